// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// vtkDelaunayFlipPoints: from points and segments to a mesh.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkDataArray.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace
{

using PointsFilter = Watched<vtkDelaunayFlipPoints>;

constexpr double Inf = std::numeric_limits<double>::infinity();

/// Random points in a square of this size, with some height.
Points MakeCloud(int count, double size = 10.0)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(0.0, size);
  Points points(count);
  for (auto& point : points)
  {
    point = { draw(random), draw(random), 0.1 * draw(random) };
  }
  return points;
}

Mesh ToMesh(const Points& points) { return MakeMesh(points, {}); }

/// A square of 4 x 4 units. Points 0 to 3 are its corners, counter-clockwise.
const Points Square = { { 0, 0, 1 }, { 4, 0, 2 }, { 4, 4, 3 }, { 0, 4, 4 } };

}

TEST(FromPoints, OfAnyTypeAndLayout)
{
  auto floats = ToMesh(MakeCloud(500)), doubles = ToMesh(MakeCloud(500)), separate = ToMesh({});
  const auto flatten = [](double* x) { x[2] = 0.0; };
  ReplacePoints<vtkFloatArray>(floats, flatten);
  ReplacePoints<vtkDoubleArray>(doubles, flatten);
  separate->DeepCopy(floats);
  ReplacePoints<vtkSOADataArrayTemplate<float>>(separate);
  for (const Mesh& cloud : { floats, doubles, separate })
  {
    PointsFilter filter(cloud);
    const auto output = RunCleanly(filter);
    EXPECT_EQ(output->GetPoints(), cloud->GetPoints());
    EXPECT_EQ(CountViolations(output), 0);
    EXPECT_GT(output->GetNumberOfPolys(), 950);
  }
}

TEST(FromPoints, WhatPassesAndWhatIsReported)
{
  auto cloud = ToMesh(MakeCloud(300));
  AddNumbers(cloud->GetPointData(), "n", 300, 5);
  cloud->SetVerts(MakeCells({ { 0 }, { 1 } }));
  cloud->SetPolys(MakeCells({ { 0, 1, 2 } }));
  AddNumbers(cloud->GetCellData(), "dropped", 3, 0);
  cloud->GetFieldData()->AddArray(MakeArray<vtkIntArray>("kept", 1));
  PointsFilter filter(cloud);
  const auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetPointData()->GetArray("n"), cloud->GetPointData()->GetArray("n"));
  EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(output->GetNumberOfVerts(), 0);
  EXPECT_TRUE(output->GetFieldData()->HasArray("kept"));
  EXPECT_EQ(GetText(output, "StopReason"), "converged");
  EXPECT_EQ(GetTotal(output, "TotalFlips"), filter->GetTotalFlips());
  EXPECT_GT(filter->GetTotalFlips(), 0);
  EXPECT_EQ(GetTotal(output, "RepeatedPoints"), 0.0);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), filter->GetNumberOfIterations());
  EXPECT_EQ(filter.GetRow("Flipped", 0), GetTotal(output, "Flipped"));
}

TEST(FromPoints, OtherPointSets)
{
  const auto cloud = ToMesh(MakeCloud(50));
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(cloud->GetPoints());
  vtkNew<vtkStructuredGrid> lattice;
  lattice->SetDimensions(10, 5, 1);
  lattice->SetPoints(cloud->GetPoints());
  PointsFilter expected(cloud);
  RunCleanly(expected);
  for (vtkPointSet* set : { static_cast<vtkPointSet*>(grid), static_cast<vtkPointSet*>(lattice) })
  {
    PointsFilter filter(set);
    RunCleanly(filter);
    EXPECT_EQ(filter.GetPolygons(), expected.GetPolygons());
  }
}

TEST(FromPoints, DegenerateInput)
{
  struct Case
  {
    Points Given;
    std::size_t Triangles;
    const char* Warning;
  };
  const std::vector<Case> cases = {
    { { { 0, 0, 0 }, { 1, 0, 0 } }, 0, "fewer than three places" },
    { { { 0, 0, 0 }, { 1, 1, 9 }, { 2, 2, 0 }, { 3, 3, 0 } }, 0, "4 points without a triangle" },
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 7 } }, 1, "1 duplicate point skipped" },
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { Inf, 0, 0 } }, 1, "NaN or infinite" },
  };
  for (const Case& each : cases)
  {
    PointsFilter filter(ToMesh(each.Given));
    ExpectHolds(RunToWarning(filter), each.Warning);
    EXPECT_EQ(filter.GetPolygons().size(), each.Triangles);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), static_cast<vtkIdType>(each.Given.size()));
  }
  PointsFilter heights(ToMesh({ { 0, 0, NAN }, { 1, 0, Inf }, { 0, 1, 0 } }));
  RunCleanly(heights);
  EXPECT_EQ(heights.GetPolygons().size(), 1u);
  vtkNew<vtkPolyData> nothing;
  PointsFilter empty(nothing);
  EXPECT_EQ(RunCleanly(empty)->GetNumberOfPoints(), 0);
  EXPECT_TRUE(empty->GetConverged());
}

TEST(FromPoints, Projections)
{
  const Points flat = MakeCloud(200);
  Points upright = flat;
  for (auto& point : upright)
  {
    point = { 5.0, point[0] - 0.001 * point[2], point[1] };
  }
  // In x and y alone all of these are on one line, or nearly.
  PointsFilter plane(ToMesh(upright));
  plane->SetProjectionToBestFittingPlane();
  const auto output = RunCleanly(plane);
  EXPECT_EQ(output->GetPoints()->GetPoint(3)[0], 5.0);
  EXPECT_GT(plane.GetPolygons().size(), 350u);
  vtkNew<vtkTransform> transform; // y, z and x become x, y and z
  transform->SetMatrix(
    std::array<double, 16>{ 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1 }.data());
  PointsFilter moved(ToMesh(upright));
  moved->SetTransform(transform);
  const auto byTransform = GetTriangles(RunCleanly(moved));
  EXPECT_EQ(byTransform, GetTriangles(output));
  const vtkMTimeType before = moved->GetMTime();
  transform->RotateZ(30.0);
  EXPECT_GT(moved->GetMTime(), before);
  // One point that is not finite must not spoil the plane.
  upright.push_back({ Inf, 0, 0 });
  PointsFilter other(ToMesh(upright));
  other->SetProjectionToBestFittingPlane();
  RunToWarning(other);
  EXPECT_EQ(GetTriangles(other->GetOutput()), byTransform);
}

