// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "Machine.h"
#include "MeshDivision.h"
#include "OtherGroup.h"
#include "PieceFlip.h"
#include "Records.h"

#ifdef DELAUNAYFLIP_HAS_MPI
#include <mpi.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
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

/// What a rank has sent to others.
struct GroupMeter
{
  std::int64_t BytesSent = 0;
  std::int64_t Exchanges = 0;
  std::int64_t Gathers = 0;
  double Seconds = 0.0; ///< In these, waiting included.
};

/// Another group, with its messages measured.
class MeteredGroup : public OtherGroup
{
public:
  MeteredGroup(PieceGroup& group, GroupMeter& meter)
    : OtherGroup(group),
      Meter(meter)
  {
  }

  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    for (int rank = 0; rank < this->GetSize(); ++rank)
    {
      this->Meter.BytesSent += rank == this->GetRank() ? 0 : messages[rank].size();
    }
    ++this->Meter.Exchanges;
    const auto start = Clock::now();
    std::vector<Message> received = OtherGroup::Exchange(std::move(messages));
    this->Meter.Seconds += SecondsSince(start);
    return received;
  }
  std::vector<Message> Gather(const Message& message) override
  {
    this->Meter.BytesSent += (this->GetSize() - 1) * message.size();
    ++this->Meter.Gathers;
    const auto start = Clock::now();
    std::vector<Message> received = OtherGroup::Gather(message);
    this->Meter.Seconds += SecondsSince(start);
    return received;
  }

private:
  GroupMeter& Meter;
};

#ifdef DELAUNAYFLIP_HAS_MPI
/// The processes of an mpirun. Messages have at most 2^31 - 1 bytes together.
class MpiGroup : public PieceGroup
{
public:
  int GetRank() const override
  {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
  }
  int GetSize() const override
  {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
  }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    std::vector<int> sizes, sizesBack(messages.size());
    Message all;
    for (const Message& message : messages)
    {
      sizes.push_back(static_cast<int>(message.size()));
      all.insert(all.end(), message.begin(), message.end());
    }
    MPI_Alltoall(sizes.data(), 1, MPI_INT, sizesBack.data(), 1, MPI_INT, MPI_COMM_WORLD);
    Message back(std::accumulate(sizesBack.begin(), sizesBack.end(), std::size_t(0)));
    if (std::max(all.size(), back.size()) > std::numeric_limits<int>::max())
    {
      throw std::runtime_error("messages of more than 2^31 bytes");
    }
    std::vector<int> begins(sizes.size()), beginsBack(sizes.size());
    std::partial_sum(sizes.begin(), sizes.end() - 1, begins.begin() + 1);
    std::partial_sum(sizesBack.begin(), sizesBack.end() - 1, beginsBack.begin() + 1);
    MPI_Alltoallv(all.data(), sizes.data(), begins.data(), MPI_CHAR, back.data(), sizesBack.data(),
      beginsBack.data(), MPI_CHAR, MPI_COMM_WORLD);
    for (std::size_t i = 0; i < messages.size(); ++i)
    {
      const char* begin = back.data() + beginsBack[i];
      messages[i].assign(begin, begin + sizesBack[i]);
    }
    return messages;
  }
  std::vector<Message> Gather(const Message& message) override
  {
    return this->Exchange(std::vector<Message>(this->GetSize(), message));
  }
};
#endif

struct Measure
{
  double Seconds = 0.0;
  double CpuSeconds = 0.0; ///< The sum over all threads.
  PiecesReport Report;
  GroupMeter Meter; ///< That of the rank that sent most.
  double Load = 1.0;
  std::uint64_t Hash = 14695981039346656037u; ///< FNV-1a.
  std::uint64_t Set = 0;
};

/// Hashes some triangles after others.
template <typename Id>
std::uint64_t Hash(std::uint64_t hash, const std::vector<Id>& ids)
{
  for (const Id id : ids)
  {
    hash = (hash ^ static_cast<std::uint64_t>(id)) * 1099511628211u;
  }
  return hash;
}

