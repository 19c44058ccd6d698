// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDABACKEND_CUH
#define DELAUNAYFLIP_CUDABACKEND_CUH

#include "Array.h"
#include "CudaContext.h"
#include "CudaKernels.cuh"
#include "DeviceMesh.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipError.h"
#include "StagedCopies.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cub/cub.cuh>
#include <cuda_runtime_api.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// The caller's mesh in the device's memory.
struct LocalDeviceMesh
{
  TriangleMesh Mesh; ///< Views of the arrays below, or of the caller's if they are on the device.
  bool IsOnHost = true; ///< Whether the caller's arrays are in the host's memory.
  Array<float> Floats;
  Array<double> Doubles;
  Array<std::int32_t> Triangles, Regions;
  Array<unsigned char> Frozen;

  /// Frees the array of which the engine now has its own form.
  void DropPoints()
  {
    this->Floats = Array<float>();
    this->Doubles = Array<double>();
  }
  void DropTriangles()
  {
    this->Triangles = Array<std::int32_t>();
    this->Frozen = Array<unsigned char>();
  }
  void DropRegions() { this->Regions = Array<std::int32_t>(); }
};

/// The number of the first item of every tile of a range, in device memory, and that of all items.
struct DeviceNumbering
{
  Array<std::int64_t> FirstOfTile;
  std::int64_t Total = 0;
};

/// Runs work for every item on a GPU: the counterpart of ThreadBackend, with the same results.
/// Calls return before the work is done, except those that return something to the host.
///
/// Every call may throw BackendUnavailable.
class CudaBackend
{
public:
  /// @param devices CUDA's numbers of the GPUs, which share the mesh; -1: the current one.
  /// @param threads the number of CPU threads, for conversions of copied data.
  CudaBackend(const std::vector<int>& devices, int threads)
    : Context(LeaseContext(ResolveDevices(devices))),
      Threads(threads)
  {
  }

  std::unique_ptr<DeviceScope> MakeCurrent() const
  {
    return std::unique_ptr<DeviceScope>(new CurrentDevice(this->Context->Device));
  }

  static constexpr bool IsOnHost = false;
  static constexpr bool MemoryIsScarce = true;

  /// With slices of vertices an edge table takes a quarter of the memory, and every triangle is
  /// visited four times. Several GPUs have more memory, and a slice would be on one of them.
  int CountTableSlices() const
  {
    constexpr int Slices = 4;
    return this->CountDevices() == 1 ? Slices : 1;
  }

  /// E.g. "CUDA: NVIDIA H200".
  std::string GetName() const { return "CUDA: " + this->Context->Name; }

  CudaContext& GetContext() const { return *this->Context; }
  cudaStream_t GetStream() const { return this->Context->Stream; }

  template <typename T>
  Array<T> MakeArray(std::int64_t size) const
  {
    return Array<T>(static_cast<std::size_t>(size), this->Context->GetMemory());
  }

  /// Makes an array in the memory of the first GPU alone.
  template <typename T>
  Array<T> MakeArrayOnFirst(std::int64_t size) const
  {
    return Array<T>(static_cast<std::size_t>(size), *this->Context->Pool);
  }

  template <typename Work>
  void ForEach(std::int64_t size, const Work& work) const
  {
    this->LaunchShared(size,
      [&](cudaStream_t stream, const ItemRange& items, int)
      { ForEachKernel<<<this->GetBlocks(items), ThreadsPerBlock, 0, stream>>>(items, work); });
  }

  template <typename Work>
  void RunGroup(const Work& work) const
  {
    cudaLaunchAttribute cluster{};
    cudaLaunchConfig_t config = ConfigureGroup(this->CountGroupBlocks(), cluster);
    Launch(this->GetStream(),
      [&](cudaStream_t stream)
      {
        config.stream = stream;
        cudaLaunchKernelEx(&config, GroupKernel<Work>, work); // Launch sees whether this fails
      });
  }

  /// The number of threads of a group.
  std::int64_t CountGroupThreads() const
  {
    return std::int64_t(this->CountGroupBlocks()) * ThreadsOfGroup;
  }