TEST(FromPoints, OnASphere)
{
  Points degrees;
  for (int column = -18; column <= 18; ++column)
  {
    for (int row = -9; row <= 9; ++row)
    {
      degrees.push_back({ 10.0 * column, 10.0 * row, 5.0 });
    }
  }
  const std::size_t places = 36 * 17 + 2;
  PointsFilter globe(ToMesh(degrees));
  globe->SetProjectionToSphere();
  globe->DegreesOn();
  ExpectHolds(RunToWarning(globe), "duplicate points skipped");
  EXPECT_EQ(2 * places - 4, globe.GetPolygons().size());
  const double* pole = globe->GetOutput()->GetPoint(18);
  EXPECT_EQ(
    (std::array<double, 3>{ 0.0, 0.0, 1.0 }), (std::array<double, 3>{ pole[0], pole[1], pole[2] }));
  // Without Degrees the filter triangulates the points of that output in the same way.
  vtkNew<vtkPolyData> given;
  given->SetPoints(globe->GetOutput()->GetPoints());
  PointsFilter again(given);
  again->SetProjectionToSphere();
  RunToWarning(again);
  EXPECT_EQ(GetTriangles(globe->GetOutput()), GetTriangles(again->GetOutput()));
  Points half;
  std::copy_if(degrees.begin(), degrees.end(), std::back_inserter(half),
    [](const auto& point) { return point[1] >= 10.0; });
  PointsFilter part(ToMesh(half));
  part->SetProjectionToOpenSphere();
  part->DegreesOn();
  RunToWarning(part);
  EXPECT_EQ(36u + 7 * 72, part.GetPolygons().size()); // a fan at the pole, and seven bands
  part->SetMinimumAngle(20.0);
  ExpectHolds(
    RunToError(part, vtkDelaunayFlip::FAILURE_OPTIONS), "MinimumAngle has no meaning on a sphere");
  PointsFilter turned(ToMesh({ { 3, 0, 0 }, { 45, 90, 0 }, { 10, 120, 0 }, { -9, -91, 0 } }));
  turned->SetProjectionToSphere();
  turned->DegreesOn();
  ExpectHolds(RunToWarning(turned), "2 points with a latitude beyond 90 degrees (first: 2)");
}

/// A coast of the second input is in degrees, too. Its inside is its smaller side.
TEST(FromPoints, CoastsOnASphere)
{
  Points degrees;
  for (int i = 0; i < 300; ++i)
  {
    degrees.push_back({ 137.5 * i - 360.0 * (137 * i / 360), 0.6 * i - 89.7, 0.0 });
  }
  PointsFilter globe(ToMesh(degrees));
  globe->SetProjectionToSphere();
  globe->DegreesOn();
  const std::size_t whole = 2 * 304 - 4;
  const auto coast = MakeMesh(
    { { 160, -20, 0 }, { -160, -20, 0 }, { -160, 20, 0 }, { 160, 20, 0 } }, { { 0, 1, 2, 3 } });
  globe->SetSegmentsData(coast);
  globe->Update();
  const std::size_t inside = globe.GetPolygons().size();
  EXPECT_LT(10u, inside);
  EXPECT_GT(whole / 4, inside);
  EXPECT_EQ(4, globe->GetNumberOfSegmentEdges());
  globe->SetFirstHole(0);
  globe->Update();
  EXPECT_EQ(whole - inside, globe.GetPolygons().size());
  const double* corner = globe->GetOutput()->GetPoint(300);
  EXPECT_NEAR(1.0, std::hypot(corner[0], corner[1], corner[2]), 1e-15);
  globe->SetSegmentsData(
    MakeMesh({ { 20, 160, 0 }, { -20, 160, 0 }, { -20, -160, 0 } }, { { 0, 1, 2 } }));
  ExpectHolds(RunToWarning(globe), "segments: 3 points with a latitude beyond 90 degrees");
}

/// Points on a wall: what is added is on it, too. Each property makes another mesh.
TEST(FromPoints, Refinement)
{
  Points wall = MakeCloud(100);
  for (auto& point : wall)
  {
    point = { 5.0, point[0], point[1] };
  }
  const auto cloud = ToMesh(wall);
  const auto heights = MakeArray<vtkDoubleArray>("height", 100);
  const auto sizes = MakeArray<vtkDoubleArray>("size", 100);
  for (int i = 0; i < 100; ++i)
  {
    heights->SetValue(i, wall[i][2]);
    sizes->SetValue(i, 0.4);
  }
  cloud->GetPointData()->AddArray(heights);
  cloud->GetPointData()->AddArray(sizes);
  PointsFilter filter(cloud);
  filter->SetProjectionToBestFittingPlane();
  filter->SetMinimumAngle(25.0);
  auto output = RunCleanly(filter);
  const vtkIdType refined = output->GetNumberOfPoints();
  EXPECT_GT(refined, 100);
  EXPECT_EQ(refined - 100, GetTotal(output, "RefinementPoints"));
  vtkDataArray* const added = output->GetPointData()->GetArray("height");
  for (vtkIdType i = 0; i < refined; ++i)
  {
    EXPECT_NEAR(output->GetPoint(i)[0], 5.0, 1e-9);
    EXPECT_NEAR(output->GetPoint(i)[2], added->GetComponent(i, 0), 1e-9);
  }
  EXPECT_EQ(GetTotal(output, "UnrefinedTriangles"), 0.0);
  EXPECT_EQ(GetTotal(output, "TrianglesBelow20After"), 0.0);
  vtkIdType last = refined;
  const auto expectMore = [&]()
  {
    const vtkIdType count = RunCleanly(filter)->GetNumberOfPoints();
    EXPECT_GT(count, last);
    last = count;
  };
  filter->SetMaximumArea(0.2);
  expectMore();
  filter->SetMaximumEdge(0.5);
  expectMore();
  filter->SetSizeArray("size");
  expectMore();
  filter->AddRegion(5.0, 5.0, 3, 0.01);
  filter->RemoveAllRegions();
  EXPECT_EQ(RunCleanly(filter)->GetCellData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfLines(), 0);
  filter->SetPointLimit(500);
  ExpectHolds(RunToWarning(filter), "PointLimit allows no more");
  EXPECT_LE(filter->GetOutput()->GetNumberOfPoints(), 500);
}

