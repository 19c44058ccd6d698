// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaSupport.h"
#include "SystemMemory.h"

#include <malloc.h>
#include <new>

namespace delaunayflip
{

void* AllocateFromSystem(std::size_t bytes)
{
  void* memory = _aligned_malloc(bytes > 0 ? bytes : 1, CacheLine);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void FreeToSystem(void* memory, std::size_t) noexcept { _aligned_free(memory); }

const char* ExplainNoCuda() { return " (built without CUDA for this platform)"; }

}
