// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOPCHOICE_H
#define DELAUNAYFLIP_FLIPLOOPCHOICE_H

#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "FlipRules.h"
#include "MeshSurvey.h"
#include "PlanarSurvey.h"
#include "SpatialOrder.h"

#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// Which rule judges a mesh, on which coordinates, and whether flips need a guard.

namespace delaunayflip
{

/// The coordinates by which a mesh is judged. For terrain judged by angles, those of the
/// projection.
/// @param asFloat whether the caller's coordinates are of type float.
inline PackingPlan PlanPacking(const MeshSurvey& survey, CriterionKind criterion, bool asFloat)
{
  if (survey.Geometry == GeometryKind::Surface)
  {
    return { { 0, 1, 2 }, 3, asFloat, false, false };
  }
  const PlaneProjection& plane = survey.Projection;
  const bool byAngles = criterion == CriterionKind::OppositeAngles;
  const int components = byAngles || plane.Tilted ? 3 : 2;
  return { { plane.AxisU, plane.AxisV, plane.AxisW }, components, asFloat && components == 2,
    byAngles && survey.Geometry == GeometryKind::PlanarXY,
    survey.Geometry == GeometryKind::Planar && survey.NonFinitePoints.Count > 0 };
}

struct FlipLoopInput
{
  const PackedPoints& Points; ///< Packed by PlanPacking. Must live as long as the loop.
  const MeshSurvey& Survey;
  const FlipOptions& Options;
  const FlipReport& Counts; ///< Has the counts of points and edges of the input.
  EdgeMesh& Mesh; ///< Must live as long as the loop.
  const WholeMesh& Whole;
  Array<unsigned char>& SharedVertices; ///< WholeMesh::SharedPoints, by vertex, or empty. Taken.
};

struct FlipLoopResult
{
  std::unique_ptr<FlipLoop> Loop;
  double SquaredCotangent; ///< FlipLoop::FindLargestSquaredCotangent.
  std::vector<Defect> Defects; ///< Triangles without area or turned over.
};

/// Which rule of FlipRules.h judges a mesh.
struct RuleChoice
{
  RuleChoice(const MeshSurvey& survey, const FlipOptions& options)
    : IsSurface(survey.Geometry == GeometryKind::Surface),
      ByAngles(options.Criterion == CriterionKind::OppositeAngles),
      IsTilted(survey.Projection.Tilted),
      IsCanonical(options.TieRule == TieRuleKind::Canonical),
      FiltersApply(survey.FiltersApply),
      Range(survey.Range),
      Tolerance(options.Tolerance < 0.0
          ? AngleTolerance{ 0.0, 1.0, survey.Precision }
          : AngleTolerance{ std::sin(options.Tolerance), std::cos(options.Tolerance), 0.0 }),
      MaximumDeviation(options.MaximumDeviation < 1e299 ? options.MaximumDeviation : INFINITY)
  {
  }

  /// Calls visit(rule) for packed coordinates (PlanPacking), of one type or the other.
  /// @param uniformSide the side to which all triangles turn, if they do (PlanarSurvey).
  template <typename Function>
  auto Visit(
    const float* floats, const double* doubles, int uniformSide, const Function& visit) const
  {
    if (this->IsSurface)
    {
      return floats ? visit(SurfaceRule<float>{
                        { floats, this->Tolerance, this->Range }, this->MaximumDeviation })
                    : visit(SurfaceRule<double>{
                        { doubles, this->Tolerance, this->Range }, this->MaximumDeviation });
    }
    if (this->ByAngles)
    {
      return visit(PlanarAngleRule{ { doubles, this->Tolerance, this->Range } });
    }
    if (this->IsTilted)
    {
      return visit(
        PlanarRule<double, 3>{ doubles, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    return floats
      ? visit(PlanarRule<float, 2>{ floats, uniformSide, this->IsCanonical, this->FiltersApply })
      : visit(PlanarRule<double, 2>{ doubles, uniformSide, this->IsCanonical, this->FiltersApply });
  }

  bool IsSurface, ByAngles, IsTilted, IsCanonical, FiltersApply;
  CoordinateRange Range;
  AngleTolerance Tolerance;
  double MaximumDeviation;
};

/// Makes the loop that suits a mesh. The backend must live as long as the loop.
template <typename Backend>
FlipLoopResult ChooseFlipLoop(const FlipLoopInput& input, const Backend& backend)
{
  const MeshSurvey& survey = input.Survey;
  FlipLoopResult result;
  bool needsGuard = true;
  int uniformSide = 0;
  if (survey.Geometry != GeometryKind::Surface)
  {
    const EdgeCounts& edges = input.Counts.Edges;
    const bool brokenFans =
      edges.NonManifold > 0 || edges.WronglyWound > 0 || survey.NonFinitePoints.Count > 0;
    const bool areSimple = input.Whole.StarsAreSimple;
    const PlanarSurvey plane =
      SurveyPlane(input.Mesh, input.Points, brokenFans || areSimple, survey.UsedPoints, backend);
    result.Defects = plane.ListDefects(input.Whole.Side);
    needsGuard = !(plane.StarsAreSimple || areSimple) || input.SharedVertices.Size() > 0;
    uniformSide = plane.UniformSide;
  }
  EdgeGuard guard;
  if (needsGuard)
  {
    guard = EdgeGuard(input.Mesh, input.Counts.Points, backend, std::move(input.SharedVertices));
  }
  const auto make = [&](const auto& rule)
  {
    using Loop = typename LoopOf<Backend, std::decay_t<decltype(rule)>>::Type;
    return std::unique_ptr<FlipLoop>(
      new Loop(input.Mesh, rule, survey.Range, std::move(guard), backend));
  };
  const bool isFloat = input.Points.IsFloat();
  result.Loop = RuleChoice(survey, input.Options)
                  .Visit(isFloat ? input.Points.Floats.Data() : nullptr,
                    input.Points.Doubles.Data(), uniformSide, make);
  result.SquaredCotangent = result.Loop->FindLargestSquaredCotangent();
  if (survey.Geometry == GeometryKind::Surface && result.SquaredCotangent == INFINITY)
  {
    result.Defects = { FindZeroAreaTriangles(input.Mesh, input.Points, backend) };
  }
  return result;
}

}

#endif