//------------------------------------------------------------------------------
/// Lines of the second input have their cell ids, those of the first one follow.
TEST(FromPoints, SegmentsArePassed)
{
  const auto cloud =
    MakeLines({ { 0, 0, 0 }, { 8, 0, 0 }, { 8, 8, 0 }, { 0, 8, 0 } }, { { 0, 1 } });
  PointsFilter filter(cloud);
  filter->LinesAsSegmentsOn();
  filter->PassSegmentsOn();
  const auto wall =
    MakeLines({ { 2, 1, 0 }, { 2, 7, 0 }, { 6, 1, 0 }, { 6, 7, 0 } }, { { 0, 1 }, { 2, 3 } });
  filter->SetSegmentsData(wall);
  filter->SetMaximumEdge(1.0);
  filter->AddRegion(4.0, 4.0, 3, 0.0);
  const auto output = RunCleanly(filter);
  auto* const ofCells = vtkIdTypeArray::SafeDownCast(output->GetCellData()->GetArray("SegmentIds"));
  auto* const ofPoints =
    vtkIdTypeArray::SafeDownCast(output->GetPointData()->GetArray("SegmentIds"));
  ASSERT_TRUE(ofCells && ofPoints);
  ASSERT_EQ(output->GetNumberOfLines(), filter->GetNumberOfSegmentEdges());
  EXPECT_EQ(ofCells->GetNumberOfValues(), output->GetNumberOfCells());
  EXPECT_EQ(ofPoints->GetNumberOfValues(), output->GetNumberOfPoints());
  const auto find = [&](vtkIdType point) -> vtkIdType
  {
    const double* const place = output->GetPoint(point);
    const vtkIdType onWall = place[0] == 2.0 ? 0 : 1;
    return place[1] == 0.0 ? 2 : onWall;
  };
  vtkIdType inner = 0;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    const bool isLine = cell < output->GetNumberOfLines();
    const vtkIdType point = output->GetCell(cell)->GetPointId(0);
    EXPECT_EQ(ofCells->GetValue(cell), isLine ? find(point) : -1);
    EXPECT_EQ(output->GetCellData()->GetArray("Region")->GetTuple1(cell), isLine ? 0 : 3);
  }
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const vtkIdType segment = ofPoints->GetValue(point);
    inner += segment >= 0 ? 1 : 0;
    EXPECT_TRUE(segment < 0 || (point >= 8 && segment == find(point)));
  }
  EXPECT_GE(inner, 7 + 5 + 5);
  filter->PassSegmentsOff();
  EXPECT_EQ(RunCleanly(filter)->GetNumberOfLines(), 0);
}

//------------------------------------------------------------------------------
TEST(FromPoints, PointsOfSegmentsAreAdded)
{
  auto cloud = ToMesh(Square);
  AddNumbers(cloud->GetPointData(), "both", 4, 1);
  AddNumbers(cloud->GetPointData(), "mine", 4, 11);
  AddNumbers(cloud->GetPointData(), "kind", 4, 21);
  cloud->GetPointData()->SetActiveScalars("mine");
  auto ids = MakeArray<vtkIntArray>("ids", 4);
  ids->FillValue(3);
  cloud->GetPointData()->SetGlobalIds(ids);
  // Points 0 and 2 are new and the same one; point 1 is a corner.
  auto lines = MakeLines({ { 1, 2, 9 }, { 4, 4, 3 }, { 1, 2, 9 } }, { { 0, 1 }, { 2, 1 } });
  AddNumbers(lines->GetPointData(), "both", 3, 100);
  AddNumbers(lines->GetPointData(), "theirs", 3, 200);
  const auto kinds = MakeArray<vtkDoubleArray>("kind", 3);
  kinds->FillValue(0.5);
  lines->GetPointData()->AddArray(kinds);
  auto names = vtkSmartPointer<vtkStringArray>::New();
  names->SetName("names");
  names->InsertNextValue("new");
  names->InsertNextValue("corner");
  names->InsertNextValue("again");
  lines->GetPointData()->AddArray(names);
  PointsFilter filter(cloud);
  filter->SetSegmentsData(lines);
  const auto output = RunCleanly(filter);
  ASSERT_EQ(output->GetNumberOfPoints(), 5);
  EXPECT_EQ(output->GetPoint(4)[2], 9.0);
  EXPECT_TRUE(HasEdge(output, 4, 2));
  vtkPointData* data = output->GetPointData();
  EXPECT_EQ(GetNumbers(data, "both"), (std::vector<int>{ 1, 2, 3, 4, 100 }));
  EXPECT_EQ(GetNumbers(data, "mine"), (std::vector<int>{ 11, 12, 13, 14, 13 }));
  EXPECT_EQ(GetNumbers(data, "kind"), (std::vector<int>{ 21, 22, 23, 24, 23 })); // of the survey
  EXPECT_EQ(data->GetArray("kind (2)")->GetTuple1(4), 0.5);
  EXPECT_EQ(GetNumbers(data, "theirs"), (std::vector<int>{ 0, 0, 0, 0, 200 }));
  EXPECT_EQ(data->GetAbstractArray("names")->GetVariantValue(4).ToString(), "new");
  EXPECT_EQ(data->GetScalars(), data->GetArray("mine"));
  EXPECT_EQ(data->GetGlobalIds(), nullptr);
  EXPECT_NE(data->GetPedigreeIds(), nullptr);
  EXPECT_EQ(filter->GetNumberOfSegmentEdges(), 1); // of both
  EXPECT_EQ(cloud->GetNumberOfPoints(), 4);
}

