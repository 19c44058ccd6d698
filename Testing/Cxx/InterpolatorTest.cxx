// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// vtkDelaunayFlipInterpolator: from the data of points to those of places.

#include "FilterTestSupport.h"

#include "DelaunayFlip.h"
#include "PointTriangulation.h"

#include "vtkDataArray.h"
#include "vtkDelaunayFlipInterpolator.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace
{

using Interpolator = Watched<vtkDelaunayFlipInterpolator>;

/// Some linear functions of a place.
double GetHeight(const double* x) { return 2.0 * x[0] - 3.0 * x[1] + 1.0; }
double GetOther(const double* x) { return 7.0 - 0.5 * x[0] - 0.25 * x[1]; }

/// Points in a square from 0 to 10, and more of them on its border than inside. z is a height.
Mesh MakeSource()
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(0.0, 10.0);
  Points points = { { 0, 0, 0 }, { 10, 0, 0 }, { 10, 10, 0 }, { 0, 10, 0 } };
  for (int i = 0; i < 400; ++i)
  {
    points.push_back({ draw(random), draw(random), 0.0 });
  }
  for (auto& point : points)
  {
    point[2] = GetHeight(point.data());
  }
  return MakeMesh(points, {});
}

/// Places in a square that is half a unit larger.
Mesh MakePlaces(int count = 500)
{
  std::mt19937 random(6);
  std::uniform_real_distribution<double> draw(-0.5, 10.5);
  Points places(count);
  for (auto& place : places)
  {
    place = { draw(random), draw(random), 99.0 };
  }
  return MakeMesh(places, {});
}

vtkSmartPointer<vtkImageData> MakeImage()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(21, 17, 2);
  image->SetOrigin(-0.3, 0.1, 4.0);
  image->SetSpacing(0.53, 0.61, 1.0);
  return image;
}

/// The points of any dataset.
Mesh ListPoints(vtkDataSet* dataset)
{
  Points points(dataset->GetNumberOfPoints());
  for (vtkIdType i = 0; i < dataset->GetNumberOfPoints(); ++i)
  {
    dataset->GetPoint(i, points[i].data());
  }
  return MakeMesh(points, {});
}

bool IsInSquare(const double* x) { return x[0] >= 0 && x[1] >= 0 && x[0] <= 10 && x[1] <= 10; }

/// Updates a filter that must have neither an error nor a warning. @returns the point data.
vtkPointData* Update(Interpolator& filter)
{
  filter->Update();
  EXPECT_EQ(filter.GetErrors(), std::vector<std::string>());
  EXPECT_EQ(filter.GetWarnings(), std::vector<std::string>());
  return filter->GetOutput()->GetPointData();
}

/// All components of an array; NaN becomes -1000.
std::vector<double> GetValues(vtkPointData* data, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = data->GetArray(name);
  EXPECT_NE(array, nullptr) << name;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      const double value = array->GetComponent(i, k);
      values.push_back(std::isnan(value) ? -1000.0 : value);
    }
  }
  return values;
}

}

