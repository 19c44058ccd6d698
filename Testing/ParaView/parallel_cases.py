# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes in pieces, for programs with any number of ranks. Run by test_parallel.py:
parallel_cases.py FOLDER [PORT], in pvbatch, or in pvpython as the client of a server at the port.
Writes what the filter says of each case to FOLDER/facts.json, and files of the ranks beside it.

Sources make the pieces on the ranks, and another filter, downstream, writes what every rank has into
a file of its own.
"""

import glob
import json
import os
import sys

from paraview import simple

from PluginTesting import PLUGIN, Messages, fetch, refresh

# The size of the mesh, and whether it is broken on the last rank.
CASES = {"pieces": (40, False), "other pieces": (30, False), "one fails": (20, True)}
SOURCE = """
import sys
sys.path.insert(0, {here!r})
from surfaces import make_piece
make_piece(self.GetOutput(), {size}, {broken})
"""
PIECES = "self.GetOutputInformation(0).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)"
WRITER = """
import sys
sys.path.insert(0, {here!r})
from surfaces import write_rank
write_rank(self.GetInput(), {folder!r})
self.GetOutput().Initialize()
"""
HERE = os.path.dirname(os.path.abspath(__file__))


def make_source(case):
    size, broken = CASES[case]
    source = simple.ProgrammableSource(OutputDataSetType="vtkPolyData")
    source.Script = SOURCE.format(here=HERE, size=size, broken=broken)
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
        "bad": flip.NonDelaunayAfter, "stopped": flip.StopReason,
        "geometry": flip.GeometryUsed, "iterations": flip.NumberOfIterations,
        "flipped": get_flipped(fetch(flip, 1)), "errors": messages.text.count("ERROR"),
        "warnings": messages.text.count("Warning"), "text": messages.text}


if __name__ == "__main__":
    if len(sys.argv) > 2:
        simple.Connect("127.0.0.1", int(sys.argv[2]))
        simple.LoadPlugin(PLUGIN, remote=True)
    simple.LoadPlugin(PLUGIN, remote=False)
    facts = {case: run(case, sys.argv[1]) for case in CASES}
    with open(os.path.join(sys.argv[1], "facts.json"), "w", encoding="utf-8") as file:
        json.dump(facts, file)
    print("all is well", flush=True)
