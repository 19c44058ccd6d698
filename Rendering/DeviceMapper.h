// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DeviceMapper_h
#define DeviceMapper_h

#include "BufferFiller.h"

#include "vtkOpenGLPolyDataMapper.h"

#include <array>
#include <functional>
#include <string>

namespace delaunayflip
{

/// Draws a mesh whose triangles and their colours are written into OpenGL's buffers by someone
/// else. VTK makes the buffers, once, from the input; then the buffers are filled again and again,
/// and the input may be behind them. The input is brought up to date only to make the buffers anew
/// and for whoever asks for it, such as a picker; never to draw.
///
/// The input must have no cells but triangles, and direct colours of cells in four bytes.
class DeviceMapper : public vtkOpenGLPolyDataMapper
{
public:
  static DeviceMapper* New();
  vtkTypeMacro(DeviceMapper, vtkOpenGLPolyDataMapper);

  /// What fills the buffers. None of these is called again after one has thrown an exception.
  struct Callbacks
  {
    std::function<void(const DrawnBuffers&)> Register; ///< The buffers have been made.
    std::function<void()> Map; ///< OpenGL does not use them for the moment.
    std::function<void()> Unmap; ///< They are about to be drawn as they are.
    std::function<void()> Fill; ///< They must be filled before they are drawn.
    std::function<void()> Release; ///< They are about to be changed or deleted. Throws nothing.
    /// Whether questions for bounds come from drawing, so that they need not bring the input up to
    /// date: points stay where they are. Pickers ask for bounds before they look at the input.
    std::function<bool()> IsQuiet;
  };
  void SetCallbacks(const Callbacks& callbacks) { this->Calls = callbacks; }

  /// Says that the buffers must be filled again before they are drawn.
  void NoteChange() { this->IsBehind = true; }

  /// Whether there are buffers that can be filled.
  bool IsReady() const { return this->IsRegistered; }

  /// Takes the buffers from OpenGL until they are filled or drawn, if they are there. OpenGL's
  /// context must be current, here and below.
  void MapBuffers();

  /// Fills the buffers now, if they are there and must be, and gives them back to OpenGL.
  void FillIfNeeded();

  /// Calls nothing of the callbacks any more, after a last Release().
  void Stop();

  /// Why the buffers can no longer be filled; empty if they can. The mapper then draws its input.
  const std::string& GetFailure() const { return this->Failure; }

  double* GetBounds() override;
  using vtkOpenGLPolyDataMapper::GetBounds;
  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  DeviceMapper() = default;
  ~DeviceMapper() override;

  void UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;

private:
  using Stamps = std::array<vtkMTimeType, 3>;

  template <typename Call>
  bool Try(const Call& call);
  void TryToWrite(const std::function<void()>& call);
  void Release();
  bool CanMovePoints() const;
  void MovePoints(vtkRenderer* renderer);
  void FindInverseShift();
  DrawnBuffers GetBuffers() const;
  void UpdateInput();

  Callbacks Calls;
  std::string Failure;
  Stamps Built{}; ///< What the buffers were made from, but for points, triangles and colours.
  vtkMTimeType BuiltPoints = 0;
  vtkIdType BuiltPlaces = 0; ///< The number of points.
  bool HasOnlyMoved = false; ///< Nothing but points makes the buffers out of date.
  bool IsRegistered = false;
  bool IsBehind = false; ///< The buffers hold an earlier mesh.
  bool AreSpoiled = false; ///< They hold nothing that could be drawn.
};

}

#endif
