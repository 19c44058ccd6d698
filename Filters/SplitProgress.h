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

/// Thrown when an observer asks to stop while polygons are being split.
struct SplitAborted
{
};

/// Tells an observer the progress of a pass over cells, measured in their points.
class SplitProgress
{
public:
  /// @param observer may be empty.
  /// @param points the sum of the sizes of all cells.
  SplitProgress(ProgressObserver observer, vtkIdType points)
    : Observer(std::move(observer)),
      Points(static_cast<double>(std::max<vtkIdType>(points, 1))),
      InCell([this](double share)
        { return this->Tell(static_cast<double>(this->Done) + share * this->CellSize); })
  {
  }
  SplitProgress(const SplitProgress&) = delete;
  SplitProgress& operator=(const SplitProgress&) = delete;

  /// Begins a cell of `size` points. @returns an observer of the work on this cell.
  const ProgressObserver& BeginCell(vtkIdType size)
  {
    this->CellSize = static_cast<double>(size);
    return this->InCell;
  }

  /// @throws SplitAborted.
  void EndCell()
  {
    constexpr vtkIdType PointsBetweenCalls = 16384; // a few milliseconds
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