/// Numbers become those of the first input if these are real. Other arrays of one name are two, and
/// those with too few tuples are left out.
TEST(FromPoints, ArraysOfOneNameAndOtherTypes)
{
  const auto ofType = [](auto array, vtkIdType tuples)
  {
    array->SetName("v");
    array->SetNumberOfTuples(tuples);
    for (vtkIdType i = 0; i < tuples; ++i)
    {
      array->SetVariantValue(i, vtkVariant(static_cast<double>(7 + i)));
    }
    return vtkSmartPointer<vtkAbstractArray>(array);
  };
  const auto run = [](vtkAbstractArray* own, vtkAbstractArray* theirs)
  {
    const auto cloud = ToMesh(Square),
               lines = MakeLines({ { 1, 2, 9 }, { 3, 2, 9 } }, { { 0, 1 } });
    cloud->GetPointData()->AddArray(own);
    lines->GetPointData()->AddArray(theirs);
    PointsFilter filter(cloud);
    filter->SetSegmentsData(lines);
    Mesh output = filter.Run();
    EXPECT_EQ(filter.GetErrors(), std::vector<std::string>());
    EXPECT_EQ(filter.GetWarnings().size(), theirs->GetNumberOfTuples() < 2 ? 1u : 0u);
    return output;
  };
  const auto integers = ofType(vtkSmartPointer<vtkIntArray>::New(), 2);
  const auto floats = ofType(vtkSmartPointer<vtkFloatArray>::New(), 2);
  const auto doubles = ofType(vtkSmartPointer<vtkDoubleArray>::New(), 2);
  const auto texts = ofType(vtkSmartPointer<vtkStringArray>::New(), 2);
  const auto few = ofType(vtkSmartPointer<vtkDoubleArray>::New(), 1);
  const auto own = MakeArray<vtkDoubleArray>("v", 4);
  const auto whole = MakeArray<vtkIntArray>("v", 4);
  own->FillValue(2.0);
  whole->FillValue(2);
  const auto expect = [](const Mesh& output, double value, double other)
  {
    vtkPointData* data = output->GetPointData();
    EXPECT_EQ(data->GetArray("v")->GetTuple1(4), value);
    vtkAbstractArray* more = data->GetAbstractArray("v (2)");
    EXPECT_EQ(more != nullptr, other > 0.0);
    EXPECT_TRUE(!more || more->GetVariantValue(4).ToDouble() == other);
  };
  expect(run(own, doubles), 7.0, 0.0);
  expect(run(own, floats), 7.0, 0.0);
  expect(run(own, integers), 7.0, 0.0);
  expect(run(own, texts), 2.0, 7.0);
  expect(run(own, few), 2.0, 0.0);
  expect(run(whole, integers), 7.0, 0.0);
  expect(run(whole, doubles), 2.0, 7.0);
}

/// The second input's values stay where their array is added under another name, also if the first
/// input has an array of that name.
TEST(FromPoints, ArraysOfOtherTypesInBothInputs)
{
  const auto addSegment = [](vtkPolyData* points, double y, double value)
  {
    const auto line = MakeLines({ { 1, y, 0 }, { 2, y, 0 } }, { { 0, 1 } });
    const auto values = MakeArray<vtkDoubleArray>("a", 2);
    values->FillValue(value);
    line->GetPointData()->AddArray(values);
    PointsFilter filter(points);
    filter->SetSegmentsData(line);
    Mesh output = Mesh::New();
    output->ShallowCopy(filter.Run());
    return output;
  };
  const auto first = ToMesh({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 } });
  AddNumbers(first->GetPointData(), "a", 4, 1);
  const auto once = addSegment(first, 1, 0.5);
  const auto twice = addSegment(once, 3, 77);
  vtkDataArray* values = twice->GetPointData()->GetArray("a (2)");
  const double expected[] = { 0, 0, 0, 0, 0.5, 0.5, 77, 77 };
  ASSERT_TRUE(values);
  ASSERT_EQ(values->GetNumberOfTuples(), 8);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    EXPECT_EQ(values->GetComponent(i, 0), expected[i]) << i;
  }
}

TEST(FromPoints, SizesOfBothInputs)
{
  const auto refine = [](vtkAbstractArray* theirs)
  {
    const auto cloud = ToMesh(MakeCloud(30, 1.0));
    const auto lines = MakeLines({ { 0.3, 0.3, 1 }, { 0.45, 0.45, 1 } }, { { 0, 1 } });
    const auto sizes = MakeArray<vtkDoubleArray>("size", 30);
    sizes->FillValue(0.2);
    cloud->GetPointData()->AddArray(sizes);
    if (theirs)
    {
      lines->GetPointData()->AddArray(theirs);
    }
    PointsFilter filter(cloud);
    filter->SetSegmentsData(lines);
    filter->SetSizeArray("size");
    filter.Run();
    EXPECT_EQ(filter.GetErrors(), std::vector<std::string>());
    return filter->GetOutput()->GetNumberOfPoints();
  };
  const auto doubles = MakeArray<vtkDoubleArray>("size", 2);
  const auto integers = MakeArray<vtkIntArray>("size", 2);
  doubles->FillValue(1.0);
  integers->FillValue(1);
  const vtkIdType alone = refine(nullptr), together = refine(doubles);
  EXPECT_LT(together, alone);
  EXPECT_EQ(refine(integers), together);
  EXPECT_EQ(refine(MakeArray<vtkStringArray>("size", 2)), alone);
  EXPECT_EQ(refine(MakeArray<vtkDoubleArray>("size", 1)), alone);
  EXPECT_EQ(refine(MakeArray<vtkDoubleArray>("size", 2, 2)), alone);

  // Where a point of a segment is nowhere, there is no limit.
  const auto cloud = ToMesh(Square);
  AddNumbers(cloud->GetPointData(), "size", 4, 2);
  PointsFilter filter(cloud);
  filter->SetSegmentsData(MakeLines({ { 1, 1, 0 }, { NAN, 1, 0 } }, { { 0, 1 } }));
  filter->SetSizeArray("size");
  ExpectHolds(RunToWarning(filter), "not finite");
}

