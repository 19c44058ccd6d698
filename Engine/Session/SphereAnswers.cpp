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
  if (this->Input.NumberOfSegments + this->Input.NumberOfHoleSeeds > 0)
  {
    throw InvalidOptions("places cannot be found on a sphere with segments, outlines or holes yet");
  }
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
  if (!this->IsOver() || this->Triangles.empty())
  {
    FillOutside(query);
    return true;
  }
  if (!this->Asker)
  {
    this->Asker = std::make_unique<SphereAsker>(SphereMesh{ this->Points.data(),
      this->Triangles.data(), this->Neighbors.data(), this->Report.Triangles });
  }
  const ThreadBackend threads(this->Options.NumberOfThreads);
  return this->Asker->Answer(query, threads, progress) == AskResult::Complete;
}

}
