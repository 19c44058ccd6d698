// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolyDataBridge.h"

#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "PolygonSplit.h"
#include "TriangleAngles.h"
#include "UpdateProgress.h"

#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <map>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace delaunayflip
{
namespace
{

/// Cells with arrays of their own, which share the memory of the others and know how much of it
/// they use.
vtkSmartPointer<vtkCellArray> ShareCells(vtkCellArray* cells)
{
  const auto share = [](vtkDataArray* array)
  {
    auto shared = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    shared->ShallowCopy(array);
    return shared;
  };
  auto shared = vtkSmartPointer<vtkCellArray>::New();
  shared->SetData(share(cells->GetOffsetsArray()), share(cells->GetConnectivityArray()));
  return shared;
}

/// E.g. "it has \"Side\", \"Material\"".
std::string ListNames(vtkCellData* data)
{
  std::string names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const char* name = data->GetAbstractArray(i)->GetName();
    names += std::string(i > 0 ? ", \"" : "it has \"") + (name ? name : "") + '"';
  }
  return names.empty() ? "it has none" : names;
}

/// Hints to back new memory with pages of 2 MiB instead of 4 KiB, which are each allocated and
/// cleared on first use: with it for the connectivity alone, an update of 5 M points on a GPU takes
/// 56 ms instead of 63.
template <typename Value>
void UseHugePages([[maybe_unused]] Value* values, [[maybe_unused]] vtkIdType count)
{
#if defined(__linux__)
  constexpr std::uintptr_t HugePage = std::uintptr_t(2) << 20;
  const auto begin = reinterpret_cast<std::uintptr_t>(values);
  const std::uintptr_t first = (begin + HugePage - 1) / HugePage * HugePage;
  const std::uintptr_t end = begin + count * sizeof(Value);
  if (first + HugePage <= end)
  {
    madvise(reinterpret_cast<void*>(first), (end - first) / HugePage * HugePage, MADV_HUGEPAGE);
  }
#endif
}

/// Room for triangles. Offsets are not shared with the input, whose cells may grow in place later:
/// the output would then have more offsets than connectivity.
template <typename ArrayT>
vtkSmartPointer<vtkCellArray> MakeRoom(vtkIdType count)
{
  vtkNew<ArrayT> offsets, connectivity;
  offsets->SetNumberOfTuples(count + 1);
  connectivity->SetNumberOfTuples(3 * count);
  UseHugePages(offsets->GetPointer(0), count + 1);
  UseHugePages(connectivity->GetPointer(0), 3 * count);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/// Id is the engine's type for the values of ArrayT.
template <typename ArrayT, typename Id>
void Fill(const FlipSession& session, vtkCellArray* cells)
{
  using Value = typename ArrayT::ValueType;
  const vtkIdType count = cells->GetNumberOfCells();
  Value* values = static_cast<ArrayT*>(cells->GetOffsetsArray())->GetPointer(0);
  vtkSMPTools::For(0, count + 1,
    [values](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        values[i] = static_cast<Value>(3 * i);
      }
    });
  auto* connectivity = static_cast<ArrayT*>(cells->GetConnectivityArray());
  session.StoreTriangles(
    MutableTriangleArray(reinterpret_cast<Id*>(connectivity->GetPointer(0)), count));
}

}

vtkSmartPointer<vtkPolyData> ShareMesh(vtkPolyData* mesh)
{
  auto shared = vtkSmartPointer<vtkPolyData>::New();
  shared->ShallowCopy(mesh);
  shared->SetVerts(ShareCells(mesh->GetVerts()));
  shared->SetLines(ShareCells(mesh->GetLines()));
  shared->SetPolys(ShareCells(mesh->GetPolys()));
  shared->SetStrips(ShareCells(mesh->GetStrips()));
  return shared;
}

//------------------------------------------------------------------------------
PolyDataBridge::PolyDataBridge(vtkPolyData* mesh, vtkPolyData* constraints,
  const BridgeSettings& settings, const UpdatePlan& plan)
  : Mesh(mesh),
    Points(ViewPoints(mesh, Coordinates)),
    Slots(mesh, Points, settings.Triangulate, plan.For(UpdatePlan::Polygons)),
    Constraints(
      FindConstraintEdges({ settings.LinesAsConstraints ? mesh : nullptr, constraints, Points,
                            Slots.Triangles, settings.InsertLines, settings.InsertConstraints },
        plan.For(UpdatePlan::Constraints)))
{
  if (const auto ghosts = FindGhosts(mesh))
  {
    const int ghost = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
      vtkDataSetAttributes::HIDDENCELL;
    this->Slots.Frozen.resize(this->Slots.Triangles.Count);
    for (vtkIdType triangle = 0; triangle < this->Slots.Triangles.Count; ++triangle)
    {
      const vtkIdType cell = this->Slots.GetCell(triangle);
      if (cell < ghosts->GetNumberOfValues() && (ghosts->GetValue(cell) & ghost) != 0)
      {
        this->Slots.Frozen[triangle] = 1;
      }
    }
  }
  if (!settings.RegionArray.empty())
  {
    this->LabelRegions(settings.RegionArray, plan.For(UpdatePlan::Regions));
  }
}

