// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The mapper: what it draws, compared with VTK's own mapper; and live views that draw without
/// copies: the same pictures and meshes as from the host; and those that cannot, or no longer.

#include "LiveViewTestSupport.h"
#include "TestFiller.h"
#include "TestWindow.h"

#include "DelaunayFlip.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellPicker.h"
#include "vtkColorTransferFunction.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkDoubleArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLookupTable.h"
#include "vtkMeshQuality.h"
#include "vtkPlane.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

using delaunayflip::MutableTriangleArray;

namespace
{

const std::string WithoutCopies = "drawn without copies";

/// What is drawn, by this project's mapper or, to compare, by VTK's own.
struct Drawing
{
  vtkNew<vtkDelaunayFlipMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkSmartPointer<vtkRenderWindow> Window = MakeTestWindow();

  explicit Drawing(vtkPolyData* mesh)
  {
    this->Window->SetSize(200, 200);
    this->Window->SetMultiSamples(0);
    this->Window->SetOffScreenRendering(true);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->AddActor(this->Actor);
    this->Mapper->SetInputData(mesh);
    this->Mapper->SetColorBy(vtkDelaunayFlipMapper::COLOR_BY_SOLID);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetInterpolationToFlat();
    this->Actor->GetProperty()->SetColor(0.8, 0.5, 0.2);
    this->Actor->GetProperty()->SetAmbient(0.3);
    this->Actor->GetProperty()->SetDiffuse(0.7);
    this->Renderer->ResetCamera();
  }

  Bytes Draw()
  {
    this->Renderer->ResetCameraClippingRange();
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, 199, 199, 0, pixels);
    return Bytes(pixels->GetPointer(0), pixels->GetPointer(pixels->GetNumberOfValues()));
  }

  /// Draws the picture by VTK's mapper.
  Bytes DrawByVtk(vtkPolyDataMapper* mapper)
  {
    mapper->SetClippingPlanes(this->Mapper->GetClippingPlanes());
    this->Actor->SetMapper(mapper);
    const Bytes picture = this->Draw();
    this->Actor->SetMapper(this->Mapper);
    return picture;
  }
  Bytes DrawByVtk()
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputDataObject(this->Mapper->GetInput());
    mapper->ScalarVisibilityOff();
    return this->DrawByVtk(mapper);
  }
};

double FindMean(const Bytes& picture)
{
  return std::accumulate(picture.begin(), picture.end(), 0.0) / static_cast<double>(picture.size());
}

void ExpectSameStep(ViewPair& views)
{
  views.Step();
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

/// A run that is drawn from copies for a reason, with the right pictures.
void ExpectCopies(const std::string& reason)
{
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  while (views.Step())
  {
  }
  EXPECT_EQ(views.Sharing->GetDrawing(), "drawn from copies: " + reason);
  EXPECT_TRUE(views.Sharing.Errors.empty());
  EXPECT_EQ(views.Sharing.Filter.GetPolygons(), FlipAtOnce(mesh));
}

}

TEST(Mapper, DrawsWhatVtkDraws)
{
  for (const double far : { 0.0, 1e7 }) // where single precision alone would show nothing
  {
    auto mesh = MakeBadSphere();
    MovePoints(mesh, [far](double* x) { x[0] = far + 1e-3 * x[0], x[1] *= 1e-3, x[2] *= 1e-3; });
    Drawing drawing(mesh);
    drawing.Actor->SetScale(1.0, 2.0, 0.5);
    drawing.Actor->RotateX(30.0);
    drawing.Renderer->ResetCamera();
    EXPECT_LE(Compare(drawing.Draw(), drawing.DrawByVtk()), 0.003);
    EXPECT_GT(FindMean(drawing.Draw()), 20.0);
    drawing.Actor->GetProperty()->LightingOff();
    drawing.Renderer->GetActiveCamera()->ParallelProjectionOn();
    EXPECT_LE(Compare(drawing.Draw(), drawing.DrawByVtk()), 0.003);
  }
}

