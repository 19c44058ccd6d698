#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: rivals.py list|scipy|triangle|startinpy|vtk|meshlib [OPTION...]

Other people's programs on the meshes of the experiments, in the form of delaunay-flip-paper's rows.
They come from packages in the virtual environment of reproduce_paper.sh; nothing in this project
links or ships them. `list` prints which are installed.
"""

import argparse
import importlib
import importlib.metadata
import json
import os
import subprocess
import tempfile
import time

import numpy

# Package, module and licence of each.
PACKAGES = {
    "scipy": ("scipy", "scipy.spatial", "BSD-3-Clause; with Qhull's own licence"),
    "triangle": ("triangle", "triangle", "LGPL-3.0 wrapper; Triangle itself: no commercial use"),
    "startinpy": ("startinpy", "startinpy", "MIT"),
    "delaunator": ("delaunator", "delaunator", "GPL, as its package says"),
    "vtk": ("vtk", "vtkmodules.vtkFiltersCore", "BSD-3-Clause"),
    "meshlib": ("meshlib", "meshlib.mrmeshpy", "MeshLib's own"),
}


def list_packages():
    """{"scipy": {"version": ..., "licence": ...}, "delaunator": {"absent": ...}}"""
    listing = {}
    for name, (package, module, licence) in PACKAGES.items():
        try:
            importlib.import_module(module)
            version = importlib.metadata.version(package)
            listing[name] = {"version": version, "licence": licence}
        except (ImportError, OSError) as error:
            listing[name] = {"absent": str(error), "licence": licence}
    return listing


def run_scipy(points):
    from scipy.spatial import Delaunay

    return time_call(lambda: Delaunay(points).simplices)


def run_triangle(points):
    from triangle import triangulate

    return time_call(lambda: triangulate({"vertices": points})["triangles"])


def run_startinpy(points):
    import startinpy

    def build():
        triangulation = startinpy.DT()
        triangulation.snap_tolerance = 1e-12
        triangulation.insert(in_space)
        return triangulation

    in_space = numpy.column_stack((points, numpy.zeros(len(points))))
    milliseconds, triangulation = time_call(build)
    return milliseconds, numpy.asarray(triangulation.triangles) - 1  # 0 is at infinity


def run_vtk(points):
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkDelaunay2D

    in_space = numpy.column_stack((points, numpy.zeros(len(points))))
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(in_space, deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(vtk_points)

    def build():
        delaunay = vtkDelaunay2D()
        delaunay.SetInputData(mesh)
        delaunay.SetTolerance(0.0)
        delaunay.Update()
        return delaunay.GetOutput()

    milliseconds, output = time_call(build)
    return milliseconds, vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)


FROM_POINTS = {
    "scipy": run_scipy,
    "triangle": run_triangle,
    "startinpy": run_startinpy,
    "vtk": run_vtk,
}


def time_call(call):
    start = time.perf_counter()
    result = call()
    return 1e3 * (time.perf_counter() - start), result


def repeat(arguments, run):
    """The spread of the times of run(), and its last result."""
    times, result = [], None
    start = time.monotonic()
    while not times or (
        not arguments.no_times
        and len(times) < arguments.repetitions
        and time.monotonic() - start < arguments.seconds
    ):
        milliseconds, result = run()
        times.append(milliseconds)
    spread = {
        "median": float(numpy.median(times)),
        "smallest": min(times),
        "largest": max(times),
        "runs": len(times),
    }
    return spread, result


def run_from_points(arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "points")
        command = [arguments.program, "points", "--points", str(arguments.points), "--output"]
        subprocess.run([*command, path], check=True)
        points = numpy.fromfile(path, numpy.float32).reshape(-1, 2).astype(numpy.float64)
        spread, triangles = repeat(arguments, lambda: FROM_POINTS[arguments.what](points))
        row = {
            "program": arguments.what,
            "points": len(points),
            "triangles": len(triangles),
            "total_ms": spread,
        }
        numpy.ascontiguousarray(triangles, numpy.int32).tofile(path)
        command = [arguments.program, "compare", "--points", str(arguments.points), "--file"]
        compared = subprocess.run([*command, path], check=True, capture_output=True, text=True)
        row.update({name: value for name, value in json.loads(compared.stdout)["rows"][0].items()
                    if name in ("different", "percent", "bad_left")})
        return row


def run_meshlib(arguments):
    """MeshLib's flips of a surface, with its default limits but no limit on passes."""
    import surfaces
    from meshlib import mrmeshnumpy, mrmeshpy

    points, triangles = surfaces.read(arguments.mesh)
    settings = mrmeshpy.DeloneSettings()

    def run():
        mesh = mrmeshnumpy.meshFromFacesVerts(triangles, points)
        return time_call(lambda: mrmeshpy.makeDeloneEdgeFlips(mesh, settings, 100))

    spread, flips = repeat(arguments, run)
    name = os.path.splitext(os.path.basename(arguments.mesh))[0]
    return {"program": "meshlib", "mesh": name, "points": len(points),
            "triangles": len(triangles), "flips": flips, "flips_ms": spread}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["list", *FROM_POINTS, "meshlib"])
    parser.add_argument("--points", type=int, default=1000)
    parser.add_argument("--mesh", help="a .dfmesh file")
    parser.add_argument("--program", help="delaunay-flip-paper")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=20.0, help="after which none is begun")
    parser.add_argument("--no-times", action="store_true")
    parser.add_argument("--output", required=True)
    arguments = parser.parse_args()
    if arguments.what == "list":
        result = list_packages()
    else:
        run = run_meshlib if arguments.what == "meshlib" else run_from_points
        row = run(arguments)
        if arguments.no_times:
            row = {name: value for name, value in row.items() if not name.endswith("_ms")}
        result = {"rows": [row]}
    with open(arguments.output, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)


if __name__ == "__main__":
    main()
