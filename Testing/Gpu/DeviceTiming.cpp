// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceTiming.h"

#include "CudaDevice.h"
#include "EngineTiming.h"
#include "TestDevice.h"

#include <string>

namespace delaunayflip
{
namespace
{

template <typename Real, typename Id>
void TimeArrays(
  BenchmarkRow& row, const BenchmarkMesh& mesh, int components, const RepetitionPlan& plan)
{
  const DeviceArrays<Real, Id> device(mesh.View(), components);
  FlipOptions options;
  options.Geometry = mesh.Geometry;
  options.Backend = BackendKind::CUDA;
  EngineTiming timing;
  TakePeakCudaMemory(); // of earlier runs
  row.Repetitions = Repeat(plan,
    [&](bool isWarm)
    {
      return timing.RunOnce(
        isWarm, [&]() { return FlipSession(device.View(), options); },
        [&](const FlipSession& session) { session.StoreTriangles(device.ViewResult(), {}); });
    });
  timing.Fill(row, mesh.EndsDelaunay);
  row.DeviceBytes = static_cast<double>(TakePeakCudaMemory()) / static_cast<double>(row.Points);
  row.Note = row.HasFailed ? row.Note : "from device to device";
}

}

template <typename Id>
BenchmarkRow TimeOnDevice(const BenchmarkMesh& mesh, int components, const RepetitionPlan& plan)
{
  const std::string bits = std::to_string(8 * sizeof(Id));
  BenchmarkRow row =
    MakeRow(mesh, "CUDA: " + std::to_string(components) + "-D, " + bits + "-bit, on device");
  Try(row,
    [&]
    {
      mesh.Doubles.empty() ? TimeArrays<float, Id>(row, mesh, components, plan)
                           : TimeArrays<double, Id>(row, mesh, components, plan);
    });
  return row;
}

template BenchmarkRow TimeOnDevice<std::int32_t>(const BenchmarkMesh&, int, const RepetitionPlan&);
template BenchmarkRow TimeOnDevice<std::int64_t>(const BenchmarkMesh&, int, const RepetitionPlan&);

}
