// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSurvey.h"

#include "Atomics.h"
#include "EdgeMeshBuilder.h"
#include "ExactPredicates.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshSurveyBuilder.h"
#include "PlanarSurvey.h"
#include "SubMesh.h"
#include "SurfaceAngles.h"
#include "TriangleAngles.h"

#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Threads whose sums are those of all ranks, so that a survey decides alike on all of them.
class GroupBackend : public ThreadBackend
{
public:
  GroupBackend(int threads, const PointKeys& keys, PieceGroup& group)
    : ThreadBackend(threads),
      Keys(keys),
      Group(group)
  {
  }

  template <typename Result, typename Work>
  Result Sum(std::int64_t size, const Work& work) const
  {
    return SumOverRanks(this->Group, this->ThreadBackend::Sum<Result>(size, work));
  }

  const PointKeys& Keys;
  PieceGroup& Group;
};

/// The sum of a rank at a shared point.
struct PointSum
{
  std::int64_t Key;
  std::uint32_t Sum;
};

/// Found in GeometryChoice.h instead of the function that does nothing. The total of every point
/// goes to the first rank that has it, and 0 to the others.
void JoinPointSums(const GroupBackend& backend, std::uint32_t* sums)
{
  const PointKeys& keys = backend.Keys;
  RecordLists<PointSum> toHome(backend.Group.GetSize());
  RecordLists<std::int64_t> points(backend.Group.GetSize()); // in the order of what is sent
  for (std::size_t i = 0; i < keys.Keys.size(); ++i)
  {
    if (keys.Shared[i])
    {
      const int home = GetHome(ScatterBits(keys.Keys[i]), backend.Group);
      toHome[home].push_back({ keys.Keys[i], sums[i] });
      points[home].push_back(static_cast<std::int64_t>(i));
    }
  }
  const RecordLists<PointSum> lists = ExchangeRecords(backend.Group, toHome);
  RecordLists<std::uint32_t> totals(lists.size()); // in the same orders
  std::unordered_map<std::int64_t, std::uint32_t*> totalOf; // never iterated over
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    totals[rank].resize(lists[rank].size());
    for (std::size_t i = 0; i < lists[rank].size(); ++i)
    {
      *totalOf.emplace(lists[rank][i].Key, &totals[rank][i]).first->second += lists[rank][i].Sum;
    }
  }
  totals = ExchangeRecords(backend.Group, totals);
  for (std::size_t home = 0; home < totals.size(); ++home)
  {
    for (std::size_t i = 0; i < points[home].size(); ++i)
    {
      sums[points[home][i]] = totals[home][i];
    }
  }
}

}

void CheckParts(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group)
{
  DoTogether(group,
    [&]()
    {
      CheckOptions(options);
      CheckMeshSize(piece.Mesh.Triangles.Count, piece.Mesh.Points.Count,
        "on one rank; divide the mesh among more ranks");
      if (piece.Mesh.Points.Count > std::numeric_limits<std::int32_t>::max())
      {
        throw MeshTooLarge("a piece has more than 2^31 points: divide the mesh among more ranks");
      }
      for (std::int64_t i = 0; i < 2 * piece.Mesh.NumberOfConstraintEdges; ++i)
      {
        CheckConstraint(piece.Mesh, i / 2, static_cast<int>(i % 2));
      }
      RequireValidIds(piece.Mesh);
    });
}

PartSurvey::PartSurvey(MeshSurvey found, bool isFloat)
  : MeshSurvey(std::move(found)),
    IsFloat(isFloat)
{
  this->Uses = Array<PointUse>();
  this->Precision = isFloat ? FloatPrecision : DoublePrecision;
  if (this->Geometry == GeometryKind::Planar)
  {
    this->Whole.PlaneAxis = this->Projection.AxisW;
    this->Whole.PlaneIsTilted = this->Projection.Tilted;
  }
}

std::vector<Defect> PartSurvey::ListDefects() const
{
  std::vector<Defect> defects;
  AddDefect(this->RepeatedIds, defects);
  AddDefect(this->NonFinitePoints, defects);
  AddDefect(this->NearlyHeightField, defects);
  return defects;
}

PartSurvey SurveyParts(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group)
{
  const GroupBackend backend(options.NumberOfThreads, keys, group);
  const TriangleMesh& mesh = piece.Mesh;
  MeshSurvey found; // ids are valid, and it is known which points are used
  found.Uses = backend.MakeArray<PointUse>(mesh.Points.Count);
  std::transform(keys.Used.begin(), keys.Used.end(), found.Uses.Data(),
    [](unsigned char isUsed) { return isUsed != 0 ? PointUse::Used : PointUse::Unused; });
  SurveyPointsAndGeometry(found, MeshInput{ mesh, mesh }, options.Geometry, backend);
  CheckTieRule(options, found.Geometry);
  const std::int64_t doubles = mesh.Points.Count > 0 && !mesh.Points.Floats ? 1 : 0;
  PartSurvey survey(std::move(found), SumOverRanks(group, doubles) == 0);
  survey.NearlyHeightField.FirstIds.clear(); // of other ranks
  if (survey.Geometry != GeometryKind::Surface)
  {
    SurveyStars(mesh, keys, backend, group, survey);
  }
  return survey;
}

