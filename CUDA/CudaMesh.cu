// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"
#include "CudaBackend.cuh"
#include "CudaFlipLoop.cuh"
#include "FlipError.h"
#include "MeshOnBackend.h"
#include "Strips.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Bits that have the same order as the numbers.
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

/// Sorts all points by their strip and as many bits of x as a key has room for. Usually few points
/// have an equal key, and one thread sorts them. If there are many, all points are first sorted by
/// y, then by x; each sort keeps the order of equal keys.
template <typename Real>
struct StripSorter<Real, CudaBackend>
{
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
    int stripBits = 1;
    while ((strips >> stripBits) > 0)
    {
      ++stripBits;
    }
    constexpr int RealBits = 8 * sizeof(Real);
    const int lost = std::max(0, RealBits + stripBits - 64);
    const auto keyOf = [=] __device__(Real x, Real y)
    {
      const bool isFinite = IsFinite(x) && IsFinite(y);
      const std::uint64_t strip = isFinite ? findStrip(y) : unused;
      return strip << (RealBits - lost) | OrderedBits(x) >> lost;
    };

    StripPoints<Real> sorted;
    sorted.Strips = strips;
    sorted.Ids = backend.MakeIndices(count);
    sorted.Coordinates = backend.MakeArray<Real>(2 * count);
    CoordinatePair<Real>* places = sorted.Places();
    for (const bool byAll : { false, true })
    {
      for (int axis = 1; axis >= 0 && byAll; --axis)
      {
        backend.template SortBy<std::uint64_t>(sorted.Ids, count, RealBits,
          [=] __device__(std::uint32_t i)
          { return std::uint64_t(OrderedBits(static_cast<Real>(points.Get(i, axis)))); });
      }
      backend.template SortBy<std::uint64_t>(sorted.Ids, count, RealBits - lost + stripBits,
        [=] __device__(std::uint32_t i) {
          return keyOf(static_cast<Real>(points.Get(i, 0)), static_cast<Real>(points.Get(i, 1)));
        });
      VertexId* ids = sorted.Ids.Data();
      backend.ForEach(count,
        [=] __device__(std::int64_t i)
        {
          places[i] = { static_cast<Real>(points.Get(ids[i], 0)),
            static_cast<Real>(points.Get(ids[i], 1)) };
        });
      const auto keyAt = [=] __device__(std::int64_t i) { return keyOf(places[i].U, places[i].V); };
      if (byAll)
      {
        break;
      }
      const std::int64_t unsorted = backend.template Sum<std::int64_t>(count,
        [=] __device__(std::int64_t i, std::int64_t & sum)
        { sum += int(!SortEqualKeys(i, count, places, ids, keyAt)); });
      if (unsorted == 0)
      {
        break;
      }
    }
    FindStarts(
      sorted, count,
      [=] __device__(std::int64_t i)
      { return static_cast<std::int64_t>(keyOf(places[i].U, places[i].V) >> (RealBits - lost)); },
      backend);
    return sorted;
  }

  /// Finds where strips begin among the sorted points. Those that are not finite come after the
  /// last strip, and count no more.
  /// @param stripOf the strip of a sorted point
  template <typename StripOf>
  static void FindStarts(StripPoints<Real>& sorted, std::int64_t count, const StripOf& stripOf,
    const CudaBackend& backend)
  {
    const std::int64_t strips = sorted.Strips;
    sorted.Starts = backend.MakeArray<std::uint32_t>(strips + 1);
    std::uint32_t* starts = sorted.Starts.Data();
    backend.ForEach(count + 1,
      [=] __device__(std::int64_t i)
      {
        const std::int64_t first = i > 0 ? stripOf(i - 1) + 1 : 0;
        const std::int64_t strip = i < count ? stripOf(i) : strips;
        for (std::int64_t next = first; next <= strip; ++next)
        {
          starts[next] = static_cast<std::uint32_t>(i);
        }
      });
    std::uint32_t used = 0;
    backend.Download(starts + strips, 1, &used);
    sorted.Count = used;
  }

  /// If points of equal keys begin at a place, sorts these. That changes no key, so other threads
  /// may read keys meanwhile.
  /// @returns false if the points are too many for one thread.
  template <typename KeyAt>
  __device__ static bool SortEqualKeys(std::int64_t first, std::int64_t count,
    CoordinatePair<Real>* places, VertexId* ids, const KeyAt& keyAt)
  {
    constexpr std::int64_t Most = 64;
    const auto continues = [&](std::int64_t i)
    { return i > 0 && i < count && keyAt(i) == keyAt(i - 1); };
    if (continues(first) || !continues(first + 1))
    {
      return true;
    }
    std::int64_t end = first + 2;
    while (end - first <= Most && continues(end))
    {
      ++end;
    }
    for (std::int64_t i = first + 1; i < end; ++i)
    {
      const CoordinatePair<Real> place = places[i];
      const VertexId id = ids[i];
      const auto isBefore = [&](const CoordinatePair<Real>& other)
      { return place.U < other.U || (place.U == other.U && place.V < other.V); };
      std::int64_t to = i;
      for (; to > first && isBefore(places[to - 1]); --to)
      {
        places[to] = places[to - 1];
        ids[to] = ids[to - 1];
      }
      places[to] = place;
      ids[to] = id;
    }
    return end - first <= Most;
  }
};

