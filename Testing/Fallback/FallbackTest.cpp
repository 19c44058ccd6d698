// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FakeDevice.h"
#include "FlipTestSupport.h"
#include "MeshDivision.h"
#include "PieceFlip.h"
#include "PointRun.h"
#include "RandomNumbers.h"
#include "TestDevice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// @file
/// What happens where a GPU fails, without one.

namespace delaunayflip
{

namespace
{

/// Large enough for BackendKind::Auto to take a GPU.
class FallbackTest : public testing::Test
{
protected:
  ~FallbackTest() override { CallsToFailure = 0; }

  /// A session with a backend that fails at some call, in steps of two iterations.
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
    EXPECT_TRUE(this->Mesh.Triangles == StoreTriangles(session));
    EXPECT_EQ(std::vector<std::int32_t>(this->Mesh.NumberOfTriangles()), StoreFlipCounts(session));
  }

  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(12000, 35);
  FlipResult Expected = Flip(this->Mesh.View(), OnBackend(BackendKind::Threads));
};

/// What is asked of an observer: false from the moment on when the backend has failed.
bool IsUnharmed(double) { return CallsToFailure > 0; }

TEST_F(FallbackTest, AnyCallMayFail)
{
  for (int call = 1;; ++call)
  {
    const FlipSession session = this->RunInSteps(call);
    ASSERT_TRUE(this->Expected.Triangles == StoreTriangles(session)) << call;
    const FlipReport& report = session.GetReport();
    ExpectSameStatistics(this->Expected.Report, report);
    if (CallsToFailure > 0)
    {
      EXPECT_LT(20, call);
      EXPECT_EQ("", report.Fallback);
      break;
    }
    EXPECT_EQ("as the test wants it", report.Fallback);
  }
}

TEST_F(FallbackTest, PagesOfExpectedMemoryAreTouchedOnceAndOnlyForAGpu)
{
  constexpr std::int64_t Page = 4096, Pages = 1000, Bytes = Page * Pages + 1;
  std::vector<char> duringBuild(Bytes, 'x');
  {
    const FlipSession neverAdvanced(
      this->Mesh.View(), OnBackend(BackendKind::CUDA), {}, { { duringBuild.data(), Bytes } });
  }
  EXPECT_EQ(Pages + 1, std::count(duringBuild.begin(), duringBuild.end(), 0));
  for (const BackendKind backend : { BackendKind::CUDA, BackendKind::Threads })
  {
    std::vector<char> memory(Bytes, 'x'), announcedLater(Bytes, 'x');
    FlipSession session(this->Mesh.View(), OnBackend(backend), {}, { { memory.data(), Bytes } });
    session.Expect(announcedLater.data(), Bytes);
    session.Advance(1);
    const std::int64_t expected = backend == BackendKind::CUDA ? Pages + 1 : 0;
    EXPECT_EQ(expected, std::count(announcedLater.begin(), announcedLater.end(), 0));
    EXPECT_EQ(expected, std::count(memory.begin(), memory.end(), 0));
    EXPECT_EQ(expected > 0, memory.back() == 0);
    std::fill(memory.begin(), memory.end(), 'x');
    session.Advance(1);
    EXPECT_EQ(0, std::count(memory.begin(), memory.end(), 0));
  }
}

/// Points that take flips, points with segments that divide and conquer takes over at once, and
/// points for which it does after some flips.
TEST_F(FallbackTest, AnyCallMayFailForPoints)
{
  std::vector<double> places[3];
  for (int i = 0; i < 12000; ++i)
  {
    const double angle = 2.4 * i, radius = 100.0 * std::sqrt(i);
    places[0].insert(places[0].end(), { std::cos(angle) * radius, std::sin(angle) * radius });
    const double place = 0.0005236 * i;
    places[1].insert(places[1].end(), { 1000.0 * std::cos(place), std::sin(place) });
  }
  for (int i = 0; i < 250; ++i)
  {
    const double x = 0.01 + 0.04 * i;
    places[2].insert(places[2].end(), { 1000.0 * x, 1000.0 / x });
  }
  for (const std::vector<double>& xy : places)
  {
    const auto count = static_cast<std::int64_t>(xy.size()) / 2;
    PointInput points{ PlaneArray(xy.data(), count, 2) };
    const std::vector<std::int64_t> segments = { 0, 3 * count / 4, 20, count / 2, 11, 12, 1,
      count / 6 };
    points.Segments = segments.data();
    points.NumberOfSegments = 4;
    PointOptions options{ OnBackend(BackendKind::Threads) };
    options.LongestEdge = 300.0; // removes triangles
    FlipSession expected(points, options);
    expected.Advance();
    options.Backend = BackendKind::Auto;
    const auto run = [&](int call)
    {
      CallsToFailure = call;
      FlipSession session(points, options);
      while (session.Advance(50))
      {
      }
      ASSERT_TRUE(StoreTriangles(expected) == StoreTriangles(session)) << call;
      ASSERT_EQ(expected.ListSegmentEdges(), session.ListSegmentEdges()) << call;
      ASSERT_EQ(expected.GetReport().TotalFlips, session.GetReport().TotalFlips) << call;
      ASSERT_EQ(CallsToFailure > 0 ? "" : "as the test wants it", session.GetReport().Fallback);
    };
    // Nothing replaces this backend: if it fails in a call, the next one begins anew.
    const auto failsOnce = [&](int call)
    {
      CallsToFailure = 0;
      options.Backend = BackendKind::CUDA;
      FlipSession session(points, options);
      CallsToFailure = call;
      try
      {
        session.Advance();
        session.GetReport();
        StoreTriangles(session);
      }
      catch (const BackendUnavailable&)
      {
        session.Advance();
      }
      const bool hasFailed = CallsToFailure == 0;
      CallsToFailure = 0; // or one of the calls below might fail
      EXPECT_TRUE(StoreTriangles(expected) == StoreTriangles(session)) << call;
      EXPECT_EQ(expected.GetReport().TotalFlips, session.GetReport().TotalFlips) << call;
      EXPECT_TRUE(session.GetReport().Converged()) << call;
      return hasFailed;
    };
    constexpr int Many = 1000000;
    run(Many);
    const int calls = Many - CallsToFailure;
    // Calls near the first and the last one are tried more densely.
    constexpr double Share = Reduction > 1 ? 3.0 : 0.125;
    const auto stepFor = [](int distance) { return 1 + static_cast<int>(Share * distance); };
    for (int call = 1; call <= calls; call += stepFor(std::min(call, calls - call)))
    {
      run(call);
    }
    for (int call = 1; failsOnce(call); call += stepFor(call / 2))
    {
    }
  }
}

/// Rounds of refinement are made again where a GPU fails at any time.
TEST_F(FallbackTest, AnyCallMayFailForRefinement)
{
  std::vector<double> xy;
  for (int i = 0; i < 11000; ++i)
  {
    xy.insert(xy.end(), { std::cos(2.4 * i) * std::sqrt(i), std::sin(2.4 * i) * std::sqrt(i) });
  }
  const std::int64_t segments[] = { 10998, 10999, 3, 4 };
  const RegionSeed region{ 0.0, 0.0, 5, 0.0 };
  PointInput input{ PlaneArray(xy.data(), 11000, 2) };
  input.Segments = segments;
  input.NumberOfSegments = 2;
  input.Regions = &region;
  input.NumberOfRegions = 1;
  const auto run = [&](BackendKind backend, int call)
  {
    CallsToFailure = call;
    PointOptions options{ OnBackend(backend) };
    options.MinimumAngle = 28.0;
    FlipSession session(input, options);
    session.Advance();
    EXPECT_LT(0, session.GetReport().FromPoints.RefinementPoints);
    return session;
  };
  const FlipSession expected = run(BackendKind::Threads, 0);
  ForEachFailingCall(15, run,
    [&](const FlipSession& session)
    {
      ASSERT_TRUE(StoreTriangles(expected) == StoreTriangles(session));
      ExpectSameStatistics(expected.GetReport(), session.GetReport());
    });
}

/// A GPU also fails while it refines a mesh with triangles that are not counter-clockwise.
TEST_F(FallbackTest, AnyCallMayFailForRefinementOfMeshes)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(11000, 4);
  std::swap(mesh.Triangles[0], mesh.Triangles[1]);
  const auto run = [&](BackendKind backend, int call)
  {
    CallsToFailure = call;
    FlipOptions options = OnBackend(backend, InPlane());
    options.MaximumArea = 5e-5;
    FlipSession session(mesh.View(), options);
    session.Advance();
    EXPECT_LT(0, session.GetReport().FromPoints.RefinementPoints);
    return session;
  };
  const auto listSources = [](const FlipSession& session)
  {
    std::vector<std::int32_t> sources(session.GetReport().Triangles);
    session.StoreSources(sources.data());
    return sources;
  };
  const FlipSession expected = run(BackendKind::Threads, 0);
  ForEachFailingCall(8, run,
    [&](const FlipSession& session)
    {
      ASSERT_TRUE(StoreTriangles(expected) == StoreTriangles(session));
      ASSERT_TRUE(listSources(expected) == listSources(session));
      ExpectSameStatistics(expected.GetReport(), session.GetReport());
    });
}

