// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintOracle.h"
#include "MeshAudit.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

/// @file
/// Constraints that are inserted into divided meshes: those within the piece of one rank.

namespace delaunayflip
{
namespace
{

constexpr const char* LeavesPart =
  "constraint edges that cannot be inserted because they leave the part of the mesh that a rank "
  "has: insert constraints across ranks before the mesh is divided";
constexpr const char* NeedsGuard =
  "constraint edges that ranks cannot insert because triangles overlap or have no area: insert "
  "constraints before the mesh is divided";

/// Fewer under a sanitizer.
constexpr std::uint32_t CountSeeds(std::uint32_t all)
{
  return std::max<std::uint32_t>(1, all / Reduction);
}

/// The piece's id of a point of the whole mesh, or -1.
std::int64_t FindPoint(const OwnedPiece& piece, std::int64_t point)
{
  const auto found = std::find(piece.PointOf.begin(), piece.PointOf.end(), point);
  return found == piece.PointOf.end() ? -1 : found - piece.PointOf.begin();
}

/// Adds a point that the piece's triangles do not use, unless it has the point.
std::int64_t AddPoint(const TriangleMesh& mesh, std::int64_t point, OwnedPiece& piece)
{
  const std::int64_t known = FindPoint(piece, point);
  if (known >= 0)
  {
    return known;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    piece.Doubles.push_back(mesh.Points.Get(point, axis));
  }
  piece.PointOf.push_back(point);
  return static_cast<std::int64_t>(piece.PointOf.size()) - 1;
}

/// Gives every constraint to one rank only, which need not have triangles at its points.
std::vector<OwnedPiece> GiveToAny(const TriangleMesh& mesh, std::vector<OwnedPiece> pieces)
{
  for (OwnedPiece& piece : pieces)
  {
    piece.Constraints.clear();
    piece.ToInsert.clear();
  }
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    OwnedPiece& piece = pieces[(7 * i + 1) % pieces.size()];
    const std::int64_t from = AddPoint(mesh, mesh.ConstraintEdges[2 * i], piece);
    piece.Constraints.push_back(from);
    piece.Constraints.push_back(AddPoint(mesh, mesh.ConstraintEdges[2 * i + 1], piece));
    piece.ToInsert.push_back(mesh.ConstraintsToInsert[i]);
  }
  return pieces;
}

/// A report's defects with their counts, without ids.
std::map<std::string, std::int64_t> CountDefects(const FlipReport& report)
{
  std::map<std::string, std::int64_t> counts;
  for (const Defect& defect : report.Defects)
  {
    counts[defect.What] = defect.Count;
  }
  return counts;
}

/// Whether the triangles of one rank, alone, can have a constraint as an edge.
bool LiesInAPiece(const std::vector<OwnedPiece>& pieces, const std::int64_t* ends)
{
  for (const OwnedPiece& piece : pieces)
  {
    const std::int64_t own[2] = { FindPoint(piece, ends[0]), FindPoint(piece, ends[1]) };
    if (own[0] >= 0 && own[1] >= 0)
    {
      const unsigned char insert = 1;
      TriangleMesh part = piece.View(true).Mesh;
      part.Regions = nullptr;
      part.FrozenTriangles = nullptr;
      part.ConstraintEdges = own;
      part.NumberOfConstraintEdges = 1;
      part.ConstraintsToInsert = &insert;
      FlipOptions options = MakeCanonical();
      options.Geometry = GeometryKind::Planar;
      options.MaximumIterations = 0;
      if (Flip(part, options).Report.UnmatchedConstraints == 0)
      {
        return true;
      }
    }
  }
  return false;
}

/// The constraints, each once.
std::vector<VertexPair> ListPairs(const ConstrainedMesh& mesh)
{
  std::vector<VertexPair> pairs;
  for (std::size_t i = 0; i < mesh.Ends.size(); i += 2)
  {
    pairs.push_back(std::minmax({ mesh.Ends[i], mesh.Ends[i + 1] }));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The same mesh with the constraints that lie in a piece.
ConstrainedMesh KeepWithin(const ConstrainedMesh& mesh, const std::vector<OwnedPiece>& pieces)
{
  ConstrainedMesh within;
  within.Mesh = mesh.Mesh;
  for (std::size_t i = 0; i < mesh.Ends.size(); i += 2)
  {
    if (LiesInAPiece(pieces, mesh.Ends.data() + i))
    {
      within.Add(mesh.Ends[i], mesh.Ends[i + 1]);
    }
  }
  return within;
}

/// A mesh that a few iterations have improved, so that pieces are compact, with long and, more of
/// them, short constraints that do not cross each other.
ConstrainedMesh Draw(std::size_t points, std::int32_t size, std::uint32_t seed)
{
  ConstrainedMesh drawn = DrawCase(points, size, 10, seed);
  FlipOptions few = MakeCanonical();
  few.MaximumIterations = 4;
  drawn.Mesh.Triangles = Flip(drawn.Mesh.View(), few).Triangles;
  const std::vector<double>& x = drawn.Mesh.Points;
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < points; ++i)
  {
    const std::int64_t from = DrawIndex(random, drawn.Mesh.NumberOfPoints());
    const auto measure = [&](std::int64_t to)
    { return std::hypot(x[3 * to] - x[3 * from], x[3 * to + 1] - x[3 * from + 1]); };
    std::int64_t best = from == 0 ? 1 : 0;
    for (int trial = 0; trial < 20; ++trial)
    {
      const std::int64_t to = DrawIndex(random, drawn.Mesh.NumberOfPoints());
      best = to != from && measure(to) < measure(best) ? to : best;
    }
    drawn.Add(from, best);
  }
  return DropCrossing(drawn);
}

/// Expects what one process makes of a mesh in which no two constraints cross and all lie in
/// pieces.
void ExpectAsAlone(const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces,
  const FlipOptions& options = MakeCanonical(), bool withNumbers = true)
{
  const FlipResult alone = Flip(mesh, options);
  const GroupResult together = FlipDivided(mesh, pieces, options, withNumbers);
  EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(together.View()));
  ExpectSameOnAllRanks(together.Reports);
  const PiecesReport& report = together.Reports.front();
  ExpectConsistentStatistics(report);
  EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
  EXPECT_EQ(alone.Report.UnmatchedConstraints, report.UnmatchedConstraints);
  EXPECT_EQ(CountDefects(alone.Report), CountDefects(report));
  EXPECT_EQ(alone.Report.Points, report.Points);
  EXPECT_EQ(alone.Report.Edges.Edges, report.Edges.Edges);
  EXPECT_EQ(alone.Report.Edges.Boundary, report.Edges.Boundary);
  EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
  EXPECT_EQ(alone.Report.Edges.Region, report.Edges.Region);
  EXPECT_EQ(alone.Report.Edges.Fixed, report.Edges.Fixed);
  EXPECT_EQ(alone.Report.EulerCharacteristic, report.EulerCharacteristic);
  EXPECT_EQ(alone.Report.NonDelaunayAfter, report.NonDelaunayAfter);
  EXPECT_EQ(alone.Report.GeometryUsed, report.GeometryUsed);
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  EXPECT_EQ(2 * (report.TotalFlips + report.ConstraintFlips),
    std::accumulate(together.FlipCounts.begin(), together.FlipCounts.end(), std::int64_t(0)));
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

  /// However the mesh and its constraints are divided. @returns how many lie in pieces.
  std::int64_t ExpectAsAloneAlways(
    const ConstrainedMesh& mesh, const FlipOptions& options = MakeCanonical()) const
  {
    const ConstrainedMesh within = KeepWithin(mesh, this->CutIt(mesh.View()));
    const TriangleMesh view = within.View();
    ExpectAsAlone(view, this->CutIt(view), options);
    ExpectAsAlone(view, GiveToAny(view, this->CutIt(view)), options);
    ExpectAsAlone(view, GiveToAny(view, this->CutIt(view)), options, false);
    const ConstrainedMesh scattered = KeepWithin(mesh, this->ScatterIt(mesh.View()));
    ExpectAsAlone(scattered.View(), this->ScatterIt(scattered.View()), options);
    return view.NumberOfConstraintEdges;
  }
};

TEST_P(PieceInsertionTest, RandomConstraintsAmongManyPoints)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(4); ++seed)
  {
    SCOPED_TRACE(seed);
    EXPECT_LT(40, this->ExpectAsAloneAlways(Draw(300, 1000, seed)));
  }
}

