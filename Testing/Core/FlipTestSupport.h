// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPTESTSUPPORT_H
#define DELAUNAYFLIP_FLIPTESTSUPPORT_H

#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

/// @file
/// Helpers of several engine tests: flip copies of meshes, compare meshes, change them.

namespace delaunayflip
{

/// Whether the program is instrumented, and so an order of magnitude slower: tests then use smaller
/// meshes and fewer cases.
#ifdef DELAUNAYFLIP_REDUCED_TESTS
constexpr std::int64_t Reduction = 10;
#else
constexpr std::int64_t Reduction = 1;
#endif

using Point3 = std::array<double, 3>;

/// Triangles in a canonical order: each starts at its smallest id, then all are sorted. Their
/// winding is kept.
using TriangleSet = std::vector<std::array<std::int64_t, 3>>;
TriangleSet ToTriangleSet(const TriangleArray& triangles);
TriangleSet ToTriangleSet(const std::vector<std::int32_t>& triangles);
std::vector<std::int32_t> ToIds(const TriangleSet& triangles);

struct FlipResult
{
  std::vector<std::int32_t> Triangles;
  std::vector<std::int32_t> FlipCounts;
  FlipReport Report;
};

/// The options, with the backend of DELAUNAYFLIP_TEST_BACKEND if they do not choose one.
FlipOptions OnTestBackend(FlipOptions options);

/// A session on that backend. Coordinates that need the CPU's exact arithmetic run on the CPU, as
/// with BackendKind::Auto.
FlipSession MakeSession(const TriangleMesh& mesh, const FlipOptions& options = {});

/// A session from points, on the same backend, that has done all.
FlipSession FlipPoints(const PointInput& points, const PointOptions& options = {});

/// The triangles that a session has now, and their flips.
std::vector<std::int32_t> StoreTriangles(const FlipSession& session);
std::vector<std::int32_t> StoreOrderedTriangles(const FlipSession& session);
std::vector<std::int32_t> StoreFlipCounts(const FlipSession& session);

/// Runs all flips on a copy of the triangles, on the backend that MakeSession chooses.
FlipResult Flip(const TriangleMesh& mesh, const FlipOptions& options = {});

/// A run so many iterations at a time (-1: all at once), on the backend of the options.
FlipResult FlipInSteps(
  const TriangleMesh& mesh, const FlipOptions& options, std::int64_t step = -1);

/// Flip, and reports a failure for a run that does not end by itself, for statistics that do
/// not add up, for topology that has changed, and for counts of bad edges and smallest angles,
/// before and after, that are not those of the audit.
FlipResult FlipAndAudit(const TriangleMesh& mesh, const FlipOptions& options = {});

/// The options on a backend.
FlipOptions OnBackend(BackendKind backend, FlipOptions options = {});

/// The options, by default those of the member's class, with another value of one.
template <typename T, typename Owner, typename Value, typename Options = Owner>
Options With(T Owner::*member, const Value& value, Options options = {})
{
  options.*member = value;
  return options;
}

/// The options with so many threads.
template <typename Options = FlipOptions>
Options WithThreads(int threads, const Options& options = {})
{
  return With(&FlipOptions::NumberOfThreads, threads, options);
}

/// On a surface, by default without feature edges.
FlipOptions OnSurface(double featureAngle = 180.0);

/// In the plane of x and y.
FlipOptions InPlane(TieRuleKind ties = TieRuleKind::Keep);

TriangleArray ViewTriangles(const std::vector<std::int32_t>& triangles);

/// `mesh` with other triangles but the same labels and constraints.
TriangleMesh WithTriangles(const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles);

/// `mesh` with constraint edges, given as pairs of ids.
/// @param toInsert TriangleMesh::ConstraintsToInsert.
TriangleMesh WithConstraints(TriangleMesh mesh, const std::vector<std::int64_t>& ends,
  const unsigned char* toInsert = nullptr);

/// Reports a failure for every count of edges that has changed although flips must not change it.
void ExpectSameTopology(
  const TriangleArray& before, const std::vector<std::int32_t>& after, const FlipReport& report);

/// The number of flips, from the counts of triangles.
std::int64_t SumFlips(const std::vector<std::int32_t>& flipCounts);

/// Reports a failure for rows that break NonDelaunay = Flipped + Excluded + Blocked, and for totals
/// that are not the sums of the rows.
void ExpectConsistentStatistics(const FlipReport& report);

/// Reports a failure for every difference other than times, the backend's name and its fallback.
void ExpectSameStatistics(const FlipReport& a, const FlipReport& b);

/// Reports a failure for every bit that differs.
void ExpectSameResult(const FlipResult& expected, const FlipResult& actual);

/// Names the cases of a suite by their member Name.
inline constexpr auto GetCaseName = [](const auto& test) { return std::string(test.param.Name); };

/// The message of the error that run() throws; "" if it throws none.
template <typename Error, typename Run>
std::string GetMessage(const Run& run)
{
  try
  {
    run();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

/// Reports a failure unless run() throws InvalidMesh with this cell and point. @returns its
/// message.
std::string ExpectInvalidMesh(
  std::int64_t cell, std::int64_t point, const std::function<void()>& run);

/// The count of the first defect with `word` in its text, or 0. Reports a failure if the defect
/// lacks its first ids.
std::int64_t CountDefect(const FlipReport& report, const std::string& word);

bool HasEdge(const std::vector<std::int32_t>& triangles, std::int64_t p, std::int64_t q);

/// Reverses the winding of every triangle.
void ReverseTriangles(std::vector<std::int32_t>& triangles);

/// Random triangles on few points: every kind of edge, degenerate triangles included.
OwnedMesh<double> MakeSoup(std::int32_t points, std::int32_t triangles, std::uint32_t seed);

/// A random integer in [0, count), the same with every standard library.
inline std::int32_t DrawIndex(std::mt19937& random, std::int64_t count)
{
  return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(count));
}

/// One coordinate of the image of (x, y, z) under an affine map.
struct AffineRow
{
  double X, Y, Z, Offset;
};
using AffineMap = std::array<AffineRow, 3>;

/// The mesh with mapped points, in double precision.
template <typename Real>
OwnedMesh<double> Transform(const OwnedMesh<Real>& mesh, const AffineMap& map)
{
  OwnedMesh<double> result;
  result.Triangles = mesh.Triangles;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    for (const AffineRow& row : map)
    {
      result.Points.push_back(row.X * mesh.Points[i] + row.Y * mesh.Points[i + 1] +
        row.Z * mesh.Points[i + 2] + row.Offset);
    }
  }
  return result;
}

/// Uniform scale and offset in x and y.
inline AffineMap ScaleAndMove(double scale, double offset)
{
  return { { { scale, 0, 0, offset }, { 0, scale, 0, offset }, { 0, 0, scale, 0 } } };
}

/// The mesh with its coordinates rounded to float.
OwnedMesh<float> RoundToFloat(const OwnedMesh<double>& mesh);

/// The mesh with a height for every x and y.
OwnedMesh<double> Lift(OwnedMesh<double> mesh, const std::function<double(double, double)>& height);

/// A fan of triangles around point 0 that covers so many turns; closed, or open like a spiral
/// staircase.
OwnedMesh<double> MakeWindingFan(int count, double turns, bool closed);

/// Adds the points, times a factor, and the triangles of another mesh.
template <typename Real>
void Append(OwnedMesh<Real>& mesh, const OwnedMesh<double>& other, double factor = 1.0)
{
  const auto offset = static_cast<std::int32_t>(mesh.NumberOfPoints());
  for (const double coordinate : other.Points)
  {
    mesh.Points.push_back(static_cast<Real>(factor * coordinate));
  }
  for (const std::int32_t id : other.Triangles)
  {
    mesh.Triangles.push_back(id + offset);
  }
}

}

#endif
