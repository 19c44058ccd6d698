// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

/// @file
/// Refinement of meshes of the caller: borders, data, defects.

namespace delaunayflip
{
namespace
{

constexpr double DegreesPerRadian = 57.295779513082321;
constexpr double Rounding = 1e-9;

double Cross(const double* a, const double* b, const double* c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A refined mesh with all its points.
struct RefinedMesh
{
  std::vector<double> Points;
  std::vector<std::int32_t> Triangles, Sources;
  std::vector<AddedPoint> Added;
  FlipReport Report;

  const double* GetPoint(std::int64_t id) const { return &this->Points[3 * id]; }
  double GetArea(std::size_t t) const
  {
    const std::int32_t* ids = &this->Triangles[3 * t];
    return 0.5 * Cross(this->GetPoint(ids[0]), this->GetPoint(ids[1]), this->GetPoint(ids[2]));
  }
  double GetSmallestAngle(std::size_t t) const
  {
    double smallest = 180.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const double* a = this->GetPoint(this->Triangles[3 * t + slot]);
      const double* b = this->GetPoint(this->Triangles[3 * t + (slot + 1) % 3]);
      const double* c = this->GetPoint(this->Triangles[3 * t + (slot + 2) % 3]);
      const double dot = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
      smallest = std::min(smallest, std::atan2(std::fabs(Cross(a, b, c)), dot) * DegreesPerRadian);
    }
    return smallest;
  }
  TriangleMesh View() const
  {
    TriangleMesh mesh;
    mesh.Points =
      PointArray(this->Points.data(), static_cast<std::int64_t>(this->Points.size()) / 3);
    mesh.Triangles = ViewTriangles(this->Triangles);
    return mesh;
  }
};

RefinedMesh Take(const FlipSession& session, const TriangleMesh& mesh)
{
  RefinedMesh refined;
  refined.Report = session.GetReport();
  refined.Triangles = StoreTriangles(session);
  refined.Sources.resize(refined.Report.Triangles);
  session.StoreSources(refined.Sources.data());
  refined.Added = session.GetAddedPoints();
  for (std::int64_t i = 0; i < 3 * mesh.Points.Count; ++i)
  {
    refined.Points.push_back(mesh.Points.GetNumber(i));
  }
  for (const AddedPoint& point : refined.Added)
  {
    refined.Points.insert(refined.Points.end(), { point.X, point.Y, point.Z });
  }
  return refined;
}

RefinedMesh Refine(const TriangleMesh& mesh, const FlipOptions& options)
{
  FlipSession session = MakeSession(mesh, options);
  session.Advance();
  return Take(session, mesh);
}

/// The options of a run in x and y with a goal.
FlipOptions WithGoal(double FlipOptions::*goal, double value)
{
  return With(goal, value, InPlane());
}

FlipOptions WithAngle(double angle) { return WithGoal(&FlipOptions::MinimumAngle, angle); }

/// The edges that belong to one triangle only.
std::set<std::pair<std::int64_t, std::int64_t>> FindBoundary(const TriangleArray& triangles)
{
  std::map<std::pair<std::int64_t, std::int64_t>, int> uses;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      ++uses[std::minmax(triangles.Get(t, slot), triangles.Get(t, (slot + 1) % 3))];
    }
  }
  std::set<std::pair<std::int64_t, std::int64_t>> boundary;
  for (const auto& [edge, count] : uses)
  {
    if (count == 1)
    {
      boundary.insert(edge);
    }
  }
  return boundary;
}

/// An L with a square hole and a step of narrow triangles. Heights are 2 x + 3 y.
struct Room
{
  std::vector<double> Points;
  std::vector<std::int32_t> Triangles;
  std::vector<std::int32_t> Regions; ///< 7 where x is below 5, else -3.

