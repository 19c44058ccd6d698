#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the result of the demo: a terrain mesh before and after, and the flips per iteration."""

import argparse
import csv
import json
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.patches import Rectangle
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

INK = "#22313f"
RELIEF = LinearSegmentedColormap.from_list(
    "relief",
    [
        (0.0, "#8fb8d0"),
        (0.02, "#8fb8d0"),
        (0.03, "#86ab6f"),
        (0.2, "#b4c383"),
        (0.4, "#dccf9d"),
        (0.6, "#bd9f7c"),
        (0.8, "#a79489"),
        (1.0, "#f7f5f2"),
    ],
)
# The colours of angles everywhere: see Plugin/AngleColors.json.
ANGLES = LinearSegmentedColormap.from_list(
    "angles", ["#b2182b", "#ef8a62", "#fddbc7", "#d1e5f0", "#67a9cf", "#2166ac"], N=12
)
SUN = np.array([-0.5, 0.5, 0.7071])
WINDOW = 0.05  # the close-up's width, as a share of the map's


def read_mesh(path):
    """Points (n x 3, kilometres from the lower left corner) and triangles (m x 3 ids) of a .vtp."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points[:, :2] -= points[:, :2].min(axis=0)
    return points / 1000.0, triangles


def smallest_angles(points, triangles):
    """The smallest angle of every triangle in degrees, in the x, y plane."""
    corners = points[triangles][:, :, :2]
    angles = []
    for i in range(3):
        a = corners[:, (i + 1) % 3] - corners[:, i]
        b = corners[:, (i + 2) % 3] - corners[:, i]
        cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        angles.append(np.arctan2(np.abs(cross), (a * b).sum(axis=1)))
    return np.degrees(np.min(angles, axis=0))


def shaded_colors(points, triangles):
    """An RGBA colour per triangle: height tints, with the sun in the north-west."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None] + 1e-300
    light = 0.4 + 0.85 * np.clip(normals @ SUN, 0.0, 1.0)
    heights = points[:, 2]
    colors = RELIEF(Normalize(heights.min(), heights.max())(heights[triangles].mean(axis=1)))
    colors[:, :3] = np.clip(colors[:, :3] * light[:, None], 0.0, 1.0)
    return colors


def roughest_window(points):
    """A square (x, y, side) around the highest point, inside the map."""
    extent = points[:, :2].max(axis=0)
    side = WINDOW * extent[0]
    peak = points[np.argmax(points[:, 2]), :2]
    low = np.clip(peak - side / 2, 0.05 * extent, 0.95 * extent - side)
    return low[0], low[1], side


def draw_triangles(axes, points, triangles, colors, **style):
    axes.add_collection(PolyCollection(points[triangles][:, :, :2], facecolors=colors, **style))


def draw_map(axes, points, triangles, window):
    colors = shaded_colors(points, triangles)
    draw_triangles(axes, points, triangles, colors, linewidths=0, antialiased=False)
    x, y, side = window
    for color, width in (("white", 3.0), (INK, 1.4)):
        axes.add_patch(Rectangle((x, y), side, side, fill=False, edgecolor=color, linewidth=width))
    width, height = points[:, :2].max(axis=0)
    frame(axes, (0, width), (0, height))


def draw_close_up(axes, points, triangles, window):
    """The window's triangles, coloured by their smallest angle."""
    x, y, side = window
    corners = points[triangles]
    near = (corners[:, :, 0].max(axis=1) > x) & (corners[:, :, 0].min(axis=1) < x + side)
    near &= (corners[:, :, 1].max(axis=1) > y) & (corners[:, :, 1].min(axis=1) < y + side)
    shown = triangles[near]
    colors = ANGLES(smallest_angles(points, shown) / 60.0)
    draw_triangles(axes, points, shown, colors, edgecolors=INK + "90", linewidths=0.3)
    frame(axes, (x, x + side), (y, y + side))


