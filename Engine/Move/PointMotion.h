// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTMOTION_H
#define DELAUNAYFLIP_POINTMOTION_H

#include "Array.h"
#include "EdgeFlip.h"
#include "FlipError.h"
#include "GroupBoundary.h"
#include "HullBoundary.h"
#include "LateCounts.h"
#include "MeshRoom.h"
#include "MotionView.h"
#include "PlaneMesh.h"
#include "RoundParts.h"
#include "VertexRemoval.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// Moves the vertices of a Delaunay triangulation in rounds. In a round all vertices that are not
/// at their targets make a step there. As long as a triangle is not counter-clockwise, its vertices
/// take equal and smaller shares of their steps. After each round edges flip. So the place of a
/// vertex depends on the mesh and the targets alone.

namespace delaunayflip
{

/// A mesh with vertices that move.
template <typename Real>
struct MovingMesh
{
  EdgeMesh& Edges;
  Real* Coordinates; ///< x and y by vertex.
  std::int64_t Vertices;
  const VertexId* Ids; ///< By vertex, its point.
};

/// Moves the vertices of a mesh, and keeps its arrays from one motion to the next.
template <typename Real, typename Backend>
class PointMotion
{
public:
  static constexpr int NumberOfCounts = static_cast<int>(MotionCount::End);

  /// What threads count together.
  struct SharedCounts
  {
    std::uint32_t Values[NumberOfCounts]; ///< By MotionCount.
    LateCounts Late;

    std::uint32_t Get(MotionCount count) const { return this->Values[static_cast<int>(count)]; }
    std::uint32_t Get(HullCount count) const
    {
      return this->Values[static_cast<int>(MotionCount::Hull) + static_cast<int>(count)];
    }
    /// Whether the boundary is a convex polygon that goes around once. If all triangles are
    /// counter-clockwise, too, none overlap.
    bool IsConvex() const
    {
      return this->Get(HullCount::Concave) == 0 && this->Get(HullCount::TurnsBack) == 0 &&
        this->Get(HullCount::Reversals) == 2;
    }
  };

  explicit PointMotion(const Backend& backend)
    : Device(backend),
      Hull(backend)
  {
  }

  /// Begins a motion. The mesh must be Delaunay.
  /// @param targets by point, in the memory of the backend.
  /// @param used by point, what MergePlaces returned. Empty if all are used.
  /// @param segments the edges that segments have become.
  void Begin(const MovingMesh<Real>& mesh, const PlaneArray& targets, const Array<VertexId>& used,
    const std::vector<EdgeId>& segments)
  {
    this->Targets = targets;
    this->UsedPoint = used.Size() > 0 ? used.Data() : nullptr;
    this->NumberOfPoints = std::max(mesh.Vertices, static_cast<std::int64_t>(used.Size()));
    this->Rounds = 0;
    this->Allowance = mesh.Vertices / 4 + Fewest;
    this->MostInverted =
      static_cast<std::uint32_t>(mesh.Edges.NumberOfTriangles / MostShare + Fewest);
    this->MakeRoom(mesh);
    this->RequireHull(mesh);
    this->Hull.Pin(segments, mesh.Vertices);
  }

  /// Removes points. Edges that have to be judged become candidates.
  /// @param ids the mesh's own, which change.
  /// @param removed which points, and how many there are in all.
  /// @param segments as for Begin.
  /// @returns false if all points have to be triangulated anew.
  /// @throws BeyondDevice.
  bool Remove(const MovingMesh<Real>& mesh, VertexId* ids, const RemovedPoints& removed,
    const std::vector<EdgeId>& segments)
  {
    Reserve(this->Counts, 0, 1, this->Device);
    this->ClearCounts();
    this->RequireHull(mesh);
    this->Hull.Pin(segments, mesh.Vertices);
    VertexRemoval<Real, Backend> removal(
      mesh.Edges, this->ViewPlane(mesh), this->Hull, this->Device);
    const bool isDone = removal.Remove(mesh.Coordinates, ids, removed);
    MovingMesh<Real> left = mesh;
    left.Vertices -= static_cast<std::int64_t>(removed.Ids.Size());
    if (isDone)
    {
      this->Hull.CountTurns(this->ViewPlane(left), this->GetHullCounts());
    }
    // Throws if a device could not decide, which may be why the removal has failed.
    const SharedCounts counts = this->FetchCounts();
    const bool isConvex = isDone && counts.IsConvex();
    if (isConvex)
    {
      this->End(left);
    }
    return isConvex;
  }

