// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTMOTION_H
#define DELAUNAYFLIP_POINTMOTION_H

#include "Array.h"
#include "Atomics.h"
#include "FlipError.h"
#include "HullBoundary.h"
#include "MeshRoom.h"
#include "PlaceWalk.h"
#include "PlaneMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

/// @file
/// Moves the vertices of a Delaunay triangulation in rounds. In a round all vertices that are not
/// at their targets make a step there. As long as a triangle is not counter-clockwise, the steps of
/// its vertices are halved. After each round edges flip. So the place of a vertex depends on the
/// mesh and the targets alone.

namespace delaunayflip
{

/// How often the step of a vertex has been halved in a round.
enum Halvings : std::uint8_t
{
  WholeStep = 0,
  NoStep = 24, ///< The vertex stays where it is.
  AtTarget = 255 ///< The vertex was at its target before the round.
};

/// A vertex that is not at its target yet.
struct LateVertex
{
  VertexId Vertex;
  CornerId Corner; ///< One of its corners or, between rounds, a corner near it.
};

/// The lists that several threads fill. No result depends on their order.
enum class MotionList : int
{
  Inverted,
  Changed,
  Late,
  Count
};

/// Pointers to the arrays of a round.
template <typename Real>
struct MotionView
{
  PlaneMesh Mesh; ///< At the current places.
  Real* Now; ///< The current places, x and y by vertex.
  Real* Before; ///< The places before this round, likewise.
  PlaneArray Targets; ///< By point.
  const VertexId* Ids; ///< By vertex, its point.
  std::uint8_t* HalvingsOf; ///< By vertex.
  std::uint32_t* VertexMarks; ///< The stamp of the last pass that has handled a vertex.
  std::uint32_t* TriangleMarks;
  std::uint32_t* Counts; ///< By list.
  std::uint32_t MostInverted, MostLate;

  DELAUNAYFLIP_HOST_DEVICE Real GetTarget(VertexId vertex, int axis) const
  {
    return static_cast<Real>(this->Targets.Get(this->Ids[vertex], axis));
  }

  /// Whether a coordinate is neither so large nor so small that products of it overflow or vanish.
  DELAUNAYFLIP_HOST_DEVICE static bool IsUsual(Real coordinate)
  {
    constexpr double Least = 7.8886090522101181e-31; // 2^-100
    const double size = std::fabs(static_cast<double>(coordinate));
    return size == 0.0 || (size >= Least && size <= 1.0 / Least);
  }

  /// Moves a vertex to its target. @returns whether the target's coordinates are usual.
  DELAUNAYFLIP_HOST_DEVICE bool Start(VertexId vertex) const
  {
    bool isUsual = true;
    for (int axis = 0; axis < 2; ++axis)
    {
      const std::int64_t i = std::int64_t(2) * vertex + axis;
      const Real target = this->GetTarget(vertex, axis);
      this->Before[i] = this->Now[i];
      this->Now[i] = target;
      isUsual = isUsual && IsUsual(target);
    }
    this->HalvingsOf[vertex] = WholeStep;
    return isUsual;
  }

