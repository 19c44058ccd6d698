// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"

#include "PointViews.h"
#include "UpdateProgress.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

namespace delaunayflip
{

std::size_t PointPlaces::Hash::operator()(const Bits& bits) const
{
  // Coordinates on a lattice differ only in a few high bits: multiply, then fold those down.
  std::uint64_t hash = 0;
  for (const std::uint64_t word : bits)
  {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15u; // 2^64 / golden ratio, odd
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

bool PointPlaces::Read(const PointArray& points, std::int64_t point, Bits& bits) const
{
  const double largest =
    this->AsFloats ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis)
  {
    double x = points.Get(point, axis);
    if (!(std::fabs(x) <= largest))
    {
      return false;
    }
    x = this->AsFloats ? static_cast<double>(static_cast<float>(x)) : x;
    x = x == 0.0 ? 0.0 : x;
    std::memcpy(&bits[axis], &x, sizeof(x));
  }
  return true;
}

std::int64_t PointPlaces::Add(const PointArray& points, std::int64_t point)
{
  Bits bits;
  if (!this->Read(points, point, bits))
  {
    return this->NumberOfPlaces++;
  }
  const auto added = this->Numbers.emplace(bits, this->NumberOfPlaces);
  this->NumberOfPlaces += added.second ? 1 : 0;
  return added.first->second;
}

std::int64_t PointPlaces::Find(const PointArray& points, std::int64_t point) const
{
  Bits bits;
  if (!this->Read(points, point, bits))
  {
    return None;
  }
  const auto found = this->Numbers.find(bits);
  return found == this->Numbers.end() ? None : found->second;
}

namespace
{

/// Finds, for edges between points of another dataset, the edges of a mesh at the same places.
///
/// Coordinates are compared in the lower of the two precisions: float constraints match the double
/// mesh from which they were made. Where several points of the mesh lie at one place, all pairs of
/// them that are edges of the mesh match.
class PlaceMatch
{
public:
  /// @param pairs point ids of `others`.
  /// @throws RunAborted.
  PlaceMatch(const PointArray& others, const std::vector<PointPair>& pairs, const PointArray& mesh,
    const ProgressObserver& progress);

  /// Adds pairs of the mesh's points. Some of them may not be edges of the mesh. Pairs with an end
  /// where the mesh has no point are counted as unmatched.
  /// @throws RunAborted.
  void AddEdges(
    const TriangleArray& triangles, const ProgressObserver& progress, ConstraintEdges& edges) const;

private:
  void NumberPlaces(const PointArray& others, const std::vector<PointPair>& pairs,
    const ProgressObserver& progress);
  void FindPoints(const PointArray& mesh, const ProgressObserver& progress);
  std::int64_t AddEdgesAt(const std::vector<PointPair>& crowded, const TriangleArray& triangles,
    const ProgressObserver& progress, std::vector<PointPair>& edges) const;
  std::int64_t GetPlace(std::int64_t point) const;

  PointPlaces Places;
  std::vector<PointPair> Wanted; ///< Pairs of places, unique, in the order given.
  std::vector<std::int64_t> PlaceOfPoint; ///< For every point of the mesh its place, or None.
  std::vector<std::int64_t> PointsAtPlace; ///< How many points of the mesh lie there.
  std::vector<std::int64_t> PointOfPlace; ///< The first of them.
};

PlaceMatch::PlaceMatch(const PointArray& others, const std::vector<PointPair>& pairs,
  const PointArray& mesh, const ProgressObserver& progress)
  : Places(others.Floats != nullptr || mesh.Floats != nullptr)
{
  this->NumberPlaces(others, pairs, MakePart(progress, 0.0, 0.6));
  this->FindPoints(mesh, MakePart(progress, 0.6, 1.0));
}

void PlaceMatch::NumberPlaces(
  const PointArray& others, const std::vector<PointPair>& pairs, const ProgressObserver& progress)
{
  WorkProgress work(MakePart(progress, 0.0, 0.6), static_cast<vtkIdType>(pairs.size()));
  std::vector<std::int64_t> places(others.Count, PointPlaces::None);
  const auto number = [&](std::int64_t point)
  {
    std::int64_t& place = places[point];
    place = place == PointPlaces::None ? this->Places.Add(others, point) : place;
    return place;
  };
  std::vector<PointPair> wanted;
  for (const PointPair& pair : pairs)
  {
    const std::int64_t from = number(pair[0]);
    const std::int64_t to = number(pair[1]);
    AddPair(from, to, wanted);
    work.Add();
  }
  const std::vector<std::size_t> first = FindFirst(wanted, MakePart(progress, 0.6, 1.0));
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    if (first[i] == i)
    {
      this->Wanted.push_back(wanted[i]);
    }
  }
}

void PlaceMatch::FindPoints(const PointArray& mesh, const ProgressObserver& progress)
{
  this->PlaceOfPoint.resize(mesh.Count);
  ForPieces(mesh.Count, progress,
    [this, &mesh](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        this->PlaceOfPoint[point] = this->Places.Find(mesh, point);
      }
    });
  this->PointsAtPlace.resize(this->Places.GetNumberOfPlaces());
  this->PointOfPlace.resize(this->Places.GetNumberOfPlaces());
  for (std::int64_t point = 0; point < mesh.Count; ++point)
  {
    const std::int64_t place = this->PlaceOfPoint[point];
    if (place != PointPlaces::None && this->PointsAtPlace[place]++ == 0)
    {
      this->PointOfPlace[place] = point;
    }
  }
}

void PlaceMatch::AddEdges(
  const TriangleArray& triangles, const ProgressObserver& progress, ConstraintEdges& edges) const
{
  std::vector<PointPair> crowded;
  for (const PointPair& pair : this->Wanted)
  {
    const std::int64_t points = this->PointsAtPlace[pair[0]] * this->PointsAtPlace[pair[1]];
    edges.Unmatched += points == 0 ? 1 : 0;
    if (points == 1)
    {
      AddPair(this->PointOfPlace[pair[0]], this->PointOfPlace[pair[1]], edges.Pairs);
    }
    else if (points > 1)
    {
      crowded.push_back(pair);
    }
  }
  std::sort(crowded.begin(), crowded.end());
  edges.Unmatched += this->AddEdgesAt(crowded, triangles, progress, edges.Pairs);
}

/// Adds the edges of the mesh between pairs of places where several points lie.
/// @returns how many of the pairs have no edge.
std::int64_t PlaceMatch::AddEdgesAt(const std::vector<PointPair>& crowded,
  const TriangleArray& triangles, const ProgressObserver& progress,
  std::vector<PointPair>& edges) const
{
  std::vector<PointPair> found;
  const std::int64_t sides = crowded.empty() ? 0 : 3 * triangles.Count;
  WorkProgress work(MakePart(progress, 0.0, 0.7), sides);
  for (std::int64_t side = 0; side < sides; ++side)
  {
    work.Add();
    const std::int64_t from = triangles.Get(side / 3, side % 3);
    const std::int64_t to = triangles.Get(side / 3, (side + 1) % 3);
    const std::int64_t places[2] = { this->GetPlace(from), this->GetPlace(to) };
    const PointPair pair = { std::min(places[0], places[1]), std::max(places[0], places[1]) };
    if (std::binary_search(crowded.begin(), crowded.end(), pair))
    {
      AddPair(from, to, edges);
      found.push_back(pair);
    }
  }
  std::sort(found.begin(), found.end());
  const auto end = std::unique(found.begin(), found.end());
  return static_cast<std::int64_t>(crowded.size()) - (end - found.begin());
}

/// Accepts ids out of range, which the engine reports later.
std::int64_t PlaceMatch::GetPlace(std::int64_t point) const
{
  const bool isPoint = point >= 0 && point < static_cast<std::int64_t>(this->PlaceOfPoint.size());
  return isPoint ? this->PlaceOfPoint[point] : PointPlaces::None;
}

}

