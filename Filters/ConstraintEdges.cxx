// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"

#include "DelaunayFlip.h"
#include "UpdateReport.h"

#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace delaunayflip
{

bool PointPlaces::Read(const PointArray& points, std::int64_t point, Place& place) const
{
  const double largest =
    this->AsFloats ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double x = points.Get(point, axis);
    if (!(std::fabs(x) <= largest))
    {
      return false;
    }
    const double rounded = this->AsFloats ? static_cast<float>(x) : x;
    place[axis] = rounded + 0.0; // makes 0 of -0
  }
  return true;
}

std::int64_t PointPlaces::Add(const PointArray& points, std::int64_t point)
{
  Place place;
  if (!this->Read(points, point, place))
  {
    return this->NumberOfPlaces++;
  }
  const auto added = this->Numbers.emplace(place, this->NumberOfPlaces);
  if (added.second)
  {
    ++this->NumberOfPlaces;
  }
  return added.first->second;
}

std::int64_t PointPlaces::Find(const PointArray& points, std::int64_t point) const
{
  Place place;
  if (!this->Read(points, point, place))
  {
    return None;
  }
  const auto found = this->Numbers.find(place);
  return found == this->Numbers.end() ? None : found->second;
}

//------------------------------------------------------------------------------
namespace
{

/// Adds the pair of `a` and `b`, unless they are equal.
void AddPair(std::int64_t a, std::int64_t b, std::vector<PointPair>& pairs)
{
  if (a != b)
  {
    pairs.push_back({ std::min(a, b), std::max(a, b) });
  }
}

/// Adds the pairs along lines or, if they are closed, polygons.
void AddPaths(vtkCellArray* cells, bool areClosed, const PointIdCheck& check,
  WorkProgress& progress, std::vector<PointPair>& pairs)
{
  VisitEdges(cells, areClosed, check,
    [&](vtkIdType, vtkIdType from, vtkIdType to, bool)
    {
      AddPair(from, to, pairs);
      progress.Add();
    });
}

/// Adds the edges along lines and polygons of a second input. Their ids must be below
/// `numberOfPoints`.
void AddAllPaths(vtkPolyData* others, vtkIdType numberOfPoints, const ProgressObserver& progress,
  std::vector<PointPair>& pairs)
{
  vtkCellArray* lines = others->GetLines();
  vtkCellArray* polygons = others->GetPolys();
  WorkProgress work(
    progress, lines->GetNumberOfConnectivityIds() + polygons->GetNumberOfConnectivityIds());
  PointIdCheck check{ "constraint cell", others->GetNumberOfVerts(), numberOfPoints };
  AddPaths(lines, false, check, work, pairs);
  check.FirstCell += others->GetNumberOfLines();
  AddPaths(polygons, true, check, work, pairs);
}

/// Keeps the first of equal pairs. Its flag is set if the flag of any of them is.
/// @throws RunAborted.
void RemoveRepeated(std::vector<PointPair>& pairs, std::vector<unsigned char>& flags,
  const ProgressObserver& progress)
{
  WorkProgress work(progress, static_cast<vtkIdType>(pairs.size()));
  std::unordered_map<PointPair, std::size_t, HashWords> known; // never iterated over
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const auto added = known.emplace(pairs[i], kept);
    const std::size_t place = added.first->second;
    const bool isNew = added.second;
    if (isNew)
    {
      pairs[place] = pairs[i];
      flags[place] = flags[i];
      ++kept;
    }
    else
    {
      flags[place] |= flags[i];
    }
    work.Add();
  }
  pairs.resize(kept);
  flags.resize(kept);
}

/// Adds the edges of the mesh between pairs of places where several points lie. Counts the pairs
/// that have no edge.
void AddCrowdedEdges(std::vector<PointPair>& crowded, const std::vector<std::int64_t>& placeOf,
  const TriangleArray& triangles, const ProgressObserver& progress, ConstraintEdges& edges)
{
  std::sort(crowded.begin(), crowded.end());
  const auto getPlace = [&](std::int64_t point) // the engine reports ids out of range later
  {
    const bool isPoint = point >= 0 && point < static_cast<std::int64_t>(placeOf.size());
    return isPoint ? placeOf[point] : PointPlaces::None;
  };
  std::vector<PointPair> found;
  if (crowded.empty())
  {
    return;
  }
  const std::int64_t sides = 3 * triangles.Count;
  WorkProgress work(progress, sides);
  for (std::int64_t side = 0; side < sides; ++side)
  {
    work.Add();
    const std::int64_t from = triangles.Get(side / 3, static_cast<int>(side % 3));
    const std::int64_t to = triangles.Get(side / 3, static_cast<int>((side + 1) % 3));
    const std::int64_t a = getPlace(from), b = getPlace(to);
    const PointPair pair = { std::min(a, b), std::max(a, b) };
    if (std::binary_search(crowded.begin(), crowded.end(), pair))
    {
      AddPair(from, to, edges.Pairs);
      found.push_back(pair);
    }
  }
  std::sort(found.begin(), found.end());
  edges.Unmatched += static_cast<std::int64_t>(crowded.size()) -
    (std::unique(found.begin(), found.end()) - found.begin());
}