/// Points are inserted again, in the same batches, where a GPU fails at any time.
TEST_F(FallbackTest, AnyCallMayFailForPointsThatComeLater)
{
  std::vector<double> xy;
  for (int i = 0; i < 12600; ++i)
  {
    const double radius = std::sqrt(i % 12000); // the later ones are inside
    xy.insert(xy.end(), { std::cos(2.4 * i) * radius, std::sin(2.4 * i) * radius });
  }
  const auto run = [&](BackendKind backend, int call)
  {
    CallsToFailure = call;
    FlipSession session(
      PointInput{ PlaneArray(xy.data(), 12000, 2) }, PointOptions{ OnBackend(backend) });
    session.Advance();
    for (const std::int64_t first : { 12000, 12300 })
    {
      EXPECT_TRUE(session.Insert(PlaneArray(xy.data() + 2 * first, 300, 2)));
    }
    return session;
  };
  const FlipSession expected = run(BackendKind::Threads, 0);
  ForEachFailingCall(10, run,
    [&](const FlipSession& session)
    {
      ASSERT_TRUE(StoreTriangles(expected) == StoreTriangles(session));
      ExpectSameStatistics(expected.GetReport(), session.GetReport());
      if (CallsToFailure == 0)
      {
        EXPECT_EQ("as the test wants it", session.GetReport().Fallback);
      }
    });
}

