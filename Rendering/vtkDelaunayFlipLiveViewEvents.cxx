// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The timer and the keys of vtkDelaunayFlipLiveView.

#include "vtkDelaunayFlipLiveView.h"

#include "LiveScene.h"

#include "vtkCommand.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSmartPointer.h"

#include <map>
#include <string>

using namespace delaunayflip;

//------------------------------------------------------------------------------
void vtkDelaunayFlipLiveView::StartTimer()
{
  if (!this->IsRunning() && this->AwaitStep())
  {
    this->Render();
    this->InvokeEvent(vtkCommand::StartEvent);
  }
}

/// Uses one-shot timers, so that none has to be destroyed: VTK 9.1 crashes if a timer is destroyed
/// while timers fire.
bool vtkDelaunayFlipLiveView::AwaitStep()
{
  this->TimerId = this->Interactor
    ? this->Interactor->CreateOneShotTimer(static_cast<unsigned long>(this->FrameInterval))
    : 0;
  if (this->TimerId == 0)
  {
    vtkErrorMacro("The interactor has no timer.");
  }
  return this->TimerId != 0;
}

/// A timer that was already started still fires, and is ignored.
void vtkDelaunayFlipLiveView::StopTimer() { this->TimerId = 0; }

bool vtkDelaunayFlipLiveView::IsRunning() const { return this->TimerId != 0 && this->Interactor; }

//------------------------------------------------------------------------------
void vtkDelaunayFlipLiveView::OnTimer(vtkObject*, unsigned long, void* id)
{
  const int awaited = this->TimerId;
  if (!this->IsRunning() || (id && *static_cast<const int*>(id) != awaited))
  {
    return;
  }
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  if (!this->IsBusy)
  {
    this->TakeStep();
  }
  if (this->TimerId == awaited && this->Interactor)
  {
    this->AwaitStep();
  }
}

//------------------------------------------------------------------------------
bool vtkDelaunayFlipLiveView::OnKey(vtkObject*, unsigned long event, void*)
{
  using Self = vtkDelaunayFlipLiveView;
  static const std::map<std::string, void (*)(Self*)> actions = {
    { "space", [](Self* self) { self->IsRunning() ? self->Pause() : self->Run(); } },
    { "n", [](Self* self) { self->Step(); } },
    { "b", [](Self* self) { self->Restart(); } },
    { "k", [](Self* self) { self->CycleColors(); } },
    { "g", [](Self* self) { self->ToggleEdges(); } },
    { "i", [](Self* self) { self->ToggleStatistics(); } },
    { "d", [](Self* self) { self->ToggleDrawing(); } },
  };
  const char* key = this->Interactor->GetKeySym();
  const auto action = actions.find(key ? key : "");
  if (action == actions.end() || this->Interactor->GetControlKey())
  {
    return false;
  }
  if (event == vtkCommand::KeyPressEvent)
  {
    const vtkSmartPointer<Self> self(this); // An observer may drop it.
    action->second(this);
  }
  return true;
}

void vtkDelaunayFlipLiveView::CycleColors()
{
  this->SetColorBy((this->ColorBy + 1) % (COLOR_BY_FLIP_COUNT + 1));
  this->Render();
}

void vtkDelaunayFlipLiveView::ToggleEdges()
{
  const bool areShown = this->Scene->GetEdgeVisibility();
  this->SetEdgeVisibility(areShown ? EDGE_VISIBILITY_OFF : EDGE_VISIBILITY_ON);
  this->Render();
}

void vtkDelaunayFlipLiveView::ToggleStatistics()
{
  this->SetShowStatistics(!this->ShowStatistics);
  this->Render();
}

void vtkDelaunayFlipLiveView::ToggleDrawing()
{
  this->SetShowDrawing(!this->ShowDrawing);
  this->Render();
}
