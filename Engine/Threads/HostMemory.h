// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTMEMORY_H
#define DELAUNAYFLIP_HOSTMEMORY_H

#include "Array.h"

#include <cstddef>

namespace delaunayflip
{

/// Memory of this process. Large allocations use huge pages, because otherwise almost every
/// scattered access to gigabytes misses the TLB; when freed, they are returned to the system.
/// Thread-safe.
class HostMemory : public Memory
{
public:
  void* Allocate(std::size_t bytes) override;
  /// Memory of which little will be used, and only that is taken from the system. Its bytes are
  /// not initialized.
  void* AllocateSparse(std::size_t bytes);
  void Free(void* memory, std::size_t bytes) noexcept override;
};

}

#endif
