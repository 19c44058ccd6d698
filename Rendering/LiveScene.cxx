// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveScene.h"

#include "UpdateReport.h"

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipLiveView.h"
#include "vtkDelaunayFlipMapper.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

namespace delaunayflip
{

namespace
{

constexpr int FontSize = 14;
constexpr vtkIdType SmallMesh = 20000; // triangles, up to which edges can be told apart

double DarkInk[] = { 0.13, 0.19, 0.25 };
double LightInk[] = { 0.92, 0.94, 0.96 };
double DarkRed[] = { 0.75, 0.05, 0.1 };
double LightRed[] = { 1.0, 0.6, 0.55 };

constexpr const char* KeyHelp = "space: run/pause, n: next step, b: begin again, "
                                "k: colours, g: edges, i: statistics, d: drawing, q: quit";

/// Breaks a text into lines of so many characters.
std::string Wrap(const std::string& text, std::size_t width = 60)
{
  std::istringstream words(text);
  std::string wrapped;
  std::string word;
  for (std::size_t begin = 0; words >> word; wrapped += word)
  {
    const bool fits = wrapped.size() - begin + 1 + word.size() <= width;
    wrapped += wrapped.empty() ? "" : fits ? " " : "\n";
    begin = fits ? begin : wrapped.size();
  }
  return wrapped;
}

/// After a failure the filter has no counts, so the text says which frame is shown instead.
std::string DescribeFailure(vtkDelaunayFlipLiveView* view)
{
  // If the filter's source failed, the filter itself has no message.
  const std::string reason = view->GetFilter()->GetErrorMessage();
  return Wrap("failed: " + (reason.empty() ? "no input" : reason)) + "\nthe mesh of frame " +
    Count(view->GetFrameNumber());
}

std::string DescribeMesh(
  vtkDelaunayFlipLiveView* view, vtkDelaunayFlipMapper* mapper, const std::string& state)
{
  vtkDelaunayFlip* filter = view->GetFilter();
  if (view->GetFrameNumber() == 0)
  {
    return "input, " + state + "\n" + Count(mapper->GetNumberOfTriangles(), "triangle");
  }
  const bool isOne = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)) != nullptr;
  return (isOne ? "iteration " + Count(filter->GetNumberOfIterations())
                : "all blocks in one step") +
    ", " + state + "\n" + Count(filter->GetTotalFlips(), "flip") + ", " +
    Count(filter->GetNumberOfNonDelaunayEdges(), "bad edge") + " left";
}

/// Two or three lines. A failure, and how the mesh is drawn, take as many as their reasons need.
std::string DescribeStatus(
  vtkDelaunayFlipLiveView* view, vtkDelaunayFlipMapper* mapper, int state, bool isRunning)
{
  std::string text;
  if (state == vtkDelaunayFlip::STOP_REASON_FAILED)
  {
    text = DescribeFailure(view);
  }
  else
  {
    text = DescribeMesh(view, mapper,
      state != vtkDelaunayFlip::STOP_REASON_RUNNING ? view->GetFilter()->GetStopReasonAsString()
        : isRunning                                 ? "running"
                                                    : "paused");
    const double angle = mapper->GetSmallestAngle();
    char line[64] = "";
    if (!std::isnan(angle))
    {
      std::snprintf(line, sizeof(line), "\nsmallest angle %.2f degrees", angle);
    }
    text += line;
  }
  return view->GetShowDrawing() ? text + "\n" + Wrap(mapper->GetDrawing()) : text;
}

}

LiveScene::LiveScene()
{
  this->Actor->SetMapper(this->Mapper);
  this->Actor->PickableOff(); // see vtkDelaunayFlipMapper
  this->Actor->GetProperty()->SetAmbient(0.3);
  this->Actor->GetProperty()->SetDiffuse(0.7);
  this->Actor->GetProperty()->SetColor(0.80, 0.86, 0.91);
  this->Actor->GetProperty()->SetEdgeColor(0.15, 0.17, 0.2);
  for (vtkTextActor* text : { this->Status.Get(), this->Keys.Get() })
  {
    text->GetTextProperty()->SetFontSize(FontSize);
    text->GetTextProperty()->SetLineSpacing(1.15);
    text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  }
  this->Status->GetTextProperty()->SetVerticalJustificationToTop();
  this->Status->SetPosition(0.02, 0.985);
  this->Keys->GetTextProperty()->SetJustificationToCentered();
  this->Keys->SetPosition(0.5, 0.015);
  this->Scale->SetLookupTable(this->Mapper->GetLookupTable());
  this->Scale->SetOrientationToHorizontal();
  this->Scale->UnconstrainedFontSizeOn();
  this->Scale->SetTitleTextProperty(this->Keys->GetTextProperty());
  this->Scale->SetLabelTextProperty(this->Keys->GetTextProperty());
  this->Scale->SetTextPositionToPrecedeScalarBar();
  this->Scale->SetLabelFormat("%.0f");
  this->Scale->SetWidth(0.6);
}

LiveScene::~LiveScene() { this->Leave(); }

//------------------------------------------------------------------------------
void LiveScene::Enter(vtkRenderWindow* window)
{
  this->Leave();
  this->Renderer = window->GetRenderers()->GetFirstRenderer();
  if (!this->Renderer)
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1.0, 1.0, 1.0);
    window->AddRenderer(renderer);
    this->Renderer = renderer;
  }
  this->Renderer->AddViewProp(this->Actor);
  this->Renderer->AddViewProp(this->Scale);
  this->Renderer->AddViewProp(this->Status);
  this->Renderer->AddViewProp(this->Keys);
}

