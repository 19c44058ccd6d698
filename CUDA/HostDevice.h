// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTDEVICE_H
#define DELAUNAYFLIP_HOSTDEVICE_H

#include <cstdint>

/// @file
/// What lets one text of the algorithm compile for both backends. Such text uses + - * / and sqrt
/// only, and never lets the compiler fuse them.

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

namespace delaunayflip
{

/// Relaxed atomics: phases end with a barrier, so nothing inside one needs an order.
template <typename T>
inline T AtomicLoad(const T* address)
{
  T value;
  __atomic_load(address, &value, __ATOMIC_RELAXED);
  return value;
}

template <typename T>
inline void AtomicStore(T* address, T value)
{
  __atomic_store(address, &value, __ATOMIC_RELAXED);
}

/// Stores `desired` where *address equals `expected`. @returns what was there before.
template <typename T>
inline T AtomicCompareExchange(T* address, T expected, T desired)
{
  __atomic_compare_exchange(
    address, &expected, &desired, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
}

/// @returns what was there before.
template <typename T>
inline T AtomicExchange(T* address, T value)
{
  return __atomic_exchange_n(address, value, __ATOMIC_RELAXED);
}

template <typename T>
inline void AtomicMin(T* address, T value)
{
  T seen = AtomicLoad(address);
  while (value < seen)
  {
    const T before = AtomicCompareExchange(address, seen, value);
    if (before == seen)
    {
      return;
    }
    seen = before;
  }
}

/// Asks for the cache line of `address`; a hint without effect on results.
inline void Prefetch(const void* address)
{
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

}

#endif
