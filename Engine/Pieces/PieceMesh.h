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

/// A triangle as it is sent to another rank.
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
/// Most triangles are never touched by a round. So a triangle is *listed*, that is copied to its
/// place in Triangles, only when it is needed. Until then it stays in the arrays of the caller or
/// of the engine of the first flips. Before a triangle changes or goes to another rank, all
/// triangles that share an edge with it are listed.
class PieceMesh
{
public:
  /// Starts with the triangles of the caller, none of them listed.
  /// @param firstOrigin the number of the first of them among the triangles of all ranks.
  PieceMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin);

  PieceTriangles Triangles; ///< A place may be empty (HasLeft), or not listed.

  bool IsListed(std::int64_t t) const { return this->Listed[t] != 0; }
  bool AreAllListed() const { return this->NumberListed == this->Triangles.size(); }
  /// The numbers of the listed triangles, ascending.
  std::vector<std::int64_t> FindListed() const;
  void List(std::int64_t t)
  {
    if (!this->IsListed(t))
    {
      this->MakeTriangle(t);
    }
  }
  void ListAll();
  /// The point ids of a triangle, listed or not.
  void GetPoints(std::int64_t t, std::int32_t (&points)[3]) const;
  /// The ends of the edge opposite to a corner of a triangle, listed or not.
  PointPair GetEdge(std::int64_t t, int slot) const
  {
    std::int32_t points[3];
    this->GetPoints(t, points);
    return MakePair(points[(slot + 1) % 3], points[(slot + 2) % 3]);
  }
  /// The largest squared cotangent of the triangles that are not listed, as defined in FlipLoop.h.
  /// Only after TakeTriangles(made, marks).
  double FindLargestSquaredCotangent() const;
  /// Takes the result of the first flips, in the order of the engine: triangles near each other in
  /// the mesh are near each other in memory. Lists the triangles at marked boundary edges.
  /// @param made must not change as long as there are triangles that are not listed.
  void TakeTriangles(const HostTriangles& made, MarkedEdges marks);
  /// The same for arrays in the order of the triangles here. Lists all triangles.
  void TakeTriangles(const std::int32_t* ids, const std::int32_t* flips, const MarkedEdges& marks);
  /// Begins the lists of corners at every point (PointStars), with which rounds find triangles
  /// without a pass over all. From now on only the functions below may change triangles.
  /// @param listsChanged whether TakeChanged will be called; then all triangles must be listed.
  void BeginRounds(bool listsChanged);
  /// Flips the edge opposite to two corners.
  void Flip(const PieceCorner& one, const PieceCorner& other);
  /// The triangles that have changed or arrived since the last call, and those at points that have
  /// become shared. A triangle may be repeated.
  std::vector<std::int64_t> TakeChanged() { return std::exchange(this->Changed, {}); }
  /// Marks the edge opposite to a corner as a seam edge.
  void SetSeam(const PieceCorner& corner);
  /// Removes this mark: both triangles of the edge are on this rank.
  void ClearSeam(const PieceCorner& corner);
  /// The seam edges whose triangles here have changed or arrived since the last call.
  std::vector<PieceCorner> TakeNewSeams();
  /// The keys of seam edges that have lost their triangle here since the last call. They may
  /// include edges that have a triangle here again, or that TakeNewSeams has never returned.
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
  /// The mate of a corner: the corner of another triangle here that is opposite to the same edge.
  PieceCorner FindMate(const PieceCorner& corner) const;
  /// The same, but none if the edge is a fixed edge or a seam edge.
  PieceCorner FindOpenMate(const PieceCorner& corner);
  /// Prefetches the points of a triangle and those opposite to it.
  void PrefetchPoints(std::int64_t triangle) const;
  bool HasEdge(const PointPair& ends) const;

  bool IsShared(std::int64_t point) const { return this->Shared[point] != 0; }
  /// One flag per point: whether other ranks may have triangles at it.
  const std::vector<unsigned char>& GetShared() const { return this->Shared; }
  /// The shared points, in no particular order.
  const std::vector<std::int32_t>& GetSharedPoints() const { return this->SharedPoints; }
  /// What is known of the points of all ranks, without the arrays with one value per point.
  const PointKeys& GetWholeKeys() const { return this->WholeKeys; }

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

  /// Removes triangles that go to other ranks. @returns them, in the same order.
  std::vector<TravellingTriangle> Release(const std::vector<std::int64_t>& triangles);
  /// Adds one that comes from another rank. @returns its number here.
  std::int64_t Receive(const TravellingTriangle& triangle);

  /// Points with this id or a larger one came from other ranks.
  std::int64_t GetFirstReceived() const { return this->Given.Count; }
  /// The rank that a point comes from, and its id there.
  PieceOrigin FindOrigin(std::int64_t point) const
  {
    return this->WholeKeys.FindOrigin(this->Keys[point]);
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

  // Where the triangles are that are not listed: in Made if it has records, otherwise in Caller.
  TriangleArray Caller;
  HostTriangles Made;
  std::int64_t FirstOrigin;
  HostVector<Past> Pasts; ///< Of the input of the first flips; empty if that was the caller's.
  MarkedEdges Marks;
  std::vector<unsigned char> Listed; ///< One flag per triangle.
  std::size_t NumberListed = 0;
  bool HasStars = false;

  PointStars Stars; ///< Of the listed triangles.
  /// By corner, 3 * triangle + slot: its mate (FindMate), or Unknown until it is searched for.
  RawVector<std::uint32_t> Mates;
  bool ListsChanged = false;
  std::vector<std::int64_t> Changed;
  std::vector<std::int64_t> MayHaveSeams; ///< Triangles for TakeNewSeams (PieceTriangle::IsNoted).
  std::vector<PointPair> LostSeams;
  std::vector<unsigned char> Shared;
  std::vector<std::int32_t> SharedPoints;
  PointArray Given; ///< The caller's points.
  std::vector<double> Received; ///< Coordinates of the points from other ranks, which follow these.
  PointKeys WholeKeys;
  HostVector<std::int64_t> Keys;
  std::int64_t FirstOwnKey;
  std::unordered_map<std::int64_t, std::int32_t> OtherKeys; ///< Never iterated over.
};

}

#endif
