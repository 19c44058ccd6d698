# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The surfaces of Fig. 10 and their stand-ins, as .dfmesh files (Testing/Meshes/MeshFile.h) in
OUTPUT/meshes."""

import glob
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SUFFIXES = (".ply", ".stl", ".vtk")
DECIMATED_SHARE = 0.9  # of the noisy torus's triangles, which are removed


def prepare(arguments, points):
    """Makes the files that do not exist. @returns the names of all, the generated ones first."""
    folder = os.path.join(arguments.output, "meshes")
    os.makedirs(folder, exist_ok=True)
    for name in ("torus", "noisy-torus"):
        path = os.path.join(folder, name + ".dfmesh")
        if not os.path.isfile(path):
            command = [arguments.program, name, "--points", str(points), "--output", path]
            subprocess.run(command, check=True)
    python = find_python(arguments)
    if python:
        command = [python, os.path.abspath(__file__), folder, arguments.meshes or ""]
        subprocess.run(command, check=True)
    elif arguments.meshes:
        print("no Python with VTK and numpy: the meshes of --meshes cannot be read")
    generated = ["torus", "noisy-torus", "decimated-torus"]
    names = sorted(os.path.basename(path)[: -len(".dfmesh")]
                   for path in glob.glob(os.path.join(folder, "*.dfmesh")))
    return [name for name in generated if name in names] + [
        name for name in names if name not in generated]


def find_python(arguments):
    """A Python that has VTK and numpy."""
    for python in (arguments.rivals, sys.executable, "/usr/bin/python3"):
        test = [python, "-c", "import numpy, vtkmodules.vtkIOGeometry, vtkmodules.vtkFiltersCore"]
        if python and subprocess.run(test, capture_output=True, check=False).returncode == 0:
            return python
    return None


def convert_all(folder, source):
    """Runs in a Python that has VTK."""
    sys.path[:0] = [HERE, os.path.join(HERE, "../../Testing/Gpu")]
    import export_meshes
    import numpy

    decimated = os.path.join(folder, "decimated-torus.dfmesh")
    if not os.path.isfile(decimated):
        points, triangles = decimate(*read(os.path.join(folder, "noisy-torus.dfmesh")))
        export_meshes.write(decimated, points, triangles, numpy.empty((0, 2)))
    for path in sorted(glob.glob(os.path.join(source, "*.*"))) if source else []:
        name, suffix = os.path.splitext(os.path.basename(path))
        target = os.path.join(folder, name + ".dfmesh")
        if suffix.lower() in SUFFIXES and not os.path.isfile(target):
            export_meshes.write(target, *export_meshes.convert(path))


def read(path):
    """Points and triangles of a .dfmesh file in single precision."""
    import numpy

    with open(path, "rb") as file:
        file.seek(8)
        size, points, triangles, _, _ = numpy.fromfile(file, "<i8", 5)
        kind = "<f4" if size == 4 else "<f8"
        coordinates = numpy.fromfile(file, kind, 3 * points).reshape(-1, 3)
        return coordinates, numpy.fromfile(file, "<i4", 3 * triangles).reshape(-1, 3)


def decimate(points, triangles):
    """A surface reduced by vtkQuadricDecimation."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkQuadricDecimation

    mesh = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    mesh.SetPoints(vtk_points)
    cells = vtkCellArray()
    for triangle in triangles.tolist():
        cells.InsertNextCell(3, triangle)
    mesh.SetPolys(cells)
    decimation = vtkQuadricDecimation()
    decimation.SetInputData(mesh)
    decimation.SetTargetReduction(DECIMATED_SHARE)
    decimation.Update()
    result = decimation.GetOutput()
    ids = vtk_to_numpy(result.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(result.GetPoints().GetData()).astype("<f4"), ids.astype(numpy.int64)


if __name__ == "__main__":
    convert_all(*sys.argv[1:3])
