// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Arrays that have not what a mesh needs: they pass or are left out, with one warning that names
/// them; ghost arrays of another kind than ghost types have; offsets that contradict the ids.

#include "FilterTestSupport.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariantArray.h"

#include <gtest/gtest.h>

namespace
{

using Array = vtkSmartPointer<vtkAbstractArray>;

std::vector<Array> MakeArraysOfAllKinds(const char* name, vtkIdType tuples)
{
  return { MakeArray<vtkIntArray>(name, tuples), MakeArray<vtkDoubleArray>(name, tuples),
    MakeArray<vtkStringArray>(name, tuples), MakeArray<vtkVariantArray>(name, tuples),
    MakeArray<vtkBitArray>(name, tuples) };
}

void SetNormals(vtkPolyData* mesh, vtkIdType tuples)
{
  auto normals = MakeArray<vtkFloatArray>("Normals", tuples, 3);
  normals->Fill(0.5);
  mesh->GetCellData()->SetNormals(normals);
}

template <typename ArrayT>
void SetCells(vtkCellArray* cells, const std::vector<int>& offsets)
{
  vtkNew<ArrayT> offsetArray, ids;
  for (const int offset : offsets)
  {
    offsetArray->InsertNextValue(offset);
  }
  for (const int id : { 0, 1, 2, 0, 2, 3 })
  {
    ids->InsertNextValue(id);
  }
  cells->SetData(offsetArray, ids);
}

const std::vector<std::vector<int>> WrongOffsets = { {}, { 3 }, { 6, 6, 6 }, { 0, 3 }, { 0, 3, 5 },
  { 0, 3, 7 }, { 0, 7, 6 }, { 0, -3, 6 }, { 0, 3, -6 }, { 3, 3, 6 }, { -3, 3, 6 },
  { 0, 2147483647, 6 }, { 0, 6, 3, 6 } };

using SetRoom = void (*)(vtkPolyData*, vtkCellArray*);
const SetRoom Rooms[] = { [](vtkPolyData* mesh, vtkCellArray* cells) { mesh->SetVerts(cells); },
  [](vtkPolyData* mesh, vtkCellArray* cells) { mesh->SetLines(cells); },
  [](vtkPolyData* mesh, vtkCellArray* cells) { mesh->SetPolys(cells); },
  [](vtkPolyData* mesh, vtkCellArray* cells) { mesh->SetStrips(cells); } };

constexpr int Hidden = vtkDataSetAttributes::HIDDENCELL;
const char* const GhostName = vtkDataSetAttributes::GhostArrayName();
const std::string WrongType =
  "1 ghost array that is not of type unsigned char ignored: \"vtkGhostType\"";
const std::string WrongComponents =
  "1 ghost array with several components ignored: \"vtkGhostType\"";

/// Ghost types of a rhombus: all are `flag`.
template <typename ArrayT>
vtkSmartPointer<ArrayT> MakeGhosts(int flag, int components = 1, vtkIdType tuples = 2)
{
  auto ghosts = MakeArray<ArrayT>(GhostName, tuples, components);
  ghosts->Fill(flag);
  return ghosts;
}

/// A rhombus in a place of its own.
Mesh MakeRhombusWith(vtkAbstractArray* ghosts, double place = 0.0)
{
  auto mesh = MakeRhombus();
  MovePoints(mesh, [place](double* x) { x[0] += place; });
  if (ghosts)
  {
    mesh->GetCellData()->AddArray(ghosts);
  }
  return mesh;
}

bool IsFlipped(vtkPolyData* rhombus) { return rhombus && HasEdge(rhombus, 1, 3); }

/// Rhombi with these ghost arrays that are partitions of one dataset.
vtkSmartPointer<vtkPartitionedDataSet> MakePartitions(const std::vector<Array>& ghosts)
{
  auto data = vtkSmartPointer<vtkPartitionedDataSet>::New();
  for (const auto& array : ghosts)
  {
    const unsigned int count = data->GetNumberOfPartitions();
    data->SetPartition(count, MakeRhombusWith(array, 10.0 * count));
  }
  return data;
}

vtkPolyData* GetPartition(WatchedFilter& filter, unsigned int partition)
{
  return vtkPolyData::SafeDownCast(
    vtkPartitionedDataSet::SafeDownCast(filter->GetOutputDataObject(0))
      ->GetPartitionAsDataObject(partition));
}

}

