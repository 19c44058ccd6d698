// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FakeDevice.h"

#include "CudaDevice.h"
#include "FlipError.h"
#include "LoadedMesh.h"
#include "SphereOnBackend.h"
#include "TestDevice.h"
#include "ThreadBackend.h"

#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <utility>

namespace delaunayflip
{

int CallsToFailure = 0;
bool IsDeviceLost = false;
std::int64_t CopiedBytes = 0;
std::int64_t AnswersOnDevice = 0;

namespace
{
/// @throws BackendUnavailable if the device is lost.
void RequireDevice()
{
  if (IsDeviceLost)
  {
    throw BackendUnavailable("as the test wants it");
  }
}

/// Counts a call. @throws BackendUnavailable if it is to fail.
void CallDevice()
{
  RequireDevice();
  if (CallsToFailure > 0 && --CallsToFailure == 0)
  {
    throw BackendUnavailable("as the test wants it");
  }
}

/// Whether there is no array, or one in an allocation of the device.
bool HasOrLacks(const void* array) { return !array || FindDeviceOf(array) >= 0; }

/// The begin and the end of each allocation.
std::map<std::uintptr_t, std::uintptr_t> Allocations;

/// What the thread engine reads, and what it needs to keep for that.
struct WidePoints
{
  std::vector<float> Floats;
  std::vector<double> Doubles;
  TriangleMesh View;

  explicit WidePoints(const DeviceMesh& mesh)
  {
    static_cast<FixedEdges&>(this->View) = mesh;
    this->View.Triangles = mesh.Triangles;
    if (mesh.Points.Floats)
    {
      this->Floats = Widen(mesh.Points.Floats, mesh.Points);
      this->View.Points = PointArray(this->Floats.data(), mesh.Points.Count);
    }
    else
    {
      this->Doubles = Widen(mesh.Points.Doubles, mesh.Points);
      this->View.Points = PointArray(this->Doubles.data(), mesh.Points.Count);
    }
  }

  template <typename Real>
  static std::vector<Real> Widen(const Real* values, const DevicePointArray& points)
  {
    std::vector<Real> wide;
    for (std::int64_t i = 0; i < 3 * points.Count; ++i)
    {
      const std::int64_t axis = i % 3;
      wide.push_back(axis < points.Components ? values[points.Components * (i / 3) + axis] : 0);
    }
    return wide;
  }
};

class FakeEngine : public LoadedMesh
{
public:
  explicit FakeEngine(std::unique_ptr<LoadedMesh> engine)
    : Engine(std::move(engine)),
      Report(this->Engine->GetInputReport())
  {
    this->Report.Backend = "CUDA: fake";
  }