TEST_P(PieceInsertionTest, RandomConstraintsAmongFewLatticePoints)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(12); ++seed)
  {
    SCOPED_TRACE(seed);
    this->ExpectAsAloneAlways(Draw(20 + seed, 6, seed));
  }
}

TEST_P(PieceInsertionTest, InATiltedPlane)
{
  ConstrainedMesh drawn = Draw(120, 100, 3);
  drawn.Mesh = Transform(drawn.Mesh, { { { 0, 0, 0, 4 }, { 2, 0, 0, 0 }, { 0, 1, 0, 0 } } });
  for (std::size_t i = 0; i < drawn.Mesh.Points.size(); i += 3)
  {
    drawn.Mesh.Points[i] = 3 * drawn.Mesh.Points[i + 1] - 2 * drawn.Mesh.Points[i + 2];
  }
  EXPECT_LT(10, this->ExpectAsAloneAlways(drawn));
}

TEST_P(PieceInsertionTest, WithRegionsAndFrozenTriangles)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(6); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = Draw(120, 30, seed);
    const ConstrainedMesh within = KeepWithin(drawn, this->CutIt(drawn.View()));
    TriangleMesh mesh = within.View();
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
    ExpectAsAlone(mesh, this->CutIt(mesh));
    mesh.FrozenTriangles = frozen.data();
    ExpectAsAlone(mesh, GiveToAny(mesh, this->CutIt(mesh)));
    mesh.Regions = nullptr;
    ExpectAsAlone(mesh, this->CutIt(mesh));
  }
}

