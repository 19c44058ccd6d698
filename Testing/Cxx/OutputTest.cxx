// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What the output holds: points, point data and cell data of any type and layout; and what becomes
/// of quads, polygons, strips and cells with too few points.

#include "FilterTestSupport.h"

#include "FlipReport.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkTriangle.h"
#include "vtkVariantArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

/// The rhombus with a vert, a line along its boundary, and cells numbered 10, 11, 12, 13.
Mesh MakeMixedRhombus()
{
  auto mesh = MakeRhombus();
  mesh->SetVerts(MakeCells({ { 3 } }));
  mesh->SetLines(MakeCells({ { 0, 1 } }));
  AddNumbers(mesh->GetCellData(), "Number", 4, 10);
  return mesh;
}

Mesh SetCellNormals(Mesh mesh, double z)
{
  auto normals = MakeArray<vtkFloatArray>("Normals", mesh->GetNumberOfCells(), 3);
  normals->Fill(0.0);
  normals->FillComponent(2, z);
  mesh->GetCellData()->SetNormals(normals);
  return mesh;
}

constexpr double Degrees = 180.0 / 3.14159265358979323846;

/// The smallest angles of half of the rhombus, and of a triangle of 1-3 and an end.
const double AngleBefore = std::atan(1.0 / 3.0) * Degrees, AngleAfter = 2.0 * AngleBefore;

void ExpectAngles(vtkPolyData* mesh, const char* when, const std::vector<double>& expected)
{
  const std::string name = std::string("Smallest angle ") + when + " (degrees)";
  auto* angles = vtkDoubleArray::SafeDownCast(mesh->GetCellData()->GetArray(name.c_str()));
  ASSERT_NE(angles, nullptr) << name;
  ASSERT_EQ(angles->GetNumberOfTuples(), static_cast<vtkIdType>(expected.size()));
  for (std::size_t cell = 0; cell < expected.size(); ++cell)
  {
    const double angle = angles->GetValue(static_cast<vtkIdType>(cell));
    const bool areBothNaN = std::isnan(angle) && std::isnan(expected[cell]);
    EXPECT_TRUE(areBothNaN || std::fabs(angle - expected[cell]) < 1e-12)
      << name << " of " << cell << ": " << angle << " is not " << expected[cell];
  }
}

const Points Grid = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 2, 1, 0 },
  { 0, 2, 0 }, { 1, 2, 0 }, { 2, 2, 0 } };

/// The output of a mesh with numbered cells; `numbers` says which ones its cells come from.
Mesh FlipNumbered(vtkPolyData* mesh, const std::vector<int>& numbers, bool triangulate = true)
{
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  WatchedFilter filter(mesh);
  filter->SetTriangulate(triangulate);
  auto output = RunCleanly(filter);
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), numbers);
  return output;
}

/// A random bad mesh with its points in an array of this type.
template <typename ArrayT>
Mesh MakeBadMesh(double scale = 1.0)
{
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMesh(300, 3));
  ReplacePoints<ArrayT>(mesh,
    [scale](double* x)
    {
      x[0] *= scale;
      x[1] *= scale;
    });
  return mesh;
}

}

TEST(Output, PointsAndTheirDataAreTheSameObjects)
{
  auto mesh = MakeRhombus();
  AddNumbers(mesh->GetPointData(), "Depth", 4, 5);
  mesh->GetPointData()->SetActiveScalars("Depth");
  const auto names = MakeArray<vtkStringArray>("Name", 4);
  mesh->GetPointData()->AddArray(names);
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(output->GetPointData()->GetScalars(), mesh->GetPointData()->GetScalars());
  EXPECT_EQ(output->GetPointData()->GetAbstractArray("Name"), names);
}