  template <typename Result, typename Work>
  Result Sum(std::int64_t size, const Work& work) const
  {
    static_assert(sizeof(Result) <= CudaContext::ResultBytes);
    if (size == 0)
    {
      return Result{};
    }
    const int most = this->GetBlocks({ 0, size });
    Array<Result> partials = this->MakeArrayOnFirst<Result>(most * this->CountDevices());
    int blocks = 0;
    this->LaunchShared(size,
      [&](cudaStream_t stream, const ItemRange& items, int)
      {
        const int own = this->GetBlocks(items);
        SumKernel<<<own, ThreadsPerBlock, 0, stream>>>(items, work, partials.Data() + blocks);
        blocks += own;
      });
    const AddPartial<Result> add{ partials.Data() };
    auto* all = static_cast<Result*>(this->Context->GetResult());
    Launch(this->GetStream(),
      [&](cudaStream_t stream) {
        SumKernel<<<1, ThreadsPerBlock, 0, stream>>>(ItemRange{ 0, blocks }, add, all);
      });
    this->Synchronize();
    return *all;
  }

  using Numbering = DeviceNumbering;

  template <typename CountOf>
  Numbering Count(std::int64_t size, const CountOf& count) const
  {
    const std::int64_t tiles = ItemRange{ 0, size }.CountTiles();
    Numbering numbering;
    if (size == 0)
    {
      return numbering;
    }
    numbering.FirstOfTile = this->MakeArray<std::int64_t>(tiles + 1);
    std::int64_t* firsts = numbering.FirstOfTile.Data();
    this->LaunchShared(size,
      [&](cudaStream_t stream, const ItemRange& items, int) {
        CountKernel<<<GridOf(items.CountTiles()), ThreadsPerBlock, 0, stream>>>(
          items, count, firsts);
      });
    if (tiles <= FewTiles)
    {
      auto* total = static_cast<std::int64_t*>(this->Context->GetResult());
      Launch(this->GetStream(),
        [&](cudaStream_t stream)
        { NumberTilesKernel<<<1, ThreadsOfGroup, 0, stream>>>(tiles, firsts, total); });
      this->Synchronize();
      numbering.Total = *total;
      return numbering;
    }
    this->Fill(firsts + tiles, 0, 1);
    this->RunCub(
      [&](void* temporary, std::size_t& bytes)
      {
        return cub::DeviceScan::ExclusiveSum(
          temporary, bytes, firsts, firsts, static_cast<int>(tiles + 1), this->GetStream());
      });
    this->Download(firsts + tiles, 1, &numbering.Total);
    return numbering;
  }

  template <typename CountOf, typename Visit>
  void ForEachNumbered(
    const Numbering& numbering, std::int64_t size, const CountOf& count, const Visit& visit) const
  {
    this->LaunchShared(size,
      [&](cudaStream_t stream, const ItemRange& items, int)
      {
        ForEachNumberedKernel<<<GridOf(items.CountTiles()), ThreadsPerBlock, 0, stream>>>(
          items, count, visit, numbering.FirstOfTile.Data());
      });
  }

  template <int KeyBits, typename KeyOf>
  Array<std::uint32_t> SortIndices(std::int64_t size, const KeyOf& keyOf) const;

  /// 0 .. size - 1, on the first GPU.
  Array<std::uint32_t> MakeIndices(std::int64_t size) const
  {
    Array<std::uint32_t> indices = this->MakeArrayOnFirst<std::uint32_t>(size);
    std::uint32_t* index = indices.Data();
    this->ForEach(
      size, [=] __device__(std::int64_t i) { index[i] = static_cast<std::uint32_t>(i); });
    return indices;
  }

  /// Sorts `order`, which names items, by keyOf(item); equal keys keep their order.
  template <typename Key, typename KeyOf>
  void SortBy(
    Array<std::uint32_t>& order, std::int64_t size, int keyBits, const KeyOf& keyOf) const;

  /// Sorts `size` numbers, none of which is NaN.
  void SortNumbers(Array<double>& numbers, std::int64_t size) const;

  HostMemory& GetHostMemory() const { return this->Threads.GetHostMemory(); }
  const ThreadBackend& GetThreads() const { return this->Threads; }

  /// Calls work(task) for task = 0 .. count - 1 on CPU threads.
  void ForTasks(std::int64_t count, const std::function<void(std::int64_t)>& work) const
  {
    this->Threads.ForTasks(count, work);
  }

