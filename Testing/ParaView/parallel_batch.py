# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Run by test_parallel.py in pvbatch with two ranks, each of which has its own meshes.

Prints one line of JSON for each requested case: the messages and results of the filter.
"""

import json
import os
import sys

from paraview import simple

from PluginTesting import Messages, fetch, refresh

# Runs on every rank. "meshes" has the sizes of the rank's fans, by their blocks.
SOURCE = """
import sys
sys.path.insert(0, {here!r})
from PluginTesting import convert_surface, make_cells, make_fan
from vtkmodules.vtkParallelCore import vtkMultiProcessController

rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
meshes = {meshes!r}[rank]
kinds = {kinds!r}

def make(size, block):
    if block in kinds:
        return convert_surface(size, kinds[block])
    mesh = make_fan(abs(size))
    if size < 0:
        mesh.SetPolys(make_cells([(0, 1, 77)]))
        mesh.GetCellData().Initialize()
    return mesh

output = self.GetOutput()
if {composite!r}:
    output.SetNumberOfBlocks(4)
    for block, size in meshes.items():
        output.SetBlock(block, make(size, block))
elif meshes:
    output.ShallowCopy(make(meshes[0], 0))
"""
PIECES = "self.GetOutputInformation(0).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)"

# By case: the sizes of the fans of rank 0 and of rank 1. Negative sizes make broken fans.
CASES = {
    "pieces": ({0: 20}, {0: 30}),
    "one empty": ({}, {0: 20}),
    "one fails": ({0: 20}, {0: -20}),
    "blocks": ({0: 10}, {1: 20, 2: 15, 3: 25}),
    "shared block": ({0: 10, 1: 12}, {1: 20}),
    "block fails": ({0: 10}, {1: 20, 2: -15, 3: 25}),
    "nothing": ({}, {}),
    "unstructured pieces": ({0: 20}, {0: 30}),
    "blocks of other types": ({0: 20, 3: 6}, {1: 9, 2: 7}),
}
# By case and block: the types of meshes that are not polygonal data.
KINDS = {
    "unstructured pieces": {0: "vtkUnstructuredGrid"},
    "blocks of other types": {
        0: "vtkUnstructuredGrid", 1: "vtkStructuredGrid", 2: "vtkImageData", 3: "vtkStructuredGrid"},
}


def make_source(case):
    composite = "block" in case
    kinds = KINDS.get(case, {})
    kind = "vtkMultiblockDataSet" if composite else kinds.get(0, "vtkPolyData")
    source = simple.ProgrammableSource(OutputDataSetType=kind)
    source.Script = SOURCE.format(here=os.path.dirname(os.path.abspath(__file__)),
                                  meshes=CASES[case], kinds=kinds, composite=composite)
    source.ScriptRequestInformation = PIECES
    return source


def get_flipped(table):
    column = table.GetRowData().GetArray("Flipped")  # missing if ParaView joined empty tables
    return [int(column.GetTuple1(i)) for i in range(column.GetNumberOfTuples())] if column else []


def describe(flip, messages):
    return {
        "flips": flip.TotalFlips, "iterations": flip.NumberOfIterations,
        "bad": flip.NumberOfNonDelaunayEdges, "stopped": flip.StopReason,
        "geometry": flip.GeometryUsed, "flipped": get_flipped(fetch(flip, 1)),
        "errors": messages.text.count("ERROR"), "warnings": messages.text.count("Warning"),
        "text": messages.text}


def run(case):
    """Updates the filter, changes an option and updates it again. This would hang if a rank had
    missed an update."""
    flip = simple.DelaunayFlip(Input=make_source(case))
    flip.LiveUpdate = int(case == "pieces")
    for tie_rule in ("Keep", "Canonical"):
        flip.TieRule = tie_rule
        with Messages() as messages:
            refresh(flip)
        said = describe(flip, messages)
    print(json.dumps({case: said}), flush=True)


simple.LoadPlugin(os.environ["DELAUNAYFLIP_PLUGIN"], remote=False)
for name in sys.argv[1:]:
    run(name)
print("all is well", flush=True)
