// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolyDataBridge.h"

#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "PolygonSplit.h"
#include "TriangleAngles.h"
#include "UpdateReport.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <tuple>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace delaunayflip
{
namespace
{

/// Asks for pages of 2 MiB instead of 4 KiB in new memory, because each page is allocated and
/// cleared on first use. Measured in an earlier version: for the connectivity alone, this took an
/// update of 5 M points on a GPU from 63 to 56 ms.
void UseHugePages([[maybe_unused]] vtkDataArray* values)
{
#if defined(__linux__)
  constexpr std::uintptr_t HugePage = std::uintptr_t(2) << 20;
  const auto begin = reinterpret_cast<std::uintptr_t>(values->GetVoidPointer(0));
  const std::uintptr_t first = (begin + HugePage - 1) / HugePage * HugePage;
  const std::uintptr_t end = begin + values->GetNumberOfValues() * values->GetDataTypeSize();
  if (first + HugePage <= end)
  {
    madvise(reinterpret_cast<void*>(first), (end - first) / HugePage * HugePage, MADV_HUGEPAGE);
  }
#endif
}

}

//------------------------------------------------------------------------------
namespace
{

/// Whether offsets are 0, 3, 6, ...; checked by all threads.
template <typename Id>
bool AreTriangleOffsets(const Id* offsets, vtkIdType count)
{
  std::atomic<bool> are{ true };
  vtkSMPTools::For(0, count,
    [&are, offsets](vtkIdType begin, vtkIdType end)
    {
      bool areTriangles = true;
      for (vtkIdType i = begin; i < end; ++i)
      {
        areTriangles = areTriangles && offsets[i] == 3 * i;
      }
      if (!areTriangles)
      {
        are = false;
      }
    });
  return are;
}

/// Whether all cells have three points. Offsets in plain memory are of type VtkId.
template <typename VtkId>
bool AreTriangles(vtkCellArray* cells)
{
  using ArrayT = vtkAOSDataArrayTemplate<VtkId>;
  if (auto* offsets = vtkArrayDownCast<ArrayT>(cells->GetOffsetsArray()))
  {
    return AreTriangleOffsets(offsets->GetPointer(0), offsets->GetNumberOfValues());
  }
  return cells->IsValid() && cells->IsHomogeneous() == 3;
}

/// Views cells as triangles, if all of them are. VTK has ids of type VtkId, and the engine of Id.
template <typename VtkId, typename Id>
bool ViewTriangles(vtkCellArray* cells, TriangleArray& triangles)
{
  auto* ids = vtkArrayDownCast<vtkAOSDataArrayTemplate<VtkId>>(cells->GetConnectivityArray());
  if (!ids || ids->GetNumberOfValues() != 3 * cells->GetNumberOfCells() ||
    !AreTriangles<VtkId>(cells))
  {
    return false;
  }
  // vtkTypeInt64 (long long) and std::int64_t (long) are distinct types of the same representation.
  triangles =
    TriangleArray(reinterpret_cast<const Id*>(ids->GetPointer(0)), cells->GetNumberOfCells());
  return true;
}

}

TriangleSlots::TriangleSlots(
  vtkPolyData* mesh, const PointArray& points, bool triangulate, const ProgressObserver& progress)
  : FirstPolygon(mesh->GetNumberOfVerts() + mesh->GetNumberOfLines()),
    FirstStrip(FirstPolygon + mesh->GetNumberOfPolys())
{
  const auto check = [&](vtkIdType first) { return PointIdCheck{ "cell", first, points.Count }; };
  check(0).RequireValid(mesh->GetVerts());
  check(mesh->GetNumberOfVerts()).RequireValid(mesh->GetLines());
  check(this->FirstStrip).RequireValid(mesh->GetStrips());
  vtkCellArray* polygons = mesh->GetPolys();
  this->InPlace = mesh->GetNumberOfStrips() == 0 &&
    (ViewTriangles<vtkTypeInt32, std::int32_t>(polygons, this->Triangles) ||
      ViewTriangles<vtkTypeInt64, std::int64_t>(polygons, this->Triangles));
  if (this->InPlace)
  {
    return;
  }
  this->NoTriangles = Defect(DefectKind::PolygonsTooSmall);
  if (triangulate)
  {
    this->NoTriangles.Detail = ", left out";
  }
  WorkProgress split(progress,
    polygons->GetNumberOfConnectivityIds() + mesh->GetStrips()->GetNumberOfConnectivityIds());
  VisitCells(polygons, check(this->FirstPolygon),
    [&](vtkIdType polygon, vtkIdList* ids)
    {
      constexpr vtkIdType LargePolygon = 1000; // takes a while to split
      const vtkIdType size = ids->GetNumberOfIds();
      const bool stays = size < 3 || (size > 3 && !triangulate);
      const std::size_t before = this->Ids.size();
      if (stays)
      {
        this->Polygons.push_back({ this->FirstPolygon + polygon, None });
      }
      if (size == 3)
      {
        this->Ids.insert(this->Ids.end(), ids->begin(), ids->end());
      }
      else if (size > 3)
      {
        const std::vector<std::int64_t> corners(ids->begin(), ids->end());
        ProgressObserver observer;
        if (size >= LargePolygon)
        {
          observer = split.ForNext(size);
        }
        if (!SplitPolygon(points, corners.data(), size, this->Ids, observer))
        {
          throw RunAborted();
        }
      }
      const auto made = static_cast<vtkIdType>(this->Ids.size() - before) / 3;
      this->AddTriangles(this->FirstPolygon + polygon, made, stays);
      if (size > 3 && made == 0)
      {
        this->CountNoTriangle(this->FirstPolygon + polygon);
      }
      split.Add(size);
    });
  VisitCells(mesh->GetStrips(), check(this->FirstStrip),
    [&](vtkIdType strip, vtkIdList* ids)
    {
      this->SplitStrip(this->FirstStrip + strip, ids, triangulate);
      split.Add(ids->GetNumberOfIds());
    });
  this->Triangles = TriangleArray(static_cast<const std::int64_t*>(this->Ids.data()),
    static_cast<std::int64_t>(this->Cells.size()));
}

/// Leaves out triangles that name a point twice, by which strips continue elsewhere.
void TriangleSlots::SplitStrip(vtkIdType cell, vtkIdList* ids, bool triangulate)
{
  const vtkIdType size = ids->GetNumberOfIds();
  const bool stays = size < 3 || !triangulate;
  if (stays)
  {
    this->Strips.push_back(cell);
  }
  vtkIdType made = 0;
  for (vtkIdType i = 0; i + 2 < size; ++i)
  {
    // Every other triangle of a strip is wound the other way.
    const vtkIdType odd = i % 2;
    const vtkIdType a = ids->GetId(i + odd), b = ids->GetId(i + 1 - odd), c = ids->GetId(i + 2);
    if (a != b && b != c && c != a)
    {
      this->Ids.insert(this->Ids.end(), { a, b, c });
      ++made;
    }
  }
  this->AddTriangles(cell, made, stays);
}

void TriangleSlots::CountNoTriangle(vtkIdType cell)
{
  constexpr std::size_t Most = 3; // named in the warning
  ++this->NoTriangles.Count;
  if (this->NoTriangles.FirstIds.size() < Most)
  {
    this->NoTriangles.FirstIds.push_back(cell);
  }
}

void TriangleSlots::AddTriangles(vtkIdType cell, vtkIdType count, bool stays)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (!stays)
    {
      this->Polygons.push_back({ cell, static_cast<vtkIdType>(this->Cells.size()) });
    }
    this->Cells.push_back(cell);
    this->Frozen.push_back(static_cast<unsigned char>(stays));
  }
  this->AreDivided = this->AreDivided || (count > 1 && !stays);
}

