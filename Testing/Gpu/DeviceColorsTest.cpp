// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceColors.h"
#include "FlipError.h"
#include "GpuTestSupport.h"
#include "TestDevice.h"
#include "TriangleAngles.h"

#include <cmath>
#include <limits>

/// @file
/// Colours of triangles in the memory of a GPU: values, their range, and bands.

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

}
}