TEST(Output, CellsKeepTheirSlotsAndTheInputIsUntouched)
{
  auto mesh = SetCellNormals(MakeMixedRhombus(), 1.0);
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(mesh);
  WatchedFilter filter(mesh);
  EXPECT_EQ(RunCleanly(filter)->GetCellData()->GetArray("vtkDelaunayFlipCount"), nullptr);
  filter->GenerateFlipCountOn();
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_FALSE(HasEdge(output, 0, 2));
  EXPECT_EQ(GetCells(output->GetVerts()), Cells({ { 3 } }));
  EXPECT_EQ(GetCells(output->GetLines()), Cells({ { 0, 1 } }));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 10, 11, 12, 13 }));
  EXPECT_EQ(
    GetNumbers(output->GetCellData(), "vtkDelaunayFlipCount"), std::vector<int>({ 0, 0, 1, 1 }));
  EXPECT_EQ(GetCells(mesh->GetPolys()), GetCells(copy->GetPolys()));
  EXPECT_EQ(mesh->GetCellData()->GetNumberOfArrays(), copy->GetCellData()->GetNumberOfArrays());
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 0);
}

TEST(Output, NormalsOfChangedTrianglesAreRenewed)
{
  // Folded by about 20 degrees along the diagonal 0-2, and a third triangle with edges that cannot
  // flip. The normals are not of unit length, unlike computed ones.
  auto mesh = SetCellNormals(MakeMesh({ { -3, 0, 0 }, { 0, -1, 0.1 }, { 3, 0, 0 }, { 0, 1, 0.1 },
                                        { 10, 0, 0 }, { 11, 0, 0 }, { 10, 1, 0 } },
                               { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 } }),
    0.5);
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  ASSERT_EQ(filter->GetTotalFlips(), 1);
  vtkDataArray* normals = output->GetCellData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  // (0, 1, 3) and (1, 2, 3) rise from z = 0 at x = -3 and 3 to 0.1 at x = 0.
  for (vtkIdType cell = 0; cell < 2; ++cell)
  {
    const Cell ids = GetCell(output, cell);
    const double left = std::count(ids.begin(), ids.end(), 0) ? -1.0 : 1.0;
    EXPECT_NEAR(normals->GetComponent(cell, 0), left * 0.1 / std::sqrt(9.01), 1e-6);
    EXPECT_NEAR(normals->GetComponent(cell, 1), 0.0, 1e-6);
    EXPECT_NEAR(normals->GetComponent(cell, 2), 3.0 / std::sqrt(9.01), 1e-6);
  }
  EXPECT_DOUBLE_EQ(normals->GetComponent(2, 2), 0.5);
  EXPECT_DOUBLE_EQ(mesh->GetCellData()->GetNormals()->GetComponent(0, 2), 0.5);
  WatchedFilter against(SetCellNormals(MakeRhombus(), -1.0)); // the winding
  EXPECT_DOUBLE_EQ(RunCleanly(against)->GetCellData()->GetNormals()->GetComponent(1, 2), -1.0);
  auto bits = MakeArray<vtkBitArray>("Bits", 2, 3);
  bits->Fill(0.0);
  against->GetPolyDataInput(0)->GetCellData()->SetNormals(bits);
  against->Modified();
  EXPECT_STREQ(RunCleanly(against)->GetCellData()->GetNormals()->GetName(), "Bits");
}

TEST(Output, CellNormalsFollowTheWindingWhereTrianglesTurn)
{
  // A plane bent by most of a turn. Its triangles turn with the flips, many by more than 90
  // degrees.
  auto mesh = MakeBadMesh<vtkDoubleArray>();
  double bounds[6];
  mesh->GetBounds(bounds);
  ReplacePoints<vtkDoubleArray>(mesh,
    [&](double* x)
    {
      const double angle = 5.0 * (x[0] - bounds[0]) / (bounds[1] - bounds[0]);
      x[0] = 0.2 * (bounds[1] - bounds[0]) * std::cos(angle);
      x[2] = 0.2 * (bounds[1] - bounds[0]) * std::sin(angle);
    });
  SetCellNormals(mesh, 0.0);
  const auto findNormal = [](vtkPolyData* of, vtkIdType cell)
  {
    const Cell ids = GetCell(of, cell);
    Points::value_type corners[3], normal;
    for (int i = 0; i < 3; ++i)
    {
      of->GetPoint(ids[i], corners[i].data());
    }
    vtkTriangle::ComputeNormal(
      corners[0].data(), corners[1].data(), corners[2].data(), normal.data());
    return normal;
  };
  vtkDataArray* given = mesh->GetCellData()->GetNormals();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    given->SetTuple(cell, findNormal(mesh, cell).data());
  }
  WatchedFilter filter(mesh);
  filter->SetGeometryToSurface();
  filter->SetFeatureAngle(180.0);
  auto output = RunCleanly(filter);
  std::size_t turned = 0;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    const auto normal = findNormal(output, cell);
    double before[3], after[3];
    given->GetTuple(cell, before);
    output->GetCellData()->GetNormals()->GetTuple(cell, after);
    turned += vtkMath::Dot(before, normal.data()) < 0.0 ? 1 : 0;
    EXPECT_LT(0.999, vtkMath::Dot(normal.data(), after)) << "cell " << cell;
  }
  EXPECT_LT(10u, turned);
}

