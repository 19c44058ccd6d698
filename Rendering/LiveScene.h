// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveScene_h
#define LiveScene_h

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkActor;
class vtkLookupTable;
class vtkMeshQuality;
class vtkPolyData;
class vtkPolyDataMapper;
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
  vtkRenderer* GetRenderer() const;

  /// Makes a camera that looks at the mesh, if the renderer has none yet.
  void LookAtMesh();

  /// Shows a mesh, which must consist of triangles.
  void SetMesh(vtkPolyData* mesh);
  vtkPolyData* GetMesh() const;

  /// One of vtkDelaunayFlipLiveView::ColorByType.
  void SetColorBy(int what);
  void SetEdgeVisibility(bool visible);
  bool GetEdgeVisibility() const;

  /// The smallest angle of the mesh in degrees; NaN if it has no triangles.
  double GetSmallestAngle();

  void SetStatus(const std::string& text, bool isError);
  void SetKeys(const std::string& text);

private:
  void PlaceTexts();
  void PlaceScale();
  void ColorByNothing();
  void ColorBySmallestAngle();
  void ColorByFlipCount();
  void ShowScale(const char* title);

  vtkWeakPointer<vtkRenderer> Renderer;
  vtkNew<vtkPolyData> Mesh;
  vtkNew<vtkMeshQuality> Quality;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkLookupTable> Colors;
  vtkNew<vtkScalarBarActor> Scale;
  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Keys;
  double LargestCount = 0.0; ///< The largest flip count of any mesh so far.
  double Ink[3] = { 0.0, 0.0, 0.0 };
};

}

#endif
