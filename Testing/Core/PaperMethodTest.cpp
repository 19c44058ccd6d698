// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PaperMethod.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "References.h"
#include "TestBackend.h"

#include <gtest/gtest.h>

/// @file
/// The baseline of the benchmarks is the paper's method, and does what the paper says of it. Which
/// edge is flipped first differs from run to run, so these tests ask for nothing that depends on
/// it.

namespace delaunayflip
{
namespace
{

PaperOptions InDouble(double epsilon)
{
  PaperOptions options;
  options.InDouble = true;
  options.Epsilon = epsilon;
  options.OnGpu = IsTestBackendCuda();
  options.CountsIterations = true;
  return options;
}

PaperResult RunPaper(const TriangleMesh& mesh, const PaperOptions& options)
{
  return PaperMethod(mesh, options).Run();
}

/// Ends, and leaves as many edges of every kind as there were.
void ExpectSound(const TriangleMesh& mesh, const PaperResult& result)
{
  EXPECT_TRUE(result.Converged);
  EXPECT_EQ(result.Iterations, static_cast<std::int64_t>(result.Counts.size()));
  const TriangleArray after = ViewTriangles(result.Triangles);
  const EdgeCounts before = CountEdges(mesh.Triangles);
  EXPECT_EQ(before.Edges, CountEdges(after).Edges);
  EXPECT_EQ(before.Boundary, CountEdges(after).Boundary);
  EXPECT_EQ(before.WronglyWound, CountEdges(after).WronglyWound);
  EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, after));
}

/// In single precision too: the chain has no near ties.
TEST(PaperMethod, TakesTheFlipsOfFigure6)
{
  for (const bool inDouble : { false, true })
  {
    PaperOptions options = InDouble(1e-5);
    options.InDouble = inDouble;
    const OwnedMesh<double> mesh = MakeWorstCaseMesh(4);
    const PaperResult result = RunPaper(mesh.View(), options);
    ExpectSound(mesh.View(), result);
    std::vector<std::int64_t> flips;
    for (const PaperIteration& iteration : result.Counts)
    {
      EXPECT_EQ(iteration.Bad, iteration.Flipped) << "no two bad edges share a triangle";
      flips.push_back(iteration.Flipped);
    }
    EXPECT_EQ((std::vector<std::int64_t>{ 1, 2, 3, 2, 1 }), flips);
  }
}

/// In double precision, with no four points near a circle, nothing is "quasi".
TEST(PaperMethod, FindsTheDelaunayTriangulation)
{
  const OwnedMesh<float> mesh = MakeRandomBadMesh(20000 / Reduction, 4);
  const TriangleSet expected = MakeCgalDelaunay(mesh.View().Points);
  ASSERT_NE(expected, ToTriangleSet(mesh.Triangles));
  for (const PaperTestKind test : { PaperTestKind::OppositeAngles, PaperTestKind::InCircle })
  {
    for (const int threads : { 1, 4 })
    {
      PaperOptions options = InDouble(test == PaperTestKind::InCircle ? 1e-15 : 1e-7);
      options.Test = test;
      options.NumberOfThreads = threads;
      const PaperResult result = RunPaper(mesh.View(), options);
      ExpectSound(mesh.View(), result);
      EXPECT_EQ(expected, ToTriangleSet(result.Triangles));
      // The paper excludes under 20 %. Threads of a CPU, which come to many neighbours of an edge
      // after its flip, exclude more; on a GPU more of them read at once.
      std::int64_t bad = 0;
      for (const PaperIteration& iteration : result.Counts)
      {
        EXPECT_LE(iteration.Flipped, iteration.Bad);
        bad += iteration.Bad;
      }
      EXPECT_LT(result.CountFlips(), bad) << "nobody was excluded: neighbours flipped at once";
      EXPECT_GT(result.CountFlips(), 0.6 * static_cast<double>(bad));
    }
  }
}

TEST(PaperMethod, MakesASurfaceDelaunay)
{
  const OwnedMesh<double> mesh = MakeBadSphere(60, 40, 8);
  PaperOptions options = InDouble(1e-7);
  options.Dimension = 3;
  const PaperResult result = RunPaper(mesh.View(), options);
  ExpectSound(mesh.View(), result);
  FlipOptions judge = OnSurface();
  judge.Tolerance = 2e-7;
  EXPECT_GT(CountNonDelaunayEdges(mesh.View(), judge), 0);
  EXPECT_EQ(0, CountNonDelaunayEdges(WithTriangles(mesh.View(), result.Triangles), judge));
}

TEST(PaperMethod, KeepsEdgesBeyondTheNormalThreshold)
{
  const OwnedMesh<double> mesh = MakeBadSphere(20, 12, 9);
  PaperOptions options = InDouble(1e-7);
  options.Dimension = 3;
  std::vector<std::int64_t> flips;
  for (const double threshold : { 0.0, 12.0, 180.0 })
  {
    options.NormalThreshold = threshold;
    flips.push_back(RunPaper(mesh.View(), options).CountFlips());
  }
  EXPECT_EQ(0, flips[0]);
  EXPECT_LT(flips[0], flips[1]);
  EXPECT_LT(flips[1], flips[2]);
}

}
}
