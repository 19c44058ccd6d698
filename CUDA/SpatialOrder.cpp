// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SpatialOrder.h"

#include <cmath>

namespace delaunayflip
{

namespace
{
/// Smaller meshes fit a second-level cache in any order.
constexpr std::int64_t SmallestOrderedMesh = 1 << 14; // triangles

constexpr int DigitBits = 11;
constexpr int KeyBits = 2 * DigitBits;
constexpr int PlanarCellBits = 11; // 2 axes
constexpr int SurfaceCellBits = 7; // 3 axes

struct KeyedIndex
{
  std::uint32_t Key;
  std::uint32_t Index;
};

/// Position along the Hilbert curve of a cell, each coordinate of `bits` bits (Skilling,
/// Programming the Hilbert curve, 2004).
template <int Axes>
std::uint32_t HilbertIndex(std::uint32_t (&cell)[Axes], int bits)
{
  for (int level = bits - 1; level > 0; --level)
  {
    const std::uint32_t lower = (1u << level) - 1;
    for (std::uint32_t& x : cell)
    {
      // All ones where the bit of this level is set: invert the first axis, else exchange with it.
      const std::uint32_t invert = 0u - ((x >> level) & 1u);
      const std::uint32_t exchange = (cell[0] ^ x) & lower & ~invert;
      cell[0] ^= (lower & invert) | exchange;
      x ^= exchange;
    }
  }
  std::uint32_t index = 0;
  std::uint32_t parity = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
  {
    for (const std::uint32_t x : cell)
    {
      parity ^= (x >> bit) & 1;
      index = (index << 1) | parity;
    }
  }
  return index;
}

/// Cell of a coordinate in the box, 0 for what is not in it (NaN).
std::uint32_t CellOf(double x, double lower, double width, int bits)
{
  const double cells = static_cast<double>(1u << bits);
  const double position = width > 0.0 ? (x - lower) / width * cells : 0.0;
  return position > 0.0 ? static_cast<std::uint32_t>(std::min(position, cells - 1.0)) : 0;
}

std::uint32_t VertexKey(const PointArray& points, const MeshSurvey& survey, std::int64_t point)
{
  // Half of each, so that a box as wide as the range of double does not overflow.
  const auto cellAlong = [&](int axis, int bits)
  {
    return CellOf(0.5 * points.Get(point, axis), 0.5 * survey.Lower[axis],
      0.5 * survey.Upper[axis] - 0.5 * survey.Lower[axis], bits);
  };
  if (survey.Geometry == GeometryKind::Surface)
  {
    std::uint32_t cell[3] = { cellAlong(0, SurfaceCellBits), cellAlong(1, SurfaceCellBits),
      cellAlong(2, SurfaceCellBits) };
    return HilbertIndex(cell, SurfaceCellBits);
  }
  std::uint32_t cell[2] = { cellAlong(survey.Projection.AxisU, PlanarCellBits),
    cellAlong(survey.Projection.AxisV, PlanarCellBits) };
  return HilbertIndex(cell, PlanarCellBits);
}

std::uint32_t MedianOf(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// One pass of a stable radix sort: `from` to `to` by the digit at `shift`.
void SortByDigit(
  const Array<KeyedIndex>& from, Array<KeyedIndex>& to, int shift, const ThreadBackend& backend)
{
  constexpr std::uint32_t Digits = 1u << DigitBits;
  constexpr std::int64_t Grain = 1 << 17;
  const std::int64_t size = from.Size();
  const std::int64_t chunks = (size + Grain - 1) / Grain;
  const auto digitOf = [shift](const KeyedIndex& item)
  { return (item.Key >> shift) & (Digits - 1); };
  std::vector<std::uint32_t> starts(chunks * Digits, 0);
  const auto count = [&](std::int64_t begin, std::int64_t end)
  {
    std::uint32_t* counts = &starts[begin / Grain * Digits];
    for (std::int64_t i = begin; i < end; ++i)
    {
      ++counts[digitOf(from[i])];
    }
  };
  backend.ForRange(size, count, Grain);
  std::uint32_t start = 0;
  for (std::uint32_t digit = 0; digit < Digits; ++digit)
  {
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
    {
      const std::uint32_t items = starts[chunk * Digits + digit];
      starts[chunk * Digits + digit] = start;
      start += items;
    }
  }
  const auto place = [&](std::int64_t begin, std::int64_t end)
  {
    std::uint32_t* next = &starts[begin / Grain * Digits];
    for (std::int64_t i = begin; i < end; ++i)
    {
      to[next[digitOf(from[i])]++] = from[i];
    }
  };
  backend.ForRange(size, place, Grain);
}

/// Indices 0 .. size - 1 by key(index) of KeyBits bits; equal keys keep their order.
template <typename KeyOf>
Array<std::uint32_t> SortedIndices(
  std::int64_t size, const KeyOf& keyOf, const ThreadBackend& backend)
{
  Array<KeyedIndex> items(size);
  Array<KeyedIndex> sorted(size);
  backend.ForRange(size,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        items[i] = { keyOf(i), static_cast<std::uint32_t>(i) };
      }
    });
  SortByDigit(items, sorted, 0, backend);
  SortByDigit(sorted, items, DigitBits, backend);
  Array<std::uint32_t> indices(size);
  backend.ForRange(size,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        indices[i] = items[i].Index;
      }
    });
  return indices;
}
}

SpatialOrder OrderMesh(
  const TriangleMesh& mesh, const MeshSurvey& survey, const ThreadBackend& backend)
{
  SpatialOrder order;
  if (mesh.Triangles.Count < SmallestOrderedMesh)
  {
    return order;
  }
  const std::int64_t vertices = mesh.Points.Count;
  order.VertexOfRank = SortedIndices(
    vertices, [&](std::int64_t i) { return VertexKey(mesh.Points, survey, i); }, backend);
  order.RankOfVertex = Array<VertexId>(vertices);
  backend.ForRange(vertices,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t rank = begin; rank < end; ++rank)
      {
        order.RankOfVertex[order.VertexOfRank[rank]] = static_cast<VertexId>(rank);
      }
    });
  const auto triangleKey = [&](std::int64_t t)
  {
    const std::uint64_t median = MedianOf(order.RankOfVertex[mesh.Triangles.Get(t, 0)],
      order.RankOfVertex[mesh.Triangles.Get(t, 1)], order.RankOfVertex[mesh.Triangles.Get(t, 2)]);
    return static_cast<std::uint32_t>((median << KeyBits) / vertices);
  };
  order.TriangleOfRank = SortedIndices(mesh.Triangles.Count, triangleKey, backend);
  return order;
}

}
