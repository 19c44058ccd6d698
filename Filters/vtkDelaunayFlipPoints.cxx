// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipPoints.h"

#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "FlipRun.h"
#include "MeshBlocks.h"
#include "UpdateReport.h"

#include "vtkAbstractTransform.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace delaunayflip;

static_assert(
  static_cast<int>(RingRuleKind::Orientation) == vtkDelaunayFlipPoints::RING_RULE_ORIENTATION, "");

namespace
{

/// The rotation that takes the plane of the points to that of x and y. Points that are not finite
/// do not matter.
vtkSmartPointer<vtkTransform> FitPlane(vtkPoints* points)
{
  vtkNew<vtkPoints> finite;
  finite->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const double* x = points->GetPoint(i);
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
    {
      finite->InsertNextPoint(x);
    }
  }
  double origin[3], normal[3] = { 0.0, 0.0, 1.0 }, axis[3];
  vtkPlane::ComputeBestFittingPlane(finite, origin, normal);
  vtkMath::MultiplyScalar(normal, normal[2] < 0.0 ? -1.0 : 1.0);
  const double up[3] = { 0.0, 0.0, 1.0 };
  vtkMath::Cross(normal, up, axis);
  auto rotation = vtkSmartPointer<vtkTransform>::New();
  rotation->RotateWXYZ(
    vtkMath::DegreesFromRadians(std::atan2(vtkMath::Norm(axis), normal[2])), axis);
  return rotation;
}

/// The finite heights of a range of points. Low exceeds High if there are none.
struct HeightRange
{
  double Low = INFINITY, High = -INFINITY;

  HeightRange(const PointArray& points, vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType i = begin; i < end; ++i)
    {
      const double height = points.Get(i, 2);
      if (std::isfinite(height))
      {
        this->Low = std::min(this->Low, height);
        this->High = std::max(this->High, height);
      }
    }
  }

  bool IsZero() const { return this->Low == 0.0 && this->High == 0.0; }
};

/// What decides the triangles of a block.
struct CloudRequest
{
  vtkPolyData* Cloud; ///< Its points and point data, and the lines that are segments.
  vtkPolyData* Segments; ///< Or null.
  vtkAbstractTransform* Transform; ///< Or null.
  bool FitsPlane;
  bool ClosedLinesAsRings;
  vtkIdType FirstHole;
  PointOptions Options;
  Stamps Points; ///< Of the cloud.
  Stamps Arrays; ///< Of both, but for these points.
  std::vector<double> Key; ///< The values of the options, and when the transform was modified.
  bool IsLive;
  ProgressObserver Progress;
};

/// Triangulates the points of a block.
class CloudRun : public UpdateRun
{
public:
  explicit CloudRun(const CloudRequest& request)
    : UpdateRun({ { false, false, request.Segments != nullptr, false, true, true, false },
        request.Progress }),
      Asked(request),
      Given(
        request.IsLive ? CopyPoints(request.Cloud) : vtkSmartPointer<vtkPolyData>(request.Cloud)),
      Cloud(vtkSmartPointer<vtkPolyData>::New())
  {
    this->Cloud->ShallowCopy(this->Given);
    this->AddSegments(request.Segments, request.ClosedLinesAsRings);
    this->FindFlatPoints(request.FirstHole);
    this->Input.Points = this->Project(request);
    this->Input.Segments = this->Segments.data();
    this->Input.NumberOfSegments = static_cast<std::int64_t>(this->Rings.size());
    this->Input.Rings = this->Rings.data();
    this->Input.FirstAdded = this->Given->GetNumberOfPoints();
    if (request.FirstHole >= 0)
    {
      this->Input.FirstHole =
        static_cast<std::int32_t>(std::min<vtkIdType>(request.FirstHole, VTK_INT_MAX));
    }
    this->Session =
      std::make_unique<FlipSession>(this->Input, request.Options, this->GetProgress());
    if (!request.IsLive)
    {
      this->Room = this->MakeRoom();
      for (const ResultMemory& memory : ListMemory(this->Room))
      {
        this->Session->Expect(memory.First, memory.Bytes);
      }
    }
  }

  /// Whether these are the points that a live run has copied. A filter upstream whose output was
  /// released may have been executed again and have put out the same points.
  bool HasCopyOf(vtkPolyData* cloud) const
  {
    std::vector<double> storage, others;
    return this->Asked.IsLive &&
      HaveSameBits(ViewPoints(this->Given, storage), ViewPoints(cloud, others));
  }

