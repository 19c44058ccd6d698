// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "Machine.h"
#include "MeshDivision.h"
#include "MeteredGroup.h"
#include "PieceFlip.h"
#include "Records.h"

#ifdef DELAUNAYFLIP_HAS_MPI
#include "MpiGroup.h"
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// delaunay-flip-pieces: flips one mesh in pieces, a rank each in a thread of its own, and prints a
/// line of JSON. Usage: delaunay-flip-pieces [NAME=VALUE ...]
///
///     points=500000   of the mesh
///     mesh=random     a random bad mesh, the worst that we know; or grid: a grid with jitter
///     pieces=2        0: undivided
///     ranks=1         0: no ranks, but FlipInPieces, which divides the mesh and flips it in place
///     threads=1       of each rank
///     surface=0       1: the random mesh gets hills, and is flipped by opposite angles
///     feature=180     the feature angle
///     devices=        CUDA's numbers of GPUs, separated by commas: the ranks use them in turn, and
///                     the undivided mesh is on all of them
///     runs=1          the fastest is printed
///
/// delaunay-flip-processes, started by mpirun, does the same with a process for each rank: pieces=
/// does not matter, and CPU seconds are those of all processes.
///
/// `load` is the greatest number of triangles that a rank has in the end over the mean.
///
/// Not measured is how the mesh is made, and how it is divided among ranks. `hash` is one of all
/// triangles in their order: two programs that print the same have made the same result. `set` is
/// one of the triangles of the whole mesh, whatever their order and their first point.

using namespace delaunayflip;

namespace
{

using Clock = std::chrono::steady_clock;
using Settings = std::map<std::string, std::string>;

Settings ReadSettings(int argc, char** argv)
{
  Settings settings{ { "points", "500000" }, { "mesh", "random" }, { "pieces", "2" },
    { "ranks", "1" }, { "threads", "1" }, { "surface", "0" }, { "feature", "180" },
    { "devices", "" }, { "runs", "1" } };
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    const std::size_t sign = word.find('=');
    const auto known = settings.find(word.substr(0, sign));
    if (sign == std::string::npos || known == settings.end())
    {
      throw std::runtime_error("unknown setting: " + word);
    }
    known->second = word.substr(sign + 1);
  }
  return settings;
}

OwnedMesh<float> MakeRandomMesh(std::int64_t points)
{
  // An odd number of tiles per side: pieces must not be cut along tiles, whose borders are good.
  constexpr std::int64_t PointsPerTile = 100000;
  const double tiles = static_cast<double>(points) / static_cast<double>(PointsPerTile);
  const auto side = static_cast<std::int32_t>(std::ceil(std::sqrt(tiles))) | 1;
  return MakeTiledBadMesh(points, side, 1);
}

void AddHills(OwnedMesh<float>& mesh)
{
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const double x = mesh.Points[i];
    const double y = mesh.Points[i + 1];
    mesh.Points[i + 2] = static_cast<float>(0.05 * std::sin(20.0 * x) * std::cos(17.0 * y));
  }
}

struct Measure
{
  double Seconds = 0.0;
  double CpuSeconds = 0.0; ///< Of all threads.
  PiecesReport Report;
  GroupMeter Meter; ///< Of the rank that sent most.
  double Load = 1.0;
  std::uint64_t Hash = 14695981039346656037u; ///< FNV-1a.
  std::uint64_t Set = 0;

  /// @param most triangles of a rank.
  void SetLoad(std::size_t most, int ranks)
  {
    const auto all = static_cast<double>(this->Report.Triangles);
    this->Load = static_cast<double>(most) * ranks / all;
  }

  /// Hashes some triangles.
  template <typename Id>
  void AddToHash(const std::vector<Id>& ids)
  {
    for (const Id id : ids)
    {
      this->Hash = (this->Hash ^ static_cast<std::uint64_t>(id)) * 1099511628211u;
    }
  }

  void AddToSet(const std::vector<std::int32_t>& ids)
  {
    for (std::size_t i = 0; i < ids.size(); i += 3)
    {
      const std::int32_t* t = ids.data() + i;
      const auto first = std::min_element(t, t + 3) - t;
      const auto get = [=](std::ptrdiff_t slot)
      { return static_cast<std::uint64_t>(t[(first + slot) % 3]); };
      this->Set += ScatterBits(get(0) + ScatterBits(get(1) + ScatterBits(get(2))));
    }
  }
};

/// @param work makes a measure but its times.
template <typename Work>
Measure TakeTime(const Work& work)
{
  Measure measure;
  const std::clock_t cpu = std::clock();
  const auto start = Clock::now();
  work(measure);
  measure.Seconds = std::chrono::duration<double>(Clock::now() - start).count();
  measure.CpuSeconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  return measure;
}

