// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The progress events of an update, observers that stop it at any of them, and what the stopped
/// update gives.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int Side = 120; ///< Quads per side: enough for several progress events during the split.

/// Quads with numbered cells, many of which are split along the wrong diagonal.
Mesh MakeQuads()
{
  auto mesh = ToPolyData(delaunayflip::MakeGridMesh(Side, Side));
  MovePoints(mesh,
    [](double* x)
    {
      const double wave = std::sin(x[0] * x[1]);
      x[0] += 0.3 * std::fmod(x[1], 2.0);
      x[1] += 0.2 * wave;
    });
  Cells quads;
  for (vtkIdType y = 0; y < Side; ++y)
  {
    for (vtkIdType x = 0; x < Side; ++x)
    {
      const vtkIdType corner = y * (Side + 1) + x;
      quads.push_back({ corner, corner + 1, corner + Side + 2, corner + Side + 1 });
    }
  }
  mesh->SetPolys(MakeCells(quads));
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  return mesh;
}

Mesh MakeLongRun() { return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(300, 1)); }

/// Records the progress events of an update, and stops it at one of them.
class ProgressWatch
{
public:
  explicit ProgressWatch(WatchedFilter& filter, std::size_t lastEvent = SIZE_MAX)
    : Filter(filter.Get()),
      LastEvent(lastEvent)
  {
    OnProgress(this->Filter, [this]() { this->Record(); });
  }

  std::vector<double> Progress;
  std::vector<vtkIdType> Iterations;

private:
  void Record()
  {
    if (this->IsOfExecutive())
    {
      return;
    }
    this->Progress.push_back(this->Filter->GetProgress());
    this->Iterations.push_back(this->Filter->GetNumberOfIterations());
    if (this->Progress.size() == this->LastEvent)
    {
      this->Filter->SetAbortExecute(1);
    }
  }

  /// 0 before the filter runs; from VTK 9.3 on also 1 after it was aborted.
  bool IsOfExecutive() const
  {
    return this->Filter->GetProgress() == 0.0 ||
      (this->Filter->GetProgress() == 1.0 && this->Progress.size() == this->LastEvent);
  }

  vtkDelaunayFlip* Filter;
  std::size_t LastEvent;
};

constexpr int LongSide = 130; ///< Squares; 33,800 triangles are enough for events while labelled.

/// A lattice of triangles with bad diagonals.
Mesh MakeLattice()
{
  auto mesh = ToPolyData(delaunayflip::MakeGridMesh(LongSide, LongSide));
  Shear(mesh, -0.7);
  return mesh;
}

/// All first edges of its triangles as lines; with points of their own or without.
Mesh MakeEdges(vtkPolyData* mesh, bool withPoints)
{
  Cells lines;
  for (const Cell& triangle : GetCells(mesh->GetPolys()))
  {
    lines.push_back({ triangle[0], triangle[1] });
  }
  auto edges = MakeLines(lines);
  if (withPoints)
  {
    edges->SetPoints(mesh->GetPoints());
    ReplacePoints<vtkFloatArray>(edges);
  }
  return edges;
}

/// That an update, stopped at its first event, passes the very cells of the input, and the next one
/// is whole.
void ExpectToStopAtOnce(WatchedFilter& filter, vtkPolyData* mesh)
{
  ProgressWatch watch(filter, 1);
  filter->SetInputData(mesh);
  EXPECT_EQ(filter.Run()->GetPolys(), mesh->GetPolys());
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
  EXPECT_EQ(watch.Progress.size(), 1u);
  filter->RemoveAllObservers();
  filter->Modified();
  RunCleanly(filter);
  EXPECT_TRUE(filter->GetConverged());
}

}

TEST(FilterProgress, BeginsBeforeTheFirstIterationAndRisesToOne)
{
  WatchedFilter filter(MakeLongRun());
  ProgressWatch watch(filter);
  RunCleanly(filter);
  EXPECT_TRUE(std::is_sorted(watch.Progress.begin(), watch.Progress.end()));
  EXPECT_LT(watch.Progress.front(), 0.1);
  EXPECT_EQ(watch.Progress.back(), 1.0);
  const auto early = std::count(watch.Iterations.begin(), watch.Iterations.end(), 0);
  ASSERT_GE(early, 5);
  EXPECT_GT(watch.Progress[early - 1], 0.4);
  EXPECT_LT(watch.Progress[early - 1], 0.7);
  EXPECT_EQ(watch.Iterations.back(), filter->GetNumberOfIterations());
}

