// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Edges that stay: lines, the second input by ids and by place, regions, features; and constraints
/// that are not edges of the mesh and become edges.

#include "FilterTestSupport.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFeatureEdges.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariantArray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// Gives a mesh points of this type (VTK_FLOAT, ...).
void Convert(vtkPolyData* mesh, int type)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->DeepCopy(mesh->GetPoints());
  mesh->SetPoints(points);
}

/// The results for constraints: edges kept, edges unmatched.
using Counts = std::pair<vtkIdType, vtkIdType>;

Counts Constrain(WatchedFilter& filter, vtkPolyData* constraints)
{
  filter->SetConstraintsData(constraints);
  vtkPolyData* output = filter.Run();
  EXPECT_TRUE(filter.GetErrors().empty());
  const Counts counts(
    filter->GetNumberOfConstraintEdges(), filter->GetNumberOfUnmatchedConstraints());
  EXPECT_EQ(counts.first, GetTotal(output, "ConstraintEdges"));
  EXPECT_EQ(counts.second, GetTotal(output, "UnmatchedConstraints"));
  EXPECT_EQ(filter.GetWarnings().size(), counts.second > 0 ? 1u : 0u);
  return counts;
}

Counts Constrain(vtkPolyData* mesh, vtkPolyData* constraints)
{
  WatchedFilter filter(mesh);
  return Constrain(filter, constraints);
}

/// MakeRhombus(), with point 4 at the place of point 0, and point 5 at that of point 2. Point 5 is
/// a corner of the triangle (5, 6, 7).
Mesh MakeCrowdedRhombus()
{
  return MakeRhombusAnd({ { -3, 0, 0 }, { 3, 0, 0 }, { 9, 0, 0 }, { 6, 2, 0 } }, { { 5, 6, 7 } });
}

/// How many flips the rhombus takes if its two triangles have these region labels.
template <typename ArrayT, typename Value>
vtkIdType CountFlips(const std::vector<Value>& values, int components = 1)
{
  auto mesh = MakeRhombus();
  const auto regions = MakeArray<ArrayT>("Region", 2, components);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    regions->SetValue(static_cast<vtkIdType>(i), values[i]);
  }
  mesh->GetCellData()->AddArray(regions);
  WatchedFilter filter(mesh);
  filter->SetRegionArray("Region");
  RunCleanly(filter);
  return filter->GetTotalFlips();
}

/// A lattice of 7 x 7 unit squares, all cut along the same diagonal; point 8 y + x.
Mesh MakeLattice() { return ToPolyData(delaunayflip::MakeGridMesh(7, 7)); }

bool HasEdges(vtkPolyData* mesh, const Cell& chain)
{
  bool all = true;
  for (std::size_t i = 1; i < chain.size(); ++i)
  {
    all = all && HasEdge(mesh, chain[i - 1], chain[i]);
  }
  return all;
}

const Cells Lines = { { 0, 50, 7 }, { 16, 39 }, { 3, 3 } }; // 16-39 crosses both parts of the first
const Cell FirstChain = { 0, 25, 50 }; // by ids: (0, 0), (1, 3), (2, 6)

}

TEST(Constraints, AreLinesOfTheMesh)
{
  auto mesh = MakeRhombus();
  mesh->SetLines(MakeCells({ { 1, 2, 0, 3 } })); // its middle segment is the long diagonal
  WatchedFilter filter(mesh);
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 0, 2));
  filter->LinesAsConstraintsOff();
  auto output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_EQ(GetCells(output->GetLines()), Cells({ { 1, 2, 0, 3 } }));
}