/// E.g. "from (0, 0, 0) to (1, 2.5, 0)".
std::string DescribeEdge(const PointArray& points, std::int64_t from, std::int64_t to)
{
  std::ostringstream text;
  const int digits = points.Floats ? 7 : 10;
  const auto write = [&](std::int64_t end)
  {
    text << '(' << points.Get(end, 0) << ", " << points.Get(end, 1) << ", " << points.Get(end, 2)
         << ')';
  };
  text << std::setprecision(digits) << "from ";
  write(from);
  text << " to ";
  write(to);
  return text.str();
}

/// The points of a mesh at each place.
struct PointsAtPlaces
{
  explicit PointsAtPlaces(std::int64_t places)
    : HowMany(places),
      First(places)
  {
  }

  void Add(std::int64_t point, std::int64_t place)
  {
    if (place != PointPlaces::None && this->HowMany[place]++ == 0)
    {
      this->First[place] = point;
    }
  }

  std::vector<std::int64_t> HowMany, First;
};

/// Counts the points of a mesh at each place. Where there are several, those that no triangle uses
/// count only if there are no others. @param placeOf by point.
PointsAtPlaces CountPoints(
  const TriangleMesh& mesh, const std::vector<std::int64_t>& placeOf, std::int64_t places)
{
  PointsAtPlaces all(places);
  for (std::int64_t point = 0; point < mesh.Points.Count; ++point)
  {
    all.Add(point, placeOf[point]);
  }
  const bool areSingle = std::all_of(
    all.HowMany.begin(), all.HowMany.end(), [](std::int64_t points) { return points < 2; });
  if (areSingle)
  {
    return all;
  }
  std::vector<char> isUsed(mesh.Points.Count);
  for (std::int64_t corner = 0; corner < 3 * mesh.Triangles.Count; ++corner)
  {
    const std::int64_t point = mesh.Triangles.Get(corner / 3, static_cast<int>(corner % 3));
    if (point >= 0 && point < mesh.Points.Count) // the engine reports other ids later
    {
      isUsed[point] = 1;
    }
  }
  PointsAtPlaces used(places);
  for (std::int64_t point = 0; point < mesh.Points.Count; ++point)
  {
    used.Add(point, isUsed[point] != 0 ? placeOf[point] : PointPlaces::None);
  }
  for (std::int64_t place = 0; place < places; ++place)
  {
    if (used.HowMany[place] > 0)
    {
      all.HowMany[place] = used.HowMany[place];
      all.First[place] = used.First[place];
    }
  }
  return all;
}

