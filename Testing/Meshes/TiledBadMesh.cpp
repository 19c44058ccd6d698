// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"
#include "SplitHistory.h"

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

namespace delaunayflip
{
namespace
{

/// Where the tiles of a mesh lie and how many points each contains. The corners of all tiles are
/// the first points; the points inside follow, tile by tile.
class TiledSquare
{
public:
  TiledSquare(std::int64_t points, std::int32_t tilesPerSide)
    : TilesPerSide(tilesPerSide),
      TileSize(LatticeSize / tilesPerSide),
      Corners((std::int64_t(tilesPerSide) + 1) * (tilesPerSide + 1)),
      PointsInside(points - this->Corners)
  {
  }

  std::int64_t GetNumberOfTiles() const
  {
    return std::int64_t(this->TilesPerSide) * this->TilesPerSide;
  }

  std::int64_t GetNumberOfPoints() const { return this->Corners + this->PointsInside; }

  std::int64_t GetNumberOfTriangles() const
  {
    return 2 * (this->PointsInside + this->GetNumberOfTiles());
  }

  /// The number of points inside the tiles before `tile`.
  std::int64_t CountBefore(std::int64_t tile) const
  {
    const std::int64_t tiles = this->GetNumberOfTiles();
    const std::int64_t rest = this->PointsInside % tiles;
    return this->PointsInside / tiles * tile + std::min(tile, rest);
  }

  LatticePoint GetOrigin(std::int64_t tile) const
  {
    return { static_cast<std::int32_t>(tile % this->TilesPerSide) * this->TileSize,
      static_cast<std::int32_t>(tile / this->TilesPerSide) * this->TileSize };
  }

  /// The id in the mesh of a point of a tile.
  std::int32_t GetId(std::int64_t tile, std::int32_t point) const
  {
    if (point >= 4)
    {
      return static_cast<std::int32_t>(this->Corners + this->CountBefore(tile) + point - 4);
    }
    const std::int64_t column = tile % this->TilesPerSide + (point == 1 || point == 2);
    const std::int64_t row = tile / this->TilesPerSide + (point >= 2);
    return static_cast<std::int32_t>(row * (this->TilesPerSide + 1) + column);
  }

  const std::int32_t TilesPerSide;
  const std::int32_t TileSize;

private:
  const std::int64_t Corners;
  const std::int64_t PointsInside;
};

/// A random coordinate in [1, size - 1]: inside the tile, so that its border keeps its four edges.
std::int32_t DrawInside(std::mt19937& random, std::int32_t size)
{
  return 1 + static_cast<std::int32_t>((std::uint64_t(random()) * std::uint64_t(size - 1)) >> 32);
}

void StorePoint(const LatticePoint& point, std::int32_t id, OwnedMesh<float>& mesh)
{
  constexpr float Step = 1.0f / static_cast<float>(LatticeSize);
  mesh.Points[3 * static_cast<std::size_t>(id)] = static_cast<float>(point.X) * Step;
  mesh.Points[3 * static_cast<std::size_t>(id) + 1] = static_cast<float>(point.Y) * Step;
}

void StoreCorners(const TiledSquare& square, OwnedMesh<float>& mesh)
{
  std::int32_t id = 0;
  for (std::int32_t row = 0; row <= square.TilesPerSide; ++row)
  {
    for (std::int32_t column = 0; column <= square.TilesPerSide; ++column)
    {
      StorePoint({ column * square.TileSize, row * square.TileSize }, id++, mesh);
    }
  }
}

/// The part of a tile without its corners, which are shared.
void MakeTile(
  const TiledSquare& square, std::int64_t tile, std::uint32_t seed, OwnedMesh<float>& mesh)
{
  const std::int64_t before = square.CountBefore(tile);
  const std::int64_t points = 4 + square.CountBefore(tile + 1) - before;
  std::mt19937 random(seed + 7919u * static_cast<std::uint32_t>(tile));
  SplitHistory history(points, square.TileSize);
  while (static_cast<std::int64_t>(history.Points.size()) < points)
  {
    const std::int32_t x = DrawInside(random, square.TileSize);
    const std::int32_t y = DrawInside(random, square.TileSize);
    history.Insert({ x, y });
  }
  const LatticePoint origin = square.GetOrigin(tile);
  for (std::int32_t i = 4; i < points; ++i)
  {
    const LatticePoint& point = history.Points[static_cast<std::size_t>(i)];
    StorePoint({ origin.X + point.X, origin.Y + point.Y }, square.GetId(tile, i), mesh);
  }
  std::size_t next = static_cast<std::size_t>(3 * 2 * (before + tile));
  history.ForEachTriangle(
    [&](const std::array<std::int32_t, 3>& ids)
    {
      for (const std::int32_t id : ids)
      {
        mesh.Triangles[next++] = square.GetId(tile, id);
      }
    });
}

}

OwnedMesh<float> MakeTiledBadMesh(
  std::int64_t points, std::int32_t tilesPerSide, std::uint32_t seed, int threads)
{
  const TiledSquare square(points, tilesPerSide);
  OwnedMesh<float> mesh;
  mesh.Points.resize(static_cast<std::size_t>(3 * square.GetNumberOfPoints()));
  mesh.Triangles.resize(static_cast<std::size_t>(3 * square.GetNumberOfTriangles()));
  StoreCorners(square, mesh);
  std::atomic<std::int64_t> nextTile{ 0 };
  const auto work = [&]
  {
    for (std::int64_t tile; (tile = nextTile++) < square.GetNumberOfTiles();)
    {
      MakeTile(square, tile, seed, mesh);
    }
  };
  const unsigned available = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> workers(threads > 0 ? static_cast<unsigned>(threads) : available);
  for (std::thread& worker : workers)
  {
    worker = std::thread(work);
  }
  for (std::thread& worker : workers)
  {
    worker.join();
  }
  return mesh;
}

}
