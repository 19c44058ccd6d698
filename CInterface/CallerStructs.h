// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CALLERSTRUCTS_H
#define DELAUNAYFLIP_CALLERSTRUCTS_H

#include "delaunayflip_c.h"

#include "DelaunayFlip.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

/// @file
/// Converts the structs of a C program to the engine's types, and reports of the engine to structs.
/// Every function throws InvalidCall if the program breaks a rule of delaunayflip_c.h.

namespace delaunayflip
{

/// A call that breaks a rule of the header.
class InvalidCall : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// @throws InvalidCall
inline void Require(bool isKept, const char* rule)
{
  if (!isKept)
  {
    throw InvalidCall(rule);
  }
}

/// A struct with its size; all other members are 0.
template <typename Struct>
Struct MakeEmpty()
{
  Struct values = {};
  values.size = sizeof(Struct);
  return values;
}

/// Completes the caller's struct: a program compiled with an older header has fewer members; the
/// others keep their defaults.
template <typename Struct>
Struct Complete(const Struct* given, void (*initialize)(Struct*))
{
  Require(given, "a struct is null");
  Require(given->size >= static_cast<std::int64_t>(sizeof(given->size)),
    "the size of a struct is not set: call its _init function first");
  Struct complete;
  initialize(&complete);
  std::memcpy(&complete, given, std::min(sizeof(Struct), static_cast<std::size_t>(given->size)));
  complete.size = sizeof(Struct);
  return complete;
}

/// The polygons with all members that this library knows.
delaunayflip_polygons CompletePolygons(const delaunayflip_polygons* given);

/// Views of the arrays of a mesh in the host's memory.
TriangleMesh ToMesh(const delaunayflip_mesh* given);

/// Views of the points and segments to triangulate.
PointInput ToPointInput(const delaunayflip_points& points);

/// @param options of the run.
PointOptions ToPointOptions(const delaunayflip_points& points, const FlipOptions& options);

/// Views of the arrays of a complete mesh in device memory.
DeviceMesh ToDeviceMesh(const delaunayflip_mesh& mesh);

/// Whether `memory`, a delaunayflip_memory, is that of a device.
bool IsOnDevice(std::int32_t memory);

/// A view of an array for three ids per triangle, of a delaunayflip_type.
MutableTriangleArray ToOutput(void* ids, std::int64_t triangles, std::int32_t type);

GeometryKind ToGeometry(std::int32_t value);

/// The engine's defaults where `given` is null.
FlipOptions ToOptions(const delaunayflip_options* given);

/// The engine's observers that call the caller's functions, if there are any.
struct Observers
{
  explicit Observers(const delaunayflip_callbacks* given);

  ProgressObserver Progress;
  FlipObserver Iteration;
};

delaunayflip_iteration ToC(const IterationRecord& record);

/// A report, kept for the C struct that points to its strings.
class KeptReport
{
public:
  /// @param numbers the numbers by which the report names triangles; null: their indices.
  KeptReport(FlipReport report, const std::int64_t* numbers);

  /// Fills as many bytes of `target` as target.size says.
  void Fill(delaunayflip_report& target) const;

private:
  FlipReport Report;
  std::string Defects;
};

}

#endif
