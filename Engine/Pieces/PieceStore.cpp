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
    const std::vector<std::int64_t> order = this->SortTriangles();
    this->Flipped.Triangles.reserve(3 * order.size());
    this->Flipped.Origins.reserve(order.size());
    this->Flipped.FlipCounts.reserve(order.size());
    for (const std::int64_t t : order)
    {
      const PieceTriangle& triangle = this->Mesh.Triangles[t];
      this->Flipped.Origins.push_back(FindOrigin(this->FirstOrigins, triangle.Origin));
      this->Flipped.FlipCounts.push_back(triangle.Flips);
      for (const std::int32_t point : triangle.Points)
      {
        this->Flipped.Triangles.push_back(this->StorePoint(point));
      }
    }
  }

private:
  bool IsOwn(const PieceTriangle& triangle) const
  {
    return this->FirstOrigins[this->Rank] <= triangle.Origin &&
      triangle.Origin < this->FirstOrigins[this->Rank + 1];
  }

  /// The triangles in the order in which a caller gets them.
  std::vector<std::int64_t> SortTriangles() const
  {
    const std::vector<PieceTriangle>& triangles = this->Mesh.Triangles;
    const auto isBefore = [&](std::int64_t a, std::int64_t b)
    {
      const bool isOwn = this->IsOwn(triangles[a]);
      return isOwn == this->IsOwn(triangles[b]) ? triangles[a].Origin < triangles[b].Origin : isOwn;
    };
    std::vector<std::int64_t> order;
    order.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      if (!triangles[t].HasLeft)
      {
        order.push_back(static_cast<std::int64_t>(t));
      }
    }
    // Those that have never left are in order.
    const auto received = std::is_sorted_until(order.begin(), order.end(), isBefore);
    std::sort(received, order.end(), isBefore);
    std::inplace_merge(order.begin(), received, order.end(), isBefore);
    return order;
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
