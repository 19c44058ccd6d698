// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalReference.h"
#include "ConstraintOracle.h"
#include "FlipError.h"
#include "GivenConstraints.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

/// @file
/// Constraints that are inserted into divided meshes.

namespace delaunayflip
{
namespace
{

/// Fewer under a sanitizer.
constexpr std::uint32_t CountSeeds(std::uint32_t all)
{
  return std::max<std::uint32_t>(1, all / Reduction);
}

class PieceInsertionTest : public RanksTest
{
protected:
  std::vector<OwnedPiece> CutIt(const TriangleMesh& mesh) const
  {
    return Divide(mesh, this->Cut(mesh), GetParam());
  }
  std::vector<OwnedPiece> ScatterIt(const TriangleMesh& mesh) const
  {
    return Divide(mesh, this->Scatter(mesh), GetParam());
  }

  /// However the mesh and its constraints are divided.
  void ExpectAsAloneAlways(const TriangleMesh& mesh) const
  {
    ExpectAsAlone(mesh, GiveFar(mesh, this->CutIt(mesh)));
    ExpectAsAlone(mesh, GiveFar(mesh, this->ScatterIt(mesh)));
    ExpectAsAlone(mesh, GiveToAny(mesh, this->CutIt(mesh)));
    ExpectAsAlone(mesh, GiveToAny(mesh, this->CutIt(mesh)), MakeCanonical(), false);
  }
};

TEST_P(PieceInsertionTest, RandomConstraintsAmongManyPoints)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(4); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DropCrossing(DrawCase(150, 1000, 60, seed));
    this->ExpectAsAloneAlways(drawn.View());
  }
}

TEST_P(PieceInsertionTest, RandomConstraintsAmongFewLatticePoints)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(12); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DropCrossing(DrawCase(20 + seed, 6, 12, seed));
    this->ExpectAsAloneAlways(drawn.View());
  }
}

TEST_P(PieceInsertionTest, ThatCrossEachOther)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(6); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DrawCase(100, 40, 40, seed);
    const TriangleMesh mesh = drawn.View();
    const std::vector<OwnedPiece> pieces = GiveFar(mesh, this->CutIt(mesh));
    const FlipResult alone = Flip(mesh, MakeCanonical());
    const GroupResult together = FlipDivided(mesh, pieces, MakeCanonical());
    ExpectSameOnAllRanks(together.Reports);
    const PiecesReport& report = together.Reports.front();
    EXPECT_EQ(alone.Report.InsertedConstraints + alone.Report.UnmatchedConstraints,
      report.InsertedConstraints + report.UnmatchedConstraints);
    EXPECT_EQ(0, report.NonDelaunayAfter);
    EXPECT_EQ(EulerCharacteristic(mesh.Triangles), EulerCharacteristic(together.View()));
    EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, together.View()));
    const std::vector<std::int32_t> ids(together.Triangles.begin(), together.Triangles.end());
    EXPECT_EQ(SumAreas(mesh), SumAreas(WithTriangles(mesh, ids)));
    std::vector<VertexPair> held;
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      const std::vector<VertexPair> split =
        SplitAtVertices(mesh, mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1]);
      const bool isHeld = std::all_of(split.begin(), split.end(),
        [&](const VertexPair& one) { return HasEdge(ids, one.first, one.second); });
      held.insert(held.end(), isHeld ? split.begin() : split.end(), split.end());
    }
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    EXPECT_LE(report.Edges.Constraint, static_cast<std::int64_t>(held.size()));
    ExpectConstrainedDelaunay(WithTriangles(mesh, ids), held);
    EXPECT_EQ(ToTriangleSet(FlipDivided(mesh, pieces, MakeCanonical()).View()),
      ToTriangleSet(together.View()));
  }
}

TEST_P(PieceInsertionTest, AlongAndAcrossALattice)
{
  constexpr std::int32_t Size = 12;
  ConstrainedMesh lattice;
  lattice.Mesh = MakeGridMesh(Size, Size);
  const auto point = [](std::int64_t x, std::int64_t y) { return y * (Size + 1) + x; };
  lattice.Add(point(0, 6), point(Size, 6)); // along edges
  lattice.Add(point(0, Size), point(6, 6)); // across diagonals, through vertices
  lattice.Add(point(1, 0), point(Size, 5)); // meets no vertex
  lattice.Add(point(0, 7), point(5, Size)); // is a diagonal's neighbour
  lattice.Add(point(0, 1), point(9, 4)); // meets every third
  this->ExpectAsAloneAlways(DropCrossing(lattice).View());
}

