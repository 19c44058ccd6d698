// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BufferFiller.h"

#include "DelaunayFlip.h"
#include "OpenGLFunctions.h"
#include "TriangleAngles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

void Upload(unsigned int buffer, const void* data, std::int64_t bytes)
{
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

/// Writes whole buffers, but measures only triangles that have other points than the time before.
class HostFiller : public BufferFiller
{
public:
  explicit HostFiller(const DrawnBuffers& buffers)
    : Buffers(buffers)
  {
  }

  void Fill(const FilledMesh& mesh) override
  {
    const auto count = static_cast<std::size_t>(this->Buffers.Count);
    this->Before.swap(this->Ids);
    this->Ids.resize(3 * count);
    this->Counts.assign(mesh.Colors.ByFlipCount ? count : 0, 0);
    this->StoreMesh(mesh);
    const bool areMoved = std::exchange(this->PointsTime, mesh.PointsTime) != mesh.PointsTime;
    this->Measure(mesh.Points, areMoved || this->Before.size() != this->Ids.size());
    this->Paint(mesh.Colors);
    Upload(this->Buffers.Triangles, this->Ids.data(), 12 * this->Buffers.Count);
    Upload(this->Buffers.Colors, this->Colors.data(), 4 * this->Buffers.Count);
  }

  double GetSmallestAngle() noexcept override
  {
    double smallest = std::numeric_limits<double>::quiet_NaN();
    for (const double angle : this->Degrees)
    {
      smallest = smallest <= angle || std::isnan(angle) ? smallest : angle;
    }
    return smallest;
  }

private:
  /// Ids of points that do not exist become 0: the mesh may be one that no filter has checked.
  void StoreMesh(const FilledMesh& mesh)
  {
    if (mesh.Session)
    {
      mesh.Session->StoreTriangles(MutableTriangleArray(this->Ids.data(), this->Buffers.Count));
      if (mesh.Colors.ByFlipCount)
      {
        mesh.Session->StoreFlipCounts(this->Counts.data());
      }
      return;
    }
    for (std::size_t i = 0; i < this->Ids.size(); ++i)
    {
      const std::int64_t id = mesh.Triangles.Get(static_cast<std::int64_t>(i / 3), i % 3);
      this->Ids[i] = id >= 0 && id < mesh.Points.Count ? static_cast<std::int32_t>(id) : 0;
    }
    if (mesh.FlipCounts && mesh.Colors.ByFlipCount)
    {
      std::copy_n(mesh.FlipCounts, this->Counts.size(), this->Counts.begin());
    }
  }

  void Measure(const PointArray& points, bool measuresAll)
  {
    this->Degrees.resize(this->Ids.size() / 3);
    std::vector<std::size_t> changed;
    std::vector<std::int32_t> ids;
    for (std::size_t t = 0; t < this->Degrees.size(); ++t)
    {
      const auto first = this->Ids.begin() + static_cast<std::ptrdiff_t>(3 * t);
      if (measuresAll ||
        !std::equal(first, first + 3, this->Before.begin() + (first - this->Ids.begin())))
      {
        changed.push_back(t);
        ids.insert(ids.end(), first, first + 3);
      }
    }
    TriangleMesh mesh;
    mesh.Points = points;
    mesh.Triangles = TriangleArray(ids.data(), static_cast<std::int64_t>(changed.size()));
    std::vector<double> degrees(changed.size());
    FindSmallestAngles(mesh, GeometryKind::Surface, 0, degrees.data());
    for (std::size_t i = 0; i < changed.size(); ++i)
    {
      this->Degrees[changed[i]] = degrees[i];
    }
  }

  void Paint(const DrawnColors& colors)
  {
    const std::int32_t largest =
      this->Counts.empty() ? 0 : *std::max_element(this->Counts.begin(), this->Counts.end());
    const ColorBands bands = colors.Choose(largest);
    const auto last = static_cast<double>(bands.Colors.size() - 1);
    const double scale = (last + 1.0) / (bands.Last - bands.First);
    this->Colors.resize(this->Degrees.size());
    for (std::size_t t = 0; t < this->Colors.size(); ++t)
    {
      const double value = colors.ByFlipCount ? this->Counts[t] : this->Degrees[t];
      const double band = std::clamp((value - bands.First) * scale, 0.0, last);
      this->Colors[t] =
        std::isnan(value) ? bands.OfNaN : bands.Colors[static_cast<std::size_t>(band)];
    }
  }

  DrawnBuffers Buffers;
  std::uint64_t PointsTime = 0;
  std::vector<std::int32_t> Ids, Before; ///< Of this fill and the last one.
  std::vector<std::int32_t> Counts; ///< Only if colours show them.
  std::vector<double> Degrees;
  std::vector<std::uint32_t> Colors;
};

}

std::unique_ptr<BufferFiller> MakeHostFiller(vtkDelaunayFlip*, const DrawnBuffers& buffers)
{
  return std::make_unique<HostFiller>(buffers);
}

}
