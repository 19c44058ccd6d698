// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceMapper.h"

#include "vtkActor.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTransform.h"

#include <stdexcept>
#include <utility>
#include <vector>

namespace delaunayflip
{

vtkStandardNewMacro(DeviceMapper);

namespace
{

/// Keeps a mapper from updating its input, without marking the mapper as modified.
class StaticScope
{
public:
  StaticScope(vtkTypeBool& flag, bool isStatic)
    : Flag(flag),
      Before(std::exchange(flag, isStatic))
  {
  }
  ~StaticScope() { this->Flag = this->Before; }
  StaticScope(const StaticScope&) = delete;
  StaticScope& operator=(const StaticScope&) = delete;

private:
  vtkTypeBool& Flag;
  vtkTypeBool Before;
};

}

/// Not left to the superclass, whose destructor would not call what this class overrides.
DeviceMapper::~DeviceMapper() { this->Stop(); }

void DeviceMapper::Stop()
{
  this->ReleaseGraphicsResources(nullptr);
  this->Failure = "stopped";
  this->Calls = {};
}

//------------------------------------------------------------------------------
double* DeviceMapper::GetBounds()
{
  const StaticScope scope(this->Static, this->Calls.IsQuiet && this->Calls.IsQuiet());
  return this->Superclass::GetBounds();
}

/// A selector looks into the input, for the ids of what it has found.
void DeviceMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  const StaticScope scope(this->Static, !renderer->GetSelector());
  this->Superclass::RenderPiece(renderer, actor);
}

void DeviceMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Release();
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void DeviceMapper::UpdateInput()
{
  this->GetInputAlgorithm()->Update();
  this->CurrentInput = this->GetInput();
}

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

/// Whether the registered buffers, which are those of triangles and colours, can stay.
bool DeviceMapper::CanMovePoints() const
{
  vtkPointData* data = this->CurrentInput->GetPointData();
  return this->IsRegistered && !data->GetNormals() && !data->GetTCoords() &&
    this->CurrentInput->GetNumberOfPoints() == this->BuiltPlaces;
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
  this->FindInverseShift();
  this->IsBehind = true;
}

/// VTK keeps points in single precision, shifted and scaled where that would be too coarse. Finds
/// the matrix with which its shader takes this back.
void DeviceMapper::FindInverseShift()
{
  vtkOpenGLVertexBufferObject* places = this->VBOs->GetVBO("vertexMC");
  if (places->GetCoordShiftAndScaleEnabled())
  {
    const std::vector<double>& scale = places->GetScale();
    this->VBOInverseTransform->Identity();
    this->VBOInverseTransform->Translate(places->GetShift().data());
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
    this->IsRegistered = this->Try([this]() { this->Calls.Register(this->GetBuffers()); });
    this->IsBehind = true;
  }
  this->FillIfNeeded();
  if (this->AreSpoiled)
  {
    this->BuildBufferObjects(renderer, actor);
  }
}

//------------------------------------------------------------------------------
template <typename Call>
bool DeviceMapper::Try(const Call& call)
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

void DeviceMapper::MapBuffers()
{
  if (this->IsRegistered)
  {
    this->TryToWrite(this->Calls.Map);
  }
}

void DeviceMapper::FillIfNeeded()
{
  if (this->IsRegistered)
  {
    this->TryToWrite(std::exchange(this->IsBehind, false) ? this->Calls.Fill : this->Calls.Unmap);
  }
}

/// Does without the buffers from now on if a call fails.
void DeviceMapper::TryToWrite(const std::function<void()>& call)
{
  if (!this->Try(call))
  {
    this->AreSpoiled = true;
    this->Release();
  }
}

void DeviceMapper::Release()
{
  if (std::exchange(this->IsRegistered, false))
  {
    this->Calls.Release();
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
