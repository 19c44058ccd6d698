// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CALLERMESH_H
#define DELAUNAYFLIP_CALLERMESH_H

#include "DeviceMesh.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace delaunayflip
{

/// The caller's mesh, in the host's memory or in a device's.
class CallerMesh
{
public:
  explicit CallerMesh(const TriangleMesh& mesh)
    : Host(mesh)
  {
  }
  explicit CallerMesh(const DeviceMesh& mesh);

  std::int64_t CountPoints() const { return this->Host.Points.Count; }
  std::int64_t CountTriangles() const { return this->Host.Triangles.Count; }

  const FixedEdges& GetFixedEdges() const { return this->Host; }

  /// Whether this array in the host's memory is that of the triangles.
  bool IsTriangleArray(const void* ids) const { return ids && ids == this->Host.Triangles.Data(); }

  /// The arrays in device memory; null if they are in the host's.
  const DeviceMesh* GetOnDevice() const { return this->Device ? &*this->Device : nullptr; }

  /// The arrays in the host's memory, unless they are in a device's.
  const TriangleMesh& GetOnHost() const { return this->Host; }

  /// The arrays in the host's memory. They are copied from a device in the first call; the copies
  /// belong to this object and to those copied from it later.
  /// @throws BackendUnavailable.
  const TriangleMesh& CopyToHost();

  /// The GPU to use for arrays in device memory: `requested`, or if that is -1 the one that has
  /// them.
  /// @throws InvalidOptions if another GPU, or none, has them.
  int ChooseDevice(int requested) const;

private:
  TriangleMesh Host; ///< Without points and triangles, except counts, until they are copied.
  std::optional<DeviceMesh> Device;
  std::vector<std::shared_ptr<const void>> Copies; ///< Copies of the arrays of a device.
};

/// @param what the array, for the message, e.g. "the points are".
/// @returns CUDA's number of the GPU that has an array, or -1 if the array is empty.
/// @throws InvalidOptions if no GPU has it.
int RequireOnDevice(const void* memory, std::int64_t size, const char* what);

/// The GPU for a run: `chosen`, or if that is -1 the one that has this array; -1 if neither is
/// known. @throws InvalidOptions if another GPU, or none, has the array.
int JoinDevice(int chosen, const void* memory, std::int64_t size, const char* what);

}

#endif
