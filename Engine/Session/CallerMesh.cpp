// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CallerMesh.h"

#include "Array.h"
#include "FlipError.h"

#include <algorithm>
#include <string>
#include <vector>

namespace delaunayflip
{

namespace
{
template <typename T>
std::vector<T> CopyToHost(const T* values, std::int64_t size, const DeviceStream& stream)
{
  std::vector<T> copy(size);
  if (size > 0)
  {
    CopyFromDevice(values, size * static_cast<std::int64_t>(sizeof(T)), copy.data(), stream);
  }
  return copy;
}

/// Three coordinates for each of `count` points; those of a plane get z = 0.
template <typename T>
std::vector<T> CopyPoints(const T* values, const DevicePointArray& points, DeviceStream stream)
{
  std::vector<T> copy = CopyToHost(values, points.Components * points.Count, stream);
  if (points.Components == 3)
  {
    return copy;
  }
  std::vector<T> wide(3 * points.Count);
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    wide[3 * i] = copy[2 * i];
    wide[3 * i + 1] = copy[2 * i + 1];
  }
  return wide;
}

int RequireDevice(const void* memory, const char* what)
{
  const int device = FindDeviceOf(memory);
  if (device < 0)
  {
    throw InvalidOptions(std::string(what) +
      " not in the memory of a GPU; arrays in the host's "
      "memory are flipped on a GPU by the functions for these");
  }
  return device;
}

void RequireComponents(const DevicePointArray& points)
{
  if (points.Components != 2 && points.Components != 3)
  {
    throw InvalidOptions(
      "points must have 2 or 3 components, not " + std::to_string(points.Components));
  }
}
}

struct CallerMesh::Copies
{
  std::vector<float> Floats;
  std::vector<double> Doubles;
  std::vector<std::int32_t> Ids32;
  std::vector<std::int64_t> Ids64;
  std::optional<TriangleMesh> View; ///< Of these; none before they are made.

  void Make(const DeviceMesh& mesh)
  {
    TriangleMesh view;
    static_cast<FixedEdges&>(view) = mesh;
    if (mesh.Points.Floats)
    {
      this->Floats = CopyPoints(mesh.Points.Floats, mesh.Points, mesh.Stream);
      view.Points = PointArray(this->Floats.data(), mesh.Points.Count);
    }
    else
    {
      this->Doubles = CopyPoints(mesh.Points.Doubles, mesh.Points, mesh.Stream);
      view.Points = PointArray(this->Doubles.data(), mesh.Points.Count);
    }
    const std::int64_t triangles = mesh.Triangles.Count;
    if (mesh.Triangles.Ids32)
    {
      this->Ids32 = CopyToHost(mesh.Triangles.Ids32, 3 * triangles, mesh.Stream);
      view.Triangles = TriangleArray(this->Ids32.data(), triangles);
    }
    else
    {
      this->Ids64 = CopyToHost(mesh.Triangles.Ids64, 3 * triangles, mesh.Stream);
      view.Triangles = TriangleArray(this->Ids64.data(), triangles);
    }
    this->View = view;
  }
};

CallerMesh::CallerMesh(const TriangleMesh& mesh)
  : Host(mesh)
{
}

CallerMesh::CallerMesh(const DeviceMesh& mesh)
  : Device(mesh),
    Copied(std::make_shared<Copies>())
{
  RequireComponents(mesh.Points);
  static_cast<FixedEdges&>(this->Host) = mesh;
  this->Host.Points.Count = mesh.Points.Count;
  this->Host.Triangles.Count = mesh.Triangles.Count;
}

bool CallerMesh::HasConstraintsToInsert() const
{
  const unsigned char* flags = this->Host.ConstraintsToInsert;
  return flags &&
    std::any_of(flags, flags + this->Host.NumberOfConstraintEdges,
      [](unsigned char flag) { return flag != 0; });
}

const TriangleMesh& CallerMesh::GetOnHost()
{
  if (!this->Device)
  {
    return this->Host;
  }
  if (!this->Copied->View)
  {
    this->Copied->Make(*this->Device);
  }
  return *this->Copied->View;
}

int CallerMesh::ChooseDevice(int requested) const
{
  int chosen = requested;
  const auto join = [&](const void* memory, std::int64_t size, const char* what)
  {
    const int device = size > 0 ? RequireDevice(memory, what) : chosen;
    if (chosen >= 0 && device != chosen)
    {
      throw InvalidOptions(std::string(what) + " in the memory of GPU " + std::to_string(device) +
        ", but GPU " + std::to_string(chosen) + " has other arrays of the mesh or was requested");
    }
    chosen = device;
  };
  if (this->Device)
  {
    const TriangleArray& triangles = this->Device->Triangles;
    join(this->Device->Points.Data(), this->Device->Points.Count, "the points are");
    join(triangles.Data(), triangles.Count, "the triangles are");
  }
  return chosen;
}

void RequireOnDevice(const MutableTriangleArray& triangles)
{
  if (triangles.Count > 0)
  {
    RequireDevice(triangles.Data(), "the array for triangles is");
  }
}

void RequireOnDevice(const std::int32_t* values, std::int64_t count)
{
  if (count > 0)
  {
    RequireDevice(values, "the array for flip counts is");
  }
}

}
