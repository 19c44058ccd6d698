// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateRequests_h
#define UpdateRequests_h

#include "EngineExport.h"
#include "PolyDataBridge.h"
#include "UpdateRun.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkAbstractTransform;
class vtkPoints;

/// @file
/// What updates ask for. FlipRun.cxx and TriangulationRun.cxx do it.

namespace delaunayflip
{

/// What an update of a vtkDelaunayFlip asks for. The second input has the constraints.
struct DELAUNAYFLIP_EXPORT FlipRequest : UpdateRequest
{
  bool HasWork() const override;

  /// If only points have been moved since the last update, the new run is a warm start: it begins
  /// with the triangles of the last run and the edges that were fixed in it. Other new runs begin
  /// with the triangles of the input.
  bool ContinueOrStart(std::unique_ptr<UpdateRun>& run) const override;

  BridgeSettings Settings;
  FlipOptions Options;
  bool WantsFlipCounts = false; ///< The output gets a cell array of flip counts.
  bool WantsAngles = false; ///< The output gets cell arrays of smallest angles.
};

/// The heights of points that only segments have.
enum class HeightsKind
{
  Auto, ///< Survey for lines, outlines or holes with z = 0 throughout, if other points have others.
  Survey, ///< Those of the given points there.
  Own
};

/// What an update of a vtkDelaunayFlipPoints asks for. The first input has the points, their data,
/// and the lines that are segments. The second input has more segments.
struct TriangulationRequest : UpdateRequest
{
  bool HasWork() const override;

  /// If the last run was kept, and the points of this request are as many, with segments between
  /// the same ones, their triangulation follows them to their places, and the run goes on with it.
  bool ContinueOrStart(std::unique_ptr<UpdateRun>& run) const override;

  bool IsRefined() const;

  /// Whether the points and the segments between them alone decide about the triangles. Only then
  /// KeepsRun is allowed.
  bool IsPlain() const;

  vtkMTimeType InputTime = 0; ///< When the dataset with the points was modified.
  vtkMTimeType OthersTime = 0; ///< When the second input was modified.
  vtkAbstractTransform* Transform = nullptr; ///< May be null.
  vtkMTimeType TransformTime = 0; ///< When it was modified.
  bool FitsPlane = false; ///< Points are projected to the plane that fits them best.
  bool LinesAsSegments = false;
  bool ClosedLinesAsRings = true;
  bool PassesSegments = false; ///< The output has the edges along segments, as lines.
  vtkIdType FirstHole = -1;
  HeightsKind Heights = HeightsKind::Auto; ///< In a projection Auto is Own.
  bool WantsHeights = true; ///< Else nobody has to be told of points without heights.
  /// Point data become doubles, so that those which points of the second input get are not rounded.
  bool ConvertsToDoubles = false;
  /// A point array of heights. Those of points of the second input that are not finite are
  /// replaced by those of the first one there; "": none.
  std::string HeightArray;
  std::string SizeArray; ///< A point array of longest edges; "": none.
  std::vector<std::array<double, 4>> Regions; ///< x, y, label and largest area of each.
  PointOptions Options;
};

/// The projection in which these points are triangulated; null: that to x and y.
/// @param count how many of the points count.
vtkSmartPointer<vtkAbstractTransform> FindProjection(
  const TriangulationRequest& request, vtkPoints* points, vtkIdType count);

}

#endif
