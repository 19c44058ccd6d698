// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipInterpolator.h"

#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "MeshBlocks.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkAbstractTransform.h"
#include "vtkCharArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

using namespace delaunayflip;

static_assert(
  static_cast<int>(InterpolationKind::Natural) == vtkDelaunayFlipInterpolator::METHOD_NATURAL, "");

namespace
{

/// What the coordinates of places are.
enum class PlaceKind
{
  InPlane,
  Angles, ///< Longitudes and latitudes.
  Directions ///< From the center of a sphere.
};

/// The points of a dataset, as the engine takes them.
class Places
{
public:
  /// @param projection may be null.
  Places(vtkDataSet* places, vtkAbstractTransform* projection, PlaceKind kind)
    : Count(places->GetNumberOfPoints())
  {
    this->Query.Degrees = kind == PlaceKind::Angles;
    auto* image = vtkImageData::SafeDownCast(places);
    const bool mayBeRaster = !projection && kind != PlaceKind::Directions;
    if (image && mayBeRaster && this->SetRaster(image))
    {
      return;
    }
    vtkSmartPointer<vtkPoints> points;
    if (auto* set = vtkPointSet::SafeDownCast(places))
    {
      points = set->GetPoints();
    }
    else
    {
      points = ListPoints(places);
    }
    if (projection && points)
    {
      vtkNew<vtkPoints> projected;
      projected->SetDataTypeToDouble();
      projection->TransformPoints(points, projected);
      points = projected;
    }
    this->Mesh->SetPoints(points);
    this->Query.Places = ViewPlane(ViewPoints(this->Mesh, this->Storage));
  }

  vtkIdType Count;
  PlaceQuery Query; ///< Has the first of the places, after which they come again.

private:
  /// Takes a layer of an image as a raster, if that has the same coordinates.
  bool SetRaster(vtkImageData* image)
  {
    int extent[6], size[3];
    image->GetExtent(extent);
    image->GetDimensions(size);
    const bool isRounded = extent[0] != 0 || extent[2] != 0; // its coordinates in another way
    if (this->Count == 0 || isRounded || !image->GetDirectionMatrix()->IsIdentity())
    {
      return false;
    }
    PlaceRaster& raster = this->Query.Raster;
    std::copy_n(image->GetOrigin(), 2, raster.Origin);
    std::copy_n(image->GetSpacing(), 2, raster.Step);
    raster.Columns = size[0];
    raster.Rows = size[1];
    return true;
  }

  static vtkSmartPointer<vtkPoints> ListPoints(vtkDataSet* places)
  {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(places->GetNumberOfPoints());
    for (vtkIdType i = 0; i < places->GetNumberOfPoints(); ++i)
    {
      double x[3];
      places->GetPoint(i, x);
      points->SetPoint(i, x);
    }
    return points;
  }

  vtkNew<vtkPolyData> Mesh;
  std::vector<double> Storage; ///< Coordinates that cannot be viewed in place.
};

//------------------------------------------------------------------------------
/// Removes the point arrays of a source that cannot be interpolated.
/// @returns a note about those that may be missed; "" if there are none.
std::string RemoveOthers(vtkPolyData* source)
{
  vtkPointData* data = source->GetPointData();
  const vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  std::string names;
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const bool isLabel = std::count(std::begin(labels), std::end(labels), array) > 0;
    const bool isWhole = array->GetNumberOfTuples() >= source->GetNumberOfPoints();
    const bool isNumeric = vtkDataArray::SafeDownCast(array) != nullptr;
    if (!isLabel && (!isWhole || !isNumeric))
    {
      const std::string before = names.empty() ? "" : ", ";
      names = "\"" + GetName(array) + "\"" + before + names;
    }
    if (isLabel || !isWhole || !isNumeric)
    {
      data->RemoveArray(i);
    }
  }
  if (names.empty())
  {
    return "";
  }
  return "point arrays of the source left out, which have no numbers or too few tuples: " + names;
}

