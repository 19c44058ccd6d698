// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveScene_h
#define LiveScene_h

#include "DeviceDrawing.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkActor;
class vtkDelaunayFlip;
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
  vtkRenderer* GetRenderer() const { return this->Renderer; }

  /// Makes a camera that looks at the mesh, if the renderer has none yet.
  void LookAtMesh();

  /// Shows a mesh, which must consist of triangles.
  void SetMesh(vtkPolyData* mesh);

  /// The mesh of the last SetMesh(): it has the points and the number of triangles of what is
  /// shown.
  vtkPolyData* GetMesh() const { return this->Mesh; }

  /// Draws the mesh of a filter's live run without copies from the next SetColorBy() on, if it can.
  /// The mesh must be that of the last SetMesh().
  void OfferRun(vtkDelaunayFlip* filter);

  /// Shows the first mesh of a filter's new run in the buffers of the run before, which is drawn
  /// without copies. @returns false, and does nothing, if there is none or the mesh does not fit.
  bool TakeNextRun(vtkDelaunayFlip* filter, vtkPolyData* mesh);

  /// Says why OfferRun() was not called.
  void DeclineRun(const std::string& reason);

  /// Whether the run's mesh is drawn without copies.
  bool DrawsRun() const { return this->Device.IsOn(); }

  /// Says that the run is about to make a step.
  void BeginStep() { this->Device.BeginStep(); }

  /// Says that the run has made a step, in place of SetMesh().
  void NoteStep() { this->Device.NoteStep(); }

  /// How the mesh is drawn, in words.
  std::string DescribeDrawing() const;

  /// One of vtkDelaunayFlipLiveView::ColorByType.
  void SetColorBy(int what);
  void SetEdgeVisibility(bool visible);
  bool GetEdgeVisibility() const;

  /// The smallest angle of the mesh in degrees; NaN if it has no triangles.
  double GetSmallestAngle();

  void SetStatus(const std::string& text, bool isError);
  void SetKeys(const std::string& text);

  /// Draws the window with what was set.
  void Draw();

private:
  bool ColorOnDevice(int what);
  void FillTable(int what);
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
  DeviceDrawing Device;
  vtkSmartPointer<vtkDelaunayFlip> Run; ///< Whose run the device may draw, or draws.
  int ColorBy = 0;
  int TableKind = -1; ///< What the table of colours is for, and up to which count.
  double TableCount = 0.0;
  double LargestCount = 0.0; ///< The largest flip count of any mesh so far.
  double Ink[3] = { 0.0, 0.0, 0.0 };
};

}

#endif
