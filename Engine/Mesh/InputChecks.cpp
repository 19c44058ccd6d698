// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InputChecks.h"

#include "CudaDevice.h"
#include "FlipError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace delaunayflip
{

namespace
{
/// The largest mesh for which 4 * triangle + slot, and 2 * edge + side with at most 3 edges per
/// triangle, stay below 2^32.
constexpr std::int64_t LargestMesh = ((std::int64_t(1) << 32) - 2) / 6;
constexpr std::int64_t MostPoints = (std::int64_t(1) << 32) - 2;
constexpr int MostPieces = 255;

void Require(bool isValid, const std::string& message)
{
  if (!isValid)
  {
    throw InvalidOptions(message);
  }
}

/// The smallest and the largest length or area that can be meant.
constexpr double SmallestGoal = 1e-60, LargestGoal = 1e60;

struct Range
{
  double Low, High;
  const char* Words; ///< What is allowed: the end of a message.
};

constexpr Range Within(double low, double high, const char* words) { return { low, high, words }; }

constexpr Range AtLeast(double low, const char* words)
{
  return { low, std::numeric_limits<double>::infinity(), words };
}

constexpr struct AnyValue
{
} Any;

template <typename Value>
void CheckRange(const Value&, const char*, AnyValue)
{
}

/// @param name in C.
template <typename Value>
void CheckRange(Value value, std::string name, const Range& range)
{
  std::replace(name.begin(), name.end(), '_', ' ');
  const double number = static_cast<double>(value);
  Require(number >= range.Low && number <= range.High, "the " + name + " must be " + range.Words);
}

/// Requires a length or area to be 0, or one that can be meant.
void RequireSize(double size, const std::string& name)
{
  Require(size == 0.0 || (size >= SmallestGoal && size <= LargestGoal),
    name + " must be from 1e-60 to 1e60, or 0 for no limit");
}

void CheckGoals(const FlipOptions& options)
{
  constexpr double LargestAngle = 33.0;
  Require(options.MinimumAngle >= 0.0 && options.MinimumAngle <= LargestAngle,
    "MinimumAngle must be from 0 to 33 degrees");
  RequireSize(options.MaximumArea, "MaximumArea");
  RequireSize(options.MaximumEdge, "MaximumEdge");
  Require(options.PointLimit >= 0, "PointLimit must be 0 or more");
}

void CheckSphere(const FlipOptions& options)
{
  Require(options.Criterion == CriterionKind::InCircle,
    "on a sphere edges are judged by the exact orientation of four points: use the criterion "
    "'in-circle', or geometry 'surface' for opposite angles");
  Require(options.NumberOfPieces <= 1,
    "a mesh on a sphere cannot be flipped in several pieces: leave the number of pieces 0 or 1");
}
}

void RefuseParts(GeometryKind geometry)
{
  Require(geometry != GeometryKind::Sphere,
    "a mesh on a sphere cannot be flipped in several pieces: give it to one process, with at most "
    "715 million triangles");
}

void CheckOptions(const FlipOptions& options)
{
  Require(options.Geometry != GeometryKind::Mixed, "a mesh has one geometry");
  if (options.Geometry == GeometryKind::Sphere)
  {
    CheckSphere(options);
  }
  Require(options.Tolerance == -1.0 || (options.Tolerance >= 0.0 && options.Tolerance < 1.0),
    "the tolerance must be -1 (automatic), or at least 0 and below 1 radian");
  static_assert(MostPieces == 255, "the words of the table say so");
#define DELAUNAYFLIP_CHECK(name, Member, isForAll, range) CheckRange(options.Member, #name, range)
  DELAUNAYFLIP_OPTIONS(DELAUNAYFLIP_CHECK);
#undef DELAUNAYFLIP_CHECK
  CheckGoals(options);
  std::vector<int> devices = options.Devices;
  std::sort(devices.begin(), devices.end());
  Require(devices.empty() || devices.front() >= 0,
    "the numbers of GPUs that share a mesh must be 0 or more");
  const auto twice = std::adjacent_find(devices.begin(), devices.end());
  if (twice != devices.end())
  {
    throw InvalidOptions(
      "GPU " + std::to_string(*twice) + " is named twice; name each GPU that shares the mesh once");
  }
}

void CheckTieRule(const FlipOptions& options, GeometryKind geometry)
{
  if (options.TieRule == TieRuleKind::Canonical &&
    (geometry == GeometryKind::Surface || options.Criterion != CriterionKind::InCircle))
  {
    throw InvalidOptions(
      "the tie rule 'canonical' needs the in-circle criterion in planar geometry; "
      "use 'keep' for surfaces and opposite angles");
  }
}

bool HasGoals(const FlipOptions& options)
{
  return options.MinimumAngle > 0.0 || options.MaximumArea > 0.0 || options.MaximumEdge > 0.0;
}

bool HasAreas(const RegionSeed* regions, std::int64_t count)
{
  return std::any_of(
    regions, regions + count, [](const RegionSeed& region) { return region.MaximumArea > 0.0; });
}

bool HasGoals(const FlipOptions& options, const FixedEdges& mesh)
{
  return HasGoals(options) || mesh.Sizes || HasAreas(mesh.RegionSeeds, mesh.NumberOfRegionSeeds);
}

void CheckRefinement(
  const FlipOptions& options, const FixedEdges& mesh, GeometryKind geometry, bool isInXY)
{
  const bool isWanted = HasGoals(options, mesh);
  if (isWanted && geometry == GeometryKind::Surface)
  {
    throw InvalidOptions(
      "refinement is for the plane and for terrain, but the mesh is taken for a surface in space; "
      "choose the geometry 'planar-xy' to refine it in x and y, or set no goals");
  }
  if (isWanted && geometry == GeometryKind::Sphere)
  {
    throw InvalidOptions("a mesh on a sphere cannot be refined yet; set no goals");
  }
  if (isWanted && options.Criterion != CriterionKind::InCircle)
  {
    throw InvalidOptions("refinement needs the in-circle criterion, not opposite angles");
  }
  Require(mesh.NumberOfRegionSeeds == 0 || isInXY,
    "region seeds are places in x and y, but the mesh is not in this plane; use 'planar-xy', or "
    "give no region seeds");
}

void CheckSizes(const double* sizes, std::int64_t points)
{
  for (std::int64_t i = 0; i < points; ++i)
  {
    if (sizes[i] <= 0.0)
    {
      throw InvalidOptions("the size of point " + std::to_string(i) + " is not above 0");
    }
    const bool isLimit = sizes[i] <= std::numeric_limits<double>::max(); // else NaN or infinite
    const bool isSound = !isLimit || (sizes[i] >= SmallestGoal && sizes[i] <= LargestGoal);
    if (!isSound) // only then, as a message for every point would take long
    {
      throw InvalidOptions("the size of point " + std::to_string(i) +
        " must be from 1e-60 to 1e60, or NaN for no limit");
    }
  }
}

void CheckRegions(const RegionSeed* regions, std::int64_t count)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const RegionSeed& region = regions[i];
    const std::string name = "region " + std::to_string(i);
    Require(std::isfinite(region.X) && std::isfinite(region.Y),
      name + " has a coordinate that is NaN or infinite");
    RequireSize(region.MaximumArea, "the area of " + name);
  }
}

