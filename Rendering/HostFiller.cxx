// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BufferFiller.h"

#include "DelaunayFlip.h"
#include "OpenGLFunctions.h"
#include "TriangleAngles.h"

#include "vtkSMPTools.h"

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
    constexpr vtkIdType grain = 1 << 15; // triangles at a time
    const auto count = static_cast<std::size_t>(this->Buffers.Count);
    this->Before.swap(this->Ids);
    this->Ids.resize(3 * count);
    this->Counts.assign(mesh.Colors.ByFlipCount ? count : 0, 0);
    this->StoreMesh(mesh);
    const bool areMoved = std::exchange(this->PointsTime, mesh.PointsTime) != mesh.PointsTime;
    const bool measuresAll = areMoved || this->Before.size() != this->Ids.size();
    this->Degrees.resize(count);
    this->Colors.resize(count);
    const std::int32_t largest =
      this->Counts.empty() ? 0 : *std::max_element(this->Counts.begin(), this->Counts.end());
    const ColorBands bands = mesh.Colors.Choose(largest);
    vtkSMPTools::For(0, this->Buffers.Count, grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        this->Measure(mesh.Points, begin, end, measuresAll);
        this->Paint(bands, begin, end);
      });
    Upload(this->Buffers.Triangles, this->Ids.data(), 12 * this->Buffers.Count);
    Upload(this->Buffers.Colors, this->Colors.data(), 4 * this->Buffers.Count);
  }

  double GetSmallestAngle() noexcept override
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const double angle : this->Degrees)
    {
      smallest = angle < smallest ? angle : smallest;
    }
    return smallest <= 60.0 ? smallest : std::numeric_limits<double>::quiet_NaN();
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

  void Measure(const PointArray& points, vtkIdType begin, vtkIdType end, bool measuresAll)
  {
    std::vector<vtkIdType> changed;
    std::vector<std::int32_t> ids;
    for (vtkIdType t = begin; t < end; ++t)
    {
      const std::int32_t* triangle = &this->Ids[3 * t];
      if (measuresAll || !std::equal(triangle, triangle + 3, &this->Before[3 * t]))
      {
        changed.push_back(t);
        ids.insert(ids.end(), triangle, triangle + 3);
      }
    }
    TriangleMesh mesh;
    mesh.Points = points;
    mesh.Triangles = TriangleArray(ids.data(), static_cast<std::int64_t>(changed.size()));
    std::vector<double> degrees(changed.size());
    FindSmallestAngles(mesh, GeometryKind::Surface, 1, degrees.data());
    for (std::size_t i = 0; i < changed.size(); ++i)
    {
      this->Degrees[changed[i]] = degrees[i];
    }
  }

  void Paint(const ColorBands& bands, vtkIdType begin, vtkIdType end)
  {
    const auto last = static_cast<double>(bands.Colors.size() - 1);
    const double scale = (last + 1.0) / (bands.Last - bands.First);
    for (vtkIdType t = begin; t < end; ++t)
    {
      const double value = this->Counts.empty() ? this->Degrees[t] : this->Counts[t];
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
