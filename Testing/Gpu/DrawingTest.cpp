// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaContext.h"
#include "DeviceColors.h"
#include "FlipError.h"
#include "GpuTestSupport.h"
#include "TestDevice.h"
#include "TriangleAngles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

/// @file
/// Arrays in device memory that are drawn while a session goes on: bit for bit what is written all
/// at once, which is what the host measures.

namespace delaunayflip
{
namespace
{

const std::vector<std::uint32_t> Colors = { 11, 12, 13, 14, 15, 16, 17 };

DrawnColors ByAngle(double last)
{
  return { false, [last](double) { return ColorBands{ Colors, 0.0, last, 9 }; } };
}

/// The scale follows the largest count.
DrawnColors ByFlipCount()
{
  return { true, [](double largest) { return ColorBands{ Colors, 0.0, largest + 1.0, 9 }; } };
}

struct Picture
{
  std::vector<std::int32_t> Triangles;
  std::vector<std::uint32_t> Colors;
  double SmallestAngle = 0.0;

  bool operator==(const Picture& other) const
  {
    return this->Triangles == other.Triangles && this->Colors == other.Colors &&
      this->SmallestAngle == other.SmallestAngle;
  }
};

class DrawnTrianglesTest : public GpuTest
{
protected:
  void SetUp() override
  {
    GpuTest::SetUp();
    if (!this->IsSkipped())
    {
      this->UseMesh(MakeRandomBadMeshDouble(20000, 5));
    }
  }

  void UseMesh(OwnedMesh<double> mesh)
  {
    this->Mesh = std::move(mesh);
    const std::int64_t count = this->Mesh.NumberOfTriangles();
    this->Memory.emplace(this->Mesh.View(), 3);
    this->ColorMemory.emplace(std::vector<std::uint32_t>(count, 77));
  }

  FlipSession Begin(BackendKind backend = BackendKind::CUDA) const
  {
    FlipOptions options;
    options.Backend = backend;
    return FlipSession(this->Mesh.View(), options);
  }

  DrawnArrays View() const
  {
    return { DevicePointArray(this->Memory->Points.Data(), this->Mesh.NumberOfPoints()),
      this->Memory->ViewResult(), this->ColorMemory->Data(), {} };
  }

  /// What an update leaves in the arrays.
  Picture Update(const FlipSession& session, const DrawnColors& colors)
  {
    this->Drawn.Update(session, this->View(), colors);
    const double smallest = this->Drawn.GetSmallestAngle();
    return { this->Memory->Result.Get(), this->ColorMemory->Get(), smallest };
  }

  /// The same by another object, which writes everything, in other arrays.
  Picture WriteAll(const FlipSession& session, const DrawnColors& colors) const
  {
    const std::int64_t count = this->Mesh.NumberOfTriangles();
    const DeviceValues<std::int32_t> ids(std::vector<std::int32_t>(3 * count, 55));
    const DeviceValues<std::uint32_t> painted(std::vector<std::uint32_t>(count, 55));
    DrawnTriangles drawn;
    drawn.Update(session,
      { this->View().Points, MutableTriangleArray(ids.Data(), count), painted.Data(), {} }, colors);
    return { ids.Get(), painted.Get(), drawn.GetSmallestAngle() };
  }

  /// Updates the arrays and compares them.
  void ExpectSame(const FlipSession& session, const DrawnColors& colors)
  {
    EXPECT_TRUE(this->Update(session, colors) == this->WriteAll(session, colors));
  }

  /// Compares the arrays after every iteration.
  void ExpectSameIterations(FlipSession session, const DrawnColors& colors)
  {
    this->ExpectSame(session, colors);
    int iterations = 0;
    for (bool goesOn = true; goesOn; ++iterations)
    {
      goesOn = session.Advance(1);
      this->ExpectSame(session, colors);
    }
    EXPECT_LT(5, iterations);
  }

  void MovePoints()
  {
    std::vector<double> points = this->Memory->Points.Get();
    for (double& coordinate : points)
    {
      coordinate = 0.8 * coordinate * coordinate;
    }
    this->Memory->Points.Set(points);
  }