/// Labels count from 0 in the order of appearance in the cells. The array may hold numbers or
/// strings, with any number of components.
void PolyDataBridge::LabelRegions(const std::string& name, const ProgressObserver& observer)
{
  vtkAbstractArray* array = this->Mesh->GetCellData()->GetAbstractArray(name.c_str());
  if (!array)
  {
    throw InvalidOptions("RegionArray: the input has no cell array named \"" + name + "\"; " +
      ListNames(this->Mesh->GetCellData()) + ".");
  }
  if (array->GetNumberOfTuples() != this->Mesh->GetNumberOfCells())
  {
    throw InvalidOptions(
      "RegionArray: \"" + name + "\" must have as many tuples as the mesh has cells.");
  }
  WorkProgress progress(observer, array->GetNumberOfTuples());
  std::map<std::string, std::int32_t> known;
  std::vector<std::int32_t> labels; // of cells
  const auto label = [&](const std::string& key)
  {
    const auto found = known.emplace(key, static_cast<std::int32_t>(known.size()));
    if (found.second)
    {
      this->RegionKeys.push_back(key);
    }
    labels.push_back(found.first->second);
    progress.Add();
  };
  // Numbers as bytes, in a form that is the same for all NaN, for 0 and -0, and for integers of all
  // sizes, of which a double does not have all bits.
  auto* numbers = vtkArrayDownCast<vtkDataArray>(array);
  const int type = array->GetDataType(), width = array->GetNumberOfComponents();
  const bool areDoubles = type == VTK_FLOAT || type == VTK_DOUBLE || type == VTK_BIT;
  std::string key;
  const auto append = [&key](auto number)
  { key.append(reinterpret_cast<const char*>(&number), sizeof(number)); };
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    if (areDoubles)
    {
      const double value = numbers->GetComponent(i / width, static_cast<int>(i % width));
      append(vtkMath::IsNan(value) ? NaN : value + 0.0);
    }
    else if (numbers)
    {
      append(array->GetVariantValue(i).ToTypeInt64());
    }
    else
    {
      key += array->GetVariantValue(i).ToString() + '\0';
    }
    if ((i + 1) % width == 0)
    {
      label(std::exchange(key, std::string()));
    }
  }
  this->Regions.resize(this->Slots.Triangles.Count);
  for (vtkIdType triangle = 0; triangle < this->Slots.Triangles.Count; ++triangle)
  {
    this->Regions[triangle] = labels[this->Slots.GetCell(triangle)];
  }
}

TriangleMesh PolyDataBridge::GetMesh() const
{
  TriangleMesh mesh;
  mesh.Points = this->Points;
  mesh.Triangles = this->Slots.Triangles;
  const std::vector<PointPair>& pairs = this->Constraints.Pairs;
  mesh.ConstraintEdges = pairs.empty() ? nullptr : pairs.front().data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(pairs.size());
  mesh.ConstraintsToInsert = pairs.empty() ? nullptr : this->Constraints.ToInsert.data();
  mesh.Regions = this->Regions.empty() ? nullptr : this->Regions.data();
  mesh.FrozenTriangles = this->Slots.Frozen.empty() ? nullptr : this->Slots.Frozen.data();
  return mesh;
}

void PolyDataBridge::NumberCells(std::vector<Defect>& defects) const
{
  for (Defect& defect : defects)
  {
    if (defect.Ids == DefectIds::Triangles)
    {
      for (std::int64_t& id : defect.FirstIds)
      {
        id = this->Slots.GetCell(id);
      }
      // Several triangles of a polygon are one cell.
      defect.FirstIds.erase(
        std::unique(defect.FirstIds.begin(), defect.FirstIds.end()), defect.FirstIds.end());
    }
  }
}

