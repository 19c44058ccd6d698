// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The part of LiveScene that draws without copies.

#include "LiveScene.h"

#include "ColorScales.h"
#include "ShownMesh.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipLiveView.h"

#include "vtkActor.h"
#include "vtkLookupTable.h"
#include "vtkMeshQuality.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"

#include <algorithm>

namespace delaunayflip
{

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
/// @returns whether the device draws, with these colours.
bool LiveScene::ColorOnDevice(int what)
{
  if (this->Run && !this->DrawsRun())
  {
    const vtkSmartPointer<vtkDelaunayFlip> filter = this->Run;
    this->Device.Begin(this->Renderer->GetRenderWindow(), this->Actor, filter);
    this->Run = this->DrawsRun() ? filter : nullptr;
  }
  const bool isDone = this->DrawsRun() &&
    this->Device.Fill({ what,
      { what == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT,
        [this, what](double largestCount) { return this->ChooseColors(what, largestCount); } } });
  if (this->DrawsRun() && !isDone)
  {
    this->LeaveDevice();
  }
  return isDone;
}

ColorBands LiveScene::ChooseColors(int what, double largestCount)
{
  if (what == vtkDelaunayFlipLiveView::COLOR_BY_SOLID)
  {
    return MakePlainBands();
  }
  this->LargestCount = std::max(this->LargestCount, largestCount);
  this->FillTable(what);
  return GetBands(this->Colors);
}

/// Shows the mesh of the run from a copy.
void LiveScene::LeaveDevice()
{
  const std::string reason = this->Device.GetFailure();
  if (const vtkSmartPointer<vtkPolyData> mesh = CopyRun(this->Run))
  {
    this->SetMesh(mesh);
  }
  this->DeclineRun(reason);
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
