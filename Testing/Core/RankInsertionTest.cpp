// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "MeshAudit.h"
#include "PartTestSupport.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>

/// @file
/// Constraints that are inserted on ranks: those within the piece of one of them.

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
std::int64_t FindPoint(const OwnPiece& piece, std::int64_t point)
{
  const auto found = std::find(piece.PointOf.begin(), piece.PointOf.end(), point);
  return found == piece.PointOf.end() ? -1 : found - piece.PointOf.begin();
}

/// Gives every constraint to one rank only, which need not have triangles at its points.
std::vector<OwnPiece> GiveToAny(const TriangleMesh& mesh, std::vector<OwnPiece> pieces)
{
  for (OwnPiece& piece : pieces)
  {
    piece.Constraints.clear();
    piece.ToInsert.clear();
  }
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    OwnPiece& piece = pieces[(7 * i + 1) % pieces.size()];
    for (const std::int64_t point :
      { mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1] })
    {
      std::int64_t known = FindPoint(piece, point);
      if (known < 0)
      {
        known = static_cast<std::int64_t>(piece.PointOf.size());
        piece.PointOf.push_back(point);
        for (int axis = 0; axis < 3; ++axis)
        {
          piece.Doubles.push_back(mesh.Points.Get(point, axis));
        }
      }
      piece.Constraints.push_back(known);
    }
    piece.ToInsert.push_back(mesh.ConstraintsToInsert[i]);
  }
  return pieces;
}

/// Whether the triangles of one rank, alone, can have a constraint as an edge.
bool LiesInAPiece(const std::vector<OwnPiece>& pieces, const std::int64_t* ends)
{
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::Planar;
  options.MaximumIterations = 0;
  const unsigned char insert = 1;
  return std::any_of(pieces.begin(), pieces.end(),
    [&](const OwnPiece& piece)
    {
      const std::vector<std::int64_t> own{ FindPoint(piece, ends[0]), FindPoint(piece, ends[1]) };
      TriangleMesh part = WithConstraints(piece.View().Mesh, own, &insert);
      part.Regions = nullptr;
      part.FrozenTriangles = nullptr;
      return own[0] >= 0 && own[1] >= 0 && Flip(part, options).Report.UnmatchedConstraints == 0;
    });
}

/// The mesh with only those constraints that lie in a piece.
ConstrainedMesh KeepWithin(const ConstrainedMesh& mesh, const std::vector<OwnPiece>& pieces)
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

/// The count of a defect of which ranks name no ids.
std::int64_t CountWithoutIds(const FlipReport& report, const std::string& what)
{
  const auto found = std::find_if(report.Defects.begin(), report.Defects.end(),
    [&](Defect defect)
    {
      defect.Count = 2; // the words do not depend on it
      return DescribeDefects({ defect }).find(what) != std::string::npos;
    });
  return found == report.Defects.end() ? 0 : found->Count;
}

/// A mesh that a few iterations have improved, so that pieces are compact, with long and, more of
/// them, short constraints that do not cross each other.
ConstrainedMesh Draw(std::size_t points, std::int32_t size, std::uint32_t seed)
{
  ConstrainedMesh drawn = DrawCase(points, size, 10, seed);
  const FlipOptions few = With(&FlipOptions::MaximumIterations, 4, MakeCanonical());
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

class RankInsertionTest : public testing::TestWithParam<int>
{
protected:
  std::vector<OwnPiece> Divide(const TriangleMesh& mesh, bool cut = true) const
  {
    return cut ? DivideMesh(mesh, GetParam())
               : DivideMesh(mesh, DivideAtRandom(mesh, GetParam()), GetParam());
  }
};

/// If no two constraints cross and all lie in pieces, ranks make what one process makes of the
/// mesh, whoever has the constraints.
TEST_P(RankInsertionTest, WithinPieces)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(16); ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = seed % 4 == 0 ? Draw(300, 1000, seed) : Draw(20 + seed, 6, seed);
    if (seed % 3 == 0) // in a tilted plane
    {
      drawn.Mesh = Transform(drawn.Mesh, { { { 2, 0, 0, 4 }, { 0, 1, 0, 0 }, { 3, -2, 0, 0 } } });
    }
    for (const bool cut : { true, false })
    {
      const ConstrainedMesh within = KeepWithin(drawn, this->Divide(drawn.View(), cut));
      const TriangleMesh mesh = within.View();
      EXPECT_TRUE(!cut || seed % 4 > 0 || mesh.NumberOfConstraintEdges > 40);
      const std::vector<OwnPiece> pieces = this->Divide(mesh, cut);
      ExpectAsAlone(mesh, MakeCanonical(), FlipDivided(mesh, pieces, MakeCanonical()));
      for (const bool withNumbers : { true, false })
      {
        ExpectAsAlone(mesh, MakeCanonical(),
          FlipDivided(mesh, GiveToAny(mesh, pieces), MakeCanonical(), withNumbers));
      }
    }
  }
}