TEST_P(PieceInsertionTest, OneThatLeavesTheMesh)
{
  ConstrainedMesh ring;
  ring.Mesh = MakeGridMesh(3, 3); // with a hole in its middle
  ring.Mesh.Triangles.erase(
    ring.Mesh.Triangles.begin() + 3 * 8, ring.Mesh.Triangles.begin() + 3 * 10);
  ring.Add(0, 15);
  ring.Add(4, 11);
  ring.Add(9, 6);
  ring.Add(0, 7);
  ring.Add(3, 13, false); // is not an edge and is not to be inserted
  const TriangleMesh mesh = ring.View();
  ExpectAsAlone(mesh, GiveToAny(mesh, this->CutIt(mesh)));
  ExpectAsAlone(mesh, GiveToAny(mesh, this->ScatterIt(mesh)));
}

TEST_P(PieceInsertionTest, BesidePointsThatAreNotFinite)
{
  ConstrainedMesh drawn = DropCrossing(DrawCase(100, 1000, 30, 6));
  drawn.Mesh.Points[3 * 50] = -std::numeric_limits<double>::infinity();
  drawn.Mesh.Points[3 * 60 + 1] = std::numeric_limits<double>::infinity();
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::PlanarXY;
  const TriangleMesh mesh = drawn.View();
  ExpectAsAlone(mesh, GiveToAny(mesh, this->CutIt(mesh)), options);
}

TEST_P(PieceInsertionTest, ToAPointWithoutTriangles)
{
  ConstrainedMesh grid;
  grid.Mesh = MakeGridMesh(6, 2);
  grid.Mesh.Points.insert(grid.Mesh.Points.end(), { 0.5, 0.25, 0.0 });
  grid.Add(20, 21);
  grid.Add(0, 13);
  const TriangleMesh mesh = grid.View();
  const GroupResult result = FlipDivided(mesh, GiveToAny(mesh, this->CutIt(mesh)), MakeCanonical());
  EXPECT_EQ(1, result.Reports.front().UnmatchedConstraints);
  EXPECT_EQ(1, result.Reports.front().InsertedConstraints);
}

TEST_P(PieceInsertionTest, WithRegionsAndFrozenTriangles)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(6); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DropCrossing(DrawCase(120, 30, 25, seed));
    TriangleMesh mesh = drawn.View();
    std::vector<std::int32_t> regions;
    std::vector<unsigned char> frozen;
    for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
    {
      double x = 0.0;
      for (int slot = 0; slot < 3; ++slot)
      {
        x += mesh.Points.Get(mesh.Triangles.Get(t, slot), 0) / 3.0;
      }
      regions.push_back(x > 20.0 ? -7 : 3);
      frozen.push_back(t % 40 == 0 ? 1 : 0);
    }
    mesh.Regions = regions.data();
    ExpectAsAlone(mesh, GiveFar(mesh, this->CutIt(mesh)));
    mesh.FrozenTriangles = frozen.data();
    ExpectAsAlone(mesh, GiveToAny(mesh, this->ScatterIt(mesh)));
    mesh.Regions = nullptr;
    ExpectAsAlone(mesh, GiveFar(mesh, this->CutIt(mesh)));
  }
}

TEST_P(PieceInsertionTest, InATiltedPlane)
{
  ConstrainedMesh drawn = DropCrossing(DrawCase(120, 100, 30, 3));
  drawn.Mesh = Transform(drawn.Mesh, { { { 0, 0, 0, 4 }, { 2, 0, 0, 0 }, { 0, 1, 0, 0 } } });
  for (std::size_t i = 0; i < drawn.Mesh.Points.size(); i += 3)
  {
    drawn.Mesh.Points[i] = 3 * drawn.Mesh.Points[i + 1] - 2 * drawn.Mesh.Points[i + 2];
  }
  this->ExpectAsAloneAlways(drawn.View());
}

TEST_P(PieceInsertionTest, InTerrain)
{
  ConstrainedMesh drawn = DropCrossing(DrawCase(120, 1000, 30, 4));
  std::mt19937 random(4);
  for (std::size_t i = 2; i < drawn.Mesh.Points.size(); i += 3)
  {
    drawn.Mesh.Points[i] = DrawIndex(random, 5);
  }
  const TriangleMesh mesh = drawn.View();
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::PlanarXY;
  ExpectAsAlone(mesh, GiveToAny(mesh, this->CutIt(mesh)), options);
}

