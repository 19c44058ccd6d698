// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Each allocation of the engine fails once: an error, and the caller's arrays are as they were.

#include "FailingAllocations.h"

#include "DelaunayFlip.h"
#include "GeneratedMeshes.h"
#include "MeshAudit.h"
#include "PieceFlip.h"
#include "PolygonSplit.h"
#include "TriangleAngles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <new>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

constexpr std::size_t Megabyte = std::size_t(1) << 20;

using Ids = std::vector<std::int32_t>;

/// Runs `work` with its first allocation failing, its second, and so on until it gets through.
/// @param isRight whether it has done its work all the same: where threads lack memory, one thread
/// does it.
/// @returns how many there were.
std::int64_t FailEach(const std::function<void()>& work, const std::function<void()>& checkFailed,
  const std::function<bool()>& isRight, std::size_t smallest = 0)
{
  for (std::int64_t number = 1;; ++number)
  {
    bool hasThrown = false;
    FailingAllocations failing(number, smallest);
    try
    {
      work();
    }
    catch (const std::bad_alloc&)
    {
      hasThrown = true;
    }
    if (!FailingAllocations::Stop())
    {
      EXPECT_FALSE(hasThrown);
      return number - 1;
    }
    EXPECT_TRUE(hasThrown || isRight()) << "allocation " << number;
    if (hasThrown)
    {
      checkFailed();
    }
    if (testing::Test::HasFailure())
    {
      ADD_FAILURE() << "allocation " << number;
      return number;
    }
  }
}

/// Lets the allocations of a whole run fail, which stores into an array of its own.
void ExpectFailuresReported(
  const OwnedMesh<double>& owned, FlipOptions options, std::size_t smallest = 0)
{
  options.Backend = BackendKind::Threads;
  Ids expected(owned.Triangles.size());
  const MutableTriangleArray all(expected.data(), owned.NumberOfTriangles());
  FlipToDelaunay(owned.View(), options, all); // also what a process allocates only once
  const Ids untouched(owned.Triangles.size(), -7);
  const OwnedMesh<double> before = owned;
  Ids output = untouched;
  const std::int64_t count = FailEach(
    [&]()
    {
      FlipToDelaunay(
        owned.View(), options, MutableTriangleArray(output.data(), owned.NumberOfTriangles()));
    },
    [&]()
    {
      EXPECT_TRUE(output == untouched);
      EXPECT_TRUE(owned.Triangles == before.Triangles && owned.Points == before.Points);
    },
    [&]() { return std::exchange(output, untouched) == expected; }, smallest);
  EXPECT_TRUE(output == expected);
  EXPECT_GE(count, smallest > 0 ? 3 : 30);
}

FlipOptions MakeOptions(int threads, GeometryKind geometry = GeometryKind::Auto)
{
  FlipOptions options;
  options.NumberOfThreads = threads;
  options.Geometry = geometry;
  options.TrackQuality = true;
  return options;
}

/// In pieces the array has valid triangles, or what it had before.
void ExpectFailuresInPiecesReported(const OwnedMesh<double>& mesh, FlipOptions options)
{
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 1;
  options.NumberOfPieces = 3;
  const std::int64_t euler = EulerCharacteristic(mesh.View().Triangles);
  const Ids untouched(mesh.Triangles.size(), -7);
  Ids output = untouched;
  const MutableTriangleArray triangles(output.data(), mesh.NumberOfTriangles());
  const auto flip = [&]() { FlipInPieces(mesh.View(), options, triangles); };
  flip();
  const Ids expected = output;
  std::copy(untouched.begin(), untouched.end(), output.begin());
  const std::int64_t count = FailEach(
    flip,
    [&]()
    {
      EXPECT_TRUE(output == untouched ||
        EulerCharacteristic(TriangleArray(output.data(), mesh.NumberOfTriangles())) == euler);
      std::copy(untouched.begin(), untouched.end(), output.begin());
    },
    []() { return false; });
  EXPECT_GT(count, 200);
  EXPECT_TRUE(output == expected);
}

}

