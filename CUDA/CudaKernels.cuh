// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAKERNELS_CUH
#define DELAUNAYFLIP_CUDAKERNELS_CUH

#include <cub/cub.cuh>

#include <cstdint>

/// @file
/// The kernels behind "for every item do this" (CudaBackend.cuh).

namespace delaunayflip
{

constexpr int ThreadsPerBlock = 256;

/// Items whose numbers a block assigns: TileItems a thread.
constexpr int TileItems = 4;
constexpr int TileSize = ThreadsPerBlock * TileItems;

/// One thread calls work(i) for every i of its stride. What work writes is its own business.
template <typename Work>
__global__ void __launch_bounds__(ThreadsPerBlock) ForEachKernel(std::int64_t size, Work work)
{
  const std::int64_t stride = std::int64_t(gridDim.x) * ThreadsPerBlock;
  for (std::int64_t i = std::int64_t(blockIdx.x) * ThreadsPerBlock + threadIdx.x; i < size;
       i += stride)
  {
    work(i);
  }
}

template <typename Result>
struct Plus
{
  __device__ Result operator()(Result a, const Result& b) const
  {
    a += b;
    return a;
  }
};

/// As ForEachKernel, with a sum; a block writes its own partial sum.
template <typename Result, typename Work>
__global__ void __launch_bounds__(ThreadsPerBlock)
  SumKernel(std::int64_t size, Work work, Result* partials)
{
  using Reduce = cub::BlockReduce<Result, ThreadsPerBlock>;
  __shared__ typename Reduce::TempStorage storage;
  Result sum{};
  const std::int64_t stride = std::int64_t(gridDim.x) * ThreadsPerBlock;
  for (std::int64_t i = std::int64_t(blockIdx.x) * ThreadsPerBlock + threadIdx.x; i < size;
       i += stride)
  {
    work(i, sum);
  }
  const Result total = Reduce(storage).Reduce(sum, Plus<Result>());
  if (threadIdx.x == 0)
  {
    partials[blockIdx.x] = total;
  }
}

/// Counts a thread's items of a tile; `counts` receives them one by one. @returns their sum.
template <typename CountOf>
__device__ int CountTileItems(std::int64_t size, const CountOf& count, int (&counts)[TileItems])
{
  int sum = 0;
  for (int k = 0; k < TileItems; ++k)
  {
    const std::int64_t i =
      std::int64_t(blockIdx.x) * TileSize + std::int64_t(threadIdx.x) * TileItems + k;
    counts[k] = i < size ? static_cast<int>(count(i)) : 0;
    sum += counts[k];
  }
  return sum;
}

/// One block counts one tile.
template <typename CountOf>
__global__ void __launch_bounds__(ThreadsPerBlock)
  CountKernel(std::int64_t size, CountOf count, std::int64_t* countOfTile)
{
  using Reduce = cub::BlockReduce<int, ThreadsPerBlock>;
  __shared__ typename Reduce::TempStorage storage;
  int counts[TileItems];
  const int total = Reduce(storage).Sum(CountTileItems(size, count, counts));
  if (threadIdx.x == 0)
  {
    countOfTile[blockIdx.x] = total;
  }
}

/// One block visits one tile, counting on from the tile's first number.
template <typename CountOf, typename Visit>
__global__ void __launch_bounds__(ThreadsPerBlock) ForEachNumberedKernel(
  std::int64_t size, CountOf count, Visit visit, const std::int64_t* firstOfTile)
{
  using Scan = cub::BlockScan<int, ThreadsPerBlock>;
  __shared__ typename Scan::TempStorage storage;
  int counts[TileItems];
  int before = 0;
  Scan(storage).ExclusiveSum(CountTileItems(size, count, counts), before);
  std::int64_t next = firstOfTile[blockIdx.x] + before;
  for (int k = 0; k < TileItems; ++k)
  {
    const std::int64_t i =
      std::int64_t(blockIdx.x) * TileSize + std::int64_t(threadIdx.x) * TileItems + k;
    if (i < size)
    {
      visit(i, next);
      next += counts[k];
    }
  }
}

}

#endif
