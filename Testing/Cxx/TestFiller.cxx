// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiller.h"

#include "BufferFiller.h"
#include "DelaunayFlip.h"
#include "TestBackend.h"
#include "TriangleAngles.h"

#include "vtk_glew.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace delaunayflip;

namespace
{

TestFiller Plan;

template <typename T>
std::uint32_t FindColor(const ColorBands& bands, T value)
{
  if (value != value)
  {
    return bands.OfNaN;
  }
  const auto size = static_cast<double>(bands.Colors.size());
  const double band =
    (static_cast<double>(value) - bands.First) * size / (bands.Last - bands.First);
  return bands.Colors[static_cast<std::size_t>(std::clamp(std::floor(band), 0.0, size - 1.0))];
}

template <typename T>
std::vector<std::uint32_t> FindColors(const ColorBands& bands, const std::vector<T>& values)
{
  std::vector<std::uint32_t> colors(values.size());
  std::transform(values.begin(), values.end(), colors.begin(),
    [&bands](T value) { return FindColor(bands, value); });
  return colors;
}

/// The memory of a buffer, until it is unmapped. What is not written stays.
void* MapMemory(unsigned int buffer, std::int64_t bytes)
{
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  GLint size = 0;
  glGetBufferParameteriv(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &size);
  void* memory = glMapBuffer(GL_COPY_WRITE_BUFFER, GL_WRITE_ONLY);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  if (size != bytes || !memory)
  {
    throw std::runtime_error("the buffer has " + std::to_string(size) + " bytes");
  }
  return memory;
}

void UnmapMemory(unsigned int buffer)
{
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glUnmapBuffer(GL_COPY_WRITE_BUFFER);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

/// Writes through mapped memory of OpenGL.
class HostFiller : public BufferFiller
{
public:
  std::string FindObstacle(vtkDelaunayFlip*) override { return {}; }
  void Register(const DrawnBuffers& buffers) override { this->Buffers = buffers; }
  void Release() noexcept override { this->Unmap(); }
  void Map() override
  {
    if (!this->Triangles)
    {
      const std::int64_t count = this->Buffers.Count;
      this->Triangles = static_cast<std::int32_t*>(MapMemory(this->Buffers.Triangles, 12 * count));
      this->Colors = static_cast<std::uint32_t*>(MapMemory(this->Buffers.Colors, 4 * count));
    }
  }
  void Unmap() override
  {
    if (std::exchange(this->Triangles, nullptr))
    {
      UnmapMemory(this->Buffers.Triangles);
      UnmapMemory(this->Buffers.Colors);
    }
  }
  void Fill(const FilledMesh& mesh) override
  {
    const std::int64_t count = this->Buffers.Count;
    std::vector<std::int32_t> ids(3 * count);
    mesh.Session.StoreTriangles(MutableTriangleArray(ids.data(), count));
    this->Map();
    std::copy(ids.begin(), ids.end(), this->Triangles);
    TriangleMesh drawn;
    drawn.Points = mesh.Points;
    drawn.Triangles = TriangleArray(ids.data(), count);
    std::vector<double> degrees(count);
    FindSmallestAngles(drawn, GeometryKind::Surface, 1, degrees.data());
    std::vector<std::int32_t> flips(count);
    mesh.Session.StoreFlipCounts(flips.data());
    const ColorBands bands = mesh.Colors.Choose(
      mesh.Colors.ByFlipCount ? *std::max_element(flips.begin(), flips.end()) : 0);
    const std::vector<std::uint32_t> colors =
      mesh.Colors.ByFlipCount ? FindColors(bands, flips) : FindColors(bands, degrees);
    std::copy(colors.begin(), colors.end(), this->Colors);
    this->Unmap();
    this->SmallestAngle = *std::min_element(degrees.begin(), degrees.end());
  }
  double GetSmallestAngle() noexcept override { return this->SmallestAngle; }

private:
  double SmallestAngle = 0.0;
  DrawnBuffers Buffers;
  std::int32_t* Triangles = nullptr; ///< The memory of the buffers while they are mapped.
  std::uint32_t* Colors = nullptr;
};

/// Counts the calls of another one, and lets them fail as planned.
class WatchedFiller : public BufferFiller
{
public:
  ~WatchedFiller() override { this->Release(); }
  std::string FindObstacle(vtkDelaunayFlip* filter) override
  {
    return Plan.Obstacle.empty() ? this->Filler->FindObstacle(filter) : Plan.Obstacle;
  }
  void Register(const DrawnBuffers& buffers) override
  {
    Count(Plan.Registers, Plan.FailingRegister, "no registration");
    this->Filler->Register(buffers);
    Plan.IsRegistered = true;
  }
  void Release() noexcept override
  {
    Plan.Releases += Plan.IsRegistered ? 1 : 0;
    Plan.IsRegistered = Plan.AreMapped = false;
    this->Filler->Release();
  }
  void Map() override
  {
    CountMap();
    this->Filler->Map();
    Plan.AreMapped = true;
  }
  void Unmap() override
  {
    Count(Plan.Unmaps, Plan.FailingUnmap, "no unmapping");
    this->Filler->Unmap();
    Plan.AreMapped = false;
  }
  void Fill(const FilledMesh& mesh) override
  {
    Count(Plan.Fills, Plan.FailingFill, "no filling");
    if (!Plan.AreMapped)
    {
      CountMap();
    }
    this->Filler->Fill(mesh);
    Plan.AreMapped = false;
  }
  double GetSmallestAngle() noexcept override { return this->Filler->GetSmallestAngle(); }

private:
  static void CountMap() { Count(Plan.Maps, Plan.FailingMap, "no mapping"); }
  static void Count(int& calls, int failing, const char* message)
  {
    ++calls;
    if (failing > 0 && calls >= failing)
    {
      throw std::runtime_error(message);
    }
  }

  std::unique_ptr<BufferFiller> Filler =
    IsTestBackendCuda() ? MakeCudaFiller() : std::make_unique<HostFiller>();
};

}

TestFiller& TestFiller::Install()
{
  Plan = TestFiller();
  ReplaceBufferFiller(
    []() -> std::unique_ptr<BufferFiller> { return std::make_unique<WatchedFiller>(); });
  return Plan;
}

void TestFiller::Remove() { ReplaceBufferFiller(&MakeCudaFiller); }