TEST(MalformedArrays, ThatAreShortAreLeftOutWhereACellIsSplitAndElsePass)
{
  for (const vtkIdType tuples : { 0, 1 })
  {
    for (const Array& array : MakeArraysOfAllKinds("Short", tuples))
    {
      auto mesh = MakeQuadAndTriangle();
      AddNumbers(mesh->GetCellData(), "Number", 2, 5);
      mesh->GetCellData()->AddArray(array);
      WatchedFilter split(mesh);
      ExpectHolds(RunToWarning(split), "1 cell array with too few tuples left out: \"Short\"");
      vtkCellData* data = split->GetOutput()->GetCellData();
      EXPECT_EQ(data->GetAbstractArray("Short"), nullptr);
      EXPECT_EQ(GetNumbers(data, "Number"), std::vector<int>({ 5, 5, 6 }));
      EXPECT_TRUE(HasEdge(split->GetOutput(), 1, 3));
      EXPECT_EQ(array->GetNumberOfTuples(), tuples);

      auto rhombus = MakeRhombus();
      rhombus->GetCellData()->AddArray(array);
      WatchedFilter whole(rhombus);
      ExpectHolds(
        RunToWarning(whole), "1 cell array with too few tuples passed unchanged: \"Short\"");
      EXPECT_EQ(whole->GetOutput()->GetCellData()->GetAbstractArray("Short"), array);
      EXPECT_TRUE(HasEdge(whole->GetOutput(), 1, 3));
    }
  }
}

TEST(MalformedArrays, ActiveCellNormals)
{
  for (const vtkIdType tuples : { 0, 1 })
  {
    auto mesh = MakeRhombus();
    SetNormals(mesh, tuples);
    WatchedFilter filter(mesh);
    ExpectHolds(RunToWarning(filter), "\"Normals\"");
    EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
    EXPECT_EQ(filter->GetOutput()->GetCellData()->GetNormals(), mesh->GetCellData()->GetNormals());
  }
  auto whole = MakeRhombus(); // of another type
  auto integers = MakeArray<vtkIntArray>("Normals", 2, 3);
  integers->Fill(7);
  whole->GetCellData()->SetNormals(integers);
  WatchedFilter renewing(whole);
  vtkDataArray* renewed = RunCleanly(renewing)->GetCellData()->GetNormals();
  ASSERT_NE(renewed, nullptr);
  EXPECT_EQ(renewed->GetComponent(0, 2), 1.0);
  EXPECT_EQ(integers->GetValue(2), 7);
}

TEST(MalformedArrays, ShortPointDataPass)
{
  auto mesh = MakeQuadAndTriangle();
  const auto array = MakeArray<vtkStringArray>("Short", 3);
  mesh->GetPointData()->AddArray(array);
  WatchedFilter filter(mesh);
  ExpectHolds(
    RunToWarning(filter), "1 point array with too few tuples passed unchanged: \"Short\"");
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetAbstractArray("Short"), array);
}

