// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GivenConstraints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace delaunayflip
{

namespace
{
/// The piece's id of a point of the whole mesh, or -1.
std::int64_t FindPoint(const OwnedPiece& piece, std::int64_t point)
{
  const auto found = std::find(piece.PointOf.begin(), piece.PointOf.end(), point);
  return found == piece.PointOf.end() ? -1 : found - piece.PointOf.begin();
}

/// Adds a point that the piece's triangles do not use, unless it has the point.
std::int64_t AddPoint(const TriangleMesh& mesh, std::int64_t point, OwnedPiece& piece)
{
  const std::int64_t known = FindPoint(piece, point);
  if (known >= 0)
  {
    return known;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    piece.Doubles.push_back(mesh.Points.Get(point, axis));
  }
  piece.PointOf.push_back(point);
  return static_cast<std::int64_t>(piece.PointOf.size()) - 1;
}

PieceOrigin FindOrigin(const std::vector<OwnedPiece>& pieces, std::int64_t point)
{
  std::int32_t rank = static_cast<std::int32_t>(pieces.size()) - 1;
  while (FindPoint(pieces[rank], point) < 0)
  {
    --rank;
  }
  return { rank, FindPoint(pieces[rank], point) };
}

std::int64_t SumOf(const std::vector<std::int32_t>& values)
{
  std::int64_t sum = 0;
  for (const std::int32_t value : values)
  {
    sum += value;
  }
  return sum;
}
}

std::vector<std::string> ListDefects(const FlipReport& report)
{
  std::vector<std::string> list;
  for (const Defect& defect : report.Defects)
  {
    list.push_back(std::to_string(defect.Count) + " " + defect.What);
  }
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<OwnedPiece> GiveToAny(const TriangleMesh& mesh, std::vector<OwnedPiece> pieces)
{
  for (OwnedPiece& piece : pieces)
  {
    piece.Constraints.clear();
    piece.ToInsert.clear();
  }
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    OwnedPiece& piece = pieces[(7 * i + 1) % pieces.size()];
    const std::int64_t from = AddPoint(mesh, mesh.ConstraintEdges[2 * i], piece);
    piece.Constraints.push_back(from);
    piece.Constraints.push_back(AddPoint(mesh, mesh.ConstraintEdges[2 * i + 1], piece));
    piece.ToInsert.push_back(mesh.ConstraintsToInsert[i]);
  }
  return pieces;
}

std::vector<OwnedPiece> GiveFar(const TriangleMesh& mesh, std::vector<OwnedPiece> pieces)
{
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
    const bool isGiven = std::any_of(pieces.begin(), pieces.end(),
      [=](const OwnedPiece& piece)
      { return FindPoint(piece, ends[0]) >= 0 && FindPoint(piece, ends[1]) >= 0; });
    for (std::int64_t time = 0; time < (i == 0 ? 2 : 1) && !isGiven; ++time)
    {
      std::vector<PieceOrigin>& far = pieces[(i + time) % pieces.size()].FarConstraints;
      far.push_back(FindOrigin(pieces, ends[time]));
      far.push_back(FindOrigin(pieces, ends[1 - time]));
    }
  }
  return pieces;
}

GroupResult ExpectAsAlone(const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces,
  FlipOptions options, bool withNumbers)
{
  const FlipResult alone = Flip(mesh, options);
  const GroupResult together = FlipDivided(mesh, pieces, options, withNumbers);
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(together.View()));
  ExpectSameOnAllRanks(together.Reports);
  const PiecesReport& report = together.Reports.front();
  ExpectConsistentStatistics(report);
  EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
  EXPECT_EQ(alone.Report.UnmatchedConstraints, report.UnmatchedConstraints);
  EXPECT_EQ(ListDefects(alone.Report), ListDefects(report));
  EXPECT_EQ(alone.Report.Points, report.Points);
  EXPECT_EQ(alone.Report.Edges.Edges, report.Edges.Edges);
  EXPECT_EQ(alone.Report.Edges.Boundary, report.Edges.Boundary);
  EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
  EXPECT_EQ(alone.Report.Edges.Region, report.Edges.Region);
  EXPECT_EQ(alone.Report.Edges.Fixed, report.Edges.Fixed);
  EXPECT_EQ(alone.Report.EulerCharacteristic, report.EulerCharacteristic);
  EXPECT_EQ(alone.Report.NonDelaunayAfter, report.NonDelaunayAfter);
  EXPECT_EQ(alone.Report.GeometryUsed, report.GeometryUsed);
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  EXPECT_EQ(2 * (report.TotalFlips + report.ConstraintFlips), SumOf(together.FlipCounts));
  return together;
}

}
