// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipError.h"
#include "FlipTestSupport.h"
#include "PointTriangulation.h"
#include "TestDevice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

/// @file
/// Meshes in device memory: the result is that of the same mesh in the host's memory, bit for bit.
/// Runs on a GPU, and with FakeDevice.cpp where there need not be one.

namespace delaunayflip
{
namespace
{

/// A mesh in device memory with the types of its arrays.
template <typename RealT, typename IdT, int ComponentsT>
struct Layout
{
  using Real = RealT;
  using Arrays = DeviceArrays<RealT, IdT>;
  static constexpr int Components = ComponentsT;
};

class TestOfADevice : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!HasTestDevice())
    {
      GTEST_SKIP() << "no GPU";
    }
  }
};

template <typename Tested>
class DeviceLayoutTest : public TestOfADevice
{
};

using Layouts = testing::Types<Layout<float, std::int32_t, 3>, Layout<float, std::int64_t, 2>,
  Layout<double, std::int32_t, 2>, Layout<double, std::int64_t, 3>>;
TYPED_TEST_SUITE(DeviceLayoutTest, Layouts);

using Arrays = DeviceArrays<double, std::int32_t>;

class DeviceMeshTest : public TestOfADevice
{
protected:
  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(2000, 71);
};

/// Flips a mesh in device memory, and expects what threads make of the same mesh.
template <typename Real, typename Id>
FlipReport ExpectSame(const TriangleMesh& mesh, const FlipOptions& options, int components,
  const DeviceArrays<Real, Id>& device)
{
  const std::vector<Real> before = device.Points.Get();
  FlipSession session(device.View(), options);
  session.Advance();
  session.StoreTriangles(device.ViewResult(), {});
  session.StoreFlipCounts(device.FlipCounts.Data(), {});
  const FlipResult expected = Flip(mesh, OnBackend(BackendKind::Threads, options));
  const std::vector<Id> ids(expected.Triangles.begin(), expected.Triangles.end());
  EXPECT_TRUE(ids == device.Result.Get());
  EXPECT_TRUE(expected.FlipCounts == device.FlipCounts.Get());
  EXPECT_LT(0, expected.Report.TotalFlips);
  ExpectSameStatistics(expected.Report, session.GetReport());
  EXPECT_TRUE((DeviceArrays<Real, Id>::ListIds(mesh.Triangles)) == device.Triangles.Get());
  EXPECT_TRUE(before == device.Points.Get());
  EXPECT_EQ(before.size(), static_cast<std::size_t>(components * mesh.Points.Count));
  return session.GetReport();
}

FlipReport ExpectSame(const TriangleMesh& mesh, const FlipOptions& options)
{
  return ExpectSame(mesh, options, 3, Arrays(mesh, 3));
}

template <typename Real>
OwnedMesh<Real> MakeRandomBadMeshOf(std::int64_t points, std::uint32_t seed)
{
  OwnedMesh<Real> mesh;
  Append(mesh, MakeRandomBadMeshDouble(points, seed));
  return mesh;
}

/// Large enough to be sorted, and to iterate in chunks.
TYPED_TEST(DeviceLayoutTest, GivesTheSameBits)
{
  const auto mesh = MakeRandomBadMeshOf<typename TypeParam::Real>(40000, 70);
  const typename TypeParam::Arrays device(mesh.View(), TypeParam::Components);
  const FlipReport report = ExpectSame(mesh.View(), {}, TypeParam::Components, device);
  EXPECT_EQ(0u, report.Backend.rfind("CUDA: ", 0)) << report.Backend;
  EXPECT_EQ("", report.Fallback);
}

/// The smallest allocation that ends with the mesh shows reads beyond it to compute-sanitizer.
TYPED_TEST(DeviceLayoutTest, GivesTheSameBitsOfFewTriangles)
{
  const auto mesh = MakeRandomBadMeshOf<typename TypeParam::Real>(300, 72);
  const typename TypeParam::Arrays device(mesh.View(), TypeParam::Components);
  ExpectSame(mesh.View(), {}, TypeParam::Components, device);
}

