// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSurvey.h"

#include "EdgeMeshBuilder.h"
#include "ExactPredicates.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshSurveyBuilder.h"
#include "PartMesh.h"
#include "PlanarSurvey.h"
#include "SubMesh.h"
#include "SurfaceAngles.h"
#include "TriangleAngles.h"

#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace delaunayflip
{

namespace
{
/// A backend that adds up sums over all ranks, so that a survey decides alike on all of them.
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
  std::int64_t Point; ///< Its id on the rank that owns its key.
  std::uint32_t Sum;
};

/// GeometryChoice.h calls this overload instead of the one that does nothing. The total of every
/// point goes to the rank that owns its key, and 0 to the others.
void JoinPointSums(const GroupBackend& backend, std::uint32_t* sums)
{
  const PointKeys& keys = backend.Keys;
  RecordLists<PointSum> toOwner(backend.Group.GetSize());
  for (std::size_t i = 0; i < keys.Keys.size(); ++i)
  {
    if (keys.Shared[i])
    {
      const PieceOrigin owner = keys.Owners.Find(keys.Keys[i]);
      toOwner[owner.Rank].push_back({ owner.Id, std::exchange(sums[i], 0u) });
    }
  }
  for (const PointSum& one : Join(ExchangeRecords(backend.Group, toOwner)))
  {
    sums[one.Point] += one.Sum;
  }
}

std::string Write(GeometryKind geometry) { return ToString(geometry); }

std::string Write(CriterionKind criterion)
{
  return criterion == CriterionKind::InCircle ? "in-circle" : "opposite-angles";
}

std::string Write(TieRuleKind rule) { return rule == TieRuleKind::Keep ? "keep" : "canonical"; }

std::string Write(std::int64_t value) { return std::to_string(value); }

std::string Write(bool value) { return value ? "on" : "off"; }

std::string Write(double value)
{
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10) << value;
  return text.str();
}
}

