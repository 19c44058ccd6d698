// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMeshBuilder.h"
#include "GeneratedMeshes.h"
#include "GeometryChoice.h"
#include "MeshSurveyBuilder.h"
#include "PlanarSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// What is found out about a mesh before the first flip, part by part.

namespace
{
using namespace delaunayflip;

PlanarSurvey Survey(const OwnedMesh<double>& owned)
{
  const ThreadBackend backend(1);
  const TriangleMesh mesh = owned.View();
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, GeometryKind::PlanarXY, backend);
  const SpatialOrder order = OrderMesh(input, survey, backend);
  const EdgeMeshInput edges{ input, survey, order, 180.0 };
  EdgeMeshResult result = BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend);
  const PackingPlan plan{ { 0, 1, 2 }, 2, false, true, false };
  const PackedPoints points = PackPoints(mesh.Points, order.View(), plan, backend);
  return SurveyPlane(result.Edges, points, false, survey.UsedPoints, backend);
}

TEST(PlanarSurvey, FansOfLessThanATurnAreSimple)
{
  for (int start = 0; start < 8; ++start)
  {
    for (int count = 1; count < 8; ++count)
    {
      for (const bool clockwise : { false, true })
      {
        const PlanarSurvey survey = Survey(MakeFan(start, count, clockwise));
        EXPECT_TRUE(survey.StarsAreSimple) << start << " " << count << " " << clockwise;
        EXPECT_EQ(clockwise ? -1 : 1, survey.UniformSide);
      }
    }
  }
}

TEST(PlanarSurvey, FansOfMoreThanATurnAreNot)
{
  for (int start = 0; start < 8; ++start)
  {
    for (int count = 9; count < 16; ++count)
    {
      EXPECT_FALSE(Survey(MakeFan(start, count, false)).StarsAreSimple) << start << " " << count;
      EXPECT_FALSE(Survey(MakeFan(start, count, true)).StarsAreSimple) << start << " " << count;
    }
  }
}

/// Whichever corner of a triangle comes first. Most have three points inside.
TEST(PlanarSurvey, LatticesAreSimple)
{
  for (const bool clockwise : { false, true })
  {
    for (const int slot : { 0, 1, 2 })
    {
      OwnedMesh<double> mesh = MakeGridMesh(5, 4);
      for (auto t = mesh.Triangles.begin(); t != mesh.Triangles.end(); t += 3)
      {
        std::rotate(t, t + slot, t + 3);
        std::swap(*t, clockwise ? t[2] : *t);
      }
      EXPECT_TRUE(Survey(mesh).StarsAreSimple) << slot << " " << clockwise;
    }
  }
}

TEST(PlanarSurvey, OfTwoOppositeTrianglesTheRightOneIsInverted)
{
  for (const std::int64_t inverted : { 0, 1 })
  {
    OwnedMesh<double> mesh = MakeFan(0, 2, false);
    std::swap(mesh.Triangles[3 * inverted + 1], mesh.Triangles[3 * inverted + 2]);
    EXPECT_EQ(std::vector<std::int64_t>{ inverted }, Survey(mesh).GetInverted(0).FirstIds);
  }
}

TEST(PlanarSurvey, SumsOfPartsAreWhole)
{
  StarSums stars, part;
  part.SeveralFans = 1;
  part.Covers = 2;
  part.Uncertain = 3; // only on a device
  stars += part;
  EXPECT_EQ(1, stars.SeveralFans);
  EXPECT_EQ(2, stars.Covers);
  EXPECT_EQ(3, stars.Uncertain);
  AreaSum area, small;
  small.Add(1.0);
  small.Add(0x1p-58);
  area += small;
  EXPECT_TRUE(area.Get() == (std::int64_t(1) << 60) + 4);
}

TEST(GeometryChoice, HighBoxesAreHigherThanWide)
{
  EXPECT_TRUE(IsHigherThanWide({ { 0, 0, 100 }, { 1, 1, 102 } }));
  EXPECT_FALSE(IsHigherThanWide({ { 0, 0, 100 }, { 50, 50, 101 } }));
  EXPECT_FALSE(IsHigherThanWide({ { 0, 0, -1e308 }, { 1, 1e300, -1e308 } }));
  EXPECT_TRUE(IsHigherThanWide({ { 0, 0, -1.7e308 }, { 1.7e308, 1.7e308, 1.7e308 } }));
}

TEST(PlanarSurvey, TouchingCornersAreNotSimple)
{
  OwnedMesh<double> bowTie;
  bowTie.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0 };
  bowTie.Triangles = { 0, 1, 2, 0, 3, 4 };
  EXPECT_FALSE(Survey(bowTie).StarsAreSimple);
}

TEST(PlaneFinder, TakesTheFirstOfTheFarthest)
{
  Farthest farthest;
  farthest += { 7, 2.0, {} };
  EXPECT_EQ(7, farthest.Point);
  farthest += { 3, 1.0, {} };
  EXPECT_EQ(7, farthest.Point);
  farthest += { 9, 2.0, {} };
  EXPECT_EQ(7, farthest.Point);
  farthest += { 4, 2.0, {} };
  EXPECT_EQ(4, farthest.Point);
  farthest += { 8, 3.0, {} };
  EXPECT_EQ(8, farthest.Point);
}

TEST(PlaneScale, BringsTheLargestCoordinateToOneToTwo)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double extent : { 5e-324, 1e-200, 3.0, 1.7e308 })
    {
      BoundingBox box;
      box.Lower[axis] = -extent;
      const Vector3 scaled = PlaneScale(box)(extent, extent, extent);
      EXPECT_GE(scaled.X, 1.0) << extent;
      EXPECT_LT(scaled.X, 2.0) << extent;
    }
  }
  const Vector3 same = PlaneScale(BoundingBox())(3.0, 4.0, 5.0);
  EXPECT_EQ(3.0, same.X);
  EXPECT_EQ(5.0, same.Z);
}

TEST(SurfaceAngles, TheSmallestAngleCountsAtAnyCorner)
{
  const Vector3 corners[] = { { 0, 0, 1 }, { 10, 0, 1 }, { 10, 1, 2 } };
  const double cotangent = 10.0 / std::sqrt(2.0);
  for (int first = 0; first < 3; ++first)
  {
    const Vector3& a = corners[first];
    const Vector3& b = corners[(first + 1) % 3];
    const Vector3& c = corners[(first + 2) % 3];
    EXPECT_NEAR(cotangent * cotangent, LargestSquaredCotangent(a, b, c), 1e-9);
    EXPECT_NEAR(cotangent * cotangent, LargestSquaredCotangent(a, c, b), 1e-9);
  }
}

/// A new triangle that stands upright on the quad's vector area, exactly, would be the first step
/// of a fold.
TEST(SurfaceAngles, FlipsMustNotSetATriangleUpright)
{
  const Vector3 origin = { 0, 0, 0 };
  EXPECT_TRUE(FoldsOver({ { 0, -3, -2 }, origin, { 3, -3, -3 }, { -1, -3, -1 } }));
  EXPECT_TRUE(FoldsOver({ { 3, 2, 2 }, origin, { 3, 1, 2 }, { 1, 1, 1 } }));
  EXPECT_FALSE(FoldsOver({ { 1, 2, 0 }, origin, { 3, 0, 0 }, { 1, -2, 0 } }));
}

}
