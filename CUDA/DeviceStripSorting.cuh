// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICESTRIPSORTING_CUH
#define DELAUNAYFLIP_DEVICESTRIPSORTING_CUH

#include "CudaBackend.cuh"
#include "Strips.h"

#include <cstdint>
#include <type_traits>

namespace delaunayflip
{

/// Bits that order as the number does.
__device__ inline std::uint64_t OrderedBits(double number)
{
  const std::int64_t bits = __double_as_longlong(number);
  return static_cast<std::uint64_t>(bits ^ ((bits >> 63) | (std::int64_t(1) << 63)));
}
__device__ inline std::uint32_t OrderedBits(float number)
{
  const std::int32_t bits = __float_as_int(number);
  return static_cast<std::uint32_t>(bits ^ ((bits >> 31) | (std::int32_t(1) << 31)));
}

/// Sorts all points by y, then by x, then by their strip; each sort keeps the order of equal keys.
template <typename Real>
struct StripSorter<Real, CudaBackend>
{
  using Key = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

  static StripPoints<Real> Sort(
    const PlaneArray& points, const StripBounds& bounds, const CudaBackend& backend)
  {
    const std::int64_t count = points.Count;
    const std::int64_t strips = bounds.CountStrips();
    const auto cells = static_cast<std::int64_t>(bounds.FirstOfCell.size());
    Array<double> boundsHere = backend.MakeArray<double>(strips - 1);
    Array<std::uint32_t> cellsHere = backend.MakeArray<std::uint32_t>(cells);
    backend.Upload(bounds.Bounds.data(), strips - 1, boundsHere.Data());
    backend.Upload(bounds.FirstOfCell.data(), cells, cellsHere.Data());
    StripFinder findStrip = bounds.View();
    findStrip.Bounds = boundsHere.Data();
    findStrip.FirstOfCell = cellsHere.Data();
    const auto unused = static_cast<std::uint32_t>(strips); // not finite
    Array<std::uint32_t> stripOfPoint = backend.MakeArray<std::uint32_t>(count);
    std::uint32_t* stripOf = stripOfPoint.Data();
    backend.ForEach(count,
      [=] __device__(std::int64_t i)
      { stripOf[i] = IsFinitePoint(points, i) ? findStrip(points.Get(i, 1)) : unused; });

    StripPoints<Real> sorted;
    sorted.Ids = backend.MakeIndices(count);
    for (int axis = 1; axis >= 0; --axis)
    {
      backend.template SortBy<Key>(sorted.Ids, count, 8 * sizeof(Key),
        [=] __device__(std::uint32_t i)
        { return OrderedBits(static_cast<Real>(points.Get(i, axis))); });
    }
    int stripBits = 1;
    while ((strips >> stripBits) > 0)
    {
      ++stripBits;
    }
    backend.template SortBy<std::uint32_t>(
      sorted.Ids, count, stripBits, [=] __device__(std::uint32_t i) { return stripOf[i]; });

    sorted.Strips = strips;
    sorted.Starts = backend.MakeArray<std::uint32_t>(strips + 1);
    std::uint32_t* starts = sorted.Starts.Data();
    const std::uint32_t* ids = sorted.Ids.Data();
    backend.ForEach(count + 1,
      [=] __device__(std::int64_t i)
      {
        const std::int64_t before = i > 0 ? std::int64_t(stripOf[ids[i - 1]]) : -1;
        const std::int64_t strip = i < count ? std::int64_t(stripOf[ids[i]]) : strips;
        for (std::int64_t next = before + 1; next <= strip; ++next)
        {
          starts[next] = static_cast<std::uint32_t>(i);
        }
      });
    std::uint32_t used = 0;
    backend.Download(starts + strips, 1, &used);
    sorted.Count = used;
    sorted.Coordinates = backend.MakeArray<Real>(2 * sorted.Count);
    CoordinatePair<Real>* places = sorted.Places();
    backend.ForEach(sorted.Count,
      [=] __device__(std::int64_t i)
      {
        places[i] = { static_cast<Real>(points.Get(ids[i], 0)),
          static_cast<Real>(points.Get(ids[i], 1)) };
      });
    return sorted;
  }
};

}

#endif