  std::unique_ptr<DeviceScope> MakeCurrent() const override
  {
    CallDevice();
    return nullptr;
  }
  FlipLoop& GetLoop() override { return this->Engine->GetLoop(); }
  const FlipReport& GetInputReport() const override { return this->Report; }
  void StoreTriangles(const MutableTriangleArray& triangles) const override
  {
    this->Engine->StoreTriangles(triangles);
  }
  void StoreOrderedTriangles(const MutableTriangleArray& triangles) const override
  {
    this->Engine->StoreOrderedTriangles(triangles);
  }
  void StoreFlipCounts(std::int32_t* counts) const override
  {
    this->Engine->StoreFlipCounts(counts);
  }
  void StoreNeighbors(std::int32_t* neighbors) const override
  {
    this->Engine->StoreNeighbors(neighbors);
  }
  void StoreUsedPoints(std::int64_t first, std::int64_t count, std::int64_t* ids) const override
  {
    this->Engine->StoreUsedPoints(first, count, ids);
  }
  bool CanAnswerInPlace(const PlaceQuery& query) const override
  {
    return HasOrLacks(query.Places.Data()) && HasOrLacks(query.Triangles) &&
      HasOrLacks(query.Values) && HasOrLacks(query.Results);
  }
  AskResult Ask(const RunQuery& asked, const ProgressObserver& observer) override
  {
    return this->Engine->Ask(asked, observer);
  }
  MotionResult InsertPoints(const std::vector<double>& places, bool keepsFixed) override
  {
    const MotionResult result = this->Engine->InsertPoints(places, keepsFixed);
    this->Report = this->Engine->GetInputReport();
    this->Report.Backend = "CUDA: fake";
    return result;
  }
  MotionResult MovePoints(const PointInput& targets, const std::vector<EdgeId>& segments,
    const BuildProgress& progress) override
  {
    const MotionResult result = this->Engine->MovePoints(targets, segments, progress);
    this->Report = this->Engine->GetInputReport();
    this->Report.Backend = "CUDA: fake";
    return result;
  }
  MotionResult RemovePoints(
    const std::vector<VertexId>& ids, const std::vector<EdgeId>& segments) override
  {
    const MotionResult result = this->Engine->RemovePoints(ids, segments);
    this->Report = this->Engine->GetInputReport();
    this->Report.Backend = "CUDA: fake";
    return result;
  }
  void StartRefinement(const RefinementPlan& plan) override { this->Engine->StartRefinement(plan); }
  std::int64_t Refine() override
  {
    const std::int64_t added = this->Engine->Refine();
    this->Report = this->Engine->GetInputReport();
    this->Report.Backend = "CUDA: fake";
    return added;
  }
  const RefinementResult& FetchRefinement(bool isOver) override
  {
    return this->Engine->FetchRefinement(isOver);
  }
  void VisitRefined(const RefinedVertexVisitor& visit) override
  {
    this->Engine->VisitRefined(visit);
  }
  bool StoreTrianglesOnDevice(
    const MutableTriangleArray& triangles, const DeviceStream&, std::int32_t*) const override
  {
    this->Engine->StoreTriangles(triangles);
    return true;
  }
  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream&) const override
  {
    this->Engine->StoreFlipCounts(counts);
    return true;
  }
  bool StoreNeighborsOnDevice(std::int32_t* neighbors, const DeviceStream&) const override
  {
    this->Engine->StoreNeighbors(neighbors);
    return true;
  }
  KeptTriangles CutOff(const PointInput& input, const PointOptions& options,
    std::vector<SegmentEdge>& segments) override
  {
    return this->Engine->CutOff(input, options, segments);
  }
  void NumberKept(const std::vector<std::int32_t>& regions, std::int64_t firstAdded,
    std::vector<SegmentEdge>& segments, KeptTriangles& kept) override
  {
    this->Engine->NumberKept(regions, firstAdded, segments, kept);
  }
  void ViewOnHost(const HostView& view) override { this->Engine->ViewOnHost(view); }
  std::vector<std::int64_t> FindEnds(const std::vector<HalfEdgeId>& sides) override
  {
    return this->Engine->FindEnds(sides);
  }
  void DivideAndConquer(const BuildProgress& progress) override
  {
    this->Engine->DivideAndConquer(progress);
  }
  void InsertSegments(
    const std::vector<std::uint32_t>& ends, const SegmentObserver& onBatch) override
  {
    this->Engine->InsertSegments(ends, onBatch);
  }
  Defect FindTurnedTriangles() const override { return this->Engine->FindTurnedTriangles(); }
  bool KeepsSliver() override { return this->Engine->KeepsSliver(); }
  HiddenSums CountHidden() override { return this->Engine->CountHidden(); }
  void Audit() const override { this->Engine->Audit(); }

private:
  std::unique_ptr<LoadedMesh> Engine;
  FlipReport Report;
};
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  RequireDevice();
  return std::unique_ptr<LoadedMesh>(new FakeEngine(LoadOnThreads(mesh, options, progress)));
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const DeviceMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  return LoadOnCuda(WidePoints(mesh).View, options, progress);
}

std::unique_ptr<LoadedMesh> LoadOnCuda(
  const PointInput& points, const FlipOptions& options, const BuildProgress& progress)
{
  RequireDevice();
  return std::unique_ptr<LoadedMesh>(
    new FakeEngine(LoadOnThreads(points.Points, options, progress)));
}

