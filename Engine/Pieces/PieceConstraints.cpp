// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceConstraints.h"

#include "ConstraintInsertion.h"
#include "ConstraintList.h"
#include "MissingConstraints.h"
#include "PieceRegion.h"
#include "Records.h"
#include "SpreadPoints.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <set>
#include <utility>

namespace delaunayflip
{

namespace
{
/// How much of a run is done when each rank has inserted its own constraints, and when all are in.
constexpr double OwnShare = 0.2;
constexpr double FarShare = 0.25;

/// What the ranks' own insertions have found.
struct InsertionSums
{
  std::int64_t Missing = 0; ///< Constraints that were not edges.
  std::int64_t Left = 0; ///< Of these, those that no rank could insert alone.
  std::int64_t Aborted = 0; ///< Ranks.

  InsertionSums& operator+=(const InsertionSums& part)
  {
    this->Missing += part.Missing;
    this->Left += part.Left;
    this->Aborted += part.Aborted;
    return *this;
  }
};

bool Holds(const std::vector<PointPair>& ascending, const PointPair& pair)
{
  return std::binary_search(ascending.begin(), ascending.end(), pair);
}

/// The constraints of all ranks in the ranks' order, each once.
std::vector<FarConstraint> JoinLeft(const RecordLists<FarConstraint>& lists)
{
  std::vector<FarConstraint> all;
  std::set<PointPair> known;
  for (const std::vector<FarConstraint>& list : lists)
  {
    for (const FarConstraint& one : list)
    {
      if (known.insert(one.GetKeys()).second)
      {
        all.push_back(one);
      }
    }
  }
  return all;
}

void AddCounts(const FlipReport& part, FlipReport& sum)
{
  sum.InsertedConstraints += part.InsertedConstraints;
  sum.UnmatchedConstraints += part.UnmatchedConstraints;
  sum.ConstraintFlips += part.ConstraintFlips;
  sum.Defects.insert(sum.Defects.end(), part.Defects.begin(), part.Defects.end());
}
}

/// What InsertOwn has made; dropped if the run is stopped.
struct PieceConstraints::OwnWork
{
  ConstraintList List;
  TriangleMesh Mesh; ///< Views the list.
  ConstraintInsertion Insertion;
};

//------------------------------------------------------------------------------
PieceConstraints::PieceConstraints(const PieceJob& job, PieceMesh& mesh)
  : Job(job),
    Mesh(mesh),
    Piece(job.Piece),
    Far(LookUpFarConstraints(job.Piece, mesh, job.Group)),
    Seams(SurveySeams(job, job.Piece, mesh, this->Far)),
    Arrays(job.Survey.IsFloat)
{
  const bool isPlanar = job.Survey.Geometry != GeometryKind::Surface;
  if (isPlanar && this->Seams.Counts.ToInsert + this->Seams.Counts.MissingToInsert > 0)
  {
    this->Run();
  }
}

void PieceConstraints::AddTo(FlipReport& report) const { AddCounts(this->Found, report); }

void PieceConstraints::Run()
{
  OwnWork own;
  DoTogether(this->Job.Group, [&]() { this->InsertOwn(own); });
  const std::vector<FarConstraint> left = this->ListLeft();
  InsertionSums sums;
  sums.Left = static_cast<std::int64_t>(left.size());
  sums.Missing = sums.Left + this->Found.InsertedConstraints + this->Found.UnmatchedConstraints;
  sums.Aborted = this->IsAborted ? 1 : 0;
  sums = SumOverRanks(this->Job.Group, sums);
  this->IsAborted = sums.Aborted > 0;
  if (sums.Missing == 0 || this->IsAborted)
  {
    this->Found = FlipReport(); // what ranks have inserted before another one stopped is dropped
    std::fill(this->Seams.ToInsert.begin(), this->Seams.ToInsert.end(), 0);
    return;
  }
  this->Keep(own);
  this->Share = OwnShare;
  if (sums.Left > 0)
  {
    this->InsertFar(JoinLeft(GatherRecords(this->Job.Group, left)));
    this->Share = FarShare;
  }
  this->Arrays.TakeTriangles(this->Mesh);
  this->Arrays.AddTo(this->Piece.Mesh);
  this->Fixed = MarkedEdges();
  this->Seams = SurveySeams(this->Job, this->Piece, this->Mesh);
}

/// @param end the share of a run that is over then.
/// @returns what was inserted; nothing if an observer stops it.
ConstraintInsertion PieceConstraints::Insert(const TriangleMesh& mesh, double end)
{
  FlipOptions options = this->Job.Options;
  options.Geometry = this->Job.Survey.Geometry;
  const double begin = this->Share;
  const auto progress = [&](double share)
  { return !this->Job.Progress || this->Job.Progress(begin + (end - begin) * share); };
  try
  {
    return ConstraintInsertion(mesh, options, progress);
  }
  catch (const RunAborted&)
  {
    this->IsAborted = true;
    return ConstraintInsertion();
  }
}

//------------------------------------------------------------------------------
/// Inserts what stays within this piece, and lists what does not.
void PieceConstraints::InsertOwn(OwnWork& own)
{
  for (const PointPair& edge : this->Seams.EdgesToFix)
  {
    own.List.AddEdge(edge[0], edge[1]);
  }
  const std::vector<std::int64_t>& ends = this->Seams.Constraints;
  for (std::size_t i = 0; i < this->Seams.ToInsert.size(); ++i)
  {
    own.List.Add(ends[2 * i], ends[2 * i + 1], this->Seams.ToInsert[i] != 0);
  }
  own.Mesh = own.List.AddTo(this->Piece.Mesh);
  own.Mesh.Whole = this->Job.Survey.Whole;
  if (this->Job.Group.GetSize() > 1 && this->Job.Survey.NeedsGuard())
  {
    // A flip here might make an edge that another rank has.
    this->LeaveMissing(own.Mesh);
    return;
  }
  own.Insertion = this->Insert(own.Mesh, OwnShare);
  if (this->Job.Group.GetSize() > 1)
  {
    const std::vector<std::int64_t> leaving = own.Insertion.TakeLeaving();
    for (std::size_t i = 0; i < leaving.size(); i += 2)
    {
      this->Left.push_back(MakePair(leaving[i], leaving[i + 1]));
    }
    std::sort(this->Left.begin(), this->Left.end());
  }
  FlipReport part;
  own.Insertion.AddTo(part);
  AddCounts(part, this->Found);
}

void PieceConstraints::LeaveMissing(const TriangleMesh& mesh)
{
  const ThreadBackend backend(this->Job.Options.NumberOfThreads);
  for (const std::int64_t i : FindMissingConstraints(mesh, backend).First)
  {
    this->Left.push_back(MakePair(mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1]));
  }
  std::sort(this->Left.begin(), this->Left.end());
}