  /// A device always uses the edge table.
  bool PairCorners(EdgeMesh&, std::int64_t, PairSums&, Numbering&) const { return false; }

  /// Sets the bytes of `size` values.
  template <typename T>
  void Fill(T* values, int byte, std::int64_t size) const
  {
    CallCuda("fill memory", cudaMemsetAsync, values, byte, size * sizeof(T), this->GetStream());
  }

  /// Waits until the values have arrived.
  template <typename T>
  void Download(const T* values, std::int64_t size, T* host) const
  {
    constexpr std::size_t Staged = std::size_t(1) << 20; // from here on buffers are faster
    const std::size_t bytes = static_cast<std::size_t>(size) * sizeof(T);
    if (bytes >= Staged)
    {
      this->GetCopies().Receive(
        size, values, [host](std::int64_t i, const T& value) { host[i] = value; });
      return;
    }
    const bool isSmall = bytes <= CudaContext::ResultBytes;
    void* const to = isSmall ? this->Context->GetResult() : static_cast<void*>(host);
    CallCuda("copy from the GPU", cudaMemcpyAsync, to, values, bytes, cudaMemcpyDeviceToHost,
      this->GetStream());
    this->Synchronize();
    if (isSmall)
    {
      std::memcpy(static_cast<void*>(host), to, bytes);
    }
  }

  /// Calls put(i, value) on CPU threads for i = 0 .. size - 1.
  template <typename T, typename Put>
  void Receive(const T* values, std::int64_t size, const Put& put) const
  {
    this->GetCopies().Receive(size, values, put);
  }

  /// Waits until `host` has been read.
  template <typename T>
  void Upload(const T* host, std::int64_t size, T* values) const
  {
    this->GetCopies().Send(size, values, [host](std::int64_t i) { return host[i]; });
  }

  void Synchronize() const
  {
    CallCuda("finish the work", cudaStreamSynchronize, this->GetStream());
  }

  /// Lets the work that follows wait for what is in a stream of the caller.
  void WaitFor(const DeviceStream& stream) const
  {
    CudaContext::LetWait(
      this->GetStream(), static_cast<cudaStream_t>(stream.Handle), this->Context->CallerDone);
  }

  /// Copies the caller's arrays to the device.
  using LocalMesh = LocalDeviceMesh;
  LocalMesh Localize(const TriangleMesh& mesh) const
  {
    const PointArray& points = mesh.Points;
    const TriangleArray& triangles = mesh.Triangles;
    LocalMesh local = this->BringLabels(mesh, points.Count, triangles.Count);
    local.Triangles = this->MakeArray<std::int32_t>(3 * triangles.Count);
    this->GetCopies().Send(3 * triangles.Count, local.Triangles.Data(),
      [&](std::int64_t i)
      {
        // An id that does not fit is invalid, and stays invalid.
        const std::int64_t id = triangles.Ids32 ? triangles.Ids32[i] : triangles.Ids64[i];
        return id == static_cast<std::int32_t>(id) ? static_cast<std::int32_t>(id) : -1;
      });
    local.Mesh.Triangles = TriangleArray(local.Triangles.Data(), triangles.Count);
    const std::int64_t numbers = 3 * points.Count;
    if (points.Floats)
    {
      local.Mesh.Points = { this->Bring(points.Floats, numbers, local.Floats), points.Count };
    }
    else
    {
      local.Mesh.Points = { this->Bring(points.Doubles, numbers, local.Doubles), points.Count };
    }
    return local;
  }

  /// Views the caller's arrays in this device's memory. Points without z are copied, with z = 0.
  LocalMesh Localize(const DeviceMesh& mesh) const
  {
    const DevicePointArray& points = mesh.Points;
    LocalMesh local = this->BringLabels(mesh, points.Count, mesh.Triangles.Count);
    this->WaitFor(mesh.Stream);
    local.IsOnHost = false;
    local.Mesh.Triangles = mesh.Triangles;
    if (points.Floats)
    {
      local.Mesh.Points = { this->WithZ(points.Floats, points, local.Floats), points.Count };
    }
    else
    {
      local.Mesh.Points = { this->WithZ(points.Doubles, points, local.Doubles), points.Count };
    }
    return local;
  }

