// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ConstraintEdges_h
#define ConstraintEdges_h

#include "DataArrays.h"
#include "EngineExport.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

class FlipSession;

/// A hash of ids or coordinates.
struct HashWords
{
  template <typename Word, std::size_t Count>
  std::size_t operator()(const std::array<Word, Count>& words) const
  {
    // Coordinates on a lattice differ only in a few high bits: multiply, then fold those down.
    std::uint64_t hash = 0;
    for (const Word& word : words)
    {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &word, sizeof(word));
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15u; // 2^64 / golden ratio, odd
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Numbers the distinct places of points. Coordinates must be equal; -0 equals 0.
class DELAUNAYFLIP_EXPORT PointPlaces
{
public:
  static constexpr std::int64_t None = -1;

  /// @param asFloats whether coordinates are rounded to float before they are compared.
  explicit PointPlaces(bool asFloats)
    : AsFloats(asFloats)
  {
  }

  /// The number of a point's place: 0, 1, ... in the order of first calls. A point with a
  /// coordinate that is NaN or infinite gets a place that Find never returns.
  std::int64_t Add(const PointArray& points, std::int64_t point);

  /// The number of a point's place, or None if no point was added there. Thread-safe.
  std::int64_t Find(const PointArray& points, std::int64_t point) const;

  std::int64_t GetNumberOfPlaces() const { return this->NumberOfPlaces; }

private:
  using Place = std::array<double, 3>;
  /// @returns whether all coordinates are finite.
  bool Read(const PointArray& points, std::int64_t point, Place& place) const;

  bool AsFloats;
  std::int64_t NumberOfPlaces = 0;
  std::unordered_map<Place, std::int64_t, HashWords>
    Numbers; ///< Never iterated over: its order varies.
};

using PointPair = std::array<std::int64_t, 2>;

/// Which edges are constraints, and what happens to those that the mesh does not have.
struct ConstraintSettings
{
  bool LinesAsConstraints = true; ///< The lines of the mesh are constraints.
  bool InsertLines = false; ///< Those that are no edges of the mesh are inserted.
  bool InsertConstraints = true; ///< Whether edges of the second input are inserted.
};

/// Edges that must stay.
struct ConstraintEdges
{
  std::vector<PointPair> Pairs; ///< Unique, in the order given, the smaller id of each pair first.
  std::vector<unsigned char> ToInsert; ///< One flag per pair, as in TriangleMesh.
  std::int64_t Unmatched = 0; ///< How many edges of the second input the mesh does not have.
  std::vector<char> AreHere; ///< One flag per edge of the second input: the mesh has both ends.
  std::string FirstStranger; ///< Where the first edge lies that ends where there is no point.
};

/// Finds the edges along the lines of the mesh and along the lines and polygons of the others. The
/// ids of the others are those of the mesh if the others have no points or the same points as the
/// mesh; otherwise edges are matched by the coordinates of their points.
/// @param mesh the points and triangles of `input`. @param others the second input, or null.
/// @throws InvalidMesh when a cell names a point that does not exist; RunAborted.
ConstraintEdges FindConstraintEdges(const TriangleMesh& mesh, vtkPolyData* input,
  vtkPolyData* others, const ConstraintSettings& settings, const ProgressObserver& progress);

/// Lines with points of their own, two in `ends` for each; null if there are none.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkPolyData> MakeLines(
  const std::vector<std::array<double, 3>>& ends, bool areFloats);

/// The edges along the lines and polygons of several second inputs, as lines with points of their
/// own; null if there are none.
/// @param sources are pairs of a second input and a mesh, or null. An input without points names
/// points of that mesh.
/// @throws InvalidMesh.
DELAUNAYFLIP_EXPORT vtkSmartPointer<vtkPolyData> JoinConstraints(
  const std::vector<std::pair<vtkPolyData*, vtkPolyData*>>& sources);

//------------------------------------------------------------------------------
/// The range of the finite heights of the first points. Low exceeds High if there are none.
struct HeightRange
{
  double Low = INFINITY, High = -INFINITY;

  HeightRange(const PointArray& points, std::int64_t count);

  bool IsEmpty() const { return this->Low > this->High; }
  bool IsZero() const { return this->Low == 0.0 && this->High == 0.0; }
};

/// Points that segments add.
struct PointsWithoutHeights
{
  /// Those of lines, outlines or holes, each of the three by itself, that have z = 0 wherever it is
  /// finite. Empty if the given points have z = 0, too.
  std::vector<std::int64_t> AtZero;
  std::vector<std::int64_t> NotFinite; ///< Those with a z that is NaN or infinite.

  std::vector<std::int64_t> List() const
  {
    std::vector<std::int64_t> all = this->AtZero;
    all.insert(all.end(), this->NotFinite.begin(), this->NotFinite.end());
    return all;
  }
};

/// Where the segments of a triangulation come from; see TriangulationRequest.
struct SegmentSource
{
  vtkPolyData* Others = nullptr; ///< The second input; null if there is none.
  bool ClosedLinesAsRings = true;
  bool ConvertsToDoubles = false; ///< See TriangulationRequest.
};

/// The segments of both inputs of a triangulation, as pairs of point ids. New points of the second
/// input follow those of the first one.
class SegmentList
{
public:
  /// @param points receives the points of the first input and the new ones.
  SegmentList(const SegmentSource& source, vtkPolyData* given, vtkPolyData* points,
    const ProgressObserver& progress);

  /// Finds the added points without heights, if the given points have heights.
  PointsWithoutHeights FindPointsWithoutHeights(std::int64_t firstHole) const;

  /// Stores the edges that segments have become, as lines, and the ids of their cells.
  void StoreEdges(const FlipSession& session, vtkPolyData* output) const;

  std::vector<std::int64_t> Ends; ///< Pairs of ids.
  std::vector<std::int32_t> Rings; ///< One number per segment.
  /// One number per segment: the id of its cell. Cells of the first input are numbered after all
  /// cells of the second one.
  std::vector<vtkIdType> Cells;
  Defect ShortArrays; ///< Point arrays of the second input that are left out.
  /// The names of the arrays in which added points have values of the second input.
  std::set<std::string> Received;

private:
  enum class CellKind
  {
    Line,
    LineOrRing, ///< A line that ends where it begins is a ring.
    Ring
  };

  /// @param ids the id of each point that the cells name. Empty: the cells name these ids.
  void AddCells(vtkCellArray* cells, const PointIdCheck& check, const std::vector<vtkIdType>& ids,
    CellKind kind);
  /// Adds the segments along a path. The number of a ring is that of its cell.
  void AddPath(const std::vector<vtkIdType>& path, bool isRing, vtkIdType cell);
  /// Whether a line of three or more points ends at the place where it begins.
  bool IsClosed(const std::vector<vtkIdType>& path) const;
  /// Adds the points of the segments that are new. @returns the id of each point of the segments.
  std::vector<vtkIdType> AddPoints(const PointArray& own, const PointArray& others,
    vtkPolyData* segments, const ProgressObserver& observer);

  vtkPolyData* Given;
  vtkPolyData* Points;
  bool ConvertsToDoubles;
  vtkIdType FirstNumber = 0; ///< What is added to cell ids.
  std::size_t FirstOther = 0; ///< The index in Ends at which those of the second input begin.
};

}

#endif
