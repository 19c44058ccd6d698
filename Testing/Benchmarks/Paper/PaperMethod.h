// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERMETHOD_H
#define DELAUNAYFLIP_PAPERMETHOD_H

#include "Array.h"
#include "Atomics.h"
#include "HostDevice.h"
#include "SequentialLawson.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

/// @file
/// The method of the paper itself, as a baseline for benchmarks: C. A. Navarro, N.
/// Hitschfeld-Kahler, E. Scheihing, GRAPP 2013. Written from the text of the paper alone. It works
/// on the paper's four arrays, with one thread per edge for all edges in every iteration, on a GPU
/// or on threads of the CPU.
///
/// Choices where the paper says nothing:
/// - if a thread claims only one triangle of its edge, that triangle stays claimed until the end of
///   the iteration;
/// - the loop ends after an iteration that found no bad edge, or at a limit;
/// - cosines are clamped to -1 .. 1 before acos.
///
/// PaperThreads.cpp and PaperCuda.cu instantiate the loop for their backend.

namespace delaunayflip
{

enum class PaperTestKind
{
  OppositeAngles, ///< The paper's own.
  InCircle ///< Named as future work. Only in the plane, and for counter-clockwise meshes.
};

struct PaperOptions
{
  PaperTestKind Test = PaperTestKind::OppositeAngles;
  bool InDouble = false; ///< Coordinates and arithmetic in double; the paper uses float.
  int Dimension = 2; ///< 2: by x and y; 3: in space.

  /// The epsilon of eq. 5, in radians; for InCircle relative to the magnitude of the determinant's
  /// terms. For float angles "experimentally estimated" like the paper's: with 5e-4 the loop does
  /// not end on a random bad mesh of 1 M points. Near pi a change of the cosine's last bit changes
  /// acos by 3.5e-4.
  double Epsilon = 1e-3;

  /// In space, an edge stays if the normals of its two triangles differ by more than this many
  /// degrees when it is tested; 180 turns this off.
  double NormalThreshold = 180.0;

  std::int64_t MaximumIterations = 150; ///< The paper has no limit.
  bool OnGpu = false;
  int NumberOfThreads = 0; ///< 0: as many as the machine has.
  bool CountsIterations = false; ///< Fill PaperResult::Counts, which slows the loop.
};

struct PaperIteration
{
  std::uint32_t Bad = 0;
  std::uint32_t Flipped = 0;
};

struct PaperResult
{
  std::vector<std::int32_t> Triangles;
  std::int64_t Iterations = 0; ///< Iterations that found a bad edge.
  bool Converged = false; ///< Whether the last iteration found no bad edge.
  std::vector<PaperIteration> Counts; ///< By iteration, if asked for.
  std::string Backend; ///< E.g. "CUDA: NVIDIA H200".
  double FlipSeconds = 0.0; ///< For the loop, without copies.
};

/// Runs the loop on a copy of the arrays of a mesh. The options Test, InDouble, Dimension, Epsilon,
/// OnGpu and NumberOfThreads must be those with which it was made.
using PaperLoop = std::function<PaperResult(const PaperOptions&)>;

/// Builds the arrays on the host.
/// @param mesh with valid ids and fewer than 2^31 / 3 triangles; not used later.
/// @throws BackendUnavailable if a GPU is requested and the program has no CUDA.
PaperLoop MakePaperLoop(const TriangleMesh& mesh, const PaperOptions& options);

/// Builds the arrays on the current GPU (PaperCuda.cu); the loop throws BackendUnavailable without
/// one.
PaperLoop MakePaperLoopOnGpu(const TriangleMesh& mesh, const PaperOptions& options);

/// A position, loaded in one instruction: x, y as in the paper, or x, y, z and padding.
template <typename Real, int Size>
struct alignas((Size == 2 ? 2 : 4) * sizeof(Real)) PaperPoint
{
  using Number = Real;
  static constexpr int Dimension = Size;
  Real Values[Size == 2 ? 2 : 4];
};

template <typename Real, int Size>
DELAUNAYFLIP_HOST_DEVICE PaperPoint<Real, Size> operator-(
  const PaperPoint<Real, Size>& p, const PaperPoint<Real, Size>& q)
{
  PaperPoint<Real, Size> difference{};
  for (int axis = 0; axis < Size; ++axis)
  {
    difference.Values[axis] = p.Values[axis] - q.Values[axis];
  }
  return difference;
}

template <typename Real, int Size>
DELAUNAYFLIP_HOST_DEVICE Real Dot(const PaperPoint<Real, Size>& p, const PaperPoint<Real, Size>& q)
{
  Real sum = p.Values[0] * q.Values[0] + p.Values[1] * q.Values[1];
  if constexpr (Size == 3)
  {
    sum += p.Values[2] * q.Values[2];
  }
  return sum;
}

template <typename Real>
DELAUNAYFLIP_HOST_DEVICE PaperPoint<Real, 3> Cross(
  const PaperPoint<Real, 3>& p, const PaperPoint<Real, 3>& q)
{
  const Real* u = p.Values;
  const Real* v = q.Values;
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0], 0 };
}