/// If a GPU fails after points have moved, the triangles are those of the CPU.
TEST_F(FallbackTest, AnyCallMayFailForPointsThatMove)
{
  std::vector<double> xy;
  for (int i = 0; i < 12000; ++i)
  {
    const double radius = std::sqrt(i);
    xy.insert(xy.end(), { std::cos(2.4 * i) * radius, std::sin(2.4 * i) * radius });
  }
  const auto run = [&](BackendKind backend, int call)
  {
    CallsToFailure = call;
    FlipSession session(
      PointInput{ PlaneArray(xy.data(), 12000, 2) }, PointOptions{ OnBackend(backend) });
    session.Advance();
    std::vector<double> moved = xy;
    for (const double step : { 0.01, 0.02, 3.0, 0.01 })
    {
      for (std::size_t i = 0; i < moved.size(); ++i)
      {
        moved[i] += step * std::sin(static_cast<double>(7 * i));
      }
      EXPECT_TRUE(session.Move({ PlaneArray(moved.data(), 12000, 2) }));
      // If the GPU fails meanwhile, the CPU begins with the points at their current places.
      const bool isInPlace = session.GetReport().FromPoints.MoveRounds > 0;
      EXPECT_TRUE(isInPlace || step > 1.0) << step << ' ' << call;
    }
    return session;
  };
  const auto expected = StoreOrderedTriangles(run(BackendKind::Threads, 0));
  ForEachFailingCall(10, run,
    [&](const FlipSession& session)
    {
      ASSERT_TRUE(expected == StoreOrderedTriangles(session));
      EXPECT_TRUE(session.GetReport().Converged());
    });
}

