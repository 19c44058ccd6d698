// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "Machine.h"
#include "PointSets.h"
#if defined(DELAUNAYFLIP_HAS_CUDA)
#include "TestDevice.h"
#endif

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Usage: delaunay-flip-point-benchmark [--points N...] [--sets NAME...] [--threads T...] [...]
/// Times the triangulation of sets of points, from arrays of doubles to arrays of 32-bit ids, on
/// threads and on a GPU, and CGAL on one thread. Prints a table with medians in milliseconds, the
/// smallest and the largest time, how many times as fast as CGAL that is, and device memory.
/// compare.py has other programs. With --ratios it prints one table instead: for every set and
/// number of points the processor time of the engine on one thread, divided by that of CGAL. Both
/// run in turn, and the least time of each counts, so that other work on the machine matters
/// little. With --angle, points are refined to that smallest angle, and CGAL's mesher does it, too.

namespace delaunayflip
{
namespace
{

using Places = std::vector<Place>;
using Random = std::mt19937_64;

/// Segments from points to others that are a few triangles away.
std::vector<std::int64_t> DrawSegments(
  const std::vector<std::int32_t>& triangles, std::int64_t points, std::int64_t count)
{
  constexpr int Steps = 4;
  std::vector<std::int64_t> triangleOf(points, 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    triangleOf[triangles[i]] = static_cast<std::int64_t>(i / 3);
  }
  Random random(6);
  std::vector<std::int64_t> segments;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto from = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(points));
    std::int64_t to = from;
    for (int step = 0; step < Steps; ++step)
    {
      to = triangles[3 * triangleOf[to] + static_cast<std::int64_t>(random() % 3)];
    }
    segments.insert(segments.end(), { from, to });
  }
  return segments;
}

/// Those of the segments that do not cross an earlier one.
std::vector<std::int64_t> KeepInserted(
  const std::vector<std::int64_t>& segments, const std::vector<std::int64_t>& edges)
{
  std::vector<std::int64_t> kept;
  std::size_t next = 0; // the edges of a segment are a path from its start to its end
  for (std::size_t i = 0; i < segments.size(); i += 2)
  {
    std::int64_t at = segments[i];
    std::size_t edge = next;
    while (at != segments[i + 1] && edge < edges.size() && edges[edge] == at)
    {
      at = edges[edge + 1];
      edge += 2;
    }
    if (at == segments[i + 1] && edge > next)
    {
      kept.insert(kept.end(), { segments[i], segments[i + 1] });
      next = edge;
    }
  }
  return kept;
}

//------------------------------------------------------------------------------
struct Result
{
  double Milliseconds = 0.0;
  std::int64_t Triangles = 0;
  std::string Note;
};

PointInput View(const Places& places, const std::vector<std::int64_t>& segments)
{
  PointInput input;
  input.Points = PlaneArray(places.front().data(), static_cast<std::int64_t>(places.size()), 2);
  input.Segments = segments.empty() ? nullptr : segments.data();
  input.NumberOfSegments = static_cast<std::int64_t>(segments.size() / 2);
  return input;
}

/// Refines the points, and the edges of their hull.
/// @param angle in degrees.
Result TimeRefinement(const PointInput& input, BackendKind backend, int threads, double angle)
{
  PointOptions options;
  options.Backend = backend;
  options.NumberOfThreads = threads;
  options.MinimumAngle = angle;
  const Clock::time_point start = Clock::now();
  FlipSession session(input, options);
  session.Advance();
  const std::int64_t count = session.GetReport().Triangles;
  std::vector<std::int32_t> triangles(3 * count);
  session.StoreTriangles(MutableTriangleArray(triangles.data(), count));
  const double milliseconds = MillisecondsSince(start);
  const PointCounts& counts = session.GetReport().FromPoints;
  return { milliseconds, count,
    std::to_string(counts.Used) + " points, " + std::to_string(counts.RefinementRounds) +
      " rounds, smallest angle " + std::to_string(session.GetReport().MinimumAngleAfter) };
}

