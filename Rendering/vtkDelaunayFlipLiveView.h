// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipLiveView
 * @brief   watch vtkDelaunayFlip or vtkDelaunayFlipPoints at work in a window
 *
 * vtkDelaunayFlipLiveView drives a filter from the timer of an interactor. It draws the
 * input, then the mesh after every step of IterationsPerUpdate iterations, until no edge is left to
 * flip. It shows statistics: the iteration, the flips so far, the bad edges left, the smallest
 * angle, and whether the run continues.
 *
 *     vtkNew<vtkDelaunayFlipLiveView> view;
 *     view->SetFilter(flip);
 *     view->SetInteractor(interactor); // with a render window
 *     view->Run();
 *     interactor->Start();
 *
 * Keys: space runs and pauses, n makes one step, b begins again, k changes the colours, g shows or
 * hides the edges, i the statistics, d how the mesh is drawn. Only other keys reach the interactor
 * style.
 *
 * Drawing: the view adds to the first renderer of the interactor's window the faces of the mesh
 * (quads, polygons and strips as triangles; no lines or verts), a colour scale and two texts, and
 * removes them when it is deleted. If the window has no renderer, the view makes one with a white
 * background. A renderer without a camera gets one that looks at the mesh from +z, or at a flat
 * mesh along the axis in which it has no extent. Colours, edges and texts that are chosen appear in
 * the next frame or with Render().
 *
 * The filter: Start() restarts it and turns on LiveUpdate and, if it has that, GenerateFlipCount;
 * both stay on. The input of a vtkDelaunayFlipPoints has no triangles, so the first frame shows
 * how many points there are. If points move, Step() shows them where they are; with its KeepSession
 * on, the triangulation follows them. Do
 * not update the filter elsewhere in the meantime: an update between two steps, for example by
 * another view, is a step that is not shown. Composite input cannot be flipped live; LiveUpdate is
 * turned off for it, and its first step is the last. A change of the input, also after the end, is
 * noticed at the next Step(), Run() or Restart().
 *
 * vtkDelaunayFlipMapper draws the mesh; pickers do not see it. The pipeline is updated before
 * anything is drawn, never while rendering. So drawing the window again, or rotating the mesh,
 * never executes the filter. Off-screen windows work too: there, call Step() for every frame,
 * without an event loop.
 *
 * A failure of the filter ends the run. The reason is shown over the last good mesh; the filter
 * itself reports the error. The next Step() or Run() tries again.
 *
 * Events: UpdateEvent after every frame has been drawn and written; StartEvent when the timer
 * starts; EndEvent when a run ends: by convergence, an iteration limit or a failure.
 * Observers may call any method. While the filter or its source executes or the window is drawn,
 * Step(), Run(), Start() and Restart() do nothing.
 *
 * Between the steps of a run the filter's output stays as it was, until the end of the run, and
 * where a triangulation follows points, until the next update. A program that reads it earlier
 * calls Update() of the filter first, which makes no step.
 *
 * The view keeps the filter alive, but not the interactor and the window, which may be deleted in
 * any order.
 *
 * @sa
 * vtkDelaunayFlip vtkDelaunayFlipPoints vtkDelaunayFlipMapper
 */
#ifndef vtkDelaunayFlipLiveView_h
#define vtkDelaunayFlipLiveView_h

#include "vtkDelaunayFlipRenderingModule.h" // For export macro
#include "vtkNew.h" // For Mapper and others
#include "vtkObject.h"
#include "vtkSmartPointer.h" // For Filter
#include "vtkWeakPointer.h" // For Interactor and Window

#include <string> // For std::string
#include <vector> // For std::vector

class vtkActor;
class vtkDataObject;
class vtkDelaunayFlipAlgorithm;
class vtkDelaunayFlipMapper;
class vtkRenderer;
class vtkRenderWindow;
class vtkRenderWindowInteractor;
class vtkScalarBarActor;
class vtkTextActor;