TEST(FilterProgress, AbortsAnywhere)
{
  const Mesh mesh = MakeLongRun();
  bool hasStoppedEarly = false;
  bool hasConverged = false;
  for (std::size_t event = 1; !hasConverged; ++event)
  {
    WatchedFilter filter(mesh);
    ProgressWatch watch(filter, event);
    vtkPolyData* output = filter.Run();
    ASSERT_TRUE(filter.GetErrors().empty());
    ASSERT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_NONE);
    hasConverged = filter->GetConverged();
    if (!hasConverged)
    {
      ASSERT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED) << event;
      ASSERT_EQ(watch.Progress.size(), event);
    }
    EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
    const auto limit = [&](vtkDelaunayFlip* other)
    { other->SetMaximumIterations(filter->GetNumberOfIterations()); };
    ASSERT_EQ(GetCells(output->GetPolys()), FlipAtOnce(mesh, limit)) << event;
    hasStoppedEarly = hasStoppedEarly || filter->GetNumberOfIterations() == 0;
  }
  EXPECT_TRUE(hasStoppedEarly);
}

TEST(FilterProgress, AnAbortAtEveryEventEndsWithTheUpdate)
{
  WatchedFilter filter(MakeLongRun());
  OnProgress(filter.Get(), [&]() { filter->SetAbortExecute(1); }); // the executive tells of the end
  filter->Update();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  EXPECT_EQ(filter->GetAbortExecute(), 0);
  filter->RemoveAllObservers();
  filter->Modified();
  RunCleanly(filter);
  EXPECT_TRUE(filter->GetConverged());
}

TEST(FilterProgress, AbortsWhileTheInputIsRead)
{
  WatchedFilter split;
  ExpectToStopAtOnce(split, MakeQuads());
  const Mesh mesh = MakeLattice();
  for (const bool withPoints : { false, true })
  {
    WatchedFilter filter;
    filter->SetConstraintsData(MakeEdges(mesh, withPoints));
    ExpectToStopAtOnce(filter, mesh);
    EXPECT_GT(filter->GetNumberOfConstraintEdges(), LongSide * LongSide);
  }
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  const auto names = MakeArray<vtkStringArray>("Name", mesh->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    names->SetValue(cell, cell % 2 == 0 ? "even" : "odd");
  }
  mesh->GetCellData()->AddArray(names);
  for (const char* array : { "Number", "Name" })
  {
    WatchedFilter filter;
    filter->SetRegionArray(array);
    ExpectToStopAtOnce(filter, mesh);
  }
}

/// The mesh is that of a whole update, but there are no angles.
TEST(FilterProgress, AbortsWhileAnglesAreFound)
{
  const Mesh mesh = MakeLongRun();
  WatchedFilter whole(mesh);
  whole->GenerateQualityOn();
  const ProgressWatch all(whole);
  EXPECT_EQ(RunCleanly(whole)->GetCellData()->GetNumberOfArrays(), 2);
  for (const std::size_t before : { 1, 2 }) // the last event, when all is done
  {
    WatchedFilter filter(mesh);
    filter->GenerateQualityOn();
    ProgressWatch watch(filter, all.Progress.size() - before);
    vtkPolyData* output = filter.Run();
    EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
    EXPECT_EQ(GetCells(output->GetPolys()), FlipAtOnce(mesh));
    EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), 0);
  }
}

/// Wherever it is stopped, a live run continues with the next update.
TEST(FilterProgress, LiveRunsContinue)
{
  for (const Mesh& input : { MakeQuads(), MakeLongRun() })
  {
    for (std::size_t event : { 1, 3, 4, 6, 9, 10 })
    {
      LiveFilter filter(input);
      filter->SetIterationsPerUpdate(2);
      ProgressWatch watch(filter, event);
      filter.Run();
      ASSERT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED) << event;
      filter->RemoveAllObservers();
      EXPECT_TRUE(filter->Advance());
      filter.RunToTheEnd();
      EXPECT_TRUE(filter->GetConverged());
      EXPECT_EQ(filter.GetPolygons(), FlipAtOnce(input)) << event;
    }
  }
}
