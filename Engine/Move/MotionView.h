// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MOTIONVIEW_H
#define DELAUNAYFLIP_MOTIONVIEW_H

#include "Atomics.h"
#include "GroupWork.h"
#include "HullBoundary.h"
#include "PlaceWalk.h"
#include "PlaneMesh.h"
#include "ThreadGroup.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// How often the step of a vertex has been halved in a round.
enum Halvings : std::uint8_t
{
  WholeStep = 0,
  NoStep = 24, ///< The vertex stays where it is.
  AtTarget = 255 ///< The vertex was at its target before the round.
};

/// More than any number of halvings of a step; see MotionView::VertexMarks.
constexpr std::uint32_t StampUnit = 32;

/// A vertex that is not at its target yet.
struct LateVertex
{
  VertexId Vertex;
  CornerId Corner; ///< One of its corners or, between rounds, a corner near it.
};

/// What threads count together. The first three are the lengths of lists. No result depends on the
/// order of these lists.
enum class MotionCount : int
{
  Inverted, ///< Triangles that are not counter-clockwise.
  Changed, ///< Vertices that were halved in the last pass.
  Late, ///< Vertices that the next round moves.
  Passes, ///< Passes of a round that have halved steps.
  Unusual, ///< Targets with unusual coordinates, or of points that would be used or no longer used.
  Undecided, ///< 1 if a device could not decide.
  Hull, ///< The first of HullCount.
  End = Hull + static_cast<int>(HullCount::End)
};

/// Pointers to the arrays of a round.
template <typename Real>
struct MotionView
{
  PlaneMesh Mesh; ///< At the current places.
  Real* Now; ///< The current places, x and y by vertex.
  Real* Before; ///< The places before this round, likewise.
  PlaneArray Targets; ///< By point.
  const VertexId* Ids; ///< By vertex, its point.
  std::uint8_t* HalvingsOf; ///< By vertex.
  /// By vertex, StampUnit times the stamp of the last pass that has asked it for a smaller step,
  /// plus the halvings that were asked for.
  std::uint32_t* VertexMarks;
  std::uint32_t* TriangleMarks;
  TriangleId* Inverted; ///< The list of inverted triangles.
  LateVertex* Changed; ///< Vertices with a new step since triangles were last checked.
  LateVertex* Next; ///< Vertices that the next round moves.
  std::uint32_t* Counts; ///< By MotionCount.
  std::uint32_t MostInverted, MostLate;

  DELAUNAYFLIP_HOST_DEVICE Real GetTarget(VertexId vertex, int axis) const
  {
    return static_cast<Real>(this->Targets.Get(this->Ids[vertex], axis));
  }

  /// Whether a coordinate is neither so large nor so small that products of it overflow or vanish.
  DELAUNAYFLIP_HOST_DEVICE static bool IsUsual(Real coordinate)
  {
    constexpr double Least = 7.8886090522101181e-31; // 2^-100
    const double size = std::fabs(static_cast<double>(coordinate));
    return size == 0.0 || (size >= Least && size <= 1.0 / Least);
  }

  /// Whether a point that is not used stays so: at the place of the same used point as before, or
  /// not finite, as before. @param own the used point of its place.
  DELAUNAYFLIP_HOST_DEVICE bool KeepsUse(std::int64_t point, VertexId own) const
  {
    if (own == point)
    {
      return true;
    }
    const double x = this->Targets.Get(point, 0), y = this->Targets.Get(point, 1);
    if (own == NoVertex)
    {
      return !(IsFinite(x) && IsFinite(y));
    }
    return x == this->Targets.Get(own, 0) && y == this->Targets.Get(own, 1);
  }

