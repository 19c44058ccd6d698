// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What a frame of a live view costs: one iteration, drawn in 1920 x 1080 pixels from copies and
/// without, and the drawing and the iteration alone. Prints a JSON object per line as soon as it is
/// measured. Ends with 77 where EGL has no GPU of CUDA.
///
/// Usage: delaunay-flip-window-benchmark [--any] [--frames N] [--moving POINTS] [POINTS...]
#include "BenchmarkMesh.h"
#include "BufferFiller.h"
#include "DelaunayFlip.h"
#include "EglWindow.h"
#include "TestWindow.h"

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipLiveView.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include "vtk_glew.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

using namespace delaunayflip;

namespace
{

struct Arguments
{
  bool AllowsOthers = false;
  int Frames = 20;
  std::int64_t Moving = 0;
  std::vector<std::int64_t> Sizes;
};

/// A filter and a window that shows it.
struct Scene
{
  vtkNew<vtkDelaunayFlip> Filter;
  vtkSmartPointer<vtkRenderWindow> Window = MakeTestWindow();
  vtkSmartPointer<vtkRenderWindowInteractor> Interactor = MakeTestInteractor();
  vtkNew<vtkDelaunayFlipLiveView> View;

  Scene(vtkPolyData* mesh, bool usesGpu)
  {
    this->Filter->SetInputData(mesh);
    this->Filter->SetBackend(
      usesGpu ? vtkDelaunayFlip::BACKEND_CUDA : vtkDelaunayFlip::BACKEND_AUTO);
    this->Window->SetSize(1920, 1080);
    this->Window->SetMultiSamples(0);
    this->Window->SetOffScreenRendering(true);
    this->Interactor->SetRenderWindow(this->Window);
    this->View->SetFilter(this->Filter);
    this->View->SetInteractor(this->Interactor);
    this->View->ShowStatisticsOff();
    this->View->SetColorByToSmallestAngle();
  }
};

/// Calls work() and waits for OpenGL, several times, and prints what it took.
/// @param prepare called before each, and not timed.
void Measure(
  const BenchmarkMesh& mesh, const std::string& what, int frames, const std::function<bool()>& work,
  const std::function<void()>& prepare = []() {})
{
  std::vector<double> times;
  bool goesOn = true;
  while (goesOn && static_cast<int>(times.size()) < frames)
  {
    prepare();
    const auto start = std::chrono::steady_clock::now();
    goesOn = work();
    glFinish();
    times.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  const double median = times[times.size() / 2];
  std::printf("{\"points\": %lld, \"triangles\": %lld, \"what\": \"%s\", \"frames\": %zu, "
              "\"median_ms\": %.3f, \"slowest_ms\": %.3f, \"per_second\": %.1f}\n",
    static_cast<long long>(mesh.CountPoints()), static_cast<long long>(mesh.CountTriangles()),
    what.c_str(), times.size(), median, times.back(), 1000.0 / median);
  std::fflush(stdout);
}

void TimeFlips(const BenchmarkMesh& mesh, vtkPolyData* data, const Arguments& arguments)
{
  vtkNew<vtkDelaunayFlip> filter;
  filter->SetInputData(data);
  filter->SetBackend(
    arguments.AllowsOthers ? vtkDelaunayFlip::BACKEND_AUTO : vtkDelaunayFlip::BACKEND_CUDA);
  filter->GenerateFlipCountOn();
  filter->LiveUpdateOn();
  filter->Update();
  Measure(mesh, "iteration alone", arguments.Frames,
    [&]()
    {
      filter->AdvanceSession();
      return true;
    });
}

unsigned int MakeBuffer(std::int64_t bytes)
{
  unsigned int buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, bytes, nullptr, GL_STATIC_DRAW);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  return buffer;
}

/// What it takes to bring triangles and colours up to date in buffers that nobody draws: after an
/// iteration, when nothing has changed, and in new buffers.
void TimeFilling(const BenchmarkMesh& mesh, vtkPolyData* data, const Arguments& arguments)
{
  Scene scene(data, !arguments.AllowsOthers);
  scene.View->ZeroCopyOff();
  scene.View->Step();
  const std::unique_ptr<BufferFiller> filler = MakeCudaFiller();
  if (!filler->FindObstacle(scene.Filter).empty())
  {
    return;
  }
  const std::int64_t count = mesh.CountTriangles();
  const DrawnBuffers buffers{ MakeBuffer(12 * count), MakeBuffer(4 * count), count };
  filler->Register(buffers);
  const DrawnColors colors{ false, [](double) {
                             return ColorBands{ std::vector<std::uint32_t>(12, 7), 0.0, 60.0, 0 };
                           } };
  const PointArray points(mesh.Floats.data(), mesh.CountPoints());
  const auto fill = [&]()
  {
    filler->Fill({ *scene.Filter->GetSession(), points, 0, colors });
    return filler->GetSmallestAngle() >= 0.0; // waits for the GPU
  };
  fill();
  const int frames = arguments.Frames;
  Measure(mesh, "filling alone", frames, fill, [&]() { scene.Filter->AdvanceSession(); });
  Measure(mesh, "filling alone, nothing new", frames, fill);
  Measure(mesh, "filling alone, new buffers", frames, fill, [&]() { filler->Register(buffers); });
  filler->Release();
  for (const unsigned int buffer : { buffers.Triangles, buffers.Colors })
  {
    glDeleteBuffers(1, &buffer);
  }
}

void TimeView(const BenchmarkMesh& mesh, vtkPolyData* data, const Arguments& arguments,
  const std::string& what, bool drawsEdges, int frames)
{
  const bool copies = what == "copies";
  Scene scene(data, !arguments.AllowsOthers);
  scene.View->SetZeroCopy(!copies);
  scene.View->SetEdgeVisibility(drawsEdges ? vtkDelaunayFlipLiveView::EDGE_VISIBILITY_ON
                                           : vtkDelaunayFlipLiveView::EDGE_VISIBILITY_OFF);
  scene.View->SetShowStatistics(what == "no copies, with texts");
  scene.View->Step();
  scene.View->Step(); // what VTK makes for the first frames
  const std::string edges = drawsEdges ? ", edges" : "";
  Measure(mesh, what + edges, frames, [&]() { return scene.View->Step(); });
  std::printf("{\"drawing\": \"%s\", \"renderer\": \"%s\"}\n", scene.View->GetDrawing().c_str(),
    GetRendererName().c_str());
  if (what == "no copies")
  {
    scene.View->Render();
    Measure(mesh, "drawing alone" + edges, frames,
      [&]()
      {
        scene.Window->Render();
        return true;
      });
  }
}

/// Lifts the points of a plane into a hill that grows and shrinks.
void Swell(vtkPoints* points, double time)
{
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    const double square = (x[0] - 0.5) * (x[0] - 0.5) + (x[1] - 0.5) * (x[1] - 0.5);
    points->SetPoint(i, x[0], x[1], std::sin(time) * std::exp(-12.0 * square));
  }
  points->Modified();
}

