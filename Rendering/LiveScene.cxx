// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveScene.h"

#include "LiveRun.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipLiveView.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
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
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace delaunayflip
{

namespace
{

constexpr const char* QualityName = "Quality"; // as vtkMeshQuality names its array
constexpr const char* CountName = "vtkDelaunayFlipCount";
constexpr int FontSize = 14;

using Color = std::array<double, 3>;

constexpr Color PlainColor = { 0.80, 0.86, 0.91 }; ///< As PlainBytes.
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

/// Fills the table, for 0 to `largest`, with twelve bands of colours interpolated between `stops`.
void FillColors(vtkLookupTable* table, const std::vector<Color>& stops, double largest)
{
  constexpr int bands = 12;
  vtkNew<vtkColorTransferFunction> function;
  for (std::size_t i = 0; i < stops.size(); ++i)
  {
    const double x = static_cast<double>(i) / static_cast<double>(stops.size() - 1);
    function->AddRGBPoint(x, stops[i][0], stops[i][1], stops[i][2]);
  }
  table->SetNumberOfTableValues(bands);
  for (int i = 0; i < bands; ++i)
  {
    const double* rgb = function->GetColor(static_cast<double>(i) / (bands - 1));
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetRange(0.0, largest);
}

/// The colours of a table for a GPU.
ColorBands GetBands(vtkLookupTable* table)
{
  ColorBands bands;
  bands.Colors.resize(static_cast<std::size_t>(table->GetNumberOfTableValues()));
  std::memcpy(bands.Colors.data(), table->GetPointer(0), 4 * bands.Colors.size());
  bands.First = table->GetRange()[0];
  bands.Last = table->GetRange()[1];
  std::memcpy(&bands.OfNaN, table->GetNanColorAsUnsignedChars(), sizeof(bands.OfNaN));
  return bands;
}

/// A single colour for all values.
ColorBands MakePlainBands()
{
  ColorBands bands;
  bands.Colors.resize(1);
  std::memcpy(bands.Colors.data(), PlainBytes.data(), PlainBytes.size());
  bands.OfNaN = bands.Colors[0];
  return bands;
}

/// The axis along which to look at a mesh: the one along which it is flat, else z.
int GetViewAxis(const double* bounds)
{
  const auto extent = [bounds](int axis) { return bounds[2 * axis + 1] - bounds[2 * axis]; };
  const double largest = std::max({ extent(0), extent(1), extent(2) });
  const auto isFlat = [&](int axis) { return extent(axis) < 1e-3 * largest; };
  return isFlat(2) ? 2 : isFlat(1) ? 1 : isFlat(0) ? 0 : 2;
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
  this->Mapper->SetInputDataObject(this->Mesh);
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

//------------------------------------------------------------------------------
void LiveScene::SetColorBy(int what)
{
  const bool byAngle = what == vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE;
  const bool byCount = what == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT;
  this->ColorBy = what;
  if (!this->ColorOnDevice(what))
  {
    this->Mapper->SetScalarVisibility(byAngle || byCount);
    this->Mapper->SelectColorArray(byAngle ? QualityName : CountName);
    if (byAngle)
    {
      this->Quality->Update();
      this->Mapper->SetInputConnection(this->Quality->GetOutputPort());
    }
    else
    {
      this->Mapper->SetInputDataObject(this->Mesh);
    }
    vtkDataArray* counts = this->Mesh->GetCellData()->GetArray(CountName);
    if (byCount && counts) // the input has none yet
    {
      this->LargestCount = std::max(this->LargestCount, counts->GetRange()[1]);
    }
    this->FillTable(what);
  }
  this->Scale->SetVisibility(byAngle || byCount);
  if (byAngle || byCount)
  {
    this->ShowScale(byCount ? "flips of a triangle" : "smallest angle (degrees)");
  }
}

/// Only if it must change, since what is drawn with it is then drawn anew.
void LiveScene::FillTable(int what)
{
  if (what == vtkDelaunayFlipLiveView::COLOR_BY_SOLID ||
    (this->TableKind == what && this->TableCount == this->LargestCount))
  {
    return;
  }
  this->TableKind = what;
  this->TableCount = this->LargestCount;
  if (what == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT)
  {
    // From nearly white to dark violet. The range is 0 to the largest count, rounded up to a
    // multiple of four for whole labels at its quarters, and at least 12.
    FillColors(this->Colors,
      { { 0.96, 0.95, 0.98 }, { 0.80, 0.81, 0.91 }, { 0.62, 0.60, 0.80 }, { 0.46, 0.32, 0.66 },
        { 0.25, 0.0, 0.49 } },
      4.0 * std::ceil(std::max(this->LargestCount, 12.0) / 4.0));
  }
  else
  {
    // 0 to 60 degrees in steps of five: from red for slivers to blue for equilateral triangles.
    FillColors(this->Colors,
      { { 0.70, 0.09, 0.17 }, { 0.94, 0.54, 0.38 }, { 0.99, 0.86, 0.78 }, { 0.82, 0.90, 0.94 },
        { 0.40, 0.66, 0.81 }, { 0.13, 0.40, 0.67 } },
      60.0);
  }
}

void LiveScene::ShowScale(const char* title)
{
  // Above the line of keys, if there is one, and as high as the labels need.
  const double height = std::max(1, this->Renderer->GetSize()[1]); // pixels
  const double lines = this->Keys->GetVisibility() ? 2.0 : 0.4;
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

//------------------------------------------------------------------------------
void LiveScene::OfferRun(vtkDelaunayFlip* filter)
{
  this->DeclineRun("");
  this->Run = filter;
}

bool LiveScene::TakeNextRun(vtkDelaunayFlip* filter, vtkPolyData* mesh)
{
  const bool isTaken = this->DrawsRun() && this->Run == filter && this->Device.TakeNextRun();
  if (isTaken)
  {
    this->Mesh->ShallowCopy(mesh);
  }
  return isTaken;
}

void LiveScene::DeclineRun(const std::string& reason)
{
  this->Device.End(reason);
  this->Run = nullptr;
}

std::string LiveScene::DescribeDrawing() const
{
  return this->DrawsRun() ? "drawn without copies"
                          : "drawn from copies: " + this->Device.GetObstacle();
}

//------------------------------------------------------------------------------
/// @returns whether the device draws, with these colours. If it no longer can, the mesh of the run
/// is shown from a copy.
bool LiveScene::ColorOnDevice(int what)
{
  if (this->Run && !this->DrawsRun())
  {
    const vtkSmartPointer<vtkDelaunayFlip> filter = this->Run;
    this->Device.Begin(this->Renderer->GetRenderWindow(), this->Actor, filter);
    this->Run = this->DrawsRun() ? filter : nullptr;
  }
  if (!this->DrawsRun())
  {
    return false;
  }
  const auto choose = [this, what](double largestCount)
  {
    if (what == vtkDelaunayFlipLiveView::COLOR_BY_SOLID)
    {
      return MakePlainBands();
    }
    this->LargestCount = std::max(this->LargestCount, largestCount);
    this->FillTable(what);
    return GetBands(this->Colors);
  };
  if (this->Device.Fill(what, { what == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT, choose }))
  {
    return true;
  }
  const std::string reason = this->Device.GetFailure();
  if (const vtkSmartPointer<vtkPolyData> mesh = CopyRun(this->Run))
  {
    this->SetMesh(mesh);
  }
  this->DeclineRun(reason);
  return false;
}

//------------------------------------------------------------------------------
void LiveScene::Draw()
{
  this->Device.SetQuiet(true);
  this->Renderer->ResetCameraClippingRange();
  this->Device.SetQuiet(false);
  const vtkSmartPointer<vtkRenderWindow> window = this->Renderer->GetRenderWindow();
  window->Render();
  if (this->DrawsRun() && !this->Device.GetFailure().empty())
  {
    this->SetColorBy(this->ColorBy);
    window->Render();
  }
}

}