namespace
{
/// Counts its arrays as device memory.
class FakeSphere : public SphereOnBackend<ThreadBackend>
{
public:
  using SphereOnBackend::SphereOnBackend;
  ~FakeSphere() override
  {
    for (const void* memory : this->Lent)
    {
      Allocations.erase(reinterpret_cast<std::uintptr_t>(memory));
    }
  }

  std::unique_ptr<DeviceScope> MakeCurrent() const override
  {
    CallDevice();
    return nullptr;
  }
  PlaneArray Project(const NumberedPoint& pole, std::int64_t& unplaced) override
  {
    const PlaneArray places = SphereOnBackend::Project(pole, unplaced);
    this->Lend(places.Data(), 16 * places.Count);
    this->Lend(this->GetTriangles(), 24 * places.Count);
    this->Lend(this->GetNeighbors(), 24 * places.Count);
    return places;
  }
  bool StoreTriangles(const MutableTriangleArray& triangles, const DeviceStream&) override
  {
    return this->Store(this->GetTriangles(), triangles);
  }
  bool StoreNeighbors(std::int32_t* neighbors, const DeviceStream&) override
  {
    return this->Store(
      this->GetNeighbors(), MutableTriangleArray(neighbors, this->CountTriangles()));
  }

private:
  void Lend(const void* memory, std::uintptr_t bytes)
  {
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    Allocations[address] = address + bytes;
    this->Lent.push_back(memory);
  }
  static bool Store(const std::int32_t* numbers, const MutableTriangleArray& target)
  {
    for (std::int64_t i = 0; i < 3 * target.Count; ++i)
    {
      StoreNumberStep{ numbers }(i, target);
    }
    return true;
  }

  std::vector<const void*> Lent;
};
}

std::unique_ptr<LoadedSphere> LoadSphereOnCuda(const PointInput& points, const FlipOptions& options)
{
  RequireDevice();
  auto sphere = std::make_unique<FakeSphere>(ThreadBackend(options.NumberOfThreads));
  sphere->Load(points);
  return sphere;
}

namespace
{
class FakeAsker : public SphereAskerOnBackend<ThreadBackend>
{
public:
  using SphereAskerOnBackend::SphereAskerOnBackend;

  bool CanAnswerInPlace(const PlaceQuery&) const override { return true; }
  AskResult Answer(const PlaceQuery& query, const ProgressObserver& observer) override
  {
    CallDevice();
    AnswersOnDevice += query.CountPlaces();
    return SphereAskerOnBackend::Answer(query, observer);
  }
};
}

std::unique_ptr<SphereDeviceAsker> LoadAskerOnCuda(
  const AskedSphere& asked, std::int64_t points, const FlipOptions& options)
{
  return std::make_unique<FakeAsker>(asked, points, ThreadBackend(options.NumberOfThreads));
}

bool HasCudaDevice() { return true; }

int CountCudaDevices() { return 1; }
void ReleaseCudaMemory() {}
std::size_t TakePeakCudaMemory() { return 0; }

int FindDeviceOf(const void* memory)
{
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const auto after = Allocations.upper_bound(address);
  return after != Allocations.begin() && address < std::prev(after)->second ? 0 : -1;
}

void CopyMemory(const void* from, std::int64_t bytes, void* to, const DeviceStream&)
{
  if (bytes > 0) // else there may be no arrays
  {
    std::memcpy(to, from, static_cast<std::size_t>(bytes));
    CopiedBytes += bytes;
  }
}

bool HasTestDevice() { return true; }

void* AllocateOnTestDevice(std::size_t bytes)
{
  void* memory = std::malloc(bytes);
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  Allocations[address] = address + bytes;
  return memory;
}

void FreeOnTestDevice(void* memory)
{
  Allocations.erase(reinterpret_cast<std::uintptr_t>(memory));
  std::free(memory);
}

}