TEST_F(DeviceMeshTest, SurfacesAndTiltedPlanes)
{
  const FlipReport report = ExpectSame(MakeBadSphere(60, 30, 64).View(), {});
  EXPECT_EQ(0u, report.Backend.rfind("CUDA: ", 0)) << report.Backend;
  const AffineMap tilt = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0.25, 0.5, 0, 3 } } };
  const OwnedMesh<double> plane = Transform(this->Mesh, tilt);
  EXPECT_EQ(GeometryKind::Planar, ExpectSame(plane.View(), {}).GeometryUsed);
}

TEST_F(DeviceMeshTest, ConstraintsRegionsAndFrozenTrianglesAreTheHosts)
{
  std::vector<std::int32_t> regions(this->Mesh.NumberOfTriangles());
  std::vector<unsigned char> frozen(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    regions[i] = static_cast<std::int32_t>(i / 400);
    frozen[i] = i % 97 == 0;
  }
  const std::vector<std::int64_t> edges(
    this->Mesh.Triangles.begin(), this->Mesh.Triangles.begin() + 60);
  TriangleMesh mesh = WithConstraints(this->Mesh.View(), edges);
  mesh.Regions = regions.data();
  mesh.FrozenTriangles = frozen.data();
  const FlipReport report = ExpectSame(mesh, {});
  EXPECT_LT(0, report.Edges.Region);
  EXPECT_LT(0, report.Edges.Constraint);
}

TEST_F(DeviceMeshTest, ConstraintsAreInserted)
{
  const std::vector<std::int64_t> edge{ 100, 200 };
  const unsigned char flag = 1;
  const TriangleMesh mesh = WithConstraints(this->Mesh.View(), edge, &flag);
  for (const BackendKind backend : { BackendKind::Auto, BackendKind::CUDA })
  {
    const FlipReport report = ExpectSame(mesh, OnBackend(backend));
    EXPECT_EQ(1, report.InsertedConstraints);
    EXPECT_LT(0, report.ConstraintFlips);
  }
}

TEST_F(DeviceMeshTest, ThreadsGetACopy)
{
  const FlipReport report = ExpectSame(this->Mesh.View(), OnBackend(BackendKind::Threads));
  EXPECT_EQ(0u, report.Backend.rfind("Threads: ", 0)) << report.Backend;
  const OwnedMesh<float> floats = MakeRandomBadMesh(500, 73);
  const DeviceArrays<float, std::int64_t> device(floats.View(), 2);
  ExpectSame(floats.View(), OnBackend(BackendKind::Threads), 2, device);
}

/// Whether or not threads flip, and constraints were inserted on the host.
TEST_F(DeviceMeshTest, DoesNotFollowItsPoints)
{
  const Arrays device(this->Mesh.View(), 3);
  const std::int64_t ends[] = { 100, 200 };
  const unsigned char flag = 1;
  for (const std::int64_t constraints : { 0, 1 })
  {
    DeviceMesh mesh = device.View();
    mesh.ConstraintEdges = ends;
    mesh.NumberOfConstraintEdges = constraints;
    mesh.ConstraintsToInsert = &flag;
    FlipSession session(mesh, OnBackend(BackendKind::Threads));
    session.Advance();
    EXPECT_EQ(constraints, session.GetReport().InsertedConstraints);
    PointMove move;
    move.Points = PlaneArray(this->Mesh.Points.data(), this->Mesh.View().Points.Count, 3);
    EXPECT_THROW(session.Move(move), InvalidOptions);
  }
}

TEST_F(DeviceMeshTest, TheResultMayReplaceTheInput)
{
  const Arrays device(this->Mesh.View(), 3);
  const FlipReport report = FlipToDelaunay(device.View(), {}, device.ViewInput());
  EXPECT_TRUE(report.Converged());
  EXPECT_TRUE(Flip(this->Mesh.View()).Triangles == device.Triangles.Get());
}

TEST_F(DeviceMeshTest, EveryStepCanBeStored)
{
  const Arrays device(this->Mesh.View(), 3);
  FlipSession onDevice(device.View(), {});
  FlipSession onHost(this->Mesh.View(), OnBackend(BackendKind::Threads));
  std::vector<std::int32_t> expected(this->Mesh.Triangles.size());
  const MutableTriangleArray host(expected.data(), this->Mesh.NumberOfTriangles());
  bool isRunning = true;
  while (isRunning)
  {
    isRunning = onDevice.Advance(1);
    EXPECT_EQ(isRunning, onHost.Advance(1));
    onDevice.StoreTriangles(device.ViewResult(), {});
    onHost.StoreTriangles(host);
    ASSERT_TRUE(expected == device.Result.Get());
    onDevice.StoreTriangles(host);
    ASSERT_TRUE(expected == device.Result.Get());
  }
}

