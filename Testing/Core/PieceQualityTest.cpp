// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceQuality.h"
#include "FlipEngine.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

/// @file
/// The smallest angle of a rank after rounds.

namespace delaunayflip
{
namespace
{

/// Two triangles with a common edge, one of them flat, and a third one beside them.
OwnedMesh<double> MakeThreeTriangles()
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.01, 0.0, 0.5, -1.0, 0.0, //
    2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 2.5, 0.3, 0.0 };
  mesh.Triangles = { 0, 1, 2, 1, 0, 3, 4, 5, 6 };
  return mesh;
}

/// The triangles of a rank after its first flips.
class PieceQualityTest : public testing::Test
{
protected:
  PieceQualityTest()
  {
    this->Mesh.TakeTriangles(this->First->ViewHostTriangles(), MarkedEdges());
    this->Mesh.BeginRounds(false);
  }

  /// The corner at a point of one triangle, which it lists.
  PieceCorner ListCorner(std::int32_t point)
  {
    for (std::int64_t corner = 0; corner < 9; ++corner)
    {
      std::int32_t points[3];
      this->Mesh.GetPoints(corner / 3, points);
      if (points[corner % 3] == point)
      {
        this->Mesh.List(corner / 3);
        return { corner / 3, static_cast<int>(corner % 3) };
      }
    }
    return { -1, 0 };
  }

  double MeasureAll() const { return FindSmallestAngle(this->Mesh, this->Survey, 1); }
  double Measure() const { return FindSmallestAngleAfterRounds(this->Mesh, this->Survey); }

  OwnedMesh<double> Triangles = MakeThreeTriangles();
  std::unique_ptr<PieceGroup> Alone = MakeSingleGroup();
  MeshPiece Piece{ Triangles.View() };
  PieceSurvey Survey = SurveyPieces(Piece, MatchPoints(Piece, *Alone), FlipOptions(), *Alone);
  std::unique_ptr<FlipEngine> First =
    MakeThreadEngine(Triangles.View(), FlipOptions(), BuildProgress());
  PieceMesh Mesh{ Piece, MatchPoints(Piece, *Alone), 0, 0 };
};

TEST_F(PieceQualityTest, NoTriangleIsListed)
{
  EXPECT_NEAR(1.1458, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

TEST_F(PieceQualityTest, AnotherOneIsListed)
{
  this->ListCorner(4);
  EXPECT_NEAR(1.1458, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

TEST_F(PieceQualityTest, TheFlattestHasChanged)
{
  const PieceCorner corner = this->ListCorner(2);
  this->Mesh.Flip(corner, this->Mesh.FindOpenMate(corner));
  EXPECT_NEAR(26.5651, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

TEST_F(PieceQualityTest, TheFlattestHasLeft)
{
  this->Mesh.Release({ this->ListCorner(2).Triangle });
  EXPECT_NEAR(30.9638, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

}
}
