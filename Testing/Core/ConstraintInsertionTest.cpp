// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "PointTestSupport.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace delaunayflip
{
namespace
{

constexpr const char* Crosses = "because they cross edges that stay";
constexpr const char* Leaves = "because they leave the mesh";
constexpr const char* Overlaps = "where triangles overlap or points coincide";

/// The mesh right after the insertion.
FlipResult Insert(const TriangleMesh& mesh, const FlipOptions& options = {})
{
  return Flip(mesh, With(&FlipOptions::MaximumIterations, 0, options));
}

std::int64_t CountRefused(const FlipReport& report)
{
  return CountDefect(report, Crosses) + CountDefect(report, Leaves) + CountDefect(report, Overlaps);
}

/// Nothing but edges has changed: counts, area, and the way that every triangle turns.
void ExpectSameDomain(const TriangleMesh& mesh, const FlipResult& result)
{
  ExpectSameTopology(mesh.Triangles, result.Triangles, result.Report);
  const TriangleMesh after = WithTriangles(mesh, result.Triangles);
  EXPECT_EQ(SumAreas(mesh), SumAreas(after));
  EXPECT_EQ(CountTurns(mesh).Left, CountTurns(after).Left);
  EXPECT_EQ(CountTurns(mesh).Right, CountTurns(after).Right);
}

void ExpectAsPredicted(const TriangleMesh& mesh, const FlipOptions& options = {})
{
  const ExpectedInsertion expected = PredictInsertion(mesh);
  const FlipResult inserted = Insert(mesh, options);
  const FlipResult result = Flip(mesh, options);
  for (const FlipResult* one : { &inserted, &result })
  {
    ExpectSameDomain(mesh, *one);
    ExpectEdges(one->Triangles, expected.Pieces);
    EXPECT_EQ(expected.Inserted, one->Report.InsertedConstraints);
    EXPECT_EQ(expected.Refused, one->Report.UnmatchedConstraints);
    EXPECT_EQ(expected.Refused, CountRefused(one->Report));
    EXPECT_EQ(inserted.Report.ConstraintFlips, one->Report.ConstraintFlips);
    ExpectConsistentStatistics(one->Report);
  }
  EXPECT_EQ(0, inserted.Report.TotalFlips);
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  ExpectConstrainedDelaunay(WithTriangles(mesh, result.Triangles), expected.Pieces);
}

}

TEST(ConstraintInsertion, OfRandomConstraints)
{
  for (std::uint32_t seed = 0; seed < 300 / Reduction; ++seed)
  {
    SCOPED_TRACE(seed);
    ExpectAsPredicted(DrawCase(8 + seed % 20, 6, 12, seed).View());
    if (seed % 15 == 0)
    {
      ExpectAsPredicted(DrawCase(150, 1000, 60, seed).View());
      ConstrainedMesh drawn = DrawCase(40, 12, 20, seed);
      ReverseTriangles(drawn.Mesh.Triangles);
      const ExpectedInsertion expected = PredictInsertion(drawn.View());
      const FlipResult result = Flip(drawn.View());
      ExpectSameDomain(drawn.View(), result);
      ExpectEdges(result.Triangles, expected.Pieces);
      EXPECT_EQ(expected.Inserted, result.Report.InsertedConstraints);
    }
  }
}

TEST(ConstraintInsertion, TrianglesDoNotChooseWhatIsRefused)
{
  const FlipOptions options = With(&FlipOptions::TieRule, TieRuleKind::Canonical);
  for (std::uint32_t seed = 0; seed < 20 / Reduction; ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DrawCase(60, 200, 60, seed);
    const std::vector<std::int32_t> others = Flip(drawn.Mesh.View()).Triangles;
    const FlipResult one = Flip(drawn.View(), options);
    const FlipResult other = Flip(WithTriangles(drawn.View(), others), options);
    EXPECT_LT(0, one.Report.UnmatchedConstraints);
    EXPECT_EQ(one.Report.UnmatchedConstraints, other.Report.UnmatchedConstraints);
    EXPECT_TRUE(ToTriangleSet(one.Triangles) == ToTriangleSet(other.Triangles));
  }
}

TEST(ConstraintInsertion, GivesCgalsConstrainedDelaunayMesh)
{
  for (std::uint32_t seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const ConstrainedMesh drawn =
      DropCrossing(Constrain(MakeRandomBadMeshDouble(1000 / Reduction, seed), 60, random));
    const FlipResult result = Flip(drawn.View());
    EXPECT_EQ(0, result.Report.UnmatchedConstraints);
    EXPECT_LT(5, result.Report.InsertedConstraints);
    EXPECT_TRUE(MakeCgalConstrainedDelaunay(drawn.View()) == ToTriangleSet(result.Triangles));
  }
}

namespace
{

/// A mesh of triangles with their middle at whole coordinates, without the stars of some points.
ConstrainedMesh DrawCaseWithHoles(std::uint32_t seed)
{
  ConstrainedMesh drawn = DrawCase(60, 30, 30, seed);
  for (double& x : drawn.Mesh.Points)
  {
    x *= 3.0;
  }
  std::vector<std::int32_t> kept;
  const std::vector<std::int32_t>& all = drawn.Mesh.Triangles;
  for (std::size_t i = 0; i < all.size(); i += 3)
  {
    if (all[i] % 15 != 0 && all[i + 1] % 15 != 0 && all[i + 2] % 15 != 0)
    {
      kept.insert(kept.end(), &all[i], &all[i] + 3);
    }
  }
  drawn.Mesh.Triangles = kept;
  return drawn;
}

/// Whether the middle of a triangle lies in the mesh.
bool IsInDomain(const TriangleMesh& mesh, const std::array<std::int64_t, 3>& triangle)
{
  const auto getPoint = [&](std::int64_t id) -> Point3 {
    return { mesh.Points.Get(id, 0), mesh.Points.Get(id, 1), 0.0 };
  };
  Point3 middle{};
  for (const std::int64_t id : triangle)
  {
    middle[0] += getPoint(id)[0] / 3.0;
    middle[1] += getPoint(id)[1] / 3.0;
  }
  bool isIn = false;
  for (std::int64_t t = 0; t < mesh.Triangles.Count && !isIn; ++t)
  {
    isIn = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      isIn = isIn &&
        RationalTurn(getPoint(mesh.Triangles.Get(t, slot)),
          getPoint(mesh.Triangles.Get(t, (slot + 1) % 3)), middle) >= 0;
    }
  }
  return isIn;
}

/// CGAL's constrained Delaunay triangles in the domain of a mesh. Its rim constrains, too.
std::vector<std::int32_t> MakeReferenceInDomain(const TriangleMesh& mesh, ConstrainedMesh accepted)
{
  const OppositeMap sides = FindOpposites(mesh.Triangles);
  for (const auto& [side, opposite] : sides)
  {
    if (sides.count({ side.second, side.first }) == 0)
    {
      accepted.Add(side.first, side.second);
    }
  }
  TriangleSet triangles;
  const TriangleSet all = MakeCgalConstrainedDelaunay(accepted.View());
  std::copy_if(all.begin(), all.end(), std::back_inserter(triangles),
    [&](const auto& triangle) { return IsInDomain(mesh, triangle); });
  return ToIds(triangles);
}

}

