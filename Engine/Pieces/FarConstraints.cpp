// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FarConstraints.h"

#include "FlipError.h"
#include "Records.h"

#include <algorithm>
#include <string>

namespace delaunayflip
{

namespace
{
/// A point of a rank, as it answers others.
struct FarPoint
{
  std::int64_t Key;
  double Position[3];
};

/// Answers what the ranks ask: their ids of points of this rank.
RecordLists<FarPoint> DescribePoints(
  const RecordLists<std::int64_t>& questions, const PieceMesh& mesh)
{
  RecordLists<FarPoint> answers(questions.size());
  for (std::size_t rank = 0; rank < questions.size(); ++rank)
  {
    for (const std::int64_t id : questions[rank])
    {
      if (id < 0 || id >= mesh.GetNumberOfPoints())
      {
        throw InvalidMesh("a constraint edge names point " + std::to_string(id) +
            " of this rank, which does not exist",
          -1, id);
      }
      FarPoint point{ mesh.GetKey(id), {} };
      mesh.GetPosition(id, point.Position);
      answers[rank].push_back(point);
    }
  }
  return answers;
}
}

FarConstraint MakeFarConstraint(const PieceMesh& mesh, std::int64_t from, std::int64_t to)
{
  FarConstraint constraint{ { mesh.GetKey(from), mesh.GetKey(to) }, {} };
  mesh.GetPosition(from, constraint.Positions[0]);
  mesh.GetPosition(to, constraint.Positions[1]);
  return constraint;
}

std::vector<FarConstraint> LookUpFarConstraints(
  const MeshPiece& piece, const PieceMesh& mesh, PieceGroup& group)
{
  std::vector<FarConstraint> constraints(piece.NumberOfFarConstraints);
  if (SumOverRanks(group, piece.NumberOfFarConstraints) == 0)
  {
    return constraints;
  }
  RecordLists<std::int64_t> questions(group.GetSize());
  for (std::int64_t i = 0; i < 2 * piece.NumberOfFarConstraints; ++i)
  {
    questions[piece.FarConstraints[i].Rank].push_back(piece.FarConstraints[i].Id);
  }
  const RecordLists<FarPoint> answers =
    ExchangeRecords(group, DescribePoints(ExchangeRecords(group, questions), mesh));
  std::vector<std::size_t> next(group.GetSize());
  for (std::int64_t i = 0; i < 2 * piece.NumberOfFarConstraints; ++i)
  {
    const std::int32_t rank = piece.FarConstraints[i].Rank;
    const FarPoint& point = answers[rank][next[rank]++];
    constraints[i / 2].Ends[i % 2] = point.Key;
    std::copy_n(point.Position, 3, constraints[i / 2].Positions[i % 2]);
  }
  return constraints;
}

}
