// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TURNEDTRIANGLES_H
#define DELAUNAYFLIP_TURNEDTRIANGLES_H

#include "Defects.h"
#include "EdgeMesh.h"
#include "HeightFieldSurvey.h"
#include "MeshSurvey.h"
#include "PackedPoints.h"
#include "WideAngles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace delaunayflip
{

struct TurnedSums
{
  std::int64_t All = 0;
  IdSample Flipped; ///< Triangles that flips have made.

  DELAUNAYFLIP_HOST_DEVICE TurnedSums& operator+=(const TurnedSums& part)
  {
    this->All += part.All;
    this->Flipped += part.Flipped;
    return *this;
  }
};

/// Counts a triangle that turns to the less common side in x and y.
struct TurnedStep
{
  const TriangleRecord* Triangles;
  PackedPointsView Points;
  int Side; ///< The side to which most triangles turned at first.

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const VertexId vertex : this->Triangles[t].Vertices)
    {
      delaunayflip::Prefetch(this->Points.Address(vertex));
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, TurnedSums& sums) const
  {
    const TriangleRecord& triangle = this->Triangles[t];
    Vector3 a = this->Points.GetPosition(triangle.Vertices[0]);
    Vector3 b = this->Points.GetPosition(triangle.Vertices[1]);
    Vector3 c = this->Points.GetPosition(triangle.Vertices[2]);
    if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c))
    {
      return;
    }
    BringNearOne(a, b, c);
    if (FindTurn(a, b, c) == -this->Side)
    {
      ++sums.All;
      if (triangle.Flips >= OneFlip)
      {
        sums.Flipped.Note(triangle.InputTriangle);
      }
    }
  }
};

/// How many more triangles turn to the less common side than at first.
/// @param points the points in space.
template <typename Backend>
Defect FindTurnedTriangles(const EdgeMesh& mesh, const PackedPoints& points,
  const TurnCounts& before, const Backend& backend)
{
  const TurnedSums sums = backend.template Sum<TurnedSums>(
    mesh.NumberOfTriangles, TurnedStep{ mesh.Triangles.Data(), points.View(), before.Side });
  Defect defect = MakeDefect("triangles that flips in space have turned over in x and y, although "
                             "the input was a height field or nearly one; if it is terrain, use "
                             "planar-xy",
    sums.Flipped);
  defect.Count = std::max<std::int64_t>(0, sums.All - before.Others);
  defect.FirstIds.resize(std::min<std::size_t>(defect.FirstIds.size(), defect.Count));
  return defect;
}

}

#endif
