// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "Array.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "Predicates.h"
#include "SmallestAngle.h"
#include "Strips.h"

#include <array>
#include <map>
#include <set>
#include <unordered_map>

namespace delaunayflip
{

namespace
{
/// How many points or segments pass between two calls of an observer.
constexpr std::int64_t Batch = 1 << 14;

void Tell(const ProgressObserver& observer)
{
  if (observer && !observer(0.0))
  {
    throw RunAborted();
  }
}

void CheckInput(const PointInput& input, const PointOptions& options)
{
  for (const double length : { options.PointTolerance, options.Alpha, options.LongestEdge })
  {
    if (!(length >= 0.0 && length < INFINITY))
    {
      throw InvalidOptions(
        "the point tolerance, alpha and the longest edge must be finite and 0 or more");
    }
  }
  if (options.NumberOfPieces > 1)
  {
    throw InvalidOptions(
      "points cannot be triangulated in several pieces: gather them in one process first");
  }
  for (std::int64_t i = 0; i < 2 * input.NumberOfSegments; ++i)
  {
    const std::int64_t point = input.Segments[i];
    if (point < 0 || point >= input.Points.Count)
    {
      const std::int32_t ring = input.Rings ? input.Rings[i / 2] : -1;
      throw InvalidMesh((ring < 0 ? "segment " : "ring ") +
          std::to_string(ring < 0 ? i / 2 : ring) + " names point " + std::to_string(point) +
          ", but there are " + DescribePoints(input.Points.Count),
        i / 2, point);
    }
  }
  for (std::int64_t i = 0; i < 2 * input.NumberOfHoleSeeds; ++i)
  {
    if (!IsFinite(input.HoleSeeds[i]))
    {
      throw InvalidOptions(
        "hole seed " + std::to_string(i / 2) + " has a coordinate that is NaN or infinite");
    }
  }
}

/// A box around places.
struct CoordinateBox
{
  double Low[2] = { INFINITY, INFINITY };
  double High[2] = { -INFINITY, -INFINITY };

  void Add(double x, double y)
  {
    if (IsFinite(x) && IsFinite(y))
    {
      this->Low[0] = std::min(this->Low[0], x);
      this->Low[1] = std::min(this->Low[1], y);
      this->High[0] = std::max(this->High[0], x);
      this->High[1] = std::max(this->High[1], y);
    }
  }

