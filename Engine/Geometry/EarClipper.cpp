// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EarClipper.h"

#include "Predicates.h"

#include <utility>

namespace delaunayflip
{

EarClipper::EarClipper(const std::vector<PlaneVector>& polygon, const ProgressObserver& progress)
  : Polygon(polygon),
    Progress(progress),
    Tree(polygon),
    Left(static_cast<std::int64_t>(polygon.size())),
    BlockedBy(static_cast<std::size_t>(this->Tree.GetNumberOfPlaces()))
{
  for (std::int64_t i = 0; i < this->Left; ++i)
  {
    this->Next.push_back((i + 1) % this->Left);
    this->Previous.push_back((i + this->Left - 1) % this->Left);
    this->Candidates.insert(this->Candidates.end(), i);
  }
}

EarClipper::Triangles EarClipper::Clip()
{
  std::int64_t vertex = 0;
  while (this->Left > 3)
  {
    const std::int64_t ear = this->FindEar(vertex);
    if (this->Stopped)
    {
      return {};
    }
    vertex = this->CutOff(ear);
  }
  this->Cut.push_back({ this->Previous[vertex], vertex, this->Next[vertex] });
  return std::move(this->Cut);
}

/// Calls the observer from time to time.
bool EarClipper::ReportProgress()
{
  constexpr std::int64_t VisitsBetweenCalls = std::int64_t(1) << 15; // about a millisecond
  if (this->Progress && this->Tree.GetVisits() - this->VisitsTold >= VisitsBetweenCalls)
  {
    this->VisitsTold = this->Tree.GetVisits();
    const auto left = static_cast<double>(this->Left);
    this->Stopped = !this->Progress(1.0 - left / static_cast<double>(this->Polygon.size()));
  }
  return !this->Stopped;
}

/// The first ear from a vertex on, all the way around; the vertex itself if there is none.
std::int64_t EarClipper::FindEar(std::int64_t from)
{
  while (!this->Candidates.empty() && this->ReportProgress())
  {
    auto next = this->Candidates.lower_bound(from);
    next = next == this->Candidates.end() ? this->Candidates.begin() : next;
    if (this->IsEar(*next))
    {
      return *next;
    }
    this->Candidates.erase(next);
  }
  return from;
}

bool EarClipper::IsEar(std::int64_t vertex)
{
  const std::array<std::int64_t, 3> triangle = { this->Previous[vertex], vertex,
    this->Next[vertex] };
  const PlaneVector& a = this->Polygon[triangle[0]];
  const PlaneVector& b = this->Polygon[triangle[1]];
  const PlaneVector& c = this->Polygon[triangle[2]];
  if (Orientation(a.data(), b.data(), c.data()) <= 0)
  {
    return false;
  }
  const std::int64_t inside = this->Tree.FindInside(triangle);
  if (inside == PlaceTree::NoPlace)
  {
    return true;
  }
  this->BlockedBy[inside].push_back(vertex);
  return false;
}

/// @returns the vertex after the next one, where the walk continues.
std::int64_t EarClipper::CutOff(std::int64_t vertex)
{
  const std::int64_t previous = this->Previous[vertex];
  const std::int64_t next = this->Next[vertex];
  this->Cut.push_back({ previous, vertex, next });
  this->Next[previous] = next;
  this->Previous[next] = previous;
  this->Next[vertex] = -1;
  --this->Left;
  this->Candidates.erase(vertex);
  this->Candidates.insert({ previous, next });
  if (this->Tree.Remove(vertex))
  {
    for (const std::int64_t blocked :
      std::exchange(this->BlockedBy[this->Tree.GetPlace(vertex)], {}))
    {
      if (!this->IsCutOff(blocked))
      {
        this->Candidates.insert(blocked);
      }
    }
  }
  return this->Next[next];
}

}
