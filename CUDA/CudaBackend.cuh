// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDABACKEND_CUH
#define DELAUNAYFLIP_CUDABACKEND_CUH

#include "Array.h"
#include "CudaContext.h"
#include "CudaError.h"
#include "CudaKernels.cuh"
#include "DeviceMesh.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipError.h"
#include "StagedCopy.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cub/cub.cuh>

#include <algorithm>
#include <cstdint>
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

  const TriangleMesh& View() const { return this->Mesh; }

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

/// Number of the first item of every tile of a range, in device memory, and of all items.
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
    : Context(ResolveDevices(devices)),
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

  /// The same on the first GPU alone.
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

  template <typename Result, typename Work>
  Result Sum(std::int64_t size, const Work& work) const
  {
    const int most = this->GetBlocks({ 0, size });
    Array<Result> partials = this->MakeArrayOnFirst<Result>(most * this->CountDevices() + 1);
    int blocks = 0;
    this->LaunchShared(size,
      [&](cudaStream_t stream, const ItemRange& items, int)
      {
        const int own = this->GetBlocks(items);
        SumKernel<<<own, ThreadsPerBlock, 0, stream>>>(items, work, partials.Data() + blocks);
        blocks += own;
      });
    Result* all = partials.Data() + blocks;
    this->Launch(
      [&](cudaStream_t stream)
      {
        SumKernel<<<1, ThreadsPerBlock, 0, stream>>>(
          ItemRange{ 0, blocks }, AddPartial<Result>{ partials.Data() }, all);
      });
    Result total;
    this->Download(all, 1, &total);
    return total;
  }

  using Numbering = DeviceNumbering;

  template <typename CountOf>
  Numbering Count(std::int64_t size, const CountOf& count) const
  {
    const std::int64_t tiles = ItemRange{ 0, size }.CountTiles();
    Numbering numbering;
    numbering.FirstOfTile = this->MakeArray<std::int64_t>(tiles + 1);
    std::int64_t* firsts = numbering.FirstOfTile.Data();
    this->Fill(firsts, 0, tiles + 1);
    this->LaunchShared(size,
      [&](cudaStream_t stream, const ItemRange& items, int) {
        CountKernel<<<GridOf(items.CountTiles()), ThreadsPerBlock, 0, stream>>>(
          items, count, firsts);
      });
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

  /// A device always uses the edge table.
  bool PairCorners(EdgeMesh&, std::int64_t, PairSums&, Numbering&) const { return false; }

  /// Sets the bytes of `size` values.
  template <typename T>
  void Fill(T* values, int byte, std::int64_t size) const
  {
    CallCuda("fill memory",
      [&] { return cudaMemsetAsync(values, byte, size * sizeof(T), this->GetStream()); });
  }

  /// Waits until the values have arrived.
  template <typename T>
  void Download(const T* values, std::int64_t size, T* host) const
  {
    CallCuda("copy from the GPU",
      [&]
      {
        return cudaMemcpyAsync(
          host, values, size * sizeof(T), cudaMemcpyDeviceToHost, this->GetStream());
      });
    this->Synchronize();
  }

  /// Waits until `host` has been read.
  template <typename T>
  void Upload(const T* host, std::int64_t size, T* values) const
  {
    StagedCopy(*this->Context, this->Threads)
      .Upload(size, values, [host](std::int64_t i) { return host[i]; });
  }

  void Synchronize() const
  {
    CallCuda("finish the work", [&] { return cudaStreamSynchronize(this->GetStream()); });
  }

  /// Lets the work that follows wait for what is in a stream of the caller.
  void WaitFor(const DeviceStream& stream) const
  {
    CudaContext& context = *this->Context;
    CallCuda("record an event",
      [&]
      { return cudaEventRecord(context.CallerDone, static_cast<cudaStream_t>(stream.Handle)); });
    CallCuda("wait for an event",
      [&] { return cudaStreamWaitEvent(context.Stream, context.CallerDone, 0); });
  }

  /// Copies the caller's arrays to the device.
  using LocalMesh = LocalDeviceMesh;
  LocalMesh Localize(const TriangleMesh& mesh) const;

  /// Views the caller's arrays in this device's memory, except points without z, which get one.
  LocalMesh Localize(const DeviceMesh& mesh) const;

  template <typename Store>
  void StoreTriangles(const MutableTriangleArray& triangles, const Store& store) const
  {
    const auto fill = [&](const OutputSlice& ids) {
      this->ForEach(triangles.Count, [=] __device__(std::int64_t t) { store(t, IdSlice{ ids }); });
    };
    // Vertex ids are unsigned 32-bit numbers.
    if (triangles.Ids32)
    {
      this->DownloadSlices(3 * triangles.Count, fill,
        [&](std::int64_t i, std::uint32_t id)
        { triangles.Ids32[i] = static_cast<std::int32_t>(id); });
    }
    else
    {
      this->DownloadSlices(3 * triangles.Count, fill,
        [&](std::int64_t i, std::uint32_t id) { triangles.Ids64[i] = id; });
    }
  }

  template <typename Store>
  void StoreValues(std::int64_t size, std::int32_t* values, const Store& store) const
  {
    this->DownloadSlices(
      size,
      [&](const OutputSlice& slice)
      { this->ForEach(size, [=] __device__(std::int64_t i) { store(i, slice); }); },
      [=](std::int64_t i, std::uint32_t value) { values[i] = static_cast<std::int32_t>(value); });
  }

  /// Calls store(i, target) for i = 0 .. size - 1, to set values of the caller's in this device's
  /// memory after all that is in the caller's stream. Waits for it.
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
      this->Launch([&](cudaStream_t own)
        { ForEachKernel<<<this->GetBlocks(items), ThreadsPerBlock, 0, own>>>(items, work); });
    }
    this->Synchronize();
  }

  /// Calls launch(stream), which launches a kernel, and checks it.
  template <typename LaunchKernel>
  void Launch(const LaunchKernel& launch) const
  {
    CallCuda("start a kernel",
      [&]
      {
        launch(this->GetStream());
        return cudaGetLastError();
      });
  }

  int CountDevices() const { return 1 + static_cast<int>(this->Context->Others.size()); }

  /// Calls launch(stream, part), which launches a kernel, on each of the first `parts` GPUs.
  template <typename LaunchPart>
  void LaunchOnEach(int parts, const LaunchPart& launch) const
  {
    if (parts == 1)
    {
      this->Launch([&](cudaStream_t stream) { launch(stream, 0); });
      return;
    }
    this->Context->Fork();
    this->Launch([&](cudaStream_t stream) { launch(stream, 0); });
    for (int part = 1; part < parts; ++part)
    {
      const DeviceStreams& other = this->Context->Others[part - 1];
      const CurrentDevice current(other.Device);
      CallCuda("start a kernel",
        [&]
        {
          launch(other.Stream, part);
          return cudaGetLastError();
        });
    }
    this->Context->Join();
  }

  /// Calls launch(stream, items, part), which launches a kernel, for the items of every GPU.
  template <typename LaunchItems>
  void LaunchShared(std::int64_t size, const LaunchItems& launch) const
  {
    // Fewer are done by one GPU before another would begin.
    constexpr std::int64_t SmallestShared = std::int64_t(1) << 18;
    const int parts = size < SmallestShared ? 1 : this->CountDevices();
    if (size > 0)
    {
      this->LaunchOnEach(parts,
        [&](cudaStream_t stream, int part) {
          launch(stream, { FirstOf(part, parts, size), FirstOf(part + 1, parts, size) }, part);
        });
    }
  }

  /// The first item of a part; they are as large as the parts of an array (SharedMemory).
  static std::int64_t FirstOf(int part, int parts, std::int64_t size)
  {
    return part == parts ? size : size * part / parts / ThreadsPerBlock * ThreadsPerBlock;
  }

  /// The caller's points with three coordinates each: a view, or a copy in `wide`. Public because
  /// device lambdas require it.
  template <typename T>
  PointArray ViewPoints(const T* values, const DevicePointArray& points, Array<T>& wide) const;

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
  /// @throws BackendUnavailable for more points than ids can name.
  static void RequireCountable(std::int64_t points);

  /// A copy of the host's values.
  template <typename T>
  Array<T> Bring(const T* host, std::int64_t size) const;

  /// Sets what the caller knows about edges, with copies of what is per triangle.
  void BringLabels(const FixedEdges& fixed, LocalDeviceMesh& local) const;

  /// Calls put(i, value) on the host for i = 0 .. size - 1. The values are copied in slices, to
  /// save memory: fill(slice) launches a kernel over all triangles that sets the values of one
  /// slice, while the host still converts the slice before it.
  template <typename Fill, typename Put>
  void DownloadSlices(std::int64_t size, const Fill& fill, const Put& put) const
  {
    const std::int64_t sliceSize = StagedCopy::GetSliceSize<std::uint32_t>(size, SlicesOfOutput);
    Array<std::uint32_t> values = this->MakeArray<std::uint32_t>(std::min(size, sliceSize));
    StagedCopy(*this->Context, this->Threads)
      .DownloadSlices(
        size, values.Data(), sliceSize,
        [&](std::int64_t first) {
          fill(OutputSlice{ values.Data(), first, std::min(size, first + sliceSize) });
        },
        put);
  }

  static constexpr std::int64_t SlicesOfOutput = 8;

  static std::vector<int> ResolveDevices(std::vector<int> devices)
  {
    if (devices.front() < 0)
    {
      CallCuda("ask for the current device", [&] { return cudaGetDevice(&devices.front()); });
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

template <int KeyBits, typename KeyOf>
Array<std::uint32_t> CudaBackend::SortIndices(std::int64_t size, const KeyOf& keyOf) const
{
  // One GPU sorts.
  Array<std::uint32_t> keys = this->MakeArrayOnFirst<std::uint32_t>(size);
  Array<std::uint32_t> sortedKeys = this->MakeArrayOnFirst<std::uint32_t>(size);
  Array<std::uint32_t> indices = this->MakeArrayOnFirst<std::uint32_t>(size);
  Array<std::uint32_t> sorted = this->MakeArrayOnFirst<std::uint32_t>(size);
  std::uint32_t* keyOfItem = keys.Data();
  std::uint32_t* indexOfItem = indices.Data();
  this->ForEach(size,
    [=] __device__(std::int64_t i)
    {
      keyOfItem[i] = keyOf(i);
      indexOfItem[i] = static_cast<std::uint32_t>(i);
    });
  cub::DoubleBuffer<std::uint32_t> keyBuffer(keys.Data(), sortedKeys.Data());
  cub::DoubleBuffer<std::uint32_t> indexBuffer(indices.Data(), sorted.Data());
  this->RunCub(
    [&](void* temporary, std::size_t& bytes)
    {
      return cub::DeviceRadixSort::SortPairs(
        temporary, bytes, keyBuffer, indexBuffer, size, 0, KeyBits, this->GetStream());
    });
  Array<std::uint32_t> found =
    indexBuffer.Current() == sorted.Data() ? std::move(sorted) : std::move(indices);
  return this->CountDevices() == 1 ? std::move(found) : this->Share(found);
}

}

#endif
