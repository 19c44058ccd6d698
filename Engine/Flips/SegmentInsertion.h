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
    Inserted,
    Refused
  };

  static constexpr std::uint32_t MostHints = 4;

  VertexId From, To;
  StateKind State;
  std::uint32_t Beaten; ///< The number of the last round that it cannot win; 0: none.
  std::uint32_t NumberOfEdges; ///< The length of its path.
  TriangleId Crossed[MostHints]; ///< The first ones that the path crosses, to prefetch.
  ConstraintPath::Segment First; ///< The first segment of the path.
  ConstraintPath::Segment* Others; ///< All of it, if it has several.

  DELAUNAYFLIP_HOST_DEVICE ConstraintPath::Segment* GetPath()
  {
    return this->NumberOfEdges > 1 ? this->Others : &this->First;
  }
};

/// The data that threads prefetch for an item. Each kind is found by means of the one before it, so
/// it is prefetched some items later.
enum class PrefetchStage
{
  Item,
  Ends, ///< Its two points, and a corner of the first.
  FirstTriangle, ///< The triangle of that corner.
  CornersAcross, ///< The corners on the other side of its edges.
  TrianglesAcross, ///< The triangles of these.
  Count
};

/// What is done to the items of a list in a round, step by step. All segments that are left find
/// their paths and claim the triangles that these cross. One of several claims on a triangle wins;
/// the others are beaten. A path that runs along an edge shares it with others that do, but not
/// with one that crosses it. The first of all items is never beaten.
struct SegmentRound
{
  PlaneMesh Mesh;
  VertexFans Fans;
  std::uint32_t* Claims; ///< The smallest claim on each triangle.
  SegmentItem* Items = nullptr;
  const std::uint32_t* List = nullptr;
  std::uint32_t Number = 0; ///< The first round has 1.
  std::uint32_t FirstClaim = 0; ///< The first item's claim.
  std::uint32_t EndClaim = 0; ///< One more than the last item's. Other rounds have no lower claims.

  DELAUNAYFLIP_HOST_DEVICE ConstraintPath StartPath(const SegmentItem& item) const
  {
    return { this->Mesh, this->Fans, nullptr, item.From, item.To };
  }

  /// Finds the path of a segment, and claims the triangles that it crosses. A segment that crosses
  /// a fixed edge is refused: that edge will stay. The later one of two claims on a triangle sees
  /// the other, and so knows which segment is beaten.
  DELAUNAYFLIP_HOST_DEVICE void Claim(SegmentItem& item, std::uint32_t claim) const
  {
    std::uint32_t edges = 0, crossed = 0;
    TriangleId last = NoTriangle;
    const auto claimTriangle = [&](HalfEdgeId side)
    {
      const TriangleId triangle = TriangleOf(this->Mesh.Edges.CornerOfHalfEdge[side]);
      if (triangle == last)
      {
        return;
      }
      last = triangle;
      item.Crossed[crossed++ % SegmentItem::MostHints] = triangle;
      const std::uint32_t before = AtomicMin(&this->Claims[triangle], claim);
      if (before != claim)
      {
        this->Beat(std::max(before, claim));
      }
    };
    const PathResult result = this->StartPath(item).Walk(
      [&](const ConstraintPath::Segment& segment)
      {
        if (edges == 0)
        {
          item.First = segment;
        }
        ++edges;
      },
      [&](HalfEdgeId side)
      {
        claimTriangle(side);
        claimTriangle(side ^ 1u);
      });
    if (result == PathResult::Found)
    {
      item.NumberOfEdges = edges;
    }
    else
    {
      item.NumberOfEdges = 0;
      item.State = SegmentItem::Refused;
    }
  }

  /// Stores the path of a segment. Where the path runs along an edge, an earlier segment in one of
  /// the two triangles may cross it, and then beats it. A later segment that crosses it has both
  /// triangles or is beaten.
  DELAUNAYFLIP_HOST_DEVICE void Decide(SegmentItem& item, std::uint32_t claim) const
  {
    const auto see = [&](const ConstraintPath::Segment& segment)
    {
      const CornerId corners[2] = { this->Mesh.Edges.CornerOfHalfEdge[segment.Side],
        this->Mesh.Edges.CornerOfHalfEdge[segment.Side ^ 1u] };
      if (segment.IsEdge && corners[0] != NoCorner && corners[1] != NoCorner)
      {
        const std::uint32_t left = this->Claims[TriangleOf(corners[0])];
        const std::uint32_t right = this->Claims[TriangleOf(corners[1])];
        if (left < claim || right < claim)
        {
          this->Beat(claim);
        }
        else if (left == right && left != claim)
        {
          this->Beat(left);
        }
      }
    };
    if (item.NumberOfEdges == 1)
    {
      see(item.First);
    }
    else if (item.NumberOfEdges > 1)
    {
      ConstraintPath::Segment* next = item.Others;
      this->StartPath(item).Walk(
        [&](const ConstraintPath::Segment& segment)
        {
          see(segment);
          *next++ = segment;
        },
        [](HalfEdgeId) {});
    }
  }

