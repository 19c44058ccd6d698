// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAKERNELS_CUH
#define DELAUNAYFLIP_CUDAKERNELS_CUH

#include <cub/cub.cuh>

#include <cstdint>

/// @file
/// The kernels of CudaBackend.cuh, which run work for every item.

namespace delaunayflip
{

constexpr int ThreadsPerBlock = 256;

/// One thread calls work(i) for every i of its stride. The caller makes sure that what different i
/// write does not conflict.
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

/// The same as ForEachKernel, with a sum: every block writes its partial sum.
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

/// The sum of partial sums.
template <typename Result>
struct AddPartial
{
  const Result* Partials;

  __device__ void operator()(std::int64_t i, Result& sum) const { sum += this->Partials[i]; }
};

/// The item of this thread where a block handles a tile of ThreadsPerBlock.
__device__ inline std::int64_t GetTileItem()
{
  return std::int64_t(blockIdx.x) * ThreadsPerBlock + threadIdx.x;
}

/// One block counts one tile, one item per thread, because counting may wait for memory.
template <typename CountOf>
__global__ void __launch_bounds__(ThreadsPerBlock)
  CountKernel(std::int64_t size, CountOf count, std::int64_t* countOfTile)
{
  using Reduce = cub::BlockReduce<int, ThreadsPerBlock>;
  __shared__ typename Reduce::TempStorage storage;
  const std::int64_t i = GetTileItem();
  const int total = Reduce(storage).Sum(i < size ? static_cast<int>(count(i)) : 0);
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
  const std::int64_t i = GetTileItem();
  int before = 0;
  Scan(storage).ExclusiveSum(i < size ? static_cast<int>(count(i)) : 0, before);
  if (i < size)
  {
    visit(i, firstOfTile[blockIdx.x] + before);
  }
}

}

#endif
