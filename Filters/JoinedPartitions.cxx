// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JoinedPartitions.h"

#include "DataArrays.h"
#include "FlipError.h"
#include "PieceFlip.h"
#include "PolyDataBridge.h"
#include "UpdateProgress.h"

#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <memory>

namespace delaunayflip
{
namespace
{

/// Cells of several meshes by kind (verts, lines, polygons and strips, which is the order of cell
/// ids), and which cells they were.
class CellCollector
{
public:
  /// @param areWide whether ids are stored in 64 bits.
  explicit CellCollector(bool areWide)
  {
    for (auto& cells : this->Cells)
    {
      areWide ? cells->Use64BitStorage() : cells->Use32BitStorage();
    }
  }

  /// Adds a mesh without its duplicate ghost cells. @param points the new ids of its points.
  /// @throws InvalidMesh when a cell names a point that does not exist.
  void Add(vtkPolyData* mesh, vtkIdList* points)
  {
    const auto ghosts = FindGhosts(mesh);
    const vtkIdType known = ghosts ? ghosts->GetNumberOfValues() : 0;
    this->Add(
      mesh,
      [&](vtkIdType cell) {
        return cell >= known || (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) == 0;
      },
      [&](vtkIdType id) { return points->GetId(id); });
  }

  /// Adds cells of a mesh. @param isKept whether a cell is among them. @param newId of a point.
  template <typename IsKept, typename NewId>
  void Add(vtkPolyData* mesh, const IsKept& isKept, const NewId& newId)
  {
    vtkCellArray* arrays[] = { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(),
      mesh->GetStrips() };
    PointIdCheck check{ "cell", 0, mesh->GetNumberOfPoints() };
    this->Sources.emplace_back();
    for (std::size_t kind = 0; kind < this->Cells.size(); ++kind)
    {
      const auto add = [&](vtkIdType place, vtkIdList* ids)
      {
        const vtkIdType cell = check.FirstCell + place;
        if (isKept(cell))
        {
          std::transform(ids->begin(), ids->end(), ids->begin(), newId);
          this->Cells[kind]->InsertNextCell(ids);
          this->Sources.back()[kind]->InsertNextId(cell);
        }
      };
      VisitCells(arrays[kind], check, add);
      check.FirstCell += arrays[kind]->GetNumberOfCells();
    }
  }

  /// Writes the cells, and the data of those that are kept. @param meshes as they were added.
  /// @returns for each cell which of them it is from.
  vtkSmartPointer<vtkIntArray> Store(const MeshList& meshes, vtkPolyData* joined) const
  {
    auto owners = vtkSmartPointer<vtkIntArray>::New();
    joined->SetVerts(this->Cells[0]);
    joined->SetLines(this->Cells[1]);
    joined->SetPolys(this->Cells[2]);
    joined->SetStrips(this->Cells[3]);
    vtkCellData* data = joined->GetCellData();
    data->Initialize();
    vtkIdType next = 0;
    for (std::size_t kind = 0; kind < this->Cells.size(); ++kind)
    {
      for (std::size_t k = 0; k < meshes.size(); ++k)
      {
        vtkIdList* sources = this->Sources[k][kind];
        const auto own = TakeWholeArrays(meshes[k]->GetCellData(), meshes[k]->GetNumberOfCells());
        vtkAbstractArray* ghosts = own->GetAbstractArray(vtkDataSetAttributes::GhostArrayName());
        if (ghosts && IsWrongGhostArray(ghosts))
        {
          own->RemoveArray(ghosts->GetName()); // else it would hide those of other partitions
        }
        AddTuples(own, sources, MakeRange(next, sources->GetNumberOfIds()),
          joined->GetNumberOfCells(), data);
        next += sources->GetNumberOfIds();
        while (owners->GetNumberOfValues() < next)
        {
          owners->InsertNextValue(static_cast<int>(k));
        }
      }
    }
    return owners;
  }

private:
  std::array<vtkNew<vtkCellArray>, 4> Cells;
  std::vector<std::array<vtkNew<vtkIdList>, 4>> Sources; ///< By mesh and kind, the cells kept.
};

/// The points of all partitions. They are the same if they have the same global id or, if a
/// partition has no global ids, equal coordinates, if at least one of them is at the border of its
/// partition. Points without cells are not compared.
/// @param joined receives each once, with its data: those of the first partition that has it.
/// @returns for each partition the new ids of its points.
std::vector<vtkSmartPointer<vtkIdList>> AddPoints(
  const MeshList& partitions, vtkPolyData* joined, vtkIdType& ambiguous)
{
  std::vector<std::unique_ptr<PolyDataBridge>> bridges;
  std::vector<std::vector<std::int64_t>> numbers;
  std::vector<MeshPiece> pieces;
  bool areDoubles = false;
  for (const auto& mesh : partitions)
  {
    bridges.push_back(
      std::make_unique<PolyDataBridge>(mesh, nullptr, BridgeSettings(), UpdatePlan({}, {})));
    bridges.back()->RequireValidIds();
    numbers.push_back(ReadPointNumbers(mesh));
    pieces.push_back(
      { bridges.back()->GetMesh(), numbers.back().empty() ? nullptr : numbers.back().data() });
    areDoubles =
      areDoubles || (mesh->GetPoints() && mesh->GetPoints()->GetDataType() == VTK_DOUBLE);
  }
  const JoinedPoints found = JoinPoints(pieces);
  ambiguous = found.Ambiguous;
  std::vector<vtkIdType> all; // of the points of all partitions, in the joined mesh
  std::vector<vtkSmartPointer<vtkIdList>> ids;
  vtkNew<vtkPoints> points;
  points->SetDataType(areDoubles ? VTK_DOUBLE : VTK_FLOAT);
  for (const auto& mesh : partitions)
  {
    ids.push_back(vtkSmartPointer<vtkIdList>::New());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const std::int64_t same = found.Same[all.size()];
      const bool isKnown = same < static_cast<std::int64_t>(all.size());
      all.push_back(isKnown ? all[same] : points->InsertNextPoint(mesh->GetPoint(i)));
      ids.back()->InsertNextId(all.back());
    }
  }
  joined->SetPoints(points);
  for (std::size_t k = partitions.size(); k-- > 0;) // the first one's data count
  {
    const vtkIdType count = partitions[k]->GetNumberOfPoints();
    AddTuples(TakeWholeArrays<vtkDataSetAttributes>(partitions[k]->GetPointData(), count),
      MakeRange(0, count), ids[k], points->GetNumberOfPoints(), joined->GetPointData());
  }
  return ids;
}

void RequireRegions(const MeshList& partitions, const std::string& name)
{
  vtkAbstractArray* first = partitions.front()->GetCellData()->GetAbstractArray(name.c_str());
  for (const auto& mesh : partitions)
  {
    vtkAbstractArray* own = mesh->GetCellData()->GetAbstractArray(name.c_str());
    if (!own || !first || own->GetDataType() != first->GetDataType() ||
      own->GetNumberOfComponents() != first->GetNumberOfComponents() ||
      own->GetNumberOfTuples() < mesh->GetNumberOfCells())
    {
      throw InvalidOptions("not all partitions have a cell array named \"" + name +
        "\" of the same type, with a tuple for every cell");
    }
  }
}

}

