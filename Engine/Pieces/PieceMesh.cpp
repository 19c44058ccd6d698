// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceMesh.h"

#include "FlipError.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace delaunayflip
{

PieceMesh::PieceMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin)
  : Shared(std::move(keys.Shared)),
    Given(piece.Mesh.Points),
    Keys(std::move(keys.Keys)),
    FirstOwnKey(keys.FirstKeys[rank])
{
  keys.Keys.clear();
  keys.Shared.clear();
  keys.Closed = std::vector<unsigned char>();
  this->Numbers = std::move(keys);
  for (std::int64_t i = 0; i < this->Given.Count; ++i)
  {
    if (this->Keys[i] != this->FirstOwnKey + i)
    {
      this->OtherKeys.emplace(this->Keys[i], static_cast<std::int32_t>(i));
    }
  }
  for (std::size_t i = 0; i < this->Shared.size(); ++i)
  {
    if (this->Shared[i])
    {
      this->SharedPoints.push_back(static_cast<std::int32_t>(i));
    }
  }
  const TriangleArray& triangles = piece.Mesh.Triangles;
  constexpr std::int64_t PartToReceive = 16; // so that the first arrival does not copy all
  this->Triangles.reserve(triangles.Count + triangles.Count / PartToReceive);
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    PieceTriangle triangle{};
    triangle.Origin = firstOrigin + t;
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.Points[slot] = static_cast<std::int32_t>(triangles.Get(t, slot));
    }
    this->Triangles.push_back(triangle);
  }
}

std::int64_t PieceMesh::FindPoint(std::int64_t key) const
{
  const std::int64_t own = key - this->FirstOwnKey;
  if (own >= 0 && own < this->Given.Count)
  {
    return this->Keys[own] == key ? own : -1;
  }
  const auto other = this->OtherKeys.find(key);
  return other != this->OtherKeys.end() ? other->second : -1;
}

void PieceMesh::GetPosition(std::int64_t point, double (&x)[3]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    x[axis] = point < this->Given.Count ? this->Given.Get(point, axis)
                                        : this->Received[3 * (point - this->Given.Count) + axis];
  }
}

//------------------------------------------------------------------------------
void PieceMesh::BeginRounds()
{
  this->Stars.AddAll(this->Triangles, this->GetNumberOfPoints());
  for (std::size_t t = 0; t < this->Triangles.size(); ++t)
  {
    this->NoteSeams(static_cast<std::int64_t>(t));
  }
}

void PieceMesh::EndRounds()
{
  const auto hasLeft = [](const PieceTriangle& triangle) { return triangle.HasLeft; };
  this->Triangles.erase(
    std::remove_if(this->Triangles.begin(), this->Triangles.end(), hasLeft), this->Triangles.end());
  for (PieceTriangle& triangle : this->Triangles)
  {
    triangle.Marks = 0;
    triangle.IsNoted = false;
  }
  this->Stars = PointStars();
  this->Changed.clear();
  this->MayHaveSeams.clear();
  this->LostSeams.clear();
}

void PieceMesh::NoteSeams(std::int64_t t)
{
  PieceTriangle& triangle = this->Triangles[t];
  if (triangle.HasSeam() && !triangle.IsNoted)
  {
    triangle.IsNoted = true;
    this->MayHaveSeams.push_back(t);
  }
}

void PieceMesh::SetSeam(const PieceCorner& corner)
{
  this->Triangles[corner.Triangle].Set(SeamMark, corner.Slot);
  this->NoteSeams(corner.Triangle);
}

void PieceMesh::ClearSeam(const PieceCorner& corner)
{
  PieceTriangle& triangle = this->Triangles[corner.Triangle];
  triangle.Clear(SeamMark, corner.Slot);
  this->LostSeams.push_back(this->GetKeys(triangle.GetEdge(corner.Slot)));
}

std::vector<PieceCorner> PieceMesh::TakeNewSeams()
{
  std::vector<PieceCorner> corners;
  for (const std::int64_t t : this->MayHaveSeams)
  {
    PieceTriangle& triangle = this->Triangles[t];
    triangle.IsNoted = false;
    for (int slot = 0; slot < 3 && !triangle.HasLeft; ++slot)
    {
      if (triangle.Has(SeamMark, slot))
      {
        corners.push_back({ t, slot });
      }
    }
  }
  this->MayHaveSeams.clear();
  return corners;
}

