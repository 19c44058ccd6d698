// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STRIPS_H
#define DELAUNAYFLIP_STRIPS_H

#include "Array.h"
#include "BinarySearch.h"
#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "HostDevice.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

/// @file
/// The first step of a triangulation of points makes horizontal strips, and in each strip a chain.
///
/// A strip holds the points with y in a range. No value of y is in two strips. In a strip the
/// points are sorted by (x, y), so that joined in this order they are a chain that never turns back
/// in x. Every chain lies strictly above the one before.

namespace delaunayflip
{

DELAUNAYFLIP_HOST_DEVICE inline bool IsFinitePoint(const PlaneArray& points, std::int64_t point)
{
  return IsFinite(points.Get(point, 0)) && IsFinite(points.Get(point, 1));
}

/// Finds the strip of a y by a binary search, which a table of equal cells narrows. This takes
/// constant time where points are spread evenly. It points to the arrays of StripBounds.
struct StripFinder
{
  const double* Bounds;
  const std::uint32_t* FirstOfCell;
  std::uint32_t Cells;
  double HalfLower, Scale;

  /// Does not decrease with y.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindCell(double y) const
  {
    const double cell = (0.5 * y - this->HalfLower) * this->Scale;
    const double last = this->Cells - 1;
    // The order of the arguments matters: NaN becomes 0.
    return static_cast<std::uint32_t>(std::min(std::max(0.0, cell), last));
  }

  /// Returns the number of the strip, which is the number of bounds that are not above y.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t operator()(double y) const
  {
    const std::uint32_t* cell = this->FirstOfCell + this->FindCell(y);
    return FindEnd(cell[0], cell[1], [&](std::uint32_t bound) { return this->Bounds[bound] <= y; });
  }
};

/// The values of y where strips begin, except that of the lowest strip.
struct StripBounds
{
  std::vector<double> Bounds; ///< Ascending.
  /// By cell: its first bound. The number of bounds comes last.
  std::vector<std::uint32_t> FirstOfCell;
  double HalfLower = 0.0, Scale = 0.0;

  explicit StripBounds(std::vector<double> bounds)
    : Bounds(std::move(bounds)),
      FirstOfCell(2 * this->Bounds.size() + 2, 0)
  {
    if (this->Bounds.size() > 1)
    {
      this->HalfLower = 0.5 * this->Bounds.front();
      const double scale = static_cast<double>(2 * this->Bounds.size()) /
        (0.5 * this->Bounds.back() - this->HalfLower);
      if (std::isfinite(scale)) // else there is one cell
      {
        this->Scale = scale;
      }
    }
    const StripFinder finder = this->View();
    for (const double bound : this->Bounds)
    {
      ++this->FirstOfCell[finder.FindCell(bound) + 1];
    }
    std::partial_sum(this->FirstOfCell.begin(), this->FirstOfCell.end(), this->FirstOfCell.begin());
  }

  std::int64_t CountStrips() const { return static_cast<std::int64_t>(this->Bounds.size()) + 1; }

  StripFinder View() const
  {
    return { this->Bounds.data(), this->FirstOfCell.data(),
      static_cast<std::uint32_t>(this->FirstOfCell.size() - 1), this->HalfLower, this->Scale };
  }
};

/// Points sorted by (strip, x, y, id), in the memory of a backend.
template <typename Real>
struct StripPoints
{
  Array<Real> Coordinates; ///< x and y of every point.
  Array<VertexId> Ids; ///< The caller's.
  Array<std::uint32_t> Starts; ///< By strip: its first point. The number of points comes last.
  std::int64_t Count = 0;
  std::int64_t Strips = 0;

  CoordinatePair<Real>* Places()
  {
    return reinterpret_cast<CoordinatePair<Real>*>(this->Coordinates.Data());
  }
};

/// Sorts the points that are finite. A backend specialises this (Threads/ThreadMesh.cpp).
template <typename Real, typename Backend>
struct StripSorter;

/// Sample number i of a set of `count` points: a fixed pseudo-random choice, so that no regular
/// order of the points matters (splitmix64, Steele et al. 2014).
DELAUNAYFLIP_HOST_DEVICE inline std::int64_t PickSample(std::uint64_t i, std::int64_t count)
{
  std::uint64_t z = (i + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(count));
}

/// Half of the distance over which the middle 98 of 100 values are spread. Outliers do not count.
/// The whole distance could overflow.
/// @param sorted at least at the tails.
inline double FindSpread(const std::vector<double>& sorted)
{
  const std::size_t tail = sorted.size() / 100;
  return 0.5 * sorted[sorted.size() - 1 - tail] - 0.5 * sorted[tail];
}

/// Puts those values to their sorted places that FindSpread reads and all beyond them. These are so
/// few that a processor predicts nearly all comparisons, unlike those of a whole sort.
/// @param values at least one.
inline void SortTails(std::vector<double>& values)
{
  const auto size = static_cast<std::int64_t>(values.size());
  const std::int64_t tail = size / 100 + 1;
  std::partial_sort(values.begin(), values.begin() + tail, values.end());
  if (size > 1)
  {
    std::partial_sort(
      values.rbegin(), values.rbegin() + tail, values.rend() - tail, std::greater<>());
  }
}

/// Strips about as high as the points in them are apart in x: `count` points have
/// sqrt(count * height / width) strips.
inline std::int64_t CountStrips(std::int64_t count, double width, double height)
{
  double ratio = 0.0;
  if (height > 0.0)
  {
    ratio = height / width; // infinite where the width is 0
  }
  const double strips = std::sqrt(static_cast<double>(count) * ratio);
  const double most = static_cast<double>(count) / 2.0;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(strips, most) + 0.5));
}