TEST(ConstraintInsertion, GivesCgalsMeshInADomainWithHoles)
{
  const FlipOptions options = With(&FlipOptions::TieRule, TieRuleKind::Canonical);
  std::int64_t inserted = 0;
  std::int64_t left = 0;
  for (std::uint32_t seed = 0; seed < 30 / Reduction; ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DrawCaseWithHoles(seed);
    const TriangleMesh mesh = drawn.View();
    const FlipResult result = Flip(mesh, options);
    ExpectSameDomain(mesh, result);
    inserted += result.Report.InsertedConstraints;
    left += CountDefect(result.Report, Leaves);
    ConstrainedMesh accepted;
    accepted.Mesh = drawn.Mesh;
    for (const auto& [from, to] : FindHeldPieces(mesh, result.Triangles))
    {
      accepted.Add(from, to);
    }
    const std::vector<std::int32_t> reference = MakeReferenceInDomain(mesh, accepted);
    const FlipResult canonical = Flip(WithTriangles(accepted.View(), reference), options);
    EXPECT_TRUE(ToTriangleSet(canonical.Triangles) == ToTriangleSet(result.Triangles));
  }
  EXPECT_LT(0, inserted);
  EXPECT_LT(0, left);
}

TEST(ConstraintInsertion, AlongAndAcrossALattice)
{
  constexpr std::int32_t Size = 24;
  ConstrainedMesh lattice;
  lattice.Mesh = MakeGridMesh(Size, Size);
  const auto point = [](std::int64_t x, std::int64_t y) { return y * (Size + 1) + x; };
  lattice.Add(point(0, 12), point(Size, 12)); // along edges
  lattice.Add(point(0, 0), point(Size, Size)); // along one kind of diagonal
  lattice.Add(point(0, Size), point(12, 12)); // across the other
  lattice.Add(point(13, 0), point(Size, 11)); // and again
  lattice.Add(point(1, 0), point(Size, 10)); // meets no vertex
  lattice.Add(point(0, 13), point(23, Size)); // meets no vertex
  lattice.Add(point(0, 1), point(21, 4)); // meets every seventh
  lattice.Add(point(12, Size), point(14, 0)); // crosses some of them
  ExpectAsPredicted(lattice.View());
}

