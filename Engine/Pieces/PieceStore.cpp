// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceStore.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
PieceOrigin FindOrigin(const std::vector<std::int64_t>& firsts, std::int64_t number)
{
  const auto after = std::upper_bound(firsts.begin(), firsts.end(), number);
  const auto rank = static_cast<std::int32_t>(after - firsts.begin() - 1);
  return { rank, number - firsts[rank] };
}

class PieceStore
{
public:
  PieceStore(const PieceMesh& mesh, const std::vector<std::int64_t>& firstOrigins, int rank,
    FlippedPiece& flipped)
    : Mesh(mesh),
      FirstOrigins(firstOrigins),
      Rank(rank),
      Flipped(flipped),
      IdOfReceived(mesh.GetNumberOfPoints() - mesh.GetFirstReceived(), -1)
  {
  }

  void Run()
  {
    const PieceTriangles& triangles = this->Mesh.Triangles;
    this->Flipped.Triangles.reserve(3 * triangles.size());
    this->Flipped.Origins.reserve(triangles.size());
    this->Flipped.FlipCounts.reserve(triangles.size());
    const std::int64_t inOrder = this->CountInOrder();
    const std::vector<std::int64_t> others = this->SortOthers(inOrder);
    auto next = others.begin();
    for (std::int64_t t = 0; t < inOrder; ++t)
    {
      for (; next != others.end() && this->IsBefore(*next, t); ++next)
      {
        this->StoreTriangle(triangles[*next]);
      }
      if (!triangles[t].HasLeft)
      {
        this->StoreTriangle(triangles[t]);
      }
    }
    std::for_each(next, others.end(), [&](std::int64_t t) { this->StoreTriangle(triangles[t]); });
  }

private:
  bool IsOwn(const PieceTriangle& triangle) const
  {
    return this->FirstOrigins[this->Rank] <= triangle.Origin &&
      triangle.Origin < this->FirstOrigins[this->Rank + 1];
  }

  /// The order in which a caller gets triangles.
  bool IsBefore(std::int64_t a, std::int64_t b) const
  {
    const PieceTriangles& triangles = this->Mesh.Triangles;
    const bool isOwn = this->IsOwn(triangles[a]);
    return isOwn == this->IsOwn(triangles[b]) ? triangles[a].Origin < triangles[b].Origin : isOwn;
  }

  /// Triangles before this one are in order, as those that have never left are.
  std::int64_t CountInOrder() const
  {
    const auto size = static_cast<std::int64_t>(this->Mesh.Triangles.size());
    std::int64_t t = std::min<std::int64_t>(1, size);
    while (t < size && this->IsBefore(t - 1, t))
    {
      ++t;
    }
    return t;
  }

  std::vector<std::int64_t> SortOthers(std::int64_t inOrder) const
  {
    const PieceTriangles& triangles = this->Mesh.Triangles;
    std::vector<std::int64_t> others;
    for (auto t = inOrder; t < static_cast<std::int64_t>(triangles.size()); ++t)
    {
      if (!triangles[t].HasLeft)
      {
        others.push_back(t);
      }
    }
    std::sort(others.begin(), others.end(),
      [this](std::int64_t a, std::int64_t b) { return this->IsBefore(a, b); });
    return others;
  }

  void StoreTriangle(const PieceTriangle& triangle)
  {
    this->Flipped.Origins.push_back(this->IsOwn(triangle)
        ? PieceOrigin{ this->Rank, triangle.Origin - this->FirstOrigins[this->Rank] }
        : FindOrigin(this->FirstOrigins, triangle.Origin));
    this->Flipped.FlipCounts.push_back(triangle.Flips);
    for (const std::int32_t point : triangle.Points)
    {
      this->Flipped.Triangles.push_back(this->StorePoint(point));
    }
  }

  /// @returns the id that a point has in the result.
  std::int64_t StorePoint(std::int64_t point)
  {
    const std::int64_t first = this->Mesh.GetFirstReceived();
    if (point < first)
    {
      return point;
    }
    std::int64_t& id = this->IdOfReceived[point - first];
    if (id < 0)
    {
      id = first + static_cast<std::int64_t>(this->Flipped.ReceivedPoints.size());
      double x[3];
      this->Mesh.GetPosition(point, x);
      this->Flipped.ReceivedPoints.push_back(this->Mesh.FindOrigin(point));
      this->Flipped.ReceivedCoordinates.insert(this->Flipped.ReceivedCoordinates.end(), x, x + 3);
    }
    return id;
  }

  const PieceMesh& Mesh;
  const std::vector<std::int64_t>& FirstOrigins;
  int Rank;
  FlippedPiece& Flipped;
  std::vector<std::int64_t> IdOfReceived; ///< Ids of received points in the result; -1: not yet.
};
}

void StorePiece(const PieceMesh& mesh, const std::vector<std::int64_t>& firstOrigins, int rank,
  FlippedPiece& flipped)
{
  flipped = FlippedPiece();
  PieceStore(mesh, firstOrigins, rank, flipped).Run();
}

}