def add_angle_legend(figure, bottom):
    """A colour bar below the pictures of a figure, at a share of its height."""
    bar = figure.add_axes((0.3, bottom, 0.4, 0.12 / figure.get_figheight()))
    figure.colorbar(ScalarMappable(Normalize(0, 60), ANGLES), cax=bar, orientation="horizontal",
                    ticks=range(0, 61, 10), format="{x:.0f}°")
    bar.set_xlabel("smallest angle of a triangle", color=INK, fontsize=9)
    bar.tick_params(labelsize=9, colors=INK)


def draw_histogram(axes, angles):
    counts, edges = np.histogram(angles, bins=60, range=(0, 60))
    share = 100.0 * counts / len(angles)
    axes.bar(edges[:-1], share, width=1.0, align="edge", color=ANGLES(edges[:-1] / 60.0))
    axes.set_xlim(0, 60)
    axes.set_xticks(range(0, 61, 10), [f"{tick}°" for tick in range(0, 61, 10)])
    axes.set_xlabel("smallest angle of a triangle")
    axes.spines[["top", "right"]].set_visible(False)


def frame(axes, x_limits, y_limits):
    axes.set(xlim=x_limits, ylim=y_limits, aspect="equal", xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set(color=INK, linewidth=0.8)


def draw_comparison(path, before, after, triangles_bad):
    """Two columns, before and after: the map, a close-up of its edges, the smallest angles."""
    figure, grid = plt.subplots(
        3, 2, figsize=(10, 10.6), layout="constrained", height_ratios=[6.7, 10, 4]
    )
    window = roughest_window(before[0])
    titles = ("before", "after")
    for column, ((points, triangles), title) in enumerate(zip((before, after), titles)):
        bad = triangles_bad[column]
        grid[0, column].set_title(f"{title}: {bad:,} edges not Delaunay", fontsize=14)
        draw_map(grid[0, column], points, triangles, window)
        draw_close_up(grid[1, column], points, triangles, window)
        draw_histogram(grid[2, column], smallest_angles(points, triangles))
    grid[0, 0].set_ylabel("the terrain under the sun")
    grid[1, 0].set_ylabel("close-up, coloured by smallest angle")
    grid[2, 0].set_ylabel("% of triangles")
    save(figure, path)


def draw_iterations(path, rows):
    """Flipped and excluded edges of every iteration, on a logarithmic scale."""
    numbers = np.array([[int(row[key]) for key in ("Flipped", "Excluded")] for row in rows])
    edges = np.arange(len(rows) + 1) + 0.5
    figure, axes = plt.subplots(figsize=(9, 4.5), layout="constrained")
    style = {"edges": edges, "baseline": 0.5}
    axes.stairs(numbers[:, 0], **style, fill=True, color="#67a9cf", label="flipped")
    axes.stairs(numbers[:, 1], **style, color="#b2182b", linewidth=1.4, label="had to wait")
    axes.set(xlabel="iteration", ylabel="edges", yscale="log", ylim=(0.5, None))
    axes.set_xlim(0.5, len(rows) + 0.5)
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
    axes.set_title(f"{numbers[:, 0].sum():,} flips in {len(rows)} iterations")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False)
    save(figure, path)


def save(figure, path):
    """Writes a PNG of 256 colours, also those of a legend, in a third of the size of a full one."""
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    few = image.quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    few.save(path, optimize=True)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="holds before.vtp, after.vtp, report.json, iterations.csv")
    folder = parser.parse_args().folder

    before = read_mesh(os.path.join(folder, "before.vtp"))
    after = read_mesh(os.path.join(folder, "after.vtp"))
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    with open(os.path.join(folder, "iterations.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    bad = report["non_delaunay_before"], report["non_delaunay_after"]
    draw_comparison(os.path.join(folder, "before_after.png"), before, after, bad)
    draw_iterations(os.path.join(folder, "iterations.png"), rows)


if __name__ == "__main__":
    main()
