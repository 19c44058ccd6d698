// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HOSTDEVICE_H
#define DELAUNAYFLIP_HOSTDEVICE_H

#include <cstddef>
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

/// For large functions that are called seldom: inlined, they would swell every kernel
/// around them, once for each call.
#if defined(__CUDACC__)
#define DELAUNAYFLIP_NO_INLINE __noinline__
#elif defined(__GNUC__)
#define DELAUNAYFLIP_NO_INLINE __attribute__((noinline))
#else
#define DELAUNAYFLIP_NO_INLINE
#endif

namespace delaunayflip
{

/// Relaxed atomics on words of 4 and 8 bytes, loads and stores also on bytes: phases end with a
/// barrier, so nothing inside one needs an order. Where the CPU takes a word of any type, a device
/// wants its own names for the unsigned ones.
#if defined(__CUDA_ARCH__)
#define DELAUNAYFLIP_ON_DEVICE 1
template <std::size_t Size>
struct DeviceWord;
template <>
struct DeviceWord<4>
{
  using Type = unsigned int;
};
template <>
struct DeviceWord<8>
{
  using Type = unsigned long long;
};
template <typename T>
using DeviceWordOf = typename DeviceWord<sizeof(T)>::Type;
#else
#define DELAUNAYFLIP_ON_DEVICE 0
#endif

template <typename T>
DELAUNAYFLIP_HOST_DEVICE inline T AtomicLoad(const T* address)
{
#if DELAUNAYFLIP_ON_DEVICE
  return *const_cast<const volatile T*>(address);
#else
  T value;
  __atomic_load(address, &value, __ATOMIC_RELAXED);
  return value;
#endif
}

template <typename T>
DELAUNAYFLIP_HOST_DEVICE inline void AtomicStore(T* address, T value)
{
#if DELAUNAYFLIP_ON_DEVICE
  *const_cast<volatile T*>(address) = value;
#else
  __atomic_store(address, &value, __ATOMIC_RELAXED);
#endif
}

/// Stores `desired` where *address equals `expected`. @returns what was there before.
template <typename T>
DELAUNAYFLIP_HOST_DEVICE inline T AtomicCompareExchange(T* address, T expected, T desired)
{
#if DELAUNAYFLIP_ON_DEVICE
  using Word = DeviceWordOf<T>;
  return atomicCAS(
    reinterpret_cast<Word*>(address), static_cast<Word>(expected), static_cast<Word>(desired));
#else
  __atomic_compare_exchange(
    address, &expected, &desired, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// @returns what was there before.
template <typename T>
DELAUNAYFLIP_HOST_DEVICE inline T AtomicExchange(T* address, T value)
{
#if DELAUNAYFLIP_ON_DEVICE
  using Word = DeviceWordOf<T>;
  return atomicExch(reinterpret_cast<Word*>(address), static_cast<Word>(value));
#else
  return __atomic_exchange_n(address, value, __ATOMIC_RELAXED);
#endif
}

/// @returns what was there before.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t AtomicAdd(std::uint32_t* address, std::uint32_t value)
{
#if DELAUNAYFLIP_ON_DEVICE
  return atomicAdd(address, value);
#else
  return __atomic_fetch_add(address, value, __ATOMIC_RELAXED);
#endif
}

/// Sets bits. Nobody asks what was there: a device sends it off and goes on.
DELAUNAYFLIP_HOST_DEVICE inline void AtomicSet(std::uint32_t* address, std::uint32_t bits)
{
#if DELAUNAYFLIP_ON_DEVICE
  // Where much surrounds it, the compiler leaves an atomicOr that waits for what was there.
  asm volatile("red.relaxed.gpu.global.or.b32 [%0], %1;"
               :
               : "l"(__cvta_generic_to_global(address)), "r"(bits)
               : "memory");
#else
  __atomic_fetch_or(address, bits, __ATOMIC_RELAXED);
#endif
}

/// Clears all bits but these.
DELAUNAYFLIP_HOST_DEVICE inline void AtomicAnd(std::uint32_t* address, std::uint32_t bits)
{
#if DELAUNAYFLIP_ON_DEVICE
  asm volatile("red.relaxed.gpu.global.and.b32 [%0], %1;"
               :
               : "l"(__cvta_generic_to_global(address)), "r"(bits)
               : "memory");
#else
  __atomic_fetch_and(address, bits, __ATOMIC_RELAXED);
#endif
}

template <typename T>
DELAUNAYFLIP_HOST_DEVICE inline void AtomicMin(T* address, T value)
{
#if DELAUNAYFLIP_ON_DEVICE
  using Word = DeviceWordOf<T>;
  atomicMin(reinterpret_cast<Word*>(address), static_cast<Word>(value));
#else
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
#endif
}

/// Asks for the cache line of `address`; a hint without effect on results. Into the second-level
/// cache: more requests may be on their way to it than to the first.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void Prefetch(const void* address)
{
#if defined(__GNUC__) && !DELAUNAYFLIP_ON_DEVICE
  __builtin_prefetch(address, 0, 2);
  // Calls of a function that does nothing but prefetch would be dropped as calls without effect.
  __asm__ volatile("");
#else
  (void)address;
#endif
}

}

#endif
