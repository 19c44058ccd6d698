#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes terrain from survey points, badly triangulated.

Fractal mountains, sampled at scattered points that are denser where the relief is rougher, with
coordinates in metres and an offset like that of UTM. The triangles come from plain insertion: every
point, in random order, splits the triangle that contains it (Navarro, Hitschfeld and Scheihing,
Fig. 7); no edge is ever flipped, so most triangles are slivers. Equal arguments give equal
files.
"""

import argparse

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

WIDTH, HEIGHT = 12000.0, 8000.0  # metres
EASTING, NORTHING = 412000.0, 5136000.0
LOWEST, HIGHEST = 380.0, 2650.0  # metres above the sea
SIDE_SPACING = 40.0  # metres between the points on the outline


def fractal_field(random, shape, exponent):
    """A random field with the power spectrum 1 / frequency^exponent; mean 0, deviation 1."""
    fx = np.fft.rfftfreq(shape[1])
    fy = np.fft.fftfreq(shape[0])[:, None]
    frequency = np.hypot(fx, fy)
    frequency[0, 0] = np.inf
    spectrum = np.fft.rfft2(random.standard_normal(shape)) / frequency ** (exponent / 2)
    field = np.fft.irfft2(spectrum, shape)
    return (field - field.mean()) / field.std()


def relief(random):
    """Heights in metres on a grid of 768 x 1152 cells: sharp crests, slopes, flat valley floors."""
    shape = (768, 1152)
    ranges = fractal_field(random, shape, 5.0)
    crests = 1.0 - np.abs(fractal_field(random, shape, 4.4))
    spurs = 1.0 - np.abs(fractal_field(random, shape, 3.9))
    height = 0.6 * ranges + 0.5 * crests + 0.22 * np.exp(0.4 * ranges) * spurs
    height = (height - height.min()) / np.ptp(height)
    floor = 0.36
    height = np.logaddexp(0.0, 24.0 * (height - floor)) / 24.0
    return LOWEST + (HIGHEST - LOWEST) * (height - height.min()) / np.ptp(height)


def sample(grid, points):
    """Values of `grid`, which spans the whole map, at `points` (n x 2 metres), bilinearly."""
    rows, columns = grid.shape
    x = points[:, 0] / WIDTH * (columns - 1)
    y = points[:, 1] / HEIGHT * (rows - 1)
    i = np.minimum(x.astype(int), columns - 2)
    j = np.minimum(y.astype(int), rows - 2)
    u, v = x - i, y - j
    south = grid[j, i] * (1 - u) + grid[j, i + 1] * u
    north = grid[j + 1, i] * (1 - u) + grid[j + 1, i + 1] * u
    return south * (1 - v) + north * v


def survey_points(random, count, grid):
    """`count` points (x, y in metres): the four corners first, then outline and interior mixed."""
    sides = outline(random)
    wanted = count - 4 - len(sides)
    if wanted < 0:
        raise SystemExit(f"--points must be at least {4 + len(sides)}")
    corners = np.array([[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]])
    others = np.vstack([sides, interior(random, wanted, grid)])
    return np.vstack([corners, random.permutation(others)])


def interior(random, count, grid):
    """`count` points inside, denser on slopes, no two of them in one cell of a fine raster."""
    cell = 0.35 * np.sqrt(WIDTH * HEIGHT / max(count, 1))
    slope = np.hypot(*np.gradient(grid))
    steep = np.quantile(slope, 0.9)
    points = np.empty((0, 2))
    while len(points) < count:
        candidates = cell + random.random((2 * count, 2)) * [WIDTH - 2 * cell, HEIGHT - 2 * cell]
        chance = 0.1 + 0.9 * np.minimum(sample(slope, candidates) / steep, 1)
        points = np.vstack([points, candidates[random.random(len(candidates)) < chance]])
        _, first = np.unique((points // cell).astype(int), axis=0, return_index=True)
        points = points[np.sort(first)]
    return points[:count]


def outline(random):
    """Points on the four sides of the map, between the corners, about SIDE_SPACING apart."""
    sides = []
    for axis, length, across in ((0, WIDTH, HEIGHT), (1, HEIGHT, WIDTH)):
        for level in (0.0, across):
            steps = np.arange(SIDE_SPACING, length - SIDE_SPACING / 2, SIDE_SPACING)
            side = np.full((len(steps), 2), level)
            side[:, axis] = steps + random.uniform(-0.3, 0.3, len(steps)) * SIDE_SPACING
            sides.append(side)
    return np.vstack(sides)


def orientation(a, b, c):
    """Twice the signed area of the triangles a, b, c (arrays of x, y)."""
    ab, ac = b - a, c - a
    return ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]


def insert_all(points):
    """Triangles (m x 3 ids) of inserting `points` in order into the rectangle of the first four.

    Works in steps. In each, every triangle that contains points is split at the first of them.
    This gives the same triangles as inserting one point after the other.
    """
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    waiting = np.arange(4, len(points))
    holder = locate(points, waiting, np.repeat(triangles[None], len(waiting), axis=0))
    while len(waiting):
        split, first = np.unique(holder, return_index=True)
        children = three_children(triangles[split], waiting[first])
        family = np.searchsorted(split, holder)
        child = locate(points, waiting, children[family])
        slots = np.column_stack([split, len(triangles) + np.arange(2 * len(split)).reshape(-1, 2)])
        triangles = np.vstack([triangles, np.empty((2 * len(split), 3), int)])
        triangles[slots] = children
        holder = slots[family, child]
        left = np.ones(len(waiting), bool)
        left[first] = False
        waiting, holder = waiting[left], holder[left]
    area = orientation(*(points[triangles[:, i]] for i in range(3)))
    return triangles[area > 0]  # a point on the outline leaves one child without area


def three_children(parents, apexes):
    """Parents (n x 3 ids), each split at its apex: n x 3 triangles."""
    following = np.roll(parents, -1, axis=1)
    return np.stack([parents, following, np.repeat(apexes[:, None], 3, axis=1)], axis=2)


def locate(points, ids, candidates):
    """Which of its candidate triangles (n x k x 3 ids) contains each point of `ids`."""
    corners = points[candidates]
    point = points[ids][:, None]
    inside = np.min(
        [orientation(corners[:, :, i], corners[:, :, (i + 1) % 3], point) for i in range(3)], axis=0
    )
    has_area = orientation(corners[:, :, 0], corners[:, :, 1], corners[:, :, 2]) > 0
    return np.argmax(np.where(has_area, inside, -np.inf), axis=1)


def poly_data(points, triangles):
    """A vtkPolyData of double points and triangles."""
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    cells = vtkCellArray()
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64)
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(triangles.astype(np.int64).ravel(), deep=True),
    )
    mesh = vtkPolyData()
    mesh.SetPoints(vtk_points)
    mesh.SetPolys(cells)
    return mesh


def make_terrain(count, seed):
    """The mesh as vtkPolyData with `count` points."""
    random = np.random.default_rng(seed)
    grid = relief(random)
    plan = survey_points(random, count, grid)
    triangles = insert_all(plan)
    spatial = np.column_stack([plan + [EASTING, NORTHING], sample(grid, plan)])
    return poly_data(spatial, triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output", help="file to write (.vtp)")
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=4)
    arguments = parser.parse_args()

    mesh = make_terrain(arguments.points, arguments.seed)
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetFileName(arguments.output)
    writer.SetInputData(mesh)
    if not writer.Write():
        raise SystemExit(f"cannot write {arguments.output}")
    print(f"{mesh.GetNumberOfPoints():,} points, {mesh.GetNumberOfCells():,} triangles")


if __name__ == "__main__":
    main()
