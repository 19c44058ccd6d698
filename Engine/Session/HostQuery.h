// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTQUERY_H
#define DELAUNAYFLIP_HOSTQUERY_H

#include "Array.h"
#include "CallerMesh.h"
#include "FlipError.h"
#include "Interpolation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What queries about places in the plane and on a sphere have in common.

namespace delaunayflip
{

/// @throws InvalidOptions.
inline void CheckQuery(const PlaceQuery& query)
{
  constexpr std::int64_t MostCells = std::int64_t(1) << 40;
  const PlaceRaster& raster = query.Raster;
  const bool hasCells = raster.Columns > 0 && raster.Rows > 0;
  if (raster.Columns < 0 || raster.Rows < 0 ||
    (hasCells && raster.Rows > MostCells / raster.Columns))
  {
    throw InvalidOptions("a raster of " + std::to_string(raster.Columns) + " columns and " +
      std::to_string(raster.Rows) + " rows is not possible; 0 to 2^40 cells are");
  }
  if (query.Places.Count < 0 || query.Places.Stride < 2)
  {
    throw InvalidOptions("places need a count that is not negative and a stride of at least 2");
  }
  if (query.Values && (query.Components < 1 || !query.Results))
  {
    throw InvalidOptions("values at places need at least one component and an array for results");
  }
}

/// Stores the results of all places for a mesh without triangles.
inline void FillOutside(const PlaceQuery& query)
{
  const std::int64_t count = query.CountPlaces();
  if (query.Triangles)
  {
    std::fill_n(query.Triangles, count, -1);
  }
  if (query.Values)
  {
    std::fill_n(query.Results, count * query.Components, std::nan(""));
  }
}

/// Copies in the host's memory of those arrays of a query that are in the memory of a GPU.
class HostQuery
{
public:
  /// @param points how many have values. @param coordinates how many are read for each place.
  HostQuery(const PlaceQuery& query, std::int64_t points, std::int64_t coordinates = 2)
    : Caller(query),
      Query(query)
  {
    const std::int64_t count = query.CountPlaces();
    if (query.Raster.CountCells() == 0 && count > 0)
    {
      const std::int64_t numbers = (count - 1) * query.Places.Stride + coordinates;
      this->Fetch(query.Places.Floats, numbers, this->Floats, this->Query.Places.Floats);
      this->Fetch(query.Places.Doubles, numbers, this->Doubles, this->Query.Places.Doubles);
    }
    this->Fetch(query.Values, points * query.Components, this->Values, this->Query.Values);
    this->Triangles.resize(query.Triangles ? count : 0);
    this->Results.resize(query.Values ? count * query.Components : 0);
    this->Query.Triangles = query.Triangles ? this->Triangles.data() : nullptr;
    this->Query.Results = query.Values ? this->Results.data() : nullptr;
    this->Query.OnDevice = false;
  }

  const PlaceQuery& Get() const { return this->Query; }

  /// Copies the results to the caller's arrays.
  void CopyBack() const
  {
    this->Store(this->Triangles, this->Caller.Triangles);
    this->Store(this->Results, this->Caller.Results);
  }

private:
  template <typename Value>
  void Fetch(
    const Value* values, std::int64_t size, std::vector<Value>& copy, const Value*& fetched) const
  {
    if (values && size > 0)
    {
      RequireOnDevice(values, size, "places or values are");
      copy.resize(size);
      CopyMemory(
        values, size * static_cast<std::int64_t>(sizeof(Value)), copy.data(), this->Caller.Stream);
      fetched = copy.data();
    }
  }

  template <typename Value>
  void Store(const std::vector<Value>& values, Value* target) const
  {
    constexpr auto Bytes = static_cast<std::int64_t>(sizeof(Value));
    CopyMemory(values.data(), SizeOf(values) * Bytes, target, this->Caller.Stream);
  }

  const PlaceQuery& Caller;
  PlaceQuery Query;
  std::vector<float> Floats;
  std::vector<double> Doubles, Values, Results;
  std::vector<std::int32_t> Triangles;
};

}

#endif
