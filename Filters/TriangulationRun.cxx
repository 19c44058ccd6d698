// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "PolyDataBridge.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkAbstractTransform.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

/// The rotation that takes the plane of the first points to that of x and y. Points that are not
/// finite do not matter.
vtkSmartPointer<vtkTransform> FitPlane(vtkPoints* points, vtkIdType count)
{
  vtkNew<vtkPoints> finite;
  finite->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* x = points->GetPoint(i);
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
    {
      finite->InsertNextPoint(x);
    }
  }
  double origin[3], normal[3] = { 0.0, 0.0, 1.0 }, axis[3];
  vtkPlane::ComputeBestFittingPlane(finite, origin, normal);
  if (normal[2] < 0.0)
  {
    vtkMath::MultiplyScalar(normal, -1.0);
  }
  const double up[3] = { 0.0, 0.0, 1.0 };
  vtkMath::Cross(normal, up, axis);
  auto rotation = vtkSmartPointer<vtkTransform>::New();
  rotation->RotateWXYZ(
    vtkMath::DegreesFromRadians(std::atan2(vtkMath::Norm(axis), normal[2])), axis);
  return rotation;
}

/// The finite heights of the first points. Low exceeds High if there are none.
struct HeightRange
{
  double Low = INFINITY, High = -INFINITY;

  HeightRange(const PointArray& points, vtkIdType count)
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double height = points.Get(i, 2);
      if (std::isfinite(height))
      {
        this->Low = std::min(this->Low, height);
        this->High = std::max(this->High, height);
      }
    }
  }

  bool IsEmpty() const { return this->Low > this->High; }
  bool IsZero() const { return this->Low == 0.0 && this->High == 0.0; }
};

/// Whether two requests have the same options. Their inputs may differ.
bool HaveSameOptions(const TriangulationRequest& a, const TriangulationRequest& b)
{
  const auto tie = [](const TriangulationRequest& r)
  {
    return std::tie(r.TransformTime, r.FitsPlane, r.LinesAsSegments, r.ClosedLinesAsRings,
      r.FirstHole, r.Heights, r.SizeArray, r.Regions, r.Options);
  };
  return tie(a) == tie(b);
}

/// Stamps the points of the first input.
Stamps StampPoints(const TriangulationRequest& request)
{
  Stamps stamps;
  stamps.AddPoints(request.Input, request.InputTime);
  return stamps;
}

/// Stamps all arrays of both inputs but these points.
Stamps StampArrays(const TriangulationRequest& request)
{
  Stamps stamps;
  for (vtkPolyData* given : { request.Input, request.Others })
  {
    if (!given)
    {
      continue;
    }
    if (given == request.Others)
    {
      stamps.AddPoints(given);
    }
    stamps.AddCells(given->GetVerts());
    stamps.AddCells(given->GetLines());
    stamps.AddCells(given->GetPolys());
    stamps.AddArrays(given->GetPointData());
    stamps.AddArrays(given->GetFieldData());
  }
  return stamps;
}

vtkSmartPointer<vtkPolyData> CopyShallow(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(mesh);
  return copy;
}

/// Makes arrays of integers ones of doubles, so that what is interpolated is not rounded.
void TurnToDoubles(vtkDataSetAttributes* data)
{
  const vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i); // null if it has no numbers
    const bool isLabel = std::count(std::begin(labels), std::end(labels), array) > 0;
    if (array && array->GetName() && !isLabel && array->GetDataType() != VTK_FLOAT &&
      array->GetDataType() != VTK_DOUBLE)
    {
      vtkNew<vtkDoubleArray> doubles;
      doubles->DeepCopy(array);
      const int attributes = FindAttributes(data, array);
      AddAttributes(data, data->AddArray(doubles), attributes); // in its place
    }
  }
}