TEST(Mapper, ColorsByAngleAsVtkMeasuresIt)
{
  Drawing drawing(MakeBadSphere());
  drawing.Mapper->SetColorBy(vtkDelaunayFlipMapper::COLOR_BY_SMALLEST_ANGLE);
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputData(drawing.Mapper->GetInput());
  quality->SetTriangleQualityMeasureToMinAngle();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(quality->GetOutputPort());
  mapper->SetLookupTable(drawing.Mapper->GetLookupTable());
  mapper->UseLookupTableScalarRangeOn();
  EXPECT_LE(Compare(drawing.Draw(), drawing.DrawByVtk(mapper)), 0.003);
  const double smallest = quality->GetOutput()->GetCellData()->GetArray("Quality")->GetRange()[0];
  EXPECT_NEAR(drawing.Mapper->GetSmallestAngle(), smallest, 1e-9);
}

TEST(Mapper, ColorsByFlipCountAsVtkDoes)
{
  auto mesh = MakeBadSphere();
  mesh->SetLines(MakeCells({ { 0, 1 } })); // cells before the polygons
  vtkNew<vtkIntArray> counts;
  counts->SetName("vtkDelaunayFlipCount");
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    counts->InsertNextValue(static_cast<int>(i % 17));
  }
  mesh->GetCellData()->SetScalars(counts);
  Drawing drawing(mesh);
  drawing.Mapper->SetColorBy(vtkDelaunayFlipMapper::COLOR_BY_FLIP_COUNT);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->SetScalarModeToUseCellData();
  mapper->SetLookupTable(drawing.Mapper->GetLookupTable());
  mapper->UseLookupTableScalarRangeOn();
  const Bytes picture = drawing.Draw(); // which fills the table
  EXPECT_LE(Compare(picture, drawing.DrawByVtk(mapper)), 0.003);
  EXPECT_EQ(drawing.Mapper->GetLookupTable()->GetRange()[1], 16.0);
}

TEST(Mapper, ClippingPlanes)
{
  Drawing drawing(MakeBadSphere());
  const double whole = FindMean(drawing.Draw());
  drawing.Actor->SetPosition(0.1, 0.2, 0.3);
  for (const int axis : { 0, 1 })
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0.2, 0.2, 0.2);
    plane->SetNormal(axis == 0, axis == 1, 0.0);
    drawing.Mapper->AddClippingPlane(plane);
    EXPECT_LE(Compare(drawing.Draw(), drawing.DrawByVtk()), 0.003);
  }
  EXPECT_LT(FindMean(drawing.Draw()), 0.5 * whole);
}

TEST(Mapper, EdgesAreDrawnAndFadeWhereTheyAreDense)
{
  Drawing coarse(MakeRhombus());
  coarse.Actor->GetProperty()->SetEdgeColor(0.0, 0.0, 1.0);
  coarse.Actor->GetProperty()->LightingOff();
  const Bytes plain = coarse.Draw();
  coarse.Actor->GetProperty()->EdgeVisibilityOn();
  const Bytes edges = coarse.Draw();
  const std::size_t middle = 3 * (100 * 200 + 100); // on the edge between the triangles
  EXPECT_EQ(plain[middle + 2], 51);
  EXPECT_GE(edges[middle + 2], 150);
  EXPECT_LT(edges[middle], plain[middle]);
  EXPECT_EQ(edges[middle - 3 * 200 * 20], plain[middle]); // within a triangle
  EXPECT_NEAR(Compare(edges, coarse.DrawByVtk()), 0.0, 0.03);

  Drawing dense(ToPolyData(delaunayflip::MakeRandomBadMeshDouble(20000, 3)));
  dense.Actor->GetProperty()->LightingOff();
  const double bright = FindMean(dense.Draw());
  dense.Actor->GetProperty()->SetEdgeColor(0.0, 0.0, 0.0);
  dense.Actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_GT(FindMean(dense.Draw()), 0.85 * bright);
}

