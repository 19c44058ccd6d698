// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERERUN_H
#define DELAUNAYFLIP_SPHERERUN_H

#include "DelaunayFlip.h"
#include "LoadedSphere.h"
#include "Outline.h"
#include "RefusedSegments.h"
#include "SegmentCrossings.h"
#include "SessionRun.h"
#include "SphereAsker.h"
#include "SpherePasses.h"
#include "SphereSegments.h"
#include "SphereStart.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace delaunayflip
{

/// Makes the triangulation of points on a sphere, which is their convex hull. It uses two other
/// sessions: one for the projected points in the plane, and one for the closed mesh on the sphere.
/// Advance does all the work, whatever the number of iterations.
///
/// After the flips in the plane all decisions are exact, for the points as given. If filters see
/// that all edges are convex, there is nothing to flip on the sphere. Points where the
/// projection has folded the mesh over are left out, and inserted at the end. If flips cannot make
/// an edge convex, one of its ends is inside of the hull; the run then begins again without that
/// point. It also begins again without points within a face or an edge of the hull, because the
/// start would decide which of these have triangles.
///
/// Segments are inserted into the complete mesh, and edges around them flip again. At the end rings
/// and hole seeds remove triangles.
class SphereRun final : public SessionRun
{
public:
  /// @throws InvalidMesh for segments between points that there are not. @throws InvalidOptions for
  /// options that only triangulations in the plane have.
  SphereRun(const PointInput& input, const PointOptions& options, const ProgressObserver& progress);

  bool Advance(std::int64_t iterations, const FlipObserver& observer,
    const ProgressObserver& progress) override;
  const FlipReport& GetReport() override { return this->Report; }
  void StoreTriangles(const MutableTriangleArray& triangles) override;
  void StoreFlipCounts(std::int32_t* counts) override;
  void StoreNeighbors(std::int32_t* neighbors) override;
  void StoreUsedPoints(std::int64_t* ids) override;
  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written) override;
  bool StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream& stream) override;
  std::vector<std::int64_t> ListSegmentEdges() override;
  std::vector<std::int64_t> ListSegmentsOfEdges() override;
  void StoreRegions(std::int32_t* labels) override;
  bool Ask(const PlaceQuery& query, const ProgressObserver& progress) override;

private:
  /// @throws RunAborted if an observer stops the session, or has stopped its constructor.
  template <typename Session>
  static void AdvanceToEnd(Session& session, const ProgressObserver& progress)
  {
    const auto isAborted = [&]
    { return session.GetReport().StopReason == StopReasonKind::Aborted; };
    if (!isAborted())
    {
      session.Advance(-1, {}, progress);
    }
    if (isAborted())
    {
      throw RunAborted();
    }
  }

  enum class PointState : char
  {
    Used,
    NotFinite,
    Repeated, ///< Another point at its place is used.
    LeftOut, ///< The projection cannot place it. It is inserted at the end.
    Inside
  };

  void Run();
  void RunOnHost();
  bool RunOnDevice();
  bool PrefersDevice() const;
  FlipOptions ChooseDevice() const;
  bool MayRunOnDevice() const;
  bool StartOnDevice(LoadedSphere& device, const FlipOptions& options);
  void Fetch();
  void RequireAsker();
  AskResult AskDevice(const PlaceQuery& query, const ProgressObserver& progress);
  AskResult AskHost(const PlaceQuery& query, const ProgressObserver& progress) const;
  template <typename Store>
  bool StoreFromDevice(const Store& store);
  void ReportStart(const StartSums& sums);
  void ReadPoints();
  void MakeHull();
  bool Start();
  void StartInPlane(const SpherePoints& points, const NumberedPoint& pole);
  void MarkUnplaced(std::int32_t id, const NumberedPoint& pole, const double* places);
  void MarkRepeated(const std::vector<std::int64_t>& used, const PlaneNumbers& numbers);
  void JoinPole(std::int32_t pole);
  bool StartFromSimplex();
  void MarkRepeatedLeftOut();
  bool ChooseCenter(const Simplex& simplex);
  void TestStart();
  bool TakeStart();
  void Flip();
  const std::vector<std::int32_t>& FindNeighborsOnce();
  bool LeaveOut(const std::vector<std::int32_t>& points, PointState state);
  bool HasLeftOut() const;
  bool InsertLeftOut();
  void OpenMesh();
  void TriangulateOnePlane();
  void CheckSeeds() const;
  void CheckOpposite() const;
  void PrepareSegments();
  void InsertSegments();
  void RequireFacesOutside() const;
  void Refuse(const Segment& segment, RefusalKind why, std::int32_t crossed);
  void ExplainRingRefused() const;
  void FlipAroundSegments();
  void MarkInside();
  void RemoveTriangles();
  void DropTriangles(const std::vector<unsigned char>& isRemoved);
  void DropLostEdges();
  void Complete();
  void CountSegments();
  void ListRemoved();
  void ListUnused();
  std::vector<std::int32_t> ListActive() const;
  std::int64_t FindUsed(std::int64_t point) const;
  ProgressObserver TellHalf();
  void Reset() override;
  std::string ExplainRefusal() const override;

  const PointInput Input;
  const PointOptions Options;
  /// If it is there, it has the closed mesh of all points, and the arrays below are empty until
  /// they are fetched.
  std::unique_ptr<LoadedSphere> OnDevice;
  SpacePoints Points;
  std::vector<PointState> States; ///< By point.
  std::vector<std::int32_t> UsedPoint; ///< By point, the one that is used at its place.
  std::vector<std::int32_t> Triangles, FlipCounts;
  std::vector<std::int32_t> Neighbors; ///< Those of Triangles. Empty: not known.
  PlanePoint Center = Origin; ///< The place from which triangles are seen.
  StartSums Tested; ///< What the last test of the start has found.
  /// The share of the progress that was given to stretches of the work, with the one under way.
  double Done = 0.0;
  int Starts = 0;
  /// A simplex of all points. It depends on their places alone.
  Simplex FirstSimplex;
  FlipReport Planar; ///< Sums over the flips in the plane.
  /// Answers about the final triangles. Made by the first query.
  std::unique_ptr<const SphereAsker> Asker;
  std::unique_ptr<SphereDeviceAsker> DeviceAsker; ///< A copy on a GPU, if that answers.
  std::int64_t Opened = 0; ///< How many triangles OpenMesh has removed.
  bool HasHull = false; ///< Whether there were triangles before rings and seeds removed them.
  std::vector<Segment> Segments; ///< The caller's. Those of a ring run in one direction.
  std::vector<SphereEdge> Edges; ///< Those that segments have become, of triangles that are kept.
  std::vector<RefusedSegment> Refused;
  std::int64_t Replaced = 0; ///< How many edges segments have replaced.
  KeptTriangles Kept; ///< What rings and seeds have removed.
  /// The triangles before that, with their neighbours and, by triangle, its number in the output or
  /// -1. Empty if nothing was removed.
  std::vector<std::int32_t> WholeTriangles, WholeNeighbors, Numbers;
};

}

#endif
