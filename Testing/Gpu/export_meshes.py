#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: export_meshes.py DATA_DIR OUT_DIR

Writes every mesh of DATA_DIR and of its folder small/ that VTK can read to OUT_DIR/NAME.dfmesh, for
machines without VTK, and two of its own; Testing/Meshes/MeshFile.h describes the files. Polygons are split into fans,
images become height fields with two triangles per cell, and lines become constraint edges. Needs
VTK's Python package and numpy (Debian: python3-vtk9).
"""

import glob
import os
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkDataSetReader
from vtkmodules.vtkIOPLY import vtkPLYReader


def read(path):
    """The dataset in a file; for STL, every triangle has its own three points."""
    suffix = os.path.splitext(path)[1].lower()
    readers = {
        ".vtk": vtkDataSetReader,
        ".ply": vtkPLYReader,
        ".stl": vtkSTLReader,
        ".obj": vtkOBJReader,
    }
    reader = readers[suffix]()
    if suffix == ".stl":
        reader.MergingOff()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def merge_points(points, triangles):
    """Merges points with equal coordinates, in the order of first appearance."""
    _, first, inverse = numpy.unique(points, axis=0, return_index=True, return_inverse=True)
    rank = numpy.empty(len(first), dtype=numpy.int64)
    rank[numpy.argsort(first)] = numpy.arange(len(first))
    return points[numpy.sort(first)], rank[inverse.reshape(-1)][triangles]


def cells_of(array):
    """Point ids and offsets of a vtkCellArray."""
    ids = vtk_to_numpy(array.GetConnectivityArray()).astype(numpy.int64)
    return ids, vtk_to_numpy(array.GetOffsetsArray()).astype(numpy.int64)


def fans(array):
    """The polygons of a vtkCellArray as triangles (first, i, i + 1), in their order."""
    ids, offsets = cells_of(array)
    sizes = numpy.diff(offsets)
    counts = numpy.maximum(sizes - 2, 0)
    start = numpy.repeat(offsets[:-1], counts)
    within = numpy.arange(counts.sum()) - numpy.repeat(numpy.cumsum(counts) - counts, counts)
    corners = (start, start + within + 1, start + within + 2)
    return numpy.stack([ids[corner] for corner in corners], axis=1)


def segments(array):
    """The lines of a vtkCellArray as pairs of point ids."""
    if array.GetNumberOfCells() == 0:
        return numpy.empty((0, 2), numpy.int64)
    ids, offsets = cells_of(array)
    is_last = numpy.zeros(len(ids), dtype=bool)
    is_last[offsets[1:] - 1] = True
    starts = numpy.flatnonzero(~is_last)
    return numpy.stack((ids[starts], ids[starts + 1]), axis=1)


def image_mesh(image):
    """Points and triangles of an image. Its first array is the height."""
    columns, rows, _ = image.GetDimensions()
    (x0, y0, _), (dx, dy, _) = image.GetOrigin(), image.GetSpacing()
    points = numpy.empty((rows, columns, 3))
    points[..., 0] = x0 + dx * numpy.arange(columns)
    points[..., 1] = (y0 + dy * numpy.arange(rows))[:, None]
    points[..., 2] = vtk_to_numpy(image.GetPointData().GetArray(0)).reshape(rows, columns)
    corner = (columns * numpy.arange(rows - 1)[:, None] + numpy.arange(columns - 1)).reshape(-1)
    lower = numpy.stack((corner, corner + 1, corner + columns + 1), axis=1)
    upper = numpy.stack((corner, corner + columns + 1, corner + columns), axis=1)
    return points.reshape(-1, 3), numpy.stack((lower, upper), axis=1).reshape(-1, 3)


def is_height_field(points, triangles):
    """Whether all triangles turn the same way seen from above."""
    flat = points[:, :2].astype(numpy.float64)
    a, b, c = (flat[triangles[:, slot]] for slot in range(3))
    turns = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return bool(len(turns) and ((turns > 0).all() or (turns < 0).all()))


def convert(path):
    """Points, triangles and constraint edges of a file."""
    data = read(path)
    lines = numpy.empty((0, 2), numpy.int64)
    if isinstance(data, vtkImageData):
        return (*image_mesh(data), lines)
    points = vtk_to_numpy(data.GetPoints().GetData())
    triangles = fans(data.GetPolys())
    # Both formats repeat points: STL with every triangle, OBJ for texture coordinates and normals.
    attributes = data.GetPointData()
    if path.lower().endswith(".stl") or attributes.GetTCoords() or attributes.GetNormals():
        points, triangles = merge_points(points, triangles)
    return points, triangles, segments(data.GetLines())


def write(path, points, triangles, lines):
    is_float = points.dtype == numpy.float32
    header = [4 if is_float else 8, len(points), len(triangles), len(lines)]
    header.append(int(is_height_field(points, triangles)))
    with open(path, "wb") as file:
        file.write(b"DFMESH01")
        file.write(numpy.array(header, "<i8").tobytes())
        file.write(points.astype("<f4" if is_float else "<f8").tobytes())
        file.write(triangles.astype("<i4").tobytes())
        file.write(lines.astype("<i8").tobytes())


def join(parts):
    """Meshes as one."""
    sizes = numpy.cumsum([0] + [len(points) for points, _ in parts])
    return (numpy.concatenate([points for points, _ in parts]).astype(numpy.float32),
            numpy.concatenate([triangles + size for (_, triangles), size in zip(parts, sizes)]))


def chains(size=470, lattice=182):
    """A surface with few flips in its last iterations: six good lattices, and four chains of the
    paper's Fig. 6, two of them upright."""
    parts = []
    random = numpy.random.default_rng(1)
    i, step = numpy.arange(size), numpy.arange(size - 1)
    upper = numpy.stack((numpy.full(size - 1, size), step + 1, step), axis=1)
    lower = numpy.stack((numpy.full(size - 1, size - 1), size + step, size + step + 1), axis=1)
    x, side = numpy.concatenate((size + 1 + i, i)), numpy.repeat((1, -1), size)
    for k in range(4):
        yz = (side, numpy.full(2 * size, 5 * k)) if k % 2 else (numpy.full(2 * size, 3 * k), side)
        parts.append((numpy.stack((x, *yz), axis=1), numpy.concatenate((upper, lower))))
    corner = (lattice * numpy.arange(lattice - 1)[:, None] + numpy.arange(lattice - 1)).reshape(-1)
    cells = numpy.concatenate(
        (numpy.stack((corner, corner + lattice, corner + lattice + 1), axis=1),
         numpy.stack((corner, corner + lattice + 1, corner + 1), axis=1)))
    for k in range(6):
        flat = numpy.indices((lattice, lattice)).reshape(2, -1)
        flat = flat + random.uniform(-0.2, 0.2, flat.shape)
        far = numpy.full(lattice * lattice, -10 - 300 * (k // 3))
        parts.append((numpy.roll(numpy.stack((*flat, far), axis=1), k % 3, axis=1), cells))
    return join(parts)


def repeat_triangles(points, triangles, share=3):
    """With every third triangle again at the end."""
    return points, numpy.concatenate((triangles, triangles[::share]))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, target = sys.argv[1:]
    os.makedirs(target, exist_ok=True)
    paths = sorted(glob.glob(f"{source}/*.*") + glob.glob(f"{source}/small/*.*"))
    for path in paths:
        name, suffix = os.path.splitext(os.path.basename(path))
        if suffix.lower() in (".vtk", ".ply", ".stl", ".obj"):
            points, triangles, lines = convert(path)
            write(f"{target}/{name}.dfmesh", points, triangles, lines)
            print(f"{name}: {len(points)} points, {len(triangles)} triangles, {len(lines)} lines")
    none = numpy.empty((0, 2), numpy.int64)
    write(f"{target}/chains.dfmesh", *chains(), none)
    write(f"{target}/chains_repeated.dfmesh", *repeat_triangles(*chains()), none)


if __name__ == "__main__":
    main()
