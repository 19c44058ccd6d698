// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICECOLORS_H
#define DELAUNAYFLIP_DEVICECOLORS_H

#include "DeviceMesh.h"
#include "EngineExport.h"
#include "FlipOptions.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

/// @file
/// Colours of triangles in the memory of a GPU, for programs that draw a mesh from there. Nothing
/// here is copied through the host.

namespace delaunayflip
{

class FlipSession;

/// Bands of equal width between two numbers, with a colour each.
struct ColorBands
{
  std::vector<std::uint32_t> Colors; ///< One or more: red, green, blue and alpha in memory's order.
  double First = 0.0; ///< Where the first band begins. What is less gets its colour.
  double Last = 1.0; ///< Where the last band ends. What is more gets its colour.
  std::uint32_t OfNaN = 0;
};

/// What a program draws a session's mesh from, in the memory of a GPU.
struct DrawnArrays
{
  /// Where the points of the mesh are, which angles depend on. Read if everything is written.
  DevicePointArray Points;
  MutableTriangleArray Triangles; ///< As many as the session has.
  std::uint32_t* Colors = nullptr; ///< One per triangle.
  DeviceStream Stream;
};

/// What the colours of triangles show.
struct DrawnColors
{
  bool ByFlipCount = false; ///< Else by smallest angle on the surface.
  /// The colours, given the largest flip count of a triangle (0 for angles).
  std::function<ColorBands(double largestCount)> Choose;
};

/// Keeps arrays from which a mesh is drawn up to date with a session that is advanced. It writes
/// only the triangles that have changed since its last update, those of which the flip count is
/// another, and their colours. It writes all triangles of another session, and all colours if
/// other ones are chosen. For that it keeps, in the memory of the GPU, the flip counts and smallest
/// angles of the last update, 8 bytes per triangle, and the points.
class DELAUNAYFLIP_EXPORT DrawnTriangles
{
public:
  DrawnTriangles();
  ~DrawnTriangles();
  DrawnTriangles(const DrawnTriangles&) = delete;
  DrawnTriangles& operator=(const DrawnTriangles&) = delete;

  /// Says that points have moved, or that the arrays of the next update are others or have been
  /// changed: that update writes everything.
  void Forget();

  /// Waits for what is in the caller's stream. Work that follows in that stream finds the arrays
  /// updated; the call itself may return before.
  /// @throws InvalidOptions if the arrays are not in the memory of a GPU or there is no colour.
  /// @throws BackendUnavailable also if the session works elsewhere than on that GPU alone, or has
  /// inserted constraints by flips. Then the next update writes everything.
  void Update(const FlipSession& session, const DrawnArrays& arrays, const DrawnColors& colors);

  /// Waits for the last update.
  /// @returns the smallest angle of the mesh in degrees; NaN if there is none, or no update.
  /// @throws BackendUnavailable.
  double GetSmallestAngle() const;

private:
  class OnDevice;
  std::unique_ptr<OnDevice> Shown; ///< Null if nothing is.
};

}

#endif