TEST_F(DeviceMeshTest, AnySessionStoresOnADevice)
{
  const FlipResult expected = Flip(this->Mesh.View(), OnBackend(BackendKind::Threads));
  for (const BackendKind backend : { BackendKind::Threads, BackendKind::CUDA })
  {
    const DeviceArrays<double, std::int64_t> device(this->Mesh.View(), 3);
    FlipSession session(this->Mesh.View(), OnBackend(backend));
    session.Advance();
    session.StoreTriangles(device.ViewResult(), {});
    session.StoreFlipCounts(device.FlipCounts.Data(), {});
    const std::vector<std::int64_t> ids = device.Result.Get();
    EXPECT_TRUE(std::vector<std::int32_t>(ids.begin(), ids.end()) == expected.Triangles);
    EXPECT_TRUE(expected.FlipCounts == device.FlipCounts.Get());
  }
  FlipOptions inPieces = OnBackend(BackendKind::Threads);
  inPieces.NumberOfPieces = 3;
  FlipSession divided(this->Mesh.View(), inPieces);
  divided.Advance();
  const DeviceArrays<double, std::int64_t> device(this->Mesh.View(), 3);
  divided.StoreFlipCounts(device.FlipCounts.Data(), {});
  EXPECT_EQ(StoreFlipCounts(divided), device.FlipCounts.Get());
  EXPECT_TRUE(divided.GetAddedPoints().empty());
}

TEST_F(DeviceMeshTest, AnAbortedBuildGivesTheInput)
{
  const DeviceArrays<double, std::int64_t> device(this->Mesh.View(), 2);
  FlipSession session(device.View(), {}, [](double) { return false; });
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(2000, session.GetReport().Points);
  session.StoreTriangles(device.ViewResult(), {});
  session.StoreFlipCounts(device.FlipCounts.Data(), {});
  EXPECT_TRUE(device.Triangles.Get() == device.Result.Get());
  EXPECT_EQ(std::vector<std::int32_t>(this->Mesh.NumberOfTriangles(), 0), device.FlipCounts.Get());
  EXPECT_FALSE(session.Advance());
  EXPECT_TRUE(session.GetReport().Converged());
}

TEST_F(DeviceMeshTest, NothingIsFlippedInAnEmptyMesh)
{
  DeviceMesh mesh;
  EXPECT_TRUE(FlipToDelaunay(mesh, {}, MutableTriangleArray()).Converged());
  const Arrays device(this->Mesh.View(), 3);
  mesh.Points = device.View().Points;
  EXPECT_EQ(2000, FlipToDelaunay(mesh, {}, MutableTriangleArray()).Points);
}

template <typename Id>
void ExpectInvalid(const TriangleMesh& mesh, Id id)
{
  const DeviceArrays<double, Id> device(mesh, 3);
  std::vector<Id> ids = device.Triangles.Get();
  ids[3 * 17 + 2] = id;
  ids[3 * 19] = -1;
  device.Triangles.Set(ids);
  ExpectInvalidMesh(17, id, [&] { FlipToDelaunay(device.View(), {}, device.ViewResult()); });
  EXPECT_EQ(77, device.Result.Get()[0]);
}

TEST_F(DeviceMeshTest, AnInvalidIdIsNamed)
{
  ExpectInvalid<std::int32_t>(this->Mesh.View(), 2000);
  ExpectInvalid<std::int32_t>(this->Mesh.View(), -5);
  ExpectInvalid<std::int64_t>(this->Mesh.View(), std::int64_t(1) << 33);
}