TEST(Output, AnglesPerTriangle)
{
  WatchedFilter filter(MakeMixedRhombus());
  EXPECT_EQ(RunCleanly(filter)->GetCellData()->GetNumberOfArrays(), 1);
  filter->GenerateQualityOn();
  auto output = RunCleanly(filter);
  ExpectAngles(output, "before", { NAN, NAN, AngleBefore, AngleBefore });
  ExpectAngles(output, "after", { NAN, NAN, AngleAfter, AngleAfter });

  // The rhombus as a quad, a degenerate triangle, one with a NaN, and a cell of two points.
  const Points points = { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 9, 0, 0 },
    { 10, 0, 0 }, { 11, 0, 0 }, { NAN, 1, 0 } };
  WatchedFilter mixed(MakeMesh(points, { { 0, 1, 2, 3 }, { 4, 5, 6 }, { 5, 6, 7 }, { 4, 5 } }));
  mixed->GenerateQualityOn();
  mixed->SetGeometryToPlanarXY();
  ExpectAngles(mixed.Run(), "before", { AngleBefore, AngleBefore, 0, NAN, NAN });
  ExpectAngles(mixed.Run(), "after", { AngleAfter, AngleAfter, 0, NAN, NAN });
  mixed->TriangulateOff();
  ExpectAngles(mixed.Run(), "after", { NAN, 0, NAN, NAN });

  auto terrain = MakeRhombus(); // The angles of terrain are those of its projection.
  terrain->GetPoints()->SetPoint(1, 0, -1, 50);
  filter->SetInputData(terrain);
  filter->SetGeometryToPlanarXY();
  output = RunCleanly(filter);
  ExpectAngles(output, "before", { AngleBefore, AngleBefore });
  EXPECT_DOUBLE_EQ(filter->GetReport().MinimumAngleAfter,
    output->GetCellData()->GetArray("Smallest angle after (degrees)")->GetRange()[0]);
}

TEST(Output, GlobalIdsBecomePedigreeIdsWhereACellIsSplit)
{
  for (const bool hasOwn : { false, true })
  {
    auto mesh = MakeQuadAndTriangle();
    AddNumbers(mesh->GetCellData(), "Id", 2, 7);
    mesh->GetCellData()->SetActiveGlobalIds("Id");
    auto own = MakeArray<vtkStringArray>("Own", 2);
    own->SetValue(0, "quad");
    mesh->GetCellData()->SetPedigreeIds(hasOwn ? own.Get() : nullptr);
    WatchedFilter filter(mesh);
    vtkCellData* data = RunCleanly(filter)->GetCellData();
    EXPECT_EQ(data->GetGlobalIds(), nullptr);
    ASSERT_NE(data->GetPedigreeIds(), nullptr);
    EXPECT_EQ(data->GetPedigreeIds()->GetVariantValue(1).ToString(), hasOwn ? "quad" : "7");
    EXPECT_EQ(GetNumbers(data, "Id"), std::vector<int>({ 7, 7, 8 }));
    EXPECT_NE(mesh->GetCellData()->GetGlobalIds(), nullptr);
  }
  auto whole = MakeRhombus();
  AddNumbers(whole->GetCellData(), "Id", 2, 7);
  whole->GetCellData()->SetActiveGlobalIds("Id");
  WatchedFilter filter(whole);
  EXPECT_NE(RunCleanly(filter)->GetCellData()->GetGlobalIds(), nullptr);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetPedigreeIds(), nullptr);
}

