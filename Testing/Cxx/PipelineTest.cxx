// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The filter in a pipeline: limits, executions, many filters at a time; and that updates leave
/// nothing behind, neither memory nor objects of VTK.

#include "FilterTestSupport.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkTable.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <thread>

#if defined(__linux__)
#include <malloc.h>
#include <unistd.h>
#endif

namespace
{

Mesh MakeLongRun() { return ToPolyData(delaunayflip::MakeWorstCaseMesh(20)); } // 37 iterations

/// A fan of 18 triangles with all points on one circle.
Mesh MakeCircle(std::mt19937& random)
{
  constexpr double Turn = 2.0 * 3.14159265358979323846;
  std::array<double, 20> angles;
  std::generate(
    angles.begin(), angles.end(), [&random]() { return Turn * random() / random.max(); });
  std::sort(angles.begin(), angles.end());
  Points points;
  for (const double angle : angles)
  {
    points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
  }
  Cells triangles;
  for (vtkIdType point = 2; point < 20; ++point)
  {
    triangles.push_back({ 0, point - 1, point });
  }
  return MakeMesh(points, triangles);
}

/// Whether each of some updates of a mesh, half of them live, gives the expected triangles.
bool HoldsInEachUpdate(vtkPolyData* mesh, const Cells& expected)
{
  vtkNew<vtkDelaunayFlip> filter;
  SetTestBackend(filter);
  filter->SetInputData(mesh);
  filter->SetNumberOfThreads(3);
  bool holds = true;
  for (int update = 0; update < 10; ++update)
  {
    filter->SetLiveUpdate(update % 2 == 1);
    filter->Modified();
    do
    {
      filter->Update();
    } while (filter->Advance());
    holds = holds && GetCells(filter->GetOutput()->GetPolys()) == expected;
  }
  return holds;
}

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
Mesh MakeInput() { return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(1000, 1)); }

#endif

}

TEST(Pipeline, RequestedLimitGivesNoWarning)
{
  for (const int limit : { 0, 5 })
  {
    auto mesh = MakeLongRun();
    WatchedFilter filter(mesh);
    filter->SetMaximumIterations(limit);
    auto output = RunCleanly(filter);
    EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT);
    EXPECT_EQ(filter->GetNumberOfIterations(), limit);
    EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), limit);
    EXPECT_GT(filter->GetNonDelaunayAfter(), 0);
    EXPECT_EQ(CountViolations(output), filter->GetNonDelaunayAfter());
    EXPECT_EQ(GetCells(output->GetPolys()) == GetCells(mesh->GetPolys()), limit == 0);
  }
}

TEST(Pipeline, SafetyLimitWarns)
{
  // Without a tolerance, rounding makes both diagonals of some quads bad, and flips never end.
  std::mt19937 random(1);
  WatchedFilter filter;
  filter->SetGeometryToSurface();
  filter->SetTolerance(0.0);
  for (int mesh = 0; mesh < 1000 && filter.GetWarnings().empty(); ++mesh)
  {
    filter->SetInputData(MakeCircle(random));
    filter.Run();
  }
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT);
  EXPECT_EQ(filter->GetNumberOfIterations(), 1018);
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  ExpectHolds(filter.GetWarnings()[0], "stopped by the safety limit of 1018 iterations");

  // With the automatic tolerance no edge flips because of rounding alone.
  WatchedFilter automatic(filter->GetInput());
  automatic->SetGeometryToSurface();
  RunCleanly(automatic);
  EXPECT_TRUE(automatic->GetConverged());
}

TEST(Pipeline, ExecutesOnlyWhenModified)
{
  vtkNew<vtkAppendPolyData> above;
  above->AddInputData(MakeRhombus());
  WatchedFilter filter;
  filter->SetInputConnection(above->GetOutputPort());
  int executions = 0;
  OnProgress(filter.Get(), [&]() { executions += filter->GetProgress() == 0.0 ? 1 : 0; });
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3));
  RunCleanly(filter);
  EXPECT_EQ(executions, 1);
  filter->SetGeometryToPlanar();
  RunCleanly(filter);
  EXPECT_EQ(executions, 2);
}

TEST(ManyFilters, UpdateAtTheSameTime)
{
  const auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(6000, 1));
  const Cells expected = FlipAtOnce(mesh);
  std::array<bool, 6> results{};
  std::vector<Mesh> copies; // reference counts alone are safe to share
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    copies.push_back(Mesh::New());
    copies.back()->DeepCopy(mesh);
  }
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    threads.emplace_back([&, i]() { results[i] = HoldsInEachUpdate(copies[i], expected); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(std::count(results.begin(), results.end(), true), 6);
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

TEST(Growth, NoneOfUpdatesFiltersAndLiveRuns)
{
  const auto mesh = MakeInput();
  WatchedFilter filter(mesh);
  filter->GenerateQualityOn();
  filter->GenerateFlipCountOn();
  LiveFilter live(mesh);
  int updates = 0;
  ExpectNoGrowth(
    [&]()
    {
      filter->Modified();
      filter.Run();
      WatchedFilter(mesh).Run();
      live.Run();
      if (!live->Advance() || ++updates % 7 == 0)
      {
        live->Restart();
      }
    });
}

#endif

TEST(Growth, NothingOutlivesTheFilter)
{
  for (const bool live : { false, true })
  {
    std::vector<vtkWeakPointer<vtkObjectBase>> all;
    {
      auto mesh = MakeBadPlane();
      auto lines = MakeLines({ { 0, 1 } });
      auto filter = vtkSmartPointer<vtkDelaunayFlip>::New();
      filter->SetInputData(mesh);
      filter->SetConstraintsData(lines);
      filter->SetLiveUpdate(live);
      filter->Update();
      for (vtkObject* object : std::initializer_list<vtkObject*>{ filter, mesh, lines,
             filter->GetOutput(), mesh->GetPoints(), filter->GetOutput()->GetPolys() })
      {
        all.emplace_back(object);
      }
    }
    for (const auto& object : all)
    {
      EXPECT_EQ(object, nullptr);
    }
  }
}
