// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DELAUNAYFLIP_H
#define DELAUNAYFLIP_DELAUNAYFLIP_H

#include "DeviceMesh.h"
#include "EngineExport.h"
#include "FlipError.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "Interpolation.h"
#include "PointTriangulation.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

/// @file
/// The main header of the engine. FlipToDelaunay flips a mesh in one call:
///
///     const double xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
///     std::int32_t ids[] = { 0, 1, 2, 0, 2, 3 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 4);
///     mesh.Triangles = TriangleArray(ids, 2);
///     const FlipReport report = FlipToDelaunay(mesh, {}, MutableTriangleArray(ids, 2));
///     report.TotalFlips; // 1
///
/// Now `ids` has two better triangles. A FlipSession flips a mesh a few iterations at a time:
///
///     FlipSession session(mesh, FlipOptions());
///     while (session.Advance(10))
///     {
///       session.StoreTriangles(MutableTriangleArray(ids, 2)); // and show them, for example
///     }
///     session.GetReport().Converged(); // true
///
/// It can also make a mesh from points (PointTriangulation.h). In the examples of these headers a
/// comment after an expression is its value, and all names are in the namespace delaunayflip.

namespace delaunayflip
{

class SessionRun;

/// New memory in the host for a result. The system takes longer to provide its pages than storing
/// the result takes.
struct ResultMemory
{
  void* First;
  std::int64_t Bytes;
};

/// A mesh that is being flipped. It is built once from the caller's arrays, then advanced by
/// iterations, and can be read at any time between them. With BackendKind::Auto, with several
/// pieces, and if a progress observer stopped the constructor, the caller's arrays must stay
/// unchanged as long as the session exists: if a GPU fails, the CPU starts from them. Otherwise
/// they are not needed after the constructor.
///
/// With several pieces (FlipOptions::NumberOfPieces) the first Advance makes all iterations,
/// whatever their number, and the edges and angles of the report are known only then. If it is
/// stopped, the next one begins anew.
///
/// Any number of threads and any backend give the same result, bit for bit, for the same mesh and
/// options.
class DELAUNAYFLIP_EXPORT FlipSession
{
public:
  /// Builds the edge mesh and tests all edges. If `progress` returns false meanwhile, the report's
  /// StopReason is Aborted and the triangles are those of the input; the next Advance builds again.
  /// @param progress is kept: if a GPU fails in a later call, it can stop the CPU from repeating
  /// the run. The report and the triangles are then as above.
  /// @param expected is memory that is announced as by Expect, but its pages are touched from the
  /// beginning, while the GPU builds the edge mesh. It must stay until the first Advance returns,
  /// or until the session is destroyed without one.
  /// @throws InvalidMesh, InvalidOptions, MeshTooLarge, BackendUnavailable, std::bad_alloc.
  FlipSession(const TriangleMesh& mesh, const FlipOptions& options,
    const ProgressObserver& progress = {}, const std::vector<ResultMemory>& expected = {});

  /// Opens a session for a mesh in the memory of a GPU, with the same result. FlipOptions::Device
  /// must be -1 or that GPU, and NumberOfPieces 0 or 1. BackendKind::Auto uses the GPU whatever the
  /// size of the mesh.
  /// @throws InvalidOptions if the arrays are not in the memory of that GPU; BackendUnavailable if
  /// CUDA cannot be used at all, with any BackendKind.
  FlipSession(
    const DeviceMesh& mesh, const FlipOptions& options, const ProgressObserver& progress = {});

  /// Triangulates points in the plane (PointTriangulation.h): a session that begins with a valid
  /// triangulation of all places, which flips make Delaunay. When no bad edge or no iteration is
  /// left, the segments are inserted, and flips go on around them. In the end triangles are
  /// removed as the options say. So the number of triangles, GetReport().Triangles, is that of the
  /// result once there is nothing more to do. It is 0 if fewer than three places are given or all
  /// lie on one line. If an observer aborts, segments that are not inserted yet are missing, and
  /// nothing is removed.
  ///
  /// If the flips would be a long chain, as for points along curves, the host takes over by divide
  /// and conquer. The arrays must stay unchanged as long as the session exists.
  /// @throws MeshTooLarge for more than 357 million points; InvalidMesh if a segment names a point
  /// that does not exist, or (also from Advance) if a ring is not closed or one of its segments is
  /// refused; InvalidOptions, BackendUnavailable, std::bad_alloc.
  FlipSession(
    const PointInput& points, const PointOptions& options, const ProgressObserver& progress = {});
  ~FlipSession();
  FlipSession(FlipSession&&) noexcept;
  FlipSession& operator=(FlipSession&&) noexcept;

  /// Runs at most `iterations` more iterations; -1 (default): no limit. Ends earlier on
  /// convergence, at FlipOptions::MaximumIterations, or if an observer returns false. The next call
  /// continues from there.
  /// @returns whether there is more to do and no observer stopped the run.
  /// @throws BackendUnavailable, std::bad_alloc, what an observer throws; and, after a constructor
  /// that was stopped or with several pieces, what the constructor throws. After an exception the
  /// next call begins anew.
  bool Advance(std::int64_t iterations = -1, const FlipObserver& observer = {},
    const ProgressObserver& progress = {});