void RefuseRefinement(const FlipOptions& options, const FixedEdges& mesh, const char* what)
{
  if (HasGoals(options, mesh) || mesh.NumberOfRegionSeeds > 0)
  {
    throw InvalidOptions(std::string(what) +
      " cannot be refined; set MinimumAngle, MaximumArea and MaximumEdge to 0, and give no sizes "
      "and no region seeds");
  }
}

int CountPieces(const FlipOptions& options, std::int64_t triangles)
{
  // They are cut by a sample of the triangles, so that they are not of quite the same size.
  constexpr std::int64_t LargestPiece = LargestMesh - LargestMesh / 16;
  std::int64_t pieces = std::max(1, options.NumberOfPieces);
  if (options.NumberOfPieces == 0 && triangles > LargestMesh)
  {
    pieces = std::min<std::int64_t>(MostPieces, (triangles + LargestPiece - 1) / LargestPiece);
  }
  if (pieces > 1 && triangles > pieces * LargestPiece)
  {
    throw MeshTooLarge("the mesh has " + std::to_string(triangles) + " triangles; " +
      std::to_string(pieces) + " pieces can have at most " + std::to_string(pieces * LargestPiece));
  }
  return static_cast<int>(pieces);
}

void CheckMeshSize(std::int64_t triangles, std::int64_t points, const char* remedy)
{
  if (triangles > LargestMesh || points > MostPoints)
  {
    throw MeshTooLarge("the mesh has " + std::to_string(triangles) + " triangles and " +
      std::to_string(points) + " points; at most " + std::to_string(LargestMesh) +
      " triangles and " + std::to_string(MostPoints) + " points are supported " + remedy);
  }
}

std::int64_t CountPointsThatFit(std::int64_t triangles, std::int64_t points)
{
  return std::max<std::int64_t>(0, std::min((LargestMesh - triangles) / 2, MostPoints - points));
}

void CheckPointCount(std::int64_t points)
{
  constexpr std::int64_t Most = LargestMesh / 2; // There are fewer than two triangles per point.
  if (points > Most)
  {
    throw MeshTooLarge("there are " + std::to_string(points) + " points; at most " +
      std::to_string(Most) + " can be triangulated at once");
  }
}

std::vector<int> ParseDevices(const std::string& list)
{
  if (list == "all")
  {
    std::vector<int> devices(CountCudaDevices());
    std::iota(devices.begin(), devices.end(), 0);
    return devices;
  }
  std::vector<int> devices;
  if (list.empty())
  {
    return devices;
  }
  std::istringstream words(list + ",");
  for (std::string word; std::getline(words, word, ',');)
  {
    std::istringstream stream(word);
    int device = -1;
    const bool isNumber = (stream >> device) && (stream >> std::ws).eof();
    if (!isNumber || device < 0)
    {
      throw InvalidOptions("'" + list +
        "' is not a list of GPUs; give CUDA's numbers separated by commas (0,1), or all");
    }
    devices.push_back(device);
  }
  return devices;
}

}
