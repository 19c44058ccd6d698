// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereRun.h"

#include "CudaDevice.h"
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
  this->Fetch();
  AskResult result = AskResult::Undecided;
  if (this->IsOver() && !this->Triangles.empty())
  {
    this->RequireAsker();
    result = this->AskDevice(query, progress);
  }
  if (result == AskResult::Undecided && query.OnDevice)
  {
    const HostQuery host(
      query, this->Input.Points.Count, query.Degrees ? Coordinates - 1 : Coordinates);
    result = this->AskHost(host.Get(), progress);
    host.CopyBack();
  }
  else if (result == AskResult::Undecided)
  {
    result = this->AskHost(query, progress);
  }
  return result == AskResult::Complete;
}

void SphereRun::RequireAsker()
{
  if (this->Asker)
  {
    return;
  }
  const bool isWhole = this->Numbers.empty();
  const auto& triangles = isWhole ? this->Triangles : this->WholeTriangles;
  const auto& neighbors = isWhole ? this->Neighbors : this->WholeNeighbors;
  const SphereMesh mesh{ this->Points.data(), triangles.data(), neighbors.data(),
    SizeOf(triangles) / 3 };
  this->Asker =
    std::make_unique<SphereAsker>(mesh, SizeOf(this->Points), this->Numbers, this->Edges);
}

/// Lets a GPU answer if one is used. Few places in the host's memory are not worth the copies.
/// @returns Undecided if the host has to answer.
AskResult SphereRun::AskDevice(const PlaceQuery& query, const ProgressObserver& progress)
{
  const bool areFew = !query.OnDevice && query.CountPlaces() < SmallestMeshForCuda;
  if (areFew || !this->PrefersDevice())
  {
    return AskResult::Undecided;
  }
  try
  {
    if (!this->DeviceAsker)
    {
      this->DeviceAsker =
        LoadAskerOnCuda(this->Asker->View(), SizeOf(this->Points), this->ChooseDevice());
    }
    if (query.OnDevice && !this->DeviceAsker->CanAnswerInPlace(query))
    {
      return AskResult::Undecided;
    }
    return this->DeviceAsker->Answer(query, progress);
  }
  catch (const BackendUnavailable&)
  {
    this->DeviceAsker.reset();
    return AskResult::Undecided;
  }
}

/// @param query its arrays are in the host's memory.
AskResult SphereRun::AskHost(const PlaceQuery& query, const ProgressObserver& progress) const
{
  if (!this->Asker)
  {
    FillOutside(query);
    return AskResult::Complete;
  }
  const ThreadBackend threads(this->Options.NumberOfThreads);
  return this->Asker->Answer(query, threads, progress);
}

}
