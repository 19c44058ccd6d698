// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JoinedPartitions.h"

#include "FlipError.h"
#include "MalformedArrays.h"
#include "OutputCells.h"
#include "PieceInput.h"
#include "PointViews.h"
#include "PolyDataBridge.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr const char* MarkName = "vtkDelaunayFlipPartition"; ///< Rank + 1 and partition of a cell.
constexpr vtkIdType None = -1;

/// Verts, lines, polygons and strips: the order of cell ids.
std::array<vtkCellArray*, 4> ListCells(vtkPolyData* mesh)
{
  return { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() };
}

void RequireValidIds(vtkPolyData* mesh)
{
  PointIdCheck check{ "cell", 0, mesh->GetNumberOfPoints() };
  vtkNew<vtkIdList> ids;
  for (vtkCellArray* cells : ListCells(mesh))
  {
    check.RequireValid(cells);
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, ids);
      check.RequireInRange(cell, ids);
    }
    check.FirstCell += cells->GetNumberOfCells();
  }
}

vtkSmartPointer<vtkIdList> MakeList(const std::vector<vtkIdType>& ids)
{
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->begin());
  return list;
}

}

JoinedPartitions::JoinedPartitions(
  std::vector<vtkSmartPointer<vtkPolyData>> partitions, const std::string& regions, int rank)
  : Partitions(std::move(partitions)),
    Rank(rank)
{
  for (vtkSmartPointer<vtkPolyData>& mesh : this->Partitions)
  {
    RequireValidIds(mesh);
    mesh = DropDuplicateCells(ShareMesh(mesh));
  }
  this->Points = JoinPoints(this->Partitions);
  this->Mesh->SetPoints(this->Points.Points);
  this->AddCells();
  this->AddData();
  if (!regions.empty())
  {
    this->RequireRegions(regions);
  }
}

void JoinedPartitions::AddCells()
{
  this->Cells.resize(this->Partitions.size());
  std::array<vtkNew<vtkCellArray>, 4> joined;
  vtkNew<vtkIdList> ids;
  vtkIdType next = 0;
  for (std::size_t kind = 0; kind < joined.size(); ++kind)
  {
    for (std::size_t k = 0; k < this->Partitions.size(); ++k)
    {
      vtkCellArray* cells = ListCells(this->Partitions[k])[kind];
      for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
      {
        cells->GetCellAtId(cell, ids);
        std::transform(ids->begin(), ids->end(), ids->begin(),
          [&](vtkIdType id) { return this->Points.Ids[k][id]; });
        joined[kind]->InsertNextCell(ids);
        this->Cells[k].push_back(next++);
      }
    }
  }
  this->Mesh->SetVerts(joined[0]);
  this->Mesh->SetLines(joined[1]);
  this->Mesh->SetPolys(joined[2]);
  this->Mesh->SetStrips(joined[3]);
}

void JoinedPartitions::AddData()
{
  this->PointData.reset(
    new PartitionData(this->Mesh->GetPointData(), this->Mesh->GetNumberOfPoints()));
  this->CellData.reset(
    new PartitionData(this->Mesh->GetCellData(), this->Mesh->GetNumberOfCells()));
  vtkNew<vtkIntArray> marks;
  marks->SetName(MarkName);
  marks->SetNumberOfComponents(2);
  marks->SetNumberOfTuples(this->Mesh->GetNumberOfCells());
  for (std::size_t k = this->Partitions.size(); k-- > 0;) // the first one's points count
  {
    vtkPolyData* mesh = this->Partitions[k];
    this->PointData->Add(mesh->GetPointData(), MakeList(this->Points.Ids[k]));
    this->CellData->Add(mesh->GetCellData(), MakeList(this->Cells[k]));
    for (const vtkIdType cell : this->Cells[k])
    {
      marks->SetTypedComponent(cell, 0, this->Rank + 1);
      marks->SetTypedComponent(cell, 1, static_cast<int>(k));
    }
  }
  this->Mesh->GetCellData()->AddArray(marks);
}