  /// Moves a vertex as far as its halvings say.
  DELAUNAYFLIP_HOST_DEVICE void Step(VertexId vertex) const
  {
    const std::uint8_t halvings = this->HalvingsOf[vertex];
    const double share = 1.0 / static_cast<double>(std::uint32_t(1) << halvings);
    for (int axis = 0; axis < 2; ++axis)
    {
      const std::int64_t i = std::int64_t(2) * vertex + axis;
      const double before = this->Before[i];
      double place = before;
      if (halvings < NoStep)
      {
        place += (static_cast<double>(this->GetTarget(vertex, axis)) - before) * share;
      }
      this->Now[i] = static_cast<Real>(place);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsAtTarget(VertexId vertex) const
  {
    return this->Before[std::int64_t(2) * vertex] == this->GetTarget(vertex, 0) &&
      this->Before[std::int64_t(2) * vertex + 1] == this->GetTarget(vertex, 1);
  }

  /// Makes room for an element in a list. @returns its index.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Append(MotionList list) const
  {
    return AtomicAdd(&this->Counts[static_cast<int>(list)], 1u);
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsInverted(TriangleId triangle) const
  {
    const VertexId* v = this->Mesh.Edges.Triangles[triangle].Vertices;
    return this->Mesh.FindOrientation(v[0], v[1], v[2]) <= 0;
  }
  DELAUNAYFLIP_HOST_DEVICE void AppendInverted(TriangleId triangle, TriangleId* list) const
  {
    const std::uint32_t place = this->Append(MotionList::Inverted);
    if (place < this->MostInverted)
    {
      list[place] = triangle;
    }
  }

  /// Calls visit(corner) for all corners of the vertex that has the corner `first`.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void ForStar(CornerId first, const Visit& visit) const
  {
    visit(first);
    CornerId corner = this->Mesh.FindNextAround(first);
    for (; corner != NoCorner && corner != first; corner = this->Mesh.FindNextAround(corner))
    {
      visit(corner);
    }
    if (corner == NoCorner) // the vertex is on the boundary
    {
      corner = this->Mesh.FindPreviousAround(first);
      for (; corner != NoCorner; corner = this->Mesh.FindPreviousAround(corner))
      {
        visit(corner);
      }
    }
  }

  /// Makes the edges of a triangle candidates.
  DELAUNAYFLIP_HOST_DEVICE void JudgeEdges(TriangleId triangle) const
  {
    for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
    {
      EdgeState* state = &this->Mesh.Edges.States[EdgeOf(side)];
      if (AtomicLoad(state) != EdgeState::Fixed)
      {
        AtomicStore(state, EdgeState::Candidate);
      }
    }
  }
};

/// Finds the triangles that are not counter-clockwise.
template <typename Real>
struct FindInverted
{
  MotionView<Real> Motion;
  TriangleId* List;

  void Prefetch(std::int64_t triangle) const
  {
    for (const VertexId vertex : this->Motion.Mesh.Edges.Triangles[triangle].Vertices)
    {
      delaunayflip::Prefetch(this->Motion.Now + std::int64_t(2) * vertex);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t triangle) const
  {
    const VertexId* v = this->Motion.Mesh.Edges.Triangles[triangle].Vertices;
    const PlanePoint a = this->Get(v[0]), b = this->Get(v[1]), c = this->Get(v[2]);
    // All coordinates are in the range of the filter.
    if (FilteredOrientation(a, b, c) != 1 &&
      this->Motion.IsInverted(static_cast<TriangleId>(triangle)))
    {
      this->Motion.AppendInverted(static_cast<TriangleId>(triangle), this->List);
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE PlanePoint Get(VertexId vertex) const
  {
    const Real* place = this->Motion.Now + std::int64_t(2) * vertex;
    return { place[0], place[1], 0.0 };
  }
};

/// A mesh whose vertices move.
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
  explicit PointMotion(const Backend& backend)
    : Device(backend),
      Hull(backend)
  {
  }

  /// Begins a motion. The mesh must be Delaunay.
  /// @param targets by point, in the memory of the backend.
  void Begin(const MovingMesh<Real>& mesh, const PlaneArray& targets)
  {
    this->Targets = targets;
    this->Rounds = 0;
    this->Allowance = mesh.Vertices / 4 + Fewest;
    this->MostInverted =
      static_cast<std::uint32_t>(mesh.Edges.NumberOfTriangles / MostShare + Fewest);
    this->MakeRoom(mesh);
    this->RequireHull(mesh);
  }

  /// Removes points. Edges that have to be judged become candidates.
  /// @param ids the mesh's own, which change.
  /// @param removed the ids of these points, ascending, in the memory of the backend.
  /// @returns false if all points have to be triangulated anew.
  /// @throws BeyondDevice.
  bool Remove(const MovingMesh<Real>& mesh, VertexId* ids, const Array<VertexId>& removed)
  {
    Reserve(this->Failed, 0, 1, this->Device);
    this->ResetFailed();
    this->RequireHull(mesh);
    const bool isDone =
      this->Hull.Remove(mesh.Edges, this->ViewPlane(mesh), mesh.Coordinates, ids, removed);
    MovingMesh<Real> left = mesh;
    left.Vertices -= static_cast<std::int64_t>(removed.Size());
    const bool isConvex = isDone && this->Hull.IsConvex(this->ViewPlane(left));
    this->CheckFailed();
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
    ++this->Rounds;
    this->ResetFailed();
    const bool moved = this->Rounds == 1 ? this->StartAll(mesh) : this->StartLate(mesh);
    this->ChangedHull = moved && this->Hull.CutOff(mesh.Edges, this->ViewPlane(mesh));
    if (!moved || this->Hull.HasFailed())
    {
      return false;
    }
    const bool all = this->Rounds == 1;
    if (this->ChangedHull && !all)
    {
      this->FindCornersAgain(mesh);
    }
    this->SetCounts(0, 0, 0);
    this->FindAllInverted(mesh, all);
    if (!this->Halve(mesh))
    {
      return false;
    }
    this->ChangedHull |= this->Hull.FillUp(mesh.Edges, this->ViewPlane(mesh));
    if (this->Hull.HasFailed() || !this->Hull.IsConvex(this->ViewPlane(mesh)))
    {
      return false;
    }
    this->ChooseCandidates(mesh, all);
    this->KeepLate(mesh);
    this->CheckFailed();
    return this->Rounds < MostRounds && this->CountLate() <= this->Allowance;
  }

  /// Whether the mesh has more or fewer edges after the last round.
  bool HasChangedHull() const { return this->ChangedHull; }
  std::int64_t CountLate() const { return this->NumberOfLate; }
  std::int64_t CountRounds() const { return this->Rounds; }

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

  /// Moves all vertices to their targets. @returns whether the coordinates of all targets are
  /// usual.
  bool StartAll(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    const std::int64_t unusual = this->Device.template Sum<std::int64_t>(mesh.Vertices,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
      { sum += motion.Start(static_cast<VertexId>(i)) ? 0 : 1; });
    return unusual == 0;
  }

  /// Moves the late vertices to their targets.
  bool StartLate(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    LateVertex* late = this->Late.Data();
    const std::int64_t count = this->NumberOfLate;
    const auto triangles = static_cast<TriangleId>(mesh.Edges.NumberOfTriangles);
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const VertexId vertex = late[i].Vertex;
        TriangleId start = TriangleOf(late[i].Corner);
        start = start < triangles ? start : 0;
        const FoundPlace found = WalkToPlace(motion.Mesh, motion.Mesh.GetPoint(vertex), start);
        const int slot = found.IsOutside() ? -1 : found.FindVertexSlot();
        if (slot >= 0)
        {
          late[i].Corner = MakeCorner(found.Triangle, slot);
        }
        else // a device could not decide
        {
          *motion.Mesh.Failed = 1;
        }
      });
    this->CheckFailed();
    this->Device.ForEach(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { motion.Start(late[i].Vertex); });
    return true;
  }

  /// Finds the corners of late vertices again after triangles were cut off and others have taken
  /// their numbers.
  void FindCornersAgain(const MovingMesh<Real>& mesh)
  {
    const HullView hull = this->Hull.View(this->ViewPlane(mesh));
    LateVertex* late = this->Late.Data();
    this->Device.ForEach(this->NumberOfLate,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { late[i].Corner = hull.FindCorner(late[i].Vertex, late[i].Corner); });
  }

  /// Lists the triangles that are not counter-clockwise.
  /// @param all whether to look at all triangles, instead of those around late vertices.
  void FindAllInverted(const MovingMesh<Real>& mesh, bool all)
  {
    const MotionView<Real> motion = this->View(mesh);
    TriangleId* list = this->Inverted.Data();
    if (all)
    {
      this->Device.ForEach(mesh.Edges.NumberOfTriangles, FindInverted<Real>{ motion, list });
      return;
    }
    ++this->Stamp;
    this->CheckStars(motion, this->Late.Data(), this->NumberOfLate, list);
  }

  /// Lists the inverted triangles around vertices, each once.
  void CheckStars(const MotionView<Real>& motion, const LateVertex* corners, std::int64_t count,
    TriangleId* list) const
  {
    const std::uint32_t stamp = this->Stamp;
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        motion.ForStar(corners[i].Corner,
          [&](CornerId corner)
          {
            const TriangleId triangle = TriangleOf(corner);
            if (motion.IsInverted(triangle) &&
              AtomicExchange(&motion.TriangleMarks[triangle], stamp) != stamp)
            {
              motion.AppendInverted(triangle, list);
            }
          });
      });
  }

  /// Halves the steps of vertices until no triangle is inverted.
  /// @returns false if too many triangles are inverted, or too many passes are needed.
  bool Halve(const MovingMesh<Real>& mesh)
  {
    const MotionView<Real> motion = this->View(mesh);
    std::int64_t late = 0;
    for (int pass = 0;; ++pass)
    {
      std::uint32_t counts[NumberOfLists];
      this->Device.Download(this->Counts.Data(), NumberOfLists, counts);
      const std::int64_t inverted = counts[static_cast<int>(MotionList::Inverted)];
      late = counts[static_cast<int>(MotionList::Late)];
      if (inverted > this->MostInverted || late > motion.MostLate || pass > MostPasses)
      {
        return false;
      }
      if (inverted == 0)
      {
        break;
      }
      this->HalvePass(motion, inverted);
    }
    this->NumberOfNext = late;
    return true;
  }

  /// Halves the steps of the vertices of listed triangles, and lists those that are inverted then.
  void HalvePass(const MotionView<Real>& motion, std::int64_t inverted)
  {
    const std::uint32_t stamp = ++this->Stamp;
    const TriangleId* list = this->Inverted.Data();
    LateVertex* changed = this->Changed.Data();
    LateVertex* next = this->Next.Data();
    this->Device.ForEach(inverted,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          const VertexId vertex = motion.Mesh.Edges.Triangles[list[i]].Vertices[slot];
          const bool isMine = motion.HalvingsOf[vertex] < NoStep &&
            AtomicExchange(&motion.VertexMarks[vertex], stamp) != stamp;
          if (!isMine)
          {
            continue;
          }
          const LateVertex late{ vertex, MakeCorner(list[i], slot) };
          motion.HalvingsOf[vertex] = static_cast<std::uint8_t>(motion.HalvingsOf[vertex] + 1);
          motion.Step(vertex);
          changed[motion.Append(MotionList::Changed)] = late;
          if (motion.HalvingsOf[vertex] == 1 && !motion.IsAtTarget(vertex))
          {
            const std::uint32_t place = motion.Append(MotionList::Late);
            if (place < motion.MostLate)
            {
              next[place] = late;
            }
          }
        }
      });
    std::uint32_t counts[NumberOfLists];
    this->Device.Download(this->Counts.Data(), NumberOfLists, counts);
    this->SetCounts(0, 0, counts[static_cast<int>(MotionList::Late)]);
    this->CheckStars(
      motion, changed, counts[static_cast<int>(MotionList::Changed)], this->Inverted.Data());
  }