TEST(Interpolator, LinearFunctionsOfAllTypes)
{
  const auto source = MakeSource();
  const vtkIdType count = source->GetNumberOfPoints();
  const auto floats = MakeArray<vtkFloatArray>("floats", count, 2);
  floats->SetComponentName(1, "other");
  const auto integers = MakeArray<vtkIntArray>("integers", count);
  const auto texts = MakeArray<vtkStringArray>("texts", count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    source->GetPoint(i, x);
    floats->SetTuple2(i, GetHeight(x), GetOther(x));
    integers->SetValue(i, static_cast<int>(i % 2));
  }
  vtkPointData* given = source->GetPointData();
  given->SetScalars(floats);
  given->AddArray(integers);
  given->AddArray(texts);
  AddNumbers(given, "ids", count, 0);
  given->SetActiveGlobalIds("ids");
  const auto places = MakePlaces();
  AddNumbers(places->GetPointData(), "kept", places->GetNumberOfPoints(), 0);
  for (const int method : { 0, 1 })
  {
    Interpolator filter(places);
    filter->SetSourceData(source);
    filter->SetMethod(method);
    filter->Update();
    ASSERT_EQ(filter.GetWarnings().size(), 1u);
    ExpectHolds(filter.GetWarnings()[0],
      "point arrays of the source left out, which have no numbers or too few tuples: \"texts\"");
    vtkPointData* data = filter->GetOutput()->GetPointData();
    EXPECT_EQ(data->GetNumberOfArrays(), 5);
    EXPECT_EQ(data->GetScalars(), data->GetArray("floats"));
    EXPECT_EQ(data->GetScalars()->GetDataType(), VTK_FLOAT);
    EXPECT_STREQ(data->GetScalars()->GetComponentName(1), "other");
    EXPECT_EQ(data->GetArray("integers")->GetDataType(), VTK_DOUBLE);
    EXPECT_EQ(data->GetArray("kept"), places->GetPointData()->GetArray("kept"));
    int fractions = 0;
    for (vtkIdType i = 0; i < places->GetNumberOfPoints(); ++i)
    {
      double x[3];
      places->GetPoint(i, x);
      EXPECT_EQ(data->GetArray("vtkValidPointMask")->GetTuple1(i), IsInSquare(x));
      if (!IsInSquare(x))
      {
        EXPECT_TRUE(std::isnan(data->GetArray("Elevation")->GetTuple1(i)));
        continue;
      }
      EXPECT_NEAR(data->GetArray("Elevation")->GetTuple1(i), GetHeight(x), 1e-12);
      EXPECT_NEAR(data->GetArray("floats")->GetComponent(i, 1), GetOther(x), 1e-5);
      const double between = data->GetArray("integers")->GetTuple1(i);
      fractions += static_cast<int>(between > 0.01 && between < 0.99);
    }
    EXPECT_GT(fractions, 200);
  }
}

TEST(Interpolator, ImagesAndGridsAreTheirPoints)
{
  const auto image = MakeImage();
  const auto shifted = MakeImage();
  shifted->SetExtent(3, 23, -2, 14, 0, 1);
  const auto turned = MakeImage();
  turned->SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1);
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(3, 2, 1);
  const auto xs = MakeArray<vtkDoubleArray>("x", 3), ys = MakeArray<vtkDoubleArray>("y", 2);
  xs->SetVariantValue(0, 1.0);
  xs->SetVariantValue(1, 2.5);
  xs->SetVariantValue(2, 11.0);
  ys->SetVariantValue(0, 3.0);
  ys->SetVariantValue(1, 9.0);
  grid->SetXCoordinates(xs);
  grid->SetYCoordinates(ys);
  const auto source = MakeSource();
  MovePoints(source, [](double* x) { x[2] = std::sin(x[0]) * x[1]; });
  const std::vector<vtkDataSet*> all = { image, shifted, turned, grid };
  for (vtkDataSet* dataset : all)
  {
    for (const int choice : { 0, 1 })
    {
      Interpolator filter(dataset), expected(ListPoints(dataset));
      for (Interpolator* each : { &filter, &expected })
      {
        (*each)->SetSourceData(source);
        (*each)->SetMethod(choice);
        (*each)->SetOutside(choice);
        Update(*each);
      }
      EXPECT_STREQ(filter->GetOutput()->GetClassName(), dataset->GetClassName());
      vtkPointData* data = filter->GetOutput()->GetPointData();
      vtkPointData* others = expected->GetOutput()->GetPointData();
      EXPECT_EQ(data->GetScalars(), data->GetArray("Elevation"));
      const std::vector<double> heights = GetValues(data, "Elevation");
      EXPECT_EQ(heights, GetValues(others, "Elevation"));
      EXPECT_EQ(GetValues(data, "vtkValidPointMask"), GetValues(others, "vtkValidPointMask"));
      EXPECT_EQ(std::count(heights.begin(), heights.end(), -1000.0) == 0, choice == 1);
    }
  }
}