constexpr char MaskName[] = "vtkValidPointMask"; // as vtkProbeFilter calls it

/// The arrays that are interpolated: some of a mesh from points, and their z.
class Columns
{
public:
  /// @param arrays how many of the mesh's point arrays, the first ones.
  /// @param elevation the name of the array of z; "": none.
  Columns(vtkPolyData* mesh, int arrays, const std::string& elevation)
    : Mesh(mesh),
      HasElevation(!elevation.empty()),
      Width(static_cast<int>(HasElevation))
  {
    for (int i = 0; i < arrays; ++i)
    {
      this->Arrays.push_back(mesh->GetPointData()->GetArray(i));
      this->Width += this->Arrays.back()->GetNumberOfComponents();
    }
    SetName(elevation, this->Elevation);
  }

  /// The number of values that a point has.
  int GetWidth() const { return this->Width; }

  /// The values of all points, one point after the other.
  std::vector<double> Gather() const
  {
    const vtkIdType count = this->Mesh->GetNumberOfPoints();
    std::vector<double> values(count * this->Width);
    double* next = values.data();
    for (vtkIdType point = 0; point < count; ++point)
    {
      for (vtkDataArray* array : this->Arrays)
      {
        array->GetTuple(point, next);
        next += array->GetNumberOfComponents();
      }
      if (this->HasElevation)
      {
        *next++ = this->Mesh->GetPoints()->GetData()->GetComponent(point, 2);
      }
    }
    return values;
  }

  /// Writes the arrays. Those that they or the mask replace take their attributes along.
  /// @param values at places, which come again until there are `count`.
  void Scatter(const std::vector<double>& values, vtkIdType count, vtkPointData* output) const
  {
    const double* first = values.data();
    const auto places = static_cast<vtkIdType>(values.size()) / std::max(this->Width, 1);
    for (vtkDataArray* array : this->Arrays)
    {
      output->RemoveArray(array->GetName());
    }
    output->RemoveArray(this->Elevation->GetName());
    output->RemoveArray(MaskName);
    const auto add = [&](vtkDataArray* like, int attributes)
    {
      const auto array = MakeArray(like, count);
      for (vtkIdType i = 0; i < count; ++i)
      {
        array->SetTuple(i, first + i % places * this->Width);
      }
      first += like->GetNumberOfComponents();
      AddAttributes(output, output->AddArray(array), attributes);
    };
    for (vtkDataArray* array : this->Arrays)
    {
      add(array, FindAttributes(this->Mesh->GetPointData(), array));
    }
    if (this->HasElevation)
    {
      add(this->Elevation, 1 << vtkDataSetAttributes::SCALARS);
    }
  }

private:
  /// @param like has the name, the components and what else is known of them.
  static vtkSmartPointer<vtkDataArray> MakeArray(vtkDataArray* like, vtkIdType count)
  {
    const int type = FindPointType(like->GetDataType() == VTK_FLOAT);
    auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName(like->GetName());
    array->SetNumberOfComponents(like->GetNumberOfComponents());
    array->SetNumberOfTuples(count);
    array->CopyComponentNames(like);
    array->CopyInformation(like->GetInformation());
    array->SetLookupTable(like->GetLookupTable());
    return array;
  }

  vtkPolyData* Mesh;
  std::vector<vtkDataArray*> Arrays;
  bool HasElevation;
  vtkNew<vtkDoubleArray> Elevation; ///< Has only a name.
  int Width;
};

