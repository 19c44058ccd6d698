// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEGMENTINSERTION_H
#define DELAUNAYFLIP_SEGMENTINSERTION_H

#include "Array.h"
#include "Atomics.h"
#include "ConstraintFlips.h"
#include "FlipError.h"
#include "LoadedMesh.h"
#include "SpatialOrder.h"
#include "Strips.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A segment to insert, on a backend.
struct SegmentItem
{
  enum StateKind : std::uint32_t
  {
    Waiting,
    Winning,
    Inserted,
    Refused
  };

  VertexId From, To;
  StateKind State;
  std::uint32_t NumberOfEdges; ///< Of its path.
  ConstraintPath::Segment* Path;
};

/// Segments that are inserted into a triangulation of points, and what those that are under way
/// claim.
struct SegmentClaims
{
  static constexpr std::uint32_t None = 0xFFFFFFFFu;

  PlaneMesh Mesh;
  VertexFans Fans;
  std::uint32_t *Triangles, *Edges; ///< The smallest claim of each in the current round, or more.

  DELAUNAYFLIP_HOST_DEVICE ConstraintPath StartPath(const SegmentItem& item) const
  {
    return { this->Mesh, this->Fans, nullptr, item.From, item.To };
  }

  /// Finds the path of a segment, and claims the triangles that it crosses and the edges that it
  /// runs along. A segment that crosses a fixed edge is refused: that edge will stay.
  DELAUNAYFLIP_HOST_DEVICE void Claim(SegmentItem& item, std::uint32_t claim) const
  {
    item.NumberOfEdges = 0;
    const PathResult result = this->StartPath(item).Walk(
      [&](const ConstraintPath::Segment& segment)
      {
        ++item.NumberOfEdges;
        if (segment.IsEdge)
        {
          AtomicMin(&this->Edges[EdgeOf(segment.Side)], claim);
        }
      },
      [&](HalfEdgeId side) {
        this->VisitTriangles(side, [&](std::uint32_t* triangle) { AtomicMin(triangle, claim); });
      });
    if (result != PathResult::Found)
    {
      item.State = SegmentItem::Refused;
      item.NumberOfEdges = 0;
    }
  }

  /// Stores the path of a segment, which wins unless an earlier one has a claim in its way. A path
  /// that crosses triangles needs them for itself, and may take no edge that an earlier one runs
  /// along. Paths that run along an edge may share it, but no earlier one may cross it.
  DELAUNAYFLIP_HOST_DEVICE void Decide(SegmentItem& item, std::uint32_t claim) const
  {
    bool isFirst = true;
    const auto see = [&](std::uint32_t* other) { isFirst = isFirst && AtomicLoad(other) >= claim; };
    ConstraintPath::Segment* next = item.Path;
    this->StartPath(item).Walk(
      [&](const ConstraintPath::Segment& segment)
      {
        *next++ = segment;
        if (segment.IsEdge)
        {
          this->VisitTriangles(segment.Side, see);
        }
      },
      [&](HalfEdgeId side)
      {
        this->VisitTriangles(side, see);
        see(&this->Edges[EdgeOf(side)]);
      });
    item.State = isFirst ? SegmentItem::Winning : SegmentItem::Waiting;
  }

  /// Makes the path of a winner edges.
  DELAUNAYFLIP_HOST_DEVICE void Flip(SegmentItem& item, std::int64_t& flips) const
  {
    ConstraintPath path = this->StartPath(item);
    for (std::uint32_t i = 0; i < item.NumberOfEdges; ++i)
    {
      path.Flip(item.Path[i]);
    }
    flips += path.Flips;
  }

  /// Fixes these. That is a step of its own, because flips beside an edge make it a candidate.
  DELAUNAYFLIP_HOST_DEVICE void Fix(SegmentItem& item) const
  {
    for (std::uint32_t i = 0; i < item.NumberOfEdges; ++i)
    {
      AtomicStore(&this->Mesh.Edges.States[EdgeOf(item.Path[i].Side)], EdgeState::Fixed);
    }
    item.State = SegmentItem::Inserted;
  }

private:
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void VisitTriangles(HalfEdgeId side, const Visit& visit) const
  {
    for (const HalfEdgeId both : { side, side ^ 1u })
    {
      const CornerId corner = this->Mesh.Edges.CornerOfHalfEdge[both];
      if (corner != NoCorner)
      {
        visit(&this->Triangles[TriangleOf(corner)]);
      }
    }
  }
};

