// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTMEMORY_H
#define DELAUNAYFLIP_HOSTMEMORY_H

#include "Array.h"
#include "SystemMemory.h"

#include <cstddef>
#include <vector>

namespace delaunayflip
{

/// Memory of this process. On Linux, allocations of 16 MiB and more use huge pages, because
/// otherwise almost every scattered access to gigabytes misses the TLB; when freed, they are
/// returned to the system. Thread-safe.
class HostMemory : public Memory
{
public:
  void* Allocate(std::size_t bytes) override { return AllocateFromSystem(bytes); }
  void Free(void* memory, std::size_t bytes) noexcept override { FreeToSystem(memory, bytes); }
};

template <typename T>
struct HostAllocator
{
  using value_type = T;

  HostAllocator() = default;
  template <typename Other>
  explicit HostAllocator(const HostAllocator<Other>&)
  {
  }

  T* allocate(std::size_t count)
  {
    return static_cast<T*>(HostMemory().Allocate(count * sizeof(T)));
  }
  void deallocate(T* values, std::size_t count) noexcept
  {
    HostMemory().Free(values, count * sizeof(T));
  }

  bool operator==(const HostAllocator&) const { return true; }
  bool operator!=(const HostAllocator&) const { return false; }
};

/// A vector in HostMemory, which takes huge pages if it is large.
template <typename T>
using HostVector = std::vector<T, HostAllocator<T>>;

}

#endif
