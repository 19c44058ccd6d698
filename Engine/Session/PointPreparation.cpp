// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointPreparation.h"

#include "Array.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "LoadedMesh.h"
#include "PortableMath.h"
#include "Predicates.h"
#include "RingDirections.h"
#include "Strips.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <array>
#include <map>
#include <type_traits>
#include <unordered_map>
#include <utility>

namespace delaunayflip
{

namespace
{
/// How many points pass between two calls of an observer.
constexpr std::int64_t Batch = 1 << 14;

void Tell(const ProgressObserver& observer)
{
  if (observer && !observer(0.0))
  {
    throw RunAborted();
  }
}

/// Requires an option that is a number to be finite and not negative.
void CheckNumber(const char* name, double number)
{
  if (!(number >= 0.0 && number < INFINITY))
  {
    throw InvalidOptions(ToCamelCase(name) + " must be finite and 0 or more");
  }
}

/// Any other option may have all values of its type.
template <typename Choice>
void CheckNumber(const char*, Choice)
{
}

void CheckInput(const PointInput& input, const PointOptions& options)
{
  ForEachPointOption(
    [](const char* name, const auto& option) { CheckNumber(name, option); }, options);
  CheckRegions(input.Regions, input.NumberOfRegions);
  if (input.Sizes)
  {
    CheckSizes(input.Sizes, input.Points.Count);
  }
  if (options.NumberOfPieces > 1)
  {
    throw InvalidOptions(
      "points cannot be triangulated in several pieces: gather them in one process first");
  }
  CheckSegments(input, 2);
}
}

std::int32_t GetRing(const PointInput& input, std::int64_t segment)
{
  return input.Rings ? input.Rings[segment] : -1;
}

void CheckSegments(const PointInput& input, int seedNumbers)
{
  for (std::int64_t i = 0; i < 2 * input.NumberOfSegments; ++i)
  {
    const std::int64_t point = input.Segments[i];
    if (point < 0 || point >= input.Points.Count)
    {
      std::string name = "segment " + std::to_string(i / 2);
      if (GetRing(input, i / 2) >= 0)
      {
        name = "ring " + std::to_string(GetRing(input, i / 2));
      }
      throw InvalidMesh(name + " names point " + std::to_string(point) + ", but there are " +
          DescribePoints(input.Points.Count),
        i / 2, point, GetRing(input, i / 2));
    }
  }
  for (std::int64_t i = 0; i < seedNumbers * input.NumberOfHoleSeeds; ++i)
  {
    if (!IsFinite(input.HoleSeeds[i]))
    {
      throw InvalidOptions("hole seed " + std::to_string(i / seedNumbers) +
        " has a coordinate that is NaN or infinite");
    }
  }
}

PreparedPoints::PreparedPoints(const PointInput& input, const PointOptions& options)
  : Caller(input),
    Options(options),
    Prepared(input)
{
  CheckInput(input, options);
}

void PreparedPoints::Prepare(const ProgressObserver& observer)
{
  if (this->IsPrepared)
  {
    return;
  }
  const PointInput& input = this->Caller;
  this->Unprepare(); // what a call that was stopped has left
  this->Segments.clear();
  if (this->Options.PointTolerance > 0.0)
  {
    this->CopyToHost();
    this->FindNearPoints(observer);
    this->CopyPoints(); // so that no crossing uses a point that is not used
  }
  for (std::int64_t i = 0; i < input.NumberOfSegments; ++i)
  {
    const std::int64_t* ends = input.Segments + 2 * i;
    this->Segments.push_back(
      { this->GetNear(ends[0]), this->GetNear(ends[1]), GetRing(input, i), i });
  }
  const CrossingsCaller caller{ [this](std::int64_t count, const auto& work)
    { ThreadBackend(this->Options.NumberOfThreads).ForTasks(count, work); },
    [&] { Tell(observer); } };
  if (this->Options.SplitCrossings && !this->Segments.empty())
  {
    SplitSegments split = SplitCrossings(this->CopyToHost(), std::move(this->Segments), caller);
    this->Segments = std::move(split.Segments);
    this->Added = std::move(split.Added);
    CheckPointCount(input.Points.Count + SizeOf(this->Added));
    this->Counts.Crossings = SizeOf(this->Added);
    this->Counts.LargestShift = split.LargestShift;
    this->CopyPoints();
  }
  if (this->WantsRefinement() && !this->Segments.empty())
  {
    this->Segments = SplitAtNearPoints(this->CopyToHost(), std::move(this->Segments), caller);
  }
  this->IsPrepared = true;
}

bool PreparedPoints::WantsRefinement() const
{
  const PointInput& input = this->Caller;
  return HasGoals(this->Options) || input.Sizes != nullptr ||
    HasAreas(input.Regions, input.NumberOfRegions);
}

/// Drops what Prepare has made, and keeps what the caller has given.
void PreparedPoints::Unprepare()
{
  this->Prepared = this->Caller;
  this->NearPoint.clear();
  this->Added.clear();
  this->SetRefined(0, {});
  this->Counts = PointCounts();
  this->IsPrepared = false;
}

void PreparedPoints::Exchange(PointPlaces& places)
{
  std::swap(this->Caller.Points, places.Points);
  std::swap(this->Caller.OnDevice, places.OnDevice);
  std::swap(this->Caller.Stream, places.Stream);
  this->CallerFloats.swap(places.Floats);
  this->CallerDoubles.swap(places.Doubles);
  this->Unprepare();
}

void PreparedPoints::CopyPlaces(PointPlaces& places) const
{
  std::vector<float> floats;
  std::vector<double> doubles;
  const PlaneArray from = this->CopyCaller(floats, doubles);
  const auto copy = [&](auto& coordinates)
  {
    coordinates.resize(2 * from.Count);
    CopyCoordinates(from, coordinates.data());
    places.Points = PlaneArray(coordinates.data(), from.Count, 2);
  };
  if (from.Floats)
  {
    copy(places.Floats);
  }
  else
  {
    copy(places.Doubles);
  }
  places.OnDevice = false;
}

void PreparedPoints::TakeOver()
{
  this->Unprepare();
  const PlaneArray before = this->CopyToHost();
  const auto copy = [&](auto& coordinates)
  {
    using Real = typename std::decay_t<decltype(coordinates)>::value_type;
    const void* const own = coordinates.data();
    if (before.Count > 0 && own == before.Data())
    {
      return;
    }
    std::vector<Real> all(2 * before.Count);
    CopyCoordinates(before, all.data());
    coordinates = std::move(all);
    this->Caller.Points = PlaneArray(coordinates.data(), before.Count, 2);
  };
  if (before.Floats)
  {
    copy(this->CallerFloats);
  }
  else
  {
    copy(this->CallerDoubles);
  }
  this->Caller.OnDevice = false;
  this->Prepared = this->Caller;
}

void PreparedPoints::ExchangeSome(
  const std::vector<VertexId>& points, std::vector<std::array<double, 2>>& places)
{
  const auto exchange = [&](auto& coordinates)
  {
    using Real = typename std::decay_t<decltype(coordinates)>::value_type;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      auto* const place = &coordinates[std::size_t(2) * points[i]];
      const std::array<double, 2> before = { place[0], place[1] };
      place[0] = static_cast<Real>(places[i][0]);
      place[1] = static_cast<Real>(places[i][1]);
      places[i] = before;
    }
  };
  if (this->Caller.Points.Floats)
  {
    exchange(this->CallerFloats);
  }
  else
  {
    exchange(this->CallerDoubles);
  }
  this->Unprepare();
}

