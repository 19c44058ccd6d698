#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: rivals.py list|scipy|triangle|startinpy|vtk|meshlib [SETTINGS]

Other people's programs on the meshes of the experiments, with the settings and rows of
delaunay-flip-paper. They come from packages in the virtual environment of reproduce_paper.sh;
nothing in this project links or ships them. `list` prints which are installed.
"""

import importlib
import importlib.metadata
import json
import os
import subprocess
import sys
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


def repeat(settings, call):
    """A list of times of call(), and its last result."""
    times, result = [], None
    start = time.monotonic()
    while not times or (len(times) < settings["Repetitions"]
                        and time.monotonic() - start < settings["Seconds"]):
        milliseconds, result = call()
        times.append(milliseconds)
    return times, result


def run_from_points(what, settings):
    def ask(experiment, **more):
        text = json.dumps({"Points": settings["Points"], **more})
        words = [settings["DelaunayFlip"], experiment, text]
        return subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout

    flat = numpy.frombuffer(ask("points"), numpy.float32).reshape(-1, 2).astype(numpy.float64)
    points = numpy.column_stack((flat, numpy.zeros(len(flat))))
    program = globals()["run_" + what]
    times, triangles = repeat(settings, lambda: program(points))
    with tempfile.NamedTemporaryFile() as file:
        file.write(numpy.ascontiguousarray(triangles, numpy.int32).tobytes())
        file.flush()
        compared = json.loads(ask("compare", Mesh=file.name))["rows"][0]
    return {"program": what, "points": len(points), "total_ms": times, **compared}


def run_meshlib(settings):
    """MeshLib's flips of a surface, with its default limits but no limit on passes."""
    from meshlib import mrmeshnumpy, mrmeshpy

    points, triangles = meshes.read(settings["Mesh"])
    limits = mrmeshpy.DeloneSettings()

    def run():
        mesh = mrmeshnumpy.meshFromFacesVerts(triangles, points)
        return time_call(lambda: mrmeshpy.makeDeloneEdgeFlips(mesh, limits, 100))

    times, flips = repeat(settings, run)
    name = os.path.splitext(os.path.basename(settings["Mesh"]))[0]
    return {"program": "meshlib", "mesh": name, "points": len(points),
            "triangles": len(triangles), "flips": flips, "flips_ms": times}


def main():
    what = sys.argv[1]
    if what == "list":
        print(json.dumps(list_packages()))
        return
    settings = json.loads(sys.argv[2])
    row = run_meshlib(settings) if what == "meshlib" else run_from_points(what, settings)
    if not settings["Repetitions"]:
        row = {name: value for name, value in row.items() if not name.endswith("_ms")}
    print(json.dumps({"rows": [row]}))


if __name__ == "__main__":
    main()
