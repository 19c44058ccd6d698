// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipMapper
 * @brief   draw triangles that change in every frame
 *
 * vtkDelaunayFlipMapper draws the polygons and strips of its input as triangles, by OpenGL. It
 * keeps points, triangles and flip counts in three buffers of its own, and one shader draws them.
 * Triangles are shaded flat and coloured by what they are, see ColorBy.
 *
 *     mapper->SetInputConnection(flip->GetOutputPort());
 *     actor->SetMapper(mapper);
 *
 * With SetFilter() it draws the live run of a vtkDelaunayFlip or vtkDelaunayFlipPoints: the points
 * of the input with the triangles that the run has now. The steps of the run need not be put out.
 * If the filter works on a GPU by CUDA and OpenGL draws on the same one, CUDA writes them into the
 * buffer. Otherwise they are written from the memory of the host. Both give the same picture.
 * vtkDelaunayFlipLiveView draws with this mapper.
 *
 * It uses these of the actor's property: ambient and diffuse coefficient, lighting, edge
 * visibility, edge colour and line width, and the colour if ColorBy is SOLID. Edges fade where
 * triangles are smaller than about seven pixels, so that a dense mesh shows its colours. The light
 * is at the camera, wherever the renderer's lights are. Up to six clipping planes are obeyed.
 * GetLookupTable() has the colours, for a vtkScalarBarActor; another table has no effect.
 *
 * @warning
 * Nothing is picked: hardware selection does not see the triangles, and other pickers see the
 * input, which a live run may be ahead of. Triangles are opaque and filled: with an opacity of less
 * than 1 nothing is drawn, and a warning says so. Scalars, textures and normals do not matter.
 * Coordinates are drawn in single precision, relative to the centre of the mesh.
 *
 * @sa
 * vtkDelaunayFlip vtkDelaunayFlipLiveView
 */
#ifndef vtkDelaunayFlipMapper_h
#define vtkDelaunayFlipMapper_h

#include "vtkDelaunayFlipRenderingModule.h" // For export macro
#include "vtkPolyDataMapper.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkDelaunayFlipAlgorithm;
class vtkMatrix4x4;
class vtkOpenGLRenderWindow;
class vtkPoints;
class vtkProperty;
class vtkShaderProgram;

class VTKDELAUNAYFLIPRENDERING_EXPORT vtkDelaunayFlipMapper : public vtkPolyDataMapper
{
public:
  static vtkDelaunayFlipMapper* New();
  vtkTypeMacro(vtkDelaunayFlipMapper, vtkPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the colour of a triangle shows. SOLID: nothing. SMALLEST_ANGLE (default): its smallest
   * angle in space, from 0 (red) to 60 degrees (blue). FLIP_COUNT: in how many flips it took part,
   * from 0 to the largest count so far or 12, whichever is larger; without a live run this is the
   * cell array vtkDelaunayFlipCount, or 0. Flip counts are sent from the host.
   */
  enum ColorByType
  {
    COLOR_BY_SOLID = 0,
    COLOR_BY_SMALLEST_ANGLE = 1,
    COLOR_BY_FLIP_COUNT = 2
  };
  vtkSetClampMacro(ColorBy, int, COLOR_BY_SOLID, COLOR_BY_FLIP_COUNT);
  vtkGetMacro(ColorBy, int);
  ///@}

  ///@{
  /**
   * The filter that makes the live run. Null (default): the triangles of the input are drawn. The
   * input must be the output of the filter's last update, or a copy of it. If the run has no
   * session, or the output has other cells than triangles, the input is drawn.
   */
  void SetFilter(vtkDelaunayFlipAlgorithm* filter);
  vtkDelaunayFlipAlgorithm* GetFilter() const;
  ///@}

  ///@{
  /**
   * Whether CUDA may write into the buffer of triangles. Default on.
   */
  vtkSetMacro(ZeroCopy, bool);
  vtkGetMacro(ZeroCopy, bool);
  vtkBooleanMacro(ZeroCopy, bool);
  ///@}

  /**
   * Whether the cells and points of a mesh are valid, and its polygons and strips name points that
   * exist. If not, nothing is drawn.
   */
  static bool CanDraw(vtkPolyData* mesh);

  /// Whether the filter's run is drawn, so that steps need not be put out.
  bool DrawsRun();

  /// Whether SetMovedPoints() takes these points, so that they need not be put out.
  bool CanFollow(vtkPoints* points);

  ///@{
  /**
   * Call these before and after each step of the filter's run that is not put out. BeginStep() may
   * be left out: it lets the GPU switch from OpenGL to CUDA while the step is prepared.
   */
  void BeginStep();
  void EndStep();
  ///@}

  /**
   * Draws these points instead of those of the input, with the triangles of the filter's run, until
   * the input changes. There may be more or fewer triangles than the input has. Nothing happens if
   * there are more or fewer points, or if the run has no triangles.
   */
  void SetMovedPoints(vtkPoints* points);

  /**
   * The smallest angle in space, in degrees, of the triangles that the host has last had: those of
   * the input, or of a run drawn from copies. NaN if there are none. Every call measures it.
   */
  double GetSmallestAngle();

  /// The number of triangles of the input or, once its points have moved, of the filter's run.
  vtkIdType GetNumberOfTriangles();

  /// How a run is drawn: "drawn without copies", or "drawn from copies: " and the reason.
  std::string GetDrawing() const;

  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  bool HasOpaqueGeometry() override { return true; }
  bool HasTranslucentPolygonalGeometry() override { return false; }

protected:
  vtkDelaunayFlipMapper();
  ~vtkDelaunayFlipMapper() override;
  void ComputeBounds() override;

  int ColorBy = COLOR_BY_SMALLEST_ANGLE;
  bool ZeroCopy = true;

private:
  void ReadInput();
  bool Prepare(vtkOpenGLRenderWindow* window);
  void SetPlaces(vtkShaderProgram* program, vtkRenderer* renderer, vtkMatrix4x4* dataToWorld);
  void SetColors(vtkShaderProgram* program, vtkProperty* property);

  struct Parts;
  std::unique_ptr<Parts> Own;
};

#endif
