// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Arrays that have not what a mesh needs: they pass or are left out, with one warning.

#include "LiveTestSupport.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVariantArray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// The rhombus as one quad, beside a triangle far away.
vtkSmartPointer<vtkPolyData> MakeQuadAndTriangle()
{
  return MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 10, 0, 0 },
                    { 11, 0, 0 }, { 10, 1, 0 } },
    { { 0, 1, 2, 3 }, { 4, 5, 6 } });
}

/// Updates; all is well but for one warning.
std::string RunToOneWarning(WatchedFilter& filter)
{
  filter.Run();
  EXPECT_EQ(filter.GetErrors(), std::vector<std::string>{});
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_TRUE(filter->GetConverged());
  return filter.GetWarnings().empty() ? "" : filter.GetWarnings()[0];
}

template <typename ArrayT>
vtkSmartPointer<ArrayT> MakeArray(const char* name, vtkIdType tuples, int components = 1)
{
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// A cell array that is too short is left out where a cell is split.
template <typename ArrayT>
void ExpectLeftOut(vtkIdType tuples)
{
  auto mesh = MakeQuadAndTriangle();
  AddNumbers(mesh->GetCellData(), "Number", 2, 5);
  mesh->GetCellData()->AddArray(MakeArray<ArrayT>("Short", tuples));
  WatchedFilter filter(mesh);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(Holds(warning, "1 cell array with too few tuples left out: \"Short\"")) << warning;
  vtkCellData* data = filter->GetOutput()->GetCellData();
  EXPECT_EQ(data->GetAbstractArray("Short"), nullptr);
  EXPECT_EQ(GetNumbers(data, "Number"), std::vector<int>({ 5, 5, 6 }));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  EXPECT_EQ(mesh->GetCellData()->GetAbstractArray("Short")->GetNumberOfTuples(), tuples);
}

/// And passes where none is.
template <typename ArrayT>
void ExpectPassed(vtkIdType tuples)
{
  auto mesh = MakeRhombus();
  const auto array = MakeArray<ArrayT>("Short", tuples);
  mesh->GetCellData()->AddArray(array);
  WatchedFilter filter(mesh);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(Holds(warning, "1 cell array with too few tuples passed unchanged: \"Short\""))
    << warning;
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetAbstractArray("Short"), array);
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
}

void SetShortNormals(vtkPolyData* mesh, vtkIdType tuples)
{
  auto normals = MakeArray<vtkFloatArray>("Normals", tuples, 3);
  normals->Fill(0.5);
  mesh->GetCellData()->SetNormals(normals);
}

template <typename ArrayT>
void SetCells(vtkCellArray* cells, const std::vector<int>& offsets, const std::vector<int>& ids)
{
  vtkNew<ArrayT> offsetArray;
  vtkNew<ArrayT> idArray;
  for (const int offset : offsets)
  {
    offsetArray->InsertNextValue(offset);
  }
  for (const int id : ids)
  {
    idArray->InsertNextValue(id);
  }
  cells->SetData(offsetArray, idArray);
}

const std::vector<int> SixIds = { 0, 1, 2, 0, 2, 3 };

const std::vector<std::vector<int>> WrongOffsets = { {}, { 3 }, { 6, 6, 6 }, { 0, 3 }, { 0, 3, 5 },
  { 0, 3, 7 }, { 0, 7, 6 }, { 0, -3, 6 }, { 0, 3, -6 }, { 3, 3, 6 }, { -3, 3, 6 },
  { 0, 2147483647, 6 }, { 0, 6, 3, 6 } };

/// The one error of an update, whose output is empty.
std::string GetError(WatchedFilter& filter)
{
  vtkPolyData* output = filter.Run();
  EXPECT_EQ(output->GetNumberOfCells(), 0);
  EXPECT_EQ(output->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
  EXPECT_EQ(filter.GetErrors().size(), 1u);
  return filter.GetErrors().empty() ? "" : filter.GetErrors()[0];
}

enum class Room
{
  Verts,
  Lines,
  Polys,
  Strips
};

void SetRoom(vtkPolyData* mesh, Room room, vtkCellArray* cells)
{
  room == Room::Verts     ? mesh->SetVerts(cells)
    : room == Room::Lines ? mesh->SetLines(cells)
    : room == Room::Polys ? mesh->SetPolys(cells)
                          : mesh->SetStrips(cells);
}

template <typename ArrayT>
void ExpectOffsetsRefused(Room room)
{
  for (const std::vector<int>& offsets : WrongOffsets)
  {
    for (const bool triangulate : { true, false })
    {
      auto mesh = MakeRhombus();
      vtkNew<vtkCellArray> cells;
      SetCells<ArrayT>(cells, offsets, SixIds);
      SetRoom(mesh, room, cells);
      if (mesh->GetNumberOfPolys() == 0)
      {
        continue; // nothing to do: the input passes
      }
      WatchedFilter filter(mesh);
      filter->SetTriangulate(triangulate);
      const std::string error = GetError(filter);
      EXPECT_TRUE(Holds(error, "offsets")) << error << testing::PrintToString(offsets);
    }
  }
}

}

