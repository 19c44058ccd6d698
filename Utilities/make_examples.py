#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the files of the documentation's examples: small meshes of bad triangles.

terrain.vtp: survey points in metres, see make_terrain.py; road.vtk: a line over it.
scan.ply: a bumpy ring, as a laser scanner gives it. part.stl: an elliptic cylinder, as a CAD program
writes it. plate.vtk: a plane of two materials, with a cell array Material. The same arguments give the
same files.
"""
import argparse
import os
import sys

try:
    import numpy as np
    from make_terrain import make_terrain
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
except ImportError as missing:
    sys.exit(f"{missing}. The examples need NumPy and VTK for this Python: pip install numpy vtk, or on "
             "Debian python3-numpy and python3-vtk9 with /usr/bin/python3.")

VTK_HEADER = "# vtk DataFile Version 3.0\n{}\nASCII\nDATASET POLYDATA\nPOINTS {} double\n"


def grid_triangles(rows, columns, random, closed=False):
    """Two triangles per cell of a grid, cut along a random diagonal; closed: the last row and
    column join the first."""
    last_row, last_column = (rows, columns) if closed else (rows - 1, columns - 1)
    i, j = (a.ravel() for a in np.mgrid[:last_row, :last_column])
    following = (i + 1) % rows, (j + 1) % columns
    a, b = i * columns + j, i * columns + following[1]
    d, c = following[0] * columns + j, following[0] * columns + following[1]
    other = random.random(len(a)) < 0.5
    first = np.where(other[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(other[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return np.concatenate([first, second])


def ring(random, around=96, across=48):
    """A torus with bumps, whose points are uneven and in skew rows: (points, triangles)."""
    u, v = np.mgrid[:around, :across].reshape(2, -1).astype(float)
    v += 1.5 * u  # three times around at the end, so that the last row meets the first
    u = (u + random.uniform(-0.24, 0.24, u.shape)) * 2 * np.pi / around
    v = (v + random.uniform(-0.24, 0.24, v.shape)) * 2 * np.pi / across
    tube = 0.4 + 0.03 * np.sin(5 * u) * np.cos(3 * v)
    distance = 1 + tube * np.cos(v)
    points = np.stack([distance * np.cos(u), distance * np.sin(u), tube * np.sin(v)], 1)
    return points, grid_triangles(around, across, random, closed=True)


def cylinder(sides=48):
    """Elliptic, of height 2; its lids are fans from one point of the rim: (points, triangles)."""
    angle = np.arange(sides) * 2 * np.pi / sides
    rim = np.stack([2 * np.cos(angle), np.sin(angle)], 1)
    points = np.concatenate([np.c_[rim, np.zeros(sides)], np.c_[rim, np.full(sides, 2.0)]])
    i = np.arange(sides)
    j = (i + 1) % sides
    walls = np.concatenate([np.stack([i, j, j + sides], 1), np.stack([i, j + sides, i + sides], 1)])
    k = np.arange(1, sides - 1)
    top = np.stack([np.zeros_like(k), k, k + 1], 1) + sides
    bottom = np.stack([np.zeros_like(k), k + 1, k], 1)
    return points, np.concatenate([walls, top, bottom])


def plate(random, side=40):
    """A square whose columns are waves: (points, triangles, the material of each triangle)."""
    x, y = np.mgrid[:side, :side].reshape(2, -1) / (side - 1.0)
    inside = (x > 0) & (x < 1) & (y > 0) & (y < 1)
    x += 0.75 * x * (1 - x) * np.sin(2 * np.pi * y)
    noise = random.uniform(-0.2, 0.2, (2, len(x))) / (side - 1.0) * inside
    points = np.stack([x + noise[0], y + noise[1], np.zeros_like(x)], 1)
    triangles = grid_triangles(side, side, random)
    material = (triangles // side).max(axis=1) > side // 2
    return points, triangles, material.astype(int)


def road(points):
    """Points of the terrain near a straight line over it, from west to east."""
    plan = points[:, :2] - points[:, :2].min(axis=0)
    width, height = plan.max(axis=0)
    stations = np.stack([np.linspace(0.1, 0.9, 7) * width, np.linspace(0.3, 0.6, 7) * height], 1)
    nearest = [np.argmin(((plan - station) ** 2).sum(axis=1)) for station in stations]
    return points[nearest]


def rows_of(numbers):
    return "".join(" ".join(repr(value) for value in row) + "\n" for row in numbers.tolist())


def polygons(triangles):
    cells = np.c_[np.full(len(triangles), 3), triangles]
    return f"POLYGONS {len(cells)} {cells.size}\n{rows_of(cells)}"


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def write_terrain(folder, count):
    mesh = make_terrain(count, seed=4)
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.SetFileName(os.path.join(folder, "terrain.vtp"))
    writer.SetInputData(mesh)
    writer.Write()
    line = road(vtk_to_numpy(mesh.GetPoints().GetData()))
    ids = " ".join(map(str, range(len(line))))
    write(folder, "road.vtk", VTK_HEADER.format("A road", len(line)) + rows_of(line)
          + f"LINES 1 {len(line) + 1}\n{len(line)} {ids}\n")


def write_ply(folder, name, points, triangles):
    write(folder, name, "ply\nformat ascii 1.0\n"
          f"element vertex {len(points)}\n" + "".join(f"property double {a}\n" for a in "xyz")
          + f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
          + rows_of(points) + rows_of(np.c_[np.full(len(triangles), 3), triangles]))


def write_stl(folder, name, points, triangles):
    facets = ("facet normal 0 0 0\nouter loop\n"
              + "".join("vertex " + row for row in rows_of(points[triangle]).splitlines(True))
              + "endloop\nendfacet\n" for triangle in triangles)
    write(folder, name, "solid part\n" + "".join(facets) + "endsolid part\n")


def write_plate(folder, points, triangles, material):
    write(folder, "plate.vtk", VTK_HEADER.format("A plate", len(points)) + rows_of(points)
          + polygons(triangles) + f"CELL_DATA {len(triangles)}\nSCALARS Material int\n"
          + "LOOKUP_TABLE default\n" + rows_of(material[:, None]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default=".", help="where to write (default: here)")
    parser.add_argument("--terrain-points", type=int, default=2000)
    arguments = parser.parse_args()

    os.makedirs(arguments.folder, exist_ok=True)
    random = np.random.default_rng(1)
    write_terrain(arguments.folder, arguments.terrain_points)
    write_ply(arguments.folder, "scan.ply", *ring(random))
    write_stl(arguments.folder, "part.stl", *cylinder())
    write_plate(arguments.folder, *plate(random))
    print("terrain.vtp road.vtk scan.ply part.stl plate.vtk")


if __name__ == "__main__":
    main()
