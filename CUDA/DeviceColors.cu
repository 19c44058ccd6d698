// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceColors.h"

#include "Array.h"
#include "CudaBackend.cuh"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "LoadedMesh.h"
#include "SmallestAngle.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

namespace delaunayflip
{

namespace
{

/// ColorBands where kernels can read them.
struct ColorTable
{
  const std::uint32_t* Colors = nullptr;
  std::int64_t Size = 0;
  double First = 0.0; ///< Where the first band begins.
  double Scale = 0.0; ///< Bands per unit.
  std::uint32_t OfNaN = 0;

  __device__ std::uint32_t Find(double value) const
  {
    const double band = (value - this->First) * this->Scale;
    const double last = static_cast<double>(this->Size - 1);
    const double kept = band < 0.0 ? 0.0 : band > last ? last : band;
    return band == band ? this->Colors[static_cast<int>(kept)] : this->OfNaN;
  }
};

/// @param memory receives the colours.
/// @throws InvalidOptions if there is no band.
ColorTable MakeColorTable(
  const ColorBands& bands, const CudaBackend& backend, Array<std::uint32_t>& memory)
{
  const auto size = static_cast<std::int64_t>(bands.Colors.size());
  if (size == 0)
  {
    throw InvalidOptions("there must be at least one band of colours");
  }
  Array<std::uint32_t> colors = backend.MakeArray<std::uint32_t>(size);
  backend.Upload(bands.Colors.data(), size, colors.Data());
  memory = std::move(colors);
  return { memory.Data(), size, bands.First, static_cast<double>(size) / (bands.Last - bands.First),
    bands.OfNaN };
}

/// A block looks for changed triangles in this many, and then works on those alone, without idle
/// threads between them.
constexpr int TrianglesPerThread = 4;
constexpr int TrianglesPerBlock = ThreadsPerBlock * TrianglesPerThread;

/// What is known of some triangles. None if all bytes are 255.
struct DrawnExtremes
{
  /// The bits of the smallest angle, a float. Numbers that are not negative have the order of their
  /// bits, and those of NaN are greater.
  std::uint32_t AngleBits = 0xFFFFFFFFu;
  std::int32_t LargestCount = -1;

  __device__ void Add(float degrees, std::uint32_t flips)
  {
    *this += DrawnExtremes{ degrees == degrees ? __float_as_uint(degrees) : 0xFFFFFFFFu,
      static_cast<std::int32_t>(flips) };
  }
  __device__ DrawnExtremes& operator+=(const DrawnExtremes& other)
  {
    this->AngleBits = min(this->AngleBits, other.AngleBits);
    this->LargestCount = max(this->LargestCount, other.LargestCount);
    return *this;
  }
  __device__ void AddTo(DrawnExtremes* all) const
  {
    atomicMin(&all->AngleBits, this->AngleBits);
    atomicMax(&all->LargestCount, this->LargestCount);
  }
  double GetSmallestAngle() const
  {
    float degrees = 0.0f;
    std::memcpy(&degrees, &this->AngleBits, sizeof(degrees));
    return degrees;
  }
};

/// The triangles of an engine, what they were at the last update, and where to write them.
struct DrawnView
{
  const TriangleRecord* Records;
  SpatialOrderView Order;
  std::int64_t Count;
  std::uint32_t* Flips; ///< At the last update, in the engine's order, as are the angles.
  float* Degrees;
  PointArray Points; ///< In the engine's order.
  MutableTriangleArray Triangles;
  std::uint32_t* Colors;
  ColorTable Table;
  bool ByFlipCount;