void JoinedPartitions::RequireRegions(const std::string& name) const
{
  vtkAbstractArray* joined = this->Mesh->GetCellData()->GetAbstractArray(name.c_str());
  for (const auto& mesh : this->Partitions)
  {
    vtkAbstractArray* own = mesh->GetCellData()->GetAbstractArray(name.c_str());
    if (!own || !joined || own->GetDataType() != joined->GetDataType() ||
      own->GetNumberOfComponents() != joined->GetNumberOfComponents() ||
      own->GetNumberOfTuples() < mesh->GetNumberOfCells())
    {
      throw InvalidOptions("not all partitions have a cell array named \"" + name +
        "\" of the same type, with a tuple for every cell");
    }
  }
}

void JoinedPartitions::RemoveMarks(vtkPolyData* flipped)
{
  flipped->GetCellData()->RemoveArray(MarkName);
}

/// Divides a result.
class JoinedPartitions::Divider
{
public:
  Divider(const JoinedPartitions& joined, vtkPolyData* flipped)
    : Joined(joined),
      Flipped(flipped),
      Cells(joined.Partitions.size()),
      Local(flipped->GetNumberOfPoints(), None)
  {
    this->ListCellsOfPartitions();
    JoinedPartitions::RemoveMarks(flipped);
  }

  vtkSmartPointer<vtkPolyData> MakePartition(std::size_t k)
  {
    vtkPolyData* own = this->Joined.Partitions[k];
    auto made = vtkSmartPointer<vtkPolyData>::New();
    const std::vector<vtkIdType>& points = this->Joined.Points.Ids[k];
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      this->Local[points[i]] = static_cast<vtkIdType>(i);
    }
    made->SetVerts(own->GetVerts());
    made->SetLines(own->GetLines());
    const vtkIdType first = this->Flipped->GetNumberOfVerts() + this->Flipped->GetNumberOfLines();
    made->SetPolys(this->TakeCells(k, this->Flipped->GetPolys(), first));
    made->SetStrips(
      this->TakeCells(k, this->Flipped->GetStrips(), first + this->Flipped->GetNumberOfPolys()));
    this->StorePoints(k, made);
    this->StoreCellData(k, made);
    this->StoreFieldData(k, made);
    this->ForgetPoints(points);
    return made;
  }

