// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceOutput.h"

#include "MalformedArrays.h"
#include "OutputCells.h"
#include "TriangleSlots.h"
#include "TupleTransfer.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangle.h"

#include <numeric>

namespace delaunayflip
{
namespace
{

vtkSmartPointer<vtkIdList> MakeRange(vtkIdType first, vtkIdType count)
{
  auto range = vtkSmartPointer<vtkIdList>::New();
  range->SetNumberOfIds(count);
  std::iota(range->begin(), range->end(), first);
  return range;
}

/// The data of own items, at `targets`, and behind them or between them that of received ones.
struct JoinedData
{
  vtkDataSetAttributes* Own;
  vtkIdList* Sources; ///< Ids in Own.
  vtkIdList* Targets;
  vtkDataSetAttributes* Received;
  vtkIdType FirstReceived; ///< The place of the first received item.

  void Store(vtkDataSetAttributes* result) const
  {
    const vtkIdType received =
      this->Received->GetNumberOfArrays() > 0 ? this->Received->GetNumberOfTuples() : 0;
    const vtkIdType all = this->Targets->GetNumberOfIds() + received;
    result->CopyAllOn();
    if (this->Own->GetNumberOfArrays() == 0)
    {
      if (this->Sources->GetNumberOfIds() == 0)
      {
        result->ShallowCopy(this->Received);
      }
      return;
    }
    result->CopyAllocate(this->Own, all);
    result->CopyData(this->Own, this->Sources, this->Targets);
    this->AddReceived(received, result);
  }

private:
  void AddReceived(vtkIdType count, vtkDataSetAttributes* result) const
  {
    const auto from = MakeRange(0, count);
    const auto to = MakeRange(this->FirstReceived, count);
    for (int i = 0; i < result->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* target = result->GetAbstractArray(i);
      const char* name = target->GetName();
      vtkAbstractArray* source = this->Received->GetAbstractArray(name ? name : "");
      if (source)
      {
        target->InsertTuples(to, from, source);
      }
    }
  }
};

}

PieceOutput::PieceOutput(vtkPolyData* mesh, const TriangleSlots& slots, const FlippedPiece& flipped)
  : Mesh(mesh),
    Slots(slots),
    Flipped(flipped)
{
  this->ListPolygons();
}

/// The polygons that stayed, in their order, then those received.
void PieceOutput::ListPolygons()
{
  constexpr vtkIdType Gone = -1;
  std::vector<vtkIdType> placeOfSlot(this->Slots.GetTriangles().Count, 0);
  for (const std::int64_t slot : this->Flipped.GoneTriangles)
  {
    placeOfSlot[slot] = Gone;
  }
  vtkIdType kept = 0;
  for (vtkIdType& place : placeOfSlot)
  {
    place = place == Gone ? Gone : kept++;
  }
  for (vtkIdType polygon = 0; polygon < this->Slots.GetNumberOfPolygons(); ++polygon)
  {
    const vtkIdType slot = this->Slots.GetTriangle(polygon);
    const vtkIdType place = slot == TriangleSlots::None ? -1 : placeOfSlot[slot];
    if (slot == TriangleSlots::None || place >= 0)
    {
      this->Polygons.push_back({ this->Slots.GetCellOfPolygon(polygon), place });
    }
  }
  for (vtkIdType i = 0; i < this->CountReceived(); ++i)
  {
    this->Polygons.push_back({ -1, kept + i });
  }
}

bool PieceOutput::IsUnchanged() const
{
  return this->Slots.AreInPlace() && this->CountReceived() == 0 &&
    this->Flipped.GoneTriangles.empty();
}

void PieceOutput::Store(
  vtkCellData* cellData, bool areDivided, PieceGroup& group, vtkPolyData* output) const
{
  this->StorePoints(group, output);
  vtkNew<vtkCellData> received;
  BringTuples(
    this->Flipped.ReceivedTriangles, cellData,
    [this](std::int64_t slot) { return this->Slots.GetCell(slot); }, group, received);
  DoTogether(group,
    [&]()
    {
      this->StoreCells(output);
      output->GetFieldData()->ShallowCopy(this->Mesh->GetFieldData());
      this->StoreCellData(cellData, received, output);
      if (areDivided)
      {
        DemoteGlobalIds(output->GetCellData());
      }
    });
}

/// The points of the mesh, then those received, with their data.
void PieceOutput::StorePoints(PieceGroup& group, vtkPolyData* output) const
{
  const vtkSmartPointer<vtkPointData> data = TakeWholePointArrays(this->Mesh);
  vtkNew<vtkPointData> received;
  BringTuples(
    this->Flipped.ReceivedPoints, data,
    [](std::int64_t point) { return static_cast<vtkIdType>(point); }, group, received);
  const auto count = static_cast<vtkIdType>(this->Flipped.ReceivedPoints.size());
  const vtkIdType given = this->Mesh->GetNumberOfPoints();
  DoTogether(group,
    [&]()
    {
      if (count == 0)
      {
        output->SetPoints(this->Mesh->GetPoints());
        output->GetPointData()->ShallowCopy(data);
        return;
      }
      output->SetPoints(this->MakePoints());
      const auto own = MakeRange(0, given);
      JoinedData{ data, own, own, received, given }.Store(output->GetPointData());
    });
}

vtkSmartPointer<vtkPoints> PieceOutput::MakePoints() const
{
  const vtkIdType given = this->Mesh->GetNumberOfPoints();
  const auto count = static_cast<vtkIdType>(this->Flipped.ReceivedPoints.size());
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(this->Flipped.AreFloats ? VTK_FLOAT : VTK_DOUBLE);
  if (given > 0)
  {
    points->SetDataType(this->Mesh->GetPoints()->GetDataType());
  }
  points->SetNumberOfPoints(given + count);
  if (given > 0)
  {
    points->InsertPoints(0, given, 0, this->Mesh->GetPoints());
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(given + i, this->Flipped.ReceivedCoordinates.data() + 3 * i);
  }
  return points;
}

void PieceOutput::StoreCells(vtkPolyData* output) const
{
  output->SetVerts(this->Mesh->GetVerts());
  output->SetLines(this->Mesh->GetLines());
  output->SetStrips(BuildStrips(this->Slots, this->Mesh));
  vtkNew<vtkCellArray> polygons;
  UsesWideIds(this->Mesh) ? polygons->Use64BitStorage() : polygons->Use32BitStorage();
  vtkNew<vtkIdList> ids;
  for (const OutputCell& cell : this->Polygons)
  {
    if (cell.Triangle < 0)
    {
      this->Mesh->GetPolys()->GetCellAtId(cell.Source - this->Slots.GetFirstPolygon(), ids);
      polygons->InsertNextCell(ids);
    }
    else
    {
      const std::int32_t* points = this->Flipped.Triangles.data() + 3 * cell.Triangle;
      polygons->InsertNextCell({ points[0], points[1], points[2] });
    }
  }
  output->SetPolys(polygons);
}

void PieceOutput::StoreCellData(
  vtkCellData* cellData, vtkCellData* received, vtkPolyData* output) const
{
  if (this->IsUnchanged())
  {
    output->GetCellData()->ShallowCopy(cellData);
    return;
  }
  const vtkIdType before = this->Slots.GetFirstPolygon();
  const auto sources = MakeRange(0, before);
  const auto targets = MakeRange(0, before);
  for (const OutputCell& cell : this->Polygons)
  {
    if (cell.Source >= 0)
    {
      targets->InsertNextId(sources->InsertNextId(cell.Source));
    }
  }
  const vtkIdType firstReceived = sources->GetNumberOfIds();
  for (const vtkIdType strip : this->Slots.GetStrips())
  {
    targets->InsertNextId(sources->InsertNextId(strip) + this->CountReceived());
  }
  JoinedData{ cellData, sources, targets, received, firstReceived }.Store(output->GetCellData());
}

//------------------------------------------------------------------------------
template <typename ArrayT, typename Value>
void PieceOutput::AddTriangleArray(
  const char* name, const std::vector<Value>& values, Value elsewhere, vtkPolyData* output) const
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfTuples(output->GetNumberOfCells());
  array->FillValue(elsewhere);
  const vtkIdType first = this->Slots.GetFirstPolygon();
  for (std::size_t polygon = 0; polygon < this->Polygons.size(); ++polygon)
  {
    if (this->Polygons[polygon].Triangle >= 0)
    {
      array->SetValue(
        first + static_cast<vtkIdType>(polygon), values[this->Polygons[polygon].Triangle]);
    }
  }
  output->GetCellData()->AddArray(array);
}

