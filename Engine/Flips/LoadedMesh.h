// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LOADEDMESH_H
#define DELAUNAYFLIP_LOADEDMESH_H

#include "DeviceMesh.h"
#include "EdgeMesh.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "HiddenEdges.h"
#include "Outline.h"
#include "RefinementPlan.h"
#include "RunProgress.h"
#include "RunQuery.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace delaunayflip
{

/// Restores the state of the calling thread that a backend has changed.
class DeviceScope
{
public:
  virtual ~DeviceScope() = default;
};

/// A side of an edge that a segment has become.
struct SegmentSide
{
  HalfEdgeId Side; ///< One that has a triangle.
  std::uint32_t IsOnLeft; ///< Whether it is to the left of the segment.
  std::uint32_t IsOnHull; ///< Whether the other side has no triangle.
};

/// What consecutive segments have become.
struct InsertedSegments
{
  static constexpr std::int32_t Refused = -1;

  std::vector<std::int32_t> NumberOfEdges; ///< Per segment, or Refused.
  std::vector<SegmentSide> Sides; ///< One per edge, in the order of the segments.
  std::int64_t Flips = 0;
};

/// The outcome of a motion, a removal or an insertion of points.
struct MotionResult
{
  bool IsThere = false; ///< False: it did not end, and the mesh is of no use.
  std::int64_t Rounds = 0;
  std::int64_t Flips = 0;
  std::vector<PinnedEdge> Edges; ///< What the given edges are now. Empty: what they were before.
};

/// @returns whether to go on.
using SegmentObserver = std::function<bool(const InsertedSegments&)>;

/// A mesh that is loaded onto a backend, ready to flip: what a session needs of a backend.
/// MeshOnBackend.h makes one.
class LoadedMesh
{
public:
  virtual ~LoadedMesh() = default;

  /// Makes the backend's device current in the calling thread as long as the result is kept. Null
  /// if there is no device. Call this before any other function.
  virtual std::unique_ptr<DeviceScope> MakeCurrent() const = 0;

  virtual FlipLoop& GetLoop() = 0;

  /// What is known about the input before the first iteration.
  virtual const FlipReport& GetInputReport() const = 0;

  /// These do what FlipSession's functions of the same names do.
  virtual void StoreTriangles(const MutableTriangleArray& triangles) const = 0;
  virtual void StoreOrderedTriangles(const MutableTriangleArray& triangles) const = 0;
  virtual void StoreFlipCounts(std::int32_t* counts) const = 0;
  virtual void StoreNeighbors(std::int32_t* neighbors) const = 0;
  /// @param first the first of these points, the results of which are stored.
  virtual void StoreUsedPoints(std::int64_t first, std::int64_t count, std::int64_t* ids) const = 0;

  /// Answers a query about a mesh from points that has triangles. The query's arrays are in the
  /// memory of the backend (CanAnswerInPlace) or of the host.
  /// @param observer is told the share of the places that is done.
  /// @returns Undecided only if the query's arrays are in the memory of the backend.
  virtual AskResult Ask(const RunQuery& asked, const ProgressObserver& observer) = 0;
  virtual bool CanAnswerInPlace(const PlaceQuery&) const { return false; }

  /// Inserts points into a Delaunay triangulation of points, and flips until it is one again. The
  /// new points are in the hull, with coordinates in the precision of the others.
  /// @param places x and y. The numbers of these points follow those of the mesh's.
  /// @param keepsFixed whether it ends if a point is on a fixed edge, because segments are some of
  /// these.
  virtual MotionResult InsertPoints(const std::vector<double>& places, bool keepsFixed) = 0;

  /// Moves the points of a Delaunay triangulation of points, and flips until it is Delaunay again.
  /// @param targets the places of all points, on a device only if HasMemory is true of them.
  /// @param segments the edges that segments have become, each once. They stay edges.
  /// @throws RunAborted. Then the mesh is of no use.
  virtual MotionResult MovePoints(const PointInput& targets, const std::vector<EdgeId>& segments,
    const BuildProgress& progress) = 0;
  /// Removes points from such a triangulation.
  /// @param ids of points, ascending; none is an end of one of the segments.
  virtual MotionResult RemovePoints(
    const std::vector<VertexId>& ids, const std::vector<EdgeId>& segments) = 0;
  /// Whether an array is in the memory of the backend's device.
  virtual bool HasMemory(const void*) const { return false; }

  /// Moves the points of a mesh of triangles, which stay as they are. All edges that are not fixed
  /// become candidates, and flips are counted anew. FlipLoop::Detect must follow.
  /// @param moved the mesh that was loaded, with its points at other places.
  /// @returns false, and changes nothing, if the mesh has to be loaded anew: on a device, if points
  /// are not finite, or if another geometry suits it now.
  virtual bool MoveMesh(const TriangleMesh&, const FlipOptions&) { return false; }

  /// Begins to refine a Delaunay triangulation of points, in which segments are fixed edges, unless
  /// it has begun.
  virtual void StartRefinement(const RefinementPlan& plan) = 0;
  /// Makes a round of refinement, and flips until the mesh is constrained Delaunay.
  /// @returns how many points it has added; their numbers follow those of the mesh's. 0: there is
  /// nothing more to do, or the limit is reached.
  virtual std::int64_t Refine() = 0;
  /// What the rounds have made so far. Valid until the mesh changes.
  /// @param isOver whether no round follows. Else the next round goes on as if nothing was fetched.
  virtual const RefinementResult& FetchRefinement(bool isOver) = 0;
  /// Tells a visitor of the points that the rounds have added so far.
  virtual void VisitRefined(const RefinedVertexVisitor& visit) = 0;

  /// Calls view(mesh) with a mesh from points, in the memory of the host.
  using HostView = std::function<void(const PointMeshView&)>;
  virtual void ViewOnHost(const HostView& view) = 0;
  /// Finds the points at the start and the end of half-edges of a mesh from points.
  virtual std::vector<std::int64_t> FindEnds(const std::vector<HalfEdgeId>& sides) = 0;

  /// Finds the triangles of a mesh from points that do not belong to the result. They stay in the
  /// mesh. From now on, what stores triangles, flip counts or neighbours leaves them out.
  /// @param segments all of them; receives those of the triangles that are kept.
  virtual KeptTriangles CutOff(
    const PointInput& input, const PointOptions& options, std::vector<SegmentEdge>& segments) = 0;
  /// Numbers the triangles that are kept, and measures them, after refinement.
  /// @param regions by triangle, -1 for one that is removed. @param segments all that are edges of
  /// triangles that are kept. @param kept what CutOff returned.
  virtual void NumberKept(const std::vector<std::int32_t>& regions, std::int64_t firstAdded,
    std::vector<SegmentEdge>& segments, KeptTriangles& kept) = 0;

  /// Triangulates the points of a mesh from points again, by divide and conquer on the host. Then
  /// no edge is bad. FlipLoop::Detect must follow.
  /// @throws RunAborted.
  virtual void DivideAndConquer(const BuildProgress& progress) = 0;

  /// Inserts segments into a mesh from points, one after the other, if they cross none before them.
  /// FlipLoop::Detect must follow.
  /// @param ends pairs of points. @param onBatch is told of some segments at a time, in their
  /// order, and is called with none before the first ones.
  virtual void InsertSegments(
    const std::vector<std::uint32_t>& ends, const SegmentObserver& onBatch) = 0;

  /// Stores the triangles in device memory. @returns false, and writes nothing, if the backend's
  /// device cannot write it.
  virtual bool StoreTrianglesOnDevice(
    const MutableTriangleArray&, const DeviceStream&, std::int32_t*) const
  {
    return false;
  }
  virtual bool StoreFlipCountsOnDevice(std::int32_t*, const DeviceStream&) const { return false; }
  virtual bool StoreNeighborsOnDevice(std::int32_t*, const DeviceStream&) const { return false; }

  /// Finds the triangles of a surface that flips have turned over in x and y. If it was not a
  /// height field or nearly one, there are none.
  virtual Defect FindTurnedTriangles() const = 0;

  /// Returns what KeepsWorstSliver (SmallestAngle.h) does.
  virtual bool KeepsSliver() = 0;

  /// Which kept edges would be bad without defects of the mesh.
  virtual HiddenSums CountHidden() = 0;

  /// Throws std::logic_error if the edge mesh is inconsistent, which is a bug of the engine.
  virtual void Audit() const = 0;
};

/// @throws RunAborted.
std::unique_ptr<LoadedMesh> LoadOnThreads(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// Triangulates points in the plane.
std::unique_ptr<LoadedMesh> LoadOnThreads(
  const PlaneArray& points, const FlipOptions& options, const BuildProgress& progress);

/// The edges that stay, without boundary edges, as pairs of ids. An edge of three or more triangles
/// is listed several times.
/// @param counts of its edges.
std::vector<std::int64_t> ListInnerFixedEdges(
  const TriangleMesh& mesh, const FlipOptions& options, const EdgeCounts& counts);

/// The regions that the region seeds of a mesh in x and y are in: by triangle of the caller, the
/// number of the first seed there, from 1, or 0 where there is none. Flips change none of them,
/// because they cross no edge that stays.
/// @param unused receives unused seeds; Outside: in no triangle with the orientation of most.
std::vector<std::int32_t> FindSeededRegions(
  const TriangleMesh& mesh, const FlipOptions& options, UnusedSeeds& unused);

/// @throws RunAborted.
/// @throws BackendUnavailable if there is no GPU, its memory runs out, its driver fails, or the
/// mesh needs the CPU. The message says why.
std::unique_ptr<LoadedMesh> LoadOnCuda(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// For arrays in the memory of FlipOptions::Device.
std::unique_ptr<LoadedMesh> LoadOnCuda(
  const DeviceMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// For points in the host's memory, or in that of FlipOptions::Device.
std::unique_ptr<LoadedMesh> LoadOnCuda(
  const PointInput& points, const FlipOptions& options, const BuildProgress& progress);

}

#endif
