// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTDEVICE_H
#define DELAUNAYFLIP_HOSTDEVICE_H

/// @file
/// Macros that let both backends compile the same functions. Such functions use only + - * /, sqrt
/// and the exact scalbn and ilogb, and the compiler must not fuse these.

#if defined(__CUDACC__)
#define DELAUNAYFLIP_HOST_DEVICE __host__ __device__
#else
#define DELAUNAYFLIP_HOST_DEVICE
#endif

/// For small functions in the hottest loops that return a struct: a call would store the struct
/// word by word and load it as vectors, which stalls, since store buffers cannot forward that.
#define DELAUNAYFLIP_ALWAYS_INLINE inline __attribute__((always_inline))

/// For large functions that are called seldom and would bloat every kernel that calls them.
#if defined(__CUDACC__)
#define DELAUNAYFLIP_NO_INLINE __noinline__
#else
#define DELAUNAYFLIP_NO_INLINE __attribute__((noinline))
#endif

#if defined(__CUDA_ARCH__)
#define DELAUNAYFLIP_ON_DEVICE 1
#else
#define DELAUNAYFLIP_ON_DEVICE 0
#endif

namespace delaunayflip
{

/// Prefetches the cache line of `address` into the second-level cache, which allows more
/// outstanding requests than the first. Has no effect on results.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void Prefetch(const void* address)
{
#if !DELAUNAYFLIP_ON_DEVICE
  __builtin_prefetch(address, 0, 2);
  // Without this, the compiler removes calls of functions that only prefetch, because they have
  // no effect.
  __asm__ volatile("");
#else
  (void)address;
#endif
}

}

#endif
