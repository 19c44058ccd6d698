// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The partitions of a dataset are flipped as one mesh.

#include "FilterTestSupport.h"
#include "MeshDivision.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace
{

using Corner = std::array<double, 3>;
using Triangles = std::multiset<std::array<Corner, 3>>;
using Parts = std::vector<Mesh>;

Corner GetPlace(vtkPolyData* mesh, vtkIdType point)
{
  Corner place;
  mesh->GetPoint(point, place.data());
  return place;
}

void AddIds(vtkDataSetAttributes* data, const char* name, const std::vector<std::int64_t>& ids)
{
  const auto array = MakeArray<vtkIntArray>(name, static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), array->GetPointer(0));
  data->AddArray(array);
}

/// Cuts a mesh: triangle t goes to part ownerOf(t). Each part has the points of its triangles, with
/// their number in "Point", and its triangles' numbers in "Cell".
template <typename OwnerOf>
Parts Cut(vtkPolyData* mesh, int count, const OwnerOf& ownerOf)
{
  delaunayflip::Owners owners;
  for (vtkIdType t = 0; t < mesh->GetNumberOfCells(); ++t)
  {
    owners.push_back(ownerOf(t));
  }
  Parts parts;
  const delaunayflip::OwnedMesh<double> owned = ToOwnedMesh(mesh);
  for (const auto& piece : delaunayflip::DivideMesh(owned.View(), owners, count))
  {
    parts.push_back(ToPolyData(delaunayflip::OwnedMesh<double>{ piece.Doubles, piece.Triangles }));
    AddIds(parts.back()->GetPointData(), "Point", piece.PointOf);
    AddIds(parts.back()->GetCellData(), "Cell", piece.SlotOf);
  }
  return parts;
}

Parts CutInOrder(vtkPolyData* mesh, int count)
{
  const vtkIdType size = mesh->GetNumberOfCells();
  return Cut(mesh, count, [=](vtkIdType t) { return static_cast<int>(t * count / size); });
}

Mesh MakeBadMesh(int points = 300)
{
  return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(points, 3));
}

class PartitionFilter : public WatchedFilter
{
public:
  explicit PartitionFilter(const Parts& parts,
    const vtkSmartPointer<vtkPartitionedDataSet>& data =
      vtkSmartPointer<vtkPartitionedDataSet>::New())
  {
    for (const auto& part : parts)
    {
      data->SetPartition(data->GetNumberOfPartitions(), part);
    }
    (*this)->SetInputDataObject(data);
    (*this)->SetTieRuleToCanonical();
  }

  Parts Update()
  {
    (*this)->Update();
    auto* data = vtkPartitionedDataSet::SafeDownCast((*this)->GetOutputDataObject(0));
    Parts parts;
    for (unsigned int i = 0; data && i < data->GetNumberOfPartitions(); ++i)
    {
      parts.emplace_back(vtkPolyData::SafeDownCast(data->GetPartitionAsDataObject(i)));
    }
    return parts;
  }

  Parts UpdateCleanly()
  {
    const Parts parts = this->Update();
    EXPECT_TRUE(this->GetErrors().empty()) << this->GetErrors()[0];
    EXPECT_TRUE(this->GetWarnings().empty()) << this->GetWarnings()[0];
    return parts;
  }
};

/// By their corners, from the smallest one on.
Triangles Join(const Parts& parts)
{
  Triangles triangles;
  for (const auto& part : parts)
  {
    for (const Cell& cell : GetCells(part->GetPolys()))
    {
      std::array<Corner, 3> corners;
      std::transform(cell.begin(), cell.end(), corners.begin(),
        [&part](vtkIdType id) { return GetPlace(part, id); });
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      triangles.insert(corners);
    }
  }
  return triangles;
}

Triangles FlipUndivided(vtkPolyData* mesh)
{
  WatchedFilter filter(mesh);
  filter->SetTieRuleToCanonical();
  return Join({ RunCleanly(filter) });
}