TEST(ConstraintInsertion, OfTheSecondOfTwoThatCross)
{
  ConstrainedMesh square{ MakeGridMesh(1, 1), {}, {} };
  square.Add(1, 2);
  square.Add(3, 0); // an edge of the given triangles, which does not matter
  square.Add(2, 1);
  const FlipResult result = Flip(square.View());
  EXPECT_TRUE(HasEdge(result.Triangles, 1, 2));
  EXPECT_EQ(1, result.Report.Edges.Constraint);
  EXPECT_EQ(1, result.Report.UnmatchedConstraints);
  EXPECT_EQ(1, result.Report.InsertedConstraints);
  EXPECT_EQ(1, CountDefect(result.Report, Crosses));
  EXPECT_EQ("1 constraint edge that cannot be inserted because it crosses edges that stay (first: "
            "3-0 crosses constraint 0 (points 1 and 2))",
    DescribeDefects(result.Report.Defects));
  ConstrainedMesh kept{ MakeGridMesh(1, 1), {}, {} };
  kept.Add(1, 2);
  kept.Add(0, 3, false); // an edge that is kept, and crossed
  EXPECT_NE(std::string::npos,
    DescribeDefects(Flip(kept.View()).Report.Defects)
      .find("1-2 crosses constraint 1 (points 0 and "));
}

TEST(ConstraintInsertion, OnlyOfFlaggedConstraints)
{
  ConstrainedMesh square{ MakeGridMesh(1, 1), {}, {} };
  square.Add(1, 2, false);
  FlipResult result = Flip(square.View());
  EXPECT_TRUE(HasEdge(result.Triangles, 0, 3));
  EXPECT_EQ(1, result.Report.UnmatchedConstraints);
  EXPECT_EQ(0, result.Report.ConstraintFlips);
  square.Add(2, 1);
  result = Flip(square.View());
  EXPECT_TRUE(HasEdge(result.Triangles, 1, 2));
  EXPECT_EQ(0, result.Report.UnmatchedConstraints);
  EXPECT_EQ(1, result.Report.InsertedConstraints);
  EXPECT_EQ(1, result.Report.ConstraintFlips);
  EXPECT_EQ(1, result.Report.Edges.Constraint);
  EXPECT_EQ((std::vector<std::int32_t>{ 1, 1 }), result.FlipCounts);
}

TEST(ConstraintInsertion, LeavesAloneWhatLeavesTheMesh)
{
  // A lattice with a hole in its middle and one unused point.
  ConstrainedMesh ring;
  ring.Mesh = MakeGridMesh(3, 3);
  ring.Mesh.Triangles.erase(
    ring.Mesh.Triangles.begin() + 3 * 8, ring.Mesh.Triangles.begin() + 3 * 10);
  ring.Mesh.Points.insert(ring.Mesh.Points.end(), { 0.5, 0.25, 0.0 });
  ring.Add(0, 15); // through corners of the hole
  ring.Add(1, 10); // over its side
  ring.Add(4, 16); // to the unused point
  ring.Add(9, 6); // the hole's other diagonal
  ring.Add(0, 7); // possible
  const FlipResult result = Flip(ring.View());
  EXPECT_EQ(4, CountDefect(result.Report, Leaves));
  EXPECT_EQ(1, result.Report.InsertedConstraints);
  ExpectEdges(result.Triangles, SplitAtVertices(ring.View(), 0, 7));
  ExpectSameDomain(ring.View(), result);
}

