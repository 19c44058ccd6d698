// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceSurvey.h"

#include "FixedEdges.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "MeshSurveyBuilder.h"
#include "Records.h"
#include "StarCheck.h"
#include "ThreadBackend.h"
#include "TriangleAngles.h"

#include <algorithm>
#include <cstdint>
#include <limits>
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

/// The total of every point goes to the first rank that has it, and 0 to the others.
RecordLists<PointSum> AddPointSums(const RecordLists<PointSum>& lists)
{
  std::vector<RankedRecord<PointSum>> all = JoinLists(lists);
  std::sort(all.begin(), all.end(),
    [](const RankedRecord<PointSum>& a, const RankedRecord<PointSum>& b)
    { return std::tie(a.Value.Key, a.Rank) < std::tie(b.Value.Key, b.Rank); });
  for (std::size_t i = all.size(); i-- > 1;)
  {
    if (all[i].Value.Key == all[i - 1].Value.Key)
    {
      all[i - 1].Value.Sum += all[i].Value.Sum;
      all[i].Value.Sum = 0;
    }
  }
  RecordLists<PointSum> answers(lists.size());
  for (const RankedRecord<PointSum>& sum : all)
  {
    answers[sum.Rank].push_back(sum.Value);
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

/// BuildMeshSurvey without what is known: ids are valid, and which points are used.
MeshSurvey SurveyAll(const TriangleMesh& mesh, GeometryKind requested, const GroupBackend& backend)
{
  const MeshInput input{ mesh, mesh };
  MeshSurvey survey;
  survey.Uses = backend.MakeArray<PointUse>(mesh.Points.Count);
  std::transform(backend.Keys.Used.begin(), backend.Keys.Used.end(), survey.Uses.Data(),
    [](unsigned char isUsed) { return isUsed != 0 ? PointUse::Used : PointUse::Unused; });
  SurveyPoints(survey, input, requested, backend);
  GeometryChoice<GroupBackend>(input, survey, backend).Choose(requested);
  if (survey.Geometry != requested && survey.NonFinitePoints.Count > 0)
  {
    SurveyPoints(survey, input, survey.Geometry, backend); // z may no longer matter
  }
  ResolveRange(survey);
  return survey;
}
}

namespace
{
/// @throws InvalidMesh.
void CheckIds(const TriangleMesh& mesh, const ThreadBackend& backend)
{
  const auto points = static_cast<std::uint64_t>(mesh.Points.Count);
  const auto invalid = backend.Sum<std::int64_t>(mesh.Triangles.Count,
    [&](std::int64_t t, std::int64_t& sum)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        sum += static_cast<std::uint64_t>(mesh.Triangles.Get(t, slot)) >= points ? 1 : 0;
      }
    });
  if (invalid > 0)
  {
    RequireValidIds(mesh); // throws
  }
}

}

void CheckPieces(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group)
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
      const ThreadBackend backend(options.NumberOfThreads);
      for (std::int64_t i = 0; i < 2 * piece.Mesh.NumberOfConstraintEdges; ++i)
      {
        CheckConstraint(piece.Mesh, i / 2, static_cast<int>(i % 2));
      }
      CheckIds(piece.Mesh, backend);
    });
}

PieceSurvey SurveyPieces(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group)
{
  const GroupBackend backend(options.NumberOfThreads, keys, group);
  const TriangleMesh& mesh = piece.Mesh;
  const MeshSurvey found = SurveyAll(mesh, options.Geometry, backend);
  CheckTieRule(options, found.Geometry);
  PieceSurvey survey;
  survey.Geometry = found.Geometry;
  survey.GeometryReason = found.GeometryReason;
  survey.Projection = found.Projection;
  survey.Range = found.Range;
  survey.FiltersApply = found.FiltersApply;
  survey.NearlyHeightField = found.NearlyHeightField;
  survey.NearlyHeightField.FirstIds.clear(); // of other ranks
  if (found.Geometry == GeometryKind::Planar)
  {
    survey.Whole.PlaneAxis = found.Projection.AxisW;
    survey.Whole.PlaneIsTilted = found.Projection.Tilted;
  }
  const std::int64_t doubles = mesh.Points.Count > 0 && !mesh.Points.Floats ? 1 : 0;
  survey.IsFloat = SumOverRanks(group, doubles) == 0;
  if (found.Geometry != GeometryKind::Surface)
  {
    const StarTurns turns = SumStarTurns(mesh, found.Projection, keys, backend, group);
    survey.Whole.Side = turns.GetSide();
    survey.Whole.StarsAreSimple = AreStarsSimple(mesh, found.Projection, keys, turns, group);
  }
  return survey;
}

}