  FlipReport GetReport() const override
  {
    FlipReport report = this->Session->GetReport();
    report.Points += static_cast<std::int64_t>(this->Session->GetAddedPoints().size());
    AddDefect(this->DescribeFlatPoints(), report.Defects);
    const auto malformed = ListMalformedArrays(this->Given, !this->AddsPoints(), true);
    report.Defects.insert(report.Defects.end(), malformed.begin(), malformed.end());
    AddDefect(this->ShortArrays, report.Defects);
    return report;
  }

  bool Store(vtkPolyData* output) const override
  {
    output->SetPoints(this->Cloud->GetPoints());
    output->GetPointData()->ShallowCopy(this->Cloud->GetPointData());
    output->GetFieldData()->ShallowCopy(this->Cloud->GetFieldData());
    AddPointFieldData(this->Session->GetReport().FromPoints, output->GetFieldData());
    if (!this->Session->GetAddedPoints().empty())
    {
      this->AddCrossings(output);
    }
    if (this->AddsPoints())
    {
      DemoteGlobalIds(output->GetPointData());
    }
    // Triangles may have been removed since.
    const bool fits =
      this->Room && this->Room->GetNumberOfCells() == this->Session->GetReport().Triangles;
    const auto triangles = fits ? this->Room : this->MakeRoom();
    FillTriangles(*this->Session, triangles);
    output->SetPolys(triangles);
    return true;
  }

private:
  bool AddsPoints() const
  {
    return this->Cloud->GetPoints() != this->Given->GetPoints() ||
      !this->Session->GetAddedPoints().empty();
  }

  vtkSmartPointer<vtkCellArray> MakeRoom() const
  {
    return MakeRoomForTriangles(this->Session->GetReport().Triangles, sizeof(vtkIdType) == 8);
  }

  void AddSegments(vtkPolyData* others, bool closedLinesAsRings)
  {
    vtkPolyData* given = this->Given;
    const vtkIdType count = given->GetNumberOfPoints();
    this->AddCells(
      given->GetLines(), { "line, cell", given->GetNumberOfVerts(), count }, {}, CellKind::Line);
    this->FirstOther = this->Segments.size();
    if (!others)
    {
      return;
    }
    const auto segments = ShareMesh(others); // which observers cannot take away
    std::vector<double> storage, otherStorage;
    const PointArray points = ViewPoints(given, storage);
    const PointArray otherPoints = ViewPoints(segments, otherStorage);
    const bool areSame = otherPoints.Count == 0 || HaveSameBits(points, otherPoints);
    const auto ids =
      areSame ? std::vector<vtkIdType>() : this->AddPoints(points, otherPoints, segments);
    const vtkIdType size = areSame ? count : otherPoints.Count;
    const vtkIdType verts = segments->GetNumberOfVerts();
    this->AddCells(segments->GetLines(), { "segment cell", verts, size }, ids,
      closedLinesAsRings ? CellKind::LineOrRing : CellKind::Line);
    this->AddCells(segments->GetPolys(),
      { "segment cell", verts + segments->GetNumberOfLines(), size }, ids, CellKind::Ring);
  }

  enum class CellKind
  {
    Line,
    LineOrRing, ///< A line that ends where it begins is a ring.
    Ring
  };

  /// @param ids of the points that the cells name; empty: their own. Rings have the numbers of
  /// their cells.
  void AddCells(vtkCellArray* cells, const PointIdCheck& check, const std::vector<vtkIdType>& ids,
    CellKind kind)
  {
    std::vector<vtkIdType> path;
    VisitCells(cells, check,
      [&](vtkIdType cell, vtkIdList* points)
      {
        path.clear();
        for (const vtkIdType id : *points)
        {
          path.push_back(ids.empty() ? id : ids[id]);
        }
        const bool isRing =
          kind == CellKind::Ring || (kind == CellKind::LineOrRing && this->IsClosed(path));
        const bool isOpen = !path.empty() && (path.size() == 1 || path.front() != path.back());
        if (kind == CellKind::Ring && isOpen)
        {
          path.push_back(path.front());
        }
        for (std::size_t i = 1; i < path.size(); ++i)
        {
          if (path[i - 1] != path[i] || isRing)
          {
            this->Segments.insert(this->Segments.end(), { path[i - 1], path[i] });
            this->Rings.push_back(isRing ? static_cast<std::int32_t>(check.FirstCell + cell) : -1);
          }
        }
      });
  }

  /// Whether a line of three or more points ends at the place where it begins.
  bool IsClosed(const std::vector<vtkIdType>& path) const
  {
    if (path.size() < 3)
    {
      return false;
    }
    std::array<double, 3> first, last;
    this->Cloud->GetPoint(path.front(), first.data());
    this->Cloud->GetPoint(path.back(), last.data());
    return path.front() == path.back() || first == last;
  }

