// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LOADEDSPHERE_H
#define DELAUNAYFLIP_LOADEDSPHERE_H

#include "FlipOptions.h"
#include "LoadedMesh.h"
#include "PointTriangulation.h"
#include "SphereDeviceAsker.h"
#include "SpherePasses.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>

namespace delaunayflip
{

/// Points on a sphere in the memory of a device, and the start of their triangulation
/// (SphereStart.h). SphereOnBackend.h makes one. Every call may throw BackendUnavailable.
class LoadedSphere
{
public:
  virtual ~LoadedSphere() = default;

  /// See LoadedMesh.
  virtual std::unique_ptr<DeviceScope> MakeCurrent() const = 0;

  /// Whether filters may be used for all points.
  virtual bool AreUsual() const = 0;
  /// Finds four points that span a large volume, or none.
  virtual Simplex FindSimplex() const = 0;

  /// Projects all points but one from that one, the pole. @returns their places in the plane, in
  /// the memory of the device, by PlaneNumbers. @param unplaced receives how many of them are NaN.
  virtual PlaneArray Project(const NumberedPoint& pole, std::int64_t& unplaced) = 0;

  /// The memory for the triangles in the plane and their neighbours.
  virtual std::int32_t* GetTriangles() = 0;
  virtual std::int32_t* GetNeighbors() = 0;
  /// Closes the mesh that these triangles make with triangles to the pole. Numbers in the plane
  /// become ids.
  /// @param inPlane how many triangles there are.
  virtual void JoinPole(std::int64_t inPlane, std::int32_t pole) = 0;
  /// How many triangles the closed mesh has.
  virtual std::int64_t CountTriangles() const = 0;

  /// Tests all triangles and edges.
  /// @param center triangles should face away from it.
  virtual StartSums TestStart(const PlanePoint& center) const = 0;

  /// Copies to the host.
  virtual void Fetch(
    PlanePoint* points, std::int32_t* triangles, std::int32_t* neighbors) const = 0;

  /// Store into arrays of the caller's. @returns false, and write nothing, if they are not in the
  /// memory of the device.
  virtual bool StoreTriangles(
    const MutableTriangleArray& triangles, const DeviceStream& stream) = 0;
  virtual bool StoreNeighbors(std::int32_t* neighbors, const DeviceStream& stream) = 0;
};

/// @throws BackendUnavailable as LoadOnCuda.
std::unique_ptr<LoadedSphere> LoadSphereOnCuda(
  const PointInput& points, const FlipOptions& options);

/// Copies what is asked to a GPU.
/// @param asked in the host's memory. @param points their number.
/// @throws BackendUnavailable as LoadOnCuda.
std::unique_ptr<SphereDeviceAsker> LoadAskerOnCuda(
  const AskedSphere& asked, std::int64_t points, const FlipOptions& options);

}

#endif