/// A copy of points, with arrays of doubles if that is asked for.
vtkSmartPointer<vtkPolyData> CopyForRun(const TriangulationRequest& request, vtkPolyData* points)
{
  auto copy = CopyShallow(points);
  if (request.FillsData)
  {
    TurnToDoubles(copy->GetPointData());
  }
  return copy;
}

/// Writes the tuple of an added point: between those of two or three others.
void InterpolateTuple(vtkIdType target, const AddedPoint& point, vtkAbstractArray* array)
{
  if (point.Third < 0)
  {
    array->InterpolateTuple(target, point.From, array, point.To, array, point.Share);
    return;
  }
  vtkNew<vtkIdList> corners;
  for (const std::int64_t corner : { point.From, point.To, point.Third })
  {
    corners->InsertNextId(corner);
  }
  double weights[] = { 1.0 - point.Share - point.ThirdShare, point.Share, point.ThirdShare };
  array->InterpolateTuple(target, corners, array, weights);
}

/// The segments of both inputs, as pairs of ids of points. Points of the second input that are new
/// come after those of the first one.
class SegmentList
{
public:
  /// @param points receives those of the first input and the new ones.
  SegmentList(const TriangulationRequest& request, vtkPolyData* given, vtkPolyData* points,
    const ProgressObserver& progress)
    : Given(given),
      Points(points),
      FillsData(request.FillsData)
  {
    const vtkIdType count = given->GetNumberOfPoints();
    this->AddCells(
      given->GetLines(), { "line, cell", given->GetNumberOfVerts(), count }, {}, CellKind::Line);
    this->FirstOther = this->Ends.size();
    if (!request.Others)
    {
      return;
    }
    const auto segments = ShareMesh(request.Others); // which observers cannot take away
    std::vector<double> storage, otherStorage;
    const PointArray own = ViewPoints(given, storage);
    const PointArray others = ViewPoints(segments, otherStorage);
    std::vector<vtkIdType> ids; // empty if the cells name points of the first input
    vtkIdType size = count;
    if (others.Count > 0 && !HaveSameBits(own, others))
    {
      ids = this->AddPoints(own, others, segments, progress);
      size = others.Count;
    }
    const CellKind kindOfLines = request.ClosedLinesAsRings ? CellKind::LineOrRing : CellKind::Line;
    PointIdCheck check{ "segment cell", segments->GetNumberOfVerts(), size };
    this->AddCells(segments->GetLines(), check, ids, kindOfLines);
    check.FirstCell += segments->GetNumberOfLines();
    this->AddCells(segments->GetPolys(), check, ids, CellKind::Ring);
  }

  /// Finds the added points of lines, outlines or holes, each of the three by itself, that have
  /// z = 0 throughout, while the given points have other heights.
  std::vector<std::int64_t> FindFlatPoints(vtkIdType firstHole) const
  {
    std::vector<std::int64_t> flat;
    std::vector<double> storage;
    const PointArray points = ViewPoints(this->Points, storage);
    const vtkIdType given = this->Given->GetNumberOfPoints();
    const HeightRange heights(points, given);
    if (points.Count == given || heights.IsEmpty() || heights.IsZero())
    {
      return flat;
    }
    enum
    {
      OfLines,
      OfOutlines,
      OfHoles,
      Kinds
    };
    const auto getKind = [&](std::size_t end)
    {
      const std::int32_t ring = this->Rings[end / 2];
      if (ring < 0)
      {
        return OfLines;
      }
      return firstHole >= 0 && ring >= firstHole ? OfHoles : OfOutlines;
    };
    bool isFlat[Kinds] = { true, true, true };
    for (std::size_t end = this->FirstOther; end < this->Ends.size(); ++end)
    {
      isFlat[getKind(end)] &= points.Get(this->Ends[end], 2) == 0.0;
    }
    std::vector<bool> isListed(points.Count, false);
    for (std::size_t end = this->FirstOther; end < this->Ends.size(); ++end)
    {
      const std::int64_t point = this->Ends[end];
      if (point >= given && isFlat[getKind(end)] && !isListed[point])
      {
        isListed[point] = true;
        flat.push_back(point);
      }
    }
    return flat;
  }

