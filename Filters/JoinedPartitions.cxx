// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JoinedPartitions.h"

#include "DataArrays.h"
#include "FlipError.h"
#include "PieceFlip.h"
#include "PolyDataBridge.h"
#include "UpdateProgress.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr vtkIdType None = -1;

/// Verts, lines, polygons and strips: the order of cell ids.
std::array<vtkCellArray*, 4> ListCells(vtkPolyData* mesh)
{
  return { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() };
}

/// The cells with the ids `chosen`, ascending, of `from`.
/// @param areWide whether ids are stored in 64 bits. @param localize turns a point id into that of
/// the new mesh.
template <typename Localize>
void TakeCells(vtkPolyData* from, const std::vector<vtkIdType>& chosen, bool areWide,
  const Localize& localize, vtkPolyData* to)
{
  std::array<vtkNew<vtkCellArray>, 4> taken;
  vtkIdType first = 0;
  auto cell = chosen.begin();
  vtkNew<vtkIdList> ids;
  for (std::size_t kind = 0; kind < taken.size(); ++kind)
  {
    vtkCellArray* cells = ListCells(from)[kind];
    areWide ? taken[kind]->Use64BitStorage() : taken[kind]->Use32BitStorage();
    for (; cell != chosen.end() && *cell < first + cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(*cell - first, ids);
      std::transform(ids->begin(), ids->end(), ids->begin(), localize);
      taken[kind]->InsertNextCell(ids);
    }
    first += cells->GetNumberOfCells();
  }
  to->SetVerts(taken[0]);
  to->SetLines(taken[1]);
  to->SetPolys(taken[2]);
  to->SetStrips(taken[3]);
}

vtkSmartPointer<vtkIdList> MakeList(const std::vector<vtkIdType>& ids)
{
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->begin());
  return list;
}

/// The mesh without cells that are copies of others.
vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh)
{
  auto kept = ShareMesh(mesh);
  if (HasDuplicateCells(mesh))
  {
    const auto ghosts = FindGhosts(mesh);
    std::vector<vtkIdType> chosen;
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
    {
      if (cell >= ghosts->GetNumberOfValues() ||
        (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) == 0)
      {
        chosen.push_back(cell);
      }
    }
    TakeCells(
      mesh, chosen, UsesWideIds(mesh), [](vtkIdType id) { return id; }, kept);
    const auto whole = TakeWholeArrays(mesh->GetCellData(), mesh->GetNumberOfCells());
    kept->GetCellData()->Initialize();
    JoinTuples(whole, nullptr, MakeList(chosen), kept->GetCellData());
  }
  return kept;
}

/// The name in the joined data of an array of a partition.
std::string FindName(vtkDataSetAttributes* own, int index, vtkDataSetAttributes* joined)
{
  vtkAbstractArray* array = own->GetAbstractArray(index);
  std::string name = array->GetName() ? array->GetName() : "\n" + std::to_string(index);
  if (IsWrongGhostArray(array)) // the joined mesh has the ghost types of the other partitions
  {
    name += '\n';
  }
  vtkAbstractArray* known = joined->GetAbstractArray(name.c_str());
  while (known && !IsSameKind(known, array))
  {
    name += '\n'; // no name that anybody gives
    known = joined->GetAbstractArray(name.c_str());
  }
  return name;
}

}

std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh)
{
  vtkDataArray* ids = mesh->GetPointData()->GetGlobalIds();
  std::vector<std::int64_t> numbers;
  if (ids && ids->GetNumberOfComponents() == 1 &&
    ids->GetNumberOfTuples() == mesh->GetNumberOfPoints())
  {
    auto* known = vtkArrayDownCast<vtkIdTypeArray>(ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i) // a double has not all bits of an id
    {
      numbers.push_back(known ? known->GetValue(i) : ids->GetVariantValue(i).ToTypeInt64());
    }
  }
  return numbers;
}

bool HasDuplicateCells(vtkPolyData* mesh)
{
  const auto ghosts = FindGhosts(mesh);
  return ghosts &&
    std::any_of(ghosts->Begin(), ghosts->End(),
      [](unsigned char ghost) { return (ghost & vtkDataSetAttributes::DUPLICATECELL) != 0; });
}

//------------------------------------------------------------------------------
JoinedPartitions::JoinedPartitions(
  std::vector<vtkSmartPointer<vtkPolyData>> partitions, const std::string& regions)
  : Partitions(std::move(partitions))
{
  for (vtkSmartPointer<vtkPolyData>& mesh : this->Partitions)
  {
    PointIdCheck check{ "cell", 0, mesh->GetNumberOfPoints() };
    for (vtkCellArray* cells : ListCells(mesh))
    {
      VisitCells(cells, check, [](vtkIdType, vtkIdList*) {});
      check.FirstCell += cells->GetNumberOfCells();
    }
    mesh = DropDuplicateCells(mesh);
  }
  this->JoinPoints();
  this->JoinCells();
  if (!regions.empty())
  {
    this->RequireRegions(regions);
  }
}

