// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREDEVICEASKER_H
#define DELAUNAYFLIP_SPHEREDEVICEASKER_H

#include "Array.h"
#include "RunQuery.h"
#include "SphereQuery.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace delaunayflip
{

/// A triangulation on a sphere in the memory of a device, which answers queries. Every call may
/// throw BackendUnavailable.
class SphereDeviceAsker
{
public:
  virtual ~SphereDeviceAsker() = default;

  /// Whether all arrays of a query are in the memory of the device.
  virtual bool CanAnswerInPlace(const PlaceQuery& query) const = 0;

  /// @param query its arrays are in the memory of the device (CanAnswerInPlace) or of the host.
  /// @param observer is told the share of the places that is done.
  virtual AskResult Answer(const PlaceQuery& query, const ProgressObserver& observer) = 0;
};

/// What all devices have in common.
template <typename Backend>
class SphereAskerOnBackend : public SphereDeviceAsker
{
public:
  /// Copies what is asked.
  /// @param host in the host's memory. @param points their number.
  SphereAskerOnBackend(const AskedSphere& host, std::int64_t points, Backend backend)
    : Device(std::move(backend)),
      Asked(host),
      Points(points)
  {
    const std::int64_t triangles = host.Mesh.NumberOfTriangles;
    const std::int64_t cells = PlaceGridFrame::GetFirst(host.Grid.Frame.Finest + 1);
    AskedSphere& here = this->Asked;
    SphereMesh& seen = here.Seen.Mesh;
    const SphereBoundaryView& boundary = host.Boundary;
    here.Mesh.Points = this->Copy(host.Mesh.Points, points, this->Places);
    here.Mesh.Triangles = this->Copy(host.Mesh.Triangles, 3 * triangles, this->Triangles);
    here.Mesh.Neighbors = this->Copy(host.Mesh.Neighbors, 3 * triangles, this->Neighbors);
    seen = here.Mesh;
    if (host.Seen.Mesh.Neighbors != host.Mesh.Neighbors)
    {
      seen.Neighbors = this->Copy(host.Seen.Mesh.Neighbors, 3 * triangles, this->SeenNeighbors);
    }
    here.Seen.Directions = this->Copy(host.Seen.Directions, points, this->Directions);
    here.Numbers = this->Copy(host.Numbers, triangles, this->Numbers);
    here.Grid.Cells = this->Copy(host.Grid.Cells, cells, this->Cells);
    here.Boundary.Directions = here.Seen.Directions;
    here.Boundary.Edges = this->Copy(boundary.Edges, boundary.NumberOfEdges, this->Edges);
    here.Boundary.Caps = this->Copy(boundary.Caps, boundary.CountGroups(), this->Caps);
    const std::int32_t none = 0;
    this->Copy(&none, 1, this->Failed);
    here.Failed = this->Failed.Data();
  }

  AskResult Answer(const PlaceQuery& query, const ProgressObserver& observer) override
  {
    constexpr std::int64_t MostAtATime = 1 << 20; // keeps a GPU busy, and needs little memory
    PlaceQuery here = query;
    Array<double> values;
    if (!query.OnDevice)
    {
      here.Values = this->Copy(query.Values, this->Points * query.Components, values);
    }
    const std::int64_t count = query.CountPlaces();
    for (std::int64_t first = 0; first < count; first += MostAtATime)
    {
      if (observer && !observer(static_cast<double>(first) / static_cast<double>(count)))
      {
        return AskResult::Stopped;
      }
      const std::int64_t size = std::min(MostAtATime, count - first);
      const AnswerOnSphere answer = CutAnswer(this->Asked, here, first, size);
      if (query.OnDevice)
      {
        this->Device.ForEach(size, answer);
      }
      else
      {
        this->AnswerCopy(answer, size);
      }
    }
    std::int32_t hasFailed = 0;
    this->Device.Download(this->Failed.Data(), 1, &hasFailed);
    if (hasFailed == 0)
    {
      return AskResult::Complete;
    }
    const std::int32_t none = 0;
    this->Device.Upload(&none, 1, this->Failed.Data());
    return AskResult::Undecided;
  }

protected:
  const Backend& GetBackend() const { return this->Device; }

private:
  /// Copies values of the host. @returns where they are; null for none.
  template <typename T>
  const T* Copy(const T* host, std::int64_t size, Array<T>& copy) const
  {
    if (!host || size == 0)
    {
      return nullptr;
    }
    copy = this->Device.template MakeArray<T>(size);
    this->Device.Upload(host, size, copy.Data());
    return copy.Data();
  }

  /// Answers a block with places and results in the host's memory.
  void AnswerCopy(AnswerOnSphere answer, std::int64_t count) const
  {
    const PlaceBlock block = answer.Block;
    const std::int64_t coordinates = answer.Degrees ? 2 : 3;
    const std::int64_t numbers = (count - 1) * block.Places.Stride + coordinates;
    Array<float> floats;
    Array<double> doubles, results;
    Array<std::int32_t> triangles;
    PlaceBlock& here = answer.Block;
    here.Places.Floats = this->Copy(block.Places.Floats, numbers, floats);
    here.Places.Doubles = this->Copy(block.Places.Doubles, numbers, doubles);
    const std::int64_t size = count * answer.Values.Components;
    if (block.Triangles)
    {
      triangles = this->Device.template MakeArray<std::int32_t>(count);
    }
    if (block.Results)
    {
      results = this->Device.template MakeArray<double>(size);
    }
    here.Triangles = triangles.Data();
    here.Results = results.Data();
    this->Device.ForEach(count, answer);
    this->Device.Download(here.Triangles, block.Triangles ? count : 0, block.Triangles);
    this->Device.Download(here.Results, block.Results ? size : 0, block.Results);
  }

  Backend Device;
  AskedSphere Asked; ///< With the arrays below.
  std::int64_t Points;
  Array<PlanePoint> Places;
  Array<Vector3> Directions;
  Array<std::int32_t> Triangles, Neighbors, SeenNeighbors, Numbers, Failed;
  Array<TriangleId> Cells;
  Array<BoundaryEdge> Edges;
  Array<BoundaryCap> Caps;
};

}

#endif
