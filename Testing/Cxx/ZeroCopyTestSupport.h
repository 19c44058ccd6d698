// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ZeroCopyTestSupport_h
#define ZeroCopyTestSupport_h

#include "LiveViewTestSupport.h"

#include <string>
#include <vector>

class vtkActor;

/// Helpers for the tests of live views that draw without copies.

using Bytes = std::vector<unsigned char>;

extern const std::string WithoutCopies; ///< What such a view says of itself.

/// A view with what these tests look at.
class RunView : public WatchedView
{
public:
  using WatchedView::WatchedView;

  /// The pixels of the window.
  Bytes GetPicture();

  vtkActor* GetActor();

  /// The triangles of the run as they are now.
  Cells GetTriangles();

  std::string Print();
};

/// The same run twice: once drawn from copies, once without as far as possible.
struct ViewPair
{
  explicit ViewPair(vtkPolyData* mesh);

  /// A step of both.
  void Step();

  RunView Copying, Sharing;
};

/// The share of pixels with a component that differs by more than 8 of 255.
double Compare(const Bytes& a, const Bytes& b);

/// At most one pixel in 1,000 may differ: a triangle at the edge of two colours may have either.
constexpr double Tolerance = 0.001;

/// The triangles after a single update, without a view.
Cells FlipAtOnce(vtkPolyData* mesh);

#endif
