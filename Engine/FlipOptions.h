// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPOPTIONS_H
#define DELAUNAYFLIP_FLIPOPTIONS_H

#include <cstdint>
#include <tuple>

/// @file
/// What a caller may choose. The defaults are right for any triangle mesh.

namespace delaunayflip
{

/// In which space edges are judged.
enum class GeometryKind
{
  /// Planar when all used points lie in one plane (within 1e-6 of the bounding box's diagonal).
  /// Else PlanarXY when the mesh is a height field over x and y, and either z extends further than
  /// both of them (mixed units) or 95 % of the area in space slopes below 45 degrees: the
  /// planes of triangles or, of slivers, their edges. A height field: all triangles but at most one
  /// in 1,000 have area in x and y and turn the same way, and around no point they turn more than
  /// once. Else Surface. FlipReport::GeometryReason says why.
  Auto,
  Planar, ///< In the plane of the points, whatever its orientation; an error if there is none.
  PlanarXY, ///< By x and y; z rides along (terrain).
  Surface ///< In space, by opposite-angle sums.
};

/// How an edge is judged.
enum class CriterionKind
{
  InCircle, ///< The exact in-circle predicate. Planar geometry only; surfaces ignore it.
  OppositeAngles ///< The paper's eq. 5: opposite-angle sum > pi + Tolerance. Surfaces always use
                 ///< it.
};

/// What happens to an edge whose four points lie on one circle exactly.
enum class TieRuleKind
{
  Keep, ///< It stays: a Delaunay mesh comes back bit-identical.
  Canonical ///< The result no longer depends on the input's triangles (planar, in-circle).
};

/// Where the flips run.
enum class BackendKind
{
  Auto, ///< CUDA from SmallestMeshForCuda triangles (CudaDevice.h) on where there is a GPU, else
        ///< Threads. Where the GPU fails, Threads do the work.
  CUDA, ///< A GPU; BackendUnavailable if there is none or it fails.
  Threads ///< Threads of the CPU.
};

struct FlipOptions
{
  GeometryKind Geometry = GeometryKind::Auto;
  CriterionKind Criterion = CriterionKind::InCircle;
  TieRuleKind TieRule = TieRuleKind::Keep;
  BackendKind Backend = BackendKind::Auto;

  /// The paper's epsilon: by how many radians an opposite-angle sum must exceed pi, >= 0 and < 1.
  /// -1: automatic. Each edge has its own then: what a unit in the last place of the coordinates of
  /// its four points, as float or double, can do to its sum. So a surface that is Delaunay within
  /// the precision of its points comes back bit-identical. Used by OppositeAngles only.
  double Tolerance = -1.0;

  /// Surfaces: an edge whose two triangles' normals differ by more than this many degrees
  /// (0 .. 180) in the input stays; 180 fixes none.
  double FeatureAngle = 30.0;

  /// -1: until no edge can flip. 0: none. n > 0: at most n. On surfaces, where no theorem ends the
  /// loop in floating point, -1 means the number of triangles + 1000.
  std::int64_t MaximumIterations = -1;

  /// Threads to use; 0: as many as the machine has. At most twice as many are used, or 16 if that
  /// is more, and fewer if the system cannot start so many. The result does not depend on it.
  int NumberOfThreads = 0;

  /// CUDA's number of the GPU to use; -1: the one that is current in the calling thread.
  int Device = -1;

  /// Compute the smallest angle after every iteration (a pass over the mesh each time).
  bool TrackQuality = false;
};

inline bool operator==(const FlipOptions& a, const FlipOptions& b)
{
  const auto tie = [](const FlipOptions& o)
  {
    return std::tie(o.Geometry, o.Criterion, o.TieRule, o.Backend, o.Tolerance, o.FeatureAngle,
      o.MaximumIterations, o.NumberOfThreads, o.Device, o.TrackQuality);
  };
  return tie(a) == tie(b);
}

}

#endif
