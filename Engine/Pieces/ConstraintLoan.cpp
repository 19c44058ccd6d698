// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintLoan.h"

#include "ConstraintGroups.h"
#include "SegmentTree.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace delaunayflip
{

namespace
{
constexpr std::int32_t None = -1;

/// What a rank knows about a constraint.
struct RankShare
{
  std::int32_t Constraint;
  std::int32_t First; ///< Of its group, as far as the rank knows.
  std::int64_t Triangles; ///< That are counted for this constraint.
};

/// A point of a triangle that touches a constraint.
struct TouchedPoint
{
  std::int64_t Key;
  std::int32_t Constraint;
};

class ConstraintLender
{
public:
  ConstraintLender(const std::vector<FarConstraint>& constraints, const PieceSurvey& survey,
    const TriangleMesh& caller, PieceMesh& mesh, PieceGroup& group)
    : Constraints(constraints),
      Survey(survey),
      Caller(caller),
      Mesh(mesh),
      Group(group),
      Groups(constraints.size()),
      TouchedBy(mesh.Triangles.size(), None)
  {
  }

  InsertionTask Run()
  {
    this->FindTouched();
    if (this->Survey.NeedsGuard())
    {
      this->AddNeighbours();
    }
    const std::vector<int> receivers = this->ChooseReceivers();
    InsertionTask task;
    for (std::size_t i = 0; i < this->Constraints.size(); ++i)
    {
      if (receivers[i] == this->Group.GetRank())
      {
        task.Constraints.push_back(this->Constraints[i]);
      }
    }
    this->Lend(receivers, task);
    return task;
  }

private:
  PlanePoint Project(const double (&x)[3]) const
  {
    return this->Survey.Projection.Project(PointArray(x, 1), 0);
  }

  void FindTouched()
  {
    std::vector<SegmentTree::Segment> segments;
    for (const FarConstraint& one : this->Constraints)
    {
      segments.push_back({ this->Project(one.Positions[0]), this->Project(one.Positions[1]) });
    }
    const SegmentTree tree(segments);
    std::vector<std::int32_t> touched;
    for (std::size_t t = 0; t < this->TouchedBy.size(); ++t)
    {
      SegmentTree::Triangle corners;
      if (this->FindCorners(this->Mesh.Triangles[t], corners))
      {
        tree.FindTouched(corners, touched);
        for (const std::int32_t constraint : touched)
        {
          this->Touch(t, constraint);
        }
      }
    }
  }

  /// @returns whether they are finite; else no constraint goes through the triangle.
  bool FindCorners(const PieceTriangle& triangle, SegmentTree::Triangle& corners) const
  {
    bool areFinite = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      double x[3];
      this->Mesh.GetPosition(triangle.Points[slot], x);
      corners[slot] = this->Project(x);
      areFinite = areFinite && IsFinite(corners[slot]);
    }
    return areFinite;
  }

  void Touch(std::size_t triangle, std::int32_t constraint)
  {
    std::int32_t& first = this->TouchedBy[triangle];
    if (first == None)
    {
      first = constraint;
    }
    this->Groups.Join(first, constraint);
  }

  /// Also touches the triangles, on any rank, that share a point with a touched one.
  void AddNeighbours()
  {
    std::map<std::int64_t, std::int32_t> known; // keys of points
    std::vector<TouchedPoint> points;
    for (std::size_t t = 0; t < this->TouchedBy.size(); ++t)
    {
      for (int slot = 0; slot < 3 && this->TouchedBy[t] != None; ++slot)
      {
        const std::int64_t key = this->Mesh.GetKey(this->Mesh.Triangles[t].Points[slot]);
        const auto [place, isNew] = known.emplace(key, this->TouchedBy[t]);
        this->Groups.Join(place->second, this->TouchedBy[t]);
        if (isNew)
        {
          points.push_back({ key, this->TouchedBy[t] });
        }
      }
    }
    for (const std::vector<TouchedPoint>& list : GatherRecords(this->Group, points))
    {
      for (const TouchedPoint& one : list)
      {
        const std::int64_t point = this->Mesh.FindPoint(one.Key);
        if (point >= 0)
        {
          this->Mesh.ForEachAt(static_cast<std::int32_t>(point),
            [&](const PieceCorner& corner) { this->Touch(corner.Triangle, one.Constraint); });
        }
      }
    }
  }

  std::vector<RankShare> ListShares()
  {
    std::vector<RankShare> shares;
    for (std::size_t i = 0; i < this->Constraints.size(); ++i)
    {
      const auto constraint = static_cast<std::int32_t>(i);
      shares.push_back({ constraint, this->Groups.GetFirst(constraint), 0 });
    }
    for (const std::int32_t constraint : this->TouchedBy)
    {
      if (constraint != None)
      {
        ++shares[constraint].Triangles;
      }
    }
    const auto saysNothing = [](const RankShare& share)
    { return share.Triangles == 0 && share.First == share.Constraint; };
    shares.erase(std::remove_if(shares.begin(), shares.end(), saysNothing), shares.end());
    return shares;
  }

  /// The rank that receives each constraint: the one that has most of its group's triangles; if
  /// several have as many, the lowest.
  std::vector<int> ChooseReceivers()
  {
    const RecordLists<RankShare> shares = GatherRecords(this->Group, this->ListShares());
    for (const std::vector<RankShare>& list : shares)
    {
      for (const RankShare& share : list)
      {
        this->Groups.Join(share.Constraint, share.First);
      }
    }
    std::vector<int> best(this->Constraints.size(), 0);
    std::vector<std::int64_t> most(this->Constraints.size(), 0);
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
    {
      std::map<std::int32_t, std::int64_t> sums;
      for (const RankShare& share : shares[rank])
      {
        sums[this->Groups.GetFirst(share.Constraint)] += share.Triangles;
      }
      for (const auto& [first, sum] : sums)
      {
        best[first] = sum > most[first] ? static_cast<int>(rank) : best[first];
        most[first] = std::max(sum, most[first]);
      }
    }
    for (std::size_t i = 0; i < best.size(); ++i)
    {
      best[i] = best[this->Groups.GetFirst(static_cast<std::int32_t>(i))];
    }
    return best;
  }

  /// Divides the touched triangles among the ranks.
  void Lend(const std::vector<int>& receivers, InsertionTask& task)
  {
    task.Lent.resize(this->Group.GetSize());
    for (std::size_t t = 0; t < this->TouchedBy.size(); ++t)
    {
      if (this->TouchedBy[t] != None)
      {
        const int receiver = receivers[this->TouchedBy[t]];
        (receiver == this->Group.GetRank() ? task.Triangles : task.Lent[receiver])
          .push_back(static_cast<std::int64_t>(t));
      }
    }
    task.Labels = this->ListLabels(task.Triangles);
    task.LentPoints = this->ListPrivatePoints(task.Lent);
    RecordLists<TravellingTriangle> triangles;
    RecordLists<TriangleLabel> labels;
    for (const std::vector<std::int64_t>& list : task.Lent)
    {
      triangles.push_back(this->Mesh.Release(list));
      labels.push_back(this->ListLabels(list));
    }
    this->Borrow(
      ExchangeRecords(this->Group, triangles), ExchangeRecords(this->Group, labels), task);
  }

  void Borrow(const RecordLists<TravellingTriangle>& triangles,
    const RecordLists<TriangleLabel>& labels, InsertionTask& task)
  {
    for (std::size_t rank = 0; rank < triangles.size(); ++rank)
    {
      std::vector<std::int64_t> borrowed;
      for (const TravellingTriangle& triangle : triangles[rank])
      {
        borrowed.push_back(this->Mesh.Receive(triangle));
      }
      task.Triangles.insert(task.Triangles.end(), borrowed.begin(), borrowed.end());
      task.Labels.insert(task.Labels.end(), labels[rank].begin(), labels[rank].end());
      task.Borrowed.push_back(std::move(borrowed));
    }
  }

  std::vector<std::int32_t> ListPrivatePoints(const RecordLists<std::int64_t>& lists) const
  {
    std::vector<std::int32_t> points;
    for (const std::vector<std::int64_t>& list : lists)
    {
      for (const std::int64_t t : list)
      {
        std::copy_if(std::begin(this->Mesh.Triangles[t].Points),
          std::end(this->Mesh.Triangles[t].Points), std::back_inserter(points),
          [this](std::int32_t point) { return !this->Mesh.IsShared(point); });
      }
    }
    return points;
  }

  std::vector<TriangleLabel> ListLabels(const std::vector<std::int64_t>& triangles) const
  {
    const TriangleMesh& caller = this->Caller;
    std::vector<TriangleLabel> labels;
    for (const std::int64_t t : triangles)
    {
      labels.push_back({ caller.Regions ? caller.Regions[t] : 0,
        caller.FrozenTriangles && caller.FrozenTriangles[t] != 0 });
    }
    return labels;
  }

  const std::vector<FarConstraint>& Constraints;
  const PieceSurvey& Survey;
  const TriangleMesh& Caller;
  PieceMesh& Mesh;
  PieceGroup& Group;
  ConstraintGroups Groups;
  std::vector<std::int32_t> TouchedBy; ///< One constraint per triangle, or None.
};
}

