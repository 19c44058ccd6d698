// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceSurvey.h"

#include "FixedEdges.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshSurveyBuilder.h"
#include "PlanarSurvey.h"
#include "Records.h"
#include "StarCheck.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

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

struct RankedSum
{
  PointSum Point;
  int Rank;
};

/// The total of every point goes to the first rank that has it, and 0 to the others.
RecordLists<PointSum> AddPointSums(const RecordLists<PointSum>& lists)
{
  std::vector<RankedSum> all;
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const PointSum& sum : lists[rank])
    {
      all.push_back({ sum, static_cast<int>(rank) });
    }
  }
  std::sort(all.begin(), all.end(),
    [](const RankedSum& a, const RankedSum& b)
    { return std::tie(a.Point.Key, a.Rank) < std::tie(b.Point.Key, b.Rank); });
  for (std::size_t i = all.size(); i-- > 1;)
  {
    if (all[i].Point.Key == all[i - 1].Point.Key)
    {
      all[i - 1].Point.Sum += all[i].Point.Sum;
      all[i].Point.Sum = 0;
    }
  }
  RecordLists<PointSum> answers(lists.size());
  for (const RankedSum& sum : all)
  {
    answers[sum.Rank].push_back(sum.Point);
  }
  return answers;
}

/// Found in HeightFieldSurvey.h instead of the function that does nothing.
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
  const RecordLists<PointSum> answers =
    ExchangeRecords(backend.Group, AddPointSums(ExchangeRecords(backend.Group, toHome)));
  for (std::size_t home = 0; home < answers.size(); ++home)
  {
    for (const std::int64_t point : points[home])
    {
      const auto found = std::lower_bound(answers[home].begin(), answers[home].end(),
        keys.Keys[point], [](const PointSum& sum, std::int64_t key) { return sum.Key < key; });
      sums[point] = found->Sum;
    }
  }
}

/// The side to which all triangles of all ranks strictly turn in the plane: 1 or -1; else 0.
int FindUniformSide(
  const TriangleMesh& mesh, const PlaneProjection& plane, const GroupBackend& backend)
{
  const OrientationSums turns = backend.Sum<OrientationSums>(mesh.Triangles.Count,
    [&](std::int64_t t, OrientationSums& sums)
    {
      PlanePoint corners[3];
      for (int slot = 0; slot < 3; ++slot)
      {
        corners[slot] = plane.Project(mesh.Points, mesh.Triangles.Get(t, slot));
        corners[slot].W = 0.0;
      }
      const bool isFinite = IsFinite(corners[0]) && IsFinite(corners[1]) && IsFinite(corners[2]);
      sums.Note(isFinite ? FindOrientation(corners[0], corners[1], corners[2]) : 0,
        static_cast<TriangleId>(t));
    });
  if (turns.None.Count > 0 || (turns.Left.Count > 0 && turns.Right.Count > 0))
  {
    return 0;
  }
  return turns.Left.Count > 0 ? 1 : -1;
}

/// Whether no flip in a plane can make an edge that exists.
bool NeedsNoGuard(
  const TriangleMesh& mesh, const PlaneProjection& plane, const GroupBackend& backend)
{
  const int side = FindUniformSide(mesh, plane, backend);
  return side != 0 && AreStarsSimple(mesh, plane, side, backend.Keys, backend.Group);
}
}

namespace
{
/// Ids are checked by the ranks that have the points.
void CheckFarConstraints(const MeshPiece& piece, const PieceGroup& group)
{
  for (std::int64_t i = 0; i < 2 * piece.NumberOfFarConstraints; ++i)
  {
    const PieceOrigin& end = piece.FarConstraints[i];
    if (end.Rank < 0 || end.Rank >= group.GetSize())
    {
      throw InvalidMesh("constraint edge " + std::to_string(i / 2) + " names a point of rank " +
          std::to_string(end.Rank) + ", but ranks are 0 to " + std::to_string(group.GetSize() - 1),
        -1, end.Id);
    }
  }
}
}

void CheckPieces(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group)
{
  DoTogether(group,
    [&]()
    {
      CheckOptions(options);
      CheckMeshSize(piece.Mesh.Triangles.Count, piece.Mesh.Points.Count);
      const ThreadBackend backend(options.NumberOfThreads);
      for (std::int64_t i = 0; i < 2 * piece.Mesh.NumberOfConstraintEdges; ++i)
      {
        CheckConstraint(piece.Mesh, i / 2, static_cast<int>(i % 2));
      }
      CheckFarConstraints(piece, group);
      // The geometry does not matter here; this one takes the least time.
      BuildMeshSurvey(MeshInput{ piece.Mesh, piece.Mesh }, GeometryKind::PlanarXY, backend);
    });
}

PieceSurvey SurveyPieces(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group)
{
  const GroupBackend backend(options.NumberOfThreads, keys, group);
  const TriangleMesh& mesh = piece.Mesh;
  const MeshSurvey found = BuildMeshSurvey(MeshInput{ mesh, mesh }, options.Geometry, backend);
  CheckTieRule(options, found.Geometry);
  PieceSurvey survey;
  survey.Geometry = found.Geometry;
  survey.GeometryReason = found.GeometryReason;
  survey.Projection = found.Projection;
  survey.Range = found.Range;
  survey.NearlyHeightField = found.NearlyHeightField;
  survey.NearlyHeightField.FirstIds.clear(); // of other ranks
  if (found.Geometry == GeometryKind::Planar)
  {
    survey.Whole.PlaneAxis = found.Projection.AxisW;
    survey.Whole.PlaneIsTilted = found.Projection.Tilted;
  }
  const std::int64_t doubles = mesh.Points.Count > 0 && !mesh.Points.Floats ? 1 : 0;
  survey.IsFloat = SumOverRanks(group, doubles) == 0;
  survey.Whole.StarsAreSimple =
    found.Geometry != GeometryKind::Surface && NeedsNoGuard(mesh, found.Projection, backend);
  return survey;
}

}