/// After an insertion or removal that has failed, a session goes on with all points or without the
/// new ones.
TEST(EngineAllocations, OfChangesOfPointsFailOnce)
{
  constexpr std::int64_t Before = 2000, After = 2050;
  std::mt19937 random(1);
  std::vector<double> xy = { 0, 0, 1e10, 0, 0, 1e10, 1e10, 1e10 }; // around all others
  while (xy.size() < 2 * After)
  {
    xy.push_back(1.0 + random());
  }
  const auto triangulate = [&](std::int64_t count)
  {
    PointOptions options;
    options.Backend = BackendKind::Threads;
    options.NumberOfThreads = 1;
    FlipSession session(PointInput{ PlaneArray(xy.data(), count, 2) }, options);
    session.Advance();
    return session;
  };
  const auto store = [](FlipSession& session)
  {
    Ids ids(3 * session.CountTriangles());
    session.StoreTriangles(MutableTriangleArray(ids.data(), session.CountTriangles()));
    return ids;
  };
  FlipSession more = triangulate(After), fewer = triangulate(Before);
  const Ids ofAll = store(more), ofFirst = store(fewer);
  const PlaneArray added(xy.data() + 2 * Before, After - Before, 2);
  const std::vector<std::int64_t> ids = { 3, 5, 1000, 1001 };
  FlipSession session = triangulate(Before);
  const std::int64_t insertions = FailEach([&] { session.Insert(added); },
    [&]
    {
      session.Advance();
      const Ids made = store(session);
      EXPECT_TRUE(made == ofAll || made == ofFirst);
      EXPECT_TRUE(session.Remove(ids.data(), 4));
      session = triangulate(Before);
    },
    [] { return false; });
  EXPECT_LT(10, insertions);
  FlipSession whole = triangulate(After);
  const std::int64_t removals = FailEach([&] { whole.Remove(ids.data(), 4); },
    [&]
    {
      whole.Advance();
      EXPECT_TRUE(store(whole) == ofAll);
      whole.Compact(); // reads the places of all points
      EXPECT_EQ(After, whole.GetReport().FromPoints.Used);
      whole = triangulate(After);
    },
    [] { return false; });
  EXPECT_LT(10, removals);
}

/// After a move that has failed, points are where they were.
TEST(EngineAllocations, OfMovesFailOnce)
{
  std::mt19937 random(1);
  std::vector<double> xy = { 0, 0, 1e10, 1e10, 0, 1e10, 1e10, 0, 5, 1, 5.5, 1 };
  while (xy.size() < 400)
  {
    xy.push_back(10.0 + random());
  }
  const std::vector<std::int64_t> segments = { 0, 1, 2, 3 };
  PointInput input{ PlaneArray(xy.data(), 200, 2) };
  PointOptions options;
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 1;
  const auto look = [](FlipSession& session)
  {
    session.Advance();
    Ids ids(3 * session.CountTriangles());
    session.StoreTriangles(MutableTriangleArray(ids.data(), session.CountTriangles()));
    std::vector<std::int64_t> used(200);
    session.StoreUsedPoints(used.data());
    return std::tuple(ids, used, session.GetAddedPoints().size());
  };
  const auto failEach = [&](const std::function<void(FlipSession&)>& change)
  {
    FlipSession session(input, options), other(input, options);
    const auto before = look(session);
    look(other);
    change(other);
    const auto after = look(other);
    const std::int64_t count =
      FailEach([&] { change(session); }, [&] { EXPECT_TRUE(look(session) == before); },
        [&]
        {
          const bool isRight = look(session) == after;
          session = FlipSession(input, options);
          look(session);
          return isRight;
        });
    EXPECT_LT(10, count);
  };
  const std::vector<std::int64_t> ids = { 7, 9 };
  const std::vector<double> places = { 12, 13, 1e9, 1e9 };
  const PointMove move{ PlaneArray(places.data(), 2, 2), ids.data() };
  options.PointTolerance = 1.0;
  failEach([](FlipSession& session) { session.Compact(); });
  input.Segments = segments.data();
  input.NumberOfSegments = 2;
  options.SplitCrossings = true;
  failEach([&](FlipSession& session) { session.Move(move); });
}

