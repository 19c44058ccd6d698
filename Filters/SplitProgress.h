// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SplitProgress_h
#define SplitProgress_h

#include "FlipReport.h"

#include "vtkType.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

/// Thrown when an observer wants to stop while polygons are split.
struct SplitAborted
{
};

/// Tells an observer how many of the points of some cells have been gone through.
class SplitProgress
{
public:
  /// @param observer may be empty. @param points of all cells, each as often as cells name it.
  SplitProgress(ProgressObserver observer, vtkIdType points)
    : Observer(std::move(observer)),
      Points(static_cast<double>(std::max<vtkIdType>(points, 1))),
      InCell([this](double share)
        { return this->Tell(static_cast<double>(this->Done) + share * this->CellSize); })
  {
  }
  SplitProgress(const SplitProgress&) = delete;
  SplitProgress& operator=(const SplitProgress&) = delete;

  /// A cell of `size` points comes next. @returns an observer for the time that it takes.
  const ProgressObserver& BeginCell(vtkIdType size)
  {
    this->CellSize = static_cast<double>(size);
    return this->InCell;
  }

  /// @throws SplitAborted.
  void EndCell()
  {
    constexpr vtkIdType PointsBetweenCalls = 16384; // some milliseconds
    const vtkIdType before = this->Done / PointsBetweenCalls;
    this->Done += static_cast<vtkIdType>(this->CellSize);
    if (this->Done / PointsBetweenCalls != before && !this->Tell(static_cast<double>(this->Done)))
    {
      throw SplitAborted();
    }
  }

private:
  bool Tell(double points) { return !this->Observer || this->Observer(points / this->Points); }

  ProgressObserver Observer;
  double Points;
  ProgressObserver InCell;
  vtkIdType Done = 0; ///< Points.
  double CellSize = 0.0;
};

}

#endif
