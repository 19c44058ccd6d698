// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPOPTIONS_H
#define DELAUNAYFLIP_FLIPOPTIONS_H

#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

/// @file
/// The options of a run. The defaults suit any triangle mesh. Set a member to change one:
///
///     const double xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
///     std::int32_t ids[] = { 0, 1, 2, 0, 2, 3 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 4);
///     mesh.Triangles = TriangleArray(ids, 2);
///     FlipOptions options;
///     options.Geometry = GeometryKind::Surface;
///     options.FeatureAngle = 60.0;
///     options.MaximumIterations = 0; // tests all edges, and makes no flips
///     const FlipReport report = FlipToDelaunay(mesh, options, MutableTriangleArray(ids, 2));
///     report.NonDelaunayAfter; // 1

namespace delaunayflip
{

/// The space in which edges are judged.
enum class GeometryKind
{
  /// Planar if all used points lie in one plane, within 1e-6 of the bounding box's diagonal. Else
  /// PlanarXY if the mesh is a height field over x and y, and either z extends further than both of
  /// them (mixed units) or 95 % of the area in space slopes less than 45 degrees; the slope is that
  /// of a triangle's plane or, for slivers, of the steepest edge. In a height field all triangles,
  /// except at most one in 1,000, have area in x and y and face the same side, and the triangles
  /// around any point go around it at most once. If z extends more than ten times as far as x and
  /// as y, one in five may have no area, and one in 100 of the others may face the other side, as
  /// where an ocean crosses 180 degrees. Else Surface. FlipReport::GeometryReason says why.
  Auto,
  Planar, ///< In the plane of the points, in any orientation; an error if there is none.
  PlanarXY, ///< By x and y alone, for terrain.
  Surface, ///< In space, by opposite-angle sums.

  /// On a sphere around the origin, which every triangle must face with the same side. An edge is
  /// good if the far corner of one triangle is not beyond the plane of the other. So the mesh
  /// becomes the convex hull of the points, which is their Delaunay triangulation on the sphere.
  /// Signs are exact for the points as given. No flip turns a triangle over, seen from the origin.
  /// An edge that is blocked for this reason ends at a point inside of the hull. Auto never chooses
  /// this geometry.
  Sphere,
  Mixed ///< Several meshes with different ones (AddReport); no option.
};

/// How an edge is judged.
enum class CriterionKind
{
  /// The exact in-circle predicate; on a sphere, the exact orientation of four points in space.
  /// Surfaces ignore this choice.
  InCircle,
  /// The paper's eq. 5: opposite-angle sum > pi + Tolerance. Surfaces always use it. An error on
  /// spheres.
  OppositeAngles
};

/// What happens to an edge if its four points lie exactly on one circle or, on a sphere, in one
/// plane.
enum class TieRuleKind
{
  Keep, ///< It stays: a Delaunay mesh comes back bit-identical.
  /// Planar, in-circle: where nothing overlaps and no edge is left blocked, all triangles with an
  /// area are the same for every triangulation with the same fixed edges. Triangles without area
  /// are left only along fixed edges, cut as the input has them. This is also true on a sphere, if
  /// no point is inside of the hull. An error on surfaces.
  Canonical
};

/// Where the flips run.
enum class BackendKind
{
  /// A GPU if there is one and the mesh has at least SmallestMeshForCuda triangles (CudaDevice.h).
  /// Otherwise, or if the GPU fails, CPU threads.
  Auto,
  CUDA, ///< A GPU; throws BackendUnavailable if there is none or it fails.
  Threads ///< CPU threads.
};

struct FlipOptions
{
  GeometryKind Geometry = GeometryKind::Auto;
  CriterionKind Criterion = CriterionKind::InCircle;
  TieRuleKind TieRule = TieRuleKind::Keep;
  BackendKind Backend = BackendKind::Auto;

  /// The paper's epsilon: how far an opposite-angle sum may exceed pi before the edge is bad, in
  /// radians, at least 0 and below 1. -1 (default) is automatic: each edge has its own tolerance,
  /// the largest change of its sum that one unit in the last place of its points' coordinates
  /// (float or double) can cause. So a surface that is Delaunay within the precision of its points
  /// comes back bit-identical. Used by OppositeAngles only.
  double Tolerance = -1.0;

  /// On surfaces, an edge stays if the normals of its two triangles differ by more than this angle
  /// in the input. In degrees, 0 to 180; 180 fixes no edge.
  double FeatureAngle = 30.0;

  /// On surfaces, an edge stays if its flip would move the surface by more than this length, 0 or
  /// more, in the unit of the points. That is the distance between the edge and the one that would
  /// take its place. It holds for each flip; the moves of many flips can add up. 0 allows a flip
  /// only if its four points lie in one plane. 1e299 or more, such as infinity (default), is no
  /// limit. In planar geometry no flip moves the surface, and this has no effect.
  double MaximumDeviation = std::numeric_limits<double>::infinity();

  /// The most iterations to make: 0 makes none, -1 (default) sets no limit. On surfaces, where with
  /// a fixed tolerance nothing proves that the loop ends, -1 means the number of triangles + 1000.
  /// Rounds of refinement count as iterations.
  std::int64_t MaximumIterations = -1;

  /// The number of threads; 0 (default): as many as the machine has. At most twice as many are
  /// used, or 16 if that is more, and fewer if the system cannot start so many. The result does not
  /// depend on it.
  int NumberOfThreads = 0;

