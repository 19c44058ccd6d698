// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceDrawing.h"

#include <limits>

#ifdef DELAUNAYFLIP_DRAWS_ON_DEVICE

#include "BufferFiller.h"
#include "DelaunayFlip.h"
#include "LiveRun.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDelaunayFlip.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkProperty.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

/// The cell array of colours, red, green, blue and alpha in bytes: all are opaque and the same.
constexpr const char* ColorName = "DelaunayFlipColors";

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

/// What is drawn until other colours are written into the mapper's buffer.
vtkSmartPointer<vtkUnsignedCharArray> MakeColors(vtkIdType count)
{
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName(ColorName);
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy(PlainBytes.begin(), PlainBytes.end(), colors->GetPointer(4 * i));
  }
  return colors;
}

/// Puts out the mesh of a filter's live run, but only when something needs it on the host: a
/// picker, an exporter, a mapper that makes its buffers. Call Modified() when there is another.
class LiveMeshSource : public vtkPolyDataAlgorithm
{
public:
  static LiveMeshSource* New();
  vtkTypeMacro(LiveMeshSource, vtkPolyDataAlgorithm);

  vtkSmartPointer<vtkDelaunayFlip> Filter; ///< Without it, or a mesh of it, the last one stays.

protected:
  LiveMeshSource() { this->SetNumberOfInputPorts(0); }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    if (const vtkSmartPointer<vtkPolyData> mesh = this->CopyMesh())
    {
      vtkDataArray* last = this->Last ? this->Last->GetCellData()->GetArray(ColorName) : nullptr;
      const vtkIdType count = mesh->GetNumberOfCells();
      const bool fits = last && last->GetNumberOfTuples() == count;
      const vtkSmartPointer<vtkDataArray> colors = fits ? last : MakeColors(count);
      this->Last = vtkSmartPointer<vtkPolyData>::New();
      this->Last->ShallowCopy(mesh);
      this->Last->GetCellData()->AddArray(colors);
    }
    if (this->Last)
    {
      vtkPolyData::GetData(outputs)->ShallowCopy(this->Last);
    }
    return 1;
  }

private:
  vtkSmartPointer<vtkPolyData> CopyMesh() const
  {
    return !this->Filter                  ? nullptr
      : this->Filter->GetMeshIsWithheld() ? CopyRun(this->Filter)
                                          : MakeFaces(this->Filter->GetOutputDataObject(0));
  }

  vtkSmartPointer<vtkPolyData> Last;
};

vtkStandardNewMacro(LiveMeshSource);

/// Draws a mesh whose triangles and their colours are written into OpenGL's buffers by a filler.
/// VTK makes the buffers, once, from the input; then the buffers are filled again and again, and
/// the input may be behind them. The input is brought up to date only to make the buffers anew and
/// for whoever asks for it, such as a picker; never to draw.
///
/// The input must have no cells but triangles, and direct colours of cells in four bytes.
class DeviceMapper : public vtkOpenGLPolyDataMapper
{
public:
  static DeviceMapper* New();
  vtkTypeMacro(DeviceMapper, vtkOpenGLPolyDataMapper);

  /// None of its calls is made again after one has thrown an exception.
  std::unique_ptr<BufferFiller> Filler = MakeBufferFiller();
  std::function<void()> Fill; ///< Makes the filler fill the buffers.

  /// Whether questions for bounds come from drawing, so that they need not bring the input up to
  /// date: points stay where they are. Pickers ask for bounds before they look at the input.
  std::function<bool()> IsQuiet;

  /// Says that the buffers must be filled again before they are drawn.
  void NoteChange() { this->IsBehind = true; }

  /// Whether there are buffers that can be filled.
  bool IsReady() const { return this->IsRegistered; }

  /// Takes the buffers from OpenGL until they are filled or drawn, if they are there. OpenGL's
  /// context must be current, here and below.
  void MapBuffers()
  {
    if (this->IsRegistered)
    {
      this->TryToWrite([this]() { this->Filler->Map(); });
    }
  }