  template <typename Store>
  void StoreTriangles(
    const MutableTriangleArray& triangles, const Store& store, bool areInOrder) const
  {
    const auto fill = [&](const OutputSlice& ids)
    {
      std::int64_t first = 0, last = triangles.Count;
      if (areInOrder)
      {
        first = ids.First / 3;
        last = (ids.Last + 2) / 3;
      }
      this->ForEach(
        last - first, [=] __device__(std::int64_t i) { store(first + i, IdSlice{ ids }); });
    };
    const auto download = [&](auto* ids)
    {
      this->GetCopies().DownloadSlices(3 * triangles.Count, areInOrder, fill,
        [ids](std::int64_t i, std::uint32_t id)
        { ids[i] = static_cast<std::remove_pointer_t<decltype(ids)>>(id); });
    };
    if (triangles.Ids32)
    {
      download(triangles.Ids32);
    }
    else
    {
      download(triangles.Ids64);
    }
  }

  template <typename Store>
  void StoreValues(std::int64_t size, std::int32_t* values, const Store& store) const
  {
    this->GetCopies().DownloadSlices(
      size, false,
      [&](const OutputSlice& slice)
      { this->ForEach(size, [=] __device__(std::int64_t i) { store(i, slice); }); },
      [=](std::int64_t i, std::uint32_t value) { values[i] = static_cast<std::int32_t>(value); });
  }

  /// Calls store(i, target) for i = 0 .. size - 1, to set the caller's values in the memory of this
  /// device, after all that is in the caller's stream. Waits until they are set.
  template <typename Target, typename Store>
  void StoreOnDevice(
    std::int64_t size, const Target& target, const DeviceStream& stream, const Store& store) const
  {
    this->WaitFor(stream);
    const ItemRange items{ 0, size };
    const auto work = [=] __device__(std::int64_t i) { store(i, target); };
    if (size > 0)
    {
      // The other GPUs cannot access the caller's memory.
      Launch(this->GetStream(),
        [&](cudaStream_t own)
        { ForEachKernel<<<this->GetBlocks(items), ThreadsPerBlock, 0, own>>>(items, work); });
    }
    this->Synchronize();
  }