TEST(FromPoints, IdsOfSegments)
{
  // With the shorter diagonal these would be Delaunay.
  const Points points = { { 0, 0, 0 }, { 4, -1, 0 }, { 8, 0, 0 }, { 4, 1, 0 } };
  auto lines = MakeLines(points, { { 0, 2 } });
  auto idsOnly = MakeLines({ { 0, 2 } });
  auto floats = MakeLines(points, { { 0, 2 } });
  ReplacePoints<vtkFloatArray>(floats);
  for (vtkPolyData* segments : { lines.Get(), idsOnly.Get(), floats.Get() })
  {
    PointsFilter filter(ToMesh(points));
    filter->SetSegmentsData(segments);
    const auto output = RunCleanly(filter);
    EXPECT_TRUE(HasEdge(output, 0, 2));
    EXPECT_EQ(output->GetNumberOfPoints(), 4);
  }
  for (const bool asSegments : { false, true })
  {
    PointsFilter filter(lines);
    filter->SetLinesAsSegments(asSegments);
    const auto output = RunCleanly(filter);
    EXPECT_EQ(HasEdge(output, 0, 2), asSegments);
    EXPECT_EQ(output->GetNumberOfLines(), 0);
  }
  PointsFilter wrong(ToMesh(points));
  wrong->SetSegmentsData(MakeLines(points, { { 0, 1 }, { 0, 9 } }));
  ExpectHolds(RunToError(wrong), "segment cell 1 names point 9, but there are 4 points");
}

TEST(FromPoints, Crossings)
{
  auto cloud = ToMesh(Square);
  auto heights = MakeArray<vtkDoubleArray>("height", 4);
  for (vtkIdType i = 0; i < 4; ++i)
  {
    heights->SetValue(i, 10.0 * static_cast<double>(i));
  }
  cloud->GetPointData()->SetScalars(heights);
  AddNumbers(cloud->GetPointData(), "Id", 4, 100);
  cloud->GetPointData()->SetActiveGlobalIds("Id");
  auto ghosts = MakeArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 4);
  ghosts->FillValue(2);
  cloud->GetPointData()->AddArray(ghosts);
  for (const bool splits : { false, true })
  {
    PointsFilter filter(cloud);
    filter->SetSegmentsData(MakeLines(Square, { { 0, 2 }, { 1, 3 } }));
    filter->SetSplitCrossings(splits);
    if (!splits)
    {
      ExpectHolds(RunToWarning(filter), "cross");
      EXPECT_EQ(filter->GetNumberOfRefusedSegments(), 1);
      EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
      continue;
    }
    const auto output = RunCleanly(filter);
    ASSERT_EQ(output->GetNumberOfPoints(), 5);
    EXPECT_EQ(output->GetPoint(4)[0], 2.0);
    EXPECT_EQ(output->GetPoint(4)[1], 2.0);
    EXPECT_EQ(output->GetPoint(4)[2], 2.0); // between 1 and 3, of the earlier segment
    EXPECT_EQ(output->GetPointData()->GetScalars()->GetTuple1(4), 10.0);
    ASSERT_NE(output->GetPointData()->GetPedigreeIds(), nullptr);
    EXPECT_EQ(output->GetPointData()->GetPedigreeIds()->GetVariantValue(4).ToInt(), 0);
    EXPECT_EQ(output->GetPointData()->GetArray(ghosts->GetName())->GetTuple1(4), 0.0);
    EXPECT_EQ(GetTotal(output, "Crossings"), 1.0);
    ExpectHolds(filter->GetSummary(), "mesh: 5 points, ");
    EXPECT_EQ(filter.GetPolygons().size(), 4u);
    EXPECT_EQ(cloud->GetNumberOfPoints(), 4);
  }
  // Integers would cut the crossing.
  vtkNew<vtkPoints> corners;
  corners->SetDataTypeToInt();
  for (const auto& [x, y] : { std::pair(0, 0), { 1, 0 }, { 1, 1 }, { 0, 1 } })
  {
    corners->InsertNextPoint(x, y, 0);
  }
  cloud->SetPoints(corners);
  cloud->SetLines(MakeLines(Square, { { 0, 2 }, { 1, 3 } })->GetLines());
  PointsFilter filter(cloud);
  filter->LinesAsSegmentsOn();
  filter->SplitCrossingsOn();
  const auto output = RunCleanly(filter);
  ASSERT_EQ(output->GetNumberOfPoints(), 5);
  EXPECT_EQ(output->GetPoint(4)[0], 0.5);
  EXPECT_EQ(output->GetPoint(4)[1], 0.5);
  auto floats =
    MakeLines({ { 0, 0, 1 }, { 1, 0, 2 }, { 1, 1, Inf }, { 0, 1, 4 } }, { { 0, 2 }, { 1, 3 } });
  ReplacePoints<vtkFloatArray>(floats);
  PointsFilter infinite(floats);
  infinite->LinesAsSegmentsOn();
  infinite->SplitCrossingsOn();
  EXPECT_EQ(RunCleanly(infinite)->GetPoint(4)[2], Inf);
}