//------------------------------------------------------------------------------
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

/// Stores the triangles that flips have changed since the last time; `Written` has their numbers of
/// flips at that time. A triangle that stays costs two reads and no write. The lanes of a warp have
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
      const auto flips =
        static_cast<std::int32_t>(this->Triangles.Stored.Triangles[t].Flips / OneFlip);
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

/// A mesh that also stores into arrays in the memory of its device.
class CudaMesh : public MeshOnBackend<CudaBackend>
{
public:
  using MeshOnBackend::MeshOnBackend;

  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written) const override
  {
    const StoreStep all = this->GetStoreStep();
    constexpr std::int64_t lanes = StoreChangedStep::Lanes;
    const std::int64_t full = (triangles.Count + lanes - 1) / lanes * lanes;
    if (written)
    {
      return this->StoreHere(
        triangles.Data(), full, triangles, stream, StoreChangedStep{ all, written });
    }
    return this->StoreHere(triangles.Data(), 3 * this->LimitToStored(triangles).Count, triangles,
      stream, StoreIdStep{ all });
  }

  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream) const override
  {
    return this->StoreHere(counts, this->CountStored(), stream, this->GetFlipCountStep());
  }

  bool StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream& stream) const override
  {
    return this->StoreHere(neighbors, 3 * this->CountStored(), stream, this->GetNeighborStep());
  }

  AskResult Ask(const RunQuery& asked, const ProgressObserver& observer) override
  {
    if (asked.Query.OnDevice)
    {
      this->GetBackend().WaitFor(asked.Query.Stream);
    }
    return MeshOnBackend::Ask(asked, observer);
  }

  bool CanAnswerInPlace(const PlaceQuery& query) const override
  {
    const void* const arrays[] = { query.Places.Data(), query.Triangles, query.Values,
      query.Results };
    return std::all_of(std::begin(arrays), std::end(arrays),
      [&](const void* array) { return !array || this->HasMemory(array); });
  }

  bool HasMemory(const void* array) const override
  {
    return FindDeviceOf(array) == this->GetBackend().GetContext().Device;
  }

  MotionResult MovePoints(const PointInput& targets, const std::vector<EdgeId>& segments,
    const BuildProgress& progress) override
  {
    if (targets.OnDevice)
    {
      this->GetBackend().WaitFor(targets.Stream);
    }
    return MeshOnBackend::MovePoints(targets, segments, progress);
  }

private:
  /// Stores if the memory is that of the device. @returns whether it is.
  template <typename Target, typename Store>
  bool StoreHere(const void* memory, std::int64_t size, const Target& target,
    const DeviceStream& stream, const Store& store) const
  {
    const CudaBackend& backend = this->GetBackend();
    const bool isHere = size == 0 || FindDeviceOf(memory) == backend.GetContext().Device;
    if (isHere)
    {
      backend.StoreOnDevice(size, target, stream, store);
    }
    return isHere;
  }
  template <typename Store>
  bool StoreHere(
    std::int32_t* values, std::int64_t size, const DeviceStream& stream, const Store& store) const
  {
    const OutputSlice all{ reinterpret_cast<std::uint32_t*>(values), 0, size };
    return this->StoreHere(values, size, all, stream, store);
  }
};
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
  CudaBackend backend(devices, options.NumberOfThreads);
  const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
  LocalDeviceMesh local = backend.Localize(mesh);
  return std::make_unique<CudaMesh>(mesh, std::move(local), options, std::move(backend), progress);
}

/// A mesh that is on a GPU stays there.
std::unique_ptr<LoadedMesh> LoadOnCuda(
  const DeviceMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  CudaBackend backend({ options.Device }, options.NumberOfThreads);
  const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
  LocalDeviceMesh local = backend.Localize(mesh);
  TriangleMesh view; // the caller's arrays, where they are
  static_cast<FixedEdges&>(view) = mesh;
  static_cast<CoordinateArray&>(view.Points) = mesh.Points;
  view.Triangles = mesh.Triangles;
  return std::make_unique<CudaMesh>(view, std::move(local), options, std::move(backend), progress);
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const PointInput& points, const FlipOptions& options, const BuildProgress& progress)
{
  CudaBackend backend({ options.Device }, options.NumberOfThreads);
  const std::unique_ptr<DeviceScope> current = backend.MakeCurrent();
  if (points.OnDevice)
  {
    backend.WaitFor(points.Stream);
  }
  return std::make_unique<CudaMesh>(
    points.Points, points.OnDevice, options, std::move(backend), progress);
}

}