TEST_P(PieceInsertionTest, OneRankHasAll)
{
  const ConstrainedMesh drawn = DropCrossing(DrawCase(100, 1000, 40, 8));
  const TriangleMesh mesh = drawn.View();
  const Owners owners(mesh.Triangles.Count, GetParam() - 1);
  ExpectAsAlone(mesh, GiveToAny(mesh, Divide(mesh, owners, GetParam())));
}

/// They count once, and leave no trace.
TEST_P(PieceInsertionTest, OthersAreUnmatched)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(8); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = seed % 2 == 0 ? Draw(200, 1000, seed) : Draw(30, 6, seed);
    const TriangleMesh all = drawn.View();
    for (const Owners& owners : { this->Cut(all), this->Scatter(all) })
    {
      const std::vector<OwnedPiece> pieces = Divide(all, owners, GetParam());
      const ConstrainedMesh within = KeepWithin(drawn, pieces);
      const FlipResult alone = Flip(within.View(), MakeCanonical());
      ASSERT_EQ(0, alone.Report.UnmatchedConstraints);
      const GroupResult together = FlipDivided(all, GiveToAny(all, pieces), MakeCanonical());
      ExpectSameOnAllRanks(together.Reports);
      EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(together.View()));
      const PiecesReport& report = together.Reports.front();
      const auto unmatched =
        static_cast<std::int64_t>(ListPairs(drawn).size() - ListPairs(within).size());
      EXPECT_EQ(unmatched, report.UnmatchedConstraints);
      EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
      EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
      EXPECT_EQ(unmatched, CountDefects(report)[LeavesPart]);
      EXPECT_EQ(GetParam() == 1, unmatched == 0);
      // Also those that several ranks give; and ranks that lack an end do not know others.
      EXPECT_EQ(ToTriangleSet(alone.Triangles),
        ToTriangleSet(FlipDivided(all, pieces, MakeCanonical()).View()));
    }
  }
}

TEST_P(PieceInsertionTest, ThatCrossEachOther)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(6); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DrawCase(100, 40, 40, seed);
    const TriangleMesh mesh = drawn.View();
    const std::vector<OwnedPiece> pieces = GiveToAny(mesh, this->CutIt(mesh));
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

/// Two ranks have three columns each of a lattice.
TEST(PieceInsertion, AtTheSeamOfALattice)
{
  ConstrainedMesh lattice;
  lattice.Mesh = MakeGridMesh(6, 6);
  const auto point = [](std::int64_t x, std::int64_t y) { return y * 7 + x; };
  lattice.Add(point(3, 0), point(3, 3)); // three seam edges, which both ranks have
  lattice.Add(point(3, 4), point(6, 6)); // begins at the seam, through a vertex at most
  lattice.Add(point(0, 6), point(3, 5)); // ends at it
  lattice.Add(point(1, 1), point(2, 0)); // within
  lattice.Add(point(2, 2), point(4, 1)); // crosses it
  const TriangleMesh mesh = lattice.View();
  Owners owners;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    double x = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      x += mesh.Points.Get(mesh.Triangles.Get(t, slot), 0);
    }
    const double largest = mesh.Points.Get(mesh.Points.Count - 1, 0);
    owners.push_back(2.0 * x > 3.0 * largest ? 1 : 0);
  }
  const GroupResult result =
    FlipDivided(mesh, GiveToAny(mesh, Divide(mesh, owners, 2)), MakeCanonical());
  const PiecesReport& report = result.Reports.front();
  EXPECT_EQ(4, report.InsertedConstraints);
  EXPECT_EQ(1, report.UnmatchedConstraints);
  EXPECT_EQ(1, CountDefects(report)[LeavesPart]);
  const std::vector<std::int32_t> ids(result.Triangles.begin(), result.Triangles.end());
  for (int i = 0; i < 4; ++i)
  {
    ExpectEdges(ids, SplitAtVertices(mesh, lattice.Ends[2 * i], lattice.Ends[2 * i + 1]));
  }
}