  std::vector<std::int64_t> Ends; ///< Pairs of ids.
  std::vector<std::int32_t> Rings; ///< One number per segment.
  Defect ShortArrays; ///< Point arrays of the second input that are left out.

private:
  enum class CellKind
  {
    Line,
    LineOrRing, ///< A line that ends where it begins is a ring.
    Ring
  };

  /// @param ids are those of the points that the cells name. Empty: the cells name them by these.
  void AddCells(vtkCellArray* cells, const PointIdCheck& check, const std::vector<vtkIdType>& ids,
    CellKind kind)
  {
    std::vector<vtkIdType> path;
    VisitCells(cells, check,
      [&](vtkIdType cell, vtkIdList* points)
      {
        path.assign(points->begin(), points->end());
        if (!ids.empty())
        {
          std::transform(
            path.begin(), path.end(), path.begin(), [&ids](vtkIdType id) { return ids[id]; });
        }
        const bool isRing =
          kind == CellKind::Ring || (kind == CellKind::LineOrRing && this->IsClosed(path));
        const bool isOpen = !path.empty() && (path.size() == 1 || path.front() != path.back());
        if (kind == CellKind::Ring && isOpen)
        {
          path.push_back(path.front());
        }
        this->AddPath(path, isRing, static_cast<std::int32_t>(check.FirstCell + cell));
      });
  }

  /// Rings have the numbers of their cells.
  void AddPath(const std::vector<vtkIdType>& path, bool isRing, std::int32_t cell)
  {
    constexpr std::int32_t NoRing = -1;
    for (std::size_t i = 1; i < path.size(); ++i)
    {
      if (path[i - 1] != path[i] || isRing)
      {
        this->Ends.insert(this->Ends.end(), { path[i - 1], path[i] });
        this->Rings.push_back(isRing ? cell : NoRing);
      }
    }
  }

  /// Whether a line of three or more points ends at the place where it begins.
  bool IsClosed(const std::vector<vtkIdType>& path) const
  {
    if (path.size() < 3)
    {
      return false;
    }
    std::array<double, 3> first, last;
    this->Points->GetPoint(path.front(), first.data());
    this->Points->GetPoint(path.back(), last.data());
    return path.front() == path.back() || first == last;
  }

  /// Adds the points of the segments where they are new. @returns the id of each.
  std::vector<vtkIdType> AddPoints(const PointArray& own, const PointArray& others,
    vtkPolyData* segments, const ProgressObserver& observer)
  {
    PointPlaces places(own.Floats || others.Floats);
    std::vector<vtkIdType> ids(others.Count);
    for (vtkIdType i = 0; i < others.Count; ++i)
    {
      ids[i] = places.Add(others, i); // at first the number of its place
    }
    std::vector<vtkIdType> first(places.GetNumberOfPlaces(), PointPlaces::None);
    WorkProgress progress(observer, own.Count);
    for (vtkIdType i = own.Count - 1; i >= 0; --i)
    {
      const std::int64_t place = places.Find(own, i);
      if (place != PointPlaces::None)
      {
        first[place] = i;
      }
      progress.Add();
    }
    vtkNew<vtkIdList> added;
    for (vtkIdType i = 0; i < others.Count; ++i)
    {
      vtkIdType& id = first[ids[i]];
      if (id == PointPlaces::None)
      {
        id = own.Count + added->InsertNextId(i);
      }
      ids[i] = id;
    }
    if (added->GetNumberOfIds() > 0)
    {
      vtkPointData* data = segments->GetPointData();
      const auto theirs = TakeWholeArrays(data, others.Count);
      if (this->FillsData)
      {
        TurnToDoubles(theirs);
      }
      AppendPoints(CopyShallow(this->Points), segments->GetPoints(), added, theirs, this->Points);
      this->ShortArrays = FindShortArrays(
        data, others.Count, "point", " of the second input with too few tuples left out");
    }
    return ids;
  }