  /// Moves all vertices that are not at their targets, some of them only a part of the way. Edges
  /// that have to be judged become candidates.
  /// @returns false if the motion does not suit steps: too many triangles would be inverted, or the
  /// boundary would not be simple. Then the places of the mesh are of no use.
  /// @throws BeyondDevice.
  bool MakeRound(const MovingMesh<Real>& mesh)
  {
    const bool all = ++this->Rounds == 1;
    this->LateFlips = 0;
    this->IsSettled = false;
    this->HasVeryLargeStar = false;
    const EdgeState* states = mesh.Edges.States.Data();
    this->BeginChanges(mesh);
    if (all)
    {
      this->StartAll(mesh);
    }
    else
    {
      this->StartLate(mesh);
    }
    const SharedCounts counts = this->Halve(mesh);
    this->Hull.EndChanges(counts.Late.Sizes, mesh.Edges);
    if (counts.Late.End != LateEnd::Done)
    {
      return false;
    }
    const bool haveStatesMoved = mesh.Edges.States.Data() != states; // loops know their address
    this->ChangedHull = haveStatesMoved || counts.Late.HasChangedHull != 0;
    this->NumberOfNext = counts.Get(MotionCount::Late);
    if (all)
    {
      this->ChooseAll(mesh);
    }
    else
    {
      this->ChooseCandidates(mesh);
    }
    std::swap(this->Late, this->Next);
    this->NumberOfLate = this->NumberOfNext;
    return this->Rounds < LateLimits::Rounds && this->CountLate() <= this->Allowance;
  }

  /// Whether so few vertices are late that MakeLateRounds moves them. If it had no room for their
  /// triangles, MakeRound comes next.
  bool AreFewLate() const
  {
    return this->Rounds > 0 && this->NumberOfLate > 0 && this->NumberOfLate <= LateLimits::Late &&
      !this->HasVeryLargeStar;
  }

  /// Makes rounds with their flips, by one group of threads, until all vertices are at their
  /// targets or it takes too much of one group. Edges that are left to be judged are candidates.
  /// @tparam LateRounds that of LateRounds.h, which knows how edges flip.
  /// @returns false like MakeRound. @throws BeyondDevice.
  template <template <typename> class LateRounds>
  bool MakeLateRounds(const MovingMesh<Real>& mesh)
  {
    const Backend& device = this->Device;
    Reserve(this->ChangedTriangles, 0, LateLimits::Triangles, device);
    for (Array<BadEdge>& bad : this->BadEdges)
    {
      Reserve(bad, 0, LateLimits::Bad, device);
    }
    const EdgeState* states = mesh.Edges.States.Data();
    this->BeginChanges(mesh);
    const bool haveStatesMoved = mesh.Edges.States.Data() != states; // loops know their address
    device.RunGroup(LateRounds<Real>{ this->View(mesh), this->ViewBoundary(mesh), this->Late.Data(),
      this->GetLateCounts(), this->ChangedTriangles.Data(),
      { this->BadEdges[0].Data(), this->BadEdges[1].Data() }, this->Stamp });
    const LateCounts counts = this->FetchCounts().Late;
    this->Hull.EndChanges(counts.Sizes, mesh.Edges);
    this->Stamp = counts.Stamp;
    this->Rounds += counts.Rounds;
    this->HasVeryLargeStar = counts.End == LateEnd::GoesOn && counts.Rounds == 0;
    this->LateFlips = counts.Flips;
    this->IsSettled = counts.End == LateEnd::Done;
    this->NumberOfLate = counts.Late;
    this->ChangedHull = haveStatesMoved || counts.HasChangedHull != 0;
    return counts.End != LateEnd::Failed && this->Rounds < LateLimits::Rounds;
  }

  /// How many edges MakeLateRounds has flipped, if it made the last rounds.
  std::int64_t CountLateFlips() const { return this->LateFlips; }

  /// Whether MakeLateRounds has made the last rounds, and no loop has to flip or to learn of other
  /// edges.
  bool IsDelaunay() const { return this->IsSettled && !this->ChangedHull; }