//------------------------------------------------------------------------------
/// Counts places that are in no triangle, or only those that are not finite, if there are any.
/// @param triangles those of the places, which come again until there are all.
/// @throws InvalidMesh if there are any.
void RequireInside(const Places& places, PlaceKind kind, const std::vector<std::int32_t>& triangles)
{
  const PlaneArray& given = places.Query.Places;
  const auto isFinite = [&given, kind](std::int64_t place)
  {
    if (place >= given.Count) // it is the cell of a raster
    {
      return true;
    }
    const bool isOnMap = std::isfinite(given.Get(place, 0)) && std::isfinite(given.Get(place, 1));
    return isOnMap && (kind != PlaceKind::Directions || std::isfinite(given.Get(place, 2)));
  };
  std::vector<vtkIdType> outside, unusable;
  for (vtkIdType i = 0; i < places.Count; ++i)
  {
    const auto place = static_cast<std::int64_t>(i % triangles.size());
    if (triangles[place] < 0)
    {
      outside.push_back(i);
    }
    if (triangles[place] < 0 && !isFinite(place))
    {
      unusable.push_back(i);
    }
  }
  if (outside.empty())
  {
    return;
  }
  const std::vector<vtkIdType>& told = unusable.empty() ? outside : unusable;
  const char* const what = unusable.empty() ? "outside of the triangulation" : "NaN or infinite";
  throw InvalidMesh(std::to_string(told.size()) + " of " + std::to_string(places.Count) +
      " places " + (told.size() == 1 ? "is " : "are ") + what +
      " (first: " + std::to_string(told.front()) + ")",
    -1, -1);
}

/// What is asked about every dataset of places.
struct Source
{
  const FlipSession* Session; ///< Null: there are no triangles.
  vtkSmartPointer<vtkAbstractTransform> Projection;
  PlaceKind Kind;
  const Columns& Arrays;
  std::vector<double> Values;
  InterpolationKind Method;
  int Outside; ///< A vtkDelaunayFlipInterpolator::OutsideType.

  /// Adds the arrays to a dataset, but none if the observer stops it.
  /// @returns whether it did not.
  bool Interpolate(vtkDataSet* dataset, const ProgressObserver& observer) const
  {
    Places places(dataset, this->Projection, this->Kind);
    PlaceQuery& query = places.Query;
    std::vector<std::int32_t> triangles(query.CountPlaces(), -1);
    std::vector<double> results(triangles.size() * this->Arrays.GetWidth(), NaN);
    query.Triangles = triangles.data();
    if (!results.empty())
    {
      query.Values = this->Values.data();
      query.Components = this->Arrays.GetWidth();
      query.Results = results.data();
    }
    query.Method = this->Method;
    if (this->Outside == vtkDelaunayFlipInterpolator::OUTSIDE_NEAREST)
    {
      query.Outside = OutsideKind::Nearest;
    }
    if (this->Session && !this->Session->Ask(query, observer))
    {
      return false;
    }
    if (this->Outside == vtkDelaunayFlipInterpolator::OUTSIDE_ERROR)
    {
      RequireInside(places, this->Kind, triangles);
    }
    vtkPointData* output = dataset->GetPointData();
    this->Arrays.Scatter(results, places.Count, output);
    AddMask(triangles, places.Count, output);
    return true;
  }

  static void AddMask(
    const std::vector<std::int32_t>& triangles, vtkIdType count, vtkPointData* output)
  {
    vtkNew<vtkCharArray> mask;
    mask->SetName(MaskName);
    mask->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      mask->SetValue(i, static_cast<char>(triangles[i % triangles.size()] >= 0));
    }
    output->AddArray(mask);
  }
};

/// The points with values for a block. May throw.
vtkSmartPointer<vtkPointSet> FindSource(
  const MeshBlock& block, const std::vector<MeshBlock>& sources)
{
  const auto found = ListOthers(block, sources, "the source of a single dataset", "vtkPointSet");
  if (found.empty())
  {
    throw InvalidMesh("the source has no points (vtkPointSet) at the same place", -1, -1);
  }
  if (found.size() > 1)
  {
    throw InvalidMesh("the source is in several partitions; join them first, by "
                      "vtkAppendDataSets, or Merge Blocks in ParaView",
      -1, -1);
  }
  return vtkPointSet::SafeDownCast(found.front().Data);
}

}

vtkStandardNewMacro(vtkDelaunayFlipInterpolator);

