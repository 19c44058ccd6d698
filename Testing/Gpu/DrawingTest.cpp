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
/// Angles and colours in device memory, and arrays that are drawn while a session goes on: bit for
/// bit what is written all at once.

namespace delaunayflip
{
namespace
{

class DeviceColorsTest : public GpuTest
{
protected:
  /// The angles of a mesh by the GPU, which must be those of the CPU.
  template <typename Real, typename Id>
  void ExpectSameAngles(const TriangleMesh& mesh, GeometryKind geometry, int components)
  {
    std::vector<double> expected(mesh.Triangles.Count);
    FindSmallestAngles(mesh, geometry, 1, expected.data());
    const DeviceArrays<Real, Id> device(mesh, components);
    const DeviceValues<float> degrees(std::vector<float>(mesh.Triangles.Count, -1.0f));
    const ValueRange range = FindSmallestAngles(device.View(), geometry, degrees.Data());
    const std::vector<float> actual = degrees.Get();
    for (std::size_t t = 0; t < expected.size(); ++t)
    {
      ASSERT_NEAR(expected[t], actual[t], 1e-5) << "triangle " << t;
    }
    EXPECT_EQ(*std::min_element(actual.begin(), actual.end()), range.Smallest);
    EXPECT_EQ(*std::max_element(actual.begin(), actual.end()), range.Largest);
  }
};

TEST_F(DeviceColorsTest, AnglesAreThoseOfTheHost)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 17);
  this->ExpectSameAngles<double, std::int32_t>(mesh.View(), GeometryKind::Surface, 3);
  this->ExpectSameAngles<double, std::int64_t>(mesh.View(), GeometryKind::PlanarXY, 2);
}

TEST_F(DeviceColorsTest, WhatHasNoAngleIsNaN)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(100, 18);
  mesh.Triangles[3] = 1000000;
  mesh.Triangles[7] = -1;
  const DeviceArrays<double, std::int32_t> device(mesh.View(), 3);
  const std::int64_t count = mesh.View().Triangles.Count;
  const DeviceValues<float> degrees(std::vector<float>(count, -1.0f));
  const ValueRange range = FindSmallestAngles(device.View(), GeometryKind::Surface, degrees.Data());
  const std::vector<float> angles = degrees.Get();
  EXPECT_FALSE(std::isnan(angles[0]));
  EXPECT_TRUE(std::isnan(angles[1]) && std::isnan(angles[2]));
  EXPECT_LE(0.0, range.Smallest);
  EXPECT_LT(range.Smallest, range.Largest);
}

TEST_F(DeviceColorsTest, Bands)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const DeviceValues<float> values({ -5.0f, 0.0f, 9.9f, 10.0f, 30.0f, 99.0f, nan });
  const DeviceValues<std::uint32_t> colors(std::vector<std::uint32_t>(7, 0));
  ColorValues(values.Data(), 7, { { 1, 2, 3 }, 0.0, 30.0, 9 }, colors.Data(), {});
  EXPECT_EQ((std::vector<std::uint32_t>{ 1, 1, 1, 2, 3, 3, 9 }), colors.Get());
}

TEST_F(DeviceColorsTest, ColorsMayTakeThePlaceOfCounts)
{
  const DeviceValues<std::int32_t> counts({ 4, 0, 7, 12, 40 });
  const ValueRange range = FindRange(counts.Data(), 5, {});
  EXPECT_EQ(0.0, range.Smallest);
  EXPECT_EQ(40.0, range.Largest);
  auto* colors = reinterpret_cast<std::uint32_t*>(counts.Data());
  ColorValues(counts.Data(), 5, { { 5, 6, 7 }, 0.0, 12.0, 9 }, colors, {});
  EXPECT_EQ((std::vector<std::int32_t>{ 6, 5, 6, 7, 7 }), counts.Get());
}

TEST_F(DeviceColorsTest, NothingToColor)
{
  EXPECT_TRUE(std::isnan(FindRange(nullptr, 0, {}).Smallest));
  EXPECT_TRUE(std::isnan(FindSmallestAngles(DeviceMesh(), GeometryKind::Surface, nullptr).Largest));
  std::uint32_t onHost[1] = {};
  const std::int32_t values[1] = {};
  EXPECT_THROW(ColorValues(values, 1, {}, onHost, {}), InvalidOptions);
  EXPECT_THROW(ColorValues(values, 1, { { 1 } }, onHost, {}), InvalidOptions);
}

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

  /// The same by the functions that write everything, in other arrays.
  Picture WriteAll(const FlipSession& session, const DrawnColors& colors) const
  {
    const std::int64_t count = this->Mesh.NumberOfTriangles();
    const DeviceValues<std::int32_t> ids(std::vector<std::int32_t>(3 * count, 55));
    const DeviceValues<std::uint32_t> painted(std::vector<std::uint32_t>(count, 55));
    const DeviceValues<float> degrees(std::vector<float>(count, 55.0f));
    const DeviceValues<std::int32_t> flips(std::vector<std::int32_t>(count, 55));
    session.StoreTriangles(MutableTriangleArray(ids.Data(), count), {});
    session.StoreFlipCounts(flips.Data(), {});
    DeviceMesh mesh;
    mesh.Points = this->View().Points;
    mesh.Triangles = TriangleArray(ids.Data(), count);
    const double smallest =
      FindSmallestAngles(mesh, GeometryKind::Surface, degrees.Data()).Smallest;
    const double largest = FindRange(flips.Data(), count, {}).Largest;
    const ColorBands bands = colors.Choose(colors.ByFlipCount ? largest : 0.0);
    colors.ByFlipCount ? ColorValues(flips.Data(), count, bands, painted.Data(), {})
                       : ColorValues(degrees.Data(), count, bands, painted.Data(), {});
    return { ids.Get(), painted.Get(), smallest };
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

TEST_F(DrawnTrianglesTest, SessionsWhoseTrianglesAreElsewhere)
{
  FlipSession session = this->Begin();
  session.Advance(3);
  this->ExpectSame(session, ByAngle(60.0));
  this->ExpectSameIterations(this->Begin(BackendKind::Threads), ByFlipCount());
  this->ExpectSame(session, ByFlipCount());
}

TEST_F(DrawnTrianglesTest, FlipsOfInsertedConstraintsCount)
{
  const std::int64_t edge[] = { 100, 900, 1000, 150 };
  const unsigned char inserts[] = { 1, 1 };
  TriangleMesh mesh = this->Mesh.View();
  mesh.ConstraintEdges = edge;
  mesh.NumberOfConstraintEdges = 2;
  mesh.ConstraintsToInsert = inserts;
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  FlipSession session(mesh, options);
  std::vector<std::int32_t> counts(this->Mesh.NumberOfTriangles());
  session.StoreFlipCounts(counts.data());
  EXPECT_LT(0, *std::max_element(counts.begin(), counts.end()));
  this->ExpectSameIterations(std::move(session), ByFlipCount());
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
  this->ExpectSame(session, ByAngle(60.0));
}

}
}
