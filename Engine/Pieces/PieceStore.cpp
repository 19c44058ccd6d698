// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceStore.h"

#include <algorithm>
#include <iterator>
#include <utility>

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

  void StoreAll()
  {
    const PieceTriangles& triangles = this->Mesh.Triangles;
    this->Flipped.Triangles.reserve(3 * triangles.size());
    this->Flipped.FlipCounts.reserve(triangles.size());
    this->FindPlaces();
    for (std::size_t i = 0; i < this->Own.size(); ++i)
    {
      constexpr std::size_t PrefetchDistance = 16;
      const std::uint32_t later = this->Own[std::min(i + PrefetchDistance, this->Own.size() - 1)];
      if (later != Nowhere)
      {
        Prefetch(&triangles[later]);
      }
      if (this->Own[i] != Nowhere)
      {
        this->StoreTriangle(triangles[this->Own[i]]);
      }
      else
      {
        this->Flipped.GoneTriangles.push_back(static_cast<std::int64_t>(i));
      }
    }
    this->StoreOthers();
  }

  /// Overwrites the slots of listed triangles, closes those of triangles that have left, and adds
  /// those of other ranks.
  void StoreListed()
  {
    this->Flipped.GoneTriangles = this->OverwriteSlots();
    RemoveItems(this->Flipped.GoneTriangles, 3, this->Flipped.Triangles);
    RemoveItems(this->Flipped.GoneTriangles, 1, this->Flipped.FlipCounts);
    this->StoreOthers();
  }

private:
  /// @returns the slots of triangles that have left, ascending.
  std::vector<std::int64_t> OverwriteSlots()
  {
    std::vector<std::int64_t> left, present;
    for (const std::int64_t t : this->Mesh.FindListed())
    {
      const PieceTriangle& triangle = this->Mesh.Triangles[t];
      const std::int64_t slot = triangle.Origin - this->FirstOrigins[this->Rank];
      if (this->IsOwn(triangle) && !triangle.HasLeft)
      {
        this->Overwrite(slot, triangle);
        present.push_back(slot);
      }
      else if (this->IsOwn(triangle))
      {
        left.push_back(slot); // it may have come back, with another number
      }
      else if (!triangle.HasLeft)
      {
        this->Others.push_back(static_cast<std::uint32_t>(t));
      }
    }
    std::sort(left.begin(), left.end());
    std::sort(present.begin(), present.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    std::vector<std::int64_t> gone;
    std::set_difference(
      left.begin(), left.end(), present.begin(), present.end(), std::back_inserter(gone));
    return gone;
  }

  void Overwrite(std::int64_t slot, const PieceTriangle& triangle)
  {
    this->Flipped.FlipCounts[slot] = triangle.Flips;
    for (int corner = 0; corner < 3; ++corner)
    {
      this->Flipped.Triangles[3 * slot + corner] = this->StorePoint(triangle.Points[corner]);
    }
  }

  /// Removes items of `size` values by their numbers, which ascend.
  template <typename T>
  static void RemoveItems(
    const std::vector<std::int64_t>& gone, std::int64_t size, std::vector<T>& values)
  {
    auto to = values.begin() + (gone.empty() ? values.size() : size * gone.front());
    for (std::size_t i = 0; i < gone.size(); ++i)
    {
      const auto end = i + 1 < gone.size() ? values.begin() + size * gone[i + 1] : values.end();
      to = std::move(values.begin() + size * (gone[i] + 1), end, to);
    }
    values.erase(to, values.end());
  }

  void StoreOthers()
  {
    const PieceTriangles& triangles = this->Mesh.Triangles;
    std::sort(this->Others.begin(), this->Others.end(),
      [&](std::uint32_t a, std::uint32_t b) { return triangles[a].Origin < triangles[b].Origin; });
    for (const std::uint32_t t : this->Others)
    {
      this->Flipped.ReceivedTriangles.push_back(
        FindOrigin(this->FirstOrigins, triangles[t].Origin));
      this->StoreTriangle(triangles[t]);
    }
  }

  bool IsOwn(const PieceTriangle& triangle) const
  {
    return this->FirstOrigins[this->Rank] <= triangle.Origin &&
      triangle.Origin < this->FirstOrigins[this->Rank + 1];
  }

  void FindPlaces()
  {
    const PieceTriangles& triangles = this->Mesh.Triangles;
    const std::int64_t first = this->FirstOrigins[this->Rank];
    this->Own.assign(this->FirstOrigins[this->Rank + 1] - first, Nowhere);
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      const auto place = static_cast<std::uint32_t>(t);
      if (!triangles[t].HasLeft && this->IsOwn(triangles[t]))
      {
        this->Own[triangles[t].Origin - first] = place;
      }
      else if (!triangles[t].HasLeft)
      {
        this->Others.push_back(place);
      }
    }
  }

  void StoreTriangle(const PieceTriangle& triangle)
  {
    this->Flipped.FlipCounts.push_back(triangle.Flips);
    for (const std::int32_t point : triangle.Points)
    {
      this->Flipped.Triangles.push_back(this->StorePoint(point));
    }
  }

  /// @returns the id that a point has in the result.
  std::int32_t StorePoint(std::int32_t point)
  {
    const auto first = static_cast<std::int32_t>(this->Mesh.GetFirstReceived());
    if (point < first)
    {
      return point;
    }
    std::int32_t& id = this->IdOfReceived[point - first];
    if (id < 0)
    {
      id = first + static_cast<std::int32_t>(this->Flipped.ReceivedPoints.size());
      double x[3];
      this->Mesh.GetPosition(point, x);
      this->Flipped.ReceivedPoints.push_back(this->Mesh.FindOrigin(point));
      this->Flipped.ReceivedCoordinates.insert(this->Flipped.ReceivedCoordinates.end(), x, x + 3);
    }
    return id;
  }

  static constexpr std::uint32_t Nowhere = 0xFFFFFFFFu;

  const PieceMesh& Mesh;
  const std::vector<std::int64_t>& FirstOrigins;
  int Rank;
  FlippedPiece& Flipped;
  HostVector<std::uint32_t> Own; ///< Places of the rank's own triangles, by their slots.
  std::vector<std::uint32_t> Others; ///< Places of those of other ranks, in the order of these.
  std::vector<std::int32_t> IdOfReceived; ///< Ids of received points in the result; -1: not yet.
};
}

void StorePiece(const PieceMesh& mesh, const std::vector<std::int64_t>& firstOrigins, int rank,
  FlippedPiece& flipped)
{
  PieceStore(mesh, firstOrigins, rank, flipped).StoreAll();
}

void StoreListed(const PieceMesh& mesh, const std::vector<std::int64_t>& firstOrigins, int rank,
  FlippedPiece& flipped)
{
  PieceStore(mesh, firstOrigins, rank, flipped).StoreListed();
}

}
