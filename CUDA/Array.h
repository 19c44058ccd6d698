// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ARRAY_H
#define DELAUNAYFLIP_ARRAY_H

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

namespace delaunayflip
{

/// Memory for `bytes` bytes, never null. Large blocks come from the system and go back to it when
/// freed (a heap would keep them, and builds need much for a short while), and ask for huge pages,
/// because scattered accesses to gigabytes otherwise miss the TLB every time.
/// @throws std::bad_alloc.
void* AllocateMemory(std::size_t bytes);

/// @param bytes as it was allocated.
void FreeMemory(void* memory, std::size_t bytes) noexcept;

/// A block of uninitialised values of a trivial type, owned; moved, never copied.
template <typename T>
class Array
{
public:
  Array() = default;
  explicit Array(std::size_t size)
    : Values(static_cast<T*>(AllocateMemory(size * sizeof(T)))),
      Count(size)
  {
  }
  Array(Array&& other) noexcept { this->Swap(other); }
  Array& operator=(Array&& other) noexcept
  {
    Array moved(std::move(other));
    this->Swap(moved);
    return *this;
  }
  ~Array() { FreeMemory(this->Values, this->Count * sizeof(T)); }

  T* Data() { return this->Values; }
  const T* Data() const { return this->Values; }
  std::size_t Size() const { return this->Count; }
  T& operator[](std::size_t i) { return this->Values[i]; }
  const T& operator[](std::size_t i) const { return this->Values[i]; }

private:
  void Swap(Array& other) noexcept
  {
    std::swap(this->Values, other.Values);
    std::swap(this->Count, other.Count);
  }

  T* Values = nullptr;
  std::size_t Count = 0;
};

}

#endif
