// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live views: the picture, the texts and the files.

#include "LiveViewTestSupport.h"
#include "TemporaryFolder.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkPNGReader.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace
{

namespace fs = std::filesystem;
using delaunayflip::TemporaryFolder;
using Bytes = std::vector<unsigned char>;

/// The pixels of the window.
Bytes GetPicture(WatchedView& view)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  const int* size = view.Window->GetSize();
  view.Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  return Bytes(pixels->GetPointer(0), pixels->GetPointer(pixels->GetNumberOfValues()));
}

Bytes ReadPicture(const std::string& file)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const auto* first = static_cast<unsigned char*>(image->GetScalarPointer());
  return Bytes(first, first + image->GetNumberOfPoints() * image->GetNumberOfScalarComponents());
}

}

TEST(LiveViewPicture, Texts)
{
  WatchedView view(MakeRhombus(), false);
  view->Start();
  EXPECT_EQ(view.GetStatus(), "input, paused\n2 triangles\nsmallest angle 18.43 degrees");
  EXPECT_EQ(view.GetKeys().find("space: run/pause"), 0u);
  view->Run();
  EXPECT_EQ(view.GetStatus().find("input, running"), 0u);
  view->Step();
  EXPECT_EQ(view.GetStatus(),
    "iteration 1, converged\n1 flip, 0 bad edges left\nsmallest angle 36.87 degrees");
  view->ShowKeysOff();
  view->Render();
  EXPECT_EQ(view.GetKeys(), "");
}

TEST(LiveViewPicture, StatisticsAreThoseOfTheFilter)
{
  WatchedView view;
  view->SetColorByToSolid();
  view->Start();
  while (view->Step())
  {
    const std::string flips = std::to_string(view.Filter->GetTotalFlips());
    const std::string edges = std::to_string(view.Filter->GetNumberOfNonDelaunayEdges());
    std::string status = view.GetStatus();
    status.erase(std::remove(status.begin(), status.end(), ','), status.end()); // 1,234
    EXPECT_NE(status.find(" running\n" + flips + " flip"), std::string::npos) << status;
    EXPECT_NE(status.find(" " + edges + " bad edge"), std::string::npos) << status;
    EXPECT_NE(status.find(" left\nsmallest angle "), std::string::npos) << status;
  }
}

TEST(LiveViewPicture, StatisticsCanBeTurnedOff)
{
  WatchedView view;
  view->Step();
  const Bytes before = GetPicture(view);
  view->ShowStatisticsOff();
  view->Render();
  EXPECT_EQ(view.GetStatus(), "");
  EXPECT_NE(GetPicture(view), before);
  view->ShowStatisticsOn();
  view->Render();
  EXPECT_EQ(GetPicture(view), before);
}

TEST(LiveViewPicture, AFailureIsShownInAnyCase)
{
  WatchedView view;
  view->ShowStatisticsOff();
  view->Step();
  view.Filter->SetTieRuleToCanonical();
  view.Filter->SetGeometryToSurface();
  view->Step();
  EXPECT_EQ(view.GetStatus().find("failed: "), 0u);
}

TEST(LiveViewPicture, NumbersAreGrouped)
{
  WatchedView view(ToPolyData(delaunayflip::MakeRandomBadMeshDouble(700, 3)));
  view->Start();
  EXPECT_NE(view.GetStatus().find("input, running\n1,"), std::string::npos) << view.GetStatus();
}

TEST(LiveViewPicture, OffScreenThereAreNoKeys)
{
  WatchedView view;
  view->Start();
  EXPECT_EQ(view.GetKeys(), "");
}

TEST(LiveViewPicture, Colors)
{
  WatchedView view;
  std::set<Bytes> pictures;
  view->Step();
  EXPECT_EQ(view.GetColorArray(), "Quality");
  pictures.insert(GetPicture(view));
  view->SetColorByToFlipCount();
  view->Render();
  EXPECT_EQ(view.GetColorArray(), "vtkDelaunayFlipCount");
  pictures.insert(GetPicture(view));
  view->SetColorByToSolid();
  view->Render();
  EXPECT_EQ(view.GetColorArray(), "");
  pictures.insert(GetPicture(view));
  view->SetEdgeVisibilityToOff();
  view->Render();
  EXPECT_FALSE(view.HasEdges());
  pictures.insert(GetPicture(view));
  EXPECT_EQ(pictures.size(), 4u);
}