TEST(Interpolator, SegmentsAndProjections)
{
  const auto source = MakeSource(), places = MakePlaces();
  Interpolator filter(places);
  filter->SetSourceData(source);
  filter->SetSegmentsData(
    MakeMesh({ { 2, 2, -1 }, { 8, 2, -19 + 30 }, { 8, 8, -7 }, { 2, 8, 0 } }, { { 0, 1, 2, 3 } }));
  vtkPointData* data = Update(filter);
  for (vtkIdType i = 0; i < places->GetNumberOfPoints(); ++i)
  {
    double x[3];
    places->GetPoint(i, x);
    const bool isInside = x[0] >= 2 && x[1] >= 2 && x[0] <= 8 && x[1] <= 8;
    EXPECT_EQ(data->GetArray("vtkValidPointMask")->GetTuple1(i), isInside);
  }
  // Points that only a breakline has get the data of the source.
  const auto marked = MakeSource();
  const auto ones = MakeArray<vtkDoubleArray>("ones", marked->GetNumberOfPoints());
  ones->FillValue(1.0);
  marked->GetPointData()->AddArray(ones);
  Interpolator broken(places);
  broken->SetSourceData(marked);
  broken->SetSegmentsData(MakeLines({ { 1, 1, 80 }, { 9, 7, 90 } }, { { 0, 1 } }));
  broken->SetOutsideToNearest();
  for (const double value : GetValues(Update(broken), "ones"))
  {
    EXPECT_NEAR(value, 1.0, 1e-12);
  }
  // An array of the same name keeps its values, as numbers of the source's type.
  const auto others = MakeLines({ { 1, 1, 80 }, { 9, 7, 90 } }, { { 0, 1 } });
  const auto singles = MakeArray<vtkFloatArray>("ones", 2);
  singles->FillValue(3.0);
  others->GetPointData()->AddArray(singles);
  broken->SetSegmentsData(others);
  broken->SetInputDataObject(MakeMesh({ { 1, 1, 0 }, { 9, 7, 0 } }, {}));
  EXPECT_EQ(GetValues(Update(broken), "ones"), (std::vector<double>{ 3.0, 3.0 }));
  // The plane of x and y stands upright, and so do the places.
  const std::vector<double> flat = [&]()
  {
    Interpolator plain(places);
    plain->SetSourceData(source);
    return GetValues(Update(plain), "Elevation");
  }();
  const auto heights = MakeArray<vtkDoubleArray>("heights", source->GetNumberOfPoints());
  heights->CopyComponent(0, source->GetPoints()->GetData(), 2);
  source->GetPointData()->AddArray(heights);
  const auto turn = [](double* x)
  {
    x[2] = x[0];
    x[0] = 5.0;
  };
  MovePoints(source, turn);
  MovePoints(places, turn);
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(
    std::array<double, 16>{ 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1 }.data());
  Interpolator moved(places), fitted(places);
  moved->SetSourceData(source);
  moved->SetTransform(transform);
  EXPECT_EQ(GetValues(Update(moved), "heights"), flat);
  fitted->SetSourceData(source);
  fitted->SetProjectionToBestFittingPlane();
  const std::vector<double> found = GetValues(Update(fitted), "heights");
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    EXPECT_NEAR(found[i], flat[i], 1e-9);
  }
}

/// The points that refinement adds have values, too.
TEST(Interpolator, RefinementAndRegions)
{
  using Change = std::function<void(vtkDelaunayFlipInterpolator*)>;
  const std::vector<Change> changes = { [](auto* filter) { filter->SetMaximumArea(0.05); },
    [](auto* filter) { filter->SetMinimumAngle(25.0); },
    [](auto* filter) { filter->AddRegion(5.0, 5.0, 3.0, 0.0); },
    [](auto* filter) { filter->AddRegion(5.0, 5.0, 3.0, 0.05); } };
  const auto source = MakeSource(), places = MakePlaces();
  const auto others = MakeArray<vtkIntArray>("integers", source->GetNumberOfPoints());
  others->FillValue(4);
  source->GetPointData()->AddArray(others);
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    Interpolator filter(places);
    filter->SetSourceData(source);
    changes[i](filter.Get());
    vtkPointData* data = Update(filter);
    EXPECT_EQ(filter->GetReport().Points > source->GetNumberOfPoints(), i != 2);
    for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
    {
      double x[3];
      places->GetPoint(k, x);
      ASSERT_EQ(data->GetArray("vtkValidPointMask")->GetTuple1(k), IsInSquare(x));
      if (IsInSquare(x))
      {
        EXPECT_NEAR(data->GetArray("Elevation")->GetTuple1(k), GetHeight(x), 1e-12);
        EXPECT_NEAR(data->GetArray("integers")->GetTuple1(k), 4.0, 1e-12);
      }
    }
  }
}