TEST(MalformedArrays, ShortCellArraysAreLeftOutWhereACellIsSplit)
{
  for (const vtkIdType tuples : { 0, 1 })
  {
    ExpectLeftOut<vtkIntArray>(tuples);
    ExpectLeftOut<vtkDoubleArray>(tuples);
    ExpectLeftOut<vtkStringArray>(tuples);
    ExpectLeftOut<vtkVariantArray>(tuples);
    ExpectLeftOut<vtkBitArray>(tuples);
  }
}

TEST(MalformedArrays, ShortCellArraysPassWhereNoneIs)
{
  for (const vtkIdType tuples : { 0, 1 })
  {
    ExpectPassed<vtkIntArray>(tuples);
    ExpectPassed<vtkStringArray>(tuples);
    ExpectPassed<vtkVariantArray>(tuples);
    ExpectPassed<vtkBitArray>(tuples);
  }
}

TEST(MalformedArrays, WholeCellArraysOfAllTypesAreCopied)
{
  auto mesh = MakeQuadAndTriangle();
  auto strings = MakeArray<vtkStringArray>("String", 2);
  strings->SetValue(0, "quad");
  auto variants = MakeArray<vtkVariantArray>("Variant", 2);
  variants->SetValue(0, vtkVariant(2.5));
  auto bits = MakeArray<vtkBitArray>("Bit", 2);
  bits->SetValue(0, 1);
  bits->SetValue(1, 0);
  for (vtkAbstractArray* array :
    { static_cast<vtkAbstractArray*>(strings.Get()), static_cast<vtkAbstractArray*>(variants.Get()),
      static_cast<vtkAbstractArray*>(bits.Get()) })
  {
    mesh->GetCellData()->AddArray(array);
  }
  WatchedFilter filter(mesh);
  vtkCellData* data = RunCleanly(filter)->GetCellData();
  for (const vtkIdType half : { 0, 1 })
  {
    EXPECT_EQ(data->GetAbstractArray("String")->GetVariantValue(half).ToString(), "quad");
    EXPECT_EQ(data->GetAbstractArray("Variant")->GetVariantValue(half).ToDouble(), 2.5);
    EXPECT_EQ(data->GetArray("Bit")->GetComponent(half, 0), 1.0);
  }
  EXPECT_EQ(data->GetArray("Bit")->GetComponent(2, 0), 0.0);
}

TEST(MalformedArrays, LongerCellArraysAreNoTrouble)
{
  auto mesh = MakeQuadAndTriangle();
  AddNumbers(mesh->GetCellData(), "Number", 9, 5);
  WatchedFilter filter(mesh);
  EXPECT_EQ(GetNumbers(RunCleanly(filter)->GetCellData(), "Number"), std::vector<int>({ 5, 5, 6 }));
}

TEST(MalformedArrays, OneWarningNamesTheFirstArrays)
{
  auto mesh = MakeQuadAndTriangle();
  for (const char* name : { "a", "b", "c", "d", "e" })
  {
    mesh->GetCellData()->AddArray(MakeArray<vtkStringArray>(name, 1));
  }
  WatchedFilter filter(mesh);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(
    Holds(warning, "5 cell arrays with too few tuples left out: \"a\", \"b\", \"c\", and 2 more"))
    << warning;
}

TEST(MalformedArrays, ActiveCellNormalsThatAreTooFewPass)
{
  for (const vtkIdType tuples : { 0, 1 })
  {
    auto mesh = MakeRhombus();
    SetShortNormals(mesh, tuples);
    WatchedFilter filter(mesh);
    const std::string warning = RunToOneWarning(filter);
    EXPECT_TRUE(Holds(warning, "\"Normals\"")) << warning;
    EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
    EXPECT_EQ(filter->GetOutput()->GetCellData()->GetNormals(), mesh->GetCellData()->GetNormals());
  }
}

