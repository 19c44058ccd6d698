// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BadMesh_h
#define BadMesh_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// A unit square of triangles, most of them slivers.
/// @param rim the number of points on each side. @param splits how often a triangle is split into
/// three.
vtkSmartPointer<vtkPolyData> MakeBadMesh(int rim = 3, int splits = 300);

#endif