/// One coordinate of up to `size` of the points. All points are taken if there are no more. Points
/// that are not finite are left out.
template <typename Backend>
std::vector<double> SampleAxis(
  const PlaneArray& points, int axis, std::int64_t size, bool isSorted, const Backend& backend)
{
  const bool all = size >= points.Count;
  size = std::min(size, points.Count);
  Array<double> sampled = backend.template MakeArray<double>(size);
  double* samples = sampled.Data();
  backend.ForEach(size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    {
      const std::int64_t point = all ? i : PickSample(i, points.Count);
      samples[i] = IsFinitePoint(points, point) ? points.Get(point, axis) : INFINITY;
    });
  if (isSorted)
  {
    backend.SortNumbers(sampled, size);
  }
  std::vector<double> onHost(size);
  backend.Download(sampled.Data(), size, onHost.data());
  onHost.erase(std::remove(onHost.begin(), onHost.end(), INFINITY), onHost.end());
  return onHost;
}

/// Chooses the strips from samples, so that they hold similar numbers of points.
template <typename Backend>
StripBounds ChooseStrips(const PlaneArray& points, const Backend& backend)
{
  // With half as many samples per strip, up to 7 % more edges of 200,000 points flip. With twice as
  // many, and at least 2,048, sorting them took a tenth of the time of 1,000 points.
  constexpr std::int64_t SmallestSample = 1 << 9;
  constexpr std::int64_t SamplesPerStrip = 16;
  std::vector<double> xs = SampleAxis(points, 0, SmallestSample, false, backend);
  if (xs.empty())
  {
    return StripBounds({});
  }
  SortTails(xs);
  std::vector<double> ys;
  // The first sample is large enough for a square. The second one is as large as is needed.
  auto strips = static_cast<std::int64_t>(std::sqrt(static_cast<double>(points.Count)));
  for (std::int64_t size = 0; size < std::min(points.Count, SamplesPerStrip * strips);)
  {
    size = std::max(SmallestSample, SamplesPerStrip * strips);
    ys = SampleAxis(points, 1, size, true, backend);
    if (ys.empty())
    {
      return StripBounds({});
    }
    strips = CountStrips(points.Count, FindSpread(xs), FindSpread(ys));
  }
  std::vector<double> bounds;
  double previous = ys.front();
  for (std::int64_t strip = 1; strip < strips; ++strip)
  {
    const double bound = ys[static_cast<std::size_t>(
      static_cast<double>(ys.size()) * static_cast<double>(strip) / static_cast<double>(strips))];
    if (bound > previous)
    {
      bounds.push_back(bound);
      previous = bound;
    }
  }
  return StripBounds(std::move(bounds));
}

/// Whether a point of the strips is the first at its place.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE bool IsFirstAtPlace(const CoordinatePair<Real>* places, std::int64_t i)
{
  return i == 0 || places[i].U != places[i - 1].U || places[i].V != places[i - 1].V;
}

/// Keeps one of the points at equal places, which is the one with the lowest id.
/// @param callerPoints the number of the caller's points.
/// @returns for each of the caller's points the id of the point that is used at its place, NoVertex
/// for one that is not finite; empty if all points are used.
template <typename Real, typename Backend>
Array<VertexId> MergePlaces(
  StripPoints<Real>& strips, std::int64_t callerPoints, const Backend& backend)
{
  const std::int64_t count = strips.Count;
  const CoordinatePair<Real>* places = strips.Places();
  const VertexId* ids = strips.Ids.Data();
  const auto isFirst = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
  { return IsFirstAtPlace(places, i) ? 1 : 0; };
  const typename Backend::Numbering numbering = backend.Count(count, isFirst);
  if (numbering.Total == callerPoints)
  {
    return {};
  }
  StripPoints<Real> kept;
  kept.Count = numbering.Total;
  kept.Strips = strips.Strips;
  kept.Coordinates = backend.template MakeArray<Real>(2 * kept.Count);
  kept.Ids = backend.template MakeArray<VertexId>(kept.Count);
  kept.Starts = backend.template MakeArray<std::uint32_t>(kept.Strips + 1);
  Array<std::uint32_t> numbers = backend.template MakeArray<std::uint32_t>(count);
  CoordinatePair<Real>* toPlaces = kept.Places();
  VertexId* toIds = kept.Ids.Data();
  std::uint32_t* toNumbers = numbers.Data();
  backend.ForEachNumbered(numbering, count, isFirst,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
    {
      if (!IsFirstAtPlace(places, i))
      {
        toNumbers[i] = static_cast<std::uint32_t>(number - 1);
        return;
      }
      toNumbers[i] = static_cast<std::uint32_t>(number);
      toPlaces[number] = places[i];
      toIds[number] = ids[i];
    });
  const std::uint32_t* starts = strips.Starts.Data();
  std::uint32_t* toStarts = kept.Starts.Data();
  const std::int64_t end = kept.Count;
  backend.ForEach(kept.Strips + 1,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t strip)
    {
      toStarts[strip] =
        starts[strip] < count ? toNumbers[starts[strip]] : static_cast<std::uint32_t>(end);
    });
  Array<VertexId> used = backend.template MakeArray<VertexId>(callerPoints);
  VertexId* usedPoint = used.Data();
  backend.ForEach(
    callerPoints, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { usedPoint[i] = NoVertex; });
  backend.ForEach(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { usedPoint[ids[i]] = toIds[toNumbers[i]]; });
  strips = std::move(kept);
  return used;
}

}

#endif
