// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateProgress_h
#define UpdateProgress_h

#include "FlipReport.h"

#include "vtkType.h"

#include <algorithm>
#include <array>
#include <utility>

namespace delaunayflip
{

/// An observer of a part of some work, which begins and ends at some share of the whole.
inline ProgressObserver MakePart(const ProgressObserver& whole, double begin, double end)
{
  if (!whole)
  {
    return {};
  }
  return [=](double share) { return whole(begin + (end - begin) * share); };
}

/// Tells an observer, every few milliseconds, how many items of some work are done.
class WorkProgress
{
public:
  /// @param observer may be empty. @param items of the whole work.
  WorkProgress(ProgressObserver observer, vtkIdType items)
    : Observer(std::move(observer)),
      Items(static_cast<double>(std::max<vtkIdType>(items, 1)))
  {
  }

  /// More items are done.
  /// @throws RunAborted.
  void Add(vtkIdType items = 1)
  {
    constexpr vtkIdType ItemsBetweenCalls = 16384;
    const vtkIdType before = this->Done / ItemsBetweenCalls;
    this->Done += items;
    if (this->Done / ItemsBetweenCalls != before && this->Observer &&
      !this->Observer(std::min(static_cast<double>(this->Done) / this->Items, 1.0)))
    {
      throw RunAborted();
    }
  }

  /// An observer of the next `size` items, which are to be added together.
  ProgressObserver ForNext(vtkIdType size) const
  {
    const double done = static_cast<double>(this->Done);
    return MakePart(
      this->Observer, done / this->Items, (done + static_cast<double>(size)) / this->Items);
  }

private:
  ProgressObserver Observer;
  double Items;
  vtkIdType Done = 0;
};

/// Turns the progress of each part of an update into that of the whole. The parts follow each other
/// in this order.
class UpdatePlan
{
public:
  enum Part
  {
    FixedEdges, ///< Those of the first mesh, for a warm start.
    Polygons, ///< Are split.
    Constraints, ///< Are matched.
    Regions, ///< Are labelled.
    Session, ///< The engine.
    Output,
    Angles, ///< For GenerateQuality.
    NumberOfParts
  };

  /// @param has which parts this update has. @param observer may be empty.
  UpdatePlan(const std::array<bool, NumberOfParts>& has, ProgressObserver observer)
    : Observer(std::move(observer))
  {
    // Each part's time in units of the engine's, measured once on one thread.
    constexpr double Durations[] = { 0.4, 0.2, 0.3, 0.3, 1.0, 0.05, 0.4 };
    double sum = 0.0;
    for (int part = 0; part < NumberOfParts; ++part)
    {
      if (has[part])
      {
        sum += Durations[part];
      }
      this->Ends[part + 1] = sum;
    }
  }

  ProgressObserver For(Part part) const
  {
    const double all = this->Ends[NumberOfParts];
    return MakePart(this->Observer, this->Ends[part] / all, this->Ends[part + 1] / all);
  }

private:
  ProgressObserver Observer;
  double Ends[NumberOfParts + 1] = {}; ///< Where each part begins, and where the last one ends.
};

}

#endif
