// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Where the flips run. Some of these tests are skipped without a GPU, others with one.

#include "FilterTestSupport.h"

#include "CudaDevice.h"
#include "FlipReport.h"

#include "vtkCellArray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

constexpr int NoSuchDevice = 1000000;

#ifdef DELAUNAYFLIP_HAS_CUDA
const char* const Reason = "CUDA could not ";
#else
const char* const Reason = "this build has no CUDA backend";
#endif

/// Just large enough for a GPU to be chosen.
Mesh MakeLargeMesh()
{
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMesh(10300, 5));
  EXPECT_GE(mesh->GetNumberOfPolys(), delaunayflip::SmallestMeshForCuda);
  return mesh;
}

Cells RunOnThreads(vtkPolyData* mesh)
{
  return FlipAtOnce(mesh, [](vtkDelaunayFlip* filter) { filter->SetBackendToThreads(); });
}

bool RanOn(WatchedFilter& filter, const std::string& backend)
{
  return filter->GetReport().Backend.rfind(backend + ": ", 0) == 0;
}

}

TEST(Backend, DevicesThatCannotBeReadAreAnError)
{
  WatchedFilter filter(MakeRhombus());
  filter->SetDevices("0;1");
  ExpectHolds(RunToError(filter, vtkDelaunayFlip::FAILURE_OPTIONS), "0;1");
  filter->SetDevices("3,5"); // nothing to the CPU
  filter->SetBackendToThreads();
  filter->Update();
  EXPECT_EQ(filter.GetErrors().size(), 1u);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
}

TEST(Backend, AutoIsSilent)
{
  auto mesh = MakeLargeMesh();
  WatchedFilter filter(mesh);
  filter->SetBackendToAuto();
  EXPECT_EQ(GetCells(RunCleanly(filter)->GetPolys()), RunOnThreads(mesh));
  EXPECT_TRUE(RanOn(filter, delaunayflip::HasCudaDevice() ? "CUDA" : "Threads"));
  EXPECT_EQ(filter->GetReport().Fallback, "");
}

/// Also run with OldDriver, with which the GPU of any machine fails.
TEST(Backend, FallbackGivesOneWarning)
{
  if (!delaunayflip::HasCudaDevice())
  {
    GTEST_SKIP() << "no GPU";
  }
  auto mesh = MakeLargeMesh();
  WatchedFilter filter(mesh);
  filter->SetBackendToAuto();
  filter->SetDeviceId(NoSuchDevice);
  filter->SetMaximumIterations(100000); // so that there is no other warning
  const std::string warning = RunToWarning(filter);
  EXPECT_EQ(filter.GetPolygons(), RunOnThreads(mesh));
  ExpectHolds(warning, "the GPU could not be used, the CPU did the work: CUDA could not ");
  ExpectHolds(warning, filter->GetReport().Fallback);
  EXPECT_TRUE(RanOn(filter, "Threads"));
  mesh->GetPoints()->SetPoint(0, NAN, 0.0, 0.0); // which shares the warning
  WatchedFilter dirty(mesh);
  dirty->SetBackendToAuto();
  dirty->SetDeviceId(NoSuchDevice);
  const std::string both = RunToWarning(dirty);
  ExpectHolds(both, "NaN");
  ExpectHolds(both, "the GPU could not be used");
}

TEST(Backend, ForcedBackendThatIsAbsentIsAnError)
{
  WatchedFilter filter(MakeRhombus());
  filter->SetBackendToCUDA();
  filter->SetDeviceId(delaunayflip::HasCudaDevice() ? NoSuchDevice : -1);
  ExpectHolds(RunToError(filter, vtkDelaunayFlip::FAILURE_BACKEND), Reason);
  filter->SetBackendToThreads(); // then there is no error
  EXPECT_TRUE(HasEdge(filter.Run(), 1, 3));
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_NONE);
}
