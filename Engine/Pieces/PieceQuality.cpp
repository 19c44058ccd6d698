// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceQuality.h"

#include "AngleSurvey.h"
#include "CotangentAngle.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

double MeasureCotangent(const double (&x)[3][3], const PieceSurvey& survey)
{
  const bool isFlat = survey.Geometry == GeometryKind::PlanarXY;
  const Vector3 a{ x[0][0], x[0][1], isFlat ? 0.0 : x[0][2] };
  const Vector3 b{ x[1][0], x[1][1], isFlat ? 0.0 : x[1][2] };
  const Vector3 c{ x[2][0], x[2][1], isFlat ? 0.0 : x[2][2] };
  const double usual =
    isFlat ? LargestSquaredCotangentFlat(a, b, c) : LargestSquaredCotangent(a, b, c);
  return usual == INFINITY || IsWide(survey.Range, a, b, c) ? LargestSquaredCotangentWide(a, b, c)
                                                            : usual;
}

namespace
{
double Measure(const PieceMesh& mesh, const PieceSurvey& survey, const std::int32_t (&points)[3])
{
  double x[3][3];
  for (int slot = 0; slot < 3; ++slot)
  {
    mesh.GetPosition(points[slot], x[slot]);
  }
  return MeasureCotangent(x, survey);
}

/// -infinity for an empty place.
double Measure(const PieceMesh& mesh, const PieceSurvey& survey, std::int64_t t)
{
  std::int32_t points[3];
  mesh.GetPoints(t, points);
  const double cotangent = Measure(mesh, survey, points);
  return mesh.IsListed(t) && mesh.Triangles[t].HasLeft ? -INFINITY : cotangent;
}

struct MeasureStep
{
  const PieceMesh& Mesh;
  const PieceSurvey& Survey;

  void Prefetch(std::int64_t t) const
  {
    std::int32_t points[3];
    this->Mesh.GetPoints(t, points);
    for (const std::int32_t point : points)
    {
      this->Mesh.PrefetchPoint(point);
    }
  }
  void operator()(std::int64_t t, LargestValue& sum) const
  {
    LargestValue one;
    one.Value = Measure(this->Mesh, this->Survey, t);
    sum += one;
  }
};
}

double FindSmallestAngle(const PieceMesh& mesh, const PieceSurvey& survey, int threads)
{
  const LargestValue largest = ThreadBackend(threads).Sum<LargestValue>(
    static_cast<std::int64_t>(mesh.Triangles.size()), MeasureStep{ mesh, survey });
  return ToDegrees(largest.Value);
}

double FindSmallestAngleAfterRounds(const PieceMesh& mesh, const PieceSurvey& survey)
{
  double largest = mesh.FindLargestSquaredCotangent();
  for (const std::int64_t t : mesh.FindListed())
  {
    largest = std::max(largest, Measure(mesh, survey, t));
  }
  return ToDegrees(largest);
}

}
