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

import meshes

# Module and licence of each package.
PACKAGES = {
    "scipy": ("scipy.spatial", "BSD-3-Clause; with Qhull's own licence"),
    "triangle": ("triangle", "LGPL-3.0 wrapper; Triangle itself: no commercial use"),
    "startinpy": ("startinpy", "MIT"),
    "vtk": ("vtkmodules.vtkFiltersCore", "BSD-3-Clause"),
    "meshlib": ("meshlib.mrmeshpy", "MeshLib's own"),
}


def list_packages():
    """{"scipy": {"version": ..., "licence": ...}, "triangle": {"absent": ..., "licence": ...}}"""
    listing = {}
    for name, (module, licence) in PACKAGES.items():
        try:
            importlib.import_module(module)
            listing[name] = {"version": importlib.metadata.version(name), "licence": licence}
        except (ImportError, OSError) as error:
            listing[name] = {"absent": str(error), "licence": licence}
    return listing


def time_call(call):
    """Milliseconds, and the result."""
    start = time.perf_counter()
    result = call()
    return 1e3 * (time.perf_counter() - start), result


def run_scipy(points):
    from scipy.spatial import Delaunay

    return time_call(lambda: Delaunay(points[:, :2]).simplices)


def run_triangle(points):
    from triangle import triangulate

    return time_call(lambda: triangulate({"vertices": points[:, :2]})["triangles"])


def run_startinpy(points):
    import startinpy

    def build():
        triangulation = startinpy.DT()
        triangulation.snap_tolerance = 1e-12
        triangulation.insert(points)
        return triangulation

    milliseconds, triangulation = time_call(build)
    return milliseconds, numpy.asarray(triangulation.triangles) - 1  # 0 is at infinity


def run_vtk(points):
    from vtkmodules.vtkFiltersCore import vtkDelaunay2D

    delaunay = vtkDelaunay2D()
    delaunay.SetInputData(meshes.make_poly_data(points))
    delaunay.SetTolerance(0.0)
    milliseconds, _ = time_call(delaunay.Update)
    return milliseconds, meshes.read_poly_data(delaunay.GetOutput())[1]


def repeat(arguments, call):
    """A list of times of call(), and its last result."""
    times, result = [], None
    start = time.monotonic()
    while not times or (not arguments.no_times and len(times) < arguments.repetitions
                        and time.monotonic() - start < arguments.seconds):
        milliseconds, result = call()
        times.append(milliseconds)
    return times, result


def run_from_points(arguments):
    def ask(command, *more):
        words = [arguments.program, command, "--points", str(arguments.points), *more]
        return subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout

    flat = numpy.frombuffer(ask("points"), numpy.float32).reshape(-1, 2).astype(numpy.float64)
    points = numpy.column_stack((flat, numpy.zeros(len(flat))))
    program = globals()["run_" + arguments.what]
    times, triangles = repeat(arguments, lambda: program(points))
    with tempfile.NamedTemporaryFile() as file:
        file.write(numpy.ascontiguousarray(triangles, numpy.int32).tobytes())
        file.flush()
        compared = json.loads(ask("compare", "--mesh", file.name))["rows"][0]
    return {"program": arguments.what, "points": len(points), "total_ms": times, **compared}


def run_meshlib(arguments):
    """MeshLib's flips of a surface, with its default limits but no limit on passes."""
    from meshlib import mrmeshnumpy, mrmeshpy

    points, triangles = meshes.read(arguments.mesh)
    settings = mrmeshpy.DeloneSettings()

    def run():
        mesh = mrmeshnumpy.meshFromFacesVerts(triangles, points)
        return time_call(lambda: mrmeshpy.makeDeloneEdgeFlips(mesh, settings, 100))

    times, flips = repeat(arguments, run)
    name = os.path.splitext(os.path.basename(arguments.mesh))[0]
    return {"program": "meshlib", "mesh": name, "points": len(points),
            "triangles": len(triangles), "flips": flips, "flips_ms": times}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["list", *PACKAGES])
    parser.add_argument("--points", type=int, default=1000)
    parser.add_argument("--mesh", help="a .dfmesh file")
    parser.add_argument("--program", help="delaunay-flip-paper")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=20.0, help="after which none is begun")
    parser.add_argument("--no-times", action="store_true")
    arguments = parser.parse_args()
    if arguments.what == "list":
        print(json.dumps(list_packages()))
    else:
        row = (run_meshlib if arguments.what == "meshlib" else run_from_points)(arguments)
        if arguments.no_times:
            row = {name: value for name, value in row.items() if not name.endswith("_ms")}
        print(json.dumps({"rows": [row]}))


if __name__ == "__main__":
    main()
