// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceDrawing.h"

#include "BufferFiller.h"
#include "DelaunayFlip.h"
#include "DeviceMapper.h"
#include "LiveMeshSource.h"
#include "ShownMesh.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkDelaunayFlip.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkWeakPointer.h"

#include <limits>
#include <utility>

namespace delaunayflip
{

namespace
{

/// The points where they are; without a count if they are of another type than float and double.
PointArray ViewPoints(vtkPolyData* mesh)
{
  vtkDataArray* data = mesh->GetPoints() ? mesh->GetPoints()->GetData() : nullptr;
  if (auto* floats = vtkFloatArray::FastDownCast(data))
  {
    return PointArray(floats->GetPointer(0), floats->GetNumberOfTuples());
  }
  if (auto* doubles = vtkDoubleArray::FastDownCast(data))
  {
    return PointArray(doubles->GetPointer(0), doubles->GetNumberOfTuples());
  }
  return {};
}

/// Why the triangles of a session cannot be those of an output in their order; empty if they are.
std::string FindObstacleInMesh(vtkPolyData* mesh, const FlipSession* session)
{
  if (!mesh || !session)
  {
    return "the filter is not in a live run of one mesh";
  }
  const vtkIdType count = mesh->GetNumberOfPolys();
  if (count == 0 || mesh->GetPolys()->IsHomogeneous() != 3 || mesh->GetNumberOfStrips() > 0 ||
    session->GetReport().Triangles != count)
  {
    return "the mesh has other cells than triangles";
  }
  return ViewPoints(mesh).Count == 0 ? "the points are neither float nor double" : "";
}

/// Whether the user is moving the camera: then an interactor style asks for more frames per second.
bool IsInteracting(vtkRenderWindow* window)
{
  vtkRenderWindowInteractor* interactor = window->GetInteractor();
  return interactor && window->GetDesiredUpdateRate() > interactor->GetStillUpdateRate();
}

}

/// What is there while the drawing is on.
struct DeviceDrawing::Parts
{
  vtkWeakPointer<vtkRenderWindow> Window;
  vtkSmartPointer<vtkActor> Actor;
  vtkSmartPointer<vtkDelaunayFlip> Filter;
  vtkSmartPointer<vtkMapper> OwnMapper; ///< The actor's before.
  std::unique_ptr<BufferFiller> Filler = MakeBufferFiller();
  vtkNew<LiveMeshSource> Source;
  vtkNew<DeviceMapper> Mapper;
  Coloring Colors;
  bool IsCalm = false; ///< SetQuiet().

  Parts(vtkRenderWindow* window, vtkActor* actor, vtkDelaunayFlip* filter);
  ~Parts();

  vtkPolyData* GetOutput() const;
  std::string FindObstacle();
  bool Fits(vtkPolyData* mesh) const;
  void MakeCurrent() const;
  void FillBuffers();
  bool IsQuiet() const;
};

DeviceDrawing::Parts::Parts(vtkRenderWindow* window, vtkActor* actor, vtkDelaunayFlip* filter)
  : Window(window),
    Actor(actor),
    Filter(filter)
{
  this->Source->GetMesh = [this]()
  {
    return this->Filter->GetMeshIsWithheld() ? CopyRun(this->Filter) : MakeFaces(this->GetOutput());
  };
  this->Mapper->SetInputConnection(this->Source->GetOutputPort());
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->Mapper->SetColorModeToDirectScalars();
  this->Mapper->SelectColorArray(LiveMeshSource::ColorName);
  this->Mapper->SetCallbacks(
    { [this](const DrawnBuffers& buffers) { this->Filler->Register(buffers); },
      [this]() { this->Filler->Map(); }, [this]() { this->Filler->Unmap(); },
      [this]() { this->FillBuffers(); }, [this]() { this->Filler->Release(); },
      [this]() { return this->IsQuiet(); } });
}

/// Others may keep the mapper.
DeviceDrawing::Parts::~Parts()
{
  if (this->Window && this->Mapper->IsReady())
  {
    this->Window->MakeCurrent();
  }
  this->Mapper->Stop();
  this->Source->GetMesh = nullptr;
}

vtkPolyData* DeviceDrawing::Parts::GetOutput() const
{
  return vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0));
}

