// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOPCHOICE_H
#define DELAUNAYFLIP_FLIPLOOPCHOICE_H

#include "FlipOptions.h"
#include "FlipRules.h"
#include "MeshSurvey.h"
#include "PortableMath.h"

#include <cmath>

/// @file
/// Which rule judges a mesh.

namespace delaunayflip
{

/// Which rule of FlipRules.h judges a mesh.
struct RuleChoice
{
  /// @param center TriangleMesh::Center; only spheres use it.
  RuleChoice(const MeshSurvey& survey, const FlipOptions& options,
    const PlanePoint& center = { 0.0, 0.0, 0.0 })
    : IsSurface(survey.Geometry == GeometryKind::Surface),
      IsSphere(survey.Geometry == GeometryKind::Sphere),
      Center(center),
      ByAngles(options.Criterion == CriterionKind::OppositeAngles),
      IsTilted(survey.Projection.Tilted),
      IsCanonical(options.TieRule == TieRuleKind::Canonical),
      FiltersApply(survey.FiltersApply),
      Range(survey.Range),
      Tolerance(options.Tolerance < 0.0
          ? AngleTolerance{ 0.0, 1.0, survey.Precision }
          : AngleTolerance{ Sine(options.Tolerance), Cosine(options.Tolerance), 0.0 }),
      MaximumDeviation(options.MaximumDeviation < 1e299 ? options.MaximumDeviation : INFINITY)
  {
  }

  /// Calls visit(rule) for packed coordinates (PlanPacking), of one type or the other.
  /// @param uniformSide PlanarSurvey::UniformSide or SphereSurvey::UniformSide.
  template <typename Function>
  auto Visit(
    const float* floats, const double* doubles, int uniformSide, const Function& visit) const
  {
    if (this->IsSurface && floats)
    {
      return visit(
        SurfaceRule<float>{ { floats, this->Tolerance, this->Range }, this->MaximumDeviation });
    }
    if (this->IsSurface)
    {
      return visit(
        SurfaceRule<double>{ { doubles, this->Tolerance, this->Range }, this->MaximumDeviation });
    }
    if (this->IsSphere && floats)
    {
      return visit(SphereRule<float>{
        floats, this->Center, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    if (this->IsSphere)
    {
      return visit(SphereRule<double>{
        doubles, this->Center, uniformSide, this->IsCanonical, this->FiltersApply });
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
    if (floats)
    {
      return visit(
        PlanarRule<float, 2>{ floats, uniformSide, this->IsCanonical, this->FiltersApply });
    }
    return visit(
      PlanarRule<double, 2>{ doubles, uniformSide, this->IsCanonical, this->FiltersApply });
  }

  bool IsSurface, IsSphere;
  PlanePoint Center;
  bool ByAngles, IsTilted, IsCanonical, FiltersApply;
  CoordinateRange Range;
  AngleTolerance Tolerance;
  double MaximumDeviation;
};

}

#endif
