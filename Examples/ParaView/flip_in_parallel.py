#!/usr/bin/env pvbatch
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Divides a mesh among the ranks of pvbatch, flips it as one, and writes the pieces.

usage: mpirun -n RANKS pvbatch flip_in_parallel.py MESH OUTPUT.pvtp [--planar-xy]

--planar-xy: judge edges by x and y alone, for terrain.
The plugin is found by PV_PLUGIN_PATH. Only the first rank runs this script; the others do what it
asks of them.
"""
import sys

from paraview import simple


def main():
    is_terrain = sys.argv[3:] == ["--planar-xy"]
    if len(sys.argv) != 3 + is_terrain:
        sys.exit(__doc__)
    mesh = simple.OpenDataFile(sys.argv[1])
    pieces = simple.ExtractSurface(Input=simple.RedistributeDataSet(Input=mesh))
    flip = simple.DelaunayFlip(Input=pieces, Geometry="Planar XY" if is_terrain else "Auto")
    flip.UpdatePipeline()
    flip.SMProxy.UpdatePipelineInformation()
    if flip.StopReason != "converged":
        sys.exit(f"error: {flip.StopReason}")
    simple.SaveData(sys.argv[2], proxy=flip, DataMode="Binary")
    print(f"{flip.TotalFlips} flips in {flip.NumberOfRounds} rounds, "
          f"{flip.NonDelaunayAfter} bad edges left", flush=True)


main()