TEST_F(DeviceMeshTest, RefusesOtherMemoryAndShapes)
{
  const Arrays device(this->Mesh.View(), 3);
  const auto expectRefused = [&](const auto& change, int number = -1)
  {
    DeviceMesh mesh = device.View();
    change(mesh);
    EXPECT_THROW(FlipSession(mesh, With(&FlipOptions::Device, number)), InvalidOptions);
  };
  expectRefused([&](DeviceMesh& mesh)
    { mesh.Points = DevicePointArray(this->Mesh.Points.data(), this->Mesh.NumberOfPoints()); });
  expectRefused([&](DeviceMesh& mesh) { mesh.Triangles = this->Mesh.View().Triangles; });
  for (const int components : { 0, 1, 4 })
  {
    expectRefused([&](DeviceMesh& mesh) { mesh.Points.Components = components; });
  }
  expectRefused([](DeviceMesh&) {}, 77);
  PointInput points;
  points.Points = PlaneArray(device.Points.Data(), this->Mesh.NumberOfPoints(), 3);
  points.OnDevice = true;
  EXPECT_THROW(FlipSession(points, PointOptions{ With(&FlipOptions::Device, 77) }), InvalidOptions);
  const FlipSession session(device.View(), {});
  std::vector<std::int32_t> host(this->Mesh.Triangles.size());
  const MutableTriangleArray result(host.data(), this->Mesh.NumberOfTriangles());
  EXPECT_THROW(session.StoreTriangles(result, {}), InvalidOptions);
  EXPECT_THROW(session.StoreFlipCounts(host.data(), {}), InvalidOptions);
  EXPECT_TRUE(std::vector<std::int32_t>(host.size(), 0) == host);
  ExpectSame(this->Mesh.View(), With(&FlipOptions::Device, 0));
}

/// Points on a sphere, in device memory and in the host's: the mesh is that of threads, whether it
/// stays on the device or has ties, repeated points or points inside.
class DeviceSphereTest : public TestOfADevice
{
protected:
  static std::vector<double> DrawPoints(std::int64_t count)
  {
    std::mt19937 random(3);
    std::vector<double> points(3 * count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double longitude = 360.0 * (random() * 0x1p-32),
                   latitude = 180.0 * (random() * 0x1p-32);
      PlaceOnSphere(longitude, latitude - 90.0, points.data() + 3 * i);
    }
    return points;
  }

  /// Longitudes and latitudes at equal distances, without the poles: many ties.
  static std::vector<double> MakeGrid(int columns, int rows)
  {
    std::vector<double> points;
    for (int i = 0; i < columns * rows; ++i)
    {
      double xyz[3];
      PlaceOnSphere(
        360.0 * (i % columns) / columns, 180.0 * (i / columns + 0.5) / rows - 90.0, xyz);
      points.insert(points.end(), xyz, xyz + 3);
    }
    return points;
  }

  static PointInput View(const double* points, std::size_t numbers, bool onDevice)
  {
    PointInput input;
    input.Points = PlaneArray(points, static_cast<std::int64_t>(numbers / 3), 3);
    input.OnDevice = onDevice;
    return input;
  }

  struct Stored
  {
    std::vector<std::int32_t> Triangles, Neighbors, FlipCounts;
    std::vector<std::int64_t> Used;

    bool operator==(const Stored& other) const
    {
      return this->Triangles == other.Triangles && this->Neighbors == other.Neighbors &&
        this->FlipCounts == other.FlipCounts && this->Used == other.Used;
    }
  };

  static Stored StoreOnHost(const FlipSession& session, std::size_t points)
  {
    const std::int64_t count = session.CountTriangles();
    Stored stored{ std::vector<std::int32_t>(3 * count), std::vector<std::int32_t>(3 * count),
      std::vector<std::int32_t>(count), std::vector<std::int64_t>(points) };
    session.StoreTriangles(MutableTriangleArray(stored.Triangles.data(), count));
    session.StoreNeighbors(stored.Neighbors.data());
    session.StoreFlipCounts(stored.FlipCounts.data());
    session.StoreUsedPoints(stored.Used.data());
    return stored;
  }

  static FlipSession Run(const PointInput& input, BackendKind backend)
  {
    PointOptions options;
    options.Projection = ProjectionKind::Sphere;
    options.Backend = backend;
    FlipSession session(input, options);
    session.Advance();
    return session;
  }

