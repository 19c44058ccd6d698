// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WholeStars.h"

#include "PointSet.h"
#include "Records.h"
#include "StarCheck.h"
#include "SubMesh.h"

#include <memory>
#include <numeric>
#include <utility>

namespace delaunayflip
{

namespace
{
/// One flag per point: whether it has triangles and they close around it. Others are added to
/// `open` if they have triangles.
Array<unsigned char> FindClosed(
  const TriangleMesh& mesh, const ThreadBackend& threads, PointSet& open)
{
  Array<std::uint64_t> fans = threads.MakeArray<std::uint64_t>(mesh.Points.Count);
  Array<unsigned char> closed = threads.MakeArray<unsigned char>(mesh.Points.Count);
  threads.ForEach(mesh.Points.Count, [&](std::int64_t i) { fans[i] = closed[i] = 0; });
  threads.ForEach(mesh.Triangles.Count,
    [&](std::int64_t t)
    {
      const std::int64_t ids[3] = { mesh.Triangles.Get(t, 0), mesh.Triangles.Get(t, 1),
        mesh.Triangles.Get(t, 2) };
      const std::uint64_t bits[3] = { ScatterBits(ids[0]), ScatterBits(ids[1]),
        ScatterBits(ids[2]) };
      for (int slot = 0; slot < 3; ++slot)
      {
        // Around a closed fan every neighbour is the next one once, and once the previous one.
        __atomic_fetch_add(
          &fans[ids[slot]], bits[(slot + 1) % 3] - bits[(slot + 2) % 3], __ATOMIC_RELAXED);
        AtomicStore<unsigned char>(&closed[ids[slot]], 1);
      }
    });
  threads.ForEach(mesh.Points.Count,
    [&](std::int64_t i)
    {
      if (fans[i] != 0)
      {
        closed[i] = 0;
        open.Add(i);
      }
    });
  return closed;
}

/// Whether the triangles at some points, and so those around each, cover no direction twice.
bool AreApart(const TriangleMesh& mesh, const PlaneProjection& plane, const ThreadBackend& threads)
{
  PointKeys keys; // with no point known to be closed
  keys.Keys.resize(mesh.Points.Count);
  std::iota(keys.Keys.begin(), keys.Keys.end(), 0);
  keys.Shared.resize(mesh.Points.Count);
  keys.Closed.resize(mesh.Points.Count);
  const std::unique_ptr<PieceGroup> group = MakeSingleGroup();
  return AreStarsSimple(
    mesh, plane, keys, SumStarTurns(mesh, plane, keys, threads, *group), *group);
}
}

void SurveyStars(const TriangleMesh& mesh, const PlaneProjection& plane,
  const ThreadBackend& threads, WholeMesh& whole)
{
  PointSet open(mesh.Points.Count, threads);
  const Array<unsigned char> closed = FindClosed(mesh, threads, open);
  const StarTurns turns = SumStarTurns(mesh, plane, closed.Data(), threads);
  const auto numberOfClosed = threads.Sum<std::int64_t>(
    mesh.Points.Count, [&](std::int64_t i, std::int64_t& sum) { sum += closed[i]; });
  whole.Side = turns.GetSide();
  if (!turns.AreUniform() || turns.Covers != numberOfClosed)
  {
    return;
  }
  const auto isAtOpenPoint = [&](std::int64_t t) { return open.Touches(mesh.Triangles, t); };
  Array<std::int64_t> slots = ListNumbers(mesh.Triangles.Count, isAtOpenPoint, threads);
  whole.StarsAreSimple =
    AreApart(SubMesh(mesh, std::move(slots), threads).ViewWithoutLabels(), plane, threads);
}

}