TEST(Mapper, AnyInput)
{
  auto strip = MakeMesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 2, 1, 0 } }, {});
  strip->SetStrips(MakeCells({ { 0, 1, 2, 3 } }));
  strip->SetLines(MakeCells({ { 0, 4 } }));
  auto integers = MakeRhombus();
  ReplacePoints<vtkIntArray>(integers);
  for (const Mesh& mesh : { MakeQuadAndTriangle(), strip, integers })
  {
    Drawing drawing(mesh);
    EXPECT_EQ(drawing.Mapper->GetNumberOfTriangles(),
      mesh == Mesh(strip) || mesh == Mesh(integers) ? 2 : 3);
    const Bytes picture = drawing.Draw();
    mesh->SetLines(nullptr);
    EXPECT_LE(Compare(picture, drawing.DrawByVtk()), 0.003);
  }
  auto bad = MakeRhombusAnd(
    { { std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0 } }, { { 0, 1, 4 }, { 0, 1, 2 } });
  bad->GetPolys()->ReplaceCellAtId(3, 3, std::array<vtkIdType, 3>{ 0, 2, 99 }.data());
  bad->Modified();
  Drawing(bad).Draw();
  EXPECT_EQ(FindMean(Drawing(vtkSmartPointer<vtkPolyData>::New()).Draw()), 0.0);
  const vtkIdType far = 1000000000, wrapped = (vtkIdType(1) << 32) + 2;
  for (const Cell& cell :
    { Cell{ 0, 1, 2, far }, Cell{ 0, 1, 2, -far }, Cell{ 0, 1, 2, 3, far }, Cell{ 0, 1, wrapped } })
  {
    bad->SetPolys(MakeCells({ cell }));
    EXPECT_EQ(FindMean(Drawing(bad).Draw()), 0.0);
  }
  vtkNew<vtkIdTypeArray> offsets, ids;
  offsets->SetNumberOfValues(100001);
  std::generate_n(
    offsets->GetPointer(0), 100001, [id = vtkIdType(-3)]() mutable { return id += 3; });
  ids->SetNumberOfValues(3);
  ids->FillValue(0);
  bad->GetPolys()->SetData(offsets, ids);
  EXPECT_TRUE(std::isnan(Drawing(bad).Mapper->GetSmallestAngle()));
  auto pairs = MakeRhombus();
  pairs->GetPoints()->GetData()->SetNumberOfComponents(2);
  EXPECT_TRUE(std::isnan(Drawing(pairs).Mapper->GetSmallestAngle()));
}

TEST(Mapper, AnotherMeshOfTheSameAgeIsAnotherMesh)
{
  auto before = MakeRhombus();
  vtkNew<vtkPolyData> after;
  after->SetPoints(before->GetPoints());
  after->SetPolys(MakeCells({ { 0, 1, 3 }, { 1, 2, 3 } }));
  before->GetPoints()->Modified();
  ASSERT_EQ(after->GetMTime(), before->GetMTime());
  vtkNew<vtkDelaunayFlipMapper> mapper;
  mapper->SetInputData(before);
  const double angle = mapper->GetSmallestAngle();
  mapper->SetInputData(after);
  EXPECT_GT(mapper->GetSmallestAngle(), 1.5 * angle);
}

TEST(Mapper, InfinitePointsHideNoOthers)
{
  auto mesh = MakeBadPlane();
  const double mean = FindMean(Drawing(mesh).Draw());
  mesh->GetPoints()->SetPoint(7, std::numeric_limits<double>::infinity(), 0.0, 0.0);
  EXPECT_GT(FindMean(Drawing(mesh).Draw()), 0.8 * mean);
  MovePoints(mesh, [](double* x) { x[2] = std::numeric_limits<double>::infinity(); });
  EXPECT_EQ(FindMean(Drawing(mesh).Draw()), 0.0);
}

TEST(Mapper, OtherTablesHaveNoEffect)
{
  Drawing drawing(MakeBadPlane());
  drawing.Mapper->SetColorBy(vtkDelaunayFlipMapper::COLOR_BY_SMALLEST_ANGLE);
  const Bytes picture = drawing.Draw();
  drawing.Mapper->SetLookupTable(nullptr);
  EXPECT_EQ(drawing.Draw(), picture);
  drawing.Mapper->SetLookupTable(vtkNew<vtkColorTransferFunction>());
  drawing.Mapper->SetColorBy(vtkDelaunayFlipMapper::COLOR_BY_FLIP_COUNT); // another table
  drawing.Draw();
}

TEST(Mapper, NothingIsTranslucent)
{
  Drawing drawing(MakeBadPlane());
  int warnings = 0;
  OnEvent(drawing.Mapper, vtkCommand::WarningEvent, [&warnings]() { ++warnings; });
  drawing.Actor->GetProperty()->SetOpacity(0.5);
  drawing.Draw();
  EXPECT_EQ(FindMean(drawing.Draw()), 0.0);
  EXPECT_EQ(warnings, 1);
}

TEST(Mapper, NothingIsPicked)
{
  Drawing drawing(MakeBadPlane());
  drawing.Draw();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(drawing.Renderer);
  selector->SetArea(100, 90, 100, 90);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(selection->GetNumberOfNodes(), 0u);
  WatchedView view;
  view->Step();
  vtkNew<vtkCellPicker> picker;
  EXPECT_FALSE(picker->Pick(100, 90, 0, view->GetRenderer()));
}

