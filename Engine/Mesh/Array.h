// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ARRAY_H
#define DELAUNAYFLIP_ARRAY_H

#include <cstddef>
#include <utility>

namespace delaunayflip
{

/// The memory from which arrays are allocated. Arrays must not outlive it.
class Memory
{
public:
  virtual ~Memory() = default;

  /// Memory for `bytes` bytes, never null.
  /// @throws std::bad_alloc.
  virtual void* Allocate(std::size_t bytes) = 0;

  /// @param bytes the number of bytes that were allocated.
  virtual void Free(void* memory, std::size_t bytes) noexcept = 0;
};

/// Uninitialised values of a trivial type, owned; moved, never copied. Only arrays in
/// the host's memory may be indexed on the host.
template <typename T>
class Array
{
public:
  Array() = default;
  Array(std::size_t size, Memory& memory)
    : Values(static_cast<T*>(memory.Allocate(size * sizeof(T)))),
      Count(size),
      Owner(&memory)
  {
  }
  Array(Array&& other) noexcept { this->Swap(other); }
  Array& operator=(Array&& other) noexcept
  {
    Array moved(std::move(other));
    this->Swap(moved);
    return *this;
  }
  ~Array()
  {
    if (this->Owner)
    {
      this->Owner->Free(this->Values, this->Count * sizeof(T));
    }
  }

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
    std::swap(this->Owner, other.Owner);
  }

  T* Values = nullptr;
  std::size_t Count = 0;
  Memory* Owner = nullptr;
};

}

#endif
