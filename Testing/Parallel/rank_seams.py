# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The cases of real meshes and of points that coincide."""
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOLegacy import vtkPolyDataReader

import rank_meshes
from rank_runs import RANK, describe, flip_piece, same

READERS = {".vtk": vtkPolyDataReader, ".obj": vtkOBJReader}


def read_mesh(name):
    path = os.path.join(os.environ["DELAUNAYFLIP_DATA_DIR"], name)
    reader = READERS[os.path.splitext(name)[1]]()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    return points, rank_meshes.read_triangles(mesh)


def run_real(name, kind, options, unique=True):
    points, triangles = read_mesh(name)
    return same(points, triangles, kind, True, options, unique)


def run_slit(ids):
    """Two points of rank 0 are at the same place, at the two sides of a slit; rank 1 has one of them."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0, 0, 0], [0.5, -1, 0], [-1, 1, 0.0]])
    slots = np.array([2] if RANK == 1 else [0, 1])
    triangles = np.array([[0, 1, 2], [3, 4, 1], [0, 2, 5]])
    flip, said = flip_piece(rank_meshes.make_piece(points, triangles, slots, ids), {})
    return describe(flip, said), said
