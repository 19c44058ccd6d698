// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipLiveView.h"

#include "FlipReport.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDelaunayFlip.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkDelaunayFlipPoints.h"
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

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
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

/// The points that a filter triangulates. Null if its input is a mesh.
vtkPointSet* FindPoints(vtkDelaunayFlipAlgorithm* filter)
{
  const bool makesTriangles = vtkDelaunayFlipPoints::SafeDownCast(filter) != nullptr;
  return makesTriangles ? vtkPointSet::SafeDownCast(filter->GetInputDataObject(0, 0)) : nullptr;
}

/// Sets a flag until the end of a scope, also if an observer ends it by an exception.
auto Raise(bool& flag)
{
  const auto lower = [](bool* raised) { *raised = false; };
  flag = true;
  return std::unique_ptr<bool, decltype(lower)>(&flag, lower);
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
  const bool mayWithhold = goesOn || moved;
  if (!hasFailed && !(mayWithhold && this->Mapper->DrawsRun()))
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
// What is drawn: a mesh, its colour scale, and texts.

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