  Room()
  {
    const Places corners = { { 0, 0 }, { 10, 0 }, { 10, 4 }, { 5, 4 }, { 5, 9 }, { 0, 9 }, { 2, 1 },
      { 3, 1 }, { 3, 2.5 }, { 2, 2.5 }, { 5, 0 }, { 5.3, 0.2 }, { 9, 3.9 } };
    const std::vector<std::vector<std::int64_t>> rings = { { 0, 10, 1, 2, 3, 4, 5 },
      { 6, 7, 8, 9 } };
    std::vector<double> xy;
    for (const Place& corner : corners)
    {
      xy.insert(xy.end(), { corner[0], corner[1] });
      this->Points.insert(
        this->Points.end(), { corner[0], corner[1], 2.0 * corner[0] + 3.0 * corner[1] });
    }
    std::vector<std::int64_t> segments;
    std::vector<std::int32_t> ringOf;
    for (std::size_t r = 0; r < rings.size(); ++r)
    {
      for (std::size_t i = 0; i < rings[r].size(); ++i)
      {
        segments.insert(segments.end(), { rings[r][i], rings[r][(i + 1) % rings[r].size()] });
        ringOf.push_back(static_cast<std::int32_t>(r));
      }
    }
    segments.insert(segments.end(), { 10, 3 });
    ringOf.push_back(-1);
    PointInput input{ PlaneArray(xy.data(), static_cast<std::int64_t>(corners.size()), 2) };
    input.Segments = segments.data();
    input.NumberOfSegments = static_cast<std::int64_t>(ringOf.size());
    input.Rings = ringOf.data();
    this->Triangles = StoreTriangles(FlipPoints(input));
    for (std::size_t t = 0; t < this->Triangles.size(); t += 3)
    {
      double x = 0.0;
      for (int slot = 0; slot < 3; ++slot)
      {
        x += this->Points[3 * this->Triangles[t + slot]];
      }
      this->Regions.push_back(x < 15.0 ? 7 : -3);
    }
  }

  TriangleMesh View() const
  {
    TriangleMesh mesh;
    mesh.Points =
      PointArray(this->Points.data(), static_cast<std::int64_t>(this->Points.size()) / 3);
    mesh.Triangles = ViewTriangles(this->Triangles);
    mesh.Regions = this->Regions.data();
    return mesh;
  }
};

/// Sums the areas of regions.
std::map<std::int32_t, double> SumAreas(const RefinedMesh& mesh, const std::int32_t* regions)
{
  std::map<std::int32_t, double> areas;
  for (std::size_t t = 0; t < mesh.Triangles.size() / 3; ++t)
  {
    areas[regions[mesh.Sources[t]]] += mesh.GetArea(t);
  }
  return areas;
}

/// The source of each triangle, in the mesh that was flipped but not refined, has its centroid.
/// @param before the triangles of that mesh.
void ExpectCentroidsInSources(const RefinedMesh& refined, const std::vector<std::int32_t>& before)
{
  for (std::size_t t = 0; t < refined.Triangles.size() / 3; ++t)
  {
    if (refined.GetArea(t) <= 0.0)
    {
      continue;
    }
    double center[2] = { 0.0, 0.0 };
    for (int slot = 0; slot < 3; ++slot)
    {
      const double* corner = refined.GetPoint(refined.Triangles[3 * t + slot]);
      center[0] += corner[0] / 3.0;
      center[1] += corner[1] / 3.0;
    }
    const std::int32_t* ids = &before[3 * refined.Sources[t]];
    for (int slot = 0; slot < 3; ++slot)
    {
      ASSERT_LE(
        -1e-12, Cross(refined.GetPoint(ids[slot]), refined.GetPoint(ids[(slot + 1) % 3]), center))
        << t;
    }
  }
}

TEST(MeshRefineTest, ReachesGoalsInDomainsWithHoles)
{
  const Room room;
  const RefinedMesh refined = Refine(room.View(), WithAngle(28.0));
  EXPECT_LT(0, refined.Report.FromPoints.RefinementPoints);
  EXPECT_EQ(0, refined.Report.FromPoints.UnrefinedTriangles);
  for (std::size_t t = 0; t < refined.Triangles.size() / 3; ++t)
  {
    ASSERT_LE(28.0 - Rounding, refined.GetSmallestAngle(t)) << t;
    ASSERT_LT(0.0, refined.GetArea(t)) << t;
  }
  const std::map<std::int32_t, double> areas = SumAreas(refined, room.Regions.data());
  EXPECT_NEAR(45.0 - 1.5, areas.at(7), Rounding);
  EXPECT_NEAR(20.0, areas.at(-3), Rounding);
  // The hole and the notch stay: the boundary has more points, but the same length.
  double length = 0.0;
  const auto boundary = FindBoundary(ViewTriangles(refined.Triangles));
  for (const auto& [a, b] : boundary)
  {
    const double *from = refined.GetPoint(a), *to = refined.GetPoint(b);
    length += std::hypot(to[0] - from[0], to[1] - from[1]);
  }
  EXPECT_NEAR(10 + 4 + 5 + 5 + 5 + 9 + 5, length, Rounding);
  EXPECT_EQ(static_cast<std::int64_t>(boundary.size()), refined.Report.Edges.Boundary);
  EXPECT_EQ(0, refined.Report.EulerCharacteristic);
  EXPECT_EQ(0, Flip(refined.View(), InPlane()).Report.NonDelaunayBefore);
}