/// Also where they have no name.
TEST(Output, ArraysMayBeSeveralAttributes)
{
  auto mesh = SetCellNormals(MakeQuadAndTriangle(), 1.0);
  vtkCellData* given = mesh->GetCellData();
  AddNumbers(given, "Id", 2, 7);
  given->SetActiveGlobalIds("Id");
  given->SetActiveScalars("Id");
  given->SetActiveVectors("Normals");
  for (const bool areNamed : { true, false })
  {
    given->GetGlobalIds()->SetName(areNamed ? "Id" : nullptr);
    given->GetNormals()->SetName(areNamed ? "Normals" : nullptr);
    WatchedFilter filter(mesh);
    vtkCellData* data = RunCleanly(filter)->GetCellData();
    EXPECT_EQ(data->GetNumberOfArrays(), 2);
    ASSERT_NE(data->GetScalars(), nullptr);
    EXPECT_EQ(data->GetPedigreeIds(), data->GetScalars());
    ASSERT_NE(data->GetNormals(), nullptr);
    EXPECT_EQ(data->GetVectors(), data->GetNormals());
  }
}

TEST(Output, LabelsOfRegionsAreNoGlobalIds)
{
  auto mesh = MakeRhombus();
  mesh->GetCellData()->SetGlobalIds(MakeArray<vtkIdTypeArray>("Region", 2));
  WatchedFilter filter(mesh);
  filter->AddRegion(0.0, 0.5, 7.0, 0.0);
  vtkCellData* data = RunCleanly(filter)->GetCellData();
  EXPECT_EQ(data->GetNumberOfArrays(), 1);
  EXPECT_EQ(data->GetArray("Region")->GetTuple1(0), 7.0);
  EXPECT_EQ(data->GetGlobalIds(), nullptr);
  EXPECT_EQ(data->GetPedigreeIds(), nullptr);
}

TEST(Output, CellDataOfAllTypesFollowTheirCells)
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays = { MakeArray<vtkSOADataArrayTemplate<float>>(
    "Value", 2) };
  for (const int type : { VTK_BIT, VTK_CHAR, VTK_UNSIGNED_SHORT, VTK_ID_TYPE, VTK_DOUBLE })
  {
    arrays.push_back(vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type)));
    arrays.back()->SetName("Value");
    arrays.back()->SetNumberOfTuples(2);
  }
  for (const auto& values : arrays)
  {
    auto mesh = MakeQuadAndTriangle();
    values->SetComponent(0, 0, 1.0);
    values->SetComponent(1, 0, 0.0);
    mesh->GetCellData()->AddArray(values);
    auto names = MakeArray<vtkStringArray>("Name", 2);
    names->SetValue(0, "quad");
    mesh->GetCellData()->AddArray(names);
    auto variants = MakeArray<vtkVariantArray>("Variant", 2);
    variants->SetValue(0, vtkVariant(2.5));
    mesh->GetCellData()->AddArray(variants);
    auto output = FlipNumbered(mesh, { 0, 0, 1 });
    vtkCellData* data = output->GetCellData();
    vtkDataArray* copied = data->GetArray("Value");
    ASSERT_NE(copied, nullptr) << values->GetClassName();
    EXPECT_EQ(copied->GetDataType(), values->GetDataType());
    for (vtkIdType cell = 0; cell < 3; ++cell)
    {
      EXPECT_EQ(copied->GetComponent(cell, 0), cell < 2 ? 1.0 : 0.0) << values->GetClassName();
    }
    EXPECT_EQ(data->GetAbstractArray("Name")->GetVariantValue(1).ToString(), "quad");
    EXPECT_EQ(data->GetAbstractArray("Variant")->GetVariantValue(1).ToDouble(), 2.5);
  }
}