/// Every partition has the cells that it had, and its points first.
void ExpectOwnData(vtkPolyData* mesh, const Parts& given, const Parts& parts)
{
  ASSERT_EQ(parts.size(), given.size());
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    EXPECT_EQ(
      GetNumbers(parts[k]->GetCellData(), "Cell"), GetNumbers(given[k]->GetCellData(), "Cell"));
    EXPECT_FALSE(parts[k]->GetCellData()->HasArray("vtkDelaunayFlipPartition"));
    const std::vector<int> own = GetNumbers(given[k]->GetPointData(), "Point");
    const std::vector<int> points = GetNumbers(parts[k]->GetPointData(), "Point");
    ASSERT_EQ(static_cast<vtkIdType>(points.size()), parts[k]->GetNumberOfPoints());
    EXPECT_TRUE(std::equal(own.begin(), own.end(), points.begin()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_EQ(GetPlace(parts[k], static_cast<vtkIdType>(i)), GetPlace(mesh, points[i]));
    }
  }
}

void AddGlobalIds(const Parts& parts)
{
  for (const auto& part : parts)
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("Ids");
    for (const int number : GetNumbers(part->GetPointData(), "Point"))
    {
      ids->InsertNextValue((vtkIdType(1) << 60) + number);
    }
    part->GetPointData()->SetGlobalIds(ids);
  }
}

}

TEST(Partitions, AreFlippedAsOneMesh)
{
  const auto mesh = MakeBadMesh();
  for (const int count : { 2, 5, 40 })
  {
    const Parts given = CutInOrder(mesh, count);
    PartitionFilter filter(given);
    const Parts parts = filter.UpdateCleanly();
    EXPECT_EQ(Join(parts), FlipUndivided(mesh));
    ExpectOwnData(mesh, given, parts);
    EXPECT_EQ(filter->GetNonDelaunayAfter(), 0);
    for (const auto& part : parts)
    {
      EXPECT_EQ(part->GetFieldData()->GetArray("DelaunayFlip:TotalFlips")->GetComponent(0, 0),
        filter->GetTotalFlips());
    }
  }
}

TEST(Partitions, OfOtherDatasetsAreOtherMeshes)
{
  const auto mesh = MakeBadMesh();
  const Parts given = CutInOrder(mesh, 3);
  PartitionFilter pieces(given, vtkSmartPointer<vtkMultiPieceDataSet>::New());
  EXPECT_EQ(Join(pieces.UpdateCleanly()), FlipUndivided(mesh));
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 1, given[0]); // after one that is null
  collection->SetPartition(0, 2, given[2]);
  collection->SetPartition(1, 0, given[1]);
  WatchedFilter filter;
  filter->SetInputDataObject(collection);
  filter->SetTieRuleToCanonical();
  filter->Update();
  EXPECT_TRUE(filter.GetWarnings().empty());
  auto* output = vtkPartitionedDataSetCollection::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_EQ(output->GetPartitionAsDataObject(0, 0), nullptr);
  EXPECT_EQ(Join({ vtkPolyData::SafeDownCast(output->GetPartitionAsDataObject(1, 0)) }),
    FlipUndivided(given[1]));
}

TEST(Partitions, ShareNoPointsWithoutBorders)
{
  const auto sphere = ToPolyData(delaunayflip::MakeBadSphere(12, 8, 1));
  Parts twins;
  for (int i = 0; i < 2; ++i)
  {
    twins.push_back(Mesh::New());
    twins.back()->DeepCopy(sphere);
    AddNumbers(twins.back()->GetPointData(), "Point", sphere->GetNumberOfPoints(), 0);
  }
  PartitionFilter apart(twins);
  apart->SetTieRuleToKeep();
  apart.UpdateCleanly();
  WatchedFilter alone(sphere);
  RunCleanly(alone);
  EXPECT_EQ(apart->GetTotalFlips(), 2 * alone->GetTotalFlips());
  AddGlobalIds(twins); // which say that points are the same
  PartitionFilter joined(twins);
  joined->SetTieRuleToKeep();
  joined.Update();
  EXPECT_LT(joined->GetTotalFlips(), apart->GetTotalFlips());
}

