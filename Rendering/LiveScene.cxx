// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkDelaunayFlipLiveView draws: a mesh, its colour scale, and texts.
#include "vtkDelaunayFlipLiveView.h"

#include "UpdateReport.h"

#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

using namespace delaunayflip;

namespace
{

constexpr int FontSize = 14;
constexpr vtkIdType SmallMesh = 20000; // triangles, up to which edges can be told apart

constexpr double DarkInk[] = { 0.13, 0.19, 0.25 }, LightInk[] = { 0.92, 0.94, 0.96 };
constexpr double Red[] = { 0.85, 0.2, 0.2 };

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

}

vtkStandardNewMacro(vtkDelaunayFlipLiveView);

vtkDelaunayFlipLiveView::vtkDelaunayFlipLiveView()
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

/// Along the axis in which the mesh is flat, else along z.
void vtkDelaunayFlipLiveView::LookAtMesh()
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
  // From below in y, so that x points to the right.
  camera->SetPosition(axis == 0 ? 1.0 : 0.0, axis == 1 ? -1.0 : 0.0, axis == 2 ? 1.0 : 0.0);
  camera->SetViewUp(0.0, axis == 2 ? 1.0 : 0.0, axis == 2 ? 0.0 : 1.0);
  this->Renderer->ResetCamera();
}

/// A mesh, or all blocks of a composite one.
void vtkDelaunayFlipLiveView::ShowMesh(vtkDataObject* mesh)
{
  const auto blocks = vtkCompositeDataSet::GetDataSets<vtkPolyData>(mesh);
  vtkNew<vtkPolyData> shown;
  if (blocks.size() == 1)
  {
    shown->ShallowCopy(blocks.front());
  }
  else
  {
    vtkNew<vtkAppendPolyData> append;
    append->AddInputData(shown); // so that there is one
    for (vtkPolyData* block : blocks)
    {
      append->AddInputData(block);
    }
    append->Update();
    shown->ShallowCopy(append->GetOutput());
  }
  this->Mapper->SetInputDataObject(shown);
}

void vtkDelaunayFlipLiveView::Render()
{
  const vtkSmartPointer<vtkRenderWindow> window = this->Window.Get();
  if (this->IsBusy || !window || !this->Renderer)
  {
    return;
  }
  this->IsBusy = true;
  const bool isOffScreen = window->GetOffScreenRendering(); // there are no keys, and no timer
  const bool isSmall = this->Mapper->GetNumberOfTriangles() < SmallMesh;
  this->Mapper->SetColorBy(this->ColorBy);
  this->Actor->GetProperty()->SetEdgeVisibility(this->EdgeVisibility == EDGE_VISIBILITY_ON ||
    (this->EdgeVisibility == EDGE_VISIBILITY_AUTO && isSmall));
  this->Keys->SetVisibility(this->ShowKeys && !isOffScreen);
  this->Status->SetVisibility(this->ShowStatistics || this->HasFailed);
  this->Scale->SetVisibility(this->ColorBy != COLOR_BY_SOLID);
  this->Scale->SetTitle(
    this->ColorBy == COLOR_BY_FLIP_COUNT ? "flips of a triangle" : "smallest angle (degrees)");
  this->ArrangeTexts();
  this->Renderer->ResetCameraClippingRange();
  std::string drawing;
  do // again if the mapper has chosen another way, so that the text is right
  {
    drawing = this->GetDrawing();
    if (this->Status->GetVisibility())
    {
      this->Status->SetInput(this->DescribeStatus(this->IsRunning() || isOffScreen).c_str());
    }
    window->Render();
  } while (this->ShowDrawing && this->GetDrawing() != drawing);
  this->IsBusy = false;
}

/// The keys take as many lines as the width of the renderer needs. The scale is above them, and as
/// high as its labels need.
void vtkDelaunayFlipLiveView::ArrangeTexts()
{
  constexpr double characterWidth = 6.5; // pixels
  const int* size = this->Renderer->GetSize();
  const std::string keys = Wrap(KeyHelp, static_cast<std::size_t>(size[0] / characterWidth));
  const double more = 1.2 * static_cast<double>(std::count(keys.begin(), keys.end(), '\n'));
  const double unit = static_cast<double>(FontSize) / std::max(1, size[1]);
  this->Keys->SetInput(keys.c_str());
  this->Scale->SetPosition(0.2, unit * (this->Keys->GetVisibility() ? 2.0 + more : 0.4));
  this->Scale->SetHeight(3.6 * unit);
  const double* rgb = this->Renderer->GetBackground();
  const bool isDark = 0.3 * rgb[0] + 0.6 * rgb[1] + 0.1 * rgb[2] < 0.5;
  const double* ink = isDark ? LightInk : DarkInk;
  this->Keys->GetTextProperty()->SetColor(ink);
  this->Status->GetTextProperty()->SetColor(this->HasFailed ? Red : ink);
}

/// Two or three lines. A failure, and how the mesh is drawn, take as many as their reasons need.
std::string vtkDelaunayFlipLiveView::DescribeStatus(bool isRunning)
{
  const std::string drawing = this->ShowDrawing ? "\n" + Wrap(this->GetDrawing()) : "";
  if (this->HasFailed)
  {
    // The filter has no counts now, and no message if it was its source that failed.
    const std::string reason = this->Filter->GetErrorMessage();
    return Wrap("failed: " + (reason.empty() ? "no input" : reason)) + "\nthe mesh of frame " +
      Count(this->FrameNumber) + drawing;
  }
  const bool isInput = this->FrameNumber == 0;
  const bool mayGoOn =
    isInput || this->Filter->GetStopReason() == vtkDelaunayFlip::STOP_REASON_RUNNING;
  const std::string state = !mayGoOn ? this->Filter->GetStopReasonAsString()
    : isRunning                      ? "running"
                                     : "paused";
  const bool isOne = vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0)) != nullptr;
  const std::string mesh = isInput ? "input"
    : isOne                        ? "iteration " + Count(this->Filter->GetNumberOfIterations())
                                   : "all blocks in one step";
  const std::string counts = isInput ? Count(this->Mapper->GetNumberOfTriangles(), "triangle")
                                     : Count(this->Filter->GetTotalFlips(), "flip") + ", " +
      Count(this->Filter->GetNumberOfNonDelaunayEdges(), "bad edge") + " left";
  const FlipReport& report = this->Filter->GetReport();
  const double angle = isInput ? this->Mapper->GetSmallestAngle()
    : report.Triangles > 0     ? report.MinimumAngleAfter
                               : std::nan("");
  char line[64] = "";
  if (!std::isnan(angle))
  {
    std::snprintf(line, sizeof(line), "\nsmallest angle %.2f degrees", angle);
  }
  return mesh + ", " + state + "\n" + counts + line + drawing;
}