/// Finds, for edges between points of another dataset, the edges of the mesh at the same places.
///
/// Coordinates are compared in the lower of the two precisions: float constraints match the double
/// mesh from which they were made. Where several points of the mesh lie at one place, all pairs of
/// them that are edges of the mesh match. Other pairs that are added may not be edges of the mesh.
/// Pairs with an end where the mesh has no point are counted as unmatched.
/// @throws RunAborted.
void MatchPlaces(const PointArray& others, const std::vector<PointPair>& pairs,
  const TriangleMesh& mesh, const ProgressObserver& progress, ConstraintEdges& edges)
{
  PointPlaces places(others.Floats != nullptr || mesh.Points.Floats != nullptr);
  std::vector<std::int64_t> placeOfOther(others.Count, PointPlaces::None);
  const auto number = [&](std::int64_t point)
  {
    std::int64_t& place = placeOfOther[point];
    if (place == PointPlaces::None)
    {
      place = places.Add(others, point);
    }
    return place;
  };
  std::vector<PointPair> wanted; // pairs of places
  WorkProgress numbering(MakePart(progress, 0.0, 0.32), static_cast<vtkIdType>(pairs.size()));
  for (const PointPair& pair : pairs)
  {
    const std::int64_t from = number(pair[0]);
    AddPair(from, number(pair[1]), wanted);
    numbering.Add();
  }
  std::vector<unsigned char> noFlags(wanted.size());
  RemoveRepeated(wanted, noFlags, MakePart(progress, 0.32, 0.54));

  std::vector<std::int64_t> placeOf(mesh.Points.Count); // some are None
  WorkProgress finding(MakePart(progress, 0.54, 0.9), mesh.Points.Count);
  constexpr vtkIdType Chunk = 32768; // some milliseconds
  for (vtkIdType chunk = 0; chunk < mesh.Points.Count; chunk += Chunk)
  {
    vtkSMPTools::For(chunk, std::min<vtkIdType>(chunk + Chunk, mesh.Points.Count),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType point = begin; point < end; ++point)
        {
          placeOf[point] = places.Find(mesh.Points, point);
        }
      });
    finding.Add(Chunk);
  }
  const PointsAtPlaces at = CountPoints(mesh, placeOf, places.GetNumberOfPlaces());
  for (const PointPair& pair : pairs)
  {
    const std::int64_t from = placeOfOther[pair[0]], to = placeOfOther[pair[1]];
    const bool areHere = at.HowMany[from] > 0 && at.HowMany[to] > 0;
    edges.AreHere.push_back(static_cast<char>(areHere));
    if (!areHere && from != to && edges.FirstStranger.empty())
    {
      edges.FirstStranger = DescribeEdge(others, pair[0], pair[1]);
    }
  }
  std::vector<PointPair> crowded;
  for (const PointPair& pair : wanted)
  {
    const std::int64_t points = at.HowMany[pair[0]] * at.HowMany[pair[1]];
    if (points == 0)
    {
      ++edges.Unmatched;
    }
    else if (points == 1)
    {
      AddPair(at.First[pair[0]], at.First[pair[1]], edges.Pairs);
    }
    else
    {
      crowded.push_back(pair);
    }
  }
  AddCrowdedEdges(crowded, placeOf, mesh.Triangles, MakePart(progress, 0.9, 1.0), edges);
}

}

ConstraintEdges FindConstraintEdges(const TriangleMesh& mesh, vtkPolyData* input,
  vtkPolyData* others, const ConstraintSettings& settings, const ProgressObserver& progress)
{
  ConstraintEdges edges;
  if (settings.LinesAsConstraints)
  {
    vtkCellArray* lines = input->GetLines();
    const double end = others ? 0.0 : 0.5; // beside others the lines take no time
    WorkProgress work(MakePart(progress, 0.0, end), lines->GetNumberOfConnectivityIds());
    AddPaths(lines, false, { "line, cell", input->GetNumberOfVerts(), mesh.Points.Count }, work,
      edges.Pairs);
    edges.ToInsert.resize(edges.Pairs.size(), settings.InsertLines);
  }
  if (others)
  {
    std::vector<double> storage;
    const PointArray points = ViewPoints(others, storage);
    if (points.Count == 0 || HaveSameBits(points, mesh.Points))
    {
      const std::size_t before = edges.Pairs.size();
      AddAllPaths(others, mesh.Points.Count, MakePart(progress, 0.0, 0.7), edges.Pairs);
      edges.AreHere.assign(edges.Pairs.size() - before, 1);
    }
    else
    {
      std::vector<PointPair> pairs;
      AddAllPaths(others, points.Count, MakePart(progress, 0.0, 0.07), pairs);
      MatchPlaces(points, pairs, mesh, MakePart(progress, 0.07, 0.7), edges);
    }
    edges.ToInsert.resize(edges.Pairs.size(), settings.InsertConstraints);
  }
  RemoveRepeated(edges.Pairs, edges.ToInsert, MakePart(progress, 0.7, 1.0));
  return edges;
}

vtkSmartPointer<vtkPolyData> MakeLines(
  const std::vector<std::array<double, 3>>& ends, bool areFloats)
{
  if (ends.empty())
  {
    return nullptr;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(FindPointType(areFloats));
  vtkNew<vtkCellArray> lines;
  for (std::size_t i = 0; i < ends.size(); i += 2)
  {
    lines->InsertNextCell(
      { points->InsertNextPoint(ends[i].data()), points->InsertNextPoint(ends[i + 1].data()) });
  }
  auto made = vtkSmartPointer<vtkPolyData>::New();
  made->SetPoints(points);
  made->SetLines(lines);
  return made;
}

vtkSmartPointer<vtkPolyData> JoinConstraints(
  const std::vector<std::pair<vtkPolyData*, vtkPolyData*>>& sources)
{
  std::vector<std::array<double, 3>> ends;
  bool areFloats = true;
  for (const auto& [edges, mesh] : sources)
  {
    const bool namesMesh = mesh && edges->GetNumberOfPoints() == 0;
    vtkPolyData* named = namesMesh ? mesh : edges;
    vtkPoints* points = named->GetPoints();
    areFloats = areFloats && (!points || points->GetDataType() == VTK_FLOAT);
    std::vector<PointPair> pairs;
    AddAllPaths(edges, named->GetNumberOfPoints(), {}, pairs);
    for (const PointPair& pair : pairs)
    {
      points->GetPoint(pair[0], ends.emplace_back().data());
      points->GetPoint(pair[1], ends.emplace_back().data());
    }
  }
  return MakeLines(ends, areFloats);
}

//------------------------------------------------------------------------------
HeightRange::HeightRange(const PointArray& points, std::int64_t count)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double height = points.Get(i, 2);
    if (std::isfinite(height))
    {
      this->Low = std::min(this->Low, height);
      this->High = std::max(this->High, height);
    }
  }
}

