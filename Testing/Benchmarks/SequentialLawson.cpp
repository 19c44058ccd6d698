// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SequentialLawson.h"

#include "Predicates.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{

std::int32_t Next(std::int32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::int32_t Previous(std::int32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

struct Side
{
  std::uint64_t Ends; ///< Smaller vertex id above the larger.
  std::int32_t Corner;
};

}

SequentialLawson::SequentialLawson(const OwnedMesh<float>& mesh)
  : Vertices(mesh.Triangles)
{
  for (std::int64_t i = 0; i < mesh.NumberOfPoints(); ++i)
  {
    this->Points.push_back(mesh.Points[3 * i]);
    this->Points.push_back(mesh.Points[3 * i + 1]);
  }
  this->FindNeighbors();
}

void SequentialLawson::FindNeighbors()
{
  const auto corners = static_cast<std::int32_t>(this->Vertices.size());
  std::vector<Side> sides;
  sides.reserve(this->Vertices.size());
  for (std::int32_t corner = 0; corner < corners; ++corner)
  {
    const auto [low, high] =
      std::minmax({ this->Vertices[Next(corner)], this->Vertices[Previous(corner)] });
    sides.push_back({ std::uint64_t(low) << 32 | std::uint64_t(high), corner });
  }
  std::sort(
    sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.Ends < b.Ends; });
  this->Twins.assign(this->Vertices.size(), -1);
  this->IsStacked.assign(this->Vertices.size(), 0);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
  {
    if (sides[i].Ends == sides[i + 1].Ends)
    {
      this->Link(sides[i].Corner, sides[i + 1].Corner);
    }
  }
}

void SequentialLawson::Link(std::int32_t corner, std::int32_t twin)
{
  this->Twins[corner] = twin;
  if (twin >= 0)
  {
    this->Twins[twin] = corner;
  }
}

void SequentialLawson::Push(std::int32_t corner)
{
  if (this->Twins[corner] >= 0 && !this->IsStacked[corner])
  {
    this->IsStacked[corner] = 1;
    this->Stack.push_back(corner);
  }
}

std::int64_t SequentialLawson::Run()
{
  const auto corners = static_cast<std::int32_t>(this->Vertices.size());
  for (std::int32_t corner = 0; corner < corners; ++corner)
  {
    if (corner < this->Twins[corner])
    {
      this->Push(corner);
    }
  }
  std::int64_t flips = 0;
  while (!this->Stack.empty())
  {
    const std::int32_t corner = this->Stack.back();
    this->Stack.pop_back();
    this->IsStacked[corner] = 0;
    if (this->Twins[corner] >= 0 && this->IsBad(corner))
    {
      this->Flip(corner);
      ++flips;
    }
  }
  return flips;
}

bool SequentialLawson::IsBad(std::int32_t corner) const
{
  const auto point = [this](std::int32_t c) { return &this->Points[2 * this->Vertices[c]]; };
  return InCircle(point(corner), point(Next(corner)), point(Previous(corner)),
           point(this->Twins[corner])) > 0;
}

/// Triangles (a, p, q) and (b, q, p) become (a, p, b) and (b, q, a).
void SequentialLawson::Flip(std::int32_t a)
{
  const std::int32_t b = this->Twins[a];
  const std::int32_t p = Next(a);
  const std::int32_t q = Previous(a);
  const std::int32_t qOfB = Next(b);
  const std::int32_t pOfB = Previous(b);
  const std::int32_t acrossQA = this->Twins[p];
  const std::int32_t acrossPB = this->Twins[qOfB];
  this->Vertices[q] = this->Vertices[b];
  this->Vertices[pOfB] = this->Vertices[a];
  this->Link(a, acrossPB);
  this->Link(b, acrossQA);
  this->Link(p, qOfB);
  for (std::int32_t corner : { a, q, b, pOfB })
  {
    this->Push(corner);
  }
}

}