  vtkPolyData* Given;
  vtkPolyData* Points;
  bool FillsData; ///< See TriangulationRequest.
  std::size_t FirstOther = 0; ///< Where the ends of the second input begin.
};

//------------------------------------------------------------------------------
/// Triangulates points.
class TriangulationRun : public UpdateRun
{
public:
  explicit TriangulationRun(const TriangulationRequest& request);

  FlipReport GetReport() const override;
  bool Store(vtkPolyData* output) const override;

  /// Whether the request is for the same triangles.
  bool Fits(const TriangulationRequest& request) const;

  /// Goes on with the points as they are stamped now.
  void Renew(const TriangulationRequest& request) { this->StampedPoints = StampPoints(request); }

private:
  bool HasCopyOf(vtkPolyData* points) const;
  bool AddsPoints() const;
  void ChooseHeights();
  void ReadSizes();
  void ReadRegions();
  std::vector<std::pair<vtkDataArray*, int>> ListSurveyed() const;
  void WriteSurveyed(const std::vector<std::pair<vtkDataArray*, int>>& numbers,
    const std::vector<std::int64_t>& points, const std::vector<double>& values,
    const std::vector<std::int64_t>& lifted);
  void TakeHeights(
    const std::vector<std::int64_t>& points, const std::vector<std::int64_t>& lifted);
  vtkSmartPointer<vtkCellArray> MakeRoom() const;
  Defect DescribeFlatPoints() const;
  PlaneArray Project();
  void AppendAdded(vtkPolyData* output) const;
  void InterpolateData(vtkPointData* data) const;

  TriangulationRequest Asked; ///< Its meshes may be gone.
  Stamps StampedPoints;
  Stamps StampedArrays;
  vtkSmartPointer<vtkPolyData> Given; ///< The input.
  vtkSmartPointer<vtkPolyData> Points; ///< The input with the points of the segments.
  SegmentList Segments;
  std::vector<std::int64_t> FlatPoints; ///< See SegmentList::FindFlatPoints.
  bool AreLifted = false; ///< They have got heights.
  bool HasSurveyed = false; ///< Added points have got data of the given ones.
  std::vector<double> Sizes; ///< Longest edges near points, if they are limited.
  std::vector<RegionSeed> Regions;
  std::vector<double> Storage; ///< Points that cannot be viewed in place.
  vtkNew<vtkPoints> Projected; ///< In the plane, if there is a projection.
  PointInput View; ///< Views of these.
};

bool IsProjected(const TriangulationRequest& request)
{
  return request.Transform || request.FitsPlane;
}

/// Whether points of the second input get point data of the first one, whatever their heights.
bool FillsData(const TriangulationRequest& request)
{
  return request.FillsData || !request.SizeArray.empty();
}

/// Whether points of the second input may get other heights: an estimate, before these are known.
bool MayTakeHeights(const TriangulationRequest& request)
{
  vtkPolyData* others = request.Others;
  const bool fillsData = FillsData(request);
  if (!others || fillsData || request.Heights != HeightsKind::Auto || IsProjected(request))
  {
    return others && (fillsData || request.Heights == HeightsKind::Survey);
  }
  double bounds[6];
  others->GetBounds(bounds);
  return others->GetNumberOfPoints() > 0 && bounds[4] == 0.0 && bounds[5] == 0.0;
}