TEST(Constraints, OfTheSecondInputByIdsOrByPlace)
{
  const double near = std::nextafter(3.0, 4.0);
  auto polygon = Mesh::New();
  polygon->SetPolys(MakeCells({ { 2, 3, 0 } })); // its closing edge is the long diagonal
  const struct
  {
    const char* Name;
    Mesh Constraints;
    Counts Expected;
    bool Keeps; ///< The long diagonal.
  } cases[] = { { "lines without points", MakeLines({ { 0, 2 }, { 1, 3 } }), { 1, 1 }, true },
    { "polygon without points", polygon, { 3, 0 }, true },
    { "polygon", MakeMesh({ { 3, 0, 0 }, { 0, 1, 0 }, { -3, 0, 0 } }, { { 0, 1, 2 } }), { 3, 0 },
      true },
    { "numbered otherwise",
      MakeLines({ { 7, 7, 7 }, { 3, 0, 0 }, { 8, 8, 8 }, { -3, 0, 0 }, { 9, 9, 9 } }, { { 1, 3 } }),
      { 1, 0 }, true },
    { "minus zero", MakeLines({ { -3, -0.0, 0 }, { 3, 0, -0.0 } }, { { 0, 1 } }), { 1, 0 }, true },
    { "near", MakeLines({ { -3, 0, 0 }, { near, 0, 0 } }, { { 0, 1 } }), { 0, 1 }, false },
    { "nowhere",
      MakeLines({ { NAN, 0, 0 }, { 3, 0, 0 }, { INFINITY, 0, 0 } }, { { 0, 1 }, { 1, 2 } }),
      { 0, 2 }, false },
    { "twice, and of no length",
      MakeLines({ { -3, 0, 0 }, { 3, 0, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 3, 0, 0 }, { -3, 0, 0 },
                  { 0, 1, 0 }, { 0, 1, 0 }, { 5, 5, 5 }, { 5, 5, 5 } },
        { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 }, { 1, 8 }, { 9, 2 } }),
      { 2, 1 }, true } };
  for (const auto& given : cases)
  {
    SCOPED_TRACE(given.Name);
    WatchedFilter filter(MakeRhombus());
    filter->LinesAsConstraintsOff(); // which concerns only the first input
    EXPECT_EQ(Constrain(filter, given.Constraints), given.Expected);
    EXPECT_EQ(HasEdge(filter->GetOutput(), 0, 2), given.Keeps);
  }
}

TEST(Constraints, OutputOfFeatureEdgesHoldsEveryEdge)
{
  vtkNew<vtkFeatureEdges> edges; // all with two triangles, with points in a different order
  edges->BoundaryEdgesOff();
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ManifoldEdgesOn();
  for (const Mesh& mesh : { MakeBadPlane(), MakeBadSphere() })
  {
    for (const int type : { VTK_DOUBLE, VTK_FLOAT })
    {
      Convert(mesh, type);
      for (const int precision : { vtkAlgorithm::SINGLE_PRECISION, vtkAlgorithm::DOUBLE_PRECISION })
      {
        edges->SetInputData(mesh);
        edges->SetOutputPointsPrecision(precision);
        edges->Update();
        WatchedFilter filter(mesh);
        EXPECT_EQ(
          Constrain(filter, edges->GetOutput()), Counts(edges->GetOutput()->GetNumberOfLines(), 0));
        EXPECT_EQ(filter->GetTotalFlips(), 0);
      }
    }
  }
}

TEST(Constraints, PlacesAreComparedInTheLowerPrecision)
{
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(0, -3.1, 0.0, 0.0);
  Mesh line = MakeLines({ { -3.1, 0, 0 }, { 3, 0, 0 } }, { { 0, 1 } });
  Mesh other = MakeLines({ { -3.2, 0, 0 }, { 3, 0, 0 } }, { { 0, 1 } });
  Convert(line, VTK_FLOAT);
  EXPECT_EQ(Constrain(mesh, line), Counts(1, 0));
  Convert(line, VTK_DOUBLE); // the values of the floats, which differ from those of the mesh
  EXPECT_EQ(Constrain(mesh, line), Counts(0, 1));
  Convert(mesh, VTK_FLOAT);
  EXPECT_EQ(Constrain(mesh, line), Counts(1, 0));
  EXPECT_EQ(Constrain(mesh, other), Counts(0, 1));
}

TEST(Constraints, OfCoincidentPointsEveryPairThatIsAnEdge)
{
  auto mesh = MakeCrowdedRhombus();
  EXPECT_EQ(Constrain(mesh, MakeLines({ { 3, 0, 0 }, { -3, 0, 0 } }, { { 0, 1 } })), Counts(1, 0));
  EXPECT_EQ(Constrain(mesh, MakeLines({ { -3, 0, 0 }, { 9, 0, 0 } }, { { 0, 1 } })), Counts(0, 1));
  auto sheets = MakeRhombusAnd(
    { { -3, 0, 0 }, { 0, -1, 1 }, { 3, 0, 0 }, { 0, 1, 1 } }, { { 4, 5, 6 }, { 4, 6, 7 } });
  EXPECT_EQ(
    Constrain(sheets, MakeLines({ { 3, 0, 0 }, { -3, 0, 0 } }, { { 0, 1 } })), Counts(2, 0));
}

TEST(Constraints, TheSamePointsGoByIds)
{
  auto mesh = MakeCrowdedRhombus();
  Mesh constraints = MakeLines({ { 4, 2 } }); // no edge, although 4 is at the place of 0
  constraints->SetPoints(mesh->GetPoints());
  EXPECT_EQ(Constrain(mesh, constraints), Counts(0, 1));
  Convert(constraints, VTK_DOUBLE); // other points with the same bits
  EXPECT_EQ(Constrain(mesh, constraints), Counts(0, 1));
  Convert(constraints, VTK_FLOAT); // other bits
  EXPECT_EQ(Constrain(mesh, constraints), Counts(1, 0));
}

