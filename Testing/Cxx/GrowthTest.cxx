// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Updates leave nothing behind: neither memory nor objects of VTK.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#if defined(__linux__)
#include <malloc.h>
#include <unistd.h>
#endif

namespace
{

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

/// Bytes of memory of this process that hold something.
double GetResidentBytes()
{
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// 1,000 updates after some to warm up. Each of them leaking a hundredth of its mesh would show.
void ExpectNoGrowth(const std::function<void()>& update)
{
  constexpr double Most = 1 << 20;
  for (int i = 0; i < 100; ++i)
  {
    update();
  }
  const double before = GetResidentBytes();
  for (int i = 0; i < 1000; ++i)
  {
    update();
  }
  EXPECT_LT(GetResidentBytes() - before, Most);
}

/// 2,000 triangles: 100 kB or so an update.
vtkSmartPointer<vtkPolyData> MakeInput()
{
  return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(1000, 1));
}

#endif

}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

TEST(Growth, NoneOfUpdates)
{
  WatchedFilter filter(MakeInput());
  filter->GenerateQualityOn();
  filter->GenerateFlipCountOn();
  ExpectNoGrowth(
    [&]()
    {
      filter->Modified();
      filter.Run();
    });
}

TEST(Growth, NoneOfFilters)
{
  const auto mesh = MakeInput();
  ExpectNoGrowth(
    [&]()
    {
      WatchedFilter filter(mesh);
      filter.Run();
    });
}

TEST(Growth, NoneOfLiveRuns)
{
  LiveFilter filter(MakeInput());
  int updates = 0;
  ExpectNoGrowth(
    [&]()
    {
      filter.Run();
      if (!filter->Advance() || ++updates % 7 == 0)
      {
        filter->Restart();
      }
    });
}

TEST(Growth, NoneOfBlocks)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeInput());
  blocks->SetBlock(2, MakeRhombus());
  WatchedFilter filter;
  filter->SetInputDataObject(blocks);
  ExpectNoGrowth(
    [&]()
    {
      filter->Modified();
      filter->Update();
    });
}

TEST(Growth, NoneOfErrors)
{
  auto mesh = MakeInput();
  mesh->GetPolys()->InsertNextCell({ 0, 1, 1 << 20 });
  vtkNew<vtkDelaunayFlip> filter;
  SetTestBackend(filter);
  filter->SetInputData(mesh);
  vtkObject::GlobalWarningDisplayOff();
  ExpectNoGrowth(
    [&]()
    {
      filter->Modified();
      filter->Update();
    });
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
}

#endif

TEST(Growth, NothingOutlivesTheFilter)
{
  vtkWeakPointer<vtkPolyData> input, constraints, output;
  vtkWeakPointer<vtkPoints> points;
  vtkWeakPointer<vtkCellArray> cells;
  vtkWeakPointer<vtkDelaunayFlip> weak;
  for (const bool live : { false, true })
  {
    {
      auto mesh = MakeBadPlane();
      vtkNew<vtkPolyData> lines;
      lines->SetLines(MakeCells({ { 0, 1 } }));
      auto filter = vtkSmartPointer<vtkDelaunayFlip>::New();
      filter->SetInputData(mesh);
      filter->SetConstraintsData(lines);
      filter->SetLiveUpdate(live);
      filter->Update();
      weak = filter;
      input = mesh;
      constraints = lines;
      output = filter->GetOutput();
      points = mesh->GetPoints();
      cells = filter->GetOutput()->GetPolys();
    }
    EXPECT_EQ(weak, nullptr);
    EXPECT_EQ(input, nullptr);
    EXPECT_EQ(constraints, nullptr);
    EXPECT_EQ(output, nullptr);
    EXPECT_EQ(points, nullptr);
    EXPECT_EQ(cells, nullptr);
  }
}