Result TimeEngine(const PointInput& input, BackendKind backend, int threads)
{
  PointOptions options;
  options.Backend = backend;
  options.NumberOfThreads = threads;
  std::vector<std::int32_t> triangles(6 * input.Points.Count);
  const Clock::time_point start = Clock::now();
  FlipSession session(input, options);
  const double build = MillisecondsSince(start);
  session.Advance();
  const std::int64_t count = session.GetReport().Triangles;
  const double flips = MillisecondsSince(start) - build;
  session.StoreTriangles(MutableTriangleArray(triangles.data(), count));
  const FlipReport& report = session.GetReport();
  const auto points = static_cast<double>(input.Points.Count);
  char note[128];
  std::snprintf(note, sizeof note,
    "build %.1f, flips %.1f; per point %.2f bad edges and %.2f flips, %zu iterations", build, flips,
    static_cast<double>(report.NonDelaunayBefore) / points,
    static_cast<double>(report.TotalFlips) / points, report.Iterations.size());
  return { MillisecondsSince(start), count, note };
}

/// The most device memory since the last call of TakePeakCudaMemory.
std::string DescribeMemory(const PointInput& input)
{
  char note[64];
  std::snprintf(note, sizeof note, "%.1f bytes of device memory per point",
    static_cast<double>(TakePeakCudaMemory()) / static_cast<double>(input.Points.Count));
  return note;
}

#if defined(DELAUNAYFLIP_HAS_CUDA)
/// From device memory to device memory.
Result TimeOnDevice(const PointInput& host)
{
  const DeviceValues<double> points(
    std::vector<double>(host.Points.Doubles, host.Points.Doubles + 2 * host.Points.Count));
  DeviceValues<std::int32_t> triangles(std::vector<std::int32_t>(6 * host.Points.Count));
  PointInput input = host;
  input.Points = PlaneArray(points.Data(), host.Points.Count, 2);
  input.OnDevice = true;
  double milliseconds = 0.0;
  std::int64_t count = 0;
  TakePeakCudaMemory(); // of earlier runs
  {
    const Clock::time_point start = Clock::now();
    FlipSession session(input, PointOptions());
    session.Advance();
    count = session.GetReport().Triangles;
    session.StoreTriangles(MutableTriangleArray(triangles.Data(), count), DeviceStream());
    milliseconds = MillisecondsSince(start);
  } // its memory is measured when it is free
  return { milliseconds, count, DescribeMemory(host) };
}
#endif

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Result TimeCgal(const PointInput& input)
{
  std::vector<Kernel::Point_2> points;
  for (std::int64_t i = 0; i < input.Points.Count; ++i)
  {
    points.emplace_back(input.Points.Get(i, 0), input.Points.Get(i, 1));
  }
  const Clock::time_point start = Clock::now();
  if (input.NumberOfSegments == 0)
  {
    CGAL::Delaunay_triangulation_2<Kernel> triangulation(points.begin(), points.end());
    return { MillisecondsSince(start), static_cast<std::int64_t>(triangulation.number_of_faces()),
      "" };
  }
  CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag>
    triangulation;
  triangulation.insert(points.begin(), points.end());
  const double before = MillisecondsSince(start);
  std::vector<std::pair<std::size_t, std::size_t>> pairs; // CGAL's fastest way, by indices
  for (std::int64_t i = 0; i < input.NumberOfSegments; ++i)
  {
    pairs.emplace_back(input.Segments[2 * i], input.Segments[2 * i + 1]);
  }
  const Clock::time_point again = Clock::now();
  triangulation.clear();
  triangulation.insert_constraints(points.begin(), points.end(), pairs.begin(), pairs.end());
  char note[64];
  std::snprintf(note, sizeof note, "%.1f without segments", before);
  return { MillisecondsSince(again), static_cast<std::int64_t>(triangulation.number_of_faces()),
    note };
}

/// CGAL's mesher, with the edges of the hull as constraints.
Result TimeCgalRefinement(const PointInput& input, double angle)
{
  using Faces = CGAL::Delaunay_mesh_face_base_2<Kernel>;
  using Vertices = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
  using Mesh = CGAL::Constrained_Delaunay_triangulation_2<Kernel,
    CGAL::Triangulation_data_structure_2<Vertices, Faces>>;
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Mesh>;
  std::vector<Kernel::Point_2> points, hull;
  for (std::int64_t i = 0; i < input.Points.Count; ++i)
  {
    points.emplace_back(input.Points.Get(i, 0), input.Points.Get(i, 1));
  }
  const Clock::time_point start = Clock::now();
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  Mesh mesh;
  mesh.insert(points.begin(), points.end());
  for (std::size_t i = 0; i < hull.size(); ++i)
  {
    mesh.insert_constraint(hull[i], hull[(i + 1) % hull.size()]);
  }
  const double sine = std::sin(angle * M_PI / 180.0);
  CGAL::refine_Delaunay_mesh_2(mesh, Criteria(sine * sine, 0.0));
  return { MillisecondsSince(start), static_cast<std::int64_t>(mesh.number_of_faces()),
    std::to_string(mesh.number_of_vertices()) + " points" };
}

