// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchmarkPolyData_h
#define BenchmarkPolyData_h

#include "BenchmarkMesh.h"

#include "vtkSmartPointer.h"

class vtkPolyData;

namespace delaunayflip
{

/// The same mesh for VTK, with its constraint edges as lines.
vtkSmartPointer<vtkPolyData> ToPolyData(const BenchmarkMesh& mesh);

}

#endif
