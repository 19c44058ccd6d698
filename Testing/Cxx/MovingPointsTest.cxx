// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Points that move between updates, of vtkDelaunayFlipPoints and of meshes.

#include "FilterTestSupport.h"

#include "DelaunayFlip.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDelaunayFlipInterpolator.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using PointsFilter = Watched<vtkDelaunayFlipPoints>;

constexpr int Count = 2000;

/// Points at random in a square of 10 x 10, about 0.22 apart, with point data. Each time they are
/// other points.
Mesh MakeCloud(int count = Count)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(0.0, 10.0);
  Points points(count);
  for (auto& point : points)
  {
    point = { draw(random), draw(random), 0.1 * draw(random) };
  }
  auto cloud = MakeMesh(points, {});
  AddNumbers(cloud->GetPointData(), "n", count, 5);
  return cloud;
}

/// Moves every point in its own direction, by up to this much.
void Shake(vtkPolyData* cloud, double size)
{
  int i = 0;
  MovePoints(cloud,
    [&](double* x)
    {
      x[0] += size * std::sin(12.3 * i);
      x[1] += size * std::cos(45.6 * i);
      ++i;
    });
}

/// That two arrays have the same values of the same type.
void ExpectSame(vtkAbstractArray* expected, vtkAbstractArray* actual)
{
  ASSERT_TRUE(expected && actual);
  ASSERT_EQ(expected->GetDataType(), actual->GetDataType());
  ASSERT_EQ(expected->GetNumberOfValues(), actual->GetNumberOfValues());
  for (vtkIdType i = 0; i < expected->GetNumberOfValues(); ++i)
  {
    const vtkVariant value = expected->GetVariantValue(i);
    const bool areNan =
      std::isnan(value.ToDouble()) && std::isnan(actual->GetVariantValue(i).ToDouble());
    ASSERT_TRUE(areNan || value == actual->GetVariantValue(i)) << expected->GetName() << ' ' << i;
  }
}

/// Whether a result tells of iterations and flips, which differ between the ways.
bool TellsTheWay(const std::string& name)
{
  static const std::set<std::string> names = { "Iteration", "Tested", "NonDelaunay", "Flipped",
    "Excluded", "Blocked", "MinimumAngle", "Seconds", "TotalFlips", "ConstraintFlips",
    "MoveRounds" };
  const std::string prefix = "DelaunayFlip:";
  return name.rfind(prefix, 0) == 0 && names.count(name.substr(prefix.size())) > 0;
}

/// Updates a filter, and compares its output with that of a new one.
/// @returns the rounds that the points have taken to their places.
double Update(PointsFilter& filter, const std::function<void(PointsFilter&)>& set = {})
{
  const std::size_t warnings = filter.GetWarnings().size();
  vtkPolyData* actual = filter.Run();
  PointsFilter fresh(filter->GetInput());
  fresh->SetKeepSessionToOn();
  if (set)
  {
    set(fresh);
  }
  vtkPolyData* expected = fresh.Run();
  EXPECT_EQ(fresh.GetWarnings().size(), filter.GetWarnings().size() - warnings);
  const bool arePassed = fresh->GetNumberOfInputConnections(1) == 0;
  EXPECT_EQ(expected->GetPoints() == actual->GetPoints(), arePassed);
  ExpectSame(expected->GetPoints()->GetData(), actual->GetPoints()->GetData());
  EXPECT_EQ(GetTotal(expected, "MoveRounds"), 0.0);
  ExpectSame(
    expected->GetPolys()->GetConnectivityArray(), actual->GetPolys()->GetConnectivityArray());
  ExpectSame(expected->GetPolys()->GetOffsetsArray(), actual->GetPolys()->GetOffsetsArray());
  EXPECT_EQ(GetCells(expected->GetLines()), GetCells(actual->GetLines()));
  ExpectSame(expected->GetPointData()->GetArray("n"), actual->GetPointData()->GetArray("n"));
  vtkFieldData* fields = expected->GetFieldData();
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    const char* name = fields->GetArrayName(i);
    if (!TellsTheWay(name))
    {
      ExpectSame(fields->GetAbstractArray(i), actual->GetFieldData()->GetAbstractArray(name));
    }
  }
  return GetTotal(actual, "MoveRounds");
}

