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
  if (mesh.Points.Components != 2 && mesh.Points.Components != 3)
  {
    throw InvalidOptions(
      "points must have 2 or 3 components, not " + std::to_string(mesh.Points.Components));
  }
  static_cast<FixedEdges&>(this->Host) = mesh;
  this->Host.Points.Count = mesh.Points.Count;
  this->Host.Triangles.Count = mesh.Triangles.Count;
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

int RequireOnDevice(const void* memory, std::int64_t size, const char* what)
{
  const int device = size > 0 ? FindDeviceOf(memory) : -1;
  if (size > 0 && device < 0)
  {
    throw InvalidOptions(std::string(what) +
      " not in the memory of a GPU; arrays in the host's "
      "memory are flipped on a GPU by the functions for these");
  }
  return device;
}

int CallerMesh::ChooseDevice(int requested) const
{
  int chosen = requested;
  const auto join = [&](const auto& array, const char* what)
  {
    const int device = RequireOnDevice(array.Data(), array.Count, what);
    if (chosen >= 0 && device >= 0 && device != chosen)
    {
      throw InvalidOptions(std::string(what) + " in the memory of GPU " + std::to_string(device) +
        ", but GPU " + std::to_string(chosen) + " has other arrays of the mesh or was requested");
    }
    chosen = std::max(chosen, device);
  };
  if (this->Device)
  {
    join(this->Device->Points, "the points are");
    join(this->Device->Triangles, "the triangles are");
  }
  return chosen;
}

}