/// Longitudes and latitudes give the values of the directions that they are.
TEST(Interpolator, OnASphere)
{
  Points angles, directions;
  for (int i = 0; i < 200; ++i)
  {
    const double longitude = std::fmod(137.5 * i, 360.0) - 180.0, latitude = 0.89 * i - 89.0;
    angles.push_back({ longitude, latitude, std::cos(0.05 * latitude) });
    directions.emplace_back();
    delaunayflip::PlaceOnSphere(longitude, latitude, directions.back().data());
  }
  const auto source = MakeMesh(angles, {}), turned = MakeMesh(directions, {});
  const auto heights = MakeArray<vtkDoubleArray>("heights", 200);
  heights->CopyComponent(0, source->GetPoints()->GetData(), 2);
  turned->GetPointData()->AddArray(heights);
  vtkNew<vtkImageData> map;
  map->SetDimensions(37, 19, 1);
  map->SetOrigin(-180.0, -90.0, 0.0);
  map->SetSpacing(10.0, 10.0, 1.0);
  Points places;
  for (vtkIdType i = 0; i < map->GetNumberOfPoints(); ++i)
  {
    double angle[3];
    map->GetPoint(i, angle);
    places.emplace_back();
    delaunayflip::PlaceOnSphere(angle[0], angle[1], places.back().data());
  }
  for (const int method : { 0, 1 })
  {
    Interpolator onMap(map), onSphere(MakeMesh(places, {}));
    onMap->SetSourceData(source);
    onMap->SetProjectionToSphere();
    onMap->DegreesOn();
    onMap->SetMethod(method);
    onSphere->SetSourceData(turned);
    onSphere->SetProjectionToOpenSphere();
    onSphere->SetMethod(method);
    const std::vector<double> found = GetValues(Update(onMap), "Elevation");
    vtkPointData* data = Update(onSphere);
    EXPECT_EQ(found, GetValues(data, "heights"));
    EXPECT_EQ(nullptr, data->GetArray("Elevation"));
    EXPECT_EQ(std::vector<double>(found.size(), 1.0), GetValues(data, "vtkValidPointMask"));
    EXPECT_EQ(found.front(), found[36]); // at a pole, whatever the longitude
    EXPECT_LE(*std::max_element(found.begin(), found.end()), method == 0 ? 1.0 : 1.001);
  }
}