/// Points or a mesh for three time steps. Each time they are other objects.
class MovingSource : public vtkPolyDataAlgorithm
{
public:
  static MovingSource* New() { VTK_STANDARD_NEW_BODY(MovingSource); }
  vtkTypeMacro(MovingSource, vtkPolyDataAlgorithm);

  std::function<Mesh()> Make = [] { return MakeCloud(); };

protected:
  MovingSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    const double times[] = { 0.0, 1.0, 2.0 };
    const double range[] = { 0.0, 2.0 };
    vtkInformation* info = output->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 3);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    vtkInformation* info = output->GetInformationObject(0);
    double time = 0.0;
    if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
    {
      time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    }
    const Mesh made = this->Make();
    Shake(made, 0.003 * time);
    vtkPolyData::GetData(output)->ShallowCopy(made);
    return 1;
  }
};

/// A mesh with numbered cells.
Mesh NumberCells(const Mesh& mesh)
{
  AddNumbers(mesh->GetCellData(), "n", mesh->GetNumberOfCells(), 0);
  return mesh;
}

using SetOptions = std::function<void(vtkDelaunayFlip*)>;

/// That the output of a filter is that of a new one, with all that is told, but for seconds.
void ExpectOutputOfANewFilter(WatchedFilter& filter, const SetOptions& set)
{
  vtkPolyData* actual = filter->GetOutput();
  WatchedFilter fresh(filter->GetInput());
  set(fresh.Get());
  vtkPolyData* expected = fresh.Run(); // some triangles turn over, which is a warning
  EXPECT_EQ(expected->GetPoints(), actual->GetPoints());
  ExpectSame(
    expected->GetPolys()->GetConnectivityArray(), actual->GetPolys()->GetConnectivityArray());
  EXPECT_EQ(GetNumbers(expected->GetCellData(), "n"), GetNumbers(actual->GetCellData(), "n"));
  vtkFieldData* fields = expected->GetFieldData();
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    const std::string name = fields->GetArrayName(i);
    if (name != "DelaunayFlip:Seconds")
    {
      ExpectSame(
        fields->GetAbstractArray(i), actual->GetFieldData()->GetAbstractArray(name.c_str()));
    }
  }
}

/// Two kinds of meshes, with the options for each.
struct MovingMesh
{
  std::function<Mesh()> Make;
  SetOptions Set;
};

std::vector<MovingMesh> ListMovingMeshes()
{
  const auto plane = [] { return NumberCells(MakeBadPlane()); };
  const auto surface = [] { return NumberCells(MakeBadSphere()); };
  const SetOptions none = [](vtkDelaunayFlip*) {};
  const SetOptions canonical = [](vtkDelaunayFlip* each) { each->SetTieRuleToCanonical(); };
  const SetOptions sharp = [](vtkDelaunayFlip* each) { each->SetFeatureAngle(12.0); };
  return { { plane, none }, { plane, canonical }, { surface, none }, { surface, sharp } };
}

}

