// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactReference.h"
#include "FlipTestSupport.h"
#include "SeamSurvey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

/// @file
/// Verdicts on single quads: known ones, those of exact arithmetic, and those of a session.

namespace delaunayflip
{
namespace
{

/// a, p, q and b: triangles (a, p, q) and (b, q, p), which share the edge from p to q.
using QuadPoints = std::array<Point3, 4>;

OwnedMesh<double> MakeQuadMesh(const QuadPoints& apqb)
{
  OwnedMesh<double> mesh;
  for (const Point3& x : apqb)
  {
    mesh.Points.insert(mesh.Points.end(), x.begin(), x.end());
  }
  mesh.Triangles = { 0, 1, 2, 3, 2, 1 };
  return mesh;
}

PartSurvey Survey(const TriangleMesh& mesh, const FlipOptions& options)
{
  const auto alone = MakeSingleGroup();
  const MeshPiece piece{ mesh };
  return SurveyParts(piece, MatchPoints(piece, *alone), options, *alone);
}

SeamSide MakeSide(const Point3& start, const Point3& end, const Point3& opposite, bool runsForward)
{
  SeamSide side = {};
  std::copy(start.begin(), start.end(), side.Ends[runsForward ? 0 : 1]);
  std::copy(end.begin(), end.end(), side.Ends[runsForward ? 1 : 0]);
  std::copy(opposite.begin(), opposite.end(), side.Opposite);
  side.RunsForward = runsForward;
  return side;
}

/// The verdict on the edge from p to q, which must not depend on how the quad is given.
EdgeState Judge(const QuadPoints& apqb, const FlipOptions& options)
{
  const OwnedMesh<double> mesh = MakeQuadMesh(apqb);
  const QuadJudge judge(Survey(mesh.View(), options), options);
  double points[4][3];
  std::copy(mesh.Points.begin(), mesh.Points.end(), points[0]);
  const EdgeState verdict = judge.Judge(points);
  const auto& [a, p, q, b] = apqb;
  for (const bool forward : { false, true })
  {
    EXPECT_EQ(verdict, judge.Judge(MakeSide(p, q, a, forward), MakeSide(q, p, b, !forward)));
  }
  return verdict;
}

/// What a session does to the edge from p to q.
EdgeState AskSession(const TriangleMesh& mesh, FlipOptions options)
{
  options.MaximumIterations = 1;
  options.FeatureAngle = 180.0; // no edge is too sharp to flip
  const FlipReport report = Flip(mesh, options).Report;
  return report.TotalFlips == 1 ? EdgeState::Bad
    : report.BlockedByShape > 0 ? EdgeState::BlockedByShape
                                : EdgeState::Good;
}

FlipOptions MakeOptions(
  GeometryKind geometry, TieRuleKind ties, CriterionKind criterion = CriterionKind::InCircle)
{
  FlipOptions options;
  options.Geometry = geometry;
  options.TieRule = ties;
  options.Criterion = criterion;
  return options;
}

const FlipOptions InPlane = MakeOptions(GeometryKind::PlanarXY, TieRuleKind::Keep);
const FlipOptions Canonical = MakeOptions(GeometryKind::PlanarXY, TieRuleKind::Canonical);
const FlipOptions ByAngles =
  MakeOptions(GeometryKind::PlanarXY, TieRuleKind::Keep, CriterionKind::OppositeAngles);
const FlipOptions OnSurface = MakeOptions(GeometryKind::Surface, TieRuleKind::Keep);

/// Four distinct points of a small lattice: many quads are tied, flat or folded.
QuadPoints DrawQuad(std::mt19937& random, bool isFlat)
{
  QuadPoints quad;
  for (std::size_t i = 0; i < quad.size();)
  {
    quad[i] = { 1.0 * DrawIndex(random, 4), 1.0 * DrawIndex(random, 4),
      isFlat ? 0.0 : 1.0 * DrawIndex(random, 4) };
    i += std::find(quad.begin(), quad.begin() + i, quad[i]) == quad.begin() + i ? 1 : 0;
  }
  return quad;
}

/// For quads whose triangles lie on both sides of the edge.
EdgeState JudgeInRationals(const QuadPoints& apqb, bool isCanonical)
{
  const auto& [a, p, q, b] = apqb;
  const int inside = RationalInCircle(a, p, q, b) * RationalTurn(a, p, q);
  const bool hasLargest = std::max(p, q) > std::max(a, b);
  return inside > 0 || (inside == 0 && isCanonical && hasLargest) ? EdgeState::Bad
                                                                  : EdgeState::Good;
}

TEST(QuadJudge, KnowsSimpleQuadsInThePlane)
{
  const QuadPoints kite = { { { 0, 1, 0 }, { -3, 0, 0 }, { 3, 0, 0 }, { 0, -1, 0 } } };
  const QuadPoints tall = { { { 0, 4, 0 }, { -3, 0, 0 }, { 3, 0, 0 }, { 0, -4, 0 } } };
  for (const FlipOptions& options : { InPlane, Canonical, ByAngles, OnSurface })
  {
    EXPECT_EQ(EdgeState::Bad, Judge(kite, options));
    EXPECT_EQ(EdgeState::Good, Judge(tall, options));
  }
}

TEST(QuadJudge, DecidesTiesByTheirLargestPoint)
{
  const QuadPoints square = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } } };
  const QuadPoints turned = { { { 1, 0, 0 }, { 1, 1, 0 }, { 0, 0, 0 }, { 0, 1, 0 } } };
  EXPECT_EQ(EdgeState::Good, Judge(square, Canonical));
  EXPECT_EQ(EdgeState::Bad, Judge(turned, Canonical));
  for (const FlipOptions& options : { InPlane, ByAngles, OnSurface })
  {
    EXPECT_EQ(EdgeState::Good, Judge(square, options));
    EXPECT_EQ(EdgeState::Good, Judge(turned, options));
  }
}