#ifdef DELAUNAYFLIP_HAS_MPI
/// @param flipped where the result goes; later runs reuse its memory.
Measure FlipInProcesses(
  MpiGroup& group, const OwnPiece& piece, const FlipOptions& options, FlippedPiece& flipped)
{
  GroupMeter meter;
  group.Wait();
  Measure measure = TakeTime(
    [&](Measure& own)
    {
      MeteredGroup metered(group, meter);
      own.Report = FlipPiece(piece.View(), options, metered, flipped);
      group.Wait();
    });
  measure.CpuSeconds = group.Sum(measure.CpuSeconds);
  const std::uint64_t most = group.PassOn(0,
    [&](std::uint64_t size) { return std::max<std::uint64_t>(size, flipped.FlipCounts.size()); });
  measure.SetLoad(most, group.GetSize());
  measure.Meter = meter;
  measure.Hash = group.PassOn(measure.Hash,
    [&](std::uint64_t hash)
    {
      measure.Hash = hash;
      measure.AddToHash(flipped.Triangles);
      return measure.Hash;
    });
  return measure;
}
#else
/// Undivided, or in pieces without ranks.
Measure FlipInOneProcess(OwnedMesh<float>& mesh, const FlipOptions& options, bool isLast)
{
  std::vector<std::int32_t> copy(isLast ? 0 : mesh.Triangles.size());
  std::vector<std::int32_t>& ids = isLast ? mesh.Triangles : copy;
  const MutableTriangleArray triangles(ids.data(), mesh.NumberOfTriangles());
  const TriangleMesh given = mesh.View();
  Measure measure = TakeTime(
    [&](Measure& own)
    {
      if (options.NumberOfPieces > 0)
      {
        own.Report = FlipInPieces(given, options, triangles);
      }
      else
      {
        static_cast<FlipReport&>(own.Report) = FlipToDelaunay(given, options, triangles);
      }
    });
  measure.AddToHash(ids);
  measure.AddToSet(ids);
  return measure;
}

/// @param flipped where the results go; later runs reuse their memory.
Measure FlipPieces(const std::vector<OwnPiece>& pieces, const FlipOptions& options,
  const std::vector<int>& devices, std::vector<FlippedPiece>& flipped)
{
  const int ranks = static_cast<int>(pieces.size());
  std::vector<int> turns;
  for (int rank = 0; rank < ranks && !devices.empty(); ++rank)
  {
    turns.push_back(rank % static_cast<int>(devices.size()));
  }
  std::vector<GroupMeter> meters(ranks);
  flipped.resize(ranks);
  Measure measure = TakeTime(
    [&](Measure& sum)
    {
      RunInThreads(
        ranks,
        [&](PieceGroup& group)
        {
          MeteredGroup metered(group, meters[group.GetRank()]);
          const int rank = group.GetRank();
          FlipOptions own = options;
          own.Device = devices.empty() ? -1 : devices[turns[rank]];
          const PiecesReport report = FlipPiece(pieces[rank].View(), own, metered, flipped[rank]);
          if (rank == 0)
          {
            sum.Report = report;
          }
        },
        turns);
    });
  measure.Meter = *std::max_element(meters.begin(), meters.end(),
    [](const GroupMeter& a, const GroupMeter& b) { return a.BytesSent < b.BytesSent; });
  std::size_t most = 0;
  for (const FlippedPiece& piece : flipped)
  {
    measure.AddToHash(piece.Triangles);
    most = std::max(most, piece.FlipCounts.size());
  }
  measure.SetLoad(most, ranks);
  return measure;
}
#endif

std::string DescribeCounts(const Measure& measure)
{
  const PiecesReport& report = measure.Report;
  std::ostringstream text;
  text << "\"build_seconds\": " << report.BuildSeconds
       << ", \"flip_seconds\": " << report.FlipSeconds << ", \"triangles\": " << report.Triangles
       << ", \"flips\": " << report.TotalFlips << ", \"rounds\": " << report.Rounds
       << ", \"moved\": " << report.MovedTriangles << ", \"seam_edges\": " << report.SeamEdges
       << ", \"load\": " << measure.Load << ", \"bytes_sent\": " << measure.Meter.BytesSent
       << ", \"exchanges\": " << measure.Meter.Exchanges
       << ", \"gathers\": " << measure.Meter.Gathers << ", \"backend\": \"" << report.Backend
       << "\", \"hash\": \"" << std::hex << measure.Hash << "\", \"set\": \"" << measure.Set
       << "\"";
  return text.str();
}