//------------------------------------------------------------------------------
PieceCorner PieceMesh::FindMate(const PieceCorner& corner) const
{
  const PieceTriangle& triangle = this->Triangles[corner.Triangle];
  const std::int32_t start = triangle.GetStart(corner.Slot);
  const std::int32_t end = triangle.GetEnd(corner.Slot);
  PieceCorner mate{ -1, 0 };
  this->Stars.ForEach(start,
    [&](std::int64_t t)
    {
      const PieceTriangle& other = this->Triangles[t];
      const bool hasEnd =
        other.Points[0] == end || other.Points[1] == end || other.Points[2] == end;
      for (int slot = 0; slot < 3 && hasEnd && t != corner.Triangle; ++slot)
      {
        mate = other.HasEdge(slot, start, end) ? PieceCorner{ t, slot } : mate;
      }
    });
  return mate;
}

PieceCorner PieceMesh::FindOpenMate(const PieceCorner& corner) const
{
  const PieceTriangle& triangle = this->Triangles[corner.Triangle];
  const bool isMarked = triangle.Has(FixedMark, corner.Slot) || triangle.Has(SeamMark, corner.Slot);
  return isMarked ? PieceCorner{ -1, 0 } : this->FindMate(corner);
}

bool PieceMesh::HasEdge(const PointPair& ends) const
{
  bool has = false;
  this->Stars.ForEach(static_cast<std::int32_t>(ends[0]),
    [&](std::int64_t t)
    {
      const std::int32_t(&points)[3] = this->Triangles[t].Points;
      has = has || std::find(points, points + 3, ends[1]) != points + 3;
    });
  return has;
}

//------------------------------------------------------------------------------
TravellingTriangle PieceMesh::Pack(const PieceTriangle& triangle) const
{
  TravellingTriangle packed{};
  for (int slot = 0; slot < 3; ++slot)
  {
    packed.Keys[slot] = this->GetKey(triangle.Points[slot]);
    this->GetPosition(triangle.Points[slot], packed.Coordinates[slot]);
  }
  packed.Origin = triangle.Origin;
  packed.Flips = triangle.Flips;
  packed.Marks = triangle.Marks;
  return packed;
}

std::vector<TravellingTriangle> PieceMesh::Release(const std::vector<std::int64_t>& triangles)
{
  this->Stars.Remove(this->Triangles, triangles);
  std::vector<TravellingTriangle> packed;
  for (const std::int64_t t : triangles)
  {
    packed.push_back(this->Pack(this->Triangles[t]));
    for (int slot = 0; slot < 3; ++slot)
    {
      if (this->Triangles[t].Has(SeamMark, slot))
      {
        this->LostSeams.push_back(this->GetKeys(this->Triangles[t].GetEdge(slot)));
      }
    }
    for (const std::int32_t point : this->Triangles[t].Points)
    {
      this->Share(point);
    }
    this->Triangles[t].HasLeft = true;
  }
  return packed;
}

std::int64_t PieceMesh::Receive(const TravellingTriangle& packed)
{
  // Corners are numbered by 32 bits, and two numbers mean something else.
  constexpr std::size_t Most = (std::numeric_limits<std::uint32_t>::max() - 1) / 3;
  if (this->Triangles.size() == Most)
  {
    throw MeshTooLarge("a piece has too many triangles: divide the mesh among more ranks");
  }
  PieceTriangle triangle{};
  for (int slot = 0; slot < 3; ++slot)
  {
    triangle.Points[slot] = this->FindOrAddPoint(packed.Keys[slot], packed.Coordinates[slot]);
    this->Share(triangle.Points[slot]);
  }
  triangle.Origin = packed.Origin;
  triangle.Flips = packed.Flips;
  triangle.Marks = packed.Marks;
  const auto t = static_cast<std::int64_t>(this->Triangles.size());
  this->Triangles.push_back(triangle);
  this->Stars.Add(this->Triangles, t);
  this->NoteSeams(t);
  this->Changed.push_back(t);
  return t;
}

void PieceMesh::Share(std::int32_t point)
{
  if (!this->Shared[point])
  {
    this->Shared[point] = 1;
    this->SharedPoints.push_back(point);
    this->Stars.ForEach(point, [&](std::int64_t t) { this->Changed.push_back(t); });
  }
}

std::int32_t PieceMesh::FindOrAddPoint(std::int64_t key, const double (&x)[3])
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
  const auto point = static_cast<std::int32_t>(this->Keys.size());
  this->Keys.push_back(key);
  this->Shared.push_back(0);
  this->Received.insert(this->Received.end(), x, x + 3);
  this->OtherKeys.emplace(key, point);
  return point;
}

}
