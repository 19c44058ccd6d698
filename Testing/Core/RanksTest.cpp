// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "MeshAudit.h"
#include "PartSurvey.h"
#include "PartTestSupport.h"
#include "PieceGroup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

/// @file
/// What only ranks have: points that they share, uneven parts, messages, failures, and options that
/// must be the same.

namespace delaunayflip
{
namespace
{

/// The parameter is the number of ranks.
class RanksTest : public testing::TestWithParam<int>
{
protected:
  std::vector<OwnPiece> Cut(const OwnedMesh<double>& mesh) const
  {
    return DivideMesh(mesh.View(), GetParam());
  }
};

/// One rank has all triangles, or none.
TEST_P(RanksTest, UnevenParts)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 28);
  const Owners all(mesh.NumberOfTriangles(), GetParam() - 1);
  const PartsResult result =
    FlipDivided(mesh.View(), DivideMesh(mesh.View(), all, GetParam()), MakeCanonical());
  ExpectAsAlone(mesh.View(), MakeCanonical(), result);
  EXPECT_EQ(1, result.Report.Rounds);
  EXPECT_EQ(mesh.NumberOfTriangles(), result.Sizes.back());
  Owners owners = DivideBySpace(mesh.View(), GetParam());
  std::replace(owners.begin(), owners.end(), 1, 0);
  const PartsResult without =
    FlipDivided(mesh.View(), DivideMesh(mesh.View(), owners, GetParam()), MakeCanonical());
  ExpectAsAlone(mesh.View(), MakeCanonical(), without);
  EXPECT_EQ(GetParam() > 2, without.Report.SeamEdges > 0);
}

/// Two ranks have a triangle on the same three points: sharp edges, as for one process.
TEST_P(RanksTest, CountEdgesOfRepeatedTriangles)
{
  OwnedMesh<double> mesh = MakeBadSphere(12, 8, 3);
  const auto first = static_cast<std::int32_t>(mesh.NumberOfPoints());
  mesh.Points.insert(mesh.Points.end(), { 5, 5, 5, 6, 5, 5, 5, 6, 5 });
  mesh.Triangles.insert(
    mesh.Triangles.end(), { first, first + 1, first + 2, first + 1, first, first + 2 });
  Owners owners = DivideBySpace(mesh.View(), GetParam());
  owners.back() = GetParam() - 1;
  owners[owners.size() - 2] = 0;
  const FlipOptions options = OnSurfaceOfRanks(60.0);
  const FlipReport alone = Flip(mesh.View(), options).Report;
  EXPECT_LE(3, alone.Edges.Feature);
  ExpectSameCounts(
    alone, FlipDivided(mesh.View(), DivideMesh(mesh.View(), owners, GetParam()), options).Report);
}

/// Triangles that name a point twice have no edges, also between ranks.
TEST_P(RanksTest, PairEdgesBesideTrianglesWithRepeatedIds)
{
  const OwnedMesh<double> clean = MakeRandomBadMeshDouble(500, 29);
  OwnedMesh<double> mesh = clean;
  Owners owners = DivideBySpace(clean.View(), GetParam());
  for (std::size_t i = 0; i < clean.Triangles.size(); i += 3)
  {
    const std::int32_t a = clean.Triangles[i], b = clean.Triangles[i + 1];
    mesh.Triangles.insert(mesh.Triangles.end(), { b, a, b });
    owners.push_back(static_cast<std::int32_t>(i / 3) % GetParam());
  }
  const PartsResult result =
    FlipDivided(mesh.View(), DivideMesh(mesh.View(), owners, GetParam()), MakeCanonical());
  ExpectAsAlone(mesh.View(), MakeCanonical(), result);
  EXPECT_EQ(0, result.Report.Edges.NonManifold);
  ExpectSameCounts(Flip(mesh.View(), MakeCanonical()).Report, result.Report);
}

TEST(RanksWithoutNumbers, KeepPointsApartThatCoincideOnOneRank)
{
  // A slit from (0, 0) to (1, 0), along which the left piece has two points at the same place.
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0, 0, 0, 0.5, -1, 0, 2, 0.1, 0 };
  const std::vector<std::int32_t> triangles[] = { { 0, 1, 2, 3, 4, 1, 1, 5, 2 },
    { 0, 1, 2, 3, 4, 1, 0, 2, 5 } };
  for (const int i : { 0, 1 })
  {
    mesh.Triangles = triangles[i];
    const std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), { 0, 0, 1 }, 2);
    const PiecesReport report = FlipDivided(mesh.View(), pieces, MakeCanonical(), false).Report;
    EXPECT_EQ(i == 0 ? 0 : 3, report.AmbiguousPoints); // first the other rank has neither
  }
}

