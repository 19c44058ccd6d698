// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayFlipLiveView
 * @brief   watch vtkDelaunayFlip at work in a window
 *
 * vtkDelaunayFlipLiveView drives a vtkDelaunayFlip from the timer of an interactor and draws the
 * mesh after every step: first the input, then the mesh after each IterationsPerUpdate iterations
 * of the filter, until nothing is left to flip. On the screen it shows statistics: the iteration,
 * the flips so far, the bad edges left, the smallest angle and whether the run goes on.
 *
 *     vtkNew<vtkDelaunayFlipLiveView> view;
 *     view->SetFilter(flip);
 *     view->SetInteractor(interactor); // that has a render window
 *     view->Run();
 *     interactor->Start();
 *
 * Keys: space runs and pauses, n makes one step, b begins again, k changes the colours, g shows and
 * hides the edges, i the statistics. These keys do not reach the interactor style; all others do.
 *
 * What it draws into: the first renderer of the interactor's window, which it gives the faces of
 * the mesh (quads, polygons and strips as triangles; neither lines nor verts), a scale of colours
 * and two texts; all of them go when the view does. Where the window has no renderer it makes one,
 * with a white background. A renderer without a camera gets one that looks at the mesh from +z, or
 * at a flat mesh along the axis that it does not extend in.
 *
 * What it does to the filter: Start() turns on LiveUpdate and GenerateFlipCount, which stay on, and
 * restarts it. The filter must not be executed by others in the meantime: an update between two
 * steps, by another view say, is a step that is not shown. Composite input cannot be flipped live;
 * its first step is the last, and LiveUpdate is turned off for it. Input that changes, also after
 * the end, is noticed at the next Step(), Run() or Restart().
 *
 * The pipeline is updated before anything is drawn, never from within a rendering, and what is
 * drawn is a copy (shallow): to draw the window again, or to turn the mesh, never executes the
 * filter. A window that is off screen works too: there Step() makes frame after frame without an
 * event loop.
 *
 * A failure of the filter ends the run and is told on the screen, over the last good mesh; the
 * filter itself gives the error. The next Step() or Run() tries again.
 *
 * Events: UpdateEvent after every frame, drawn and written; StartEvent when the timer begins;
 * EndEvent when a step finds the end of the run: convergence, an iteration limit or a failure.
 * Observers may call any method. While the filter executes or the window is drawn, Step(), Run(),
 * Start() and Restart() do nothing.
 *
 * Cost: a step of the filter, a copy of its triangles to the graphics card, and, where statistics
 * are shown or triangles are coloured by their smallest angle, a pass of vtkMeshQuality. After the
 * end of a run there is no timer.
 *
 * The view keeps the filter alive, but neither interactor nor window; they may go in any order.
 *
 * @sa
 * vtkDelaunayFlip
 */
#ifndef vtkDelaunayFlipLiveView_h
#define vtkDelaunayFlipLiveView_h

#include "vtkDelaunayFlipRenderingModule.h" // For export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // For Filter
#include "vtkWeakPointer.h" // For Interactor and Window

#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

class vtkDelaunayFlip;
class vtkRenderer;
class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace delaunayflip
{
class LiveScene;
enum class LiveState;
}

