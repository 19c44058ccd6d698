// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartMesh.h"

#include "FlipError.h"
#include "SmallestAngle.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"

namespace delaunayflip
{

void PointStars::Begin(std::int64_t triangles, std::int64_t capacity, std::int64_t points)
{
  this->First.assign(points, None);
  this->Links.reserve(3 * capacity);
  this->Links.resize(3 * triangles);
}

void PointStars::Add(const PartCorner& corner, std::int32_t point)
{
  const auto number = static_cast<std::uint32_t>(3 * corner.Triangle + corner.Slot);
  if (number >= this->Links.size())
  {
    this->Links.resize(number + std::size_t(1));
  }
  if (static_cast<std::size_t>(point) >= this->First.size())
  {
    this->First.resize(static_cast<std::size_t>(point) + 1, None);
  }
  const std::uint32_t next = this->First[point];
  this->Links[number] = { next, None };
  this->First[point] = number;
  if (next != None)
  {
    this->Links[next].Previous = number;
  }
}

void PointStars::Remove(const PartCorner& corner, std::int32_t point)
{
  const Link link = this->Links[3 * corner.Triangle + corner.Slot];
  if (link.Previous != None)
  {
    this->Links[link.Previous].Next = link.Next;
  }
  else
  {
    this->First[point] = link.Next;
  }
  if (link.Next != None)
  {
    this->Links[link.Next].Previous = link.Previous;
  }
}

//------------------------------------------------------------------------------
PartMesh::PartMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin)
  : Given(piece.Mesh.Points),
    Points(std::move(keys)),
    Rank(rank),
    FirstOwnKey(Points.Owners.Firsts[rank])
{
  this->Points.Closed = this->Points.Used = std::vector<unsigned char>();
  for (std::int64_t i = 0; i < this->Given.Count; ++i)
  {
    if (this->GetKey(i) != this->FirstOwnKey + i)
    {
      this->OtherKeys.emplace(this->GetKey(i), static_cast<std::int32_t>(i));
    }
    if (this->IsShared(i))
    {
      this->SharedPoints.push_back(static_cast<std::int32_t>(i));
    }
  }
  constexpr std::int64_t PartToReceive = 16; // so that the first arrival does not copy all
  const std::int64_t count = piece.Mesh.Triangles.Count;
  this->Triangles.reserve(count + count / PartToReceive);
  this->Triangles.resize(count);
  for (std::int64_t t = 0; t < count; ++t)
  {
    this->Triangles[t].Origin = firstOrigin + t;
  }
  this->Take(piece.Mesh.Triangles);
}

void PartMesh::Take(const TriangleArray& triangles)
{
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Triangles[t].Points[slot] = static_cast<std::int32_t>(triangles.Get(t, slot));
    }
  }
}

std::int64_t PartMesh::FindPoint(std::int64_t key) const
{
  const std::int64_t own = key - this->FirstOwnKey;
  if (own >= 0 && own < this->Given.Count)
  {
    return this->GetKey(own) == key ? own : -1;
  }
  const auto other = this->OtherKeys.find(key);
  return other != this->OtherKeys.end() ? other->second : -1;
}

//------------------------------------------------------------------------------
AngleSums PartMesh::MeasureAngles(const PartSurvey& survey, int threads) const
{
  return delaunayflip::MeasureAngles(SizeOf(this->Triangles), survey, ThreadBackend(threads),
    [&](std::int64_t t, double(&x)[3][3])
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        this->GetPosition(this->Triangles[t].Points[slot], x[slot]);
      }
      return !this->Triangles[t].HasLeft;
    });
}