  /// The number of triangles. Unlike GetReport it measures nothing.
  std::int64_t CountTriangles() const;

  /// Announces memory that a Store function will write after the next Advance, such as a new array
  /// for the result. Its contents are lost, and it must stay until that Advance returns. While a
  /// GPU flips, CPU threads touch its pages.
  void Expect(void* memory, std::int64_t bytes);

  /// What has happened so far. The first call after an Advance that did not finish computes the
  /// smallest angle, which takes a pass over the mesh. If this throws, the next Advance begins
  /// anew.
  const FlipReport& GetReport() const;

  /// Writes the triangles, each in its input slot. A triangle that no flip changed keeps its three
  /// ids in their order. Triangles that refinement has added follow. `triangles.Count` must be
  /// CountTriangles().
  void StoreTriangles(const MutableTriangleArray& triangles) const;

  /// Writes the triangles in an order that depends on them alone. Each begins with its lowest id,
  /// and they are sorted by their first and then by their second id. So points that have moved to
  /// some places give the same numbers as points that were triangulated there. Only StoreTriangles
  /// has the numbers of triangles that the other functions use. For sessions from points in the
  /// plane.
  void StoreOrderedTriangles(const MutableTriangleArray& triangles) const;

  /// Writes three numbers for every triangle: the triangles across its edges. Number k is opposite
  /// vertex k, and -1 where there is none. For sessions from points.
  void StoreNeighbors(std::int32_t* neighbors) const;

  /// Writes, for every point of the caller, the id of the point that is used at its place, or -1 if
  /// it is not finite; its own id after an abort before there were triangles. For sessions from
  /// points.
  void StoreUsedPoints(std::int64_t* ids) const;

  /// Returns the points made where segments cross, with PointOptions::SplitCrossings, and then
  /// those of refinement, which are numbered behind all others.
  const std::vector<AddedPoint>& GetAddedPoints() const;

  /// Writes them to arrays with room for all. This is faster, since it takes several threads.
  void StoreAddedPoints(const AddedPointArrays& arrays) const;

  /// Returns the edges that segments have become, as pairs of point ids, in the order and direction
  /// of the segments, each once. Empty until they are inserted. For sessions from points.
  std::vector<std::int64_t> ListSegmentEdges() const;

  /// Returns the number of the caller's segment for each of these edges; of several, the first one.
  std::vector<std::int64_t> ListSegmentsOfEdges() const;

  /// Writes the label of the region that each triangle is in (PointInput::Regions, or
  /// FixedEdges::RegionSeeds); 0 where there is none. Not for a mesh in several pieces.
  void StoreRegions(std::int32_t* labels) const;

  /// Writes, for each of CountTriangles() triangles, its source: the triangle before refinement
  /// that contains its centroid. The triangle gets the source's data. It has exactly the source's
  /// region, because edges between regions are never crossed. Without refinement each triangle is
  /// its own source. For sessions from triangles.
  void StoreSources(std::int32_t* sources) const;

  /// Inserts more points into the triangulation, numbered after the others. The triangles are then
  /// those of all points, perhaps in another order than if all had been given at once. Up to one in
  /// 32 of the points at a time are inserted in place where Move would keep the mesh, if all are in
  /// triangles that are kept, and none is on a segment: only the triangles around them change.
  /// Otherwise the triangulation is made anew.
  /// For sessions from points.
  /// @param points in the host's memory; they are copied, in the precision of the others.
  /// @param progress is told the share that is done if all is made anew.
  /// @returns false if that has asked to stop. Then Advance begins with all points.
  /// @throws InvalidOptions if the session is not one from points, or with PointInput::Sizes;
  /// InvalidMesh if there are too many points, or as the constructor; BackendUnavailable.
  bool Insert(const PlaneArray& points, const ProgressObserver& progress = {});