TEST(MovingPoints, GiveTheOutputOfANewFilter)
{
  auto cloud = MakeCloud();
  PointsFilter filter(cloud);
  filter->SetKeepSessionToOn();
  EXPECT_EQ(Update(filter), 0.0);
  vtkNew<vtkPolyData> first;
  first->ShallowCopy(filter->GetOutput());
  const Cells before = GetCells(first->GetPolys());
  for (const double size : { 0.002, 0.01, 0.02 })
  {
    Shake(cloud, size);
    EXPECT_GT(Update(filter), 0.0) << size;
    EXPECT_EQ(filter->GetNumberOfIterations(), 0);
  }
  EXPECT_GT(filter->GetTotalFlips(), 0);
  EXPECT_NE(filter.GetPolygons(), before);
  EXPECT_EQ(GetCells(first->GetPolys()), before);
  Shake(cloud, 3.0);
  EXPECT_EQ(Update(filter), 0.0);
  Shake(cloud, 0.002);
  EXPECT_GT(Update(filter), 0.0);

  // The boundary grows and shrinks, and nothing has moved.
  for (const double factor : { 1.02, 0.97, 1.0 })
  {
    MovePoints(cloud,
      [factor](double* x)
      {
        const double far = std::hypot(x[0] - 5.0, x[1] - 5.0);
        x[0] = 5.0 + (x[0] - 5.0) * (far > 5.0 ? factor : 1.0);
      });
    Update(filter);
  }

  // Values that are changed in place without a notice count, too.
  static_cast<double*>(cloud->GetPoints()->GetVoidPointer(0))[300] += 0.003;
  filter->Modified();
  EXPECT_GT(Update(filter), 0.0);

  // Other data of the same points.
  AddNumbers(cloud->GetPointData(), "n", Count, 8);
  Update(filter);
  EXPECT_TRUE(filter.GetErrors().empty());
}

/// An outline, a hole and a line, which all move with the points.
TEST(MovingPoints, TakeSegmentsAlong)
{
  auto cloud = MakeCloud();
  const auto segments =
    MakeMesh({ { 1, 1, 0 }, { 9, 1, 0 }, { 9, 9, 0 }, { 1, 9, 0 }, { 4, 4, 0 }, { 6, 4, 0 },
               { 6, 6, 0 }, { 4, 6, 0 }, { 2, 2, 0 }, { 8, 3, 0 } },
      { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } });
  segments->SetLines(MakeLines({ { 8, 9 } })->GetLines());
  const auto set = [&segments](PointsFilter& each)
  {
    each->SetSegmentsData(segments);
    each->SetFirstHole(2); // the line is cell 0
    each->PassSegmentsOn();
  };
  PointsFilter filter(cloud);
  filter->SetKeepSessionToOn();
  set(filter);
  EXPECT_EQ(Update(filter, set), 0.0);
  EXPECT_GT(GetTotal(filter->GetOutput(), "OutsideTriangles"), 0.0);
  const auto move = [&](double step)
  {
    Shake(cloud, 0.1 * step);
    MovePoints(segments, [step](double* x) { x[0] += step * (0.5 + 0.01 * x[1]); });
  };
  for (const double step : { 3e-5, 3e-5, 5e-5 })
  {
    move(step);
    EXPECT_GT(Update(filter, set), 0.0) << step;
  }
  move(0.3); // through points
  EXPECT_EQ(Update(filter, set), 0.0);
  move(3e-5);
  EXPECT_GT(Update(filter, set), 0.0);
  EXPECT_TRUE(filter.GetErrors().empty());
}