namespace
{

/// The cells of a vtkCellArray, as lines or as polygons.
struct Paths
{
  vtkCellArray* Cells;
  bool AreClosed;
};

void AddPaths(const Paths& paths, const PointIdCheck& check, WorkProgress& progress,
  std::vector<PointPair>& pairs)
{
  check.RequireValid(paths.Cells);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < paths.Cells->GetNumberOfCells(); ++cell)
  {
    paths.Cells->GetCellAtId(cell, ids);
    check.RequireInRange(cell, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    for (vtkIdType i = 1; i < count; ++i)
    {
      AddPair(ids->GetId(i - 1), ids->GetId(i), pairs);
    }
    if (paths.AreClosed && count > 2)
    {
      AddPair(ids->GetId(count - 1), ids->GetId(0), pairs);
    }
    progress.Add(count);
  }
}

void AddLines(
  const ConstraintSource& source, const ProgressObserver& progress, std::vector<PointPair>& pairs)
{
  vtkCellArray* lines = source.Lines->GetLines();
  const PointIdCheck check{ "line, cell", source.Lines->GetNumberOfVerts(), source.Points.Count };
  WorkProgress work(progress, lines->GetNumberOfConnectivityIds());
  AddPaths({ lines, false }, check, work, pairs);
}

/// Adds the edges along lines and polygons of the second input, whose ids must be below
/// `numberOfPoints`.
void AddOtherPaths(vtkPolyData* others, vtkIdType numberOfPoints, const ProgressObserver& progress,
  std::vector<PointPair>& pairs)
{
  WorkProgress work(progress,
    others->GetLines()->GetNumberOfConnectivityIds() +
      others->GetPolys()->GetNumberOfConnectivityIds());
  PointIdCheck check{ "constraint cell", others->GetNumberOfVerts(), numberOfPoints };
  AddPaths({ others->GetLines(), false }, check, work, pairs);
  check.FirstCell += others->GetNumberOfLines();
  AddPaths({ others->GetPolys(), true }, check, work, pairs);
}

void AddOthers(
  const ConstraintSource& source, const ProgressObserver& progress, ConstraintEdges& edges)
{
  std::vector<double> storage;
  const PointArray points = ViewPoints(source.Others, storage);
  if (points.Count == 0 || HaveSameBits(points, source.Points))
  {
    AddOtherPaths(source.Others, source.Points.Count, progress, edges.Pairs);
    return;
  }
  std::vector<PointPair> pairs;
  AddOtherPaths(source.Others, points.Count, MakePart(progress, 0.0, 0.1), pairs);
  PlaceMatch(points, pairs, source.Points, MakePart(progress, 0.1, 0.9))
    .AddEdges(source.Triangles, MakePart(progress, 0.9, 1.0), edges);
}

/// Keeps the first of equal pairs; it is to be inserted if any of them is.
void RemoveRepeated(ConstraintEdges& edges, const ProgressObserver& progress)
{
  const std::vector<std::size_t> first = FindFirst(edges.Pairs, progress);
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    edges.ToInsert[first[i]] |= edges.ToInsert[i];
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    if (first[i] == i)
    {
      edges.Pairs[kept] = edges.Pairs[i];
      edges.ToInsert[kept++] = edges.ToInsert[i];
    }
  }
  edges.Pairs.resize(kept);
  edges.ToInsert.resize(kept);
}

}