TEST(Partitions, GlobalIdsSayWhichPointsAreTheSame)
{
  const auto mesh = MakeBadMesh();
  const Parts given = Cut(mesh, 3, [](vtkIdType t) { return static_cast<int>(t % 3); });
  AddGlobalIds(given);
  PartitionFilter filter(given);
  const Parts parts = filter.UpdateCleanly();
  EXPECT_EQ(Join(parts), FlipUndivided(mesh));
  ExpectOwnData(mesh, given, parts);
  EXPECT_NE(parts[0]->GetPointData()->GetGlobalIds(), nullptr);
  const vtkIdType last = given[1]->GetNumberOfPoints() - 1;
  for (vtkIdType i = 0; i <= last; ++i)
  {
    given[1]->GetPointData()->GetGlobalIds()->SetComponent(i, 0, 5000 + i);
  }
  given[1]->Modified();
  PartitionFilter other(given);
  EXPECT_NE(Join(other.Update()), FlipUndivided(mesh)); // part 1 is apart from the others
}

TEST(Partitions, AmbiguousPointsAreToldOf)
{
  auto first =
    MakeMesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { -1, 0, 0 }, { 0, -1, 0 } },
      { { 0, 1, 2 }, { 3, 4, 5 } });
  auto second = MakeMesh({ { 0, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 } }, { { 0, 1, 2 } });
  PartitionFilter filter({ first, second });
  filter.Update();
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  ExpectHolds(filter.GetWarnings()[0], "coincide with others of the same partition");
  ExpectHolds(filter.GetWarnings()[0], "vtkGlobalPointIds");
}

TEST(Partitions, KeepArraysThatOthersLack)
{
  const auto mesh = MakeBadMesh(60);
  const Parts given = CutInOrder(mesh, 2);
  AddNumbers(given[0]->GetCellData(), "Own", given[0]->GetNumberOfCells(), 7);
  AddNumbers(given[0]->GetPointData(), "OwnOfPoints", given[0]->GetNumberOfPoints(), 7);
  vtkNew<vtkDoubleArray> other; // the same name, another type
  other->SetName("Own");
  other->SetNumberOfTuples(given[1]->GetNumberOfCells());
  other->Fill(0.25);
  given[1]->GetCellData()->SetScalars(other);
  PartitionFilter filter(given);
  const Parts parts = filter.UpdateCleanly();
  ExpectOwnData(mesh, given, parts);
  EXPECT_EQ(GetNumbers(parts[0]->GetCellData(), "Own"), GetNumbers(given[0]->GetCellData(), "Own"));
  ASSERT_NE(parts[1]->GetCellData()->GetScalars(), nullptr);
  EXPECT_EQ(parts[1]->GetCellData()->GetScalars()->GetComponent(0, 0), 0.25);
  const std::vector<int> points = GetNumbers(parts[0]->GetPointData(), "OwnOfPoints");
  EXPECT_EQ(points.front(), 7);
  EXPECT_EQ(points.back(), 0); // of a point that the other partition had
}

