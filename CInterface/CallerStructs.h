// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CALLERSTRUCTS_H
#define DELAUNAYFLIP_CALLERSTRUCTS_H

#include "delaunayflip_c.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

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

/// @throws RunAborted if an observer has asked to stop.
inline void RequireNotStopped(bool isComplete)
{
  if (!isComplete)
  {
    throw RunAborted();
  }
}

/// Requires that the caller has set the size of a struct.
template <typename Struct>
void RequireSize(const Struct* given)
{
  Require(given && given->size >= static_cast<std::int64_t>(sizeof(given->size)),
    "a struct is null, or its size is not set: call its _init function first");
}

/// Requires that the caller's array of `count` things, called `name`, can exist.
inline void RequireArray(const void* array, std::int64_t count, const std::string& name)
{
  constexpr std::int64_t Most = std::int64_t(1) << 48; // more than any memory holds
  Require(count >= 0, ("number_of_" + name + " is negative").c_str());
  Require(count <= Most, ("number_of_" + name + " is larger than any memory").c_str());
  Require(array || count == 0, (name + " is null").c_str());
}

/// A struct with its size; all other members are 0.
template <typename Struct>
Struct MakeEmpty()
{
  Struct values = {};
  values.size = sizeof(Struct);
  return values;
}

/// Writes the values to a caller's struct of `size` bytes, which may have fewer members or more.
template <typename Struct>
void Initialize(Struct* target, std::int64_t size, const Struct& values)
{
  if (target && size >= static_cast<std::int64_t>(sizeof(values.size)))
  {
    const auto bytes = static_cast<std::size_t>(size);
    std::memset(static_cast<void*>(target), 0, bytes);
    std::memcpy(target, &values, std::min(sizeof(values), bytes));
    std::memcpy(target, &size, sizeof(size));
  }
}

/// Completes the caller's struct: a program compiled with an older header has fewer members; the
/// others keep their defaults.
template <typename Struct>
Struct Complete(const Struct* given, void (*initialize)(Struct*, std::int64_t))
{
  RequireSize(given);
  Struct complete;
  initialize(&complete, sizeof(complete));
  std::memcpy(&complete, given, std::min(sizeof(Struct), static_cast<std::size_t>(given->size)));
  complete.size = sizeof(Struct);
  return complete;
}

// Both enumerations have the same order.
static_assert(static_cast<int>(StopReasonKind::Running) == DELAUNAYFLIP_RUNNING, "");
static_assert(static_cast<int>(StopReasonKind::Aborted) == DELAUNAYFLIP_ABORTED, "");

template <typename Enumeration>
Enumeration ToEnumeration(std::int32_t value, Enumeration last, const std::string& name)
{
  Require(value >= 0 && value <= static_cast<std::int32_t>(last),
    (name + " is no delaunayflip_" + name).c_str());
  return static_cast<Enumeration>(value);
}

/// The coordinates of points or places as `Array`. Its constructors take the components too, if
/// they are given. @param name "point" or "place".
template <typename Array, typename... Components>
Array ToCoordinates(const void* values, std::int64_t count, std::int32_t type,
  const std::string& name, Components... components)
{
  RequireArray(values, count, name + "s");
  Require(type == DELAUNAYFLIP_FLOAT32 || type == DELAUNAYFLIP_FLOAT64,
    (name + "_type is neither DELAUNAYFLIP_FLOAT32 nor DELAUNAYFLIP_FLOAT64").c_str());
  return type == DELAUNAYFLIP_FLOAT32
    ? Array(static_cast<const float*>(values), count, components...)
    : Array(static_cast<const double*>(values), count, components...);
}

template <typename Array, typename Struct, typename... Components>
Array ToPoints(const Struct& c, Components... components)
{
  return ToCoordinates<Array>(c.points, c.number_of_points, c.point_type, "point", components...);
}