TEST(MeshRefineTest, InterpolatesInTheMeshBefore)
{
  const Room room;
  const TriangleMesh mesh = room.View();
  FlipOptions options = WithAngle(30.0);
  options.MaximumArea = 0.1;
  const RefinedMesh refined = Refine(mesh, options);
  for (const AddedPoint& point : refined.Added)
  {
    ASSERT_NEAR(2.0 * point.X + 3.0 * point.Y, point.Z, 1e-12);
    ASSERT_EQ(point.Third < 0, point.ThirdShare == 0.0 && point.Third < 0);
  }
  ExpectCentroidsInSources(refined, Flip(mesh, InPlane()).Triangles);
  for (std::size_t t = 0; t < refined.Triangles.size() / 3; ++t)
  {
    ASSERT_GE(0.1, refined.GetArea(t));
  }
}

TEST(MeshRefineTest, KeepsSegmentsRegionsAndWinding)
{
  Room room;
  ReverseTriangles(room.Triangles);
  const std::vector<std::int64_t> constraints = { 11, 12 };
  const unsigned char insert = 1;
  const TriangleMesh mesh = WithConstraints(room.View(), constraints, &insert);
  const RefinedMesh refined = Refine(mesh, WithAngle(25.0));
  double onConstraint = 0.0;
  const std::set<std::int64_t> ends = { 11, 12 };
  std::vector<std::int64_t> chain = { 11 };
  for (std::size_t i = 0; i < refined.Added.size(); ++i)
  {
    const AddedPoint& point = refined.Added[i];
    if (point.Third < 0 && ends.count(point.From) > 0 && ends.count(point.To) > 0)
    {
      chain.push_back(mesh.Points.Count + static_cast<std::int64_t>(i));
    }
  }
  chain.push_back(12);
  std::sort(chain.begin(), chain.end(),
    [&](std::int64_t a, std::int64_t b)
    { return refined.GetPoint(a)[0] < refined.GetPoint(b)[0]; });
  for (std::size_t i = 1; i < chain.size(); ++i)
  {
    EXPECT_TRUE(HasEdge(refined.Triangles, chain[i - 1], chain[i])) << i;
    onConstraint += 1.0;
  }
  EXPECT_EQ(onConstraint, refined.Report.Edges.Constraint);
  for (std::size_t t = 0; t < refined.Triangles.size() / 3; ++t)
  {
    ASSERT_GT(0.0, refined.GetArea(t)) << t; // as before
  }
  const std::map<std::int32_t, double> areas = SumAreas(refined, room.Regions.data());
  EXPECT_NEAR(-43.5, areas.at(7), Rounding);
}

/// Region seeds name parts that constraints enclose. They give labels, and limits of areas.
TEST(MeshRefineTest, LabelsRegionsOfSeeds)
{
  Room room;
  const std::vector<std::int64_t> wall = { 10, 3 };
  const RegionSeed seeds[] = { { 1.0, 8.0, 4, 0.05 }, { 8.0, 2.0, -6, 0.0 }, { 0.5, 0.5, 9, 1e-3 },
    { 7.0, 8.0, 5, 0.0 } };
  for (const bool isReversed : { false, true })
  {
    if (isReversed)
    {
      ReverseTriangles(room.Triangles);
    }
    TriangleMesh mesh = WithConstraints(room.View(), wall);
    mesh.Regions = nullptr;
    mesh.RegionSeeds = seeds;
    mesh.NumberOfRegionSeeds = 4;
    FlipSession session = MakeSession(mesh, InPlane());
    session.Advance();
    const RefinedMesh refined = Take(session, mesh);
    std::vector<std::int32_t> labels(refined.Sources.size());
    session.StoreRegions(labels.data());
    std::map<std::int32_t, double> areas, largest;
    for (std::size_t t = 0; t < labels.size(); ++t)
    {
      const double area = std::fabs(refined.GetArea(t));
      areas[labels[t]] += area;
      largest[labels[t]] = std::max(largest[labels[t]], area);
    }
    EXPECT_NEAR(43.5, areas[4], Rounding);
    EXPECT_NEAR(20.0, areas[-6], Rounding);
    EXPECT_GE(0.05, largest[4]);
    EXPECT_LT(0.5, largest[-6]);
    EXPECT_EQ(2U, areas.size());
    EXPECT_NE(std::string::npos,
      DescribeDefects(refined.Report.Defects)
        .find("region seed outside of all triangles (first: 3)"));
  }
}

