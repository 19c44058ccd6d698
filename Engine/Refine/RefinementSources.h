// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTSOURCES_H
#define DELAUNAYFLIP_REFINEMENTSOURCES_H

#include "RefinementItem.h"
#include "RefinementStep.h"
#include "RefinementView.h"

#include <cstdint>

/// @file
/// Where a round finds bad triangles. It looks around the new vertices, since insertion changes no
/// other triangles, and again at unchanged triangles for which the last round inserted no vertex.
/// So the time of a round is proportional to what it changes. The first and the last round look at
/// all triangles.

namespace delaunayflip
{

/// The sources of places. They are numbered: first the items of the round before, then the new
/// vertices, then all triangles if the round looks at all.
struct RefinementSources
{
  RefinementView View;
  const RefinementItem* Items; ///< The items for triangles of the round before.
  std::int64_t NumberOfItems;
  const TriangleId* Splits; ///< By new vertex, the triangle that it has split.
  std::int64_t FirstVertex; ///< The first new vertex.
  std::int64_t NumberOfVertices;
  std::int64_t NumberOfTriangles; ///< All triangles, or 0 if the round does not look at all.
  std::uint32_t* Counts; ///< By source, the number of its bad triangles.
  TriangleId* Listed; ///< By new vertex, its first bad triangles, MostListed each.
  static constexpr std::uint32_t MostListed = 4; ///< Few vertices have more.

  DELAUNAYFLIP_HOST_DEVICE std::int64_t GetSize() const
  {
    return this->NumberOfItems + this->NumberOfVertices + this->NumberOfTriangles;
  }

  /// Counts an item if its triangle is bad and has not changed. Must precede all calls of Count.
  DELAUNAYFLIP_HOST_DEVICE void Keep(std::int64_t i) const
  {
    const RefinementItem& item = this->Items[i];
    const bool isSame = item.Flips == this->View.GetFlips(item.Source) &&
      this->View.GetShape(item.Source) == ShapeKind::Bad;
    this->Counts[i] = int(isSame);
  }

  /// Judges triangles, and counts the bad ones.
  DELAUNAYFLIP_HOST_DEVICE int Count(std::int64_t source) const
  {
    if (source >= this->NumberOfItems)
    {
      std::uint32_t count = 0;
      const bool listsBad = this->IsAroundVertex(source);
      this->ForTriangles(source,
        [&](TriangleId triangle)
        {
          if (this->View.Judge(triangle) != ShapeKind::Bad)
          {
            return;
          }
          if (listsBad && count < MostListed)
          {
            this->GetListed(source)[count] = triangle;
          }
          ++count;
        });
      this->Counts[source] = count;
    }
    return static_cast<int>(this->Counts[source]);
  }

  /// Proposes places for the bad triangles of a source.
  /// @param first the number of the first place.
  DELAUNAYFLIP_HOST_DEVICE void Propose(
    std::int64_t source, std::int64_t first, const RefinementStep& step) const
  {
    if (this->Counts[source] == 0)
    {
      return;
    }
    if (source < this->NumberOfItems)
    {
      step.Items[first] = this->Items[source];
      step.LocateAndClaim(first);
      return;
    }
    if (this->IsListed(source))
    {
      for (std::uint32_t k = 0; k < this->Counts[source]; ++k)
      {
        step.MakeItem(first + k, this->GetListed(source)[k]);
        step.LocateAndClaim(first + k);
      }
      return;
    }
    std::int64_t next = first;
    // LocateAndClaim may change a shape to Left, but only that of its own triangle.
    this->ForTriangles(source,
      [&](TriangleId triangle)
      {
        if (this->View.GetShape(triangle) == ShapeKind::Bad)
        {
          step.MakeItem(next, triangle);
          step.LocateAndClaim(next);
          ++next;
        }
      });
  }

  /// The triangle at which the search for a place, or for the triangles of a vertex, begins.
  TriangleId GetStart(std::int64_t source) const
  {
    if (source < this->NumberOfItems)
    {
      return this->Items[source].Found.Triangle;
    }
    const std::int64_t number = source - this->NumberOfItems;
    if (number < this->NumberOfVertices)
    {
      return this->Splits[number];
    }
    return static_cast<TriangleId>(number - this->NumberOfVertices);
  }

  /// Prefetches what Count will read of this source, and of earlier ones.
  void PrefetchToCount(std::int64_t source) const
  {
    if (source < this->NumberOfItems + RefinementView::Fifth)
    {
      return; // items are counted already
    }
    this->View.PrefetchTriangle(this->GetStart(source));
    const TriangleId second = this->GetStart(source - RefinementView::Second);
    if (!this->IsAroundVertex(source))
    {
      if (!this->View.IsJudged(second))
      {
        this->View.PrefetchCorners(second);
      }
      return;
    }
    this->View.PrefetchCorners(second);
    this->View.PrefetchNeighbors(this->GetStart(source - RefinementView::Third));
    this->View.PrefetchBeyond(this->GetStart(source - RefinementView::Fourth));
    this->View.PrefetchSecondNeighbors(this->GetStart(source - RefinementView::Fifth));
  }

