// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "Array.h"
#include "CallerMesh.h"
#include "FlipError.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// How the run of points moves and removes them.

namespace delaunayflip
{
namespace
{

/// @throws InvalidOptions.
void CheckIds(const std::int64_t* ids, std::int64_t count, std::int64_t points)
{
  const auto* const wrong =
    std::find_if(ids, ids + count, [=](std::int64_t id) { return id < 0 || id >= points; });
  if (wrong != ids + count)
  {
    throw InvalidOptions(
      "point " + std::to_string(*wrong) + " does not exist; there are " + Count(points, "point"));
  }
}

/// Lists each of some ids once, in ascending order. Bits take less time than a sort of 10,000 ids.
/// @param points how many there are, more than any id.
std::vector<VertexId> ListOnce(const std::int64_t* ids, std::int64_t count, std::int64_t points)
{
  constexpr int BitsOfWord = 64;
  std::vector<std::uint64_t> words(points / BitsOfWord + 1);
  for (std::int64_t i = 0; i < count; ++i)
  {
    words[ids[i] / BitsOfWord] |= std::uint64_t(1) << (ids[i] % BitsOfWord);
  }
  std::vector<VertexId> once;
  once.reserve(count);
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    for (std::uint64_t word = words[i]; word != 0; word &= word - 1)
    {
      once.push_back(static_cast<VertexId>(BitsOfWord * i + __builtin_ctzll(word)));
    }
  }
  return once;
}

/// Sets x and y of a point.
void SetPlace(PointPlaces& places, std::int64_t point, double x, double y)
{
  const auto set = [&](auto& coordinates)
  {
    using Real = typename std::decay_t<decltype(coordinates)>::value_type;
    coordinates[2 * point] = static_cast<Real>(x);
    coordinates[2 * point + 1] = static_cast<Real>(y);
  };
  if (places.Points.Floats)
  {
    set(places.Floats);
  }
  else
  {
    set(places.Doubles);
  }
}

/// Copies x and y of places into an array that the run owns.
template <typename Real>
void CopyInto(const PlaneArray& from, std::vector<Real>& coordinates, PointPlaces& places,
  const ThreadBackend& threads)
{
  coordinates.resize(2 * from.Count);
  threads.ForRange(from.Count,
    [&](std::int64_t begin, std::int64_t end)
    { CopyCoordinates(from, begin, end, coordinates.data()); });
  places.Points = PlaneArray(coordinates.data(), from.Count, 2);
}

}

bool PointRun::Move(const PointMove& move, const ProgressObserver& progress)
{
  const std::int64_t points = this->Points.GetCaller().Points.Count;
  if (!move.Ids && move.Points.Count != points)
  {
    throw InvalidOptions("there are " + Count(points, "point") + " to move, but places for " +
      Count(move.Points.Count, "point"));
  }
  if (move.Ids)
  {
    CheckIds(move.Ids, move.Points.Count, points);
  }
  if (progress && !progress(0.0))
  {
    return false;
  }
  this->ReadPlaces(move);
  return this->GoToPlaces(this->Points.GetRemoved(), progress);
}

bool PointRun::Remove(const std::int64_t* ids, std::int64_t count, const ProgressObserver& progress)
{
  CheckIds(ids, count, this->Points.GetCaller().Points.Count);
  if (progress && !progress(0.0))
  {
    return false;
  }
  const std::vector<std::int64_t>& before = this->Points.GetRemoved();
  std::vector<VertexId> added = ListOnce(ids, count, this->Points.GetCaller().Points.Count);
  added.erase(std::remove_if(added.begin(), added.end(),
                [this](VertexId id) { return this->Points.IsRemoved(id); }),
    added.end());
  std::vector<std::int64_t> removed(before.size() + added.size());
  std::merge(before.begin(), before.end(), added.begin(), added.end(), removed.begin());
  const std::array<double, 2> nowhere = { NAN, NAN };
  std::vector<std::array<double, 2>> places(added.size(), nowhere);
  // Made now, because a function may take memory, and from the exchange on nothing may throw but
  // what Follow catches.
  const InPlaceChange change = [&](const BuildProgress&) { return this->RemoveInPlace(added); };
  const std::function<void()> exchange = [&] { this->Points.ExchangeSome(added, places); };
  try
  {
    this->Points.TakeOver();
  }
  catch (...)
  {
    this->Reset(); // the points may no longer be prepared
    throw;
  }
  exchange();
  return this->Follow(std::move(removed), change, exchange, progress);
}

bool PointRun::Compact(const ProgressObserver& progress)
{
  const PointInput& caller = this->Points.GetCaller();
  const bool namesPoints = caller.NumberOfSegments > 0 || caller.Sizes != nullptr;
  if (namesPoints)
  {
    throw InvalidOptions("points cannot get other numbers, because segments or sizes name them");
  }
  if (progress && !progress(0.0))
  {
    return false;
  }
  this->Points.CopyPlaces(this->Places);
  const PlaneArray all = this->Places.Points;
  std::int64_t kept = 0;
  for (std::int64_t i = 0; i < all.Count; ++i)
  {
    if (!this->Points.IsRemoved(i))
    {
      SetPlace(this->Places, kept++, all.Get(i, 0), all.Get(i, 1));
    }
  }
  this->Places.Points.Count = kept;
  return this->GoToPlaces({}, progress);
}