TEST(MovingPoints, StartAgainWithOtherSegments)
{
  auto cloud = MakeCloud();
  const Points ends = { { 2, 2, 0 }, { 8, 3, 0 }, { 2, 5, 0 }, { 8, 6, 0 } };
  auto segments = MakeLines(ends, { { 0, 1 }, { 2, 3 } });
  const auto keep = [&segments](PointsFilter& each) { each->SetSegmentsData(segments); };
  PointsFilter filter(cloud);
  filter->SetKeepSessionToOn();
  keep(filter);
  Update(filter, keep);
  const auto expect = [&](bool isFollowed, const std::function<void(PointsFilter&)>& set)
  {
    Shake(cloud, 1e-5);
    set(filter);
    EXPECT_EQ(Update(filter, set) > 0.0, isFollowed);
  };
  expect(true, keep);
  segments = MakeLines(ends, { { 0, 1 }, { 3, 2 } });
  expect(false, keep);
  expect(true, keep);
  segments = MakeLines(ends, { { 2, 3 }, { 1, 0 } }); // the numbers of points are others
  expect(false, keep);
  expect(true, keep);

  const auto split = [&segments](PointsFilter& each)
  {
    each->SetSegmentsData(segments);
    each->SplitCrossingsOn();
  };
  filter->SplitCrossingsOn();
  Shake(cloud, 1e-5);
  EXPECT_EQ(GetTotal(filter.Run(), "MoveRounds"), 0.0);
  Shake(cloud, 1e-5);
  EXPECT_EQ(Update(filter, split), 0.0);
  filter->SplitCrossingsOff();

  // While segments cross, points are triangulated anew.
  segments = MakeLines(ends, { { 0, 1 }, { 2, 3 } });
  expect(false, keep);
  const auto place = [&segments](vtkIdType point, double x, double y)
  {
    segments->GetPoints()->SetPoint(point, x, y, 0.0);
    segments->GetPoints()->Modified();
  };
  place(3, 8.0, 2.5);
  expect(false, keep);
  EXPECT_EQ(filter->GetNumberOfRefusedSegments(), 1);
  expect(false, keep);
  place(3, 8.0, 6.0);
  expect(false, keep);
  EXPECT_EQ(filter->GetNumberOfRefusedSegments(), 0);
  expect(true, keep);

  // A ring that a segment crosses is an error.
  segments->SetPolys(MakeMesh({}, { { 0, 1, 3, 2 } })->GetPolys());
  segments->GetPoints()->InsertNextPoint(4.0, 4.0, 0.0);
  segments->GetPoints()->InsertNextPoint(6.0, 4.0, 0.0);
  segments->SetLines(MakeLines({ { 4, 5 } })->GetLines());
  expect(false, keep);
  expect(true, keep);
  EXPECT_TRUE(filter.GetErrors().empty());
  place(5, 9.0, 4.0);
  filter.Run();
  EXPECT_EQ(filter.GetErrors().size(), 1u);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0);
  place(5, 6.0, 4.0);
  expect(false, keep);
  expect(true, keep);
}

TEST(MovingPoints, ThatMeetOrLeaveOrGetMore)
{
  auto cloud = MakeCloud();
  PointsFilter filter(cloud);
  filter->SetKeepSessionToOn();
  Update(filter);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  double x[3], y[3];
  cloud->GetPoint(7, x);
  cloud->GetPoint(20, y);
  const auto place = [&cloud](vtkIdType point, const double* at)
  {
    cloud->GetPoints()->SetPoint(point, at);
    cloud->GetPoints()->Modified();
  };
  const double none[] = { nan, 0.0, 0.0 };
  for (const double* at : { static_cast<const double*>(y), none, static_cast<const double*>(x) })
  {
    place(7, at);
    EXPECT_EQ(Update(filter), 0.0);
    Shake(cloud, 0.002); // two points at one place part again
    EXPECT_EQ(Update(filter) > 0.0, at != y);
  }
  for (const int count : { 1500, 2100, 2 })
  {
    auto other = MakeCloud(count);
    filter->SetInputData(other);
    EXPECT_EQ(Update(filter), 0.0);
    Shake(other, 0.002);
    EXPECT_EQ(Update(filter) > 0.0, count > 2);
  }
}

