// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSurvey.h"

#include "Atomics.h"
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

#include <array>

namespace delaunayflip
{

namespace
{
/// The place of a point: its global number, or the bits of its three coordinates. Points of
/// different ranks can be the same point only if their places are equal.
using Place = std::array<std::uint64_t, 3>;

std::uint64_t GetHash(const Place& place)
{
  return ScatterBits(place[0] + ScatterBits(place[1] + ScatterBits(place[2])));
}

bool Holds(const BoundingBox& box, const double (&x)[3])
{
  bool holds = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    holds = holds && box.Lower[axis] <= x[axis] && x[axis] <= box.Upper[axis];
  }
  return holds;
}

/// A point of one rank that another may have, too.
struct Candidate
{
  Place At;
  std::int64_t Key; ///< Its key if it is not shared.
  std::int32_t Rank;
  bool IsUnused; ///< It has no triangles.
  bool IsInside; ///< It has no number and is not at the border of its part.
};

/// What is known of the points of a piece.
class PiecePoints
{
public:
  /// @param haveNumbers whether all pieces that have points give numbers.
  PiecePoints(const MeshPiece& piece, bool haveNumbers, const ThreadBackend& threads)
    : Mesh(piece.Mesh),
      Used(Mesh.Points.Count, 0),
      Numbers(haveNumbers ? piece.PointNumbers : nullptr),
      Fans(threads.MakeArray<std::uint64_t>(Mesh.Points.Count))
  {
    threads.ForEach(this->Mesh.Points.Count, [&](std::int64_t i) { this->Fans[i] = 0; });
    threads.ForEach(this->Mesh.Triangles.Count,
      [&](std::int64_t t)
      {
        std::int64_t ids[3];
        std::uint64_t bits[3];
        for (int slot = 0; slot < 3; ++slot)
        {
          ids[slot] = this->Mesh.Triangles.Get(t, slot);
          bits[slot] = ScatterBits(ids[slot]);
        }
        for (int slot = 0; slot < 3; ++slot)
        {
          // Around a closed fan every neighbour is once the next one and once the previous one.
          __atomic_fetch_add(
            &this->Fans[ids[slot]], bits[(slot + 1) % 3] - bits[(slot + 2) % 3], __ATOMIC_RELAXED);
          AtomicStore<unsigned char>(&this->Used[ids[slot]], 1);
        }
      });
    for (std::int64_t i = 0; i < 2 * this->Mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t end = this->Mesh.ConstraintEdges[i];
      this->Fans[end] = this->Used[end] != 0 ? this->Fans[end] : 1;
    }
  }

  bool HaveNumbers() const { return this->Numbers != nullptr; }
  /// Whether the triangles of a point form a closed fan.
  bool IsClosed(std::int64_t point) const
  {
    return this->Used[point] != 0 && this->Fans[point] == 0;
  }
  /// Whether a point is at the border of the part: its triangles do not form a closed fan, or it
  /// has none and is the end of a constraint. Also true where triangles are not wound consistently.
  bool IsAtBorder(std::int64_t point) const { return this->Fans[point] != 0; }
  /// Whether a point must be matched with points of other ranks: a triangle has it, or it is the
  /// end of a constraint.
  bool IsWanted(std::int64_t point) const
  {
    return this->Used[point] != 0 || this->IsAtBorder(point);
  }

  /// @returns whether the coordinates are numbers.
  bool GetPosition(std::int64_t point, double (&x)[3]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = this->Mesh.Points.Get(point, axis) + 0.0; // -0 becomes 0
    }
    return !std::isnan(x[0]) && !std::isnan(x[1]) && !std::isnan(x[2]);
  }
  /// @returns whether a point has a place: a number, or coordinates without NaN.
  bool FindPlace(std::int64_t point, Place& place) const
  {
    if (this->Numbers)
    {
      place = { static_cast<std::uint64_t>(this->Numbers[point]), 0, 0 };
      return true;
    }
    double x[3];
    const bool isPlace = this->GetPosition(point, x);
    std::memcpy(place.data(), x, sizeof(x));
    return isPlace;
  }

  /// Calls add(candidate) for the wanted points for which isAsked(place) is true or that are at the
  /// border.
  /// @param firstKey of the piece.
  template <typename IsAsked, typename Add>
  void List(std::int64_t firstKey, int rank, const IsAsked& isAsked, const Add& add) const
  {
    for (std::int64_t i = 0; i < this->Mesh.Points.Count; ++i)
    {
      Place place{};
      if (this->IsWanted(i) && this->FindPlace(i, place) && (this->IsAtBorder(i) || isAsked(place)))
      {
        const bool isInside = !this->Numbers && !this->IsAtBorder(i);
        add({ place, firstKey + i, rank, this->Used[i] == 0, isInside });
      }
    }
  }