/// This time with an outline, a hole and a segment: the CPU inserts them at the current places.
TEST_F(FallbackTest, AnyCallMayFailForSegmentsThatMove)
{
  std::vector<double> xy{ -130, -130, 130, -130, 130, 130, -130, 130 };
  for (int i = 0; i < 12000; ++i)
  {
    const double radius = std::sqrt(i);
    xy.insert(xy.end(), { std::cos(2.4 * i) * radius, std::sin(2.4 * i) * radius });
  }
  const auto points = static_cast<std::int64_t>(xy.size()) / 2;
  const std::vector<std::int64_t> segments{ 0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 4, 9, 7 };
  const std::vector<std::int32_t> rings{ 0, 0, 0, 0, 1, 1, 1, -1 };
  const auto run = [&](BackendKind backend, int call)
  {
    CallsToFailure = call;
    PointInput input{ PlaneArray(xy.data(), points, 2) };
    input.Segments = segments.data();
    input.NumberOfSegments = 8;
    input.Rings = rings.data();
    input.FirstHole = 1;
    FlipSession session(input, PointOptions{ OnBackend(backend) });
    session.Advance();
    std::vector<double> moved = xy;
    for (const double step : { 0.01, 0.02, 0.0 })
    {
      for (std::size_t i = 0; i < moved.size(); ++i)
      {
        moved[i] += step * std::sin(static_cast<double>(7 * i));
      }
      EXPECT_TRUE(session.Move({ PlaneArray(moved.data(), points, 2) }));
      EXPECT_LT(0, session.GetReport().FromPoints.MoveRounds) << step << ' ' << call;
    }
    return session;
  };
  const FlipSession whole = run(BackendKind::Threads, 0);
  EXPECT_LT(0, whole.GetReport().FromPoints.OutsideTriangles);
  ForEachFailingCall(10, run,
    [&](const FlipSession& session)
    {
      ASSERT_TRUE(StoreOrderedTriangles(whole) == StoreOrderedTriangles(session));
      EXPECT_EQ(whole.ListSegmentEdges(), session.ListSegmentEdges());
      EXPECT_TRUE(session.GetReport().Converged());
    });
}

/// The names of the stages in the journal of a finished run, and how much of each was done.
std::vector<std::pair<std::string, std::int64_t>> ListJournal(const LoadedRun& run)
{
  std::vector<std::pair<std::string, std::int64_t>> entries;
  for (const LoadedRun::Entry& entry : run.GetJournal())
  {
    entries.emplace_back(run.GetStages()[entry.Stage].Name, entry.Count);
  }
  return entries;
}

