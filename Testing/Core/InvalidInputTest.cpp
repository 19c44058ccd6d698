// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <limits>

namespace delaunayflip
{
namespace
{

constexpr std::int64_t Far = std::numeric_limits<std::int64_t>::max() / 8;

/// Expects InvalidMesh with this cell and point, and an unchanged output array. @returns its
/// message.
std::string ExpectInvalid(TriangleMesh mesh, std::int64_t cell, std::int64_t point)
{
  std::vector<std::int64_t> output(3 * mesh.Triangles.Count, -7);
  const std::vector<std::int64_t> before = output;
  std::string message;
  try
  {
    FlipToDelaunay(
      mesh, OnTestBackend({}), MutableTriangleArray(output.data(), mesh.Triangles.Count));
    ADD_FAILURE() << "no exception for point " << point;
  }
  catch (const InvalidMesh& error)
  {
    EXPECT_EQ(cell, error.Cell);
    EXPECT_EQ(point, error.Point);
    message = error.what();
    EXPECT_NE(std::string::npos, message.find(std::to_string(cell)));
    EXPECT_NE(std::string::npos, message.find(std::to_string(point)));
  }
  EXPECT_EQ(before, output);
  return message;
}

TEST(InvalidIds, ThrowWithCellAndPoint)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  for (std::int32_t id : { 16, -1, 2000000000, std::numeric_limits<std::int32_t>::min() })
  {
    for (const int slot : { 0, 1, 2 })
    {
      OwnedMesh<double> mesh = grid;
      mesh.Triangles[3 * 5 + slot] = id;
      ExpectInvalid(mesh.View(), 5, id);
    }
  }
  for (std::int64_t id : { std::int64_t(16), std::int64_t(-1), Far, -Far })
  {
    std::vector<std::int64_t> ids(grid.Triangles.begin(), grid.Triangles.end());
    ids[3 * 17 + 2] = id;
    TriangleMesh mesh = grid.View();
    mesh.Triangles = TriangleArray(ids.data(), grid.NumberOfTriangles());
    ExpectInvalid(mesh, 17, id);
  }
}

TEST(InvalidIds, AreFoundWithoutAnyPoint)
{
  const std::vector<std::int32_t> triangles = { 0, 0, 0 };
  TriangleMesh mesh;
  mesh.Triangles = ViewTriangles(triangles);
  EXPECT_NE(std::string::npos, ExpectInvalid(mesh, 0, 0).find("the mesh has no points"));
}

TEST(InvalidIds, OfConstraintsThrowWithConstraintAndPoint)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  for (std::int64_t id : { std::int64_t(16), std::int64_t(-1), Far, -Far })
  {
    const std::int64_t constraints[] = { 0, 1, 1, id };
    TriangleMesh mesh = grid.View();
    mesh.ConstraintEdges = constraints;
    mesh.NumberOfConstraintEdges = 2;
    ExpectInvalid(mesh, 1, id);
  }
}

template <typename Error, typename Change>
void ExpectRefused(const TriangleMesh& mesh, const Change& change)
{
  FlipOptions options;
  change(options);
  EXPECT_THROW(MakeSession(mesh, options), Error);
}

TEST(InvalidOptions, AreRefused)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  const TriangleMesh mesh = grid.View();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double tolerance : { -1e-9, -2.0, 1.0, nan })
  {
    ExpectRefused<InvalidOptions>(mesh, [&](FlipOptions& o) { o.Tolerance = tolerance; });
  }
  for (double angle : { -0.1, 180.1, nan })
  {
    ExpectRefused<InvalidOptions>(mesh, [&](FlipOptions& o) { o.FeatureAngle = angle; });
  }
  ExpectRefused<InvalidOptions>(mesh, [](FlipOptions& o) { o.MaximumIterations = -2; });
  ExpectRefused<InvalidOptions>(mesh, [](FlipOptions& o) { o.NumberOfThreads = -1; });
  ExpectRefused<InvalidOptions>(mesh, [](FlipOptions& o) { o.Device = -2; });
}

TEST(InvalidOptions, AreThoseThatTheMeshCannotHonour)
{
  const OwnedMesh<double> sphere = MakeBadSphere(8, 4, 1);
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  const auto setCanonical = [](FlipOptions& o) { o.TieRule = TieRuleKind::Canonical; };
  ExpectRefused<InvalidOptions>(sphere.View(), setCanonical);
  ExpectRefused<InvalidOptions>(grid.View(),
    [&](FlipOptions& o)
    {
      setCanonical(o);
      o.Geometry = GeometryKind::Surface;
    });
  ExpectRefused<InvalidOptions>(grid.View(),
    [&](FlipOptions& o)
    {
      setCanonical(o);
      o.Criterion = CriterionKind::OppositeAngles;
    });
  ExpectRefused<InvalidOptions>(
    sphere.View(), [](FlipOptions& o) { o.Geometry = GeometryKind::Planar; });
  EXPECT_NO_THROW(Flip(grid.View()));
}

/// More triangles than half-edges can be numbered for: refused before anything is read or
/// allocated.
TEST(TooLargeMeshes, AreRefusedUnread)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  for (std::int64_t count : { std::int64_t(1) << 31, std::int64_t(1) << 40 })
  {
    TriangleMesh mesh = grid.View();
    mesh.Triangles.Count = count;
    FlipOptions options;
    for (options.NumberOfPieces = 1; options.NumberOfPieces < 4; ++options.NumberOfPieces)
    {
      EXPECT_THROW(FlipSession(mesh, options), MeshTooLarge);
    }
    mesh = grid.View();
    mesh.Points.Count = count << 2;
    EXPECT_THROW(MakeSession(mesh), MeshTooLarge);
  }
  TriangleMesh mesh = grid.View();
  mesh.Triangles.Count = std::int64_t(1) << 40;
  EXPECT_THROW(MakeSession(mesh), MeshTooLarge);
}

/// A forced backend runs or is refused; it is never replaced silently.
TEST(ForcedBackend, RunsOrIsRefused)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  try
  {
    EXPECT_EQ(0u, Flip(grid.View(), options).Report.Backend.rfind("CUDA: ", 0));
  }
  catch (const BackendUnavailable& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("CUDA"));
  }
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 3;
  EXPECT_EQ("Threads: 3", Flip(grid.View(), options).Report.Backend);
}

}
}