TEST(ConstraintInsertion, StopsAtRegionsAndFrozenTriangles)
{
  ConstrainedMesh strip;
  strip.Mesh = MakeGridMesh(4, 1);
  strip.Add(0, 8);
  TriangleMesh mesh = strip.View();
  const std::vector<std::int32_t> regions = { 0, 0, 0, 0, 1, 1, 1, 1 };
  mesh.Regions = regions.data();
  EXPECT_NE(std::string::npos,
    DescribeDefects(Flip(mesh).Report.Defects).find("(first: 0-8 crosses the edge of points "));
  mesh = strip.View();
  const std::vector<unsigned char> frozen = { 0, 0, 0, 1, 0, 0, 0, 0 };
  mesh.FrozenTriangles = frozen.data();
  const FlipResult result = Flip(mesh);
  EXPECT_EQ(1, CountDefect(result.Report, Crosses));
  EXPECT_TRUE(std::equal(&result.Triangles[9], &result.Triangles[12], &strip.Mesh.Triangles[9]));
  EXPECT_EQ(1, Flip(strip.View()).Report.InsertedConstraints);
}

TEST(ConstraintInsertion, FlipsTrianglesWithoutAreaOutOfTheWay)
{
  // Points 4 to 6 lie on the line 0-2, which has no triangle with area at all of them on one side.
  ConstrainedMesh bar;
  bar.Mesh.Points = { 0, 0, 0, 4, -4, 0, 8, 0, 0, 4, 4, 0, 2, 0, 0, 4, 0, 0, 6, 0, 0 };
  bar.Mesh.Triangles = { 0, 1, 2, 0, 2, 4, 4, 2, 5, 5, 2, 6, 0, 4, 3, 4, 5, 3, 5, 6, 3, 6, 2, 3 };
  bar.Add(1, 5);
  ExpectSameTopology(
    bar.Mesh.View().Triangles, Insert(bar.View()).Triangles, Insert(bar.View()).Report);
  const FlipResult result = Insert(bar.View());
  EXPECT_TRUE(HasEdge(result.Triangles, 1, 5));
  EXPECT_EQ(1, result.Report.InsertedConstraints);
  bar.Add(1, 3);
  const FlipResult longer = Insert(bar.View());
  ExpectEdges(longer.Triangles, { { 1, 5 }, { 5, 3 } });
  EXPECT_EQ(SumAreas(bar.Mesh.View()), SumAreas(WithTriangles(bar.View(), longer.Triangles)));
}

TEST(ConstraintInsertion, KeepsOverlapsWhatTheyAre)
{
  // Random triangles through each other: constraints may fail, but topology must stay.
  for (std::uint32_t seed = 0; seed < 200 / Reduction; ++seed)
  {
    SCOPED_TRACE(seed);
    const ConstrainedMesh drawn = DrawOverlapping(40, seed);
    const FlipResult inserted = Insert(drawn.View());
    ExpectSameTopology(drawn.View().Triangles, inserted.Triangles, inserted.Report);
    EXPECT_EQ(SumAreas(drawn.View()), SumAreas(WithTriangles(drawn.View(), inserted.Triangles)));
    const FlipResult result = Flip(drawn.View());
    ExpectSameTopology(drawn.View().Triangles, result.Triangles, result.Report);
    EXPECT_EQ(result.Report.UnmatchedConstraints, CountRefused(result.Report));
  }
}

TEST(ConstraintInsertion, SaysWhereTrianglesOverlap)
{
  // Two lattices at the same place; constraints from one to the other, and within one.
  ConstrainedMesh layers;
  layers.Mesh = MakeGridMesh(4, 4);
  Append(layers.Mesh, MakeGridMesh(4, 4));
  layers.Add(0, 25 + 11);
  layers.Add(6, 25 + 6);
  layers.Add(25, 25 + 11);
  const FlipResult result = Flip(layers.View());
  EXPECT_EQ(2, CountDefect(result.Report, Overlaps));
  EXPECT_EQ(1, result.Report.InsertedConstraints);

  // The triangle behind edge 1-2 is folded back over the one before it.
  ConstrainedMesh fold;
  fold.Mesh.Points = { 0, 0, 0, 2, -1, 0, 2, 1, 0, 1, 0.25, 0, 4, 0, 0, 5, -1, 0, 5, 1, 0 };
  fold.Mesh.Triangles = { 0, 1, 2, 2, 1, 3, 4, 5, 6 };
  fold.Add(0, 4);
  EXPECT_EQ(1, CountDefect(Flip(fold.View()).Report, Overlaps));
}

