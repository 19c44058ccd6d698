// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "QuadJudge.h"

#include "FlipLoopChoice.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
/// What the engine knows of a mesh when it chooses a rule.
MeshSurvey DescribeMesh(const PieceSurvey& survey)
{
  MeshSurvey mesh;
  mesh.Geometry = survey.Geometry;
  mesh.Projection = survey.Projection;
  mesh.Precision = survey.IsFloat ? FloatPrecision : DoublePrecision;
  return mesh;
}

/// @param rule for the points 0 to 3.
template <typename Rule>
EdgeState Decide(const Rule& rule)
{
  const Quad quad{ 0, 0, 0, 1, 2, 3 };
  const EdgeState state = rule.Judge(quad);
  return state == EdgeState::Uncertain ? rule.JudgeExactly(quad) : state;
}
}

QuadJudge::QuadJudge(const PieceSurvey& survey, const FlipOptions& options)
  : Plan(PlanPacking(DescribeMesh(survey), options.Criterion, false)),
    Criterion(options.Criterion),
    IsSurface(survey.Geometry == GeometryKind::Surface),
    Canonical(options.TieRule == TieRuleKind::Canonical),
    FiltersApply(survey.FiltersApply),
    Tolerance(GetTolerance(options, DescribeMesh(survey))),
    Range(survey.Range)
{
}

EdgeState QuadJudge::Judge(const double (&apqb)[4][3]) const
{
  double packed[12];
  const int components = this->Plan.Components;
  for (int i = 0; i < 4 * components; ++i)
  {
    const int k = i % components;
    packed[i] = this->Plan.Flat && k == 2 ? 0.0 : apqb[i / components][this->Plan.Axes[k]];
  }
  if (this->IsSurface)
  {
    return Decide(SurfaceRule<double>{ { packed, this->Tolerance, this->Range } });
  }
  if (this->Criterion == CriterionKind::OppositeAngles)
  {
    return Decide(PlanarAngleRule{ { packed, this->Tolerance, this->Range } });
  }
  return components == 3
    ? Decide(PlanarRule<double, 3>{ packed, 0, this->Canonical, this->FiltersApply })
    : Decide(PlanarRule<double, 2>{ packed, 0, this->Canonical, this->FiltersApply });
}

EdgeState QuadJudge::Judge(const SeamSide& one, const SeamSide& other) const
{
  double apqb[4][3];
  std::copy_n(one.Opposite, 3, apqb[0]);
  std::copy_n(one.Ends[one.RunsForward ? 0 : 1], 3, apqb[1]);
  std::copy_n(one.Ends[one.RunsForward ? 1 : 0], 3, apqb[2]);
  std::copy_n(other.Opposite, 3, apqb[3]);
  return this->Judge(apqb);
}

EdgeState QuadJudge::Judge(
  const PieceMesh& mesh, const PieceCorner& one, const PieceCorner& other) const
{
  const PieceTriangle& triangle = mesh.Triangles[one.Triangle];
  double apqb[4][3];
  mesh.GetPosition(triangle.Points[one.Slot], apqb[0]);
  mesh.GetPosition(triangle.GetStart(one.Slot), apqb[1]);
  mesh.GetPosition(triangle.GetEnd(one.Slot), apqb[2]);
  mesh.GetPosition(mesh.Triangles[other.Triangle].Points[other.Slot], apqb[3]);
  return this->Judge(apqb);
}

}
