#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pieces of a mesh on four ranks before and after vtkPDelaunayFlip, with a colour for each
rank. To be run by mpirun, with the build's package and matplotlib in PYTHONPATH:

    mpirun -n 4 python3 Utilities/draw_pieces.py [FOLDER]
"""
import os
import sys

import numpy as np
from mpi4py import MPI
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, f"{HERE}/../Testing/Parallel")

import delaunayflip
import rank_meshes

COLORS = ("#e0a458", "#5b8e7d", "#7ea8d8", "#bc6c8f")
WORLD = MPI.COMM_WORLD


def flip(piece, iterations):
    """The corners of the triangles of every rank, and a line about them."""
    filter_ = delaunayflip.vtkPDelaunayFlip()
    filter_.SetMaximumIterations(iterations)
    filter_.SetInputData(piece)
    filter_.UpdatePiece(WORLD.rank, WORLD.size, 0)
    mesh = filter_.GetOutput()
    corners = rank_meshes.read_points(mesh)[rank_meshes.read_triangles(mesh)][:, :, :2]
    text = (f"after {filter_.GetTotalFlips():,} flips in {filter_.GetNumberOfRounds()} rounds; "
            f"{filter_.GetNumberOfMovedTriangles()} triangles moved")
    return WORLD.gather(corners), text


def draw(pictures, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from draw_demo import INK, save
    from matplotlib.collections import PolyCollection

    figure, both = plt.subplots(1, 2, figsize=(9, 5.0))
    for axes, (pieces, title) in zip(both, pictures):
        for rank, (corners, color) in enumerate(zip(pieces, COLORS)):
            axes.add_collection(PolyCollection(
                corners, facecolors=color, edgecolors=INK, linewidths=0.4, label=f"process {rank}"))
        axes.set(xlim=(-0.01, 1.01), ylim=(-0.01, 1.01), aspect="equal")
        axes.axis("off")
        axes.set_title(title, color=INK, fontsize=10)
    figure.subplots_adjust(0.01, 0.08, 0.99, 0.92, wspace=0.04)
    handles, names = both[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", frameon=False, ncol=len(names), labelcolor=INK)
    save(figure, path)


def main():
    controller = vtkMPIController()
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    points, triangles = rank_meshes.make_random(300)
    owners = rank_meshes.divide(points, triangles, WORLD.size, "space")
    piece = rank_meshes.make_piece(points, triangles, np.flatnonzero(owners == WORLD.rank), True)
    before, _ = flip(piece, 0)
    after, text = flip(piece, -1)
    if WORLD.rank == 0:
        folder = sys.argv[1] if len(sys.argv) > 1 else f"{HERE}/../Documentation/images"
        draw([(before, "before"), (after, text)], os.path.join(folder, "pieces.png"))
    vtkMultiProcessController.SetGlobalController(None)


main()
