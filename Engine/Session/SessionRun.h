// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SESSIONRUN_H
#define DELAUNAYFLIP_SESSIONRUN_H

#include "DelaunayFlip.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{

class LoadedMesh;

/// What becomes of a run if an observer asks it to stop during a stage.
enum class OnStop
{
  Forgets, ///< It is forgotten. The next Advance begins anew.
  /// Its mesh is valid and stays. The next Advance continues with the stage; with several pieces it
  /// begins anew.
  KeepsMesh,
  Ignores ///< It goes on, because the result is not complete without the stage.
};

/// One of the things that a run does. They are done in their order.
struct Stage
{
  const char* Name;
  OnStop Stop;
  /// About the share of the progress that the stage takes if it has something to do. It is 0 if the
  /// stage is short, if BuildProgress tells its share, and for the flips of a mesh, which take the
  /// rest.
  double Share;
  /// Does what is left of the stage. @returns whether the stage is complete. If not, the
  /// iterations of the caller are spent, or an observer has stopped the run.
  std::function<bool()> Work;
  /// Changes a mesh that is loaded again as Work has changed the first one. Empty if Work does not
  /// change the mesh. @param count how much of the stage was done: iterations, segments or rounds.
  /// The last stage of points gets the number of a batch of points, or PointRun::AllPoints.
  std::function<void(LoadedMesh&, std::int64_t count)> Repeat;
};

/// The work of a stage that is done at once and is complete then. @param work returns nothing.
template <typename Function>
std::function<bool()> Whole(const Function& work)
{
  return [work]
  {
    work();
    return true;
  };
}

/// Gives a variable another value for as long as this lives.
template <typename Value>
class TemporaryValue
{
public:
  TemporaryValue(Value& variable, const Value& value)
    : Variable(variable),
      Before(std::exchange(variable, value))
  {
  }
  ~TemporaryValue() { this->Variable = std::move(this->Before); }
  TemporaryValue(const TemporaryValue&) = delete;
  TemporaryValue& operator=(const TemporaryValue&) = delete;

private:
  Value& Variable;
  Value Before;
};

/// What a FlipSession owns: a list of stages, and how far it is. Only stages change the mesh. The
/// functions do what those of FlipSession do. Getters are not const, because a GPU may fail while
/// it is asked. Then threads make the same mesh again, unless an observer stops them.
class SessionRun
{
public:
  virtual ~SessionRun() = default;
  SessionRun(const SessionRun&) = delete;
  SessionRun& operator=(const SessionRun&) = delete;

  virtual bool Advance(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress) = 0;
  virtual void Expect(const ResultMemory&) {}

  virtual const FlipReport& GetReport() = 0;
  virtual void StoreTriangles(const MutableTriangleArray& triangles) = 0;
  virtual void StoreFlipCounts(std::int32_t* counts) = 0;

  /// See FlipSession.
  virtual const std::vector<AddedPoint>& GetAddedPoints()
  {
    static const std::vector<AddedPoint> none;
    return none;
  }
  virtual void StoreAddedPoints(const AddedPointArrays& arrays)
  {
    const std::vector<AddedPoint>& points = this->GetAddedPoints();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      arrays.Set(static_cast<std::int64_t>(i), points[i]);
    }
  }
  /// Only sessions from triangles have them.
  virtual void StoreSources(std::int32_t*)
  {
    throw InvalidOptions("triangles have sources only in a session from triangles");
  }

  /// Stores in device memory. @returns false, and writes nothing, if the values have to be copied
  /// from the host.
  virtual bool StoreTrianglesOnDevice(
    const MutableTriangleArray&, const DeviceStream&, std::int32_t*)
  {
    return false;
  }
  virtual bool StoreFlipCountsOnDevice(std::int32_t*, const DeviceStream&) { return false; }

  // Not every session has these.
  virtual void StoreOrderedTriangles(const MutableTriangleArray&) { Refuse(); }
  virtual void StoreNeighbors(std::int32_t*) { Refuse(); }
  virtual bool StoreNeighborsOnDevice(std::int32_t*, const DeviceStream&) { return false; }
  virtual void StoreUsedPoints(std::int64_t*) { Refuse(); }
  virtual std::vector<std::int64_t> ListSegmentEdges() { Refuse(); }
  virtual std::vector<std::int64_t> ListSegmentsOfEdges() { Refuse(); }
  virtual void StoreRegions(std::int32_t*) { Refuse(); }
  virtual bool Insert(const PlaneArray&, const ProgressObserver&) { Refuse(); }
  virtual bool Move(const PointMove&, const ProgressObserver&) { Refuse(); }
  virtual bool Remove(const std::int64_t*, std::int64_t, const ProgressObserver&) { Refuse(); }
  virtual bool Compact(const ProgressObserver&) { Refuse(); }
  virtual bool Ask(const PlaceQuery&, const ProgressObserver&) { Refuse(); }

  /// How many triangles the Store functions write.
  std::int64_t CountTriangles() const { return this->Report.Triangles; }

  /// For tests.
  const std::vector<Stage>& GetStages() const { return this->Stages; }

protected:
  SessionRun() = default;

  /// Says why functions that a session does not have are refused.
  virtual std::string ExplainRefusal() const { return "this session was not made from points"; }
  [[noreturn]] void Refuse() const { throw InvalidOptions(this->ExplainRefusal()); }

  /// For a run that is done at once: tells observers that it has ended, and then all iterations.
  void TellEnd(const FlipObserver& observer, const ProgressObserver& progress) const
  {
    if (progress)
    {
      progress(1.0);
    }
    for (std::size_t i = 0; observer && i < this->Report.Iterations.size(); ++i)
    {
      observer(this->Report.Iterations[i]);
    }
  }

  /// Does the stages before this one that are not complete. Once an observer has stopped the run,
  /// no stage begins that keeps the mesh when it is stopped. Others do begin: without them the mesh
  /// does not fit the report.
  /// @returns whether all are complete.
  bool RunStages(std::size_t end)
  {
    for (; this->Current < end; ++this->Current)
    {
      const Stage& stage = this->Stages[this->Current];
      const TemporaryValue<bool> forgets(this->MayForget, stage.Stop == OnStop::Forgets);
      const bool stopsHere = this->WasStopped && stage.Stop == OnStop::KeepsMesh;
      if (stopsHere || !stage.Work())
      {
        return false;
      }
    }
    return true;
  }

  bool IsOver() const { return this->Current == this->Stages.size(); }

  /// Forgets everything but the caller's input.
  virtual void Reset() = 0;

  /// Forgets the run after an observer has stopped it while there is no valid mesh: while one is
  /// built, or while the CPU repeats what a GPU has lost.
  void Abort()
  {
    this->Reset();
    this->Report.StopReason = StopReasonKind::Aborted;
  }

  FlipReport Report;
  std::vector<Stage> Stages;
  std::size_t Current = 0; ///< The number of the stage that comes next or is not complete.
  ProgressObserver Observer; ///< The one of the call under way, else the constructor's.
  bool WasStopped = false; ///< Whether an observer of the call under way has asked to stop.
  bool MayForget = false; ///< Whether an observer may stop the stage under way and lose the run.
};

}

#endif
