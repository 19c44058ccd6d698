# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The command line of live_flip.py, and the files that it reads and writes."""
import argparse
import multiprocessing
import os
import sys

from delaunayflip import vtkDelaunayFlip
from vtkmodules.vtkCommonCore import (
    vtkLogger, vtkOutputWindow, vtkPoints, vtkStringOutputWindow)
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

DONE, WRONG_USAGE, BAD_FILE = 0, 2, 3  # exit statuses, those of delaunay-flip

READERS = {".vtk": vtkPolyDataReader, ".vtp": vtkXMLPolyDataReader, ".ply": vtkPLYReader,
           ".stl": vtkSTLReader, ".obj": vtkOBJReader}

GEOMETRIES = {"auto": vtkDelaunayFlip.GEOMETRY_AUTO, "planar": vtkDelaunayFlip.GEOMETRY_PLANAR,
              "planar-xy": vtkDelaunayFlip.GEOMETRY_PLANAR_XY,
              "surface": vtkDelaunayFlip.GEOMETRY_SURFACE}

RIM, SPLITS = 3, 300


def make_bad_mesh():
    """A fan in a square, with its triangles split into three again and again: slivers."""
    points = [(0.44, 0.53)]
    for x, y, dx, dy in ((0, 0, 1, 0), (1, 0, 0, 1), (1, 1, -1, 0), (0, 1, 0, -1)):
        points += [(x + dx * i / RIM, y + dy * i / RIM) for i in range(RIM)]
    triangles = [(0, 1 + i, 1 + (i + 1) % (4 * RIM)) for i in range(4 * RIM)]
    for i in range(SPLITS):
        a, b, c = triangles[i]
        points.append([0.28 * points[a][k] + 0.33 * points[b][k] + 0.39 * points[c][k]
                       for k in range(2)])
        p = len(points) - 1
        triangles += [(a, b, p), (b, c, p), (c, a, p)]
    mesh = vtkPolyData()
    mesh.SetPoints(vtkPoints())
    for x, y in points:
        mesh.GetPoints().InsertNextPoint(x, y, 0)
    mesh.SetPolys(vtkCellArray())
    for triangle in triangles[SPLITS:]:
        mesh.GetPolys().InsertNextCell(3, triangle)
    return mesh


def get_extension(file):
    return os.path.splitext(file)[1].lower()


def read_arguments(description):
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Exit status: 0 done; 2 wrong usage; 3 a file cannot be read, written or used.")
    parser.add_argument(
        "mesh", nargs="?", metavar="MESH",
        help=f"file to read: {' '.join(READERS)} (default: a generated bad mesh)")
    parser.add_argument(
        "--geometry", choices=GEOMETRIES, default="auto",
        help="where edges are judged; planar-xy: by x and y, for terrain (default: auto)")
    parser.add_argument(
        "--frames", metavar="PREFIX", help="write frames instead of showing them in a window")
    arguments = parser.parse_args()
    if arguments.mesh and get_extension(arguments.mesh) not in READERS:
        parser.error(
            f"{arguments.mesh}: unknown file extension; known are {' '.join(READERS)}")
    return arguments


def fail(status, message):
    print("error:", message, file=sys.stderr)
    sys.exit(status)


def find_problems(reader):
    """Makes a reader of VTK read. Returns what was wrong, or ""."""
    # Some truncated files crash the reader, so a child process tries first.
    child = multiprocessing.get_context("fork").Process(target=reader.Update)
    child.start()
    child.join()
    if child.exitcode != 0:
        return "VTK's reader crashed; the file is probably truncated or corrupt"
    reader.Update()
    messages = vtkOutputWindow.GetInstance().GetOutput().splitlines()
    if messages:
        return messages[1].split("): ")[-1]  # the first line names a source file of VTK
    return "" if reader.GetOutput().GetNumberOfCells() else "no mesh in it"


def read_mesh(file):
    """The mesh in a file; for None, a square of 612 triangles, most of them slivers."""
    if not file:
        return make_bad_mesh()
    if not os.path.isfile(file) or not os.access(file, os.R_OK):
        fail(BAD_FILE, f"{file}: no such file, or no permission to read it")
    reader = READERS[get_extension(file)]()
    reader.SetFileName(file)
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    vtkOutputWindow.SetInstance(vtkStringOutputWindow())  # collects the messages
    problems = find_problems(reader)
    vtkOutputWindow.SetInstance(None)
    vtkLogger.SetStderrVerbosity(verbosity)
    if problems:
        fail(BAD_FILE, f"{file}: cannot be read: {problems}")
    return join_points(reader) if get_extension(file) == ".obj" else reader.GetOutput()


def join_points(reader):
    """Merges coincident points: vtkOBJReader repeats them for normals and texture coordinates."""
    clean = vtkCleanPolyData()
    clean.SetInputConnection(reader.GetOutputPort())
    clean.SetTolerance(0.0)
    clean.Update()
    return clean.GetOutput()


def write_frames(view, window, prefix):
    """Runs the view to the end, off screen; writes every step and the last mesh."""
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(360, 360)
    view.SetFramePrefix(prefix)
    while view.Step():
        pass
    flip = view.GetFilter()
    if not view.GetConverged():
        wrong_options = flip.GetFailure() == vtkDelaunayFlip.FAILURE_OPTIONS
        fail(WRONG_USAGE if wrong_options else BAD_FILE, flip.GetErrorMessage())
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetInputConnection(flip.GetOutputPort())
    writer.SetFileName(prefix + ".vtp")
    writer.Write()
    if writer.GetErrorCode() != 0:
        fail(BAD_FILE, f"{prefix}.vtp: cannot be written")
    print(view.GetFrameNumber(), "steps,", flip.GetTotalFlips(), "flips")
