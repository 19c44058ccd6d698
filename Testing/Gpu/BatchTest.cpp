// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"

/// @file
/// A GPU runs iterations in batches: observers are called, and aborts act, at the end of a batch.

namespace delaunayflip
{
namespace
{

class BatchTest : public GpuTest
{
protected:
  static constexpr std::int64_t LargestBatch = 128;

  FlipSession Start() const
  {
    FlipOptions options;
    options.Backend = BackendKind::CUDA;
    return FlipSession(this->Mesh.View(), options);
  }

  std::vector<std::int32_t> Store(const FlipSession& session) const
  {
    std::vector<std::int32_t> triangles(this->Mesh.Triangles.size());
    session.StoreTriangles(MutableTriangleArray(triangles.data(), this->Mesh.NumberOfTriangles()));
    return triangles;
  }

  /// Takes 797 iterations, several batches.
  OwnedMesh<double> Mesh = MakeWorstCaseMesh(400);
};

TEST_F(BatchTest, AnAbortActsAtItsEnd)
{
  FlipSession session = this->Start();
  std::int64_t calls = 0;
  EXPECT_FALSE(session.Advance(-1,
    [&](const IterationRecord& record)
    {
      EXPECT_EQ(++calls, record.Iteration);
      return record.Iteration < 3;
    }));
  const auto done = static_cast<std::int64_t>(session.GetReport().Iterations.size());
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(calls, done);
  EXPECT_LE(3, done);
  EXPECT_GE(3 + LargestBatch, done);
  EXPECT_LT(0, session.GetReport().NonDelaunayAfter);

  // The mesh and the statistics are those after `done` iterations, and the run can continue.
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  options.MaximumIterations = done;
  EXPECT_TRUE(Flip(this->Mesh.View(), options).Triangles == this->Store(session));
  EXPECT_FALSE(session.Advance());
  options.MaximumIterations = -1;
  const FlipResult complete = Flip(this->Mesh.View(), options);
  EXPECT_TRUE(complete.Triangles == this->Store(session));
  EXPECT_EQ(complete.Report.TotalFlips, session.GetReport().TotalFlips);
  EXPECT_EQ(complete.Report.Iterations.size(), session.GetReport().Iterations.size());
  ExpectConsistentStatistics(session.GetReport());
}

TEST_F(BatchTest, AnExceptionLeavesTheSessionUsable)
{
  FlipSession session = this->Start();
  const auto throwing = [](const IterationRecord& record) -> bool
  {
    if (record.Iteration == 2)
    {
      throw std::logic_error("from the observer");
    }
    return true;
  };
  EXPECT_THROW(session.Advance(-1, throwing), std::logic_error);
  session.Advance();
  EXPECT_TRUE(session.GetReport().Converged());
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  EXPECT_TRUE(Flip(this->Mesh.View(), options).Triangles == this->Store(session));
}

}
}