void LiveScene::Leave()
{
  if (this->Renderer)
  {
    this->Renderer->RemoveViewProp(this->Actor);
    this->Renderer->RemoveViewProp(this->Scale);
    this->Renderer->RemoveViewProp(this->Status);
    this->Renderer->RemoveViewProp(this->Keys);
  }
  this->Renderer = nullptr;
}

//------------------------------------------------------------------------------
/// Along the axis in which the mesh is flat, else along z.
void LiveScene::LookAtMesh()
{
  if (this->Renderer->IsActiveCameraCreated() || this->Mapper->GetNumberOfTriangles() == 0)
  {
    return;
  }
  const vtkBoundingBox box(this->Mapper->GetBounds());
  int axis = 2;
  for (const int flat : { 0, 1, 2 })
  {
    axis = box.GetLength(flat) < 1e-3 * box.GetMaxLength() ? flat : axis;
  }
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  double position[3] = { 0.0, 0.0, 0.0 };
  position[axis] = axis == 1 ? -1.0 : 1.0; // so that x points to the right
  camera->SetPosition(position);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, axis == 2 ? 1.0 : 0.0, axis == 2 ? 0.0 : 1.0);
  this->Renderer->ResetCamera();
}

//------------------------------------------------------------------------------
void LiveScene::SetMesh(vtkDataObject* mesh)
{
  vtkNew<vtkPolyData> shown;
  if (vtkPolyData::SafeDownCast(mesh))
  {
    shown->ShallowCopy(mesh);
  }
  else if (mesh)
  {
    vtkNew<vtkAppendPolyData> append;
    append->AddInputData(shown); // so that there is one
    for (vtkPolyData* block : vtkCompositeDataSet::GetDataSets<vtkPolyData>(mesh))
    {
      append->AddInputData(block);
    }
    append->Update();
    shown->ShallowCopy(append->GetOutput());
  }
  this->Mapper->SetInputDataObject(shown);
}

//------------------------------------------------------------------------------
void LiveScene::Draw(vtkDelaunayFlipLiveView* view, int state)
{
  const vtkSmartPointer<vtkRenderWindow> window = this->Renderer->GetRenderWindow();
  const bool isOffScreen = window->GetOffScreenRendering(); // there are no keys, and no timer
  const bool hasFailed = state == vtkDelaunayFlip::STOP_REASON_FAILED;
  const std::string drawing = this->Mapper->GetDrawing();
  const bool isSmall = this->Mapper->GetNumberOfTriangles() < SmallMesh;
  this->Mapper->SetColorBy(view->GetColorBy());
  this->Actor->GetProperty()->SetEdgeVisibility(
    view->GetEdgeVisibility() == vtkDelaunayFlipLiveView::EDGE_VISIBILITY_ON ||
    (view->GetEdgeVisibility() == vtkDelaunayFlipLiveView::EDGE_VISIBILITY_AUTO && isSmall));
  this->Keys->SetVisibility(view->GetShowKeys() && !isOffScreen);
  this->Status->SetVisibility(view->GetShowStatistics() || hasFailed);
  if (this->Status->GetVisibility())
  {
    this->Status->SetInput(
      DescribeStatus(view, this->Mapper, state, view->IsRunning() || isOffScreen).c_str());
  }
  this->Scale->SetVisibility(view->GetColorBy() != vtkDelaunayFlipLiveView::COLOR_BY_SOLID);
  this->Scale->SetTitle(view->GetColorBy() == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT
      ? "flips of a triangle"
      : "smallest angle (degrees)");
  this->ArrangeTexts(hasFailed);
  this->Renderer->ResetCameraClippingRange();
  window->Render();
  if (view->GetShowDrawing() && this->Mapper->GetDrawing() != drawing)
  {
    this->Draw(view, state); // with the text that is right only now
  }
}

/// The keys take as many lines as the width of the renderer needs. The scale is above them, and as
/// high as its labels need.
void LiveScene::ArrangeTexts(bool hasFailed)
{
  constexpr double characterWidth = 6.5; // pixels
  const int* size = this->Renderer->GetSize();
  this->Keys->SetInput(Wrap(KeyHelp, static_cast<std::size_t>(size[0] / characterWidth)).c_str());
  const std::string keys = this->Keys->GetVisibility() ? this->Keys->GetInput() : "";
  const double more = 1.2 * static_cast<double>(std::count(keys.begin(), keys.end(), '\n'));
  const double unit = static_cast<double>(FontSize) / std::max(1, size[1]);
  this->Scale->SetPosition(0.2, unit * (keys.empty() ? 0.4 : 2.0 + more));
  this->Scale->SetHeight(3.6 * unit);

  const double* rgb = this->Renderer->GetBackground();
  const bool isDark = 0.3 * rgb[0] + 0.6 * rgb[1] + 0.1 * rgb[2] < 0.5;
  this->Keys->GetTextProperty()->SetColor(isDark ? LightInk : DarkInk);
  this->Status->GetTextProperty()->SetColor(
    hasFailed ? (isDark ? LightRed : DarkRed) : (isDark ? LightInk : DarkInk));
}

}
