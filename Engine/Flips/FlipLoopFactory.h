// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOPFACTORY_H
#define DELAUNAYFLIP_FLIPLOOPFACTORY_H

#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "FlipRules.h"
#include "MeshSurvey.h"
#include "PackedPoints.h"
#include "PlanarSurvey.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// Which rule judges a mesh, on which coordinates, and whether flips need a guard.

namespace delaunayflip
{

/// Which coordinates a mesh is judged by. Terrain by angles: those of the projection.
/// @param asFloat whether the caller's are of type float.
inline PackingPlan PlanPacking(const MeshSurvey& survey, CriterionKind criterion, bool asFloat)
{
  if (survey.Geometry == GeometryKind::Surface)
  {
    return { { 0, 1, 2 }, 3, asFloat, false, survey.Scale };
  }
  const PlaneProjection& plane = survey.Projection;
  const bool byAngles = criterion == CriterionKind::OppositeAngles;
  const int components = byAngles || plane.Tilted ? 3 : 2;
  return { { plane.AxisU, plane.AxisV, plane.AxisW }, components, asFloat && components == 2,
    byAngles && survey.Geometry == GeometryKind::PlanarXY, byAngles ? survey.Scale : 1.0 };
}

struct FlipLoopInput
{
  const PackedPoints& Points; ///< By PlanPacking. The loop reads them; must live as long.
  const MeshSurvey& Survey;
  const FlipOptions& Options;
  const FlipReport& Counts; ///< Of the input's points and edges.
};

struct FlipLoopResult
{
  std::unique_ptr<FlipLoop> Loop;
  std::vector<Defect> Defects; ///< Of triangles: without area, turned over.
};

/// Makes a loop. The mesh must live as long as the loop, as the backend must.
template <typename Backend>
class FlipLoopFactory
{
public:
  /// @param table the vertex pairs of all edges; kept where flips could make an edge that exists.
  FlipLoopFactory(
    const FlipLoopInput& input, EdgeMesh& mesh, EdgeTable table, const Backend& backend)
    : Input(input),
      Mesh(mesh),
      Table(std::move(table)),
      Engine(backend)
  {
  }

  FlipLoopResult Make()
  {
    if (this->Input.Survey.Geometry == GeometryKind::Surface)
    {
      this->MakeSurfaceLoop();
    }
    else
    {
      this->MakePlanarLoop();
    }
    return std::move(this->Result);
  }

private:
  void MakePlanarLoop()
  {
    const bool byAngles = this->Input.Options.Criterion == CriterionKind::OppositeAngles;
    const PackedPoints& points = this->Input.Points;
    const MeshSurvey& survey = this->Input.Survey;
    const EdgeCounts& edges = this->Input.Counts.Edges;
    const bool brokenFans =
      edges.NonManifold > 0 || edges.WronglyWound > 0 || survey.NonFinitePoints.Count > 0;
    const PlanarSurvey plane =
      SurveyPlane(this->Mesh, points, brokenFans, survey.UsedPoints, this->Engine);
    this->Result.Defects = { plane.ZeroAreaTriangles, plane.InvertedTriangles };
    this->Guard = plane.StarsAreSimple ? EdgeGuard() : this->MakeGuard();
    const double* doubles = points.Doubles.Data();
    if (byAngles)
    {
      this->SetLoop(PlanarAngleRule{ { doubles, this->GetTolerance() } }, 1.0);
    }
    else if (survey.Projection.Tilted)
    {
      this->SetInCircleRule<double, 3>(doubles, plane.UniformSide);
    }
    else if (points.IsFloat())
    {
      this->SetInCircleRule<float, 2>(points.Floats.Data(), plane.UniformSide);
    }
    else
    {
      this->SetInCircleRule<double, 2>(doubles, plane.UniformSide);
    }
  }

  template <typename Real, int Components>
  void SetInCircleRule(const Real* coordinates, int uniformSide)
  {
    const bool canonical = this->Input.Options.TieRule == TieRuleKind::Canonical;
    const MeshSurvey& survey = this->Input.Survey;
    this->SetLoop(
      PlanarRule<Real, Components>{ coordinates, uniformSide, canonical, survey.FiltersApply },
      survey.Scale);
  }

  void MakeSurfaceLoop()
  {
    const PackedPoints& points = this->Input.Points;
    this->Result.Defects = { FindZeroAreaTriangles(this->Mesh, points, this->Engine) };
    this->Guard = this->MakeGuard();
    if (points.IsFloat())
    {
      this->SetLoop(SurfaceRule<float>{ { points.Floats.Data(), this->GetTolerance() } }, 1.0);
    }
    else
    {
      this->SetLoop(SurfaceRule<double>{ { points.Doubles.Data(), this->GetTolerance() } }, 1.0);
    }
  }

  EdgeGuard MakeGuard()
  {
    const bool isMissing = this->Table.IsEmpty();
    EdgeGuard guard(std::move(this->Table), this->Input.Counts.Edges.Edges,
      this->Input.Counts.Points, this->Engine);
    if (isMissing)
    {
      guard.Rebuild(this->Mesh, this->Engine);
    }
    return guard;
  }

  AngleTolerance GetTolerance() const
  {
    return { std::sin(this->Input.Options.Tolerance), std::cos(this->Input.Options.Tolerance) };
  }

  template <typename Rule>
  void SetLoop(const Rule& rule, double scale)
  {
    this->Table = EdgeTable();
    this->Result.Loop.reset(new typename LoopOf<Backend, Rule>::Type(
      this->Mesh, rule, scale, std::move(this->Guard), this->Engine));
  }

  const FlipLoopInput& Input;
  EdgeMesh& Mesh;
  EdgeTable Table;
  const Backend& Engine;
  EdgeGuard Guard;
  FlipLoopResult Result;
};

}

#endif
