// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveScene.h"

#include "ColorScales.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipLiveView.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkLookupTable.h"
#include "vtkMeshQuality.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <array>
#include <limits>

namespace delaunayflip
{

namespace
{

constexpr const char* QualityName = "Quality"; // as vtkMeshQuality names its array
constexpr const char* CountName = "vtkDelaunayFlipCount";
constexpr int FontSize = 14;

using Color = std::array<double, 3>;

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

const char* GetTitle(int colorBy)
{
  return colorBy == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT ? "flips of a triangle"
                                                                 : "smallest angle (degrees)";
}

/// The axis along which to look at a mesh: the one along which it is flat, else z.
int GetViewAxis(const double* bounds)
{
  const auto extent = [bounds](int axis) { return bounds[2 * axis + 1] - bounds[2 * axis]; };
  const double largest = std::max({ extent(0), extent(1), extent(2) });
  for (const int axis : { 2, 1, 0 })
  {
    if (extent(axis) < 1e-3 * largest)
    {
      return axis;
    }
  }
  return 2;
}

}

LiveScene::LiveScene()
{
  this->Quality->SetInputData(this->Mesh);
  this->Quality->SetTriangleQualityMeasureToMinAngle();
  this->Mapper->SetLookupTable(this->Colors);
  this->Mapper->UseLookupTableScalarRangeOn();
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->Actor->SetMapper(this->Mapper);
  this->Actor->GetProperty()->SetInterpolationToFlat();
  this->Actor->GetProperty()->SetAmbient(0.3);
  this->Actor->GetProperty()->SetDiffuse(0.7);
  this->Actor->GetProperty()->SetColor(PlainColor[0], PlainColor[1], PlainColor[2]);
  this->Actor->GetProperty()->SetEdgeColor(0.15, 0.17, 0.2);
  this->Scale->SetLookupTable(this->Colors);
  this->Scale->SetOrientationToHorizontal();
  this->Scale->UnconstrainedFontSizeOn();
  this->Scale->SetTextPositionToPrecedeScalarBar();
  this->Scale->SetLabelFormat("%.0f");
  this->Scale->SetWidth(0.6);
  this->PlaceTexts();
  this->ColorByNothing();
}

LiveScene::~LiveScene() { this->Leave(); }

//------------------------------------------------------------------------------
void LiveScene::PlaceTexts()
{
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

/// Places the colour scale above the line of keys, if there is one, as high as its labels need.
void LiveScene::PlaceScale()
{
  const double height = std::max(1, this->Renderer->GetSize()[1]); // pixels
  const double lines = this->Keys->GetVisibility() ? 2.0 : 0.4;
  this->Scale->SetPosition(0.2, lines * FontSize / height);
  this->Scale->SetHeight(3.6 * FontSize / height);
}

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
  this->LargestCount = 0.0;
  const Color& ink = IsDark(this->Renderer) ? LightInk : DarkInk;
  std::copy(ink.begin(), ink.end(), this->Ink);
  Paint(this->Keys->GetTextProperty(), this->Ink);
}

void LiveScene::Leave()
{
  this->DeclineRun("no step has been made yet");
  if (this->Renderer)
  {
    this->Renderer->RemoveActor(this->Actor);
    this->Renderer->RemoveViewProp(this->Scale);
    this->Renderer->RemoveViewProp(this->Status);
    this->Renderer->RemoveViewProp(this->Keys);
  }
  this->Renderer = nullptr;
}

vtkRenderer* LiveScene::GetRenderer() const { return this->Renderer; }

//------------------------------------------------------------------------------
void LiveScene::LookAtMesh()
{
  if (this->Renderer->IsActiveCameraCreated() || this->Mesh->GetNumberOfCells() == 0)
  {
    return;
  }
  double bounds[6];
  this->Mesh->GetBounds(bounds);
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
  this->DeclineRun("no step has been made yet");
  this->Mesh->ShallowCopy(mesh);
}

vtkPolyData* LiveScene::GetMesh() const { return this->Mesh; }

//------------------------------------------------------------------------------
void LiveScene::SetColorBy(int what)
{
  this->ColorBy = what;
  if (this->ColorOnDevice(what))
  {
    what == vtkDelaunayFlipLiveView::COLOR_BY_SOLID ? this->Scale->VisibilityOff()
                                                    : this->ShowScale(GetTitle(what));
  }
  else if (what == vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE)
  {
    this->ColorBySmallestAngle();
  }
  else if (what == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT)
  {
    this->ColorByFlipCount();
  }
  else
  {
    this->ColorByNothing();
  }
}

void LiveScene::ColorByNothing()
{
  this->Mapper->SetInputDataObject(this->Mesh);
  this->Mapper->ScalarVisibilityOff();
  this->Scale->VisibilityOff();
}

void LiveScene::ColorBySmallestAngle()
{
  this->Quality->Update();
  this->Mapper->SetInputConnection(this->Quality->GetOutputPort());
  this->Mapper->SelectColorArray(QualityName);
  this->FillTable(vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE);
  this->ShowScale(GetTitle(vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE));
}

/// Only if it must change, since what is drawn with it is then drawn anew.
void LiveScene::FillTable(int what)
{
  if (this->TableKind == what && this->TableCount == this->LargestCount)
  {
    return;
  }
  this->TableKind = what;
  this->TableCount = this->LargestCount;
  if (what == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT)
  {
    FillCountColors(this->Colors, this->LargestCount);
  }
  else
  {
    FillAngleColors(this->Colors);
  }
}

/// The input has no array of counts yet.
void LiveScene::ColorByFlipCount()
{
  this->Mapper->SetInputDataObject(this->Mesh);
  this->Mapper->SelectColorArray(CountName);
  if (vtkDataArray* counts = this->Mesh->GetCellData()->GetArray(CountName))
  {
    this->LargestCount = std::max(this->LargestCount, counts->GetRange()[1]);
  }
  this->FillTable(vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT);
  this->ShowScale(GetTitle(vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT));
}

void LiveScene::ShowScale(const char* title)
{
  this->Mapper->ScalarVisibilityOn();
  this->PlaceScale();
  this->Scale->SetTitle(title);
  this->Scale->VisibilityOn();
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
double LiveScene::GetSmallestAngle()
{
  if (this->DrawsRun())
  {
    return this->Device.GetSmallestAngle();
  }
  this->Quality->Update();
  vtkDataArray* angles = this->Quality->GetOutput()->GetCellData()->GetArray(QualityName);
  if (!angles || angles->GetNumberOfTuples() == 0)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return angles->GetRange()[0];
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

void LiveScene::SetStatus(const std::string& text, bool isError)
{
  const Color& red = IsDark(this->Renderer) ? LightRed : DarkRed;
  this->Status->SetInput(text.c_str());
  this->Status->SetVisibility(!text.empty());
  Paint(this->Status->GetTextProperty(), isError ? red.data() : this->Ink);
}

void LiveScene::SetKeys(const std::string& text)
{
  this->Keys->SetInput(text.c_str());
  this->Keys->SetVisibility(!text.empty());
}

}
