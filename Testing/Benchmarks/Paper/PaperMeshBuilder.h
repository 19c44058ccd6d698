// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERMESHBUILDER_H
#define DELAUNAYFLIP_PAPERMESHBUILDER_H

#include "PaperArrays.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// For every corner the one across the edge opposite to it. -1 if that edge belongs to one
/// triangle, to three or more, or to two that run through it the same way: such edges become
/// boundary edges, one for each of their triangles, because ta and tb hold two triangles only.
std::vector<std::int32_t> FindTwinCorners(
  const std::vector<std::int32_t>& triangles, std::int64_t points, const ThreadBackend& threads);

template <typename Real>
void SetPosition(const PointArray& points, std::int64_t i, PaperPoint2<Real>& position)
{
  position = { static_cast<Real>(points.Get(i, 0)), static_cast<Real>(points.Get(i, 1)) };
}

template <typename Real>
void SetPosition(const PointArray& points, std::int64_t i, PaperPoint3<Real>& position)
{
  position = { static_cast<Real>(points.Get(i, 0)), static_cast<Real>(points.Get(i, 1)),
    static_cast<Real>(points.Get(i, 2)), Real(0) };
}

inline std::int32_t NextCorner(std::int32_t corner)
{
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

inline std::int32_t PreviousCorner(std::int32_t corner)
{
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// Fills the arrays of edges from those of vertices and triangles.
template <typename Point>
void FillEdges(
  PaperMesh<Point>& mesh, const std::vector<std::int32_t>& twins, const ThreadBackend& threads)
{
  const auto corners = static_cast<std::int64_t>(twins.size());
  const auto count = [&](std::int64_t c) { return twins[c] < 0 || c < twins[c] ? 1 : 0; };
  const auto numbering = threads.Count(corners, count);
  for (std::vector<IndexPair>* pairs :
    { &mesh.Ends, &mesh.TriangleA, &mesh.TriangleB, &mesh.Opposites })
  {
    pairs->resize(numbering.Total);
  }
  threads.ForEachNumbered(numbering, corners, count,
    [&](std::int64_t c, std::int64_t edge)
    {
      if (count(c) == 0)
      {
        return;
      }
      const auto a = static_cast<std::int32_t>(c);
      const std::int32_t b = twins[c];
      mesh.TriangleA[edge] = { NextCorner(a), PreviousCorner(a) };
      mesh.TriangleB[edge] =
        b < 0 ? IndexPair{ -1, -1 } : IndexPair{ PreviousCorner(b), NextCorner(b) };
      mesh.Opposites[edge] = { a, b };
      mesh.Ends[edge] = { mesh.Triangles[NextCorner(a)], mesh.Triangles[PreviousCorner(a)] };
    });
}

/// @param mesh with fewer than 2^31 / 3 triangles and valid ids.
template <typename Point>
PaperMesh<Point> MakePaperMesh(const TriangleMesh& mesh, const ThreadBackend& threads)
{
  PaperMesh<Point> result;
  result.Vertices.resize(mesh.Points.Count);
  threads.ForEach(
    mesh.Points.Count, [&](std::int64_t i) { SetPosition(mesh.Points, i, result.Vertices[i]); });
  result.Triangles.resize(3 * mesh.Triangles.Count);
  threads.ForEach(3 * mesh.Triangles.Count,
    [&](std::int64_t i)
    { result.Triangles[i] = static_cast<std::int32_t>(mesh.Triangles.Get(i / 3, i % 3)); });
  FillEdges(result, FindTwinCorners(result.Triangles, mesh.Points.Count, threads), threads);
  return result;
}

}

#endif