TEST(FromPoints, OutlinesAndHoles)
{
  Points points = MakeCloud(400);
  for (auto& point : points)
  {
    point[2] = 0.0; // as the rings have
  }
  const Points outline = { { 1, 1, 0 }, { 9, 1, 0 }, { 9, 9, 0 }, { 1, 9, 0 } };
  const Points hole = { { 4, 4, 0 }, { 6, 4, 0 }, { 6, 6, 0 }, { 4, 6, 0 } };
  Points both = outline;
  both.insert(both.end(), hole.begin(), hole.end());
  const auto measure = [](vtkPolyData* mesh)
  {
    double area = 0.0;
    for (const Cell& cell : GetCells(mesh->GetPolys()))
    {
      double a[3], b[3], c[3];
      mesh->GetPoint(cell[0], a);
      mesh->GetPoint(cell[1], b);
      mesh->GetPoint(cell[2], c);
      area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    }
    return area;
  };
  struct Case
  {
    Cells Rings;
    int Rule;
    double Area;
    vtkIdType FirstHole;
  };
  const Cells nested = { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } };
  const Cells opposite = { { 0, 1, 2, 3 }, { 7, 6, 5, 4 } };
  const std::vector<Case> cases = {
    { nested, vtkDelaunayFlipPoints::RING_RULE_EVEN_ODD, 60.0, 2 },
    { nested, vtkDelaunayFlipPoints::RING_RULE_ORIENTATION, 64.0, 2 },
    { opposite, vtkDelaunayFlipPoints::RING_RULE_ORIENTATION, 60.0, 2 },
    { opposite, vtkDelaunayFlipPoints::RING_RULE_NON_ZERO, 60.0, 2 },
    { nested, vtkDelaunayFlipPoints::RING_RULE_NON_ZERO, 64.0, 2 },
    { nested, vtkDelaunayFlipPoints::RING_RULE_NON_ZERO, 60.0, 1 },
  };
  for (const Case& each : cases)
  {
    PointsFilter filter(ToMesh(points));
    filter->SetSegmentsData(MakeMesh(both, each.Rings));
    filter->SetRingRule(each.Rule);
    filter->SetFirstHole(each.FirstHole);
    const auto output = RunCleanly(filter);
    EXPECT_NEAR(measure(output), each.Area, 1e-9);
    EXPECT_GT(GetTotal(output, "OutsideTriangles"), 0.0);
  }
  PointsFilter crossed(ToMesh(points));
  crossed->SetSegmentsData(MakeMesh(Square, { { 0, 1, 3, 2 } }));
  ExpectHolds(RunToError(crossed), "ring 0 from point 4");
}

/// Closed by the first id, or by another point at its place.
TEST(FromPoints, ClosedLinesAreRings)
{
  const Points corners = { { 1, 1, 5 }, { 9, 1, 5 }, { 9, 9, 5 }, { 1, 9, 5 }, { 1, 1, 5 } };
  for (const Cells& lines : { Cells{ { 0, 1, 2, 3, 0 } }, Cells{ { 0, 1, 2, 3, 4 } } })
  {
    PointsFilter filter(ToMesh(MakeCloud(400)));
    filter->SetSegmentsData(MakeLines(corners, lines));
    EXPECT_GT(GetTotal(RunCleanly(filter), "OutsideTriangles"), 0.0);
    filter->ClosedLinesAsRingsOff();
    const auto output = RunCleanly(filter);
    EXPECT_EQ(GetTotal(output, "OutsideTriangles"), 0.0);
    EXPECT_GE(GetTotal(output, "SegmentEdges"), 4.0);
  }
  PointsFilter own(MakeLines(corners, { { 0, 1, 2, 3, 4 } })); // with the points of the input
  own->SetSegmentsData(MakeLines(corners, { { 0, 1, 2, 4 } }));
  ExpectHolds(RunToWarning(own), "1 duplicate point skipped");
  EXPECT_EQ(own->GetOutput()->GetNumberOfPolys(), 1);
}

/// Points of segments, of which those of a hole have heights, in a survey of a plane.
TEST(FromPoints, HeightsOfSegments)
{
  Points corners = MakeCloud(300);
  corners.insert(corners.end(), { { 0, 0, 0 }, { 10, 0, 0 }, { 10, 10, 0 }, { 0, 10, 0 } });
  for (auto& point : corners)
  {
    point[2] = 5.0 + point[0] - 2.0 * point[1];
  }
  auto survey = ToMesh(corners);
  const auto count = static_cast<vtkIdType>(corners.size());
  auto reals = MakeArray<vtkDoubleArray>("reals", count, 2);
  auto integers = MakeArray<vtkIntArray>("integers", count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    reals->SetTuple2(i, corners[i][0], corners[i][1]);
    integers->SetValue(i, static_cast<int>(100.0 * corners[i][0]));
  }
  survey->GetPointData()->AddArray(reals);
  survey->GetPointData()->AddArray(integers);
  AddNumbers(survey->GetPointData(), "both", count, 0);
  AddNumbers(survey->GetPointData(), "ids", count, 0);
  survey->GetPointData()->SetActiveGlobalIds("ids");
  // An outline that reaches over the survey, and a hole.
  auto rings = MakeMesh(
    { { 1, 1, 0 }, { 9, 1, 0 }, { 9, 12, 0 }, { 1, 9, 0 }, { 3, 3, 7 }, { 4, 3, 7 }, { 4, 4, 7 } },
    { { 0, 1, 2, 3 }, { 4, 5, 6 } });
  AddNumbers(rings->GetPointData(), "both", 7, 70);
  struct Case
  {
    int Choice;
    double OfOutline, OfHole;
    const char* Warning;
  };
  const std::vector<Case> cases = {
    { vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_AUTO, 4.0, 7.0,
      "4 points of segments without heights (z = 0 throughout; the given points have z = -15 to "
      "15): they have got the heights of the given points there; SegmentHeights Own keeps z = 0" },
    { vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_SURVEY, 4.0, 2.0, nullptr },
    { vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_OWN, 0.0, 7.0, nullptr },
  };
  for (const Case& each : cases)
  {
    PointsFilter filter(survey);
    filter->SetSegmentsData(rings);
    filter->SetFirstHole(1);
    filter->SetSegmentHeights(each.Choice);
    Mesh output = filter->GetOutput();
    if (each.Warning)
    {
      ExpectHolds(RunToWarning(filter), each.Warning);
    }
    else
    {
      output = RunCleanly(filter);
    }
    EXPECT_NEAR(output->GetPoint(count)[2], each.OfOutline, 1e-12);
    EXPECT_NEAR(output->GetPoint(count + 4)[2], each.OfHole, 1e-12);
    vtkPointData* data = output->GetPointData();
    EXPECT_NEAR(data->GetArray("reals")->GetComponent(count + 2, 1), 10.0, 1e-12);
    EXPECT_NEAR(data->GetArray("reals")->GetComponent(count + 4, 0), 3.0, 1e-12);
    EXPECT_NEAR(data->GetArray("integers")->GetTuple1(count), 100.0, 1.0);
    EXPECT_EQ(data->GetArray("both")->GetTuple1(count), 70.0);
    EXPECT_EQ(data->GetArray("ids")->GetTuple1(count), 0.0);
    EXPECT_EQ(rings->GetPoint(0)[2], 0.0);
  }
  PointsFilter projected(survey);
  projected->SetSegmentsData(rings);
  projected->SetFirstHole(1);
  projected->SetProjectionToBestFittingPlane();
  projected->SetSegmentHeightsToSurvey();
  ExpectHolds(RunToError(projected, vtkDelaunayFlip::FAILURE_OPTIONS), "another projection");
  // Without triangles of their own, points have no heights for others.
  PointsFilter line(ToMesh({ { 0, 0, 1 }, { 1, 1, 2 }, { 2, 2, 3 } }));
  line->SetSegmentsData(MakeLines({ { 3, 3, 0 }, { 0, 5, 0 } }, { { 0, 1 } }));
  ExpectHolds(RunToWarning(line), "the mesh goes to z = 0 there");
}