  __device__ std::uint32_t CountFlips(std::int64_t t) const
  {
    return this->Records[t].Flips / OneFlip;
  }
  __device__ void StoreId(std::int64_t t, int slot) const
  {
    const TriangleRecord& triangle = this->Records[t];
    this->Triangles.Set(
      triangle.InputTriangle, slot, this->Order.GetVertex(triangle.Vertices[slot]));
  }
  /// Needs the flips and the angle.
  __device__ void StoreColor(std::int64_t t) const
  {
    const auto value = this->ByFlipCount ? static_cast<double>(this->Flips[t])
                                         : static_cast<double>(this->Degrees[t]);
    this->Colors[this->Records[t].InputTriangle] = this->Table.Find(value);
  }
  /// Stores what StoreId does not.
  __device__ void Measure(std::int64_t t) const
  {
    const VertexId(&vertices)[3] = this->Records[t].Vertices;
    const std::int64_t ids[3] = { vertices[0], vertices[1], vertices[2] };
    TriangleMesh triangle;
    triangle.Points = this->Points;
    triangle.Triangles.Ids64 = ids;
    triangle.Triangles.Count = 1;
    this->Degrees[t] = static_cast<float>(FindSmallestAngle(triangle, GeometryKind::Surface, 0));
    this->Flips[t] = this->CountFlips(t);
    if (this->Table.Size > 0) // else all colours follow
    {
      this->StoreColor(t);
    }
  }
};

/// Updates what has changed of the triangles of a block, and finds the extremes of all.
__global__ void __launch_bounds__(ThreadsPerBlock)
  UpdateDrawnKernel(DrawnView view, DrawnExtremes* extremes)
{
  using Reduce = cub::BlockReduce<DrawnExtremes, ThreadsPerBlock>;
  __shared__ typename Reduce::TempStorage storage;
  __shared__ TriangleId changed[TrianglesPerBlock];
  __shared__ int size;
  if (threadIdx.x == 0)
  {
    size = 0;
  }
  __syncthreads();
  DrawnExtremes found;
  const std::int64_t first = std::int64_t(blockIdx.x) * TrianglesPerBlock;
  const std::int64_t last = min(first + TrianglesPerBlock, view.Count);
#pragma unroll
  for (int i = 0; i < TrianglesPerThread; ++i)
  {
    const std::int64_t t = first + i * ThreadsPerBlock + threadIdx.x;
    if (t < last && view.CountFlips(t) != view.Flips[t])
    {
      changed[atomicAdd(&size, 1)] = static_cast<TriangleId>(t);
    }
    else if (t < last)
    {
      found.Add(view.Degrees[t], view.Flips[t]);
    }
  }
  __syncthreads();
  // Neighbouring threads have the ids of one triangle, so that these go to memory together.
  for (int i = threadIdx.x; i < 3 * size; i += ThreadsPerBlock)
  {
    view.StoreId(changed[i / 3], i % 3);
  }
  for (int i = threadIdx.x; i < size; i += ThreadsPerBlock)
  {
    const std::int64_t t = changed[i];
    view.Measure(t);
    found.Add(view.Degrees[t], view.Flips[t]);
  }
  const DrawnExtremes all = Reduce(storage).Reduce(found, Plus<DrawnExtremes>());
  if (threadIdx.x == 0)
  {
    all.AddTo(extremes);
  }
}

/// Copies coordinate i of the points in an order of neighbours, so that those of a triangle are in
/// few sectors of memory.
template <typename T>
struct SortPointsStep
{
  const T* Caller;
  SpatialOrderView Order;
  T* Sorted;

  __device__ void operator()(std::int64_t i) const
  {
    this->Sorted[i] = this->Caller[3 * std::int64_t(this->Order.GetVertex(i / 3)) + i % 3];
  }
};

struct StoreColorStep
{
  DrawnView View;

  __device__ void operator()(std::int64_t t) const { this->View.StoreColor(t); }
};

}

/// What was written last, on a GPU.
class DrawnTriangles::OnDevice
{
public:
  explicit OnDevice(int device)
    : Backend({ device }, 1)
  {
  }

  int GetDevice() const { return this->Backend.GetContext().Device; }

  void Forget() { this->Engine = 0; }

  /// Does not wait for the GPU if colours show angles.
  void Update(
    const DeviceTriangles& triangles, const DrawnArrays& arrays, const DrawnColors& colors)
  {
    const std::unique_ptr<DeviceScope> current = this->Backend.MakeCurrent();
    this->Backend.WaitFor(arrays.Stream);
    this->Backend.WaitFor(triangles.Stream);
    if (std::exchange(this->Engine, 0) != triangles.Engine)
    {
      this->Resize(this->Degrees, triangles.Count);
      this->Resize(this->Flips, triangles.Count);
      this->Backend.Fill(this->Flips.Data(), 255, triangles.Count); // all seem changed
      const DevicePointArray& points = arrays.Points;
      points.Floats ? this->SortPoints(points.Floats, points, triangles.Order, this->Floats)
                    : this->SortPoints(points.Doubles, points, triangles.Order, this->Doubles);
    }
    bool areOther = !colors.ByFlipCount && this->TakeColors(colors, 0.0);
    DrawnView view{ triangles.Records, triangles.Order, triangles.Count, this->Flips.Data(),
      this->Degrees.Data(), this->Points, arrays.Triangles, arrays.Colors, this->Table,
      colors.ByFlipCount };
    this->Resize(this->Found, 1);
    this->Backend.Fill(this->Found.Data(), 255, 1);
    const auto blocks =
      static_cast<unsigned>((view.Count + TrianglesPerBlock - 1) / TrianglesPerBlock);
    this->Backend.Launch([&](cudaStream_t stream)
      { UpdateDrawnKernel<<<blocks, ThreadsPerBlock, 0, stream>>>(view, this->Found.Data()); });
    if (colors.ByFlipCount)
    {
      areOther = this->TakeColors(colors, this->WaitForExtremes().LargestCount);
    }
    if (areOther)
    {
      view.Table = this->Table;
      this->Backend.ForEach(view.Count, StoreColorStep{ view });
    }
    this->LetWait(arrays.Stream);
    this->LetWait(triangles.Stream); // the engine must not change what is being read
    this->Engine = triangles.Engine;
  }

