// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTMEMORY_H
#define DELAUNAYFLIP_HOSTMEMORY_H

#include "Array.h"

#include <cstddef>
#include <mutex>

namespace delaunayflip
{

/// Memory of this process. Large blocks are of huge pages, because scattered accesses to gigabytes
/// otherwise miss the TLB every time. Their pages go from one block to the next by being mapped
/// anew, in any number, and back to the system with the memory itself: to touch a fresh page costs
/// as much as a pass over it, and on a virtual machine many times as much. May be used by several
/// threads.
class HostMemory : public Memory
{
public:
  HostMemory() = default;
  ~HostMemory() override;
  HostMemory(const HostMemory&) = delete;
  HostMemory& operator=(const HostMemory&) = delete;

  void* Allocate(std::size_t bytes) override;
  void Free(void* memory, std::size_t bytes) noexcept override;

private:
  /// Pages that no block has, described in the first of them.
  struct SpareSpan
  {
    SpareSpan* Next;
    std::size_t Bytes;
  };

  std::size_t MoveSpare(char* target, std::size_t bytes);

  std::mutex Mutex; ///< Of Spare.
  SpareSpan* Spare = nullptr;
};

}

#endif