TriangulationRun::TriangulationRun(const TriangulationRequest& request)
  : UpdateRun({ { false, false, request.Others != nullptr, false, MayTakeHeights(request), true,
                  true, false },
      request.Progress }),
    Asked(request),
    StampedPoints(StampPoints(request)),
    StampedArrays(StampArrays(request)),
    Given(request.IsLive ? CopyPoints(request.Input) : CopyShallow(request.Input)),
    Points(CopyForRun(request, Given)),
    Segments(request, Given, Points, this->Plan.For(UpdatePlan::Constraints)),
    FlatPoints(Segments.FindFlatPoints(request.FirstHole))
{
  this->View.Points = this->Project();
  this->ChooseHeights();
  this->ReadSizes();
  this->ReadRegions();
  this->View.Segments = this->Segments.Ends.data();
  this->View.NumberOfSegments = static_cast<std::int64_t>(this->Segments.Rings.size());
  this->View.Rings = this->Segments.Rings.data();
  this->View.FirstAdded = this->Given->GetNumberOfPoints();
  if (request.FirstHole >= 0)
  {
    this->View.FirstHole =
      static_cast<std::int32_t>(std::min<vtkIdType>(request.FirstHole, VTK_INT_MAX));
  }
  this->Session = std::make_unique<FlipSession>(this->View, request.Options, this->GetProgress());
  if (!request.IsLive)
  {
    this->Room = this->MakeRoom();
    for (const ResultMemory& memory : ListMemory(this->Room))
    {
      this->Session->Expect(memory.First, memory.Bytes);
    }
  }
}

bool TriangulationRun::Fits(const TriangulationRequest& request) const
{
  return HaveSameOptions(this->Asked, request) && this->StampedArrays.Fit(StampArrays(request)) &&
    (this->StampedPoints.Fit(StampPoints(request)) || this->HasCopyOf(request.Input));
}

/// Whether these are the points that a live run has copied. If the output of a filter upstream was
/// released, it may have been executed again and have put out the same points.
bool TriangulationRun::HasCopyOf(vtkPolyData* points) const
{
  std::vector<double> storage, others;
  return this->Asked.IsLive &&
    HaveSameBits(ViewPoints(this->Given, storage), ViewPoints(points, others));
}

/// A view of the points, or of a projection of them.
PlaneArray TriangulationRun::Project()
{
  const vtkIdType count = this->Points->GetNumberOfPoints();
  if (const auto projection = FindProjection(this->Asked, this->Points->GetPoints(), count))
  {
    this->Projected->SetDataTypeToDouble();
    projection->TransformPoints(this->Points->GetPoints(), this->Projected);
    return { static_cast<const double*>(this->Projected->GetVoidPointer(0)), count, 3 };
  }
  return ViewPlane(ViewPoints(this->Points, this->Storage));
}

//------------------------------------------------------------------------------
FlipReport TriangulationRun::GetReport() const
{
  FlipReport report = this->Session->GetReport();
  report.Points += static_cast<std::int64_t>(this->Session->GetAddedPoints().size());
  AddDefect(this->DescribeFlatPoints(), report.Defects);
  const auto malformed = ListMalformedArrays(this->Given, !this->AddsPoints(), true);
  report.Defects.insert(report.Defects.end(), malformed.begin(), malformed.end());
  AddDefect(this->Segments.ShortArrays, report.Defects);
  return report;
}

bool TriangulationRun::AddsPoints() const
{
  return this->Points->GetPoints() != this->Given->GetPoints() ||
    !this->Session->GetAddedPoints().empty();
}

/// Counts the flat points that are corners of triangles.
Defect TriangulationRun::DescribeFlatPoints() const
{
  const std::int64_t triangles = this->Session->GetReport().Triangles;
  if (this->FlatPoints.empty() || triangles == 0)
  {
    return {};
  }
  std::vector<std::int64_t> corners(3 * triangles);
  this->Session->StoreTriangles(MutableTriangleArray(corners.data(), triangles));
  std::set<std::int64_t> found(this->FlatPoints.begin(), this->FlatPoints.end());
  const auto total = static_cast<std::int64_t>(found.size());
  for (const std::int64_t corner : corners)
  {
    found.erase(corner);
  }
  const std::int64_t count = total - static_cast<std::int64_t>(found.size());
  const std::string fate = this->AreLifted
    ? "they have got the heights of the given points there; SegmentHeights Own keeps z = 0"
    : "the mesh goes to z = 0 there; if it should not, give them heights, for example those of the "
      "nearest points";
  std::vector<double> storage;
  const PointArray points = ViewPoints(this->Given, storage);
  const HeightRange heights(points, points.Count);
  constexpr int Digits = 6;
  Defect flat(DefectKind::PointsWithoutHeights, count);
  flat.Detail =
    " (z = 0 throughout; the given points have z = " + FormatNumber(heights.Low, Digits) + " to " +
    FormatNumber(heights.High, Digits) + "): " + fate;
  return flat;
}

