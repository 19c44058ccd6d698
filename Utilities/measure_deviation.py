#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the tables of the guides "Scans" and "Simulation meshes": what feature angles and a maximum
deviation do to meshes of make_examples.py, and how many diagonals of quads flip where the points of a
rotated grid are rounded."""
import argparse
import json
import os
import subprocess
import tempfile

import numpy as np
from draw_gallery import HERE, run
from make_examples import VTK_HEADER, polygons, rows_of, write
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

SLIVER = 10.0  # degrees
CASES = (("before", ["--max-iterations", "0"]), ("30", ["--feature-angle", "30"]),
         ("60", ["--feature-angle", "60"]), ("180", ["--feature-angle", "180"]),
         *((f"180, {share}", ["--feature-angle", "180", "--max-deviation", share])
           for share in ("0.1%", "0.3%")))


def sample_edges(points, triangles, parts=16):
    """Points that divide the edges of the triangles into equal parts: flips move a surface most there."""
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
    shares = np.arange(1, parts)[:, None, None] / parts
    return (points[edges[:, 0]] * (1 - shares) + points[edges[:, 1]] * shares).reshape(-1, 3)


def measure_distance(samples, points, triangles):
    """The largest distance of the samples from a surface."""
    mesh, corners, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    corners.SetData(numpy_to_vtk(points, deep=True))
    cells.SetData(3, numpy_to_vtk(triangles.ravel().astype(np.int64), deep=True, array_type=12))
    mesh.SetPoints(corners)
    mesh.SetPolys(cells)
    surface, distances = vtkImplicitPolyDataDistance(), vtkDoubleArray()
    surface.SetInput(mesh)
    surface.FunctionValue(numpy_to_vtk(samples, deep=True), distances)
    return abs(vtk_to_numpy(distances)).max()


def compare(command, folder, file, options, before):
    """Slivers left, and the distance between both surfaces in percent of the diagonal."""
    points, triangles, angles = run(command, folder, file, ["--quality", "--geometry", "surface", *options])
    old_points, old_triangles, _ = before or (points, triangles, None)
    moved = max(measure_distance(sample_edges(points, triangles), old_points, old_triangles),
                measure_distance(sample_edges(old_points, old_triangles), points, triangles))
    diagonal = np.linalg.norm(np.ptp(points, axis=0))
    return (points, triangles, angles), int((angles < SLIVER).sum()), 100 * moved / diagonal


def count_flips(command, folder, options):
    """The flips of a grid of 100 x 100 quads of 1 m, turned by 25 degrees and rounded to millimetres."""
    x, y = np.mgrid[:101, :101].reshape(2, -1)
    turn = np.radians(25.0)
    points = np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn),
                       0 * x], 1).round(3)
    a = np.flatnonzero((x < 100) & (y < 100))
    triangles = np.concatenate([np.stack([a, a + 101, a + 102], 1), np.stack([a, a + 102, a + 1], 1)])
    write(folder, "grid.vtk", VTK_HEADER.format("A grid", len(points)) + rows_of(points)
          + polygons(triangles))
    subprocess.run([command, "grid.vtk", "out.vtk", "--quiet", "--report", "run.json", *options],
                   cwd=folder, check=True)
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
        return json.load(file)["total_flips"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--command", default=f"{HERE}/../build/bin/delaunay-flip")
    command = os.path.abspath(parser.parse_args().command)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["/usr/bin/python3", f"{HERE}/make_examples.py", folder], check=True,
                       stdout=subprocess.DEVNULL)
        print("| mesh | feature angle, deviation | slivers | moved |\n|---|---|---|---|")
        for file in ("scan.ply", "edges.ply", "terrain.vtp"):
            before = None
            for title, options in CASES:
                mesh, slivers, moved = compare(command, folder, file, options, before)
                before = before or mesh
                print(f"| {file} | {title} | {slivers:,} | {moved:.2f} % |")
        print("\n| options | flips |\n|---|---|")
        for options in ([], ["--criterion", "opposite-angles"],
                        ["--criterion", "opposite-angles", "--tolerance", "1e-3"],
                        ["--criterion", "opposite-angles", "--tolerance", "6e-3"]):
            title = f"`{' '.join(options)}`" if options else "none"
            print(f"| {title} | {count_flips(command, folder, options):,} |")


if __name__ == "__main__":
    main()