/// The angle p, apex, q in radians. Because of rounding the cosine may lie outside -1 .. 1.
template <typename Point>
DELAUNAYFLIP_HOST_DEVICE typename Point::Number FindAngle(
  const Point& apex, const Point& p, const Point& q)
{
  using Real = typename Point::Number;
  const Point u = p - apex;
  const Point v = q - apex;
  const Real cosine = Dot(u, v) / (std::sqrt(Dot(u, u)) * std::sqrt(Dot(v, v)));
  return std::acos(cosine < Real(-1) ? Real(-1) : (cosine > Real(1) ? Real(1) : cosine));
}

/// Eq. 5, for the edge p-q of the triangles (p, q, a) and (q, p, b): whether the opposite angles
/// sum to more than pi + epsilon. False if a number is NaN.
template <typename Real>
struct OppositeAngleTest
{
  Real Limit; ///< pi + epsilon.

  template <typename Point>
  DELAUNAYFLIP_HOST_DEVICE bool IsBad(
    const Point& p, const Point& q, const Point& a, const Point& b) const
  {
    return FindAngle(a, p, q) + FindAngle(b, p, q) > this->Limit;
  }
};

/// Whether the in-circle determinant of a counter-clockwise mesh exceeds epsilon times the sum of
/// the absolute values of its terms.
template <typename Real>
struct InCircleTest
{
  Real Epsilon;

  using Point = PaperPoint<Real, 2>;

  DELAUNAYFLIP_HOST_DEVICE bool IsBad(
    const Point& p, const Point& q, const Point& a, const Point& b) const
  {
    const Point sides[] = { p - b, q - b, a - b };
    Real sum = 0, magnitude = 0;
    for (int i = 0; i < 3; ++i)
    {
      const Point &u = sides[i], &v = sides[(i + 1) % 3], &lifted = sides[(i + 2) % 3];
      const Real left = u.Values[0] * v.Values[1], right = u.Values[1] * v.Values[0];
      const Real lift = Dot(lifted, lifted);
      sum += lift * (left - right);
      magnitude += lift * (std::fabs(left) + std::fabs(right));
    }
    return sum > this->Epsilon * magnitude;
  }
};

/// Section 5.2: whether the normals of the two triangles are "almost parallel".
/// @param cosine of the threshold; at most -1: no threshold.
template <typename Real>
DELAUNAYFLIP_HOST_DEVICE bool AreAlmostParallel(const PaperPoint<Real, 3>& p,
  const PaperPoint<Real, 3>& q, const PaperPoint<Real, 3>& a, const PaperPoint<Real, 3>& b,
  Real cosine)
{
  if (cosine <= Real(-1))
  {
    return true;
  }
  const PaperPoint<Real, 3> m = Cross(q - p, a - p);
  const PaperPoint<Real, 3> n = Cross(p - q, b - q);
  return Dot(m, n) >= cosine * std::sqrt(Dot(m, m)) * std::sqrt(Dot(n, n));
}

/// Two indices: of an edge's ends in Vertices, or of their places in Triangles.
struct alignas(8) IndexPair
{
  std::int32_t First, Second;
};

/// The arrays of section 2. `Of<T>` is a vector on the host, an array of the backend, or a pointer
/// for the threads. Each value of an edge has an array of its own, so that neighbouring threads
/// read neighbouring words.
template <typename Point, template <typename> class Of>
struct PaperArrays
{
  Of<Point> Vertices;
  Of<std::int32_t> Triangles; ///< Three indices of vertices each.
  Of<IndexPair> Ends; ///< v1, v2 of an edge.
  Of<IndexPair> TriangleA; ///< ta: where in Triangles v1 and v2 are.
  Of<IndexPair> TriangleB; ///< tb, the same in the other triangle; -1, -1 at a boundary.
  Of<IndexPair> Opposites; ///< Where in Triangles the opposite vertices are, in ta and in tb.
  Of<std::int32_t> Flags; ///< By triangle: the last iteration in which a thread claimed it.
  Of<std::int32_t> Rotations; ///< By triangle: the one that it rotated with last.
};

template <typename T>
using PaperVector = std::vector<T>;
template <typename T>
using Pointer = T*;

