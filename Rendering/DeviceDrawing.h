// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DeviceDrawing_h
#define DeviceDrawing_h

#include "DeviceColors.h"

#include <array>
#include <memory>
#include <string>

class vtkActor;
class vtkDelaunayFlip;
class vtkRenderWindow;

namespace delaunayflip
{

/// What a mesh is painted with that shows nothing by its colours: red, green, blue and alpha.
constexpr std::array<unsigned char, 4> PlainBytes = { 204, 219, 232, 255 };

/// Draws the mesh of a live run without copies through the host: the run's session writes into the
/// buffers of OpenGL. For that it gives an actor another mapper while it is on.
class DeviceDrawing
{
public:
  DeviceDrawing();
  ~DeviceDrawing();
  DeviceDrawing(const DeviceDrawing&) = delete;
  DeviceDrawing& operator=(const DeviceDrawing&) = delete;

  /// Begins to draw the mesh of a filter's last update, which has been put out, with an actor in a
  /// window that has been drawn before. Without success GetObstacle() says why not.
  void Begin(vtkRenderWindow* window, vtkActor* actor, vtkDelaunayFlip* filter);

  /// Gives the actor its own mapper back.
  void End(const std::string& reason);

  bool IsOn() const { return this->On != nullptr; }

  /// Why this is off.
  const std::string& GetObstacle() const { return this->Obstacle; }

  /// Says that the session is about to make a step.
  void BeginStep();

  /// Says that the session has made a step.
  void NoteStep();

  /// Goes on with a new run of the filter, whose mesh has been put out.
  /// @returns false, and does nothing, if the buffers are not made for such a mesh.
  bool TakeNextRun();

  /// Brings the buffers up to date, with these colours. Two with the same `kind` are the same.
  /// @returns false if that failed; GetFailure() says why.
  bool Fill(int kind, const DrawnColors& colors);
  std::string GetFailure() const;

  /// While this is on, questions for bounds come from drawing.
  void SetQuiet(bool isQuiet);

  /// The smallest angle of the mesh in the buffers, in degrees; NaN if there is none.
  double GetSmallestAngle() const;

private:
  struct Parts;
  std::unique_ptr<Parts> On; ///< Null while this is off.
  std::string Obstacle = "no step has been made yet";
};

}

#endif