/// The caller's labels and those of seeds are independent of each other.
TEST(MeshRefineTest, LabelsRegionsWithinRegions)
{
  const Room room;
  const std::vector<std::int64_t> wall = { 11, 12 };
  const unsigned char insert = 1;
  const RegionSeed seeds[] = { { 9.0, 0.5, 1, 0.0 }, { 5.5, 3.5, 2, 0.0 } };
  TriangleMesh mesh = WithConstraints(room.View(), wall, &insert);
  mesh.RegionSeeds = seeds;
  mesh.NumberOfRegionSeeds = 2;
  for (const double angle : { 0.0, 25.0 })
  {
    FlipSession session = MakeSession(mesh, WithAngle(angle));
    session.Advance();
    const RefinedMesh refined = Take(session, mesh);
    EXPECT_EQ(angle > 0.0, !refined.Added.empty());
    std::vector<std::int32_t> labels(refined.Sources.size());
    session.StoreRegions(labels.data());
    // The wall does not reach the boundary, so that both seeds are in one region.
    std::map<std::pair<std::int64_t, std::int64_t>, std::set<std::int32_t>> regionsOfEdge;
    for (std::size_t t = 0; t < labels.size(); ++t)
    {
      const std::int32_t region = room.Regions[refined.Sources[t]];
      ASSERT_EQ(region == -3 ? 1 : 0, labels[t]) << t;
      for (int slot = 0; slot < 3; ++slot)
      {
        const std::int64_t a = refined.Triangles[3 * t + slot];
        const std::int64_t b = refined.Triangles[3 * t + (slot + 1) % 3];
        regionsOfEdge[std::minmax(a, b)].insert(region);
      }
    }
    EXPECT_EQ(refined.Report.Edges.Region,
      std::count_if(regionsOfEdge.begin(), regionsOfEdge.end(),
        [](const auto& edge) { return edge.second.size() > 1; }));
  }
}

TEST(MeshRefineTest, SameForAllThreads)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(4000 / Reduction, 5);
  std::vector<std::int32_t> some; // these leave holes and bays
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
  {
    const double x = mesh.Points[3 * mesh.Triangles[t]], y = mesh.Points[3 * mesh.Triangles[t] + 1];
    if (std::sin(11.0 * x) * std::cos(13.0 * y) < 0.5)
    {
      some.insert(some.end(), mesh.Triangles.begin() + t, mesh.Triangles.begin() + t + 3);
    }
  }
  mesh.Triangles = some;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    sizes.push_back(i % 2 == 0 ? 0.05 + 0.1 * mesh.Points[i] : NAN);
  }
  TriangleMesh view = mesh.View();
  view.Sizes = sizes.data();
  const RefinedMesh expected = Refine(view, WithThreads(1, WithAngle(20.0)));
  EXPECT_LT(100 / Reduction, expected.Report.FromPoints.RefinementPoints);
  for (const int threads : { 2, 3, 16 })
  {
    const RefinedMesh other = Refine(view, WithThreads(threads, WithAngle(20.0)));
    EXPECT_EQ(expected.Triangles, other.Triangles);
    EXPECT_EQ(expected.Sources, other.Sources);
    EXPECT_EQ(expected.Points, other.Points);
  }
}

/// A fan that goes around twice: each place has two triangles, and each new point belongs to one.
TEST(MeshRefineTest, StaysInItsSheet)
{
  OwnedMesh<double> fan;
  const int count = 40;
  fan.Points = { 0, 0, 0 };
  for (int i = 0; i <= count; ++i)
  {
    const double angle = 4.0 * M_PI * i / count;
    fan.Points.insert(fan.Points.end(), { std::cos(angle), std::sin(angle), 0.01 * i });
    if (i > 0)
    {
      fan.Triangles.insert(fan.Triangles.end(), { 0, i, i + 1 });
    }
  }
  FlipOptions options = InPlane();
  options.MaximumArea = 0.01;
  const RefinedMesh refined = Refine(fan.View(), options);
  EXPECT_LT(0, refined.Report.FromPoints.RefinementPoints);
  double area = 0.0;
  std::vector<double> areas(count);
  for (std::size_t t = 0; t < refined.Triangles.size() / 3; ++t)
  {
    areas[refined.Sources[t]] += refined.GetArea(t);
    area += refined.GetArea(t);
  }
  EXPECT_NEAR(0.5 * count * std::sin(4.0 * M_PI / count), area, Rounding);
  EXPECT_LT(0.0, *std::min_element(areas.begin(), areas.end()));
  EXPECT_EQ(1, refined.Report.EulerCharacteristic);
}

