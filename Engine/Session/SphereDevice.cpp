// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CallerMesh.h"
#include "CudaDevice.h"
#include "FlipError.h"
#include "SphereRun.h"

/// @file
/// The run on a sphere that stays in the memory of a GPU.

namespace delaunayflip
{

/// Whether to use a GPU for what it can do.
bool SphereRun::PrefersDevice() const
{
  if (this->Options.Backend != BackendKind::Auto)
  {
    return this->Options.Backend == BackendKind::CUDA;
  }
  const bool isLarge = 2 * this->Input.Points.Count >= SmallestMeshForCuda;
  return this->Input.OnDevice || (isLarge && HasCudaDevice());
}

/// The options, with the GPU that has the points.
FlipOptions SphereRun::ChooseDevice() const
{
  FlipOptions options = this->Options;
  if (this->Input.OnDevice)
  {
    const PlaneArray& points = this->Input.Points;
    options.Device = JoinDevice(options.Device, points.Data(), points.Count, "the points are");
  }
  return options;
}

/// Whether a GPU is to make the mesh, and there is nothing that only the host does.
bool SphereRun::MayRunOnDevice() const
{
  const PointInput& input = this->Input;
  const bool isPlain = input.NumberOfSegments + input.NumberOfHoleSeeds == 0 && !input.Rings &&
    this->Options.Projection == ProjectionKind::Sphere && input.Points.Count > 3;
  return isPlain && this->PrefersDevice();
}

/// Makes the mesh on a GPU, if all points are used and filters see that all edges are convex.
/// @returns false otherwise, and also if the GPU fails: then the host has to make the mesh.
bool SphereRun::RunOnDevice()
{
  if (!this->MayRunOnDevice())
  {
    return false;
  }
  const FlipOptions options = this->ChooseDevice();
  try
  {
    std::unique_ptr<LoadedSphere> device = LoadSphereOnCuda(this->Input, options);
    const std::unique_ptr<DeviceScope> current = device->MakeCurrent();
    if (this->StartOnDevice(*device, options))
    {
      this->OnDevice = std::move(device);
    }
  }
  catch (const BackendUnavailable&)
  {
    this->OnDevice.reset();
  }
  if (!this->OnDevice)
  {
    this->Planar = FlipReport();
  }
  return this->OnDevice != nullptr;
}

bool SphereRun::StartOnDevice(LoadedSphere& device, const FlipOptions& options)
{
  const Simplex simplex = device.AreUsual() ? device.FindSimplex() : Simplex();
  if (simplex.empty())
  {
    return false;
  }
  const NumberedPoint& pole = simplex.front();
  std::int64_t unplaced = 0;
  PointInput plane;
  plane.Points = device.Project(pole, unplaced);
  plane.OnDevice = true;
  if (unplaced > 0)
  {
    return false;
  }
  PointOptions inPlane;
  static_cast<FlipOptions&>(inPlane) = options;
  const ProgressObserver progress = this->TellHalf();
  FlipSession session(plane, inPlane, progress);
  AdvanceToEnd(session, progress);
  const FlipReport& report = session.GetReport();
  AddReport(this->Planar, report);
  if (report.Triangles == 0 || report.FromPoints.Repeated > 0)
  {
    return false;
  }
  session.StoreTriangles(MutableTriangleArray(device.GetTriangles(), report.Triangles), {});
  session.StoreNeighbors(device.GetNeighbors(), {});
  device.JoinPole(report.Triangles, pole.Id);
  StartSums sums = device.TestStart(Origin);
  if (sums.Turned > 0)
  {
    sums = device.TestStart(FindCenter(simplex));
  }
  if (sums.Turned + sums.Uncertain > 0)
  {
    return false;
  }
  this->ReportStart(sums);
  return true;
}

/// Copies the mesh to the host, unless it is there. If the GPU fails, the host makes it again.
void SphereRun::Fetch()
try
{
  if (!this->OnDevice || !this->Triangles.empty())
  {
    return;
  }
  const TemporaryValue<ProgressObserver> nobody(this->Observer, {});
  try
  {
    const std::unique_ptr<DeviceScope> current = this->OnDevice->MakeCurrent();
    this->Points.resize(this->Input.Points.Count);
    this->Triangles.resize(3 * this->Report.Triangles);
    this->Neighbors.resize(3 * this->Report.Triangles);
    this->OnDevice->Fetch(this->Points.data(), this->Triangles.data(), this->Neighbors.data());
  }
  catch (const BackendUnavailable&)
  {
    this->OnDevice.reset();
    this->Neighbors.clear();
    this->Planar = FlipReport();
    this->RunOnHost();
  }
}
catch (...)
{
  this->Reset(); // forgets what is half done
  throw;
}

/// Stores by a call of the device. @returns whether it has. If the GPU fails, the host stores.
template <typename Store>
bool SphereRun::StoreFromDevice(const Store& store)
{
  if (!this->OnDevice)
  {
    return false;
  }
  try
  {
    const std::unique_ptr<DeviceScope> current = this->OnDevice->MakeCurrent();
    return store(*this->OnDevice);
  }
  catch (const BackendUnavailable&)
  {
    return false;
  }
}

bool SphereRun::StoreTrianglesOnDevice(
  const MutableTriangleArray& triangles, const DeviceStream& stream, std::int32_t*)
{
  return this->StoreFromDevice(
    [&](LoadedSphere& sphere) { return sphere.StoreTriangles(triangles, stream); });
}

bool SphereRun::StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream& stream)
{
  return this->StoreFromDevice(
    [&](LoadedSphere& sphere) { return sphere.StoreNeighbors(neighbors, stream); });
}

}
