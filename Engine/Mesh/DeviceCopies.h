// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICECOPIES_H
#define DELAUNAYFLIP_DEVICECOPIES_H

#include "DeviceMesh.h"

#include <cstdint>
#include <vector>

/// @file
/// The caller's device memory as code without CUDA sees it. The CUDA backend implements these
/// functions; each may throw BackendUnavailable.

namespace delaunayflip
{

/// CUDA's number of the GPU that has this memory; -1 if none has.
int FindDeviceOf(const void* memory);

/// Copies after all that is in the caller's stream, and waits.
void CopyFromDevice(const void* device, std::int64_t bytes, void* host, const DeviceStream& stream);
void CopyToDevice(const void* host, std::int64_t bytes, void* device, const DeviceStream& stream);

/// Calls store(values), which sets `size` values in the host's memory, and copies them to a device.
template <typename T, typename Store>
void StoreThroughHost(T* device, std::int64_t size, const DeviceStream& stream, const Store& store)
{
  std::vector<T> values(size);
  store(values.data());
  if (size > 0)
  {
    CopyToDevice(values.data(), size * static_cast<std::int64_t>(sizeof(T)), device, stream);
  }
}

}

#endif
