// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Observers that take things from the filter while it works, or throw; and inputs that change in
/// place after an update.

#include "LiveTestSupport.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

namespace
{

using Action = std::function<void()>;

vtkSmartPointer<vtkPolyData> MakeQuads()
{
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(20000, 1));
  mesh->GetPolys()->InsertNextCell({ 0, 1, 2, 3 }); // so that all are copied, with progress
  return mesh;
}

/// Whether the filter is at work. Outside, progress comes from the executive.
bool IsAtWork(vtkDelaunayFlip* filter)
{
  return filter->GetProgress() > 0.0 && filter->GetProgress() < 1.0;
}

/// What an update gives when `action` happens at each of its events.
Cells FlipDespite(WatchedFilter& filter, const Action& action)
{
  int events = 0;
  auto act = [&]()
  {
    if (IsAtWork(filter.Get()))
    {
      action();
      ++events;
    }
  };
  OnProgress(filter.Get(), act);
  const vtkSmartPointer<vtkPolyData> output = filter->GetOutput(); // the filter may lose it
  filter->Update();
  EXPECT_GT(events, 3);
  filter->RemoveAllObservers();
  return GetCells(output->GetPolys());
}

/// That an update gives the same mesh when `action`, made for its filter, happens at each event.
void ExpectUnharmed(const std::function<Action(vtkDelaunayFlip*)>& makeAction)
{
  vtkNew<vtkPolyData> line;
  line->SetLines(MakeCells({ { 0, 1 } }));
  for (const auto make : { MakeQuads, MakeBadPlane })
  {
    for (const bool live : { false, true })
    {
      WatchedFilter expected(make());
      expected->SetConstraintsData(line);
      expected->SetLiveUpdate(live);
      const Cells cells = GetCells(expected.Run()->GetPolys());
      WatchedFilter filter;
      filter->SetInputData(make()); // which nobody else holds
      vtkNew<vtkPolyData> constraints;
      constraints->ShallowCopy(line);
      filter->SetConstraintsData(constraints);
      filter->SetLiveUpdate(live);
      EXPECT_TRUE(FlipDespite(filter, makeAction(filter.Get())) == cells);
    }
  }
}

vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int i = 0; i < 4; ++i)
  {
    blocks->SetBlock(i, MakeBadPlane());
  }
  return blocks;
}

/// The filter's error when progress makes it catch `thrown`.
template <typename Thrown>
std::string GetErrorOfThrown(const Thrown& thrown, bool live)
{
  WatchedFilter filter(MakeBadPlane());
  filter->SetLiveUpdate(live);
  Action action = [&]()
  {
    if (IsAtWork(filter.Get()))
    {
      throw thrown;
    }
  };
  OnProgress(filter.Get(), action);
  EXPECT_EQ(filter.Run()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OTHER);
  filter->RemoveAllObservers();
  filter->LiveUpdateOff();
  filter->Modified();
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  return filter.GetErrors().empty() ? "" : filter.GetErrors()[0];
}

}

TEST(ObserverSafety, InputsMayBeRemoved)
{
  ExpectUnharmed(
    [](vtkDelaunayFlip* filter)
    {
      return [filter]()
      {
        filter->RemoveAllInputConnections(0);
        filter->RemoveAllInputConnections(1);
      };
    });
}

TEST(ObserverSafety, InputsMayBeReplaced)
{
  ExpectUnharmed(
    [](vtkDelaunayFlip* filter)
    {
      return [filter]()
      {
        filter->SetInputData(MakeRhombus());
        filter->SetConstraintsData(MakeRhombus());
      };
    });
}

TEST(ObserverSafety, InputsMayBeEmptied)
{
  ExpectUnharmed(
    [](vtkDelaunayFlip* filter)
    {
      return [filter]()
      {
        filter->GetInputDataObject(0, 0)->Initialize();
        filter->GetInputDataObject(1, 0)->Initialize();
      };
    });
}

TEST(ObserverSafety, OutputsMayBeEmptied)
{
  for (const bool live : { false, true })
  {
    WatchedFilter expected(MakeBadPlane());
    expected->GenerateQualityOn();
    expected->SetLiveUpdate(live);
    const Cells cells = GetCells(expected.Run()->GetPolys());
    WatchedFilter filter(MakeBadPlane());
    filter->GenerateQualityOn();
    filter->GenerateFlipCountOn();
    filter->SetLiveUpdate(live);
    EXPECT_TRUE(
      FlipDespite(filter, [&]() { filter->GetOutputDataObject(0)->Initialize(); }) == cells);
    vtkPolyData* output = filter->GetOutput();
    vtkDataArray* angles = output->GetCellData()->GetArray("vtkDelaunayFlipAngleAfter");
    EXPECT_EQ(angles->GetNumberOfTuples(), output->GetNumberOfCells());
  }
}

/// To cells that are copied; those that are viewed in place must not change.
TEST(ObserverSafety, CellsMayBeAppended)
{
  for (const bool live : { false, true })
  {
    WatchedFilter expected(MakeQuads());
    expected->SetLiveUpdate(live);
    const Cells cells = GetCells(expected.Run()->GetPolys());
    const auto mesh = MakeQuads();
    mesh->SetLines(vtkNew<vtkCellArray>()); // not the one that all meshes without lines share
    WatchedFilter filter(mesh);
    filter->SetLiveUpdate(live);
    filter->GenerateQualityOn();
    const auto append = [&]()
    {
      for (int i = 0; i < 1000; ++i)
      {
        mesh->GetPolys()->InsertNextCell({ 0, 1, 2, 3 });
        mesh->GetLines()->InsertNextCell({ 0, 1 });
      }
    };
    EXPECT_TRUE(FlipDespite(filter, append) == cells);
  }
}