  /// The answer is final only when all have decided. Prefetches ask earlier, while others are being
  /// beaten.
  DELAUNAYFLIP_HOST_DEVICE bool IsWinner(const SegmentItem& item) const
  {
    return item.State == SegmentItem::Waiting && AtomicLoad(&item.Beaten) != this->Number;
  }

  /// Turns the path of a winner into edges.
  DELAUNAYFLIP_HOST_DEVICE void Flip(SegmentItem& item, std::int64_t& flips) const
  {
    ConstraintPath path = this->StartPath(item);
    for (std::uint32_t i = 0; i < item.NumberOfEdges; ++i)
    {
      path.Flip(item.GetPath()[i]);
    }
    flips += path.Flips;
  }

  /// Fixes these edges. That is a step of its own: flips beside an edge make it a candidate.
  DELAUNAYFLIP_HOST_DEVICE void Fix(SegmentItem& item) const
  {
    for (std::uint32_t i = 0; i < item.NumberOfEdges; ++i)
    {
      AtomicStore(&this->Mesh.Edges.States[EdgeOf(item.GetPath()[i].Side)], EdgeState::Fixed);
    }
    item.State = SegmentItem::Inserted;
  }

  /// Prefetches what Claim will read of an item.
  void PrefetchClaim(std::int64_t i, PrefetchStage stage) const
  {
    const SegmentItem& item = this->Items[this->List[i]];
    if (stage == PrefetchStage::Item)
    {
      delaunayflip::Prefetch(&item);
      return;
    }
    const CornerId* first = &this->Fans.First[item.From];
    if (stage == PrefetchStage::Ends)
    {
      delaunayflip::Prefetch(first);
      this->Mesh.PrefetchPoint(item.From);
      this->Mesh.PrefetchPoint(item.To);
      return;
    }
    const TriangleRecord* triangles = this->Mesh.Edges.Triangles;
    const TriangleRecord* triangle = &triangles[TriangleOf(*first)];
    if (stage == PrefetchStage::FirstTriangle)
    {
      delaunayflip::Prefetch(triangle);
      return;
    }
    for (const HalfEdgeId side : triangle->HalfEdges)
    {
      const CornerId* across = &this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
      if (stage == PrefetchStage::CornersAcross)
      {
        delaunayflip::Prefetch(across);
      }
      else
      {
        delaunayflip::Prefetch(&triangles[TriangleOf(*across)]);
      }
    }
  }