inline FixedEdges ToFixedEdges(const delaunayflip_mesh& c, const std::vector<RegionSeed>& seeds)
{
  RequireArray(c.constraint_edges, c.number_of_constraint_edges, "constraint_edges");
  return { c.constraint_edges, c.number_of_constraint_edges, c.constraints_to_insert, c.regions,
    c.frozen_triangles, c.sizes, seeds.data(), static_cast<std::int64_t>(seeds.size()) };
}

/// A view of the caller's integers as `Array`. 32-bit ids have the type Id32, 64-bit ids Id64.
template <typename Array, typename Id32, typename Id64, typename Void>
Array ToIds(Void* ids, std::int64_t triangles, std::int32_t type)
{
  RequireArray(ids, triangles, "triangles");
  Require(type == DELAUNAYFLIP_INT32 || type == DELAUNAYFLIP_INT64,
    "id_type is neither DELAUNAYFLIP_INT32 nor DELAUNAYFLIP_INT64");
  return type == DELAUNAYFLIP_INT32 ? Array(static_cast<Id32*>(ids), triangles)
                                    : Array(static_cast<Id64*>(ids), triangles);
}

inline TriangleArray ToTriangles(const delaunayflip_mesh& c)
{
  return ToIds<TriangleArray, const std::int32_t, const std::int64_t>(
    c.triangles, c.number_of_triangles, c.id_type);
}

/// Whether `memory`, a delaunayflip_memory, is that of a device.
inline bool IsOnDevice(std::int32_t memory)
{
  Require(memory == DELAUNAYFLIP_HOST || memory == DELAUNAYFLIP_CUDA,
    "memory is neither DELAUNAYFLIP_HOST nor DELAUNAYFLIP_CUDA");
  return memory == DELAUNAYFLIP_CUDA;
}

/// Views of the arrays of a mesh in the host's memory, and of these region seeds.
inline TriangleMesh ToMesh(
  const delaunayflip_mesh* given, const std::vector<RegionSeed>& seeds = {})
{
  const delaunayflip_mesh c = Complete(given, delaunayflip_mesh_init_sized);
  Require(!IsOnDevice(c.memory), "this function needs a mesh in the host's memory");
  Require(c.point_components == 3, "point_components must be 3 for points in the host's memory");
  return { ToFixedEdges(c, seeds), ToPoints<PointArray>(c), ToTriangles(c), {}, {} };
}

inline PlaneArray ToPlane(const delaunayflip_points& c)
{
  Require(c.point_components == 2 || c.point_components == 3, "point_components is not 2 or 3");
  return ToPoints<PlaneArray>(c, c.point_components);
}

/// @param name of the array.
inline std::vector<RegionSeed> ToRegions(
  const delaunayflip_region* given, std::int64_t count, const std::string& name)
{
  RequireArray(given, count, name);
  std::vector<RegionSeed> regions;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const delaunayflip_region& region = given[i];
    regions.push_back({ region.x, region.y, region.label, region.maximum_area });
  }
  return regions;
}

/// Views of the points and segments to triangulate, and of these regions.
inline PointInput ToPointInput(const delaunayflip_points& c, const std::vector<RegionSeed>& regions)
{
  RequireArray(c.segments, c.number_of_segments, "segments");
  RequireArray(c.hole_seeds, c.number_of_hole_seeds, "hole_seeds");
  PointInput input;
  input.Points = ToPlane(c);
  input.Segments = c.segments;
  input.NumberOfSegments = c.number_of_segments;
  input.Rings = c.rings;
  input.FirstHole = c.first_hole;
  input.HoleSeeds = c.hole_seeds;
  input.NumberOfHoleSeeds = c.number_of_hole_seeds;
  input.FirstAdded = c.first_added;
  input.Sizes = c.sizes;
  input.Regions = regions.data();
  input.NumberOfRegions = static_cast<std::int64_t>(regions.size());
  input.OnDevice = IsOnDevice(c.memory);
  input.Stream = { c.stream };
  return input;
}