  static void ExpectSameSphere(const std::vector<double>& points)
  {
    const std::size_t count = points.size() / 3;
    const PointInput onHost = View(points.data(), points.size(), false);
    const FlipSession threads = Run(onHost, BackendKind::Threads);
    const Stored expected = StoreOnHost(threads, count);
    const FlipSession copied = Run(onHost, BackendKind::CUDA);
    EXPECT_TRUE(expected == StoreOnHost(copied, count));
    ExpectSameStatistics(threads.GetReport(), copied.GetReport());
    EXPECT_EQ(0u, copied.GetReport().Backend.rfind("CUDA: ", 0));
    const DeviceValues<double> values(points);
    const FlipSession session = Run(View(values.Data(), points.size(), true), BackendKind::Auto);
    ExpectSameStatistics(threads.GetReport(), session.GetReport());
    const std::int64_t triangles = session.CountTriangles();
    const DeviceValues<std::int64_t> ids(std::vector<std::int64_t>(3 * triangles));
    const DeviceValues<std::int32_t> neighbors(std::vector<std::int32_t>(3 * triangles));
    session.StoreTriangles(MutableTriangleArray(ids.Data(), triangles), {});
    session.StoreNeighbors(neighbors.Data(), {});
    const std::vector<std::int64_t> stored = ids.Get();
    EXPECT_TRUE(expected.Triangles == std::vector<std::int32_t>(stored.begin(), stored.end()));
    EXPECT_TRUE(expected.Neighbors == neighbors.Get());
    EXPECT_TRUE(expected == StoreOnHost(session, count));
  }
};

TEST_F(DeviceSphereTest, StaysOnTheDevice)
{
  for (const std::int64_t count : { 4, 300, 20000 })
  {
    ExpectSameSphere(DrawPoints(count));
  }
}

TEST_F(DeviceSphereTest, GoesOnOnTheHost)
{
  std::vector<double> points = DrawPoints(300);
  points.insert(points.end(), { 0.5, 0.0, 0.0 }); // inside
  ExpectSameSphere(points);
  points = DrawPoints(300);
  points.insert(points.end(), points.begin(), points.begin() + 30); // repeated
  ExpectSameSphere(points);
  points[7] = NAN;
  ExpectSameSphere(points);
  ExpectSameSphere({ 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0.6, 0.8, 0, 0.6,
    -0.8, 0, -0.6, 0.8, 0, -0.6, -0.8, 0 }); // four and more in one circle
}

/// Questions about a triangulation on a sphere, with places in the memory of the host and of the
/// device: the answers are those of threads, to the last bit.
class DeviceSphereAnswers : public DeviceSphereTest
{
protected:
  struct Answers
  {
    std::vector<std::int32_t> Triangles;
    std::vector<double> Results;

    bool operator==(const Answers& other) const
    {
      const auto isSame = [](double a, double b) { return a == b || (a != a && b != b); };
      return this->Triangles == other.Triangles &&
        std::equal(this->Results.begin(), this->Results.end(), other.Results.begin(),
          other.Results.end(), isSame);
    }
  };

  static constexpr int Components = 2;