/// Points are the same if they have the same global id or, if a partition has no global ids, equal
/// coordinates, if at least one of them is at the border of its partition. Points without cells are
/// not compared.
void JoinedPartitions::JoinPoints()
{
  std::vector<std::unique_ptr<PolyDataBridge>> bridges;
  std::vector<std::vector<std::int64_t>> numbers;
  std::vector<MeshPiece> pieces;
  bool areDoubles = false;
  for (const auto& mesh : this->Partitions)
  {
    bridges.push_back(
      std::make_unique<PolyDataBridge>(mesh, nullptr, BridgeSettings(), UpdatePlan({}, {})));
    numbers.push_back(ReadPointNumbers(mesh));
    pieces.push_back(
      { bridges.back()->GetMesh(), numbers.back().empty() ? nullptr : numbers.back().data() });
    areDoubles =
      areDoubles || (mesh->GetPoints() && mesh->GetPoints()->GetDataType() == VTK_DOUBLE);
  }
  const JoinedPoints joined = delaunayflip::JoinPoints(pieces);
  this->Ambiguous = joined.Ambiguous;
  std::vector<vtkIdType> ids; // of the points of all partitions, in the joined mesh
  vtkNew<vtkPoints> points;
  points->SetDataType(areDoubles ? VTK_DOUBLE : VTK_FLOAT);
  for (const auto& mesh : this->Partitions)
  {
    const auto first = static_cast<std::ptrdiff_t>(ids.size());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const std::int64_t same = joined.Same[ids.size()];
      const bool isKnown = same < static_cast<std::int64_t>(ids.size());
      ids.push_back(isKnown ? ids[same] : points->InsertNextPoint(mesh->GetPoint(i)));
    }
    this->PointIds.emplace_back(ids.begin() + first, ids.end());
  }
  this->Mesh->SetPoints(points);
}

void JoinedPartitions::JoinCells()
{
  std::vector<std::vector<vtkIdType>> places(this->Partitions.size());
  std::array<vtkNew<vtkCellArray>, 4> joined;
  vtkNew<vtkIntArray> marks;
  marks->SetName(MarkName);
  vtkNew<vtkIdList> ids;
  for (std::size_t kind = 0; kind < joined.size(); ++kind)
  {
    for (std::size_t k = 0; k < this->Partitions.size(); ++k)
    {
      vtkCellArray* cells = ListCells(this->Partitions[k])[kind];
      for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
      {
        cells->GetCellAtId(cell, ids);
        std::transform(ids->begin(), ids->end(), ids->begin(),
          [&](vtkIdType id) { return this->PointIds[k][id]; });
        joined[kind]->InsertNextCell(ids);
        places[k].push_back(marks->InsertNextValue(static_cast<int>(k)));
      }
    }
  }
  this->Mesh->SetVerts(joined[0]);
  this->Mesh->SetLines(joined[1]);
  this->Mesh->SetPolys(joined[2]);
  this->Mesh->SetStrips(joined[3]);
  for (std::size_t k = this->Partitions.size(); k-- > 0;) // the first one's points count
  {
    vtkPolyData* mesh = this->Partitions[k];
    this->JoinData(mesh->GetPointData(), MakeList(this->PointIds[k]), this->Mesh->GetPointData(),
      this->Mesh->GetNumberOfPoints());
    this->JoinData(mesh->GetCellData(), MakeList(places[k]), this->Mesh->GetCellData(),
      this->Mesh->GetNumberOfCells());
  }
  this->Mesh->GetCellData()->AddArray(marks);
}

/// @param places of the partition's tuples among all. Arrays with too few tuples are left out.
void JoinedPartitions::JoinData(
  vtkDataSetAttributes* own, vtkIdList* places, vtkDataSetAttributes* joined, vtkIdType size) const
{
  const auto sources = MakeRange(0, places->GetNumberOfIds());
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    const std::string name = FindName(own, i, joined);
    vtkSmartPointer<vtkAbstractArray> target = joined->GetAbstractArray(name.c_str());
    const bool isKnown = target != nullptr;
    target = isKnown ? target : MakeZeros(array, size);
    if (!target || array->GetNumberOfTuples() < places->GetNumberOfIds())
    {
      continue;
    }
    if (!isKnown)
    {
      target->SetName(name.c_str());
      AddArrayAs(own->IsArrayAnAttribute(i), target, joined);
    }
    target->InsertTuples(places, sources, array);
  }
}

void JoinedPartitions::RequireRegions(const std::string& name) const
{
  vtkAbstractArray* joined = this->Mesh->GetCellData()->GetAbstractArray(name.c_str());
  for (const auto& mesh : this->Partitions)
  {
    vtkAbstractArray* own = mesh->GetCellData()->GetAbstractArray(name.c_str());
    if (!own || !joined || !IsSameKind(own, joined) ||
      own->GetNumberOfTuples() < mesh->GetNumberOfCells())
    {
      throw InvalidOptions("not all partitions have a cell array named \"" + name +
        "\" of the same type, with a tuple for every cell");
    }
  }
}