/// Integers that are linear between points stay so at points that a breakline and crossings add.
TEST(Interpolator, IntegersAreNotRoundedAtBreaklines)
{
  const auto source = MakeMesh({ { 0, 0, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, { 10, 10, 0 } }, {});
  const auto classes = MakeArray<vtkUnsignedCharArray>("classes", 4);
  for (vtkIdType i = 0; i < 4; ++i)
  {
    classes->SetValue(i, static_cast<unsigned char>(i % 2));
  }
  source->GetPointData()->SetScalars(classes);
  const auto places = MakePlaces();
  Interpolator filter(places);
  filter->SetSourceData(source);
  filter->SplitCrossingsOn();
  filter->SetSegmentsData(
    MakeLines({ { 2.5, 2, 0 }, { 2.5, 8, 0 }, { 1, 4, 0 }, { 9, 6, 0 } }, { { 0, 1 }, { 2, 3 } }));
  vtkPointData* data = Update(filter);
  EXPECT_EQ(data->GetScalars(), data->GetArray("classes"));
  for (vtkIdType i = 0; i < places->GetNumberOfPoints(); ++i)
  {
    double x[3];
    places->GetPoint(i, x);
    if (data->GetArray("vtkValidPointMask")->GetTuple1(i) > 0.0)
    {
      EXPECT_NEAR(data->GetArray("classes")->GetTuple1(i), x[0] / 10.0, 1e-12);
    }
  }
}

/// An array that is replaced was an attribute for what it held.
TEST(Interpolator, ReplacedArraysAreNoAttributesAnyMore)
{
  const auto source = MakeSource();
  AddNumbers(source->GetPointData(), "ids", source->GetNumberOfPoints(), 0);
  AddNumbers(source->GetPointData(), "scalars", source->GetNumberOfPoints(), 0);
  source->GetPointData()->SetActiveScalars("scalars");
  const auto places = MakePlaces();
  const vtkIdType count = places->GetNumberOfPoints();
  vtkPointData* given = places->GetPointData();
  given->SetGlobalIds(MakeArray<vtkIdTypeArray>("ids", count));
  given->SetScalars(MakeArray<vtkIntArray>("vtkValidPointMask", count));
  given->SetNormals(MakeArray<vtkFloatArray>("Elevation", count, 3));
  Interpolator filter(places);
  filter->SetSourceData(source);
  vtkPointData* data = Update(filter);
  EXPECT_EQ(data->GetNumberOfArrays(), 4);
  EXPECT_EQ(data->GetGlobalIds(), nullptr);
  EXPECT_EQ(data->GetNormals(), nullptr);
  EXPECT_EQ(data->GetScalars(), data->GetArray("scalars"));
  EXPECT_EQ(given->GetGlobalIds(), given->GetArray("ids"));
}

TEST(Interpolator, OnlyWhatHasChangedIsMadeAgain)
{
  const auto source = MakeSource(), places = MakePlaces();
  Interpolator filter(places);
  filter->SetSourceData(source);
  const std::vector<double> before = GetValues(Update(filter), "Elevation");
  const auto* session = filter->GetSession();
  ASSERT_NE(session, nullptr);
  const auto others = MakeImage();
  filter->SetInputDataObject(others);
  EXPECT_EQ(GetValues(Update(filter), "Elevation").size(), 21u * 17 * 2);
  EXPECT_EQ(filter->GetSession(), session);
  filter->SetInputDataObject(places);
  MovePoints(source, [](double* x) { x[2] += 1.0; });
  const std::vector<double> after = GetValues(Update(filter), "Elevation");
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_NEAR(after[i], before[i] + (before[i] > -1000.0 ? 1.0 : 0.0), 1e-12);
  }
  const auto* last = filter->GetSession();
  MovePoints(places, [](double* x) { x[0] = x[1] = 5.0; });
  EXPECT_NEAR(GetValues(Update(filter), "Elevation").back(), -3.0, 1e-12);
  EXPECT_EQ(filter->GetSession(), last);
  filter->SetPointTolerance(0.5);
  RunToWarning(filter);
  EXPECT_GT(filter->GetReport().FromPoints.TooNear, 0);
}