/// Two ranks have a closed surface each, at the same places. Nothing says that the points are the
/// same.
TEST(RanksWithoutNumbers, KeepClosedTwinsApart)
{
  OwnedMesh<double> mesh = MakeBadSphere(12, 8, 3);
  const FlipReport alone = Flip(mesh.View(), OnSurfaceOfRanks()).Report;
  Owners owners(mesh.NumberOfTriangles());
  owners.resize(2 * owners.size(), 1);
  Append(mesh, OwnedMesh<double>(mesh));
  const std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), owners, 2);
  const PiecesReport report = FlipDivided(mesh.View(), pieces, OnSurfaceOfRanks(), false).Report;
  EXPECT_EQ(2 * alone.TotalFlips, report.TotalFlips);
  EXPECT_EQ(0, report.SeamEdges);
}

/// Seen from above. Both ranks of a seam must still find the same halves of its edges.
TEST_P(RanksTest, MayDisagreeAboutHeights)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(500, 17);
  std::vector<OwnPiece> pieces = this->Cut(mesh);
  std::mt19937 random(4);
  for (OwnPiece& piece : pieces)
  {
    for (std::size_t i = 2; i < piece.Doubles.size(); i += 3)
    {
      piece.Doubles[i] = DrawIndex(random, 1000);
    }
  }
  const FlipOptions options = With(&FlipOptions::Geometry, GeometryKind::PlanarXY, MakeCanonical());
  const PiecesReport report = FlipDivided(mesh.View(), pieces, options).Report;
  EXPECT_EQ(StopReasonKind::Converged, report.StopReason);
  EXPECT_EQ(Flip(mesh.View(), options).Report.NonDelaunayBefore, report.NonDelaunayBefore);
  EXPECT_EQ(0, report.NonDelaunayAfter);
}

TEST_P(RanksTest, DecideAboutTheGeometryTogether)
{
  // Each half lies in a plane of its own.
  const OwnedMesh<double> mesh =
    Lift(MakeGridMesh(8, 4), [](double x, double) { return 3 * std::fabs(x - 4); });
  FlipOptions options = OnSurfaceOfRanks();
  options.Geometry = GeometryKind::Auto;
  EXPECT_EQ(GeometryKind::PlanarXY, FindGeometry(mesh.View(), options));
  EXPECT_EQ(
    GeometryKind::PlanarXY, FlipDivided(mesh.View(), this->Cut(mesh), options).Report.GeometryUsed);
  options.Geometry = GeometryKind::Planar;
  EXPECT_THROW(FlipDivided(mesh.View(), this->Cut(mesh), options), InvalidOptions);
}

/// Flips a small mesh. @returns the message that all ranks give.
/// @param change changes the options and the piece of the last rank.
std::string FindError(int ranks, const std::function<void(FlipOptions&, OwnPiece&)>& change)
{
  std::vector<OwnPiece> pieces = DivideMesh(MakeRandomBadMeshDouble(50, 17).View(), ranks);
  FlipOptions different = MakeCanonical();
  change(different, pieces.back());
  std::vector<std::string> errors(ranks);
  RunInThreads(ranks,
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      FlippedPiece flipped;
      errors[rank] = GetMessage<FlipError>(
        [&]
        {
          FlipPiece(
            pieces[rank].View(), rank + 1 == ranks ? different : MakeCanonical(), group, flipped);
        });
    });
  EXPECT_EQ(ranks, std::count(errors.begin(), errors.end(), errors.front()));
  return errors.front();
}

TEST_P(RanksTest, AllFailIfOneDoes)
{
  const std::string error =
    FindError(GetParam(), [](FlipOptions&, OwnPiece& piece) { piece.Triangles[4] = 77777; });
  EXPECT_EQ(
    0u, error.find("rank " + std::to_string(GetParam() - 1) + ": triangle 1 names point 77777"))
    << error;
}

