// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Filters that update at the same time, each in a thread of its own.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

namespace
{

constexpr int Updates = 10;

/// Whether each of some updates of a mesh, half of them live, gives the expected triangles.
bool HoldsInEachUpdate(vtkPolyData* mesh, const Cells& expected)
{
  vtkNew<vtkDelaunayFlip> filter;
  SetTestBackend(filter);
  filter->SetInputData(mesh);
  filter->SetNumberOfThreads(3);
  bool holds = true;
  for (int update = 0; update < Updates; ++update)
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

}

TEST(ManyFilters, UpdateAtTheSameTime)
{
  const auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(6000, 1));
  const Cells expected = FlipAtOnce(mesh);
  std::array<bool, 6> results{};
  std::vector<vtkSmartPointer<vtkPolyData>> copies; // reference counts alone are safe to share
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    copies.push_back(vtkSmartPointer<vtkPolyData>::New());
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
  for (const bool result : results)
  {
    EXPECT_TRUE(result);
  }
}
