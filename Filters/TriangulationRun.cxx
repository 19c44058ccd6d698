// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "PolyDataBridge.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkAbstractTransform.h"
#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

/// Whether two requests have the same options. Their inputs may differ.
bool HaveSameOptions(const TriangulationRequest& a, const TriangulationRequest& b)
{
  const auto tie = [](const TriangulationRequest& r)
  {
    return std::tie(r.TransformTime, r.FitsPlane, r.LinesAsSegments, r.ClosedLinesAsRings,
      r.PassesSegments, r.FirstHole, r.Heights, r.WantsHeights, r.HeightArray, r.SizeArray,
      r.Regions, r.Options, r.KeepsRun);
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

/// Stamps all arrays of both inputs but these points. A run with steps does not begin anew when a
/// filter upstream is executed again and passes the same arrays, so the times of datasets do not
/// matter there.
Stamps StampArrays(const TriangulationRequest& request)
{
  Stamps stamps;
  const bool hasSteps = request.IterationsPerUpdate >= 0;
  for (vtkPolyData* given : { request.Input, request.Others })
  {
    if (!given)
    {
      continue;
    }
    const vtkMTimeType time = given == request.Others ? request.OthersTime : request.InputTime;
    const vtkMTimeType since = hasSteps ? 0 : time;
    if (given == request.Others)
    {
      stamps.AddPoints(given, since);
    }
    stamps.AddCells(given->GetVerts());
    stamps.AddCells(given->GetLines());
    stamps.AddCells(given->GetPolys());
    stamps.AddArrays(given->GetPointData(), since);
    stamps.AddArrays(given->GetFieldData());
  }
  return stamps;
}

/// A copy of points, with arrays of doubles if that is asked for.
vtkSmartPointer<vtkPolyData> CopyForRun(const TriangulationRequest& request, vtkPolyData* points)
{
  auto copy = CopyShallow(points);
  if (request.ConvertsToDoubles)
  {
    TurnToDoubles(copy->GetPointData());
  }
  return copy;
}

/// Whether points have an array with a tuple for each of them.
bool HasWholeArray(vtkPolyData* points, const char* name)
{
  vtkAbstractArray* array = points->GetPointData()->GetAbstractArray(name);
  return array && array->GetNumberOfTuples() >= points->GetNumberOfPoints();
}

/// Components of an array that are interpolated between the given points.
struct SurveyedArray
{
  vtkDataArray* Array;
  int First, Count;
  bool OnlyUnknown; ///< Whether numbers that are finite stay.
};

//------------------------------------------------------------------------------
/// Triangulates points.
class TriangulationRun : public UpdateRun
{
public:
  /// Reads the input.
  explicit TriangulationRun(const TriangulationRequest& request);

  void OpenSession() override;

  /// Whether the points of a request may be those of this run at other places.
  bool MayBeFollowed(const TriangulationRequest& request) const;

  /// Takes over the session of such a run and moves its points to the places of these. Nothing
  /// happens if their coordinates have another precision, or if segments have other ends.
  /// @throws RunAborted; then the other run is what it was. See FlipSession::Move.
  void Follow(TriangulationRun& last);

  FlipReport GetReport() const override;
  bool Store(vtkPolyData* output) const override;
  const FlipSession* GetSessionToDraw() const override
  {
    return this->Asked.IsRefined() ? nullptr : this->Session.get();
  }
  bool HasFollowed() const override { return this->IsFollowing; }

  /// Whether the request is for the same triangles, at once or in steps as this run.
  bool Fits(const TriangulationRequest& request) const;

  /// Goes on with the points as they are stamped now.
  void Renew(const TriangulationRequest& request) { this->StampedPoints = StampPoints(request); }

private:
  bool HasCopyOf(vtkPolyData* points) const;
  bool AddsPoints() const;
  void ChooseHeights();
  void ReadSizes();
  void ReadRegions();
  std::vector<SurveyedArray> ListSurveyed() const;
  void AskSurvey(
    FlipSession& survey, const SurveyedArray& surveyed, const std::vector<std::int64_t>& points);
  void TakeHeights(
    const std::vector<std::int64_t>& points, const std::vector<std::int64_t>& lifted);
  vtkSmartPointer<vtkCellArray> MakeRoom() const;
  Defect DescribePointsWithoutHeights() const;
  PlaneArray Project();
  void StoreRegions(vtkPolyData* output) const;

  TriangulationRequest Asked; ///< Its meshes may be gone.
  Stamps StampedPoints; ///< Only a live run is compared with the next input.
  Stamps StampedArrays;
  vtkSmartPointer<vtkPolyData> Given; ///< The input.
  vtkSmartPointer<vtkPolyData> Points; ///< The input with the points of the segments.
  SegmentList Segments;
  PointsWithoutHeights WithoutHeights; ///< Those that a warning counts.
  bool IsFollowing = false; ///< See HasFollowed.
  bool AreLifted = false; ///< They have got heights.
  /// Sizes of the points that segments add, not rounded, if they are interpolated.
  std::vector<double> SurveyedSizes;
  std::vector<double> Sizes; ///< Longest edges near points, if they are limited.
  std::vector<RegionSeed> Regions;
  std::vector<double> Storage; ///< Points that cannot be viewed in place, or must not.
  std::vector<float> FloatStorage; ///< Likewise, in single precision.
  vtkNew<vtkPoints> Projected; ///< In the plane, if there is a projection.
  PointInput View; ///< Views of these.
};

bool IsOnSphere(const TriangulationRequest& request)
{
  return request.Options.Projection != ProjectionKind::Plane;
}

bool IsProjected(const TriangulationRequest& request)
{
  return request.Transform || request.FitsPlane || IsOnSphere(request);
}

/// Whether points of the second input may get heights or data of the first one: an estimate, before
/// these points are known.
bool MayTakeHeights(const TriangulationRequest& request)
{
  vtkPolyData* others = request.Others;
  const bool hasData = request.Input->GetPointData()->GetNumberOfArrays() > 0;
  if (!others || hasData || request.Heights != HeightsKind::Auto || IsProjected(request))
  {
    return others && (hasData || request.Heights == HeightsKind::Survey);
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
    StampedPoints(request.IsLive ? StampPoints(request) : Stamps()),
    StampedArrays(request.IsLive ? StampArrays(request) : Stamps()),
    Given(request.IsLive ? CopyPoints(request.Input) : CopyShallow(request.Input)),
    Points(CopyForRun(request, Given)),
    Segments({ request.Others, request.ClosedLinesAsRings, request.ConvertsToDoubles }, Given,
      Points, this->Plan.For(UpdatePlan::Constraints)),
    WithoutHeights(Segments.FindPointsWithoutHeights(request.FirstHole))
{
  if (IsOnSphere(request))
  {
    this->WithoutHeights = {}; // those on the equator
  }
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
}

void TriangulationRun::OpenSession()
{
  if (this->Asked.KeepsRun)
  {
    this->View.Points = CopyPlaces(
      this->View.Points, this->FloatStorage, this->Storage); // the caller may change them
  }
  this->Session =
    std::make_unique<FlipSession>(this->View, this->Asked.Options, this->GetProgress());
  if (!this->Asked.IsLive)
  {
    this->Room = this->MakeRoom();
    for (const ResultMemory& memory : ListMemory(this->Room))
    {
      this->Session->Expect(memory.First, memory.Bytes);
    }
  }
}

bool TriangulationRun::MayBeFollowed(const TriangulationRequest& request) const
{
  return request.KeepsRun && this->Asked.IsLive == request.IsLive &&
    HaveSameOptions(this->Asked, request) &&
    this->Given->GetNumberOfPoints() == request.Input->GetNumberOfPoints() &&
    this->Session->GetReport().Converged();
}

void TriangulationRun::Follow(TriangulationRun& last)
{
  const PlaneArray& places = this->View.Points;
  const bool isSameType = (places.Floats == nullptr) == (last.View.Points.Floats == nullptr);
  const bool isSame = isSameType && places.Count == last.View.Points.Count &&
    this->Segments.Ends == last.Segments.Ends && this->Segments.Rings == last.Segments.Rings;
  if (!isSame)
  {
    return;
  }
  PointMove move;
  move.Points = places;
  if (!last.Session->Move(move, this->GetProgress()))
  {
    throw RunAborted();
  }
  this->Session = std::move(last.Session);
  this->Segments.Ends.swap(last.Segments.Ends); // which the session has views of
  this->Segments.Rings.swap(last.Segments.Rings);
  this->View.Segments = this->Segments.Ends.data();
  this->View.Rings = this->Segments.Rings.data();
  const FlipReport& report = this->Session->GetReport();
  this->IsFollowing = report.FromPoints.MoveRounds > 0 && report.Triangles > 0 &&
    this->Points->GetNumberOfPoints() == this->Given->GetNumberOfPoints() &&
    this->Segments.Ends.empty();
}

bool TriangulationRun::Fits(const TriangulationRequest& request) const
{
  return this->Asked.IsLive == request.IsLive && HaveSameOptions(this->Asked, request) &&
    this->StampedArrays.Fit(StampArrays(request)) &&
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
  AddDefect(this->DescribePointsWithoutHeights(), report.Defects);
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

/// What a warning says of points without heights.
struct HeightWords
{
  const char* What;
  const char* Kept; ///< What SegmentHeights Own does.
  const char* Fate; ///< What they do to the mesh.
};

/// @param areAtZero whether some have z = 0.
/// @param areNotFinite whether some have a z that is not finite.
HeightWords ChooseWords(bool areAtZero, bool areNotFinite)
{
  if (!areNotFinite)
  {
    return { "z = 0 throughout", "keeps z = 0", "the mesh goes to z = 0 there; if it should not" };
  }
  if (!areAtZero)
  {
    return { "z is not finite", "keeps their z", "the mesh has no heights there; if it should" };
  }
  return { "z = 0 throughout, or not finite", "keeps their z",
    "the mesh goes to z = 0 there, or has no heights; if it should not" };
}

/// Counts the points without heights that are corners of triangles.
Defect TriangulationRun::DescribePointsWithoutHeights() const
{
  const std::int64_t triangles = this->Session->GetReport().Triangles;
  if (this->WithoutHeights.List().empty() || triangles == 0)
  {
    return {};
  }
  std::vector<std::int64_t> corners(3 * triangles);
  this->Session->StoreTriangles(MutableTriangleArray(corners.data(), triangles));
  std::vector<bool> isCorner(this->Points->GetNumberOfPoints(), false);
  for (const std::int64_t corner : corners)
  {
    if (corner < static_cast<std::int64_t>(isCorner.size())) // else refinement has added it
    {
      isCorner[corner] = true;
    }
  }
  const auto count = [&isCorner](const std::vector<std::int64_t>& points)
  {
    return std::count_if(
      points.begin(), points.end(), [&isCorner](std::int64_t point) { return isCorner[point]; });
  };
  const std::int64_t atZero = count(this->WithoutHeights.AtZero);
  const std::int64_t notFinite = count(this->WithoutHeights.NotFinite);
  const HeightWords words = ChooseWords(atZero > 0, notFinite > 0);
  std::string fate = words.Fate;
  fate += ", give them heights, for example those of the nearest points";
  if (this->AreLifted)
  {
    fate = "they have got the heights of the given points there; SegmentHeights Own ";
    fate += words.Kept;
  }
  std::vector<double> storage;
  const PointArray points = ViewPoints(this->Given, storage);
  const HeightRange heights(points, points.Count);
  constexpr int Digits = 6;
  Defect defect(DefectKind::PointsWithoutHeights, atZero + notFinite);
  defect.Detail = " (" + std::string(words.What) +
    "; the given points have z = " + FormatNumber(heights.Low, Digits) + " to " +
    FormatNumber(heights.High, Digits) + "): " + fate;
  return defect;
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
    lifted = this->WithoutHeights.List();
  }
  if (heights == HeightsKind::Survey || !this->Asked.WantsHeights)
  {
    this->WithoutHeights = {};
  }
  else if (heights == HeightsKind::Own)
  {
    this->WithoutHeights.AtZero.clear(); // nobody is told of what was asked for
  }
  this->TakeHeights(added, lifted);
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
  const bool areGiven = this->Given->GetPointData()->HasArray(name.c_str()) != 0;
  if (areGiven)
  {
    FindSizes(this->Given, name, given);
  }
  vtkDataArray* array = FindSizes(this->Points, name, count);
  const bool areReceived = this->Segments.Received.count(name) > 0;
  this->Sizes.assign(count, NAN);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool isKnown = i < given ? areGiven : areReceived;
    if (isKnown)
    {
      this->Sizes[i] = array->GetComponent(i, 0);
    }
  }
  if (!areReceived)
  {
    std::copy(this->SurveyedSizes.begin(), this->SurveyedSizes.end(), this->Sizes.begin() + given);
  }
  this->View.Sizes = this->Sizes.data();
}

void TriangulationRun::ReadRegions()
{
  this->Regions = ReadRegionSeeds(this->Asked.Regions);
  this->View.Regions = ViewValues(this->Regions);
  this->View.NumberOfRegions = static_cast<std::int64_t>(this->Regions.size());
}

/// The point data that points of the second input get from the given ones.
std::vector<SurveyedArray> TriangulationRun::ListSurveyed() const
{
  std::vector<SurveyedArray> surveyed;
  vtkPointData* data = this->Points->GetPointData();
  const vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i); // null if it has no numbers
    if (!array || !array->GetName() || std::count(std::begin(labels), std::end(labels), array) > 0)
    {
      continue;
    }
    const bool isReceived = this->Segments.Received.count(array->GetName()) > 0;
    const bool isWanted = !isReceived || this->Asked.HeightArray == array->GetName();
    if (isWanted && HasWholeArray(this->Given, array->GetName()))
    {
      surveyed.push_back({ array, 0, array->GetNumberOfComponents(), isReceived });
    }
  }
  return surveyed;
}

/// Gives points of the second input the data of the given points, and heights to those that are
/// lifted. Both are interpolated in the triangulation of the given points alone. Outside of it they
/// are those of the nearest place on its boundary. Without triangles nothing changes.
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
  const std::vector<SurveyedArray> arrays = this->ListSurveyed();
  if (lifted.empty() && arrays.empty())
  {
    return;
  }
  PointOptions options;
  options.Backend = this->Asked.Options.Backend;
  options.Device = this->Asked.Options.Device;
  options.NumberOfThreads = this->Asked.Options.NumberOfThreads;
  options.Projection = this->Asked.Options.Projection;
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
  for (const SurveyedArray& array : arrays)
  {
    this->AskSurvey(survey, array, points);
  }
  if (!lifted.empty())
  {
    this->AskSurvey(survey, { this->Points->GetPoints()->GetData(), 2, 1, false }, lifted);
    this->Points->GetPoints()->Modified();
  }
  this->AreLifted = !lifted.empty();
}

