// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveTestSupport_h
#define LiveTestSupport_h

#include "FilterTestSupport.h"

/// Helpers for the tests of live updates.

/// A random bad mesh of 400 points, and a closed surface with bad triangles.
vtkSmartPointer<vtkPolyData> MakeBadPlane();
vtkSmartPointer<vtkPolyData> MakeBadSphere();

/// The polygons after a single update, without LiveUpdate.
Cells FlipAtOnce(vtkPolyData* mesh, double featureAngle = 30.0);

/// A filter with LiveUpdate on.
class LiveFilter : public WatchedFilter
{
public:
  explicit LiveFilter(vtkPolyData* input);

  /// Updates until nothing is left to do. @returns the number of updates.
  int RunToTheEnd();

  Cells GetTriangles();
};

/// Moves the points in place by a shear, which makes other edges bad.
void Shear(vtkPolyData* mesh, double factor);

#endif
