// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveScene.h"

#include "UpdateReport.h"

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace delaunayflip
{

namespace
{

constexpr int FontSize = 14;

constexpr const char* KeyHelp = "space: run/pause, n: next step, b: begin again, "
                                "k: colours, g: edges, i: statistics, d: drawing, q: quit";

using Color = std::array<double, 3>;

constexpr Color PlainColor = { 0.80, 0.86, 0.91 };
constexpr Color DarkInk = { 0.13, 0.19, 0.25 };
constexpr Color LightInk = { 0.92, 0.94, 0.96 };
constexpr Color DarkRed = { 0.75, 0.05, 0.1 };
constexpr Color LightRed = { 1.0, 0.6, 0.55 };

bool IsDark(vtkRenderer* renderer)
{
  const double* rgb = renderer->GetBackground();
  return 0.3 * rgb[0] + 0.6 * rgb[1] + 0.1 * rgb[2] < 0.5;
}

void Paint(vtkTextProperty* text, const double* color)
{
  text->SetColor(color[0], color[1], color[2]);
}

/// The axis along which to look at a mesh: the one along which it is flat, else z.
int GetViewAxis(const double* bounds)
{
  const auto extent = [bounds](int axis) { return bounds[2 * axis + 1] - bounds[2 * axis]; };
  const double largest = std::max({ extent(0), extent(1), extent(2) });
  const auto isFlat = [&](int axis) { return extent(axis) < 1e-3 * largest; };
  return isFlat(2) ? 2 : isFlat(1) ? 1 : isFlat(0) ? 0 : 2;
}

std::string DescribeCounts(vtkDelaunayFlip* filter)
{
  return Count(filter->GetTotalFlips(), "flip") + ", " +
    Count(filter->GetNumberOfNonDelaunayEdges(), "bad edge") + " left";
}

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

std::string DescribeState(const LiveStatus& status)
{
  switch (status.State)
  {
    case LiveState::Failed:
    {
      // If the filter's source failed, the filter itself has no message.
      const std::string reason = status.Filter->GetErrorMessage();
      return Wrap("failed: " + (reason.empty() ? "no input" : reason));
    }
    case LiveState::Converged:
      return "converged";
    case LiveState::Limited:
      return "iteration limit";
    case LiveState::Aborted:
      return "aborted";
    default:
      return status.IsRunning ? "running" : "paused";
  }
}

/// After a failure the filter has no counts, so the text says which frame is shown instead.
std::string DescribeMesh(const LiveStatus& status)
{
  const std::string state = DescribeState(status);
  const std::string triangles = Count(status.Triangles, "triangle");
  if (status.State == LiveState::Failed)
  {
    return state + "\nthe mesh of frame " + Count(status.Frame);
  }
  if (status.Frame == 0)
  {
    return "input, " + state + "\n" + triangles;
  }
  if (!vtkPolyData::SafeDownCast(status.Filter->GetOutputDataObject(0)))
  {
    return "all blocks in one step, " + state + "\n" + DescribeCounts(status.Filter);
  }
  return "iteration " + Count(status.Filter->GetNumberOfIterations()) + ", " + state + "\n" +
    DescribeCounts(status.Filter);
}

std::string DescribeStatus(const LiveStatus& status)
{
  char angle[64] = "";
  if (!std::isnan(status.SmallestAngle))
  {
    std::snprintf(angle, sizeof(angle), "\nsmallest angle %.2f degrees", status.SmallestAngle);
  }
  const std::string drawing = status.Drawing.empty() ? "" : "\n" + Wrap(status.Drawing);
  return DescribeMesh(status) + angle + drawing;
}

}

LiveScene::LiveScene()
{
  this->Actor->SetMapper(this->Mapper);
  this->Actor->PickableOff(); // see vtkDelaunayFlipMapper
  this->Actor->GetProperty()->SetAmbient(0.3);
  this->Actor->GetProperty()->SetDiffuse(0.7);
  this->Actor->GetProperty()->SetColor(PlainColor[0], PlainColor[1], PlainColor[2]);
  this->Actor->GetProperty()->SetEdgeColor(0.15, 0.17, 0.2);
  this->Scale->SetLookupTable(this->Mapper->GetLookupTable());
  this->Scale->SetOrientationToHorizontal();
  this->Scale->UnconstrainedFontSizeOn();
  this->Scale->SetTextPositionToPrecedeScalarBar();
  this->Scale->SetLabelFormat("%.0f");
  this->Scale->SetWidth(0.6);
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
  this->Renderer->AddActor(this->Actor);
  this->Renderer->AddViewProp(this->Scale);
  this->Renderer->AddViewProp(this->Status);
  this->Renderer->AddViewProp(this->Keys);
  const Color& ink = IsDark(this->Renderer) ? LightInk : DarkInk;
  std::copy(ink.begin(), ink.end(), this->Ink);
  Paint(this->Keys->GetTextProperty(), this->Ink);
}

void LiveScene::Leave()
{
  if (this->Renderer)
  {
    this->Renderer->RemoveActor(this->Actor);
    this->Renderer->RemoveViewProp(this->Scale);
    this->Renderer->RemoveViewProp(this->Status);
    this->Renderer->RemoveViewProp(this->Keys);
  }
  this->Renderer = nullptr;
}

//------------------------------------------------------------------------------
void LiveScene::LookAtMesh()
{
  if (this->Renderer->IsActiveCameraCreated() || this->Mapper->GetNumberOfTriangles() == 0)
  {
    return;
  }
  double bounds[6];
  this->Mapper->GetBounds(bounds);
  const int axis = GetViewAxis(bounds);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  double position[3] = { 0.0, 0.0, 0.0 };
  position[axis] = axis == 1 ? -1.0 : 1.0; // so that x points to the right
  camera->SetPosition(position);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, axis == 2 ? 1.0 : 0.0, axis == 2 ? 0.0 : 1.0);
  this->Renderer->ResetCamera();
}

