// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "PaperMethod.h"
#include "SequentialLawson.h"
#include "ThreadBackend.h"

#include <memory>
#include <stdexcept>

namespace delaunayflip
{

// Not in the unnamed namespace, because the loop's template would not find it there.
template <typename Step>
void RunPhase(const ThreadBackend& backend, std::int64_t size, const Step& step)
{
  backend.ForEach(size, step);
}

namespace
{

/// An edge that two triangles cannot share the same way, or more than two, becomes a boundary edge
/// for each of its triangles, because ta and tb hold two triangles only.
template <typename Point>
PaperArrays<Point, PaperVector> MakePaperArrays(const TriangleMesh& mesh)
{
  PaperArrays<Point, PaperVector> arrays;
  for (std::int64_t i = 0; i < mesh.Points.Count; ++i)
  {
    Point point{};
    for (int axis = 0; axis < Point::Dimension; ++axis)
    {
      point.Values[axis] = static_cast<typename Point::Number>(mesh.Points.Get(i, axis));
    }
    arrays.Vertices.push_back(point);
  }
  const CornerMesh corners(mesh.Triangles);
  for (std::int32_t a = 0; a < corners.CountCorners(); ++a)
  {
    const std::int32_t b = corners.Twins[a];
    if (b < 0 || a < b)
    {
      const IndexPair places{ CornerMesh::Next(a), CornerMesh::Previous(a) };
      arrays.Ends.push_back({ corners.Vertices[places.First], corners.Vertices[places.Second] });
      arrays.TriangleA.push_back(places);
      arrays.TriangleB.push_back(
        b < 0 ? IndexPair{ -1, -1 } : IndexPair{ CornerMesh::Previous(b), CornerMesh::Next(b) });
      arrays.Opposites.push_back({ a, b });
    }
  }
  arrays.Triangles = corners.Vertices;
  arrays.Flags.resize(mesh.Triangles.Count);
  arrays.Rotations.resize(mesh.Triangles.Count);
  return arrays;
}

using Loop = std::function<PaperResult(const PaperOptions&)>;

template <typename Real, int Dimension, typename Test>
Loop MakePaperLoop(const TriangleMesh& mesh, int threads, const Test& test)
{
  using Point = PaperPoint<Real, Dimension>;
  const auto arrays =
    std::make_shared<PaperArrays<Point, PaperVector>>(MakePaperArrays<Point>(mesh));
  const auto backend = std::make_shared<ThreadBackend>(threads);
  return [arrays, backend, test](const PaperOptions& options)
  {
    if (!options.OnGpu)
    {
      return RunPaperLoop(*arrays, test, options, *backend);
    }
#if defined(DELAUNAYFLIP_HAS_CUDA)
    return RunPaperLoopOnGpu(*arrays, test, options);
#else
    throw BackendUnavailable("built without the CUDA backend");
#endif
  };
}

template <typename Real>
Loop ChooseLoop(const TriangleMesh& mesh, const PaperOptions& options)
{
  const OppositeAngleTest<Real> angles{ static_cast<Real>(Pi + options.Epsilon) };
  if (options.Dimension == 3)
  {
    return MakePaperLoop<Real, 3>(mesh, options.NumberOfThreads, angles);
  }
  if (options.Test == PaperTestKind::OppositeAngles)
  {
    return MakePaperLoop<Real, 2>(mesh, options.NumberOfThreads, angles);
  }
  const InCircleTest<Real> inCircle{ static_cast<Real>(options.Epsilon) };
  return MakePaperLoop<Real, 2>(mesh, options.NumberOfThreads, inCircle);
}

}

PaperMethod::PaperMethod(const TriangleMesh& mesh, const PaperOptions& options)
  : Options(options)
{
  if (options.Dimension == 3 && options.Test == PaperTestKind::InCircle)
  {
    throw std::invalid_argument("the in-circle test is for the plane");
  }
  this->Loop =
    options.InDouble ? ChooseLoop<double>(mesh, options) : ChooseLoop<float>(mesh, options);
}

}
