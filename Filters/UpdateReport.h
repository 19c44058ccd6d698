// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdateReport_h
#define UpdateReport_h

#include "EngineExport.h"
#include "FlipReport.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class vtkFieldData;

/// @file
/// What an update tells of itself: reports and their sums, messages and arrays.

namespace delaunayflip
{

/// What an update did to a mesh, or the sum over several meshes, flipped one after the other.
struct UpdateReport : FlipReport
{
  UpdateReport() = default;
  explicit UpdateReport(FlipReport report)
    : FlipReport(std::move(report))
  {
  }

  /// Adds the report of another mesh. Counts are summed, those of iterations row by row; the stop
  /// reason is the worse of the two, and angles are the smaller ones. Ids of defects are dropped:
  /// they mean nothing outside their mesh.
  DELAUNAYFLIP_EXPORT void Add(const UpdateReport& other);

  /// GeometryUsed in words, or "mixed".
  const char* GetGeometryName() const;

  bool HasMixedGeometry = false; ///< GeometryUsed is then that of the first mesh.
};

/// A message about a mesh.
struct Note
{
  std::string Where; ///< E.g. "block 3 (wing)"; empty if there is only one mesh.
  std::string Text;
};

/// Joins notes to one text. Each text appears once, with the first places to which it applies.
std::string Describe(const std::vector<Note>& notes);

/// What one update did to all of its meshes, and the messages about it.
struct UpdateSummary
{
  UpdateReport Report; ///< The sum over the meshes without a failure.
  int Failure = 0; ///< Of the first error, one of vtkDelaunayFlip::FailureType; 0: none.
  std::vector<Note> Errors;
  std::vector<Note> Warnings;

  /// Adds the exception that is being handled.
  /// @param where what notes call the mesh; "" if it is the only one.
  DELAUNAYFLIP_EXPORT void AddFailure(const std::string& where);
};

/// What to warn the user of, or empty. Reaching a requested iteration limit is not worth a warning.
/// @param hasTolerance whether the user has set one.
DELAUNAYFLIP_EXPORT std::string DescribeTrouble(
  const FlipReport& report, bool hasAskedForLimit, bool hasTolerance);

/// E.g. "1,234,567 points"; the number alone without a noun.
DELAUNAYFLIP_EXPORT std::string Count(std::int64_t number, const std::string& singular = "");

/// What was done, in lines of a title, ": " and a text; "" before an update and without triangles.
std::string Summarize(const UpdateReport& report);

/// Adds the columns of the iterations as arrays with one tuple per iteration. Replaces arrays with
/// the same names.
/// @param prefix of their names.
void AddIterationColumns(const FlipReport& report, const std::string& prefix, vtkFieldData* data);

/// Adds these columns, and one-tuple arrays that sum up the run, to the field data of a mesh, with
/// the prefix "DelaunayFlip:", since the user may have an array "Seconds" already.
DELAUNAYFLIP_EXPORT void AddFieldData(const UpdateReport& report, vtkFieldData* data);

/// The same for what is known of points.
void AddPointFieldData(const PointCounts& counts, vtkFieldData* data);

}

#endif
