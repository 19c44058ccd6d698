// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipTestSupport.h"
#include "HostMemory.h"

#include <gtest/gtest.h>

#include <limits>
#include <new>
#if defined(__linux__)
#include <cerrno>
#include <sys/mman.h>
#endif

/// @file
/// Input and options that are refused, and memory that there is not.

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
  const std::string message = ExpectInvalidMesh(cell, point,
    [&]
    {
      FlipToDelaunay(
        mesh, OnTestBackend({}), MutableTriangleArray(output.data(), mesh.Triangles.Count));
    });
  EXPECT_NE(std::string::npos, message.find(std::to_string(cell)));
  EXPECT_NE(std::string::npos, message.find(std::to_string(point)));
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
  constexpr unsigned char flags[] = { 1, 1 };
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  for (std::int64_t id : { std::int64_t(16), std::int64_t(-1), Far, -Far })
  {
    const std::vector<std::int64_t> ends = { 0, 1, 1, id };
    ExpectInvalid(WithConstraints(grid.View(), ends), 1, id);
    ExpectInvalid(WithConstraints(grid.View(), ends, flags), 1, id);
  }
}

TEST(InvalidOptions, AreRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const OwnedMesh<double> grid = MakeGridMesh(3, 3), sphere = MakeBadSphere(8, 4, 1);
  const auto expectRefused = [&](const OwnedMesh<double>& mesh, const auto& change)
  {
    FlipOptions options;
    change(options);
    EXPECT_THROW(MakeSession(mesh.View(), options), InvalidOptions);
    if (&mesh == &grid) // what is refused for a sphere depends on the mesh
    {
      EXPECT_THROW(CheckOptionsAndBackend(options), InvalidOptions);
    }
  };
  for (double tolerance : { -1e-9, -2.0, 1.0, nan })
  {
    expectRefused(grid, [&](FlipOptions& o) { o.Tolerance = tolerance; });
  }
  for (double angle : { -0.1, 180.1, nan })
  {
    expectRefused(grid, [&](FlipOptions& o) { o.FeatureAngle = angle; });
  }
  for (double deviation : { -1e-300, -std::numeric_limits<double>::infinity(), nan })
  {
    expectRefused(grid, [&](FlipOptions& o) { o.MaximumDeviation = deviation; });
  }
  expectRefused(grid, [](FlipOptions& o) { o.MaximumIterations = -2; });
  expectRefused(grid, [](FlipOptions& o) { o.NumberOfThreads = -1; });
  expectRefused(grid, [](FlipOptions& o) { o.Device = -2; });
  expectRefused(grid, [](FlipOptions& o) { o.Devices = { 0, 1, 0 }; });
  expectRefused(grid, [](FlipOptions& o) { o.Devices = { -1, 0 }; });
  // Those that the mesh cannot honour.
  expectRefused(sphere, [](FlipOptions& o) { o.TieRule = TieRuleKind::Canonical; });
  expectRefused(grid,
    [](FlipOptions& o)
    {
      o.TieRule = TieRuleKind::Canonical;
      o.Geometry = GeometryKind::Surface;
    });
  expectRefused(grid,
    [](FlipOptions& o)
    {
      o.TieRule = TieRuleKind::Canonical;
      o.Criterion = CriterionKind::OppositeAngles;
    });
  expectRefused(sphere, [](FlipOptions& o) { o.Geometry = GeometryKind::Planar; });
  FlipOptions threads = OnBackend(BackendKind::Threads);
  threads.Devices = { 7, 9 }; // nothing to the CPU
  EXPECT_NO_THROW(Flip(grid.View(), threads));
  EXPECT_NO_THROW(CheckOptionsAndBackend(threads));
}

TEST(DeviceLists, AreNumbersOrAll)
{
  EXPECT_EQ(ParseDevices(""), std::vector<int>());
  EXPECT_EQ(ParseDevices(" 2, 10 "), std::vector<int>({ 2, 10 }));
  EXPECT_EQ(static_cast<int>(ParseDevices("all").size()), CountCudaDevices());
  for (const char* list : { "x", "0,", ",0", "0,,1", "-1", "0.5", "0 1", "all,0", "99999999999" })
  {
    const std::string error = GetMessage<InvalidOptions>([&] { ParseDevices(list); });
    EXPECT_NE(std::string::npos, error.find(list)) << list << ": " << error;
  }
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
  PointInput points;
  points.Points = PlaneArray(grid.Points.data(), std::int64_t(1) << 62, 2);
  EXPECT_EQ("there are 4611686018427387904 points; at most 357913941 can be triangulated at once",
    GetMessage<MeshTooLarge>([&] { FlipSession(points, PointOptions()); }));
}

/// A forced backend runs or is refused; it is never replaced silently.
TEST(ForcedBackend, RunsOrIsRefused)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  const std::string error = GetMessage<BackendUnavailable>(
    [&]
    {
      const FlipReport report = Flip(grid.View(), OnBackend(BackendKind::CUDA)).Report;
      EXPECT_EQ(0u, report.Backend.rfind("CUDA: ", 0));
    });
  EXPECT_TRUE(error.empty() || error.find("CUDA") != std::string::npos) << error;
  const FlipOptions options = WithThreads(3, OnBackend(BackendKind::Threads));
  EXPECT_EQ("Threads: 3", Flip(grid.View(), options).Report.Backend);
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
TEST(HostMemory, TooMuchIsBadAlloc)
{
  HostMemory memory;
  EXPECT_THROW(memory.Allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

TEST(HostMemory, LargeAllocationsGoBackToTheSystem)
{
  HostMemory memory;
  constexpr std::size_t Bytes = std::size_t(1) << 26;
  void* pages = memory.Allocate(Bytes);
  unsigned char isResident = 0;
  static_cast<char*>(pages)[0] = 1;
  EXPECT_EQ(0, mincore(pages, 1, &isResident));
  EXPECT_EQ(1, isResident & 1);
  memory.Free(pages, Bytes);
  // No longer mapped.
  EXPECT_EQ(-1, mincore(pages, 1, &isResident));
  EXPECT_EQ(ENOMEM, errno);
}
#endif

}
}