/// Where flips could make edges that other ranks have.
TEST_P(PieceInsertionTest, BesideTrianglesWithoutArea)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(4); ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = DropCrossing(DrawCase(60, 20, 20, seed));
    drawn.Mesh.Points.insert(drawn.Mesh.Points.end(), { 40, 40, 0, 40, 41, 0, 40, 42, 0 });
    const auto last = static_cast<std::int32_t>(drawn.Mesh.NumberOfPoints());
    drawn.Mesh.Triangles.insert(drawn.Mesh.Triangles.end(), { last - 3, last - 2, last - 1 });
    ExpectAsAlone(drawn.View(), GiveFar(drawn.View(), this->CutIt(drawn.View())));
    ExpectAsAlone(drawn.View(), GiveToAny(drawn.View(), this->ScatterIt(drawn.View())));
  }
}

TEST_P(PieceInsertionTest, KeepsOverlapsWhatTheyAre)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(10); ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = DrawCase(40, 10, 30, seed);
    std::mt19937 random(seed);
    for (int i = 0; i < 6; ++i)
    {
      const std::size_t point = DrawIndex(random, drawn.Mesh.NumberOfPoints());
      drawn.Mesh.Points[3 * point] = DrawIndex(random, 11);
      drawn.Mesh.Points[3 * point + 1] = DrawIndex(random, 11);
    }
    drawn.Mesh = seed % 2 == 0 ? drawn.Mesh : RepeatTriangles(drawn.Mesh);
    const TriangleMesh mesh = drawn.View();
    const std::vector<OwnedPiece> pieces = GiveFar(mesh, this->CutIt(mesh));
    const GroupResult result = FlipDivided(mesh, pieces, MakeCanonical());
    ExpectSameOnAllRanks(result.Reports);
    EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, result.View()));
    EXPECT_EQ(EulerCharacteristic(mesh.Triangles), EulerCharacteristic(result.View()));
    const FlipReport alone = Flip(mesh, MakeCanonical()).Report;
    const PiecesReport& report = result.Reports.front();
    EXPECT_EQ(alone.InsertedConstraints + alone.UnmatchedConstraints,
      report.InsertedConstraints + report.UnmatchedConstraints);
    EXPECT_EQ(alone.EulerCharacteristic, report.EulerCharacteristic);
    EXPECT_EQ(alone.Edges.Edges, report.Edges.Edges);
    EXPECT_EQ(alone.Edges.Boundary, report.Edges.Boundary);
    EXPECT_EQ(alone.Edges.NonManifold, report.Edges.NonManifold);
  }
}

/// A second sheet over some of the points, which has edges that flips in the first one could make.
TEST_P(PieceInsertionTest, BetweenTwoSheets)
{
  std::int64_t inserted = 0;
  for (std::uint32_t seed = 0; seed < CountSeeds(12); ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = DrawCase(60, 12, 30, seed);
    std::vector<std::array<double, 2>> places;
    for (std::size_t i = 0; i < drawn.Mesh.Points.size(); i += 6)
    {
      places.push_back({ drawn.Mesh.Points[i], drawn.Mesh.Points[i + 1] });
    }
    Owners owners(drawn.Mesh.NumberOfTriangles(), 0);
    for (const std::int32_t point : MakeSweptMesh(places).Triangles)
    {
      drawn.Mesh.Triangles.push_back(2 * point);
    }
    owners.resize(drawn.Mesh.NumberOfTriangles(), GetParam() - 1);
    const TriangleMesh mesh = drawn.View();
    for (const Owners& some : { owners, this->Cut(mesh) })
    {
      const GroupResult result =
        FlipDivided(mesh, GiveFar(mesh, Divide(mesh, some, GetParam())), MakeCanonical());
      ExpectSameOnAllRanks(result.Reports);
      EXPECT_EQ(0, CountDuplicateEdgesGained(mesh.Triangles, result.View()));
      const FlipReport& report = result.Reports.front();
      EXPECT_EQ(Flip(mesh, MakeCanonical()).Report.EulerCharacteristic, report.EulerCharacteristic);
      inserted += report.InsertedConstraints;
    }
  }
  EXPECT_LT(0, inserted);
}