/// A point of a line with a z that is not finite has no height.
TEST(FromPoints, LinesWithHolesInTheirHeights)
{
  Points corners = MakeCloud(400);
  for (auto& point : corners)
  {
    point[2] = 5.0;
  }
  const auto count = static_cast<vtkIdType>(corners.size());
  const double inf = std::numeric_limits<double>::infinity();
  const auto lines =
    MakeLines({ { 2, 2, 7 }, { 3, 2, NAN }, { 4, 2, 9 }, { 5, 2, -inf } }, { { 0, 1, 2, 3 } });
  const std::vector<std::pair<int, const char*>> cases = {
    { vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_AUTO,
      "2 points of segments without heights (z is not finite; the given points have z = 5 to 5): "
      "they have got the heights of the given points there; SegmentHeights Own keeps their z" },
    { vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_SURVEY, nullptr },
    { vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_OWN,
      "2 points of segments without heights (z is not finite; the given points have z = 5 to 5): "
      "the mesh has no heights there; if it should, give them heights" },
  };
  for (const auto& [choice, warning] : cases)
  {
    PointsFilter filter(ToMesh(corners));
    filter->SetSegmentsData(lines);
    filter->SetSegmentHeights(choice);
    Mesh output = filter->GetOutput();
    if (warning)
    {
      ExpectHolds(RunToWarning(filter), warning);
    }
    else
    {
      output = RunCleanly(filter);
    }
    const bool isOwn = choice == vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_OWN;
    for (const vtkIdType unknown : { count + 1, count + 3 })
    {
      const bool isSurveyed = std::fabs(output->GetPoint(unknown)[2] - 5.0) < 1e-12;
      EXPECT_NE(isSurveyed, isOwn);
    }
    const bool isSurvey = choice == vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_SURVEY;
    EXPECT_NEAR(output->GetPoint(count)[2], isSurvey ? 5.0 : 7.0, 1e-12);
  }
}

/// On a globe, z of stations and of lines is in an array, which can be interpolated.
TEST(FromPoints, HeightsOfStations)
{
  Points stations;
  for (int i = 0; i < 200; ++i)
  {
    stations.push_back({ std::fmod(137.5 * i, 360.0) - 180.0, 0.89 * i - 89.0, 100.0 });
  }
  const auto run = [&stations](vtkPolyData* lines, int choice)
  {
    PointsFilter filter(ToMesh(stations));
    filter->SetSegmentsData(lines);
    filter->SetSegmentHeights(choice);
    filter->SetProjectionToSphere();
    filter->DegreesOn();
    return RunCleanly(filter);
  };
  const int automatic = vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_AUTO;
  for (const double height : { 0.0, 30.0 })
  {
    const auto lines = MakeLines({ { 11, 12, height }, { 14, 13, height } }, { { 0, 1 } });
    for (const int choice : { automatic, int(vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_OWN) })
    {
      const Mesh output = run(lines, choice);
      vtkDataArray* heights = output->GetPointData()->GetArray("Height");
      ASSERT_NE(heights, nullptr);
      EXPECT_EQ(heights->GetNumberOfTuples(), 202);
      EXPECT_EQ(heights->GetTuple1(7), 100.0);
      const bool isSurveyed = height == 0.0 && choice == automatic;
      EXPECT_NEAR(heights->GetTuple1(201), isSurveyed ? 100.0 : height, 1e-9);
    }
  }
  const Mesh unknown = run(MakeLines({ { 11, 12, 30 }, { 14, 13, NAN } }, { { 0, 1 } }), automatic);
  EXPECT_EQ(unknown->GetPointData()->GetArray("Height")->GetTuple1(200), 30.0);
  EXPECT_NEAR(unknown->GetPointData()->GetArray("Height")->GetTuple1(201), 100.0, 1e-9);
  for (auto& station : stations)
  {
    station[2] = 0.0;
  }
  const auto line = MakeLines({ { 11, 12, 0 }, { 14, 13, 0 } }, { { 0, 1 } });
  EXPECT_EQ(run(line, automatic)->GetPointData()->GetArray("Height"), nullptr);
  stations[0][2] = 1.0;
  const auto named = ToMesh(stations);
  AddNumbers(named->GetPointData(), "Height", 200, 0);
  PointsFilter taken(named);
  taken->SetProjectionToSphere();
  taken->DegreesOn();
  ExpectHolds(RunToWarning(taken), "z left out, because the points have an array \"Height\"");
  EXPECT_EQ(taken->GetOutput()->GetPointData()->GetArray("Height")->GetTuple1(9), 9.0);
  for (const double z : { 0.0, 5.0 })
  {
    const auto lines = MakeLines({ { 11, 12, z }, { 14, 13, z } }, { { 0, 1 } });
    AddNumbers(lines->GetPointData(), "Height", 2, 0);
    PointsFilter filter(ToMesh(stations));
    filter->SetSegmentsData(lines);
    filter->SetSegmentHeightsToOwn();
    filter->SetProjectionToSphere();
    filter->DegreesOn();
    filter.Run();
    EXPECT_EQ(filter.GetErrors(), std::vector<std::string>{});
    EXPECT_EQ(filter.GetWarnings().size(), z == 0.0 ? 0u : 1u);
    for (const std::string& warning : filter.GetWarnings())
    {
      ExpectHolds(warning, "segments: z left out, because they have an array \"Height\"");
    }
  }
}