/// Triangles that turn around a point by more than a circle, and one turned over that leads back.
TEST(MeshRefineTest, StaysInItsTurn)
{
  OwnedMesh<double> star;
  star.Points = { 0, 0, 0 };
  const double degrees[] = { 0, 80, 160, 240, 320, 400, 440 };
  for (int i = 0; i < 7; ++i)
  {
    const double radius = i < 5 ? 1.0 : 1.5, angle = degrees[i] / DegreesPerRadian;
    star.Points.insert(
      star.Points.end(), { radius * std::cos(angle), radius * std::sin(angle), 10.0 * i });
    star.Triangles.insert(star.Triangles.end(), { 0, i + 1, (i + 1) % 7 + 1 });
  }
  FlipOptions options = InPlane();
  options.MaximumArea = 0.05;
  const RefinedMesh refined = Refine(star.View(), options);
  EXPECT_LT(30, refined.Report.FromPoints.RefinementPoints);
  ExpectCentroidsInSources(refined, Flip(star.View(), InPlane()).Triangles);
  for (const AddedPoint& point : refined.Added)
  {
    const double radius = std::hypot(point.X, point.Y);
    EXPECT_TRUE(radius < 0.9 || point.Third >= 0 || point.Z != 0.0);
  }
}

/// Planes other than z = 0: an upright one, and a tilted one.
TEST(MeshRefineTest, RefinesInAnyPlane)
{
  const OwnedMesh<double> flat = MakeRandomBadMeshDouble(60, 3);
  const AffineMap maps[] = { { { { 0, 0, 0, 4 }, { 1, 0, 0, 0 }, { 0, 1, 0, 0 } } },
    { { { 0.6, -0.64, 0, 0 }, { 0.8, 0.48, 0, 0 }, { 0, 0.6, 0, 1 } } } };
  const FlipOptions options = With(&FlipOptions::MinimumAngle, 26.0);
  const RefinedMesh expected = Refine(flat.View(), options);
  for (const AffineMap& map : maps)
  {
    const OwnedMesh<double> turned = Transform(flat, map);
    const RefinedMesh refined = Refine(turned.View(), options);
    ASSERT_EQ(GeometryKind::Planar, refined.Report.GeometryUsed);
    EXPECT_LT(0, refined.Report.FromPoints.RefinementPoints);
    const double least = refined.Report.MinimumAngleAfter;
    if (refined.Report.FromPoints.UnrefinedTriangles == 0)
    {
      EXPECT_LE(26.0 - 1e-6, least);
    }
    const double share = double(refined.Triangles.size()) / double(expected.Triangles.size());
    EXPECT_NEAR(1.0, share, 0.2);
    const FlipOptions planar = With(&FlipOptions::Geometry, GeometryKind::Planar);
    EXPECT_NO_THROW(MakeSession(refined.View(), planar)); // it is still planar
  }
}

TEST(MeshRefineTest, LeavesDefectsAlone)
{
  Room room;
  const std::int32_t first[] = { room.Triangles[0], room.Triangles[1], room.Triangles[2] };
  const auto points = static_cast<std::int32_t>(room.Points.size() / 3);
  room.Points.insert(room.Points.end(), { 4.0, 6.0, 1.0, NAN, 0.0, 0.0 });
  // These are a third triangle at an edge, one turned over, a copy, and two without area.
  const std::vector<std::vector<std::int32_t>> more = { { first[0], first[1], points },
    { first[0], first[2], first[1] }, { first[0], first[1], first[2] },
    { first[0], first[0], first[1] }, { first[0], first[1], points + 1 } };
  for (const std::vector<std::int32_t>& triangle : more)
  {
    room.Triangles.insert(room.Triangles.end(), triangle.begin(), triangle.end());
    room.Regions.push_back(99);
  }
  FlipOptions options = InPlane();
  options.MinimumAngle = 25.0;
  options.MaximumArea = 0.2;
  const RefinedMesh refined = Refine(room.View(), options);
  EXPECT_LT(20, refined.Report.FromPoints.RefinementPoints);
  EXPECT_TRUE(refined.Report.Converged());
  const std::map<std::int32_t, double> areas = SumAreas(refined, room.Regions.data());
  EXPECT_NEAR(20.0, areas.at(-3), 1e-6);
  // The non-manifold edges are still there.
  EXPECT_TRUE(HasEdge(refined.Triangles, first[0], first[1]));
}