TEST(MalformedArrays, ActiveCellNormalsThatAreTooFewAreLeftOutWhereACellIsSplit)
{
  auto mesh = MakeQuadAndTriangle();
  SetShortNormals(mesh, 1);
  WatchedFilter filter(mesh);
  RunToOneWarning(filter);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetNormals(), nullptr);
}

TEST(MalformedArrays, CellNormalsOfTwoComponentsPass)
{
  auto mesh = MakeRhombus();
  SetShortNormals(mesh, 3);
  mesh->GetCellData()->GetNormals()->SetNumberOfComponents(2);
  WatchedFilter filter(mesh);
  RunCleanly(filter);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetAbstractArray("Normals"),
    mesh->GetCellData()->GetAbstractArray("Normals"));
}

TEST(MalformedArrays, CellNormalsOfIntegersAreRenewed)
{
  auto mesh = MakeRhombus();
  auto normals = MakeArray<vtkIntArray>("Normals", 2, 3);
  normals->Fill(7);
  mesh->GetCellData()->SetNormals(normals);
  WatchedFilter filter(mesh);
  vtkDataArray* renewed = RunCleanly(filter)->GetCellData()->GetNormals();
  ASSERT_NE(renewed, nullptr);
  EXPECT_EQ(renewed->GetComponent(0, 2), 1.0);
  EXPECT_EQ(normals->GetValue(2), 7);
}

TEST(MalformedArrays, ShortPointDataPass)
{
  auto mesh = MakeQuadAndTriangle();
  const auto array = MakeArray<vtkStringArray>("Short", 3);
  mesh->GetPointData()->AddArray(array);
  WatchedFilter filter(mesh);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(Holds(warning, "1 point array with too few tuples passed unchanged: \"Short\""))
    << warning;
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetAbstractArray("Short"), array);
}

TEST(MalformedArrays, PedigreeIdsMayBeStrings)
{
  auto mesh = MakeQuadAndTriangle();
  auto ids = MakeArray<vtkStringArray>("Id", 2);
  ids->SetValue(0, "quad");
  mesh->GetCellData()->SetPedigreeIds(ids);
  AddNumbers(mesh->GetCellData(), "Global", 2, 5);
  mesh->GetCellData()->SetActiveGlobalIds("Global");
  WatchedFilter filter(mesh);
  vtkCellData* data = RunCleanly(filter)->GetCellData();
  EXPECT_EQ(data->GetGlobalIds(), nullptr);
  ASSERT_NE(data->GetPedigreeIds(), nullptr);
  EXPECT_EQ(data->GetPedigreeIds()->GetVariantValue(1).ToString(), "quad");
  EXPECT_EQ(GetNumbers(data, "Global"), std::vector<int>({ 5, 5, 6 }));
}

TEST(MalformedArrays, ShortGlobalIdsAreLeftOut)
{
  auto mesh = MakeQuadAndTriangle();
  AddNumbers(mesh->GetCellData(), "Id", 1, 5);
  mesh->GetCellData()->SetActiveGlobalIds("Id");
  WatchedFilter filter(mesh);
  RunToOneWarning(filter);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetNumberOfArrays(), 0);
}

TEST(MalformedArrays, ARegionArrayOfAnotherLengthIsAnError)
{
  for (const vtkIdType tuples : { 0, 1, 3 })
  {
    auto mesh = MakeRhombus();
    mesh->GetCellData()->AddArray(MakeArray<vtkStringArray>("Region", tuples, 2));
    WatchedFilter filter(mesh);
    filter->SetRegionArray("Region");
    filter.Run();
    EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OPTIONS);
    ASSERT_EQ(filter.GetErrors().size(), 1u);
    EXPECT_TRUE(Holds(filter.GetErrors()[0], "as many tuples")) << filter.GetErrors()[0];
  }
}