  double GetSmallestAngle() const
  {
    const std::unique_ptr<DeviceScope> current = this->Backend.MakeCurrent();
    return this->WaitForExtremes().GetSmallestAngle();
  }

private:
  /// Makes an array that has another size, after it has freed the old one.
  template <typename T>
  void Resize(Array<T>& values, std::int64_t count) const
  {
    if (count != static_cast<std::int64_t>(values.Size()))
    {
      values = Array<T>();
      values = this->Backend.MakeArray<T>(count);
    }
  }

  template <typename T>
  void SortPoints(const T* values, const DevicePointArray& points, const SpatialOrderView& order,
    Array<T>& sorted)
  {
    Array<T> wide;
    const T* caller = this->Backend.WithZ(values, points, wide);
    this->Resize(sorted, 3 * points.Count);
    this->Backend.ForEach(3 * points.Count, SortPointsStep<T>{ caller, order, sorted.Data() });
    this->Points = PointArray(sorted.Data(), points.Count);
  }

  /// Lets later work in a stream wait for the update.
  void LetWait(const DeviceStream& stream) const
  {
    const CudaContext& context = this->Backend.GetContext();
    CudaContext::LetWait(
      static_cast<cudaStream_t>(stream.Handle), context.Stream, context.CallerDone);
  }

  DrawnExtremes WaitForExtremes() const
  {
    DrawnExtremes found;
    if (this->Found.Size() == 0)
    {
      return found;
    }
    this->Backend.Download(this->Found.Data(), 1, &found);
    return found;
  }

  /// @returns whether all triangles need other colours.
  bool TakeColors(const DrawnColors& colors, std::int32_t largestCount)
  {
    const ColorBands bands = colors.Choose(colors.ByFlipCount ? largestCount : 0.0);
    const ColorBands& old = this->Bands;
    const bool isOther = old.Colors != bands.Colors || old.First != bands.First ||
      old.Last != bands.Last || old.OfNaN != bands.OfNaN;
    if (isOther || this->Table.Size == 0)
    {
      this->Table = MakeColorTable(bands, this->Backend, this->TableMemory);
      this->Bands = bands;
    }
    return std::exchange(this->ByFlipCount, colors.ByFlipCount) != colors.ByFlipCount || isOther;
  }

  CudaBackend Backend;
  std::uint64_t Engine = 0; ///< Whose triangles were written; 0: nobody's.
  Array<std::uint32_t> Flips;
  Array<float> Degrees;
  Array<float> Floats;
  Array<double> Doubles;
  PointArray Points; ///< One of these two, in the engine's order.
  Array<DrawnExtremes> Found;
  ColorBands Bands; ///< What Table was made from.
  ColorTable Table;
  Array<std::uint32_t> TableMemory;
  bool ByFlipCount = false; ///< At the last update.
};

//------------------------------------------------------------------------------
DrawnTriangles::DrawnTriangles() = default;

DrawnTriangles::~DrawnTriangles() = default;

void DrawnTriangles::Forget()
{
  if (this->Shown)
  {
    this->Shown->Forget();
  }
}

double DrawnTriangles::GetSmallestAngle() const
{
  return this->Shown ? this->Shown->GetSmallestAngle() : std::numeric_limits<double>::quiet_NaN();
}

void DrawnTriangles::Update(
  const FlipSession& session, const DrawnArrays& arrays, const DrawnColors& colors)
{
  if (arrays.Triangles.Count == 0)
  {
    this->Shown.reset();
    return;
  }
  const int device = FindDeviceOf(arrays.Colors);
  if (device < 0)
  {
    throw InvalidOptions("the array for colours is not in the memory of a GPU");
  }
  const DeviceTriangles triangles = session.ViewTriangles();
  if (!triangles.Records || device != triangles.Device)
  {
    this->Shown.reset();
    throw BackendUnavailable("the triangles of the run are not in one array on the GPU that draws");
  }
  if (!this->Shown || this->Shown->GetDevice() != device)
  {
    this->Shown = std::make_unique<OnDevice>(device);
  }
  this->Shown->Update(triangles, arrays, colors);
}

}