TEST_P(PieceInsertionTest, ToAPointWithoutTriangles)
{
  ConstrainedMesh grid;
  grid.Mesh = MakeGridMesh(6, 2);
  grid.Mesh.Points.insert(grid.Mesh.Points.end(), { 0.5, 0.25, 0.0 });
  grid.Add(20, 21);
  const TriangleMesh mesh = grid.View();
  const GroupResult result = FlipDivided(mesh, GiveToAny(mesh, this->CutIt(mesh)), MakeCanonical());
  EXPECT_EQ(1, result.Reports.front().UnmatchedConstraints);
}

/// A flip for a constraint could make an edge that another rank has.
TEST_P(PieceInsertionTest, NoneBesideATriangleWithoutArea)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(4); ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = Draw(60, 20, seed);
    const double y = seed == 0 ? std::numeric_limits<double>::infinity() : 42;
    drawn.Mesh.Points.insert(drawn.Mesh.Points.end(), { 40, 40, 0, 40, 41, 0, 40, y, 0 });
    const auto last = static_cast<std::int32_t>(drawn.Mesh.NumberOfPoints());
    drawn.Mesh.Triangles.insert(drawn.Mesh.Triangles.end(), { last - 3, last - 2, last - 1 });
    FlipOptions options = MakeCanonical();
    options.Geometry = GeometryKind::PlanarXY;
    if (GetParam() == 1)
    {
      ExpectAsAlone(drawn.View(), this->CutIt(drawn.View()), options);
      continue;
    }
    TriangleMesh mesh = drawn.View();
    const GroupResult result = FlipDivided(mesh, GiveToAny(mesh, this->CutIt(mesh)), options);
    ExpectSameOnAllRanks(result.Reports);
    mesh.ConstraintsToInsert = nullptr;
    const FlipResult alone = Flip(mesh, options);
    EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(result.View()));
    const PiecesReport& report = result.Reports.front();
    EXPECT_EQ(0, report.InsertedConstraints);
    EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
    EXPECT_LT(0, report.UnmatchedConstraints);
    std::map<std::string, std::int64_t> defects = CountDefects(report);
    EXPECT_LT(0, defects[NeedsGuard]);
    EXPECT_EQ(report.UnmatchedConstraints, defects[NeedsGuard] + defects[LeavesPart]);
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
    const std::vector<OwnedPiece> pieces = GiveToAny(mesh, this->CutIt(mesh));
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

TEST_P(PieceInsertionTest, OnASurfaceNoneIs)
{
  ConstrainedMesh sphere;
  sphere.Mesh = MakeBadSphere(20, 10, 3);
  sphere.Add(5, 90);
  sphere.Add(7, 120);
  sphere.Add(sphere.Mesh.Triangles[0], sphere.Mesh.Triangles[1]);
  const TriangleMesh mesh = sphere.View();
  const FlipReport alone = Flip(mesh, MakeOnSurface()).Report;
  const PiecesReport report =
    FlipDivided(mesh, GiveToAny(mesh, this->CutIt(mesh)), MakeOnSurface()).Reports.front();
  EXPECT_EQ(2, report.UnmatchedConstraints);
  EXPECT_EQ(0, report.InsertedConstraints);
  EXPECT_EQ(1, report.Edges.Constraint);
  EXPECT_EQ(CountDefects(alone), CountDefects(report));
  EXPECT_EQ(alone.Points, report.Points);
  EXPECT_EQ(alone.EulerCharacteristic, report.EulerCharacteristic);
}

TEST_P(PieceInsertionTest, AnyRankCanStopAll)
{
  const ConstrainedMesh drawn = Draw(200, 1000, 5);
  const TriangleMesh mesh = drawn.View();
  const std::vector<OwnedPiece> pieces = this->CutIt(mesh);
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
    EXPECT_EQ(stopped < 0.25, reports.front().InsertedConstraints == 0) << limit;
    if (stopped < 0.25) // before ranks keep what they have inserted
    {
      EXPECT_EQ(0, reports.front().ConstraintFlips) << limit;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pieces, PieceInsertionTest, testing::Values(1, 2, 3, 4, 7, 16), NameRanks);

}
}
