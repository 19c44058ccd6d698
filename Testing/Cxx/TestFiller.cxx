// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiller.h"

#include "BufferFiller.h"
#include "OpenGLFunctions.h"
#include "TestBackend.h"

#include <stdexcept>
#include <utility>

using namespace delaunayflip;

namespace
{

TestFiller Plan;
DrawnBuffers Last;

/// Counts a call, and lets it fail as planned.
void Count(int& calls, int failing, const char* message)
{
  if (++calls >= failing && failing > 0)
  {
    throw std::runtime_error(message);
  }
}

class WatchedFiller : public BufferFiller
{
public:
  explicit WatchedFiller(std::unique_ptr<BufferFiller> own)
    : Own(std::move(own))
  {
    ++Plan.Fillers;
    ++Plan.Living;
  }
  ~WatchedFiller() override { --Plan.Living; }

  void Map() override
  {
    if (!std::exchange(Plan.AreMapped, true))
    {
      Count(Plan.Maps, Plan.FailingMap, "no mapping");
      this->Own->Map();
    }
  }
  void Unmap() override
  {
    if (std::exchange(Plan.AreMapped, false))
    {
      Count(Plan.Unmaps, Plan.FailingUnmap, "no unmapping");
      this->Own->Unmap();
    }
  }
  void Fill(const FilledMesh& mesh) override
  {
    this->Map();
    Count(Plan.Fills, Plan.FailingFill, "no filling");
    this->Own->Fill(mesh);
    Plan.AreMapped = false;
    Count(Plan.Unmaps, Plan.FailingUnmap, "no unmapping");
  }
  double GetSmallestAngle() noexcept override { return this->Own->GetSmallestAngle(); }

private:
  std::unique_ptr<BufferFiller> Own;
};

std::unique_ptr<BufferFiller> MakeWatchedFiller(
  vtkDelaunayFlip* filter, const DrawnBuffers& buffers)
{
  if (!Plan.Obstacle.empty())
  {
    throw std::runtime_error(Plan.Obstacle);
  }
  Last = buffers;
  Plan.AreMapped = false;
  return std::make_unique<WatchedFiller>(
    (IsTestBackendCuda() ? MakeCudaFiller : MakeHostFiller)(filter, buffers));
}

template <typename T>
std::vector<T> Read(unsigned int buffer, std::int64_t count)
{
  std::vector<T> values(static_cast<std::size_t>(count));
  glBindBuffer(GL_COPY_READ_BUFFER, buffer);
  glGetBufferSubData(GL_COPY_READ_BUFFER, 0, 4 * count, values.data());
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  return values;
}

}

std::vector<std::int32_t> TestFiller::GetTriangles() const
{
  return Read<std::int32_t>(Last.Triangles, 3 * Last.Count);
}

std::vector<std::uint32_t> TestFiller::GetColors() const
{
  return Read<std::uint32_t>(Last.Colors, Last.Count);
}

TestFiller& TestFiller::Install()
{
  Plan = TestFiller();
  DeviceFillerMaker = &MakeWatchedFiller;
  return Plan;
}

void TestFiller::Remove() { DeviceFillerMaker = &MakeCudaFiller; }