TEST(ObserverSafety, OutputsMayBeReplaced)
{
  ExpectUnharmed(
    [](vtkDelaunayFlip* filter)
    {
      return [filter]()
      {
        filter->GetExecutive()->SetOutputData(0, vtkSmartPointer<vtkPolyData>::New());
        filter->GetExecutive()->SetOutputData(1, vtkSmartPointer<vtkTable>::New());
      };
    });
}

TEST(ObserverSafety, OptionsMayChange)
{
  ExpectUnharmed(
    [](vtkDelaunayFlip* filter)
    {
      return [filter]()
      {
        filter->SetRegionArray(filter->GetRegionArray() ? nullptr : "Region");
        filter->SetTriangulate(!filter->GetTriangulate());
        filter->SetLiveUpdate(!filter->GetLiveUpdate());
        filter->SetMaximumIterations(0);
        filter->SetNumberOfThreads(1);
        filter->Restart();
        filter->Advance();
        filter->ReleaseDeviceMemory();
      };
    });
}

TEST(ObserverSafety, AnUpdateWithinAnUpdateIsRefused)
{
  WatchedFilter filter(MakeBadPlane());
  vtkNew<vtkAppendPolyData> below;
  below->AddInputConnection(filter->GetOutputPort());
  Action action = [&]()
  {
    if (IsAtWork(filter.Get()))
    {
      filter->Update();
      below->Update();
    }
  };
  OnProgress(filter.Get(), action);
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(CountViolations(filter->GetOutput()), 0);
  EXPECT_FALSE(filter.GetErrors().empty());
}

TEST(ObserverSafety, BlocksMayBeRemoved)
{
  for (const bool all : { false, true })
  {
    WatchedFilter filter;
    const auto blocks = MakeBlocks();
    filter->SetInputDataObject(blocks);
    filter->SetInputDataObject(1, MakeBlocks());
    Action action = [&]()
    {
      if (!IsAtWork(filter.Get()))
      {
        return;
      }
      for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
      {
        blocks->SetBlock(i, nullptr);
      }
      if (all)
      {
        blocks->Initialize();
        filter->GetInputDataObject(1, 0)->Initialize();
        filter->RemoveAllInputConnections(0);
      }
    };
    OnProgress(filter.Get(), action);
    filter->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    ASSERT_EQ(output->GetNumberOfBlocks(), 4u);
    for (unsigned int i = 0; i < 4; ++i)
    {
      auto* mesh = vtkPolyData::SafeDownCast(output->GetBlock(i));
      ASSERT_NE(mesh, nullptr);
      EXPECT_EQ(mesh->GetNumberOfCells(), MakeBadPlane()->GetNumberOfCells());
    }
  }
}

TEST(ObserverSafety, ExceptionsAreErrors)
{
  for (const bool live : { false, true })
  {
    EXPECT_NE(
      GetErrorOfThrown(std::runtime_error("enough"), live).find("enough"), std::string::npos);
    EXPECT_NE(GetErrorOfThrown(42, live).find("unknown"), std::string::npos);
  }
}

TEST(SharedArrays, CellsAddedToTheInputAreNotInTheOutput)
{
  auto mesh = MakeRhombus();
  mesh->GetPolys()->Squeeze();
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  const Cells cells = GetCells(output->GetPolys());
  for (int i = 0; i < 1000; ++i)
  {
    mesh->GetPolys()->InsertNextCell({ 0, 1, 2 });
  }
  EXPECT_EQ(output->GetNumberOfCells(), 2);
  EXPECT_TRUE(output->GetPolys()->IsValid());
  EXPECT_EQ(GetCells(output->GetPolys()), cells);
  EXPECT_NE(output->GetPolys()->GetOffsetsArray(), mesh->GetPolys()->GetOffsetsArray());
}

/// Without being marked as modified.
TEST(SharedArrays, IdsOfTheInputOfALiveRunMayBeOverwritten)
{
  auto mesh = MakeBadPlane();
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh->GetNumberOfCells());
  normals->Fill(1.0);
  mesh->GetCellData()->SetNormals(normals);
  LiveFilter filter(mesh);
  filter->GenerateQualityOn();
  filter.Run();
  vtkDataArray* ids = mesh->GetPolys()->GetConnectivityArray();
  for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i)
  {
    ids->SetComponent(i, 0, i % 2 == 0 ? 1e9 : -1e9);
  }
  filter->Advance();
  filter.Run();
  filter->GenerateQualityOff();
  filter->Advance();
  filter.RunToTheEnd();
  EXPECT_NE(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OTHER) << filter->GetErrorMessage();
}

TEST(SharedArrays, CellsAddedToTheInputOfALiveRunBeginItAnew)
{
  auto whole = MakeBadPlane();
  const Cells cells = GetCells(whole->GetPolys());
  auto mesh = MakeBadPlane();
  mesh->SetPolys(MakeCells(Cells(cells.begin(), cells.begin() + cells.size() / 2)));
  mesh->GetPolys()->Squeeze();
  LiveFilter filter(mesh);
  filter->GenerateQualityOn();
  filter.Run();
  const vtkSmartPointer<vtkCellArray> output = filter->GetOutput()->GetPolys();
  const vtkIdType before = mesh->GetNumberOfPolys();
  for (std::size_t i = cells.size() / 2; i < cells.size(); ++i) // none of it marked as modified
  {
    mesh->GetPolys()->InsertNextCell(static_cast<vtkIdType>(cells[i].size()), cells[i].data());
  }
  EXPECT_EQ(output->GetNumberOfCells(), before);
  EXPECT_TRUE(output->IsValid());
  filter->Advance();
  filter.RunToTheEnd();
  EXPECT_TRUE(filter.GetTriangles() == FlipAtOnce(whole));
}