TEST_P(PieceInsertionTest, OnASurfaceNoneIs)
{
  ConstrainedMesh sphere;
  sphere.Mesh = MakeBadSphere(20, 10, 3);
  sphere.Add(5, 90);
  sphere.Add(7, 120);
  sphere.Add(sphere.Mesh.Triangles[0], sphere.Mesh.Triangles[1]);
  const TriangleMesh mesh = sphere.View();
  const FlipReport alone = Flip(mesh, MakeOnSurface()).Report;
  for (const std::vector<OwnedPiece>& pieces :
    { GiveFar(mesh, this->ScatterIt(mesh)), GiveToAny(mesh, this->CutIt(mesh)) })
  {
    const PiecesReport report = FlipDivided(mesh, pieces, MakeOnSurface()).Reports.front();
    EXPECT_EQ(2, report.UnmatchedConstraints);
    EXPECT_EQ(0, report.InsertedConstraints);
    EXPECT_EQ(1, report.Edges.Constraint);
    EXPECT_EQ(ListDefects(alone), ListDefects(report));
    EXPECT_EQ(alone.Points, report.Points);
    EXPECT_EQ(alone.EulerCharacteristic, report.EulerCharacteristic);
  }
}

TEST_P(PieceInsertionTest, OneRankHasAllOrNone)
{
  const ConstrainedMesh drawn = DropCrossing(DrawCase(100, 1000, 40, 8));
  const TriangleMesh mesh = drawn.View();
  Owners owners(mesh.Triangles.Count, GetParam() - 1);
  ExpectAsAlone(mesh, GiveToAny(mesh, Divide(mesh, owners, GetParam())));
  owners = this->Cut(mesh);
  std::replace(owners.begin(), owners.end(), GetParam() - 1, 0);
  ExpectAsAlone(mesh, GiveToAny(mesh, Divide(mesh, owners, GetParam())));
}

TEST_P(PieceInsertionTest, AnyRankCanStopAll)
{
  const ConstrainedMesh drawn = DropCrossing(DrawCase(200, 1000, 60, 5));
  const TriangleMesh mesh = drawn.View();
  const std::vector<OwnedPiece> pieces = GiveFar(mesh, this->CutIt(mesh));
  for (const double limit : { -1.0, 0.1, 0.19, 0.22, 0.3, 0.7 })
  {
    std::vector<PiecesReport> reports(GetParam());
    std::atomic<std::int64_t> triangles{ 0 };
    double stopped = 1.0; // the share at which the last rank stops all
    RunInThreads(GetParam(),
      [&](PieceGroup& group)
      {
        const int rank = group.GetRank();
        FlippedPiece flipped;
        double last = 0.0;
        const ProgressObserver progress = [&](double share)
        {
          EXPECT_LE(last, share);
          last = share;
          const bool stops = rank == GetParam() - 1 && share > limit;
          if (stops)
          {
            stopped = std::min(stopped, share);
          }
          return !stops;
        };
        reports[rank] =
          FlipPiece(pieces[rank].View(true), MakeCanonical(), group, flipped, progress);
        triangles += static_cast<std::int64_t>(flipped.FlipCounts.size());
      });
    ExpectSameOnAllRanks(reports);
    EXPECT_EQ(StopReasonKind::Aborted, reports.front().StopReason) << limit;
    EXPECT_EQ(mesh.Triangles.Count, triangles);
    if (stopped < 0.19) // before ranks keep what they have inserted
    {
      EXPECT_EQ(0, reports.front().InsertedConstraints) << limit;
      EXPECT_EQ(0, reports.front().ConstraintFlips) << limit;
    }
  }
}

TEST_P(PieceInsertionTest, AWrongPointOnOneRankIsTheFailureOfAll)
{
  const ConstrainedMesh drawn = DrawCase(60, 1000, 10, 5);
  for (const PieceOrigin wrong : { PieceOrigin{ GetParam(), 0 }, PieceOrigin{ 0, 60 } })
  {
    std::vector<OwnedPiece> pieces = this->CutIt(drawn.View());
    pieces.back().FarConstraints = { { 0, 0 }, wrong };
    std::atomic<int> failures{ 0 };
    RunInThreads(GetParam(),
      [&](PieceGroup& group)
      {
        FlippedPiece flipped;
        EXPECT_THROW(
          FlipPiece(pieces[group.GetRank()].View(true), {}, group, flipped), InvalidMesh);
        ++failures;
      });
    EXPECT_EQ(GetParam(), failures);
  }
}

INSTANTIATE_TEST_SUITE_P(Pieces, PieceInsertionTest, testing::Values(1, 2, 3, 4, 7, 16), NameRanks);

}
}
