// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "Array.h"
#include "CallerMesh.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "SphereSurvey.h"
#include "Strips.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <type_traits>

namespace delaunayflip
{

namespace
{
/// Whether the points also have z, and are on a sphere around the origin. For most inputs a sample
/// of the points is enough to see that they are not. The last point is left out: an array with a
/// stride of 3 may end after its y.
bool IsGlobe(const PointInput& input)
{
  constexpr std::int64_t Sample = 1000;
  const PlaneArray& points = input.Points;
  if (points.Stride < 3 || input.OnDevice)
  {
    return false;
  }
  const auto survey = [&](std::int64_t stride)
  {
    GlobeSurvey sum;
    for (std::int64_t i = 0; i + 1 < points.Count; i += stride)
    {
      sum.Include({ points.Get(i, 0), points.Get(i, 1), points.Get(i, 2) });
    }
    return sum;
  };
  return survey(std::max<std::int64_t>(1, points.Count / Sample)).IsGlobe() && survey(1).IsGlobe();
}
}

void PointRun::ListStages()
{
  const auto test = [this](LoadedMesh& mesh, std::int64_t) { this->RepeatTest(mesh); };
  const auto flips = [this](LoadedMesh& mesh, std::int64_t iterations)
  { this->RepeatFlips(mesh, iterations); };
  const auto divide = [this](LoadedMesh& mesh, std::int64_t) { this->DivideAndConquer(mesh); };
  const auto insert = [this](LoadedMesh& mesh, std::int64_t segments)
  { this->InsertUpTo(static_cast<std::size_t>(segments), mesh, {}); };
  const auto remove = [this](LoadedMesh& mesh, std::int64_t) { this->RemoveTriangles(mesh); };

  this->Stages = {
    { "prepare points and segments", OnStop::Forgets, 0.0,
      Whole([this] { this->Points.Prepare(this->Observer); }), {} },
    { "triangulate", OnStop::Forgets, 0.0, Whole([this] { this->Triangulate(); }), {} },
    { "test all edges", OnStop::Forgets, 0.0, Whole([this] { this->TestAllEdges(); }), test },
    { "flip", OnStop::KeepsMesh, 0.0,
      [this] { return this->Flip([this] { return this->GivesUpFlips(); }); }, flips },
    { "divide and conquer if flips are slow", OnStop::Forgets, 0.0,
      Whole([this] { this->ReplaceSlowFlips(); }), divide },
    { "decide ties", OnStop::KeepsMesh, 0.0, [this] { return this->Flip(); }, flips },
  };
  // In the Delaunay triangulation segments cross few edges, and many are edges already.
  if (this->Points.GetCaller().NumberOfSegments > 0)
  {
    this->Stages.push_back({ "insert segments", OnStop::KeepsMesh, 0.25,
      [this] { return this->InsertSegments(); }, insert });
    this->Stages.push_back(
      { "flip around segments", OnStop::KeepsMesh, 0.0, [this] { return this->Flip(); }, flips });
  }
  this->Stages.push_back(
    { "cut triangles off", OnStop::Ignores, 0.0, Whole([this] { this->CutOff(); }), remove });
  if (this->Points.GetCaller().NumberOfRegions > 0)
  {
    const auto label = [this](LoadedMesh& mesh, std::int64_t) { this->LabelRegions(mesh); };
    this->Stages.push_back(
      { "label regions", OnStop::Ignores, 0.0, Whole([this] { this->LabelRegions(); }), label });
  }
  if (this->WantsRefinement)
  {
    const auto refine = [this](LoadedMesh& mesh, std::int64_t rounds)
    { this->RepeatRounds(mesh, rounds); };
    this->Stages.push_back(
      { "refine", OnStop::KeepsMesh, 0.5, [this] { return this->Refine(); }, refine });
  }
  // The journal records later insertions and motions as done by this stage.
  const auto insertPoints = [this](LoadedMesh& mesh, std::int64_t batch)
  {
    if (batch == AllPoints)
    {
      this->RepeatAll(mesh);
      return;
    }
    this->InsertBatch(mesh, static_cast<std::size_t>(batch));
    this->JudgeTriangles(mesh);
  };
  this->Stages.push_back(
    { "measure", OnStop::Ignores, 0.0, Whole([this] { this->MeasureEnd(); }), insertPoints });
}

PointRun::PointRun(
  const PointInput& input, const PointOptions& options, const ProgressObserver& progress)
  : LoadedRun(options, progress),
    Points(input, options)
{
  CheckOptions(options);
  CheckPointCount(input.Points.Count);
  if (input.OnDevice)
  {
    this->Options.Device =
      JoinDevice(options.Device, input.Points.Data(), input.Points.Count, "the points are");
  }
  this->Options.Geometry = GeometryKind::PlanarXY;
  this->Options.Criterion = CriterionKind::InCircle;
  this->Options.TieRule = TieRuleKind::Canonical;
  this->Options.NumberOfPieces = 1;
  this->MeasuresStart = false; // nobody sees the triangles from which flips begin
  this->WantsRefinement = this->Points.WantsRefinement();
  this->ListStages();
}

void PointRun::Triangulate()
{
  const PointInput& input = this->Points.GetInput();
  this->Load(input.OnDevice, 2 * input.Points.Count);
  if (IsGlobe(this->Points.GetCaller()))
  {
    this->Report.GeometryReason +=
      "; all are on a sphere around the origin: if it is a globe, use the projection sphere";
  }
}

std::unique_ptr<LoadedMesh> PointRun::LoadOn(BackendKind backend)
{
  // A fallback loads the mesh again. The report still tells how the last move was made.
  PointResult result;
  result.MoveRounds = this->Result.MoveRounds;
  this->Result = result;
  PointInput input = this->Points.GetInput();
  if (!this->BatchEnds.empty())
  {
    input.Points.Count = this->BatchEnds.front();
  }
  if (backend == BackendKind::CUDA)
  {
    return LoadOnCuda(input, this->Options, this->Building);
  }
  PlaneArray points = this->Points.CopyToHost();
  points.Count = input.Points.Count;
  return LoadOnThreads(points, this->Options, this->Building);
}

//------------------------------------------------------------------------------
/// Flips are slow if they have taken as long as divide and conquer would. So it is for points along
/// curves, where each flip makes the next edge bad.
bool PointRun::GivesUpFlips()
{
  // Measured on one thread: divide and conquer takes as long as about 8 flips per point, an
  // iteration as long as some hundred flips.
  constexpr std::int64_t FlipsPerPoint = 8;
  constexpr std::int64_t FlipsPerIteration = 256;
  constexpr std::int64_t Fewest = 10000, Most = 100000;
  const std::int64_t points = this->Points.GetInput().Points.Count;
  const std::int64_t allowed = FlipsPerPoint * points + std::clamp(points, Fewest, Most);
  const std::vector<IterationRecord>& made = this->Report.Iterations;
  std::int64_t done = 0;
  std::size_t iterations = 0;
  while (iterations < made.size() && done < allowed)
  {
    done += made[iterations++].Flipped + FlipsPerIteration;
  }
  const bool isOver = iterations == made.size() && !this->HasMoreFlips();
  this->AreFlipsSlow = done >= allowed && !isOver;
  if (this->AreFlipsSlow)
  {
    this->DropIterations(iterations);
  }
  return this->AreFlipsSlow;
}

/// Takes all iterations but the first ones out of the report. They were made only because they
/// belong to the same batch, and the size of a batch depends on the backend.
/// @param left how many stay.
void PointRun::DropIterations(std::size_t left)
{
  FlipReport& report = this->Report;
  for (; report.Iterations.size() > left; report.Iterations.pop_back())
  {
    const IterationRecord& dropped = report.Iterations.back();
    report.TotalFlips -= dropped.Flipped;
    report.TotalExcluded -= dropped.Excluded;
    report.TotalBlocked -= dropped.Blocked;
  }
}

/// The triangles are made anew, so what has been done before does not count any more.
void PointRun::ReplaceSlowFlips()
{
  if (this->AreFlipsSlow)
  {
    this->Journal.clear();
    this->OnBackend([this](LoadedMesh& mesh) { this->DivideAndConquer(mesh); });
    this->RecordChange(0);
    this->RecordFound(this->Loaded->GetLoop().GetFound());
  }
}

void PointRun::DivideAndConquer(LoadedMesh& mesh)
{
  mesh.DivideAndConquer(this->Building);
  mesh.GetLoop().Detect();
}

/// The iterations within chunks are one batch: if they are stopped in between, the mesh is not
/// valid, and the run is forgotten.
std::int64_t PointRun::GetBatch() const
{
  const std::int64_t batch = this->Progress.GetBatch();
  if (this->CountIterations() > 0)
  {
    return batch;
  }
  return std::max(batch, this->Loaded->GetLoop().CountChunkIterations());
}

//------------------------------------------------------------------------------
bool PointRun::InsertSegments()
{
  const std::size_t all = this->Points.GetSegments().size();
  const std::size_t before = this->Result.Taken;
  const auto tell = [this](double share)
  {
    this->WasStopped = !this->TellStage(share);
    return !this->WasStopped;
  };
  if (before < all)
  {
    this->OnBackend([&](LoadedMesh& mesh) { this->InsertUpTo(all, mesh, tell); });
    this->RecordChange(static_cast<std::int64_t>(this->Result.Taken - before));
    this->RecordFound(this->Loaded->GetLoop().GetFound());
  }
  return this->Result.Taken == all;
}

/// Inserts segments from the first one that is not taken to the one before number `end`, unless an
/// observer stops it.
/// @param observer is told the share of all segments that is inserted.
/// @throws InvalidMesh if a ring with an area is not closed or a segment of it is refused.
void PointRun::InsertUpTo(std::size_t end, LoadedMesh& mesh, const ProgressObserver& observer)
{
  if (this->Result.Taken == 0)
  {
    this->Points.PrepareRings(mesh);
  }
  const std::vector<Segment>& segments = this->Points.GetSegments();
  std::vector<std::uint32_t> ends;
  for (std::size_t i = this->Result.Taken; i < end; ++i)
  {
    ends.push_back(static_cast<std::uint32_t>(segments[i].From));
    ends.push_back(static_cast<std::uint32_t>(segments[i].To));
  }
  mesh.InsertSegments(ends,
    [&](const InsertedSegments& made)
    {
      this->Take(made);
      const auto all = static_cast<double>(segments.size());
      return !observer || observer(static_cast<double>(this->Result.Taken) / all);
    });
  if (!this->Result.Refused.empty())
  {
    this->ExplainRefused(mesh);
  }
  mesh.GetLoop().Detect();
}

/// Keeps what the next segments have become.
void PointRun::Take(const InsertedSegments& made)
{
  PointResult& result = this->Result;
  auto side = made.Sides.begin();
  for (const std::int32_t edges : made.NumberOfEdges)
  {
    const auto index = static_cast<std::uint32_t>(result.Taken++);
    const Segment& segment = this->Points.GetSegments()[index];
    if (edges == InsertedSegments::Refused)
    {
      result.Refused.push_back({ segment, index });
    }
    else
    {
      ++result.Inserted;
    }
    for (std::int32_t i = 0; i < edges; ++i, ++side)
    {
      const EdgeId edge = EdgeOf(side->Side);
      result.Seen.resize(std::max<std::size_t>(result.Seen.size(), edge + 1));
      result.Edges.push_back({ side->Side, segment.Ring, side->IsOnLeft != 0, side->IsOnHull != 0,
        !result.Seen[edge], index });
      result.Seen[edge] = true;
    }
  }
  result.Flips += made.Flips;
}

/// Finds out why segments are refused and, for those that messages name, what they cross.
/// @throws InvalidMesh if a segment of a ring is refused.
void PointRun::ExplainRefused(LoadedMesh& mesh)
{
  std::vector<RefusedSegment>& refused = this->Result.Refused;
  std::sort(refused.begin(), refused.end(),
    [](const RefusedSegment& a, const RefusedSegment& b) { return a.Index < b.Index; });
  const auto isOfSame = [](const RefusedSegment& a, const RefusedSegment& b)
  { return a.Refused.Number == b.Refused.Number; };
  refused.erase(std::unique(refused.begin(), refused.end(), isOfSame), refused.end());
  const PlaneArray points = this->Points.CopyToHost();
  std::vector<RefusedSegment*> named;
  RefusedSegment* ofRing = nullptr;
  for (RefusedSegment& one : refused)
  {
    one.Why = RefusalKind::CrossesEarlier;
    if (mesh.GetInputReport().Triangles == 0)
    {
      one.Why = RefusalKind::NoTriangulation;
    }
    if (!IsFinitePoint(points, one.Refused.From) || !IsFinitePoint(points, one.Refused.To))
    {
      one.Why = RefusalKind::NotFinite;
    }
    if (this->Points.IsRemoved(one.Refused.From) || this->Points.IsRemoved(one.Refused.To))
    {
      one.Why = RefusalKind::Removed;
    }
    const bool isFirstOfRing = ofRing == nullptr && one.Refused.Ring >= 0;
    if (isFirstOfRing)
    {
      ofRing = &one;
    }
    if (one.Why == RefusalKind::CrossesEarlier && (isFirstOfRing || SizeOf(named) < MostNamedIds))
    {
      named.push_back(&one);
    }
  }
  const std::int64_t* segments = this->Points.GetCaller().Segments;
  if (!named.empty())
  {
    mesh.ViewOnHost(
      [&](const PointMeshView& view)
      {
        for (RefusedSegment* one : named)
        {
          const std::uint32_t crossed = FindCrossed(view, points, this->Result.Edges, *one);
          const std::int64_t number = this->Points.GetSegments()[crossed].Number;
          one->Crossed = { number, { segments[2 * number], segments[2 * number + 1] } };
        }
      });
  }
  if (ofRing != nullptr)
  {
    const std::int64_t number = ofRing->Refused.Number;
    throw InvalidMesh(
      DescribeRefusal(*ofRing, segments, GetRemedy(this->Points.GetOptions().SplitCrossings)),
      number, segments[2 * number], ofRing->Refused.Ring);
  }
}

//------------------------------------------------------------------------------
void PointRun::CutOff()
{
  if (MayRemove(this->Points.GetInput(), this->Points.GetOptions()))
  {
    this->OnBackend([this](LoadedMesh& mesh) { this->RemoveTriangles(mesh); });
    this->RecordChange(0);
  }
}

/// Removed triangles stay in the loaded mesh, but it leaves them out of what it stores.
void PointRun::RemoveTriangles(LoadedMesh& mesh)
{
  const PointInput& input = this->Points.GetInput();
  PointResult& result = this->Result;
  if (result.WholeEdges.empty())
  {
    result.WholeEdges = result.Edges;
  }
  result.Edges = result.WholeEdges;
  result.Loss = Defect();
  KeptTriangles& kept = result.Kept;
  kept = mesh.CutOff(input, this->Points.GetOptions(), result.Edges);
  if (IsLost(input, kept))
  {
    this->Points.CopyToHost();
    this->Result.Loss = DescribeLoss(this->Points, kept);
  }
}

void PointRun::Reset()
{
  LoadedRun::Reset();
  this->Result = PointResult();
  this->Points.SetRefined(0, {});
  this->Added.clear();
  this->BatchEnds.clear();
  this->AreFlipsSlow = false;
  this->Report.Points = this->Points.GetCaller().Points.Count;
}

void PointRun::ListDefects()
{
  this->OnBackend(
    [this](LoadedMesh& mesh)
    {
      this->Report.Defects = mesh.GetInputReport().Defects;
      this->Report.FromPoints = mesh.GetInputReport().FromPoints;
      this->Report.Edges = mesh.GetInputReport().Edges;
      AddPointsTo(this->Report, mesh, this->Points, this->Result);
    });
  AddDefect(this->FindIdleOptions(), this->Report.Defects);
  if (this->Result.HasReachedLimit)
  {
    AddDefect(this->DescribeLimit(this->Report.FromPoints.Used), this->Report.Defects);
  }
}

//------------------------------------------------------------------------------
namespace
{
/// Does with triangles what StoreOrderedTriangles does with all of them.
void SortTriangles(const MutableTriangleArray& triangles)
{
  const auto sort = [&](auto* ids)
  {
    using Triple = std::array<std::decay_t<decltype(*ids)>, 3>;
    std::vector<Triple> sorted(triangles.Count);
    for (std::int64_t t = 0; t < triangles.Count; ++t)
    {
      auto* const first = ids + 3 * t;
      std::rotate_copy(first, std::min_element(first, first + 3), first + 3, sorted[t].begin());
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::int64_t t = 0; t < triangles.Count; ++t)
    {
      std::copy(sorted[t].begin(), sorted[t].end(), ids + 3 * t);
    }
  };
  if (triangles.Ids32)
  {
    sort(triangles.Ids32);
  }
  else
  {
    sort(triangles.Ids64);
  }
}
}

void PointRun::StoreTriangles(const MutableTriangleArray& triangles)
{
  this->TryOnBackend([&](const LoadedMesh& mesh) { mesh.StoreTriangles(triangles); });
}

void PointRun::StoreOrderedTriangles(const MutableTriangleArray& triangles)
{
  if (this->Result.HasRemoved())
  {
    this->StoreTriangles(triangles);
    SortTriangles(triangles);
    return;
  }
  this->TryOnBackend([&](const LoadedMesh& mesh) { mesh.StoreOrderedTriangles(triangles); });
}

void PointRun::StoreFlipCounts(std::int32_t* counts)
{
  this->TryOnBackend([=](const LoadedMesh& mesh) { mesh.StoreFlipCounts(counts); });
}

void PointRun::StoreNeighbors(std::int32_t* neighbors)
{
  this->TryOnBackend([=](const LoadedMesh& mesh) { mesh.StoreNeighbors(neighbors); });
}

/// Divide and conquer makes other triangles without flips, so all are written.
bool PointRun::StoreTrianglesOnDevice(
  const MutableTriangleArray& triangles, const DeviceStream& stream, std::int32_t*)
{
  return this->TryStoreOnDevice([&](const LoadedMesh& mesh)
    { return mesh.StoreTrianglesOnDevice(triangles, stream, nullptr); });
}

bool PointRun::StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream)
{
  return this->TryStoreOnDevice(
    [&](const LoadedMesh& mesh) { return mesh.StoreFlipCountsOnDevice(counts, stream); });
}