  /// Adds the points of the segments to the cloud where they are new. @returns the id of each.
  std::vector<vtkIdType> AddPoints(
    const PointArray& points, const PointArray& otherPoints, vtkPolyData* segments)
  {
    PointPlaces places(points.Floats || otherPoints.Floats);
    std::vector<vtkIdType> ids(otherPoints.Count);
    for (vtkIdType i = 0; i < otherPoints.Count; ++i)
    {
      ids[i] = places.Add(otherPoints, i); // at first the number of its place
    }
    std::vector<vtkIdType> first(places.GetNumberOfPlaces(), PointPlaces::None);
    WorkProgress progress(this->Plan.For(UpdatePlan::Constraints), points.Count);
    for (vtkIdType i = points.Count - 1; i >= 0; --i)
    {
      const std::int64_t place = places.Find(points, i);
      if (place != PointPlaces::None)
      {
        first[place] = i;
      }
      progress.Add();
    }
    vtkNew<vtkIdList> added;
    for (vtkIdType i = 0; i < otherPoints.Count; ++i)
    {
      vtkIdType& id = first[ids[i]];
      if (id == PointPlaces::None)
      {
        id = points.Count + added->InsertNextId(i);
      }
      ids[i] = id;
    }
    if (added->GetNumberOfIds() > 0)
    {
      vtkPointData* data = segments->GetPointData();
      AppendPoints(this->Given, segments->GetPoints(), added,
        TakeWholeArrays(data, otherPoints.Count), this->Cloud);
      this->ShortArrays = FindShortArrays(
        data, otherPoints.Count, "point", " of the second input with too few tuples left out");
    }
    return ids;
  }

  /// Finds the added points of lines, outlines or holes, each of the three by itself, that have
  /// z = 0 throughout, while the given points have other heights.
  void FindFlatPoints(vtkIdType firstHole)
  {
    std::vector<double> storage;
    const PointArray points = ViewPoints(this->Cloud, storage);
    const vtkIdType given = this->Given->GetNumberOfPoints();
    const HeightRange heights(points, 0, given);
    if (points.Count == given || heights.Low > heights.High || heights.IsZero())
    {
      return;
    }
    const auto getKind = [&](std::size_t end)
    {
      const std::int32_t ring = this->Rings[end / 2];
      const bool isHole = firstHole >= 0 && ring >= firstHole;
      return ring < 0 ? 0 : (isHole ? 2 : 1);
    };
    bool isFlat[3] = { true, true, true };
    for (std::size_t end = this->FirstOther; end < this->Segments.size(); ++end)
    {
      isFlat[getKind(end)] &= points.Get(this->Segments[end], 2) == 0.0;
    }
    std::vector<bool> isListed(points.Count, false);
    for (std::size_t end = this->FirstOther; end < this->Segments.size(); ++end)
    {
      const std::int64_t point = this->Segments[end];
      if (point >= given && isFlat[getKind(end)] && !isListed[point])
      {
        isListed[point] = true;
        this->FlatPoints.push_back(point);
      }
    }
  }

  /// Counts those of them that triangles use.
  Defect DescribeFlatPoints() const
  {
    if (this->FlatPoints.empty() || this->Session->GetReport().Triangles == 0)
    {
      return {};
    }
    std::vector<std::int64_t> used(this->Cloud->GetNumberOfPoints());
    this->Session->StoreUsedPoints(used.data());
    const auto count = std::count_if(this->FlatPoints.begin(), this->FlatPoints.end(),
      [&](std::int64_t point) { return used[point] == point; });
    std::vector<double> storage;
    const PointArray points = ViewPoints(this->Given, storage);
    const HeightRange heights(points, 0, points.Count);
    constexpr int Digits = 6;
    const std::string text =
      "points of segments without heights (z = 0 throughout; the given points have z = " +
      FormatNumber(heights.Low, Digits) + " to " + FormatNumber(heights.High, Digits) +
      "): the mesh goes to z = 0 there; if it should not, give them heights, for example those of "
      "the nearest points";
    return { text, count, {}, DefectIds::Points };
  }

