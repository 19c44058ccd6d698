// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <string>

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

/// How often a report names a defect.
std::int64_t CountDefects(const FlipReport& report, const std::string& what)
{
  std::int64_t count = 0;
  for (const Defect& defect : report.Defects)
  {
    count += defect.What == what ? defect.Count : 0;
  }
  return count;
}

TEST(PieceConstraints, ConstraintsThatOtherRanksCrossAreNotInsertedAndSaySo)
{
  // Rank 1 has the lower middle of a lattice of 6 x 2 squares.
  const OwnedMesh<double> mesh = MakeGridMesh(6, 2);
  Owners owners;
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    double x = 0, y = 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      x += mesh.View().Points.Get(mesh.Triangles[3 * t + slot], 0) / 3;
      y += mesh.View().Points.Get(mesh.Triangles[3 * t + slot], 1) / 3;
    }
    owners.push_back(x > 2 && x < 4 && y < 1 ? 1 : 0);
  }
  const std::vector<OwnedPiece> pieces = Divide(mesh.View(), owners, 2);
  const auto find = [&](double x, double y)
  {
    std::int64_t id = 0;
    while (mesh.Points[3 * pieces[0].PointOf[id]] != x ||
      mesh.Points[3 * pieces[0].PointOf[id] + 1] != y)
    {
      ++id;
    }
    return id;
  };
  // Of rank 0: below rank 1 from one side to the other; between two corners of rank 1.
  const std::vector<std::int64_t> edges{ find(1, 0), find(5, 0), find(2, 0), find(4, 0) };
  const std::vector<unsigned char> toInsert{ 1, 1 };
  PiecesReport report;
  RunInThreads(2,
    [&](PieceGroup& group)
    {
      MeshPiece piece = pieces[group.GetRank()].View(true);
      if (group.GetRank() == 0)
      {
        piece.Mesh.ConstraintEdges = edges.data();
        piece.Mesh.NumberOfConstraintEdges = 2;
        piece.Mesh.ConstraintsToInsert = toInsert.data();
      }
      FlippedPiece flipped;
      const PiecesReport own = FlipPiece(piece, MakeCanonical(), group, flipped);
      if (group.GetRank() == 0)
      {
        report = own;
      }
    });
  EXPECT_EQ(2, report.UnmatchedConstraints);
  EXPECT_EQ(0, report.InsertedConstraints);
  EXPECT_EQ(1,
    CountDefects(report,
      "constraint edges that cannot be inserted because they leave the mesh, or the piece of their "
      "rank"));
  EXPECT_EQ(1,
    CountDefects(report,
      "constraint edges that are not inserted because both of their points are shared by ranks"));
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
  const PieceDivision division{ GetParam(), {} };
  const auto stop = [](double) { return false; };
  const PiecesReport stopped = FlipInPieces(given, MakeCanonical(), division, output, stop);
  EXPECT_EQ(StopReasonKind::Aborted, stopped.StopReason);
  EXPECT_EQ(mesh.Triangles, triangles);
  const PiecesReport report = FlipInPieces(given, MakeCanonical(), division, output);
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(triangles));
  EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
  EXPECT_EQ(alone.Report.ConstraintFlips, report.ConstraintFlips);
  EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
}

INSTANTIATE_TEST_SUITE_P(Pieces, PieceConstraintsTest, testing::Values(2, 3, 7), NameRanks);

}
}