bool PointRun::StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream& stream)
{
  return this->TryStoreOnDevice(
    [&](const LoadedMesh& mesh) { return mesh.StoreNeighborsOnDevice(neighbors, stream); });
}

void PointRun::StoreUsedPoints(std::int64_t* ids)
{
  if (!this->TryOnBackend([&](const LoadedMesh& mesh) { this->Points.StoreUsedPoints(mesh, ids); }))
  {
    std::iota(ids, ids + this->Report.Points, std::int64_t(0));
  }
}

std::vector<std::int64_t> PointRun::ListSegmentEdges()
{
  std::vector<std::int64_t> pairs;
  const auto list = [&](LoadedMesh& mesh)
  {
    std::vector<HalfEdgeId> sides;
    std::vector<bool> areOnLeft;
    for (const SegmentEdge& edge : this->Result.Edges)
    {
      if (edge.IsFirst)
      {
        sides.push_back(edge.Side);
        areOnLeft.push_back(edge.IsOnLeft);
      }
    }
    pairs = mesh.FindEnds(sides);
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      if (!areOnLeft[i])
      {
        std::swap(pairs[2 * i], pairs[2 * i + 1]);
      }
    }
  };
  if (!this->Result.Edges.empty())
  {
    this->TryOnBackend(list);
  }
  return pairs;
}

}
