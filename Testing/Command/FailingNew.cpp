// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>

/// @file
/// A library to preload. In child processes it makes one allocation by `new` fail: the one whose
/// number is in the environment variable FAILING_NEW.

namespace
{

const pid_t firstProcess = getpid();
std::atomic<long> left{ std::getenv("FAILING_NEW") ? std::atol(std::getenv("FAILING_NEW")) : 0 };

}

void* operator new(std::size_t bytes)
{
  const bool fails = firstProcess != 0 && getpid() != firstProcess && --left == 0;
  void* const memory = fails ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }

void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