  /// Moves a vertex to its target.
  DELAUNAYFLIP_HOST_DEVICE void Start(VertexId vertex) const
  {
    // All four are loaded before any of them is waited for.
    const Real x = this->GetTarget(vertex, 0), y = this->GetTarget(vertex, 1);
    const std::int64_t i = std::int64_t(2) * vertex;
    const Real beforeX = this->Now[i], beforeY = this->Now[i + 1];
    this->Before[i] = beforeX;
    this->Before[i + 1] = beforeY;
    this->Now[i] = x;
    this->Now[i + 1] = y;
    this->HalvingsOf[vertex] = WholeStep;
    if (!IsUsual(x) || !IsUsual(y))
    {
      this->Increment(MotionCount::Unusual);
    }
  }

  /// Where a vertex is after a step that has been halved so often.
  DELAUNAYFLIP_HOST_DEVICE Real FindPlace(VertexId vertex, int axis, std::uint32_t halvings) const
  {
    const double before = this->Before[std::int64_t(2) * vertex + axis];
    if (halvings >= NoStep)
    {
      return static_cast<Real>(before);
    }
    const double share = 1.0 / static_cast<double>(std::uint32_t(1) << halvings);
    const double step = static_cast<double>(this->GetTarget(vertex, axis)) - before;
    return static_cast<Real>(before + step * share);
  }

  /// Moves a vertex as far as its halvings say.
  DELAUNAYFLIP_HOST_DEVICE void Step(VertexId vertex) const
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Now[std::int64_t(2) * vertex + axis] =
        this->FindPlace(vertex, axis, this->HalvingsOf[vertex]);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsAtTarget(VertexId vertex) const
  {
    return this->Before[std::int64_t(2) * vertex] == this->GetTarget(vertex, 0) &&
      this->Before[std::int64_t(2) * vertex + 1] == this->GetTarget(vertex, 1);
  }

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t* Get(MotionCount count) const
  {
    return this->Counts + static_cast<int>(count);
  }
  /// @returns the count before, which is the index of a new element of a list.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Increment(MotionCount count) const
  {
    return AtomicAdd(this->Get(count), 1u);
  }