//------------------------------------------------------------------------------
/// Prints the row of a way to triangulate. @returns its median.
double PrintRow(
  const std::string& name, int repetitions, double cgal, const std::function<Result()>& run)
{
  std::vector<double> times;
  Result result;
  for (int i = 0; i < repetitions; ++i)
  {
    result = run();
    times.push_back(result.Milliseconds);
  }
  std::sort(times.begin(), times.end());
  const double median = times[times.size() / 2];
  std::printf("| %-20s | %9.2f | %9.2f - %9.2f | %7.2f | %9lld | %s |\n", name.c_str(), median,
    times.front(), times.back(), cgal > 0.0 ? cgal / median : 1.0,
    static_cast<long long>(result.Triangles), result.Note.c_str());
  std::fflush(stdout);
  return median;
}

//------------------------------------------------------------------------------
/// Calls run() until all of its calls have taken some milliseconds. @returns the processor time of
/// one call in microseconds.
double MeasureProcessorTime(const std::function<Result()>& run)
{
  constexpr double Enough = 0.004 * CLOCKS_PER_SEC;
  const std::clock_t start = std::clock();
  int calls = 0;
  double taken = 0.0;
  while (taken < Enough)
  {
    run();
    ++calls;
    taken = static_cast<double>(std::clock() - start);
  }
  return 1e6 * taken / CLOCKS_PER_SEC / calls;
}

struct Plan
{
  std::vector<std::int64_t> Sizes{ 1000000 };
  std::vector<std::string> Names;
  std::vector<int> Threads{ 1, 2 };
  std::int64_t Segments = 0;
  int Repetitions = 5;
  bool HasCgal = true;
  bool PrintsRatios = false;
  double Angle = 0.0; ///< The smallest one to refine to; 0: no refinement.
};

/// Prints a cell of the table of ratios.
void PrintRatio(const Places& places, int repetitions)
{
  const PointInput input = View(places, {});
  double engine = INFINITY, cgal = INFINITY;
  for (int i = 0; i < repetitions; ++i)
  {
    engine = std::min(
      engine, MeasureProcessorTime([&] { return TimeEngine(input, BackendKind::Threads, 1); }));
    cgal = std::min(cgal, MeasureProcessorTime([&] { return TimeCgal(input); }));
  }
  const auto count = static_cast<double>(places.size());
  std::printf(" %.2f (%.2f / %.2f) |", engine / cgal, engine / count, cgal / count);
  std::fflush(stdout);
}

/// In brackets the microseconds per point of both.
void PrintRatios(const std::vector<PointSet>& sets, const Plan& plan)
{
  std::printf("\n| set |");
  for (const std::int64_t count : plan.Sizes)
  {
    std::printf(" %lld points |", static_cast<long long>(count));
  }
  std::printf("\n|---|");
  for (std::size_t i = 0; i < plan.Sizes.size(); ++i)
  {
    std::printf("---|");
  }
  for (const PointSet& set : sets)
  {
    std::printf("\n| %s |", set.Name);
    for (const std::int64_t count : plan.Sizes)
    {
      PrintRatio(MakePlaces(set, count), plan.Repetitions);
    }
  }
  std::printf("\n");
}

/// @param print prints a row.
template <typename Print>
void PrintRefinement(const PointInput& input, const Plan& plan, const Print& print)
{
  for (const int threads : plan.Threads)
  {
    print(std::to_string(threads) + " threads",
      [&] { return TimeRefinement(input, BackendKind::Threads, threads, plan.Angle); });
  }
  if (HasCudaDevice())
  {
    TimeRefinement(input, BackendKind::CUDA, 0, plan.Angle); // the first use takes longer
    print(
      "GPU, host to host", [&] { return TimeRefinement(input, BackendKind::CUDA, 0, plan.Angle); });
  }
  else
  {
    std::printf("| GPU | skipped: there is none | | | | |\n");
  }
}

