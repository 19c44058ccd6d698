// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaBackend.cuh"
#include "SphereOnBackend.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace delaunayflip
{

namespace
{
/// A mesh of points on a sphere, which can also be stored into arrays in the memory of its GPU.
class CudaSphere : public SphereOnBackend<CudaBackend>
{
public:
  using SphereOnBackend::SphereOnBackend;

  bool StoreTriangles(const MutableTriangleArray& triangles, const DeviceStream& stream) override
  {
    return this->StoreHere(triangles.Data(), this->GetTriangles(), triangles, stream);
  }

  bool StoreNeighbors(std::int32_t* neighbors, const DeviceStream& stream) override
  {
    return this->StoreHere(neighbors, this->GetNeighbors(),
      MutableTriangleArray(neighbors, this->CountTriangles()), stream);
  }

private:
  bool StoreHere(const void* memory, const std::int32_t* numbers,
    const MutableTriangleArray& target, const DeviceStream& stream) const
  {
    const CudaBackend& backend = this->GetBackend();
    const bool isHere = FindDeviceOf(memory) == backend.GetContext().Device;
    if (isHere)
    {
      backend.StoreOnDevice(3 * target.Count, target, stream, StoreNumberStep{ numbers });
    }
    return isHere;
  }
};

class CudaAsker : public SphereAskerOnBackend<CudaBackend>
{
public:
  using SphereAskerOnBackend::SphereAskerOnBackend;

  bool CanAnswerInPlace(const PlaceQuery& query) const override
  {
    const void* const arrays[] = { query.Places.Data(), query.Triangles, query.Values,
      query.Results };
    const int device = this->GetBackend().GetContext().Device;
    return std::all_of(std::begin(arrays), std::end(arrays),
      [=](const void* array) { return !array || FindDeviceOf(array) == device; });
  }

  AskResult Answer(const PlaceQuery& query, const ProgressObserver& observer) override
  {
    const std::unique_ptr<DeviceScope> current = this->GetBackend().MakeCurrent();
    if (query.OnDevice)
    {
      this->GetBackend().WaitFor(query.Stream);
    }
    return SphereAskerOnBackend::Answer(query, observer);
  }
};
}

std::unique_ptr<LoadedSphere> LoadSphereOnCuda(const PointInput& points, const FlipOptions& options)
{
  CudaBackend backend({ options.Device }, options.NumberOfThreads);
  const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
  if (points.OnDevice)
  {
    backend.WaitFor(points.Stream);
  }
  auto sphere = std::make_unique<CudaSphere>(std::move(backend));
  sphere->Load(points);
  return sphere;
}

std::unique_ptr<SphereDeviceAsker> LoadAskerOnCuda(
  const AskedSphere& asked, std::int64_t points, const FlipOptions& options)
{
  CudaBackend backend({ options.Device }, options.NumberOfThreads);
  const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
  return std::make_unique<CudaAsker>(asked, points, std::move(backend));
}

}
