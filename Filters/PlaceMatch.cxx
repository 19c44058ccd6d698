// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlaceMatch.h"

#include "WorkProgress.h"

#include <algorithm>

namespace delaunayflip
{

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