TEST(Mapper, MovesToAnotherWindow)
{
  auto mesh = MakeBadSphere();
  Drawing first(mesh), second(mesh);
  const Bytes picture = first.Draw();
  second.Renderer->RemoveActor(second.Actor);
  second.Renderer->AddActor(first.Actor);
  EXPECT_EQ(second.Draw(), picture);
  EXPECT_EQ(first.Draw(), picture);
  first.Renderer->RemoveActor(first.Actor);
  EXPECT_EQ(second.Draw(), picture);
}

TEST(ZeroCopy, TheBufferHoldsTheTrianglesOfTheSession)
{
  const TestFiller& filler = TestFiller::Install();
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  view->Start();
  while (view->Step())
  {
    ASSERT_EQ(view->GetDrawing(), WithoutCopies);
    std::vector<std::int32_t> ids(3 * mesh->GetNumberOfPolys());
    view.Filter->GetSession()->StoreTriangles(
      MutableTriangleArray(ids.data(), mesh->GetNumberOfPolys()));
    EXPECT_EQ(filler.GetTriangles(), ids);
  }
}

TEST(ZeroCopy, SamePicturesAndMesh)
{
  for (const int colorBy :
    { vtkDelaunayFlipLiveView::COLOR_BY_SOLID, vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE,
      vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT })
  {
    TestFiller::Install();
    auto mesh = MakeBadPlane();
    ViewPair views(mesh);
    for (WatchedView* view : { &views.Copying, &views.Sharing })
    {
      (*view)->SetColorBy(colorBy);
      (*view)->SetEdgeVisibility(colorBy == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT
          ? vtkDelaunayFlipLiveView::EDGE_VISIBILITY_OFF
          : vtkDelaunayFlipLiveView::EDGE_VISIBILITY_ON);
    }
    while (views.Step())
    {
      EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
    }
    EXPECT_EQ(views.Copying->GetDrawing(), "drawn from copies: ZeroCopy is off");
    EXPECT_TRUE(views.Sharing->GetConverged());
    EXPECT_EQ(views.Sharing->GetFrameNumber(), views.Sharing.Filter->GetNumberOfIterations());
    EXPECT_EQ(views.Sharing.Filter.GetPolygons(), FlipAtOnce(mesh));
    EXPECT_FALSE(views.Sharing->Step());
  }
}

TEST(ZeroCopy, TheBuffersAreMappedDuringAStep)
{
  const TestFiller& filler = TestFiller::Install();
  ViewPair views(MakeBadPlane());
  ExpectSameStep(views);
  const Bytes before = views.Sharing.GetPicture();
  int steps = 0;
  OnEvent(views.Sharing.Filter.Get(), vtkCommand::StartEvent,
    [&]()
    {
      EXPECT_TRUE(filler.AreMapped);
      if (++steps == 1) // what is drawn then is the mesh before
      {
        views.Sharing.Window->Render();
        EXPECT_FALSE(filler.AreMapped);
        EXPECT_EQ(before, views.Sharing.GetPicture());
      }
    });
  ExpectSameStep(views);
  EXPECT_NE(before, views.Sharing.GetPicture());
  ExpectSameStep(views);
  EXPECT_EQ(steps, 2);
  EXPECT_FALSE(filler.AreMapped);
  EXPECT_EQ(filler.Fills, 3);
}

TEST(ZeroCopy, TheOutputIsThereOnDemand)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  WatchedFilter reference(mesh);
  reference->LiveUpdateOn();
  for (int i = 0; i < 3; ++i)
  {
    view->Step();
    reference.Run();
    reference->Advance();
  }
  EXPECT_NE(
    GetCells(view.Filter->GetOutput()->GetPolys()), GetCells(reference->GetOutput()->GetPolys()));
  EXPECT_EQ(GetCells(view.Filter.Run()->GetPolys()), GetCells(reference->GetOutput()->GetPolys()));
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 3);
  view->Step();
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 4);
  EXPECT_EQ(view->GetFrameNumber(), 4);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, RestartBeginsAtTheInput)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  view->Start();
  const Bytes input = view.GetPicture();
  view->Step();
  const Bytes first = view.GetPicture();
  view->Step();
  view->Restart();
  EXPECT_EQ(view.GetPicture(), input);
  view->Step();
  EXPECT_EQ(view.GetPicture(), first);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
  view.StepToTheEnd();
  EXPECT_EQ(view.Filter.GetPolygons(), FlipAtOnce(mesh));
}