TEST(OutputCells, QuadsSplitAlongTheirFirstDiagonalUnlessItRunsOutside)
{
  auto ties = FlipNumbered(MakeMesh(Grid, { { 0, 1, 4, 3 }, { 1, 2, 5, 4 } }), { 0, 0, 1, 1 });
  EXPECT_TRUE(HasEdge(ties, 0, 4) && HasEdge(ties, 1, 5));
  // An arrow head, in which 0-2 runs outside because of the reflex corner 3; and a folded quad.
  for (const Points& points : { Points{ { 0, 0, 0 }, { 2, 1, 0 }, { 0, 2, 0 }, { 1, 1, 0 } },
         Points{ { 0, 4, 0 }, { -1, 0, 2 }, { 0, -4, 0 }, { 1, 0, 2 } } })
  {
    WatchedFilter filter(MakeMesh(points, { { 0, 1, 2, 3 } }));
    filter->SetMaximumIterations(0);
    EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3));
  }
}

TEST(OutputCells, PolygonsAndStripsAreSplit)
{
  FlipNumbered(MakeMesh(Grid, { { 0, 1, 4, 3 }, { 1, 2, 4 }, { 4, 2, 5, 8, 7 }, { 3, 4, 7, 6 } }),
    { 0, 0, 1, 2, 2, 2, 3, 3 });
  auto mesh = MakeMesh(Grid, { { 3, 4, 6 }, { 4, 7, 6 } });
  mesh->SetVerts(MakeCells({ { 8 } }));
  mesh->SetStrips(MakeCells({ { 3, 0, 4, 1, 5, 2 } }));
  auto output = FlipNumbered(mesh, { 0, 1, 2, 3, 3, 3, 3 });
  EXPECT_EQ(output->GetNumberOfStrips(), 0);
  // All have the same winding: that of a strip's odd triangles is reversed.
  EXPECT_EQ(GetCell(output, 3), Cell({ 3, 0, 4 }));
  EXPECT_EQ(GetCell(output, 4), Cell({ 4, 0, 1 }));
}

TEST(OutputCells, OfTooFewPointsPass)
{
  for (const bool triangulate : { true, false })
  {
    auto mesh = MakeRhombus();
    mesh->SetPolys(MakeCells({ { 0, 1 }, { 0, 1, 2 }, {}, { 0, 2, 3 }, { 2 } }));
    mesh->SetStrips(MakeCells({ { 1, 2 }, { 3 }, {} }));
    auto output = FlipNumbered(mesh, { 0, 1, 2, 3, 4, 5, 6, 7 }, triangulate);
    const Cells polygons = GetCells(output->GetPolys());
    EXPECT_EQ(polygons[0], Cell({ 0, 1 }));
    EXPECT_EQ(polygons[2], Cell());
    EXPECT_EQ(polygons[4], Cell({ 2 }));
    EXPECT_TRUE(HasEdge(output, 1, 3));
    EXPECT_EQ(GetCells(output->GetStrips()), Cells({ { 1, 2 }, { 3 }, {} }));

    auto strips = MakeMesh(Grid, {});
    strips->SetStrips(MakeCells({ { 1, 2 }, { 3 }, {} }));
    output = FlipNumbered(strips, { 0, 1, 2 }, triangulate);
    EXPECT_EQ(output->GetPoints(), strips->GetPoints());
    EXPECT_EQ(GetCells(output->GetStrips()), Cells({ { 1, 2 }, { 3 }, {} }));
  }
}

/// Corners that repeat the one before them, as in triangles that are written as quads.
TEST(OutputCells, RepeatedCornersAreDropped)
{
  auto mesh = MakeRhombus();
  const Cells polygons = { { 0, 1, 2, 2 }, { 1, 3, 3, 1 }, { 0, 2, 3, 0 }, { 0, 0, 0, 0 },
    { 0, 2, 0, 2 } };
  mesh->SetPolys(MakeCells(polygons));
  AddNumbers(mesh->GetCellData(), "Number", 5, 0);
  const std::string what = "3 polygons with fewer than three different points";
  WatchedFilter filter(mesh);
  ExpectHolds(RunToWarning(filter), what + ", left out (first: 1, 3, 4)");
  EXPECT_EQ(filter->GetTotalFlips(), 1);
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  EXPECT_EQ(GetNumbers(filter->GetOutput()->GetCellData(), "Number"), std::vector<int>({ 0, 2 }));

  WatchedFilter keeping(mesh);
  keeping->TriangulateOff();
  ExpectHolds(RunToWarning(keeping), what + " (first: 1, 3, 4)");
  EXPECT_EQ(GetCells(keeping->GetOutput()->GetPolys()), polygons);

  // A strip that repeats points to continue elsewhere.
  auto strip = MakeRhombus();
  strip->SetPolys(nullptr);
  strip->SetStrips(MakeCells({ { 0, 1, 2, 2, 0, 2, 3 } }));
  EXPECT_TRUE(HasEdge(FlipNumbered(strip, { 0, 0 }), 1, 3));
}

