// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEMESH_H
#define DELAUNAYFLIP_PIECEMESH_H

#include "EngineTriangles.h"
#include "FixedPairs.h"
#include "PieceFlip.h"
#include "PieceTriangle.h"
#include "PointMatch.h"
#include "PointStars.h"

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// A triangle on its way to another rank.
struct TravellingTriangle
{
  std::int64_t Keys[3];
  double Coordinates[3][3];
  std::int64_t Origin;
  std::int32_t Flips;
  unsigned char Marks;
};

/// The triangles that a rank has at the moment, and all points that it has ever had.
///
/// Most triangles are never touched by a round. So a triangle is listed in Triangles when it is
/// needed; until then it stays where the caller, or the engine of the first flips, has it. Before
/// one changes or leaves, all that share an edge with it are listed.
class PieceMesh
{
public:
  /// Has the triangles of the caller.
  /// @param firstOrigin the number of the first of them among those of all ranks.
  PieceMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin);

  PieceTriangles Triangles; ///< Some may be empty places (PieceTriangle::HasLeft), or not listed.

  bool IsListed(std::int64_t t) const { return this->Listed[t] != 0; }
  bool AreAllListed() const { return this->NumberListed == this->Triangles.size(); }
  /// Their numbers, ascending.
  std::vector<std::int64_t> FindListed() const;
  void List(std::int64_t t)
  {
    if (!this->IsListed(t))
    {
      this->MakeTriangle(t);
    }
  }
  void ListAll();
  /// The ids of a triangle that may not be listed.
  void GetPoints(std::int64_t t, std::int32_t (&points)[3]) const;
  /// The ends of the edge opposite to a corner of such a triangle.
  PointPair GetEdge(std::int64_t t, int slot) const
  {
    std::int32_t points[3];
    this->GetPoints(t, points);
    return MakePair(points[(slot + 1) % 3], points[(slot + 2) % 3]);
  }
  /// Of the triangles that are not listed, after TakeTriangles(made, marks): as FlipLoop.h has it.
  double FindLargestSquaredCotangent() const;
  /// Takes the triangles that an engine has made of these, in its order, in which neighbours are
  /// near each other. Lists those at marked edges at the boundary.
  /// @param made must stay as it is as long as there are triangles that are not listed.
  void TakeTriangles(const HostTriangles& made, MarkedEdges marks);
  /// The same for arrays with a value per triangle. Lists all.
  void TakeTriangles(const std::int32_t* ids, const std::int32_t* flips, const MarkedEdges& marks);
  /// Lists the corners at every point, so that rounds take no time for other triangles. From now on
  /// triangles change by the functions below only.
  /// @param listsChanged whether TakeChanged will be called; then all triangles must be listed.
  void BeginRounds(bool listsChanged);
  /// Closes empty places, and forgets the lists and all marks. Triangles keep their order.
  void EndRounds();
  /// Flips the edge opposite to two corners.
  void Flip(const PieceCorner& one, const PieceCorner& other);
  /// Puts another point at a corner. Marks do not change.
  void SetPoint(const PieceCorner& corner, std::int32_t point);
  /// The triangles that have changed or come since the last call, and those at points that have
  /// become shared; some more than once.
  std::vector<std::int64_t> TakeChanged() { return std::exchange(this->Changed, {}); }
  /// Marks an edge as one between ranks.
  void SetSeam(const PieceCorner& corner);
  /// Marks it as an inner edge again.
  void ClearSeam(const PieceCorner& corner);
  /// The edges between ranks whose triangles here have changed or come since the last call.
  std::vector<PieceCorner> TakeNewSeams();
  /// Those without a triangle here since the last call: keys. Some of them may have one again, and
  /// some may never have been told.
  std::vector<PointPair> TakeLostSeams() { return std::exchange(this->LostSeams, {}); }
  /// Calls visit(corner) for every corner at a point.
  template <typename Visit>
  void ForEachAt(std::int32_t point, const Visit& visit) const
  {
    this->Stars.Find(point,
      [&](const PieceCorner& corner)
      {
        visit(corner);
        return false;
      });
  }
  /// Another triangle here at the edge opposite to a corner.
  PieceCorner FindMate(const PieceCorner& corner) const;
  /// The same, but none if the edge is fixed or between ranks.
  PieceCorner FindOpenMate(const PieceCorner& corner);
  /// Prefetches the points of a triangle and those opposite to it.
  void PrefetchPoints(std::int64_t triangle) const;
  bool HasEdge(const PointPair& ends) const;

  bool IsShared(std::int64_t point) const { return this->Shared[point] != 0; }
  /// One flag per point: whether other ranks may have triangles at it.
  const std::vector<unsigned char>& GetShared() const { return this->Shared; }
  /// Those points, without an order.
  const std::vector<std::int32_t>& GetSharedPoints() const { return this->SharedPoints; }

  /// No other rank has triangles at these points any more; some may be repeated.
  void Unshare(const std::vector<std::int32_t>& points);
  /// Other ranks may have triangles at a point, if it is known here.
  void Share(std::int64_t key);

  std::int64_t GetNumberOfPoints() const { return static_cast<std::int64_t>(this->Keys.size()); }
  std::int64_t GetKey(std::int64_t point) const { return this->Keys[point]; }
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
  void PrefetchPoint(std::int32_t point) const
  {
    if (point < this->Given.Count)
    {
      this->Given.Prefetch(point);
    }
  }
  PointPair GetKeys(const PointPair& pair) const
  {
    return MakePair(this->Keys[pair[0]], this->Keys[pair[1]]);
  }

  /// Removes triangles that go to other ranks. @returns them in their order.
  std::vector<TravellingTriangle> Release(const std::vector<std::int64_t>& triangles);
  /// Adds one that comes from another rank. @returns its number here.
  std::int64_t Receive(const TravellingTriangle& triangle);
  /// Puts one that comes back into the place that it has left.
  void PutBack(std::int64_t place, const TravellingTriangle& triangle);

  /// Points that were not among the caller's, from this id on.
  std::int64_t GetFirstReceived() const { return this->Given.Count; }
  /// Which rank has given a point.
  PieceOrigin FindOrigin(std::int64_t point) const
  {
    return this->Numbers.FindOrigin(this->Keys[point]);
  }

