// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PaperMethod.h"

#include "FlipError.h"
#include "PaperLoop.h"
#include "PaperMeshBuilder.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace delaunayflip
{

// Not in the unnamed namespace, because the loop's template would not find them there.
template <typename Step>
void RunPhase(const ThreadBackend& backend, std::int64_t size, const Step& step)
{
  backend.ForEach(size, step);
}

static void WaitFor(const ThreadBackend&) {}

class PaperMethod::Runner
{
public:
  virtual ~Runner() = default;
  virtual PaperResult Run() const = 0;
};

namespace
{

constexpr double Pi = 3.14159265358979323846;

template <typename Point, typename Test>
class RunnerOf : public PaperMethod::Runner
{
public:
  RunnerOf(const TriangleMesh& mesh, const PaperOptions& options, const Test& test)
    : Threads(options.NumberOfThreads),
      OnGpu(options.OnGpu),
      Mesh(MakePaperMesh<Point>(mesh, this->Threads)),
      Plan{ test, std::cos(options.NormalThreshold * Pi / 180.0), options.MaximumIterations,
        options.CountsIterations }
  {
  }

  PaperResult Run() const override
  {
    if (!this->OnGpu)
    {
      return RunPaperLoop(this->Mesh, this->Plan, this->Threads);
    }
#if defined(DELAUNAYFLIP_HAS_CUDA)
    return RunPaperLoopOnGpu(this->Mesh, this->Plan);
#else
    throw BackendUnavailable("built without the CUDA backend");
#endif
  }

private:
  ThreadBackend Threads;
  bool OnGpu;
  PaperMesh<Point> Mesh;
  PaperPlan<Test> Plan;
};

/// 1 if the sum of the triangles' areas in x and y is positive, else -1.
double FindSide(const TriangleMesh& mesh)
{
  double sum = 0.0;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    double x[3], y[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      x[slot] = mesh.Points.Get(mesh.Triangles.Get(t, slot), 0);
      y[slot] = mesh.Points.Get(mesh.Triangles.Get(t, slot), 1);
    }
    sum += (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  }
  return sum < 0.0 ? -1.0 : 1.0;
}

template <typename Point, typename Test>
std::unique_ptr<PaperMethod::Runner> MakeRunner(
  const TriangleMesh& mesh, const PaperOptions& options, const Test& test)
{
  return std::make_unique<RunnerOf<Point, Test>>(mesh, options, test);
}

template <typename Real>
std::unique_ptr<PaperMethod::Runner> ChooseRunner(
  const TriangleMesh& mesh, const PaperOptions& options)
{
  const OppositeAngleTest<Real> angles{ static_cast<Real>(Pi + options.Epsilon) };
  if (options.Dimension == 3)
  {
    return MakeRunner<PaperPoint3<Real>>(mesh, options, angles);
  }
  if (options.Test == PaperTestKind::OppositeAngles)
  {
    return MakeRunner<PaperPoint2<Real>>(mesh, options, angles);
  }
  const InCircleTest<Real> inCircle{ static_cast<Real>(options.Epsilon),
    static_cast<Real>(FindSide(mesh)) };
  return MakeRunner<PaperPoint2<Real>>(mesh, options, inCircle);
}

}

std::int64_t PaperResult::CountFlips() const
{
  std::int64_t flips = 0;
  for (const PaperIteration& iteration : this->Counts)
  {
    flips += iteration.Flipped;
  }
  return flips;
}

PaperMethod::PaperMethod(const TriangleMesh& mesh, const PaperOptions& options)
{
  if (options.Dimension == 3 && options.Test == PaperTestKind::InCircle)
  {
    throw std::invalid_argument("the in-circle test is for the plane");
  }
  this->Implementation =
    options.InDouble ? ChooseRunner<double>(mesh, options) : ChooseRunner<float>(mesh, options);
}

PaperMethod::~PaperMethod() = default;

PaperResult PaperMethod::Run() const { return this->Implementation->Run(); }

}
