// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace delaunayflip
{
namespace
{

/// Finds edges that should have been flipped, by inverse trigonometry and a map of edges.
class SurfaceReferee
{
public:
  /// @param deviation FlipOptions::MaximumDeviation.
  SurfaceReferee(const OwnedMesh<double>& mesh, const std::vector<std::int32_t>& triangles,
    long double deviation = INFINITY)
    : Mesh(mesh),
      Deviation(deviation)
  {
    for (std::size_t corner = 0; corner < triangles.size(); ++corner)
    {
      const std::size_t first = corner - corner % 3;
      const std::int32_t from = triangles[corner];
      const std::int32_t to = triangles[first + (corner + 1) % 3];
      this->Opposites[{ from, to }].push_back(triangles[first + (corner + 2) % 3]);
    }
  }

  /// Counts edges that should have flipped. Such an edge has exactly two triangles, consistently
  /// wound, and their opposite angles sum to more than pi by a margin. Its flip would neither fold
  /// the surface over, nor move it too far, nor repeat an edge.
  std::int64_t CountMissedFlips() const
  {
    std::int64_t missed = 0;
    for (const auto& [edge, opposites] : this->Opposites)
    {
      const auto twin = this->Opposites.find({ edge.second, edge.first });
      if (edge.first < edge.second && opposites.size() == 1 && twin != this->Opposites.end() &&
        twin->second.size() == 1)
      {
        missed += this->ShouldFlip({ opposites[0], edge.first, edge.second, twin->second[0] });
      }
    }
    return missed;
  }

  /// The distance between the segments p-q and a-b, which must be nearest to each other inside:
  /// from the places s and t on them where the way between is normal to both.
  long double FindDistance(const std::array<std::int32_t, 4>& quad) const
  {
    const LongVector a = this->Get(quad[0]), p = this->Get(quad[1]);
    const LongVector u = Subtract(this->Get(quad[3]), a), v = Subtract(this->Get(quad[2]), p);
    const LongVector w = Subtract(p, a);
    const long double uu = Dot(u, u), uv = Dot(u, v), vv = Dot(v, v);
    const long double wu = Dot(w, u), wv = Dot(w, v);
    const long double determinant = uu * vv - uv * uv;
    const long double s = (wu * vv - wv * uv) / determinant;
    const long double t = (wu * uv - wv * uu) / determinant;
    EXPECT_TRUE(s > 0 && s < 1 && t > 0 && t < 1) << double(s) << ' ' << double(t);
    LongVector way = w;
    for (int axis = 0; axis < 3; ++axis)
    {
      way[axis] += t * v[axis] - s * u[axis];
    }
    return std::sqrt(Dot(way, way));
  }

private:
  LongVector Get(std::int32_t id) const
  {
    return { this->Mesh.Points[3 * id], this->Mesh.Points[3 * id + 1],
      this->Mesh.Points[3 * id + 2] };
  }

  /// a, p, q, b: triangles (a, p, q) and (b, q, p).
  bool ShouldFlip(const std::array<std::int32_t, 4>& quad) const
  {
    constexpr long double Margin = 1e-8L;
    const LongVector a = this->Get(quad[0]);
    const LongVector p = this->Get(quad[1]);
    const LongVector q = this->Get(quad[2]);
    const LongVector b = this->Get(quad[3]);
    const bool exists = this->Opposites.count({ quad[0], quad[3] }) != 0 ||
      this->Opposites.count({ quad[3], quad[0] }) != 0;
    if (exists || FindAngle(a, p, q) + FindAngle(b, p, q) <= std::acos(-1.0L) + Margin)
    {
      return false;
    }
    const LongVector upper = FindNormal(a, p, q);
    const LongVector lower = FindNormal(b, q, p);
    const LongVector area = { upper[0] + lower[0], upper[1] + lower[1], upper[2] + lower[2] };
    const long double small = Margin * Dot(area, area);
    return Dot(FindNormal(a, p, b), area) > small && Dot(FindNormal(b, q, a), area) > small &&
      this->FindDistance(quad) <= this->Deviation - Margin;
  }

  const OwnedMesh<double>& Mesh;
  long double Deviation;
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> Opposites;
};

/// Everything that must hold after flips on any surface.
FlipResult FlipSurface(const OwnedMesh<double>& mesh, double deviation = INFINITY)
{
  FlipResult result =
    FlipAndAudit(mesh.View(), With(&FlipOptions::MaximumDeviation, deviation, OnSurface()));
  EXPECT_EQ(0, SurfaceReferee(mesh, result.Triangles, deviation).CountMissedFlips());
  return result;
}

TEST(Surface, ClosedSpheresStayClosed)
{
  for (std::int32_t columns : { 20, 60, 200 / static_cast<int>(Reduction) })
  {
    const OwnedMesh<double> mesh = MakeBadSphere(columns, columns / 2, 61);
    const FlipResult result = FlipSurface(mesh);
    EXPECT_LT(columns, result.Report.TotalFlips);
    EXPECT_LT(0, SurfaceReferee(mesh, mesh.Triangles).CountMissedFlips());
    EXPECT_EQ(0, CountEdges(ViewTriangles(result.Triangles)).Boundary);
    EXPECT_EQ(2, result.Report.EulerCharacteristic);
  }
}

/// With few columns, nearly every flip would repeat an edge that exists or that another flip makes.
TEST(Surface, NarrowSpheresGainNoEdgeTwice)
{
  std::int64_t blocked = 0;
  for (std::uint32_t seed = 0; seed < 100 / Reduction; ++seed)
  {
    const OwnedMesh<double> mesh = Transform(MakeBadSphere(3 + seed % 3, 4 + seed % 40, seed),
      { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1.0 + seed % 7, 0 } } });
    blocked += FlipSurface(mesh).Report.NonDelaunayAfter;
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_LT(0, blocked);
}

/// A sheet folded almost flat onto itself: the angles sum to more than pi, but the new triangles
/// would face each other.
TEST(Surface, FlipsThatFoldItOverAreBlocked)
{
  const OwnedMesh<double> folded = { { -4, 0, 0, 4, 0, 0, -3, 2, 0, 3, 3, 1 },
    { 2, 0, 1, 3, 1, 0 } };
  const FlipResult result = FlipSurface(folded);
  EXPECT_EQ(folded.Triangles, result.Triangles);
  EXPECT_EQ(1, result.Report.NonDelaunayBefore);
  EXPECT_EQ(1, result.Report.NonDelaunayAfter);
  EXPECT_EQ(1, result.Report.BlockedByShape);
  EXPECT_EQ(0, result.Report.BlockedByEdge);
  // Unfolded, the same two triangles may flip.
  const OwnedMesh<double> opened = { { -4, 0, 0, 4, 0, 0, -3, 2, 0, 3, -3, 1 },
    { 2, 0, 1, 3, 1, 0 } };
  EXPECT_EQ(1, FlipSurface(opened).Report.TotalFlips);
}

/// A quad with diagonals that are a quarter of `size` apart, first as wide angles.
OwnedMesh<double> MakeBentQuad(double size)
{
  return { { 0, size, size / 4, -4 * size, 0, 0, 4 * size, 0, 0, 0, -size, size / 4 },
    { 0, 1, 2, 3, 2, 1 } };
}

TEST(Surface, FlipsThatMoveItTooFarAreBlocked)
{
  for (const double size : { 1.0, 0x1p-300, 0x1p-900, 0x1p600 })
  {
    OwnedMesh<double> mesh = MakeBentQuad(size);
    for (int turn = 0; turn < 2; ++turn)
    {
      EXPECT_EQ(1, FlipSurface(mesh, size / 4).Report.TotalFlips) << size;
      const FlipReport report = FlipSurface(mesh, std::nextafter(size / 4, 0.0)).Report;
      EXPECT_EQ(0, report.TotalFlips) << size;
      EXPECT_EQ(0U, report.Iterations.size());
      EXPECT_EQ(1, report.NonDelaunayAfter);
      EXPECT_EQ(1, report.BlockedByDeviation);
      EXPECT_EQ(0, report.BlockedByShape + report.BlockedByEdge);
      EXPECT_EQ(0, FlipSurface(mesh, 0.0).Report.TotalFlips);
      mesh.Triangles = { 3, 2, 1, 0, 1, 2 };
    }
  }
  EXPECT_EQ(1, FlipSurface(MakeBentQuad(1.0), 1e299).Report.TotalFlips); // VTK's largest number
}

TEST(Surface, FlatQuadsFlipWithoutAnyDeviation)
{
  const OwnedMesh<double> flat =
    Lift(MakeRandomBadMeshDouble(2000 / Reduction, 64), [](double, double) { return 2.0; });
  const FlipReport report = FlipSurface(flat, 0.0).Report;
  EXPECT_LT(0, report.TotalFlips);
  EXPECT_EQ(0, report.NonDelaunayAfter);
}

/// In the plane nothing moves, even where points are a little off it.
TEST(Surface, DeviationHasNoEffectInPlanes)
{
  const OwnedMesh<double> tilted = Lift(MakeRandomBadMeshDouble(2000 / Reduction, 65),
    [](double x, double y) { return 0.3 * x + 0.7 * y; });
  for (const GeometryKind geometry : { GeometryKind::Planar, GeometryKind::PlanarXY })
  {
    for (const CriterionKind criterion : { CriterionKind::InCircle, CriterionKind::OppositeAngles })
    {
      FlipOptions options;
      options.Geometry = geometry;
      options.Criterion = criterion;
      const FlipResult free = Flip(tilted.View(), options);
      options.MaximumDeviation = 0.0;
      const FlipResult bound = Flip(tilted.View(), options);
      EXPECT_EQ(free.Triangles, bound.Triangles);
      EXPECT_EQ(0, bound.Report.BlockedByDeviation);
    }
  }
}

/// The quads {a, p, q, b} that flips of one iteration have changed from triangles apq and bqp.
std::vector<std::array<std::int32_t, 4>> FindFlips(
  const std::vector<std::int32_t>& before, const std::vector<std::int32_t>& after)
{
  using Ids = std::set<std::int32_t>;
  const auto intersect = [](const Ids& one, const Ids& other)
  {
    std::vector<std::int32_t> both;
    std::set_intersection(
      one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(both));
    return both;
  };
  std::map<Ids, std::vector<std::array<Ids, 2>>> sides; // by the four points
  for (std::size_t i = 0; i < before.size(); i += 3)
  {
    const Ids old(&before[i], &before[i] + 3), made(&after[i], &after[i] + 3);
    if (old != made)
    {
      Ids all = old;
      all.insert(made.begin(), made.end());
      sides[all].push_back({ old, made });
    }
  }
  std::vector<std::array<std::int32_t, 4>> quads;
  for (const auto& [ids, two] : sides)
  {
    EXPECT_EQ(2U, two.size());
    const std::vector<std::int32_t> pq = intersect(two[0][0], two[1][0]);
    const std::vector<std::int32_t> ab = intersect(two[0][1], two[1][1]);
    quads.push_back({ ab.at(0), pq.at(0), pq.at(1), ab.at(1) });
  }
  return quads;
}

TEST(Surface, NoFlipMovesItByMoreThanTheDeviation)
{
  std::int64_t blocked = 0;
  for (const double deviation : { 0.001, 0.01, 0.1 })
  {
    const OwnedMesh<double> mesh = MakeBadSphere(60, 30, 66);
    const FlipResult result = FlipSurface(mesh, deviation);
    EXPECT_EQ(result.Report.NonDelaunayAfter,
      result.Report.BlockedByShape + result.Report.BlockedByDeviation +
        result.Report.BlockedByEdge);
    blocked += result.Report.BlockedByDeviation;

    FlipSession session(
      mesh.View(), OnTestBackend(With(&FlipOptions::MaximumDeviation, deviation, OnSurface())));
    std::vector<std::int32_t> triangles = mesh.Triangles;
    std::int64_t flips = 0;
    for (bool goesOn = true; goesOn;)
    {
      goesOn = session.Advance(1);
      const std::vector<std::int32_t> next = StoreTriangles(session);
      for (const std::array<std::int32_t, 4>& quad : FindFlips(triangles, next))
      {
        ++flips;
        EXPECT_LE(SurfaceReferee(mesh, next).FindDistance(quad), deviation * (1 + 1e-12L));
      }
      triangles = next;
    }
    EXPECT_EQ(result.Report.TotalFlips, flips);
    EXPECT_EQ(result.Triangles, triangles);
  }
  EXPECT_LT(0, blocked);
}

TEST(Surface, MoebiusStripsStayOneSided)
{
  for (std::int32_t columns : { 6, 40, 400 / static_cast<int>(Reduction) })
  {
    const OwnedMesh<double> mesh = MakeMoebiusStrip(columns, 4, 62);
    const FlipResult result = FlipSurface(mesh);
    EXPECT_EQ(4, result.Report.Edges.WronglyWound);
    EXPECT_EQ(0, result.Report.EulerCharacteristic);
    EXPECT_LT(0, result.Report.TotalFlips);
  }
}

/// Three triangles at an edge, of which one has an obtuse angle and flips with a fourth.
TEST(Surface, ObtuseAnglesAtNonManifoldEdgesAreThoseOfTheInput)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 4, 0, 0, 2, 0.5, 0, 0.9, 0.3, 0, 2, 0, 3, 2, 0, -3 };
  mesh.Triangles = { 0, 1, 2, 0, 2, 3, 0, 1, 4, 0, 1, 5 };
  const FlipReport report = FlipSurface(mesh).Report;
  EXPECT_EQ(1, report.TotalFlips);
  EXPECT_EQ(1, report.Edges.NonManifold);
  EXPECT_EQ(1, report.ObtuseAtNonManifold);
}