private:
  /// What is known of a triangle besides its points.
  struct Past
  {
    std::int64_t Origin;
    std::int64_t Flips;
  };

  void GetFirstPoints(std::int64_t t, std::int32_t (&points)[3]) const;
  void MakeTriangle(std::int64_t t);
  void TakeRecord(std::int64_t t);
  void KeepPast();
  void ListBeside(std::int64_t t);
  Past GetPast(std::int64_t t) const
  {
    return this->Pasts.empty() ? Past{ this->FirstOrigin + t, 0 } : this->Pasts[t];
  }
  std::int32_t FindOrAddPoint(std::int64_t key, const double (&x)[3]);
  TravellingTriangle Pack(const PieceTriangle& triangle) const;
  void SharePoint(std::int32_t point);
  void NoteChange(std::int64_t triangle);
  void NoteSeams(std::int64_t triangle);

  static constexpr std::uint32_t Unknown = 0xFFFFFFFFu, NoMate = Unknown - 1;
  static std::size_t GetNumber(const PieceCorner& corner)
  {
    return static_cast<std::size_t>(3 * corner.Triangle + corner.Slot);
  }
  void Join(std::size_t one, std::uint32_t other);

  // Where triangles are that are not listed: with the caller or, if there are records, in these.
  TriangleArray Caller;
  HostTriangles Made;
  std::int64_t FirstOrigin;
  HostVector<Past> Pasts; ///< Of the engine's input triangles; empty: they were the caller's.
  MarkedEdges Marks;
  std::vector<unsigned char> Listed; ///< One flag per triangle.
  std::size_t NumberListed = 0;
  bool HasStars = false;

  PointStars Stars; ///< Of listed triangles.
  /// By corner, 3 * triangle + slot: another one at the same edge, if it has been asked for.
  RawVector<std::uint32_t> Mates;
  bool ListsChanged = false;
  std::vector<std::int64_t> Changed;
  std::vector<std::int64_t> MayHaveSeams; ///< New ones: triangles (PieceTriangle::IsNoted).
  std::vector<PointPair> LostSeams;
  std::vector<unsigned char> Shared;
  std::vector<std::int32_t> SharedPoints;
  PointArray Given;
  std::vector<double> Received; ///< Coordinates of the points behind those.
  PointKeys Numbers; ///< Without what has one value per point.
  HostVector<std::int64_t> Keys;
  std::int64_t FirstOwnKey;
  std::unordered_map<std::int64_t, std::int32_t> OtherKeys; ///< Never iterated over.
};

}

#endif
