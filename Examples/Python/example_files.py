# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The files that live_flip.py reads and writes."""
import argparse

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

RIM, SPLITS = 3, 300


def make_bad_mesh():
    """A fan in a square, each of its triangles split into three again and again: slivers."""
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


def read_arguments(description):
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="?", help=".vtp file (default: a bad mesh made here)")
    parser.add_argument("--frames", metavar="PREFIX", help="write frames instead of showing them")
    return parser.parse_args()


def read_mesh(file):
    """The mesh of a file; for None a square of 612 triangles, most of them slivers."""
    if not file:
        return make_bad_mesh()
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def write_frames(view, window, prefix):
    """Runs the view to its end, off screen; writes every step and the last mesh."""
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(360, 360)
    view.SetFramePrefix(prefix)
    while view.Step():
        pass
    flip = view.GetFilter()
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetInputConnection(flip.GetOutputPort())
    writer.SetFileName(prefix + ".vtp")
    writer.Write()
    print(view.GetFrameNumber(), "steps,", flip.GetTotalFlips(), "flips")
    return 0 if writer.GetErrorCode() == 0 and view.GetConverged() else 1