  /// Lets blocks of a kernel without shared memory of its own take all of a multiprocessor's.
  /// @returns the number of bytes.
  std::size_t AllowAllSharedMemory(void (*kernel)(EmptyWork)) const
  {
    int device = 0, bytes = 0;
    CallCuda("plan a launch", cudaGetDevice, &device);
    CallCuda("plan a launch", cudaDeviceGetAttribute, &bytes,
      cudaDevAttrMaxSharedMemoryPerBlockOptin, device);
    CallCuda("plan a launch",
      [&]
      { return cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes); });
    return static_cast<std::size_t>(bytes);
  }

  /// The number of blocks of a group. Blocks wait for each other in a cluster, if the code was
  /// compiled for GPUs that have them, which begin with compute capability 9.0.
  unsigned int CountGroupBlocks() const
  {
    constexpr int FirstWithClusters = 90;
    unsigned int& known = this->Context->GroupBlocks;
    if (known == 0)
    {
      const auto kernel = GroupKernel<EmptyWork>; // all kernels are compiled for the same GPUs
      cudaFuncAttributes attributes{};
      CallCuda("plan a launch", [&] { return cudaFuncGetAttributes(&attributes, kernel); });
      int clusters = 0; // a share of a GPU may have no room for one
      if (attributes.ptxVersion >= FirstWithClusters)
      {
        cudaLaunchAttribute cluster{};
        cudaLaunchConfig_t config = ConfigureGroup(MostGroupBlocks, cluster);
        // Each block takes a whole multiprocessor, as those of work with many registers do.
        config.dynamicSmemBytes = this->AllowAllSharedMemory(kernel);
        if (cudaOccupancyMaxActiveClusters(&clusters, kernel, &config) != cudaSuccess)
        {
          clusters = 0;
          cudaGetLastError(); // so that nobody takes it for a failure of what follows
        }
      }
      known = clusters > 0 ? MostGroupBlocks : 1;
    }
    return known;
  }

  /// @param cluster is written, and must live until the launch.
  static cudaLaunchConfig_t ConfigureGroup(unsigned int blocks, cudaLaunchAttribute& cluster)
  {
    cluster.id = cudaLaunchAttributeClusterDimension;
    cluster.val.clusterDim.x = blocks;
    cluster.val.clusterDim.y = cluster.val.clusterDim.z = 1;
    cudaLaunchConfig_t config{};
    config.gridDim = { blocks, 1, 1 };
    config.blockDim = { ThreadsOfGroup, 1, 1 };
    config.attrs = &cluster;
    config.numAttrs = blocks > 1 ? 1 : 0;
    return config;
  }

  /// Calls launch(stream), which launches a kernel, and checks it.
  template <typename LaunchKernel>
  static void Launch(cudaStream_t stream, const LaunchKernel& launch)
  {
    CallCuda("start a kernel",
      [&]
      {
        launch(stream);
        return cudaGetLastError();
      });
  }

  int CountDevices() const { return static_cast<int>(this->Context->Devices.size()); }

  /// Calls launch(stream, device), which launches a kernel, on each of the first `devices` GPUs.
  template <typename LaunchShare>
  void LaunchOnEach(int devices, const LaunchShare& launch) const
  {
    if (devices > 1)
    {
      this->Context->Fork();
    }
    Launch(this->GetStream(), [&](cudaStream_t stream) { launch(stream, 0); });
    for (int device = 1; device < devices; ++device)
    {
      const DeviceStreams& other = this->Context->Others[device - 1];
      const CurrentDevice current(other.Device);
      Launch(other.Stream, [&](cudaStream_t stream) { launch(stream, device); });
    }
    if (devices > 1)
    {
      this->Context->Join();
    }
  }

  /// Calls launch(stream, items, device), which launches a kernel, for the items of every GPU.
  template <typename LaunchItems>
  void LaunchShared(std::int64_t size, const LaunchItems& launch) const
  {
    // Fewer are done by one GPU before another would begin.
    constexpr std::int64_t SmallestShared = std::int64_t(1) << 18;
    const int devices = size < SmallestShared ? 1 : this->CountDevices();
    if (size > 0)
    {
      this->LaunchOnEach(devices,
        [&](cudaStream_t stream, int device)
        {
          const ItemRange items{ FirstOf(device, devices, size),
            FirstOf(device + 1, devices, size) };
          launch(stream, items, device);
        });
    }
  }

  /// The first item of a GPU. It has as many items as elements of a shared array (SharedMemory).
  static std::int64_t FirstOf(int device, int devices, std::int64_t size)
  {
    if (device == devices)
    {
      return size;
    }
    return size * device / devices / ThreadsPerBlock * ThreadsPerBlock;
  }

  /// The caller's points with three coordinates each: as they are, or copied to `wide`. Public
  /// because device lambdas require it.
  template <typename T>
  const T* WithZ(const T* values, const DevicePointArray& points, Array<T>& wide) const
  {
    if (points.Components == 3)
    {
      return values;
    }
    wide = this->MakeArray<T>(3 * points.Count);
    T* xyz = wide.Data();
    this->ForEach(points.Count,
      [=] __device__(std::int64_t i)
      {
        xyz[3 * i] = values[2 * i];
        xyz[3 * i + 1] = values[2 * i + 1];
        xyz[3 * i + 2] = 0;
      });
    return xyz;
  }

  /// A copy on all GPUs. Public because device lambdas require it.
  Array<std::uint32_t> Share(const Array<std::uint32_t>& values) const
  {
    const auto size = static_cast<std::int64_t>(values.Size());
    Array<std::uint32_t> shared = this->MakeArray<std::uint32_t>(size);
    const std::uint32_t* from = values.Data();
    std::uint32_t* to = shared.Data();
    this->ForEach(size, [=] __device__(std::int64_t i) { to[i] = from[i]; });
    return shared;
  }

