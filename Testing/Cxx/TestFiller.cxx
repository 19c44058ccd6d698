// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiller.h"

#include "BufferFiller.h"
#include "DelaunayFlip.h"
#include "OpenGLFunctions.h"
#include "TestBackend.h"

#include <stdexcept>
#include <utility>

using namespace delaunayflip;

namespace
{

TestFiller Plan;
unsigned int LastBuffer = 0; ///< The last filler's buffer.
std::int64_t LastCount = 0; ///< How many triangles it has written.

/// Counts a call, and lets it fail as planned.
void Count(int& calls, int failing, const char* message)
{
  if (++calls >= failing && failing > 0)
  {
    throw std::runtime_error(message);
  }
}

/// Fills by another filler, or, without one, from the host.
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
      if (this->Own)
      {
        this->Own->Map();
      }
    }
  }
  void Unmap() override
  {
    if (std::exchange(Plan.AreMapped, false))
    {
      Count(Plan.Unmaps, Plan.FailingUnmap, "no unmapping");
      if (this->Own)
      {
        this->Own->Unmap();
      }
    }
  }
  void Fill(const FlipSession& session, bool isNew) override
  {
    this->Map();
    Count(Plan.Fills, Plan.FailingFill, "no filling");
    LastCount = session.GetReport().Triangles;
    this->Own ? this->Own->Fill(session, isNew) : FillFromHost(session);
    Plan.AreMapped = false;
    Count(Plan.Unmaps, Plan.FailingUnmap, "no unmapping");
  }

private:
  static void FillFromHost(const FlipSession& session)
  {
    std::vector<std::int32_t> ids(static_cast<std::size_t>(3 * LastCount));
    session.StoreTriangles(MutableTriangleArray(ids.data(), LastCount));
    glBindBuffer(GL_COPY_WRITE_BUFFER, LastBuffer);
    glBufferSubData(GL_COPY_WRITE_BUFFER, 0, 12 * LastCount, ids.data());
    glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  }

  std::unique_ptr<BufferFiller> Own;
};

std::unique_ptr<BufferFiller> MakeWatchedFiller(
  vtkDelaunayFlipAlgorithm* filter, unsigned int buffer)
{
  if (!Plan.Obstacle.empty())
  {
    throw std::runtime_error(Plan.Obstacle);
  }
  LastBuffer = buffer;
  Plan.AreMapped = false;
  return std::make_unique<WatchedFiller>(
    IsTestBackendCuda() ? MakeCudaFiller(filter, buffer) : nullptr);
}

}

std::vector<std::int32_t> TestFiller::GetTriangles() const
{
  std::vector<std::int32_t> values(static_cast<std::size_t>(3 * LastCount));
  glBindBuffer(GL_COPY_READ_BUFFER, LastBuffer);
  glGetBufferSubData(GL_COPY_READ_BUFFER, 0, 12 * LastCount, values.data());
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  return values;
}

TestFiller& TestFiller::Install()
{
  Plan = TestFiller();
  DeviceFillerMaker = &MakeWatchedFiller;
  return Plan;
}

void TestFiller::Remove() { DeviceFillerMaker = &MakeCudaFiller; }
