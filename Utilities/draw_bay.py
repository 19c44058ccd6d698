#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the mesh of a bay from its shoreline and soundings, refines it by a size field from the depth, prints
what a solver gains, and draws both meshes, their angles and their areas. Needs SciPy and matplotlib:

    python3 Utilities/draw_bay.py [FOLDER]
"""
import pathlib
import sys

import matplotlib
import numpy
from scipy import sparse
from scipy.sparse.linalg import eigsh

import delaunayflip

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap, BoundaryNorm

COLORS = ["#b2182b", "#ef8a62", "#fddbc7", "#d1e5f0", "#67a9cf", "#2166ac"]  # by smallest angle
GRAVITY = 9.81


def make_shore(seed=7):
    """A bay of 10 by 8 km, open to the south, with an island: two rings, in km."""
    draw = numpy.random.default_rng(seed)
    x = numpy.linspace(0.0, 10.0, 201)
    y = 4.5 + 2.6 * numpy.exp(-((x - 5.5) / 1.8) ** 2)
    for wave in range(2, 30):
        y += draw.normal() * 0.5 / wave**1.2 * numpy.sin(0.63 * wave * x + draw.uniform(0.0, 6.3))
    turn = numpy.linspace(0.0, 2.0 * numpy.pi, 60, endpoint=False)
    radius = 0.5 + 0.06 * numpy.sin(3.0 * turn) + 0.02 * draw.normal(size=60)
    island = numpy.stack([5.2 + 1.4 * radius * numpy.cos(turn), 3.4 + radius * numpy.sin(turn)], axis=1)
    sea = numpy.array([[10.0, 0.0], [0.0, 0.0]])
    return numpy.concatenate([numpy.stack([x, y], axis=1), sea]), island


def find_distance(points, shore, island):
    """The distance from the coasts, in km."""
    coast = numpy.concatenate([shore[:-2], island])
    return numpy.linalg.norm(points[:, None] - coast[None], axis=2).min(axis=1)


def make_soundings(shore, island, seed=1):
    """Places of soundings along the lines of a ship, which keeps away from the coasts."""
    x, y = numpy.mgrid[0.15:9.9:0.1, 0.2:8.0:0.4].reshape(2, -1)
    places = numpy.stack([x, y], axis=1) + numpy.random.default_rng(seed).normal(size=(len(x), 2)) * 0.02
    return places[find_distance(places, shore, island) > 0.1]


def find_depth(points, shore, island):
    """The depth in metres, which grows with the distance from the coasts."""
    return 1.0 + 45.0 * (1.0 - numpy.exp(-find_distance(points, shore, island) / 1.5))


def measure(points, triangles, depths):
    """The smallest angles in degrees, the areas in km2, the condition number of the stiffness matrix of
    linear elements with values given on the boundary, and the time step of waves in shallow water in s."""
    corners = points[triangles, :2]
    edges = numpy.roll(corners, 1, axis=1) - numpy.roll(corners, -1, axis=1)  # opposite to each corner
    doubled = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
    values = numpy.einsum("tik,tjk->tij", edges, edges) / (2.0 * doubled[:, None, None])
    rows, columns = numpy.repeat(triangles, 3, axis=1), numpy.tile(triangles, 3)
    matrix = sparse.csr_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape=2 * (len(points),))
    pairs = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]))
    pairs, uses = numpy.unique(pairs, axis=0, return_counts=True)
    is_inside = numpy.isin(numpy.arange(len(points)), triangles)
    is_inside[pairs[uses == 1]] = False
    matrix = matrix[is_inside][:, is_inside]
    largest = eigsh(matrix, 1, which="LA", return_eigenvectors=False)[0]
    smallest = eigsh(matrix.tocsc(), 1, sigma=0.0, return_eigenvectors=False)[0]
    heights = doubled / numpy.linalg.norm(edges, axis=2).max(axis=1)  # the smallest height of each triangle
    step = (1000.0 * heights / numpy.sqrt(GRAVITY * depths[triangles].max(axis=1))).min()
    angles = delaunayflip.smallest_angles(points, triangles, geometry="planar-xy")
    return angles, doubled / 2.0, largest / smallest, step


def draw(meshes, path):
    figure, axes = pyplot.subplots(2, 2, figsize=(9.6, 7.2), dpi=100, layout="constrained")
    norm = BoundaryNorm(range(0, 61, 10), 6)
    for axis, (name, points, triangles, (angles, *_)) in zip(axes[0], meshes):
        faces = PolyCollection(points[triangles, :2], array=angles, cmap=ListedColormap(COLORS), norm=norm,
                               edgecolors="#404040", linewidths=0.2)
        axis.add_collection(faces)
        axis.set(title=name, aspect="equal", xlim=(0, 10), ylim=(0, 8), xlabel="km")
    figure.colorbar(faces, ax=axes[0], label="smallest angle (degrees)", shrink=0.8)
    for name, _, _, (angles, areas, *_) in meshes:
        for axis, values, bins in ((axes[1, 0], angles, numpy.arange(0.0, 61.0, 2.0)),
                                   (axes[1, 1], numpy.log10(areas), numpy.arange(-6.0, 0.2, 0.2))):
            share = numpy.full(len(values), 100.0 / len(values))
            axis.hist(values, bins=bins, weights=share, histtype="step", linewidth=1.5, label=name)
    axes[1, 0].set(xlabel="smallest angle of a triangle (degrees)", ylabel="% of the triangles")
    axes[1, 1].set(xlabel="area of a triangle (km², powers of ten)", ylabel="% of the triangles")
    axes[1, 1].legend(loc="upper left")
    figure.savefig(path)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "Documentation/images")
    shore, island = make_shore()
    soundings = make_soundings(shore, island)
    chart = delaunayflip.triangulate(soundings, outline=shore, holes=island)
    depths = find_depth(chart.points, shore, island)
    size = 0.05 * numpy.sqrt(depths)  # waves take about the same time through each triangle
    mesh = delaunayflip.flip(chart.points, chart.triangles, geometry="planar-xy", minimum_angle=28, size=size)
    meshes = []
    for name, points, triangles, depth in (("before", chart.points, chart.triangles, depths),
                                           ("after", mesh.points[:, :2], mesh.triangles, mesh.at_points(depths))):
        measured = measure(points, triangles, depth)
        meshes.append((name, points, triangles, measured))
        angles, areas, condition, step = measured
        print(f"{name}: {len(triangles):,} triangles, smallest angle {angles.min():.2f} degrees, smallest area "
              f"{areas.min() * 1e6:.3g} m2, condition number {condition:,.0f}, time step {step:.3f} s")
    draw(meshes, folder / "guide_bay.png")


if __name__ == "__main__":
    main()
