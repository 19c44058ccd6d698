// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuDescription.h"

#include "BenchmarkTable.h"
#include "CudaDevice.h"

#include <cuda_runtime_api.h>

namespace delaunayflip
{
namespace
{

/// CUDA's 13000 is "13.0".
std::string FormatVersion(int version)
{
  return QuoteJson(std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10));
}

}

std::string DescribeGpuInJson()
{
  cudaDeviceProp properties = {};
  int device = 0;
  if (!HasCudaDevice() || cudaGetDevice(&device) != cudaSuccess ||
    cudaGetDeviceProperties(&properties, device) != cudaSuccess)
  {
    return "null";
  }
  int runtime = 0;
  int driver = 0;
  cudaRuntimeGetVersion(&runtime);
  cudaDriverGetVersion(&driver);
  return "{\"name\": " + QuoteJson(properties.name) + ", \"compute_capability\": " +
    QuoteJson(std::to_string(properties.major) + "." + std::to_string(properties.minor)) +
    ", \"multiprocessors\": " + std::to_string(properties.multiProcessorCount) +
    ", \"memory_bytes\": " + std::to_string(properties.totalGlobalMem) +
    ", \"cuda_runtime\": " + FormatVersion(runtime) +
    ", \"cuda_of_driver\": " + FormatVersion(driver) + "}";
}

}