TEST(FromPoints, RingsWithoutAreaAreLeftOut)
{
  Points points = MakeCloud(400);
  const Points corners = { { 1, 1, 0 }, { 9, 1, 0 }, { 9, 9, 0 }, { 1, 9, 0 }, { 5, 5, 0 } };
  PointsFilter filter(ToMesh(points));
  filter->SetSegmentsData(MakeMesh(corners, { { 0, 1, 2, 3 }, { 0, 4 }, { 4 }, { 0, 4, 2 } }));
  ExpectHolds(RunToWarning(filter), "3 rings without an area, left out (first: 1, 2, 3)");
  EXPECT_GT(GetTotal(filter->GetOutput(), "OutsideTriangles"), 0.0);
}

//------------------------------------------------------------------------------
TEST(FromPoints, CompositeInput)
{
  const auto first = ToMesh(MakeCloud(100)), second = ToMesh(MakeCloud(60, 3.0));
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  vtkNew<vtkPolyData> none;
  const Mesh segments = MakeLines({ { 1, 1, 5 }, { 2, 2, 5 } }, { { 0, 1 } });
  PointsFilter filter(MakeBlocks({ first, image, second }));
  filter->SetInputDataObject(1, MakeBlocks({ none, none, segments }));
  ExpectHolds(RunToWarning(filter), "block 2: has no points of its own, passed unchanged");
  EXPECT_EQ(filter.GetBlock(0)->GetPoints(), first->GetPoints());
  EXPECT_EQ(filter.GetBlock(2)->GetNumberOfPoints(), 62);
  PointsFilter alone(first);
  RunCleanly(alone);
  EXPECT_EQ(GetCells(filter.GetBlock(0)->GetPolys()), alone.GetPolygons());
  EXPECT_EQ(filter->GetTotalFlips(),
    GetTotal(filter.GetBlock(0), "TotalFlips") + GetTotal(filter.GetBlock(2), "TotalFlips"));
}

TEST(FromPoints, PointsInPartitionsAreAnError)
{
  vtkNew<vtkPartitionedDataSet> parts, whole, segments;
  parts->SetPartition(0, ToMesh(MakeCloud(10)));
  whole->SetPartition(0, ToMesh(Square));
  PointsFilter one(parts);
  one->Update();
  EXPECT_EQ(one.GetErrors().size(), 0u);
  parts->SetPartition(1, ToMesh(MakeCloud(20)));
  segments->SetPartition(0, MakeLines(Square, { { 0, 1 } }));
  segments->SetPartition(1, MakeLines(Square, { { 0, 2 } }));
  PointsFilter several(parts), apart(whole);
  several->Update();
  EXPECT_EQ(several->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
  apart->SetInputDataObject(1, segments);
  apart->Update();
  for (const auto& [filter, text] :
    { std::pair(&several, "the points are in several partitions; join them first"),
      { &apart, "the segments are in several partitions; join them first" } })
  {
    ASSERT_EQ(filter->GetErrors().size(), 1u);
    ExpectHolds(filter->GetErrors()[0], text);
  }
}

TEST(FromPoints, PiecesAreNotLive)
{
  PointsFilter filter(ToMesh(MakeCloud(2000)));
  filter->LiveUpdateOn();
  filter->UpdatePiece(0, 2, 0);
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_FALSE(filter->GetNeedsUpdate());
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  ExpectHolds(filter.GetWarnings()[0], "LiveUpdate is for one mesh in one piece");
}

TEST(FromPoints, LiveUpdate)
{
  auto cloud = ToMesh(MakeCloud(2000));
  PointsFilter atOnce(cloud), live(cloud);
  RunCleanly(atOnce);
  live->LiveUpdateOn();
  live->Update();
  const Cells strips = live.GetPolygons();
  EXPECT_EQ(strips.size(), atOnce.GetPolygons().size());
  EXPECT_NE(strips, atOnce.GetPolygons());
  EXPECT_EQ(live->GetNumberOfIterations(), 1);
  EXPECT_GT(RunToTheEnd(live), 2);
  EXPECT_EQ(live.GetPolygons(), atOnce.GetPolygons());
  live->Update();
  EXPECT_FALSE(live->GetNeedsUpdate());
  MovePoints(cloud, [](double* x) { x[0] *= 1.5; });
  live->Update();
  EXPECT_EQ(live->GetNumberOfIterations(), 1);

  Cell all(cloud->GetNumberOfPoints());
  std::iota(all.begin(), all.end(), 0);
  cloud->SetVerts(MakeCells({ all }));
  AddNumbers(cloud->GetPointData(), "Number", cloud->GetNumberOfPoints(), 0);
  vtkNew<vtkCleanPolyData> maker; // makes other points each time, which are the same
  vtkNew<vtkElevationFilter> passer; // always gives these points
  const auto segments = MakeLines({ { 1, 1, 0 }, { 9, 8, 0 } }, { { 0, 1 } });
  for (PointsFilter* filter : { &live, &atOnce })
  {
    (*filter)->SetSegmentsData(segments);
  }
  atOnce->Update();
  for (vtkAlgorithm* source : std::initializer_list<vtkAlgorithm*>{ maker, passer })
  {
    source->SetInputDataObject(cloud);
    source->ReleaseDataFlagOn(); // so that every update executes it again
    live->SetInputConnection(source->GetOutputPort());
    EXPECT_GT(RunToTheEnd(live), 2);
    EXPECT_EQ(live.GetPolygons(), atOnce.GetPolygons());
  }
}
