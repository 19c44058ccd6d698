#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation's guides: the meshes of make_examples.py before and after
delaunay-flip, coloured by the smallest angle of each triangle, and the survey, which has no triangles
before. Each picture has a legend."""
import argparse
import os
import subprocess
import tempfile

import delaunayflip
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from draw_demo import ANGLES, INK, add_angle_legend, save, shaded_colors
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LightSource, Normalize
from matplotlib.lines import Line2D
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkContourFilter
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader

HERE = os.path.dirname(os.path.abspath(__file__))
WATER, RING = "#2166ac", "#b2182b"

#: picture: (mesh, options, the direction to look from or None for the x, y plane, a part of it)
PICTURES = {
    "scan": ("scan.ply", ["--feature-angle", "180"], (0.3, -1.0, 1.2), (-0.8, 0.8, -1.35, 0.1)),
    "part": ("part.stl", [], (0.5, -1.0, 1.1), None),
    "plate": ("plate.vtk", ["--region-array", "Material"], None, (0.3, 0.75, 0.05, 0.5)),
    "road": ("terrain.vtp", ["--geometry", "planar-xy", "--constraints", "road.vtk"], None,
             (3000, 6000, 2600, 4600)),
}


def run(command, folder, file, options):
    """Points, triangles and, with --quality, the smallest angle of each, after flips."""
    output = os.path.join(folder, "out.vtp")
    subprocess.run([command, file, output, "--quiet", *options], cwd=folder,
                   stderr=subprocess.DEVNULL, check=False)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(output)
    reader.Update()
    mesh = reader.GetOutput()
    angles = mesh.GetCellData().GetArray("Smallest angle after (degrees)")
    return (vtk_to_numpy(mesh.GetPoints().GetData()).astype(float),
            vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3),
            vtk_to_numpy(angles) if angles else None)


def read_lines(folder, name):
    """The lines of a file of make_examples.py: arrays of x, y."""
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        points, lines = file.read().split("double\n")[1].split("LINES")
    points = np.array([row.split() for row in points.splitlines()], dtype=float)
    return [points[np.array(row.split()[1:], dtype=int), :2] for row in lines.splitlines()[1:]]


def project(points, triangles, direction):
    """The points as seen from a direction, and the triangles in front, the farthest first."""
    if direction is None:
        return points[:, :2], np.arange(len(triangles))
    forward = np.array(direction) / np.linalg.norm(direction)
    right = np.cross([0, 0, 1], forward)
    right /= np.linalg.norm(right)
    plan = np.stack([points @ right, points @ np.cross(forward, right)], 1)
    corners = plan[triangles]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    depth = (points @ forward)[triangles].mean(axis=1)
    order = np.argsort(depth)
    return plan, order[(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])[order] > 0]


def draw_mesh(axes, mesh, direction, window):
    points, triangles, angles = mesh
    plan, order = project(points, triangles, direction)
    axes.add_collection(PolyCollection(
        plan[triangles[order]], facecolors=ANGLES(Normalize(0, 60)(angles[order])),
        edgecolors=INK, linewidths=0.4))
    low, high = plan.min(axis=0), plan.max(axis=0)
    limits = window or (low[0], high[0], low[1], high[1])
    axes.set_xlim(limits[:2])
    axes.set_ylim(limits[2:])
    axes.set_aspect("equal")
    axes.axis("off")


def draw_lines(axes, lines, origin, **style):
    axes.add_collection(LineCollection([line - origin[:2] for line in lines], **style))


def add_legend(figure, place, marks):
    """A line below the pictures, centred at a place: styles of lines, by what they mean."""
    handles = [Line2D([], [], label=label, **style) for label, style in marks.items()]
    figure.legend(handles=handles, loc="lower center", bbox_to_anchor=place, frameon=False,
                  ncol=len(marks), fontsize=9, labelcolor=INK)


def draw_relief(axes, mesh, origin):
    """The mesh under the sun, with its edges."""
    points, triangles, _ = mesh
    axes.add_collection(PolyCollection((points - origin)[triangles][:, :, :2], linewidths=0.25,
                                       facecolors=shaded_colors(points, triangles), edgecolors=INK))


def draw_survey(command, folder, output):
    """guide_survey.png: the points, and the mesh within its outline; guide_river.png: what the
    breaklines are for."""
    survey = np.loadtxt(os.path.join(folder, "survey.csv"), delimiter=",", skiprows=1)
    origin = survey.min(axis=0)
    river = read_lines(folder, "river.vtk")
    rings = read_lines(folder, "area.vtk") + read_lines(folder, "pond.vtk")
    plain = ["--from-points"]
    lines = plain + ["--constraints", "river.vtk"]
    bounded = lines + ["--outline", "area.vtk", "--holes", "pond.vtk"]
    point = {"color": INK, "marker": ".", "markersize": 3, "linestyle": ""}
    water, ring = {"color": WATER, "linewidth": 1.2}, {"color": RING, "linewidth": 1.2}
    for name, options, titles, window, marks in (
            ("survey", (None, bounded), ("before", "--outline, --holes"), (0, 1200, 0, 800),
             {"points": point, "breaklines": water, "outline and hole": ring}),
            ("river", (plain, lines), ("without breaklines", "--constraints"), (380, 680, 330, 570),
             {"banks of the river, as breaklines; the terrain is lit from the north-west": water})):
        figure, both = plt.subplots(1, 2, figsize=(9, 3.8))
        for axes, title, chosen in zip(both, titles, options):
            if chosen is None:
                plan = survey - origin
                axes.scatter(*plan[:, :2].T, s=1.2, c=INK, linewidths=0)
                draw_lines(axes, rings, origin, colors=RING, linewidths=1.2)
            else:
                draw_relief(axes, run(command, folder, "survey.csv", chosen), origin)
            if chosen is not plain:
                draw_lines(axes, river, origin, colors=WATER, linewidths=0.8)
            axes.set(xlim=window[:2], ylim=window[2:], aspect="equal")
            axes.set_title(title, color=INK)
            axes.axis("off")
        figure.subplots_adjust(0.01, 0.1, 0.99, 0.91, wspace=0.04)
        add_legend(figure, (0.5, 0.0), marks)
        save(figure, os.path.join(output, f"guide_{name}.png"))


def list_contours(mesh, step):
    """Contour lines of a mesh, by vtkContourFilter: segments of x, y."""
    points, triangles, _ = mesh
    surface, contours, heights = vtkPolyData(), vtkContourFilter(), numpy_to_vtk(points[:, 2].copy())
    surface.SetPoints(vtkPoints())
    surface.GetPoints().SetData(numpy_to_vtk(points))
    surface.SetPolys(vtkCellArray())
    surface.GetPolys().SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel().astype(np.int64)))
    surface.GetPointData().SetScalars(heights)
    contours.SetInputData(surface)
    low, high = (int(way(points[triangles, 2].ravel())) // step for way in (min, max))
    for number, level in enumerate(range(low + 1, high + 1)):
        contours.SetValue(number, step * level)
    contours.Update()
    lines = contours.GetOutput()
    ids = vtk_to_numpy(lines.GetLines().GetConnectivityArray()).reshape(-1, 2)
    return list(vtk_to_numpy(lines.GetPoints().GetData())[ids][:, :, :2])


def draw_dem(command, folder, output):
    """guide_dem.png: the survey as a raster, under the sun, and its contours."""
    chosen = ["--from-points", "--constraints", "river.vtk", "--outline", "area.vtk", "--holes", "pond.vtk"]
    subprocess.run(
        [command, "survey.csv", "dem.vti", "--quiet", *chosen, "--raster", "2", "--raster-method", "natural"],
        cwd=folder, check=True)
    reader = vtkXMLImageDataReader()
    reader.SetFileName(os.path.join(folder, "dem.vti"))
    reader.Update()
    image, survey = reader.GetOutput(), run(command, folder, "survey.csv", chosen)
    columns, rows, _ = image.GetDimensions()
    heights = np.flipud(vtk_to_numpy(image.GetPointData().GetArray("z")).reshape(rows, columns))
    west, south = (image.GetOrigin()[axis] - image.GetSpacing()[axis] / 2 for axis in (0, 1))
    size = columns * image.GetSpacing()[0], rows * image.GetSpacing()[1]
    shade = LightSource(azdeg=315, altdeg=45).hillshade(
        heights, dx=image.GetSpacing()[0], dy=image.GetSpacing()[1])
    figure, both = plt.subplots(1, 2, figsize=(9, 3.5))
    for axes, title in zip(both, ("--raster 2 --raster-method natural", "contours every 5 m")):
        axes.imshow(np.where(np.isnan(heights), np.nan, shade), cmap="gray", vmin=0, vmax=1,
                    extent=(0, size[0], 0, size[1]))
        axes.set_title(title, color=INK)
        axes.axis("off")
    draw_lines(both[1], list_contours(survey, 5), np.array([west, south]), colors=RING, linewidths=0.6)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.91, wspace=0.04)
    save(figure, os.path.join(output, "guide_dem.png"))


def draw_edges(command, folder, output):
    """guide_edges.png: what sharp edges become without and with a maximum deviation."""
    chosen = {"before": "--max-iterations 0"}
    for options in ("--feature-angle 30", "--feature-angle 180",
                    "--feature-angle 180 --max-deviation 0.3%"):
        chosen[options] = options
    figure, grid = plt.subplots(2, 2, figsize=(9, 6.6))
    for axes, (title, options) in zip(grid.flat, chosen.items()):
        mesh = run(command, folder, "edges.ply", ["--quality", *options.split()])
        draw_mesh(axes, mesh, (0.3, -1.0, 1.2), (-0.8, 0.8, -1.35, -0.3))
        axes.set_title(title, color=INK)
    figure.subplots_adjust(0.01, 0.08, 0.99, 0.96, wspace=0.04, hspace=0.1)
    add_angle_legend(figure, 0.08)
    save(figure, os.path.join(output, "guide_edges.png"))


def draw_globe(command, folder, output):
    """guide_globe.png: stations joined on the sphere, and their Voronoi cells."""
    direction = np.array((0.4, -1.0, 0.35))
    points, triangles, _ = run(command, folder, "stations.csv", [
        "--from-points", "--projection", "sphere", "--degrees"])
    a, b, c = points[triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    centers = normals / areas[:, None]
    sides = np.sort([np.linalg.norm(u - v, axis=1) for u, v in ((a, b), (b, c), (c, a))], axis=0)
    angles = np.degrees(np.arcsin(areas / (sides[1] * sides[2])))
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.9))
    draw_mesh(left, (points, triangles, angles), direction, (-1.02, 1.02, -1.02, 1.02))
    left.set_title("triangles", color=INK)
    plan, _ = project(points, triangles, direction)
    corners, _ = project(centers, triangles[:0], direction)
    forward = direction / np.linalg.norm(direction)
    cells = []
    for station in np.flatnonzero(points @ forward > 0):
        own = corners[(triangles == station).any(axis=1)]
        turn = np.arctan2(*(own - plan[station]).T)
        cells.append(own[np.argsort(turn)])
    right.add_collection(PolyCollection(cells, facecolors="#f4f1ea", edgecolors=INK, linewidths=0.5))
    right.plot(*plan[points @ forward > 0].T, ".", color=WATER, markersize=2)
    right.set_xlim(left.get_xlim())
    right.set_ylim(left.get_ylim())
    right.set_aspect("equal")
    right.axis("off")
    right.set_title("Voronoi cells", color=INK)
    figure.subplots_adjust(0.01, 0.13, 0.99, 0.93, wspace=0.04)
    add_angle_legend(figure, 0.1)
    save(figure, os.path.join(output, "guide_globe.png"))


def draw_globe_values(folder, output):
    """guide_globe_values.png: temperatures between stations, linear and by natural neighbours."""
    stations = np.loadtxt(os.path.join(folder, "warmth.csv"), delimiter=",", skiprows=1)
    figure, both = plt.subplots(1, 2, figsize=(9, 2.9))
    for axes, method in zip(both, ("linear", "natural")):
        between = delaunayflip.SphereInterpolator(stations[:, :2], stations[:, 2], method)
        map_ = between.raster(origin=(-179.75, 89.75), step=(0.5, -0.5), shape=(360, 720))
        image = axes.imshow(map_, extent=(-180, 180, -90, 90), cmap="RdYlBu_r", vmin=-30, vmax=36)
        axes.plot(*stations[:, :2].T, ".", color=INK, markersize=0.8)
        axes.set_title({"linear": "linear", "natural": "natural neighbours"}[method], color=INK)
        axes.set_xticks((-180, -90, 0, 90, 180))
        axes.set_yticks((-90, 0, 90))
    figure.subplots_adjust(0.05, 0.16, 0.9, 0.94, wspace=0.14)
    figure.colorbar(image, cax=figure.add_axes((0.92, 0.2, 0.015, 0.68)), label="°C")
    save(figure, os.path.join(output, "guide_globe_values.png"))


def draw_coast(command, folder, output):
    """guide_coast.png: an ocean around two continents, seen from two sides."""
    arguments = ["--from-points", "--projection", "sphere", "--degrees", "--quality"]
    points, triangles, angles = run(command, folder, "stations.csv", [*arguments, "--holes", "land.vtk"])
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]))
    edges, counts = np.unique(sides, axis=0, return_counts=True)
    coast = edges[counts == 1]
    figure, both = plt.subplots(1, 2, figsize=(9, 4.9))
    for axes, direction, title in zip(both, ((1.0, -0.5, 0.4), (-1.0, 0.2, -0.2)),
                                      ("a continent", "another one, across 180 degrees")):
        draw_mesh(axes, (points, triangles, angles), direction, (-1.02, 1.02, -1.02, 1.02))
        plan, _ = project(points, triangles[:0], direction)
        shown = coast[(points[coast] @ np.array(direction) > 0).all(axis=1)]
        axes.add_collection(LineCollection(plan[shown], colors=WATER, linewidths=1.5))
        axes.set_title(title, color=INK)
    figure.subplots_adjust(0.01, 0.13, 0.99, 0.93, wspace=0.04)
    add_angle_legend(figure, 0.1)
    save(figure, os.path.join(output, "guide_coast.png"))


def draw_picture(name, command, folder, output):
    mesh, options, direction, window = PICTURES[name]
    figure, both = plt.subplots(1, 2, figsize=(9, 4.8))
    for axes, title, limit in zip(both, ("before", "after"), (["--max-iterations", "0"], [])):
        constrained = options if not limit else [o for o in options if "road" not in o
                                                 and o != "--constraints"]
        points, triangles, angles = run(command, folder, mesh, ["--quality", *constrained, *limit])
        origin = points.min(axis=0) if direction is None else 0
        draw_mesh(axes, (points - origin, triangles, angles), direction, window)
        axes.set_title(title, color=INK)
        if name == "road":
            draw_lines(axes, read_lines(folder, "road.vtk"), origin, colors="k", linewidths=2)
    figure.subplots_adjust(0.01, 0.14, 0.99, 0.93, wspace=0.04)
    add_angle_legend(figure, 0.1)
    if name == "road":
        add_legend(figure, (0.15, 0.06), {"road": {"color": "k", "linewidth": 2}})
    save(figure, os.path.join(output, f"guide_{name}.png"))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("output", nargs="?", default=f"{HERE}/../Documentation/images")
    parser.add_argument("--command", default=f"{HERE}/../build/bin/delaunay-flip")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["/usr/bin/python3", f"{HERE}/make_examples.py", folder], check=True)
        for name in PICTURES:
            draw_picture(name, os.path.abspath(arguments.command), folder, arguments.output)
        for draw in (draw_survey, draw_dem, draw_edges, draw_globe, draw_coast):
            draw(os.path.abspath(arguments.command), folder, arguments.output)
        draw_globe_values(folder, arguments.output)


if __name__ == "__main__":
    main()