  /// Whether the mesh has more or fewer edges after the last round.
  bool HasChangedHull() const { return this->ChangedHull; }
  std::int64_t CountLate() const { return this->NumberOfLate; }
  std::int64_t CountRounds() const { return this->Rounds; }

  /// What the edges of segments have become.
  std::vector<PinnedEdge> FetchPinned(const MovingMesh<Real>& mesh)
  {
    return this->Hull.FetchPinned(mesh.Edges);
  }

  /// Ends a motion after which all vertices are at their targets.
  void End(const MovingMesh<Real>& mesh)
  {
    this->KnownTriangles = mesh.Edges.NumberOfTriangles;
    this->KnownEdges = mesh.Edges.NumberOfEdges;
    this->KnownVertices = mesh.Vertices;
  }

  // The functions below are public because device lambdas require it.

  void RequireHull(const MovingMesh<Real>& mesh)
  {
    const bool isKnown = mesh.Edges.NumberOfTriangles == this->KnownTriangles &&
      mesh.Edges.NumberOfEdges == this->KnownEdges && mesh.Vertices == this->KnownVertices;
    if (!isKnown)
    {
      this->Hull.Build(mesh.Edges, this->ViewPlane(mesh));
    }
    this->KnownTriangles = -1; // until a change ends well
  }

  /// Makes room for changes of the boundary, and sets what the counts begin with.
  void BeginChanges(const MovingMesh<Real>& mesh)
  {
    Reserve(this->PendingSides, 0, LateLimits::Pending, this->Device);
    SharedCounts counts{};
    counts.Late.Late = static_cast<std::uint32_t>(this->NumberOfLate);
    counts.Late.End = LateEnd::GoesOn;
    const StatesBehind behind = this->Hull.BeginChanges(mesh.Edges, counts.Late.Sizes);
    SharedCounts* to = this->Counts.Data();
    this->Device.ForEach(behind.Count + 1,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (i < behind.Count)
        {
          behind.Fix(i);
        }
        else
        {
          *to = counts;
        }
      });
  }