/// Calls visit(member, the engine's) for each option of points.
template <typename Struct, typename Options, typename Visit>
void PairPointOptions(Struct& c, Options& options, const Visit& visit)
{
  visit(c.alpha, options.Alpha);
  visit(c.longest_edge, options.LongestEdge);
  visit(c.point_tolerance, options.PointTolerance);
  visit(c.split_crossings, options.SplitCrossings);
  visit(c.ring_rule, options.RingRule);
  visit(c.projection, options.Projection);
  visit(c.minimum_angle, options.MinimumAngle);
  visit(c.maximum_area, options.MaximumArea);
  visit(c.maximum_edge, options.MaximumEdge);
  visit(c.keep_boundary, options.KeepBoundary);
  visit(c.point_limit, options.PointLimit);
}

/// Gives an option the value of another type: a number, a switch, a choice, or devices, which are a
/// text in C.
constexpr struct
{
  template <typename From, typename To>
  void operator()(const From& from, To& to) const
  {
    to = static_cast<To>(from);
  }
  void operator()(const char* devices, std::vector<int>& to) const
  {
    to = ParseDevices(devices ? devices : "");
  }
  void operator()(const std::vector<int>&, const char*& devices) const
  {
    devices = nullptr; // the defaults name no devices
  }
} CopyOption;

/// Refuses members for the refinement of meshes, which would have no effect on points.
inline void RequireNoGoals(const FlipOptions& options)
{
  const bool hasGoal =
    options.MinimumAngle != 0.0 || options.MaximumArea != 0.0 || options.MaximumEdge != 0.0;
  if (hasGoal || options.KeepBoundary || options.PointLimit != 0)
  {
    throw InvalidOptions("minimum_angle, maximum_area, maximum_edge, keep_boundary and point_limit "
                         "in delaunayflip_options are for meshes; for points they are in "
                         "delaunayflip_points");
  }
}

/// @param options of the run.
inline PointOptions ToPointOptions(const delaunayflip_points& c, const FlipOptions& options)
{
  RequireNoGoals(options);
  ToEnumeration(c.ring_rule, RingRuleKind::Orientation, "ring_rule");
  ToEnumeration(c.projection, ProjectionKind::OpenSphere, "projection");
  PointOptions all{ options };
  PairPointOptions(c, all, CopyOption);
  return all;
}

/// Views of the arrays of a query, and its numbers.
inline PlaceQuery ToQuery(const delaunayflip_query* given)
{
  const delaunayflip_query c = Complete(given, delaunayflip_query_init_sized);
  const InterpolationKind method = ToEnumeration(c.method, InterpolationKind::Natural, "method");
  const OutsideKind outside = ToEnumeration(c.outside, OutsideKind::Nearest, "outside");
  PlaceQuery query;
  query.Raster = { { c.origin_x, c.origin_y }, { c.step_x, c.step_y }, c.columns, c.rows };
  if (c.columns == 0 || c.rows == 0)
  {
    Require(c.place_components >= 2, "place_components is less than 2");
    query.Places = ToCoordinates<PlaneArray>(
      c.places, c.number_of_places, c.place_type, "place", c.place_components);
  }
  Require(!c.values || c.results, "results is null, but there are values");
  query.Degrees = c.degrees != 0;
  query.Triangles = c.triangles;
  query.Values = c.values;
  query.Components = c.value_components;
  query.Method = method;
  query.Outside = outside;
  query.Results = c.results;
  query.OnDevice = IsOnDevice(c.memory);
  query.Stream = { c.stream };
  return query;
}

/// Views of the arrays of a complete mesh in device memory, and of these region seeds.
inline DeviceMesh ToDeviceMesh(
  const delaunayflip_mesh& c, const std::vector<RegionSeed>& seeds = {})
{
  Require(c.point_components == 2 || c.point_components == 3, "point_components is not 2 or 3");
  return { ToFixedEdges(c, seeds), ToPoints<DevicePointArray>(c, c.point_components),
    ToTriangles(c), { c.stream } };
}

/// A view of an array for three ids per triangle, of a delaunayflip_type.
inline MutableTriangleArray ToOutput(void* ids, std::int64_t triangles, std::int32_t type)
{
  return ToIds<MutableTriangleArray, std::int32_t, std::int64_t>(ids, triangles, type);
}