//------------------------------------------------------------------------------
namespace
{
/// The orientations of triangles in the plane, and a measure of the stars of points.
struct StarTurns
{
  std::int64_t Left = 0, Right = 0, None = 0; ///< Triangles that turn left, right, or have no area.
  /// How many corners at closed points cover the direction +u. The triangles around a closed point
  /// turn around it a whole number of times. If its star is simple, +u is covered once.
  std::int64_t Covers = 0;

  StarTurns& operator+=(const StarTurns& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->None += part.None;
    this->Covers += part.Covers;
    return *this;
  }
};

struct StarTurnStep
{
  const TriangleMesh& Mesh;
  const PlaneProjection& Plane;
  const unsigned char* Closed;

  void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Mesh.Points.Prefetch(this->Mesh.Triangles.Get(t, slot));
    }
  }

  void operator()(std::int64_t t, StarTurns& sums) const
  {
    PlanePoint p[3];
    bool isFinite = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      p[slot] = this->Plane.Project(this->Mesh.Points, this->Mesh.Triangles.Get(t, slot));
      p[slot].W = 0.0;
      isFinite = isFinite && IsFinite(p[slot]);
    }
    const int side = isFinite ? FindOrientation(p[0], p[1], p[2]) : 0;
    sums.Left += side > 0 ? 1 : 0;
    sums.Right += side < 0 ? 1 : 0;
    sums.None += side == 0 ? 1 : 0;
    const int up = (StarSurvey::IsUpper(p[0], p[1]) ? 1 : 0) |
      (StarSurvey::IsUpper(p[1], p[2]) ? 2 : 0) | (StarSurvey::IsUpper(p[2], p[0]) ? 4 : 0);
    // Where a left turn covers +u, the edges to and from the corner go down; a right turn, up. No
    // branches, which would be mispredicted half of the time.
    constexpr int Corner[8] = { 0, 2, 0, 1, 1, 0, 2, 0 };
    constexpr int IsOneUp = 0b00010110, IsTwoUp = 0b01101000;
    const int covers = ((side > 0 ? IsOneUp : IsTwoUp) >> up) & 1;
    sums.Covers += covers & this->Closed[this->Mesh.Triangles.Get(t, Corner[up])];
  }
};

/// A corner with its sides in counterclockwise order, at a point that is shared or whose triangles
/// do not close around it.
struct Wedge
{
  std::int64_t Key; ///< Of the point.
  PlanePoint Apex, First, Last;

  bool IsAt(const Wedge& other) const
  {
    return this->Apex.U == other.Apex.U && this->Apex.V == other.Apex.V;
  }
  /// Whether the direction to a place lies in the wedge. That to First does, that to Last does not.
  bool Covers(const PlanePoint& place) const
  {
    const int afterFirst = FindOrientation(this->Apex, this->First, place);
    return afterFirst == 0
      ? StarSurvey::IsUpper(this->Apex, this->First) == StarSurvey::IsUpper(this->Apex, place)
      : afterFirst > 0 && FindOrientation(this->Apex, place, this->Last) > 0;
  }
  /// The order of wedges around a point, by their first directions.
  bool IsBefore(const Wedge& other) const
  {
    const bool isUpper = StarSurvey::IsUpper(this->Apex, this->First);
    return isUpper == StarSurvey::IsUpper(this->Apex, other.First)
      ? FindOrientation(this->Apex, this->First, other.First) > 0
      : isUpper;
  }
};

/// The wedges of a rank: at shared points for the homes of these, the others for this rank.
/// @param survey has the side to which all triangles turn.
RecordLists<Wedge> ListWedges(const TriangleMesh& mesh, const PartSurvey& survey,
  const PointKeys& keys, const ThreadBackend& threads, const PieceGroup& group)
{
  RecordLists<Wedge> toHome(group.GetSize());
  const auto isAtOpenPoint = [&](std::int64_t t)
  {
    return !keys.Closed[mesh.Triangles.Get(t, 0)] || !keys.Closed[mesh.Triangles.Get(t, 1)] ||
      !keys.Closed[mesh.Triangles.Get(t, 2)];
  };
  for (const std::int64_t t : ListNumbers(mesh.Triangles.Count, isAtOpenPoint, threads))
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t point = mesh.Triangles.Get(t, slot);
      if (keys.Closed[point])
      {
        continue;
      }
      const int first = (slot + (survey.Whole.Side > 0 ? 1 : 2)) % 3;
      const auto place = [&](int corner)
      {
        PlanePoint p = survey.Projection.Project(mesh.Points, mesh.Triangles.Get(t, corner));
        p.W = 0.0;
        return p;
      };
      const Wedge wedge{ keys.Keys[point], place(slot), place(first), place(3 - slot - first) };
      const int home =
        keys.Shared[point] ? GetHome(ScatterBits(wedge.Key), group) : group.GetRank();
      toHome[home].push_back(wedge);
    }
  }
  return toHome;
}

