// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamSurvey.h"

#include "SeamJudge.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
/// Makes the triangles that a rank sends.
class SeamLister
{
public:
  SeamLister(const MeshPiece& piece, const PieceMesh& mesh)
    : Piece(piece),
      Mesh(mesh)
  {
  }

  SeamTriangle Make(std::int64_t t, int slot) const
  {
    SeamTriangle seam = MakeSeamTriangle(this->Mesh, t, slot);
    seam.Side.IsFrozen = this->IsFrozen(t);
    seam.Side.Region = this->Piece.Mesh.Regions ? this->Piece.Mesh.Regions[t] : 0;
    return seam;
  }

  /// Calls visit(slot) for the edges of a triangle between shared points.
  template <typename Visit>
  void ForEachShared(std::int64_t t, const Visit& visit) const
  {
    std::int32_t points[3];
    this->Mesh.GetPoints(t, points);
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t start = points[(slot + 1) % 3];
      const std::int32_t end = points[(slot + 2) % 3];
      if (start != end && this->Mesh.IsShared(start) && this->Mesh.IsShared(end))
      {
        visit(slot);
      }
    }
  }

private:
  /// Also with a repeated id.
  bool IsFrozen(std::int64_t t) const
  {
    std::int32_t p[3];
    this->Mesh.GetPoints(t, p);
    const unsigned char* frozen = this->Piece.Mesh.FrozenTriangles;
    return (frozen && frozen[t] != 0) || p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
  }

  const MeshPiece& Piece;
  const PieceMesh& Mesh;
};

std::size_t GetHomeOf(const PointPair& keys, const PieceGroup& group)
{
  return GetHome(PairHash()(keys), group);
}

RecordLists<SeamTriangle> ListSeamTriangles(
  const MeshPiece& piece, const PieceMesh& mesh, const PieceGroup& group)
{
  const SeamLister lister(piece, mesh);
  RecordLists<SeamTriangle> toHome(group.GetSize());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const auto number = static_cast<std::int64_t>(t);
    lister.ForEachShared(number,
      [&](int slot)
      {
        const SeamTriangle seam = lister.Make(number, slot);
        toHome[GetHomeOf(seam.Ends, group)].push_back(seam);
      });
  }
  return toHome;
}

/// Sends constraints between shared points to the ranks that know their edges, and keeps the others
/// for this rank alone.
RecordLists<SharedConstraint> DivideConstraints(
  const TriangleMesh& caller, const PieceMesh& mesh, SeamSurvey& survey, const PieceGroup& group)
{
  RecordLists<SharedConstraint> toHome(group.GetSize());
  for (std::int64_t i = 0; i < caller.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t a = caller.ConstraintEdges[2 * i];
    const std::int64_t b = caller.ConstraintEdges[2 * i + 1];
    const unsigned char isToInsert = caller.ConstraintsToInsert ? caller.ConstraintsToInsert[i] : 0;
    if (a != b && mesh.IsShared(a) && mesh.IsShared(b))
    {
      const PointPair keys = mesh.GetKeys({ a, b });
      toHome[GetHomeOf(keys, group)].push_back({ keys, isToInsert != 0 ? 1 : 0 });
    }
    else
    {
      survey.Constraints.insert(survey.Constraints.end(), { a, b });
      survey.ToInsert.push_back(isToInsert);
    }
  }
  return toHome;
}

void TakeAnswers(const RecordLists<SeamAnswer>& lists, const PieceMesh& mesh, SeamSurvey& survey)
{
  for (const std::vector<SeamAnswer>& list : lists)
  {
    for (const SeamAnswer& answer : list)
    {
      survey.Marks.push_back(
        { answer.Triangle, answer.Slot, answer.IsFixed ? FixedMark : SeamMark });
      if (answer.IsToFix)
      {
        survey.EdgesToFix.push_back(mesh.GetEdge(answer.Triangle, answer.Slot));
      }
    }
  }
}
}

SeamSurvey SurveySeams(const PieceJob& job, const MeshPiece& piece, const PieceMesh& mesh)
{
  PieceGroup& group = job.Group;
  SeamSurvey seams;
  const RecordLists<SeamTriangle> triangles =
    ExchangeRecords(group, ListSeamTriangles(piece, mesh, group));
  const RecordLists<SharedConstraint> constraints =
    ExchangeRecords(group, DivideConstraints(piece.Mesh, mesh, seams, group));
  SeamVerdict verdict;
  DoTogether(
    group, [&]() { verdict = JudgeSeams(triangles, constraints, job.Survey, job.Options); });
  TakeAnswers(ExchangeRecords(group, verdict.Answers), mesh, seams);
  verdict.Counts.ToInsert = std::count_if(
    seams.ToInsert.begin(), seams.ToInsert.end(), [](unsigned char flag) { return flag != 0; });
  seams.Counts = SumOverRanks(group, verdict.Counts);
  if (seams.Counts.MissingToInsert > 0)
  {
    for (const std::vector<PointPair>& list : GatherRecords(group, verdict.Missing))
    {
      seams.Missing.insert(seams.Missing.end(), list.begin(), list.end());
    }
    std::sort(seams.Missing.begin(), seams.Missing.end());
  }
  return seams;
}

}
