// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BadPlane.h"
#include "BenchmarkMesh.h"
#include "CgalDelaunay.h"
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "Machine.h"
#include "TestDevice.h"

#if defined(DELAUNAYFLIP_HAS_VTK)
#include "vtkDelaunayFlip.h"
#include "vtkNew.h"
#endif

#include <CLI/CLI.hpp>
#include <cuda_runtime_api.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
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

using Json = nlohmann::ordered_json;
using Times = std::map<std::string, double>;

double FindMedian(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// A number of a row in the printed table. Build: from the caller's arrays to the engine's mesh
/// with its bad edges found. Store: into an array in memory that was written before. "x CUDA":
/// the total divided by that of CUDA on the same mesh. "left": bad edges of the result.
struct Column
{
  const char* Key;
  const char* Heading;
  int Width;
  int Digits;
};
constexpr Column Columns[] = { { "points", "points", 10, 0 }, { "triangles", "triangles", 10, 0 },
  { "repetitions", "runs", 4, 0 }, { "build_ms", "build ms", 9, 2 },
  { "flips_ms", "flips ms", 9, 2 }, { "store_ms", "store ms", 9, 2 },
  { "total_ms", "total ms", 9, 2 }, { "times_cuda", "x CUDA", 7, 2 }, { "flips", "flips", 10, 0 },
  { "iterations", "iter.", 6, 0 }, { "left", "left", 5, 0 },
  { "device_bytes_per_point", "GPU B/pt", 8, 1 } };

/// @param row null: the heading.
void Print(const Json& row)
{
  const std::string mesh = row.value("mesh", "mesh"), program = row.value("program", "program");
  std::printf("%-34s %-22s", mesh.c_str(), program.c_str());
  for (const Column& column : Columns)
  {
    if (row.contains(column.Key))
    {
      std::printf(" %*.*f", column.Width, column.Digits, row[column.Key].get<double>());
    }
    else
    {
      std::printf(" %*s", column.Width, row.empty() ? column.Heading : "-");
    }
  }
  std::printf("  %s\n", row.value("note", "").c_str());
  std::fflush(stdout);
}

/// CUDA's 13000 is "13.0".
std::string FormatVersion(int version)
{
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

/// The machine, the current GPU and the versions of CUDA.
Json Describe()
{
  Json json = { { "machine", DescribeMachine() }, { "cores", std::thread::hardware_concurrency() },
    { "gpu", nullptr } };
  cudaDeviceProp properties = {};
  int device = 0;
  if (HasCudaDevice() && cudaGetDevice(&device) == cudaSuccess &&
    cudaGetDeviceProperties(&properties, device) == cudaSuccess)
  {
    int runtime = 0;
    int driver = 0;
    cudaRuntimeGetVersion(&runtime);
    cudaDriverGetVersion(&driver);
    json["gpu"] = { { "name", properties.name },
      { "compute_capability",
        std::to_string(properties.major) + "." + std::to_string(properties.minor) },
      { "multiprocessors", properties.multiProcessorCount },
      { "memory_bytes", properties.totalGlobalMem }, { "cuda_runtime", FormatVersion(runtime) },
      { "cuda_of_driver", FormatVersion(driver) } };
  }
  return json;
}

class GpuBenchmark
{
public:
  std::vector<std::int64_t> Sizes = { 100000, 500000, 1000000, 2000000, 5000000, 20000000,
    100000000 };
  std::vector<std::int64_t> CpuSizes = { 100000, 1000000, 5000000 };
  std::vector<int> Threads = { 1, 2, 4, 8, 16 };
  int Repetitions = 5; ///< After one to warm up.
  double Seconds = 5.0; ///< No repetition begins after this time.
  std::string MeshFolder;

  /// The first run of the process, which starts CUDA. Call this before anything that does.
  void RunFirst()
  {
    const BenchmarkMesh mesh = MakeRandomMesh(40000);
    Print(Json::object());
    const Clock::time_point start = Clock::now();
    this->HasGpu = HasCudaDevice();
    if (this->HasGpu)
    {
      this->Add(mesh, "CUDA: first run",
        [&](Json& row)
        {
          FlipOptions options;
          options.Backend = BackendKind::CUDA;
          this->Output.assign(mesh.Ids.size(), 0);
          FlipSession session(mesh.View(), options);
          session.Advance();
          session.StoreTriangles({ this->Output.data(), mesh.CountTriangles() });
          row["total_ms"] = MillisecondsSince(start);
          row["flips"] = session.GetReport().TotalFlips;
          row["note"] = "of the process, with the start of CUDA";
        });
    }
  }

  void Run()
  {
    const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    this->Threads.erase(std::remove_if(this->Threads.begin(), this->Threads.end(),
                          [=](int threads) { return threads > cores; }),
      this->Threads.end());
    for (const std::int64_t size : this->Sizes)
    {
      // The mesh as generated, as given to the program, and the result.
      constexpr double BytesPerPoint = 160.0;
      const bool hasMemory = BytesPerPoint * static_cast<double>(size) <=
        ReadBytes("/proc/meminfo", "MemAvailable", INFINITY);
      if (!hasMemory || (!this->HasGpu && !this->IsForCpu(size)))
      {
        BenchmarkMesh none;
        none.Name = "random bad";
        this->Skip(none, size, hasMemory ? "no GPU" : "too little memory on the host");
        continue;
      }
      this->RunSize(MakeRandomMesh(size));
    }
    this->RunSpecialMeshes();
    for (const BenchmarkMesh& mesh : ReadRealMeshes(this->MeshFolder))
    {
      this->RunBeside(mesh);
    }
  }

  Json Rows = Json::array(); ///< One program on one mesh each. Times are medians.
  bool HasFailed = false;

private:
  bool IsForCpu(std::int64_t size) const
  {
    return std::find(this->CpuSizes.begin(), this->CpuSizes.end(), size) != this->CpuSizes.end();
  }

  void RunSize(const BenchmarkMesh& mesh)
  {
    this->RunCuda(mesh);
    if (this->IsForCpu(mesh.CountPoints()))
    {
      this->RunThreads(mesh, this->Threads);
      this->Add(mesh, "CGAL", [&](Json& row) { this->TimeCgal(row, mesh); });
    }
    if (mesh.CountPoints() <= LargestUntiledMesh && mesh.Ids.size() == this->Output.size())
    {
      this->Delaunay = mesh;
      this->Delaunay.Name = "already Delaunay";
      this->Delaunay.Ids = this->Output;
    }
  }

  void RunSpecialMeshes()
  {
    if (!this->Delaunay.Ids.empty())
    {
      this->RunBeside(MoveSomePoints(this->Delaunay));
      this->RunBeside(this->Delaunay);
      this->RunBeside(MakeLatticeMesh(this->Delaunay.CountPoints()));
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

  void RunThreads(const BenchmarkMesh& mesh, const std::vector<int>& counts)
  {
    for (const int threads : counts)
    {
      FlipOptions options;
      options.Backend = BackendKind::Threads;
      options.NumberOfThreads = threads;
      this->Add(mesh, "Threads: " + std::to_string(threads),
        [&](Json& row) { this->TimeEngine(row, mesh, options); });
    }
  }

  /// The first rows of a mesh.
  void RunCuda(const BenchmarkMesh& mesh)
  {
    this->CudaTotal = NAN;
    this->Flips = -1;
    if (!this->HasGpu)
    {
      this->Skip(mesh, mesh.CountPoints(), "no GPU");
      return;
    }
    FlipOptions options;
    options.Backend = BackendKind::CUDA;
    this->Add(mesh, "CUDA",
      [&](Json& row)
      {
        this->TimeEngine(row, mesh, options);
        this->CudaTotal = row["total_ms"];
      });
    if (mesh.CountPoints() <= LargestUntiledMesh)
    {
      const int components = mesh.IsPlane() ? 2 : 3;
      const std::string name = "CUDA: " + std::to_string(components) + "-D, 32-bit, on device";
      this->Add(mesh, "CUDA: 3-D, 64-bit, on device",
        [&](Json& row) { this->TimeOnDevice<std::int64_t>(row, mesh, 3); });
      this->Add(
        mesh, name, [&](Json& row) { this->TimeOnDevice<std::int32_t>(row, mesh, components); });
    }
#if defined(DELAUNAYFLIP_HAS_VTK)
    ReleaseCudaMemory(); // the module has its own engine and memory
    this->Add(mesh, "vtkDelaunayFlip: CUDA", [&](Json& row) { this->TimeFilter(row, mesh); });
#endif
  }

  void Skip(const BenchmarkMesh& mesh, std::int64_t points, const std::string& reason)
  {
    this->Add(mesh, "CUDA",
      [&](Json& row)
      {
        row["points"] = points;
        row["note"] = "skipped: " + reason;
      });
  }

  /// Makes a row and prints it at once, because the next may take long. All programs must make the
  /// same flips of a mesh as the first one. Running out of memory does not count as a failure: some
  /// machines are too small.
  template <typename Fill>
  void Add(const BenchmarkMesh& mesh, const std::string& program, const Fill& fill)
  {
    Json row = { { "mesh", mesh.Name }, { "program", program }, { "note", "" }, { "failed", false },
      { "points", mesh.CountPoints() }, { "triangles", mesh.CountTriangles() } };
    std::string error;
    try
    {
      fill(row);
      const std::int64_t flips = row.value("flips", this->Flips);
      this->Flips = this->Flips < 0 ? flips : this->Flips;
      if (flips != this->Flips)
      {
        throw std::runtime_error("different number of flips");
      }
      if (mesh.EndsDelaunay && row.value("left", 0) != 0)
      {
        throw std::runtime_error("bad edges left");
      }
    }
    catch (const std::bad_alloc&)
    {
      error = "out of memory";
    }
    catch (const std::exception& caught)
    {
      error = caught.what();
    }
    if (!error.empty())
    {
      const bool isFailure = error.find("out of memory") == std::string::npos;
      row["failed"] = isFailure;
      row["note"] = (isFailure ? "FAILED: " : "skipped: ") + error;
      this->HasFailed = this->HasFailed || isFailure;
      this->Output.clear();
    }
    if (row.contains("total_ms") && !std::isnan(this->CudaTotal))
    {
      row["times_cuda"] = row["total_ms"].get<double>() / this->CudaTotal;
    }
    Print(row);
    this->Rows.push_back(std::move(row));
  }

  /// Calls run(), which returns milliseconds, once to warm up and then several times. Adds medians.
  template <typename Run>
  void Time(Json& row, const Run& run) const
  {
    run();
    std::map<std::string, std::vector<double>> times;
    const Clock::time_point start = Clock::now();
    int done = 0;
    do
    {
      for (const auto& [name, time] : run())
      {
        times[name].push_back(time);
      }
    } while (++done < this->Repetitions && MillisecondsSince(start) < 1e3 * this->Seconds);
    row["repetitions"] = done;
    for (const auto& [name, all] : times)
    {
      row[name] = FindMedian(all);
    }
  }

  /// Times open(), which returns a session, its iterations, and store(session).
  template <typename Open, typename Store>
  void TimeSession(Json& row, const Open& open, const Store& store) const
  {
    TakePeakCudaMemory(); // of earlier runs
    this->Time(row,
      [&]
      {
        const Clock::time_point start = Clock::now();
        FlipSession session = open();
        const double build = MillisecondsSince(start);
        session.Advance();
        const double flipped = MillisecondsSince(start);
        store(session);
        const double total = MillisecondsSince(start);
        row["flips"] = session.GetReport().TotalFlips;
        row["iterations"] = session.GetReport().Iterations.size();
        row["left"] = session.GetReport().NonDelaunayAfter;
        row["program"] =
          row["program"] == "CUDA" ? Json(session.GetReport().Backend) : row["program"];
        return Times{ { "build_ms", build }, { "flips_ms", flipped - build },
          { "store_ms", total - flipped }, { "total_ms", total } };
      });
    const auto peak = static_cast<double>(TakePeakCudaMemory());
    if (peak > 0.0)
    {
      row["device_bytes_per_point"] = peak / row["points"].get<double>();
    }
  }

  void TimeEngine(Json& row, const BenchmarkMesh& mesh, FlipOptions options)
  {
    options.Geometry = mesh.Geometry;
    this->Output.assign(mesh.Ids.size(), 0);
    this->TimeSession(
      row, [&] { return FlipSession(mesh.View(), options); },
      [&](const FlipSession& session) {
        session.StoreTriangles({ this->Output.data(), mesh.CountTriangles() });
      });
  }

  /// Arrays and result in device memory.
  /// @param components of the points: 2 or 3.
  template <typename Id>
  void TimeOnDevice(Json& row, const BenchmarkMesh& mesh, int components) const
  {
    mesh.Doubles.empty() ? this->TimeArrays<float, Id>(row, mesh, components)
                         : this->TimeArrays<double, Id>(row, mesh, components);
    row["note"] = "from device to device";
  }

  template <typename Real, typename Id>
  void TimeArrays(Json& row, const BenchmarkMesh& mesh, int components) const
  {
    const DeviceArrays<Real, Id> device(mesh.View(), components);
    FlipOptions options;
    options.Geometry = mesh.Geometry;
    options.Backend = BackendKind::CUDA;
    this->TimeSession(
      row, [&] { return FlipSession(device.View(), options); },
      [&](const FlipSession& session) { session.StoreTriangles(device.ViewResult(), {}); });
  }

#if defined(DELAUNAYFLIP_HAS_VTK)
  /// From a vtkPolyData in the host's memory to another one, which has new memory each time.
  void TimeFilter(Json& row, const BenchmarkMesh& mesh) const
  {
    vtkNew<vtkDelaunayFlip> filter;
    filter->SetInputData(ToPolyData(mesh));
    filter->SetGeometry(static_cast<int>(mesh.Geometry));
    filter->SetBackendToCUDA();
    this->Time(row,
      [&]
      {
        filter->Modified();
        const Clock::time_point start = Clock::now();
        filter->Update();
        return Times{ { "total_ms", MillisecondsSince(start) } };
      });
    if (filter->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
    {
      throw std::runtime_error("the filter failed");
    }
    row["flips"] = filter->GetTotalFlips();
    row["iterations"] = filter->GetNumberOfIterations();
    row["left"] = filter->GetNonDelaunayAfter();
    row["note"] = "Update()";
  }
#endif

  /// CGAL's Delaunay triangulation of the mesh's points, which are those of a convex mesh.
  void TimeCgal(Json& row, const BenchmarkMesh& mesh) const
  {
    OwnedMesh<float> points;
    points.Points = mesh.Floats;
    this->Time(row,
      [&]
      {
        const CgalTime time = TimeCgalDelaunay(points);
        if (time.Triangles != mesh.CountTriangles())
        {
          throw std::runtime_error("different number of triangles");
        }
        return Times{ { "total_ms", 1e3 * time.Seconds } };
      });
    row["note"] = "from the points alone";
  }

  bool HasGpu = false;
  BenchmarkMesh Delaunay; ///< The largest untiled mesh after its flips.
  std::vector<std::int64_t> Output; ///< The engine's last result.
  double CudaTotal = NAN; ///< The time for the current mesh.
  std::int64_t Flips = -1; ///< Those of the first program in the current mesh.
};

int RunProgram(int argc, char** argv)
{
  GpuBenchmark benchmark;
  std::string jsonPath;
  CLI::App app("Whole runs on the GPU beside threads of the CPU and CGAL");
  app.add_flag_callback(
    "--quick",
    [&]
    {
      benchmark.Sizes = { 100000, 1000000 };
      benchmark.CpuSizes = { 100000 };
      benchmark.Repetitions = 3;
      benchmark.Seconds = 2.0;
    },
    "few sizes and runs; other options change them");
  app.add_option("--sizes", benchmark.Sizes, "points of the random bad meshes that the GPU flips")
    ->delimiter(',');
  app.add_option("--cpu-sizes", benchmark.CpuSizes, "those that threads and CGAL get too; none: 0")
    ->delimiter(',');
  app.add_option("--threads", benchmark.Threads, "numbers of threads, as far as there are cores")
    ->delimiter(',');
  app.add_option("--repetitions", benchmark.Repetitions, "after one that warms up");
  app.add_option("--seconds", benchmark.Seconds, "after which no run begins");
  app.add_option("--meshes", benchmark.MeshFolder, "also the real meshes of export_meshes.py");
  app.add_option("--json", jsonPath, "a file for the rows, the machine and the GPU");
  bool describesOnly = false;
  app.add_flag("--describe", describesOnly, "only prints the machine and the GPU as JSON");
  CLI11_PARSE(app, argc, argv);
  if (!describesOnly)
  {
    benchmark.RunFirst();
  }
  Json json = Describe();
  if (describesOnly)
  {
    std::printf("%s\n", json.dump(1).c_str());
    return 0;
  }
  benchmark.Run();
  if (!jsonPath.empty())
  {
    json["rows"] = benchmark.Rows;
    std::ofstream file(jsonPath);
    if (!(file << json.dump(1) << std::endl))
    {
      throw std::runtime_error("cannot write " + jsonPath);
    }
  }
  return benchmark.HasFailed ? 1 : 0;
}

}
}

int main(int argc, char** argv)
{
  try
  {
    return delaunayflip::RunProgram(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