  /// Moves all vertices to their targets, cuts off triangles at the boundary that are inverted
  /// then, and lists the others that are, unless a target is unusual.
  void StartAll(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    const VertexId* usedPoint = this->UsedPoint;
    const std::int64_t vertices = mesh.Vertices; // at most as many as points
    this->Device.ForEach(this->NumberOfPoints,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (usedPoint && !motion.KeepsUse(i, usedPoint[i]))
        {
          motion.Increment(MotionCount::Unusual);
        }
        if (i < vertices)
        {
          motion.Start(static_cast<VertexId>(i));
        }
      });
    this->Device.RunGroup(CutInGroup<Real>{ motion, this->ViewBoundary(mesh) });
    this->Device.ForEach(
      mesh.Edges.NumberOfTriangles, FindLeftInverted<Real>{ { motion }, this->GetLateCounts() });
  }

  /// Likewise for the late vertices.
  void StartLate(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    const GroupBoundary boundary = this->ViewBoundary(mesh);
    LateVertex* late = this->Late.Data();
    const std::int64_t count = this->NumberOfLate;
    const auto triangles = static_cast<TriangleId>(mesh.Edges.NumberOfTriangles);
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { motion.FindCorner(late[i], triangles); });
    this->Device.ForEach(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { motion.Start(late[i].Vertex); });
    this->Device.RunGroup(CutInGroup<Real>{ motion, boundary });
    // Triangles have taken the numbers of those that were cut off.
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { late[i].Corner = boundary.FindCorner(late[i].Vertex, late[i].Corner); });
    const std::uint32_t stamp = ++this->Stamp;
    this->Device.ForEach(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { motion.CheckStar(late[i], stamp); });
  }

  /// Halves the steps of vertices until no triangle is inverted, and makes the boundary convex.
  /// @returns what was counted. LateCounts::End is Done if this was possible.
  SharedCounts Halve(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    const auto mostForGroup =
      static_cast<std::uint32_t>(MostForThread * this->Device.CountGroupThreads());
    std::uint32_t passes = 0;
    for (;;)
    {
      this->Device.RunGroup(HalveAndFill<Real>{ motion, this->ViewBoundary(mesh), this->Stamp + 1,
        LateLimits::Passes - passes, mostForGroup });
      this->Stamp += LateLimits::Passes;
      const SharedCounts counts = this->FetchCounts();
      const std::uint32_t inverted = counts.Get(MotionCount::Inverted);
      passes = counts.Get(MotionCount::Passes);
      const bool isTooMuch = inverted > this->MostInverted || passes >= LateLimits::Passes ||
        counts.Get(MotionCount::Late) > motion.MostLate;
      if (counts.Late.End != LateEnd::GoesOn || isTooMuch)
      {
        return counts;
      }
      this->HalvePass(motion, inverted);
      ++passes;
    }
  }

  /// Halves the steps of the vertices of listed triangles, and lists those that are inverted then.
  void HalvePass(const MotionView<Real>& motion, std::int64_t inverted)
  {
    const std::uint32_t stamp = ++this->Stamp;
    this->Device.ForEach(
      inverted, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { motion.AskForHalvings(i, stamp); });
    const std::int64_t most = 3 * inverted; // triangles change at most so many vertices
    this->Device.ForEach(most,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (i < *motion.Get(MotionCount::Changed))
        {
          motion.TakeHalvings(i);
        }
      });
    this->Device.ForEach(1,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t)
      {
        *motion.Get(MotionCount::Inverted) = 0;
        motion.Increment(MotionCount::Passes);
      });
    const LateVertex* changed = this->Changed.Data();
    this->Device.ForEach(most,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (i < *motion.Get(MotionCount::Changed))
        {
          motion.CheckStar(changed[i], stamp);
        }
      });
    this->Device.ForEach(
      1, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t) { *motion.Get(MotionCount::Changed) = 0; });
  }

  /// Makes all edges candidates that are not fixed, after the first round. All vertices are marked
  /// as before a round.
  void ChooseAll(const MovingMesh<Real>& mesh)
  {
    EdgeState* states = mesh.Edges.States.Data();
    std::uint8_t* halvings = this->HalvingsOf.Data();
    const std::int64_t vertices = this->NumberOfNext > 0 ? mesh.Vertices : 0;
    this->Device.ForEach(mesh.Edges.NumberOfEdges, // there are more than vertices
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const bool isFixed = states[i] == EdgeState::Fixed;
        states[i] = isFixed ? EdgeState::Fixed : EdgeState::Candidate;
        if (i < vertices)
        {
          halvings[i] = AtTarget;
        }
      });
  }

  /// Makes edges candidates if a vertex of their two triangles has moved, after another round.
  void ChooseCandidates(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    std::uint8_t* halvings = this->HalvingsOf.Data();
    const LateVertex* late = this->Late.Data();
    this->Device.ForEach(this->NumberOfLate,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        motion.ForStar(
          late[i].Corner, [&](CornerId corner) { motion.JudgeEdges(TriangleOf(corner)); });
        halvings[late[i].Vertex] = AtTarget;
      });
  }

