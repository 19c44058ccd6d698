// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolyDataBridge.h"

#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "TriangleAngles.h"
#include "UpdateReport.h"

#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace delaunayflip
{

PolyDataBridge::PolyDataBridge(vtkPolyData* mesh, vtkPolyData* constraints,
  const BridgeSettings& settings, const UpdatePlan& plan)
  : Mesh(mesh),
    Points(ViewPoints(mesh, Coordinates)),
    AreLinesConstraints(settings.LinesAsConstraints),
    Refines(settings.Refines),
    Slots(mesh, Points, settings.Triangulate, plan.For(UpdatePlan::Polygons))
{
  if (!settings.RegionSeeds.empty())
  {
    this->RegionSeeds = ReadRegionSeeds(settings.RegionSeeds);
  }
  const bool hasLines = settings.LinesAsConstraints && mesh->GetNumberOfLines() > 0;
  if (constraints || hasLines)
  {
    this->Constraints = FindConstraintEdges(
      this->GetMesh(), mesh, constraints, settings, plan.For(UpdatePlan::Constraints));
  }
  if (mesh->GetCellData()->HasArray(vtkDataSetAttributes::GhostArrayName()))
  {
    this->FreezeGhosts();
  }
  if (!settings.RegionArray.empty())
  {
    this->LabelRegions(settings.RegionArray, plan.For(UpdatePlan::Regions));
  }
  if (!settings.SizeArray.empty())
  {
    this->ReadSizes(settings.SizeArray);
  }
}

/// Triangles of ghost cells stay.
void PolyDataBridge::FreezeGhosts()
{
  const auto ghosts = FindGhosts(this->Mesh);
  if (!ghosts)
  {
    return;
  }
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

void PolyDataBridge::ReadSizes(const std::string& name)
{
  vtkDataArray* array = FindSizes(this->Mesh, name, this->Points.Count);
  for (vtkIdType i = 0; i < this->Points.Count; ++i)
  {
    this->Sizes.push_back(array->GetComponent(i, 0));
  }
}

void PolyDataBridge::RequireValidIds() const
{
  const PointIdCheck check{ "cell", this->Slots.FirstPolygon, this->Points.Count };
  const TriangleArray& triangles = this->Slots.Triangles;
  for (vtkIdType triangle = 0; triangle < triangles.Count; ++triangle)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      check.RequireInRange(triangle, triangles.Get(triangle, slot));
    }
  }
}

