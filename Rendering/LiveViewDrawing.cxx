// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipLiveView.h"

#include "FlipReport.h"
#include "LiveViewSupport.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkPointSet.h"
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

/// @file
/// What vtkDelaunayFlipLiveView draws: a mesh, its colour scale, and texts.

using namespace delaunayflip;

namespace
{

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
  words >> wrapped;
  std::size_t begin = 0; // the last line begins here
  for (std::string word; words >> word; wrapped += word)
  {
    const bool fits = wrapped.size() - begin + 1 + word.size() <= width;
    if (fits)
    {
      wrapped += ' ';
    }
    else
    {
      wrapped += '\n';
      begin = wrapped.size();
    }
  }
  return wrapped;
}

/// A line about the smallest angle; "" if it is NaN.
std::string DescribeAngle(double degrees)
{
  if (std::isnan(degrees))
  {
    return "";
  }
  char line[64];
  std::snprintf(line, sizeof(line), "\nsmallest angle %.2f degrees", degrees);
  return line;
}

}

/// Looks along the axis in which the mesh, or the points of one, are flat, else along z.
void vtkDelaunayFlipLiveView::LookAtMesh()
{
  vtkBoundingBox box(this->Mapper->GetBounds());
  if (vtkPointSet* points = FindPoints(this->Filter))
  {
    box.SetBounds(points->GetBounds());
  }
  const bool isUsable = box.IsValid() && std::isfinite(box.GetDiagonalLength());
  if (this->Renderer->IsActiveCameraCreated() || !isUsable)
  {
    return;
  }
  int axis = 2;
  for (const int flat : { 0, 1, 2 })
  {
    if (box.GetLength(flat) < 1e-3 * box.GetMaxLength())
    {
      axis = flat;
    }
  }
  // It looks from below in y, so that x points to the right.
  constexpr double positions[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, -1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  constexpr double ups[3][3] = { { 0.0, 0.0, 1.0 }, { 0.0, 0.0, 1.0 }, { 0.0, 1.0, 0.0 } };
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(positions[axis]);
  camera->SetViewUp(ups[axis]);
  double bounds[6];
  this->Renderer->ComputeVisiblePropBounds(bounds);
  const vtkBoundingBox others(bounds);
  if (others.IsValid())
  {
    box.AddBox(others);
  }
  box.GetBounds(bounds);
  this->Renderer->ResetCamera(bounds);
}

/// Shows a mesh, or all blocks of a composite one.
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
      if (vtkDelaunayFlipMapper::CanDraw(block))
      {
        append->AddInputData(block);
      }
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
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  const auto busy = Raise(this->IsBusy);
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
  } while (this->Window && this->ShowDrawing && this->GetDrawing() != drawing);
}

/// The keys take as many lines as the width of the renderer needs. The scale is above them.
void vtkDelaunayFlipLiveView::ArrangeTexts()
{
  constexpr double characterWidth = 6.5; // pixels
  const int* size = this->Renderer->GetSize();
  const std::string keys = Wrap(KeyHelp, static_cast<std::size_t>(size[0] / characterWidth));
  const double more = 1.2 * static_cast<double>(std::count(keys.begin(), keys.end(), '\n'));
  const double unit = static_cast<double>(FontSize) / std::max(1, size[1]);
  this->Keys->SetInput(keys.c_str());
  const double lines = this->Keys->GetVisibility() ? 2.0 + more : 0.4; // below the scale
  this->Scale->SetPosition(0.2, unit * lines);
  this->Scale->SetHeight(3.6 * unit);
  const double* rgb = this->Renderer->GetBackground();
  const bool isDark = 0.3 * rgb[0] + 0.6 * rgb[1] + 0.1 * rgb[2] < 0.5;
  const double* ink = isDark ? LightInk : DarkInk;
  this->Keys->GetTextProperty()->SetColor(ink);
  this->Status->GetTextProperty()->SetColor(this->HasFailed ? Red : ink);
}

/// Describes the frame in two or three lines. A failure, and how the mesh is drawn, take as many as
/// their reasons need.
std::string vtkDelaunayFlipLiveView::DescribeStatus(bool isRunning)
{
  std::string text;
  if (this->HasFailed)
  {
    text = this->DescribeFailure();
  }
  else if (this->FrameNumber == 0)
  {
    const std::string state = isRunning ? "running" : "paused";
    text = "input, " + state + "\n";
    if (vtkPointSet* points = FindPoints(this->Filter))
    {
      text += Count(points->GetNumberOfPoints(), "point");
    }
    else
    {
      text += Count(this->Mapper->GetNumberOfTriangles(), "triangle") +
        DescribeAngle(this->Mapper->GetSmallestAngle());
    }
  }
  else
  {
    text = this->DescribeStep(isRunning);
  }
  if (this->ShowDrawing)
  {
    text += "\n" + Wrap(this->GetDrawing());
  }
  return text;
}

/// The filter has no counts now, and no message if it was its source that failed.
std::string vtkDelaunayFlipLiveView::DescribeFailure() const
{
  std::string reason = this->Filter->GetErrorMessage();
  if (reason.empty())
  {
    reason = "no input";
  }
  return Wrap("failed: " + reason) + "\nthe mesh of frame " + Count(this->FrameNumber);
}

std::string vtkDelaunayFlipLiveView::DescribeStep(bool isRunning) const
{
  std::string state = isRunning ? "running" : "paused";
  if (this->Filter->GetStopReason() != vtkDelaunayFlip::STOP_REASON_RUNNING)
  {
    state = this->Filter->GetStopReasonAsString();
  }
  const FlipReport& report = this->Filter->GetReport();
  std::string mesh = "all blocks in one step";
  if (report.FromPoints.MoveRounds > 0)
  {
    mesh = "moved in " + Count(report.FromPoints.MoveRounds, "round");
  }
  else if (vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0)))
  {
    mesh = "iteration " + Count(this->Filter->GetNumberOfIterations());
  }
  const std::string angle =
    report.Triangles > 0 ? DescribeAngle(report.MinimumAngleAfter) : std::string();
  return mesh + ", " + state + "\n" + Count(this->Filter->GetTotalFlips(), "flip") + ", " +
    Count(this->Filter->GetNonDelaunayAfter(), "bad edge") + " left" + angle;
}