TEST(ZeroCopy, ResizingAndEdges)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (WatchedView* view : { &views.Copying, &views.Sharing })
  {
    (*view)->Step();
    (*view)->Step();
    (*view)->SetEdgeVisibilityToOff();
    (*view)->Render();
    view->Window->SetSize(300, 250);
    (*view)->Render();
    (*view)->Step();
    (*view)->SetEdgeVisibilityToOn();
    (*view)->Render();
  }
  views.ExpectSamePicture();
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, MovedPointsAreDrawnInTheSameBuffers)
{
  // Far away, OpenGL's single precision would show nothing if VTK did not shift the points.
  for (const double far : { 0.0, 1e7 })
  {
    const TestFiller& filler = TestFiller::Install();
    auto mesh = MakeBadPlane();
    MovePoints(mesh, [far](double* x) { x[0] += far; });
    ViewPair views(mesh);
    ExpectSameStep(views);
    ExpectSameStep(views);
    MovePoints(mesh, [far](double* x) { x[0] = far + 0.8 * (x[0] - far) * (x[0] - far); });
    ExpectSameStep(views);
    ExpectSameStep(views);
    EXPECT_EQ(filler.Fillers, 1);
    EXPECT_EQ(views.Sharing->GetFrameNumber(), 4);
  }
}

/// Two views of the same points, each with a triangulation that follows them.
struct FollowingPair
{
  vtkNew<vtkDelaunayFlipPoints> Copying, Sharing;
  ViewPair Views;

  explicit FollowingPair(const Mesh& mesh)
    : Views(mesh)
  {
    for (vtkDelaunayFlipPoints* each : { this->Copying.Get(), this->Sharing.Get() })
    {
      SetTestBackend(each);
      each->SetInputData(mesh);
      each->SetKeepSessionToOn();
    }
    this->Views.Copying->SetFilter(this->Copying);
    this->Views.Sharing->SetFilter(this->Sharing);
    while (this->Views.Step())
    {
      EXPECT_EQ(this->Views.Sharing->GetDrawing(), WithoutCopies);
    }
  }

  /// A frame after the points have moved: the triangulation is made at once, and not put out.
  void ExpectFollowed(const TestFiller& filler)
  {
    EXPECT_FALSE(this->Views.Step());
    EXPECT_EQ(this->Views.Sharing.GetStatus().find("moved in "), 0u);
    EXPECT_EQ(this->Views.Sharing->GetDrawing(), WithoutCopies);
    const std::int64_t triangles = this->Sharing->GetReport().Triangles;
    EXPECT_EQ(this->Views.Sharing.GetMapper()->GetNumberOfTriangles(), triangles);
    std::vector<std::int32_t> ids(3 * triangles);
    this->Sharing->GetSession()->StoreTriangles(MutableTriangleArray(ids.data(), triangles));
    EXPECT_EQ(filler.GetTriangles(), ids);
    EXPECT_TRUE(this->Sharing->GetMeshIsWithheld());
  }

  /// The picture is that of a new triangulation.
  void ExpectPictureOf(const Mesh& mesh)
  {
    vtkNew<vtkDelaunayFlipPoints> atOnce;
    atOnce->SetInputData(mesh);
    atOnce->Update();
    WatchedView still(atOnce->GetOutput());
    still->Start();
    still->GetRenderer()->GetActiveCamera()->DeepCopy(
      this->Views.Sharing->GetRenderer()->GetActiveCamera());
    for (WatchedView* each : { &still, &this->Views.Sharing, &this->Views.Copying })
    {
      (*each)->ShowStatisticsOff();
      (*each)->Render();
    }
    EXPECT_EQ(Compare(still.GetPicture(), this->Views.Sharing.GetPicture()), 0.0);
    EXPECT_EQ(this->Views.Copying.GetPicture(), this->Views.Sharing.GetPicture());
    this->Sharing->Update();
    EXPECT_EQ(GetTriangles(this->Sharing->GetOutput()), GetTriangles(atOnce->GetOutput()));
  }
};