  OwnedMesh<double> Mesh;
  std::optional<DeviceArrays<double, std::int32_t>> Memory;
  std::optional<DeviceValues<std::uint32_t>> ColorMemory;
  DrawnTriangles Drawn;
};

TEST_F(DrawnTrianglesTest, FollowsASession)
{
  this->ExpectSameIterations(this->Begin(), ByAngle(60.0));
  this->ExpectSameIterations(this->Begin(), ByFlipCount());
}

TEST_F(DrawnTrianglesTest, WritesOnlyWhatHasChanged)
{
  FlipSession session = this->Begin();
  session.Advance(6);
  this->Update(session, ByAngle(60.0));
  const std::int64_t count = this->Mesh.NumberOfTriangles();
  std::vector<std::int32_t> before(count), after(count);
  session.StoreFlipCounts(before.data());
  session.Advance(1);
  session.StoreFlipCounts(after.data());
  this->Memory->Result.Set(std::vector<std::int32_t>(3 * count, 77));
  this->ColorMemory->Set(std::vector<std::uint32_t>(count, 77));
  const Picture partial = this->Update(session, ByAngle(60.0));
  const Picture whole = this->WriteAll(session, ByAngle(60.0));
  std::int64_t written = 0;
  for (std::int64_t t = 0; t < count; ++t)
  {
    const bool hasChanged = before[t] != after[t];
    written += hasChanged ? 1 : 0;
    ASSERT_EQ(hasChanged ? whole.Colors[t] : 77, partial.Colors[t]) << "triangle " << t;
    for (std::int64_t i = 3 * t; i < 3 * t + 3; ++i)
    {
      ASSERT_EQ(hasChanged ? whole.Triangles[i] : 77, partial.Triangles[i]) << "triangle " << t;
    }
  }
  EXPECT_LT(0, written);
  EXPECT_LT(written, count);
  EXPECT_EQ(whole.SmallestAngle, partial.SmallestAngle);
}

TEST_F(DrawnTrianglesTest, OtherColors)
{
  FlipSession session = this->Begin();
  for (const DrawnColors& colors :
    { ByAngle(60.0), ByAngle(30.0), ByFlipCount(), ByFlipCount(), ByAngle(30.0), ByAngle(60.0) })
  {
    this->ExpectSame(session, colors);
    session.Advance(1);
  }
}

/// A new one may be where another was before.
TEST_F(DrawnTrianglesTest, OtherSessions)
{
  std::optional<FlipSession> session;
  for (const int iterations : { 4, 0, 9, 3 })
  {
    session.reset();
    session.emplace(this->Begin());
    session->Advance(iterations);
    this->ExpectSame(*session, ByAngle(60.0));
    session->Advance(1);
    this->ExpectSame(*session, ByAngle(60.0));
  }
  this->UseMesh(MakeRandomBadMeshDouble(700, 6));
  this->ExpectSameIterations(this->Begin(), ByFlipCount());
}

TEST_F(DrawnTrianglesTest, MovedPointsAndOtherArrays)
{
  FlipSession session = this->Begin();
  session.Advance(3);
  this->ExpectSame(session, ByAngle(60.0));
  this->MovePoints();
  this->Drawn.Forget();
  this->ExpectSame(session, ByAngle(60.0));
  this->Memory->Result.Set(std::vector<std::int32_t>(this->Mesh.Triangles.size(), 77));
  this->Drawn.Forget();
  session.Advance(1);
  this->ExpectSame(session, ByAngle(60.0));
}

/// Angles differ from those of the host in the last bits, so that a few colours may differ.
TEST_F(DrawnTrianglesTest, WritesWhatTheHostMeasures)
{
  FlipSession session = this->Begin();
  session.Advance(3);
  const std::int64_t count = this->Mesh.NumberOfTriangles();
  std::vector<std::int32_t> ids(3 * count), flips(count);
  session.StoreTriangles(MutableTriangleArray(ids.data(), count));
  session.StoreFlipCounts(flips.data());
  TriangleMesh mesh = this->Mesh.View();
  mesh.Triangles = TriangleArray(ids.data(), count);
  std::vector<double> degrees(count);
  FindSmallestAngles(mesh, GeometryKind::Surface, 1, degrees.data());
  const Picture byAngle = this->Update(session, ByAngle(70.0)); // ten degrees per colour
  EXPECT_EQ(ids, byAngle.Triangles);
  EXPECT_NEAR(*std::min_element(degrees.begin(), degrees.end()), byAngle.SmallestAngle, 1e-5);
  const std::int32_t largest = *std::max_element(flips.begin(), flips.end());
  const Picture byFlips = this->Update(session, ByFlipCount());
  int different = 0;
  for (std::int64_t t = 0; t < count; ++t)
  {
    different += byAngle.Colors[t] != Colors[static_cast<int>(degrees[t] / 10.0)] ? 1 : 0;
    const auto size = static_cast<std::int32_t>(Colors.size());
    ASSERT_EQ(Colors[flips[t] * size / (largest + 1)], byFlips.Colors[t]) << "triangle " << t;
  }
  EXPECT_GT(3, different);
}

TEST_F(DrawnTrianglesTest, SessionsWhoseTrianglesAreElsewhere)
{
  const std::int64_t edge[] = { 100, 900, 1000, 150 };
  const unsigned char inserts[] = { 1, 1 };
  TriangleMesh mesh = this->Mesh.View();
  mesh.ConstraintEdges = edge;
  mesh.NumberOfConstraintEdges = 2;
  mesh.ConstraintsToInsert = inserts;
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  const FlipSession inserting(mesh, options), threads = this->Begin(BackendKind::Threads);
  const FlipSession session = this->Begin();
  for (const FlipSession* other : { &inserting, &threads })
  {
    this->ExpectSame(session, ByAngle(60.0));
    EXPECT_THROW(this->Drawn.Update(*other, this->View(), ByAngle(60.0)), BackendUnavailable);
  }
  this->ExpectSame(session, ByAngle(60.0));
}

/// Each call of an update fails once, and the next update makes up for it.
TEST_F(DrawnTrianglesTest, AnyCallMayFail)
{
  this->UseMesh(MakeRandomBadMeshDouble(2000, 7));
  for (const DrawnColors& colors : { ByFlipCount(), ByAngle(50.0) })
  {
    bool hasFailed = true;
    std::int64_t call = 1;
    for (; hasFailed; ++call)
    {
      FlipSession session = this->Begin();
      this->ExpectSame(session, ByAngle(60.0));
      session.Advance(2);
      hasFailed = false;
      ReleaseCudaMemory(); // else a call that lacks memory may be made again
      InjectCudaError(call, cudaErrorMemoryAllocation);
      try
      {
        this->Drawn.Update(session, this->View(), colors);
        this->Drawn.GetSmallestAngle();
      }
      catch (const BackendUnavailable&)
      {
        hasFailed = true;
      }
      InjectCudaError(0, cudaSuccess);
      this->ExpectSame(session, colors);
    }
    EXPECT_LT(10, call);
  }
}

/// An update need not be over when the engine is told to go on.
TEST_F(DrawnTrianglesTest, TheEngineWaitsForAnUpdate)
{
  this->UseMesh(MakeRandomBadMeshDouble(300000, 8));
  FlipSession session = this->Begin();
  std::vector<Picture> expected;
  while (session.Advance(1))
  {
    expected.push_back(this->WriteAll(session, ByAngle(60.0)));
  }
  session = this->Begin();
  session.Advance(1);
  for (const Picture& picture : expected)
  {
    this->Drawn.Update(session, this->View(), ByAngle(60.0));
    session.Advance(1);
    const double smallest = this->Drawn.GetSmallestAngle();
    const Picture actual{ this->Memory->Result.Get(), this->ColorMemory->Get(), smallest };
    EXPECT_TRUE(picture == actual);
  }
}

TEST_F(DrawnTrianglesTest, NothingToDraw)
{
  const FlipSession session = this->Begin();
  this->Drawn.Update(session, {}, ByAngle(60.0));
  EXPECT_TRUE(std::isnan(this->Drawn.GetSmallestAngle()));
  const DrawnColors none{ false, [](double) { return ColorBands(); } };
  EXPECT_THROW(this->Drawn.Update(session, this->View(), none), InvalidOptions);
  DrawnArrays onHost = this->View();
  std::vector<std::uint32_t> colors(this->Mesh.NumberOfTriangles());
  onHost.Colors = colors.data();
  EXPECT_THROW(this->Drawn.Update(session, onHost, ByAngle(60.0)), InvalidOptions);
  this->ExpectSame(session, ByAngle(60.0));
}

}
}