TEST(OutputCells, TriangulateOffKeepsOthersAndFixesTheirEdges)
{
  // The rhombus with a quad below its left side and a strip above its right side.
  auto mesh = MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { -3, -3, 0 },
                         { 0, -3, 0 }, { 3, 3, 0 }, { 0, 4, 0 } },
    { { 4, 5, 1, 0 }, { 0, 1, 2 }, { 0, 2, 3 } });
  mesh->SetStrips(MakeCells({ { 2, 6, 3, 7 } }));
  AddNumbers(mesh->GetCellData(), "Number", 4, 0);
  WatchedFilter filter(mesh);
  filter->TriangulateOff();
  filter->GenerateFlipCountOn();
  auto output = RunCleanly(filter);
  EXPECT_EQ(GetCell(output, 0), Cell({ 4, 5, 1, 0 }));
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_EQ(GetCells(output->GetStrips()), Cells({ { 2, 6, 3, 7 } }));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 0, 1, 2, 3 }));
  EXPECT_EQ(
    GetNumbers(output->GetCellData(), "vtkDelaunayFlipCount"), std::vector<int>({ 0, 1, 1, 0 }));

  // A flat quad, and a triangle at its side 0-2. This edge is bad, but stays.
  auto flat =
    MakeMesh({ { -3, 0, 0 }, { 3, 0, 0 }, { 0, 0.5, 0 }, { 1, -0.5, 0 }, { -1, -0.5, 0 } },
      { { 0, 1, 2 }, { 1, 0, 4, 3 } });
  filter->SetInputData(flat);
  EXPECT_EQ(GetCells(RunCleanly(filter)->GetPolys()), GetCells(flat->GetPolys()));
  filter->TriangulateOn();
  RunCleanly(filter);
  EXPECT_GT(filter->GetTotalFlips(), 0);
}

TEST(Storage, PointsOfAnyTypeAndLayout)
{
  for (const Mesh& mesh : { MakeBadMesh<vtkFloatArray>(), MakeBadMesh<vtkDoubleArray>(),
         MakeBadMesh<vtkSOADataArrayTemplate<double>>(), MakeBadMesh<vtkIntArray>(1e6) })
  {
    WatchedFilter filter(mesh);
    filter->SetGeometryToPlanar();
    vtkPolyData* output = filter.Run();
    EXPECT_GT(filter->GetTotalFlips(), 0);
    EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
    EXPECT_EQ(CountViolations(output), 0);
  }
  EXPECT_EQ(FlipAtOnce(MakeBadMesh<vtkFloatArray>()),
    FlipAtOnce(MakeBadMesh<vtkSOADataArrayTemplate<float>>()));
}

TEST(Storage, IdWidthIsKeptAndWithoutEffect)
{
  Cells expected;
  for (const bool isWide : { false, true })
  {
    const std::pair<Mesh, bool> cases[] = { { MakeBadMesh<vtkDoubleArray>(), true },
      { MakeQuadAndTriangle(), true }, { MakeQuadAndTriangle(), false } };
    for (const auto& [mesh, triangulate] : cases)
    {
      ASSERT_TRUE(isWide ? mesh->GetPolys()->ConvertTo64BitStorage()
                         : mesh->GetPolys()->ConvertTo32BitStorage());
      WatchedFilter filter(mesh);
      filter->SetTriangulate(triangulate);
      EXPECT_EQ(RunCleanly(filter)->GetPolys()->IsStorage64Bit(), isWide);
    }
    const Cells cells = FlipAtOnce(cases[0].first);
    EXPECT_NE(cells, GetCells(cases[0].first->GetPolys()));
    EXPECT_TRUE(expected.empty() || cells == expected);
    expected = cells;
  }
}
