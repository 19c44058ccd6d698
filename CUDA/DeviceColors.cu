// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceColors.h"

#include "Array.h"
#include "ColorTable.cuh"
#include "CudaBackend.cuh"
#include "FlipError.h"
#include "LocalDeviceMesh.cuh"
#include "SmallestAngle.h"

#include <cstdint>
#include <limits>
#include <memory>

namespace delaunayflip
{

namespace
{
/// The least and the greatest of some numbers, none at first.
struct Extremes
{
  float Least = std::numeric_limits<float>::infinity();
  float Greatest = -std::numeric_limits<float>::infinity();

  /// NaN changes nothing.
  __device__ void Add(float value) { *this += Extremes{ value, value }; }
  __host__ __device__ Extremes& operator+=(const Extremes& other)
  {
    this->Least = other.Least < this->Least ? other.Least : this->Least;
    this->Greatest = other.Greatest > this->Greatest ? other.Greatest : this->Greatest;
    return *this;
  }
  ValueRange Get() const
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return this->Least > this->Greatest ? ValueRange{ nan, nan }
                                        : ValueRange{ this->Least, this->Greatest };
  }
};

/// A backend on the GPU that has an array; it is current meanwhile.
class BackendOf
{
public:
  explicit BackendOf(const void* memory)
    : Backend({ RequireDevice(memory) }, 1),
      Current(this->Backend.MakeCurrent())
  {
  }
  const CudaBackend* operator->() const { return &this->Backend; }
  const CudaBackend& operator*() const { return this->Backend; }

private:
  static int RequireDevice(const void* memory)
  {
    const int device = FindDeviceOf(memory);
    if (device < 0)
    {
      throw InvalidOptions("the array for colours is not in the memory of a GPU");
    }
    return device;
  }

  CudaBackend Backend;
  std::unique_ptr<DeviceScope> Current;
};

template <typename T>
void Color(const T* values, std::int64_t count, const ColorBands& bands, std::uint32_t* colors,
  const DeviceStream& stream)
{
  if (bands.Colors.empty())
  {
    throw InvalidOptions("there must be at least one band of colours");
  }
  if (count == 0)
  {
    return;
  }
  const BackendOf backend(colors);
  const ColorTable table(bands, *backend);
  const ColorTableView view = table.View();
  backend->WaitFor(stream);
  backend->ForEach(count,
    [=] __device__(std::int64_t i) { colors[i] = view.Find(static_cast<double>(values[i])); });
  backend->Synchronize();
}
}

ValueRange FindSmallestAngles(const DeviceMesh& mesh, GeometryKind geometry, float* degrees)
{
  if (mesh.Triangles.Count == 0)
  {
    return Extremes().Get();
  }
  const BackendOf backend(degrees);
  DeviceMesh plain;
  plain.Points = mesh.Points;
  plain.Triangles = mesh.Triangles;
  plain.Stream = mesh.Stream;
  const LocalDeviceMesh local = backend->Localize(plain);
  const TriangleMesh& view = local.View();
  const PointArray points = view.Points;
  const TriangleArray triangles = view.Triangles;
  const auto measure = [=] __device__(std::int64_t t, Extremes & found)
  {
    TriangleMesh triangle;
    triangle.Points = points;
    triangle.Triangles = triangles;
    degrees[t] = static_cast<float>(FindSmallestAngle(triangle, geometry, t));
    found.Add(degrees[t]);
  };
  return backend->Sum<Extremes>(triangles.Count, measure).Get();
}

ValueRange FindRange(const std::int32_t* values, std::int64_t count, const DeviceStream& stream)
{
  if (count == 0)
  {
    return Extremes().Get();
  }
  const BackendOf backend(values);
  backend->WaitFor(stream);
  return backend
    ->Sum<Extremes>(count,
      [=] __device__(std::int64_t i, Extremes & found)
      { found.Add(static_cast<float>(values[i])); })
    .Get();
}

void ColorValues(const float* values, std::int64_t count, const ColorBands& bands,
  std::uint32_t* colors, const DeviceStream& stream)
{
  Color(values, count, bands, colors, stream);
}

void ColorValues(const std::int32_t* values, std::int64_t count, const ColorBands& bands,
  std::uint32_t* colors, const DeviceStream& stream)
{
  Color(values, count, bands, colors, stream);
}

}