TEST_P(RanksTest, NeedTheSameOptions)
{
  struct Difference
  {
    const char* Text;
    void (*Change)(FlipOptions&);
  };
  const Difference differences[] = {
    { "Geometry is 'auto' on rank 0, but 'surface'",
      [](FlipOptions& o)
      {
        o.Geometry = GeometryKind::Surface;
        o.Tolerance = 0.5; // the first difference counts
      } },
    { "FeatureAngle is '30' on rank 0, but '0.5'", [](FlipOptions& o) { o.FeatureAngle = 0.5; } },
    { "TrackQuality is 'off' on rank 0, but 'on'", [](FlipOptions& o) { o.TrackQuality = true; } },
  };
  const std::string end =
    " on rank " + std::to_string(GetParam() - 1) + "; set it to the same on all ranks";
  for (const Difference& one : differences)
  {
    EXPECT_EQ("rank 0: " + (one.Text + end),
      FindError(GetParam(), [&](FlipOptions& options, OwnPiece&) { one.Change(options); }));
  }
  EXPECT_EQ("",
    FindError(GetParam(),
      [](FlipOptions& options, OwnPiece&)
      {
        options.NumberOfThreads = 2;
        options.NumberOfPieces = 3; // ranks have one each
      }));
  RunInThreads(GetParam(),
    [&](PieceGroup& group)
    {
      const std::string value = group.GetRank() + 1 == GetParam() ? "b" : "a";
      EXPECT_THROW(RequireSameOptions({}, group, { { "Name", value } }), InvalidOptions);
    });
}

TEST(RunInThreads, NeedsARankAndATurnForEach)
{
  const auto nothing = [](PieceGroup&) {};
  EXPECT_THROW(RunInThreads(0, nothing), InvalidOptions);
  EXPECT_THROW(RunInThreads(2, nothing, { 0 }), InvalidOptions);
}

INSTANTIATE_TEST_SUITE_P(
  Pieces, RanksTest, testing::Values(2, 3, 7), testing::PrintToStringParamName());

/// They are not looked at.
TEST(RankWithTooManyPoints, IsAnError)
{
  const double x[3] = {};
  MeshPiece piece;
  piece.Mesh.Points = PointArray(x, std::int64_t(1) << 31);
  FlippedPiece flipped;
  EXPECT_THROW(FlipPiece(piece, {}, *MakeSingleGroup(), flipped), MeshTooLarge);
}

//------------------------------------------------------------------------------
// Whether stars are simple that are divided among ranks, so that flips need no guard.

/// Whether all ranks find that no guard is needed.
/// @param change changes the pieces before.
bool AreSimple(const OwnedMesh<double>& mesh, const Owners& owners, int ranks,
  const std::function<void(std::vector<OwnPiece>&)>& change = {})
{
  std::vector<OwnPiece> pieces = DivideMesh(mesh.View(), owners, ranks);
  if (change)
  {
    change(pieces);
  }
  const FlipOptions options = With(&FlipOptions::Geometry, GeometryKind::PlanarXY, MakeCanonical());
  std::vector<unsigned char> simple(ranks);
  RunInThreads(ranks,
    [&](PieceGroup& group)
    {
      const MeshPiece piece = pieces[group.GetRank()].View();
      const PointKeys keys = MatchPoints(piece, group);
      simple[group.GetRank()] = SurveyParts(piece, keys, options, group).NeedsGuard() ? 0 : 1;
    });
  EXPECT_EQ(ranks, std::count(simple.begin(), simple.end(), simple.front()));
  return simple.front() != 0;
}

/// Checks one rank, and three with triangle i on rank i % 3. Triangles may begin with any corner.
void ExpectSimple(bool expected, OwnedMesh<double> mesh)
{
  Owners owners;
  for (int t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    owners.push_back(t % 3);
    std::rotate(
      &mesh.Triangles[3 * t], &mesh.Triangles[3 * t] + t % 5 % 3, &mesh.Triangles[3 * t] + 3);
  }
  for (const bool clockwise : { false, true })
  {
    EXPECT_EQ(expected, AreSimple(mesh, Owners(owners.size()), 1)) << clockwise;
    EXPECT_EQ(expected, AreSimple(mesh, owners, 3)) << clockwise;
    ReverseTriangles(mesh.Triangles);
  }
}