namespace
{
/// A text that only equal values have: a number with all of its digits, whatever its type.
std::string DescribeValue(const vtkVariant& value)
{
  if (!value.IsFloat() && !value.IsDouble())
  {
    return value.ToString();
  }
  const double number = value.ToDouble();
  constexpr int Digits = std::numeric_limits<double>::max_digits10;
  return vtkMath::IsNan(number) ? "nan" : FormatNumber(number + 0.0, Digits); // 0 and -0 are equal
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
  std::vector<std::int32_t> labels; // one per cell
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
  // sizes. A double has too few bits for integers of 64 bits.
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
      key += DescribeValue(array->GetVariantValue(i)) + '\0';
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

void PolyDataBridge::MovePoints(
  vtkPolyData* mesh, const PointArray& points, std::vector<double>& coordinates)
{
  this->Mesh = mesh;
  this->Points = points;
  this->Coordinates.swap(coordinates);
}

TriangleMesh PolyDataBridge::GetMesh() const
{
  TriangleMesh mesh;
  mesh.Points = this->Points;
  mesh.Triangles = this->Slots.Triangles;
  const std::vector<PointPair>& pairs = this->Constraints.Pairs;
  if (!pairs.empty())
  {
    mesh.ConstraintEdges = pairs.front().data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(pairs.size());
    mesh.ConstraintsToInsert = this->Constraints.ToInsert.data();
  }
  mesh.Regions = ViewValues(this->Regions);
  mesh.FrozenTriangles = ViewValues(this->Slots.Frozen);
  mesh.Sizes = ViewValues(this->Sizes);
  mesh.RegionSeeds = ViewValues(this->RegionSeeds);
  mesh.NumberOfRegionSeeds = static_cast<std::int64_t>(this->RegionSeeds.size());
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
vtkSmartPointer<vtkCellArray> PolyDataBridge::MakeRoom() const
{
  const bool areTriangles = this->Slots.InPlace || this->Slots.ArePolygonsTriangles();
  if (this->Refines || !areTriangles)
  {
    return nullptr;
  }
  return MakeRoomForTriangles(this->Slots.Triangles.Count, UsesWideIds(this->Mesh));
}

void PolyDataBridge::Store(const FlipSession& session, const vtkSmartPointer<vtkCellArray>& room,
  vtkPolyData* mesh, vtkPolyData* output) const
{
  if (this->Refines)
  {
    this->StoreRefined(session, mesh, output);
    return;
  }
  const TriangleSlots& slots = this->Slots;
  output->SetPoints(mesh->GetPoints());
  output->GetPointData()->ShallowCopy(mesh->GetPointData());
  if (room)
  {
    FillTriangles(session, room);
    output->SetPolys(room);
  }
  else
  {
    const vtkIdType count = slots.Triangles.Count;
    std::vector<std::int64_t> ids(3 * count);
    session.StoreTriangles(MutableTriangleArray(ids.data(), count));
    output->SetPolys(BuildPolygons(slots.Polygons, { std::as_const(ids).data(), count }, mesh));
  }
  StoreCells(mesh, slots, slots.Polygons, nullptr, output);
  if (slots.AreDivided)
  {
    DemoteGlobalIds(output->GetCellData());
  }
  if (output->GetCellData()->GetNormals())
  {
    RenewNormals(output,
      [&slots](vtkIdType polygon, const std::int64_t ids[3], std::int64_t before[3])
      {
        const vtkIdType triangle = slots.GetPolygon(polygon).Triangle;
        for (int slot = 0; slot < 3 && triangle != TriangleSlots::None; ++slot)
        {
          before[slot] = slots.Triangles.Get(triangle, slot);
        }
        return !std::equal(ids, ids + 3, before);
      });
  }
}

namespace
{
/// A point that refinement has added on an edge.
struct PointOnEdge
{
  std::pair<std::int64_t, std::int64_t> Edge; ///< Its points, the lower one first.
  double Share; ///< How far the point is on the way from the first of these to the second.
  vtkIdType Point;

  bool operator<(const PointOnEdge& other) const
  {
    return std::tie(this->Edge, this->Share) < std::tie(other.Edge, other.Share);
  }
};

/// The lines of a mesh, with the points that refinement has added on edges along them.
vtkSmartPointer<vtkCellArray> SplitLines(const std::vector<AddedPoint>& added, vtkPolyData* mesh)
{
  vtkSmartPointer<vtkCellArray> lines = mesh->GetLines();
  std::vector<PointOnEdge> points;
  vtkIdType next = mesh->GetNumberOfPoints();
  for (const AddedPoint& point : added)
  {
    if (point.Third < 0)
    {
      const bool isForward = point.From < point.To;
      points.push_back(
        { std::minmax(point.From, point.To), isForward ? point.Share : 1.0 - point.Share, next });
    }
    ++next;
  }
  if (points.empty() || lines->GetNumberOfCells() == 0)
  {
    return lines;
  }
  std::sort(points.begin(), points.end());
  const auto split = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> ids, path;
  for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
  {
    lines->GetCellAtId(line, ids);
    path->Reset();
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      const std::int64_t to = ids->GetId(i), from = i > 0 ? ids->GetId(i - 1) : to;
      const std::pair<std::int64_t, std::int64_t> edge = std::minmax(from, to);
      auto first = std::lower_bound(points.begin(), points.end(), PointOnEdge{ edge, -1.0, 0 });
      auto last = std::lower_bound(first, points.end(), PointOnEdge{ edge, 2.0, 0 });
      while (first != last)
      {
        path->InsertNextId(from < to ? (first++)->Point : (--last)->Point);
      }
      path->InsertNextId(to);
    }
    split->InsertNextCell(path);
  }
  return split;
}
}

PolyDataBridge::RefinedPolygons PolyDataBridge::ListRefined(const FlipSession& session) const
{
  const TriangleSlots& slots = this->Slots;
  RefinedPolygons refined;
  refined.Sources.resize(session.GetReport().Triangles);
  session.StoreSources(refined.Sources.data());
  for (vtkIdType polygon = 0; polygon < slots.GetNumberOfPolygons(); ++polygon)
  {
    refined.Polygons.push_back(slots.GetPolygon(polygon));
  }
  const auto count = static_cast<vtkIdType>(refined.Sources.size());
  for (vtkIdType triangle = slots.Triangles.Count; triangle < count; ++triangle)
  {
    refined.Polygons.push_back({ TriangleSlots::None, triangle });
  }
  for (OutputPolygon& polygon : refined.Polygons)
  {
    if (polygon.Triangle != TriangleSlots::None)
    {
      polygon.Cell = slots.GetCell(refined.Sources[polygon.Triangle]);
    }
  }
  return refined;
}

void PolyDataBridge::StoreRefined(
  const FlipSession& session, vtkPolyData* mesh, vtkPolyData* output) const
{
  const TriangleSlots& slots = this->Slots;
  const RefinedPolygons refined = this->ListRefined(session);
  const auto count = static_cast<vtkIdType>(refined.Sources.size());
  std::vector<std::int64_t> ids(3 * count);
  session.StoreTriangles(MutableTriangleArray(ids.data(), count));
  AppendRefinedPoints(session, mesh, output);
  output->SetPolys(BuildPolygons(refined.Polygons, { std::as_const(ids).data(), count }, mesh));
  StoreCells(mesh, slots, refined.Polygons, nullptr, output);
  if (this->AreLinesConstraints)
  {
    output->SetLines(SplitLines(session.GetAddedPoints(), mesh));
  }
  if (slots.AreDivided || count > slots.Triangles.Count)
  {
    DemoteGlobalIds(output->GetCellData());
  }
  if (output->GetCellData()->GetNormals())
  {
    RenewNormals(output,
      [&](vtkIdType polygon, const std::int64_t of[3], std::int64_t before[3])
      {
        const vtkIdType source = refined.GetSource(polygon);
        for (int slot = 0; slot < 3 && source != TriangleSlots::None; ++slot)
        {
          before[slot] = slots.Triangles.Get(source, slot);
        }
        return !std::equal(of, of + 3, before);
      });
  }
}

/// Gives an output the points of the mesh, followed by those of refinement, with their data.
void PolyDataBridge::AppendRefinedPoints(
  const FlipSession& session, vtkPolyData* mesh, vtkPolyData* output)
{
  const std::vector<AddedPoint>& added = session.GetAddedPoints();
  if (added.empty())
  {
    output->SetPoints(mesh->GetPoints());
    output->GetPointData()->ShallowCopy(mesh->GetPointData());
    return;
  }
  vtkNew<vtkPoints> more;
  more->SetDataTypeToDouble();
  for (const AddedPoint& point : added)
  {
    more->InsertNextPoint(point.X, point.Y, point.Z);
  }
  const auto size = static_cast<vtkIdType>(added.size());
  AppendPoints(mesh, more, MakeRange(0, size), nullptr, output);
  InterpolateTuples(added, mesh->GetNumberOfPoints(), output->GetPointData());
  DemoteGlobalIds(output->GetPointData());
}

void PolyDataBridge::StoreFlipCounts(const FlipSession& session, vtkPolyData* output) const
{
  std::vector<std::int32_t> counts(session.CountTriangles());
  session.StoreFlipCounts(counts.data());
  this->AddNumbers("vtkDelaunayFlipCount", counts, output);
}

void PolyDataBridge::StoreRegions(const FlipSession& session, vtkPolyData* output) const
{
  std::vector<std::int32_t> labels(session.CountTriangles());
  session.StoreRegions(labels.data());
  this->AddNumbers("Region", labels, output);
}

/// Adds a number per triangle of the session; other cells get 0. Triangles that refinement has
/// added are the last polygons.
void PolyDataBridge::AddNumbers(
  const char* name, const std::vector<std::int32_t>& numbers, vtkPolyData* output) const
{
  const TriangleSlots& slots = this->Slots;
  const vtkIdType polygons = slots.GetNumberOfPolygons();
  const auto triangleOf = [&](vtkIdType polygon)
  {
    return polygon < polygons ? slots.GetPolygon(polygon).Triangle
                              : slots.Triangles.Count + polygon - polygons;
  };
  AddTriangleArray(name, numbers, 0, triangleOf, output);
}

void PolyDataBridge::StoreAngles(const FlipSession& session, int threads,
  const ProgressObserver& progress, vtkPolyData* output) const
{
  const GeometryKind geometry = session.GetReport().GeometryUsed;
  TriangleMesh mesh = this->GetMesh();
  std::vector<double> before(mesh.Triangles.Count), after(mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, threads, before.data(), MakePart(progress, 0.0, 0.5));
  if (this->Refines)
  {
    const RefinedPolygons refined = this->ListRefined(session);
    const auto count = static_cast<vtkIdType>(refined.Sources.size());
    std::vector<std::int64_t> ids(3 * count);
    session.StoreTriangles(MutableTriangleArray(ids.data(), count));
    std::vector<double> storage;
    TriangleMesh whole;
    whole.Points = ViewPoints(output, storage);
    whole.Triangles = TriangleArray(std::as_const(ids).data(), count);
    after.resize(count);
    FindSmallestAngles(whole, geometry, threads, after.data(), MakePart(progress, 0.5, 1.0));
    const auto sourceOf = [&](vtkIdType polygon) { return refined.GetSource(polygon); };
    const auto triangleOf = [&](vtkIdType polygon) { return refined.Polygons[polygon].Triangle; };
    AddTriangleArray("Smallest angle before (degrees)", before, NaN, sourceOf, output);
    AddTriangleArray("Smallest angle after (degrees)", after, NaN, triangleOf, output);
    return;
  }
  std::vector<std::int64_t> ids(3 * mesh.Triangles.Count);
  session.StoreTriangles(MutableTriangleArray(ids.data(), mesh.Triangles.Count));
  mesh.Triangles =
    TriangleArray(static_cast<const std::int64_t*>(ids.data()), mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, threads, after.data(), MakePart(progress, 0.5, 1.0));
  const auto triangleOf = [this](vtkIdType polygon)
  { return this->Slots.GetPolygon(polygon).Triangle; };
  AddTriangleArray("Smallest angle before (degrees)", before, NaN, triangleOf, output);
  AddTriangleArray("Smallest angle after (degrees)", after, NaN, triangleOf, output);
}

}
