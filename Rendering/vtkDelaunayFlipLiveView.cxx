// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipLiveView.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <cstdio>
#include <fstream>
#include <map>

using namespace delaunayflip;

namespace
{

/// Writes the picture in a window to a PNG file. Encodes it in memory first, because VTK's writer
/// does not report a full disk.
/// @returns whether the whole file could be written.
bool WriteFrame(vtkRenderWindow* window, const std::string& fileName)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (!bytes || bytes->GetNumberOfValues() == 0)
  {
    return false;
  }
  std::ofstream file(fileName, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->GetPointer(0)),
    static_cast<std::streamsize>(bytes->GetNumberOfValues()));
  file.close();
  return file.good();
}

}

vtkStandardNewMacro(vtkDelaunayFlipLiveView);

vtkDelaunayFlipLiveView::vtkDelaunayFlipLiveView()
  : State(vtkDelaunayFlip::STOP_REASON_NOT_STARTED)
{
  this->MakeScene();
}

vtkDelaunayFlipLiveView::~vtkDelaunayFlipLiveView() { this->Detach(); }

void vtkDelaunayFlipLiveView::SetFilter(vtkDelaunayFlip* filter)
{
  if (this->Filter != filter)
  {
    this->Detach();
    this->Filter = filter;
    this->Modified();
  }
}

vtkDelaunayFlip* vtkDelaunayFlipLiveView::GetFilter() const { return this->Filter; }

void vtkDelaunayFlipLiveView::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  if (this->Interactor != interactor)
  {
    this->Detach();
    this->Interactor = interactor;
    this->Modified();
  }
}

vtkRenderWindowInteractor* vtkDelaunayFlipLiveView::GetInteractor() const
{
  return this->Interactor;
}

void vtkDelaunayFlipLiveView::SetFramePrefix(const char* prefix)
{
  this->FramePrefix = prefix ? prefix : "";
  this->CanWrite = true;
  this->Modified();
}

void vtkDelaunayFlipLiveView::Start()
{
  if (!this->IsBusy && this->IsReady())
  {
    this->Detach();
    this->Attach();
    this->ShowInput();
  }
}

bool vtkDelaunayFlipLiveView::IsReady()
{
  const bool hasInput = this->Filter && this->Filter->GetNumberOfInputConnections(0) > 0;
  const bool isReady = hasInput && this->Interactor && this->Interactor->GetRenderWindow();
  if (!isReady)
  {
    vtkErrorMacro("A filter with an input and an interactor with a render window are needed.");
  }
  return isReady;
}

bool vtkDelaunayFlipLiveView::HasStarted() const
{
  return this->State != vtkDelaunayFlip::STOP_REASON_NOT_STARTED && this->Window;
}

bool vtkDelaunayFlipLiveView::BeginIfNeeded()
{
  if (!this->HasStarted())
  {
    this->Start();
  }
  return !this->IsBusy && this->HasStarted();
}

void vtkDelaunayFlipLiveView::Attach()
{
  this->Window = this->Interactor->GetRenderWindow();
  this->EnterWindow();
  // Called before the interactor styles, which do not receive events handled here.
  constexpr float priority = 1.0f;
  using Self = vtkDelaunayFlipLiveView;
  this->Observers = {
    this->Interactor->AddObserver(vtkCommand::TimerEvent, this, &Self::OnTimer),
    this->Interactor->AddObserver(vtkCommand::KeyPressEvent, this, &Self::OnKey, priority),
    this->Interactor->AddObserver(vtkCommand::CharEvent, this, &Self::OnKey, priority),
  };
}

void vtkDelaunayFlipLiveView::Detach()
{
  this->TimerId = 0;
  if (this->Interactor)
  {
    for (const unsigned long observer : this->Observers)
    {
      this->Interactor->RemoveObserver(observer);
    }
  }
  this->Observers.clear();
  this->LeaveWindow();
  this->State = vtkDelaunayFlip::STOP_REASON_NOT_STARTED;
  this->FrameNumber = -1;
  this->IsMeantToRun = false;
  this->CanWrite = true;
}

void vtkDelaunayFlipLiveView::ShowInput()
{
  vtkAlgorithmOutput* source = this->Filter->GetInputConnection(0, 0);
  source->GetProducer()->Update(source->GetIndex());
  vtkDataObject* input = this->Filter->GetInputDataObject(0, 0);
  this->Filter->SetLiveUpdate(!vtkCompositeDataSet::SafeDownCast(input));
  this->Filter->GenerateFlipCountOn();
  this->Filter->Restart();
  this->State = vtkDelaunayFlip::STOP_REASON_RUNNING;
  this->Mapper->SetFilter(nullptr);
  this->ShowMesh(input);
  this->LookAtMesh();
  this->ShowFrame(0);
}

void vtkDelaunayFlipLiveView::Run()
{
  if (this->BeginIfNeeded())
  {
    this->IsMeantToRun = true;
    this->StartTimer();
  }
}

void vtkDelaunayFlipLiveView::Pause()
{
  this->IsMeantToRun = false;
  this->TimerId = 0;
  this->Render();
}

bool vtkDelaunayFlipLiveView::Step()
{
  this->IsMeantToRun = false;
  this->TimerId = 0;
  return this->BeginIfNeeded() && this->TakeStep();
}

void vtkDelaunayFlipLiveView::Restart()
{
  if (!this->HasStarted())
  {
    this->Start();
  }
  else if (!this->IsBusy && this->IsReady())
  {
    this->TimerId = 0;
    this->ShowInput();
    if (this->IsMeantToRun)
    {
      this->StartTimer();
    }
  }
}