TEST(Journal, KeepsWhatChangesTheMesh)
{
  using Entries = std::vector<std::pair<std::string, std::int64_t>>;
  std::vector<double> spread, curve;
  for (int i = 0; i < 250; ++i)
  {
    const double radius = std::sqrt(i), x = 0.01 + 0.04 * i;
    spread.insert(spread.end(), { std::cos(2.4 * i) * radius, std::sin(2.4 * i) * radius });
    curve.insert(curve.end(), { 1000.0 * x, 1000.0 / x });
  }
  const std::vector<std::int64_t> segments = { 0, 200, 20, 150 };
  const auto run = [&](const std::vector<double>& xy)
  {
    PointInput input{ PlaneArray(xy.data(), static_cast<std::int64_t>(xy.size()) / 2, 2) };
    input.Segments = segments.data();
    input.NumberOfSegments = 2;
    PointOptions options{ OnBackend(BackendKind::Threads) };
    options.LongestEdge = 5.0;
    PointRun made(input, options, {});
    while (made.Advance(1, {}, {}))
    {
    }
    return std::pair(ListJournal(made), SizeOf(made.GetReport().Iterations));
  };
  const auto [entries, iterations] = run(spread);
  ASSERT_EQ(5u, entries.size());
  const std::int64_t around = entries[3].second;
  const Entries expected = { { "test all edges", 0 }, { "flip", iterations - around },
    { "insert segments", 2 }, { "flip around segments", around }, { "cut triangles off", 0 } };
  EXPECT_EQ(expected, entries);
  const Entries divided = run(curve).first;
  EXPECT_EQ("divide and conquer if flips are slow", divided.front().first);
  EXPECT_EQ("insert segments", divided.at(1).first);
}

TEST_F(FallbackTest, AnExceptionInTheRepetitionForgetsIt)
{
  int thrown = 0;
  for (int call = 1; CallsToFailure == 0; ++call)
  {
    CallsToFailure = call;
    const auto throwing = [asked = 0, call](double) mutable
    {
      asked += CallsToFailure == 0 ? 1 : 0;
      return asked == 3 + call % 12 ? throw std::runtime_error("from the observer") : true;
    };
    FlipSession session(this->Mesh.View(), {});
    try
    {
      while (session.Advance(2, {}, throwing))
      {
      }
    }
    catch (const std::runtime_error&)
    {
      ++thrown;
      session.Advance();
    }
    ASSERT_TRUE(this->Expected.Triangles == StoreTriangles(session)) << call;
    ASSERT_EQ(this->Expected.Report.TotalFlips, session.GetReport().TotalFlips) << call;
  }
  EXPECT_LT(0, thrown);
}

TEST_F(FallbackTest, AnAbortEndsTheRepetition)
{
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
    ASSERT_TRUE(this->Expected.Triangles == StoreTriangles(session)) << call;
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
      std::vector<std::int32_t> triangles(this->Mesh.Triangles.size());
      session.StoreTriangles(
        MutableTriangleArray(triangles.data(), this->Mesh.NumberOfTriangles()));
      EXPECT_TRUE(this->Mesh.Triangles == triangles);
    }
    this->ExpectInput(session);
    EXPECT_EQ(0, CallsToFailure);
  }
}

/// The CPU takes a copy of what is on the device.
TEST_F(FallbackTest, AnyCallMayFailForDeviceArrays)
{
  const DeviceArrays<double, std::int32_t> device(this->Mesh.View(), 2);
  for (int call = 1;; ++call)
  {
    CallsToFailure = call;
    FlipSession session(device.View(), {});
    session.Advance();
    session.StoreTriangles(device.ViewResult(), {});
    session.StoreFlipCounts(device.FlipCounts.Data(), {});
    ASSERT_TRUE(this->Expected.Triangles == device.Result.Get()) << call;
    ASSERT_TRUE(this->Expected.FlipCounts == device.FlipCounts.Get()) << call;
    ExpectSameStatistics(this->Expected.Report, session.GetReport());
    if (CallsToFailure > 0)
    {
      EXPECT_LT(5, call);
      break;
    }
    EXPECT_EQ("as the test wants it", session.GetReport().Fallback);
  }
}