  /// CUDA's number of the GPU to use, 0 or more; -1 (default): the current device of the calling
  /// thread.
  int Device = -1;

  /// CUDA's numbers of GPUs that share the mesh. It may be larger, or flips faster, than on one.
  /// They must be connected by NVLink. Empty (default): Device alone. The result does not depend on
  /// it. A mesh that is given in a GPU's memory stays on that GPU.
  std::vector<int> Devices;

  /// In how many pieces the mesh is flipped, one after the other, so that it may be larger than the
  /// memory of a GPU; 1 to 255, or 0 (default): one, or the fewest that are possible if it has more
  /// than 715 million triangles. Devices, if given, flip pieces in turn instead of sharing the
  /// mesh, and need no NVLink. The triangles around the edges between pieces are flipped at the
  /// end.
  ///
  /// In planar geometry with TieRuleKind::Canonical the triangles with an area do not depend on it.
  /// Otherwise they do, but the backend, the threads and the devices never matter.
  int NumberOfPieces = 0;

  /// Compute the smallest angle after every iteration, by one pass over the mesh each. Default off:
  /// only after the first and the last iteration. No effect on a mesh in several pieces: the
  /// smallest angle is known before the first and after the last iteration.
  bool TrackQuality = false;

  /// @name Refinement
  /// Once no edge is bad, points are added until all triangles reach these goals
  /// (PointTriangulation.h says how). It needs planar geometry and the in-circle criterion; goals
  /// are an error on surfaces, on spheres and for a mesh in several pieces. Boundary edges and all
  /// edges that stay are segments: they are split, but triangles never cross them. Non-manifold and
  /// wrongly wound edges are not split. Frozen triangles, and those that do not face the same side
  /// as most, stay as they are. TriangleMesh::Sizes is a goal, too.
  ///@{

  /// Points are added until no angle is smaller, in degrees from 0 to 33. 0 (default): no limit.
  /// Ruppert (1995) proved that this ends for up to 20.7 degrees if no segments meet at less than
  /// 60 degrees. In practice it ends for up to about 33.
  double MinimumAngle = 0.0;

  /// Points are added until no triangle is larger. 0 (default): no limit.
  double MaximumArea = 0.0;

  /// Points are added until no edge is longer. 0 (default): no limit.
  double MaximumEdge = 0.0;

  /// Whether boundary edges are never split. From points the boundary is the hull, or that of the
  /// triangles that are kept. Angles at the boundary may then be small, and edges there long.
  bool KeepBoundary = false;

  /// The most points that the mesh may have in the end. Refinement stops when there are so many.
  /// From points, those count that are corners of triangles that are kept.
  /// 0 (default): ten times as many as are given, at least a million.
  std::int64_t PointLimit = 0;
  ///@}
};

/// The table of options: entry(name in C, member, whether all ranks that share a mesh must have the
/// same value, the values that are allowed). Within and AtLeast end with the words of an error
/// message. Any: every value is allowed, or InputChecks.cpp checks it elsewhere.
#define DELAUNAYFLIP_OPTIONS(entry)                                                              \
  entry(geometry, Geometry, true, Any);                                                          \
  entry(criterion, Criterion, true, Any);                                                        \
  entry(tie_rule, TieRule, true, Any);                                                           \
  entry(backend, Backend, false, Any);                                                           \
  entry(tolerance, Tolerance, true, Any);                                                        \
  entry(feature_angle, FeatureAngle, true, Within(0, 180, "from 0 to 180 degrees"));             \
  entry(maximum_deviation, MaximumDeviation, true,                                               \
    AtLeast(0, "a length of 0 or more, or infinite (none)"));                                    \
  entry(maximum_iterations, MaximumIterations, true, AtLeast(-1, "-1 (until done), 0 or more")); \
  entry(number_of_threads, NumberOfThreads, false, AtLeast(0, "0 (all) or more"));               \
  entry(device, Device, false, AtLeast(-1, "-1 (CUDA's current one), or the number of a GPU"));  \
  entry(devices, Devices, false, Any);                                                           \
  entry(number_of_pieces, NumberOfPieces, false,                                                 \
    Within(0, MostPieces, "from 1 to 255, or 0 (as few as possible)"));                          \
  entry(track_quality, TrackQuality, true, Any);                                                 \
  entry(minimum_angle, MinimumAngle, true, Any);                                                 \
  entry(maximum_area, MaximumArea, true, Any);                                                   \
  entry(maximum_edge, MaximumEdge, true, Any);                                                   \
  entry(keep_boundary, KeepBoundary, true, Any);                                                 \
  entry(point_limit, PointLimit, true, Any)

/// Calls visit(name, isForAll, option...) for each option, with those of all structs side by side.
/// isForAll is std::true_type or std::false_type.
template <typename Visit, typename... Options>
void ForEachOption(const Visit& visit, Options&... options)
{
#define DELAUNAYFLIP_VISIT(name, Member, isForAll, range) \
  visit(#name, std::bool_constant<isForAll>(), options.Member...)
  DELAUNAYFLIP_OPTIONS(DELAUNAYFLIP_VISIT);
#undef DELAUNAYFLIP_VISIT
}

inline bool operator==(const FlipOptions& a, const FlipOptions& b)
{
  bool isSame = true;
  ForEachOption([&](const char*, auto, const auto& one, const auto& other)
    { isSame = isSame && one == other; },
    a, b);
  return isSame;
}

}

#endif