  /// All kinds of places: any, corners of triangles, middles of edges, and some that are nowhere.
  static std::vector<double> ListPlaces(
    const std::vector<double>& points, const std::vector<std::int32_t>& triangles)
  {
    std::vector<double> places = DrawPoints(SmallestMeshForCuda);
    places.insert(places.end(), points.begin(), points.end());
    for (std::size_t i = 0; i + 1 < triangles.size(); i += 3)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        places.push_back(points[3 * triangles[i] + axis] + points[3 * triangles[i + 1] + axis]);
      }
    }
    places.insert(places.end(), { 0.0, 0.0, 0.0, NAN, 1.0, 0.0, 0.0, 0.0, -1e300 });
    return places;
  }

  /// @param query its places are in the host's memory.
  static Answers Ask(const FlipSession& session, PlaceQuery query, std::size_t points)
  {
    const std::int64_t count = query.CountPlaces();
    Answers answers{ std::vector<std::int32_t>(count), std::vector<double>(Components * count) };
    const std::vector<double> values = ListValues(points);
    query.Triangles = answers.Triangles.data();
    query.Values = values.data();
    query.Components = Components;
    query.Results = answers.Results.data();
    EXPECT_TRUE(session.Ask(query));
    return answers;
  }

  static Answers AskInPlace(const FlipSession& session, PlaceQuery query,
    const std::vector<double>& places, std::size_t points)
  {
    const std::int64_t count = query.CountPlaces();
    const DeviceValues<double> there(places), values(ListValues(points));
    const DeviceValues<std::int32_t> triangles{ std::vector<std::int32_t>(count) };
    const DeviceValues<double> results{ std::vector<double>(Components * count) };
    query.Places.Doubles = there.Data();
    query.Triangles = triangles.Data();
    query.Values = values.Data();
    query.Components = Components;
    query.Results = results.Data();
    query.OnDevice = true;
    EXPECT_TRUE(session.Ask(query));
    return { triangles.Get(), results.Get() };
  }

  static std::vector<double> ListValues(std::size_t points)
  {
    std::mt19937 random(5);
    std::vector<double> values(Components * points);
    for (double& value : values)
    {
      value = random() * 0x1p-32;
    }
    return values;
  }

  static void ExpectSameAnswers(const PointInput& input, ProjectionKind projection)
  {
    PointOptions options;
    options.Projection = projection;
    options.Backend = BackendKind::Threads;
    FlipSession threads(input, options);
    threads.Advance();
    options.Backend = BackendKind::CUDA;
    FlipSession device(input, options);
    device.Advance();
    const auto count = static_cast<std::size_t>(input.Points.Count);
    const std::vector<double> points(input.Points.Doubles, input.Points.Doubles + 3 * count);
    const std::vector<double> places = ListPlaces(points, StoreOnHost(threads, count).Triangles);
    const std::vector<float> angles(places.begin(), places.end());
    for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
    {
      PlaceQuery query;
      query.Method = method;
      query.Outside = OutsideKind::Nearest;
      query.Places = PlaneArray(places.data(), static_cast<std::int64_t>(places.size() / 3), 3);
      const Answers expected = Ask(threads, query, count);
      EXPECT_TRUE(expected == Ask(device, query, count));
      EXPECT_TRUE(expected == AskInPlace(device, query, places, count));
      query.Outside = OutsideKind::NotANumber;
      query.Degrees = true;
      query.Places = PlaneArray(angles.data(), static_cast<std::int64_t>(angles.size() / 2), 2);
      EXPECT_TRUE(Ask(threads, query, count) == Ask(device, query, count));
      query.Places = {};
      query.Raster.Origin[0] = -180.0;
      query.Raster.Origin[1] = 90.0;
      query.Raster.Step[0] = 1.5;
      query.Raster.Step[1] = -1.25;
      query.Raster.Columns = 241;
      query.Raster.Rows = 145;
      EXPECT_TRUE(Ask(threads, query, count) == Ask(device, query, count));
    }
  }
};

TEST_F(DeviceSphereAnswers, AreThoseOfThreads)
{
  const std::vector<double> points = DrawPoints(2000);
  const PointInput input = View(points.data(), points.size(), false);
  ExpectSameAnswers(input, ProjectionKind::Sphere);
  const std::vector<double> grid = MakeGrid(30, 15);
  ExpectSameAnswers(View(grid.data(), grid.size(), false), ProjectionKind::Sphere);
}

TEST_F(DeviceSphereAnswers, AreThoseOfThreadsWhereTrianglesAreMissing)
{
  std::vector<double> north = DrawPoints(500);
  for (std::size_t i = 2; i < north.size(); i += 3)
  {
    north[i] = std::fabs(north[i]);
  }
  ExpectSameAnswers(View(north.data(), north.size(), false), ProjectionKind::OpenSphere);
  ExpectSameAnswers(View(north.data(), north.size(), false), ProjectionKind::Sphere);
  std::vector<double> points = DrawPoints(500);
  // The corners of a hole, and the ends of a segment.
  const double corners[][2] = { { 0, -30 }, { 50, -30 }, { 70, 30 }, { 10, 30 }, { 180, -40 },
    { 190, 50 } };
  for (const auto& corner : corners)
  {
    double xyz[3];
    PlaceOnSphere(corner[0], corner[1], xyz);
    points.insert(points.end(), xyz, xyz + 3);
  }
  const std::int64_t segments[] = { 500, 501, 501, 502, 502, 503, 503, 500, 504, 505 };
  const std::int32_t rings[] = { 0, 0, 0, 0, -1 };
  PointInput input = View(points.data(), points.size(), false);
  input.Segments = segments;
  input.NumberOfSegments = 5;
  input.Rings = rings;
  input.FirstHole = 0;
  ExpectSameAnswers(input, ProjectionKind::Sphere);
}

}
}
