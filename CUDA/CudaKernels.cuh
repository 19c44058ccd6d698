// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAKERNELS_CUH
#define DELAUNAYFLIP_CUDAKERNELS_CUH

#include "ThreadGroup.h"

#include <cub/cub.cuh>

#include <cstdint>

/// @file
/// The kernels by which CudaBackend does work for every item.

namespace delaunayflip
{

constexpr int ThreadsPerBlock = 256;

/// The items [First, Last) of a launch. First is a multiple of ThreadsPerBlock.
struct ItemRange
{
  std::int64_t First, Last;

  /// How many blocks are enough for them.
  __host__ __device__ std::int64_t CountTiles() const
  {
    return (this->Last - this->First + ThreadsPerBlock - 1) / ThreadsPerBlock;
  }
  /// The item of this thread where a block handles a tile of ThreadsPerBlock.
  __device__ std::int64_t GetFirst() const
  {
    return this->First + std::int64_t(blockIdx.x) * ThreadsPerBlock + threadIdx.x;
  }
  /// The tile of this block among all items.
  __device__ std::int64_t GetTile() const { return this->First / ThreadsPerBlock + blockIdx.x; }
};

/// One thread calls work(i) for every i of its stride. The caller makes sure that calls for
/// different i do not write to the same place.
template <typename Work>
__global__ void __launch_bounds__(ThreadsPerBlock) ForEachKernel(ItemRange items, Work work)
{
  const std::int64_t stride = std::int64_t(gridDim.x) * ThreadsPerBlock;
  for (std::int64_t i = items.GetFirst(); i < items.Last; i += stride)
  {
    work(i);
  }
}

constexpr int ThreadsOfGroup = 512; ///< In one of its blocks.
/// The most blocks that all GPUs with clusters can have in one.
constexpr unsigned int MostGroupBlocks = 8;

struct EmptyWork
{
  __device__ void operator()(const ThreadGroup&) const {}
};

/// @param work is given a group that is one block or a cluster of blocks.
template <typename Work>
__global__ void __launch_bounds__(ThreadsOfGroup) GroupKernel(Work work)
{
  work(ThreadGroup{
    blockIdx.x * ThreadsOfGroup + threadIdx.x, gridDim.x * ThreadsOfGroup, ThreadsOfGroup });
}

/// Does the work of ForEachKernel and sums up: every block writes its partial sum.
template <typename Result, typename Work>
__global__ void __launch_bounds__(ThreadsPerBlock)
  SumKernel(ItemRange items, Work work, Result* partials)
{
  using Reduce = cub::BlockReduce<Result, ThreadsPerBlock>;
  __shared__ typename Reduce::TempStorage storage;
  Result sum{};
  const std::int64_t stride = std::int64_t(gridDim.x) * ThreadsPerBlock;
  for (std::int64_t i = items.GetFirst(); i < items.Last; i += stride)
  {
    work(i, sum);
  }
  const auto plus = [](Result a, const Result& b) { return a += b; };
  const Result total = Reduce(storage).Reduce(sum, plus);
  if (threadIdx.x == 0)
  {
    partials[blockIdx.x] = total;
  }
}

/// Adds up partial sums. Not a lambda, so that there is one kernel for each type of sum.
template <typename Result>
struct AddPartial
{
  __device__ void operator()(std::int64_t i, Result& sum) const { sum += this->Partials[i]; }

  const Result* Partials;
};

/// One block counts one tile, one item per thread, because counting may wait for memory.
template <typename CountOf>
__global__ void __launch_bounds__(ThreadsPerBlock)
  CountKernel(ItemRange items, CountOf count, std::int64_t* countOfTile)
{
  using Reduce = cub::BlockReduce<int, ThreadsPerBlock>;
  __shared__ typename Reduce::TempStorage storage;
  const std::int64_t i = items.GetFirst();
  const int own = i < items.Last ? static_cast<int>(count(i)) : 0;
  const int total = Reduce(storage).Sum(own);
  if (threadIdx.x == 0)
  {
    countOfTile[items.GetTile()] = total;
  }
}

/// One block replaces the counts of all tiles by the numbers of their first items. For up to some
/// thousand tiles this is faster than the launches of a scan by several blocks.
/// @param total receives the number of all items; it may be page-locked memory of the host.
template <typename Number>
__global__ void __launch_bounds__(ThreadsOfGroup)
  NumberTilesKernel(std::int64_t tiles, Number* firstOfTile, Number* total)
{
  using Scan = cub::BlockScan<Number, ThreadsOfGroup>;
  __shared__ typename Scan::TempStorage storage;
  Number before = 0; // items of the tiles before these
  for (std::int64_t begin = 0; begin < tiles; begin += ThreadsOfGroup)
  {
    const std::int64_t tile = begin + threadIdx.x;
    const Number own = tile < tiles ? firstOfTile[tile] : 0;
    Number first = 0, sum = 0;
    Scan(storage).ExclusiveSum(own, first, sum);
    if (tile < tiles)
    {
      firstOfTile[tile] = before + first;
    }
    before += sum;
    __syncthreads(); // the storage is used again
  }
  if (threadIdx.x == 0)
  {
    *total = before;
  }
}

/// One block visits one tile, counting on from the tile's first number.
template <typename CountOf, typename Visit>
__global__ void __launch_bounds__(ThreadsPerBlock) ForEachNumberedKernel(
  ItemRange items, CountOf count, Visit visit, const std::int64_t* firstOfTile)
{
  using Scan = cub::BlockScan<int, ThreadsPerBlock>;
  __shared__ typename Scan::TempStorage storage;
  const std::int64_t i = items.GetFirst();
  const int own = i < items.Last ? static_cast<int>(count(i)) : 0;
  int before = 0;
  Scan(storage).ExclusiveSum(own, before);
  if (i < items.Last)
  {
    visit(i, firstOfTile[items.GetTile()] + before);
  }
}

}

#endif