template <typename Work>
void TakeTime(Measure& measure, const Work& work)
{
  const std::clock_t cpu = std::clock();
  const auto start = Clock::now();
  work();
  measure.Seconds = SecondsSince(start);
  measure.CpuSeconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
}

/// The values of all ranks.
template <typename T>
std::vector<T> GatherValues(PieceGroup& group, const T& value)
{
  Message own;
  Put(own, value);
  std::vector<T> values;
  for (const Message& message : group.Gather(own))
  {
    values.push_back(MessageReader(message).Get<T>());
  }
  return values;
}

/// Flips the piece of a rank.
/// @param flipped where the result goes; later runs reuse its memory.
/// @returns on every rank the measure of all.
Measure FlipAsRank(
  PieceGroup& group, const OwnPiece& piece, const FlipOptions& options, FlippedPiece& flipped)
{
  Measure measure;
  MeteredGroup metered(group, measure.Meter);
  group.Gather({});
  TakeTime(measure,
    [&]
    {
      measure.Report = FlipPiece(piece.View(), options, metered, flipped);
      group.Gather({});
    });
#ifdef DELAUNAYFLIP_HAS_MPI
  const std::vector<double> cpu = GatherValues(group, measure.CpuSeconds);
  measure.CpuSeconds = std::accumulate(cpu.begin(), cpu.end(), 0.0);
#endif
  const std::vector<GroupMeter> meters = GatherValues(group, measure.Meter);
  measure.Meter = *std::max_element(meters.begin(), meters.end(),
    [](const GroupMeter& a, const GroupMeter& b) { return a.BytesSent < b.BytesSent; });
  const std::vector<std::size_t> sizes = GatherValues(group, flipped.FlipCounts.size());
  measure.Load = static_cast<double>(*std::max_element(sizes.begin(), sizes.end())) *
    group.GetSize() / static_cast<double>(measure.Report.Triangles);
  for (int rank = 0; rank < group.GetSize(); ++rank)
  {
    const bool isNext = rank == group.GetRank();
    const std::uint64_t hash = isNext ? Hash(measure.Hash, flipped.Triangles) : 0;
    measure.Hash = GatherValues(group, hash)[rank];
  }
  return measure;
}

void Print(const Settings& settings, const Measure& measure)
{
  for (const auto& [name, value] : settings)
  {
    std::printf("%s\"%s\": \"%s\"", name == settings.begin()->first ? "{" : ", ", name.c_str(),
      value.c_str());
  }
  const PiecesReport& report = measure.Report;
  const std::pair<const char*, double> numbers[] = { { "seconds", measure.Seconds },
    { "cpu_seconds", measure.CpuSeconds }, { "communication_seconds", measure.Meter.Seconds },
    { "build_seconds", report.BuildSeconds }, { "flip_seconds", report.FlipSeconds },
    { "triangles", report.Triangles }, { "flips", report.TotalFlips }, { "rounds", report.Rounds },
    { "moved", report.MovedTriangles }, { "seam_edges", report.SeamEdges },
    { "load", measure.Load }, { "bytes_sent", measure.Meter.BytesSent },
    { "exchanges", measure.Meter.Exchanges }, { "gathers", measure.Meter.Gathers } };
  for (const auto& [name, number] : numbers)
  {
    std::printf(", \"%s\": %.12g", name, number);
  }
  std::printf(
    ", \"backend\": \"%s\", \"hash\": \"%llx\", \"set\": \"%llx\", \"machine\": \"%s\"}\n",
    report.Backend.c_str(), static_cast<unsigned long long>(measure.Hash),
    static_cast<unsigned long long>(measure.Set), DescribeMachine().c_str());
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
void PrintFastest(const Settings& settings, bool prints, const Flip& flip)
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
  if (prints)
  {
    Print(settings, best);
  }
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
  // An odd number of tiles per side: pieces must not be cut along the good borders of tiles.
  constexpr double PointsPerTile = 100000.0;
  const double tiles = static_cast<double>(points) / PointsPerTile;
  const auto side = static_cast<std::int32_t>(std::ceil(std::sqrt(tiles))) | 1;
  OwnedMesh<float> mesh = MakeTiledBadMesh(points, side, 1);
  for (std::size_t i = 0; isSurface && i < mesh.Points.size(); i += 3)
  {
    const double x = mesh.Points[i];
    const double y = mesh.Points[i + 1];
    mesh.Points[i + 2] = static_cast<float>(0.05 * std::sin(20.0 * x) * std::cos(17.0 * y));
  }
  return mesh;
}