TEST(MalformedArrays, OffsetsThatContradictTheConnectivityAreAnError)
{
  for (const SetRoom setRoom : Rooms)
  {
    for (const std::vector<int>& offsets : WrongOffsets)
    {
      for (const bool triangulate : { true, false })
      {
        auto mesh = MakeRhombus();
        vtkNew<vtkCellArray> cells;
        triangulate ? SetCells<vtkTypeInt32Array>(cells, offsets)
                    : SetCells<vtkTypeInt64Array>(cells, offsets);
        setRoom(mesh, cells);
        if (mesh->GetNumberOfPolys() > 0) // else there is nothing to do, and the input passes
        {
          SCOPED_TRACE(testing::PrintToString(offsets));
          WatchedFilter filter(mesh);
          filter->SetTriangulate(triangulate);
          ExpectHolds(RunToError(filter), "offsets");
        }
      }
      if (setRoom == Rooms[1] || setRoom == Rooms[2])
      {
        vtkNew<vtkPolyData> constraints;
        vtkNew<vtkCellArray> cells;
        SetCells<vtkTypeInt64Array>(cells, offsets);
        setRoom(constraints, cells);
        WatchedFilter filter(MakeRhombus());
        filter->SetConstraintsData(constraints);
        ExpectHolds(RunToError(filter), "constraint");
      }
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
    ExpectHolds(RunToError(filter), "coordinates");
    filter->SetInputData(MakeRhombus());
    filter->SetConstraintsData(mesh);
    ExpectHolds(RunToError(filter), "coordinates");
  }
}

TEST(GhostArrays, FixTheEdgesOfGhostCells)
{
  const std::pair<int, bool> flags[] = { { 0, true },
    { vtkDataSetAttributes::DUPLICATECELL, false }, { vtkDataSetAttributes::REFINEDCELL, false },
    { Hidden, false },
    { vtkDataSetAttributes::EXTERIORCELL, true } }; // the last one is not a ghost
  for (const auto& [flag, isFlipped] : flags)
  {
    auto mesh = MakeRhombusWith(MakeGhosts<vtkUnsignedCharArray>(0, 1, 3));
    mesh->SetVerts(MakeCells({ { 0 } }));
    mesh->GetCellData()->GetArray(GhostName)->SetComponent(2, 0, flag);
    WatchedFilter filter(mesh);
    EXPECT_EQ(IsFlipped(RunCleanly(filter)), isFlipped) << flag;
  }
  WatchedFilter separate(
    MakeRhombusWith(MakeGhosts<vtkSOADataArrayTemplate<unsigned char>>(Hidden)));
  EXPECT_FALSE(IsFlipped(RunCleanly(separate)));
  WatchedFilter filter(MakeRhombusWith(MakeGhosts<vtkUnsignedCharArray>(Hidden, 1, 1)));
  ExpectHolds(RunToWarning(filter), "too few tuples passed unchanged: \"vtkGhostType\"");
  EXPECT_FALSE(IsFlipped(filter->GetOutput()));
}

TEST(GhostArrays, OfAnotherKindAreIgnored)
{
  const std::pair<Array, std::string> cases[] = { { MakeGhosts<vtkIntArray>(Hidden), WrongType },
    { MakeGhosts<vtkUnsignedCharArray>(Hidden, 2), WrongComponents },
    { MakeArray<vtkStringArray>(GhostName, 2), WrongType } };
  for (const auto& [ghosts, expected] : cases)
  {
    WatchedFilter filter(MakeRhombusWith(ghosts));
    ExpectHolds(RunToWarning(filter), expected);
    EXPECT_TRUE(IsFlipped(filter->GetOutput()));
    EXPECT_EQ(filter->GetOutput()->GetCellData()->GetAbstractArray(GhostName), ghosts);
  }
}

TEST(GhostArrays, OfPartitionsAreNamed)
{
  const auto wrong = MakeGhosts<vtkIntArray>(Hidden);
  WatchedFilter all(
    MakePartitions({ wrong, nullptr, wrong, MakeGhosts<vtkUnsignedCharArray>(Hidden, 2) }));
  ExpectHolds(
    RunToWarning(all), "block 1, block 3: " + WrongType + "; block 4: " + WrongComponents);
  for (unsigned int partition = 0; partition < 4; ++partition)
  {
    EXPECT_TRUE(IsFlipped(GetPartition(all, partition))) << partition;
  }
  WatchedFilter both(MakePartitions({ nullptr, MakeGhosts<vtkUnsignedCharArray>(0, 1, 1) }));
  ExpectHolds(
    RunToWarning(both), "block 2: 1 cell array with too few tuples left out: \"vtkGhostType\"");
  EXPECT_TRUE(IsFlipped(GetPartition(both, 1)));
}

/// Whatever the order of the partitions, an array that is ignored does not hide another one.
TEST(GhostArrays, ThatAreIgnoredLeaveOthersInForce)
{
  for (const unsigned int first : { 0u, 1u })
  {
    std::vector<Array> ghosts = { MakeGhosts<vtkIntArray>(7),
      MakeGhosts<vtkUnsignedCharArray>(Hidden) };
    std::swap(ghosts[0], ghosts[first]);
    WatchedFilter both(MakePartitions(ghosts));
    ExpectHolds(RunToWarning(both), "block " + std::to_string(first + 1) + ": " + WrongType);
    EXPECT_TRUE(IsFlipped(GetPartition(both, first)));
    EXPECT_FALSE(IsFlipped(GetPartition(both, 1 - first)));
    vtkDataArray* passed = GetPartition(both, 1 - first)->GetCellData()->GetArray(GhostName);
    ASSERT_NE(vtkUnsignedCharArray::SafeDownCast(passed), nullptr);
    EXPECT_EQ(passed->GetTuple1(0), Hidden);
  }
}