JoinedMesh JoinPartitions(const MeshList& partitions, const std::string& regions)
{
  MeshList meshes;
  bool areWide = false;
  for (const auto& mesh : partitions)
  {
    meshes.push_back(DropDuplicateCells(mesh));
    areWide = areWide || UsesWideIds(mesh);
  }
  if (!regions.empty())
  {
    RequireRegions(meshes, regions);
  }
  JoinedMesh joined{ vtkSmartPointer<vtkPolyData>::New(), {}, nullptr };
  joined.Points = AddPoints(meshes, joined.Mesh, joined.Ambiguous);
  CellCollector cells(areWide);
  for (std::size_t k = 0; k < meshes.size(); ++k)
  {
    cells.Add(meshes[k], joined.Points[k]);
  }
  joined.Owners = cells.Store(meshes, joined.Mesh);
  joined.Mesh->GetFieldData()->ShallowCopy(partitions.front()->GetFieldData());
  return joined;
}

MeshList DividePartitions(vtkPolyData* flipped, vtkIntArray* owners, const MeshList& partitions,
  const std::vector<vtkSmartPointer<vtkIdList>>& points)
{
  constexpr vtkIdType None = -1;
  MeshList divided;
  std::vector<vtkIdType> local(flipped->GetNumberOfPoints(), None);
  for (std::size_t k = 0; k < partitions.size(); ++k)
  {
    vtkPolyData* own = partitions[k];
    vtkNew<vtkIdList> ids; // of its points in the joined mesh
    const auto take = [&](vtkIdType id)
    { return local[id] != None ? local[id] : local[id] = ids->InsertNextId(id); };
    for (const vtkIdType id : *points[k])
    {
      local[id] = ids->InsertNextId(id);
    }
    CellCollector cells(UsesWideIds(own));
    cells.Add(
      flipped, [&](vtkIdType cell) { return owners->GetValue(cell) == static_cast<int>(k); }, take);
    divided.push_back(vtkSmartPointer<vtkPolyData>::New());
    vtkPolyData* made = divided.back();
    const vtkIdType count = ids->GetNumberOfIds();
    vtkSmartPointer<vtkPoints> all = own->GetPoints();
    if (count > own->GetNumberOfPoints())
    {
      all = vtkSmartPointer<vtkPoints>::New();
      all->SetDataType(own->GetPoints()->GetDataType());
      flipped->GetPoints()->GetPoints(ids, all);
    }
    made->SetPoints(all);
    AddTuples(flipped->GetPointData(), ids, MakeRange(0, count), count, made->GetPointData());
    cells.Store({ flipped }, made);
    made->GetFieldData()->ShallowCopy(own->GetFieldData());
    vtkFieldData* first = partitions.front()->GetFieldData();
    for (int i = 0; i < flipped->GetFieldData()->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = flipped->GetFieldData()->GetAbstractArray(i);
      if (!array->GetName() || first->GetAbstractArray(array->GetName()) != array)
      {
        made->GetFieldData()->AddArray(array); // a result, not of the first partition
      }
    }
    for (const vtkIdType id : *ids)
    {
      local[id] = None;
    }
  }
  return divided;
}

vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh)
{
  const auto ghosts = FindGhosts(mesh);
  if (!ghosts ||
    std::none_of(ghosts->Begin(), ghosts->End(),
      [](unsigned char ghost) { return (ghost & vtkDataSetAttributes::DUPLICATECELL) != 0; }))
  {
    return mesh;
  }
  CellCollector cells(UsesWideIds(mesh));
  cells.Add(mesh, MakeRange(0, mesh->GetNumberOfPoints()));
  const auto kept = ShareMesh(mesh);
  cells.Store({ mesh }, kept);
  return kept;
}

std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh)
{
  vtkDataArray* ids = mesh->GetPointData()->GetGlobalIds();
  std::vector<std::int64_t> numbers;
  if (ids && ids->GetNumberOfComponents() == 1 &&
    ids->GetNumberOfTuples() == mesh->GetNumberOfPoints())
  {
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i) // a double has not all bits of an id
    {
      numbers.push_back(ids->GetVariantValue(i).ToTypeInt64());
    }
  }
  return numbers;
}

}