TEST(ZeroCopy, PointsThatMoveAreDrawnInTheSameBuffers)
{
  const TestFiller& filler = TestFiller::Install();
  auto mesh = MakeBadPlane();
  FollowingPair pair(mesh);
  for (int frame = 0; frame < 3; ++frame)
  {
    Shear(mesh, 0.003);
    pair.ExpectFollowed(filler);
    const int number = pair.Views.Sharing->GetFrameNumber();
    EXPECT_FALSE(pair.Views.Sharing->Step()); // nothing has moved
    EXPECT_EQ(pair.Views.Sharing->GetFrameNumber(), number);
  }
  EXPECT_EQ(filler.Fillers, 1);
  pair.ExpectPictureOf(mesh);
}

TEST(ZeroCopy, PointsThatChangeTheirHullAreDrawnInTheSameBuffers)
{
  const TestFiller& filler = TestFiller::Install();
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(700, 3));
  FollowingPair pair(mesh);
  const auto drift = [&mesh]
  {
    double phase = 0.0; // by point: each drifts in a direction of its own
    MovePoints(mesh,
      [&](double* x)
      {
        x[0] += 0.0003 * std::sin(phase);
        x[1] += 0.0003 * std::cos(phase);
        phase += 1.0;
      });
  };
  std::set<std::int64_t> numbers{ pair.Sharing->GetReport().Triangles };
  for (int frame = 0; frame < 30; ++frame)
  {
    drift();
    pair.ExpectFollowed(filler);
    numbers.insert(pair.Sharing->GetReport().Triangles);
  }
  EXPECT_GT(numbers.size(), 3u);
  EXPECT_LE(filler.Fillers, 2); // the second one has room for more triangles
  pair.ExpectPictureOf(mesh);

  // If somebody else updates the filter, the last frame stays until the next step.
  const std::int64_t drawn = pair.Sharing->GetReport().Triangles;
  const Bytes before = pair.Views.Sharing.GetPicture();
  for (int frame = 0; frame < 30 && pair.Sharing->GetReport().Triangles == drawn; ++frame)
  {
    drift();
    pair.Sharing->Update();
  }
  ASSERT_NE(pair.Sharing->GetReport().Triangles, drawn);
  pair.Views.Sharing->Render();
  EXPECT_EQ(pair.Views.Sharing.GetMapper()->GetNumberOfTriangles(), drawn);
  EXPECT_EQ(pair.Views.Sharing.GetPicture(), before);
}

TEST(ZeroCopy, AnotherMeshOfTheSameSizeTakesTheSameBuffers)
{
  const TestFiller& filler = TestFiller::Install();
  ViewPair views(MakeBadPlane());
  ExpectSameStep(views);
  auto next = MakeBadPlane();
  next->GetPoints()->SetPoint(0, -0.2, -0.1, 0.0);
  int fillers = 1;
  for (const Mesh& mesh : { next, ToPolyData(delaunayflip::MakeRandomBadMeshDouble(700, 3)) })
  {
    views.Copying.Filter->SetInputData(mesh);
    views.Sharing.Filter->SetInputData(mesh);
    ExpectSameStep(views);
    EXPECT_EQ(filler.Fillers, fillers++);
  }
}

TEST(ZeroCopy, LostResourcesAreMadeAgain)
{
  TestFiller& filler = TestFiller::Install();
  ViewPair views(MakeBadPlane());
  views.Step();
  views.Step();
  views.Sharing.GetActor()->GetMapper()->ReleaseGraphicsResources(views.Sharing.Window);
  EXPECT_EQ(filler.Living, 0);
  views.Sharing.Window->Render();
  EXPECT_EQ(filler.Living, 1);
  views.ExpectSamePicture();
  views.Step();
  views.ExpectSamePicture();
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, EverythingIsReleased)
{
  TestFiller& filler = TestFiller::Install();
  {
    WatchedView view;
    view->Step();
    view->Step();
    EXPECT_EQ(filler.Living, 1);
    view->SetFilter(nullptr);
    EXPECT_EQ(filler.Living, 0);
  }
  WatchedView view;
  view->Step();
  vtkSmartPointer<vtkMapper> mapper = view.GetActor()->GetMapper();
  view.View = nullptr; // while someone still has the mapper
  EXPECT_EQ(filler.Living, 0);
  mapper->Update();
  mapper->GetBounds();
}

