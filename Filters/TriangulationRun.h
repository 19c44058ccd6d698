// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TriangulationRun_h
#define TriangulationRun_h

#include "UpdateRun.h"

#include <memory>

class vtkAbstractTransform;

namespace delaunayflip
{

/// What an update of a vtkDelaunayFlipPoints asks for. The first input has the points, their data,
/// and the lines that are segments. The second input has more segments.
struct TriangulationRequest : UpdateRequest
{
  bool HasWork() const override;
  bool ContinueOrStart(std::unique_ptr<UpdateRun>& run) const override;

  vtkMTimeType InputTime = 0; ///< When the dataset with the points was modified.
  vtkAbstractTransform* Transform = nullptr; ///< May be null.
  vtkMTimeType TransformTime = 0; ///< When it was modified.
  bool FitsPlane = false; ///< Points are projected to the plane that fits them best.
  bool LinesAsSegments = false;
  bool ClosedLinesAsRings = true;
  vtkIdType FirstHole = -1;
  PointOptions Options;
};

}

#endif
