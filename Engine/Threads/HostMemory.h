// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTMEMORY_H
#define DELAUNAYFLIP_HOSTMEMORY_H

#include "Array.h"

#include <cstddef>

namespace delaunayflip
{

/// Memory of this process. Large blocks are asked for as huge pages, because scattered accesses to
/// gigabytes otherwise miss the TLB every time, and go back to the system when they are freed. May
/// be used by several threads.
class HostMemory : public Memory
{
public:
  void* Allocate(std::size_t bytes) override;
  void Free(void* memory, std::size_t bytes) noexcept override;
};

}

#endif
