// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEMESH_H
#define DELAUNAYFLIP_DEVICEMESH_H

#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// A DeviceMesh has its arrays in the memory of a GPU, for programs that have them there already
/// and want the result there. FlipSession and FlipToDelaunay (DelaunayFlip.h) accept it. Nothing
/// here owns or copies, and no header of CUDA is needed.
///
///     const auto flip = [](const float* xyz, std::int64_t points, std::int32_t* ids,
///                         std::int64_t triangles)
///     {
///       DeviceMesh mesh;
///       mesh.Points = DevicePointArray(xyz, points);
///       mesh.Triangles = TriangleArray(ids, triangles);
///       return FlipToDelaunay(mesh, {}, MutableTriangleArray(ids, triangles));
///     };

namespace delaunayflip
{

/// A stream of CUDA, by which the engine's work is ordered with the caller's. The work that the
/// caller has put into the stream before a call of the engine is done before the engine reads or
/// writes the caller's arrays. When a call of the engine returns, its results are there for any
/// stream.
struct DeviceStream
{
  void* Handle = nullptr; ///< A cudaStream_t or CUstream; null: the default stream.
};

/// Coordinates of points in device memory: Components * Count numbers, x, y and z (3 components) or
/// x and y (2; z is 0) of each point.
struct DevicePointArray : CoordinateArray
{
  DevicePointArray() = default;
  /// @param coordinates floats or doubles.
  template <typename Real>
  DevicePointArray(const Real* coordinates, std::int64_t count, int components = 3)
    : CoordinateArray(coordinates, count),
      Components(components)
  {
  }

  int Components = 3; ///< 2 or 3.
};

/// A triangle mesh in device memory, and what the caller knows about its edges. The arrays of
/// FixedEdges are in the host's memory.
///
/// The engine reads the mesh where it is. Only in these cases it copies it to the host, and goes on
/// as with arrays there: for BackendKind::Threads, for BackendKind::Auto after the GPU has failed,
/// and if ConstraintsToInsert has a flag that is not zero.
struct DeviceMesh : FixedEdges
{
  DevicePointArray Points;
  TriangleArray Triangles; ///< The ids are in device memory; do not call Get.
  DeviceStream Stream;
};

}

#endif