  /// Moves points. The triangles are then those of a triangulation of the points where they are
  /// now, perhaps in another order. If there are no goals, PointTolerance is 0, and no two points
  /// meet at one place or part, the mesh follows the points in rounds. A round moves the points as
  /// far as the triangles allow, and flips. Segments move with their points, and triangles that
  /// outlines, holes and options remove are found anew. If many triangles would turn over, flips
  /// take longer than a triangulation, as along curves, a point goes through a segment, onto it or
  /// off it, a segment is refused because it crosses another one or may be split there, and in all
  /// other cases, the points are triangulated anew. PointCounts::MoveRounds is then 0.
  ///
  /// If a GPU fails later, the CPU triangulates the points where they are, and the triangles may be
  /// in another order.
  ///
  /// The mesh of a session from triangles stays as it is, and Advance goes on with it. Edges that
  /// were fixed stay, and the report begins anew. That is for the CPU, and for all points at once,
  /// in the host's memory, with Stride 3: x, y and z.
  /// @param move coordinates in the host's memory are copied, in the precision of the points. Those
  /// in the memory of a GPU must have that precision, and stay unchanged until the next move.
  /// @param progress is asked before points move, between rounds and during long flips, and while
  /// they are triangulated anew.
  /// @returns false if `progress` has asked to stop. Then all points are where they were.
  /// @throws InvalidOptions if the number of places or an id does not fit the session, or points
  /// are on a sphere. A session from triangles must also not be on a GPU, refined or in several
  /// pieces, nor have region seeds or points that are not finite, and GeometryKind::Auto must not
  /// choose another geometry now; else nothing changes. Also throws what the constructor and
  /// Advance throw. Then all points are where they were, and the next Advance begins anew.
  bool Move(const PointMove& move, const ProgressObserver& progress = {});

  /// Removes points. The others keep their numbers. A removed point is no longer used, as if it
  /// were not finite, and later moves do not bring it back. Up to one in 32 of the points at a time
  /// are removed in place where Move would keep the mesh, unless one is on a segment or an end of
  /// one. Otherwise the triangulation is made anew. For sessions from points.
  /// @param ids of points. Ids of points that were removed before have no effect.
  /// @returns false if `progress` has asked to stop. Then no point is removed.
  /// @throws the same as Move.
  bool Remove(const std::int64_t* ids, std::int64_t count, const ProgressObserver& progress = {});

  /// Numbers the points anew, without the removed ones and in the same order. For sessions from
  /// points without segments or sizes.
  /// @returns false if `progress` has asked to stop. Then the points keep their numbers.
  /// @throws the same as Move.
  bool Compact(const ProgressObserver& progress = {});

  /// Answers a query about places: see PlaceQuery. Nothing in the session changes. Triangles that
  /// an outline, holes or options have removed are outside. For sessions from points.
  /// @param progress is told the share of the places that is done.
  /// @returns false if that has asked to stop; then some results are missing.
  /// @throws InvalidOptions if the session is not one from points, if the query's numbers are out
  /// of range, or for natural neighbours while there are bad edges; BackendUnavailable.
  bool Ask(const PlaceQuery& query, const ProgressObserver& progress = {}) const;

  /// Writes, for every triangle slot, in how many flips it took part: GetReport().Triangles
  /// numbers.
  void StoreFlipCounts(std::int32_t* counts) const;

  /// Does the same for arrays in the memory of a GPU, in any session. If the engine works on that
  /// GPU, nothing is copied through the host. An array of the mesh itself may be written once there
  /// is nothing more to do.
  /// @param written null, or one number per triangle in the memory of the engine's GPU: all -1
  /// before the first call for an array of triangles, and then what that session's last call has
  /// left there. Then only triangles that flips have changed since need be written, which takes a
  /// sixth of the time where these are few.
  /// @throws InvalidOptions if the array is not in the memory of a GPU; BackendUnavailable.
  void StoreTriangles(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written = nullptr) const;
  void StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const;
  void StoreNeighbors(std::int32_t* neighbors, const DeviceStream& stream) const;

private:
  std::unique_ptr<SessionRun> Run;
};

/// Checks options before there is a mesh: their values, whether they fit together, and, with
/// BackendKind::CUDA, whether the GPU can be used.
/// @throws InvalidOptions, BackendUnavailable.
DELAUNAYFLIP_EXPORT void CheckOptionsAndBackend(const FlipOptions& options);

/// Finds the interior edges (edges with two triangles) that never flip in a run with these options,
/// including those of inserted constraints. To keep exactly these edges fixed after points have
/// been moved, pass them as constraint edges, with a feature angle of 180, to a run over the same
/// or the flipped triangles.
/// @returns pairs of vertex ids.
/// @throws the same as FlipSession's constructor; RunAborted.
DELAUNAYFLIP_EXPORT std::vector<std::int64_t> FindFixedEdges(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress = {});

/// The geometry that a run with these options uses: options.Geometry, or what Auto chooses.
/// @throws the same as FlipSession's constructor.
DELAUNAYFLIP_EXPORT GeometryKind FindGeometry(const TriangleMesh& mesh, const FlipOptions& options);

/// Flips `mesh` in a single call and writes the result to `triangles`, which may be the array that
/// mesh.Triangles views. After an exception nothing has been written. FlipInPieces (PieceFlip.h)
/// needs less memory for a mesh in several pieces. Refinement needs a FlipSession.
/// @throws the same as FlipSession's constructor.
DELAUNAYFLIP_EXPORT FlipReport FlipToDelaunay(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer = {},
  const ProgressObserver& progress = {});

/// Flips a mesh in the memory of a GPU; `triangles` views device memory too.
DELAUNAYFLIP_EXPORT FlipReport FlipToDelaunay(const DeviceMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer = {},
  const ProgressObserver& progress = {});

}

#endif