TEST(StarCheck, SeesWhereStarsOverlap)
{
  for (int start = 0; start < 8; ++start)
  {
    for (int count = 1; count < 16; ++count)
    {
      SCOPED_TRACE(std::to_string(start) + " " + std::to_string(count));
      ExpectSimple(count <= 8, MakeFan(start, count));
    }
  }
  OwnedMesh<double> twice = MakeFan(0, 16); // and closed
  twice.Triangles.back() = 1;
  ExpectSimple(false, twice);
  ExpectSimple(true, MakeRandomBadMeshDouble(400, 3));
  OwnedMesh<double> mesh = MakeGridMesh(4, 4);
  ExpectSimple(true, mesh);
  std::swap(mesh.Triangles[9], mesh.Triangles[10]); // turned over
  ExpectSimple(false, mesh);
  std::swap(mesh.Triangles[9], mesh.Triangles[10]);
  mesh.Triangles.insert(mesh.Triangles.end(), { 0, 1, 2 }); // without area
  ExpectSimple(false, mesh);
}

TEST(StarCheck, SeesWhereFansMeetInAPoint)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0 };
  mesh.Triangles = { 0, 1, 2, 0, 3, 4 };
  EXPECT_TRUE(AreSimple(mesh, { 0, 1 }, 2));
  mesh.Points[10] = 0.0; // point 3 at (-1, 0): still apart
  EXPECT_TRUE(AreSimple(mesh, { 0, 1 }, 2));
  mesh.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, 1, 0.9, 0, -1, 1, 0 };
  EXPECT_FALSE(AreSimple(mesh, { 0, 0 }, 2));
  EXPECT_FALSE(AreSimple(mesh, { 0, 1 }, 2));
  mesh.Points[10] = 1.0; // point 3 where point 2 is: they only touch
  EXPECT_TRUE(AreSimple(mesh, { 0, 1 }, 2));
}

/// Two ranks have the star of an inner point, and one of them has the point elsewhere.
TEST(StarCheck, NeedsRanksThatAgreeAboutCoordinates)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0 };
  mesh.Triangles = { 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1 };
  EXPECT_TRUE(AreSimple(mesh, { 0, 0, 1, 1 }, 2));
  EXPECT_FALSE(AreSimple(mesh, { 0, 0, 1, 1 }, 2,
    [](std::vector<OwnPiece>& pieces)
    {
      const std::vector<std::int64_t>& points = pieces[1].PointOf;
      const auto center = std::find(points.begin(), points.end(), 0) - points.begin();
      pieces[1].Doubles[3 * center] += 0.125; // along the seam
      pieces[1].Doubles[3 * center + 1] -= 0.125;
    }));
}

//------------------------------------------------------------------------------
// Groups of ranks.

TEST(PieceGroup, RanksOfATurnWorkOneAfterTheOther)
{
  const std::vector<int> turnOf{ 0, 1, 0, 1, 0 };
  std::array<std::atomic<int>, 2> atWork{};
  std::atomic<int> most{ 0 };
  std::atomic<int> done{ 0 };
  RunInThreads(
    static_cast<int>(turnOf.size()),
    [&](PieceGroup& group)
    {
      std::atomic<int>& own = atWork[turnOf[group.GetRank()]];
      for (int round = 0; round < 4; ++round)
      {
        DoTogether(group,
          [&]()
          {
            const int now = ++own;
            most = std::max(most.load(), now);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            --own;
            ++done;
          });
      }
    },
    turnOf);
  EXPECT_EQ(1, most);
  EXPECT_EQ(20, done);
}

TEST(PieceGroup, AFailureBetweenCallsIsToldWhateverOthersCall)
{
  const std::function<void(PieceGroup&)> calls[] = {
    [](PieceGroup& group) {
      group.Gather({ 'y', 'z' });
    },
    [](PieceGroup& group) { group.Exchange(std::vector<Message>(3)); },
    [](PieceGroup& group) { DoTogether(group, []() {}); },
    [](PieceGroup&) {},
    [](PieceGroup& group) { RunTogether(group, [](PieceGroup& same) { same.Gather({}); }); },
  };
  for (const auto& others : calls)
  {
    std::atomic<int> told{ 0 };
    RunInThreads(3,
      [&](PieceGroup& group)
      {
        try
        {
          RunTogether(group,
            [&](PieceGroup& one)
            {
              EXPECT_EQ((std::vector<Message>(3, { 'x' })), one.Gather({ 'x' }));
              if (one.GetRank() == 1)
              {
                throw InvalidOptions("no such thing");
              }
              others(one);
            });
        }
        catch (const InvalidOptions& error)
        {
          told += error.what() == std::string("rank 1: no such thing") ? 1 : 0;
        }
      });
    EXPECT_EQ(3, told);
  }
}

}
}