/// Phase 1 of section 3, as the work of one thread for one edge: detection, exclusion and
/// processing.
///
/// Threads read triangles that others are flipping. That is harmless: only a thread that afterwards
/// claims both triangles of its edge changes anything, and then no other thread has flipped them in
/// this iteration, so what it has read is consistent.
template <typename Point, typename Test>
struct DetectAndFlip
{
  PaperArrays<Point, Pointer> Mesh;
  Test EdgeTest;
  typename Point::Number NormalCosine;
  std::int32_t Iteration; ///< 1, 2, ...
  std::int32_t* LastBad; ///< The last iteration that found a bad edge.
  PaperIteration* Counts; ///< This iteration's, or null.

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t edge) const
  {
    if (this->Mesh.TriangleB[edge].First < 0 || !this->IsBad(edge))
    {
      return;
    }
    AtomicStore(this->LastBad, this->Iteration);
    const bool flips =
      this->Take(this->Mesh.TriangleA[edge]) && this->Take(this->Mesh.TriangleB[edge]);
    if (flips)
    {
      this->Flip(edge);
    }
    if (this->Counts)
    {
      AtomicAdd(&this->Counts->Bad, 1u);
      AtomicAdd(&this->Counts->Flipped, flips ? 1u : 0u);
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsBad(std::int64_t edge) const
  {
    const IndexPair ends = this->Mesh.Ends[edge];
    const IndexPair opposites = this->Mesh.Opposites[edge];
    const Point p = this->Mesh.Vertices[ends.First];
    const Point q = this->Mesh.Vertices[ends.Second];
    const Point a = this->Mesh.Vertices[AtomicLoad(this->Mesh.Triangles + opposites.First)];
    const Point b = this->Mesh.Vertices[AtomicLoad(this->Mesh.Triangles + opposites.Second)];
    bool isBad = this->EdgeTest.IsBad(p, q, a, b);
    if constexpr (Point::Dimension == 3)
    {
      isBad = isBad && AreAlmostParallel(p, q, a, b, this->NormalCosine);
    }
    return isBad;
  }

  /// Claims a triangle. Returns whether this thread is the first to do so in this iteration.
  DELAUNAYFLIP_HOST_DEVICE bool Take(const IndexPair& corners) const
  {
    std::int32_t* flag = this->Mesh.Flags + corners.First / 3;
    return AtomicExchange(flag, this->Iteration) != this->Iteration;
  }

  /// The five steps of section 3.1.
  DELAUNAYFLIP_HOST_DEVICE void Flip(std::int64_t edge) const
  {
    std::int32_t* vertices = this->Mesh.Triangles;
    const IndexPair o = this->Mesh.Opposites[edge];
    const IndexPair a = this->Mesh.TriangleA[edge];
    const IndexPair b = this->Mesh.TriangleB[edge];
    const std::int32_t c1 = a.First;
    const std::int32_t c2 = b.Second;
    AtomicStore(vertices + c2, vertices[o.First]);
    AtomicStore(vertices + c1, vertices[o.Second]);
    this->Mesh.TriangleA[edge] = { o.First, c1 };
    this->Mesh.TriangleB[edge] = { c2, o.Second };
    this->Mesh.Opposites[edge] = { a.Second, b.First };
    this->Mesh.Ends[edge] = { vertices[o.First], vertices[c1] };
    this->Mesh.Rotations[a.First / 3] = b.First / 3;
    this->Mesh.Rotations[b.First / 3] = a.First / 3;
  }
};

/// Phase 2: if an edge's ends are no longer where ta (tb) says (eqs. 3 and 4), finds them in the
/// triangle with which its own was rotated.
template <typename Point>
struct RepairReferences
{
  PaperArrays<Point, Pointer> Mesh;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t edge) const
  {
    const IndexPair ends = this->Mesh.Ends[edge];
    this->Repair(ends, this->Mesh.TriangleA[edge], this->Mesh.Opposites[edge].First);
    if (this->Mesh.TriangleB[edge].First >= 0)
    {
      this->Repair(ends, this->Mesh.TriangleB[edge], this->Mesh.Opposites[edge].Second);
    }
  }

private:
  /// @param opposite the index of the third corner.
  DELAUNAYFLIP_HOST_DEVICE void Repair(
    const IndexPair& ends, IndexPair& corners, std::int32_t& opposite) const
  {
    const std::int32_t* vertices = this->Mesh.Triangles;
    if (vertices[corners.First] == ends.First && vertices[corners.Second] == ends.Second)
    {
      return;
    }
    const std::int32_t begin = 3 * this->Mesh.Rotations[corners.First / 3];
    IndexPair found = corners;
    for (std::int32_t i = begin; i < begin + 3; ++i)
    {
      found.First = vertices[i] == ends.First ? i : found.First;
      found.Second = vertices[i] == ends.Second ? i : found.Second;
    }
    opposite = 3 * begin + 3 - found.First - found.Second;
    corners = found;
  }
};

