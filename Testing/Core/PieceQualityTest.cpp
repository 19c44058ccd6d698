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

/// Two triangles that share no point, one of them flat, and a point above that one.
OwnedMesh<double> MakeTwoTriangles()
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.01, 0.0, 0.5, 1.0, 0.0, //
    2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 2.5, 0.3, 0.0 };
  mesh.Triangles = { 0, 1, 2, 4, 5, 6 };
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

  /// The corner at a point.
  PieceCorner FindCorner(std::int32_t point) const
  {
    for (std::int64_t corner = 0; corner < 6; ++corner)
    {
      std::int32_t points[3];
      this->Mesh.GetPoints(corner / 3, points);
      if (points[corner % 3] == point)
      {
        return { corner / 3, static_cast<int>(corner % 3) };
      }
    }
    return { -1, 0 };
  }

  /// Lists the triangle that has a point, and gives it another point instead.
  void Replace(std::int32_t point, std::int32_t by)
  {
    const PieceCorner corner = this->FindCorner(point);
    this->Mesh.List(corner.Triangle);
    this->Mesh.SetPoint(corner, by);
  }

  double MeasureAll() const { return FindSmallestAngle(this->Mesh, this->Survey, 1); }
  double Measure() const { return FindSmallestAngleAfterRounds(this->Mesh, this->Survey); }

  OwnedMesh<double> Triangles = MakeTwoTriangles();
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

TEST_F(PieceQualityTest, TheFlattestHasChanged)
{
  this->Replace(2, 3);
  EXPECT_NEAR(30.9638, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

TEST_F(PieceQualityTest, AnotherOneHasChanged)
{
  this->Replace(5, 3);
  EXPECT_NEAR(1.1458, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

TEST_F(PieceQualityTest, AnotherOneIsTheFlattestNow)
{
  this->Replace(5, 0); // (2, 0), (0, 0), (2.5, 0.3)
  this->Replace(2, 3);
  EXPECT_LT(this->MeasureAll(), 10.0);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

TEST_F(PieceQualityTest, TheFlattestHasLeft)
{
  const std::int64_t flat = this->FindCorner(2).Triangle;
  this->Mesh.List(flat);
  this->Mesh.Release({ flat });
  EXPECT_NEAR(30.9638, this->MeasureAll(), 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), this->Measure());
}

}
}