  std::string Describe() const
  {
    constexpr int Digits = 10; // of a map's coordinates, down to millimetres
    const auto format = [](double value) { return FormatNumber(value, Digits); };
    return "x " + format(this->Low[0]) + " to " + format(this->High[0]) + ", y " +
      format(this->Low[1]) + " to " + format(this->High[1]);
  }
};
}

PointRun::PointRun(const PointInput& input, const PointOptions& options)
  : Caller(input),
    Options(options),
    Prepared(input)
{
  CheckInput(input, options);
}

void PointRun::Prepare(const ProgressObserver& observer)
{
  if (this->IsPrepared)
  {
    return;
  }
  const PointInput& input = this->Caller;
  this->Segments.clear();
  if (this->Options.PointTolerance > 0.0 && this->NearPoint.empty())
  {
    this->GetOnHost();
    this->FindNearPoints(observer);
    this->CopyPoints(); // so that no crossing uses a point that is not used
  }
  for (std::int64_t i = 0; i < input.NumberOfSegments; ++i)
  {
    const std::int64_t* ends = input.Segments + 2 * i;
    const std::int32_t ring = input.Rings ? input.Rings[i] : -1;
    const bool merges = !this->NearPoint.empty();
    this->Segments.push_back({ merges ? this->NearPoint[ends[0]] : ends[0],
      merges ? this->NearPoint[ends[1]] : ends[1], ring, i });
  }
  if (this->Options.SplitCrossings && !this->Segments.empty())
  {
    SplitSegments split =
      SplitCrossings(this->GetOnHost(), std::move(this->Segments), [&] { Tell(observer); });
    this->Segments = std::move(split.Segments);
    this->Added = std::move(split.Added);
    const std::int64_t points = input.Points.Count + SizeOf(this->Added);
    CheckMeshSize(2 * points, points, "");
    this->Counts.Crossings = SizeOf(this->Added);
    this->Counts.LargestShift = split.LargestShift;
    this->CopyPoints();
  }
  this->IsPrepared = true;
}

void PointRun::Reset()
{
  this->Inserted = false;
  this->Taken = 0;
  this->Flips = 0;
  this->Edges.clear();
  this->Seen.clear();
  this->Refused.clear();
  this->Kept = KeptTriangles();
  this->Loss = Defect();
}

/// Copies the coordinates from a GPU, if they are there.
PlaneArray PointRun::GetOnHost()
{
  if (this->Prepared.OnDevice)
  {
    const PlaneArray& points = this->Caller.Points;
    const std::int64_t numbers = points.Count > 0 ? (points.Count - 1) * points.Stride + 2 : 0;
    const auto copy = [&](const auto* values, auto& copied)
    {
      copied.resize(numbers);
      CopyMemory(values, numbers * static_cast<std::int64_t>(sizeof(*values)), copied.data(),
        this->Caller.Stream);
      return PlaneArray(copied.data(), points.Count, points.Stride);
    };
    this->Prepared.Points =
      points.Floats ? copy(points.Floats, this->Floats) : copy(points.Doubles, this->Doubles);
    this->Prepared.OnDevice = false;
  }
  return this->Prepared.Points;
}

/// Finds for every point the one that is used instead of it: the first with a lower id that is used
/// and nearer than the tolerance, but not at the same place, because these are merged anyway. A
/// grid of cells as wide as the tolerance limits the search.
void PointRun::FindNearPoints(const ProgressObserver& observer)
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
      for (std::int64_t j = found == lastIn.end() ? -1 : found->second; j >= 0; j = before[j])
      {
        if (std::hypot(points.Get(j, 0) - x, points.Get(j, 1) - y) < tolerance)
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
void PointRun::CopyPoints()
{
  if (!this->Added.empty() || this->Counts.TooNear > 0)
  {
    this->Caller.Points.Floats ? this->CopyCoordinates(this->Floats)
                               : this->CopyCoordinates(this->Doubles);
  }
}

/// Points that are too near become NaN, so that they are not used.
template <typename Real>
void PointRun::CopyCoordinates(std::vector<Real>& copy)
{
  const PlaneArray points = this->Prepared.Points;
  const auto added = SizeOf(this->Added);
  std::vector<Real> made(2 * (points.Count + added));
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    const bool isUsed = this->NearPoint.empty() || this->NearPoint[i] == i;
    made[2 * i] = static_cast<Real>(isUsed ? points.Get(i, 0) : NAN);
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
/// Leaves out rings without an area: their segments become segments of no ring. Turns those of the
/// others to one direction.
/// @throws InvalidMesh if one of the others is not closed.
void PointRun::PrepareRings(const LoadedMesh& mesh)
{
  if (!this->Prepared.Rings)
  {
    return;
  }
  std::vector<std::int64_t> used(this->Prepared.Points.Count);
  mesh.StoreUsedPoints(used.data());
  this->LeftOutRings.clear();
  std::map<std::int32_t, std::vector<std::size_t>> rings; // by their numbers, indices of segments
  for (std::int64_t i = 0; i < this->Prepared.NumberOfSegments; ++i)
  {
    if (this->Prepared.Rings[i] >= 0)
    {
      rings[this->Prepared.Rings[i]]; // of some nothing is left, such as of one at a single place
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
      this->TurnSegments(ring, used);
      continue;
    }
    this->LeftOutRings.push_back(number);
    for (const std::size_t i : ring)
    {
      this->Segments[i].Ring = -1;
    }
  }
}

/// Whether the places of a ring are not on one line. True if one is not finite.
/// @param used by point the one that is used at its place. @param ring indices of its segments.
bool PointRun::MayHaveArea(
  const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used)
{
  const PlaneArray points = this->GetOnHost();
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

/// Turns segments of a ring so that as many begin as end at each place.
/// @throws InvalidMesh if it is not closed.
void PointRun::TurnSegments(
  const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used)
{
  std::map<std::int64_t, std::int64_t> surplus; // by place, the ends minus the beginnings there
  std::map<std::int64_t, std::vector<std::size_t>> waiting; // by place, its segments
  for (const std::size_t i : ring)
  {
    const Segment& segment = this->Segments[i];
    const std::int64_t from = used[segment.From], to = used[segment.To];
    surplus[from] -= 1;
    surplus[to] += 1;
    if (from != to)
    {
      waiting[from].push_back(i);
      waiting[to].push_back(i);
    }
  }
  for (const std::size_t i : ring)
  {
    const Segment& segment = this->Segments[i];
    for (const std::int64_t point : { segment.From, segment.To })
    {
      if (waiting[used[point]].size() % 2 != 0)
      {
        throw InvalidMesh("ring " + std::to_string(segment.Ring) + " is not closed at point " +
            std::to_string(point) + ": close it, or make its segments part of no ring",
          segment.Number, point);
      }
    }
  }
  if (std::all_of(
        surplus.begin(), surplus.end(), [](const auto& item) { return item.second == 0; }))
  {
    return;
  }
  for (auto& [place, segments] : waiting)
  {
    std::reverse(segments.begin(), segments.end()); // the first ones are taken first
  }
  std::set<std::size_t> taken;
  for (const std::size_t first : ring)
  {
    std::int64_t place = used[this->Segments[first].From];
    waiting[place].push_back(first);
    for (std::vector<std::size_t>* here = &waiting[place]; !here->empty(); here = &waiting[place])
    {
      const std::size_t i = here->back();
      here->pop_back();
      if (taken.insert(i).second)
      {
        Segment& segment = this->Segments[i];
        if (used[segment.From] != place)
        {
          std::swap(segment.From, segment.To);
        }
        place = used[segment.To];
      }
    }
  }
}

/// Finds out why segments are refused, and what those cross that messages name.
/// @throws InvalidMesh if one is of a ring.
void PointRun::ExplainRefused(LoadedMesh& mesh)
{
  std::sort(this->Refused.begin(), this->Refused.end(),
    [](const RefusedSegment& a, const RefusedSegment& b) { return a.Index < b.Index; });
  const bool hasTriangles = mesh.GetInputReport().Triangles > 0;
  const PlaneArray points = this->GetOnHost();
  std::vector<RefusedSegment*> named;
  RefusedSegment* ofRing = nullptr;
  for (RefusedSegment& one : this->Refused)
  {
    const bool areFinite =
      IsFinitePoint(points, one.Refused.From) && IsFinitePoint(points, one.Refused.To);
    const RefusalKind ofFinite =
      hasTriangles ? RefusalKind::CrossesEarlier : RefusalKind::NoTriangulation;
    one.Why = areFinite ? ofFinite : RefusalKind::NotFinite;
    const bool isFirstOfRing = !ofRing && one.Refused.Ring >= 0;
    ofRing = isFirstOfRing ? &one : ofRing;
    if (one.Why == RefusalKind::CrossesEarlier && (isFirstOfRing || SizeOf(named) < MostNamedIds))
    {
      named.push_back(&one);
    }
  }
  if (!named.empty())
  {
    mesh.ViewOnHost(
      [&](const PointMeshView& view)
      {
        for (RefusedSegment* one : named)
        {
          const std::uint32_t crossed = FindCrossed(view, points, this->Edges, *one);
          const std::int64_t number = this->Segments[crossed].Number;
          const std::int64_t* ends = this->Caller.Segments + 2 * number;
          one->Crossed = { number, { ends[0], ends[1] } };
        }
      });
  }
  if (ofRing)
  {
    const std::int64_t number = ofRing->Refused.Number;
    throw InvalidMesh(DescribeRefusal(*ofRing, this->Caller.Segments, this->Options.SplitCrossings),
      number, this->Caller.Segments[2 * number]);
  }
}

bool PointRun::Insert(LoadedMesh& mesh, const ProgressObserver& observer)
{
  if (this->Taken == 0)
  {
    this->PrepareRings(mesh);
  }
  std::vector<std::uint32_t> ends;
  for (std::size_t i = this->Taken; i < this->Segments.size(); ++i)
  {
    ends.push_back(static_cast<std::uint32_t>(this->Segments[i].From));
    ends.push_back(static_cast<std::uint32_t>(this->Segments[i].To));
  }
  bool isComplete = true;
  mesh.InsertSegments(ends,
    [&](const InsertedSegments& made)
    {
      this->Take(made);
      const auto all = static_cast<double>(this->Segments.size());
      isComplete = !observer || observer(static_cast<double>(this->Taken) / all);
      return isComplete;
    });
  if (!this->Refused.empty())
  {
    this->ExplainRefused(mesh);
  }
  this->Inserted = isComplete;
  return isComplete;
}

/// Keeps what the segments from Taken on have become.
void PointRun::Take(const InsertedSegments& made)
{
  auto side = made.Sides.begin();
  for (const std::int32_t edges : made.NumberOfEdges)
  {
    const auto index = static_cast<std::uint32_t>(this->Taken++);
    const Segment& segment = this->Segments[index];
    if (edges == InsertedSegments::Refused)
    {
      this->Refused.push_back({ segment, index });
    }
    for (std::int32_t i = 0; i < edges; ++i, ++side)
    {
      const EdgeId edge = EdgeOf(side->Side);
      this->Seen.resize(std::max<std::size_t>(this->Seen.size(), edge + 1));
      this->Edges.push_back({ side->Side, segment.Ring, side->IsOnLeft != 0, side->IsOnHull != 0,
        !this->Seen[edge], index });
      this->Seen[edge] = true;
    }
  }
  this->Flips += made.Flips;
}

void PointRun::Finish(LoadedMesh& mesh)
{
  if (!this->HasRemoved() && MayRemove(this->Prepared, this->Options))
  {
    mesh.ViewOnHost([this](const PointMeshView& view)
      { this->Kept = KeepTriangles(view, this->Prepared, this->Options, this->Edges); });
    const bool isLost =
      this->Prepared.FirstAdded > 0 ? this->Kept.UsedGiven == 0 : this->Kept.Count == 0;
    if (isLost && this->Kept.Outside + this->Kept.Large > 0)
    {
      this->GetOnHost();
      this->Loss = this->DescribeLoss();
    }
  }
}

/// Rings without an area, as a defect.
Defect PointRun::FindRingsWithoutArea() const
{
  std::vector<std::int64_t> numbers(this->LeftOutRings.begin(), this->LeftOutRings.end());
  numbers.insert(
    numbers.end(), this->Kept.RingsWithoutArea.begin(), this->Kept.RingsWithoutArea.end());
  std::sort(numbers.begin(), numbers.end());
  const std::int64_t count = SizeOf(numbers);
  numbers.resize(std::min<std::int64_t>(3, count));
  return { "rings without an area, left out", count, numbers, DefectIds::Rings };
}

/// That none of the given points is left, and where they and what was to cut them lie.
Defect PointRun::DescribeLoss() const
{
  const PlaneArray points = this->Prepared.Points;
  const std::int64_t added = std::min(this->Prepared.FirstAdded, this->Caller.Points.Count);
  const std::int64_t given = added > 0 ? added : this->Caller.Points.Count;
  CoordinateBox cloud, segments, seeds;
  for (std::int64_t i = 0; i < given; ++i)
  {
    cloud.Add(points.Get(i, 0), points.Get(i, 1));
  }
  for (const Segment& segment : this->Segments)
  {
    segments.Add(points.Get(segment.From, 0), points.Get(segment.From, 1));
    segments.Add(points.Get(segment.To, 0), points.Get(segment.To, 1));
  }
  for (std::int64_t i = 0; i < this->Caller.NumberOfHoleSeeds; ++i)
  {
    seeds.Add(this->Caller.HoleSeeds[2 * i], this->Caller.HoleSeeds[2 * i + 1]);
  }
  std::string text = "points without a triangle, because triangles are removed (" +
    std::to_string(this->Kept.Outside) + " outside, " + std::to_string(this->Kept.Large) +
    " too large): ";
  text += this->Kept.Count == 0 ? "none is left" : "only those between points of segments are left";
  text += "; these points lie in " + cloud.Describe();
  text += this->Segments.empty() ? "" : ", the segments in " + segments.Describe();
  text += this->Caller.NumberOfHoleSeeds == 0 ? "" : ", the hole seeds in " + seeds.Describe();
  return { text, given, {}, DefectIds::Points };
}

void PointRun::AddTo(FlipReport& report, LoadedMesh& mesh) const
{
  PointCounts& counts = report.FromPoints;
  const std::int64_t notFinite = counts.NotFinite - this->Counts.TooNear;
  const std::int64_t repeated = counts.Repeated;
  counts = this->Counts;
  counts.NotFinite = notFinite;
  counts.Repeated = repeated;
  std::int64_t inside = 0; // of these edges
  for (const SegmentEdge& edge : this->Edges)
  {
    counts.SegmentEdges += edge.IsFirst ? 1 : 0;
    inside += edge.IsFirst && !edge.IsOnBoundary ? 1 : 0;
  }
  counts.RefusedSegments = SizeOf(this->Refused);
  const std::int64_t places =
    this->Prepared.Points.Count - notFinite - repeated - this->Counts.TooNear;
  counts.Used = report.Triangles > 0 ? places : 0;
  counts.OutsideTriangles = this->Kept.Outside;
  counts.LargeTriangles = this->Kept.Large;
  report.Points = this->Caller.Points.Count;
  report.InsertedConstraints = static_cast<std::int64_t>(this->Taken - this->Refused.size());
  report.UnmatchedConstraints = counts.RefusedSegments;
  report.ConstraintFlips = this->Flips;
  report.Edges.Constraint = counts.SegmentEdges;
  if (this->HasRemoved())
  {
    counts.Used = this->Kept.Used;
    report.Triangles = this->Kept.Count;
    report.Edges.Edges = this->Kept.Edges;
    report.Edges.Boundary = this->Kept.Boundary;
    report.EulerCharacteristic = this->Kept.EulerCharacteristic;
    KeepAnglesAfter(this->Kept.Angles, report);
  }
  report.Edges.Fixed = report.Edges.Boundary + inside;

  std::vector<std::int64_t> used(notFinite + repeated > 0 ? this->Prepared.Points.Count : 0);
  if (!used.empty())
  {
    mesh.StoreUsedPoints(used.data());
  }
  const auto isNear = [&](std::int64_t i)
  { return !this->NearPoint.empty() && this->NearPoint[i] != i; };
  const auto add = [&](const char* what, std::int64_t count, const auto& isListed)
  {
    Defect defect{ what, count, {}, DefectIds::Points };
    for (std::int64_t i = 0; count > 0 && defect.FirstIds.size() < 3 && i < report.Points; ++i)
    {
      if (isListed(i))
      {
        defect.FirstIds.push_back(i);
      }
    }
    AddDefect(defect, report.Defects);
  };
  add("points with NaN or infinite coordinates", notFinite,
    [&](std::int64_t i) { return used[i] < 0 && !isNear(i); });
  add("duplicate points skipped", repeated,
    [&](std::int64_t i) { return used[i] >= 0 && used[i] != i; });
  add("points nearer than the tolerance to one with a lower id", counts.TooNear, isNear);
  AddDefects(this->Refused, this->Caller.Segments, this->Options.SplitCrossings, report.Defects);
  const bool isMesh = report.Triangles + this->Kept.Outside + this->Kept.Large > 0;
  for (const Defect& defect : { Defect{ "hole seeds outside of all triangles",
                                  this->Kept.SeedsOutside, {}, DefectIds::Points },
         this->FindRingsWithoutArea(),
         { "points without a triangle: there are fewer than three places, or all are on one line",
           isMesh ? 0 : report.Points, {}, DefectIds::Points } })
  {
    AddDefect(defect, report.Defects);
  }
  AddDefect(this->Loss, report.Defects);
}

//------------------------------------------------------------------------------
void PointRun::StoreUsedPoints(const LoadedMesh& mesh, std::int64_t* ids) const
{
  if (this->Prepared.Points.Count == this->Caller.Points.Count && this->NearPoint.empty())
  {
    mesh.StoreUsedPoints(ids);
    return;
  }
  std::vector<std::int64_t> used(this->Prepared.Points.Count);
  mesh.StoreUsedPoints(used.data());
  for (std::int64_t i = 0; i < this->Caller.Points.Count; ++i)
  {
    ids[i] = used[this->NearPoint.empty() ? i : this->NearPoint[i]];
  }
}

std::vector<std::int64_t> PointRun::ListSegmentEdges(LoadedMesh& mesh) const
{
  std::vector<std::int64_t> pairs;
  if (this->Edges.empty())
  {
    return pairs; // without a copy of a mesh that is on a GPU
  }
  mesh.ViewOnHost(
    [&](const PointMeshView& view)
    {
      for (const SegmentEdge& edge : this->Edges)
      {
        if (!edge.IsFirst)
        {
          continue;
        }
        const std::int64_t ends[2] = { view.Ids[view.GetStart(edge.Side)],
          view.Ids[view.GetEnd(edge.Side)] };
        pairs.insert(pairs.end(), { ends[edge.IsOnLeft ? 0 : 1], ends[edge.IsOnLeft ? 1 : 0] });
      }
    });
  return pairs;
}

}