/// Copies a mesh to the backend, runs the loop there and copies the triangles back. A backend has
/// RunPhase(backend, size, step), which calls step(i) for i = 0 .. size - 1.
template <typename Point, typename Test, typename Backend>
PaperResult RunPaperLoop(const PaperArrays<Point, PaperVector>& host, const Test& test,
  const PaperOptions& options, const Backend& backend)
{
  const auto copy = [&](const auto& values)
  {
    using T = typename std::decay_t<decltype(values)>::value_type;
    Array<T> array = backend.template MakeArray<T>(static_cast<std::int64_t>(values.size()));
    backend.Upload(values.data(), static_cast<std::int64_t>(values.size()), array.Data());
    return array;
  };
  PaperArrays<Point, Array> own{ copy(host.Vertices), copy(host.Triangles), copy(host.Ends),
    copy(host.TriangleA), copy(host.TriangleB), copy(host.Opposites), copy(host.Flags),
    copy(host.Rotations) };
  const PaperArrays<Point, Pointer> mesh{ own.Vertices.Data(), own.Triangles.Data(),
    own.Ends.Data(), own.TriangleA.Data(), own.TriangleB.Data(), own.Opposites.Data(),
    own.Flags.Data(), own.Rotations.Data() };
  const auto edges = static_cast<std::int64_t>(host.Ends.size());
  PaperResult result;
  result.Backend = backend.GetName();
  result.Counts.resize(options.CountsIterations ? options.MaximumIterations : 0);
  Array<PaperIteration> counts = copy(result.Counts);
  Array<std::int32_t> lastBad = copy(std::vector<std::int32_t>(1));
  const auto getLastBad = [&] // also waits for all work
  {
    std::int32_t iteration = 0;
    backend.Download(lastBad.Data(), 1, &iteration);
    return iteration;
  };
  getLastBad();
  const auto start = std::chrono::steady_clock::now();
  while (!result.Converged && result.Iterations < options.MaximumIterations)
  {
    const auto iteration = static_cast<std::int32_t>(result.Iterations + 1);
    RunPhase(backend, edges,
      DetectAndFlip<Point, Test>{ mesh, test,
        static_cast<typename Point::Number>(std::cos(options.NormalThreshold * Pi / 180.0)),
        iteration, lastBad.Data(),
        options.CountsIterations ? counts.Data() + result.Iterations : nullptr });
    result.Converged = getLastBad() != iteration;
    if (!result.Converged)
    {
      RunPhase(backend, edges, RepairReferences<Point>{ mesh });
      ++result.Iterations;
    }
  }
  getLastBad();
  result.FlipSeconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.Counts.resize(options.CountsIterations ? result.Iterations : 0);
  backend.Download(
    counts.Data(), static_cast<std::int64_t>(result.Counts.size()), result.Counts.data());
  result.Triangles.resize(host.Triangles.size());
  backend.Download(
    mesh.Triangles, static_cast<std::int64_t>(result.Triangles.size()), result.Triangles.data());
  return result;
}

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

/// @param runOn runOn(loop) calls loop(backend).
template <typename Real, int Dimension, typename Test, typename RunOn>
PaperLoop BindLoop(const TriangleMesh& mesh, const Test& test, const RunOn& runOn)
{
  using Arrays = PaperArrays<PaperPoint<Real, Dimension>, PaperVector>;
  const auto arrays =
    std::make_shared<const Arrays>(MakePaperArrays<PaperPoint<Real, Dimension>>(mesh));
  return [=](const PaperOptions& options)
  {
    return runOn(
      [&](const auto& backend) { return RunPaperLoop(*arrays, test, options, backend); });
  };
}

template <typename Real, typename RunOn>
PaperLoop ChooseLoop(const TriangleMesh& mesh, const PaperOptions& options, const RunOn& runOn)
{
  const OppositeAngleTest<Real> angles{ static_cast<Real>(Pi + options.Epsilon) };
  const InCircleTest<Real> inCircle{ static_cast<Real>(options.Epsilon) };
  return options.Dimension == 3                     ? BindLoop<Real, 3>(mesh, angles, runOn)
    : options.Test == PaperTestKind::OppositeAngles ? BindLoop<Real, 2>(mesh, angles, runOn)
                                                    : BindLoop<Real, 2>(mesh, inCircle, runOn);
}

}

#endif