void Print(const Settings& settings, const Measure& measure)
{
  for (const auto& [name, value] : settings)
  {
    std::printf("%s\"%s\": \"%s\"", name == settings.begin()->first ? "{" : ", ", name.c_str(),
      value.c_str());
  }
  std::printf(", \"seconds\": %.4f, \"cpu_seconds\": %.4f, \"communication_seconds\": %.4f, %s, "
              "\"machine\": \"%s\"}\n",
    measure.Seconds, measure.CpuSeconds, measure.Meter.Seconds, DescribeCounts(measure).c_str(),
    DescribeMachine().c_str());
}

FlipOptions MakeOptions(const Settings& settings, const std::vector<int>& devices)
{
  const bool isSurface = settings.at("surface") == "1";
  FlipOptions options;
  options.Geometry = isSurface ? GeometryKind::Surface : GeometryKind::Planar;
  options.TieRule = isSurface ? TieRuleKind::Keep : TieRuleKind::Canonical;
  options.FeatureAngle = std::atof(settings.at("feature").c_str());
  options.Backend = devices.empty() ? BackendKind::Threads : BackendKind::CUDA;
  options.NumberOfThreads = std::atoi(settings.at("threads").c_str());
  options.Device = devices.empty() ? -1 : devices.front();
  return options;
}

/// @param flip makes a measure; it is given whether it is the last run.
template <typename Flip>
Measure FindFastest(const Settings& settings, const Flip& flip)
{
  Measure best;
  const int runs = std::atoi(settings.at("runs").c_str());
  for (int run = 0; run < runs; ++run)
  {
    Measure measure = flip(run + 1 == runs);
    if (run == 0 || measure.Seconds < best.Seconds)
    {
      best = std::move(measure);
    }
  }
  return best;
}

OwnedMesh<float> MakeMesh(const Settings& settings)
{
  const std::int64_t points = std::atoll(settings.at("points").c_str());
  const bool isSurface = settings.at("surface") == "1";
  if (settings.at("mesh") == "grid" && !isSurface)
  {
    return MakeJitteredGrid(points, 1);
  }
  if (settings.at("mesh") != "random")
  {
    throw std::runtime_error("mesh must be random, or grid without surface=1");
  }
  OwnedMesh<float> mesh = MakeRandomMesh(points);
  if (isSurface)
  {
    AddHills(mesh);
  }
  return mesh;
}

#ifdef DELAUNAYFLIP_HAS_MPI
OwnPiece MakePiece(const Settings& settings, const MpiGroup& group)
{
  const OwnedMesh<float> mesh = MakeMesh(settings);
  return std::move(DivideMesh(mesh.View(), group.GetSize())[group.GetRank()]);
}

void Run(Settings settings, MpiGroup& group)
{
  settings["pieces"] = std::to_string(group.GetSize());
  const OwnPiece piece = MakePiece(settings, group);
  std::vector<int> devices = ParseDevices(settings.at("devices"));
  if (!devices.empty())
  {
    devices = { devices[group.GetRank() % devices.size()] };
  }
  const FlipOptions options = MakeOptions(settings, devices);
  FlippedPiece flipped;
  const Measure measure =
    FindFastest(settings, [&](bool) { return FlipInProcesses(group, piece, options, flipped); });
  if (group.GetRank() == 0)
  {
    Print(settings, measure);
  }
}
#else
void Run(const Settings& settings)
{
  OwnedMesh<float> mesh = MakeMesh(settings);
  const int count = std::atoi(settings.at("pieces").c_str());
  const std::vector<int> devices = ParseDevices(settings.at("devices"));
  FlipOptions options = MakeOptions(settings, devices);
  if (count > 0 && settings.at("ranks") != "0")
  {
    const std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), count);
    std::vector<FlippedPiece> flipped;
    Print(settings,
      FindFastest(settings, [&](bool) { return FlipPieces(pieces, options, devices, flipped); }));
    return;
  }
  options.Devices = devices;
  options.NumberOfPieces = count;
  Print(settings,
    FindFastest(settings, [&](bool isLast) { return FlipInOneProcess(mesh, options, isLast); }));
}
#endif

}

int main(int argc, char** argv)
{
#ifdef DELAUNAYFLIP_HAS_MPI
  MpiGroup group(argc, argv);
#endif
  try
  {
#ifdef DELAUNAYFLIP_HAS_MPI
    Run(ReadSettings(argc, argv), group);
#else
    Run(ReadSettings(argc, argv));
#endif
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
#ifdef DELAUNAYFLIP_HAS_MPI
    group.Abort();
#endif
    return 1;
  }
  return 0;
}