/// Random triangles: refinement ends with a valid mesh, the same for any number of threads.
TEST(MeshRefineTest, EndsForAnySoup)
{
  for (std::uint32_t seed = 0; seed < 60 / Reduction; ++seed)
  {
    const OwnedMesh<double> soup = MakeSoup(30, 60, seed);
    FlipOptions options = InPlane();
    options.MinimumAngle = 20.0;
    options.PointLimit = 2000;
    const RefinedMesh refined = Refine(soup.View(), WithThreads(1, options));
    const RefinedMesh other = Refine(soup.View(), WithThreads(3, options));
    EXPECT_EQ(refined.Triangles, other.Triangles) << seed;
    EXPECT_EQ(refined.Sources, other.Sources) << seed;
  }
}

TEST(MeshRefineTest, KeepsBoundaryAndLimits)
{
  const Room room;
  FlipOptions options = WithAngle(28.0);
  options.KeepBoundary = true;
  const TriangleMesh mesh = room.View();
  const RefinedMesh kept = Refine(mesh, options);
  EXPECT_EQ(FindBoundary(mesh.Triangles), FindBoundary(ViewTriangles(kept.Triangles)));
  EXPECT_LT(0, kept.Report.FromPoints.RefinementPoints);
  options = WithGoal(&FlipOptions::MaximumArea, 1e-4);
  options.PointLimit = 100;
  const RefinedMesh limited = Refine(mesh, options);
  EXPECT_EQ(100, limited.Report.Points + limited.Report.FromPoints.RefinementPoints);
  EXPECT_EQ(1, limited.Report.FromPoints.ReachedPointLimit);
  EXPECT_NE(std::string::npos,
    DescribeDefects(limited.Report.Defects)
      .find("PointLimit allows no more than 100; set it higher"));
}

/// Triangles that must stay as they are count, too, if they do not reach the goals.
TEST(MeshRefineTest, CountsFrozenTriangles)
{
  const Room room;
  const std::vector<unsigned char> frozen(room.Triangles.size() / 3, 1);
  TriangleMesh mesh = room.View();
  mesh.FrozenTriangles = frozen.data();
  const RefinedMesh refined = Refine(mesh, WithAngle(28.0));
  EXPECT_TRUE(refined.Added.empty());
  std::int64_t narrow = 0;
  for (std::size_t t = 0; t < frozen.size(); ++t)
  {
    narrow += refined.GetSmallestAngle(t) < 28.0 ? 1 : 0;
  }
  EXPECT_LT(5, narrow);
  EXPECT_EQ(narrow, refined.Report.FromPoints.UnrefinedTriangles);
}

/// Sizes and the limits of regions hold for them, too.
TEST(MeshRefineTest, CountsFrozenTrianglesThatAreTooLarge)
{
  OwnedMesh<double> square;
  square.Points = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
  square.Triangles = { 0, 1, 2, 0, 2, 3 };
  const unsigned char frozen[] = { 1, 1 };
  const std::vector<double> sizes(4, 0.1);
  const RegionSeed seeds[] = { { 0.6, 0.3, 1, 0.01 }, { 0.3, 0.6, 2, 0.6 } };
  const std::vector<std::int64_t> wall = { 0, 2 };
  TriangleMesh mesh = WithConstraints(square.View(), wall);
  mesh.FrozenTriangles = frozen;
  mesh.Sizes = sizes.data();
  EXPECT_EQ(2, Refine(mesh, InPlane()).Report.FromPoints.UnrefinedTriangles);
  mesh.Sizes = nullptr;
  mesh.RegionSeeds = seeds;
  mesh.NumberOfRegionSeeds = 2;
  EXPECT_EQ(1, Refine(mesh, InPlane()).Report.FromPoints.UnrefinedTriangles);
}

/// Points of no triangle do not matter, wherever they are.
TEST(MeshRefineTest, IgnoresUnusedPoints)
{
  const Room room;
  const RefinedMesh expected = Refine(room.View(), WithAngle(25.0));
  for (const double far : { 1e30, -double(INFINITY), double(NAN) })
  {
    Room other;
    other.Points.insert(other.Points.end(), { far, 0.0, 0.0 });
    const RefinedMesh refined = Refine(other.View(), WithAngle(25.0));
    EXPECT_EQ(expected.Triangles.size(), refined.Triangles.size()) << far;
    EXPECT_EQ(0, refined.Report.FromPoints.UnrefinedTriangles) << far;
  }
}