  /// Makes edges candidates if a vertex of their two triangles has moved.
  void ChooseCandidates(const MovingMesh<Real>& mesh, bool all)
  {
    const MotionView<Real> motion = this->View(mesh);
    EdgeState* states = mesh.Edges.States.Data();
    if (all)
    {
      this->Device.ForEach(mesh.Edges.NumberOfEdges,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t edge)
        {
          const bool isFixed = states[edge] == EdgeState::Fixed;
          states[edge] = isFixed ? EdgeState::Fixed : EdgeState::Candidate;
        });
      return;
    }
    const LateVertex* late = this->Late.Data();
    this->Device.ForEach(this->NumberOfLate,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        motion.ForStar(
          late[i].Corner, [&](CornerId corner) { motion.JudgeEdges(TriangleOf(corner)); });
      });
  }

  /// Keeps the vertices that are not at their targets for the next round.
  void KeepLate(const MovingMesh<Real>& mesh)
  {
    std::uint8_t* halvings = this->HalvingsOf.Data();
    if (this->Rounds == 1 && this->NumberOfNext > 0)
    {
      this->Device.ForEach(
        mesh.Vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { halvings[i] = AtTarget; });
    }
    const LateVertex* late = this->Late.Data();
    this->Device.ForEach(this->Rounds == 1 ? 0 : this->NumberOfLate,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { halvings[late[i].Vertex] = AtTarget; });
    std::swap(this->Late, this->Next);
    this->NumberOfLate = this->NumberOfNext;
  }