/// Calls visit(member, the engine's) for each option.
template <typename Struct, typename Options, typename Visit>
void PairOptions(Struct& c, Options& options, const Visit& visit)
{
#define DELAUNAYFLIP_PAIR(name, Member, isForAll, range) visit(c.name, options.Member)
  DELAUNAYFLIP_OPTIONS(DELAUNAYFLIP_PAIR);
#undef DELAUNAYFLIP_PAIR
}

/// The engine's defaults where `given` is null.
inline FlipOptions ToOptions(const delaunayflip_options* given)
{
  if (!given)
  {
    return {};
  }
  const delaunayflip_options c = Complete(given, delaunayflip_options_init_sized);
  ToEnumeration(c.geometry, GeometryKind::Sphere, "geometry");
  ToEnumeration(c.criterion, CriterionKind::OppositeAngles, "criterion");
  ToEnumeration(c.tie_rule, TieRuleKind::Canonical, "tie_rule");
  ToEnumeration(c.backend, BackendKind::Threads, "backend");
  FlipOptions options;
  PairOptions(c, options, CopyOption);
  return options;
}

inline delaunayflip_iteration ToC(const IterationRecord& record)
{
  return { record.Iteration, record.Tested, record.NonDelaunay, record.Flipped, record.Excluded,
    record.Blocked, record.MinimumAngle, record.Seconds };
}

/// None if `given` is null.
inline delaunayflip_callbacks ToCallbacks(const delaunayflip_callbacks* given)
{
  return given ? Complete(given, delaunayflip_callbacks_init_sized)
               : MakeEmpty<delaunayflip_callbacks>();
}

/// An observer that calls the caller's function, if there is one.
inline ProgressObserver ToProgress(const delaunayflip_callbacks* given)
{
  const delaunayflip_callbacks c = ToCallbacks(given);
  const auto call = [c](double share) { return c.progress(share, c.user) != 0; };
  if (!c.progress)
  {
    return nullptr;
  }
  return call;
}

/// The caller's function for a session that keeps its observer. It is called only as long as this
/// lives; afterwards nothing is told, and nothing is stopped.
class ProgressOfCall
{
public:
  explicit ProgressOfCall(const delaunayflip_callbacks* given)
    : Observer(ToProgress(given))
  {
  }
  ~ProgressOfCall() { *this->IsOver = true; }
  ProgressOfCall(const ProgressOfCall&) = delete;
  ProgressOfCall& operator=(const ProgressOfCall&) = delete;

  ProgressObserver Get() const
  {
    const auto call = [isOver = this->IsOver, observer = this->Observer](double share)
    { return *isOver || observer(share); };
    return this->Observer ? ProgressObserver(call) : nullptr;
  }

private:
  ProgressObserver Observer;
  std::shared_ptr<bool> IsOver = std::make_shared<bool>(false);
};

inline FlipObserver ToObserver(const delaunayflip_callbacks* given)
{
  const delaunayflip_callbacks c = ToCallbacks(given);
  const auto call = [c](const IterationRecord& record)
  {
    const delaunayflip_iteration copy = ToC(record);
    return c.iteration(&copy, c.user) != 0;
  };
  if (!c.iteration)
  {
    return nullptr;
  }
  return call;
}

/// Calls visit(bytes, number) for each number of a report, with its place in the C struct: there
/// the numbers follow one another in the order of ForEachNumber, with 8 bytes each.
template <typename Byte, typename Report, typename Visit>
void ForEachPlace(Byte* c, Report& report, const Visit& visit)
{
  Byte* place = c + offsetof(delaunayflip_report, total_flips);
  ForEachNumber(
    [&](const char*, NumberKind, auto& number)
    {
      visit(place, number);
      place += sizeof(std::int64_t);
    },
    report);
}

/// A number as the C struct has it.
template <typename Number>
using NumberInC = std::conditional_t<std::is_floating_point<Number>::value, double, std::int64_t>;