TEST(MovingPoints, OtherOptionsAndTypesStartAgain)
{
  auto cloud = MakeCloud();
  PointsFilter filter(cloud);
  filter->SetKeepSessionToOn();
  Update(filter);
  const auto move = [&cloud] { Shake(cloud, 0.002); };
  const auto expect = [&](double isFollowed, const std::function<void(PointsFilter&)>& set)
  {
    move();
    set(filter);
    EXPECT_EQ(Update(filter, set) > 0.0, isFollowed);
  };
  const auto same = [](PointsFilter&) {};
  expect(true, same);
  const auto threads = [](PointsFilter& each) { each->SetNumberOfThreads(2); };
  expect(false, threads);
  expect(true, threads);
  const auto alpha = [](PointsFilter& each) { each->SetAlpha(0.5); };
  expect(false, alpha);
  expect(false, alpha);
  const auto none = [](PointsFilter& each) { each->SetAlpha(0.0); };
  expect(false, none);
  expect(true, none);
  const auto segments = MakeLines({ { 1, 1, 0 }, { 9, 8, 0 } }, { { 0, 1 } });
  filter->SetSegmentsData(segments);
  move();
  EXPECT_EQ(GetTotal(filter.Run(), "MoveRounds"), 0.0);
  filter->SetSegmentsData(nullptr);
  expect(false, none);
  ReplacePoints<vtkFloatArray>(cloud);
  expect(false, none);
  expect(true, none);

  // In other planes.
  vtkNew<vtkTransform> transform;
  transform->RotateX(20.0);
  const auto tilt = [&](PointsFilter& each) { each->SetTransform(transform); };
  expect(false, tilt);
  expect(true, tilt);
  const auto fit = [](PointsFilter& each)
  {
    each->SetTransform(nullptr);
    each->SetProjectionToBestFittingPlane();
  };
  expect(false, fit);
  expect(true, fit);
}

TEST(MovingPoints, GoOnAfterAnAbort)
{
  auto cloud = MakeCloud();
  PointsFilter filter(cloud);
  filter->SetKeepSessionToOn();
  bool isAborting = true;
  OnProgress(filter.Get(), [&] { filter->SetAbortExecute(isAborting); });
  filter.Run();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  isAborting = false;
  EXPECT_EQ(Update(filter), 0.0);
  for (const double size : { 0.002, 3.0 })
  {
    Shake(cloud, size);
    isAborting = true;
    filter.Run();
    EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), Count);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0);
    isAborting = false;
    filter->Modified();
    EXPECT_EQ(Update(filter) > 0.0, size < 1.0);
  }
}

/// The first input has no time steps, but the other one has.
TEST(MovingPoints, OtherInputsHaveTimes)
{
  vtkNew<MovingSource> source;
  source->Make = []
  {
    Mesh cloud = MakeCloud();
    AddNumbers(cloud->GetPointData(), "n", cloud->GetNumberOfPoints(), 0);
    return cloud;
  };
  const Mesh places = MakeCloud(50);
  vtkNew<vtkDelaunayFlipInterpolator> interpolator;
  interpolator->SetInputData(places);
  interpolator->SetSourceConnection(source->GetOutputPort());
  std::vector<double> values;
  for (const double time : { 0.0, 2.0, 0.0 })
  {
    interpolator->UpdateTimeStep(time);
    auto* output = vtkPolyData::SafeDownCast(interpolator->GetOutputDataObject(0));
    ASSERT_NE(output, nullptr);
    values.push_back(output->GetPointData()->GetArray("n")->GetTuple1(7));
  }
  EXPECT_NE(values[1], values[0]);
  EXPECT_EQ(values[2], values[0]);

  PointsFilter filter(MakeCloud(30));
  filter->SetInputConnection(1, source->GetOutputPort());
  filter->UpdateTimeStep(0.0);
  const double before = filter->GetOutput()->GetBounds()[0];
  filter->UpdateTimeStep(2.0);
  EXPECT_NE(filter->GetOutput()->GetBounds()[0], before);
}

