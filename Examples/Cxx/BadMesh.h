// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BadMesh_h
#define BadMesh_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// A square of 612 triangles, most of them slivers.
vtkSmartPointer<vtkPolyData> MakeBadMesh();

#endif