  /// Sets all counts to 0, except that a device could not decide. One thread may call it.
  DELAUNAYFLIP_HOST_DEVICE void ClearCounts() const
  {
    for (int i = 0; i < static_cast<int>(MotionCount::End); ++i)
    {
      if (i != static_cast<int>(MotionCount::Undecided))
      {
        AtomicStore(&this->Counts[i], 0u);
      }
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsInverted(TriangleId triangle) const
  {
    const VertexId* v = this->Mesh.Edges.Triangles[triangle].Vertices;
    return this->Mesh.FindOrientation(v[0], v[1], v[2]) <= 0;
  }
  DELAUNAYFLIP_HOST_DEVICE void AppendInverted(TriangleId triangle) const
  {
    const std::uint32_t place = this->Increment(MotionCount::Inverted);
    if (place < this->MostInverted)
    {
      this->Inverted[place] = triangle;
    }
  }

  /// Calls visit(corner) for all corners of the vertex that has the corner `first`.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void ForStar(CornerId first, const Visit& visit) const
  {
    // The next corner is loaded while the visit takes its time.
    CornerId corner = first;
    do
    {
      const CornerId next = this->Mesh.FindNextAround(corner);
      visit(corner);
      corner = next;
    } while (corner != NoCorner && corner != first);
    if (corner == first)
    {
      return;
    }
    corner = this->Mesh.FindPreviousAround(first); // the vertex is on the boundary
    while (corner != NoCorner)
    {
      const CornerId next = this->Mesh.FindPreviousAround(corner);
      visit(corner);
      corner = next;
    }
  }

  /// Finds a corner of a late vertex, near the one that it had before edges flipped.
  DELAUNAYFLIP_HOST_DEVICE void FindCorner(LateVertex& late, TriangleId triangles) const
  {
    TriangleId start = TriangleOf(late.Corner);
    start = start < triangles ? start : 0;
    for (int near = 0; near < 3; ++near) // most often flips have left it there
    {
      if (this->Mesh.GetVertex(MakeCorner(start, near)) == late.Vertex)
      {
        late.Corner = MakeCorner(start, near);
        return;
      }
    }
    const FoundPlace found = WalkToPlace(this->Mesh, this->Mesh.GetPoint(late.Vertex), start);
    const int slot = found.IsOutside() ? -1 : found.FindVertexSlot();
    late.Corner = MakeCorner(start, 0);
    if (slot >= 0)
    {
      late.Corner = MakeCorner(found.Triangle, slot);
    }
    else // a device could not decide, which ends the motion later
    {
      *this->Mesh.Failed = 1;
    }
  }

  /// Lists the inverted triangles around a vertex that have not been listed under this stamp.
  DELAUNAYFLIP_HOST_DEVICE void CheckStar(const LateVertex& late, std::uint32_t stamp) const
  {
    this->ForStar(late.Corner,
      [&](CornerId corner)
      {
        const TriangleId triangle = TriangleOf(corner);
        if (this->IsInverted(triangle) &&
          AtomicExchange(&this->TriangleMarks[triangle], stamp) != stamp)
        {
          this->AppendInverted(triangle);
        }
      });
  }

  /// Asks the vertices of a listed triangle for equal shares of their steps, the largest with which
  /// it is counter-clockwise. With unequal shares a thin triangle may be inverted on the way,
  /// though it is not if all three go at the same pace. A vertex of several triangles takes the
  /// smallest share.
  DELAUNAYFLIP_HOST_DEVICE void AskForHalvings(std::int64_t inverted, std::uint32_t stamp) const
  {
    const TriangleId triangle = this->Inverted[inverted];
    const VertexId* vertices = this->Mesh.Edges.Triangles[triangle].Vertices;
    const std::uint32_t wanted = this->FindHalvings(vertices);
    for (int slot = 0; slot < 3; ++slot)
    {
      const VertexId vertex = vertices[slot];
      if (this->HalvingsOf[vertex] >= NoStep || this->HalvingsOf[vertex] == wanted)
      {
        continue;
      }
      const std::uint32_t before =
        AtomicMax(&this->VertexMarks[vertex], stamp * StampUnit + wanted);
      if (before / StampUnit != stamp)
      {
        this->Changed[this->Increment(MotionCount::Changed)] = { vertex,
          MakeCorner(triangle, slot) };
      }
    }
  }

  /// How often the steps of an inverted triangle's vertices are to be halved: as often as one of
  /// them has been, or more often, until the triangle is counter-clockwise.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindHalvings(const VertexId* vertices) const
  {
    std::uint32_t halvings = 1;
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::uint32_t own = this->HalvingsOf[vertices[slot]];
      if (own < NoStep && own > halvings)
      {
        halvings = own;
      }
    }
    while (halvings < NoStep && this->StaysInverted(vertices, halvings))
    {
      ++halvings;
    }
    return halvings;
  }

  /// Whether a triangle is not counter-clockwise if the steps of its vertices, except of those that
  /// stay where they are, are halved so often.
  DELAUNAYFLIP_HOST_DEVICE bool StaysInverted(
    const VertexId* vertices, std::uint32_t halvings) const
  {
    PlanePoint places[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      const VertexId vertex = vertices[slot];
      places[slot] = this->Mesh.GetPoint(vertex);
      if (this->HalvingsOf[vertex] < NoStep)
      {
        places[slot] = { static_cast<double>(this->FindPlace(vertex, 0, halvings)),
          static_cast<double>(this->FindPlace(vertex, 1, halvings)), 0.0 };
      }
    }
    return this->Mesh.RequireSign(FindOrientation(places[0], places[1], places[2])) <= 0;
  }

  /// Whether triangles have asked a vertex of this one for a smaller step in the pass of a stamp.
  DELAUNAYFLIP_HOST_DEVICE bool HasNewStep(TriangleId triangle, std::uint32_t stamp) const
  {
    const VertexId* v = this->Mesh.Edges.Triangles[triangle].Vertices;
    const auto isNew = [&](VertexId vertex)
    { return this->VertexMarks[vertex] / StampUnit == stamp; };
    return isNew(v[0]) || isNew(v[1]) || isNew(v[2]);
  }

  /// Moves a listed vertex as far as the triangles have asked for.
  DELAUNAYFLIP_HOST_DEVICE void TakeHalvings(std::int64_t changed) const
  {
    const LateVertex late = this->Changed[changed];
    const VertexId vertex = late.Vertex;
    const bool isFirst = this->HalvingsOf[vertex] == WholeStep;
    this->HalvingsOf[vertex] = static_cast<std::uint8_t>(this->VertexMarks[vertex] % StampUnit);
    this->Step(vertex);
    if (isFirst && !this->IsAtTarget(vertex))
    {
      const std::uint32_t place = this->Increment(MotionCount::Late);
      if (place < this->MostLate)
      {
        this->Next[place] = late;
      }
    }
  }

  /// Makes the edges of a triangle candidates.
  DELAUNAYFLIP_HOST_DEVICE void JudgeEdges(TriangleId triangle) const
  {
    for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
    {
      EdgeState* state = &this->Mesh.Edges.States[EdgeOf(side)];
      if (AtomicLoad(state) != EdgeState::Fixed)
      {
        AtomicStore(state, EdgeState::Candidate);
      }
    }
  }
};

/// Finds the triangles that are not counter-clockwise.
template <typename Real>
struct FindInverted
{
  MotionView<Real> Motion;

