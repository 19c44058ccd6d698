// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Edges that stay: lines, the second input, regions, ghosts, features, the tolerance.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// How many flips the rhombus takes if its two triangles have these region labels.
template <typename ArrayT, typename Value>
vtkIdType CountFlips(const std::vector<Value>& values, int components)
{
  auto mesh = MakeRhombus();
  vtkNew<ArrayT> regions;
  regions->SetName("Region");
  regions->SetNumberOfComponents(components);
  regions->SetNumberOfTuples(2);
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

vtkIdType CountFlipsWithGhost(int flag)
{
  auto mesh = MakeRhombus();
  mesh->SetVerts(MakeCells({ { 0 } }));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->InsertNextValue(0);
  ghosts->InsertNextValue(0);
  ghosts->InsertNextValue(static_cast<unsigned char>(flag));
  mesh->GetCellData()->AddArray(ghosts);
  WatchedFilter filter(mesh);
  RunCleanly(filter);
  return filter->GetTotalFlips();
}

}

TEST(VtkDelaunayFlip, LinesConstrain)
{
  auto mesh = MakeRhombus();
  mesh->SetLines(MakeCells({ { 1, 2, 0, 3 } })); // its middle segment is the long diagonal
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 0, 2));
  EXPECT_EQ(filter->GetTotalFlips(), 0);

  filter->LinesAsConstraintsOff();
  output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_EQ(GetCells(output->GetLines()), Cells({ { 1, 2, 0, 3 } }));
}

TEST(VtkDelaunayFlip, SecondInputConstrainsByLines)
{
  vtkNew<vtkPolyData> constraints; // needs no points of its own
  constraints->SetLines(MakeCells({ { 2, 0 } }));
  WatchedFilter filter(MakeRhombus());
  filter->SetConstraintsData(constraints);
  filter->LinesAsConstraintsOff(); // which concerns only the first input
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 0, 2));
}

TEST(VtkDelaunayFlip, SecondInputConstrainsByPolygons)
{
  vtkNew<vtkPolyData> constraints;
  constraints->SetPolys(MakeCells({ { 2, 3, 0 } })); // its closing edge is the long diagonal
  WatchedFilter filter(MakeRhombus());
  filter->SetConstraintsData(constraints);
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 0, 2));
}

TEST(VtkDelaunayFlip, MissingConstraintsGiveOneWarning)
{
  auto mesh = MakeRhombus();
  mesh->SetLines(MakeCells({ { 1, 3 }, { 3, 1 }, { 0, 1 } }));
  WatchedFilter filter(mesh);
  EXPECT_TRUE(HasEdge(filter.Run(), 1, 3)); // not an edge at first, so 0-2 may flip
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_NE(filter.GetWarnings()[0].find("1 constraint edge"), std::string::npos)
    << filter.GetWarnings()[0];
}

TEST(VtkDelaunayFlip, BordersOfRegionsStay)
{
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 7, 7 }, 1)), 1);
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 7, -7 }, 1)), 0);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ 0.25, 0.25 }, 1)), 1);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ 0.25, 0.5 }, 1)), 0);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ NAN, NAN }, 1)), 1);
  EXPECT_EQ((CountFlips<vtkDoubleArray, double>({ NAN, 0.5 }, 1)), 0);
  // Different only beyond the 53 bits of a double.
  EXPECT_EQ((CountFlips<vtkLongLongArray, long long>({ 1LL << 60, (1LL << 60) + 1 }, 1)), 0);
}

TEST(VtkDelaunayFlip, RegionsOfAnyArray)
{
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 1, 2, 1, 2 }, 2)), 1);
  EXPECT_EQ((CountFlips<vtkIntArray, int>({ 1, 2, 1, 3 }, 2)), 0);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "oak", "oak" }, 1)), 1);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "oak", "elm" }, 1)), 0);
  EXPECT_EQ((CountFlips<vtkStringArray, std::string>({ "a", "b", "a", "b" }, 2)), 1);
  EXPECT_EQ((CountFlips<vtkSOADataArrayTemplate<float>, float>({ 1.f, 1.f }, 1)), 1);
  EXPECT_EQ((CountFlips<vtkSOADataArrayTemplate<float>, float>({ 1.f, 2.f }, 1)), 0);
}

TEST(VtkDelaunayFlip, RegionsOfSplitCells)
{
  // The rhombus as a quad: its diagonal lies inside one region.
  auto mesh = MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 3, 3, 0 } },
    { { 2, 4, 3 }, { 0, 1, 2, 3 } });
  mesh->SetVerts(MakeCells({ { 0 } }));
  AddNumbers(mesh->GetCellData(), "Region", 3, 0);
  WatchedFilter filter(mesh);
  filter->SetRegionArray("Region");
  auto output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_TRUE(HasEdge(output, 2, 3));
  EXPECT_EQ(filter->GetTotalFlips(), 1);
}

TEST(VtkDelaunayFlip, WrongRegionArrayIsAnError)
{
  WatchedFilter filter(MakeRhombus());
  filter->SetRegionArray("Region");
  EXPECT_EQ(filter.Run()->GetNumberOfCells(), 0);
  ASSERT_EQ(filter.GetErrors().size(), 1u);
  EXPECT_NE(filter.GetErrors()[0].find("\"Region\""), std::string::npos);

  filter->SetRegionArray(nullptr);
  EXPECT_EQ(filter.Run()->GetNumberOfCells(), 2);
}

TEST(VtkDelaunayFlip, GhostsAreFrozen)
{
  EXPECT_EQ(CountFlipsWithGhost(0), 1);
  EXPECT_EQ(CountFlipsWithGhost(vtkDataSetAttributes::DUPLICATECELL), 0);
  EXPECT_EQ(CountFlipsWithGhost(vtkDataSetAttributes::REFINEDCELL), 0);
  EXPECT_EQ(CountFlipsWithGhost(vtkDataSetAttributes::HIDDENCELL), 0);
  EXPECT_EQ(CountFlipsWithGhost(vtkDataSetAttributes::EXTERIORCELL), 1); // not a ghost
}

TEST(VtkDelaunayFlip, FeatureEdgesStay)
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

TEST(VtkDelaunayFlip, ToleranceIsOfOppositeAnglesOnly)
{
  // Opposite angles of 95.4 degrees each: 0.19 radians above pi.
  const auto mesh = MakeMesh(
    { { -1.1, 0, 0 }, { 0, -1, 0 }, { 1.1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
  WatchedFilter inCircle(mesh);
  inCircle->SetTolerance(0.3);
  inCircle.Run();
  EXPECT_EQ(inCircle->GetTotalFlips(), 1);
  WatchedFilter filter(mesh);
  filter->SetTolerance(0.3);
  filter->SetCriterionToOppositeAngles();
  RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  filter->SetTolerance(0.1);
  RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
}
