// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkArguments.h"
#include "BenchmarkTable.h"
#include "CudaDevice.h"
#include "DeviceTiming.h"
#include "FilterTiming.h"
#include "GpuDescription.h"
#include "Machine.h"
#include "SectorRates.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <future>
#include <map>
#include <stdexcept>
#include <thread>

/// @file
/// delaunay-flip-gpu-benchmark: compares whole runs on the GPU with CPU threads and CGAL, from the
/// caller's arrays to the caller's arrays. Google Benchmark is for runs of microseconds, which it
/// repeats until the mean is stable. Runs here take many milliseconds: each is timed separately,
/// and the median of a few is reported.

namespace delaunayflip
{
namespace
{

bool Holds(const std::vector<std::int64_t>& values, std::int64_t value)
{
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// The free memory of this machine in bytes; no limit if that is unknown.
double GetFreeMemory()
{
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word)
  {
    double kilobytes = 0.0;
    if (word == "MemAvailable:" && file >> kilobytes)
    {
      return 1024.0 * kilobytes;
    }
  }
  return INFINITY;
}

class GpuBenchmark
{
public:
  explicit GpuBenchmark(const BenchmarkArguments& arguments)
    : Arguments(arguments)
  {
    const std::int64_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (const std::int64_t threads : arguments.Threads)
    {
      if (threads <= cores)
      {
        this->Threads.push_back(static_cast<int>(threads));
      }
    }
  }

  void Run()
  {
    std::printf("%s\n", FormatHeading().c_str());
    this->StartMeshes();
    for (const std::int64_t size : this->Arguments.Sizes)
    {
      this->RunSize(size);
    }
    this->RunSpecialMeshes();
    for (const BenchmarkMesh& mesh : ReadRealMeshes(this->Arguments.MeshFolder))
    {
      this->RunBeside(mesh);
    }
  }

  bool HasFailed() const
  {
    return std::any_of(
      this->Rows.begin(), this->Rows.end(), [](const BenchmarkRow& row) { return row.HasFailed; });
  }

  const std::vector<BenchmarkRow>& GetRows() const { return this->Rows; }

private:
  /// Whether some program is measured on random bad meshes of this size.
  bool IsMeasured(std::int64_t size) const
  {
    return this->HasGpu || Holds(this->Arguments.CpuSizes, size);
  }

  /// Meshes that a single thread makes are made in parallel, before the first is timed.
  void StartMeshes()
  {
    for (const std::int64_t size : this->Arguments.Sizes)
    {
      if (size <= LargestUntiledMesh && this->IsMeasured(size))
      {
        this->Meshes[size] = std::async(std::launch::async, MakeRandomMesh, size);
      }
    }
    for (auto& [size, mesh] : this->Meshes)
    {
      mesh.wait();
    }
  }

  void RunSize(std::int64_t size)
  {
    constexpr double BytesPerPoint =
      160.0; // the mesh as generated, as given to the program, and the result
    if (!this->IsMeasured(size))
    {
      this->SkipSize(size, "skipped: no GPU");
      return;
    }
    if (BytesPerPoint * static_cast<double>(size) > GetFreeMemory())
    {
      this->SkipSize(size, "skipped: too little memory on the host");
      return;
    }
    const auto made = this->Meshes.find(size);
    const BenchmarkMesh mesh =
      made == this->Meshes.end() ? MakeRandomMesh(size) : made->second.get();
    this->RunCuda(mesh);
    if (Holds(this->Arguments.CpuSizes, size))
    {
      this->RunThreads(mesh, this->Threads);
      this->Add(TimeCgal(mesh, this->Arguments.Plan));
    }
    if (size <= LargestUntiledMesh && mesh.Ids.size() == this->Output.size())
    {
      this->Delaunay = mesh;
      this->Delaunay.Name = "already Delaunay";
      this->Delaunay.Ids = this->Output;
    }
  }

  void SkipSize(std::int64_t size, const std::string& note)
  {
    BenchmarkRow row;
    row.Mesh = size <= LargestUntiledMesh ? "random bad" : "random bad, tiled";
    row.Program = "CUDA";
    row.Points = size;
    row.Note = note;
    this->Add(row);
  }

  void RunSpecialMeshes()
  {
    if (!this->Delaunay.Ids.empty())
    {
      const std::int64_t points = this->Delaunay.CountPoints();
      this->RunBeside(this->Delaunay);
      this->Delaunay = BenchmarkMesh();
      this->RunBeside(MakeLatticeMesh(points));
    }
    for (const std::int32_t triangles : { 200, 1000, 10000 })
    {
      this->RunBeside(MakeChainMesh(triangles));
    }
  }