TEST(EngineAllocations, OfMovesOfMeshesFailOnce)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 1);
  std::vector<double> points = mesh.Points;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    points[i] += 0.7 * points[i + 1];
  }
  PointMove move;
  move.Points = PlaneArray(points.data(), mesh.View().Points.Count, 3);
  const auto store = [&](FlipSession& session)
  {
    session.Advance();
    Ids ids(mesh.Triangles.size());
    session.StoreTriangles(MutableTriangleArray(ids.data(), mesh.NumberOfTriangles()));
    return ids;
  };
  FlipOptions options = MakeOptions(1);
  options.Backend = BackendKind::Threads;
  FlipSession session(mesh.View(), options);
  const Ids before = store(session);
  const std::int64_t count = FailEach([&] { session.Move(move); },
    [&] { EXPECT_TRUE(store(session) == before); }, [] { return false; });
  EXPECT_LT(10, count);
  EXPECT_FALSE(store(session) == before);
}

TEST(EngineAllocations, OfAWholeRunFailOnce)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 1);
  ExpectFailuresReported(mesh, MakeOptions(1));
  ExpectFailuresReported(mesh, MakeOptions(1, GeometryKind::Surface));
  ExpectFailuresReported(MakeRandomBadMeshDouble(6000, 1), MakeOptions(3));
}

/// Allocations of a megabyte and more are mapped.
TEST(EngineAllocations, OfALargeMeshFailOnce)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers replace mmap themselves";
#endif
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(70000, 1);
  ExpectFailuresReported(mesh, MakeOptions(2), Megabyte);
}

TEST(EngineAllocations, OfOtherFunctionsFailOnce)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 1);
  std::vector<double> angles(mesh.NumberOfTriangles());
  const std::function<void()> nothing = []() {};
  FindFixedEdges(mesh.View(), {}); // starts threads, which a process does only once
  const std::int64_t bad = CountNonDelaunayEdges(mesh.View(), {});
  std::int64_t counted = -1;
  EXPECT_GT(FailEach([&]() { counted = CountNonDelaunayEdges(mesh.View(), {}); }, nothing,
              [&]() { return std::exchange(counted, -1) == bad; }),
    1);
  const std::vector<std::int64_t> fixed = FindFixedEdges(mesh.View(), {});
  std::vector<std::int64_t> found;
  EXPECT_GT(FailEach([&]() { found = FindFixedEdges(mesh.View(), {}); }, nothing,
              [&]() { return std::exchange(found, {}) == fixed; }),
    1);
  FindSmallestAngles(mesh.View(), GeometryKind::Planar, 2, angles.data());
  const std::vector<double> expected = angles;
  FailEach([&]() { FindSmallestAngles(mesh.View(), GeometryKind::Planar, 2, angles.data()); },
    nothing, [&]() { return angles == expected; });
}

/// Between iterations a session keeps what it has; after a failure it can be asked again.
TEST(EngineAllocations, OfASessionLeaveItUsable)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 1);
  Ids expected(mesh.Triangles.size());
  FlipToDelaunay(mesh.View(), {}, MutableTriangleArray(expected.data(), mesh.NumberOfTriangles()));
  Ids output(mesh.Triangles.size());
  const MutableTriangleArray target(output.data(), mesh.NumberOfTriangles());
  FlipSession session(mesh.View(), {});
  session.Advance(3);
  FailEach([&]() { session.StoreTriangles(target); }, []() {}, []() { return false; });
  session.Advance(-1);
  session.StoreTriangles(target);
  EXPECT_TRUE(output == expected);
}

TEST(EngineAllocations, OfAMeshInPiecesFailOnce)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  ExpectFailuresInPiecesReported(MakeBadSphere(12, 6, 1), options);
  options.Geometry = GeometryKind::Auto;
  options.TieRule = TieRuleKind::Canonical;
  ExpectFailuresInPiecesReported(MakeRandomBadMeshDouble(60, 1), options);
}

}
