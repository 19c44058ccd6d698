// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereRun.h"

#include "FlipError.h"
#include "HostQuery.h"
#include "ThreadBackend.h"

#include <string>

/// @file
/// How the run on a sphere answers queries about places.

namespace delaunayflip
{

bool SphereRun::Ask(const PlaceQuery& query, const ProgressObserver& progress)
{
  constexpr std::int64_t Coordinates = 3;
  CheckQuery(query);
  const bool hasDirections =
    query.Raster.CountCells() > 0 || query.Degrees || query.Places.Count == 0;
  if (!hasDirections && query.Places.Stride < Coordinates)
  {
    throw InvalidOptions(
      "places on a sphere need x, y and z, or longitudes and latitudes in degrees");
  }
  if (query.CountPlaces() == 0)
  {
    return true;
  }
  if (query.OnDevice)
  {
    const HostQuery host(
      query, this->Input.Points.Count, query.Degrees ? Coordinates - 1 : Coordinates);
    const bool isComplete = this->Ask(host.Get(), progress);
    host.CopyBack();
    return isComplete;
  }
  this->Fetch();
  if (!this->IsOver() || this->Triangles.empty())
  {
    FillOutside(query);
    return true;
  }
  if (!this->Asker)
  {
    const bool isWhole = this->Numbers.empty();
    const auto& triangles = isWhole ? this->Triangles : this->WholeTriangles;
    const auto& neighbors = isWhole ? this->Neighbors : this->WholeNeighbors;
    const SphereMesh mesh{ this->Points.data(), triangles.data(), neighbors.data(),
      SizeOf(triangles) / 3 };
    this->Asker =
      std::make_unique<SphereAsker>(mesh, SizeOf(this->Points), this->Numbers, this->Edges);
  }
  const ThreadBackend threads(this->Options.NumberOfThreads);
  return this->Asker->Answer(query, threads, progress) == AskResult::Complete;
}

}