  /// Compares the GPU with all threads of the CPU.
  void RunBeside(const BenchmarkMesh& mesh)
  {
    this->RunCuda(mesh);
    if (!this->Threads.empty())
    {
      this->RunThreads(mesh, { this->Threads.back() });
    }
  }

  void RunCuda(const BenchmarkMesh& mesh)
  {
    this->CudaTotal = NAN;
    this->TotalFlips = -1;
    if (!this->HasGpu)
    {
      BenchmarkRow row;
      row.Mesh = mesh.Name;
      row.Program = "CUDA";
      row.Points = mesh.CountPoints();
      row.Triangles = mesh.CountTriangles();
      row.Note = "skipped: no GPU";
      this->Add(row);
      return;
    }
    FlipOptions options;
    options.Backend = BackendKind::CUDA;
    BenchmarkRow row = TimeEngine(mesh, options, this->Arguments.Plan, this->Output);
    this->CudaTotal = row.Total;
    this->Add(row);
    if (mesh.CountPoints() <= LargestUntiledMesh)
    {
      this->Add(TimeOnDevice<std::int64_t>(mesh, 3, this->Arguments.Plan));
      this->Add(TimeOnDevice<std::int32_t>(mesh, 2, this->Arguments.Plan));
    }
#if defined(DELAUNAYFLIP_HAS_VTK)
    ReleaseCudaMemory(); // the module has its own engine and memory
    this->Add(TimeFilter(mesh, this->Arguments.Plan));
#endif
  }

  void RunThreads(const BenchmarkMesh& mesh, const std::vector<int>& counts)
  {
    for (const int threads : counts)
    {
      FlipOptions options;
      options.Backend = BackendKind::Threads;
      options.NumberOfThreads = threads;
      this->Add(TimeEngine(mesh, options, this->Arguments.Plan, this->Output));
    }
  }

  /// Prints a row at once, because the next may take long. All backends must make the same flips.
  void Add(BenchmarkRow row)
  {
    row.TimesCuda = row.Total / this->CudaTotal;
    if (row.TotalFlips >= 0 && this->TotalFlips >= 0 && row.TotalFlips != this->TotalFlips)
    {
      row.HasFailed = true;
      row.Note = "FAILED: different number of flips";
    }
    this->TotalFlips = row.TotalFlips >= 0 ? row.TotalFlips : this->TotalFlips;
    std::printf("%s\n", FormatRow(row).c_str());
    std::fflush(stdout);
    this->Rows.push_back(std::move(row));
  }

  const BenchmarkArguments Arguments;
  const bool HasGpu = HasCudaDevice();
  std::vector<int> Threads;
  std::map<std::int64_t, std::future<BenchmarkMesh>> Meshes;
  BenchmarkMesh Delaunay; ///< The largest untiled mesh after its flips.
  std::vector<std::int64_t> Output;
  double CudaTotal = NAN; ///< Of the current mesh.
  std::int64_t TotalFlips = -1; ///< Of the current mesh.
  std::vector<BenchmarkRow> Rows;
};

std::string DescribeInJson()
{
  return "\"machine\": " + QuoteJson(DescribeMachine()) +
    ",\n  \"cores\": " + std::to_string(std::thread::hardware_concurrency()) +
    ",\n  \"gpu\": " + DescribeGpuInJson();
}

void WriteJson(const std::string& path, const std::vector<BenchmarkRow>& rows)
{
  std::ofstream file(path);
  file << "{\n  " << DescribeInJson() << ",\n  \"rows\": " << FormatJson(rows) << "\n}\n";
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + path);
  }
}

int RunProgram(const BenchmarkArguments& arguments)
{
  if (arguments.DescribeOnly)
  {
    std::printf("{\n  %s\n}\n", DescribeInJson().c_str());
    return 0;
  }
  if (arguments.SectorRatesOnly)
  {
    PrintSectorRates();
    return 0;
  }
  GpuBenchmark benchmark(arguments);
  benchmark.Run();
  if (!arguments.JsonPath.empty())
  {
    WriteJson(arguments.JsonPath, benchmark.GetRows());
  }
  return benchmark.HasFailed() ? 1 : 0;
}

}
}

int main(int argc, char** argv)
{
  using namespace delaunayflip;
  try
  {
    return RunProgram(ParseArguments(argc, argv));
  }
  catch (const std::invalid_argument& error)
  {
    std::fprintf(stderr, "%s\n%s", error.what(), BenchmarkUsage);
    return 2;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
