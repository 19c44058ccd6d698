// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipEngine.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <utility>

/// @file
/// What happens where a GPU fails, without one: a program of its own, in which these functions take
/// the place of the CUDA backend. It works on threads, and fails at one of its calls.

namespace delaunayflip
{

namespace
{
/// Calls of the backend until the one that fails; 0: none does.
int CallsToFailure = 0;

class FailingEngine : public FlipEngine
{
public:
  explicit FailingEngine(std::unique_ptr<FlipEngine> engine)
    : Engine(std::move(engine))
  {
  }

  std::unique_ptr<DeviceScope> MakeCurrent() const override
  {
    if (CallsToFailure > 0 && --CallsToFailure == 0)
    {
      throw BackendUnavailable("as the test wants it");
    }
    return nullptr;
  }
  FlipLoop& GetLoop() override { return this->Engine->GetLoop(); }
  const FlipReport& GetInputReport() const override { return this->Engine->GetInputReport(); }
  void StoreTriangles(const MutableTriangleArray& triangles) const override
  {
    this->Engine->StoreTriangles(triangles);
  }
  void StoreFlipCounts(std::int32_t* counts) const override
  {
    this->Engine->StoreFlipCounts(counts);
  }
  Defect FindTurnedTriangles() const override { return this->Engine->FindTurnedTriangles(); }
  void Audit() const override { this->Engine->Audit(); }

private:
  std::unique_ptr<FlipEngine> Engine;
};
}

std::unique_ptr<FlipEngine> MakeCudaEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress)
{
  return std::unique_ptr<FlipEngine>(new FailingEngine(MakeThreadEngine(mesh, options, progress)));
}

bool HasCudaDevice() { return true; }
void ReleaseCudaMemory() {}
std::size_t TakePeakCudaMemory() { return 0; }

namespace
{

/// Large enough for BackendKind::Auto to take a GPU.
class FallbackTest : public testing::Test
{
protected:
  ~FallbackTest() override { CallsToFailure = 0; }

  std::vector<std::int32_t> Store(const FlipSession& session) const
  {
    std::vector<std::int32_t> triangles(this->Mesh.Triangles.size());
    session.StoreTriangles(MutableTriangleArray(triangles.data(), this->Mesh.NumberOfTriangles()));
    return triangles;
  }

  FlipResult FlipOnThreads() const
  {
    FlipOptions options;
    options.Backend = BackendKind::Threads;
    return Flip(this->Mesh.View(), options);
  }

  /// A session whose backend fails at some call, in steps of two iterations.
  FlipSession RunInSteps(int failingCall, const ProgressObserver& progress = {}) const
  {
    CallsToFailure = failingCall;
    FlipSession session(this->Mesh.View(), {}, progress);
    while (session.Advance(2, {}, progress))
    {
      session.GetReport();
    }
    return session;
  }

  void ExpectInput(const FlipSession& session) const
  {
    EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
    EXPECT_TRUE(session.GetReport().Iterations.empty());
    EXPECT_EQ(0, session.GetReport().TotalFlips);
    EXPECT_TRUE(this->Mesh.Triangles == this->Store(session));
    std::vector<std::int32_t> counts(this->Mesh.NumberOfTriangles(), 7);
    session.StoreFlipCounts(counts.data());
    EXPECT_EQ(std::vector<std::int32_t>(counts.size(), 0), counts);
  }

  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(12000, 35);
};

/// What is asked of an observer: false from the moment on when the backend has failed.
bool IsUnharmed(double) { return CallsToFailure > 0; }

TEST_F(FallbackTest, AnyCallMayFail)
{
  const FlipResult expected = this->FlipOnThreads();
  for (int call = 1;; ++call)
  {
    const FlipSession session = this->RunInSteps(call);
    ASSERT_TRUE(expected.Triangles == this->Store(session)) << call;
    const FlipReport& report = session.GetReport();
    ExpectSameStatistics(expected.Report, report);
    if (CallsToFailure > 0)
    {
      EXPECT_LT(20, call);
      EXPECT_EQ("", report.Fallback);
      break;
    }
    EXPECT_EQ("as the test wants it", report.Fallback);
  }
}

TEST_F(FallbackTest, AnAbortEndsTheRepetition)
{
  const FlipResult expected = this->FlipOnThreads();
  int call = 1;
  for (;; ++call)
  {
    FlipSession session = this->RunInSteps(call, IsUnharmed);
    if (CallsToFailure > 0)
    {
      break;
    }
    this->ExpectInput(session);
    session.Advance();
    EXPECT_TRUE(session.GetReport().Converged());
    ASSERT_TRUE(expected.Triangles == this->Store(session)) << call;
  }
  EXPECT_LT(20, call);
}

/// Between any two batches of the iterations that are repeated.
TEST_F(FallbackTest, TheRepetitionAsksAgainAndAgain)
{
  this->RunInSteps(1000000);
  const int calls = 1000000 - CallsToFailure;
  int asked = 0;
  this->RunInSteps(calls,
    [&asked](double)
    {
      asked += CallsToFailure == 0 ? 1 : 0;
      return true;
    });
  EXPECT_EQ(0, CallsToFailure);
  EXPECT_LT(10, asked);
}

TEST_F(FallbackTest, AnAbortMayComeWhileResultsAreFetched)
{
  for (const bool fetchesReport : { true, false })
  {
    CallsToFailure = 1000000;
    FlipSession session(this->Mesh.View(), {}, IsUnharmed);
    session.Advance(5);
    CallsToFailure = 1;
    if (!fetchesReport)
    {
      EXPECT_TRUE(this->Mesh.Triangles == this->Store(session));
    }
    this->ExpectInput(session);
    EXPECT_EQ(0, CallsToFailure);
  }
}

TEST_F(FallbackTest, AForcedGpuFails)
{
  FlipOptions options;
  options.Backend = BackendKind::CUDA;
  FlipSession session(this->Mesh.View(), options);
  CallsToFailure = 1;
  EXPECT_THROW(session.Advance(), BackendUnavailable);
}

}
}
