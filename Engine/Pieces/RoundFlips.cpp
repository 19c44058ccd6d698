// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RoundFlips.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

void RoundFlips::Add(std::int64_t triangle)
{
  TriangleStep& step = this->Mesh.Triangles[triangle].Step;
  if (step != TriangleStep::Next)
  {
    step = TriangleStep::Next;
    this->Next.push_back(triangle);
  }
}

IterationRecord RoundFlips::Iterate()
{
  IterationRecord record;
  const std::vector<std::int64_t> listed = std::exchange(this->Next, {});
  for (const std::int64_t t : listed)
  {
    this->Mesh.Triangles[t].Step = TriangleStep::Listed;
  }
  for (std::size_t i = 0; i < listed.size(); ++i)
  {
    constexpr std::size_t PrefetchDistance = 8;
    this->Mesh.PrefetchPoints(listed[std::min(i + PrefetchDistance, listed.size() - 1)]);
    this->Visit(listed[i], record);
  }
  for (const std::int64_t t : listed)
  {
    TriangleStep& step = this->Mesh.Triangles[t].Step;
    step = step == TriangleStep::Next ? step : TriangleStep::None;
  }
  record.NonDelaunay = record.Flipped + record.Blocked;
  return record;
}

/// Judges the edges of a triangle but those that have been judged, or will be in the next
/// iteration.
void RoundFlips::Visit(std::int64_t t, IterationRecord& record)
{
  const PieceTriangle& triangle = this->Mesh.Triangles[t];
  for (int slot = 0; slot < 3 && triangle.Step == TriangleStep::Listed; ++slot)
  {
    const PieceCorner one{ t, slot };
    const PieceCorner other = this->Mesh.FindOpenMate(one);
    if (other.Triangle < 0 || this->Mesh.Triangles[other.Triangle].Step >= TriangleStep::Visited)
    {
      continue;
    }
    const EdgeState state = this->Judge(one, other);
    ++record.Tested;
    record.Blocked += state != EdgeState::Good && state != EdgeState::Bad ? 1 : 0;
    if (state == EdgeState::Bad)
    {
      this->Flip(one, other);
      ++record.Flipped;
    }
  }
  if (triangle.Step == TriangleStep::Listed)
  {
    this->Mesh.Triangles[t].Step = TriangleStep::Visited;
  }
}

bool RoundFlips::HasBad()
{
  for (const std::int64_t t : this->Next)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const PieceCorner other = this->Mesh.FindOpenMate({ t, slot });
      if (other.Triangle >= 0 && this->Judge({ t, slot }, other) == EdgeState::Bad)
      {
        return true;
      }
    }
  }
  return false;
}

EdgeState RoundFlips::Judge(const PieceCorner& one, const PieceCorner& other) const
{
  const EdgeState state = this->Rule.Judge(this->Mesh, one, other);
  const bool isForbidden = this->NeedsGuard && state == EdgeState::Bad &&
    this->IsForbidden(this->Mesh.Triangles[one.Triangle].Points[one.Slot],
      this->Mesh.Triangles[other.Triangle].Points[other.Slot]);
  return isForbidden ? EdgeState::BlockedByEdge : state;
}

/// Whether the edge between two points exists, or may exist on another rank.
bool RoundFlips::IsForbidden(std::int32_t a, std::int32_t b) const
{
  return (this->Mesh.IsShared(a) && this->Mesh.IsShared(b)) || this->Mesh.HasEdge({ a, b });
}

void RoundFlips::Flip(const PieceCorner& one, const PieceCorner& other)
{
  const std::int32_t from = this->Mesh.Triangles[one.Triangle].GetStart(one.Slot);
  const std::int32_t to = this->Mesh.Triangles[one.Triangle].GetEnd(one.Slot);
  this->Mesh.Flip(one, other);
  this->Add(one.Triangle);
  this->Add(other.Triangle);
  if (this->NeedsGuard)
  {
    this->AddFreed(from, to);
  }
}

void RoundFlips::AddFreed(std::int32_t from, std::int32_t to)
{
  this->Mesh.ForEachAt(from,
    [&](const PieceCorner& corner)
    {
      const PieceCorner mate = this->Mesh.FindOpenMate(corner);
      if (mate.Triangle >= 0 && this->Mesh.Triangles[mate.Triangle].Points[mate.Slot] == to)
      {
        this->Add(corner.Triangle);
      }
    });
}

}