void PartMesh::BeginRounds(const MarkedEdges& marks)
{
  const std::size_t count = this->Triangles.size();
  this->Stars.Begin(static_cast<std::int64_t>(count),
    static_cast<std::int64_t>(this->Triangles.capacity()), this->GetNumberOfPoints());
  for (auto t = static_cast<std::int64_t>(count); t-- > 0;) // lists begin with the first triangle
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Stars.Add({ t, slot }, this->Triangles[t].Points[slot]);
    }
  }
  for (const auto& [ends, mark] : marks) // in any order
  {
    const auto a = static_cast<std::int32_t>(ends[0]), b = static_cast<std::int32_t>(ends[1]);
    const auto visit = [&, mark = mark](const PartCorner& at)
    {
      PartTriangle& triangle = this->Triangles[at.Triangle];
      for (int slot = 0; slot < 3; ++slot)
      {
        if (triangle.HasEdge(slot, a, b))
        {
          triangle.SetMarks(slot, mark);
        }
      }
      return false;
    };
    this->Stars.FindAtEither(a, b, visit);
  }
  for (const std::int32_t point : this->SharedPoints)
  {
    this->NoteChangesAt(point);
  }
}

void PartMesh::NoteChange(std::int64_t t)
{
  if (!std::exchange(this->Triangles[t].IsNoted, true))
  {
    this->Changed.push_back(t);
  }
}

/// The 2-2 flip, as in EdgeFlip.h: t = (a, p, q) becomes (a, p, b), s = (b, q, p) becomes
/// (b, q, a).
void PartMesh::Flip(const PartCorner& one, const PartCorner& other)
{
  PartTriangle& t = this->Triangles[one.Triangle];
  PartTriangle& s = this->Triangles[other.Triangle];
  const int a = one.Slot;
  const int b = other.Slot;
  const int q = (a + 2) % 3; // the slots of t and s that change
  const int p = (b + 2) % 3;
  this->Stars.Remove({ one.Triangle, q }, t.Points[q]);
  this->Stars.Remove({ other.Triangle, p }, s.Points[p]);
  t.Points[q] = s.Points[b];
  s.Points[p] = t.Points[a];
  this->Stars.Add({ one.Triangle, q }, t.Points[q]);
  this->Stars.Add({ other.Triangle, p }, s.Points[p]);
  const unsigned char pb = s.GetMarks((b + 1) % 3);
  const unsigned char qa = t.GetMarks((a + 1) % 3);
  t.SetMarks(a, pb);
  t.SetMarks((a + 1) % 3, 0);
  s.SetMarks(b, qa);
  s.SetMarks((b + 1) % 3, 0);
  for (const std::int64_t changed : { one.Triangle, other.Triangle })
  {
    ++this->Triangles[changed].Flips;
    this->NoteChange(changed);
  }
}

void PartMesh::SetSeam(const PartCorner& corner)
{
  PartTriangle& triangle = this->Triangles[corner.Triangle];
  triangle.SetMarks(
    corner.Slot, static_cast<unsigned char>(triangle.GetMarks(corner.Slot) | SeamMark));
  this->NoteChange(corner.Triangle);
}

void PartMesh::ClearSeam(const PartCorner& corner)
{
  PartTriangle& triangle = this->Triangles[corner.Triangle];
  triangle.SetMarks(
    corner.Slot, static_cast<unsigned char>(triangle.GetMarks(corner.Slot) & FixedMark));
  this->LostSeams.push_back(this->GetKeys(triangle.GetEdge(corner.Slot)));
}

std::vector<std::int64_t> PartMesh::TakeChanged()
{
  for (const std::int64_t t : this->Changed)
  {
    this->Triangles[t].IsNoted = false;
  }
  return std::exchange(this->Changed, {});
}

//------------------------------------------------------------------------------
PartCorner PartMesh::FindMate(const PartCorner& corner) const
{
  const PartTriangle& triangle = this->Triangles[corner.Triangle];
  if (!triangle.HasEdges())
  {
    return {};
  }
  return this->FindEdge(
    triangle.GetStart(corner.Slot), triangle.GetEnd(corner.Slot), corner.Triangle);
}