/// Whether this rank cannot insert a constraint of the caller alone.
bool PieceConstraints::IsLeft(const PointPair& ends) const
{
  return this->Mesh.IsShared(ends[0]) && this->Mesh.IsShared(ends[1])
    ? Holds(this->Seams.Missing, this->Mesh.GetKeys(ends))
    : Holds(this->Left, ends);
}

std::vector<FarConstraint> PieceConstraints::ListLeft() const
{
  const TriangleMesh& mesh = this->Job.Piece.Mesh;
  std::vector<FarConstraint> left;
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
    const bool isToInsert = mesh.ConstraintsToInsert && mesh.ConstraintsToInsert[i] != 0;
    if (isToInsert && this->IsLeft(MakePair(ends[0], ends[1])))
    {
      left.push_back(MakeFarConstraint(this->Mesh, ends[0], ends[1]));
    }
  }
  for (const FarConstraint& one : this->Far)
  {
    if (Holds(this->Seams.Missing, one.GetKeys()))
    {
      left.push_back(one);
    }
  }
  return left;
}

/// Takes the triangles, and the constraints except those that this rank cannot insert alone.
void PieceConstraints::Keep(const OwnWork& own)
{
  this->Mesh.ListAll();
  for (const MarkedCorner& mark : this->Seams.Marks)
  {
    if (mark.Mark == FixedMark)
    {
      this->Fixed.Add(this->Mesh.Triangles[mark.Triangle].GetEdge(mark.Slot), FixedMark);
    }
  }
  const TriangleMesh& caller = this->Job.Piece.Mesh;
  const auto add = [&](std::int64_t from, std::int64_t to)
  {
    if (!this->IsLeft(MakePair(from, to)))
    {
      this->AddEdge(from, to);
    }
  };
  for (std::int64_t i = 0; i < caller.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = caller.ConstraintEdges + 2 * i;
    if (this->Mesh.IsShared(ends[0]) && this->Mesh.IsShared(ends[1]))
    {
      add(ends[0], ends[1]);
    }
  }
  own.List.ForEachMade(own.Insertion.GetMesh(own.Mesh), add);
  if (own.Insertion.HasFlips())
  {
    const MadeTriangles made(own.Insertion, own.Mesh);
    for (std::size_t t = 0; t < made.Flips.size(); ++t)
    {
      std::copy_n(made.Ids.data() + 3 * t, 3, this->Mesh.Triangles[t].Points);
      this->Mesh.Triangles[t].Flips = made.Flips[t];
    }
  }
}

