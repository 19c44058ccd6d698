// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "FlipError.h"
#include "HostQuery.h"

#include <cstdint>
#include <string>

/// @file
/// How the run of points answers queries about places.

namespace delaunayflip
{

bool PointRun::Ask(const PlaceQuery& query, const ProgressObserver& progress)
{
  CheckQuery(query);
  if (query.Degrees)
  {
    throw InvalidOptions("places have longitudes and latitudes only on a sphere");
  }
  if (query.Values && query.Method == InterpolationKind::Natural && this->Found.Bad > 0)
  {
    throw InvalidOptions("natural neighbors need a Delaunay triangulation, and " +
      std::to_string(this->Found.Bad) + " edges are bad; let the run go on until it has converged");
  }
  if (query.CountPlaces() == 0)
  {
    return true;
  }
  AskResult result = this->Answer(query, progress);
  if (result == AskResult::Undecided)
  {
    const HostQuery host(query, this->Points.CountAll());
    result = this->Answer(host.Get(), progress);
    host.CopyBack();
  }
  return result == AskResult::Complete;
}

/// Asks the mesh where it is. That may change meanwhile, if a GPU fails.
/// @returns Undecided only for a query on a device: if its arrays are not where the mesh is, or the
/// device leaves the answer to the host.
AskResult PointRun::Answer(const PlaceQuery& query, const ProgressObserver& progress)
{
  AskResult result = AskResult::Undecided;
  const auto ask = [&](LoadedMesh& mesh)
  {
    if (query.OnDevice && !mesh.CanAnswerInPlace(query))
    {
      return;
    }
    const std::int64_t points = this->Points.CountAll();
    const bool isConvex = !this->WantsRefinement;
    result = mesh.Ask({ query, this->Result.Kept.Numbers, points, isConvex }, progress);
  };
  if (this->Report.Triangles > 0)
  {
    this->TryOnBackend(ask);
  }
  if (result == AskResult::Undecided && !query.OnDevice)
  {
    FillOutside(query);
    return AskResult::Complete;
  }
  return result;
}

}
