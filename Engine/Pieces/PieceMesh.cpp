// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceMesh.h"

#include "FlipError.h"

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
  const TriangleArray& triangles = piece.Mesh.Triangles;
  this->Triangles.resize(triangles.Count);
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    PieceTriangle& triangle = this->Triangles[t];
    triangle = PieceTriangle{};
    triangle.Origin = firstOrigin + t;
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.Points[slot] = static_cast<std::int32_t>(triangles.Get(t, slot));
    }
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

PieceTriangle PieceMesh::Unpack(const TravellingTriangle& packed)
{
  PieceTriangle triangle{};
  for (int slot = 0; slot < 3; ++slot)
  {
    triangle.Points[slot] = this->FindOrAddPoint(packed.Keys[slot], packed.Coordinates[slot]);
    this->Shared[triangle.Points[slot]] = 1;
  }
  triangle.Origin = packed.Origin;
  triangle.Flips = packed.Flips;
  triangle.Marks = packed.Marks;
  return triangle;
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
  this->Shared.push_back(1);
  this->Received.insert(this->Received.end(), x, x + 3);
  this->OtherKeys.emplace(key, point);
  return point;
}

}