InsertionTask LendToConstraints(const std::vector<FarConstraint>& constraints,
  const PieceSurvey& survey, const TriangleMesh& caller, PieceMesh& mesh, PieceGroup& group)
{
  return ConstraintLender(constraints, survey, caller, mesh, group).Run();
}

void ReturnTriangles(const InsertionTask& task, const std::vector<std::int64_t>& spread,
  PieceMesh& mesh, PieceGroup& group)
{
  RecordLists<TravellingTriangle> leaving;
  RecordLists<std::int64_t> toLender(group.GetSize());
  for (const std::vector<std::int64_t>& list : task.Borrowed)
  {
    const std::size_t rank = leaving.size();
    const bool isOwn = static_cast<int>(rank) == group.GetRank();
    toLender[rank] = isOwn || !list.empty() ? spread : std::vector<std::int64_t>();
    leaving.push_back(mesh.Release(list));
  }
  const RecordLists<TravellingTriangle> back = ExchangeRecords(group, leaving);
  for (std::size_t rank = 0; rank < back.size(); ++rank)
  {
    for (std::size_t i = 0; i < back[rank].size(); ++i)
    {
      mesh.PutBack(task.Lent[rank][i], back[rank][i]);
    }
  }
  mesh.Unshare(task.LentPoints);
  for (const std::vector<std::int64_t>& list : ExchangeRecords(group, toLender))
  {
    std::for_each(list.begin(), list.end(), [&](std::int64_t key) { mesh.Share(key); });
  }
}

}