//------------------------------------------------------------------------------
/// By partition, its cells after the run.
std::vector<std::vector<vtkIdType>> JoinedPartitions::ListCellsOfPartitions(
  vtkPolyData* flipped) const
{
  std::vector<std::vector<vtkIdType>> cells(this->Partitions.size());
  std::vector<std::size_t> owners(flipped->GetNumberOfPoints(), cells.size()); // first partitions
  for (std::size_t k = cells.size(); k-- > 0;)
  {
    for (const vtkIdType point : this->PointIds[k])
    {
      owners[point] = k;
    }
  }
  auto* marks = vtkIntArray::SafeDownCast(flipped->GetCellData()->GetAbstractArray(MarkName));
  vtkNew<vtkIdList> ids;
  vtkIdType next = 0;
  for (vtkCellArray* array : ListCells(flipped))
  {
    for (vtkIdType cell = 0; cell < array->GetNumberOfCells(); ++cell, ++next)
    {
      std::size_t partition = static_cast<std::size_t>(marks->GetValue(next));
      if (marks->GetValue(next) < 0)
      {
        array->GetCellAtId(cell, ids);
        partition = cells.size();
        for (const vtkIdType id : *ids)
        {
          partition = std::min(partition, owners[id]);
        }
        partition = partition < cells.size() ? partition : 0;
      }
      cells[partition].push_back(next);
    }
  }
  return cells;
}

std::vector<vtkSmartPointer<vtkPolyData>> JoinedPartitions::Divide(vtkPolyData* flipped) const
{
  const std::vector<std::vector<vtkIdType>> cells = this->ListCellsOfPartitions(flipped);
  flipped->GetCellData()->RemoveArray(MarkName);
  std::vector<vtkSmartPointer<vtkPolyData>> partitions;
  std::vector<vtkIdType> local(flipped->GetNumberOfPoints(), None); // ids in the partition at hand
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    vtkPolyData* own = this->Partitions[k];
    const vtkIdType given = own->GetNumberOfPoints();
    for (vtkIdType i = 0; i < given; ++i)
    {
      local[this->PointIds[k][i]] = i;
    }
    std::vector<vtkIdType> added; // points that the partition lacks
    auto made = vtkSmartPointer<vtkPolyData>::New();
    const auto localize = [&](vtkIdType point)
    {
      if (local[point] == None)
      {
        local[point] = given + static_cast<vtkIdType>(added.size());
        added.push_back(point);
      }
      return local[point];
    };
    TakeCells(flipped, cells[k], UsesWideIds(own), localize, made);
    if (added.empty())
    {
      made->SetPoints(own->GetPoints());
      made->GetPointData()->ShallowCopy(TakeWholeArrays(own->GetPointData(), given));
    }
    else
    {
      vtkNew<vtkPoints> points;
      points->SetDataType(own->GetPoints()->GetDataType());
      points->InsertPoints(0, given, 0, own->GetPoints());
      for (const vtkIdType point : added)
      {
        points->InsertNextPoint(flipped->GetPoint(point));
      }
      made->SetPoints(points);
      this->DivideData(
        own->GetPointData(), given, flipped->GetPointData(), MakeList(added), made->GetPointData());
    }
    this->DivideData(
      own->GetCellData(), 0, flipped->GetCellData(), MakeList(cells[k]), made->GetCellData());
    if (!flipped->GetCellData()->GetGlobalIds() && this->Mesh->GetCellData()->GetGlobalIds())
    {
      DemoteGlobalIds(made->GetCellData());
    }
    made->GetFieldData()->ShallowCopy(own->GetFieldData());
    for (int i = 0; i < flipped->GetFieldData()->GetNumberOfArrays(); ++i)
    {
      made->GetFieldData()->AddArray(flipped->GetFieldData()->GetAbstractArray(i));
    }
    added.insert(added.end(), this->PointIds[k].begin(), this->PointIds[k].end());
    for (const vtkIdType point : added)
    {
      local[point] = None;
    }
    partitions.push_back(made);
  }
  return partitions;
}

/// Writes the data of a partition after the run: first `count` tuples of its own, then those
/// `places` of the mesh's. Cells get also the arrays that the run has added.
void JoinedPartitions::DivideData(vtkDataSetAttributes* own, vtkIdType count,
  vtkDataSetAttributes* flipped, vtkIdList* places, vtkDataSetAttributes* result) const
{
  const bool areCells = count == 0;
  vtkDataSetAttributes* joined = areCells
    ? static_cast<vtkDataSetAttributes*>(this->Mesh->GetCellData())
    : this->Mesh->GetPointData();
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    vtkAbstractArray* source = flipped->GetAbstractArray(FindName(own, i, joined).c_str());
    const bool isWhole = source && array->GetNumberOfTuples() >= count;
    if (const auto made = isWhole ? ExtendArray(array, count, source, places) : nullptr)
    {
      AddArrayAs(own->IsArrayAnAttribute(i), made, result);
    }
  }
  for (int i = 0; areCells && i < flipped->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = flipped->GetAbstractArray(i);
    if (array->GetName() && !joined->HasArray(array->GetName()))
    {
      result->AddArray(ExtendArray(array, 0, array, places));
    }
  }
}

}