bool TriangleSlots::ArePolygonsTriangles() const
{
  return this->InPlace ||
    (this->Polygons.size() == this->Cells.size() &&
      std::all_of(this->Polygons.begin(), this->Polygons.end(),
        [](const OutputPolygon& polygon) { return polygon.Triangle != None; }));
}

//------------------------------------------------------------------------------
PolyDataBridge::PolyDataBridge(vtkPolyData* mesh, vtkPolyData* constraints,
  const BridgeSettings& settings, const UpdatePlan& plan)
  : Mesh(mesh),
    Points(ViewPoints(mesh, Coordinates)),
    RegionSeeds(ReadRegionSeeds(settings.RegionSeeds)),
    AreLinesConstraints(settings.LinesAsConstraints),
    Refines(settings.Refines),
    Slots(mesh, Points, settings.Triangulate, plan.For(UpdatePlan::Polygons))
{
  this->Constraints = FindConstraintEdges(
    this->GetMesh(), mesh, constraints, settings, plan.For(UpdatePlan::Constraints));
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
  if (!settings.SizeArray.empty())
  {
    this->ReadSizes(settings.SizeArray);
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
  if (this->Refines || !this->Slots.ArePolygonsTriangles())
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
  if (!this->RegionSeeds.empty())
  {
    std::vector<std::int32_t> labels(session.CountTriangles());
    session.StoreRegions(labels.data());
    this->AddNumbers("Region", labels, output);
  }
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

//------------------------------------------------------------------------------
vtkSmartPointer<vtkCellArray> MakeRoomForTriangles(vtkIdType count, bool areWide)
{
  // Offsets are not shared with the input. Its cells may grow in place later, and the output would
  // then have more offsets than connectivity.
  auto room = vtkSmartPointer<vtkCellArray>::New();
  // There may be more connectivity than 32-bit offsets can number.
  const bool needsWide = areWide || 3 * count > std::numeric_limits<std::int32_t>::max();
  SetWidth(room, needsWide);
  room->ResizeExact(count, 3 * count);
  UseHugePages(room->GetOffsetsArray());
  UseHugePages(room->GetConnectivityArray());
  return room;
}

std::vector<ResultMemory> ListMemory(vtkCellArray* room)
{
  std::vector<ResultMemory> memory;
  if (room)
  {
    for (vtkDataArray* array : { room->GetOffsetsArray(), room->GetConnectivityArray() })
    {
      const vtkIdType bytes = array->GetNumberOfValues() * array->GetDataTypeSize();
      memory.push_back({ array->GetVoidPointer(0), bytes });
    }
  }
  return memory;
}

void FillTriangles(const FlipSession& session, vtkCellArray* room, bool areOrdered)
{
  const vtkIdType count = room->GetNumberOfCells();
  const auto fill = [&](auto* offsets, auto* ids)
  {
    vtkSMPTools::For(0, count + 1,
      [offsets](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          offsets[i] = static_cast<std::decay_t<decltype(*offsets)>>(3 * i);
        }
      });
    const MutableTriangleArray triangles(ids, count);
    if (areOrdered)
    {
      session.StoreOrderedTriangles(triangles);
    }
    else
    {
      session.StoreTriangles(triangles);
    }
  };
  void* offsets = room->GetOffsetsArray()->GetVoidPointer(0);
  void* ids = room->GetConnectivityArray()->GetVoidPointer(0);
  if (room->IsStorage64Bit())
  {
    fill(static_cast<std::int64_t*>(offsets), static_cast<std::int64_t*>(ids));
  }
  else
  {
    fill(static_cast<std::int32_t*>(offsets), static_cast<std::int32_t*>(ids));
  }
}

bool UsesWideIds(vtkPolyData* mesh)
{
  vtkCellArray* cells = mesh->GetNumberOfPolys() > 0 ? mesh->GetPolys() : mesh->GetStrips();
  return cells->GetConnectivityArray()->GetDataTypeSize() == 8;
}

vtkSmartPointer<vtkCellArray> BuildPolygons(
  const std::vector<OutputPolygon>& polygons, const TriangleArray& triangles, vtkPolyData* mesh)
{
  const vtkIdType first = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  SetWidth(cells, UsesWideIds(mesh));
  cells->AllocateEstimate(static_cast<vtkIdType>(polygons.size()), 3);
  vtkNew<vtkIdList> ids;
  for (const OutputPolygon& polygon : polygons)
  {
    if (polygon.Triangle == TriangleSlots::None)
    {
      mesh->GetPolys()->GetCellAtId(polygon.Cell - first, ids);
      cells->InsertNextCell(ids);
    }
    else
    {
      cells->InsertNextCell({ triangles.Get(polygon.Triangle, 0),
        triangles.Get(polygon.Triangle, 1), triangles.Get(polygon.Triangle, 2) });
    }
  }
  return cells;
}

void StoreCells(vtkPolyData* mesh, const TriangleSlots& slots,
  const std::vector<OutputPolygon>& polygons, vtkDataSetAttributes* received, vtkPolyData* output)
{
  output->SetVerts(mesh->GetVerts());
  output->SetLines(mesh->GetLines());
  output->SetStrips(mesh->GetStrips());
  output->GetFieldData()->ShallowCopy(mesh->GetFieldData());
  vtkCellData* data = output->GetCellData();
  const bool areAsBefore = slots.InPlace && !received && polygons.empty();
  if (areAsBefore)
  {
    data->ShallowCopy(mesh->GetCellData());
    return;
  }
  if (static_cast<vtkIdType>(slots.Strips.size()) < mesh->GetNumberOfStrips())
  {
    vtkNew<vtkCellArray> strips;
    vtkNew<vtkIdList> ids;
    for (const vtkIdType cell : slots.Strips)
    {
      mesh->GetStrips()->GetCellAtId(cell - slots.FirstStrip, ids);
      strips->InsertNextCell(ids);
    }
    output->SetStrips(strips);
  }
  const auto sources = MakeRange(0, slots.FirstPolygon);
  for (const OutputPolygon& polygon : polygons)
  {
    if (polygon.Cell != TriangleSlots::None)
    {
      sources->InsertNextId(polygon.Cell);
    }
  }
  const vtkIdType first = sources->GetNumberOfIds(); // the cells received are before the strips
  const vtkIdType count = slots.FirstPolygon + static_cast<vtkIdType>(polygons.size()) - first;
  const auto places = MakeRange(0, first);
  for (const vtkIdType strip : slots.Strips)
  {
    places->InsertNextId(sources->InsertNextId(strip) + count);
  }
  const vtkIdType size = sources->GetNumberOfIds() + count;
  data->Initialize();
  AddTuples(
    TakeWholeArrays(mesh->GetCellData(), mesh->GetNumberOfCells()), sources, places, size, data);
  if (received)
  {
    AddTuples(received, MakeRange(0, count), MakeRange(first, count), size, data);
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
  // NewInstance would make an array that cannot be written if this one computes its values.
  const auto normals =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(shared->GetDataType()));
  normals->DeepCopy(shared);
  normals->SetName(shared->GetName()); // an array of bits does not copy it
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
          const bool wasReversed = vtkMath::Dot(winding, normal) < 0.0;
          TriangleNormal(points, ids, normal);
          if (wasReversed)
          {
            vtkMath::MultiplyScalar(normal, -1.0);
          }
          normals->SetTuple(first + polygon, normal);
        }
      }
    });
  vtkCellData* data = output->GetCellData();
  const int attributes = FindAttributes(data, shared);
  AddAttributes(data, data->SetNormals(normals), attributes);
}

}