/// Rounds count as iterations of the options, too.
TEST(MeshRefineTest, KeepsTheIterationLimit)
{
  const Room room;
  FlipOptions options = WithAngle(28.0);
  const auto flips =
    static_cast<std::int64_t>(Refine(room.View(), options).Report.Iterations.size());
  for (const std::int64_t rounds : { -flips, std::int64_t(0), std::int64_t(2) })
  {
    options.MaximumIterations = flips + rounds;
    const RefinedMesh refined = Refine(room.View(), options);
    EXPECT_EQ(StopReasonKind::IterationLimit, refined.Report.StopReason);
    EXPECT_EQ(std::max<std::int64_t>(rounds, 0), refined.Report.FromPoints.RefinementRounds);
    EXPECT_EQ(rounds > 0, refined.Report.FromPoints.UnrefinedTriangles > 0);
    const std::string words = DescribeDefects(refined.Report.Defects);
    EXPECT_EQ(rounds <= 0,
      words.find(
        "triangles that refinement has not looked at: MaximumIterations allows no round") !=
        std::string::npos)
      << words;
  }
}

/// A mesh with a triangle that is turned over.
OwnedMesh<double> MakeFolded(const std::vector<double>& xy, std::vector<std::int32_t> triangles)
{
  OwnedMesh<double> mesh;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    mesh.Points.insert(mesh.Points.end(), { xy[i], xy[i + 1], 0.0 });
  }
  mesh.Triangles = std::move(triangles);
  return mesh;
}

/// Edges that flip after refinement, because they were fixed for refinement alone.
TEST(MeshRefineTest, CountsAfterTheLastFlips)
{
  const OwnedMesh<double> mesh =
    MakeFolded({ 17, 5, 4, 3, 1, 3, 16, 11, 13, 12 }, { 3, 0, 4, 1, 0, 3, 3, 2, 1, 4, 2, 3 });
  FlipOptions options = WithAngle(20.0);
  options.PointLimit = 2000;
  const RefinedMesh refined = Refine(mesh.View(), options);
  std::int64_t narrow = 0;
  for (std::size_t t = 0; t < refined.Triangles.size() / 3; ++t)
  {
    narrow += refined.GetArea(t) > 0.0 && refined.GetSmallestAngle(t) < 20.0 ? 1 : 0;
  }
  EXPECT_EQ(narrow, refined.Report.FromPoints.UnrefinedTriangles);
  ExpectCentroidsInSources(refined, Flip(mesh.View(), InPlane()).Triangles);
}

/// Edges that are fixed for refinement alone count as bad before it ends, and after a limit or an
/// observer has ended it.
TEST(MeshRefineTest, CountsEdgesThatAreFixedMeanwhile)
{
  const auto expectSame = [](const RefinedMesh& refined)
  {
    const FlipReport again =
      Flip(refined.View(), With(&FlipOptions::MaximumIterations, 0, InPlane())).Report;
    EXPECT_EQ(again.NonDelaunayAfter, refined.Report.NonDelaunayAfter);
    EXPECT_EQ(again.BlockedByShape, refined.Report.BlockedByShape);
    EXPECT_EQ(again.BlockedByEdge, refined.Report.BlockedByEdge);
  };
  std::vector<OwnedMesh<double>> meshes;
  meshes.push_back(
    MakeFolded({ 13, 6, 14, 7, 11, 1, 17, 10, 13, 6 }, { 3, 0, 1, 2, 1, 0, 3, 2, 0 }));
  for (std::uint32_t seed = 0; seed < 20; ++seed)
  {
    meshes.push_back(MakeSoup(12, 14, seed));
  }
  for (const OwnedMesh<double>& mesh : meshes)
  {
    FlipOptions options = WithAngle(20.0);
    options.PointLimit = 300;
    const RefinedMesh expected = Refine(mesh.View(), options);
    expectSame(expected);
    FlipSession session = MakeSession(mesh.View(), options);
    while (session.Advance(1))
    {
      expectSame(Take(session, mesh.View()));
    }
    EXPECT_EQ(expected.Triangles, StoreTriangles(session));
    FlipSession stopped = MakeSession(mesh.View(), options);
    do
    {
      stopped.Advance(-1, {}, [](double share) { return share == 1.0; });
      expectSame(Take(stopped, mesh.View()));
    } while (stopped.GetReport().StopReason == StopReasonKind::Aborted);
    EXPECT_EQ(expected.Triangles, StoreTriangles(stopped));
    const auto flips = static_cast<std::int64_t>(expected.Report.Iterations.size());
    for (int rounds = 1; rounds < 4; ++rounds)
    {
      options.MaximumIterations = flips + rounds;
      expectSame(Refine(mesh.View(), options));
    }
  }
}