TEST(Constraints, WarmStartsKeepThemAndTheirCounts)
{
  auto mesh = MakeRhombus();
  Mesh lines = MakeLines({ { -3, 0, 0 }, { 4, 0, 0 }, { 5, 5, 5 } }, { { 0, 1 }, { 1, 2 } });
  LiveFilter filter(mesh);
  filter->SetConstraintsData(lines);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  lines->GetPoints()->SetPoint(1, 3, 0, 0); // moved constraints restart a live run
  lines->GetPoints()->Modified();
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
  for (int move = 0; move < 2; ++move)
  {
    Shear(mesh, 0.01); // no point is at a place of the constraints any more
    filter.RunToTheEnd();
    EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
    EXPECT_EQ(filter->GetNumberOfConstraintEdges(), 1);
    EXPECT_EQ(filter->GetNumberOfUnmatchedConstraints(), 1);
  }
}

TEST(Regions, OfAnyArrayKeepTheirBorders)
{
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 7, 7 })), 1);
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 7, -7 })), 0);
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 1, 2, 1, 2 }, 2)), 1);
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 1, 2, 1, 3 }, 2)), 0);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ 0.25, 0.25 })), 1);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ NAN, NAN })), 1);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ NAN, 0.5 })), 0);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ NAN, 1, 2, 3, 4, NAN, 1, 2, 3, 5 }, 5)), 0);
  // Different only beyond the 53 bits of a double.
  EXPECT_EQ((CountFlips<vtkLongLongArray, long long>({ 1LL << 60, (1LL << 60) + 1 })), 0);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "oak", "oak" })), 1);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "oak", "elm" })), 0);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "a", "b", "a", "b" }, 2)), 1);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "a", "b", "a", "c" }, 2)), 0);
  const auto countOfVariants = [](const vtkVariant& one, const vtkVariant& other) {
    return CountFlips<vtkVariantArray, vtkVariant>({ one, other });
  };
  EXPECT_EQ(countOfVariants("some", vtkVariant()), 0);
  EXPECT_EQ(countOfVariants(1.23456789, 1.23456788), 0);
  EXPECT_EQ(countOfVariants(1.23456789, 1.23456789), 1);
  EXPECT_EQ(countOfVariants(1.2345678f, 1.2345679f), 0);
  EXPECT_EQ(countOfVariants(std::nan(""), -std::nan("")), 1);
  EXPECT_EQ(countOfVariants(0.0, -0.0), 1);
  EXPECT_EQ(countOfVariants(2, 2.0), 1);
  EXPECT_EQ(countOfVariants(1LL << 60, (1LL << 60) + 1), 0);
  EXPECT_EQ((CountFlips<vtkBitArray, int>({ 1, 1 })), 1);
  EXPECT_EQ((CountFlips<vtkBitArray, int>({ 1, 0 })), 0);
  EXPECT_EQ((CountFlips<vtkSOADataArrayTemplate<float>, float>({ 1.f, 1.f })), 1);
  EXPECT_EQ((CountFlips<vtkSOADataArrayTemplate<float>, float>({ 1.f, 2.f })), 0);
}

TEST(Regions, OfSplitCells)
{
  // The rhombus as a quad: its diagonal lies inside one region.
  auto mesh = MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 3, 3, 0 } },
    { { 2, 4, 3 }, { 0, 1, 2, 3 } });
  mesh->SetVerts(MakeCells({ { 0 } }));
  AddNumbers(mesh->GetCellData(), "Region", 3, 0);
  WatchedFilter filter(mesh);
  filter->SetRegionArray("Region");
  auto output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 1, 3) && HasEdge(output, 2, 3));
  EXPECT_EQ(filter->GetTotalFlips(), 1);
}

TEST(Regions, ArraysThatAreMissingOrOfAnotherLengthAreErrors)
{
  WatchedFilter filter(MakeRhombus());
  filter->SetRegionArray("Region");
  ExpectHolds(RunToError(filter, vtkDelaunayFlip::FAILURE_OPTIONS), "\"Region\"");
  for (const vtkIdType tuples : { 0, 1, 3 })
  {
    auto mesh = MakeRhombus();
    mesh->GetCellData()->AddArray(MakeArray<vtkStringArray>("Region", tuples, 2));
    filter->SetInputData(mesh);
    ExpectHolds(RunToError(filter, vtkDelaunayFlip::FAILURE_OPTIONS), "as many tuples");
  }
  filter->SetRegionArray(nullptr);
  EXPECT_EQ(filter.Run()->GetNumberOfCells(), 2);
}