SegmentList::SegmentList(const SegmentSource& source, vtkPolyData* given, vtkPolyData* points,
  const ProgressObserver& progress)
  : Given(given),
    Points(points),
    ConvertsToDoubles(source.ConvertsToDoubles)
{
  const vtkIdType count = given->GetNumberOfPoints();
  this->FirstNumber = source.Others ? source.Others->GetNumberOfCells() : 0;
  this->AddCells(
    given->GetLines(), { "line, cell", given->GetNumberOfVerts(), count }, {}, CellKind::Line);
  this->FirstNumber = 0;
  this->FirstOther = this->Ends.size();
  if (!source.Others)
  {
    return;
  }
  const auto segments = ShareMesh(source.Others); // so that observers cannot take it away
  std::vector<double> storage, otherStorage;
  const PointArray own = ViewPoints(given, storage);
  const PointArray others = ViewPoints(segments, otherStorage);
  std::vector<vtkIdType> ids; // empty if the cells name points of the first input
  vtkIdType size = count;
  if (others.Count > 0 && !HaveSameBits(own, others))
  {
    ids = this->AddPoints(own, others, segments, progress);
    size = others.Count;
  }
  const CellKind kindOfLines = source.ClosedLinesAsRings ? CellKind::LineOrRing : CellKind::Line;
  PointIdCheck check{ "segment cell", segments->GetNumberOfVerts(), size };
  this->AddCells(segments->GetLines(), check, ids, kindOfLines);
  check.FirstCell += segments->GetNumberOfLines();
  this->AddCells(segments->GetPolys(), check, ids, CellKind::Ring);
}

PointsWithoutHeights SegmentList::FindPointsWithoutHeights(std::int64_t firstHole) const
{
  PointsWithoutHeights found;
  std::vector<double> storage;
  const vtkIdType given = this->Given->GetNumberOfPoints();
  if (this->Points->GetNumberOfPoints() == given)
  {
    return found;
  }
  const PointArray points = ViewPoints(this->Points, storage);
  const HeightRange heights(points, given);
  if (heights.IsEmpty())
  {
    return found;
  }
  enum
  {
    OfLines,
    OfOutlines,
    OfHoles,
    Kinds
  };
  const auto getKind = [&](std::size_t end)
  {
    const std::int32_t ring = this->Rings[end / 2];
    if (ring < 0)
    {
      return OfLines;
    }
    return firstHole >= 0 && ring >= firstHole ? OfHoles : OfOutlines;
  };
  const auto isFinite = [&points](std::int64_t point)
  { return std::isfinite(points.Get(point, 2)); };
  bool isFlat[Kinds] = { true, true, true };
  for (std::size_t end = this->FirstOther; end < this->Ends.size(); ++end)
  {
    const std::int64_t point = this->Ends[end];
    isFlat[getKind(end)] &= points.Get(point, 2) == 0.0 || !isFinite(point);
  }
  std::vector<bool> isListed(points.Count, false);
  for (std::size_t end = this->FirstOther; end < this->Ends.size(); ++end)
  {
    const std::int64_t point = this->Ends[end];
    const bool isFlatHere = isFlat[getKind(end)] && !heights.IsZero();
    if (point < given || isListed[point])
    {
      continue;
    }
    if (!isFinite(point))
    {
      found.NotFinite.push_back(point);
      isListed[point] = true;
    }
    else if (isFlatHere)
    {
      found.AtZero.push_back(point);
      isListed[point] = true;
    }
  }
  return found;
}

