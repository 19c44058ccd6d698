// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CallerMesh.h"

#include "Array.h"
#include "FlipError.h"

#include <algorithm>
#include <string>
#include <type_traits>

namespace delaunayflip
{

CallerMesh::CallerMesh(const DeviceMesh& mesh)
  : Device(mesh)
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

const TriangleMesh& CallerMesh::CopyToHost()
{
  if (!this->Device || !this->Copies.empty())
  {
    return this->Host;
  }
  std::vector<std::shared_ptr<const void>> copies;
  const auto copy = [&](const auto* values, std::int64_t size, std::int64_t room)
  {
    using Value = std::decay_t<decltype(*values)>;
    const auto made = std::make_shared<std::vector<Value>>(room);
    if (size > 0)
    {
      CopyMemory(values, size * static_cast<std::int64_t>(sizeof(Value)), made->data(),
        this->Device->Stream);
    }
    copies.push_back(made);
    return made->data();
  };
  const DevicePointArray& points = this->Device->Points;
  const auto copyPoints = [&](const auto* values) // those of a plane get z = 0
  {
    auto* xyz = copy(values, points.Components * points.Count, 3 * points.Count);
    for (std::int64_t i = points.Components == 2 ? points.Count : 0; i-- > 0;)
    {
      const auto x = xyz[2 * i], y = xyz[2 * i + 1];
      xyz[3 * i] = x;
      xyz[3 * i + 1] = y;
      xyz[3 * i + 2] = 0;
    }
    return PointArray(xyz, points.Count);
  };
  const TriangleArray& triangles = this->Device->Triangles;
  const auto copyTriangles = [&](const auto* ids)
  { return TriangleArray(copy(ids, 3 * triangles.Count, 3 * triangles.Count), triangles.Count); };
  const PointArray made = points.Floats ? copyPoints(points.Floats) : copyPoints(points.Doubles);
  this->Host.Triangles =
    triangles.Ids32 ? copyTriangles(triangles.Ids32) : copyTriangles(triangles.Ids64);
  this->Host.Points = made;
  this->Copies = std::move(copies);
  return this->Host;
}

int RequireOnDevice(const void* memory, std::int64_t size, const char* what)
{
  const int device = size > 0 ? FindDeviceOf(memory) : -1;
  if (size > 0 && device < 0)
  {
    throw InvalidOptions(std::string(what) +
      " not in the memory of a GPU; for arrays in the host's memory use the functions for these");
  }
  return device;
}

int JoinDevice(int chosen, const void* memory, std::int64_t size, const char* what)
{
  const int device = RequireOnDevice(memory, size, what);
  if (chosen >= 0 && device >= 0 && device != chosen)
  {
    throw InvalidOptions(std::string(what) + " in the memory of GPU " + std::to_string(device) +
      ", but GPU " + std::to_string(chosen) + " was requested or has other arrays of the input");
  }
  return std::max(chosen, device);
}

int CallerMesh::ChooseDevice(int requested) const
{
  const DevicePointArray& points = this->Device->Points;
  const auto& triangles = this->Device->Triangles;
  const int chosen = JoinDevice(requested, points.Data(), points.Count, "the points are");
  return JoinDevice(chosen, triangles.Data(), triangles.Count, "the triangles are");
}

}