  /// Fills the buffers now, if they are there and must be, and gives them back to OpenGL.
  void FillIfNeeded()
  {
    if (this->IsRegistered)
    {
      const bool isBehind = std::exchange(this->IsBehind, false);
      this->TryToWrite([=]() { isBehind ? this->Fill() : this->Filler->Unmap(); });
    }
  }

  /// Calls nothing of the above any more, after a last release.
  void Stop()
  {
    this->ReleaseGraphicsResources(nullptr);
    this->Failure = "stopped";
    this->Fill = nullptr;
    this->IsQuiet = nullptr;
  }

  /// Why the buffers can no longer be filled; empty if they can. The mapper then draws its input.
  const std::string& GetFailure() const { return this->Failure; }

  double* GetBounds() override
  {
    const ScopedValue<vtkTypeBool> scope(this->Static, this->IsQuiet && this->IsQuiet());
    return this->Superclass::GetBounds();
  }

  using vtkOpenGLPolyDataMapper::GetBounds;

  /// A selector looks into the input, for the ids of what it has found.
  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override
  {
    const ScopedValue<vtkTypeBool> scope(this->Static, !renderer->GetSelector());
    this->Superclass::RenderPiece(renderer, actor);
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Release();
    this->Superclass::ReleaseGraphicsResources(window);
  }

protected:
  DeviceMapper() = default;

  /// Not left to the superclass, whose destructor would not call what this class overrides.
  ~DeviceMapper() override { this->Stop(); }

  void UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;

private:
  using Stamps = std::array<vtkMTimeType, 3>;

  bool Try(const std::function<void()>& call)
  {
    try
    {
      call();
      return true;
    }
    catch (const std::exception& error)
    {
      this->Failure = error.what();
      return false;
    }
  }

  /// Does without the buffers from now on if a call fails.
  void TryToWrite(const std::function<void()>& call)
  {
    if (!this->Try(call))
    {
      this->AreSpoiled = true;
      this->Release();
    }
  }

  void Release()
  {
    if (std::exchange(this->IsRegistered, false))
    {
      this->Filler->Release();
    }
  }

  /// Whether the registered buffers, which are those of triangles and colours, can stay.
  bool CanMovePoints() const
  {
    vtkPointData* data = this->CurrentInput->GetPointData();
    return this->IsRegistered && !data->GetNormals() && !data->GetTCoords() &&
      this->CurrentInput->GetNumberOfPoints() == this->BuiltPlaces;
  }

  void MovePoints(vtkRenderer* renderer);
  DrawnBuffers GetBuffers() const;
  void UpdateInput()
  {
    this->GetInputAlgorithm()->Update();
    this->CurrentInput = this->GetInput();
  }

  std::string Failure;
  Stamps Built{}; ///< What the buffers were made from, but for points, triangles and colours.
  vtkMTimeType BuiltPoints = 0;
  vtkIdType BuiltPlaces = 0; ///< The number of points.
  bool HasOnlyMoved = false; ///< Nothing but points makes the buffers out of date.
  bool IsRegistered = false;
  bool IsBehind = false; ///< The buffers hold an earlier mesh.
  bool AreSpoiled = false; ///< They hold nothing that could be drawn.
};

vtkStandardNewMacro(DeviceMapper);

/// New cells alone are no reason: the buffers have them already. Of new points only the places are
/// written anew.
bool DeviceMapper::GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  const bool isOther = this->Superclass::GetNeedToRebuildBufferObjects(renderer, actor);
  const Stamps stamps = { actor->GetProperty()->GetMTime(),
    actor->GetTexture() ? actor->GetTexture()->GetMTime() : 0, this->GetMTime() };
  const bool isNew = std::exchange(this->Built, stamps) != stamps;
  const vtkMTimeType points = this->CurrentInput->GetPoints()->GetMTime();
  const bool hasMoved = std::exchange(this->BuiltPoints, points) != points;
  const bool isOut = isNew || this->AreSpoiled || (isOther && !this->IsRegistered);
  this->HasOnlyMoved = hasMoved && !isOut;
  return isOut || hasMoved;
}

void DeviceMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  this->UpdateInput();
  if (std::exchange(this->HasOnlyMoved, false) && this->CanMovePoints())
  {
    this->MovePoints(renderer);
    return;
  }
  this->Release();
  if (std::exchange(this->AreSpoiled, false))
  {
    this->IBOBuildState.Clear();
    this->CellTextureBuildState.Clear();
  }
  this->Superclass::BuildBufferObjects(renderer, actor);
  this->BuiltPlaces = this->CurrentInput->GetNumberOfPoints();
}

void DeviceMapper::MovePoints(vtkRenderer* renderer)
{
  vtkDataArray* places = this->CurrentInput->GetPoints()->GetData();
  this->VBOs->CacheDataArray("vertexMC", places, renderer, VTK_FLOAT);
  using Buffer = vtkOpenGLVertexBufferObject;
  const auto method = static_cast<Buffer::ShiftScaleMethod>(this->ShiftScaleMethod);
  this->VBOs->GetVBO("vertexMC")->SetCoordShiftAndScaleMethod(method);
  this->VBOs->BuildAllVBOs(renderer);
  this->VBOBuildTime.Modified();
  this->IsBehind = true;
  // VTK keeps points in single precision, shifted and scaled where that would be too coarse. This
  // is the matrix with which its shader takes it back.
  Buffer* vertices = this->VBOs->GetVBO("vertexMC");
  if (vertices->GetCoordShiftAndScaleEnabled())
  {
    const std::vector<double>& scale = vertices->GetScale();
    this->VBOInverseTransform->Identity();
    this->VBOInverseTransform->Translate(vertices->GetShift().data());
    this->VBOInverseTransform->Scale(1.0 / scale[0], 1.0 / scale[1], 1.0 / scale[2]);
    this->VBOInverseTransform->GetTranspose(this->VBOShiftScale);
  }
}

void DeviceMapper::UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  if (this->GetSelection())
  {
    this->UpdateInput(); // from which VTK makes what it highlights
  }
  this->Superclass::UpdateBufferObjects(renderer, actor);
  if (!this->IsRegistered && this->Failure.empty())
  {
    this->IsRegistered = this->Try([this]() { this->Filler->Register(this->GetBuffers()); });
    this->IsBehind = true;
  }
  this->FillIfNeeded();
  if (this->AreSpoiled)
  {
    this->BuildBufferObjects(renderer, actor);
  }
}

/// @throws std::runtime_error.
DrawnBuffers DeviceMapper::GetBuffers() const
{
  const vtkOpenGLIndexBufferObject* triangles = this->Primitives[PrimitiveTris].IBO;
  const vtkIdType count = this->CurrentInput->GetNumberOfPolys();
  if (static_cast<vtkIdType>(triangles->IndexCount) != 3 * count)
  {
    throw std::runtime_error("VTK draws no surface, or leaves out triangles with two points at "
                             "one place");
  }
  if (!this->HaveCellScalars || !this->CellScalarBuffer)
  {
    throw std::runtime_error("VTK has no buffer for the colours of triangles");
  }
  return { static_cast<unsigned int>(triangles->GetHandle()),
    static_cast<unsigned int>(this->CellScalarBuffer->GetHandle()), count };
}

}

/// What is there while the drawing is on.
struct DeviceDrawing::Parts
{
  vtkWeakPointer<vtkRenderWindow> Window;
  vtkSmartPointer<vtkActor> Actor;
  vtkSmartPointer<vtkDelaunayFlip> Filter;
  vtkSmartPointer<vtkMapper> OwnMapper; ///< The actor's before.
  vtkNew<LiveMeshSource> Source;
  vtkNew<DeviceMapper> Mapper;
  int ColorKind = -1;
  DrawnColors Colors;
  bool IsCalm = false; ///< SetQuiet().