void SegmentList::AddCells(
  vtkCellArray* cells, const PointIdCheck& check, const std::vector<vtkIdType>& ids, CellKind kind)
{
  std::vector<vtkIdType> path;
  VisitCells(cells, check,
    [&](vtkIdType cell, vtkIdList* points)
    {
      path.assign(points->begin(), points->end());
      if (!ids.empty())
      {
        std::transform(
          path.begin(), path.end(), path.begin(), [&ids](vtkIdType id) { return ids[id]; });
      }
      const bool isRing =
        kind == CellKind::Ring || (kind == CellKind::LineOrRing && this->IsClosed(path));
      const bool isOpen = !path.empty() && (path.size() == 1 || path.front() != path.back());
      if (kind == CellKind::Ring && isOpen)
      {
        path.push_back(path.front());
      }
      this->AddPath(path, isRing, check.FirstCell + cell);
    });
}

void SegmentList::AddPath(const std::vector<vtkIdType>& path, bool isRing, vtkIdType cell)
{
  constexpr std::int32_t NoRing = -1;
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    if (path[i - 1] != path[i] || isRing)
    {
      this->Ends.insert(this->Ends.end(), { path[i - 1], path[i] });
      this->Rings.push_back(isRing ? static_cast<std::int32_t>(cell) : NoRing);
      this->Cells.push_back(this->FirstNumber + cell);
    }
  }
}

bool SegmentList::IsClosed(const std::vector<vtkIdType>& path) const
{
  if (path.size() < 3)
  {
    return false;
  }
  std::array<double, 3> first, last;
  this->Points->GetPoint(path.front(), first.data());
  this->Points->GetPoint(path.back(), last.data());
  return path.front() == path.back() || first == last;
}

std::vector<vtkIdType> SegmentList::AddPoints(const PointArray& own, const PointArray& others,
  vtkPolyData* segments, const ProgressObserver& observer)
{
  PointPlaces places(own.Floats || others.Floats);
  std::vector<vtkIdType> ids(others.Count);
  for (vtkIdType i = 0; i < others.Count; ++i)
  {
    ids[i] = places.Add(others, i); // the number of its place, for now
  }
  std::vector<vtkIdType> first(places.GetNumberOfPlaces(), PointPlaces::None);
  WorkProgress progress(observer, own.Count);
  for (vtkIdType i = own.Count - 1; i >= 0; --i)
  {
    const std::int64_t place = places.Find(own, i);
    if (place != PointPlaces::None)
    {
      first[place] = i;
    }
    progress.Add();
  }
  vtkNew<vtkIdList> added;
  for (vtkIdType i = 0; i < others.Count; ++i)
  {
    vtkIdType& id = first[ids[i]];
    if (id == PointPlaces::None)
    {
      id = own.Count + added->InsertNextId(i);
    }
    ids[i] = id;
  }
  if (added->GetNumberOfIds() > 0)
  {
    vtkPointData* data = segments->GetPointData();
    const auto theirs = TakeWholeArrays(data, others.Count);
    if (this->ConvertsToDoubles)
    {
      TurnToDoubles(theirs);
    }
    const auto given = TakeWholeArrays(this->Points->GetPointData(), own.Count);
    TurnToRealsOf(given, theirs);
    this->Received =
      AppendPoints(CopyShallow(this->Points), segments->GetPoints(), added, theirs, this->Points);
    this->ShortArrays = FindShortArrays(
      data, others.Count, "point", " of the second input with too few tuples left out");
  }
  return ids;
}

void SegmentList::StoreEdges(const FlipSession& session, vtkPolyData* output) const
{
  const std::vector<std::int64_t> ends = session.ListSegmentEdges();
  const std::vector<std::int64_t> segments = session.ListSegmentsOfEdges();
  const auto count = static_cast<vtkIdType>(segments.size());
  const auto make = [](vtkIdType size)
  {
    auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
    ids->SetName("SegmentIds");
    ids->SetNumberOfValues(size);
    ids->FillValue(-1);
    return ids;
  };
  const auto ofCells = make(count + output->GetNumberOfPolys());
  vtkNew<vtkCellArray> lines;
  lines->AllocateExact(count, 2 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    lines->InsertNextCell({ vtkIdType(ends[2 * i]), vtkIdType(ends[2 * i + 1]) });
    ofCells->SetValue(i, this->Cells[segments[i]]);
  }
  output->SetLines(lines);
  output->GetCellData()->AddArray(ofCells);
  const auto ofPoints = make(output->GetNumberOfPoints());
  vtkIdType id = this->Points->GetNumberOfPoints();
  for (const AddedPoint& point : session.GetAddedPoints())
  {
    ofPoints->SetValue(id, point.Segment < 0 ? -1 : this->Cells[point.Segment]);
    ++id;
  }
  output->GetPointData()->RemoveArray(ofPoints->GetName()); // it may be an attribute
  output->GetPointData()->AddArray(ofPoints);
}

}