//------------------------------------------------------------------------------
namespace
{

/// The polygons of the output. Their ids are stored as wide as those of the mesh's polygons, or of
/// its strips if it has no polygons.
vtkSmartPointer<vtkCellArray> BuildPolygons(const FlipSession& session, const TriangleSlots& slots,
  vtkPolyData* mesh, const vtkSmartPointer<vtkCellArray>& room)
{
  if (room)
  {
    FillTriangles(session, room);
    return room;
  }
  const vtkIdType count = slots.Triangles.Count;
  const bool areWide = UsesWideIds(mesh);
  std::vector<std::int64_t> storage(3 * count);
  const MutableTriangleArray triangles(storage.data(), count);
  session.StoreTriangles(triangles);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  areWide ? cells->Use64BitStorage() : cells->Use32BitStorage();
  cells->AllocateEstimate(slots.GetNumberOfPolygons(), 3);
  vtkNew<vtkIdList> ids;
  for (vtkIdType polygon = 0; polygon < slots.GetNumberOfPolygons(); ++polygon)
  {
    const vtkIdType triangle = slots.GetTriangle(polygon);
    if (triangle == TriangleSlots::None)
    {
      mesh->GetPolys()->GetCellAtId(slots.GetCellOfPolygon(polygon) - slots.FirstPolygon, ids);
      cells->InsertNextCell(ids);
    }
    else
    {
      cells->InsertNextCell(
        { triangles.Get(triangle, 0), triangles.Get(triangle, 1), triangles.Get(triangle, 2) });
    }
  }
  return cells;
}

}

vtkSmartPointer<vtkCellArray> PolyDataBridge::MakeRoom() const
{
  return this->Slots.ArePolygonsTriangles()
    ? MakeRoomForTriangles(this->Slots.Triangles.Count, UsesWideIds(this->Mesh))
    : nullptr;
}

void PolyDataBridge::Store(const FlipSession& session, const vtkSmartPointer<vtkCellArray>& room,
  vtkPolyData* mesh, vtkPolyData* output) const
{
  const TriangleSlots& slots = this->Slots;
  output->SetPoints(mesh->GetPoints());
  output->SetVerts(mesh->GetVerts());
  output->SetLines(mesh->GetLines());
  output->SetPolys(BuildPolygons(session, slots, mesh, room));
  output->SetStrips(BuildStrips(slots, mesh));
  output->GetPointData()->ShallowCopy(mesh->GetPointData());
  output->GetFieldData()->ShallowCopy(mesh->GetFieldData());
  vtkCellData* data = output->GetCellData();
  if (slots.InPlace)
  {
    data->ShallowCopy(mesh->GetCellData());
  }
  else
  {
    data->Initialize();
    const auto sources = MakeRange(0, slots.FirstPolygon);
    for (vtkIdType polygon = 0; polygon < slots.GetNumberOfPolygons(); ++polygon)
    {
      sources->InsertNextId(slots.GetCellOfPolygon(polygon));
    }
    for (const vtkIdType strip : slots.Strips)
    {
      sources->InsertNextId(strip);
    }
    const auto whole = TakeWholeArrays(mesh->GetCellData(), mesh->GetNumberOfCells());
    const vtkIdType count = sources->GetNumberOfIds();
    AddTuples(whole, sources, MakeRange(0, count), count, data);
    if (slots.AreDivided)
    {
      DemoteGlobalIds(data);
    }
  }
  RenewNormals(output,
    [&slots](vtkIdType polygon, const std::int64_t ids[3], std::int64_t before[3])
    {
      const vtkIdType triangle = slots.GetTriangle(polygon);
      for (int slot = 0; slot < 3 && triangle != TriangleSlots::None; ++slot)
      {
        before[slot] = slots.Triangles.Get(triangle, slot);
      }
      return !std::equal(ids, ids + 3, before);
    });
}

void PolyDataBridge::StoreFlipCounts(const FlipSession& session, vtkPolyData* output) const
{
  std::vector<std::int32_t> counts(this->Slots.Triangles.Count);
  session.StoreFlipCounts(counts.data());
  AddTriangleArray(
    "vtkDelaunayFlipCount", counts, 0,
    [this](vtkIdType polygon) { return this->Slots.GetTriangle(polygon); }, output);
}