/// Frames of an animation: in each of them the points move, and the mesh is made Delaunay again.
void TimeMoving(const Arguments& arguments)
{
  const BenchmarkMesh mesh = MakeRandomMesh(arguments.Moving);
  for (const std::string what : { "not flipped", "not drawn", "no copies", "copies" })
  {
    const vtkSmartPointer<vtkPolyData> data = ToPolyData(mesh);
    Scene scene(data, !arguments.AllowsOthers);
    scene.View->SetZeroCopy(what == "no copies");
    scene.View->SetEdgeVisibilityToOff();
    scene.Filter->SetGeometryToSurface();
    scene.Filter->SetFeatureAngle(180.0);
    scene.Filter->LiveUpdateOn();
    scene.Filter->SetIterationsPerUpdate(1000000);
    const auto show = [&]()
    {
      if (what == "not drawn")
      {
        scene.Filter->Update();
      }
      else if (what != "not flipped")
      {
        scene.View->Step();
      }
      return true;
    };
    show();
    int frame = 0;
    Measure(mesh, "moving points, " + what, 3 * arguments.Frames,
      [&]()
      {
        Swell(data->GetPoints(), 0.05 * ++frame);
        return show();
      });
  }
}

void TimeSize(std::int64_t points, const Arguments& arguments)
{
  const BenchmarkMesh mesh = MakeRandomMesh(points);
  const vtkSmartPointer<vtkPolyData> data = ToPolyData(mesh);
  TimeFlips(mesh, data, arguments);
  TimeFilling(mesh, data, arguments);
  for (const bool drawsEdges : { false, true })
  {
    TimeView(mesh, data, arguments, "no copies", drawsEdges, arguments.Frames);
  }
  TimeView(mesh, data, arguments, "no copies, with texts", false, arguments.Frames);
  for (const bool drawsEdges : { false, true })
  {
    TimeView(mesh, data, arguments, "copies", drawsEdges, std::min(arguments.Frames, 4));
  }
}

}

int main(int argc, char* argv[])
{
  Arguments arguments;
  CLI::App app("What a frame of a live view costs");
  app.add_flag("--any", arguments.AllowsOthers, "without CUDA, too");
  app.add_option("--frames", arguments.Frames, "to time");
  app.add_option("--moving", arguments.Moving, "points of the mesh whose points move");
  app.add_option("sizes", arguments.Sizes, "points of the other meshes");
  CLI11_PARSE(app, argc, argv);
  const std::string obstacle = OpenEgl(arguments.AllowsOthers);
  if (!obstacle.empty())
  {
    std::printf("skipped: %s\n", obstacle.c_str());
    return 77;
  }
  if (arguments.Moving > 0)
  {
    TimeMoving(arguments);
  }
  for (const std::int64_t points : arguments.Sizes)
  {
    TimeSize(points, arguments);
  }
  return 0;
}