class VTKDELAUNAYFLIPRENDERING_EXPORT vtkDelaunayFlipLiveView : public vtkObject
{
public:
  static vtkDelaunayFlipLiveView* New();
  vtkTypeMacro(vtkDelaunayFlipLiveView, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The filter to watch. Needed. Another one ends the run; Start() or Run() begins with it.
   */
  void SetFilter(vtkDelaunayFlip* filter);
  vtkDelaunayFlip* GetFilter() const;
  ///@}

  ///@{
  /**
   * The interactor whose timer drives the run, whose keys command it and whose render window shows
   * it. Needed, with its window. Another one ends the run; Start() or Run() begins with it.
   */
  void SetInteractor(vtkRenderWindowInteractor* interactor);
  vtkRenderWindowInteractor* GetInteractor() const;
  ///@}

  ///@{
  /**
   * What the colour of a triangle tells. SOLID: nothing. SMALLEST_ANGLE (default): its smallest
   * angle in space, from 0 (red) to 60 degrees (blue). FLIP_COUNT: how often it was part of a flip,
   * on a scale from 0 to the largest count so far, 12 at least. Takes effect at the next frame or
   * Render().
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
   * Whether the edges of triangles are drawn. AUTO (default): below 20,000 triangles. Takes effect
   * at the next frame or Render().
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
   * Whether three lines of statistics are drawn in the upper left corner: the iteration and whether
   * the run goes on; the flips so far and the bad edges left (GetNumberOfNonDelaunayEdges() of the
   * filter); the smallest angle of the mesh on the screen, in space and in degrees. For the input
   * the second line is the number of triangles. Default on. A failure is shown in any case. Takes
   * effect at the next frame or Render().
   */
  vtkSetMacro(ShowStatistics, bool);
  vtkGetMacro(ShowStatistics, bool);
  vtkBooleanMacro(ShowStatistics, bool);
  ///@}

  ///@{
  /**
   * Whether a line at the bottom of the window names the keys. Default on; never drawn in a window
   * that is off screen.
   */
  vtkSetMacro(ShowKeys, bool);
  vtkGetMacro(ShowKeys, bool);
  vtkBooleanMacro(ShowKeys, bool);
  ///@}

  ///@{
  /**
   * Milliseconds from the end of a step, when its frame is drawn, to the next one; 1 or more,
   * default 50. Takes effect at the next step.
   */
  vtkSetClampMacro(FrameInterval, int, 1, VTK_INT_MAX);
  vtkGetMacro(FrameInterval, int);
  ///@}

  ///@{
  /**
   * Where not empty, every frame is written as a PNG: FramePrefix followed by its number of four
   * digits or more and .png. The input is frame 0000. Files that exist are overwritten, also after
   * Restart(). A frame that cannot be written gives an error and ends the writing, not the run;
   * setting the prefix or Start() tries again. Default none.
   */
  void SetFramePrefix(const char* prefix);
  vtkGetCharFromStdStringMacro(FramePrefix);
  ///@}

  /**
   * Prepares filter, renderer and keys, and shows the input as frame 0, paused. An error if filter,
   * its input, interactor or window are missing. What Step(), Run() and Restart() begin with if
   * nobody has called it; a second call begins again.
   */
  void Start();

  /**
   * Steps from now on whenever the interactor's timer fires, in its event loop, until the end or
   * Pause(). An error if the interactor has no timer.
   */
  void Run();

  /**
   * Stops the timer.
   */
  void Pause();

  /**
   * Pauses, lets the filter make IterationsPerUpdate iterations and shows the mesh. Where nothing
   * is left to do, no frame is made.
   * @returns whether another step can change the mesh, so that `while (view->Step());` makes all
   * frames.
   */
  bool Step();

  /**
   * Begins again at the input, as frame 0: paused where the run was paused by Pause() or Step(),
   * else running.
   */
  void Restart();

  /**
   * Draws the window again, as the properties say now. Makes no step and writes no frame.
   */
  void Render();

  /**
   * Whether the timer runs.
   */
  bool IsRunning() const;

  /**
   * Whether the mesh on the screen is what the filter converged to.
   */
  bool GetConverged() const;

  /**
   * The number of the frame on the screen: of steps since the input; -1 before Start().
   */
  vtkGetMacro(FrameNumber, int);

  /**
   * The renderer that it draws into, or null before Start(): for its camera and background.
   */
  vtkRenderer* GetRenderer() const;

protected:
  vtkDelaunayFlipLiveView();
  ~vtkDelaunayFlipLiveView() override;

  int ColorBy = COLOR_BY_SMALLEST_ANGLE;
  int EdgeVisibility = EDGE_VISIBILITY_AUTO;
  bool ShowStatistics = true;
  bool ShowKeys = true;
  int FrameInterval = 50;
  std::string FramePrefix;

private:
  bool IsReady();
  bool BeginIfNeeded();
  void Attach();
  void Detach();
  void ShowInput();
  bool TakeStep();
  delaunayflip::LiveState UpdateFilter();
  void ShowStep(delaunayflip::LiveState step);
  void ShowFrame(int number);
  void StartTimer();
  bool AwaitStep();
  void ShowStatus();
  void StopTimer();
  void OnTimer(vtkObject* caller, unsigned long event, void* id);
  bool OnKey(vtkObject* caller, unsigned long event, void* data);
  void CycleColors();
  void ToggleEdges();
  void ToggleStatistics();

  vtkSmartPointer<vtkDelaunayFlip> Filter;
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  vtkWeakPointer<vtkRenderWindow> Window; ///< Null before Start().
  std::unique_ptr<delaunayflip::LiveScene> Scene;
  delaunayflip::LiveState State;
  int FrameNumber = -1;
  int TimerId = 0; ///< Of the timer that is awaited; 0: none.
  std::vector<unsigned long> Observers; ///< Of the interactor.
  bool IsMeantToRun = false; ///< Run() was called, and neither Pause() nor Step() since.
  bool IsBusy = false; ///< The filter executes, or the window is drawn.
  bool CanWrite = true; ///< No frame has failed.

  vtkDelaunayFlipLiveView(const vtkDelaunayFlipLiveView&) = delete;
  void operator=(const vtkDelaunayFlipLiveView&) = delete;
};

#endif
