// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolyDataBridge.h"

#include "DelaunayFlip.h"
#include "FlipError.h"
#include "MalformedArrays.h"
#include "OutputCells.h"
#include "PointViews.h"
#include "TriangleAngles.h"
#include "UpdateProgress.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace delaunayflip
{
namespace
{

/// The lexicographic order of tuples. All NaN are equal and come first.
struct TupleLess
{
  template <typename Value>
  bool operator()(const std::vector<Value>& left, const std::vector<Value>& right) const
  {
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      if (IsLess(left[i], right[i]))
      {
        return true;
      }
      if (IsLess(right[i], left[i]))
      {
        return false;
      }
    }
    return false;
  }

  template <typename Value>
  static bool IsLess(const Value& left, const Value& right)
  {
    return left < right || (left != left && right == right);
  }
};

/// Numbers distinct tuples, in the order of appearance.
template <typename Value>
class Labeler
{
public:
  std::int32_t operator()(const std::vector<Value>& tuple)
  {
    return this->Labels.emplace(tuple, static_cast<std::int32_t>(this->Labels.size()))
      .first->second;
  }

private:
  std::map<std::vector<Value>, std::int32_t, TupleLess> Labels;
};

struct LabelNumbers
{
  template <typename ArrayT>
  void operator()(ArrayT* array, WorkProgress& progress, std::vector<std::int32_t>& labels) const
  {
    using Value = vtk::GetAPIType<ArrayT>;
    Labeler<Value> label;
    std::vector<Value> tuple(array->GetNumberOfComponents());
    std::size_t cell = 0;
    for (const auto values : vtk::DataArrayTupleRange(array))
    {
      std::copy(values.cbegin(), values.cend(), tuple.begin());
      labels[cell++] = label(tuple);
      progress.Add();
    }
  }
};

void LabelStrings(
  vtkAbstractArray* array, WorkProgress& progress, std::vector<std::int32_t>& labels)
{
  Labeler<std::string> label;
  std::vector<std::string> tuple(array->GetNumberOfComponents());
  vtkIdType value = 0;
  for (std::int32_t& cellLabel : labels)
  {
    for (std::string& component : tuple)
    {
      component = array->GetVariantValue(value++).ToString();
    }
    cellLabel = label(tuple);
    progress.Add();
  }
}

/// One label per cell. Cells with equal tuples in the cell array `name` (numbers or strings, any
/// number of components) get the same label. Labels count from 0 in the order of appearance.
/// @throws InvalidOptions when there is no such array, or when it does not have one tuple per cell.
/// @throws RunAborted.
std::vector<std::int32_t> LabelRegions(
  vtkPolyData* mesh, const std::string& name, const ProgressObserver& observer)
{
  vtkAbstractArray* array = mesh->GetCellData()->GetAbstractArray(name.c_str());
  if (!array)
  {
    throw InvalidOptions("RegionArray: the input has no cell array named \"" + name + "\".");
  }
  if (array->GetNumberOfTuples() != mesh->GetNumberOfCells())
  {
    throw InvalidOptions(
      "RegionArray: \"" + name + "\" must have as many tuples as the mesh has cells.");
  }
  std::vector<std::int32_t> labels(mesh->GetNumberOfCells());
  WorkProgress progress(observer, mesh->GetNumberOfCells());
  vtkDataArray* numbers = vtkArrayDownCast<vtkDataArray>(array);
  if (!numbers)
  {
    LabelStrings(array, progress, labels);
  }
  else if (!vtkArrayDispatch::Dispatch::Execute(numbers, LabelNumbers{}, progress, labels))
  {
    LabelNumbers{}(numbers, progress, labels);
  }
  return labels;
}

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

PolyDataBridge::PolyDataBridge(
  vtkPolyData* mesh, vtkPolyData* constraints, const Settings& settings, const UpdatePlan& plan)
  : Mesh(mesh),
    Points(ViewPoints(mesh, Coordinates)),
    Slots(mesh, Points, settings.Triangulate, plan.ForPolygons()),
    Constraints(FindConstraintEdges(
      { settings.LinesAsConstraints ? mesh : nullptr, constraints, Points, Slots.GetTriangles(),
        settings.InsertLines, settings.InsertConstraints },
      plan.ForConstraints()))
{
  this->FreezeGhosts();
  if (!settings.RegionArray.empty())
  {
    this->LabelTriangles(settings.RegionArray, plan.ForRegions());
  }
}

void PolyDataBridge::FreezeGhosts()
{
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts = FindGhosts(this->Mesh);
  if (this->Slots.AreInPlace() && !ghosts)
  {
    return;
  }
  const int ghost = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
    vtkDataSetAttributes::HIDDENCELL;
  this->Frozen.resize(this->Slots.GetTriangles().Count);
  for (vtkIdType triangle = 0; triangle < this->Slots.GetTriangles().Count; ++triangle)
  {
    const vtkIdType cell = this->Slots.GetCell(triangle);
    this->Frozen[triangle] = this->Slots.IsFrozen(triangle) ||
      (ghosts && cell < ghosts->GetNumberOfValues() && (ghosts->GetValue(cell) & ghost) != 0);
  }
}

void PolyDataBridge::LabelTriangles(const std::string& array, const ProgressObserver& progress)
{
  const std::vector<std::int32_t> labels = LabelRegions(this->Mesh, array, progress);
  this->Regions.resize(this->Slots.GetTriangles().Count);
  for (vtkIdType triangle = 0; triangle < this->Slots.GetTriangles().Count; ++triangle)
  {
    this->Regions[triangle] = labels[this->Slots.GetCell(triangle)];
  }
}

TriangleMesh PolyDataBridge::GetMesh() const
{
  TriangleMesh mesh;
  mesh.Points = this->Points;
  mesh.Triangles = this->Slots.GetTriangles();
  const std::vector<PointPair>& pairs = this->Constraints.Pairs;
  mesh.ConstraintEdges = pairs.empty() ? nullptr : pairs.front().data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(pairs.size());
  mesh.ConstraintsToInsert = pairs.empty() ? nullptr : this->Constraints.ToInsert.data();
  mesh.Regions = this->Regions.empty() ? nullptr : this->Regions.data();
  mesh.FrozenTriangles = this->Frozen.empty() ? nullptr : this->Frozen.data();
  return mesh;
}

void PolyDataBridge::Store(const FlipSession& session, vtkPolyData* output) const
{
  output->SetPoints(this->Mesh->GetPoints());
  output->SetVerts(this->Mesh->GetVerts());
  output->SetLines(this->Mesh->GetLines());
  output->SetPolys(BuildPolygons(session, this->Slots, this->Mesh));
  output->SetStrips(BuildStrips(this->Slots, this->Mesh));
  output->GetPointData()->ShallowCopy(this->Mesh->GetPointData());
  output->GetFieldData()->ShallowCopy(this->Mesh->GetFieldData());
  PassCellData(this->Mesh, this->Slots, output);
  RenewNormals(this->Points, this->Slots, output);
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

void PolyDataBridge::AddDefects(std::vector<Defect>& defects) const
{
  AddMalformedArrays(this->Mesh, this->Slots.AreInPlace(), defects);
}

void PolyDataBridge::StoreFlipCounts(const FlipSession& session, vtkPolyData* output) const
{
  std::vector<int> counts(this->Slots.GetTriangles().Count);
  session.StoreFlipCounts(counts.data());
  AddTriangleArray<vtkIntArray>(
    { "vtkDelaunayFlipCount", std::move(counts), 0 }, this->Slots, output);
}

void PolyDataBridge::StoreAngles(const FlipSession& session, int threads,
  const ProgressObserver& progress, vtkPolyData* output) const
{
  const GeometryKind geometry = session.GetReport().GeometryUsed;
  TriangleMesh mesh = this->GetMesh();
  std::vector<double> before(mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, threads, before.data(), MakePart(progress, 0.0, 0.5));
  std::vector<std::int64_t> ids(3 * mesh.Triangles.Count);
  session.StoreTriangles(MutableTriangleArray(ids.data(), mesh.Triangles.Count));
  mesh.Triangles =
    TriangleArray(static_cast<const std::int64_t*>(ids.data()), mesh.Triangles.Count);
  std::vector<double> after(mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, threads, after.data(), MakePart(progress, 0.5, 1.0));
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  AddTriangleArray<vtkDoubleArray>(
    { "vtkDelaunayFlipAngleBefore", std::move(before), NaN }, this->Slots, output);
  AddTriangleArray<vtkDoubleArray>(
    { "vtkDelaunayFlipAngleAfter", std::move(after), NaN }, this->Slots, output);
}

}