std::string DeviceDrawing::Parts::FindObstacle()
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
  if (!window)
  {
    return "the window does not draw by OpenGL";
  }
  const std::string inMesh = FindObstacleInMesh(this->GetOutput(), this->Filter->GetSession());
  if (!inMesh.empty())
  {
    return inMesh;
  }
  window->MakeCurrent();
  return this->Filler->FindObstacle(this->Filter);
}

/// Whether a mesh has as many points and triangles as the one that is drawn.
bool DeviceDrawing::Parts::Fits(vtkPolyData* mesh) const
{
  vtkPolyData* drawn = this->Mapper->GetInput();
  return this->Mapper->IsReady() && drawn->GetNumberOfPoints() == mesh->GetNumberOfPoints() &&
    drawn->GetNumberOfPolys() == mesh->GetNumberOfPolys();
}

void DeviceDrawing::Parts::MakeCurrent() const
{
  if (!this->Window->IsCurrent()) // else a context may be flushed for nothing
  {
    this->Window->MakeCurrent();
  }
}

void DeviceDrawing::Parts::FillBuffers()
{
  if (const FlipSession* session = this->Filter->GetSession()) // else the last mesh stays
  {
    vtkPolyData* mesh = this->Mapper->GetInput();
    this->Filler->Fill(
      { *session, ViewPoints(mesh), mesh->GetPoints()->GetMTime(), this->Colors.Shown });
  }
}

bool DeviceDrawing::Parts::IsQuiet() const
{
  return this->IsCalm || !this->Window || this->Window->CheckInRenderStatus() ||
    IsInteracting(this->Window);
}

//------------------------------------------------------------------------------
DeviceDrawing::DeviceDrawing() = default;

DeviceDrawing::~DeviceDrawing() { this->End(""); }

bool DeviceDrawing::IsOn() const { return this->On != nullptr; }

void DeviceDrawing::Begin(vtkRenderWindow* window, vtkActor* actor, vtkDelaunayFlip* filter)
{
  this->End("");
  auto parts = std::make_unique<Parts>(window, actor, filter);
  this->Obstacle = parts->FindObstacle();
  if (this->Obstacle.empty())
  {
    this->On = std::move(parts);
    this->On->Source->Update(); // what has no bounds is not drawn
    this->On->OwnMapper = actor->GetMapper();
    actor->SetMapper(this->On->Mapper);
  }
}

void DeviceDrawing::End(const std::string& reason)
{
  if (this->On)
  {
    this->On->Actor->SetMapper(this->On->OwnMapper);
    this->On.reset();
  }
  this->Obstacle = reason;
}

/// CUDA takes the buffers while the session works. If something is drawn meanwhile, the mapper
/// gives them back.
void DeviceDrawing::BeginStep()
{
  if (this->On && this->On->Window && this->On->Mapper->IsReady())
  {
    this->On->MakeCurrent();
    this->On->Mapper->MapBuffers();
  }
}

void DeviceDrawing::NoteStep()
{
  this->On->Source->Modified();
  this->On->Mapper->NoteChange();
}

bool DeviceDrawing::TakeNextRun()
{
  const bool fits = this->On->FindObstacle().empty() && this->On->Fits(this->On->GetOutput());
  if (fits)
  {
    this->NoteStep();
    this->On->Source->Update(); // the points may be elsewhere
  }
  return fits;
}

/// If VTK has no buffers yet, it makes them when it draws.
bool DeviceDrawing::Fill(const Coloring& coloring)
{
  if (coloring.Kind != this->On->Colors.Kind)
  {
    this->On->Mapper->NoteChange();
  }
  this->On->Colors = coloring;
  if (this->On->Mapper->IsReady())
  {
    this->On->MakeCurrent();
    this->On->Mapper->FillIfNeeded();
  }
  else if (this->GetFailure().empty())
  {
    this->On->Window->Render();
  }
  return this->GetFailure().empty();
}

void DeviceDrawing::SetQuiet(bool isQuiet)
{
  if (this->On)
  {
    this->On->IsCalm = isQuiet;
  }
}

std::string DeviceDrawing::GetFailure() const { return this->On->Mapper->GetFailure(); }

double DeviceDrawing::GetSmallestAngle() const { return this->On->Filler->GetSmallestAngle(); }

}