/// Writes numbers of points that are interpolated between those of the given points.
void TriangulationRun::AskSurvey(
  FlipSession& survey, const SurveyedArray& surveyed, const std::vector<std::int64_t>& points)
{
  vtkDataArray* const array = surveyed.Array;
  const auto width = static_cast<std::size_t>(surveyed.Count);
  std::vector<double> values(this->Given->GetNumberOfPoints() * width), places;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = array->GetComponent(
      static_cast<vtkIdType>(i / width), surveyed.First + static_cast<int>(i % width));
  }
  const int coordinates = IsOnSphere(this->Asked) ? 3 : 2;
  for (const std::int64_t point : points)
  {
    for (int k = 0; k < coordinates; ++k)
    {
      places.push_back(this->View.Points.Get(point, k));
    }
  }
  std::vector<double> results(points.size() * width);
  PlaceQuery query;
  query.Places = { places.data(), static_cast<std::int64_t>(points.size()), coordinates };
  query.Values = values.data();
  query.Components = surveyed.Count;
  query.Outside = OutsideKind::Nearest;
  query.Results = results.data();
  survey.Ask(query);
  const bool isWhole = surveyed.First == 0 && surveyed.Count == array->GetNumberOfComponents();
  if (isWhole && GetName(array) == this->Asked.SizeArray)
  {
    this->SurveyedSizes = results;
  }
  const bool isReal = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    const std::int64_t point = points[i / width];
    const int component = surveyed.First + static_cast<int>(i % width);
    const bool isKept =
      surveyed.OnlyUnknown && std::isfinite(array->GetComponent(point, component));
    if (isReal && !isKept)
    {
      array->SetComponent(point, component, results[i]);
    }
    else if (!isKept && std::isfinite(results[i]))
    {
      array->SetComponent(point, component, std::round(results[i]));
    }
  }
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
    const bool isProjected = this->Projected->GetNumberOfPoints() > 0;
    AppendAdded(this->Session->GetAddedPoints(), !isProjected, this->Points, output);
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
  FillTriangles(*this->Session, triangles, this->Asked.KeepsRun);
  output->SetPolys(triangles);
  if (this->Asked.PassesSegments)
  {
    this->Segments.StoreEdges(*this->Session, output);
  }
  if (!this->Regions.empty())
  {
    this->StoreRegions(output);
  }
  return true;
}

/// Stores the labels of the triangles; lines have none.
void TriangulationRun::StoreRegions(vtkPolyData* output) const
{
  vtkNew<vtkIntArray> labels;
  labels->SetName("Region");
  labels->SetNumberOfValues(output->GetNumberOfCells());
  labels->FillValue(0);
  this->Session->StoreRegions(labels->GetPointer(output->GetNumberOfLines()));
  output->GetCellData()->AddArray(labels);
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
  if (last && this->IsLive && last->Fits(*this))
  {
    last->Renew(*this);
    return true;
  }
  if (last && !last->MayBeFollowed(*this))
  {
    run.reset(); // its memory may be needed
    last = nullptr;
  }
  auto made = std::make_unique<TriangulationRun>(*this);
  if (last)
  {
    made->Follow(*last);
  }
  run = std::move(made);
  return false;
}

}
