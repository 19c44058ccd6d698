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
#include <vector>

using namespace delaunayflip;

namespace
{

TestFiller Plan;

std::uint32_t FindColor(const ColorBands& bands, double value)
{
  if (std::isnan(value))
  {
    return bands.OfNaN;
  }
  const auto size = static_cast<double>(bands.Colors.size());
  const double band = (value - bands.First) * size / (bands.Last - bands.First);
  return bands.Colors[static_cast<std::size_t>(std::clamp(std::floor(band), 0.0, size - 1.0))];
}

void Write(unsigned int buffer, const void* data, std::int64_t bytes)
{
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  GLint size = 0;
  glGetBufferParameteriv(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &size);
  if (size != bytes)
  {
    throw std::runtime_error("the buffer has " + std::to_string(size) + " bytes");
  }
  glBufferSubData(GL_COPY_WRITE_BUFFER, 0, bytes, data);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

/// Counts its calls, and lets them fail as planned. Fills buffers by CUDA or from the host.
class WatchedFiller : public BufferFiller
{
public:
  ~WatchedFiller() override { this->Release(); }
  std::string FindObstacle(vtkDelaunayFlip* filter) override
  {
    return this->Cuda && Plan.Obstacle.empty() ? this->Cuda->FindObstacle(filter) : Plan.Obstacle;
  }
  void Register(const DrawnBuffers& buffers) override
  {
    Count(Plan.Registers, Plan.FailingRegister, "no registration");
    this->Buffers = buffers;
    if (this->Cuda)
    {
      this->Cuda->Register(buffers);
    }
    Plan.IsRegistered = true;
  }
  void Release() noexcept override
  {
    Plan.Releases += Plan.IsRegistered ? 1 : 0;
    Plan.IsRegistered = Plan.AreMapped = false;
    if (this->Cuda)
    {
      this->Cuda->Release();
    }
  }
  void Map() override
  {
    Count(Plan.Maps, Plan.FailingMap, "no mapping");
    if (this->Cuda)
    {
      this->Cuda->Map();
    }
    Plan.AreMapped = true;
  }
  void Unmap() override
  {
    Count(Plan.Unmaps, Plan.FailingUnmap, "no unmapping");
    if (this->Cuda)
    {
      this->Cuda->Unmap();
    }
    Plan.AreMapped = false;
  }
  void Fill(const FilledMesh& mesh) override
  {
    Count(Plan.Fills, Plan.FailingFill, "no filling");
    if (!Plan.AreMapped)
    {
      Count(Plan.Maps, Plan.FailingMap, "no mapping");
    }
    this->Cuda ? this->Cuda->Fill(mesh) : this->FillFromHost(mesh);
    Plan.AreMapped = false;
  }
  double GetSmallestAngle() noexcept override
  {
    return this->Cuda ? this->Cuda->GetSmallestAngle() : this->SmallestAngle;
  }

private:
  static void Count(int& calls, int failing, const char* message)
  {
    ++calls;
    if (failing > 0 && calls >= failing)
    {
      throw std::runtime_error(message);
    }
  }

  void FillFromHost(const FilledMesh& mesh)
  {
    const std::int64_t count = this->Buffers.Count;
    std::vector<std::int32_t> ids(3 * count), flips(count);
    mesh.Session.StoreTriangles(MutableTriangleArray(ids.data(), count));
    mesh.Session.StoreFlipCounts(flips.data());
    TriangleMesh drawn;
    drawn.Points = mesh.Points;
    drawn.Triangles = TriangleArray(ids.data(), count);
    std::vector<double> degrees(count);
    FindSmallestAngles(drawn, GeometryKind::Surface, 1, degrees.data());
    const ColorBands bands = mesh.Colors.Choose(
      mesh.Colors.ByFlipCount ? *std::max_element(flips.begin(), flips.end()) : 0);
    std::vector<std::uint32_t> colors(count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      colors[i] = FindColor(bands, mesh.Colors.ByFlipCount ? flips[i] : degrees[i]);
    }
    Write(this->Buffers.Triangles, ids.data(), 12 * count);
    Write(this->Buffers.Colors, colors.data(), 4 * count);
    this->SmallestAngle = *std::min_element(degrees.begin(), degrees.end());
  }

  std::unique_ptr<BufferFiller> Cuda = IsTestBackendCuda() ? MakeCudaFiller() : nullptr;
  DrawnBuffers Buffers;
  double SmallestAngle = 0.0;
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
