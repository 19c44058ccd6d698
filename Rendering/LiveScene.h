// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveScene_h
#define LiveScene_h

#include "vtkNew.h"
#include "vtkWeakPointer.h"

class vtkActor;
class vtkDataObject;
class vtkDelaunayFlipLiveView;
class vtkDelaunayFlipMapper;
class vtkRenderer;
class vtkRenderWindow;
class vtkScalarBarActor;
class vtkTextActor;

namespace delaunayflip
{

/// What a live view adds to a renderer: a mesh, its colour scale, and texts.
class LiveScene
{
public:
  LiveScene();
  ~LiveScene();
  LiveScene(const LiveScene&) = delete;
  LiveScene& operator=(const LiveScene&) = delete;

  /// Adds the scene to the first renderer of a window; creates one if there is none.
  void Enter(vtkRenderWindow* window);
  void Leave();

  /// Makes a camera that looks at the mesh, if the renderer has none yet.
  void LookAtMesh();

  /// Shows a mesh, or all blocks of a composite one; none if it is null.
  void SetMesh(vtkDataObject* mesh);

  /// Draws the window, with what the view is set to show.
  /// @param state of the mesh: one of vtkDelaunayFlip::StopReasonType.
  void Draw(vtkDelaunayFlipLiveView* view, int state);

  vtkWeakPointer<vtkRenderer> Renderer; ///< Null outside a window.
  vtkNew<vtkDelaunayFlipMapper> Mapper;
  vtkNew<vtkActor> Actor; ///< Of the mesh.

private:
  void ArrangeTexts(bool hasFailed);

  vtkNew<vtkScalarBarActor> Scale;
  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Keys;
};

}

#endif