/// Reads the new places of all points into this->Places.
void PointRun::ReadPlaces(const PointMove& move)
{
  const PlaneArray& now = this->Points.GetCaller().Points;
  PointPlaces& places = this->Places;
  const bool staysThere =
    move.OnDevice && !move.Ids && this->Points.GetRemoved().empty() && move.Points.Count > 0;
  if (move.OnDevice)
  {
    const bool isSame = (move.Points.Floats == nullptr) == (now.Floats == nullptr);
    if (!staysThere || !isSame)
    {
      throw InvalidOptions(
        "places in the memory of a GPU must be those of all points, in the type of their "
        "coordinates; if points were removed, compact the triangulation first");
    }
    RequireOnDevice(move.Points.Data(), move.Points.Count, "the places are");
    places.Points = move.Points;
    places.OnDevice = true;
    places.Stream = move.Stream;
    return;
  }
  if (move.Ids)
  {
    this->Points.CopyPlaces(places);
    for (std::int64_t i = 0; i < move.Points.Count; ++i)
    {
      SetPlace(places, move.Ids[i], move.Points.Get(i, 0), move.Points.Get(i, 1));
    }
  }
  else if (now.Floats)
  {
    CopyInto(move.Points, places.Floats, places, ThreadBackend(this->Options.NumberOfThreads));
  }
  else
  {
    CopyInto(move.Points, places.Doubles, places, ThreadBackend(this->Options.NumberOfThreads));
  }
  places.OnDevice = false;
  for (const std::int64_t id : this->Points.GetRemoved())
  {
    SetPlace(places, id, NAN, NAN);
  }
}

/// Moves all points to this->Places. @param removed the ids of all removed points.
bool PointRun::GoToPlaces(std::vector<std::int64_t> removed, const ProgressObserver& progress)
{
  const bool keepsNumbers = this->Places.Points.Count == this->Points.GetCaller().Points.Count;
  const InPlaceChange change = [&](const BuildProgress& told)
  { return keepsNumbers && this->MoveInPlace(told); };
  const std::function<void()> exchange = [&] { this->Points.Exchange(this->Places); };
  exchange();
  return this->Follow(std::move(removed), change, exchange, progress);
}

/// Makes the triangulation that of points that have other places.
/// @param removed the ids of all removed points.
/// @param change tries to change the mesh in place, and returns whether it could.
/// @param goBack lets the points be where they were.
bool PointRun::Follow(std::vector<std::int64_t> removed, const InPlaceChange& change,
  const std::function<void()>& goBack, const ProgressObserver& progress)
{
  std::vector<std::int64_t> removedBefore = this->Points.SetRemoved(std::move(removed));
  const auto reset = [&]
  {
    goBack();
    this->Points.SetRemoved(std::move(removedBefore));
    this->Reset();
  };
  try
  {
    double share = 0.0; // of the progress that was told
    const auto tell = [&](double next)
    {
      share = next;
      return !progress || progress(next);
    };
    bool isStopped = false;
    if (this->IsDelaunay() && this->MaySegmentsStay())
    {
      if (change(BuildProgress(tell)))
      {
        return true;
      }
      isStopped = this->Report.StopReason == StopReasonKind::Aborted;
    }
    if (!isStopped)
    {
      this->Reset();
      const auto tellRest = [&, begin = share](double part)
      { return tell(begin + (1.0 - begin) * part); };
      this->Advance(-1, {}, progress ? ProgressObserver(tellRest) : ProgressObserver());
    }
  }
  catch (...)
  {
    reset();
    throw;
  }
  const bool isThere = this->Report.StopReason != StopReasonKind::Aborted;
  if (!isThere)
  {
    reset();
    this->Advance(-1, {}, {});
  }
  return isThere;
}

/// @returns false if the points have to be triangulated anew, or an observer has stopped it.
bool PointRun::MoveInPlace(const BuildProgress& progress)
{
  return this->ChangeInPlace(
    [&](LoadedMesh& mesh)
    {
      const SegmentPins& pins = this->Result.Pins;
      const bool stay = !pins.HasBetween() || pins.AreStraight(this->Points.CopyToHost());
      if (!stay)
      {
        return MotionResult();
      }
      PointInput targets = this->Points.GetInput();
      if (targets.OnDevice && !mesh.HasMemory(targets.Points.Data()))
      {
        targets.Points = this->Points.CopyToHost();
        targets.OnDevice = false;
      }
      return mesh.MovePoints(targets, pins.GetEdges(), progress);
    });
}

