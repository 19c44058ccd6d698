// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ARRAY_H
#define DELAUNAYFLIP_ARRAY_H

#include "DeviceMesh.h"
#include "HostDevice.h"
#include "TriangleMesh.h"

#include <cstddef>
#include <cstdint>
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

/// The size of a container, as ids count.
template <typename Container>
std::int64_t SizeOf(const Container& items)
{
  return static_cast<std::int64_t>(items.size());
}

//------------------------------------------------------------------------------
// Where a backend writes results: the caller's whole array, or one slice of it at a time, to save
// device memory.

/// Values [First, Last) of an output of 32-bit numbers, in a separate array.
struct OutputSlice
{
  std::uint32_t* Values;
  std::int64_t First, Last;

  /// Sets value i if it is in the slice.
  DELAUNAYFLIP_HOST_DEVICE void Set(std::int64_t i, std::uint32_t value) const
  {
    if (i >= this->First && i < this->Last)
    {
      this->Values[i - this->First] = value;
    }
  }
};

/// A slice of vertex ids, three per triangle.
struct IdSlice
{
  OutputSlice Ids;

  DELAUNAYFLIP_HOST_DEVICE void Set(std::int64_t triangle, int slot, std::int64_t vertex) const
  {
    this->Ids.Set(3 * triangle + slot, static_cast<std::uint32_t>(vertex));
  }
};

/// Whether a target includes some id of a triangle.
DELAUNAYFLIP_HOST_DEVICE inline bool HasTriangle(const IdSlice& slice, std::int64_t triangle)
{
  return 3 * triangle + 2 >= slice.Ids.First && 3 * triangle < slice.Ids.Last;
}
DELAUNAYFLIP_HOST_DEVICE inline bool HasTriangle(const MutableTriangleArray&, std::int64_t)
{
  return true;
}

//------------------------------------------------------------------------------
// The caller's device memory as code without CUDA sees it. The CUDA backend implements these
// functions; each may throw BackendUnavailable.

/// CUDA's number of the GPU that has this memory; -1 if none has.
int FindDeviceOf(const void* memory);

/// Copies to or from a device, after all that is in the caller's stream, and waits.
void CopyMemory(const void* from, std::int64_t bytes, void* to, const DeviceStream& stream);

}

#endif
