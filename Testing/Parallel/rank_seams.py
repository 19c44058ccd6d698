# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The cases of real meshes and of seams where meshes are not simple."""
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkPolyDataReader

import rank_meshes
from rank_runs import (
    RANK, RANKS, compare, describe, flip_alone, flip_piece, same)

READERS = {".vtk": vtkPolyDataReader, ".obj": vtkOBJReader, ".stl": vtkSTLReader}


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


def run_book(side, kind):
    """Each sheet on a rank of its own ("sheets"), or all of them on several: the edges where they
    meet stay, and are counted."""
    points, triangles = rank_meshes.make_book(side)
    options = {"Geometry": 3, "FeatureAngle": 180.0}
    owners = rank_meshes.divide(points, triangles, RANKS, kind)
    if kind == "sheets":
        owners = np.arange(len(triangles)) * RANKS // len(triangles)
    piece = rank_meshes.make_piece(points, triangles, np.flatnonzero(owners == RANK), True)
    return compare(points, triangles, piece, options, False)


def run_overlap(count, kind):
    """Two flat sheets over the same points. No flip may make an edge that the other sheet has, on
    whatever rank."""
    points, below = rank_meshes.make_random(count)
    above = rank_meshes.read_triangles(
        flip_alone(points, below, {"MaximumIterations": 2}).GetOutput())
    triangles = np.concatenate([below, above])
    owners = rank_meshes.divide(points, triangles, RANKS, kind)
    piece = rank_meshes.make_piece(points, triangles, np.flatnonzero(owners == RANK), True)
    return compare(points, triangles, piece, {"Geometry": 1}, False)


def run_twins(ids):
    """Every rank has the same closed surface. Without ids, nothing says that the points are the same."""
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(12)
    sphere.SetPhiResolution(10)
    sphere.Update()
    points = vtk_to_numpy(sphere.GetOutput().GetPoints().GetData()).astype(float)
    points *= np.random.default_rng(4).uniform(0.7, 1.3, (len(points), 1))
    triangles = rank_meshes.read_triangles(sphere.GetOutput())
    options = {"Geometry": 3, "FeatureAngle": 180.0}
    piece = rank_meshes.make_piece(points, triangles, np.arange(len(triangles)), ids)
    flip, said = flip_piece(piece, options)
    facts = describe(flip, said)
    facts["flips alone"] = flip_alone(points, triangles, options).GetTotalFlips()
    return facts, said


def run_slit(ids):
    """Two points of rank 0 are at the same place, at the two sides of a slit; rank 1 has one of them."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0, 0, 0], [0.5, -1, 0], [-1, 1, 0.0]])
    slots = np.array([2] if RANK == 1 else [0, 1])
    triangles = np.array([[0, 1, 2], [3, 4, 1], [0, 2, 5]])
    flip, said = flip_piece(rank_meshes.make_piece(points, triangles, slots, ids), {})
    return describe(flip, said), said
