// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTDEVICE_H
#define DELAUNAYFLIP_HOSTDEVICE_H

/// @file
/// Macros that let both backends compile the same functions. Such functions use + - * / and sqrt
/// only, and the compiler must not fuse these.

#if defined(__CUDACC__)
#define DELAUNAYFLIP_HOST_DEVICE __host__ __device__
#else
#define DELAUNAYFLIP_HOST_DEVICE
#endif

/// For small functions that return a struct in the hottest loops: a call would store the struct in
/// words and load it in vectors, which no processor forwards from its store buffer.
#if defined(__GNUC__)
#define DELAUNAYFLIP_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define DELAUNAYFLIP_ALWAYS_INLINE inline
#endif

/// For large functions that are called seldom, which would bloat every kernel that calls them.
#if defined(__CUDACC__)
#define DELAUNAYFLIP_NO_INLINE __noinline__
#elif defined(__GNUC__)
#define DELAUNAYFLIP_NO_INLINE __attribute__((noinline))
#else
#define DELAUNAYFLIP_NO_INLINE
#endif

#if defined(__CUDA_ARCH__)
#define DELAUNAYFLIP_ON_DEVICE 1
#else
#define DELAUNAYFLIP_ON_DEVICE 0
#endif

namespace delaunayflip
{

/// Prefetches the cache line of `address` into the second-level cache, which allows more requests
/// in flight than the first. Without effect on results.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void Prefetch(const void* address)
{
#if defined(__GNUC__) && !DELAUNAYFLIP_ON_DEVICE
  __builtin_prefetch(address, 0, 2);
  // Without this, the compiler drops calls of functions that only prefetch, as calls without
  // effect.
  __asm__ volatile("");
#else
  (void)address;
#endif
}

}

#endif