void AddPair(std::int64_t a, std::int64_t b, std::vector<PointPair>& pairs)
{
  if (a != b)
  {
    pairs.push_back({ std::min(a, b), std::max(a, b) });
  }
}

std::vector<std::size_t> FindFirst(
  const std::vector<PointPair>& pairs, const ProgressObserver& progress)
{
  // About as many comparisons as the sort makes.
  constexpr vtkIdType ComparisonsPerItem = 16;
  const auto size = static_cast<double>(pairs.size());
  WorkProgress work(
    progress, static_cast<vtkIdType>(size * std::log2(size + 2.0) / ComparisonsPerItem));
  vtkIdType comparisons = 0;
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      work.Add(++comparisons % ComparisonsPerItem == 0 ? 1 : 0);
      return pairs[a] != pairs[b] ? pairs[a] < pairs[b] : a < b;
    });
  std::vector<std::size_t> first(pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isRepeated = i > 0 && pairs[order[i]] == pairs[order[i - 1]];
    first[order[i]] = isRepeated ? first[order[i - 1]] : order[i];
  }
  return first;
}

ConstraintEdges FindConstraintEdges(
  const ConstraintSource& source, const ProgressObserver& progress)
{
  ConstraintEdges edges;
  if (source.Lines)
  {
    AddLines(source, MakePart(progress, 0.0, source.Others ? 0.0 : 0.5), edges.Pairs);
    edges.ToInsert.resize(edges.Pairs.size(), source.InsertLines ? 1 : 0);
  }
  if (source.Others)
  {
    AddOthers(source, MakePart(progress, 0.0, 0.7), edges);
    edges.ToInsert.resize(edges.Pairs.size(), source.InsertOthers ? 1 : 0);
  }
  RemoveRepeated(edges, MakePart(progress, 0.7, 1.0));
  return edges;
}

}