TEST(MovingPoints, KeepTheSessionWhereThereIsTime)
{
  vtkNew<MovingSource> source;
  PointsFilter filter;
  filter->SetInputConnection(source->GetOutputPort());
  const auto updateTo = [&](double time)
  {
    filter->UpdateTimeStep(time);
    return GetTotal(filter->GetOutput(), "MoveRounds");
  };
  EXPECT_EQ(updateTo(0.0), 0.0);
  const Cells first = filter.GetPolygons();
  EXPECT_GT(updateTo(2.0), 0.0);
  EXPECT_GT(updateTo(1.0), 0.0);
  EXPECT_GT(updateTo(0.0), 0.0);
  EXPECT_EQ(filter.GetPolygons(), first);
  filter->SetKeepSessionToOff();
  EXPECT_EQ(updateTo(1.0), 0.0);
  EXPECT_EQ(updateTo(2.0), 0.0);

  auto cloud = MakeCloud();
  PointsFilter still(cloud);
  still.Run();
  Shake(cloud, 0.002);
  EXPECT_EQ(GetTotal(still.Run(), "MoveRounds"), 0.0);
}

TEST(MovingPoints, InLiveUpdates)
{
  auto cloud = MakeCloud();
  cloud->GetPoints()->GetData()->SetComponentName(0, "east");
  PointsFilter filter(cloud), atOnce(cloud);
  for (PointsFilter* each : { &filter, &atOnce })
  {
    (*each)->SetKeepSessionToOn();
  }
  filter->LiveUpdateOn();
  filter.Run();
  EXPECT_STREQ("east", filter->GetOutput()->GetPoints()->GetData()->GetComponentName(0));
  Shake(cloud, 0.002); // in the middle of a run
  EXPECT_GT(RunToTheEnd(filter), 2);
  for (int frame = 0; frame < 3; ++frame)
  {
    atOnce.Run();
    EXPECT_EQ(filter.GetPolygons(), atOnce.GetPolygons());
    Shake(cloud, 0.002);
    filter.Run();
    EXPECT_GT(GetTotal(filter->GetOutput(), "MoveRounds"), 0.0);
    EXPECT_TRUE(filter->GetConverged());
    EXPECT_FALSE(filter->GetNeedsUpdate());
  }
}

/// The run that an update without steps has kept is at its end.
TEST(MovingPoints, BeginALiveRunWhenItIsAskedFor)
{
  PointsFilter filter(MakeCloud());
  filter->SetKeepSessionToOn();
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  filter->LiveUpdateOn();
  filter.Run();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_RUNNING);
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  EXPECT_TRUE(filter->Advance());
}

/// Points of segments are behind those that a view draws, so the mesh is put out.
TEST(MovingPoints, PutMeshesWithSegmentsOut)
{
  auto cloud = MakeCloud();
  const auto segments = MakeLines({ { 2, 2, 0 }, { 8, 3, 0 } }, { { 0, 1 } });
  PointsFilter filter(cloud), atOnce(cloud);
  for (PointsFilter* each : { &filter, &atOnce })
  {
    (*each)->SetKeepSessionToOn();
    (*each)->SetSegmentsData(segments);
  }
  filter->LiveUpdateOn();
  RunToTheEnd(filter);
  for (int frame = 0; frame < 3; ++frame)
  {
    Shake(cloud, 1e-5);
    EXPECT_TRUE(filter->AdvanceSession());
    EXPECT_GT(filter->GetReport().FromPoints.MoveRounds, 0);
    EXPECT_FALSE(filter->GetMeshIsWithheld());
    atOnce.Run();
    EXPECT_EQ(filter.GetPolygons(), atOnce.GetPolygons());
    ExpectSame(
      atOnce->GetOutput()->GetPoints()->GetData(), filter->GetOutput()->GetPoints()->GetData());
  }
}