  /// A view of the points, or of a projection of them.
  PlaneArray Project(const CloudRequest& request)
  {
    if (!request.Transform && !request.FitsPlane)
    {
      const PointArray xyz = ViewPoints(this->Cloud, this->Storage);
      return xyz.Floats ? PlaneArray(xyz.Floats, xyz.Count, 3)
                        : PlaneArray(xyz.Doubles, xyz.Count, 3);
    }
    vtkPoints* points = this->Cloud->GetPoints();
    vtkSmartPointer<vtkAbstractTransform> transform = request.Transform;
    this->Projected->SetDataTypeToDouble();
    (transform ? transform.Get() : FitPlane(points).Get())
      ->TransformPoints(points, this->Projected);
    return PlaneArray(static_cast<const double*>(this->Projected->GetVoidPointer(0)),
      points->GetNumberOfPoints(), 3);
  }

  /// Adds the points where segments cross to an output.
  void AddCrossings(vtkPolyData* output) const
  {
    const std::vector<AddedPoint>& crossings = this->Session->GetAddedPoints();
    const vtkIdType count = this->Cloud->GetNumberOfPoints();
    const auto places = MakeRange(0, static_cast<vtkIdType>(crossings.size()));
    vtkNew<vtkPoints> zeros;
    zeros->SetNumberOfPoints(places->GetNumberOfIds());
    zeros->GetData()->Fill(0.0);
    AppendPoints(this->Cloud, zeros, places, nullptr, output);
    vtkPointData* data = output->GetPointData();
    vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
      data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = data->GetAbstractArray(i);
      const bool isLabel = std::count(std::begin(labels), std::end(labels), array) > 0;
      for (vtkIdType k = 0; !isLabel && k < places->GetNumberOfIds(); ++k)
      {
        const AddedPoint& point = crossings[k];
        array->InterpolateTuple(count + k, point.From, array, point.To, array, point.Share);
      }
    }
    vtkDataArray* xyz = output->GetPoints()->GetData();
    const bool isProjected = this->Projected->GetNumberOfPoints() > 0;
    for (vtkIdType i = 0; i < 3 * places->GetNumberOfIds(); ++i)
    {
      // InterpolateTuple would make infinite floats finite.
      const AddedPoint& point = crossings[i / 3];
      const int axis = static_cast<int>(i % 3);
      const double between = (1.0 - point.Share) * xyz->GetComponent(point.From, axis) +
        point.Share * xyz->GetComponent(point.To, axis);
      const double place = axis == 0 ? point.X : point.Y;
      xyz->SetComponent(count + i / 3, axis, isProjected || axis == 2 ? between : place);
    }
  }

public:
  CloudRequest Asked; ///< Its meshes may be gone.

private:
  vtkSmartPointer<vtkPolyData> Given; ///< The input.
  vtkSmartPointer<vtkPolyData> Cloud; ///< With the points of the segments.
  std::vector<double> Storage; ///< Points that cannot be viewed in place.
  vtkNew<vtkPoints> Projected; ///< In the plane, if there is a projection.
  std::vector<std::int64_t> Segments; ///< Pairs of ids.
  std::vector<std::int32_t> Rings; ///< One number per segment.
  Defect ShortArrays; ///< Of the second input.
  std::size_t FirstOther = 0; ///< Of Segments, where those of the second input begin.
  std::vector<std::int64_t> FlatPoints; ///< See FindFlatPoints.
  PointInput Input; ///< Views of these.
};

}

vtkStandardNewMacro(vtkDelaunayFlipPoints);
vtkCxxSetObjectMacro(vtkDelaunayFlipPoints, Transform, vtkAbstractTransform);

//------------------------------------------------------------------------------
vtkDelaunayFlipPoints::vtkDelaunayFlipPoints()
{
  this->InputType = "vtkPointSet";
  this->SizeOfBlocks = vtkDataObject::POINT;
}

vtkDelaunayFlipPoints::~vtkDelaunayFlipPoints() { this->SetTransform(nullptr); }