TEST_P(RankInsertionTest, WithRegionsAndFrozenTriangles)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(6); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = Draw(120, 30, seed);
    const ConstrainedMesh within = KeepWithin(drawn, this->Divide(drawn.View()));
    TriangleMesh mesh = within.View();
    std::vector<std::int32_t> regions;
    std::vector<unsigned char> frozen;
    for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
    {
      regions.push_back(mesh.Points.Get(mesh.Triangles.Get(t, 0), 0) > 20.0 ? -7 : 3);
      frozen.push_back(t % 40 == 0 ? 1 : 0);
    }
    for (const int what : { 1, 3, 2 })
    {
      mesh.Regions = what & 1 ? regions.data() : nullptr;
      mesh.FrozenTriangles = what & 2 ? frozen.data() : nullptr;
      const PartsResult together =
        FlipDivided(mesh, GiveToAny(mesh, this->Divide(mesh)), MakeCanonical());
      ExpectAsAlone(mesh, MakeCanonical(), together);
      const FlipReport alone = Flip(mesh, MakeCanonical()).Report;
      EXPECT_EQ(DescribeDefects(alone.Defects).substr(0, 30),
        DescribeDefects(together.Report.Defects).substr(0, 30)); // other ids follow
    }
  }
}

/// They count once, and leave no trace.
TEST_P(RankInsertionTest, OthersAreUnmatched)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(8); ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = seed % 2 == 0 ? Draw(200, 1000, seed) : Draw(30, 6, seed);
    const TriangleMesh all = drawn.View();
    for (const bool cut : { true, false })
    {
      const std::vector<OwnPiece> pieces = this->Divide(all, cut);
      const ConstrainedMesh within = KeepWithin(drawn, pieces);
      const FlipResult alone = Flip(within.View(), MakeCanonical());
      const PartsResult together = FlipDivided(all, GiveToAny(all, pieces), MakeCanonical());
      EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(together.Triangles));
      const PiecesReport& report = together.Report;
      const auto unmatched =
        static_cast<std::int64_t>(ToEdges(drawn.Ends).size() - ToEdges(within.Ends).size());
      EXPECT_EQ(unmatched, report.UnmatchedConstraints);
      EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
      EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
      EXPECT_EQ(unmatched, CountWithoutIds(report, LeavesPart));
      EXPECT_EQ(GetParam() == 1, unmatched == 0);
      // Also those that several ranks give; and ranks that lack an end do not know others.
      EXPECT_EQ(ToTriangleSet(alone.Triangles),
        ToTriangleSet(FlipDivided(all, pieces, MakeCanonical()).Triangles));
    }
  }
}

/// Which of two that cross is inserted depends on the ranks.
TEST_P(RankInsertionTest, ThatCrossOrOverlap)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(16); ++seed)
  {
    SCOPED_TRACE(seed);
    const bool overlaps = seed % 2 == 0;
    const ConstrainedMesh drawn =
      overlaps ? DrawOverlapping(30, seed / 2) : DrawCase(100, 40, 40, seed);
    const TriangleMesh mesh = drawn.View();
    const std::vector<OwnPiece> pieces = GiveToAny(mesh, this->Divide(mesh));
    const PartsResult together = FlipDivided(mesh, pieces, MakeCanonical());
    const PiecesReport& report = together.Report;
    const FlipReport alone = Flip(mesh, MakeCanonical()).Report;
    // Ranks may refuse others of those that cross; edges that are refused count beside what is
    // missing.
    const auto missing =
      static_cast<std::int64_t>(FindMissingConstraints(mesh, ThreadBackend(1)).First.size());
    for (const std::int64_t tried : { alone.InsertedConstraints + alone.UnmatchedConstraints,
           report.InsertedConstraints + report.UnmatchedConstraints })
    {
      EXPECT_LE(missing, tried);
    }
    EXPECT_GE(missing, report.InsertedConstraints);
    ExpectSameTopology(mesh.Triangles, together.Triangles, report);
    EXPECT_EQ(together.Triangles, FlipDivided(mesh, pieces, MakeCanonical()).Triangles);
    if (!overlaps)
    {
      const TriangleMesh after = WithTriangles(mesh, together.Triangles);
      EXPECT_EQ(0, report.NonDelaunayAfter);
      EXPECT_EQ(SumAreas(mesh), SumAreas(after));
      const std::vector<VertexPair> held = FindHeldPieces(mesh, together.Triangles);
      EXPECT_LE(report.Edges.Constraint, static_cast<std::int64_t>(held.size()));
      ExpectConstrainedDelaunay(after, held);
    }
  }
}