TEST(ConstraintInsertion, OfTerrainKeepsTheGeometryOfTheInput)
{
  // Gentle triangles until the constraint cuts the two heights from each other.
  ConstrainedMesh ridge;
  ridge.Mesh.Points = { -3, 0, 0, 0, -1.5, 2, 3, 0, 0, 0, 1.5, 2 };
  ridge.Mesh.Triangles = { 0, 1, 3, 1, 2, 3 };
  const FlipReport plain = Flip(ridge.Mesh.View()).Report;
  ridge.Add(0, 2);
  const FlipResult result = Flip(ridge.View());
  EXPECT_EQ(GeometryKind::PlanarXY, result.Report.GeometryUsed);
  EXPECT_EQ(plain.GeometryReason, result.Report.GeometryReason);
  EXPECT_TRUE(HasEdge(result.Triangles, 0, 2));
  EXPECT_EQ(GeometryKind::Surface,
    Flip(WithTriangles(ridge.Mesh.View(), result.Triangles)).Report.GeometryUsed);
}

TEST(ConstraintInsertion, FixedEdgesHoldThePieces)
{
  const ConstrainedMesh drawn = DrawCase(60, 20, 20, 4);
  const std::set<VertexPair> fixed = ToEdges(FindFixedEdges(drawn.View(), {}));
  for (const VertexPair& piece : PredictInsertion(drawn.View()).Pieces)
  {
    const bool isFixed = fixed.count(Sorted(piece.first, piece.second)) == 1;
    const bool onRim = drawn.Mesh.Points[3 * piece.first] == drawn.Mesh.Points[3 * piece.second] ||
      drawn.Mesh.Points[3 * piece.first + 1] == drawn.Mesh.Points[3 * piece.second + 1];
    EXPECT_TRUE(isFixed || onRim) << piece.first << "-" << piece.second;
  }
}

TEST(ConstraintInsertion, DoesNotDependOnThreads)
{
  std::mt19937 random(8);
  const ConstrainedMesh drawn =
    Constrain(MakeRandomBadMeshDouble(20000 / Reduction, 8), 200, random);
  const FlipResult expected = Flip(drawn.View(), WithThreads(1));
  EXPECT_LT(0, expected.Report.InsertedConstraints);
  ExpectSameResult(expected, Flip(drawn.View(), WithThreads(3)));
}

TEST(ConstraintInsertion, CanBeAborted)
{
  const ConstrainedMesh drawn = DrawCase(100, 50, 30, 9);
  const FlipResult expected = Flip(drawn.View());
  EXPECT_LT(0, expected.Report.ConstraintFlips);
  EXPECT_EQ(
    expected.Report.ConstraintFlips + expected.Report.TotalFlips, SumFlips(expected.FlipCounts));
  std::vector<double> told;
  FlipSession(drawn.View(), OnTestBackend({}),
    [&](double share)
    {
      told.push_back(share);
      return true;
    });
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  for (std::size_t last = 0; last < told.size(); ++last)
  {
    std::size_t calls = 0;
    FlipSession session(drawn.View(), OnTestBackend({}), [&](double) { return calls++ < last; });
    EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason) << last;
    EXPECT_EQ(0, session.GetReport().ConstraintFlips);
    EXPECT_TRUE(drawn.Mesh.Triangles == StoreTriangles(session));
    session.Advance();
    EXPECT_TRUE(expected.Triangles == StoreTriangles(session));
  }
}

//------------------------------------------------------------------------------
// Real drawings. DELAUNAYFLIP_DATA_DIR names the folder that has them in pslg/.

namespace
{

using Row = std::vector<double>;

/// The numbers of the lines that begin with some, or of the innermost lists of JSON.
std::vector<Row> ReadRows(const std::filesystem::path& path)
{
  std::ifstream file(path);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line, path.extension() == ".json" ? ']' : '\n');)
  {
    std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '[' || c == ','; }, ' ');
    std::istringstream text(line.substr(0, line.find('#')));
    const Row row{ std::istream_iterator<double>(text), {} };
    if (!row.empty())
    {
      rows.push_back(row);
    }
  }
  return rows;
}

/// A swept mesh of the points, of which equal ones become one, and the segments between them.
ConstrainedMesh MakeDrawing(const Places& points, const std::vector<VertexPair>& segments)
{
  std::map<std::array<double, 2>, std::int64_t> numbers;
  Places distinct;
  std::vector<std::int64_t> numberOf;
  for (const std::array<double, 2>& point : points)
  {
    const auto [place, isNew] = numbers.emplace(point, distinct.size());
    if (isNew)
    {
      distinct.push_back(point);
    }
    numberOf.push_back(place->second);
  }
  ConstrainedMesh drawing{ MakeSweptMesh(distinct), {}, {} };
  for (const auto& [from, to] : segments)
  {
    if (numberOf.at(from) != numberOf.at(to))
    {
      drawing.Add(numberOf[from], numberOf[to]);
    }
  }
  return drawing;
}