/// Whether the wedges at a point cover no direction twice, and ranks agree about its coordinates.
bool AreApart(Wedge* begin, Wedge* end)
{
  if (!std::all_of(begin, end, [&](const Wedge& wedge) { return wedge.IsAt(*begin); }))
  {
    return false;
  }
  std::sort(begin, end, [](const Wedge& a, const Wedge& b) { return a.IsBefore(b); });
  // A wedge that covers the first direction of any other also covers that of the next.
  for (const Wedge* one = begin; one + 1 < end; ++one)
  {
    if (one->Covers(one[1].First))
    {
      return false;
    }
  }
  return end - begin < 2 || !end[-1].Covers(begin->First);
}
}

void SurveyStars(const TriangleMesh& mesh, const PointKeys& keys, const ThreadBackend& threads,
  PieceGroup& group, PartSurvey& survey)
{
  WholeMesh& whole = survey.Whole;
  StarTurns turns = threads.Sum<StarTurns>(
    mesh.Triangles.Count, StarTurnStep{ mesh, survey.Projection, keys.Closed.data() });
  turns.Covers -= std::count(keys.Closed.begin(), keys.Closed.end(), 1);
  turns = SumOverRanks(group, turns);
  whole.Side = turns.Left >= turns.Right ? 1 : -1;
  whole.StarsAreSimple = false;
  if (turns.None != 0 || (turns.Left != 0 && turns.Right != 0) || turns.Covers != 0)
  {
    return;
  }
  std::vector<Wedge> wedges =
    Join(ExchangeRecords(group, ListWedges(mesh, survey, keys, threads, group)));
  std::sort(
    wedges.begin(), wedges.end(), [](const Wedge& a, const Wedge& b) { return a.Key < b.Key; });
  bool areApart = true;
  ForEachRun(
    wedges, [](const Wedge& a, const Wedge& b) { return a.Key == b.Key; },
    [&](Wedge* begin, Wedge* end) { areApart = areApart && AreApart(begin, end); });
  whole.StarsAreSimple = SumOverRanks(group, std::int64_t(areApart ? 0 : 1)) == 0;
}

Array<std::uint64_t> SumFans(
  const TriangleMesh& mesh, const ThreadBackend& threads, unsigned char* used)
{
  Array<std::uint64_t> fans = threads.MakeArray<std::uint64_t>(mesh.Points.Count);
  threads.ForEach(mesh.Points.Count, [&](std::int64_t i) { fans[i] = 0; });
  threads.ForEach(mesh.Triangles.Count,
    [&](std::int64_t t)
    {
      std::int64_t ids[3];
      std::uint64_t bits[3];
      for (int slot = 0; slot < 3; ++slot)
      {
        ids[slot] = mesh.Triangles.Get(t, slot);
        bits[slot] = ScatterBits(ids[slot]);
      }
      for (int slot = 0; slot < 3; ++slot)
      {
        // Around a closed fan every neighbour is the next one once, and once the previous one.
        __atomic_fetch_add(
          &fans[ids[slot]], bits[(slot + 1) % 3] - bits[(slot + 2) % 3], __ATOMIC_RELAXED);
        AtomicStore<unsigned char>(&used[ids[slot]], 1);
      }
    });
  return fans;
}

void SurveyStars(const TriangleMesh& mesh, const ThreadBackend& threads, PartSurvey& survey)
{
  PointKeys keys; // none is shared
  keys.Closed.resize(mesh.Points.Count);
  {
    const Array<std::uint64_t> fans = SumFans(mesh, threads, keys.Closed.data());
    threads.ForEach(mesh.Points.Count,
      [&](std::int64_t i) { keys.Closed[i] = fans[i] == 0 ? keys.Closed[i] : 0; });
  }
  keys.Shared.resize(mesh.Points.Count);
  keys.Keys.resize(mesh.Points.Count);
  std::iota(keys.Keys.begin(), keys.Keys.end(), 0);
  SurveyStars(mesh, keys, threads, *MakeSingleGroup(), survey);
}

}
