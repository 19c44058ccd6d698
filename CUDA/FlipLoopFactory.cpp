// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipLoopFactory.h"

#include "FlipRules.h"
#include "PlanarSurvey.h"
#include "SurfaceAngles.h"

#include <cmath>
#include <utility>

namespace delaunayflip
{

namespace
{
class Factory
{
public:
  Factory(const FlipLoopInput& input, EdgeMesh& mesh, EdgeTable table, const ThreadBackend& backend)
    : Input(input),
      Mesh(mesh),
      Table(std::move(table)),
      Backend(backend)
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
    const MeshSurvey& survey = this->Input.Survey;
    const PointArray& points = this->Input.Points;
    const PlaneProjection& plane = survey.Projection;
    const bool byAngles = this->Input.Options.Criterion == CriterionKind::OppositeAngles;
    const int components = byAngles || plane.Tilted ? 3 : 2;
    this->Result.Points = PackPoints(points, this->Input.Order,
      { { plane.AxisU, plane.AxisV, plane.AxisW }, components, points.Floats && components == 2,
        byAngles ? survey.Scale : 1.0 },
      this->Backend);
    if (byAngles && survey.Geometry == GeometryKind::PlanarXY)
    {
      this->DropHeights();
    }
    this->SetPlanarRule(byAngles);
  }

  void SetPlanarRule(bool byAngles)
  {
    const MeshSurvey& survey = this->Input.Survey;
    const EdgeCounts& edges = this->Input.Counts.Edges;
    const bool brokenFans =
      edges.NonManifold > 0 || edges.WronglyWound > 0 || survey.NonFinitePoints.Count > 0;
    const PlanarSurvey plane =
      SurveyPlane(this->Mesh, this->Result.Points, brokenFans, this->Backend);
    this->Result.Defects = { plane.ZeroAreaTriangles, plane.InvertedTriangles };
    EdgeGuard guard = plane.StarsAreSimple ? EdgeGuard() : this->MakeGuard();
    const double* doubles = this->Result.Points.Doubles.Data();
    const bool canonical = this->Input.Options.TieRule == TieRuleKind::Canonical;
    if (byAngles)
    {
      this->SetLoop(PlanarAngleRule{ { doubles, this->GetTolerance() } }, 1.0, std::move(guard));
    }
    else if (survey.Projection.Tilted)
    {
      this->SetLoop(
        PlanarRule<double, 3>{ doubles, plane.UniformSide, canonical, survey.FiltersApply },
        survey.Scale, std::move(guard));
    }
    else if (this->Result.Points.IsFloat())
    {
      this->SetLoop(PlanarRule<float, 2>{ this->Result.Points.Floats.Data(), plane.UniformSide,
                      canonical, survey.FiltersApply },
        survey.Scale, std::move(guard));
    }
    else
    {
      this->SetLoop(
        PlanarRule<double, 2>{ doubles, plane.UniformSide, canonical, survey.FiltersApply },
        survey.Scale, std::move(guard));
    }
  }

  void MakeSurfaceLoop()
  {
    const MeshSurvey& survey = this->Input.Survey;
    const PointArray& points = this->Input.Points;
    this->Result.Points = PackPoints(points, this->Input.Order,
      { { 0, 1, 2 }, 3, points.Floats != nullptr, survey.Scale }, this->Backend);
    this->Result.Defects = { FindZeroAreaTriangles(
      this->Mesh, this->Result.Points, this->Backend) };
    EdgeGuard guard = this->MakeGuard();
    if (this->Result.Points.IsFloat())
    {
      this->SetLoop(
        SurfaceRule<float>{ { this->Result.Points.Floats.Data(), this->GetTolerance() } }, 1.0,
        std::move(guard));
    }
    else
    {
      this->SetLoop(
        SurfaceRule<double>{ { this->Result.Points.Doubles.Data(), this->GetTolerance() } }, 1.0,
        std::move(guard));
    }
  }

  EdgeGuard MakeGuard()
  {
    return EdgeGuard(
      std::move(this->Table), this->Input.Counts.Edges.Edges, this->Input.Counts.Points);
  }

  /// Terrain: angles are those of the projection.
  void DropHeights()
  {
    for (std::int64_t v = 0; v < this->Result.Points.Count; ++v)
    {
      this->Result.Points.Doubles[3 * v + 2] = 0.0;
    }
  }

  AngleTolerance GetTolerance() const
  {
    return { std::sin(this->Input.Options.Tolerance), std::cos(this->Input.Options.Tolerance) };
  }

  template <typename Rule>
  void SetLoop(const Rule& rule, double scale, EdgeGuard guard)
  {
    this->Result.Loop.reset(
      new ThreadFlipLoop<Rule>(this->Mesh, rule, scale, std::move(guard), this->Backend));
  }

  const FlipLoopInput& Input;
  EdgeMesh& Mesh;
  EdgeTable Table;
  const ThreadBackend& Backend;
  FlipLoopResult Result;
};
}

FlipLoopResult MakeFlipLoop(
  const FlipLoopInput& input, EdgeMesh& mesh, EdgeTable table, const ThreadBackend& backend)
{
  return Factory(input, mesh, std::move(table), backend).Make();
}

}