void PreparedPoints::Append(const PlaneArray& points)
{
  this->TakeOver();
  const std::int64_t all = this->Caller.Points.Count + points.Count;
  const auto append = [&](auto& coordinates)
  {
    coordinates.resize(2 * this->Caller.Points.Count); // there may be room for more
    const std::size_t size = 2 * static_cast<std::size_t>(all);
    if (coordinates.capacity() < size)
    {
      coordinates.reserve(
        std::max(size, 2 * coordinates.capacity())); // may throw, what follows not
    }
    coordinates.resize(size);
    CopyCoordinates(points, coordinates.data() + 2 * this->Caller.Points.Count);
    this->Caller.Points = PlaneArray(coordinates.data(), all, 2);
  };
  if (this->Caller.Points.Floats)
  {
    append(this->CallerFloats);
  }
  else
  {
    append(this->CallerDoubles);
  }
  this->Prepared = this->Caller;
}

void PreparedPoints::SetRefined(std::int64_t count, std::vector<std::int64_t> segmentOf)
{
  this->Refined = count;
  this->SegmentOfOrigin = std::move(segmentOf);
}

AddedPoint ToAddedPoint(const RefinedVertex& vertex)
{
  AddedPoint point;
  point.X = vertex.U;
  point.Y = vertex.V;
  point.From = vertex.Points[0];
  point.To = vertex.Points[1];
  point.Share = vertex.Weights[1];
  if (vertex.Origin == NoOrigin)
  {
    point.Third = vertex.Points[2];
    point.ThirdShare = vertex.Weights[2];
  }
  return point;
}