TEST(LiveViewPicture, EdgesOfLargeMeshesAreHidden)
{
  WatchedView view(ToPolyData(delaunayflip::MakeRandomBadMeshDouble(10100, 3)));
  view->Start();
  EXPECT_FALSE(view.HasEdges());
  view->SetEdgeVisibilityToOn();
  view->Render();
  EXPECT_TRUE(view.HasEdges());
}

TEST(LiveViewPicture, FacesAreTriangles)
{
  auto mesh =
    MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  mesh->SetLines(MakeCells({ { 0, 1 } }));
  WatchedView view(mesh);
  view->Start();
  EXPECT_EQ(view.GetNumberOfTriangles(), 2);
  view->SetColorByToFlipCount();
  view->Step();
  EXPECT_EQ(view.GetNumberOfTriangles(), 2);
  EXPECT_EQ(view.Filter->GetOutput()->GetNumberOfCells(), 3);
}

TEST(LiveViewPicture, LooksAtFlatMeshesFromTheirSide)
{
  const int up[3] = { 2, 2, 1 };
  for (int axis = 0; axis < 3; ++axis)
  {
    Points points = { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } };
    for (auto& point : points)
    {
      std::swap(point[2], point[axis]);
    }
    WatchedView view(MakeMesh(points, { { 0, 1, 2 }, { 0, 2, 3 } }));
    view->Start();
    vtkCamera* camera = view->GetRenderer()->GetActiveCamera();
    EXPECT_NEAR(std::abs(camera->GetDirectionOfProjection()[axis]), 1.0, 1e-9);
    EXPECT_NEAR(camera->GetViewUp()[up[axis]], 1.0, 1e-9);
  }
}

TEST(LiveViewPicture, KeepsACamera)
{
  WatchedView view;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.1, 0.1, 0.2);
  renderer->GetActiveCamera()->SetPosition(0.0, -5.0, 1.0);
  view.Window->AddRenderer(renderer);
  view->Step();
  EXPECT_EQ(view->GetRenderer(), renderer.Get());
  EXPECT_EQ(renderer->GetActiveCamera()->GetPosition()[1], -5.0);
}

TEST(LiveViewPicture, EveryFrameIsWritten)
{
  const TemporaryFolder folder;
  WatchedView view;
  view->SetFramePrefix((folder / "run_").c_str());
  while (view->Step())
  {
    const std::string number = std::to_string(1000000 + view->GetFrameNumber()).substr(3);
    EXPECT_EQ(ReadPicture(folder / ("run_" + number + ".png").c_str()), GetPicture(view));
  }
  EXPECT_EQ(folder.CountFiles(), view->GetFrameNumber() + 1);
  EXPECT_TRUE(fs::exists(folder / "run_0000.png"));
  EXPECT_TRUE(view.Errors.empty());
  view->Restart();
  EXPECT_EQ(folder.CountFiles(), view.Filter->GetNumberOfIterations() + 1);
}

TEST(LiveViewPicture, FramesOfAWindowOnTheScreen)
{
  const TemporaryFolder folder;
  WatchedView view(MakeBadPlane(), false);
  view->SetFramePrefix((folder / "f").c_str());
  view.RunToTheEnd();
  EXPECT_EQ(folder.CountFiles(), view->GetFrameNumber() + 1);
  std::set<Bytes> pictures;
  for (const auto& file : fs::directory_iterator(fs::path(folder / "")))
  {
    pictures.insert(ReadPicture(file.path().string()));
  }
  EXPECT_EQ(static_cast<long>(pictures.size()), folder.CountFiles());
}

TEST(LiveViewPicture, AFolderThatIsNotThereEndsTheWriting)
{
  const TemporaryFolder folder;
  WatchedView view;
  view->SetFramePrefix((folder / "missing/f").c_str());
  while (view->Step())
  {
  }
  EXPECT_TRUE(view->GetConverged());
  ASSERT_EQ(view.Errors.size(), 1u);
  EXPECT_NE(view.Errors[0].find("missing/f0000.png"), std::string::npos);
  view->SetFramePrefix((folder / "f").c_str());
  view->Restart();
  EXPECT_EQ(folder.CountFiles(), 1);
}

TEST(LiveViewPicture, AFullDiskEndsTheWriting)
{
  if (!fs::exists("/dev/full"))
  {
    GTEST_SKIP() << "needs /dev/full";
  }
  const TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder / "f0001.png");
  WatchedView view;
  view->SetFramePrefix((folder / "f").c_str());
  while (view->Step())
  {
  }
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(view.Errors.size(), 1u);
  EXPECT_EQ(folder.CountFiles(), 2);
}