/// What is done to the items of a list in a round, step by step.
struct SegmentRound
{
  enum StepKind
  {
    Claim,
    Decide,
    Flip,
    Fix
  };

  SegmentClaims Claims;
  SegmentItem* Items;
  const std::uint32_t* List;
  std::uint32_t FirstClaim; ///< Of the first item.
  StepKind Step = Claim;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, std::int64_t& flips) const
  {
    SegmentItem& item = this->Items[this->List[i]];
    const std::uint32_t claim = this->FirstClaim + this->List[i];
    if (this->Step == Claim)
    {
      this->Claims.Claim(item, claim);
    }
    else if (this->Step == Decide && item.State == SegmentItem::Waiting)
    {
      this->Claims.Decide(item, claim);
    }
    else if (this->Step == Flip && item.State == SegmentItem::Winning)
    {
      this->Claims.Flip(item, flips);
    }
    else if (this->Step == Fix && item.State == SegmentItem::Winning)
    {
      this->Claims.Fix(item);
    }
  }
};

/// Inserts segments into a triangulation of points, many at a time, as if each were inserted after
/// those before it.
///
/// In a round, all segments that are left find their paths and claim the triangles that they cross
/// and the edges that they run along. Then those flip that have no claim of an earlier one in their
/// way. Two segments that cross claim a common triangle, so the later one waits until it finds the
/// earlier one. When few can flip at a time, threads insert the others one by one.
template <typename Backend>
struct SegmentInsertion
{
  /// @param edges its triangles turn to the left. @param placeOf of every point its place, or
  /// NoVertex. It and the places are in the memory of the backend.
  SegmentInsertion(
    EdgeMesh& edges, const PlaneArray& places, const VertexId* placeOf, const Backend& backend)
    : Device(backend),
      PlaceOf(placeOf),
      Size{ edges.NumberOfTriangles, edges.NumberOfEdges },
      Corners(backend.template MakeArray<CornerId>(places.Count)),
      TriangleClaims(backend.template MakeArray<std::uint32_t>(this->Size[0])),
      EdgeClaims(backend.template MakeArray<std::uint32_t>(this->Size[1])),
      Failed(backend.template MakeArray<std::int32_t>(1)),
      Claims{ { edges.View(), places, true, this->Failed.Data() }, { this->Corners.Data() },
        this->TriangleClaims.Data(), this->EdgeClaims.Data() }
  {
  }

  /// @param ends pairs of points. @param onBatch is told what segments have become, in their order;
  /// false: no more.
  /// @throws BeyondDevice
  void Insert(const std::vector<std::uint32_t>& ends, const SegmentObserver& onBatch)
  {
    this->Prepare();
    const auto size = static_cast<std::int64_t>(ends.size() / 2);
    // As many as take about a tenth of a second. The more, the nearer they are to each other.
    constexpr std::int64_t Fewest = 1 << 12, Most = 1 << 20;
    constexpr double SecondsPerBatch = 0.1;
    std::int64_t batch = Fewest;
    bool goesOn = true;
    for (std::int64_t begin = 0; begin < size && goesOn;)
    {
      const auto start = std::chrono::steady_clock::now();
      const std::int64_t count = std::min(batch, size - begin);
      goesOn = onBatch(this->InsertBatch(ends.data() + 2 * begin, count));
      begin += count;
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      const double next = SecondsPerBatch / std::max(taken.count(), 1e-6);
      batch = static_cast<std::int64_t>(
        std::clamp(next * static_cast<double>(count), double(Fewest), double(Most)));
    }
  }

