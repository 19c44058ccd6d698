// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereSegments.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <tuple>

namespace delaunayflip
{

bool AreOpposite(const PlanePoint& a, const PlanePoint& b, double rounding)
{
  const Vector3 first = FindDirection(a), second = FindDirection(b);
  const Vector3 cross = Cross(first, second);
  return Dot(first, second) < 0.0 && Dot(cross, cross) <= rounding * rounding;
}

SphereSegments::SphereSegments(const SpacePoints& points,
  const std::vector<std::int32_t>& neighbors, std::vector<std::int32_t>& triangles)
  : Points(points),
    Triangles(triangles),
    Twins(triangles.size(), None),
    SegmentOf(triangles.size(), None),
    CornerOf(points.size(), None)
{
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const auto corner = static_cast<std::int32_t>(i);
    this->CornerOf[triangles[i]] = corner;
    if (neighbors[i] == None)
    {
      continue;
    }
    const std::int32_t from = triangles[Next(corner)], to = triangles[Previous(corner)];
    std::int32_t twin = 3 * neighbors[i];
    while (triangles[twin] == from || triangles[twin] == to)
    {
      ++twin;
    }
    this->Twins[i] = twin;
  }
}

/// 1 if a point is to the left of the great circle from one point to another, -1 to the right.
int SphereSegments::FindSide(std::int32_t from, std::int32_t to, std::int32_t point) const
{
  return FindOrientation3D(this->Points[from], this->Points[to], this->Points[point], Origin);
}

SphereSegments::OutcomeKind SphereSegments::Insert(
  std::int32_t from, std::int32_t to, std::int32_t segment)
{
  if (this->CornerOf[from] == None || this->CornerOf[to] == None)
  {
    return OutcomeKind::HasNoTriangle;
  }
  this->Stretches.clear();
  this->Crossed = None;
  if (!this->Walk(from, to))
  {
    return OutcomeKind::HasNoTriangle;
  }
  if (this->Crossed != None)
  {
    return OutcomeKind::Crosses;
  }
  // No two stretches cross the same triangle, because triangles are convex.
  for (const Stretch& stretch : this->Stretches)
  {
    if (!stretch.Crossing.empty())
    {
      this->Replace(stretch, segment);
      continue;
    }
    const Departure departure = this->Depart(stretch.From, stretch.To);
    this->Note(departure.Corner, stretch.From, stretch.To, segment);
  }
  return OutcomeKind::Inserted;
}

//------------------------------------------------------------------------------
/// Lists the stretches of a segment, and finds what it crosses.
/// @returns false if it leaves the mesh.
bool SphereSegments::Walk(std::int32_t from, std::int32_t to)
{
  std::int32_t at = from;
  while (at != to)
  {
    if (!this->WalkStretch(at, to))
    {
      return false;
    }
    at = this->Stretches.back().To;
  }
  return true;
}

/// Goes to the next vertex on a segment.
bool SphereSegments::WalkStretch(std::int32_t from, std::int32_t to)
{
  Stretch stretch{ from, to, {} };
  const Departure departure = this->Depart(from, to);
  if (departure.Vertex != None)
  {
    stretch.To = departure.Vertex;
    this->Stretches.push_back(stretch);
    return true;
  }
  std::int32_t corner = departure.Corner;
  while (corner != None)
  {
    const std::int32_t earlier = this->SegmentOf[corner];
    const bool isFirst = this->Crossed == None || earlier < this->Crossed;
    if (earlier != None && isFirst)
    {
      this->Crossed = earlier;
    }
    stretch.Crossing.push_back(corner);
    const std::int32_t far = this->Twins[corner];
    if (far == None)
    {
      return false;
    }
    const std::int32_t vertex = this->Triangles[far];
    const int side = vertex == to ? 0 : this->FindSide(from, to, vertex);
    if (side == 0)
    {
      stretch.To = vertex;
      this->Stretches.push_back(stretch);
      return true;
    }
    corner = side > 0 ? Next(far) : Previous(far);
  }
  return false;
}

