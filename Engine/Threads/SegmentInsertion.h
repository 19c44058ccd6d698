// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEGMENTINSERTION_H
#define DELAUNAYFLIP_SEGMENTINSERTION_H

#include "Atomics.h"
#include "ConstraintFlips.h"
#include "Outline.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Inserts segments into a triangulation of points, many at a time, as if each were inserted after
/// those before it.
///
/// In a round, all segments that are left find their paths and claim the triangles that they cross
/// and the edges that they run along. Then those flip that have no claim of an earlier one in their
/// way. Two segments that cross claim a common triangle, so the later one waits until it finds the
/// earlier one. When few can flip at a time, the others are inserted one by one.
class SegmentInsertion
{
public:
  struct Item
  {
    VertexId From, To; ///< Different places.
    bool IsIn = false;
    std::vector<HalfEdgeId> Sides{}; ///< A side of each of its edges, from From to To.
  };

  SegmentInsertion(const PointMeshView& mesh, const ThreadBackend& backend)
    : Mesh(mesh),
      Backend(backend),
      Flips(mesh, FindFans(mesh, backend)),
      TriangleClaims(mesh.NumberOfTriangles, NoClaim),
      EdgeClaims(mesh.NumberOfEdges, NoClaim)
  {
  }

  /// At most some thousands at a time, because their paths take memory.
  void Insert(std::vector<Item>& items)
  {
    std::vector<std::uint32_t> left(items.size());
    std::iota(left.begin(), left.end(), 0);
    constexpr std::size_t Few = 64;
    for (std::size_t before = 2 * left.size(); left.size() > Few && left.size() <= before / 4 * 3;)
    {
      before = left.size();
      this->RunRound(items, left);
    }
    for (const std::uint32_t i : left)
    {
      items[i].IsIn = this->Flips.Insert(items[i].From, items[i].To) == PathResult::Found;
      this->TakeSides(items[i]);
    }
  }

  std::int64_t GetNumberOfFlips() const { return this->Flips.GetNumberOfFlips(); }

private:
  static constexpr std::uint32_t NoClaim = 0xFFFFFFFFu;

  /// Of each vertex the half-edge that begins its fan: the one at the boundary, or the first.
  static std::vector<HalfEdgeId> FindFans(const PointMeshView& mesh, const ThreadBackend& backend)
  {
    std::vector<HalfEdgeId> first(mesh.NumberOfPlaces, NoHalfEdge);
    const auto visit = [&](const auto& take)
    {
      backend.ForEach(mesh.NumberOfTriangles,
        [&](std::int64_t t)
        {
          const TriangleRecord& triangle = mesh.Edges.Triangles[t];
          for (int slot = 0; slot < 3; ++slot)
          {
            const HalfEdgeId leaves = triangle.HalfEdges[PreviousSlot(slot)];
            const bool isOpen = mesh.Edges.CornerOfHalfEdge[leaves ^ 1u] == NoCorner;
            take(&first[triangle.Vertices[slot]], leaves, isOpen);
          }
        });
    };
    visit([](HalfEdgeId* of, HalfEdgeId leaves, bool) { AtomicMin(of, leaves); });
    visit(
      [](HalfEdgeId* of, HalfEdgeId leaves, bool isOpen)
      {
        if (isOpen)
        {
          AtomicStore(of, leaves);
        }
      });
    return first;
  }

  /// @param left the items that are not decided yet, ascending.
  void RunRound(std::vector<Item>& items, std::vector<std::uint32_t>& left)
  {
    const auto count = static_cast<std::int64_t>(left.size());
    std::vector<ConstraintPath> paths(left.size());
    std::vector<unsigned char> wins(left.size());
    const auto forEach = [&](const auto& work)
    {
      constexpr std::int64_t Grain = 64;
      this->Backend.ForRange(
        count,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            work(i);
          }
        },
        Grain);
    };
    forEach(
      [&](std::int64_t i)
      {
        paths[i] = this->Flips.Find(items[left[i]].From, items[left[i]].To);
        this->ForClaims(paths[i], [&](std::uint32_t* claim) { AtomicMin(claim, left[i]); });
      });
    forEach([&](std::int64_t i) { wins[i] = this->HasNoEarlierClaim(paths[i], left[i]) ? 1 : 0; });
    forEach([&](std::int64_t i)
      { this->ForClaims(paths[i], [](std::uint32_t* claim) { AtomicStore(claim, NoClaim); }); });
    forEach(
      [&](std::int64_t i)
      {
        Item& item = items[left[i]];
        item.IsIn =
          wins[i] != 0 && paths[i].Result == PathResult::Found && this->Flips.Flip(paths[i]);
      });
    std::vector<std::uint32_t> waiting;
    for (std::int64_t i = 0; i < count; ++i)
    {
      Item& item = items[left[i]];
      if (item.IsIn)
      {
        this->Flips.Fix(paths[i]);
        this->TakeSides(item);
      }
      else if (wins[i] == 0)
      {
        waiting.push_back(left[i]);
      }
    }
    left = std::move(waiting);
  }

  void TakeSides(Item& item)
  {
    const std::vector<HalfEdgeId>& all = this->Flips.GetSegments();
    item.Sides.assign(all.begin() + static_cast<std::ptrdiff_t>(this->Taken), all.end());
    this->Taken = all.size();
  }

  /// Calls visit(claim) for the triangles that a path crosses and the edges that it runs along.
  template <typename Visit>
  void ForClaims(const ConstraintPath& path, const Visit& visit)
  {
    this->ForTriangles(
      path.Crossed, [&](TriangleId triangle) { visit(&this->TriangleClaims[triangle]); });
    for (const ConstraintPath::Rim& rim : path.Segments)
    {
      if (rim.size() == 1)
      {
        visit(&this->EdgeClaims[EdgeOf(rim.front())]);
      }
    }
  }

  template <typename Visit>
  void ForTriangles(const std::vector<HalfEdgeId>& sides, const Visit& visit) const
  {
    for (const HalfEdgeId side : sides)
    {
      for (const HalfEdgeId both : { side, side ^ 1u })
      {
        const CornerId corner = this->Mesh.Edges.CornerOfHalfEdge[both];
        if (corner != NoCorner)
        {
          visit(TriangleOf(corner));
        }
      }
    }
  }

  /// A path that crosses triangles needs them for itself, and may take no edge that an earlier one
  /// runs along. Paths that run along an edge may share it, but no earlier one may cross it.
  bool HasNoEarlierClaim(const ConstraintPath& path, std::uint32_t item) const
  {
    bool isFirst = true;
    const auto seeTriangle = [&](TriangleId triangle)
    { isFirst = isFirst && AtomicLoad(&this->TriangleClaims[triangle]) >= item; };
    this->ForTriangles(path.Crossed, seeTriangle);
    for (const HalfEdgeId side : path.Crossed)
    {
      isFirst = isFirst && AtomicLoad(&this->EdgeClaims[EdgeOf(side)]) >= item;
    }
    for (const ConstraintPath::Rim& rim : path.Segments)
    {
      if (rim.size() == 1)
      {
        this->ForTriangles(rim, seeTriangle);
      }
    }
    return isFirst;
  }

  const PointMeshView& Mesh;
  const ThreadBackend& Backend;
  ConstraintFlips Flips;
  std::vector<std::uint32_t> TriangleClaims, EdgeClaims; ///< The first item, or NoClaim.
  std::size_t Taken = 0; ///< Segments that items have.
};

}

#endif