/// What has followed points stays in the session until an update asks for it, also if the hull has
/// changed, and so the number of triangles.
TEST(MovingPoints, AreWithheldBySteps)
{
  auto cloud = MakeCloud();
  PointsFilter filter(cloud), atOnce(cloud);
  for (PointsFilter* each : { &filter, &atOnce })
  {
    (*each)->SetKeepSessionToOn();
  }
  filter->LiveUpdateOn();
  RunToTheEnd(filter);
  const Cells first = filter.GetPolygons();
  const auto shakeInside = [&](double size)
  {
    int i = 0;
    MovePoints(cloud,
      [&](double* x)
      {
        const bool isInside = std::hypot(x[0] - 5.0, x[1] - 5.0) < 4.0;
        x[isInside ? 0 : 2] += size * std::sin(12.3 * i++);
      });
  };
  const auto step = [&](double size, bool isWithheld)
  {
    shakeInside(size);
    EXPECT_TRUE(filter->AdvanceSession());
    EXPECT_EQ(filter->GetMeshIsWithheld(), isWithheld);
    EXPECT_EQ(filter->GetReport().FromPoints.MoveRounds > 0, isWithheld);
  };
  step(0.002, true);
  step(0.002, true);
  EXPECT_EQ(filter.GetPolygons(), first); // as it was
  filter.Run();
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_GT(GetTotal(filter->GetOutput(), "MoveRounds"), 0.0);
  atOnce.Run();
  EXPECT_EQ(filter.GetPolygons(), atOnce.GetPolygons());
  EXPECT_NE(filter.GetPolygons(), first);
  step(0.002, true);
  shakeInside(0.002); // before the mesh has been put out
  filter.Run();
  atOnce.Run();
  EXPECT_EQ(filter.GetPolygons(), atOnce.GetPolygons());
  step(0.002, true);
  const double right = cloud->GetBounds()[1]; // of a point of the hull, which others leave
  MovePoints(cloud, [right](double* x) { x[0] += x[0] == right ? 5.0 : 0.0; });
  const std::int64_t triangles = filter->GetReport().Triangles;
  filter->AdvanceSession();
  EXPECT_TRUE(filter->GetMeshIsWithheld());
  EXPECT_GT(filter->GetReport().FromPoints.MoveRounds, 0);
  EXPECT_NE(filter->GetReport().Triangles, triangles);
  filter.Run();
  atOnce.Run();
  EXPECT_EQ(filter.GetPolygons(), atOnce.GetPolygons());
  step(3.0, false); // from points
  atOnce.Run();
  EXPECT_EQ(filter.GetPolygons(), atOnce.GetPolygons());
}

/// Whatever the updates before have left.
TEST(MovingMeshes, GiveTheOutputOfANewFilter)
{
  for (const MovingMesh& moving : ListMovingMeshes())
  {
    const Mesh mesh = moving.Make();
    WatchedFilter filter(mesh);
    moving.Set(filter.Get());
    vtkNew<MovingSource> source;
    source->Make = moving.Make;
    WatchedFilter inTime;
    inTime->SetInputConnection(source->GetOutputPort());
    moving.Set(inTime.Get());
    for (const double time : { 0.0, 2.0, 1.0, 0.0 })
    {
      filter.Run();
      ExpectOutputOfANewFilter(filter, moving.Set);
      EXPECT_GT(filter->GetTotalFlips(), 0);
      Shake(mesh, 0.003);
      inTime->UpdateTimeStep(time);
      ExpectOutputOfANewFilter(inTime, moving.Set);
    }
  }
}

/// In the plane the triangles are those of a new filter, too, but in other cells.
TEST(MovingMeshes, GetTheSameTrianglesInLiveUpdates)
{
  const Mesh mesh = NumberCells(MakeBadPlane());
  LiveFilter filter(mesh);
  WatchedFilter atOnce(mesh);
  filter->SetTieRuleToCanonical();
  atOnce->SetTieRuleToCanonical();
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetPolygons(), GetCells(atOnce.Run()->GetPolys()));
  for (int frame = 0; frame < 4; ++frame)
  {
    Shear(mesh, 0.02);
    filter.RunToTheEnd();
    EXPECT_EQ(GetTriangles(filter->GetOutput()), GetTriangles(atOnce.Run()));
    EXPECT_LT(3 * filter->GetTotalFlips(), atOnce->GetTotalFlips());
  }
  EXPECT_NE(filter.GetPolygons(), atOnce.GetPolygons());
}