AddedPoint PreparedPoints::Describe(const RefinedVertex& vertex) const
{
  AddedPoint point = ToAddedPoint(vertex);
  if (vertex.Origin != NoOrigin)
  {
    point.Segment = this->SegmentOfOrigin[vertex.Origin];
  }
  return point;
}

std::vector<double> PreparedPoints::ListSizes() const
{
  const double* given = this->Caller.Sizes;
  std::vector<double> sizes(given, given + this->Caller.Points.Count);
  for (std::int64_t i = 0; i < this->Counts.Crossings; ++i)
  {
    const AddedPoint& point = this->Added[i];
    sizes.push_back((1.0 - point.Share) * sizes[point.From] + point.Share * sizes[point.To]);
  }
  return sizes;
}

PlaneArray PreparedPoints::CopyToHost()
{
  if (this->Prepared.OnDevice)
  {
    this->Prepared.Points = this->CopyCaller(this->Floats, this->Doubles);
    this->Prepared.OnDevice = false;
  }
  return this->Prepared.Points;
}

/// The caller's points in the host's memory. @param floats, doubles one of them receives a copy of
/// points that are on a GPU.
PlaneArray PreparedPoints::CopyCaller(
  std::vector<float>& floats, std::vector<double>& doubles) const
{
  const PlaneArray& points = this->Caller.Points;
  if (!this->Caller.OnDevice)
  {
    return points;
  }
  std::int64_t numbers = 0;
  if (points.Count > 0)
  {
    numbers = (points.Count - 1) * points.Stride + 2;
  }
  const auto copy = [&](const auto* values, auto& copied)
  {
    copied.resize(numbers);
    CopyMemory(values, numbers * static_cast<std::int64_t>(sizeof(*values)), copied.data(),
      this->Caller.Stream);
    return PlaneArray(copied.data(), points.Count, points.Stride);
  };
  return points.Floats ? copy(points.Floats, floats) : copy(points.Doubles, doubles);
}

/// Finds for every point the one that is used instead of it: the first with a lower id that is used
/// and nearer than the tolerance, but not at the same place, because these are merged anyway. A
/// grid of cells as wide as the tolerance limits the search.
void PreparedPoints::FindNearPoints(const ProgressObserver& observer)
{
  const PlaneArray points = this->Prepared.Points;
  const double tolerance = this->Options.PointTolerance;
  struct Hash
  {
    std::size_t operator()(const std::pair<double, double>& cell) const
    {
      return std::hash<double>()(cell.first) * 0x9E3779B97F4A7C15u +
        std::hash<double>()(cell.second);
    }
  };
  std::unordered_map<std::pair<double, double>, std::int64_t, Hash> lastIn; // used point of a cell
  std::vector<std::int64_t> before(points.Count, -1); // the used point of the same cell before
  std::vector<std::int64_t> nearPoint(points.Count);
  std::int64_t tooNear = 0;
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    if (i % Batch == 0)
    {
      Tell(observer);
    }
    nearPoint[i] = i;
    if (!IsFinitePoint(points, i))
    {
      continue;
    }
    // Beyond 2^53 cells from 0 all other doubles are farther away than the tolerance.
    const auto findCell = [&](double value)
    {
      const double cell = std::floor(value / tolerance);
      return std::fabs(cell) < 0x1p53 ? cell : value;
    };
    const double x = points.Get(i, 0), y = points.Get(i, 1);
    const double column = findCell(x), row = findCell(y);
    for (int cell = 0; cell < 9; ++cell)
    {
      const auto found = lastIn.find({ column + (cell % 3 - 1), row + (cell / 3 - 1) });
      if (found == lastIn.end())
      {
        continue;
      }
      for (std::int64_t j = found->second; j >= 0; j = before[j])
      {
        if (PlaneLength(points.Get(j, 0) - x, points.Get(j, 1) - y) < tolerance)
        {
          nearPoint[i] = std::min(nearPoint[i], j);
        }
      }
    }
    if (nearPoint[i] == i)
    {
      std::int64_t& last = lastIn.emplace(std::pair(column, row), -1).first->second;
      before[i] = std::exchange(last, i);
    }
    else if (points.Get(nearPoint[i], 0) == x && points.Get(nearPoint[i], 1) == y)
    {
      nearPoint[i] = i;
    }
    else
    {
      ++tooNear;
    }
  }
  this->NearPoint = std::move(nearPoint);
  this->Counts.TooNear = tooNear;
}