//------------------------------------------------------------------------------
void LiveScene::SetMesh(vtkPolyData* mesh)
{
  vtkNew<vtkPolyData> shown;
  if (mesh)
  {
    shown->ShallowCopy(mesh);
  }
  this->Mapper->SetInputDataObject(shown);
}

/// The first frame is drawn twice: before it there are no buffers.
void LiveScene::SetColorBy(int what)
{
  this->Mapper->SetColorBy(what);
  if (!this->Mapper->Fill())
  {
    this->Renderer->GetRenderWindow()->Render();
  }
  this->Scale->SetVisibility(what != vtkDelaunayFlipMapper::COLOR_BY_SOLID);
  this->ShowScale(what == vtkDelaunayFlipMapper::COLOR_BY_FLIP_COUNT ? "flips of a triangle"
                                                                     : "smallest angle (degrees)");
}

void LiveScene::ShowScale(const char* title)
{
  // Above the lines of keys, if there are any, and as high as the labels need.
  const double height = std::max(1, this->Renderer->GetSize()[1]); // pixels
  const std::string keys = this->Keys->GetVisibility() ? this->Keys->GetInput() : "";
  const double more = 1.2 * static_cast<double>(std::count(keys.begin(), keys.end(), '\n'));
  const double lines = keys.empty() ? 0.4 : 2.0 + more;
  this->Scale->SetPosition(0.2, lines * FontSize / height);
  this->Scale->SetHeight(3.6 * FontSize / height);
  this->Scale->SetTitle(title);
  for (vtkTextProperty* text :
    { this->Scale->GetTitleTextProperty(), this->Scale->GetLabelTextProperty() })
  {
    text->SetFontSize(FontSize);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
    Paint(text, this->Ink);
  }
}

//------------------------------------------------------------------------------
void LiveScene::SetEdgeVisibility(bool visible)
{
  this->Actor->GetProperty()->SetEdgeVisibility(visible);
}

bool LiveScene::GetEdgeVisibility() const
{
  return this->Actor->GetProperty()->GetEdgeVisibility() != 0;
}

void LiveScene::SetStatus(const LiveStatus& status)
{
  const Color& red = IsDark(this->Renderer) ? LightRed : DarkRed;
  this->Status->SetInput(DescribeStatus(status).c_str());
  this->Status->VisibilityOn();
  Paint(
    this->Status->GetTextProperty(), status.State == LiveState::Failed ? red.data() : this->Ink);
}

void LiveScene::HideStatus() { this->Status->VisibilityOff(); }

/// In as many lines as the width of the renderer needs.
void LiveScene::SetKeyVisibility(bool visible)
{
  constexpr double characterWidth = 6.5; // pixels
  const auto width = static_cast<std::size_t>(this->Renderer->GetSize()[0] / characterWidth);
  this->Keys->SetInput(Wrap(KeyHelp, width).c_str());
  this->Keys->SetVisibility(visible);
}

void LiveScene::Draw()
{
  const vtkSmartPointer<vtkRenderWindow> window = this->Renderer->GetRenderWindow();
  this->Renderer->ResetCameraClippingRange();
  window->Render();
}

}