//------------------------------------------------------------------------------
/// Gives points of the second input the heights and data that are asked for.
void TriangulationRun::ChooseHeights()
{
  const HeightsKind heights = this->Asked.Heights;
  const bool isProjected = IsProjected(this->Asked);
  if (heights == HeightsKind::Survey && isProjected)
  {
    throw InvalidOptions("SegmentHeights: the heights of the survey are for x and y; with another "
                         "projection choose Own");
  }
  const vtkIdType given = this->Given->GetNumberOfPoints();
  std::vector<std::int64_t> added(this->Points->GetNumberOfPoints() - given), lifted;
  std::iota(added.begin(), added.end(), given);
  if (heights == HeightsKind::Survey)
  {
    lifted = added;
  }
  else if (heights == HeightsKind::Auto && !isProjected)
  {
    lifted = this->FlatPoints;
  }
  if (heights != HeightsKind::Auto)
  {
    this->FlatPoints.clear(); // nobody is told of what was asked for
  }
  this->TakeHeights(FillsData(this->Asked) ? added : lifted, lifted);
}

/// Finds the longest edges near points. Near those that have no number there is no limit.
void TriangulationRun::ReadSizes()
{
  const std::string& name = this->Asked.SizeArray;
  if (name.empty())
  {
    return;
  }
  const vtkIdType given = this->Given->GetNumberOfPoints(), count = this->View.Points.Count;
  vtkDataArray* array = this->Points->GetPointData()->GetArray(name.c_str());
  if (!array)
  {
    throw InvalidOptions("SizeArray: the input has no point array of numbers named \"" + name +
      "\"; " + ListNames(this->Points->GetPointData()) + ".");
  }
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() < count)
  {
    throw InvalidOptions("SizeArray: \"" + name +
      "\" must have one component, and as many tuples as there are points.");
  }
  const auto has = [&name](vtkPolyData* points)
  { return points && points->GetPointData()->HasArray(name.c_str()) != 0; };
  const bool areGiven = has(this->Given);
  const bool areAddedKnown = has(this->Asked.Others) || this->HasSurveyed;
  this->Sizes.assign(count, NAN);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool isKnown = i < given ? areGiven : areAddedKnown;
    if (isKnown)
    {
      this->Sizes[i] = array->GetComponent(i, 0);
    }
  }
  this->View.Sizes = this->Sizes.data();
}

void TriangulationRun::ReadRegions()
{
  for (const std::array<double, 4>& region : this->Asked.Regions)
  {
    const double label = region[2];
    const bool isInteger = label >= INT32_MIN && label <= INT32_MAX && label == std::floor(label);
    if (!isInteger)
    {
      throw InvalidOptions("the label of region " + std::to_string(this->Regions.size()) +
        " must be an integer from -2147483648 to 2147483647, not " + FormatNumber(label, 10));
    }
    this->Regions.push_back({ region[0], region[1], static_cast<std::int32_t>(label), region[3] });
  }
  this->View.Regions = ViewValues(this->Regions);
  this->View.NumberOfRegions = static_cast<std::int64_t>(this->Regions.size());
}