/// Tells whether a segment leaves the corner's vertex through its triangle, or along a side of it.
SphereSegments::Departure SphereSegments::LookAt(std::int32_t corner, std::int32_t to) const
{
  const std::int32_t from = this->Triangles[corner];
  const std::int32_t right = this->Triangles[Next(corner)];
  const std::int32_t left = this->Triangles[Previous(corner)];
  const int ofRight = this->FindSide(from, to, right), ofLeft = this->FindSide(from, to, left);
  if (ofRight == 0 && ofLeft > 0)
  {
    return { Previous(corner), right };
  }
  if (ofLeft == 0 && ofRight < 0)
  {
    return { Next(corner), left };
  }
  if (ofRight < 0 && ofLeft > 0)
  {
    return { corner, None };
  }
  return { None, None };
}

/// Goes to the next triangle around a corner's vertex, counter-clockwise or clockwise.
/// @returns its corner at that vertex, or None at the boundary.
std::int32_t SphereSegments::Turn(std::int32_t corner, bool isClockwise) const
{
  const std::int32_t twin = this->Twins[isClockwise ? Previous(corner) : Next(corner)];
  if (twin == None)
  {
    return None;
  }
  return isClockwise ? Previous(twin) : Next(twin);
}

/// Looks around the first vertex, counter-clockwise, and clockwise if the boundary is met.
SphereSegments::Departure SphereSegments::Depart(std::int32_t from, std::int32_t to) const
{
  const std::int32_t first = this->CornerOf[from];
  for (const bool isClockwise : { false, true })
  {
    std::int32_t corner = first;
    do
    {
      const Departure departure = this->LookAt(corner, to);
      if (departure.Corner != None)
      {
        return departure;
      }
      corner = this->Turn(corner, isClockwise);
    } while (corner != None && corner != first);
  }
  return { None, None };
}

/// Notes that a segment follows the edge opposite to a corner.
void SphereSegments::Note(
  std::int32_t corner, std::int32_t from, std::int32_t to, std::int32_t segment)
{
  const bool isFirst = this->SegmentOf[corner] == None;
  this->Edges.push_back({ from, to, segment, isFirst });
  if (!isFirst)
  {
    return;
  }
  this->SegmentOf[corner] = segment;
  const std::int32_t twin = this->Twins[corner];
  if (twin != None)
  {
    this->SegmentOf[twin] = segment;
  }
}

//------------------------------------------------------------------------------
/// Replaces the triangles that a stretch crosses by others, of which it is an edge.
void SphereSegments::Replace(const Stretch& stretch, std::int32_t segment)
{
  this->Replaced += static_cast<std::int64_t>(stretch.Crossing.size());
  this->TakeRim(stretch);
  this->Made.clear();
  this->Fill(this->Left);
  std::reverse(this->Right.begin(), this->Right.end());
  this->Fill(this->Right);
  this->Connect(stretch, segment);
}

/// Lists the triangles of a channel, the vertices on both sides of it, and its sides.
void SphereSegments::TakeRim(const Stretch& stretch)
{
  const std::int32_t first = stretch.Crossing.front();
  this->Channel = { first / 3 };
  this->Left = { stretch.From, this->Triangles[Previous(first)] };
  this->Right = { stretch.From, this->Triangles[Next(first)] };
  std::vector<std::int32_t> sides = { Next(first), Previous(first) }; // corners opposite to them
  for (std::size_t i = 0; i < stretch.Crossing.size(); ++i)
  {
    const std::int32_t far = this->Twins[stretch.Crossing[i]];
    this->Channel.push_back(far / 3);
    if (i + 1 == stretch.Crossing.size())
    {
      sides.insert(sides.end(), { Next(far), Previous(far) });
      break;
    }
    const bool isOnLeft = stretch.Crossing[i + 1] == Next(far);
    (isOnLeft ? this->Left : this->Right).push_back(this->Triangles[far]);
    sides.push_back(isOnLeft ? Previous(far) : Next(far));
  }
  this->Left.push_back(stretch.To);
  this->Right.push_back(stretch.To);
  std::vector<std::int32_t> sorted = this->Channel;
  std::sort(sorted.begin(), sorted.end());
  this->Rim.clear();
  for (const std::int32_t side : sides)
  {
    std::int32_t twin = this->Twins[side];
    const bool isInside =
      twin != None && std::binary_search(sorted.begin(), sorted.end(), twin / 3);
    if (isInside)
    {
      twin = None; // an edge that ends within the channel: both of its sides are listed
    }
    this->Rim.push_back({ this->Triangles[Next(side)], this->Triangles[Previous(side)], twin,
      this->SegmentOf[side] });
  }
}

