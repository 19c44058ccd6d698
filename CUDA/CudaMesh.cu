// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"
#include "CudaBackend.cuh"
#include "CudaFlipLoop.cuh"
#include "DeviceStripSorting.cuh"
#include "FlipError.h"
#include "MeshOnBackend.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

namespace
{
/// Stores id i of all triangles. Neighbouring threads have the ids of one triangle, so that these
/// go to memory together.
struct StoreIdStep
{
  StoreStep Triangles;

  __device__ void operator()(std::int64_t i, const MutableTriangleArray& target) const
  {
    const auto id = static_cast<std::uint32_t>(i); // divides faster
    this->Triangles.StoreId(id / 3, static_cast<int>(id % 3), target);
  }
};

/// Stores the triangles that flips have changed since the last time, of which `Written` has the
/// numbers of flips. A triangle that stays costs two reads and no write. The lanes of a warp have
/// neighbouring triangles, and share the ids of those that have changed, so that the three of a
/// triangle go to memory together.
struct StoreChangedStep
{
  static constexpr int Lanes = 32;
  StoreStep Triangles;
  std::int32_t* Written;

  /// @param t where all lanes of the warp are in the call, up to the next multiple of their number.
  __device__ void operator()(std::int64_t t, const MutableTriangleArray& target) const
  {
    const int lane = static_cast<int>(t % Lanes);
    bool hasChanged = false;
    if (t < target.Count)
    {
      const auto flips = static_cast<std::int32_t>(this->Triangles.Triangles[t].Flips / OneFlip);
      hasChanged = this->Written[t] != flips;
      if (hasChanged)
      {
        this->Written[t] = flips;
      }
    }
    const unsigned changed = __ballot_sync(~0u, hasChanged);
    for (int id = lane; id < 3 * Lanes; id += Lanes)
    {
      if (changed >> (id / 3) & 1u)
      {
        this->Triangles.StoreId(t - lane + id / 3, id % 3, target);
      }
    }
  }
};

/// Also stores into arrays in the memory of its device.
class CudaMesh : public MeshOnBackend<CudaBackend>
{
public:
  using MeshOnBackend::MeshOnBackend;

  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written) const override
  {
    if (triangles.Count > 0 && !this->IsHere(triangles.Data()))
    {
      return false;
    }
    const StoreStep all = this->GetStoreStep();
    const CudaBackend& backend = this->GetBackend();
    if (written)
    {
      constexpr std::int64_t lanes = StoreChangedStep::Lanes;
      const std::int64_t full = (triangles.Count + lanes - 1) / lanes * lanes;
      backend.StoreOnDevice(full, triangles, stream, StoreChangedStep{ all, written });
    }
    else
    {
      backend.StoreOnDevice(3 * triangles.Count, triangles, stream, StoreIdStep{ all });
    }
    return true;
  }

  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream) const override
  {
    const std::int64_t size = this->GetInputReport().Triangles;
    if (size > 0 && !this->IsHere(counts))
    {
      return false;
    }
    const OutputSlice all{ reinterpret_cast<std::uint32_t*>(counts), 0, size };
    this->GetBackend().StoreOnDevice(size, all, stream, this->GetFlipCountStep());
    return true;
  }

  bool StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream& stream) const override
  {
    const std::int64_t size = 3 * this->GetInputReport().Triangles;
    if (size > 0 && !this->IsHere(neighbors))
    {
      return false;
    }
    const OutputSlice all{ reinterpret_cast<std::uint32_t*>(neighbors), 0, size };
    this->GetBackend().StoreOnDevice(size, all, stream, this->GetNeighborStep());
    return true;
  }

private:
  bool IsHere(const void* memory) const
  {
    return FindDeviceOf(memory) == this->GetBackend().GetContext().Device;
  }
};

/// @param view the caller's arrays, wherever they are.
template <typename Mesh>
std::unique_ptr<LoadedMesh> Load(const Mesh& mesh, const TriangleMesh& view,
  const std::vector<int>& devices, const FlipOptions& options, const BuildProgress& progress)
{
  try
  {
    CudaBackend backend(devices, options.NumberOfThreads);
    const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
    LocalDeviceMesh local = backend.Localize(mesh);
    return std::unique_ptr<LoadedMesh>(
      new CudaMesh(view, std::move(local), options, std::move(backend), progress));
  }
  catch (const BeyondDevice& error)
  {
    throw BackendUnavailable(error.what());
  }
}
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  std::vector<int> devices = { options.Device };
  if (!options.Devices.empty())
  {
    const auto most = static_cast<std::size_t>(mesh.Triangles.Count / SmallestShare);
    devices = options.Devices;
    devices.resize(std::max<std::size_t>(1, std::min(devices.size(), most)));
  }
  return Load(mesh, mesh, devices, options, progress);
}

/// A mesh that is on a GPU stays there.
std::unique_ptr<LoadedMesh> LoadOnCuda(
  const DeviceMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  TriangleMesh view;
  static_cast<FixedEdges&>(view) = mesh;
  view.Points.Floats = mesh.Points.Floats;
  view.Points.Doubles = mesh.Points.Doubles;
  view.Points.Count = mesh.Points.Count;
  view.Triangles = mesh.Triangles;
  return Load(mesh, view, { options.Device }, options, progress);
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const PointInput& points, const FlipOptions& options, const BuildProgress& progress)
{
  try
  {
    CudaBackend backend({ options.Device }, options.NumberOfThreads);
    const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
    if (points.OnDevice)
    {
      backend.WaitFor(points.Stream);
    }
    return std::unique_ptr<LoadedMesh>(
      new CudaMesh(points.Points, points.OnDevice, options, std::move(backend), progress));
  }
  catch (const BeyondDevice& error)
  {
    throw BackendUnavailable(error.what());
  }
}

}