vtkMTimeType vtkDelaunayFlipPoints::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Transform ? std::max(own, this->Transform->GetMTime()) : own;
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipPoints::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& segments, UpdateSummary& summary)
{
  if (block.Leaves.size() > 1)
  {
    throw InvalidMesh("the points are in several partitions; join them first, by "
                      "vtkAppendDataSets, or Merge Blocks in ParaView",
      -1, -1);
  }
  BlockLeaf& leaf = block.Leaves.front();
  const auto output = vtkSmartPointer<vtkPolyData>::New();
  leaf.Result = output;
  auto* points = vtkPointSet::SafeDownCast(leaf.Data);
  if (!points)
  {
    leaf.Result = Hold(leaf.Data);
    summary.Warnings.push_back({ block.Name, "has no points of its own, passed unchanged" });
    return;
  }
  using Asked = vtkStreamingDemandDrivenPipeline;
  if (this->GetOutputInformation(0)->Get(Asked::UPDATE_PIECE_NUMBER()) > 0) // the first has all
  {
    return;
  }
  const auto others = ListOthers(block, segments, "the segments of a single dataset");
  if (others.size() > 1)
  {
    throw InvalidOptions("the segments are in several partitions; join them first, by "
                         "vtkAppendPolyData, or Merge Blocks in ParaView");
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points->GetPoints());
  cloud->GetPointData()->ShallowCopy(points->GetPointData());
  cloud->GetFieldData()->ShallowCopy(points->GetFieldData());
  DropResults(cloud->GetFieldData());
  auto* mesh = vtkPolyData::SafeDownCast(points);
  if (this->LinesAsSegments && mesh)
  {
    cloud->SetVerts(mesh->GetVerts()); // so that lines have their cell ids
    cloud->SetLines(mesh->GetLines());
  }
  this->TimeOfBlock = points->GetMTime();
  // Segments that all blocks share make no mesh of their own in an empty one.
  const bool isEmptyBlock = !block.Place.empty() && points->GetNumberOfPoints() == 0;
  const bool hasSegments = !isEmptyBlock && !others.empty();
  this->FlipMesh(cloud, hasSegments ? vtkPolyData::SafeDownCast(others.front().Data) : nullptr,
    block.IsLive, output);
  output->SetVerts(nullptr);
  output->SetLines(nullptr);
}

bool vtkDelaunayFlipPoints::ContinueOrStart(
  std::unique_ptr<UpdateRun>& run, vtkPolyData* cloud, vtkPolyData* segments, bool isLive)
{
  PointOptions options;
  options.Backend = static_cast<BackendKind>(this->Backend);
  options.Device = this->DeviceId;
  options.NumberOfThreads = this->NumberOfThreads;
  options.MaximumIterations = this->MaximumIterations;
  options.PointTolerance = this->PointTolerance;
  options.SplitCrossings = this->SplitCrossings;
  options.RingRule = static_cast<RingRuleKind>(this->RingRule);
  options.Alpha = this->Alpha;
  options.LongestEdge = this->LongestEdge;
  Stamps points, arrays;
  for (vtkPolyData* given : { cloud, segments })
  {
    if (given)
    {
      given == cloud ? points.AddPoints(given, this->TimeOfBlock) : arrays.AddPoints(given);
      arrays.AddCells(given->GetVerts());
      arrays.AddCells(given->GetLines());
      arrays.AddCells(given->GetPolys());
      arrays.AddArrays(given->GetPointData());
      arrays.AddArrays(given->GetFieldData());
    }
  }
  const std::vector<double> key{ this->Transform ? double(this->Transform->GetMTime()) : 0.0,
    double(this->Projection), double(this->LinesAsSegments), double(this->ClosedLinesAsRings),
    this->PointTolerance, double(this->SplitCrossings), double(this->RingRule),
    double(this->FirstHole), this->Alpha, this->LongestEdge };
  auto* last = static_cast<CloudRun*>(run.get());
  if (last && last->Asked.Key == key && last->Asked.Options == options &&
    last->Asked.Arrays.Fit(arrays) && (last->Asked.Points.Fit(points) || last->HasCopyOf(cloud)))
  {
    last->Asked.Points = std::move(points);
    return true;
  }
  run.reset(); // its memory may be needed
  run = std::make_unique<CloudRun>(CloudRequest{ cloud, segments, this->Transform,
    this->Projection == PROJECTION_BEST_FITTING_PLANE, this->ClosedLinesAsRings, this->FirstHole,
    options, std::move(points), std::move(arrays), key, isLive, this->MakeProgress() });
  return false;
}

//------------------------------------------------------------------------------
vtkIdType vtkDelaunayFlipPoints::GetNumberOfSegmentEdges() const
{
  return this->GetReport().FromPoints.SegmentEdges;
}

vtkIdType vtkDelaunayFlipPoints::GetNumberOfRefusedSegments() const
{
  return this->GetReport().FromPoints.RefusedSegments;
}

void vtkDelaunayFlipPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "Transform: " << this->Transform << "\n";
  os << indent << "Alpha: " << this->Alpha << "\n";
  os << indent << "LongestEdge: " << this->LongestEdge << "\n";
  os << indent << "PointTolerance: " << this->PointTolerance << "\n";
  os << indent << "SplitCrossings: " << this->SplitCrossings << "\n";
  os << indent << "RingRule: " << this->RingRule << "\n";
  os << indent << "FirstHole: " << this->FirstHole << "\n";
  os << indent << "LinesAsSegments: " << this->LinesAsSegments << "\n";
  os << indent << "ClosedLinesAsRings: " << this->ClosedLinesAsRings << "\n";
}
