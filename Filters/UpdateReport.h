// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateReport_h
#define UpdateReport_h

#include "EngineExport.h"
#include "FlipReport.h"

#include "vtkType.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

class vtkDataSetAttributes;
class vtkFieldData;
class vtkPolyData;

/// @file
/// What an update tells: its progress and, in messages and arrays, what it did.

namespace delaunayflip
{

/// A message about a mesh.
struct Note
{
  std::string Where; ///< E.g. "block 3 (wing)"; empty if there is only one mesh.
  std::string Text;
};

/// Joins notes to one text. Each text appears once, with the first places to which it applies.
std::string Describe(const std::vector<Note>& notes);

/// The kinds of errors. vtkDelaunayFlipAlgorithm::FailureType explains them.
enum class FailureKind
{
  None,
  Options,
  Mesh,
  Backend,
  Other
};

/// What one update did to all of its meshes, and the messages about it.
struct UpdateSummary
{
  FlipReport Report; ///< The sum over the meshes without a failure.
  FailureKind Failure = FailureKind::None; ///< The kind of the first error.
  std::int64_t FailedRing = -1; ///< InvalidMesh::Ring of the first error.
  std::vector<Note> Errors;
  std::vector<Note> Warnings;

  /// Adds the exception that is being handled.
  /// @param where what notes call the mesh; "" if it is the only one.
  DELAUNAYFLIP_EXPORT void AddFailure(const std::string& where);
};

/// Describes what the user is warned of; "" if nothing. A requested iteration limit that was
/// reached is not worth a warning.
/// @param hasTolerance whether the user has set one.
DELAUNAYFLIP_EXPORT std::string DescribeTrouble(
  const FlipReport& report, bool hasAskedForLimit, bool hasTolerance);

/// Describes the arrays that have fewer tuples than there are points or cells. The count of the
/// defect is 0 if there are none.
/// @param kind is "point" or "cell". @param fate says what is wrong with them, and what became of
/// them.
Defect FindShortArrays(
  vtkDataSetAttributes* data, vtkIdType tuples, const std::string& kind, const std::string& fate);

/// Lists point and cell arrays that have too few tuples, and ghost arrays that are ignored.
/// @param pointsPass whether such point arrays pass. Otherwise they are left out.
/// @param cellsPass tells this of cell arrays.
DELAUNAYFLIP_EXPORT std::vector<Defect> ListMalformedArrays(
  vtkPolyData* mesh, bool pointsPass, bool cellsPass);

/// Adds the columns of the iterations as arrays with one tuple per iteration. Replaces arrays with
/// the same names. A smallest angle that was not computed is -1.
/// @param prefix of their names.
void AddIterationColumns(const FlipReport& report, const std::string& prefix, vtkFieldData* data);

/// Removes arrays that an earlier update has added to a mesh or its cells.
void DropResults(vtkFieldData* data);

/// Adds these columns, and one-tuple arrays that sum up the run, to the field data of a mesh, with
/// the prefix "DelaunayFlip:", since the user may have an array "Seconds" already.
DELAUNAYFLIP_EXPORT void AddFieldData(const FlipReport& report, vtkFieldData* data);

/// Adds an array of one count.
DELAUNAYFLIP_EXPORT void AddCount(const char* name, std::int64_t count, vtkFieldData* data);

/// Adds an array for each number of a mesh from points.
void AddPointFieldData(const FlipReport& report, vtkFieldData* data);

//------------------------------------------------------------------------------
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
    Heights, ///< Those of points of segments are found.
    Session, ///< The engine.
    Output,
    Angles, ///< For GenerateQuality.
    NumberOfParts
  };

  /// @param has which parts this update has. @param observer may be empty.
  DELAUNAYFLIP_EXPORT UpdatePlan(
    const std::array<bool, NumberOfParts>& has, ProgressObserver observer);

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
