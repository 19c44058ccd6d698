// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

/// @file
/// Divided meshes with constraints.

namespace delaunayflip
{
namespace
{

class PieceConstraintsTest : public RanksTest
{
};

TEST_P(PieceConstraintsTest, Constraints)
{
  const OwnedMesh<double> owned = MakeRandomBadMeshDouble(600, 22);
  const std::vector<std::int64_t> edges = ChooseEdges(owned.View());
  TriangleMesh mesh = owned.View();
  mesh.ConstraintEdges = edges.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(edges.size()) / 2;
  ExpectSameTriangles(mesh, this->Cut(mesh), GetParam(), MakeCanonical());
  ExpectSameTriangles(mesh, this->Scatter(mesh), GetParam(), MakeCanonical());
}

TEST_P(PieceConstraintsTest, ConstraintsThatAreNoEdges)
{
  const OwnedMesh<double> owned = MakeRandomBadMeshDouble(60, 23);
  std::vector<std::int64_t> edges;
  for (std::int64_t point = 1; point < owned.NumberOfPoints(); ++point)
  {
    edges.insert(edges.end(), { 0, point });
  }
  TriangleMesh mesh = owned.View();
  mesh.ConstraintEdges = edges.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(edges.size()) / 2;
  // Each piece is given those whose points it has; of these, one is counted on one rank only.
  const GroupResult result =
    FlipDivided(mesh, Divide(mesh, this->Cut(mesh), GetParam()), MakeCanonical());
  const FlipResult alone = Flip(mesh, MakeCanonical());
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(result.View()));
  EXPECT_EQ(alone.Report.Edges.Constraint, result.Reports.front().Edges.Constraint);
  EXPECT_LE(result.Reports.front().UnmatchedConstraints, alone.Report.UnmatchedConstraints);
}

TEST_P(PieceConstraintsTest, ConstraintsAreInsertedAcrossThePiecesOfOneProcess)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(400, 36);
  const std::vector<std::int64_t> edges{ 10, 390, 20, 380, 30, 370, 40, 200, 50, 60 };
  const std::vector<unsigned char> insert{ 1, 1, 1, 0, 1 };
  TriangleMesh given = mesh.View();
  given.ConstraintEdges = edges.data();
  given.NumberOfConstraintEdges = static_cast<std::int64_t>(insert.size());
  given.ConstraintsToInsert = insert.data();
  const FlipResult alone = Flip(given, MakeCanonical());
  ASSERT_LT(2, alone.Report.InsertedConstraints);
  std::vector<std::int32_t> triangles = mesh.Triangles;
  const MutableTriangleArray output(triangles.data(), mesh.NumberOfTriangles());
  const FlipOptions inPieces = MakeInPieces(GetParam());
  const auto stop = [](double) { return false; };
  const PiecesReport stopped = FlipInPieces(given, inPieces, output, stop);
  EXPECT_EQ(StopReasonKind::Aborted, stopped.StopReason);
  EXPECT_EQ(mesh.Triangles, triangles);
  const PiecesReport report = FlipInPieces(given, inPieces, output);
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(triangles));
  EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
  EXPECT_EQ(alone.Report.ConstraintFlips, report.ConstraintFlips);
  EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
}

INSTANTIATE_TEST_SUITE_P(Pieces, PieceConstraintsTest, testing::Values(2, 3, 7), NameRanks);

}
}