/// Float has no such integers. Their places differ a little.
TEST(Partitions, KeepTheirPointsAndPointData)
{
  const auto enlarge = [](double* x)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = (1 << 28) + std::round(1e6 * x[axis]);
    }
  };
  const auto mesh = MakeBadMesh();
  ReplacePoints<vtkDoubleArray>(mesh, enlarge);
  Parts given = Cut(mesh, 3, [](vtkIdType t) { return static_cast<int>(t % 3); });
  AddGlobalIds(given);
  for (int k = 0; k < 3; ++k)
  {
    AddNumbers(given[k]->GetPointData(), "Own", given[k]->GetNumberOfPoints(), 1000 * k);
    ReplacePoints<vtkIntArray>(given[k], [k](double* x) { x[0] += k; });
  }
  PartitionFilter filter(given);
  const Parts parts = filter.UpdateCleanly();
  const auto list = [](const Parts& meshes)
  {
    std::multiset<std::set<int>> triangles;
    for (const auto& part : meshes)
    {
      const std::vector<int> numbers = GetNumbers(part->GetPointData(), "Point");
      for (const Cell& cell : GetCells(part->GetPolys()))
      {
        triangles.insert({ numbers[cell[0]], numbers[cell[1]], numbers[cell[2]] });
      }
    }
    return triangles;
  };
  AddNumbers(mesh->GetPointData(), "Point", mesh->GetNumberOfPoints(), 0);
  WatchedFilter alone(mesh);
  alone->SetTieRuleToCanonical();
  EXPECT_EQ(list(parts), list({ RunCleanly(alone) }));
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    EXPECT_GT(parts[k]->GetNumberOfPoints(), given[k]->GetNumberOfPoints());
    const std::vector<int> own = GetNumbers(given[k]->GetPointData(), "Own");
    const std::vector<int> points = GetNumbers(parts[k]->GetPointData(), "Own");
    EXPECT_TRUE(std::equal(own.begin(), own.end(), points.begin()));
    for (vtkIdType i = 0; i < given[k]->GetNumberOfPoints(); ++i)
    {
      EXPECT_EQ(GetPlace(parts[k], i), GetPlace(given[k], i));
    }
  }
}

TEST(Partitions, KeepArraysOfAnyName)
{
  const Parts given = CutInOrder(MakeBadMesh(60), 3);
  const char* const internal = "vtkDelaunayFlipPartition";
  for (const auto& part : given)
  {
    vtkCellData* data = part->GetCellData();
    AddNumbers(data, internal, part->GetNumberOfCells(), 5);
    for (const int first : { 100, 200 })
    {
      AddNumbers(data, "Unnamed", part->GetNumberOfCells(), first);
      data->GetArray("Unnamed")->SetName(nullptr);
    }
  }
  PartitionFilter filter(given);
  const Parts parts = filter.UpdateCleanly();
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    vtkCellData* data = parts[k]->GetCellData();
    EXPECT_EQ(GetNumbers(data, internal), GetNumbers(given[k]->GetCellData(), internal));
    ASSERT_EQ(data->GetNumberOfArrays(), 4);
    std::set<double> firsts;
    for (int i = 0; i < 4; ++i)
    {
      firsts.insert(data->GetArray(i)->GetName() ? 0.0 : data->GetArray(i)->GetComponent(0, 0));
    }
    EXPECT_EQ(firsts, (std::set<double>{ 0.0, 100.0, 200.0 }));
  }
}

/// A partition that got no part of the mesh may have such ghosts.
TEST(Partitions, DropDuplicateGhosts)
{
  const auto mesh = MakeBadMesh();
  const vtkIdType half = mesh->GetNumberOfCells() / 2;
  Parts given = CutInOrder(mesh, 2);
  const Parts whole = Cut(mesh, 1, [](vtkIdType) { return 0; });
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType t = 0; t < mesh->GetNumberOfCells(); ++t)
  {
    ghosts->InsertNextValue(t < half ? 0 : vtkDataSetAttributes::DUPLICATECELL);
  }
  whole[0]->GetCellData()->AddArray(ghosts);
  PartitionFilter filter({ whole[0], given[1] });
  const Parts parts = filter.UpdateCleanly();
  EXPECT_EQ(Join(parts), FlipUndivided(mesh));
  EXPECT_EQ(parts[0]->GetNumberOfCells(), half);
}

TEST(Partitions, RegionsMustBeInAllAndWhole)
{
  const Parts given = CutInOrder(MakeBadMesh(60), 2);
  AddNumbers(given[0]->GetCellData(), "Region", given[0]->GetNumberOfCells(), 0);
  PartitionFilter filter(given);
  filter->SetRegionArray("Region");
  EXPECT_EQ(filter.Update()[0]->GetNumberOfCells(), 0);
  ASSERT_EQ(filter.GetErrors().size(), 1u);
  ExpectHolds(filter.GetErrors()[0], "not all partitions have a cell array named \"Region\"");
  AddNumbers(given[1]->GetCellData(), "Region", 1, 9000);
  PartitionFilter shorter(given);
  shorter->SetRegionArray("Region");
  EXPECT_EQ(shorter.Update()[0]->GetNumberOfCells(), 0);
  ExpectHolds(shorter.GetErrors().at(0), "with a tuple for every cell");
  AddNumbers(given[1]->GetCellData(), "Region", given[1]->GetNumberOfCells(), 9000);
  PartitionFilter all(given);
  all->SetRegionArray("Region");
  all.UpdateCleanly();
  EXPECT_EQ(all->GetTotalFlips(), 0); // every triangle is a region
}

