// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipLiveView.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkExecutive.h"
#include "vtkPNGWriter.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
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
  if (!bytes)
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
  if (this->IsBusy)
  {
    return;
  }
  const bool hasInput = this->Filter && this->Filter->GetNumberOfInputConnections(0) > 0;
  if (!hasInput || !this->Interactor || !this->Interactor->GetRenderWindow())
  {
    vtkErrorMacro("A filter with an input and an interactor with a render window are needed.");
    return;
  }
  this->Detach();
  this->Attach();
  vtkAlgorithmOutput* source = this->Filter->GetInputConnection(0, 0);
  source->GetProducer()->Update(source->GetIndex());
  vtkDataObject* input = this->Filter->GetInputDataObject(0, 0);
  this->Filter->SetLiveUpdate(!vtkCompositeDataSet::SafeDownCast(input));
  this->Filter->GenerateFlipCountOn();
  this->Filter->Restart();
  this->HasFailed = false;
  this->Mapper->SetFilter(nullptr);
  this->ShowMesh(input);
  this->LookAtMesh();
  this->ShowFrame(0);
}

bool vtkDelaunayFlipLiveView::BeginIfNeeded()
{
  if (!this->Window)
  {
    this->Start();
  }
  return !this->IsBusy && this->Window;
}

/// Draws in the first renderer of the window, or in a new one if it has none.
void vtkDelaunayFlipLiveView::Attach()
{
  this->Window = this->Interactor->GetRenderWindow();
  this->Renderer = this->Window->GetRenderers()->GetFirstRenderer();
  if (!this->Renderer)
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1.0, 1.0, 1.0);
    this->Window->AddRenderer(renderer);
    this->Renderer = renderer;
  }
  this->Renderer->AddViewProp(this->Actor);
  this->Renderer->AddViewProp(this->Scale);
  this->Renderer->AddViewProp(this->Status);
  this->Renderer->AddViewProp(this->Keys);
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
  if (this->Interactor)
  {
    for (const unsigned long observer : this->Observers)
    {
      this->Interactor->RemoveObserver(observer);
    }
  }
  if (this->Renderer)
  {
    this->Renderer->RemoveViewProp(this->Actor);
    this->Renderer->RemoveViewProp(this->Scale);
    this->Renderer->RemoveViewProp(this->Status);
    this->Renderer->RemoveViewProp(this->Keys);
  }
  this->Observers.clear();
  this->Renderer = nullptr;
  this->Window = nullptr;
  this->TimerId = 0;
  this->FrameNumber = -1;
  this->IsMeantToRun = false;
  this->CanWrite = true;
}

void vtkDelaunayFlipLiveView::Run()
{
  if (this->BeginIfNeeded())
  {
    this->IsMeantToRun = true;
    if (!this->IsRunning() && this->AwaitStep())
    {
      this->Render();
      this->InvokeEvent(vtkCommand::StartEvent);
    }
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
  const bool wasMeantToRun = this->IsMeantToRun;
  this->Start();
  if (wasMeantToRun)
  {
    this->Run();
  }
}

/// Makes a step, and puts the mesh out if the mapper cannot do without or the step is the last. An
/// update that is caused only by a change of the input or of an option is a step too.
bool vtkDelaunayFlipLiveView::TakeStep()
{
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  const vtkSmartPointer<vtkDelaunayFlip> filter = this->Filter;
  const vtkMTimeType before = filter->GetOutputDataObject(0)->GetUpdateTime();
  this->IsBusy = true;
  this->Mapper->SetZeroCopy(this->ZeroCopy);
  this->Mapper->BeginStep();
  const bool works = filter->AdvanceSession();
  const int state = works ? filter->GetStopReason() : vtkDelaunayFlip::STOP_REASON_FAILED;
  const bool hasFailed = state == vtkDelaunayFlip::STOP_REASON_FAILED;
  const bool isNew = filter->GetOutputDataObject(0)->GetUpdateTime() != before;
  const bool isUnderWay = isNew && state == vtkDelaunayFlip::STOP_REASON_RUNNING;
  const bool goesOn = isUnderWay || (isNew && state == vtkDelaunayFlip::STOP_REASON_ABORTED);
  if (!hasFailed && !(goesOn && this->Mapper->DrawsRun()))
  {
    filter->GetExecutive()->Update(0); // puts the mesh out, if the step has not
  }
  this->IsBusy = false;
  if (!this->Window)
  {
    return false; // An observer of the filter has ended the run.
  }
  const bool isEnd = !goesOn && (isNew || hasFailed || this->IsRunning());
  this->TimerId = isUnderWay ? this->TimerId : 0;
  this->HasFailed = hasFailed;
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
    this->CanWrite = WriteFrame(this->Window, this->FramePrefix + name);
    if (!this->CanWrite)
    {
      vtkErrorMacro(
        "Cannot write " << this->FramePrefix << name << "; no more frames are written.");
    }
  }
  this->InvokeEvent(vtkCommand::UpdateEvent);
}

std::string vtkDelaunayFlipLiveView::GetDrawing() const { return this->Mapper->GetDrawing(); }

bool vtkDelaunayFlipLiveView::GetConverged() const
{
  return this->FrameNumber > 0 && !this->HasFailed && this->Filter->GetConverged();
}

vtkRenderer* vtkDelaunayFlipLiveView::GetRenderer() const { return this->Renderer; }

/// Uses one-shot timers, so that none has to be destroyed: VTK 9.1 crashes if a timer is destroyed
/// while timers fire.
bool vtkDelaunayFlipLiveView::AwaitStep()
{
  const auto interval = static_cast<unsigned long>(this->FrameInterval);
  this->TimerId = this->Interactor ? this->Interactor->CreateOneShotTimer(interval) : 0;
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