/// A corner opposite to an edge between two points, in any triangle but one; or none.
PartCorner PartMesh::FindEdge(std::int32_t start, std::int32_t end, std::int64_t except) const
{
  PartCorner found;
  this->Stars.FindAtEither(start, end,
    [&](const PartCorner& at)
    {
      const PartTriangle& other = this->Triangles[at.Triangle];
      for (const int slot : { (at.Slot + 1) % 3, (at.Slot + 2) % 3 })
      {
        if (at.Triangle != except && other.HasEdge(slot, start, end))
        {
          found = { at.Triangle, slot };
        }
      }
      return found.Triangle >= 0;
    });
  return found;
}

PartCorner PartMesh::FindOpenMate(const PartCorner& corner) const
{
  if (this->Triangles[corner.Triangle].GetMarks(corner.Slot) != 0)
  {
    return {};
  }
  return this->FindMate(corner);
}

void PartMesh::PrefetchPoints(std::int64_t triangle) const
{
  for (const std::int32_t point : this->Triangles[triangle].Points)
  {
    if (point < this->Given.Count)
    {
      this->Given.Prefetch(point);
    }
  }
}

//------------------------------------------------------------------------------
std::vector<TravellingTriangle> PartMesh::Release(const std::vector<std::int64_t>& triangles)
{
  std::vector<TravellingTriangle> packed;
  for (const std::int64_t t : triangles)
  {
    PartTriangle& triangle = this->Triangles[t];
    TravellingTriangle& to = packed.emplace_back();
    to.Triangle = triangle;
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t point = triangle.Points[slot];
      to.Keys[slot] = this->GetKey(point);
      this->GetPosition(point, to.Coordinates[slot]);
      if (triangle.Has(SeamMark, slot))
      {
        this->LostSeams.push_back(this->GetKeys(triangle.GetEdge(slot)));
      }
      this->Stars.Remove({ t, slot }, point);
      this->SharePoint(point);
    }
    triangle.HasLeft = true;
  }
  return packed;
}

std::int64_t PartMesh::Receive(const TravellingTriangle& packed)
{
  // Corners are numbered by 32 bits, and two numbers mean something else.
  constexpr std::size_t Most = (std::numeric_limits<std::uint32_t>::max() - 1) / 3;
  if (this->Triangles.size() == Most)
  {
    throw MeshTooLarge("a piece has too many triangles: divide the mesh among more ranks");
  }
  const auto t = SizeOf(this->Triangles);
  this->Triangles.push_back(packed.Triangle);
  PartTriangle& triangle = this->Triangles[t];
  triangle.IsNoted = false;
  triangle.Visit = VisitState::None;
  for (int slot = 0; slot < 3; ++slot)
  {
    triangle.Points[slot] = this->FindOrAddPoint(packed.Keys[slot], packed.Coordinates[slot]);
    this->SharePoint(triangle.Points[slot]);
    this->Stars.Add({ t, slot }, triangle.Points[slot]);
  }
  this->NoteChange(t);
  return t;
}

void PartMesh::SharePoint(std::int32_t point)
{
  if (!this->IsShared(point))
  {
    this->Points.Shared[point] = 1;
    this->SharedPoints.push_back(point);
    this->NoteChangesAt(point);
  }
}

/// Takes the triangles at a point for changed ones.
void PartMesh::NoteChangesAt(std::int32_t point)
{
  this->Stars.ForEach(point, [&](const PartCorner& corner) { this->NoteChange(corner.Triangle); });
}

std::int32_t PartMesh::FindOrAddPoint(std::int64_t key, const double (&x)[3])
{
  const std::int64_t known = this->FindPoint(key);
  if (known >= 0)
  {
    return static_cast<std::int32_t>(known);
  }
  if (this->GetNumberOfPoints() == std::numeric_limits<std::int32_t>::max())
  {
    throw MeshTooLarge("a piece has more than 2^31 points: divide the mesh among more ranks");
  }
  const auto point = static_cast<std::int32_t>(this->Points.Keys.size());
  this->Points.Keys.push_back(key);
  this->Points.Shared.push_back(0);
  this->Received.insert(this->Received.end(), x, x + 3);
  this->OtherKeys.emplace(key, point);
  return point;
}

}
