// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipLiveView.h"

#include "FlipReport.h"
#include "LiveViewSupport.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkExecutive.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <cstdio>
#include <fstream>
#include <map>
#include <string>

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

vtkDelaunayFlipLiveView::~vtkDelaunayFlipLiveView() { this->Detach(); }

void vtkDelaunayFlipLiveView::SetFilter(vtkDelaunayFlipAlgorithm* filter)
{
  if (this->Filter != filter)
  {
    this->Detach();
    this->Filter = filter;
    this->Modified();
  }
}

vtkDelaunayFlipAlgorithm* vtkDelaunayFlipLiveView::GetFilter() const { return this->Filter; }

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
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  const vtkSmartPointer<vtkDelaunayFlipAlgorithm> filter = this->Filter;
  auto busy = Raise(this->IsBusy);
  this->Detach();
  this->Attach();
  vtkAlgorithmOutput* source = filter->GetInputConnection(0, 0);
  source->GetProducer()->Update(source->GetIndex());
  filter->SetLiveUpdate(!vtkCompositeDataSet::SafeDownCast(filter->GetInputDataObject(0, 0)));
  if (auto* flip = vtkDelaunayFlip::SafeDownCast(filter))
  {
    flip->GenerateFlipCountOn();
  }
  filter->Restart();
  busy.reset();
  if (!this->Window)
  {
    return; // An observer of the filter or its source has ended the run.
  }
  this->HasFailed = false;
  this->Mapper->SetFilter(nullptr);
  if (FindPoints(filter))
  {
    this->ShowMesh(vtkNew<vtkPolyData>()); // whatever cells these points have
  }
  else
  {
    this->ShowMesh(filter->GetInputDataObject(0, 0));
  }
  this->LookAtMesh();
  this->ShowFrame(0);
}

bool vtkDelaunayFlipLiveView::BeginIfNeeded()
{
  if (!this->Window || this->FrameNumber < 0)
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
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
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
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
  this->IsMeantToRun = false;
  this->TimerId = 0;
  return this->BeginIfNeeded() && this->TakeStep();
}

void vtkDelaunayFlipLiveView::Restart()
{
  const vtkSmartPointer<vtkDelaunayFlipLiveView> self(this); // An observer may drop it.
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
  const vtkSmartPointer<vtkDelaunayFlipAlgorithm> filter = this->Filter;
  const vtkMTimeType before = filter->GetOutputDataObject(0)->GetUpdateTime();
  auto busy = Raise(this->IsBusy);
  this->Mapper->SetZeroCopy(this->ZeroCopy);
  this->Mapper->BeginStep();
  const bool works = filter->AdvanceSession();
  const int state = filter->GetStopReason();
  const bool hasFailed = !works || state == vtkDelaunayFlip::STOP_REASON_FAILED;
  vtkPoints* moved = nullptr;
  vtkPointSet* points = FindPoints(filter); // null also if an observer has taken them away
  if (points && filter->GetMeshIsWithheld() && filter->GetReport().FromPoints.MoveRounds > 0)
  {
    moved = points->GetPoints();
  }
  const bool isDrawn = moved && moved->GetMTime() == this->MovedTime;
  const bool isNew = filter->GetOutputDataObject(0)->GetUpdateTime() != before && !isDrawn;
  const bool isUnderWay = isNew && works && state == vtkDelaunayFlip::STOP_REASON_RUNNING;
  const bool isAborted = isNew && works && state == vtkDelaunayFlip::STOP_REASON_ABORTED;
  const bool goesOn = isUnderWay || isAborted;
  bool isDrawnFromRun = goesOn && this->Mapper->DrawsRun();
  if (moved)
  {
    isDrawnFromRun = this->Mapper->CanFollow(moved);
  }
  if (!hasFailed && !isDrawnFromRun)
  {
    filter->GetExecutive()->Update(0); // puts the mesh out, if the step has not
  }
  busy.reset();
  if (!this->Window)
  {
    return false; // An observer of the filter has ended the run.
  }
  const bool isEnd = !goesOn && (isNew || hasFailed || this->IsRunning());
  if (!isUnderWay)
  {
    this->TimerId = 0;
  }
  this->HasFailed = hasFailed;
  if (isNew && !hasFailed)
  {
    if (!filter->GetMeshIsWithheld())
    {
      this->ShowMesh(filter->GetOutputDataObject(0));
      this->Mapper->SetFilter(filter->GetSession() ? filter.Get() : nullptr);
    }
    else if (moved)
    {
      this->Mapper->SetMovedPoints(moved);
      this->MovedTime = moved->GetMTime();
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
  return isUnderWay && this->Window;
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
  this->TimerId = 0;
  if (this->Interactor)
  {
    this->TimerId = this->Interactor->CreateOneShotTimer(interval);
  }
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

void vtkDelaunayFlipLiveView::RunOrPause()
{
  if (this->IsRunning())
  {
    this->Pause();
  }
  else
  {
    this->Run();
  }
}

void vtkDelaunayFlipLiveView::ShowOrHideEdges()
{
  const bool areShown = this->Actor->GetProperty()->GetEdgeVisibility() != 0;
  this->SetEdgeVisibility(areShown ? EDGE_VISIBILITY_OFF : EDGE_VISIBILITY_ON);
}

bool vtkDelaunayFlipLiveView::OnKey(vtkObject*, unsigned long event, void*)
{
  using Self = vtkDelaunayFlipLiveView;
  static const std::map<std::string, void (*)(Self*)> actions = {
    { "space", [](Self* self) { self->RunOrPause(); } },
    { "n", [](Self* self) { self->Step(); } },
    { "b", [](Self* self) { self->Restart(); } },
    { "k", [](Self* self) { self->SetColorBy((self->ColorBy + 1) % (COLOR_BY_FLIP_COUNT + 1)); } },
    { "g", [](Self* self) { self->ShowOrHideEdges(); } },
    { "i", [](Self* self) { self->SetShowStatistics(!self->ShowStatistics); } },
    { "d", [](Self* self) { self->SetShowDrawing(!self->ShowDrawing); } },
  };
  const char* key = this->Interactor->GetKeySym();
  if (!key || this->Interactor->GetControlKey())
  {
    return false;
  }
  const auto action = actions.find(key);
  if (action == actions.end())
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
  os << indent << "FrameInterval: " << this->FrameInterval << "\n";
  os << indent << "FramePrefix: " << this->FramePrefix << "\n";
  os << indent << "FrameNumber: " << this->FrameNumber << "\n";
}