/// A report with the numbers of a C struct, for Summarize.
/// @param iterations becomes their number. A sum over meshes may have any, so there are no records.
inline FlipReport ToReport(const delaunayflip_report* given, std::int64_t& iterations)
{
  const delaunayflip_report c = Complete(given, delaunayflip_report_init_sized);
  FlipReport report;
  ForEachPlace(reinterpret_cast<const char*>(&c), report,
    [](const char* place, auto& number)
    {
      NumberInC<std::decay_t<decltype(number)>> value;
      std::memcpy(&value, place, sizeof(value));
      number = static_cast<std::decay_t<decltype(number)>>(value);
    });
  report.GeometryUsed = ToEnumeration(c.geometry_used, GeometryKind::Mixed, "geometry");
  report.GeometryReason = c.geometry_reason ? c.geometry_reason : "";
  report.StopReason = ToEnumeration(c.stop_reason, StopReasonKind::Running, "stop_reason");
  Require(c.number_of_iterations >= 0, "number_of_iterations is negative");
  iterations = c.number_of_iterations;
  return report;
}

/// A report, kept for the C struct that points to its strings.
class KeptReport
{
public:
  /// Keeps a report, and fills as many bytes of `target` as target.size says.
  /// @param numbers the numbers by which the report names triangles; null: their indices.
  void Fill(const FlipReport& report, const std::int64_t* numbers, delaunayflip_report& target)
  {
    this->Report = report;
    for (Defect& defect : this->Report.Defects)
    {
      if (numbers && defect.Ids == DefectIds::Triangles)
      {
        std::vector<std::int64_t>& ids = defect.FirstIds;
        for (std::int64_t& id : ids)
        {
          id = numbers[id];
        }
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end()); // name each cell once
      }
    }
    this->Defects = DescribeDefects(this->Report.Defects);
    this->Texts.clear();
    this->Crossed.clear();
    for (const Defect& defect : this->Report.Defects)
    {
      this->Texts.push_back(DescribeDefects({ defect }));
      std::vector<std::int64_t>& crossed = this->Crossed.emplace_back();
      for (const CrossedEdge& edge : defect.Crossed)
      {
        crossed.insert(crossed.end(), { edge.Number, edge.Ends[0], edge.Ends[1] });
      }
    }
    delaunayflip_report c;
    delaunayflip_report_init_sized(&c, sizeof(c));
    ForEachPlace(reinterpret_cast<char*>(&c), report,
      [](char* place, const auto& number)
      {
        const NumberInC<std::decay_t<decltype(number)>> value = number;
        std::memcpy(place, &value, sizeof(value));
      });
    c.geometry_used = static_cast<std::int32_t>(report.GeometryUsed);
    c.geometry_reason = this->Report.GeometryReason.c_str();
    c.backend = this->Report.Backend.c_str();
    c.fallback = this->Report.Fallback.c_str();
    c.tolerance = this->Report.Tolerance.c_str();
    c.defects = this->Defects.c_str();
    c.stop_reason = static_cast<std::int32_t>(report.StopReason);
    c.number_of_iterations = static_cast<std::int64_t>(report.Iterations.size());
    c.size = target.size;
    std::memcpy(&target, &c, std::min(sizeof(c), static_cast<std::size_t>(target.size)));
  }

  std::int64_t CountDefects() const { return static_cast<std::int64_t>(this->Texts.size()); }

  /// @returns a defect with pointers that are valid until the next Fill.
  delaunayflip_defect GetDefect(std::int64_t i) const
  {
    const Defect& defect = this->Report.Defects[i];
    const std::vector<std::int64_t>& crossed = this->Crossed[i];
    return { static_cast<std::int32_t>(defect.Kind),
      static_cast<std::int32_t>(defect.FirstIds.size()), defect.Count, defect.FirstIds.data(),
      crossed.empty() ? nullptr : crossed.data(), this->Texts[i].c_str() };
  }

private:
  FlipReport Report;
  std::string Defects;
  std::vector<std::string> Texts; ///< The text of each defect, then those of what follows.
  std::vector<std::vector<std::int64_t>> Crossed;
};

}

#endif