  Parts(vtkRenderWindow* window, vtkActor* actor, vtkDelaunayFlip* filter)
    : Window(window),
      Actor(actor),
      Filter(filter)
  {
    this->Source->Filter = filter;
    this->Mapper->SetInputConnection(this->Source->GetOutputPort());
    this->Mapper->SetScalarModeToUseCellFieldData();
    this->Mapper->SetColorModeToDirectScalars();
    this->Mapper->SelectColorArray(ColorName);
    this->Mapper->Fill = [this]()
    {
      if (const FlipSession* session = this->Filter->GetSession()) // else the last mesh stays
      {
        vtkPolyData* mesh = this->Mapper->GetInput();
        this->Mapper->Filler->Fill(
          { *session, ViewPoints(mesh), mesh->GetPoints()->GetMTime(), this->Colors });
      }
    };
    this->Mapper->IsQuiet = [this]()
    {
      if (this->IsCalm || !this->Window || this->Window->CheckInRenderStatus())
      {
        return true;
      }
      // While the user moves the camera, an interactor style asks for more frames per second.
      vtkRenderWindowInteractor* interactor = this->Window->GetInteractor();
      return interactor && this->Window->GetDesiredUpdateRate() > interactor->GetStillUpdateRate();
    };
  }

  /// Others may keep the mapper.
  ~Parts()
  {
    if (this->Window && this->Mapper->IsReady())
    {
      this->Window->MakeCurrent();
    }
    this->Mapper->Stop();
    this->Source->Filter = nullptr;
  }

  std::string FindObstacle()
  {
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
    if (!window)
    {
      return "the window does not draw by OpenGL";
    }
    auto* mesh = vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0));
    const std::string inMesh = FindObstacleInMesh(mesh, this->Filter->GetSession());
    if (!inMesh.empty())
    {
      return inMesh;
    }
    window->MakeCurrent();
    BufferFiller* filler = this->Mapper->Filler.get();
    return filler ? filler->FindObstacle(this->Filter) : "this build has no CUDA backend";
  }

  void MakeCurrent() const
  {
    if (!this->Window->IsCurrent()) // else a context may be flushed for nothing
    {
      this->Window->MakeCurrent();
    }
  }
};

//------------------------------------------------------------------------------
DeviceDrawing::DeviceDrawing() = default;

DeviceDrawing::~DeviceDrawing() { this->End(""); }

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
  if (!this->On->FindObstacle().empty() || !this->On->Mapper->IsReady())
  {
    return false;
  }
  auto* mesh = vtkPolyData::SafeDownCast(this->On->Filter->GetOutputDataObject(0));
  vtkPolyData* drawn = this->On->Mapper->GetInput();
  const bool fits = drawn->GetNumberOfPoints() == mesh->GetNumberOfPoints() &&
    drawn->GetNumberOfPolys() == mesh->GetNumberOfPolys();
  if (fits)
  {
    this->NoteStep();
    this->On->Source->Update(); // the points may be elsewhere
  }
  return fits;
}

/// If VTK has no buffers yet, it makes them when it draws.
bool DeviceDrawing::Fill(int kind, const DrawnColors& colors)
{
  if (std::exchange(this->On->ColorKind, kind) != kind)
  {
    this->On->Mapper->NoteChange();
  }
  this->On->Colors = colors;
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

double DeviceDrawing::GetSmallestAngle() const
{
  return this->On->Mapper->Filler->GetSmallestAngle();
}

}

#else // where VTK is newer than 9.1, whose mapper is needed

#include "vtkVersion.h"

namespace delaunayflip
{

struct DeviceDrawing::Parts
{
};

DeviceDrawing::DeviceDrawing() = default;

DeviceDrawing::~DeviceDrawing() = default;

void DeviceDrawing::Begin(vtkRenderWindow*, vtkActor*, vtkDelaunayFlip*)
{
  this->Obstacle = std::string("VTK ") + vtkVersion::GetVTKVersion() +
    " is not 9.1, the release whose buffers can be filled";
}

void DeviceDrawing::End(const std::string& reason) { this->Obstacle = reason; }

void DeviceDrawing::BeginStep() {}

void DeviceDrawing::NoteStep() {}

bool DeviceDrawing::TakeNextRun() { return false; }

bool DeviceDrawing::Fill(int, const DrawnColors&) { return false; }

void DeviceDrawing::SetQuiet(bool) {}

std::string DeviceDrawing::GetFailure() const { return this->Obstacle; }

double DeviceDrawing::GetSmallestAngle() const { return std::numeric_limits<double>::quiet_NaN(); }

}

#endif
