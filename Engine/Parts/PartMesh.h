// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTMESH_H
#define DELAUNAYFLIP_PARTMESH_H

#include "FlipOptions.h"
#include "FlipReport.h"
#include "HostMemory.h"
#include "PartSurvey.h"
#include "PieceFlip.h"
#include "Records.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Two points, the smaller first: keys or ids.
using PointPair = std::array<std::int64_t, 2>;

inline PointPair MakePair(std::int64_t a, std::int64_t b)
{
  return { std::min(a, b), std::max(a, b) };
}

struct PairHash
{
  std::size_t operator()(const PointPair& pair) const
  {
    return ScatterBits(pair[0] + ScatterBits(pair[1]));
  }
};

/// Never iterated over: its order varies.
template <typename Value>
using PairMap = std::unordered_map<PointPair, Value, PairHash>;

/// What is known about the edge of a triangle opposite to one of its corners.
enum EdgeMark : unsigned char
{
  FixedMark = 1, ///< The edge never flips.
  SeamMark = 8 ///< A seam edge: it may flip, and its other triangle is on another rank.
};

/// The state of a triangle in an iteration of a round (RoundFlips).
enum class VisitState : unsigned char
{
  None,
  Listed, ///< Its edges will be judged in this iteration.
  Visited, ///< Its edges have been judged in this iteration.
  Next ///< Its edges will be judged in the next iteration.
};

/// A triangle with its marks. `mark << slot` is the bit for the edge opposite to corner `slot`.
struct PartTriangle
{
  std::int32_t Points[3]; ///< Ids of this rank.
  std::int32_t Flips;
  std::int64_t Origin; ///< The number of its input slot, counted over all ranks.
  unsigned char Marks;
  bool HasLeft; ///< It is on another rank now, and its place is empty.
  bool IsNoted; ///< In the list of changed triangles.
  VisitState Visit;

  /// The marks of one edge, shifted to slot 0; SetMarks takes them in the same form.
  unsigned char GetMarks(int slot) const
  {
    return static_cast<unsigned char>((this->Marks >> slot) & (FixedMark | SeamMark));
  }
  void SetMarks(int slot, unsigned char marks)
  {
    const int others = this->Marks & ~((FixedMark | SeamMark) << slot);
    this->Marks = static_cast<unsigned char>(others | (marks << slot));
  }
  bool Has(EdgeMark mark, int slot) const { return (this->GetMarks(slot) & mark) != 0; }

  /// The ends of the edge opposite to a corner, in the direction in which the triangle runs.
  std::int32_t GetStart(int slot) const { return this->Points[(slot + 1) % 3]; }
  std::int32_t GetEnd(int slot) const { return this->Points[(slot + 2) % 3]; }
  PointPair GetEdge(int slot) const { return MakePair(this->GetStart(slot), this->GetEnd(slot)); }
  /// Whether the three points differ. A triangle that names a point twice has no edges.
  bool HasEdges() const
  {
    const std::int32_t* p = this->Points;
    return p[0] != p[1] && p[1] != p[2] && p[2] != p[0];
  }
  /// Whether the edge opposite to a corner has these ends, in either order.
  bool HasEdge(int slot, std::int32_t a, std::int32_t b) const
  {
    const std::int32_t start = this->GetStart(slot);
    const std::int32_t end = this->GetEnd(slot);
    return ((start == a && end == b) || (start == b && end == a)) && this->HasEdges();
  }
};

using PartTriangles = HostVector<PartTriangle>;

/// A triangle of a rank and one of its corners; no corner by default.
struct PartCorner
{
  std::int64_t Triangle = -1; ///< -1: there is none.
  int Slot = 0;

  bool operator<(const PartCorner& other) const
  {
    return std::tie(this->Triangle, this->Slot) < std::tie(other.Triangle, other.Slot);
  }
};

/// The marks of the edges of a part (EdgeMark, shifted to slot 0), by the ends of the edges.
using MarkedEdges = PairMap<unsigned char>;

/// The star of every point of a rank: the corners of triangles at the point. The stars are linked
/// lists that are kept up to date, so a round takes no time for triangles that it does not change.
class PointStars
{
public:
  /// Begins with empty lists. More triangles and points may be added later.
  /// @param capacity the number of triangles to reserve memory for.
  void Begin(std::int64_t triangles, std::int64_t capacity, std::int64_t points);
  /// Adds a corner that is in no list.
  void Add(const PartCorner& corner, std::int32_t point);

  /// Removes a corner from its list.
  void Remove(const PartCorner& corner, std::int32_t point);

  /// Calls visit(corner) for every corner at a point.
  template <typename Visit>
  void ForEach(std::int32_t point, const Visit& visit) const
  {
    for (std::uint32_t number = this->GetFirst(point); number != None;
         number = this->Links[number].Next)
    {
      visit(GetCorner(number));
    }
  }

  /// Calls visit(corner) for corners at two points in turn, until it returns true or one of the
  /// points has no more corners. So a point with very many corners costs no more than the other.
  template <typename Visit>
  void FindAtEither(std::int32_t one, std::int32_t other, const Visit& visit) const
  {
    std::uint32_t number = this->GetFirst(one);
    std::uint32_t next = this->GetFirst(other);
    while (number != None && next != None && !visit(GetCorner(number)))
    {
      number = std::exchange(next, this->Links[number].Next);
    }
  }

private:
  static constexpr std::uint32_t None = 0xFFFFFFFFu;