/// Removes points. @param ids ascending.
/// @returns false if the points have to be triangulated anew.
bool PointRun::RemoveInPlace(const std::vector<VertexId>& ids)
{
  return this->AreFew(SizeOf(ids)) &&
    this->ChangeInPlace(
      [&](LoadedMesh& mesh)
      {
        const SegmentPins& pins = this->Result.Pins;
        return pins.HavePoint(ids) ? MotionResult() : mesh.RemovePoints(ids, pins.GetEdges());
      });
}

//------------------------------------------------------------------------------
// Segments.

/// Whether no segment is refused because it crosses another one. If no edge of a segment is lost in
/// a motion, none is refused after it.
bool PointRun::MaySegmentsStay()
{
  this->Points.Prepare(this->Observer);
  const PointResult& result = this->Result;
  const bool haveCrossed = std::any_of(result.Refused.begin(), result.Refused.end(),
    [](const RefusedSegment& refused)
    { return refused.Why != RefusalKind::NotFinite && refused.Why != RefusalKind::Removed; });
  return !haveCrossed;
}

void PointRun::ListPins(LoadedMesh& mesh)
{
  PointResult& result = this->Result;
  const bool isListed = result.Pins.AreListed() || this->Points.GetCaller().NumberOfSegments == 0;
  if (!isListed)
  {
    const std::vector<SegmentEdge>& edges = result.GetAllEdges();
    std::vector<HalfEdgeId> sides(edges.size());
    std::transform(
      edges.begin(), edges.end(), sides.begin(), [](const SegmentEdge& edge) { return edge.Side; });
    result.Pins.List(edges, mesh.FindEnds(sides), this->Points.GetSegments());
  }
}

/// Finds the triangles that are removed, and the regions.
void PointRun::JudgeTriangles(LoadedMesh& mesh)
{
  if (MayRemove(this->Points.GetInput(), this->Points.GetOptions()))
  {
    this->RemoveTriangles(mesh);
  }
  if (this->Points.GetCaller().NumberOfRegions > 0)
  {
    this->LabelRegions(mesh);
  }
}

/// Finds the triangles that are removed, and the regions, again after a motion.
/// @returns false if rings have got or lost an area.
bool PointRun::JudgeAgain(const MotionResult& motion)
{
  PointResult& result = this->Result;
  result.Pins.Renumber(motion.Edges, result.GetAllEdges());
  const std::vector<std::int32_t> leftOut = this->Points.GetLeftOutRings();
  bool isSame = false;
  this->OnBackend(
    [&](LoadedMesh& mesh)
    {
      this->Points.PrepareRings(mesh);
      isSame = leftOut == this->Points.GetLeftOutRings();
      if (isSame)
      {
        this->JudgeTriangles(mesh);
      }
    });
  return isSame;
}

/// Makes the mesh of all points on another backend.
void PointRun::RepeatAll(LoadedMesh& mesh)
{
  mesh.GetLoop().Converge();
  const std::vector<Segment>& segments = this->Points.GetSegments();
  if (!segments.empty())
  {
    this->InsertUpTo(segments.size(), mesh, {});
    mesh.GetLoop().Converge();
  }
  this->JudgeTriangles(mesh);
}

//------------------------------------------------------------------------------

/// Changes the loaded mesh in place.
/// @returns false if the points have to be triangulated anew.
template <typename Change>
bool PointRun::ChangeInPlace(const Change& change)
{
  if (this->Points.GetOptions().MaximumIterations >= 0)
  {
    return false;
  }
  const StopWatch watch;
  this->BatchEnds.clear();
  this->Journal = { { this->Stages.size() - 1, AllPoints } };
  MotionResult motion;
  const bool isLoaded = this->TryOnBackend(
    [&](LoadedMesh& mesh)
    {
      this->ListPins(mesh);
      motion = change(mesh);
    });
  if (!isLoaded || !motion.IsThere || !this->JudgeAgain(motion))
  {
    return false;
  }
  this->RecordMotion(motion);
  this->Report.FlipSeconds = watch.GetSeconds();
  return true;
}

/// Makes the report that of a motion, a removal or an insertion alone.
void PointRun::RecordMotion(const MotionResult& motion)
{
  FlipReport& report = this->Report;
  const FlipReport& made = this->Loaded->GetInputReport();
  report.Triangles = made.Triangles;
  report.EulerCharacteristic = made.EulerCharacteristic;
  report.Iterations.clear();
  report.TotalFlips = motion.Flips;
  report.TotalExcluded = 0;
  report.TotalBlocked = 0;
  report.NonDelaunayBefore = 0;
  report.BuildSeconds = 0.0;
  this->Result.MoveRounds = motion.Rounds;
  this->Result.Flips = 0;
  this->AreAnglesKnown = false;
  this->AreKeptEdgesKnown = false;
  this->RecordFound(this->Loaded->GetLoop().GetFound());
  this->ListDefects();
}

}
