// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceQuality.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <memory>

/// @file
/// The smallest angle of a rank after rounds.

namespace delaunayflip
{
namespace
{

/// Two triangles that share no point: one flat, the other one less so.
OwnedMesh<double> MakeTwoTriangles()
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.01, 0.0, 0.5, 1.0, 0.0, //
    2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 2.5, 0.3, 0.0 };
  mesh.Triangles = { 0, 1, 2, 4, 5, 6 };
  return mesh;
}

class PieceQualityTest : public testing::Test
{
protected:
  PieceQualityTest() { this->Mesh.BeginRounds(false); }

  double FindAngle() const { return FindSmallestAngle(this->Mesh, this->Survey, 1); }
  double FindAngle(double first) const
  {
    return FindSmallestAngle(this->Mesh, this->Survey, first, 1);
  }

  /// Lists a triangle and moves its corner 2 to point 3.
  void Change(std::int64_t triangle)
  {
    this->Mesh.List(triangle);
    this->Mesh.SetPoint({ triangle, 2 }, 3);
  }

  static constexpr int Flat = 0, Other = 1;

  OwnedMesh<double> Triangles = MakeTwoTriangles();
  std::unique_ptr<PieceGroup> Alone = MakeSingleGroup();
  MeshPiece Piece{ Triangles.View() };
  PieceSurvey Survey = SurveyPieces(Piece, MatchPoints(Piece, *Alone), FlipOptions(), *Alone);
  PieceMesh Mesh{ Piece, MatchPoints(Piece, *Alone), 0, 0 };
};

TEST_F(PieceQualityTest, AFlatTriangleThatHasChangedDoesNotCount)
{
  const double first = this->FindAngle();
  this->Change(Flat);
  const double now = this->FindAngle();
  EXPECT_GT(now, 10 * first);
  EXPECT_EQ(now, this->FindAngle(first));
}

TEST_F(PieceQualityTest, TheFirstFlipsMayHaveRoundedItsAngle)
{
  const double first = this->FindAngle();
  this->Change(Flat);
  const double now = this->FindAngle();
  EXPECT_EQ(now, this->FindAngle(first * (1 - 1e-12)));
  EXPECT_EQ(now, this->FindAngle(first * (1 + 1e-12)));
}

TEST_F(PieceQualityTest, TheSmallestAngleMayBeThatOfATriangleThatIsNotListed)
{
  const double first = this->FindAngle() * (1 - 1e-12);
  this->Change(Other);
  EXPECT_EQ(first, this->FindAngle(first)); // as the first flips have measured it
}

TEST_F(PieceQualityTest, OrThatOfATriangleThatHasChanged)
{
  const double first = this->FindAngle();
  this->Mesh.List(Other);
  this->Mesh.SetPoint({ Other, 2 }, 0);
  EXPECT_EQ(this->FindAngle(), this->FindAngle(first));
  EXPECT_LT(this->FindAngle(first), first);
}

}
}