/// Values are changed in place, and something of the dataset is marked as modified.
TEST(Interpolator, MarkedDatasetsAreReadAgain)
{
  const auto source = MakeSource();
  const auto lines = MakeLines({ { 1, 5, 100 }, { 9, 5, 100 } }, { { 0, 1 } });
  const auto values = MakeArray<vtkIntArray>("values", source->GetNumberOfPoints());
  source->GetPointData()->AddArray(values);
  Interpolator filter(MakeMesh({ { 4, 5, 0 } }, {}));
  filter->SetSourceData(source);
  filter->SetSegmentsData(lines);
  int value = 1;
  const std::vector<vtkObject*> marks = { values, source->GetPointData(), source };
  for (vtkObject* mark : marks)
  {
    values->FillValue(++value);
    mark->Modified();
    EXPECT_NEAR(Update(filter)->GetArray("values")->GetTuple1(0), value, 1e-12);
  }
  const std::vector<vtkObject*> ends = { lines->GetPoints()->GetData(), lines->GetPoints(), lines };
  for (vtkObject* mark : ends)
  {
    const double height = 100.0 * ++value;
    lines->GetPoints()->GetData()->SetTuple3(0, 1.0, 5.0, height);
    lines->GetPoints()->GetData()->SetTuple3(1, 9.0, 5.0, height);
    mark->Modified();
    EXPECT_NEAR(Update(filter)->GetArray("Elevation")->GetTuple1(0), height, 1e-9);
  }
  const auto* session = filter->GetSession();
  filter->Modified();
  Update(filter);
  EXPECT_EQ(filter->GetSession(), session);

  // Datasets may have the same time, that of what they share.
  const auto others = MakeArray<vtkIntArray>("values", source->GetNumberOfPoints());
  others->FillValue(++value);
  vtkNew<vtkPolyData> twin;
  twin->SetPoints(source->GetPoints());
  twin->GetPointData()->AddArray(others);
  source->GetPoints()->Modified();
  Update(filter);
  ASSERT_EQ(twin->GetMTime(), source->GetMTime());
  filter->SetSourceData(twin);
  EXPECT_NEAR(Update(filter)->GetArray("values")->GetTuple1(0), value, 1e-12);
}

TEST(Interpolator, Abort)
{
  for (const double when : { 0.01, 0.6 })
  {
    Interpolator filter(MakePlaces(3000000));
    filter->SetSourceData(MakeSource());
    filter->SetNumberOfThreads(1);
    bool isAsked = true;
    OnProgress(filter.Get(),
      [&]()
      {
        if (isAsked && filter->GetProgress() >= when)
        {
          filter->AbortExecuteOn();
        }
      });
    filter->Update();
    EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 3000000);
    EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    isAsked = false;
    filter->Modified();
    EXPECT_EQ(Update(filter)->GetNumberOfArrays(), 2);
    EXPECT_TRUE(filter->GetConverged());
  }
}

TEST(Interpolator, NothingToInterpolate)
{
  vtkNew<vtkPolyData> nothing;
  Interpolator nowhere(nothing);
  nowhere->SetSourceData(MakeSource());
  EXPECT_EQ(Update(nowhere)->GetArray("Elevation")->GetNumberOfTuples(), 0);
  Interpolator empty(MakeImage());
  empty->SetSourceData(nothing);
  empty->Update();
  EXPECT_EQ(GetValues(empty->GetOutput()->GetPointData(), "vtkValidPointMask"),
    std::vector<double>(21 * 17 * 2));
  ASSERT_EQ(empty.GetWarnings().size(), 1u);
  EXPECT_NE(empty.GetWarnings()[0].find("source has no points"), std::string::npos);
  const auto line = MakeMesh({ { 0, 0, 1 }, { 1, 1, 2 }, { 2, 2, 3 } }, {});
  Interpolator collinear(MakePlaces());
  collinear->SetSourceData(line);
  collinear->SetElevationArray("");
  ExpectHolds(RunToWarning(collinear), "3 points without a triangle");
  vtkPointData* data = collinear->GetOutput()->GetPointData();
  EXPECT_EQ(data->GetNumberOfArrays(), 1);
  const auto source = MakeSource();
  AddNumbers(source->GetPointData(), "Elevation", source->GetNumberOfPoints(), 0);
  Interpolator taken(MakePlaces());
  taken->SetSourceData(source);
  ExpectHolds(RunToWarning(taken), "give ElevationArray another name");
}