//------------------------------------------------------------------------------
vtkDelaunayFlipInterpolator::vtkDelaunayFlipInterpolator()
{
  this->SetNumberOfInputPorts(3);
  this->InputType = "vtkDataSet";
  this->KeepsType = true;
  this->HasSteps = false;
  this->SizeOfOthers = vtkDataObject::POINT;
  this->SegmentsPort = 2;
}

vtkDelaunayFlipInterpolator::~vtkDelaunayFlipInterpolator() = default;

vtkDataSet* vtkDelaunayFlipInterpolator::GetOutput()
{
  return vtkDataSet::SafeDownCast(this->GetOutputDataObject(0));
}

int vtkDelaunayFlipInterpolator::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { this->InputType, "vtkPointSet", "vtkPolyData" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  if (port == this->SegmentsPort)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

/// The places are asked for as the output is. All of the source is needed for any of them.
int vtkDelaunayFlipInterpolator::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  using Asked = vtkStreamingDemandDrivenPipeline;
  for (int port = 1; port < 3; ++port)
  {
    vtkInformation* info = inputVector[port]->GetInformationObject(0);
    if (!info)
    {
      continue;
    }
    info->Set(Asked::UPDATE_PIECE_NUMBER(), 0);
    info->Set(Asked::UPDATE_NUMBER_OF_PIECES(), 1);
    info->Set(Asked::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (info->Has(Asked::WHOLE_EXTENT())) // else the executive copies that of the places
    {
      info->Set(Asked::UPDATE_EXTENT(), info->Get(Asked::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
/// The blocks of the third input; none without it.
std::vector<MeshBlock> vtkDelaunayFlipInterpolator::ListSegments()
{
  vtkDataObject* third = this->GetInputDataObject(this->SegmentsPort, 0);
  return third ? ListOtherBlocks(Hold(third), vtkDataObject::CELL) : std::vector<MeshBlock>();
}

/// The run of a single block is kept. It has no steps.
std::vector<MeshBlock> vtkDelaunayFlipInterpolator::ListBlocks(
  vtkDataObject* input, const std::vector<MeshBlock>&, UpdateSummary& summary)
{
  std::vector<MeshBlock> blocks = ListMeshBlocks(input, this->SizeOfBlocks);
  for (MeshBlock& block : blocks)
  {
    block.IsLive = true;
  }
  summary.Warnings = ListMisfits(blocks, this->ListSegments(), "third input");
  return blocks;
}

void vtkDelaunayFlipInterpolator::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& sources, UpdateSummary& summary)
{
  std::vector<vtkDataSet*> datasets;
  for (BlockLeaf& leaf : block.Leaves)
  {
    leaf.Result = Hold(leaf.Data);
    if (auto* dataset = vtkDataSet::SafeDownCast(leaf.Result))
    {
      datasets.push_back(dataset);
      this->CheckPlaces(dataset, block.Name, summary);
    }
    else
    {
      summary.Warnings.push_back({ leaf.Name, "is no dataset, passed unchanged" });
    }
  }
  if (datasets.empty())
  {
    return;
  }
  const auto given = FindSource(block, sources);
  if (given->GetNumberOfPoints() == 0)
  {
    summary.Warnings.push_back({ block.Name, "the source has no points, so there are no values" });
  }
  const auto points = this->ReadPoints(given, block, summary);
  std::string elevation = this->ChooseArrays(points, block.Name, summary);
  const auto segments = this->FindSegments(block, this->ListSegments(), elevation, summary);
  TriangulationRequest request = this->MakeSourceRequest(given, points, segments);
  if (this->HasAngles() && !elevation.empty())
  {
    KeepHeights(given->GetPoints(), elevation, true, points->GetPointData());
    request.HeightArray = this->SegmentHeights == SEGMENT_HEIGHTS_AUTO ? elevation : "";
    elevation.clear();
  }
  request.WantsHeights = !elevation.empty();
  if (!request.WantsHeights && request.Heights == HeightsKind::Auto)
  {
    request.Heights = HeightsKind::Own;
  }
  const auto progress = request.Progress;
  constexpr double TriangulationShare = 0.5; // of the time
  request.Progress = MakePart(progress, 0.0, TriangulationShare);
  vtkNew<vtkPolyData> mesh;
  this->Runs->Update(request, *this->Report, mesh);
  this->HandleDefects();

  const FlipSession* session = this->Runs->GetSession();
  vtkSmartPointer<vtkAbstractTransform> projection;
  if (session)
  {
    const auto added = static_cast<vtkIdType>(session->GetAddedPoints().size());
    projection = FindProjection(request, mesh->GetPoints(), mesh->GetNumberOfPoints() - added);
  }
  const Columns columns(mesh, points->GetPointData()->GetNumberOfArrays(), elevation);
  const PlaceKind ofSphere = this->Degrees ? PlaceKind::Angles : PlaceKind::Directions;
  const PlaceKind kind = this->IsOnSphere() ? ofSphere : PlaceKind::InPlane;
  const Source source{ session, projection, kind, columns, columns.Gather(),
    static_cast<InterpolationKind>(this->Method), this->Outside };
  double begin = TriangulationShare;
  for (vtkDataSet* dataset : datasets)
  {
    const double end = begin + (1.0 - TriangulationShare) / static_cast<double>(datasets.size());
    if (this->Report->StopReason == StopReasonKind::Aborted ||
      !source.Interpolate(dataset, MakePart(progress, begin, end)))
    {
      this->Report->StopReason = StopReasonKind::Aborted;
    }
    begin = end;
  }
}

/// @param points those of the source.
TriangulationRequest vtkDelaunayFlipInterpolator::MakeSourceRequest(
  vtkPointSet* source, vtkPolyData* points, vtkPolyData* segments)
{
  TriangulationRequest request = this->MakeRequest(source);
  const auto findTime = [this](int port) // the copies in blocks are new in every update
  {
    auto* input = vtkDataSet::SafeDownCast(this->GetInputDataObject(port, 0));
    return input ? input->GetMTime() : 0;
  };
  request.Input = points;
  request.InputTime = findTime(1);
  request.Others = segments;
  request.OthersTime = findTime(this->SegmentsPort);
  request.PassesSegments = false; // an array of numbers of segments is nothing to interpolate
  request.ConvertsToDoubles = true;
  request.IsLive = true; // keeps the run
  request.IterationsPerUpdate = -1;
  return request;
}

/// Warns of points that are at no longitude and latitude.
void vtkDelaunayFlipInterpolator::CheckPlaces(
  vtkDataSet* places, const std::string& where, UpdateSummary& summary) const
{
  auto* set = vtkPointSet::SafeDownCast(places);
  const bool hasAngles = this->IsOnSphere() && this->Degrees && set && set->GetPoints();
  if (hasAngles)
  {
    WarnOfLatitudes(set->GetPoints(), "", where, summary);
  }
}

/// Removes what is not interpolated from points of the source. @returns the name of the array of z.
std::string vtkDelaunayFlipInterpolator::ChooseArrays(
  vtkPolyData* points, const std::string& where, UpdateSummary& summary) const
{
  const std::string note = RemoveOthers(points);
  if (!note.empty())
  {
    summary.Warnings.push_back({ where, note });
  }
  if (this->IsOnSphere() && !this->Degrees)
  {
    return ""; // z is one of three coordinates
  }
  const bool isTaken = points->GetPointData()->HasArray(this->ElevationArray.c_str()) != 0;
  if (!isTaken)
  {
    return this->ElevationArray;
  }
  summary.Warnings.push_back({ where,
    "z of the source left out, because the source has an array \"" + this->ElevationArray +
      "\"; give ElevationArray another name" });
  return "";
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipInterpolator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Outside: " << this->Outside << "\n";
  os << indent << "ElevationArray: " << this->ElevationArray << "\n";
}