TEST(QuadJudge, AgreesWithExactArithmetic)
{
  std::mt19937 random(1);
  std::map<EdgeState, int> verdicts;
  for (int i = 0; i < 2000; ++i)
  {
    const QuadPoints quad = DrawQuad(random, true);
    const auto& [a, p, q, b] = quad;
    if (RationalTurn(a, p, q) * RationalTurn(b, q, p) > 0)
    {
      const EdgeState verdict = JudgeInRationals(quad, true);
      ++verdicts[verdict];
      EXPECT_EQ(verdict, Judge(quad, Canonical)) << i;
      EXPECT_EQ(JudgeInRationals(quad, false), Judge(quad, InPlane)) << i;
    }
  }
  EXPECT_GT(verdicts[EdgeState::Bad], 100);
  EXPECT_GT(verdicts[EdgeState::Good], 100);
}

TEST(QuadJudge, AgreesWithASession)
{
  std::mt19937 random(2);
  std::map<EdgeState, int> verdicts;
  for (int i = 0; i < 1000; ++i)
  {
    for (const FlipOptions& options : { InPlane, Canonical, ByAngles, OnSurface })
    {
      const QuadPoints quad = DrawQuad(random, options.Geometry != GeometryKind::Surface || i % 2);
      const auto& [a, p, q, b] = quad;
      if (options.Geometry != GeometryKind::Surface &&
        RationalTurn(a, p, q) * RationalTurn(b, q, p) <= 0)
      {
        continue; // a session may choose another geometry
      }
      const OwnedMesh<double> mesh = MakeQuadMesh(quad);
      const EdgeState verdict = Judge(quad, options);
      ++verdicts[verdict];
      EXPECT_EQ(verdict, AskSession(mesh.View(), options)) << i << testing::PrintToString(quad);
    }
  }
  for (const EdgeState state : { EdgeState::Good, EdgeState::Bad, EdgeState::BlockedByShape })
  {
    EXPECT_GT(verdicts[state], 10) << static_cast<int>(state);
  }
}

TEST(QuadJudge, ToleratesAnglesOnSurfaces)
{
  const QuadPoints nearSquare = { { { 0, 0.999, 0 }, { -1, 0, 0 }, { 1, 0, 0 },
    { 0, -0.999, 1e-6 } } };
  FlipOptions options = OnSurface;
  EXPECT_EQ(EdgeState::Bad, Judge(nearSquare, options));
  options.Tolerance = 0.1;
  EXPECT_EQ(EdgeState::Good, Judge(nearSquare, options));
}

}
}