class VTKDELAUNAYFLIPRENDERING_EXPORT vtkDelaunayFlipLiveView : public vtkObject
{
public:
  static vtkDelaunayFlipLiveView* New();
  vtkTypeMacro(vtkDelaunayFlipLiveView, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The filter to watch, a vtkDelaunayFlip or a vtkDelaunayFlipPoints; required. Setting another
   * one ends the run; Start() or Run() begins with it.
   */
  void SetFilter(vtkDelaunayFlipAlgorithm* filter);
  vtkDelaunayFlipAlgorithm* GetFilter() const;
  ///@}

  ///@{
  /**
   * The interactor. Its timer and keys control the run, and its render window shows it. It is
   * required, with its window. Setting another one ends the run; Start() or Run() begins with it.
   */
  void SetInteractor(vtkRenderWindowInteractor* interactor);
  vtkRenderWindowInteractor* GetInteractor() const;
  ///@}

  ///@{
  /**
   * What the colour of a triangle shows, as vtkDelaunayFlipMapper says; default SMALLEST_ANGLE.
   */
  enum ColorByType
  {
    COLOR_BY_SOLID = 0,
    COLOR_BY_SMALLEST_ANGLE = 1,
    COLOR_BY_FLIP_COUNT = 2
  };
  vtkSetClampMacro(ColorBy, int, COLOR_BY_SOLID, COLOR_BY_FLIP_COUNT);
  vtkGetMacro(ColorBy, int);
  void SetColorByToSolid() { this->SetColorBy(COLOR_BY_SOLID); }
  void SetColorByToSmallestAngle() { this->SetColorBy(COLOR_BY_SMALLEST_ANGLE); }
  void SetColorByToFlipCount() { this->SetColorBy(COLOR_BY_FLIP_COUNT); }
  ///@}

  ///@{
  /**
   * Whether edges are drawn. AUTO (default): if there are fewer than 20,000 triangles.
   */
  enum EdgeVisibilityType
  {
    EDGE_VISIBILITY_AUTO = 0,
    EDGE_VISIBILITY_ON = 1,
    EDGE_VISIBILITY_OFF = 2
  };
  vtkSetClampMacro(EdgeVisibility, int, EDGE_VISIBILITY_AUTO, EDGE_VISIBILITY_OFF);
  vtkGetMacro(EdgeVisibility, int);
  void SetEdgeVisibilityToAuto() { this->SetEdgeVisibility(EDGE_VISIBILITY_AUTO); }
  void SetEdgeVisibilityToOn() { this->SetEdgeVisibility(EDGE_VISIBILITY_ON); }
  void SetEdgeVisibilityToOff() { this->SetEdgeVisibility(EDGE_VISIBILITY_OFF); }
  ///@}

  ///@{
  /**
   * Which texts are drawn:
   * - ShowStatistics (default on): three lines in the upper left corner: the iteration and whether
   *   the run continues, or how many rounds points have taken to other places; the flips so far and
   *   the bad edges left, or the number of triangles or points of the input; the smallest angle in
   * degrees, in space or, after a step with PLANAR_XY, in the projection. A failure is always
   * shown, instead of them.
   * - ShowDrawing (default off): GetDrawing(), as their last line.
   * - ShowKeys (default on): what the keys do, at the bottom; never in an off-screen window.
   */
  vtkSetMacro(ShowStatistics, bool);
  vtkGetMacro(ShowStatistics, bool);
  vtkBooleanMacro(ShowStatistics, bool);
  vtkSetMacro(ShowDrawing, bool);
  vtkGetMacro(ShowDrawing, bool);
  vtkBooleanMacro(ShowDrawing, bool);
  vtkSetMacro(ShowKeys, bool);
  vtkGetMacro(ShowKeys, bool);
  vtkBooleanMacro(ShowKeys, bool);
  ///@}

  ///@{
  /**
   * Whether CUDA may write what OpenGL draws, if both use one GPU; see vtkDelaunayFlipMapper. The
   * picture is the same. Default on. Takes effect at the next step.
   */
  vtkSetMacro(ZeroCopy, bool);
  vtkGetMacro(ZeroCopy, bool);
  vtkBooleanMacro(ZeroCopy, bool);
  ///@}

  /// How the mesh is drawn: "drawn without copies", or "drawn from copies: " and the reason.
  std::string GetDrawing() const;

  ///@{
  /**
   * The time from the end of a step, when its frame has been drawn, to the next step, in
   * milliseconds: 1 or more, default 50. Takes effect at the next step.
   */
  vtkSetClampMacro(FrameInterval, int, 1, VTK_INT_MAX);
  vtkGetMacro(FrameInterval, int);
  ///@}

  ///@{
  /**
   * If not empty, every frame is written to a PNG file: FramePrefix, the frame number with at least
   * four digits, and .png. The input is frame 0000. Existing files are overwritten, also after
   * Restart(). If a frame cannot be written, an error is given and no more frames are written, but
   * the run continues; setting the prefix, or Start(), tries again. Default: none.
   */
  void SetFramePrefix(const char* prefix);
  vtkGetCharFromStdStringMacro(FramePrefix);
  ///@}

  /**
   * Prepares filter, renderer and keys, and shows the input as frame 0, paused. Gives an error if
   * the filter, its input, the interactor or its window is missing. Step(), Run() and Restart()
   * call this first if it has not been called. A second call begins again.
   */
  void Start();

  /**
   * Makes a step whenever the interactor's timer fires, in its event loop, until the end of the run
   * or Pause(). No timer runs after that. Gives an error if the interactor has no timer.
   */
  void Run();

  /// Stops the timer.
  void Pause();

  /**
   * Pauses, makes the filter do IterationsPerUpdate iterations, and shows the mesh. If there is
   * nothing left to do, no frame is made.
   * @returns whether another step can change the mesh, so `while (view->Step());` makes all frames;
   * false also if an observer has aborted the step or ended the run.
   */
  bool Step();

  /**
   * Begins again at the input, as frame 0; paused if the run was paused by Pause() or Step(), else
   * running.
   */
  void Restart();

  /// Draws the window again with the current properties. Makes no step and writes no frame.
  void Render();

  /// Whether the timer runs.
  bool IsRunning() const;

  /// Whether the mesh that is shown is the one to which the filter converged.
  bool GetConverged() const;

  /**
   * The number of the frame that is shown: the number of steps since the input; -1 before Start().
   */
  vtkGetMacro(FrameNumber, int);

  /// The renderer that the view draws into, for its camera and background; null before Start().
  vtkRenderer* GetRenderer() const;

protected:
  vtkDelaunayFlipLiveView();
  ~vtkDelaunayFlipLiveView() override;

  int ColorBy = COLOR_BY_SMALLEST_ANGLE;
  int EdgeVisibility = EDGE_VISIBILITY_AUTO;
  bool ShowStatistics = true;
  bool ShowKeys = true;
  bool ZeroCopy = true;
  bool ShowDrawing = false;
  int FrameInterval = 50;
  std::string FramePrefix;

private:
  void LookAtMesh();
  void ShowMesh(vtkDataObject* mesh);
  void ArrangeTexts();
  std::string DescribeStatus(bool isRunning);
  std::string DescribeFailure() const;
  std::string DescribeStep(bool isRunning) const;
  bool BeginIfNeeded();
  void Attach();
  void Detach();
  bool TakeStep();
  void ShowFrame(int number);
  bool AwaitStep();
  void OnTimer(vtkObject* caller, unsigned long event, void* id);
  void RunOrPause();
  void ShowOrHideEdges();
  bool OnKey(vtkObject* caller, unsigned long event, void* data);

  vtkSmartPointer<vtkDelaunayFlipAlgorithm> Filter;
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  vtkWeakPointer<vtkRenderWindow> Window; ///< Null before Start().
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkNew<vtkDelaunayFlipMapper> Mapper;
  vtkNew<vtkActor> Actor; ///< The mesh.
  vtkNew<vtkScalarBarActor> Scale;
  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Keys;
  int FrameNumber = -1;
  vtkMTimeType MovedTime = 0; ///< That of the points that a triangulation has followed last.
  int TimerId = 0; ///< The timer that makes the next step; 0: none. Others still fire: ignored.
  std::vector<unsigned long> Observers; ///< Tags of the observers of the interactor.
  bool HasFailed = false; ///< The filter, or its source, in the last step.
  bool IsMeantToRun = false; ///< Run() was called, and no Pause() or Step() since.
  bool IsBusy = false; ///< The filter or its source executes, or the window is being drawn.
  bool CanWrite = true; ///< False once a frame could not be written.
};

#endif