TEST_F(FallbackTest, NothingPassesThroughTheHost)
{
  const DeviceArrays<double, std::int32_t> device(this->Mesh.View(), 3);
  const std::int64_t copied = CopiedBytes;
  const std::int64_t edge[] = { 100, 200 };
  const unsigned char flag = 0;
  DeviceMesh mesh = device.View();
  mesh.ConstraintEdges = edge;
  mesh.NumberOfConstraintEdges = 1;
  mesh.ConstraintsToInsert = &flag;
  FlipSession session(mesh, {});
  session.Advance();
  session.StoreTriangles(device.ViewResult(), {});
  session.StoreFlipCounts(device.FlipCounts.Data(), {});
  EXPECT_EQ(1, session.GetReport().UnmatchedConstraints);
  EXPECT_EQ(copied, CopiedBytes);
}

TEST_F(FallbackTest, TheHostAnswersOnASphereWhereADeviceFails)
{
  std::mt19937 random(7);
  std::vector<double> points;
  for (int i = 0; i < 500; ++i)
  {
    double xyz[3];
    PlaceOnSphere(DrawReal(random, -180.0, 180.0), DrawReal(random, -90.0, 90.0), xyz);
    points.insert(points.end(), xyz, xyz + 3);
  }
  PointInput input;
  input.Points = PlaneArray(points.data(), 500, 3);
  PointOptions options;
  options.Projection = ProjectionKind::Sphere;
  options.Backend = BackendKind::CUDA;
  FlipSession session(input, options);
  session.Advance();
  std::vector<std::int32_t> first(SmallestMeshForCuda), second(SmallestMeshForCuda);
  PlaceQuery query;
  query.Raster.Step[0] = 360.0 / SmallestMeshForCuda;
  query.Raster.Columns = SmallestMeshForCuda;
  query.Raster.Rows = 1;
  query.Triangles = first.data();
  AnswersOnDevice = 0;
  EXPECT_TRUE(session.Ask(query));
  EXPECT_EQ(SmallestMeshForCuda, AnswersOnDevice);
  EXPECT_LE(0, *std::min_element(first.begin(), first.end()));
  CallsToFailure = 1;
  query.Triangles = second.data();
  EXPECT_TRUE(session.Ask(query));
  EXPECT_EQ(0, CallsToFailure);
  EXPECT_EQ(SmallestMeshForCuda, AnswersOnDevice);
  EXPECT_EQ(first, second);
  query.Raster.Columns = 100; // too few for a copy to the device
  EXPECT_TRUE(session.Ask(query));
  EXPECT_EQ(SmallestMeshForCuda, AnswersOnDevice);
}

TEST_F(FallbackTest, AForcedGpuFails)
{
  FlipSession session(this->Mesh.View(), OnBackend(BackendKind::CUDA));
  CallsToFailure = 1;
  EXPECT_THROW(session.Advance(), BackendUnavailable);
}

/// Pieces so large that the engine orders their triangles. On the device all calls succeed.
TEST(RanksTest, MakeTheSameWhereverTheFirstFlipsAre)
{
  constexpr int Ranks = 2;
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(20000, 36);
  const std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), Ranks);
  std::vector<FlippedPiece> onThreads(Ranks), onDevice(Ranks);
  for (std::vector<FlippedPiece>* flipped : { &onThreads, &onDevice })
  {
    FlipOptions options =
      OnBackend(flipped == &onDevice ? BackendKind::CUDA : BackendKind::Threads);
    options.NumberOfThreads = 1;
    RunInThreads(Ranks,
      [&](PieceGroup& group)
      {
        const int rank = group.GetRank();
        FlipPiece(pieces[rank].View(), options, group, (*flipped)[rank]);
      });
  }
  for (int rank = 0; rank < Ranks; ++rank)
  {
    EXPECT_FALSE(onDevice[rank].ReceivedTriangles.empty());
    EXPECT_TRUE(onThreads[rank].Triangles == onDevice[rank].Triangles);
    EXPECT_TRUE(onThreads[rank].FlipCounts == onDevice[rank].FlipCounts);
    EXPECT_TRUE(onThreads[rank].ReceivedCoordinates == onDevice[rank].ReceivedCoordinates);
  }
}

}
}
