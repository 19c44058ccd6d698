# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes in pieces, for programs with any number of ranks: pvbatch and clients of pvserver.

Sources make the pieces on the ranks, and another filter, downstream, writes what every rank has into
a file of its own.
"""

import glob
import json
import os

from paraview import simple

from PluginTesting import Messages, fetch, refresh

# The sizes of meshes, by their blocks. A mesh of negative size is broken on the last rank.
CASES = {
    "pieces": {0: 40},
    "one rank has all": {0: 20},
    "unstructured pieces": {0: 30},
    "one fails": {0: -20},
    "nothing": {0: 0},
    "blocks": {0: 20, 1: 15, 2: 25},
    "blocks of other types": {0: 20, 1: 12, 2: 12, 3: 9},
    "block fails": {0: 10, 1: -20, 3: 15},
}
# By case and block: the types of meshes that are not polygonal data, and the blocks that only the
# last rank has.
KINDS = {
    "unstructured pieces": {0: "vtkUnstructuredGrid"},
    "blocks of other types": {0: "vtkUnstructuredGrid", 1: "vtkStructuredGrid", 2: "vtkImageData"},
}
ALONE = {"one rank has all": (0,), "blocks": (1,), "blocks of other types": (2, 3)}

SOURCE = """
import sys
sys.path.insert(0, {here!r})
from rank_pieces import make_pieces
make_pieces(self.GetOutput(), {sizes!r}, {kinds!r}, {alone!r})
"""
PIECES = "self.GetOutputInformation(0).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)"
WRITER = """
import sys
sys.path.insert(0, {here!r})
from rank_pieces import write_rank
write_rank(self.GetInput(), {folder!r})
self.GetOutput().Initialize()
"""
HERE = os.path.dirname(os.path.abspath(__file__))


def make_source(case):
    kinds = KINDS.get(case, {})
    kind = "vtkMultiblockDataSet" if "block" in case else kinds.get(0, "vtkPolyData")
    source = simple.ProgrammableSource(OutputDataSetType=kind)
    source.Script = SOURCE.format(
        here=HERE, sizes=CASES[case], kinds=kinds, alone=ALONE.get(case, ()))
    source.ScriptRequestInformation = PIECES
    return source


def write_ranks(flip, folder):
    """What the ranks have, in their order."""
    os.makedirs(folder)
    writer = simple.ProgrammableFilter(Input=flip, OutputDataSetType="vtkPolyData")
    writer.Script = WRITER.format(here=HERE, folder=folder)
    writer.UpdatePipeline()
    ranks = []
    for name in sorted(glob.glob(os.path.join(folder, "*.json"))):
        with open(name, encoding="utf-8") as file:
            ranks.append(json.load(file))
    return ranks


def get_flipped(table):
    column = table.GetRowData().GetArray("Flipped")  # missing if ParaView joined empty tables
    return [int(column.GetTuple1(i)) for i in range(column.GetNumberOfTuples())] if column else []


def run(case, folder):
    """Updates the filter, changes an option and updates it again. This would hang if a rank had
    missed an update. @returns the messages and results."""
    flip = simple.DelaunayFlip(Input=make_source(case), Geometry="Planar")
    flip.LiveUpdate = int(case == "pieces")
    for tie_rule in ("Keep", "Canonical"):
        flip.TieRule = tie_rule
        with Messages() as messages:
            refresh(flip)
    return {
        "ranks": write_ranks(flip, os.path.join(folder, case)), "flips": flip.TotalFlips,
        "rounds": flip.NumberOfRounds, "moved": flip.NumberOfMovedTriangles,
        "bad": flip.NumberOfNonDelaunayEdges, "stopped": flip.StopReason,
        "geometry": flip.GeometryUsed, "iterations": flip.NumberOfIterations,
        "flipped": get_flipped(fetch(flip, 1)), "errors": messages.text.count("ERROR"),
        "warnings": messages.text.count("Warning"), "text": messages.text}