private:
  void ListCellsOfPartitions()
  {
    auto* marks =
      vtkIntArray::SafeDownCast(this->Flipped->GetCellData()->GetAbstractArray(MarkName));
    const std::vector<int> owners = this->FindOwners();
    vtkNew<vtkIdList> ids;
    vtkIdType next = 0;
    for (vtkCellArray* cells : ListCells(this->Flipped))
    {
      for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell, ++next)
      {
        int partition = marks->GetTypedComponent(next, 1);
        if (marks->GetTypedComponent(next, 0) != this->Joined.Rank + 1)
        {
          cells->GetCellAtId(cell, ids);
          partition = ids->GetNumberOfIds() > 0 ? FindOwner(ids, owners) : 0;
        }
        this->Cells[partition].push_back(next);
      }
    }
  }

  /// The first partition that has each point; for points of other ranks, the number of partitions.
  std::vector<int> FindOwners() const
  {
    const auto count = static_cast<int>(this->Joined.Partitions.size());
    std::vector<int> owners(this->Flipped->GetNumberOfPoints(), count);
    for (int k = count; k-- > 0;)
    {
      for (const vtkIdType point : this->Joined.Points.Ids[k])
      {
        owners[point] = k;
      }
    }
    return owners;
  }

  int FindOwner(vtkIdList* ids, const std::vector<int>& owners) const
  {
    auto partition = static_cast<int>(this->Joined.Partitions.size());
    for (const vtkIdType id : *ids)
    {
      partition = std::min(partition, owners[id]);
    }
    return partition < static_cast<int>(this->Joined.Partitions.size()) ? partition : 0;
  }

  /// The cells of an array that are in the partition, with its own point ids.
  vtkSmartPointer<vtkCellArray> TakeCells(std::size_t k, vtkCellArray* cells, vtkIdType first)
  {
    auto taken = vtkSmartPointer<vtkCellArray>::New();
    UsesWideIds(this->Joined.Partitions[k]) ? taken->Use64BitStorage() : taken->Use32BitStorage();
    const std::vector<vtkIdType>& all = this->Cells[k];
    vtkNew<vtkIdList> ids;
    for (auto cell = std::lower_bound(all.begin(), all.end(), first);
         cell != all.end() && *cell < first + cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(*cell - first, ids);
      std::transform(ids->begin(), ids->end(), ids->begin(),
        [&](vtkIdType id) { return this->Localize(k, id); });
      taken->InsertNextCell(ids);
    }
    return taken;
  }

  vtkIdType Localize(std::size_t k, vtkIdType point)
  {
    vtkIdType& local = this->Local[point];
    if (local == None)
    {
      local = this->Joined.Partitions[k]->GetNumberOfPoints() +
        static_cast<vtkIdType>(this->Added.size());
      this->Added.push_back(point);
    }
    return local;
  }

  void StorePoints(std::size_t k, vtkPolyData* made) const
  {
    vtkPolyData* own = this->Joined.Partitions[k];
    if (this->Added.empty())
    {
      made->SetPoints(own->GetPoints());
      made->GetPointData()->ShallowCopy(TakeWholePointArrays(own));
      return;
    }
    const vtkIdType given = own->GetNumberOfPoints();
    const auto added = MakeList(this->Added);
    vtkNew<vtkPoints> points;
    points->SetDataType(own->GetPoints()->GetDataType());
    points->SetNumberOfPoints(given + added->GetNumberOfIds());
    points->InsertPoints(0, given, 0, own->GetPoints());
    for (vtkIdType i = 0; i < added->GetNumberOfIds(); ++i)
    {
      points->SetPoint(given + i, this->Flipped->GetPoint(added->GetId(i)));
    }
    made->SetPoints(points);
    this->Joined.PointData->Store(
      own->GetPointData(), given, this->Flipped->GetPointData(), added, made->GetPointData());
  }

  void StoreCellData(std::size_t k, vtkPolyData* made) const
  {
    this->Joined.CellData->Store(this->Joined.Partitions[k]->GetCellData(), 0,
      this->Flipped->GetCellData(), MakeList(this->Cells[k]), made->GetCellData());
    if (!this->Flipped->GetCellData()->GetGlobalIds() &&
      this->Joined.Mesh->GetCellData()->GetGlobalIds())
    {
      DemoteGlobalIds(made->GetCellData());
    }
  }

  void StoreFieldData(std::size_t k, vtkPolyData* made) const
  {
    vtkFieldData* result = made->GetFieldData();
    result->ShallowCopy(this->Joined.Partitions[k]->GetFieldData());
    for (int i = 0; i < this->Flipped->GetFieldData()->GetNumberOfArrays(); ++i)
    {
      result->AddArray(this->Flipped->GetFieldData()->GetAbstractArray(i));
    }
  }

  void ForgetPoints(const std::vector<vtkIdType>& points)
  {
    this->Added.insert(this->Added.end(), points.begin(), points.end());
    for (const vtkIdType point : this->Added)
    {
      this->Local[point] = None;
    }
    this->Added.clear();
  }

  const JoinedPartitions& Joined;
  vtkPolyData* Flipped;
  std::vector<std::vector<vtkIdType>> Cells; ///< Of each partition.
  std::vector<vtkIdType> Local; ///< The id of each point in the partition at hand, or None.
  std::vector<vtkIdType> Added; ///< The points of the mesh that it lacks.
};

std::vector<vtkSmartPointer<vtkPolyData>> JoinedPartitions::Divide(vtkPolyData* flipped) const
{
  std::vector<vtkSmartPointer<vtkPolyData>> partitions;
  if (!flipped->GetCellData()->HasArray(MarkName))
  {
    std::generate_n(std::back_inserter(partitions), this->Partitions.size(),
      []() { return vtkSmartPointer<vtkPolyData>::New(); });
    return partitions;
  }
  Divider divider(*this, flipped);
  for (std::size_t k = 0; k < this->Partitions.size(); ++k)
  {
    partitions.push_back(divider.MakePartition(k));
  }
  return partitions;
}

}
