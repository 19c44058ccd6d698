// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceMapper.h"

#include "vtkActor.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <stdexcept>
#include <utility>

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

/// New cells alone are no reason: the buffers have them already.
bool DeviceMapper::GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  const bool isOther = this->Superclass::GetNeedToRebuildBufferObjects(renderer, actor);
  const Stamps stamps = { actor->GetProperty()->GetMTime(),
    actor->GetTexture() ? actor->GetTexture()->GetMTime() : 0,
    this->CurrentInput->GetPoints()->GetMTime(), this->GetMTime() };
  const bool isNew = std::exchange(this->Built, stamps) != stamps;
  return isNew || this->AreSpoiled || (isOther && !this->IsRegistered);
}

void DeviceMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  this->Release();
  this->UpdateInput();
  if (std::exchange(this->AreSpoiled, false))
  {
    this->IBOBuildState.Clear();
    this->CellTextureBuildState.Clear();
  }
  this->Superclass::BuildBufferObjects(renderer, actor);
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

void DeviceMapper::FillIfNeeded()
{
  if (this->IsRegistered && std::exchange(this->IsBehind, false) &&
    !this->Try([this]() { this->Calls.Fill(); }))
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