  void Prepare()
  {
    const std::int32_t none = 0;
    this->Device.Upload(&none, 1, this->Failed.Data());
    // Any corner of a vertex will do: a path does not depend on where the search for it begins.
    const EdgeMeshView edges = this->Claims.Mesh.Edges;
    CornerId* corners = this->Corners.Data();
    this->Device.ForEach(this->Size[0],
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          AtomicStore(&corners[edges.Triangles[t].Vertices[slot]],
            MakeCorner(static_cast<TriangleId>(t), slot));
        }
      });
    // The loop of a device has states of its own.
    this->Device.ForEach(Backend::IsOnHost ? 0 : this->Size[1],
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e) {
        edges.States[e] = edges.States[e] == EdgeState::Fixed ? EdgeState::Fixed : EdgeState::Good;
      });
  }

  InsertedSegments InsertBatch(const std::uint32_t* ends, std::int64_t size)
  {
    Array<std::uint32_t> points = this->Device.template MakeArray<std::uint32_t>(2 * size);
    this->Items = this->Device.template MakeArray<SegmentItem>(size);
    this->Paths.clear();
    this->Flips = 0;
    this->Device.Upload(ends, 2 * size, points.Data());
    const std::uint32_t* point = points.Data();
    const VertexId* placeOf = this->PlaceOf;
    SegmentItem* items = this->Items.Data();
    const bool isEmpty = this->Size[0] == 0;
    this->Device.ForEach(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const VertexId from = placeOf[point[2 * i]], to = placeOf[point[2 * i + 1]];
        const bool isRefused = from == NoVertex || to == NoVertex || isEmpty;
        items[i] = { from, to,
          isRefused      ? SegmentItem::Refused
            : from == to ? SegmentItem::Inserted
                         : SegmentItem::Waiting,
          0, nullptr };
      });
    this->RunRounds(size);
    return this->Fetch(size);
  }

  void RunRounds(std::int64_t size)
  {
    // Near segments one after the other: what they visit is near, too.
    const SegmentItem* items = this->Items.Data();
    const auto places = std::max<std::uint64_t>(1, this->Corners.Size());
    Array<std::uint32_t> all = this->Device.template SortIndices<SortKeyBits>(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        return items[i].State != SegmentItem::Waiting
          ? 0u
          : static_cast<std::uint32_t>((std::uint64_t(items[i].From) << SortKeyBits) / places);
      });
    std::int64_t count = size;
    all = this->ListWaiting(all.Data(), count);
    constexpr std::int64_t Few = Backend::IsOnHost ? 64 : 0;
    for (std::int64_t before = 2 * count;
         count > Few && (!Backend::IsOnHost || count <= before / 4 * 3);)
    {
      before = count;
      this->RunRound(all.Data(), count, size);
      all = this->ListWaiting(all.Data(), count);
    }
    if constexpr (Backend::IsOnHost)
    {
      std::sort(all.Data(), all.Data() + count);
      for (std::int64_t i = 0; i < count; ++i)
      {
        this->RunRound(all.Data() + i, 1, size);
      }
    }
  }

  /// Those of a list that wait. @param count receives their number.
  Array<std::uint32_t> ListWaiting(const std::uint32_t* list, std::int64_t& count)
  {
    const SegmentItem* items = this->Items.Data();
    const auto countOf = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return items[list[i]].State == SegmentItem::Waiting ? 1 : 0; };
    const typename Backend::Numbering numbering = this->Device.Count(count, countOf);
    Array<std::uint32_t> waiting = this->Device.template MakeArray<std::uint32_t>(numbering.Total);
    std::uint32_t* to = waiting.Data();
    this->Device.ForEachNumbered(numbering, count, countOf,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (items[list[i]].State == SegmentItem::Waiting)
        {
          to[number] = list[i];
        }
      });
    count = numbering.Total;
    return waiting;
  }

  /// @param list `count` of all `size` items that wait.
  void RunRound(const std::uint32_t* list, std::int64_t count, std::int64_t size)
  {
    SegmentRound round{ this->Claims, this->Items.Data(), list, this->StartClaims(size) };
    this->ForItems(count, round);
    const auto countOf = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return static_cast<int>(round.Items[list[i]].NumberOfEdges); };
    const typename Backend::Numbering numbering = this->Device.Count(count, countOf);
    this->Paths.push_back(
      this->Device.template MakeArray<ConstraintPath::Segment>(numbering.Total));
    ConstraintPath::Segment* paths = this->Paths.back().Data();
    this->Device.ForEachNumbered(numbering, count, countOf,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      { round.Items[list[i]].Path = paths + number; });
    for (const auto step : { SegmentRound::Decide, SegmentRound::Flip, SegmentRound::Fix })
    {
      round.Step = step;
      this->Flips += this->ForItems(count, round);
    }
  }

  /// The claim of the first item. Claims are less than those of all rounds before, so that nobody
  /// has to withdraw them.
  std::uint32_t StartClaims(std::int64_t size)
  {
    if (this->FirstClaim < size)
    {
      this->FirstClaim = SegmentClaims::None;
      for (int i = 0; i < 2; ++i)
      {
        std::uint32_t* claims = i == 0 ? this->TriangleClaims.Data() : this->EdgeClaims.Data();
        this->Device.ForEach(this->Size[i],
          [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t j) { claims[j] = SegmentClaims::None; });
      }
    }
    this->FirstClaim -= size;
    return static_cast<std::uint32_t>(this->FirstClaim);
  }

  /// Calls work(i, sum) for i = 0 .. count - 1, which may each take long. @returns the sum.
  template <typename Work>
  std::int64_t ForItems(std::int64_t count, const Work& work)
  {
    if constexpr (Backend::IsOnHost)
    {
      constexpr std::int64_t Grain = 64;
      return this->Device.template SumRanges<std::int64_t>(
        count,
        [&](std::int64_t begin, std::int64_t end)
        {
          std::int64_t sum = 0;
          for (std::int64_t i = begin; i < end; ++i)
          {
            work(i, sum);
          }
          return sum;
        },
        Grain);
    }
    else
    {
      return this->Device.template Sum<std::int64_t>(count, work);
    }
  }

  /// What the items have become.
  InsertedSegments Fetch(std::int64_t size)
  {
    const SegmentItem* items = this->Items.Data();
    const PlaneMesh mesh = this->Claims.Mesh;
    const auto countOf = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return static_cast<int>(items[i].NumberOfEdges); };
    const typename Backend::Numbering numbering = this->Device.Count(size, countOf);
    Array<std::int32_t> counts = this->Device.template MakeArray<std::int32_t>(size);
    Array<SegmentSide> sides = this->Device.template MakeArray<SegmentSide>(numbering.Total);
    std::int32_t* count = counts.Data();
    SegmentSide* side = sides.Data();
    this->Device.ForEachNumbered(numbering, size, countOf,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        const SegmentItem& item = items[i];
        count[i] = item.State == SegmentItem::Refused ? InsertedSegments::Refused
                                                      : static_cast<int>(item.NumberOfEdges);
        for (std::uint32_t j = 0; j < item.NumberOfEdges; ++j)
        {
          const ConstraintPath::Segment& made = item.Path[j];
          side[number + j] = { made.Side, mesh.GetStart(made.Side) == made.Start ? 1u : 0u };
        }
      });
    InsertedSegments result;
    result.NumberOfEdges.resize(size);
    result.Sides.resize(numbering.Total);
    result.Flips = this->Flips;
    this->Device.Download(counts.Data(), size, result.NumberOfEdges.data());
    this->Device.Download(sides.Data(), numbering.Total, result.Sides.data());
    std::int32_t failed = 0;
    this->Device.Download(this->Failed.Data(), 1, &failed);
    if (failed != 0)
    {
      throw BeyondDevice();
    }
    return result;
  }

  const Backend& Device;
  const VertexId* PlaceOf;
  const std::int64_t Size[2]; ///< Numbers of triangles and edges.
  Array<CornerId> Corners; ///< One of every place.
  Array<std::uint32_t> TriangleClaims, EdgeClaims;
  Array<std::int32_t> Failed;
  const SegmentClaims Claims;
  std::int64_t FirstClaim = 0;
  Array<SegmentItem> Items;
  std::vector<Array<ConstraintPath::Segment>> Paths; ///< Of a round each.
  std::int64_t Flips = 0;
};

}

#endif