  /// Prefetches what Decide, Flip and Fix will read: the item, and later, instead of its ends, the
  /// triangles that its path crosses. Other threads may be changing what the path leads to.
  void PrefetchFlip(std::int64_t i, PrefetchStage stage) const
  {
    const SegmentItem& item = this->Items[this->List[i]];
    if (stage == PrefetchStage::Item)
    {
      delaunayflip::Prefetch(&item);
    }
    else if (stage == PrefetchStage::Ends && this->IsWinner(item))
    {
      delaunayflip::Prefetch(&this->Mesh.Edges.CornerOfHalfEdge[item.First.Side]);
      for (const TriangleId triangle : item.Crossed)
      {
        delaunayflip::Prefetch(&this->Mesh.Edges.Triangles[triangle]);
      }
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE void Beat(std::uint32_t claim) const
  {
    if (claim < this->EndClaim)
    {
      AtomicStore(&this->Items[claim - this->FirstClaim].Beaten, this->Number);
    }
  }
};

/// A step of a round.
struct SegmentStep
{
  enum StepKind
  {
    Claim,
    Decide,
    Flip,
    Fix
  };

  SegmentRound Round;
  StepKind Step;

  /// Prefetches what the step will read of an item.
  void Prefetch(std::int64_t i, PrefetchStage stage) const
  {
    if (this->Step == Claim)
    {
      this->Round.PrefetchClaim(i, stage);
    }
    else
    {
      this->Round.PrefetchFlip(i, stage);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, std::int64_t& flips) const
  {
    SegmentItem& item = this->Round.Items[this->Round.List[i]];
    const std::uint32_t claim = this->Round.FirstClaim + this->Round.List[i];
    if (this->Step == Claim)
    {
      this->Round.Claim(item, claim);
    }
    else if (this->Step == Decide)
    {
      this->Round.Decide(item, claim);
    }
    else if (this->Round.IsWinner(item))
    {
      if (this->Step == Flip)
      {
        this->Round.Flip(item, flips);
      }
      else
      {
        this->Round.Fix(item);
      }
    }
  }
};

/// Inserts segments into a triangulation of points, many at a time, as if each were inserted after
/// those before it.
///
/// In every round, the segments that no earlier one beats are inserted. Two segments that cross
/// claim a common triangle, so the later one waits until it finds the earlier one. When few can
/// flip at a time, threads insert the others one by one.
template <typename Backend>
struct SegmentInsertion
{
  /// @param edges its triangles are counter-clockwise. @param placeOf for every point its place, or
  /// NoVertex. It and the places are in the memory of the backend.
  SegmentInsertion(
    EdgeMesh& edges, const PlaneArray& places, const VertexId* placeOf, const Backend& backend)
    : Device(backend),
      PlaceOf(placeOf),
      NumberOfTriangles(edges.NumberOfTriangles),
      NumberOfEdges(edges.NumberOfEdges),
      Corners(backend.template MakeArray<CornerId>(places.Count)),
      Claims(backend.template MakeArray<std::uint32_t>(edges.NumberOfTriangles)),
      Failed(backend.template MakeArray<std::int32_t>(1)),
      Round{ { edges.View(), places, true, this->Failed.Data() }, { this->Corners.Data() },
        this->Claims.Data() }
  {
  }

  /// @param ends pairs of points. @param onBatch is told what segments have become, in their order;
  /// false: no more.
  /// @throws BeyondDevice
  void Insert(const std::vector<std::uint32_t>& ends, const SegmentObserver& onBatch)
  {
    this->Prepare();
    const auto size = static_cast<std::int64_t>(ends.size() / 2);
    // A batch takes about a tenth of a second. Segments of a large batch are near each other.
    constexpr std::int64_t Fewest = 1 << 12, Most = 1 << 20;
    constexpr double SecondsPerBatch = 0.1;
    std::int64_t batch = Fewest;
    bool goesOn = onBatch({});
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
    const EdgeMeshView edges = this->Round.Mesh.Edges;
    CornerId* corners = this->Corners.Data();
    this->Device.ForEach(this->NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          AtomicStore(&corners[edges.Triangles[t].Vertices[slot]],
            MakeCorner(static_cast<TriangleId>(t), slot));
        }
      });
    // The loop of a device has states of its own, so these are as old as the mesh.
    if constexpr (!Backend::IsOnHost)
    {
      this->Device.ForEach(this->NumberOfEdges,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e)
        {
          if (edges.States[e] != EdgeState::Fixed)
          {
            edges.States[e] = EdgeState::Good;
          }
        });
    }
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
    const bool isEmpty = this->NumberOfTriangles == 0;
    this->Device.ForEach(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const VertexId from = placeOf[point[2 * i]], to = placeOf[point[2 * i + 1]];
        SegmentItem::StateKind state = SegmentItem::Waiting;
        if (from == NoVertex || to == NoVertex || isEmpty)
        {
          state = SegmentItem::Refused;
        }
        else if (from == to)
        {
          state = SegmentItem::Inserted;
        }
        items[i] = { from, to, state, 0, 0, {}, {}, nullptr };
      });
    this->RunRounds(size);
    return this->Fetch(size);
  }

  void RunRounds(std::int64_t size)
  {
    // Segments near each other are neighbours in the list, because what they visit is near, too.
    const SegmentItem* items = this->Items.Data();
    const auto places = std::max<std::uint64_t>(1, this->Corners.Size());
    Array<std::uint32_t> all = this->Device.template SortIndices<SortKeyBits>(size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (items[i].State != SegmentItem::Waiting)
        {
          return 0u;
        }
        return static_cast<std::uint32_t>((std::uint64_t(items[i].From) << SortKeyBits) / places);
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

  /// Lists the items of a list that wait. @param count receives their number.
  Array<std::uint32_t> ListWaiting(const std::uint32_t* list, std::int64_t& count)
  {
    const SegmentItem* items = this->Items.Data();
    const auto countOf = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return int(items[list[i]].State == SegmentItem::Waiting); };
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
    this->StartClaims(size);
    SegmentRound& round = this->Round;
    round.Items = this->Items.Data();
    round.List = list;
    SegmentItem* items = round.Items;
    this->RunStep(SegmentStep::Claim, count);
    const auto countOf = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    {
      const std::uint32_t edges = items[list[i]].NumberOfEdges;
      return edges > 1 ? static_cast<int>(edges) : 0;
    };
    const typename Backend::Numbering numbering = this->Device.Count(count, countOf);
    if (numbering.Total > 0)
    {
      this->Paths.push_back(
        this->Device.template MakeArray<ConstraintPath::Segment>(numbering.Total));
      ConstraintPath::Segment* paths = this->Paths.back().Data();
      this->Device.ForEachNumbered(numbering, count, countOf,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
        { items[list[i]].Others = paths + number; });
    }
    for (const auto step : { SegmentStep::Decide, SegmentStep::Flip, SegmentStep::Fix })
    {
      this->Flips += this->RunStep(step, count);
    }
  }

  /// Claims are less than those of all rounds before, so that nobody has to withdraw them.
  void StartClaims(std::int64_t size)
  {
    SegmentRound& round = this->Round;
    ++round.Number;
    if (round.FirstClaim < size)
    {
      constexpr std::uint32_t None = 0xFFFFFFFFu;
      round.FirstClaim = None;
      std::uint32_t* claims = this->Claims.Data();
      this->Device.ForEach(this->NumberOfTriangles,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { claims[i] = None; });
    }
    round.EndClaim = round.FirstClaim;
    round.FirstClaim -= static_cast<std::uint32_t>(size);
  }

  /// Does a step to `count` items, each of which may take long. @returns the number of flips.
  std::int64_t RunStep(SegmentStep::StepKind step, std::int64_t count)
  {
    const SegmentStep work{ this->Round, step };
    if constexpr (Backend::IsOnHost)
    {
      constexpr std::int64_t Grain = 64;
      return this->Device.template SumRanges<std::int64_t>(
        count,
        [&](std::int64_t begin, std::int64_t end)
        {
          std::int64_t sum = 0;
          // What each item reads is far from what others do.
          constexpr std::int64_t Ahead = 4;
          constexpr auto Stages = static_cast<std::int64_t>(PrefetchStage::Count);
          for (std::int64_t i = begin - Stages * Ahead; i < end; ++i)
          {
            for (std::int64_t stage = 0; stage < Stages; ++stage)
            {
              const std::int64_t next = i + (Stages - stage) * Ahead;
              if (next >= begin && next < end)
              {
                work.Prefetch(next, static_cast<PrefetchStage>(stage));
              }
            }
            if (i >= begin)
            {
              work(i, sum);
            }
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
    SegmentItem* items = this->Items.Data();
    const auto countOf = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return static_cast<int>(items[i].NumberOfEdges); };
    const typename Backend::Numbering numbering = this->Device.Count(size, countOf);
    Array<std::int32_t> counts = this->Device.template MakeArray<std::int32_t>(size);
    Array<SegmentSide> sides = this->Device.template MakeArray<SegmentSide>(numbering.Total);
    std::int32_t* count = counts.Data();
    SegmentSide* side = sides.Data();
    const CornerId* corners = this->Round.Mesh.Edges.CornerOfHalfEdge;
    this->Device.ForEachNumbered(numbering, size, countOf,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        SegmentItem& item = items[i];
        count[i] = static_cast<int>(item.NumberOfEdges);
        if (item.State == SegmentItem::Refused)
        {
          count[i] = InsertedSegments::Refused;
        }
        for (std::uint32_t j = 0; j < item.NumberOfEdges; ++j)
        {
          const ConstraintPath::Segment& made = item.GetPath()[j];
          // The side of a path across triangles runs towards its start.
          const bool isOnHull = corners[made.Side ^ 1u] == NoCorner;
          side[number + j] = { made.Side, std::uint32_t(made.IsForward), std::uint32_t(isOnHull) };
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
  const std::int64_t NumberOfTriangles, NumberOfEdges;
  Array<CornerId> Corners; ///< One of every place.
  Array<std::uint32_t> Claims;
  Array<std::int32_t> Failed;
  SegmentRound Round;
  Array<SegmentItem> Items;
  std::vector<Array<ConstraintPath::Segment>> Paths; ///< One array per round.
  std::int64_t Flips = 0;
};

}

#endif
