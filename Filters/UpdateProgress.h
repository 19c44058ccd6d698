// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateProgress_h
#define UpdateProgress_h

#include "FlipReport.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <utility>

class vtkPolyData;

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

/// @throws RunAborted.
inline void ReportOrThrow(const ProgressObserver& observer, double share)
{
  if (observer && !observer(share))
  {
    throw RunAborted();
  }
}

/// Tells an observer, every few milliseconds, how many items of some work are done.
class WorkProgress
{
public:
  /// @param observer may be empty. @param items of the whole work.
  WorkProgress(ProgressObserver observer, vtkIdType items)
    : Observer(std::move(observer)),
      Items(static_cast<double>(std::max<vtkIdType>(items, 1))),
      InGroup([this](double share)
        { return this->Tell(static_cast<double>(this->Done) + share * this->GroupSize); })
  {
  }
  WorkProgress(const WorkProgress&) = delete;
  WorkProgress& operator=(const WorkProgress&) = delete;

  /// More items are done.
  /// @throws RunAborted.
  void Add(vtkIdType items = 1)
  {
    constexpr vtkIdType ItemsBetweenCalls = 16384;
    const vtkIdType before = this->Done / ItemsBetweenCalls;
    this->Done += items;
    if (this->Done / ItemsBetweenCalls != before && !this->Tell(static_cast<double>(this->Done)))
    {
      throw RunAborted();
    }
  }

  /// An observer of the next items, which are to be added together.
  const ProgressObserver& BeginGroup(vtkIdType size)
  {
    this->GroupSize = static_cast<double>(size);
    return this->InGroup;
  }

private:
  bool Tell(double items)
  {
    return !this->Observer || this->Observer(std::min(items / this->Items, 1.0));
  }

  ProgressObserver Observer;
  double Items;
  ProgressObserver InGroup;
  vtkIdType Done = 0;
  double GroupSize = 0.0;
};

/// Calls work(begin, end) on pieces of [0, count), by all threads, and asks between some of them.
/// @throws RunAborted.
template <typename Work>
void ForPieces(vtkIdType count, const ProgressObserver& progress, const Work& work)
{
  constexpr vtkIdType ItemsBetweenCalls = 32768; // some milliseconds
  for (vtkIdType begin = 0; begin < count; begin += ItemsBetweenCalls)
  {
    ReportOrThrow(progress, static_cast<double>(begin) / static_cast<double>(count));
    vtkSMPTools::For(begin, std::min(begin + ItemsBetweenCalls, count), work);
  }
}

/// What an update has to do, as far as it takes time.
struct UpdateWork
{
  vtkPolyData* Mesh;
  vtkPolyData* Constraints; ///< Or null.
  bool LinesAreConstraints;
  bool HasRegions;
  bool IsWarm; ///< Fixed edges of the first mesh have to be found, too.
  bool WantsAngles;
};

/// Turns the progress of each part of an update into that of the whole. The parts follow each other
/// in the order below; each gets the share of the time that it is expected to take.
class UpdatePlan
{
public:
  /// @param observer may be empty.
  UpdatePlan(const UpdateWork& work, ProgressObserver observer);

  ProgressObserver ForFixedEdges() const { return this->MakePartUpTo(FixedEdges); }
  ProgressObserver ForPolygons() const { return this->MakePartUpTo(Polygons); }
  ProgressObserver ForConstraints() const { return this->MakePartUpTo(Constraints); }
  ProgressObserver ForRegions() const { return this->MakePartUpTo(Regions); }
  ProgressObserver ForSession() const { return this->MakePartUpTo(Session); }
  ProgressObserver ForOutput() const { return this->MakePartUpTo(Output); }

private:
  enum Part
  {
    FixedEdges,
    Polygons,
    Constraints,
    Regions,
    Session,
    Output,
    NumberOfParts
  };

  ProgressObserver MakePartUpTo(Part part) const;

  ProgressObserver Observer;
  double Ends[NumberOfParts];
};

}

#endif