/// Reads Triangle's .poly (and the .node beside it) and .node, CDT's .txt, poly2tri's .dat, the
/// closed polygon of its points, and Delaunator's .json, points alone.
ConstrainedMesh ReadDrawing(const std::filesystem::path& path)
{
  std::vector<Row> rows = ReadRows(path);
  const std::string kind = path.extension().string();
  const bool isPoly = kind == ".poly", isPolygon = kind == ".dat";
  const std::size_t header = isPolygon || kind == ".json" ? 0 : 1; // lines before the points
  std::size_t count = header == 0 ? rows.size() : static_cast<std::size_t>(rows.at(0).at(0));
  if (isPoly && count == 0)
  {
    std::vector<Row> nodes = ReadRows(std::filesystem::path(path).replace_extension(".node"));
    count = static_cast<std::size_t>(nodes.at(0).at(0));
    nodes.resize(1 + count);
    rows.erase(rows.begin());
    rows.insert(rows.begin(), nodes.begin(), nodes.end());
  }
  const std::size_t skipped = isPoly || kind == ".node" ? 1 : 0; // numbers of the line itself
  Places points;
  for (std::size_t i = header; i < header + count; ++i)
  {
    points.push_back({ rows.at(i).at(skipped), rows.at(i).at(skipped + 1) });
  }
  std::vector<VertexPair> segments;
  for (std::size_t i = 0; isPolygon && i < count; ++i)
  {
    segments.emplace_back(i, (i + 1) % count);
  }
  if (isPoly || kind == ".txt")
  {
    const std::size_t first = header + count + skipped; // line of a segment
    const double all = isPoly ? rows.at(first - 1).at(0) : rows[0].at(1);
    const auto base = isPoly ? static_cast<std::int64_t>(rows[1][0]) : 0;
    for (std::size_t i = first; i < first + static_cast<std::size_t>(all); ++i)
    {
      segments.emplace_back(static_cast<std::int64_t>(rows.at(i).at(skipped)) - base,
        static_cast<std::int64_t>(rows.at(i).at(skipped + 1)) - base);
    }
  }
  return MakeDrawing(points, segments);
}

}

TEST(Pslg, GivesCgalsConstrainedDelaunayMesh)
{
  const char* folder = Reduction == 1 ? std::getenv("DELAUNAYFLIP_DATA_DIR") : nullptr;
  std::error_code error;
  const FlipOptions options = InPlane(TieRuleKind::Canonical);
  std::int64_t inserted = 0;
  for (const auto& file :
    std::filesystem::directory_iterator(std::string(folder ? folder : "") + "/pslg", error))
  {
    SCOPED_TRACE(file.path());
    ConstrainedMesh drawing = ReadDrawing(file.path());
    const FlipResult result = Flip(drawing.View(), options);
    ExpectSameTopology(drawing.View().Triangles, result.Triangles, result.Report);
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    if (result.Report.UnmatchedConstraints > 0)
    {
      // Some cross earlier ones, which CGAL refuses. All pairs of pieces are looked at.
      ASSERT_GT(500, drawing.Mesh.NumberOfPoints());
      const ExpectedInsertion expected = PredictInsertion(drawing.View());
      EXPECT_EQ(expected.Refused, result.Report.UnmatchedConstraints);
      drawing = { drawing.Mesh, {}, {} };
      for (const auto& [from, to] : expected.Pieces)
      {
        drawing.Add(from, to);
      }
    }
    // CGAL's, with ties as the canonical rule decides them.
    const std::vector<std::int32_t> reference = ToIds(MakeCgalConstrainedDelaunay(drawing.View()));
    const FlipResult canonical = Flip(WithTriangles(drawing.View(), reference), options);
    EXPECT_TRUE(ToTriangleSet(canonical.Triangles) == ToTriangleSet(result.Triangles));
    const TriangleMesh pieces = drawing.View();
    PointInput points;
    points.Points = PlaneArray(pieces.Points.Doubles, pieces.Points.Count, 3);
    points.Segments = pieces.ConstraintEdges;
    points.NumberOfSegments = pieces.NumberOfConstraintEdges;
    EXPECT_TRUE(ToTriangleSet(Triangulate(points).Triangles) == ToTriangleSet(result.Triangles));
    inserted += result.Report.InsertedConstraints;
  }
  if (error)
  {
    GTEST_SKIP() << "no drawings: DELAUNAYFLIP_DATA_DIR has no folder pslg";
  }
  EXPECT_LT(1000, inserted);
}

}