/// @returns the medians of the engine's rows.
std::vector<std::pair<std::string, double>> RunSet(
  const PointSet& set, std::int64_t count, const Plan& plan)
{
  const Places places = MakePlaces(set, count);
  std::vector<std::int64_t> segments;
  if (plan.Segments > 0)
  {
    const PointInput points = View(places, segments);
    FlipSession session(points, PointOptions());
    session.Advance();
    std::vector<std::int32_t> triangles(3 * session.GetReport().Triangles);
    session.StoreTriangles(MutableTriangleArray(triangles.data(), session.GetReport().Triangles));
    segments = DrawSegments(triangles, count, plan.Segments);
    FlipSession inserted(View(places, segments), PointOptions());
    inserted.Advance();
    segments = KeepInserted(segments, inserted.ListSegmentEdges());
  }
  const PointInput input = View(places, segments);
  std::printf(
    "\n%s, %lld points, %lld segments\n\n| | ms | least - most | times CGAL | triangles | |\n"
    "|---|---|---|---|---|---|\n",
    set.Name, static_cast<long long>(count), static_cast<long long>(segments.size() / 2));
  double cgal = 0.0;
  if (plan.HasCgal)
  {
    cgal = PrintRow("CGAL, 1 thread", std::min(plan.Repetitions, 3), 0.0,
      [&] { return plan.Angle > 0.0 ? TimeCgalRefinement(input, plan.Angle) : TimeCgal(input); });
  }
  std::vector<std::pair<std::string, double>> medians;
  const auto print = [&](const std::string& name, const std::function<Result()>& run)
  { medians.emplace_back(name, PrintRow(name, plan.Repetitions, cgal, run)); };
  if (plan.Angle > 0.0)
  {
    PrintRefinement(input, plan, print);
    return medians;
  }
  for (const int threads : plan.Threads)
  {
    print(std::to_string(threads) + " threads",
      [&] { return TimeEngine(input, BackendKind::Threads, threads); });
  }
  if (HasCudaDevice())
  {
    TakePeakCudaMemory();
    TimeEngine(input, BackendKind::CUDA, 0); // the first use of a GPU takes longer
    std::printf("| GPU, host to host | %s | | | | |\n", DescribeMemory(input).c_str());
    print("GPU, host to host", [&] { return TimeEngine(input, BackendKind::CUDA, 0); });
#if defined(DELAUNAYFLIP_HAS_CUDA)
    print("GPU, device memory", [&] { return TimeOnDevice(input); });
#endif
  }
  else
  {
    std::printf("| GPU | skipped: there is none | | | | |\n");
  }
  return medians;
}

/// Times a set also with twice as many points, because its time may grow faster than its size.
void RunTwice(const PointSet& set, std::int64_t count, const Plan& plan)
{
  const auto once = RunSet(set, count, plan);
  if (set.IsHard)
  {
    const auto twice = RunSet(set, 2 * count, plan);
    std::printf("\nTime with twice as many points:");
    for (std::size_t i = 0; i < once.size(); ++i)
    {
      std::printf("%s %.2f times (%s)", i > 0 ? "," : "", twice[i].second / once[i].second,
        once[i].first.c_str());
    }
    std::printf("\n");
  }
}

}
}

int main(int argc, char* argv[])
{
  using namespace delaunayflip;
  Plan plan;
  CLI::App application("Times the triangulation of points.");
  application.add_option("--points", plan.Sizes, "how many points");
  application.add_option("--sets", plan.Names, "names of sets; none: all");
  application.add_option("--threads", plan.Threads, "numbers of threads");
  application.add_option("--segments", plan.Segments, "how many segments, each across a few edges");
  application.add_option("--repetitions", plan.Repetitions, "runs per row");
  application.add_flag("!--no-cgal", plan.HasCgal, "leave CGAL out");
  application.add_flag(
    "--ratios", plan.PrintsRatios, "a table of times on one thread over CGAL's, of all sizes");
  application.add_option("--angle", plan.Angle, "refine the points to this smallest angle");
  CLI11_PARSE(application, argc, argv);
  std::printf("%s\n", DescribeMachine().c_str());
  std::vector<PointSet> sets;
  const auto& names = plan.Names;
  std::copy_if(ListPointSets().begin(), ListPointSets().end(), std::back_inserter(sets),
    [&](const PointSet& set)
    { return names.empty() || std::find(names.begin(), names.end(), set.Name) != names.end(); });
  if (plan.PrintsRatios)
  {
    PrintRatios(sets, plan);
    return 0;
  }
  for (const std::int64_t count : plan.Sizes)
  {
    for (const PointSet& set : sets)
    {
      RunTwice(set, count, plan);
    }
  }
  return 0;
}