private:
  static constexpr int NumberOfLists = static_cast<int>(MotionList::Count);
  static constexpr std::int64_t Fewest = 64;
  /// If more than one triangle in 64 is inverted, triangulating anew takes less time.
  static constexpr std::int64_t MostShare = 64;
  static constexpr std::int64_t MostRounds = 48;
  static constexpr int MostPasses = 256;

  PlaneMesh ViewPlane(const MovingMesh<Real>& mesh)
  {
    PlaneMesh plane{ mesh.Edges.View(), PlaneArray(mesh.Coordinates, mesh.Vertices, 2), true };
    plane.Failed = this->Failed.Data();
    return plane;
  }

  MotionView<Real> View(const MovingMesh<Real>& mesh)
  {
    return { this->ViewPlane(mesh), mesh.Coordinates, this->Before.Data(), this->Targets, mesh.Ids,
      this->HalvingsOf.Data(), this->VertexMarks.Data(), this->TriangleMarks.Data(),
      this->Counts.Data(), this->MostInverted, 4 * this->MostInverted };
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
    Reserve(this->Counts, 0, NumberOfLists, device);
    Reserve(this->Failed, 0, 1, device);
    // A triangulation has fewer than two triangles per vertex, whatever its boundary.
    const std::int64_t triangles = 2 * mesh.Vertices;
    constexpr std::uint32_t LastStamp = 1u << 31;
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
  void SetCounts(std::uint32_t inverted, std::uint32_t changed, std::uint32_t late)
  {
    const std::uint32_t counts[NumberOfLists] = { inverted, changed, late };
    this->Device.Upload(counts, NumberOfLists, this->Counts.Data());
  }

  void ResetFailed()
  {
    const std::int32_t none = 0;
    this->Device.Upload(&none, 1, this->Failed.Data());
  }
  void CheckFailed() const
  {
    std::int32_t hasFailed = 0;
    this->Device.Download(this->Failed.Data(), 1, &hasFailed);
    if (hasFailed != 0)
    {
      throw BeyondDevice();
    }
  }

  const Backend& Device;
  HullBoundary<Backend> Hull;
  PlaneArray Targets;
  Array<Real> Before;
  Array<std::uint8_t> HalvingsOf;
  Array<std::uint32_t> VertexMarks, TriangleMarks, Counts;
  Array<std::int32_t> Failed;
  Array<TriangleId> Inverted;
  Array<LateVertex> Changed; ///< Vertices whose steps have changed since triangles were checked.
  Array<LateVertex> Late; ///< Vertices that this round moves, if it is not the first.
  Array<LateVertex> Next; ///< Vertices that the next round moves.
  std::int64_t NumberOfLate = 0, NumberOfNext = 0;
  std::int64_t Rounds = 0;
  std::int64_t Allowance = 0;
  std::uint32_t MostInverted = 0;
  std::uint32_t Stamp = 0;
  bool ChangedHull = false;
  /// The sizes of the mesh whose boundary is known.
  std::int64_t KnownTriangles = -1, KnownEdges = -1, KnownVertices = -1;
};

}

#endif
