// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipLiveView.h"

#include "LiveRun.h"
#include "LiveScene.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <fstream>
#include <map>

using namespace delaunayflip;

namespace
{

constexpr vtkIdType SmallMesh = 20000; // triangles, up to which edges can be told apart

/// The name of a frame's file, e.g. "prefix0012.png" for frame 12.
std::string MakeFrameName(const std::string& prefix, int frame)
{
  const std::string number = std::to_string(frame);
  return prefix + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + ".png";
}

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

//------------------------------------------------------------------------------
vtkDelaunayFlipLiveView::vtkDelaunayFlipLiveView()
  : Scene(new LiveScene),
    State(LiveState::NotStarted)
{
}

vtkDelaunayFlipLiveView::~vtkDelaunayFlipLiveView() { this->Detach(); }

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
void vtkDelaunayFlipLiveView::SetFramePrefix(const char* prefix)
{
  this->FramePrefix = prefix ? prefix : "";
  this->CanWrite = true;
  this->Modified();
}

//------------------------------------------------------------------------------
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
  if (!this->Filter || this->Filter->GetNumberOfInputConnections(0) == 0)
  {
    vtkErrorMacro("A filter with an input is needed.");
    return false;
  }
  if (!this->Interactor || !this->Interactor->GetRenderWindow())
  {
    vtkErrorMacro("An interactor with a render window is needed.");
    return false;
  }
  return true;
}

bool vtkDelaunayFlipLiveView::BeginIfNeeded()
{
  if (this->State == LiveState::NotStarted || !this->Window)
  {
    this->Start();
  }
  return !this->IsBusy && this->State != LiveState::NotStarted && this->Window;
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipLiveView::Attach()
{
  this->Window = this->Interactor->GetRenderWindow();
  this->Scene->Enter(this->Window);
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
  this->Scene->Leave();
  this->Window = nullptr;
  this->State = LiveState::NotStarted;
  this->FrameNumber = -1;
  this->IsMeantToRun = false;
  this->CanWrite = true;
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipLiveView::ShowInput()
{
  vtkAlgorithmOutput* source = this->Filter->GetInputConnection(0, 0);
  source->GetProducer()->Update(source->GetIndex());
  vtkDataObject* input = this->Filter->GetInputDataObject(0, 0);
  this->Filter->SetLiveUpdate(!IsComposite(input));
  this->Filter->GenerateFlipCountOn();
  this->Filter->Restart();
  this->State = LiveState::UnderWay;
  this->Scene->GetMapper()->SetFilter(nullptr);
  this->Scene->SetMesh(JoinBlocks(input));
  this->Scene->LookAtMesh();
  this->ShowFrame(0);
}

//------------------------------------------------------------------------------
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
  if (this->State == LiveState::NotStarted || !this->Window)
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

//------------------------------------------------------------------------------
bool vtkDelaunayFlipLiveView::TakeStep()
{
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  LiveStep step;
  {
    const ScopedValue<bool> busy(this->IsBusy, true);
    const vtkSmartPointer<vtkDelaunayFlip> filter = this->Filter;
    vtkDelaunayFlipMapper* mapper = this->Scene->GetMapper();
    mapper->SetZeroCopy(this->ZeroCopy);
    mapper->BeginStep();
    step = MakeStep(filter, mapper->DrawsRun());
  }
  const LiveState next = step.State;
  if (this->State == LiveState::NotStarted)
  {
    return false; // An observer of the filter has ended the run.
  }
  const bool isNews = next != LiveState::Unchanged || this->IsRunning();
  if (next != LiveState::UnderWay)
  {
    this->TimerId = 0;
  }
  this->State = next == LiveState::Unchanged ? this->State : next;
  this->ShowStep(step);
  if (isNews && IsEnd(next))
  {
    this->InvokeEvent(vtkCommand::EndEvent);
  }
  return !IsEnd(next);
}

/// If the filter failed, the last mesh stays.
void vtkDelaunayFlipLiveView::ShowStep(const LiveStep& step)
{
  if (step.State == LiveState::Failed || step.State == LiveState::Unchanged)
  {
    this->Render();
    return;
  }
  if (!step.IsWithheld)
  {
    this->Scene->SetMesh(JoinBlocks(this->Filter->GetOutputDataObject(0)));
    this->Scene->GetMapper()->SetFilter(this->Filter->GetSession() ? this->Filter : nullptr);
  }
  this->Scene->GetMapper()->EndStep();
  this->ShowFrame(this->FrameNumber + 1);
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipLiveView::ShowFrame(int number)
{
  this->FrameNumber = number;
  this->Render();
  if (!this->FramePrefix.empty() && this->CanWrite && this->Window)
  {
    const ScopedValue<bool> busy(this->IsBusy, true);
    const std::string name = MakeFrameName(this->FramePrefix, number);
    this->CanWrite = WriteFrame(this->Window, name);
    if (!this->CanWrite)
    {
      vtkErrorMacro("Cannot write " << name << "; no more frames are written.");
    }
  }
  this->InvokeEvent(vtkCommand::UpdateEvent);
}

void vtkDelaunayFlipLiveView::Render()
{
  if (this->IsBusy || !this->Window || !this->Scene->GetRenderer())
  {
    return;
  }
  const ScopedValue<bool> busy(this->IsBusy, true);
  vtkDelaunayFlipMapper* mapper = this->Scene->GetMapper();
  const bool isSmall = mapper->GetNumberOfTriangles() < SmallMesh;
  const bool showKeys = this->ShowKeys && !this->Window->GetOffScreenRendering();
  this->Scene->SetKeys(showKeys ? KeyHelp : "");
  this->Scene->SetColorBy(this->ColorBy);
  this->Scene->SetEdgeVisibility(this->EdgeVisibility == EDGE_VISIBILITY_ON ||
    (this->EdgeVisibility == EDGE_VISIBILITY_AUTO && isSmall));
  const bool hasFailed = this->State == LiveState::Failed;
  std::string status;
  if (this->ShowStatistics || hasFailed)
  {
    // Off screen there are no keys: the program calls Step().
    const bool isRunning = this->IsRunning() || this->Window->GetOffScreenRendering();
    status = DescribeStatus(
      { this->Filter, this->State, isRunning, this->FrameNumber, mapper->GetNumberOfTriangles(),
        mapper->GetSmallestAngle(), this->ShowDrawing ? mapper->GetDrawing() : "" });
  }
  this->Scene->SetStatus(status, hasFailed);
  this->Scene->Draw();
}

std::string vtkDelaunayFlipLiveView::GetDrawing() const
{
  return this->Scene->GetMapper()->GetDrawing();
}

bool vtkDelaunayFlipLiveView::GetConverged() const { return this->State == LiveState::Converged; }

vtkRenderer* vtkDelaunayFlipLiveView::GetRenderer() const { return this->Scene->GetRenderer(); }

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
    { "k", [](Self* self) { self->SetColorBy((self->ColorBy + 1) % (COLOR_BY_FLIP_COUNT + 1)); } },
    { "g",
      [](Self* self)
      {
        const bool areShown = self->Scene->GetEdgeVisibility();
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

//------------------------------------------------------------------------------
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
  os << indent << "Drawing: " << this->GetDrawing() << "\n";
  os << indent << "FrameInterval: " << this->FrameInterval << "\n";
  os << indent << "FramePrefix: " << this->FramePrefix << "\n";
  os << indent << "FrameNumber: " << this->FrameNumber << "\n";
  os << indent << "Running: " << this->IsRunning() << "\n";
  os << indent << "Converged: " << this->GetConverged() << "\n";
}
