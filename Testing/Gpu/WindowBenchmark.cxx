// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What a frame of a live view costs: one iteration, drawn in 1920 x 1080 pixels from copies and
/// without, and the drawing and the iteration alone. Prints a JSON object per line as soon as it is
/// measured. Ends with 77 where EGL has no GPU of CUDA.
///
/// Usage: delaunay-flip-window-benchmark [--any] [--frames N] [--moving POINTS] [POINTS...]
#include "BenchmarkMesh.h"
#include "DelaunayFlip.h"
#include "EglWindow.h"
#include "OpenGLFunctions.h"
#include "TestWindow.h"

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipLiveView.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
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
void Measure(
  const BenchmarkMesh& mesh, const std::string& what, int frames, const std::function<bool()>& work)
{
  std::vector<double> times;
  bool goesOn = true;
  while (goesOn && static_cast<int>(times.size()) < frames)
  {
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
  if (what != "no copies, with texts")
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

/// A plane of x and z. Its points can be lifted into a hill. It stands upright, so that it is no
/// terrain, in which the filter would count the triangles that turn over.
struct SwellingPlane
{
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkNew<vtkDoubleArray> Coordinates;
  std::vector<double> Heights;

  explicit SwellingPlane(const BenchmarkMesh& mesh)
    : Mesh(ToPolyData(mesh))
  {
    this->Coordinates->DeepCopy(this->Mesh->GetPoints()->GetData());
    this->Mesh->GetPoints()->SetData(this->Coordinates);
    for (vtkIdType i = 0; i < this->Coordinates->GetNumberOfTuples(); ++i)
    {
      double* x = this->Coordinates->GetPointer(3 * i);
      std::swap(x[1], x[2]);
      const double square = (x[0] - 0.5) * (x[0] - 0.5) + (x[2] - 0.5) * (x[2] - 0.5);
      this->Heights.push_back(std::exp(-12.0 * square));
    }
  }

  void Swell(double time)
  {
    double* first = this->Coordinates->GetPointer(0);
    for (std::size_t i = 0; i < this->Heights.size(); ++i)
    {
      first[3 * i + 1] = std::sin(time) * this->Heights[i];
    }
    this->Mesh->GetPoints()->Modified();
  }
};

/// Frames of an animation: in each of them the points move, and the surface is made Delaunay again.
void TimeMovingPoints(std::int64_t points, const Arguments& arguments)
{
  const BenchmarkMesh mesh = MakeRandomMesh(points);
  for (const std::string what : { "no copies", "copies" })
  {
    SwellingPlane plane(mesh);
    Scene scene(plane.Mesh, !arguments.AllowsOthers);
    scene.View->SetZeroCopy(what == "no copies");
    scene.View->SetEdgeVisibility(vtkDelaunayFlipLiveView::EDGE_VISIBILITY_OFF);
    scene.Filter->SetGeometryToSurface();
    scene.Filter->SetFeatureAngle(180.0); // no edge stays because it is sharp
    scene.Filter->SetIterationsPerUpdate(1000000); // each frame to its end
    scene.View->Step();
    int frame = 0;
    Measure(mesh, "moving points, " + what, 3 * arguments.Frames,
      [&]()
      {
        plane.Swell(0.05 * ++frame);
        scene.View->Step();
        return scene.Filter->GetNonDelaunayAfter() == 0;
      });
  }
}

/// Particles that swim in circles.
struct SwimmingParticles
{
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkNew<vtkDoubleArray> Coordinates;
  std::vector<double> Sines, Cosines; ///< By particle, for its phase.
  double Length; ///< How far they go in a frame.

  SwimmingParticles(const BenchmarkMesh& mesh, double length)
    : Mesh(ToPolyData(mesh)),
      Length(length)
  {
    this->Coordinates->DeepCopy(this->Mesh->GetPoints()->GetData());
    this->Mesh->GetPoints()->SetData(this->Coordinates);
    for (vtkIdType i = 0; i < this->Coordinates->GetNumberOfTuples(); ++i)
    {
      this->Sines.push_back(std::sin(static_cast<double>(i)));
      this->Cosines.push_back(std::cos(static_cast<double>(i)));
    }
  }

  void Swim(int frame)
  {
    const double u = this->Length * std::sin(0.1 * frame);
    const double v = this->Length * std::cos(0.1 * frame);
    double* first = this->Coordinates->GetPointer(0);
    for (std::size_t i = 0; i < this->Sines.size(); ++i)
    {
      first[3 * i] += u * this->Cosines[i] + v * this->Sines[i];
      first[3 * i + 1] += v * this->Cosines[i] - u * this->Sines[i];
    }
    this->Mesh->GetPoints()->Modified();
  }
};

/// Times frames of particles. Each moves by up to a hundredth of their mean distance, and
/// vtkDelaunayFlipPoints keeps their triangulation. The drawing alone and the swimming alone, which
/// is the caller's, are measured, too.
void TimeMovingParticles(std::int64_t points, const Arguments& arguments)
{
  const BenchmarkMesh mesh = MakeRandomMesh(points);
  const double length = 0.01 / std::sqrt(static_cast<double>(points));
  for (const std::string what : { "no copies", "copies" })
  {
    SwimmingParticles particles(mesh, length);
    vtkNew<vtkDelaunayFlipPoints> filter;
    filter->SetInputData(particles.Mesh);
    filter->SetBackend(
      arguments.AllowsOthers ? vtkDelaunayFlip::BACKEND_AUTO : vtkDelaunayFlip::BACKEND_CUDA);
    filter->SetKeepSessionToOn();
    filter->SetIterationsPerUpdate(1000000); // the first frame to its end
    Scene scene(particles.Mesh, !arguments.AllowsOthers);
    scene.View->SetFilter(filter);
    scene.View->SetZeroCopy(what == "no copies");
    scene.View->SetEdgeVisibility(vtkDelaunayFlipLiveView::EDGE_VISIBILITY_OFF);
    scene.View->Step();
    int frame = 0;
    Measure(mesh, "moving particles, " + what, 3 * arguments.Frames,
      [&]()
      {
        particles.Swim(++frame);
        scene.View->Step();
        return filter->GetNonDelaunayAfter() == 0;
      });
    Measure(mesh, "moving particles, drawing alone", arguments.Frames,
      [&]()
      {
        scene.Window->Render();
        return true;
      });
    Measure(mesh, "moving particles, swimming alone", arguments.Frames,
      [&]()
      {
        particles.Swim(++frame);
        return true;
      });
  }
}

void TimeSize(std::int64_t points, const Arguments& arguments)
{
  const BenchmarkMesh mesh = MakeRandomMesh(points);
  const vtkSmartPointer<vtkPolyData> data = ToPolyData(mesh);
  TimeFlips(mesh, data, arguments);
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
  app.add_option("--moving", arguments.Moving, "points of a mesh in which all points move");
  app.add_option("sizes", arguments.Sizes, "points of the other meshes");
  CLI11_PARSE(app, argc, argv);
  const std::string obstacle = OpenEgl(arguments.AllowsOthers);
  if (!obstacle.empty())
  {
    std::printf("skipped: %s\n", obstacle.c_str());
    return 77;
  }
  for (const std::int64_t points : arguments.Sizes)
  {
    TimeSize(points, arguments);
  }
  if (arguments.Moving > 0)
  {
    TimeMovingPoints(arguments.Moving, arguments);
    TimeMovingParticles(arguments.Moving, arguments);
  }
  return 0;
}