/// Makes the points to triangulate, if they are not those of the caller.
void PreparedPoints::CopyPoints()
{
  if (this->Added.empty() && this->Counts.TooNear == 0)
  {
    return;
  }
  if (this->Caller.Points.Floats)
  {
    this->CopyUsed(this->Floats);
  }
  else
  {
    this->CopyUsed(this->Doubles);
  }
}

/// Points that are too near become NaN, so that they are not used.
template <typename Real>
void PreparedPoints::CopyUsed(std::vector<Real>& copy)
{
  const PlaneArray points = this->Prepared.Points;
  const auto added = SizeOf(this->Added);
  std::vector<Real> made(2 * (points.Count + added));
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    made[2 * i] = this->IsNear(i) ? NAN : static_cast<Real>(points.Get(i, 0));
    made[2 * i + 1] = static_cast<Real>(points.Get(i, 1));
  }
  for (std::int64_t i = 0; i < added; ++i)
  {
    made[2 * (points.Count + i)] = static_cast<Real>(this->Added[i].X);
    made[2 * (points.Count + i) + 1] = static_cast<Real>(this->Added[i].Y);
  }
  copy = std::move(made);
  this->Prepared.Points = PlaneArray(copy.data(), points.Count + added, 2);
}

//------------------------------------------------------------------------------
void PreparedPoints::PrepareRings(const LoadedMesh& mesh)
{
  if (!this->Prepared.Rings)
  {
    return;
  }
  std::vector<std::int64_t> used(this->Prepared.Points.Count);
  mesh.StoreUsedPoints(0, SizeOf(used), used.data());
  this->LeftOutRings.clear();
  std::map<std::int32_t, std::vector<std::size_t>> rings; // by their numbers, indices of segments
  for (std::int64_t i = 0; i < this->Prepared.NumberOfSegments; ++i)
  {
    if (this->Prepared.Rings[i] >= 0)
    {
      rings[this->Prepared.Rings[i]]; // stays empty for a ring at a single place
    }
  }
  for (std::size_t i = 0; i < this->Segments.size(); ++i)
  {
    if (this->Segments[i].Ring >= 0)
    {
      rings[this->Segments[i].Ring].push_back(i);
    }
  }
  for (const auto& [number, ring] : rings)
  {
    if (this->MayHaveArea(ring, used))
    {
      TurnSegments(ring, used, this->Segments);
      continue;
    }
    this->LeftOutRings.push_back(number);
    for (const std::size_t i : ring)
    {
      this->Segments[i].Ring = -1;
    }
  }
}

/// Whether a ring has a place that is not finite, or three places that are not on one line.
/// @param used by point the one that is used at its place. @param ring indices of its segments.
bool PreparedPoints::MayHaveArea(
  const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used)
{
  const PlaneArray points = this->CopyToHost();
  std::vector<std::array<double, 2>> line; // two places of the ring
  for (const std::size_t i : ring)
  {
    for (const std::int64_t point : { this->Segments[i].From, this->Segments[i].To })
    {
      const std::array<double, 2> place = { points.Get(point, 0), points.Get(point, 1) };
      const bool isOff =
        line.size() == 2 && Orientation(line[0].data(), line[1].data(), place.data()) != 0;
      if (used[point] < 0 || isOff)
      {
        return true;
      }
      if (line.empty() || (line.size() == 1 && line[0] != place))
      {
        line.push_back(place);
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void PreparedPoints::StoreUsedPoints(const LoadedMesh& mesh, std::int64_t* ids) const
{
  if (this->CountAll() == this->Caller.Points.Count && this->NearPoint.empty())
  {
    mesh.StoreUsedPoints(0, this->CountAll(), ids);
    return;
  }
  std::vector<std::int64_t> used(this->CountAll());
  mesh.StoreUsedPoints(0, SizeOf(used), used.data());
  for (std::int64_t i = 0; i < this->Caller.Points.Count; ++i)
  {
    ids[i] = used[this->GetNear(i)];
  }
}

}