TEST(MalformedArrays, RegionArraysOfAllTypesDivide)
{
  auto strings = MakeArray<vtkStringArray>("Region", 2, 2);
  strings->SetValue(3, "other");
  auto variants = MakeArray<vtkVariantArray>("Region", 2);
  variants->SetValue(0, vtkVariant("some"));
  auto bits = MakeArray<vtkBitArray>("Region", 2);
  bits->SetValue(0, 1);
  bits->SetValue(1, 0);
  auto numbers = MakeArray<vtkDoubleArray>("Region", 2, 7);
  numbers->Fill(NAN);
  numbers->SetComponent(1, 6, 1.0);
  for (vtkAbstractArray* array :
    { static_cast<vtkAbstractArray*>(strings.Get()), static_cast<vtkAbstractArray*>(variants.Get()),
      static_cast<vtkAbstractArray*>(bits.Get()), static_cast<vtkAbstractArray*>(numbers.Get()) })
  {
    auto mesh = MakeRhombus();
    mesh->GetCellData()->AddArray(array);
    WatchedFilter filter(mesh);
    EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3)) << array->GetClassName();
    filter->SetRegionArray("Region");
    EXPECT_TRUE(HasEdge(RunCleanly(filter), 0, 2)) << array->GetClassName();
  }
}

TEST(MalformedArrays, OffsetsThatContradictTheConnectivityAreAnError)
{
  for (const Room room : { Room::Verts, Room::Lines, Room::Polys, Room::Strips })
  {
    ExpectOffsetsRefused<vtkTypeInt32Array>(room);
    ExpectOffsetsRefused<vtkTypeInt64Array>(room);
  }
}

TEST(MalformedArrays, ConstraintsWithWrongOffsetsAreAnError)
{
  for (const std::vector<int>& offsets : WrongOffsets)
  {
    for (const Room room : { Room::Lines, Room::Polys })
    {
      vtkNew<vtkPolyData> constraints;
      vtkNew<vtkCellArray> cells;
      SetCells<vtkTypeInt64Array>(cells, offsets, SixIds);
      SetRoom(constraints, room, cells);
      WatchedFilter filter(MakeRhombus());
      filter->SetConstraintsData(constraints);
      EXPECT_TRUE(Holds(GetError(filter), "constraint")) << testing::PrintToString(offsets);
    }
  }
}

TEST(MalformedArrays, PointsThatAreNoTriplesAreAnError)
{
  for (const int components : { 1, 2, 4 })
  {
    auto mesh = MakeRhombus();
    mesh->GetPoints()->GetData()->SetNumberOfComponents(components);
    WatchedFilter filter(mesh);
    EXPECT_TRUE(Holds(GetError(filter), "coordinates"));
    filter->SetInputData(MakeRhombus());
    filter->SetConstraintsData(mesh);
    filter.Run();
    EXPECT_TRUE(Holds(filter.GetErrors().back(), "coordinates"));
  }
}

TEST(MalformedArrays, ConstraintsWithoutPointsOrCellsAreNone)
{
  vtkNew<vtkPolyData> nothing;
  WatchedFilter filter(MakeRhombus());
  filter->SetConstraintsData(nothing);
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3));
  vtkNew<vtkPoints> points;
  nothing->SetPoints(points);
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3));
}

TEST(MalformedArrays, ShortCellsPass)
{
  auto mesh = MakeRhombus();
  mesh->SetPolys(MakeCells({ {}, { 0, 1, 2 }, { 1 }, { 0, 2, 3 }, { 2, 3 } }));
  mesh->SetStrips(MakeCells({ {}, { 0 }, { 0, 1 } }));
  AddNumbers(mesh->GetCellData(), "Number", 8, 0);
  for (const bool triangulate : { true, false })
  {
    WatchedFilter filter(mesh);
    filter->SetTriangulate(triangulate);
    auto output = RunCleanly(filter);
    EXPECT_EQ(output->GetNumberOfPolys(), 5);
    EXPECT_EQ(output->GetNumberOfStrips(), 3);
    EXPECT_EQ(
      GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 0, 1, 2, 3, 4, 5, 6, 7 }));
    EXPECT_TRUE(HasEdge(output, 1, 3));
  }
}

TEST(MalformedArrays, PointsOfNaNAloneAreNoCrash)
{
  auto mesh = MakeRhombus();
  for (vtkIdType point = 0; point < 4; ++point)
  {
    mesh->GetPoints()->SetPoint(point, NAN, NAN, NAN);
  }
  SetShortNormals(mesh, 2);
  WatchedFilter filter(mesh);
  filter->GenerateQualityOn();
  RunToOneWarning(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
}

TEST(MalformedArrays, InALiveRunWarnOnce)
{
  auto mesh = MakeBadSphere();
  mesh->GetCellData()->AddArray(MakeArray<vtkStringArray>("Short", 1));
  SetShortNormals(mesh, 2);
  LiveFilter filter(mesh);
  EXPECT_GT(filter.RunToTheEnd(), 2);
  EXPECT_EQ(filter.GetErrors().size(), 0u);
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
}