template void PieceOutput::AddTriangleArray<vtkIntArray>(
  const char*, const std::vector<int>&, int, vtkPolyData*) const;
template void PieceOutput::AddTriangleArray<vtkDoubleArray>(
  const char*, const std::vector<double>&, double, vtkPolyData*) const;

void PieceOutput::RenewNormals(vtkPolyData* output) const
{
  const vtkSmartPointer<vtkDataArray> normals = CopyNormals(output);
  if (!normals)
  {
    return;
  }
  for (std::size_t polygon = 0; polygon < this->Polygons.size(); ++polygon)
  {
    const vtkIdType triangle = this->Polygons[polygon].Triangle;
    if (triangle >= 0 && this->Flipped.FlipCounts[triangle] > 0)
    {
      this->RenewNormal(this->Slots.GetFirstPolygon() + static_cast<vtkIdType>(polygon), triangle,
        output->GetPoints(), normals);
    }
  }
  output->GetCellData()->SetNormals(normals);
}

void PieceOutput::RenewNormal(
  vtkIdType cell, vtkIdType triangle, vtkPoints* points, vtkDataArray* normals) const
{
  double corners[3][3], old[3], normal[3];
  for (int slot = 0; slot < 3; ++slot)
  {
    points->GetPoint(this->Flipped.Triangles[3 * triangle + slot], corners[slot]);
  }
  vtkTriangle::ComputeNormal(corners[0], corners[1], corners[2], normal);
  normals->GetTuple(cell, old);
  if (vtkMath::Dot(old, normal) < 0.0)
  {
    vtkMath::MultiplyScalar(normal, -1.0);
  }
  normals->SetTuple(cell, normal);
}

}
