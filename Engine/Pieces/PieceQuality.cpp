// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceQuality.h"

#include "TriangleAngles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
}

void PieceQuality::Measure(const PieceMesh& mesh, const PieceSurvey& survey)
{
  const PieceRegion all(mesh, survey);
  const TriangleMesh view = all.View();
  std::vector<double> angles(view.Triangles.Count);
  FindSmallestAngles(view, survey.Geometry, 1, angles.data());
  this->Angles.assign(mesh.Triangles.size(), NaN);
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    this->Angles[all.GetTriangles()[i]] = angles[i];
  }
}

void PieceQuality::Update(
  const PieceRegion& region, const std::vector<std::int32_t>& ids, const PieceSurvey& survey)
{
  TriangleMesh view = region.View();
  view.Triangles = TriangleArray(ids.data(), region.GetNumberOfTriangles());
  std::vector<double> angles(view.Triangles.Count);
  FindSmallestAngles(view, survey.Geometry, 1, angles.data());
  const std::vector<std::int64_t>& triangles = region.GetTriangles();
  if (!triangles.empty() && triangles.back() >= static_cast<std::int64_t>(this->Angles.size()))
  {
    this->Angles.resize(triangles.back() + 1, NaN);
  }
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    this->Angles[triangles[i]] = angles[i];
  }
}

double PieceQuality::FindSmallest(
  const PieceMesh& mesh, const std::vector<std::int64_t>& omitted) const
{
  double smallest = NaN;
  auto next = omitted.begin();
  for (std::size_t t = 0; t < this->Angles.size(); ++t)
  {
    const bool isOmitted = next != omitted.end() && *next == static_cast<std::int64_t>(t);
    next += isOmitted ? 1 : 0;
    if (!isOmitted && !mesh.Triangles[t].HasLeft)
    {
      smallest = std::fmin(smallest, this->Angles[t]);
    }
  }
  return smallest;
}

}