private:
  /// So many tiles are numbered by one block.
  static constexpr std::int64_t FewTiles = 8192;

  /// Copies the host's values to `local`, and returns where they are there.
  template <typename T>
  const T* Bring(const T* host, std::int64_t size, Array<T>& local) const
  {
    local = this->MakeArray<T>(size);
    this->Upload(host, size, local.Data());
    return local.Data();
  }

  /// A mesh that has only what the caller knows about edges, with copies of what is per triangle.
  /// @throws BackendUnavailable for more points than ids can name.
  LocalMesh BringLabels(const FixedEdges& fixed, std::int64_t points, std::int64_t triangles) const
  {
    if (points > std::numeric_limits<std::int32_t>::max())
    {
      throw BackendUnavailable("the mesh has " + std::to_string(points) +
        " points; the CUDA backend numbers them with 31 bits, use 'threads'");
    }
    LocalMesh local;
    static_cast<FixedEdges&>(local.Mesh) = fixed;
    if (fixed.Regions)
    {
      local.Mesh.Regions = this->Bring(fixed.Regions, triangles, local.Regions);
    }
    if (fixed.FrozenTriangles)
    {
      local.Mesh.FrozenTriangles = this->Bring(fixed.FrozenTriangles, triangles, local.Frozen);
    }
    return local;
  }

  StagedCopies GetCopies() const { return { *this->Context, this->Threads }; }

  static std::vector<int> ResolveDevices(std::vector<int> devices)
  {
    if (devices.front() < 0)
    {
      CallCuda("ask for the current device", cudaGetDevice, &devices.front());
    }
    return devices;
  }

  static unsigned GridOf(std::int64_t blocks) { return static_cast<unsigned>(blocks); }

  /// Enough blocks for every item, but at most several waves of blocks.
  int GetBlocks(const ItemRange& items) const
  {
    constexpr std::int64_t BlocksPerMultiprocessor = 32;
    return static_cast<int>(std::max<std::int64_t>(
      1, std::min(items.CountTiles(), BlocksPerMultiprocessor * this->Context->Multiprocessors)));
  }

  /// Calls a CUB algorithm twice, as it requires: for the size of its memory, then with the memory.
  template <typename Algorithm>
  void RunCub(const Algorithm& algorithm) const
  {
    std::size_t bytes = 0;
    CallCuda("plan a sort or scan", [&] { return algorithm(nullptr, bytes); });
    Array<char> temporary = this->MakeArrayOnFirst<char>(static_cast<std::int64_t>(bytes));
    CallCuda("sort or scan", [&] { return algorithm(temporary.Data(), bytes); });
  }

  ContextLease Context;
  ThreadBackend Threads;
};

inline void CudaBackend::SortNumbers(Array<double>& numbers, std::int64_t size) const
{
  Array<double> sorted = this->MakeArrayOnFirst<double>(size);
  this->RunCub(
    [&](void* temporary, std::size_t& bytes)
    {
      return cub::DeviceRadixSort::SortKeys(temporary, bytes, numbers.Data(), sorted.Data(), size,
        0, 8 * static_cast<int>(sizeof(double)), this->GetStream());
    });
  numbers = std::move(sorted);
}

template <typename Key, typename KeyOf>
void CudaBackend::SortBy(
  Array<std::uint32_t>& order, std::int64_t size, int keyBits, const KeyOf& keyOf) const
{
  Array<Key> keys = this->MakeArrayOnFirst<Key>(size);
  Array<Key> sortedKeys = this->MakeArrayOnFirst<Key>(size);
  Array<std::uint32_t> sorted = this->MakeArrayOnFirst<std::uint32_t>(size);
  Key* keyOfPlace = keys.Data();
  const std::uint32_t* item = order.Data();
  this->ForEach(size, [=] __device__(std::int64_t i) { keyOfPlace[i] = keyOf(item[i]); });
  cub::DoubleBuffer<Key> keyBuffer(keys.Data(), sortedKeys.Data());
  cub::DoubleBuffer<std::uint32_t> buffer(order.Data(), sorted.Data());
  this->RunCub(
    [&](void* temporary, std::size_t& bytes)
    {
      return cub::DeviceRadixSort::SortPairs(
        temporary, bytes, keyBuffer, buffer, size, 0, keyBits, this->GetStream());
    });
  if (buffer.Current() == sorted.Data())
  {
    order = std::move(sorted);
  }
}

template <int KeyBits, typename KeyOf>
Array<std::uint32_t> CudaBackend::SortIndices(std::int64_t size, const KeyOf& keyOf) const
{
  // One GPU sorts.
  Array<std::uint32_t> order = this->MakeIndices(size);
  this->SortBy<std::uint32_t>(order, size, KeyBits, keyOf);
  if (this->CountDevices() > 1)
  {
    return this->Share(order);
  }
  return order;
}

}

#endif