TEST(Partitions, BrokenOnesAndShortArraysAreNamed)
{
  const Parts given = CutInOrder(MakeBadMesh(60), 2);
  AddNumbers(given[1]->GetCellData(), "Short", 2, 0);
  AddNumbers(given[1]->GetPointData(), "ShortToo", 2, 0);
  PartitionFilter filter(given);
  const Parts parts = filter.Update();
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  ExpectHolds(filter.GetWarnings()[0], "with too few tuples left out: \"Short\"");
  ExpectHolds(filter.GetWarnings()[0], "with too few tuples left out: \"ShortToo\"");
  EXPECT_EQ(parts[1]->GetCellData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(parts[1]->GetPointData()->GetNumberOfArrays(), 1);
  given[1]->SetPolys(MakeCells({ { 0, 1, 4444 } }));
  vtkNew<vtkUnstructuredGrid> grid;
  grid->InsertNextCell(VTK_VERTEX, 1, std::array<vtkIdType, 1>{ 0 }.data());
  auto data = vtkSmartPointer<vtkPartitionedDataSet>::New();
  data->SetPartition(0, grid);
  PartitionFilter broken(given, data);
  EXPECT_EQ(broken.Update()[1]->GetNumberOfCells(), 0);
  auto* output = vtkPartitionedDataSet::SafeDownCast(broken->GetOutputDataObject(0));
  EXPECT_TRUE(output->GetPartitionAsDataObject(0)->IsA("vtkUnstructuredGrid")); // passed
  ASSERT_EQ(broken.GetErrors().size(), 1u);
  ExpectHolds(broken.GetErrors()[0], "4444");
}

TEST(Partitions, ConstraintsMayBeOfEach)
{
  const Parts given = { MakeMesh({ { -4, 0, 0 }, { 0, -1, 0 }, { 4, 0, 0 } }, { { 0, 1, 2 } }),
    MakeMesh({ { -4, 0, 0 }, { 4, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } }) };
  PartitionFilter free(given);
  free.UpdateCleanly();
  EXPECT_EQ(free->GetTotalFlips(), 1);
  const Mesh ofSecond = MakeLines({ { 0, 1 } }); // an edge between its own points
  vtkNew<vtkPartitionedDataSet> lines;
  lines->SetPartition(1, ofSecond);
  const Mesh places = MakeLines({ { 0, 2 } });
  places->SetPoints(given[0]->GetPoints());
  // By ids of all, 0 to 1 is the seam in the second one, too.
  for (vtkDataObject* constraints : { static_cast<vtkDataObject*>(lines),
         static_cast<vtkDataObject*>(ofSecond), static_cast<vtkDataObject*>(places) })
  {
    PartitionFilter kept(given);
    kept->SetInputDataObject(1, constraints);
    kept.UpdateCleanly();
    EXPECT_EQ(kept->GetTotalFlips(), 0);
  }
  vtkNew<vtkPolyData> sides, diagonal; // of a mesh in one partition
  sides->SetLines(MakeCells({ { 0, 1 } }));
  diagonal->SetLines(MakeCells({ { 0, 2 } }));
  vtkNew<vtkPartitionedDataSet> two;
  two->SetPartition(0, sides);
  two->SetPartition(1, diagonal);
  PartitionFilter single({ MakeRhombus() });
  single->SetInputDataObject(1, two);
  single.UpdateCleanly();
  EXPECT_EQ(single->GetTotalFlips(), 0);
}