void PolyDataBridge::StoreAngles(const FlipSession& session, int threads,
  const ProgressObserver& progress, vtkPolyData* output) const
{
  const GeometryKind geometry = session.GetReport().GeometryUsed;
  TriangleMesh mesh = this->GetMesh();
  std::vector<double> before(mesh.Triangles.Count), after(mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, threads, before.data(), MakePart(progress, 0.0, 0.5));
  std::vector<std::int64_t> ids(3 * mesh.Triangles.Count);
  session.StoreTriangles(MutableTriangleArray(ids.data(), mesh.Triangles.Count));
  mesh.Triangles =
    TriangleArray(static_cast<const std::int64_t*>(ids.data()), mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, threads, after.data(), MakePart(progress, 0.5, 1.0));
  const auto triangleOf = [this](vtkIdType polygon) { return this->Slots.GetTriangle(polygon); };
  AddTriangleArray("Smallest angle before (degrees)", before, NaN, triangleOf, output);
  AddTriangleArray("Smallest angle after (degrees)", after, NaN, triangleOf, output);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkCellArray> MakeRoomForTriangles(vtkIdType count, bool areWide)
{
  // There may be more connectivity than 32-bit offsets can number.
  return areWide || 3 * count > std::numeric_limits<std::int32_t>::max()
    ? MakeRoom<vtkTypeInt64Array>(count)
    : MakeRoom<vtkTypeInt32Array>(count);
}

void ExpectTriangles(FlipSession& session, vtkCellArray* room)
{
  for (vtkDataArray* array : { room->GetOffsetsArray(), room->GetConnectivityArray() })
  {
    session.Expect(array->GetVoidPointer(0), array->GetNumberOfValues() * array->GetDataTypeSize());
  }
}

void FillTriangles(const FlipSession& session, vtkCellArray* room)
{
  room->IsStorage64Bit() ? Fill<vtkTypeInt64Array, std::int64_t>(session, room)
                         : Fill<vtkTypeInt32Array, std::int32_t>(session, room);
}

bool UsesWideIds(vtkPolyData* mesh)
{
  vtkCellArray* cells = mesh->GetNumberOfPolys() > 0 ? mesh->GetPolys() : mesh->GetStrips();
  return cells->GetConnectivityArray()->GetDataTypeSize() == 8;
}

vtkSmartPointer<vtkCellArray> BuildStrips(const TriangleSlots& slots, vtkPolyData* mesh)
{
  if (static_cast<vtkIdType>(slots.Strips.size()) == mesh->GetNumberOfStrips())
  {
    return mesh->GetStrips();
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> ids;
  for (const vtkIdType cell : slots.Strips)
  {
    mesh->GetStrips()->GetCellAtId(cell - slots.FirstStrip, ids);
    cells->InsertNextCell(ids);
  }
  return cells;
}

void DemoteGlobalIds(vtkDataSetAttributes* data)
{
  vtkSmartPointer<vtkDataArray> ids = data->GetGlobalIds();
  if (!ids)
  {
    return;
  }
  data->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  if (!data->GetPedigreeIds())
  {
    data->SetPedigreeIds(ids);
  }
}

void RenewNormals(vtkPolyData* output, const FindChange& findChange)
{
  vtkDataArray* shared = output->GetCellData()->GetNormals();
  if (!shared || shared->GetNumberOfComponents() != 3 ||
    shared->GetNumberOfTuples() < output->GetNumberOfCells())
  {
    return;
  }
  // Not its NewInstance, which cannot be written where values are computed.
  const auto normals =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(shared->GetDataType()));
  normals->DeepCopy(shared);
  std::vector<double> storage;
  const PointArray points = ViewPoints(output, storage);
  const vtkIdType first = output->GetNumberOfVerts() + output->GetNumberOfLines();
  vtkSMPTools::For(0, output->GetNumberOfPolys(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkIdList> cell;
      for (vtkIdType polygon = begin; polygon < end; ++polygon)
      {
        output->GetPolys()->GetCellAtId(polygon, cell);
        std::int64_t ids[3] = { -1, -1, -1 };
        std::copy_n(cell->begin(), std::min<vtkIdType>(cell->GetNumberOfIds(), 3), ids);
        std::int64_t before[3] = { ids[0], ids[1], ids[2] };
        const auto exists = [&](std::int64_t id) { return id >= 0 && id < points.Count; };
        // The ids of the input may have been changed.
        if (std::all_of(ids, ids + 3, exists) && findChange(polygon, ids, before) &&
          std::all_of(before, before + 3, exists))
        {
          double normal[3], winding[3];
          TriangleNormal(points, before, winding);
          normals->GetTuple(first + polygon, normal);
          const double side = vtkMath::Dot(winding, normal) < 0.0 ? -1.0 : 1.0;
          TriangleNormal(points, ids, normal);
          vtkMath::MultiplyScalar(normal, side);
          normals->SetTuple(first + polygon, normal);
        }
      }
    });
  output->GetCellData()->SetNormals(normals);
}

}
