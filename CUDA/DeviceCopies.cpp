// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Array.h"

#include "CudaContext.h"
#include "CudaError.h"

namespace delaunayflip
{

namespace
{
/// @param device the side of the copy that is in device memory.
void Copy(void* to, const void* from, std::int64_t bytes, const void* device, DeviceStream stream)
{
  const CurrentDevice current(FindDeviceOf(device)); // which the default stream belongs to
  const auto handle = static_cast<cudaStream_t>(stream.Handle);
  CallCuda("copy between host and GPU",
    [&] { return cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, handle); });
  CallCuda("finish a copy", [&] { return cudaStreamSynchronize(handle); });
}
}

int FindDeviceOf(const void* memory)
{
  cudaPointerAttributes attributes = {};
  CallCuda("find the GPU that has an array",
    [&] { return cudaPointerGetAttributes(&attributes, memory); });
  const bool isOnDevice =
    attributes.type == cudaMemoryTypeDevice || attributes.type == cudaMemoryTypeManaged;
  return isOnDevice ? attributes.device : -1;
}

void CopyFromDevice(const void* device, std::int64_t bytes, void* host, const DeviceStream& stream)
{
  Copy(host, device, bytes, device, stream);
}

void CopyToDevice(const void* host, std::int64_t bytes, void* device, const DeviceStream& stream)
{
  Copy(device, host, bytes, device, stream);
}

}
