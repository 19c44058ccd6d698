// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOPCHOICE_H
#define DELAUNAYFLIP_FLIPLOOPCHOICE_H

#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "FlipRules.h"
#include "MeshSurvey.h"
#include "PlanarSurvey.h"
#include "SpatialOrder.h"

#include <cmath>
#include <memory>
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
  std::vector<Defect> Defects; ///< Triangles without area or turned over.
};

template <typename Backend>
EdgeGuard MakeGuard(const FlipLoopInput& input, EdgeTable table, const Backend& backend)
{
  const bool isMissing = table.IsEmpty();
  EdgeGuard guard(std::move(table), input.Counts.Edges.Edges, input.Counts.Points, backend);
  if (isMissing)
  {
    guard.Rebuild(input.Mesh, backend);
  }
  guard.TakeSharedVertices(std::move(input.SharedVertices));
  return guard;
}

template <typename Backend, typename Rule>
std::unique_ptr<FlipLoop> MakeLoop(
  const FlipLoopInput& input, const Rule& rule, EdgeGuard guard, const Backend& backend)
{
  using Loop = typename LoopOf<Backend, Rule>::Type;
  return std::unique_ptr<FlipLoop>(
    new Loop(input.Mesh, rule, input.Survey.Range, std::move(guard), backend));
}

inline AngleTolerance GetTolerance(const FlipOptions& options, const MeshSurvey& survey)
{
  const double fixed = options.Tolerance;
  return fixed < 0.0 ? AngleTolerance{ 0.0, 1.0, survey.Precision }
                     : AngleTolerance{ std::sin(fixed), std::cos(fixed), 0.0 };
}

template <typename Real, int Components>
PlanarRule<Real, Components> MakeInCircleRule(
  const FlipLoopInput& input, const Real* coordinates, int uniformSide)
{
  const bool canonical = input.Options.TieRule == TieRuleKind::Canonical;
  return { coordinates, uniformSide, canonical, input.Survey.FiltersApply };
}

/// @param uniformSide the side to which all triangles turn, if they do (PlanarSurvey).
template <typename Backend>
std::unique_ptr<FlipLoop> MakePlanarLoop(
  const FlipLoopInput& input, int uniformSide, EdgeGuard guard, const Backend& backend)
{
  const double* doubles = input.Points.Doubles.Data();
  if (input.Options.Criterion == CriterionKind::OppositeAngles)
  {
    const AngleTolerance tolerance = GetTolerance(input.Options, input.Survey);
    return MakeLoop(input, PlanarAngleRule{ { doubles, tolerance, input.Survey.Range } },
      std::move(guard), backend);
  }
  if (input.Survey.Projection.Tilted)
  {
    return MakeLoop(
      input, MakeInCircleRule<double, 3>(input, doubles, uniformSide), std::move(guard), backend);
  }
  if (input.Points.IsFloat())
  {
    return MakeLoop(input,
      MakeInCircleRule<float, 2>(input, input.Points.Floats.Data(), uniformSide), std::move(guard),
      backend);
  }
  return MakeLoop(
    input, MakeInCircleRule<double, 2>(input, doubles, uniformSide), std::move(guard), backend);
}

template <typename Backend>
std::unique_ptr<FlipLoop> MakeSurfaceLoop(
  const FlipLoopInput& input, EdgeGuard guard, const Backend& backend)
{
  const AngleTolerance tolerance = GetTolerance(input.Options, input.Survey);
  const PackedPoints& points = input.Points;
  const CoordinateRange range = input.Survey.Range;
  return points.IsFloat()
    ? MakeLoop(input, SurfaceRule<float>{ { points.Floats.Data(), tolerance, range } },
        std::move(guard), backend)
    : MakeLoop(input, SurfaceRule<double>{ { points.Doubles.Data(), tolerance, range } },
        std::move(guard), backend);
}

/// Makes the loop that suits a mesh. The backend must live as long as the loop.
/// @param table the vertex pairs of all edges, or empty; kept if flips could make an edge that
/// exists.
template <typename Backend>
FlipLoopResult ChooseFlipLoop(const FlipLoopInput& input, EdgeTable table, const Backend& backend)
{
  const MeshSurvey& survey = input.Survey;
  if (survey.Geometry == GeometryKind::Surface)
  {
    const Defect flat = FindZeroAreaTriangles(input.Mesh, input.Points, backend);
    EdgeGuard guard = MakeGuard(input, std::move(table), backend);
    return { MakeSurfaceLoop(input, std::move(guard), backend), { flat } };
  }
  const EdgeCounts& edges = input.Counts.Edges;
  const bool brokenFans =
    edges.NonManifold > 0 || edges.WronglyWound > 0 || survey.NonFinitePoints.Count > 0;
  const bool areSimple = input.Whole.StarsAreSimple;
  const PlanarSurvey plane =
    SurveyPlane(input.Mesh, input.Points, brokenFans || areSimple, survey.UsedPoints, backend);
  EdgeGuard guard;
  if (!(plane.StarsAreSimple || areSimple) || input.SharedVertices.Size() > 0)
  {
    guard = MakeGuard(input, std::move(table), backend);
  }
  table = EdgeTable(); // frees its memory
  return { MakePlanarLoop(input, plane.UniformSide, std::move(guard), backend),
    { plane.ZeroAreaTriangles, plane.GetInverted(input.Whole.Side) } };
}

}

#endif
