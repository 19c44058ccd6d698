#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation's guides: the meshes of make_examples.py before and after
delaunay-flip, coloured by the smallest angle of each triangle."""
import argparse
import os
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from draw_demo import ANGLES, INK, save
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

HERE = os.path.dirname(os.path.abspath(__file__))

#: picture: (mesh, options, the direction to look from or None for the x, y plane, a part of it)
PICTURES = {
    "scan": ("scan.ply", ["--feature-angle", "180"], (0.3, -1.0, 1.2), (-0.8, 0.8, -1.35, 0.1)),
    "part": ("part.stl", [], (0.5, -1.0, 1.1), None),
    "plate": ("plate.vtk", ["--region-array", "Material"], None, (0.3, 0.75, 0.05, 0.5)),
    "road": ("terrain.vtp", ["--geometry", "planar-xy", "--constraints", "road.vtk"], None,
             (3000, 6000, 2600, 4600)),
}


def flip(command, folder, mesh, options):
    """Points, triangles and the smallest angle of each, after flips."""
    output = os.path.join(folder, "out.vtp")
    subprocess.run([command, mesh, output, "--quality", "--quiet", *options], cwd=folder,
                   stderr=subprocess.DEVNULL, check=False)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(output)
    reader.Update()
    mesh = reader.GetOutput()
    return (vtk_to_numpy(mesh.GetPoints().GetData()).astype(float),
            vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3),
            vtk_to_numpy(mesh.GetCellData().GetArray("Smallest angle after (degrees)")))


def read_road(folder):
    with open(os.path.join(folder, "road.vtk"), encoding="utf-8") as file:
        lines = file.read().split("double\n")[1].split("LINES")[0].splitlines()
    return np.array([line.split() for line in lines], dtype=float)


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


def draw_picture(name, command, folder, output):
    mesh, options, direction, window = PICTURES[name]
    figure, both = plt.subplots(1, 2, figsize=(9, 4.2))
    for axes, title, limit in zip(both, ("before", "after"), (["--max-iterations", "0"], [])):
        constrained = options if not limit else [o for o in options if "road" not in o
                                                 and o != "--constraints"]
        points, triangles, angles = flip(command, folder, mesh, constrained + limit)
        origin = points.min(axis=0) if direction is None else 0
        draw_mesh(axes, (points - origin, triangles, angles), direction, window)
        axes.set_title(title, color=INK)
        if name == "road":
            axes.add_collection(LineCollection([(read_road(folder) - origin)[:, :2]], colors="k",
                                               linewidths=2))
    figure.subplots_adjust(0.01, 0.02, 0.99, 0.92, wspace=0.04)
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


if __name__ == "__main__":
    main()