TEST(Interpolator, WrongInputs)
{
  Interpolator alone(MakePlaces());
  alone->Update();
  ExpectHolds(alone->GetErrorMessage(), "there is no second input");
  Interpolator image(MakePlaces());
  image->SetSourceData(MakeImage());
  image->Update();
  ExpectHolds(image->GetErrorMessage(),
    "the second input is a vtkImageData; it must be a vtkPointSet or vtkCompositeDataSet");
  Interpolator unfinished(MakeImage());
  unfinished->SetSourceData(MakeSource());
  unfinished->SetMaximumIterations(0);
  unfinished->SetMethodToNatural();
  unfinished->Update();
  EXPECT_EQ(unfinished->GetFailure(), vtkDelaunayFlip::FAILURE_OPTIONS);
  ExpectHolds(unfinished->GetErrorMessage(), "natural neighbors need a Delaunay triangulation");
  EXPECT_EQ(unfinished->GetOutput()->GetNumberOfPoints(), 0);
  unfinished->SetMaximumIterations(-1);
  unfinished->Update();
  EXPECT_EQ(unfinished->GetOutput()->GetNumberOfPoints(), 21 * 17 * 2);
  const auto places = MakePlaces();
  const auto mixed = MakeMesh({ { 1, 1, 9 }, { 5, 6, 9 } }, {});
  Interpolator strict(mixed);
  strict->SetSourceData(MakeSource());
  strict->SetOutsideToError();
  EXPECT_EQ(Update(strict)->GetArray("vtkValidPointMask")->GetRange()[0], 1.0);
  MovePoints(mixed, [](double* x) { x[0] *= 3.0; });
  strict->Update();
  EXPECT_EQ(strict->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
  ExpectHolds(
    strict->GetErrorMessage(), "1 of 2 places is outside of the triangulation (first: 1)");
  EXPECT_EQ(strict->GetOutput()->GetNumberOfPoints(), 0);
  Interpolator composite(places);
  composite->SetSourceData(MakeBlocks({ MakeSource() }));
  composite->Update();
  ExpectHolds(
    composite->GetErrorMessage(), "the source of a single dataset cannot be a composite dataset");
}

TEST(Interpolator, Blocks)
{
  const auto source = MakeSource(), places = MakePlaces();
  const auto image = MakeImage();
  vtkNew<vtkTable> table;
  const auto getBlock = [](Interpolator& filter, unsigned int number)
  {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    return vtkDataSet::SafeDownCast(blocks->GetBlock(number));
  };
  Interpolator shared(MakeBlocks({ places, table, image }));
  shared->SetSourceData(source);
  shared->Update();
  ASSERT_EQ(shared.GetWarnings().size(), 1u);
  ExpectHolds(shared.GetWarnings()[0], "block 2: is no dataset, passed unchanged");
  shared->LiveUpdateOn(); // which has no effect
  shared->Update();
  ASSERT_EQ(shared.GetWarnings().size(), 2u);
  EXPECT_EQ(shared.GetWarnings()[1], shared.GetWarnings()[0]);
  Interpolator alone(image);
  alone->SetSourceData(source);
  const auto expected = GetValues(Update(alone), "Elevation");
  EXPECT_EQ(GetValues(getBlock(shared, 2)->GetPointData(), "Elevation"), expected);
  EXPECT_STREQ(getBlock(shared, 2)->GetClassName(), "vtkImageData");

  // A source for each block, of points without cells; one of them is missing.
  vtkNew<vtkPolyData> flat;
  flat->DeepCopy(source);
  MovePoints(flat, [](double* x) { x[2] = 4.0; });
  Interpolator each(MakeBlocks({ image, image, image }));
  each->SetSourceData(MakeBlocks({ source, flat, table }));
  each->Update();
  EXPECT_EQ(GetValues(getBlock(each, 0)->GetPointData(), "Elevation"), expected);
  EXPECT_EQ(GetValues(getBlock(each, 1)->GetPointData(), "Elevation")[10], 4.0);
  ExpectHolds(
    each->GetErrorMessage(), "block 3: the source has no points (vtkPointSet) at the same place");
  EXPECT_EQ(getBlock(each, 2)->GetNumberOfPoints(), 0);

  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(0, source);
  parts->SetPartition(1, flat);
  Interpolator partitioned(MakeBlocks({ image }));
  partitioned->SetSourceData(parts);
  partitioned->Update();
  ExpectHolds(partitioned->GetErrorMessage(), "block 1: the source is in several partitions");
}