  void Prefetch(std::int64_t triangle) const
  {
    for (const VertexId vertex : this->Motion.Mesh.Edges.Triangles[triangle].Vertices)
    {
      delaunayflip::Prefetch(this->Motion.Now + std::int64_t(2) * vertex);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t triangle) const
  {
    const VertexId* v = this->Motion.Mesh.Edges.Triangles[triangle].Vertices;
    const PlanePoint a = this->Get(v[0]), b = this->Get(v[1]), c = this->Get(v[2]);
    // All coordinates are in the range of the filter.
    if (FilteredOrientation(a, b, c) != 1 &&
      this->Motion.IsInverted(static_cast<TriangleId>(triangle)))
    {
      this->Motion.AppendInverted(static_cast<TriangleId>(triangle));
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE PlanePoint Get(VertexId vertex) const
  {
    const Real* place = this->Motion.Now + std::int64_t(2) * vertex;
    return { place[0], place[1], 0.0 };
  }
};

/// Halves the steps of vertices, by one group of threads, until no triangle is inverted.
template <typename Real>
struct HalveInGroup
{
  MotionView<Real> Motion;
  std::uint32_t Stamp; ///< The stamp of the first pass.
  std::uint32_t MostPasses;

  /// @param check check(changed, stamp) lists the triangles that are inverted and have one of so
  /// many vertices of MotionView::Changed, after the pass with this stamp. It waits for the group.
  template <typename Check>
  DELAUNAYFLIP_HOST_DEVICE void operator()(const ThreadGroup& group, const Check& check) const
  {
    for (std::uint32_t pass = 0; pass < this->MostPasses; ++pass)
    {
      const std::uint32_t inverted = AtomicLoad(this->Motion.Get(MotionCount::Inverted));
      if (inverted == 0 || inverted > this->Motion.MostInverted)
      {
        return;
      }
      ForEachInGroup(group, inverted,
        [&](std::uint32_t i) { this->Motion.AskForHalvings(i, this->Stamp + pass); });
      const std::uint32_t changed = AtomicLoad(this->Motion.Get(MotionCount::Changed));
      if (group.Rank == 0)
      {
        AtomicStore(this->Motion.Get(MotionCount::Inverted), 0u); // all have read it
        this->Motion.Increment(MotionCount::Passes);
      }
      ForEachInGroup(group, changed, [&](std::uint32_t i) { this->Motion.TakeHalvings(i); });
      if (group.Rank == 0)
      {
        AtomicStore(this->Motion.Get(MotionCount::Changed), 0u);
      }
      check(changed, this->Stamp + pass);
    }
  }
};

}

#endif