  /// The neighbours of a corner in its list.
  struct Link
  {
    std::uint32_t Next, Previous;
  };

  static PartCorner GetCorner(std::uint32_t number)
  {
    return { number / 3, static_cast<int>(number % 3) };
  }
  std::uint32_t GetFirst(std::int32_t point) const
  {
    return static_cast<std::size_t>(point) < this->First.size() ? this->First[point] : None;
  }

  HostVector<std::uint32_t> First; ///< By point: the number of a corner, 3 * triangle + slot.
  HostVector<Link> Links; ///< By that number.
};

/// A triangle as it is sent to another rank.
struct TravellingTriangle
{
  PartTriangle Triangle; ///< With other ids there.
  std::int64_t Keys[3];
  double Coordinates[3][3];
};

/// The triangles that a rank has at the moment, and all points that it has ever had.
class PartMesh
{
public:
  /// Starts with the triangles of the caller, in their slots.
  /// @param firstOrigin the number of the first of them among the triangles of all ranks.
  PartMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin);
  /// Takes what flips have made of the triangles, in the same slots.
  void Take(const TriangleArray& triangles);

  PartTriangles Triangles; ///< A place may be empty (HasLeft).

  /// Measures the angles of all triangles.
  AngleSums MeasureAngles(const PartSurvey& survey, int threads) const;
  /// Marks edges, and begins the lists of corners at every point (PointStars), with which rounds
  /// find triangles without a pass over all. From now on only the functions below may change
  /// triangles.
  void BeginRounds(const MarkedEdges& marks);
  /// Flips the edge opposite to two corners.
  void Flip(const PartCorner& one, const PartCorner& other);
  /// Marks the edge opposite to a corner as a seam edge.
  void SetSeam(const PartCorner& corner);
  /// Removes this mark: both triangles of the edge are on this rank.
  void ClearSeam(const PartCorner& corner);
  /// The triangles that have changed or arrived since the last call, and those at points that have
  /// become shared. Some may have left by now. The first call returns all at shared points.
  std::vector<std::int64_t> TakeChanged();
  /// The keys of seam edges that have lost their triangle here since the last call. They may
  /// include edges that have a triangle here again.
  std::vector<PointPair> TakeLostSeams() { return std::exchange(this->LostSeams, {}); }
  const PointStars& GetStars() const { return this->Stars; }
  /// The mate of a corner: the corner of another triangle here that is opposite to the same edge.
  PartCorner FindMate(const PartCorner& corner) const;
  /// Finds the mate of a corner. There is none if the edge is a fixed edge or a seam edge.
  PartCorner FindOpenMate(const PartCorner& corner) const;
  /// Prefetches the points of a triangle.
  void PrefetchPoints(std::int64_t triangle) const;
  /// Whether a triangle here has an edge between these points.
  bool HasEdge(std::int64_t a, std::int64_t b) const
  {
    return this->FindEdge(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)).Triangle >= 0;
  }

  bool IsShared(std::int64_t point) const { return this->Points.Shared[point] != 0; }
  /// Whether two different points are shared.
  bool AreShared(const PointPair& ends) const
  {
    return ends[0] != ends[1] && this->IsShared(ends[0]) && this->IsShared(ends[1]);
  }
  /// The keys of all points, with flags of those at which other ranks may have triangles. Used and
  /// Closed are empty.
  const PointKeys& GetPointKeys() const { return this->Points; }
  std::int32_t GetRank() const { return this->Rank; }

  std::int64_t GetNumberOfPoints() const { return SizeOf(this->Points.Keys); }
  std::int64_t GetKey(std::int64_t point) const { return this->Points.Keys[point]; }
  /// The id of a key here, or -1.
  std::int64_t FindPoint(std::int64_t key) const;
  void GetPosition(std::int64_t point, double (&x)[3]) const
  {
    const std::int64_t received = point - this->Given.Count;
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = received < 0 ? this->Given.Get(point, axis) : this->Received[3 * received + axis];
    }
  }
  PointPair GetKeys(const PointPair& pair) const
  {
    return MakePair(this->GetKey(pair[0]), this->GetKey(pair[1]));
  }

  /// Removes triangles that go to other ranks. @returns them, in the same order.
  std::vector<TravellingTriangle> Release(const std::vector<std::int64_t>& triangles);
  /// Adds one that comes from another rank. @returns its number here.
  std::int64_t Receive(const TravellingTriangle& triangle);

  /// Points with this id or a larger one came from other ranks.
  std::int64_t GetFirstReceived() const { return this->Given.Count; }

private:
  PartCorner FindEdge(std::int32_t start, std::int32_t end, std::int64_t except = -1) const;
  std::int32_t FindOrAddPoint(std::int64_t key, const double (&x)[3]);
  void SharePoint(std::int32_t point);
  void NoteChange(std::int64_t triangle);
  void NoteChangesAt(std::int32_t point);

  PointStars Stars; ///< Empty before the rounds.
  std::vector<std::int64_t> Changed; ///< For TakeChanged (PartTriangle::IsNoted).
  std::vector<PointPair> LostSeams;
  std::vector<std::int32_t> SharedPoints;
  PointArray Given; ///< The caller's points.
  std::vector<double> Received; ///< Coordinates of the points from other ranks, which follow these.
  PointKeys Points;
  std::int32_t Rank;
  std::int64_t FirstOwnKey;
  std::unordered_map<std::int64_t, std::int32_t> OtherKeys; ///< Never iterated over.
};

}

#endif
