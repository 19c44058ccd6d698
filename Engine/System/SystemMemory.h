// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SYSTEMMEMORY_H
#define DELAUNAYFLIP_SYSTEMMEMORY_H

#include <cstddef>

/// @file
/// What the engine asks of the operating system beyond the C++ library. One file beside this one
/// answers for each system: Linux.cpp, Windows.cpp, and Posix.cpp for macOS and others.

namespace delaunayflip
{

/// Every allocation begins at a multiple of this.
constexpr std::size_t CacheLine = 64;

/// @returns `bytes` bytes, at least one. @throws std::bad_alloc.
void* AllocateFromSystem(std::size_t bytes);

/// Frees what AllocateFromSystem returned for `bytes`.
void FreeToSystem(void* memory, std::size_t bytes) noexcept;

}

#endif
