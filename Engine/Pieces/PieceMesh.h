// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEMESH_H
#define DELAUNAYFLIP_PIECEMESH_H

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
class PieceMesh
{
public:
  /// Has the triangles of the caller.
  /// @param firstOrigin the number of the first of them among those of all ranks.
  PieceMesh(const MeshPiece& piece, PointKeys keys, int rank, std::int64_t firstOrigin);

  PieceTriangles Triangles; ///< Some may be empty places (PieceTriangle::HasLeft).

  /// Lists what rounds need, so that they take no time for other triangles. From now on triangles
  /// change by the functions below only.
  void BeginRounds();
  /// Closes empty places, and forgets the lists and all marks. Triangles keep their order.
  void EndRounds();
  /// Calls change() for triangles with other points or marks afterwards.
  template <typename Change>
  void ChangeTriangles(const std::vector<std::int64_t>& triangles, const Change& change)
  {
    this->Stars.Remove(this->Triangles, triangles);
    change();
    for (const std::int64_t t : triangles)
    {
      this->Stars.Add(this->Triangles, t);
      this->NoteSeams(t);
    }
    this->Changed.insert(this->Changed.end(), triangles.begin(), triangles.end());
  }
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
  /// Calls visit(triangle) for every corner at a point.
  template <typename Visit>
  void ForEachAt(std::int32_t point, const Visit& visit) const
  {
    this->Stars.ForEach(point, visit);
  }
  /// The same for several points, in no order.
  template <typename Visit>
  void ForEachAt(const std::vector<std::int32_t>& points, const Visit& visit) const
  {
    this->Stars.ForEachOf(points, visit);
  }
  /// Another triangle here at the edge opposite to a corner.
  PieceCorner FindMate(const PieceCorner& corner) const;
  /// The same, but none if the edge is fixed or between ranks.
  PieceCorner FindOpenMate(const PieceCorner& corner) const;
  bool HasEdge(const PointPair& ends) const;

  bool IsShared(std::int64_t point) const { return this->Shared[point] != 0; }
  /// One flag per point: whether other ranks may have triangles at it.
  const std::vector<unsigned char>& GetShared() const { return this->Shared; }
  /// Those points, without an order.
  const std::vector<std::int32_t>& GetSharedPoints() const { return this->SharedPoints; }

  std::int64_t GetNumberOfPoints() const { return static_cast<std::int64_t>(this->Keys.size()); }
  std::int64_t GetKey(std::int64_t point) const { return this->Keys[point]; }
  /// The id of a key here, or -1.
  std::int64_t FindPoint(std::int64_t key) const;
  void GetPosition(std::int64_t point, double (&x)[3]) const;
  PointPair GetKeys(const PointPair& pair) const
  {
    return MakePair(this->Keys[pair[0]], this->Keys[pair[1]]);
  }

  /// Removes triangles that go to other ranks. @returns them in their order.
  std::vector<TravellingTriangle> Release(const std::vector<std::int64_t>& triangles);
  /// Adds one that comes from another rank. @returns its number here.
  std::int64_t Receive(const TravellingTriangle& triangle);

  /// Points that were not among the caller's, from this id on.
  std::int64_t GetFirstReceived() const { return this->Given.Count; }
  /// Which rank has given a point.
  PieceOrigin FindOrigin(std::int64_t point) const
  {
    return this->Numbers.FindOrigin(this->Keys[point]);
  }

private:
  std::int32_t FindOrAddPoint(std::int64_t key, const double (&x)[3]);
  TravellingTriangle Pack(const PieceTriangle& triangle) const;
  void Share(std::int32_t point);
  void NoteSeams(std::int64_t triangle);

  PointStars Stars;
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