TEST(Features, StayUnlessTheAngleIsLarge)
{
  // The rhombus, folded by about 90 degrees along its long diagonal, with flat ends: a surface.
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(1, 0, -1, 1);
  mesh->GetPoints()->SetPoint(3, 0, 1, 1);
  WatchedFilter filter(mesh);
  RunCleanly(filter);
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_SURFACE);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  filter->SetFeatureAngle(180.0);
  RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
}

TEST(ConstraintInsertion, OfTheSecondInputByDefault)
{
  Mesh mesh = MakeLattice();
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  WatchedFilter filter(mesh);
  filter->SetConstraintsData(MakeLines(Lines));
  const std::string warning = RunToWarning(filter);
  ExpectHolds(warning, "1 constraint edge");
  ExpectHolds(warning, "(first: 16-39 crosses constraint 0 (points 0 and 50))");
  vtkPolyData* output = filter->GetOutput();
  EXPECT_TRUE(HasEdges(output, FirstChain));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), GetNumbers(mesh->GetCellData(), "Number"));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraints(), 2);
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraints(), 1);
  EXPECT_GE(filter->GetNumberOfConstraintEdges(), 3);
  EXPECT_GT(filter->GetNumberOfConstraintFlips(), 0);
  EXPECT_EQ(GetTotal(output, "InsertedConstraints"), 2);
  EXPECT_EQ(GetTotal(output, "ConstraintFlips"), filter->GetNumberOfConstraintFlips());
  double flips = 0.0;
  for (vtkIdType row = 0; row < filter->GetIterations()->GetNumberOfRows(); ++row)
  {
    flips += filter.GetRow("Flipped", row);
  }
  EXPECT_EQ(flips, filter->GetTotalFlips());
  filter->InsertConstraintsOff();
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraints(), 0);
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraints(), 3);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
}

/// A point that no triangle uses does not make it ambiguous which point is meant.
TEST(ConstraintInsertion, BesidePointsThatNoTriangleUses)
{
  const Points corners = { { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { -3, 0, 0 } };
  for (const auto& extra : Points{ corners[3], { 9, 9, 0 } })
  {
    Points points = corners;
    points.push_back(extra);
    const Mesh mesh = MakeMesh(points, { { 0, 1, 2 }, { 0, 2, 3 } });
    const Mesh line = MakeLines({ corners[1], corners[3] }, { { 0, 1 } });
    WatchedFilter filter(mesh);
    filter->SetConstraintsData(line);
    RunCleanly(filter);
    EXPECT_EQ(filter->GetNumberOfInsertedConstraints(), 1);
    EXPECT_EQ(filter->GetNumberOfUnmatchedConstraints(), 0);
  }
}

TEST(ConstraintInsertion, OfLinesOnRequest)
{
  Mesh mesh = MakeLattice();
  mesh->SetLines(MakeCells(Lines));
  WatchedFilter filter(mesh);
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraints(), 3);
  filter->InsertLinesOn();
  EXPECT_TRUE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraints(), 1);
  filter->LinesAsConstraintsOff();
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfConstraintEdges(), 0);
}

TEST(ConstraintInsertion, FollowsTheOrderOfTheInput)
{
  Mesh mesh = MakeLattice();
  MovePoints(mesh, [](double* x) { x[2] = 9.0; });
  Mesh byPlace = MakeLines(
    { { 7, 4, 9 }, { 0, 2, 9 }, { 0, 0, 9 }, { 2, 6, 9 } }, { { 1, 0 }, { 2, 3 } }); // 16-39, 0-50
  WatchedFilter places(mesh);
  EXPECT_EQ(Constrain(places, byPlace).second, 1);
  EXPECT_FALSE(HasEdges(places->GetOutput(), FirstChain));
  EXPECT_EQ(places->GetNumberOfInsertedConstraints(), 1);
  ExpectHolds(places.GetWarnings()[0], "(first: 0-50 crosses constraint 0 (points 16 and 39))");
  mesh->SetLines(MakeCells({ { 16, 39 } }));
  WatchedFilter filter(mesh);
  filter->InsertLinesOn(); // which come before the second input
  EXPECT_EQ(Constrain(filter, MakeLines({ { 50, 7 }, { 0, 50 } })).second, 2);
  EXPECT_FALSE(HasEdges(filter->GetOutput(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraints(), 1);
  ExpectHolds(filter.GetWarnings()[0],
    "(first: 7-50 crosses constraint 0 (points 16 and 39), "
    "0-50 crosses constraint 0 (points 16 and 39))");
}