#ifdef DELAUNAYFLIP_HAS_MPI
void Run(Settings settings)
{
  MpiGroup group;
  settings["pieces"] = std::to_string(group.GetSize());
  const OwnPiece piece =
    std::move(DivideMesh(MakeMesh(settings).View(), group.GetSize())[group.GetRank()]);
  std::vector<int> devices = ParseDevices(settings.at("devices"));
  if (!devices.empty())
  {
    devices = { devices[group.GetRank() % devices.size()] };
  }
  const FlipOptions options = MakeOptions(settings, devices);
  FlippedPiece flipped;
  PrintFastest(settings, group.GetRank() == 0,
    [&](bool) { return FlipAsRank(group, piece, options, flipped); });
}
#else
std::uint64_t HashSet(const std::vector<std::int32_t>& ids)
{
  std::uint64_t set = 0;
  for (std::size_t i = 0; i < ids.size(); i += 3)
  {
    const std::int32_t* t = ids.data() + i;
    const auto first = std::min_element(t, t + 3) - t;
    const auto get = [=](std::ptrdiff_t slot)
    { return static_cast<std::uint64_t>(t[(first + slot) % 3]); };
    set += ScatterBits(get(0) + ScatterBits(get(1) + ScatterBits(get(2))));
  }
  return set;
}

void Run(const Settings& settings)
{
  OwnedMesh<float> mesh = MakeMesh(settings);
  const int count = std::atoi(settings.at("pieces").c_str());
  const std::vector<int> devices = ParseDevices(settings.at("devices"));
  FlipOptions options = MakeOptions(settings, devices);
  if (count > 0 && settings.at("ranks") != "0")
  {
    const std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), count);
    std::vector<FlippedPiece> flipped(count);
    std::vector<int> turns;
    for (int rank = 0; rank < count && !devices.empty(); ++rank)
    {
      turns.push_back(rank % static_cast<int>(devices.size()));
    }
    PrintFastest(settings, true,
      [&](bool)
      {
        Measure measure;
        RunInThreads(
          count,
          [&](PieceGroup& group)
          {
            const int rank = group.GetRank();
            FlipOptions own = options;
            own.Device = devices.empty() ? -1 : devices[turns[rank]];
            Measure ofRank = FlipAsRank(group, pieces[rank], own, flipped[rank]);
            if (rank == 0)
            {
              measure = std::move(ofRank);
            }
          },
          turns);
        return measure;
      });
    return;
  }
  // Undivided, or in pieces without ranks.
  options.Devices = devices;
  options.NumberOfPieces = count;
  PrintFastest(settings, true,
    [&](bool isLast)
    {
      std::vector<std::int32_t> copy(isLast ? 0 : mesh.Triangles.size());
      std::vector<std::int32_t>& ids = isLast ? mesh.Triangles : copy;
      const MutableTriangleArray triangles(ids.data(), mesh.NumberOfTriangles());
      const TriangleMesh given = mesh.View();
      Measure measure;
      TakeTime(measure,
        [&]
        {
          if (count > 0)
          {
            measure.Report = FlipInPieces(given, options, triangles);
          }
          else
          {
            static_cast<FlipReport&>(measure.Report) = FlipToDelaunay(given, options, triangles);
          }
        });
      measure.Hash = Hash(measure.Hash, ids);
      measure.Set = HashSet(ids);
      return measure;
    });
}
#endif

}

int main(int argc, char** argv)
{
#ifdef DELAUNAYFLIP_HAS_MPI
  MPI_Init(&argc, &argv);
#endif
  int status = 0;
  try
  {
    Run(ReadSettings(argc, argv));
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    status = 1;
  }
#ifdef DELAUNAYFLIP_HAS_MPI
  status == 0 ? MPI_Finalize() : MPI_Abort(MPI_COMM_WORLD, 1);
#endif
  return status;
}
