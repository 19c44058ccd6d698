// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveScene_h
#define LiveScene_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkActor;
class vtkDelaunayFlipMapper;
class vtkPolyData;
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
  vtkRenderer* GetRenderer() const { return this->Renderer; }

  /// Makes a camera that looks at the mesh, if the renderer has none yet.
  void LookAtMesh();

  /// Shows a mesh.
  void SetMesh(vtkPolyData* mesh);

  /// What draws the mesh.
  vtkDelaunayFlipMapper* GetMapper() { return this->Mapper; }

  /// Sets what colours show, one of vtkDelaunayFlipLiveView::ColorByType, and brings the mapper's
  /// buffers up to date.
  void SetColorBy(int what);
  void SetEdgeVisibility(bool visible);
  bool GetEdgeVisibility() const;

  void SetStatus(const std::string& text, bool isError);
  void SetKeys(const std::string& text);

  /// Draws the window with what was set.
  void Draw();

private:
  void ShowScale(const char* title);

  vtkWeakPointer<vtkRenderer> Renderer;
  vtkNew<vtkDelaunayFlipMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkScalarBarActor> Scale;
  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Keys;
  double Ink[3] = { 0.0, 0.0, 0.0 };
};

}

#endif
