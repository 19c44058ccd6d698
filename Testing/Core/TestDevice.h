// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TESTDEVICE_H
#define DELAUNAYFLIP_TESTDEVICE_H

#include "Array.h"
#include "DeviceMesh.h"
#include "TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// Device memory for tests: that of a GPU, or of FakeDevice.cpp, where there need not be one.

namespace delaunayflip
{

bool HasTestDevice();
void* AllocateOnTestDevice(std::size_t bytes);
void FreeOnTestDevice(void* memory);

/// Values in device memory.
template <typename T>
class DeviceValues
{
public:
  explicit DeviceValues(const std::vector<T>& values)
    : Memory(static_cast<T*>(AllocateOnTestDevice(values.size() * sizeof(T) + 1))),
      Count(static_cast<std::int64_t>(values.size()))
  {
    this->Set(values);
  }
  ~DeviceValues() { FreeOnTestDevice(this->Memory); }
  DeviceValues(const DeviceValues&) = delete;
  DeviceValues& operator=(const DeviceValues&) = delete;

  T* Data() const { return this->Memory; }
  std::int64_t Size() const { return this->Count; }

  void Set(const std::vector<T>& values) const
  {
    CopyMemory(values.data(), this->CountBytes(), this->Memory, {});
  }
  std::vector<T> Get() const
  {
    std::vector<T> values(this->Count);
    CopyMemory(this->Memory, this->CountBytes(), values.data(), {});
    return values;
  }

private:
  std::int64_t CountBytes() const { return this->Count * static_cast<std::int64_t>(sizeof(T)); }

  T* Memory;
  std::int64_t Count;
};

/// A mesh in device memory, and room for a result.
template <typename Real, typename Id>
class DeviceArrays
{
public:
  DeviceArrays(const TriangleMesh& mesh, int components)
    : Fixed(mesh),
      Components(components),
      Points(ListPoints(mesh.Points, components)),
      Triangles(ListIds(mesh.Triangles)),
      Result(std::vector<Id>(3 * mesh.Triangles.Count, 77)),
      FlipCounts(std::vector<std::int32_t>(mesh.Triangles.Count, 77))
  {
  }

  DeviceMesh View() const
  {
    DeviceMesh mesh;
    static_cast<FixedEdges&>(mesh) = this->Fixed;
    mesh.Points = DevicePointArray(
      this->Points.Data(), this->Points.Size() / this->Components, this->Components);
    mesh.Triangles = TriangleArray(this->Triangles.Data(), this->FlipCounts.Size());
    return mesh;
  }

  MutableTriangleArray ViewResult() const
  {
    return MutableTriangleArray(this->Result.Data(), this->FlipCounts.Size());
  }
  MutableTriangleArray ViewInput() const
  {
    return MutableTriangleArray(this->Triangles.Data(), this->FlipCounts.Size());
  }

  static std::vector<Id> ListIds(const TriangleArray& triangles)
  {
    std::vector<Id> ids;
    for (std::int64_t i = 0; i < 3 * triangles.Count; ++i)
    {
      ids.push_back(static_cast<Id>(triangles.Get(i / 3, static_cast<int>(i % 3))));
    }
    return ids;
  }

  static std::vector<Real> ListPoints(const PointArray& points, int components)
  {
    std::vector<Real> coordinates;
    for (std::int64_t i = 0; i < components * points.Count; ++i)
    {
      const double x = points.Get(i / components, static_cast<int>(i % components));
      coordinates.push_back(static_cast<Real>(x));
    }
    return coordinates;
  }

private:
  FixedEdges Fixed;
  int Components;

public:
  DeviceValues<Real> Points;
  DeviceValues<Id> Triangles;
  DeviceValues<Id> Result;
  DeviceValues<std::int32_t> FlipCounts;
};

}

#endif
