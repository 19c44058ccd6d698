// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Constraints of real drawings, inserted into a bad mesh of their points, against CGAL. Skipped
/// without the drawings: DELAUNAYFLIP_DATA_DIR names the folder that has them in pslg/.

#include "CgalReference.h"
#include "ConstraintOracle.h"
#include "PslgFile.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace delaunayflip
{
namespace
{

std::vector<std::string> FindDrawings()
{
  const char* folder = std::getenv("DELAUNAYFLIP_DATA_DIR");
  return folder ? ListPslgFiles(std::string(folder) + "/pslg") : std::vector<std::string>();
}

ConstrainedMesh MakeCase(const std::string& path)
{
  const Pslg drawing = ReadPslg(path);
  ConstrainedMesh made;
  made.Mesh = MakeSweptMesh(drawing.Points);
  for (const auto& [from, to] : drawing.Segments)
  {
    made.Add(from, to);
  }
  return made;
}

/// CGAL's triangles, with ties as the canonical rule decides them.
FlipResult MakeReference(const TriangleMesh& mesh, const FlipOptions& options)
{
  std::vector<std::int32_t> triangles;
  for (const auto& triangle : MakeCgalConstrainedDelaunay(mesh))
  {
    for (const std::int64_t id : triangle)
    {
      triangles.push_back(static_cast<std::int32_t>(id));
    }
  }
  return Flip(WithTriangles(mesh, triangles), options);
}

/// Without the constraints that cross earlier ones, which some drawings have and CGAL refuses.
ConstrainedMesh KeepInsertable(const ConstrainedMesh& drawing, const FlipReport& report)
{
  if (report.UnmatchedConstraints == 0)
  {
    return drawing;
  }
  constexpr std::int64_t LargestPredicted = 500; // points: all pairs of pieces are looked at
  EXPECT_GT(LargestPredicted, drawing.Mesh.NumberOfPoints());
  const ExpectedInsertion expected = PredictInsertion(drawing.View());
  EXPECT_EQ(expected.Refused, report.UnmatchedConstraints);
  ConstrainedMesh kept;
  kept.Mesh = drawing.Mesh;
  for (const auto& [from, to] : expected.Pieces)
  {
    kept.Add(from, to);
  }
  return kept;
}

}

TEST(Pslg, GivesCgalsConstrainedDelaunayMesh)
{
  const std::vector<std::string> drawings = FindDrawings();
  if (drawings.empty())
  {
    GTEST_SKIP() << "no drawings: DELAUNAYFLIP_DATA_DIR has no folder pslg";
  }
  FlipOptions options;
  options.TieRule = TieRuleKind::Canonical;
  std::int64_t inserted = 0;
  for (const std::string& path : drawings)
  {
    SCOPED_TRACE(path);
    const ConstrainedMesh drawing = MakeCase(path);
    const FlipResult result = Flip(drawing.View(), options);
    ExpectSameTopology(drawing.Mesh.View().Triangles, result.Triangles, result.Report);
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    const FlipResult reference =
      MakeReference(KeepInsertable(drawing, result.Report).View(), options);
    EXPECT_TRUE(ToTriangleSet(reference.Triangles) == ToTriangleSet(result.Triangles));
    inserted += result.Report.InsertedConstraints;
  }
  EXPECT_LT(1000, inserted);
}

}
