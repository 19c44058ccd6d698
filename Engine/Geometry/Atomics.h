// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ATOMICS_H
#define DELAUNAYFLIP_ATOMICS_H

#include "HostDevice.h"

#include <cstdint>
#include <type_traits>

namespace delaunayflip
{

/// Relaxed atomics on words of 4 and 8 bytes; loads and stores also on bytes. Passes end with a
/// barrier, so no order is needed within a pass. The CPU accepts words of any type; a device has
/// overloads only for some unsigned types.
#if DELAUNAYFLIP_ON_DEVICE
template <typename T>
using DeviceWordOf = std::conditional_t<sizeof(T) == 4, unsigned int, unsigned long long>;
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
  return atomicCAS_system(
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
  return atomicExch_system(reinterpret_cast<Word*>(address), static_cast<Word>(value));
#else
  return __atomic_exchange_n(address, value, __ATOMIC_RELAXED);
#endif
}

/// @returns what was there before.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t AtomicAdd(std::uint32_t* address, std::uint32_t value)
{
#if DELAUNAYFLIP_ON_DEVICE
  return atomicAdd_system(address, value);
#else
  return __atomic_fetch_add(address, value, __ATOMIC_RELAXED);
#endif
}

/// Sets bits. Returns nothing, so that a device does not wait.
DELAUNAYFLIP_HOST_DEVICE inline void AtomicSet(std::uint32_t* address, std::uint32_t bits)
{
#if DELAUNAYFLIP_ON_DEVICE
  // In large kernels the compiler would keep an atomicOr that waits for the old value.
  asm volatile("red.relaxed.sys.global.or.b32 [%0], %1;"
               :
               : "l"(__cvta_generic_to_global(address)), "r"(bits)
               : "memory");
#else
  __atomic_fetch_or(address, bits, __ATOMIC_RELAXED);
#endif
}

/// Clears all bits except these.
DELAUNAYFLIP_HOST_DEVICE inline void AtomicAnd(std::uint32_t* address, std::uint32_t bits)
{
#if DELAUNAYFLIP_ON_DEVICE
  asm volatile("red.relaxed.sys.global.and.b32 [%0], %1;"
               :
               : "l"(__cvta_generic_to_global(address)), "r"(bits)
               : "memory");
#else
  __atomic_fetch_and(address, bits, __ATOMIC_RELAXED);
#endif
}

/// @returns what was there before.
template <typename T>
DELAUNAYFLIP_HOST_DEVICE inline T AtomicMin(T* address, T value)
{
#if DELAUNAYFLIP_ON_DEVICE
  using Word = DeviceWordOf<T>;
  return atomicMin_system(reinterpret_cast<Word*>(address), static_cast<Word>(value));
#else
  T seen = AtomicLoad(address);
  while (value < seen)
  {
    const T before = AtomicCompareExchange(address, seen, value);
    if (before == seen)
    {
      break;
    }
    seen = before;
  }
  return seen;
#endif
}

/// @returns what was there before.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t AtomicMax(std::uint32_t* address, std::uint32_t value)
{
#if DELAUNAYFLIP_ON_DEVICE
  return atomicMax_system(address, value);
#else
  std::uint32_t seen = AtomicLoad(address);
  while (value > seen)
  {
    const std::uint32_t before = AtomicCompareExchange(address, seen, value);
    if (before == seen)
    {
      break;
    }
    seen = before;
  }
  return seen;
#endif
}

}

#endif
