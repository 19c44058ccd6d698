// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaSupport.h"
#include "SystemMemory.h"

#include <cstdlib>
#include <new>

namespace delaunayflip
{

void* AllocateFromSystem(std::size_t bytes)
{
  void* memory = nullptr;
  if (posix_memalign(&memory, CacheLine, bytes > 0 ? bytes : 1) != 0)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void FreeToSystem(void* memory, std::size_t) noexcept { std::free(memory); }

const char* ExplainNoCuda() { return " (built without CUDA for this platform)"; }

}