TEST(Surface, DuplicateTrianglesKeepTheirEdges)
{
  for (bool reversed : { false, true })
  {
    OwnedMesh<double> mesh = MakeBadSphere(40, 20, 64);
    const std::vector<std::int32_t> clean = mesh.Triangles;
    for (std::size_t t = 0; t < clean.size(); t += 60)
    {
      mesh.Triangles.insert(mesh.Triangles.end(),
        { clean[t + (reversed ? 1 : 0)], clean[t + (reversed ? 0 : 1)], clean[t + 2] });
    }
    const FlipResult result = FlipSurface(mesh);
    EXPECT_LT(100, result.Report.Edges.NonManifold);
    EXPECT_LT(0, result.Report.TotalFlips);
    EXPECT_EQ(mesh.Triangles.size() - clean.size(), 3 * result.Report.DuplicateTriangles);
    EXPECT_LT(0, result.Report.ObtuseAtNonManifold);
    for (std::size_t t = 0; t < clean.size() / 3; t += 20)
    {
      for (const std::size_t kept : { t, clean.size() / 3 + t / 20 })
      {
        EXPECT_EQ(0, result.FlipCounts[kept]);
        EXPECT_TRUE(std::equal(
          &mesh.Triangles[3 * kept], &mesh.Triangles[3 * kept] + 3, &result.Triangles[3 * kept]));
      }
    }
  }
}

/// One triangle twice and nothing else: every edge has two triangles, but none may flip.
TEST(Surface, LoneDuplicatesAreReported)
{
  const std::vector<std::int32_t> pairs[] = { { 0, 1, 2, 1, 2, 0 }, { 0, 1, 2, 2, 1, 0 } };
  for (const std::vector<std::int32_t>& pair : pairs)
  {
    const OwnedMesh<double> mesh = { { 0, 0, 0, 4, 0, 0, 1, 0.1, 0 }, pair };
    const FlipResult result = FlipSurface(mesh);
    EXPECT_EQ(mesh.Triangles, result.Triangles);
    EXPECT_EQ(3, result.Report.Edges.Fixed);
    EXPECT_EQ(1, CountDefect(result.Report, "repeat another"));
    EXPECT_EQ(1u, result.Report.Defects.size()) << DescribeDefects(result.Report.Defects);
  }
}

}
}