/// Makes a step without putting the mesh out, if the mapper can do without. An update follows the
/// last step, so that the output is then the final mesh. An update that is caused only by a change
/// of the input or of an option is a step too.
bool vtkDelaunayFlipLiveView::TakeStep()
{
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  const vtkSmartPointer<vtkDelaunayFlip> filter = this->Filter;
  const vtkMTimeType before = filter->GetOutputDataObject(0)->GetUpdateTime();
  this->IsBusy = true;
  this->Mapper->SetZeroCopy(this->ZeroCopy);
  this->Mapper->BeginStep();
  bool works = true;
  if (this->Mapper->DrawsRun())
  {
    works = filter->AdvanceSession();
  }
  else
  {
    filter->Advance();
    works = filter->GetExecutive()->Update(0) != 0;
  }
  const int state = works ? filter->GetStopReason() : vtkDelaunayFlip::STOP_REASON_FAILED;
  const bool hasFailed = state == vtkDelaunayFlip::STOP_REASON_FAILED;
  const bool isNew = filter->GetOutputDataObject(0)->GetUpdateTime() != before;
  const bool isUnderWay = state == vtkDelaunayFlip::STOP_REASON_RUNNING;
  const bool goesOn = isNew && (isUnderWay || state == vtkDelaunayFlip::STOP_REASON_ABORTED);
  if (!goesOn && !hasFailed)
  {
    filter->GetExecutive()->Update(0); // puts the mesh out, if the step has not
  }
  this->IsBusy = false;
  if (this->State == vtkDelaunayFlip::STOP_REASON_NOT_STARTED)
  {
    return false; // An observer of the filter has ended the run.
  }
  const bool isEnd = !goesOn && (isNew || hasFailed || this->IsRunning());
  this->TimerId = isNew && isUnderWay ? this->TimerId : 0;
  this->State = isNew || hasFailed ? state : this->State;
  if (isNew && !hasFailed)
  {
    if (!filter->GetMeshIsWithheld())
    {
      this->ShowMesh(filter->GetOutputDataObject(0));
      this->Mapper->SetFilter(filter->GetSession() ? filter.Get() : nullptr);
    }
    this->Mapper->EndStep();
    this->ShowFrame(this->FrameNumber + 1);
  }
  else
  {
    this->Render(); // the last mesh
  }
  if (isEnd)
  {
    this->InvokeEvent(vtkCommand::EndEvent);
  }
  return goesOn;
}

void vtkDelaunayFlipLiveView::ShowFrame(int number)
{
  this->FrameNumber = number;
  this->Render();
  if (!this->FramePrefix.empty() && this->CanWrite && this->Window)
  {
    char name[32];
    std::snprintf(name, sizeof(name), "%04d.png", number);
    this->IsBusy = true;
    this->CanWrite = WriteFrame(this->Window, this->FramePrefix + name);
    this->IsBusy = false;
    if (!this->CanWrite)
    {
      vtkErrorMacro(
        "Cannot write " << this->FramePrefix << name << "; no more frames are written.");
    }
  }
  this->InvokeEvent(vtkCommand::UpdateEvent);
}

void vtkDelaunayFlipLiveView::Render()
{
  if (!this->IsBusy && this->Window && this->Renderer)
  {
    this->IsBusy = true;
    this->Draw();
    this->IsBusy = false;
  }
}

std::string vtkDelaunayFlipLiveView::GetDrawing() const { return this->Mapper->GetDrawing(); }

bool vtkDelaunayFlipLiveView::GetConverged() const
{
  return this->State == vtkDelaunayFlip::STOP_REASON_CONVERGED;
}

vtkRenderer* vtkDelaunayFlipLiveView::GetRenderer() const { return this->Renderer; }

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

bool vtkDelaunayFlipLiveView::IsRunning() const { return this->TimerId != 0 && this->Interactor; }

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

bool vtkDelaunayFlipLiveView::OnKey(vtkObject*, unsigned long event, void*)
{
  using Self = vtkDelaunayFlipLiveView;
  static const std::map<std::string, void (*)(Self*)> actions = {
    { "space", [](Self* self) { self->IsRunning() ? self->Pause() : self->Run(); } },
    { "n", [](Self* self) { self->Step(); } },
    { "b", [](Self* self) { self->Restart(); } },
    { "k", [](Self* self) { self->SetColorBy((self->ColorBy + 1) % (COLOR_BY_FLIP_COUNT + 1)); } },
    { "g",
      [](Self* self)
      {
        const bool areShown = self->Actor->GetProperty()->GetEdgeVisibility() != 0;
        self->SetEdgeVisibility(areShown ? EDGE_VISIBILITY_OFF : EDGE_VISIBILITY_ON);
      } },
    { "i", [](Self* self) { self->SetShowStatistics(!self->ShowStatistics); } },
    { "d", [](Self* self) { self->SetShowDrawing(!self->ShowDrawing); } },
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
    this->Render();
  }
  return true;
}

void vtkDelaunayFlipLiveView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Filter: " << this->Filter << "\n";
  os << indent << "Interactor: " << this->Interactor << "\n";
  os << indent << "ColorBy: " << this->ColorBy << "\n";
  os << indent << "EdgeVisibility: " << this->EdgeVisibility << "\n";
  os << indent << "ShowStatistics: " << this->ShowStatistics << "\n";
  os << indent << "ShowKeys: " << this->ShowKeys << "\n";
  os << indent << "ZeroCopy: " << this->ZeroCopy << "\n";
  os << indent << "ShowDrawing: " << this->ShowDrawing << "\n";
  os << indent << "FrameInterval: " << this->FrameInterval << "\n";
  os << indent << "FramePrefix: " << this->FramePrefix << "\n";
  os << indent << "FrameNumber: " << this->FrameNumber << "\n";
}
