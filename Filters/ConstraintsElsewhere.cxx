// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintsElsewhere.h"

#include "ConstraintEdges.h"
#include "PointViews.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

namespace delaunayflip
{
namespace
{
/// What a rank has of the end of a constraint.
enum EndUse : char
{
  HasNothing,
  HasPoint,
  HasTriangle ///< And a triangle at the point.
};

/// This rank's points at the ends of constraints.
class EndFinder
{
public:
  EndFinder(const PointArray& ends, const TriangleMesh& mesh)
    : Places(ends.Floats != nullptr || mesh.Points.Floats != nullptr),
      Ids(ends.Count, -1),
      Uses(ends.Count, HasNothing)
  {
    std::vector<std::vector<std::int64_t>> endsAt;
    for (std::int64_t i = 0; i < ends.Count; ++i)
    {
      const std::int64_t place = this->Places.Add(ends, i);
      endsAt.resize(this->Places.GetNumberOfPlaces());
      endsAt[place].push_back(i);
      this->PlaceOf.push_back(place);
    }
    std::vector<bool> isUsed(mesh.Points.Count);
    for (std::int64_t i = 0; i < 3 * mesh.Triangles.Count; ++i)
    {
      isUsed[mesh.Triangles.Get(i / 3, static_cast<int>(i % 3))] = true;
    }
    for (std::int64_t point = 0; point < mesh.Points.Count; ++point)
    {
      const std::int64_t place = this->Places.Find(mesh.Points, point);
      if (place != PointPlaces::None)
      {
        this->Note(point, isUsed[point] ? HasTriangle : HasPoint, endsAt[place]);
      }
    }
  }

  /// One per end.
  const Message& GetUses() const { return this->Uses; }
  std::int64_t GetId(std::int64_t end) const { return this->Ids[end]; }
  std::int64_t GetPlace(std::int64_t end) const { return this->PlaceOf[end]; }

private:
  void Note(std::int64_t point, EndUse use, const std::vector<std::int64_t>& ends)
  {
    for (const std::int64_t end : ends)
    {
      this->Ids[end] = use > this->Uses[end] ? point : this->Ids[end];
      this->Uses[end] = std::max<char>(use, this->Uses[end]);
    }
  }

  PointPlaces Places;
  std::vector<std::int64_t> PlaceOf; ///< By end, as the rest.
  std::vector<std::int64_t> Ids;
  Message Uses;
};

/// Whether a rank has both ends of a constraint.
bool IsOnOneRank(const std::vector<Message>& uses, std::int64_t constraint)
{
  return std::any_of(uses.begin(), uses.end(),
    [=](const Message& one)
    { return one[2 * constraint] != HasNothing && one[2 * constraint + 1] != HasNothing; });
}

/// The first rank that has most of an end, or -1.
int FindRank(const std::vector<Message>& uses, std::int64_t end)
{
  const auto best = std::max_element(
    uses.begin(), uses.end(), [=](const Message& a, const Message& b) { return a[end] < b[end]; });
  return (*best)[end] == HasNothing ? -1 : static_cast<int>(best - uses.begin());
}

/// The points at some ends, told by the ranks that have them.
std::vector<PieceOrigin> FindOrigins(const std::vector<std::int64_t>& ends,
  const std::vector<Message>& uses, const EndFinder& finder, PieceGroup& group)
{
  std::vector<PieceOrigin> origins;
  std::vector<std::int64_t> ids; // of this rank
  for (const std::int64_t end : ends)
  {
    origins.push_back({ FindRank(uses, end), -1 });
    if (origins.back().Rank == group.GetRank())
    {
      ids.push_back(finder.GetId(end));
    }
  }
  Message message(ids.size() * sizeof(std::int64_t));
  std::copy_n(reinterpret_cast<const char*>(ids.data()), message.size(), message.data());
  const std::vector<Message> all = group.Gather(message);
  std::vector<std::size_t> next(all.size());
  for (PieceOrigin& origin : origins)
  {
    std::memcpy(&origin.Id, all[origin.Rank].data() + next[origin.Rank], sizeof(std::int64_t));
    next[origin.Rank] += sizeof(std::int64_t);
  }
  return origins;
}
}

ConstraintsElsewhere FindConstraintsElsewhere(
  vtkPolyData* constraints, const TriangleMesh& mesh, PieceGroup& group)
{
  std::vector<double> storage;
  const PointArray points = ViewPoints(constraints, storage);
  const EndFinder finder(points, mesh);
  const std::vector<Message> uses = group.Gather(finder.GetUses());
  ConstraintsElsewhere elsewhere;
  std::vector<std::int64_t> ends;
  std::set<std::pair<std::int64_t, std::int64_t>> known;
  for (std::int64_t i = 0; i < points.Count / 2; ++i)
  {
    const auto places = std::minmax({ finder.GetPlace(2 * i), finder.GetPlace(2 * i + 1) });
    if (places.first == places.second || IsOnOneRank(uses, i) || !known.insert(places).second)
    {
      continue;
    }
    if (FindRank(uses, 2 * i) < 0 || FindRank(uses, 2 * i + 1) < 0)
    {
      ++elsewhere.Unmatched;
      continue;
    }
    ends.insert(ends.end(), { 2 * i, 2 * i + 1 });
  }
  const std::vector<PieceOrigin> origins = FindOrigins(ends, uses, finder, group);
  elsewhere.Count = static_cast<std::int64_t>(ends.size()) / 2;
  elsewhere.Ends = group.GetRank() == 0 ? origins : std::vector<PieceOrigin>();
  return elsewhere;
}

}