  const TriangleMesh& Mesh;
  std::vector<unsigned char> Used; ///< One flag per point: whether a triangle has it.

private:
  const std::int64_t* Numbers; ///< One per point, or null.
  /// One number per point: 0 if its triangles form a closed fan, or closed fans, or it has none and
  /// is not the end of a constraint.
  Array<std::uint64_t> Fans;
};

/// Calls visit(same) for the candidates at each place, if several ranks have it and one of them is
/// not inside its part: first those with triangles, then the others; each group by key, hence by
/// rank.
/// @returns how many are not visited because a rank has several at one place.
template <typename Visit>
std::int64_t ForEachShared(std::vector<Candidate> all, const Visit& visit)
{
  const auto order = [](const Candidate& a) { return std::tie(a.At, a.IsUnused, a.Key); };
  std::sort(all.begin(), all.end(),
    [&](const Candidate& a, const Candidate& b) { return order(a) < order(b); });
  std::int64_t ambiguous = 0;
  const auto join = [&](const Candidate* begin, const Candidate* end)
  {
    // Only one point without triangles counts per rank, and none if it has one with triangles.
    std::vector<Candidate> list;
    bool isRepeated = false;
    for (const Candidate* one = begin; one != end; ++one)
    {
      const bool isKnown = std::any_of(
        list.begin(), list.end(), [=](const Candidate& other) { return other.Rank == one->Rank; });
      if (!one->IsUnused || !isKnown)
      {
        list.push_back(*one);
        isRepeated = isRepeated || isKnown;
      }
    }
    if (list.front().Rank == list.back().Rank ||
      std::all_of(list.begin(), list.end(), [](const Candidate& one) { return one.IsInside; }))
    {
      return;
    }
    if (isRepeated)
    {
      ambiguous += SizeOf(list);
      return;
    }
    visit(list);
  };
  ForEachRun(
    all, [](const Candidate& a, const Candidate& b) { return a.At == b.At; }, join);
  return ambiguous;
}

/// Asks the ranks whose box holds a point of this one whether they have it, too: a border point, or
/// any point if points have numbers. It may be inside their part: where three sheets of a
/// non-manifold mesh meet, two may be on one rank; and sheets that lie on each other may have the
/// same points.
/// @returns the hashes of the places, for each rank.
RecordLists<std::uint64_t> AskForPoints(const PiecePoints& points, PieceGroup& group)
{
  if (group.GetSize() == 1)
  {
    return RecordLists<std::uint64_t>(1); // without a pass over all points
  }
  BoundingBox used;
  double x[3];
  for (std::int64_t i = 0; i < points.Mesh.Points.Count; ++i)
  {
    points.GetPosition(i, x);
    for (int axis = 0; axis < 3 && points.Used[i] != 0; ++axis)
    {
      used.Include(axis, x[axis], x[axis]);
    }
  }
  const RecordLists<BoundingBox> boxes = GatherRecords(group, std::vector<BoundingBox>{ used });
  RecordLists<std::uint64_t> questions(boxes.size());
  for (std::int64_t i = 0; i < points.Mesh.Points.Count; ++i)
  {
    Place place{};
    if (!(points.HaveNumbers() ? points.IsWanted(i) : points.IsAtBorder(i)) ||
      !points.FindPlace(i, place))
    {
      continue;
    }
    const bool isSomewhere = points.GetPosition(i, x);
    for (int rank = 0; rank < group.GetSize(); ++rank)
    {
      if (rank != group.GetRank() && (!isSomewhere || Holds(boxes[rank].front(), x)))
      {
        questions[rank].push_back(GetHash(place));
      }
    }
  }
  return questions;
}
}

