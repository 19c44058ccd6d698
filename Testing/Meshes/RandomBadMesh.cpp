// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <random>
#include <thread>

/// @file
/// Meshes of triangles that random points have split.

namespace delaunayflip
{
namespace
{

/// Coordinates are multiples of 2^-24: float represents them exactly, and an orientation
/// determinant of them easily fits into 64 bits.
constexpr std::int32_t LatticeSize = std::int32_t(1) << 24;

struct LatticePoint
{
  std::int32_t X;
  std::int32_t Y;
};

/// A triangle that is or was part of the mesh. Its children cover it, and the last vertex of each
/// is the point that split it.
struct HistoryNode
{
  std::array<std::int32_t, 3> Vertices;
  std::int32_t FirstChild = -1;
  std::int32_t NumberOfChildren = 0;
};

/// The tree of all splits. It finds the triangle that contains a point from the root downwards, in
/// O(log n) expected steps and without any adjacency between triangles.
class SplitHistory
{
public:
  /// @param side the side of the square, at most LatticeSize.
  SplitHistory(std::int64_t expectedPoints, std::int32_t side)
  {
    this->Points.reserve(static_cast<std::size_t>(expectedPoints));
    this->Nodes.reserve(static_cast<std::size_t>(3 * expectedPoints));
    this->Points = { { 0, 0 }, { side, 0 }, { side, side }, { 0, side } };
    this->Nodes = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
  }

  /// Adds a point inside the square, unless it is already there.
  void Insert(const LatticePoint& point)
  {
    this->FindLeaves(point);
    for (std::int32_t leaf : this->Leaves)
    {
      for (std::int32_t vertex : this->Nodes[leaf].Vertices)
      {
        const LatticePoint& known = this->Points[vertex];
        if (known.X == point.X && known.Y == point.Y)
        {
          return;
        }
      }
    }
    this->Points.push_back(point);
    for (std::int32_t leaf : this->Leaves)
    {
      this->Split(leaf);
    }
  }

  /// Calls take(vertices) for every triangle of the mesh.
  template <typename Take>
  void ForEachTriangle(const Take& take) const
  {
    for (const HistoryNode& node : this->Nodes)
    {
      if (node.NumberOfChildren == 0)
      {
        take(node.Vertices);
      }
    }
  }

  std::vector<LatticePoint> Points; ///< First the four corners of the square.

private:
  std::int64_t Turn(std::int32_t from, std::int32_t to, const LatticePoint& point) const
  {
    const LatticePoint& a = this->Points[from];
    const LatticePoint& b = this->Points[to];
    return (std::int64_t(b.X) - a.X) * (std::int64_t(point.Y) - a.Y) -
      (std::int64_t(b.Y) - a.Y) * (std::int64_t(point.X) - a.X);
  }

  /// Whether a child contains a point that its parent contains. Only the two sides at the last
  /// vertex are new; the third is the parent's.
  bool ChildHolds(const HistoryNode& child, const LatticePoint& point) const
  {
    return this->Turn(child.Vertices[1], child.Vertices[2], point) >= 0 &&
      this->Turn(child.Vertices[2], child.Vertices[0], point) >= 0;
  }

  /// All leaves that contain the point: one, two if it lies on an edge, more if it is a vertex.
  void FindLeaves(const LatticePoint& point)
  {
    this->Leaves.clear();
    this->Pending.clear();
    for (std::int32_t root = 0; root < 2; ++root)
    {
      const std::int64_t side = this->Turn(0, 2, point);
      if (root == 0 ? side <= 0 : side >= 0)
      {
        this->Pending.push_back(root);
      }
    }
    while (!this->Pending.empty())
    {
      const std::int32_t node = this->Pending.back();
      this->Pending.pop_back();
      this->Visit(node, point);
    }
  }

  void Visit(std::int32_t index, const LatticePoint& point)
  {
    const HistoryNode& node = this->Nodes[index];
    if (node.NumberOfChildren == 0)
    {
      this->Leaves.push_back(index);
    }
    for (std::int32_t i = 0; i < node.NumberOfChildren; ++i)
    {
      if (this->ChildHolds(this->Nodes[node.FirstChild + i], point))
      {
        this->Pending.push_back(node.FirstChild + i);
      }
    }
  }

  /// Splits a leaf at the newest point. An edge on which the point lies makes no triangle with it.
  void Split(std::int32_t leaf)
  {
    const auto newest = static_cast<std::int32_t>(this->Points.size()) - 1;
    const std::array<std::int32_t, 3> corners = this->Nodes[leaf].Vertices;
    this->Nodes[leaf].FirstChild = static_cast<std::int32_t>(this->Nodes.size());
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = corners[i];
      const std::int32_t to = corners[(i + 1) % 3];
      if (this->Turn(from, to, this->Points[newest]) != 0)
      {
        this->Nodes.push_back({ { from, to, newest } });
        this->Nodes[leaf].NumberOfChildren++;
      }
    }
  }

  std::vector<HistoryNode> Nodes;
  std::vector<std::int32_t> Leaves;
  std::vector<std::int32_t> Pending;
};

/// A point strictly inside the square, so that the boundary keeps its four edges.
std::int32_t DrawCoordinate(std::mt19937& random)
{
  std::int32_t coordinate = 0;
  while (coordinate == 0)
  {
    coordinate = static_cast<std::int32_t>(random() >> 8);
  }
  return coordinate;
}

template <typename Real>
OwnedMesh<Real> MakeRandomBad(std::int64_t points, std::uint32_t seed)
{
  std::mt19937 random(seed);
  SplitHistory history(points, LatticeSize);
  while (static_cast<std::int64_t>(history.Points.size()) < points)
  {
    const std::int32_t x = DrawCoordinate(random);
    const std::int32_t y = DrawCoordinate(random);
    history.Insert({ x, y });
  }
  OwnedMesh<Real> mesh;
  mesh.Points.reserve(3 * history.Points.size());
  for (const LatticePoint& point : history.Points)
  {
    const Real step = Real(1) / static_cast<Real>(LatticeSize);
    mesh.Points.insert(mesh.Points.end(), { Real(point.X) * step, Real(point.Y) * step, Real(0) });
  }
  mesh.Triangles.reserve(6 * history.Points.size());
  history.ForEachTriangle([&](const std::array<std::int32_t, 3>& ids)
    { mesh.Triangles.insert(mesh.Triangles.end(), ids.begin(), ids.end()); });
  return mesh;
}

}

OwnedMesh<float> MakeRandomBadMesh(std::int64_t points, std::uint32_t seed)
{
  return MakeRandomBad<float>(points, seed);
}

OwnedMesh<double> MakeRandomBadMeshDouble(std::int64_t points, std::uint32_t seed)
{
  return MakeRandomBad<double>(points, seed);
}

//------------------------------------------------------------------------------
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
