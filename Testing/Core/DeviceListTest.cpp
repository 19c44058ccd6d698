// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipError.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

namespace delaunayflip
{
namespace
{

TEST(DeviceListTest, Numbers)
{
  EXPECT_EQ(ParseDevices(""), std::vector<int>());
  EXPECT_EQ(ParseDevices("3"), std::vector<int>({ 3 }));
  EXPECT_EQ(ParseDevices("1,0"), std::vector<int>({ 1, 0 }));
  EXPECT_EQ(ParseDevices(" 2, 10 "), std::vector<int>({ 2, 10 }));
}

TEST(DeviceListTest, All)
{
  const std::vector<int> all = ParseDevices("all");
  ASSERT_EQ(static_cast<int>(all.size()), CountCudaDevices());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    EXPECT_EQ(all[i], static_cast<int>(i));
  }
}

TEST(DeviceListTest, AnythingElseIsAnError)
{
  for (const char* list : { "x", "0,", ",0", "0,,1", "-1", "0.5", "0 1", "all,0", "99999999999" })
  {
    try
    {
      ParseDevices(list);
      FAIL() << list;
    }
    catch (const InvalidOptions& error)
    {
      EXPECT_NE(std::string::npos, std::string(error.what()).find(list)) << error.what();
    }
  }
}

TEST(DeviceListTest, AGpuIsNamedOnce)
{
  const OwnedMesh<double> mesh = MakeGridMesh(3, 3);
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  options.Devices = { 0, 1, 0 };
  EXPECT_THROW(Flip(mesh.View(), options), InvalidOptions);
  options.Devices = { -1, 0 };
  EXPECT_THROW(Flip(mesh.View(), options), InvalidOptions);
  options.Devices = { 7, 9 }; // nothing to the CPU
  EXPECT_NO_THROW(Flip(mesh.View(), options));
}

}
}