/// A flip for a constraint could make an edge that another rank has.
TEST_P(RankInsertionTest, NoneBesideATriangleWithoutArea)
{
  for (std::uint32_t seed = 0; seed < CountSeeds(4); ++seed)
  {
    SCOPED_TRACE(seed);
    ConstrainedMesh drawn = Draw(60, 20, seed);
    const double y = seed == 0 ? std::numeric_limits<double>::infinity() : 42;
    drawn.Mesh.Points.insert(drawn.Mesh.Points.end(), { 40, 40, 0, 40, 41, 0, 40, y, 0 });
    const auto last = static_cast<std::int32_t>(drawn.Mesh.NumberOfPoints());
    drawn.Mesh.Triangles.insert(drawn.Mesh.Triangles.end(), { last - 3, last - 2, last - 1 });
    const FlipOptions options =
      With(&FlipOptions::Geometry, GeometryKind::PlanarXY, MakeCanonical());
    TriangleMesh mesh = drawn.View();
    const PartsResult result = FlipDivided(mesh, GiveToAny(mesh, this->Divide(mesh)), options);
    mesh.ConstraintsToInsert = GetParam() == 1 ? mesh.ConstraintsToInsert : nullptr;
    const FlipResult alone = Flip(mesh, options);
    EXPECT_EQ(ToTriangleSet(alone.Triangles), ToTriangleSet(result.Triangles));
    const PiecesReport& report = result.Report;
    EXPECT_EQ(alone.Report.InsertedConstraints, report.InsertedConstraints);
    EXPECT_EQ(alone.Report.Edges.Constraint, report.Edges.Constraint);
    if (GetParam() > 1)
    {
      EXPECT_LT(0, CountWithoutIds(report, NeedsGuard));
      EXPECT_EQ(report.UnmatchedConstraints,
        CountWithoutIds(report, NeedsGuard) + CountWithoutIds(report, LeavesPart));
    }
  }
}

TEST_P(RankInsertionTest, NoneOnASurface)
{
  ConstrainedMesh sphere;
  sphere.Mesh = MakeBadSphere(20, 10, 3);
  sphere.Add(5, 90);
  sphere.Add(7, 120);
  sphere.Add(sphere.Mesh.Triangles[0], sphere.Mesh.Triangles[1]);
  const TriangleMesh mesh = sphere.View();
  const PartsResult together =
    FlipDivided(mesh, GiveToAny(mesh, this->Divide(mesh)), OnSurfaceOfRanks());
  const FlipReport alone = Flip(mesh, OnSurfaceOfRanks()).Report;
  ExpectSameCounts(alone, together.Report);
  EXPECT_EQ(0, alone.ConstraintFlips);
  EXPECT_EQ(2, together.Report.UnmatchedConstraints);
  EXPECT_EQ(2, CountDefect(alone, "cannot be inserted on a surface"));
  EXPECT_EQ(2, CountWithoutIds(together.Report, "cannot be inserted on a surface"));
  EXPECT_EQ(1, together.Report.Edges.Constraint);
}

TEST_P(RankInsertionTest, AllStopIfOneDoes)
{
  const ConstrainedMesh drawn = Draw(200, 1000, 5);
  const TriangleMesh mesh = drawn.View();
  const std::vector<OwnPiece> pieces = this->Divide(mesh);
  for (const double limit : { -1.0, 0.1, 0.19, 0.22, 0.3, 0.7, GetParam() > 1 ? 0.85 : 0.7 })
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
          if (stops) // only in the last rank's thread
          {
            stopped = std::min(stopped, share);
          }
          return !stops;
        };
        reports[rank] = FlipPiece(pieces[rank].View(), MakeCanonical(), group, flipped, progress);
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

INSTANTIATE_TEST_SUITE_P(
  Pieces, RankInsertionTest, testing::Values(1, 2, 3, 7), testing::PrintToStringParamName());

}
}