/// Makes triangles between a stretch and the vertices to the left of it. Every vertex of the chain
/// sees the stretch, in this order, so a vertex at which the chain turns towards the stretch can be
/// cut off: the triangle that does it holds no other vertex.
/// @param chain the vertices, from one end of the stretch to the other.
void SphereSegments::Fill(const std::vector<std::int32_t>& chain)
{
  std::vector<std::int32_t> kept; // of the chain, before the vertex at hand
  for (const std::int32_t vertex : chain)
  {
    while (kept.size() >= 2)
    {
      const std::int32_t from = kept[kept.size() - 2], ear = kept.back();
      if (this->FindSide(from, vertex, ear) <= 0)
      {
        break;
      }
      this->Made.insert(this->Made.end(), { from, vertex, ear });
      kept.pop_back();
    }
    kept.push_back(vertex);
  }
}

/// Writes the new triangles to the slots of the old ones, and finds out what is across their sides.
void SphereSegments::Connect(const Stretch& stretch, std::int32_t segment)
{
  std::vector<NewSide> sides;
  for (std::size_t i = 0; i < this->Made.size(); ++i)
  {
    const std::int32_t corner = 3 * this->Channel[i / 3] + static_cast<std::int32_t>(i % 3);
    this->Triangles[corner] = this->Made[i];
    this->Twins[corner] = this->SegmentOf[corner] = None;
    this->CornerOf[this->Made[i]] = corner;
  }
  for (std::size_t i = 0; i < this->Made.size(); ++i)
  {
    const std::int32_t corner = 3 * this->Channel[i / 3] + static_cast<std::int32_t>(i % 3);
    sides.push_back({ this->Triangles[Next(corner)], this->Triangles[Previous(corner)], corner });
  }
  const auto isBefore = [](const auto& a, const auto& b)
  { return std::tie(a.From, a.To) < std::tie(b.From, b.To); };
  std::sort(sides.begin(), sides.end(), isBefore);
  std::sort(this->Rim.begin(), this->Rim.end(), isBefore);
  for (const NewSide& side : sides)
  {
    const auto outer = std::lower_bound(this->Rim.begin(), this->Rim.end(), side, isBefore);
    const bool isOuter =
      outer != this->Rim.end() && outer->From == side.From && outer->To == side.To;
    if (isOuter)
    {
      this->SegmentOf[side.Corner] = outer->Segment;
      this->Twins[side.Corner] = outer->Twin;
    }
    const NewSide back{ side.To, side.From, None };
    const auto across = std::lower_bound(sides.begin(), sides.end(), back, isBefore);
    const bool isInner =
      across != sides.end() && across->From == back.From && across->To == back.To;
    if (isInner)
    {
      this->Twins[side.Corner] = across->Corner;
    }
    if (this->Twins[side.Corner] != None)
    {
      this->Twins[this->Twins[side.Corner]] = side.Corner;
    }
  }
  const NewSide made{ stretch.From, stretch.To, None };
  const auto edge = std::lower_bound(sides.begin(), sides.end(), made, isBefore);
  this->Note(edge->Corner, stretch.From, stretch.To, segment);
}

}