/// Adds a constraint that is an edge, or is not to be inserted.
void PieceConstraints::AddEdge(std::int64_t from, std::int64_t to)
{
  this->Arrays.AddConstraint(from, to);
  this->Fixed.Add(MakePair(from, to), FixedMark);
}

//------------------------------------------------------------------------------
/// Inserts constraints of all ranks, each of them on one rank.
void PieceConstraints::InsertFar(const std::vector<FarConstraint>& constraints)
{
  this->Fixed.Apply(this->Mesh.Triangles);
  this->Mesh.BeginRounds(false);
  const InsertionTask task = LendToConstraints(
    constraints, this->Job.Survey, this->Job.Piece.Mesh, this->Mesh, this->Job.Group);
  std::vector<std::int64_t> spread;
  DoTogether(this->Job.Group, [&]() { spread = this->InsertFar(task); });
  ReturnTriangles(task, spread, this->Mesh, this->Job.Group);
  this->Mesh.EndRounds();
  if (this->Mesh.GetNumberOfPoints() > this->Mesh.GetFirstReceived())
  {
    this->Arrays.TakePoints(this->Mesh);
  }
}

/// @returns keys of points that become shared.
std::vector<std::int64_t> PieceConstraints::InsertFar(const InsertionTask& task)
{
  const PieceRegion region(this->Mesh, task.Triangles, this->Job.Survey);
  std::vector<std::int32_t> regions;
  std::vector<unsigned char> frozen;
  for (const TriangleLabel& label : task.Labels)
  {
    regions.push_back(label.Region);
    frozen.push_back(label.IsFrozen ? 1 : 0);
  }
  const ConstraintList list = this->ListFar(task.Constraints, region);
  TriangleMesh mesh = list.AddTo(region.View());
  mesh.Regions = regions.data();
  mesh.FrozenTriangles = frozen.data();
  const ConstraintInsertion insertion = this->Insert(mesh, FarShare);
  FlipReport part;
  insertion.AddTo(part);
  // Some may have become edges when others along them were inserted.
  part.InsertedConstraints = this->IsAborted ? 0 : list.CountToInsert() - part.UnmatchedConstraints;
  AddCounts(part, this->Found);
  SpreadPoints spread(task, this->Job.Group.GetRank(), mesh.Points.Count);
  spread.AddTriangles(mesh.Triangles);
  const TriangleMesh after = insertion.GetMesh(mesh);
  spread.AddTriangles(after.Triangles);
  list.ForEachMade(after,
    [&](std::int64_t from, std::int64_t to)
    {
      this->AddEdge(region.GetPoint(from), region.GetPoint(to));
      spread.AddEnd(from);
      spread.AddEnd(to);
    });
  const MadeTriangles made(insertion, mesh);
  region.Store(made.Ids, made.Flips, this->Mesh);
  std::vector<std::int64_t> keys = spread.List();
  std::transform(keys.begin(), keys.end(), keys.begin(),
    [&](std::int64_t point) { return this->Mesh.GetKey(region.GetPoint(point)); });
  return keys;
}

/// The constraints in the numbers of a region. Refuses those with an end at no triangle.
ConstraintList PieceConstraints::ListFar(
  const std::vector<FarConstraint>& constraints, const PieceRegion& region)
{
  ConstraintList list;
  const TriangleMesh mesh = region.View();
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    list.AddEdge(mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1]);
  }
  FlipReport refused;
  for (const FarConstraint& one : constraints)
  {
    const std::int64_t from = region.FindPoint(this->Mesh.FindPoint(one.Ends[0]));
    const std::int64_t to = region.FindPoint(this->Mesh.FindPoint(one.Ends[1]));
    if (from >= 0 && to >= 0)
    {
      list.Add(from, to, true);
    }
    else
    {
      ++refused.UnmatchedConstraints;
    }
  }
  if (refused.UnmatchedConstraints > 0)
  {
    refused.Defects = { { ConstraintInsertion::LeavesMesh, refused.UnmatchedConstraints, {},
      DefectIds::PointPairs } };
  }
  AddCounts(refused, this->Found);
  return list;
}

}