/// The numbers that points of the second input get from the given ones: pairs of an array of the
/// points and a component. z is the first one.
std::vector<std::pair<vtkDataArray*, int>> TriangulationRun::ListSurveyed() const
{
  vtkDataArray* xyz = this->Points->GetPoints()->GetData();
  std::vector<std::pair<vtkDataArray*, int>> numbers = { { xyz, 2 } };
  vtkPointData* data = this->Points->GetPointData();
  const vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i); // null if it has no numbers
    if (!array || !array->GetName() ||
      std::count(std::begin(labels), std::end(labels), array) > 0 ||
      this->Asked.Others->GetPointData()->HasArray(array->GetName()))
    {
      continue;
    }
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      numbers.push_back({ array, k });
    }
  }
  return numbers;
}

/// Writes numbers of points; z, which is the first of them, only of those that are lifted.
/// @param values those of a point one after the other.
void TriangulationRun::WriteSurveyed(const std::vector<std::pair<vtkDataArray*, int>>& numbers,
  const std::vector<std::int64_t>& points, const std::vector<double>& values,
  const std::vector<std::int64_t>& lifted)
{
  std::vector<bool> areLifted(this->Points->GetNumberOfPoints(), false);
  for (const std::int64_t point : lifted)
  {
    areLifted[point] = true;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto& [array, component] = numbers[i % numbers.size()];
    const std::int64_t point = points[i / numbers.size()];
    const bool isReal = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
    const bool isWanted = i % numbers.size() > 0 || areLifted[point];
    if (isReal && isWanted)
    {
      array->SetComponent(point, component, values[i]);
    }
    else if (isWanted && std::isfinite(values[i]))
    {
      array->SetComponent(point, component, std::round(values[i]));
    }
  }
}

/// Gives points of the second input the data of the given points, and those of them that are lifted
/// the heights: interpolated in the triangulation of the given points alone, and outside of it as
/// at the nearest place on its boundary. Without triangles nothing changes.
void TriangulationRun::TakeHeights(
  const std::vector<std::int64_t>& points, const std::vector<std::int64_t>& lifted)
{
  PointInput given;
  given.Points = this->View.Points;
  given.Points.Count = this->Given->GetNumberOfPoints();
  if (points.empty() || given.Points.Count == 0)
  {
    return;
  }
  const auto numbers = this->ListSurveyed();
  if (lifted.empty() && numbers.size() == 1)
  {
    return;
  }
  PointOptions options;
  options.Backend = this->Asked.Options.Backend;
  options.Device = this->Asked.Options.Device;
  options.NumberOfThreads = this->Asked.Options.NumberOfThreads;
  const ProgressObserver observer = this->Plan.For(UpdatePlan::Heights);
  FlipSession survey(given, options, observer);
  survey.Advance(-1, {}, observer);
  if (survey.GetReport().StopReason == StopReasonKind::Aborted)
  {
    throw RunAborted();
  }
  if (survey.GetReport().Triangles == 0)
  {
    return;
  }
  const std::size_t width = numbers.size();
  std::vector<double> values(given.Points.Count * width), places, results(points.size() * width);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto& [array, component] = numbers[i % width];
    values[i] = array->GetComponent(static_cast<vtkIdType>(i / width), component);
  }
  for (const std::int64_t point : points)
  {
    places.insert(
      places.end(), { this->View.Points.Get(point, 0), this->View.Points.Get(point, 1) });
  }
  PlaceQuery query;
  query.Places = { places.data(), static_cast<std::int64_t>(points.size()), 2 };
  query.Values = values.data();
  query.Components = static_cast<int>(width);
  query.Outside = OutsideKind::Nearest;
  query.Results = results.data();
  survey.Ask(query);
  this->WriteSurveyed(numbers, points, results, lifted);
  this->Points->GetPoints()->Modified();
  this->AreLifted = !lifted.empty();
  this->HasSurveyed = true;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkCellArray> TriangulationRun::MakeRoom() const
{
  return MakeRoomForTriangles(this->Session->GetReport().Triangles, sizeof(vtkIdType) == 8);
}

