// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TRIANGLEORDER_H
#define DELAUNAYFLIP_TRIANGLEORDER_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "SpatialOrder.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// @file
/// An order of triangles that depends on their vertices alone, and not on the flips that have made
/// them. Each triangle begins with its lowest id. They are sorted by their first and then by their
/// second id. In a triangulation of points no two triangles have both in common.

namespace delaunayflip
{

/// The ids of a triangle, the lowest first.
struct OrderedIds
{
  VertexId Ids[3];
};

DELAUNAYFLIP_HOST_DEVICE inline OrderedIds OrderIds(
  const TriangleRecord& triangle, const SpatialOrderView& order)
{
  const VertexId a = order.GetVertex(triangle.Vertices[0]);
  const VertexId b = order.GetVertex(triangle.Vertices[1]);
  const VertexId c = order.GetVertex(triangle.Vertices[2]);
  if (a < b && a < c)
  {
    return { { a, b, c } };
  }
  if (b < c)
  {
    return { { b, c, a } };
  }
  return { { c, a, b } };
}

/// Sorts triangles with the same first id by their second one. There are few, as a rule (Shell
/// 1959).
DELAUNAYFLIP_HOST_DEVICE inline void SortBySecond(OrderedIds* triangles, std::uint32_t size)
{
  std::uint32_t gap = 1;
  while (gap < size / 3)
  {
    gap = 3 * gap + 1;
  }
  for (; gap > 0; gap /= 3)
  {
    for (std::uint32_t i = gap; i < size; ++i)
    {
      const OrderedIds moved = triangles[i];
      std::uint32_t place = i;
      for (; place >= gap && moved.Ids[1] < triangles[place - gap].Ids[1]; place -= gap)
      {
        triangles[place] = triangles[place - gap];
      }
      triangles[place] = moved;
    }
  }
}

/// More triangles with the same first id than this are sorted on the host.
constexpr std::uint32_t MostSortedInPlace = 4096;

/// Sorts on the host what would take a single thread of a GPU too long.
/// @param counts how many triangles begin with each id. @param ends the ends of these in the list.
template <typename Backend>
void SortLongLists(const Array<std::uint32_t>& counts, const Array<std::uint32_t>& ends,
  Array<OrderedIds>& listed, const Backend& backend)
{
  const auto points = static_cast<std::int64_t>(counts.Size());
  const std::uint32_t* countOf = counts.Data();
  const auto longLists = backend.template Sum<std::int64_t>(points,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
    { sum += countOf[i] > MostSortedInPlace ? 1 : 0; });
  if (longLists == 0)
  {
    return;
  }
  std::vector<std::uint32_t> sizes(points), lasts(points);
  backend.Download(counts.Data(), points, sizes.data());
  backend.Download(ends.Data(), points, lasts.data());
  std::vector<OrderedIds> list;
  for (std::int64_t i = 0; i < points; ++i)
  {
    if (sizes[i] > MostSortedInPlace)
    {
      list.resize(sizes[i]);
      OrderedIds* first = listed.Data() + (lasts[i] - sizes[i]);
      backend.Download(first, sizes[i], list.data());
      std::sort(list.begin(), list.end(),
        [](const OrderedIds& a, const OrderedIds& b) { return a.Ids[1] < b.Ids[1]; });
      backend.Upload(list.data(), sizes[i], first);
    }
  }
}

/// Lists the triangles of a mesh in this order.
/// @param points the number of ids.
template <typename Backend>
Array<OrderedIds> ListInOrder(
  const EdgeMesh& mesh, const SpatialOrderView& order, std::int64_t points, const Backend& backend)
{
  const TriangleRecord* triangles = mesh.Triangles.Data();
  Array<std::uint32_t> counts = backend.template MakeArray<std::uint32_t>(points);
  Array<std::uint32_t> ends = backend.template MakeArray<std::uint32_t>(points);
  std::uint32_t* countOf = counts.Data();
  std::uint32_t* endOf = ends.Data();
  backend.ForEach(points, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { countOf[i] = 0; });
  backend.ForEach(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    { AtomicAdd(countOf + OrderIds(triangles[t], order).Ids[0], 1u); });
  const auto count = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
  { return static_cast<int>(countOf[i]); };
  const typename Backend::Numbering numbering = backend.Count(points, count);
  backend.ForEachNumbered(numbering, points, count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t first)
    { endOf[i] = static_cast<std::uint32_t>(first); });
  Array<OrderedIds> listed = backend.template MakeArray<OrderedIds>(mesh.NumberOfTriangles);
  OrderedIds* list = listed.Data();
  backend.ForEach(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    {
      const OrderedIds ids = OrderIds(triangles[t], order);
      list[AtomicAdd(endOf + ids.Ids[0], 1u)] = ids;
    });
  SortLongLists(counts, ends, listed, backend);
  backend.ForEach(points,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    {
      const std::uint32_t size = countOf[i];
      if (size > 1 && size <= MostSortedInPlace)
      {
        SortBySecond(list + (endOf[i] - size), size);
      }
    });
  return listed;
}

/// Sets the ids of a triangle of the list, if the target includes it.
struct OrderedStoreStep
{
  const OrderedIds* Listed;

  template <typename Target>
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t number, const Target& target) const
  {
    const OrderedIds ids = this->Listed[number];
    for (int slot = 0; slot < 3; ++slot)
    {
      target.Set(number, slot, ids.Ids[slot]);
    }
  }
};

}

#endif
