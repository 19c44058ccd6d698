// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Observers that take things from the filter while it works, or throw.

#include "FilterTestSupport.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkExecutive.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{

Mesh MakeQuads()
{
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(20000, 1));
  mesh->GetPolys()->InsertNextCell({ 0, 1, 2, 3 }); // so that all are copied, with progress
  mesh->SetLines(vtkNew<vtkCellArray>()); // not the one that all meshes without lines share
  return mesh;
}

/// Whether the filter is at work. Outside, progress comes from the executive.
bool IsAtWork(vtkDelaunayFlip* filter)
{
  return filter->GetProgress() > 0.0 && filter->GetProgress() < 1.0;
}

/// What an update gives when `action` happens at each of its events.
Cells FlipDespite(WatchedFilter& filter, const std::function<void()>& action)
{
  int events = 0;
  OnProgress(filter.Get(),
    [&]()
    {
      if (IsAtWork(filter.Get()))
      {
        action();
        ++events;
      }
    });
  const Mesh output = filter->GetOutput(); // the filter may lose it
  filter->Update();
  EXPECT_GT(events, 3);
  filter->RemoveAllObservers();
  return GetCells(output->GetPolys());
}

vtkSmartPointer<vtkMultiBlockDataSet> MakePlanes()
{
  return MakeBlocks({ MakeBadPlane(), MakeBadPlane(), MakeBadPlane(), MakeBadPlane() });
}

/// The filter's error when progress makes it catch `thrown`.
template <typename Thrown>
std::string GetErrorOfThrown(const Thrown& thrown, bool live)
{
  WatchedFilter filter(MakeBadPlane());
  filter->SetLiveUpdate(live);
  OnProgress(filter.Get(),
    [&]()
    {
      if (IsAtWork(filter.Get()))
      {
        throw thrown;
      }
    });
  const std::string error = RunToError(filter, vtkDelaunayFlip::FAILURE_OTHER);
  filter->RemoveAllObservers();
  filter->LiveUpdateOff();
  filter->Modified();
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  return error;
}

}

/// Whatever happens at each event, the update gives the same mesh.
TEST(ObserverSafety, InputsOutputsAndOptionsMayChange)
{
  using Change = void (*)(vtkDelaunayFlip*);
  const Change changes[] = { [](vtkDelaunayFlip*) {},
    [](vtkDelaunayFlip* filter)
    {
      filter->RemoveAllInputConnections(0);
      filter->RemoveAllInputConnections(1);
    },
    [](vtkDelaunayFlip* filter)
    {
      filter->SetInputData(MakeRhombus());
      filter->SetConstraintsData(MakeRhombus());
    },
    [](vtkDelaunayFlip* filter)
    {
      filter->GetInputDataObject(0, 0)->Initialize();
      filter->GetInputDataObject(1, 0)->Initialize();
    },
    [](vtkDelaunayFlip* filter) { filter->GetOutputDataObject(0)->Initialize(); },
    [](vtkDelaunayFlip* filter)
    {
      filter->GetExecutive()->SetOutputData(0, Mesh::New());
      filter->GetExecutive()->SetOutputData(1, vtkSmartPointer<vtkTable>::New());
    },
    [](vtkDelaunayFlip* filter)
    {
      filter->SetRegionArray(filter->GetRegionArray() ? nullptr : "Region");
      filter->SetTriangulate(!filter->GetTriangulate());
      filter->SetLiveUpdate(!filter->GetLiveUpdate());
      filter->SetMaximumIterations(0);
      filter->SetNumberOfThreads(1);
      filter->Restart();
      filter->Advance();
      filter->ReleaseDeviceMemory();
    },
    [](vtkDelaunayFlip* filter) // to cells that are copied; those that are viewed must not change
    {
      auto* mesh = vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0));
      for (int i = 0; i < 1000 && mesh->GetNumberOfPoints() > 1000; ++i)
      {
        mesh->GetPolys()->InsertNextCell({ 0, 1, 2, 3 });
        mesh->GetLines()->InsertNextCell({ 0, 1 });
      }
    } };
  for (const auto make : { MakeQuads, MakeBadPlane })
  {
    for (const bool live : { false, true })
    {
      Cells expected;
      for (const Change change : changes)
      {
        WatchedFilter filter;
        filter->SetInputData(make()); // which nobody else holds
        filter->SetConstraintsData(MakeLines({ { 0, 1 } }));
        filter->SetLiveUpdate(live);
        filter->GenerateQualityOn();
        filter->GenerateFlipCountOn();
        const Cells cells = FlipDespite(filter, [&]() { change(filter.Get()); });
        EXPECT_TRUE(expected.empty() || cells == expected) << &change - changes;
        expected = cells;
      }
    }
  }
}

TEST(ObserverSafety, AnUpdateWithinAnUpdateIsRefused)
{
  WatchedFilter filter(MakeBadPlane());
  vtkNew<vtkAppendPolyData> below;
  below->AddInputConnection(filter->GetOutputPort());
  OnProgress(filter.Get(),
    [&]()
    {
      if (IsAtWork(filter.Get()))
      {
        filter->Update();
        below->Update();
      }
    });
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(CountViolations(filter->GetOutput()), 0);
  EXPECT_FALSE(filter.GetErrors().empty());
}

TEST(ObserverSafety, BlocksMayBeRemovedOrEmptied)
{
  for (const bool all : { false, true })
  {
    const auto blocks = MakePlanes();
    const Mesh last = vtkPolyData::SafeDownCast(blocks->GetBlock(3));
    WatchedFilter filter(blocks);
    filter->SetInputDataObject(1, MakePlanes());
    OnProgress(filter.Get(),
      [&]()
      {
        if (!IsAtWork(filter.Get()))
        {
          return;
        }
        last->Initialize();
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
      });
    filter->Update();
    for (unsigned int i = 0; i < 4; ++i)
    {
      ASSERT_NE(filter.GetBlock(i), nullptr);
      EXPECT_EQ(filter.GetBlock(i)->GetNumberOfCells(), MakeBadPlane()->GetNumberOfCells());
    }
  }
}

TEST(ObserverSafety, TheInputMayBeRemovedBeforeTheFilterHasIt)
{
  for (vtkSmartPointer<vtkDataObject> input :
    std::initializer_list<vtkSmartPointer<vtkDataObject>>{ MakeBadPlane(), MakePlanes() })
  {
    WatchedFilter filter(input);
    OnProgress(filter.Get(), [&]() { filter->SetInputDataObject(0, nullptr); });
    filter->Update();
    EXPECT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
    EXPECT_STREQ(filter->GetOutputDataObject(0)->GetClassName(), input->GetClassName());
  }
}

TEST(ObserverSafety, TheInputOfPointsMayBeRemoved)
{
  for (const unsigned long event : { vtkCommand::StartEvent, vtkCommand::ProgressEvent })
  {
    Watched<vtkDelaunayFlipPoints> filter(MakeBadPlane());
    OnEvent(filter.Get(), event, [&]() { filter->RemoveAllInputs(); });
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfInputConnections(0), 0);
    EXPECT_EQ(filter.GetErrors(), std::vector<std::string>{});
    EXPECT_EQ(filter.GetExecutiveErrors(), std::vector<std::string>{});
  }
}

TEST(ObserverSafety, ExceptionsAreErrors)
{
  for (const bool live : { false, true })
  {
    ExpectHolds(GetErrorOfThrown(std::runtime_error("enough"), live), "enough");
    ExpectHolds(GetErrorOfThrown(42, live), "unknown");
  }
}