/// It may be on another GPU.
TEST(ZeroCopy, AnotherFilterHasAnotherFiller)
{
  const TestFiller& filler = TestFiller::Install();
  const auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  view->Step();
  view->Step();
  LiveFilter other(mesh);
  other.Run();
  EXPECT_EQ(filler.Fillers, 1);
  for (int i = 0; i < 2; ++i)
  {
    view.GetMapper()->SetFilter(other.Get());
    view->Render();
    EXPECT_EQ(view->GetDrawing(), WithoutCopies);
    EXPECT_EQ(filler.Fillers, 2);
    EXPECT_EQ(filler.Living, 1);
  }
}

TEST(ZeroCopy, AWindowMayGoFirst)
{
  TestFiller& filler = TestFiller::Install();
  WatchedView view;
  view->Step();
  view->Step();
  view.Interactor = nullptr;
  view.Window = nullptr;
  EXPECT_EQ(filler.Living, 0);
  EXPECT_FALSE(view->Step());
}

TEST(ZeroCopy, AWindowMayGoThatNoLongerShowsTheMapper)
{
  TestFiller& filler = TestFiller::Install();
  WatchedView view;
  view->Step();
  view->Step();
  view.GetActor()->SetMapper(nullptr);
  EXPECT_EQ(filler.Living, 1);
  view.Interactor = nullptr;
  view.Window = nullptr;
  EXPECT_EQ(filler.Living, 0);
}

TEST(ZeroCopy, CellsThatStayAreDrawnToo)
{
  TestFiller::Install();
  ViewPair views(MakeQuadAndTriangle());
  for (WatchedView* view : { &views.Copying, &views.Sharing })
  {
    view->Filter->TriangulateOff();
    (*view)->ShowStatisticsOff();
  }
  ExpectSameStep(views);
  const Bytes before = views.Sharing.GetPicture();
  EXPECT_EQ(views.Sharing.GetMapper()->GetNumberOfTriangles(), 3);
  views.Sharing.GetActor()->VisibilityOff();
  views.Sharing.Window->Render();
  EXPECT_GT(Compare(before, views.Sharing.GetPicture()), 0.02);
}

TEST(ZeroCopyFallback, AnObstacleIsTold)
{
  TestFiller& filler = TestFiller::Install();
  filler.Obstacle = "OpenGL is elsewhere";
  ExpectCopies("OpenGL is elsewhere");
  EXPECT_EQ(filler.Fillers, 0);
  WatchedView view;
  view->ShowDrawingOn();
  view->Step();
  ExpectHolds(view.GetStatus(), "\ndrawn from copies: OpenGL is elsewhere");
}

TEST(ZeroCopyFallback, AnyCallMayFail)
{
  const struct
  {
    int TestFiller::*Failing;
    int Calls; ///< Each of the first calls fails in turn.
    const char* Reason;
  } cases[] = { { &TestFiller::FailingFill, 3, "no filling" },
    { &TestFiller::FailingMap, 2, "no mapping" },
    { &TestFiller::FailingUnmap, 1, "no unmapping" } };
  for (const auto& given : cases)
  {
    for (int call = 1; call <= given.Calls; ++call)
    {
      TestFiller& filler = TestFiller::Install();
      filler.*given.Failing = call;
      ExpectCopies(given.Reason);
      EXPECT_EQ(filler.Living, 0);
    }
  }
}

TEST(ZeroCopyFallback, AFailureOfTheFilterKeepsTheMesh)
{
  TestFiller::Install();
  WatchedView view;
  view->ShowStatisticsOff();
  view->Step();
  view->Step();
  const Bytes before = view.GetPicture();
  view.Filter->SetTieRuleToCanonical();
  view.Filter->SetGeometryToSurface();
  view->Step();
  EXPECT_EQ(view.GetStatus().find("failed: "), 0u);
  EXPECT_LT(Compare(view.GetPicture(), before), 0.1); // the text
  view.Filter->SetTieRuleToKeep();
  view.Filter->SetGeometryToAuto();
  view->Step();
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopyFallback, OnThreadsThereAreCopies)
{
  TestFiller::Remove();
  WatchedView view;
  view.Filter->SetBackendToThreads();
  view->Step();
#ifdef DELAUNAYFLIP_HAS_CUDA
  const std::string reason = "the filter works on CPU threads";
#else
  const std::string reason = "this build has no CUDA backend";
#endif
  EXPECT_EQ(view->GetDrawing(), "drawn from copies: " + reason);
}