bool TriangulationRun::Store(vtkPolyData* output) const
{
  output->SetPoints(this->Points->GetPoints());
  output->GetPointData()->ShallowCopy(this->Points->GetPointData());
  output->GetFieldData()->ShallowCopy(this->Points->GetFieldData());
  AddPointFieldData(this->Session->GetReport(), output->GetFieldData());
  if (!this->Session->GetAddedPoints().empty())
  {
    this->AppendAdded(output);
  }
  if (this->AddsPoints())
  {
    DemoteGlobalIds(output->GetPointData());
  }
  vtkSmartPointer<vtkCellArray> triangles = this->Room;
  if (!triangles || triangles->GetNumberOfCells() != this->Session->GetReport().Triangles)
  {
    triangles = this->MakeRoom(); // triangles may have been removed since the room was made
  }
  FillTriangles(*this->Session, triangles);
  output->SetPolys(triangles);
  if (!this->Regions.empty())
  {
    vtkNew<vtkIntArray> labels;
    labels->SetName("Region");
    labels->SetNumberOfValues(triangles->GetNumberOfCells());
    this->Session->StoreRegions(labels->GetPointer(0));
    output->GetCellData()->AddArray(labels);
  }
  return true;
}

/// Appends the points where segments cross, and those of refinement, to an output.
void TriangulationRun::AppendAdded(vtkPolyData* output) const
{
  const std::vector<AddedPoint>& added = this->Session->GetAddedPoints();
  const vtkIdType first = this->Points->GetNumberOfPoints();
  const auto size = static_cast<vtkIdType>(added.size());
  vtkNew<vtkPoints> zeros;
  zeros->SetNumberOfPoints(size);
  zeros->GetData()->Fill(0.0);
  AppendPoints(this->Points, zeros, MakeRange(0, size), nullptr, output);
  this->InterpolateData(output->GetPointData());
  vtkDataArray* xyz = output->GetPoints()->GetData();
  const bool isProjected = this->Projected->GetNumberOfPoints() > 0;
  for (vtkIdType i = 0; i < size; ++i)
  {
    const AddedPoint& point = added[i];
    double place[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      // InterpolateTuple would make infinite floats finite.
      place[axis] = (1.0 - point.Share - point.ThirdShare) * xyz->GetComponent(point.From, axis) +
        point.Share * xyz->GetComponent(point.To, axis);
      if (point.Third >= 0)
      {
        place[axis] += point.ThirdShare * xyz->GetComponent(point.Third, axis);
      }
    }
    if (!isProjected)
    {
      place[0] = point.X;
      place[1] = point.Y;
    }
    xyz->SetTuple(first + i, place);
  }
}

/// Gives the added points the data between those of others, except labels of points.
void TriangulationRun::InterpolateData(vtkPointData* data) const
{
  vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (std::count(std::begin(labels), std::end(labels), array) > 0)
    {
      continue;
    }
    vtkIdType next = this->Points->GetNumberOfPoints();
    for (const AddedPoint& point : this->Session->GetAddedPoints())
    {
      InterpolateTuple(next++, point, array);
    }
  }
}

}

//------------------------------------------------------------------------------
bool TriangulationRequest::HasWork() const
{
  return this->Input->GetNumberOfPoints() > 0 ||
    (this->Others && this->Others->GetNumberOfPoints() > 0);
}

bool TriangulationRequest::ContinueOrStart(std::unique_ptr<UpdateRun>& run) const
{
  auto* last = static_cast<TriangulationRun*>(run.get());
  if (last && last->Fits(*this))
  {
    last->Renew(*this);
    return true;
  }
  run.reset(); // its memory may be needed
  run = std::make_unique<TriangulationRun>(*this);
  return false;
}

vtkSmartPointer<vtkAbstractTransform> FindProjection(
  const TriangulationRequest& request, vtkPoints* points, vtkIdType count)
{
  if (!request.Transform && request.FitsPlane)
  {
    return FitPlane(points, count);
  }
  return request.Transform;
}

}