private:
  /// A group handles so many inverted triangles per thread. It need not wait for the host between
  /// passes.
  static constexpr std::uint32_t MostForThread = Backend::IsOnHost ? 64 : 4;
  static constexpr std::int64_t Fewest = 64;
  /// If more than one triangle in 64 is inverted, triangulating anew takes less time.
  static constexpr std::int64_t MostShare = 64;

  PlaneMesh ViewPlane(const MovingMesh<Real>& mesh)
  {
    PlaneMesh plane{ mesh.Edges.View(), PlaneArray(mesh.Coordinates, mesh.Vertices, 2), true };
    plane.Failed =
      reinterpret_cast<std::int32_t*>(this->GetCounts() + static_cast<int>(MotionCount::Undecided));
    return plane;
  }

  MotionView<Real> View(const MovingMesh<Real>& mesh)
  {
    return { this->ViewPlane(mesh), mesh.Coordinates, this->Before.Data(), this->Targets, mesh.Ids,
      this->HalvingsOf.Data(), this->VertexMarks.Data(), this->TriangleMarks.Data(),
      this->Inverted.Data(), this->Changed.Data(), this->Next.Data(), this->GetCounts(),
      this->MostInverted, 4 * this->MostInverted };
  }

  void MakeRoom(const MovingMesh<Real>& mesh)
  {
    const Backend& device = this->Device;
    Reserve(this->Before, 0, 2 * mesh.Vertices, device);
    Reserve(this->HalvingsOf, 0, mesh.Vertices, device);
    Reserve(this->Inverted, 0, this->MostInverted, device);
    // An inverted triangle changes at most three vertices.
    Reserve(this->Changed, 0, 3 * std::int64_t(this->MostInverted), device);
    Reserve(this->Late, 0, 4 * std::int64_t(this->MostInverted), device);
    Reserve(this->Next, 0, 4 * std::int64_t(this->MostInverted), device);
    Reserve(this->Counts, 0, 1, device);
    // A triangulation has fewer than two triangles per vertex, whatever its boundary.
    const std::int64_t triangles = 2 * mesh.Vertices;
    constexpr std::uint32_t LastStamp = (1u << 31) / StampUnit;
    const bool isNew = static_cast<std::int64_t>(this->VertexMarks.Size()) < mesh.Vertices ||
      static_cast<std::int64_t>(this->TriangleMarks.Size()) < triangles;
    if (isNew || this->Stamp > LastStamp)
    {
      Reserve(this->VertexMarks, 0, mesh.Vertices, device);
      Reserve(this->TriangleMarks, 0, triangles, device);
      this->ClearMarks(this->VertexMarks);
      this->ClearMarks(this->TriangleMarks);
      this->Stamp = 0;
    }
  }

public:
  void ClearMarks(Array<std::uint32_t>& marks) const
  {
    std::uint32_t* values = marks.Data();
    this->Device.ForEach(static_cast<std::int64_t>(marks.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { values[i] = 0; });
  }

private:
  std::uint32_t* GetCounts() { return this->Counts.Data()->Values; }
  LateCounts* GetLateCounts() { return &this->Counts.Data()->Late; }
  std::uint32_t* GetHullCounts() { return this->GetCounts() + static_cast<int>(MotionCount::Hull); }

  GroupBoundary ViewBoundary(const MovingMesh<Real>& mesh)
  {
    return { this->Hull.View(this->ViewPlane(mesh)), this->GetLateCounts(), this->GetHullCounts(),
      this->Hull.GetPending(), this->PendingSides.Data() };
  }

  void ClearCounts() { this->Device.Fill(this->GetCounts(), 0, NumberOfCounts); }

  /// Waits for what is counted. @throws BeyondDevice if a device could not decide.
  SharedCounts FetchCounts() const
  {
    SharedCounts counts;
    this->Device.Download(this->Counts.Data(), 1, &counts);
    if (counts.Get(MotionCount::Undecided) != 0)
    {
      throw BeyondDevice();
    }
    return counts;
  }

  const Backend& Device;
  HullBoundary<Backend> Hull;
  PlaneArray Targets;
  const VertexId* UsedPoint = nullptr; ///< By point. Null if all are used.
  std::int64_t NumberOfPoints = 0;
  Array<Real> Before;
  Array<std::uint8_t> HalvingsOf;
  Array<std::uint32_t> VertexMarks, TriangleMarks;
  Array<SharedCounts> Counts; ///< One.
  Array<TriangleId> Inverted;
  Array<LateVertex> Changed; ///< Vertices with a new step since triangles were last checked.
  Array<LateVertex> Late; ///< Vertices that this round moves, if it is not the first.
  Array<LateVertex> Next; ///< Vertices that the next round moves.
  Array<TriangleId> ChangedTriangles;
  Array<std::uint32_t> PendingSides;
  Array<BadEdge> BadEdges[2];
  std::int64_t NumberOfLate = 0, NumberOfNext = 0, LateFlips = 0;
  std::int64_t Rounds = 0;
  std::int64_t Allowance = 0;
  std::uint32_t MostInverted = 0;
  std::uint32_t Stamp = 0;
  bool ChangedHull = false;
  bool HasVeryLargeStar = false; ///< Whether MakeLateRounds had no room for a round.
  bool IsSettled = false; ///< Whether MakeLateRounds has left a Delaunay triangulation.
  /// The sizes that the mesh had when its boundary was found.
  std::int64_t KnownTriangles = -1, KnownEdges = -1, KnownVertices = -1;
};

}

#endif