/// Rounds count as iterations of Advance, and an observer may stop the run in each.
TEST(MeshRefineTest, AdvancesRoundByRound)
{
  const Room room;
  const TriangleMesh mesh = room.View();
  const FlipOptions options = WithGoal(&FlipOptions::MaximumEdge, 0.4);
  const RefinedMesh expected = Refine(mesh, options);
  FlipSession session = MakeSession(mesh, options);
  std::vector<std::int64_t> triangles;
  while (session.Advance(1))
  {
    triangles.push_back(session.GetReport().Triangles);
    EXPECT_EQ(0, session.GetReport().NonDelaunayAfter);
  }
  EXPECT_LE(expected.Report.FromPoints.RefinementRounds, std::int64_t(triangles.size()));
  EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
  EXPECT_LT(triangles.front(), triangles.back());
  EXPECT_EQ(expected.Triangles, StoreTriangles(session));
  FlipSession stopped = MakeSession(mesh, options);
  EXPECT_FALSE(stopped.Advance(-1, {}, [](double) { return false; }));
  EXPECT_EQ(StopReasonKind::Aborted, stopped.GetReport().StopReason);
  stopped.Advance();
  EXPECT_EQ(expected.Triangles, StoreTriangles(stopped));
}

TEST(MeshRefineTest, SaysWhatCannotBeRefined)
{
  const Room room;
  const TriangleMesh mesh = room.View();
  const FlipOptions angle = WithAngle(20.0);
  const auto explain = [&](const FlipOptions& options, const double* sizes = nullptr)
  {
    TriangleMesh own = mesh;
    own.Sizes = sizes;
    return GetMessage<InvalidOptions>([&] { MakeSession(own, options).Advance(); });
  };
  const auto has = [](const std::string& text, const char* word)
  { return text.find(word) != std::string::npos; };
  EXPECT_TRUE(has(explain(With(&FlipOptions::Geometry, GeometryKind::Surface, angle)), "surface"));
  EXPECT_TRUE(
    has(explain(With(&FlipOptions::Criterion, CriterionKind::OppositeAngles, angle)), "in-circle"));
  EXPECT_TRUE(has(explain(With(&FlipOptions::NumberOfPieces, 2, angle)), "pieces"));
  for (const double wrong : { 34.0, -1.0, double(NAN) })
  {
    EXPECT_TRUE(has(explain(WithAngle(wrong)), "from 0 to 33"));
  }
  EXPECT_TRUE(has(explain(WithGoal(&FlipOptions::MaximumArea, -1.0)), "MaximumArea"));
  EXPECT_TRUE(has(explain(WithGoal(&FlipOptions::MaximumArea, NAN)), "MaximumArea"));
  for (const double goal : { 1e-61, 1e61, 1e300 })
  {
    EXPECT_TRUE(has(explain(WithGoal(&FlipOptions::MaximumArea, goal)), "1e-60 to 1e60"));
    EXPECT_TRUE(has(explain(WithGoal(&FlipOptions::MaximumEdge, goal)), "MaximumEdge must be"));
    const std::vector<double> sizes(room.Points.size() / 3, goal);
    EXPECT_TRUE(has(explain({}, sizes.data()), "point 0 must be from"));
  }
  const RegionSeed seed{ NAN, 0.0, 1, 0.0 };
  TriangleMesh seeded = mesh;
  seeded.RegionSeeds = &seed;
  seeded.NumberOfRegionSeeds = 1;
  const auto explainSeed = [&](const FlipOptions& options)
  { return GetMessage<InvalidOptions>([&] { MakeSession(seeded, options).Advance(); }); };
  EXPECT_TRUE(has(explainSeed(InPlane()), "region 0 has a coordinate"));
  for (const double area : { -1.0, double(NAN), double(INFINITY) })
  {
    const RegionSeed wrong{ 1.0, 0.0, 1, area };
    seeded.RegionSeeds = &wrong;
    EXPECT_TRUE(has(explainSeed(InPlane()), "area of region 0 must be"));
  }
  const RegionSeed sound{ 1.0, 0.0, 1, 0.0 };
  seeded.RegionSeeds = &sound;
  EXPECT_TRUE(has(
    explainSeed(With(&FlipOptions::Geometry, GeometryKind::Surface)), "region seeds are places"));
  const std::vector<double> sizes(room.Points.size() / 3, 0.0);
  EXPECT_TRUE(has(explain({}, sizes.data()), "point 0"));
  std::vector<std::int32_t> ids = room.Triangles;
  EXPECT_TRUE(
    has(GetMessage<InvalidOptions>([&]
          { FlipToDelaunay(mesh, angle, MutableTriangleArray(ids.data(), mesh.Triangles.Count)); }),
      "session"));
}

}
}
