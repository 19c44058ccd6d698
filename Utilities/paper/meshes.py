# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: meshes.py FOLDER SURFACE TESTS RUINED [SOURCE]

Writes the surfaces of the experiments, with about that many points, and the .ply, .stl and .vtk
files of the folder SOURCE into FOLDER, as Testing/Meshes/MeshFile.h describes it. Files that exist
stay. Needs NumPy and VTK.
"""

import glob
import math
import os
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../../Testing/Gpu")]


def draw(random, count):
    """Numbers in [0, 1), those of std::mt19937."""
    return random.randint(0, 2**32, count, dtype=numpy.uint64) / 2**32


def lattice(columns, rows, wraps_columns=False, wraps_rows=False):
    """Column and row of the points, and the four corners of the quads."""
    r, c = numpy.divmod(numpy.arange(rows * columns), columns)
    kept = ((c < columns - 1) | wraps_columns) & ((r < rows - 1) | wraps_rows)
    right, up = (c + 1) % columns, (r + 1) % rows * columns
    quads = numpy.stack((c + r * columns, right + r * columns, right + up, c + up), axis=1)
    return c, r, quads[kept]


def cut(quads, others=False):
    """Two triangles for each quad, divided by the diagonal 0-2 or, if `others`, 1-3."""
    turned = numpy.where(numpy.reshape(others, (-1, 1)), numpy.roll(quads, -1, axis=1), quads)
    return turned[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def make_torus(columns, rows, shift, seed):
    """A closed torus with bumps, which replaces the paper's "Infinite". Points are moved along their
    circles by up to the share `shift` of their distance. If `shift` > 0, every quad is cut along a
    random diagonal."""
    random = numpy.random.RandomState(seed)
    c, r, quads = lattice(columns, rows, True, True)
    v = 2 * numpy.pi * r / rows
    u = 2 * numpy.pi * (c + shift * (2 * draw(random, len(c)) - 1)) / columns
    tube = 1 + 0.1 * numpy.sin(9 * u) * numpy.sin(5 * v)
    around = 2.5 + tube * numpy.cos(v)
    points = numpy.stack(
        (around * numpy.cos(u), around * numpy.sin(u), tube * numpy.sin(v)), axis=1)
    return points, cut(quads, (shift > 0) & (draw(random, len(quads)) < 0.5))


def make_box(size):
    """A cube of 6 * size * size quads, with sharp edges."""
    import export_meshes

    c, r, quads = lattice(size + 1, size + 1)
    corners = numpy.stack((c, r, 0 * c), axis=1)[quads]
    sides = [numpy.roll(quad + [0, 0, w], axis + 1, axis=1)
             for axis in range(3) for quad in corners for w in (0, size)]
    points, ids = export_meshes.merge_points(
        numpy.concatenate(sides).astype(float), numpy.arange(4 * len(sides)).reshape(-1, 4))
    ids[::2] = ids[::2, [0, 3, 2, 1]]
    return points, cut(ids)


def make_circles(columns, rows):
    """A plane disc of concentric circles of points at the same angles. So the four points of each
    quad lie on a circle, except for the rounding of their coordinates."""
    c, r, quads = lattice(columns, rows, True)
    turns = [2 * math.pi * i / columns for i in range(columns)]  # NumPy's sine has other last bits
    circle = numpy.array([(math.cos(turn), math.sin(turn), 0) for turn in turns])
    return (rows + r)[:, None] * circle[c], cut(quads[:, [0, 3, 2, 1]])


def make_grid(side):
    c, r, quads = lattice(side, side)
    return numpy.stack((c, r, 0 * c), axis=1).astype(float), cut(quads)


def decimate(points, triangles):
    """A tenth of the triangles, by vtkQuadricDecimation."""
    from vtkmodules.vtkFiltersCore import vtkQuadricDecimation

    decimation = vtkQuadricDecimation()
    decimation.SetInputData(make_poly_data(points, triangles))
    decimation.SetTargetReduction(0.9)
    decimation.Update()
    return read_poly_data(decimation.GetOutput())


def make_poly_data(points, triangles=()):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    mesh, cells = vtkPolyData(), vtkCellArray()
    mesh.SetPoints(vtkPoints())
    mesh.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    for triangle in numpy.asarray(triangles).tolist():
        cells.InsertNextCell(3, triangle)
    mesh.SetPolys(cells)
    return mesh


def read_poly_data(mesh):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    ids = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(mesh.GetPoints().GetData()), ids.astype(numpy.int64)


def read(path):
    """Points and triangles of a .dfmesh file."""
    with open(path, "rb") as file:
        file.seek(8)
        size, points, triangles, _, _ = numpy.fromfile(file, "<i8", 5)
        coordinates = numpy.fromfile(file, f"<f{size}", 3 * points).reshape(-1, 3)
        return coordinates, numpy.fromfile(file, "<i4", 3 * triangles).reshape(-1, 3)


def main(folder, surface, tests, ruined, source=""):
    import export_meshes

    surface, tests, ruined = int(surface), int(tests), int(ruined)

    def write(name, make):
        path = os.path.join(folder, name + ".dfmesh")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        if not os.path.isfile(path):
            export_meshes.write(path, *make(), numpy.empty((0, 2)))

    rows = int((surface / 2) ** 0.5)
    points, triangles = make_torus(int(surface / rows), rows, 0.4, 1)
    noise = 0.6 / (surface / 2) ** 0.5 * (
        2 * draw(numpy.random.RandomState(2), points.size).reshape(points.shape) - 1)
    noisy = (points + noise).astype("f4"), triangles
    write("torus", lambda: (points.astype("f4"), triangles))
    write("noisy-torus", lambda: noisy)
    write("decimated-torus", lambda: decimate(*noisy))
    side, around = (ruined / 2) ** 0.5, (ruined / 40) ** 0.5
    write("good/torus", lambda: make_torus(int(2 * side), int(side), 0.0, 12))
    write("good/box", lambda: make_box(int((ruined / 6) ** 0.5)))
    write("anisotropic/torus", lambda: make_torus(int(40 * around), int(around), 0.45, 12))
    write("tests/grid", lambda: make_grid(int(tests**0.5)))
    write("tests/circles", lambda: make_circles(2 * int(tests**0.5), int(tests**0.5) // 2))
    for path in sorted(glob.glob(os.path.join(source, "*.*"))) if source else []:
        name, suffix = os.path.splitext(os.path.basename(path))
        if suffix.lower() in (".ply", ".stl", ".vtk"):
            write(name, lambda: export_meshes.convert(path)[:2])


if __name__ == "__main__":
    main(*sys.argv[1:])