PointKeys MatchPoints(const MeshPiece& piece, PieceGroup& group, const ThreadBackend& threads)
{
  const std::int64_t count = piece.Mesh.Points.Count;
  const bool lacksNumbers = !piece.PointNumbers && count > 0;
  PiecePoints points(piece, SumOverRanks(group, std::int64_t(lacksNumbers ? 1 : 0)) == 0, threads);
  PointKeys keys;
  keys.Owners = RankNumbers(count, group);
  const std::int64_t first = keys.Owners.Firsts[group.GetRank()];
  std::vector<std::uint64_t> asked = Join(ExchangeRecords(group, AskForPoints(points, group)));
  std::sort(asked.begin(), asked.end());
  RecordLists<Candidate> toHome(group.GetSize());
  points.List(
    first, group.GetRank(), // another place with the same hash is only sent in vain
    [&](const Place& place)
    { return std::binary_search(asked.begin(), asked.end(), GetHash(place)); },
    [&](const Candidate& one) { toHome[GetHome(GetHash(one.At), group)].push_back(one); });
  // Now this rank is the home of places. An answer is the key that the rank has sent, and that of
  // the owner.
  RecordLists<PointPair> answers(group.GetSize());
  keys.UsedPoints = std::count(points.Used.begin(), points.Used.end(), 1);
  keys.Ambiguous = ForEachShared(Join(ExchangeRecords(group, toHome)),
    [&](const std::vector<Candidate>& same)
    {
      const Candidate& owner = same.front();
      for (const Candidate& one : same)
      {
        if (!owner.IsUnused)
        {
          keys.Repeated += one.Key == owner.Key ? 0 : 1;
          keys.UsedPoints -= one.Key == owner.Key || one.IsUnused ? 0 : 1;
          answers[one.Rank].push_back({ one.Key, owner.Key });
        }
      }
    });
  keys.Keys.resize(count);
  keys.Shared.resize(count);
  keys.Closed.resize(count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    keys.Keys[i] = first + i;
    keys.Closed[i] = points.IsClosed(i) ? 1 : 0;
  }
  for (const auto& [own, key] : Join(ExchangeRecords(group, answers)))
  {
    keys.Keys[own - first] = key;
    keys.Shared[own - first] = 1;
    keys.Closed[own - first] = 0;
  }
  for (std::int64_t* sum : { &keys.Repeated, &keys.UsedPoints, &keys.Ambiguous })
  {
    *sum = SumOverRanks(group, *sum);
  }
  keys.Used = std::move(points.Used);
  return keys;
}

JoinedPoints JoinPoints(const std::vector<MeshPiece>& pieces)
{
  const bool haveNumbers = std::all_of(pieces.begin(), pieces.end(),
    [](const MeshPiece& piece) { return piece.PointNumbers || piece.Mesh.Points.Count == 0; });
  const ThreadBackend threads(1);
  JoinedPoints joined;
  std::vector<Candidate> all;
  for (std::size_t number = 0; number < pieces.size(); ++number)
  {
    const auto first = SizeOf(joined.Same);
    PiecePoints(pieces[number], haveNumbers, threads)
      .List(
        first, static_cast<int>(number), [](const Place&) { return true; },
        [&](const Candidate& one) { all.push_back(one); });
    joined.Same.resize(joined.Same.size() + pieces[number].Mesh.Points.Count);
    std::iota(joined.Same.begin() + first, joined.Same.end(), first);
  }
  joined.Ambiguous = ForEachShared(std::move(all),
    [&](const std::vector<Candidate>& same)
    {
      std::int64_t least = same.front().Key;
      for (const Candidate& one : same)
      {
        least = std::min(least, one.Key);
      }
      for (const Candidate& one : same)
      {
        joined.Same[one.Key] = least;
      }
    });
  return joined;
}

//------------------------------------------------------------------------------
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
  std::int64_t Point; ///< Its id on the rank that owns its key.
  std::uint32_t Sum;
};

/// Found in GeometryChoice.h instead of the function that does nothing. The total of every point
/// goes to the rank that owns its key, and 0 to the others.
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
/// The place of a corner in the plane.
PlanePoint GetPlace(
  const TriangleMesh& mesh, const PlaneProjection& plane, std::int64_t triangle, int slot)
{
  PlanePoint place = plane.Project(mesh.Points, mesh.Triangles.Get(triangle, slot));
  place.W = 0.0;
  return place;
}

/// Counts how a triangle turns, and which of its corners at closed points cover the direction +u.
/// The triangles around a closed point turn around it a whole number of times. If its star is
/// simple, +u is covered once.
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
  std::int64_t Key; ///< The point's key.
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
      const auto place = [&](int corner) { return GetPlace(mesh, survey.Projection, t, corner); };
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
  PlaneSums sums = threads.Sum<PlaneSums>(
    mesh.Triangles.Count, StarTurnStep{ mesh, survey.Projection, keys.Closed.data() });
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
  whole.StarsAreSimple = SumOverRanks(group, std::int64_t(areApart ? 0 : 1)) == 0;
}

}