  /// Likewise for Propose, which does nothing for sources without bad triangles.
  void PrefetchToPropose(std::int64_t source, const std::uint64_t* claims) const
  {
    const RefinementView& view = this->View;
    this->PrefetchStage(source,
      [&](TriangleId triangle)
      {
        view.PrefetchTriangle(triangle);
        delaunayflip::Prefetch(&claims[triangle]);
      });
    if (source >= RefinementView::Fourth)
    {
      this->PrefetchStage(source - RefinementView::Second,
        [&](TriangleId triangle) { view.PrefetchCorners(triangle); });
      this->PrefetchStage(source - RefinementView::Third,
        [&](TriangleId triangle) { view.PrefetchNeighbors(triangle); });
      this->PrefetchStage(source - RefinementView::Fourth,
        [&](TriangleId triangle) { view.PrefetchBeyond(triangle); });
    }
  }

private:
  /// Calls stage(triangle) for the triangles of a source from which Propose will start.
  template <typename Stage>
  void PrefetchStage(std::int64_t source, const Stage& stage) const
  {
    if (this->IsListed(source))
    {
      for (std::uint32_t k = 0; k < this->Counts[source]; ++k)
      {
        stage(this->GetListed(source)[k]);
      }
    }
    else if (this->Counts[source] > 0)
    {
      stage(this->GetStart(source));
    }
  }

  /// Whether a source is a new vertex.
  DELAUNAYFLIP_HOST_DEVICE bool IsAroundVertex(std::int64_t source) const
  {
    const std::int64_t number = source - this->NumberOfItems;
    return number >= 0 && number < this->NumberOfVertices;
  }
  /// Whether a source is a new vertex, and all its bad triangles are listed.
  DELAUNAYFLIP_HOST_DEVICE bool IsListed(std::int64_t source) const
  {
    return this->IsAroundVertex(source) && this->Counts[source] <= MostListed;
  }
  DELAUNAYFLIP_HOST_DEVICE TriangleId* GetListed(std::int64_t source) const
  {
    return this->Listed + std::int64_t(MostListed) * (source - this->NumberOfItems);
  }

  /// Calls visit(triangle) for the triangles of a source that is not an item.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void ForTriangles(std::int64_t source, const Visit& visit) const
  {
    const std::int64_t number = source - this->NumberOfItems;
    if (number >= this->NumberOfVertices)
    {
      visit(static_cast<TriangleId>(number - this->NumberOfVertices));
      return;
    }
    const auto vertex = static_cast<VertexId>(this->FirstVertex + number);
    const PlaneMesh& mesh = this->View.Mesh;
    const CornerId first = this->FindCorner(vertex, this->Splits[number]);
    CornerId corner = first;
    while (corner != NoCorner)
    {
      this->VisitOwn(vertex, corner, visit);
      corner = mesh.FindNextAround(corner);
      if (corner == first)
      {
        return;
      }
    }
    // The vertex is on the hull, so the other triangles follow clockwise.
    corner = first == NoCorner ? NoCorner : mesh.FindPreviousAround(first);
    while (corner != NoCorner)
    {
      this->VisitOwn(vertex, corner, visit);
      corner = mesh.FindPreviousAround(corner);
    }
  }

  /// Calls visit(triangle) if the vertex is the newest one of the triangle, so that each triangle
  /// is visited once.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void VisitOwn(VertexId vertex, CornerId corner, const Visit& visit) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    const bool isNewest = mesh.GetVertex(PlaneMesh::Next(corner)) < vertex &&
      mesh.GetVertex(PlaneMesh::Previous(corner)) < vertex;
    if (isNewest)
    {
      visit(TriangleOf(corner));
    }
  }

  /// Finds a corner of a new vertex. If flips have taken the vertex from the triangle that it has
  /// split, a short walk finds it.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindCorner(VertexId vertex, TriangleId start) const
  {
    const PlaneMesh& mesh = this->View.Mesh;
    for (int slot = 0; slot < 3; ++slot)
    {
      if (mesh.GetVertex(MakeCorner(start, slot)) == vertex)
      {
        return MakeCorner(start, slot);
      }
    }
    const WalkEnd end = WalkWithinSegments(mesh, mesh.GetPoint(vertex), start);
    const int found = end.Found.FindVertexSlot();
    if (end.Blocked != NoHalfEdge || found < 0)
    {
      return NoCorner; // the last round looks at all triangles
    }
    return MakeCorner(end.Found.Triangle, found);
  }
};

/// Judges the triangles of a source, and counts the bad ones.
struct JudgeSource
{
  static constexpr bool TakesLong = true;

  RefinementSources Sources;

  void Prefetch(std::int64_t i) const { this->Sources.PrefetchToCount(i); }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const { return this->Sources.Count(i); }
};

/// Proposes places for the bad triangles of a source.
struct ProposePlaces
{
  RefinementSources Sources;
  RefinementStep Step;

  void Prefetch(std::int64_t i) const { this->Sources.PrefetchToPropose(i, this->Step.Claims); }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, std::int64_t number) const
  {
    this->Sources.Propose(i, number, this->Step);
  }
};

}

#endif
