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
  /// @param draw gives coordinates inside the square, until there are so many points.
  template <typename Draw>
  SplitHistory(std::int64_t points, std::int32_t side, const Draw& draw)
  {
    this->Nodes.reserve(static_cast<std::size_t>(3 * points));
    this->Points = { { 0, 0 }, { side, 0 }, { side, side }, { 0, side } };
    this->Nodes = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
    while (static_cast<std::int64_t>(this->Points.size()) < points)
    {
      const std::int32_t x = draw();
      this->Insert({ x, draw() });
    }
  }

  /// Adds a point inside the square, unless it is already there.
  void Insert(const LatticePoint& point)
  {
    this->Leaves.clear();
    const std::int64_t side = this->Turn(0, 2, point);
    for (const std::int32_t root : { 1, 0 })
    {
      if (root == 0 ? side <= 0 : side >= 0)
      {
        this->FindLeaves(root, point);
      }
    }
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

  /// All leaves below a node that contain the point: one, two if it lies on an edge, more if it is
  /// a vertex.
  void FindLeaves(std::int32_t index, const LatticePoint& point)
  {
    const HistoryNode& node = this->Nodes[index];
    if (node.NumberOfChildren == 0)
    {
      this->Leaves.push_back(index);
    }
    for (std::int32_t i = node.NumberOfChildren; i-- > 0;)
    {
      if (this->ChildHolds(this->Nodes[node.FirstChild + i], point))
      {
        this->FindLeaves(node.FirstChild + i, point);
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
};

template <typename Real>
OwnedMesh<Real> MakeRandomBad(std::int64_t points, std::uint32_t seed)
{
  std::mt19937 random(seed);
  // Not 0: strictly inside the square, so that the boundary keeps its four edges.
  const auto draw = [&random]()
  {
    std::uint32_t coordinate = 0;
    while (coordinate == 0)
    {
      coordinate = random() >> 8;
    }
    return static_cast<std::int32_t>(coordinate);
  };
  const SplitHistory history(points, LatticeSize, draw);
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
struct TiledSquare
{
  std::int64_t TilesPerSide;
  std::int64_t PointsInside;
  std::int64_t CountTiles() const { return this->TilesPerSide * this->TilesPerSide; }
  std::int64_t CountCorners() const { return (this->TilesPerSide + 1) * (this->TilesPerSide + 1); }
  std::int32_t GetTileSize() const
  {
    return LatticeSize / static_cast<std::int32_t>(this->TilesPerSide);
  }

  /// The number of points inside the tiles before `tile`.
  std::int64_t CountBefore(std::int64_t tile) const
  {
    const std::int64_t rest = this->PointsInside % this->CountTiles();
    return this->PointsInside / this->CountTiles() * tile + std::min(tile, rest);
  }

  /// The id in the mesh of a point of a tile.
  std::int32_t GetId(std::int64_t tile, std::int32_t point) const
  {
    if (point >= 4)
    {
      return static_cast<std::int32_t>(this->CountCorners() + this->CountBefore(tile) + point - 4);
    }
    const std::int64_t column = tile % this->TilesPerSide + (point == 1 || point == 2);
    const std::int64_t row = tile / this->TilesPerSide + (point >= 2);
    return static_cast<std::int32_t>(row * (this->TilesPerSide + 1) + column);
  }
};

/// Stores the corners of a tile, which others share, or the points inside of it.
void StorePoints(const TiledSquare& square, std::int64_t tile,
  const std::vector<LatticePoint>& points, bool corners, OwnedMesh<float>& mesh)
{
  constexpr float Step = 1.0f / static_cast<float>(LatticeSize);
  const std::int64_t x = tile % square.TilesPerSide * square.GetTileSize();
  const std::int64_t y = tile / square.TilesPerSide * square.GetTileSize();
  const auto last = corners ? 4 : static_cast<std::int32_t>(points.size());
  for (std::int32_t i = corners ? 0 : 4; i < last; ++i)
  {
    float* place = &mesh.Points[3 * static_cast<std::size_t>(square.GetId(tile, i))];
    place[0] = static_cast<float>(x + points[static_cast<std::size_t>(i)].X) * Step;
    place[1] = static_cast<float>(y + points[static_cast<std::size_t>(i)].Y) * Step;
  }
}

/// The part of a tile without its corners, which are shared.
void MakeTile(
  const TiledSquare& square, std::int64_t tile, std::uint32_t seed, OwnedMesh<float>& mesh)
{
  const std::int64_t before = square.CountBefore(tile);
  const std::int64_t points = 4 + square.CountBefore(tile + 1) - before;
  std::mt19937 random(seed + 7919u * static_cast<std::uint32_t>(tile));
  // In [1, size - 1]: inside the tile, so that its border keeps its four edges.
  const auto draw = [&]()
  {
    const std::uint64_t most = static_cast<std::uint64_t>(square.GetTileSize() - 1);
    return 1 + static_cast<std::int32_t>((std::uint64_t(random()) * most) >> 32);
  };
  const SplitHistory history(points, square.GetTileSize(), draw);
  StorePoints(square, tile, history.Points, false, mesh);
  auto next = static_cast<std::size_t>(3 * 2 * (before + tile));
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
  TiledSquare square{ tilesPerSide, 0 };
  square.PointsInside = points - square.CountCorners();
  OwnedMesh<float> mesh;
  mesh.Points.resize(static_cast<std::size_t>(3 * points));
  mesh.Triangles.resize(static_cast<std::size_t>(6 * (square.PointsInside + square.CountTiles())));
  const SplitHistory corners(0, square.GetTileSize(), []() { return 0; });
  for (std::int64_t tile = 0; tile < square.CountTiles(); ++tile)
  {
    StorePoints(square, tile, corners.Points, true, mesh);
  }
  std::atomic<std::int64_t> nextTile{ 0 };
  const auto work = [&]
  {
    for (std::int64_t tile; (tile = nextTile++) < square.CountTiles();)
    {
      MakeTile(square, tile, seed, mesh);
    }
  };
  const unsigned available = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> workers;
  for (unsigned i = threads > 0 ? static_cast<unsigned>(threads) : available; i > 0; --i)
  {
    workers.emplace_back(work);
  }
  for (std::thread& worker : workers)
  {
    worker.join();
  }
  return mesh;
}

}