void RequireSameOptions(const FlipOptions& options, PieceGroup& group,
  const std::vector<std::pair<std::string, std::string>>& more)
{
  std::vector<std::pair<std::string, std::string>> all;
  const auto add = [&all](const char* name, auto isForAll, const auto& option)
  {
    if constexpr (decltype(isForAll)::value)
    {
      all.emplace_back(ToCamelCase(name), Write(option));
    }
  };
  ForEachOption(add, options);
  all.insert(all.end(), more.begin(), more.end());
  Message own;
  for (const auto& option : all)
  {
    Put(own, option.second);
  }
  std::vector<MessageReader> ranks;
  for (Message& message : group.Gather(own))
  {
    ranks.emplace_back(std::move(message));
  }
  for (const auto& option : all)
  {
    const auto first = ranks[0].Get<std::string>();
    for (std::size_t rank = 1; rank < ranks.size(); ++rank)
    {
      const auto value = ranks[rank].Get<std::string>();
      if (value != first)
      {
        throw InvalidOptions(option.first + " is '" + first + "' on rank 0, but '" + value +
          "' on rank " + std::to_string(rank) + "; set it to the same on all ranks");
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
      RefuseRefinement(options, piece.Mesh, "a mesh in several pieces");
      CheckMeshSize(piece.Mesh.Triangles.Count, piece.Mesh.Points.Count,
        "on one rank; divide the mesh among more ranks");
      if (piece.Mesh.Points.Count > std::numeric_limits<std::int32_t>::max())
      {
        throw MeshTooLarge("a piece has more than 2^31 points: divide the mesh among more ranks");
      }
      CheckConstraints(piece.Mesh);
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
  RefuseParts(found.Geometry);
  const bool hasDoubles = mesh.Points.Count > 0 && !mesh.Points.Floats;
  PartSurvey survey(std::move(found), !IsOnAnyRank(group, hasDoubles));
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
/// The place of a corner in the plane.
PlanePoint GetPlace(
  const TriangleMesh& mesh, const PlaneProjection& plane, std::int64_t triangle, int slot)
{
  PlanePoint place = plane.Project(mesh.Points, mesh.Triangles.Get(triangle, slot));
  place.W = 0.0;
  return place;
}

/// Adds the orientation of a triangle, and counts its corners at closed points that cover the
/// direction +u. The triangles around a closed point go around it a whole number of times. If its
/// star is simple, +u is covered once.
struct StarSum
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

  void operator()(std::int64_t t, PlaneSums& sums) const
  {
    PlanePoint p[3];
    bool isFinite = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      p[slot] = GetPlace(this->Mesh, this->Plane, t, slot);
      isFinite = isFinite && IsFinite(p[slot]);
    }
    const int side = isFinite ? FindOrientation(p[0], p[1], p[2]) : 0;
    sums.Orientations.Note(side, t);
    // Whether the three edges go up, as bits.
    const auto goesUp = [&](int from, int to) { return int(StarSurvey::IsUpper(p[from], p[to])); };
    const int up = goesUp(0, 1) | goesUp(1, 2) << 1 | goesUp(2, 0) << 2;
    // Where the corner of a counter-clockwise triangle covers +u, the edges to it and from it go
    // down. Those of a clockwise one go up. Tables take the place of branches, which would be
    // mispredicted half of the time.
    constexpr int Corner[8] = { 0, 2, 0, 1, 1, 0, 2, 0 };
    constexpr int IsOneUp = 0b00010110, IsTwoUp = 0b01101000;
    const int covers = ((side > 0 ? IsOneUp : IsTwoUp) >> up) & 1;
    sums.Covers += covers & this->Closed[this->Mesh.Triangles.Get(t, Corner[up])];
  }
};

/// A corner with its sides in counterclockwise order, at a point that is shared or that triangles
/// do not surround.
struct Wedge
{
  std::int64_t Key; ///< The point's key.
  PlanePoint Apex, First, Last;

  bool IsAt(const Wedge& other) const
  {
    return this->Apex.U == other.Apex.U && this->Apex.V == other.Apex.V;
  }
  /// Whether the direction to a place lies in the wedge. First is in the wedge, Last is not.
  bool Covers(const PlanePoint& place) const
  {
    const int afterFirst = FindOrientation(this->Apex, this->First, place);
    if (afterFirst == 0)
    {
      return StarSurvey::IsUpper(this->Apex, this->First) == StarSurvey::IsUpper(this->Apex, place);
    }
    return afterFirst > 0 && FindOrientation(this->Apex, place, this->Last) > 0;
  }
  /// The order of wedges around a point, by their first directions.
  bool IsBefore(const Wedge& other) const
  {
    const bool isUpper = StarSurvey::IsUpper(this->Apex, this->First);
    if (isUpper != StarSurvey::IsUpper(this->Apex, other.First))
    {
      return isUpper;
    }
    return FindOrientation(this->Apex, this->First, other.First) > 0;
  }
};

/// The wedges of a rank: at shared points for the homes of these, the others for this rank.
/// @param survey has the orientation of all triangles.
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
      const auto place = [&](int corner) { return GetPlace(mesh, survey.Projection, t, corner); };
      const Wedge wedge{ keys.Keys[point], place(slot), place(first), place(3 - slot - first) };
      const bool isShared = keys.Shared[point] != 0;
      const int home = isShared ? GetHome(ScatterBits(wedge.Key), group) : group.GetRank();
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
  PlaneSums sums = threads.Sum<PlaneSums>(
    mesh.Triangles.Count, StarSum{ mesh, survey.Projection, keys.Closed.data() });
  sums.Covers -= std::count(keys.Closed.begin(), keys.Closed.end(), 1);
  sums = SumOverRanks(group, sums);
  whole.Side = sums.Orientations.GetSide() < 0 ? -1 : 1;
  whole.StarsAreSimple = false;
  if (sums.Orientations.CountStrays() != 0 || sums.Covers != 0)
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
  whole.StarsAreSimple = !IsOnAnyRank(group, !areApart);
}

}
