// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartConstraints.h"

#include "Records.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

namespace
{
/// How much of a run is done when all constraints are inserted.
constexpr double InsertionShare = 0.25;

/// What became of a constraint on a rank: one of these, or 1 + its Refusal. The largest of all
/// ranks decides.
constexpr char NotTried = 0, Done = 100;
}

PartConstraints::PartConstraints(const PartJob& job, PartMesh& mesh)
  : Piece(job.Piece),
    Seams(SurveySeams(job, job.Piece, mesh)),
    Job(job),
    Mesh(mesh)
{
  const bool isPlanar = job.Survey.Geometry != GeometryKind::Surface;
  if (isPlanar && this->Seams.Counts.ToInsert + this->Seams.Counts.MissingToInsert > 0)
  {
    this->Run();
  }
}

void PartConstraints::AddTo(FlipReport& report) const
{
  report.InsertedConstraints += this->Inserted;
  report.ConstraintFlips += this->Flips;
  report.UnmatchedConstraints += static_cast<std::int64_t>(this->Refused.size());
  AddDefects(this->Refused, report.Defects);
}

void PartConstraints::Run()
{
  std::vector<std::int64_t> ends;
  std::vector<unsigned char> toInsert;
  const auto add = [&](std::int64_t from, std::int64_t to, unsigned char isToInsert)
  {
    ends.insert(ends.end(), { from, to });
    toInsert.push_back(isToInsert);
  };
  for (const PointPair& edge : this->Seams.EdgesToFix)
  {
    add(edge[0], edge[1], 0);
  }
  for (std::size_t i = 0; i < this->Seams.ToInsert.size(); ++i)
  {
    const std::int64_t* own = this->Seams.Constraints.data() + 2 * i;
    add(own[0], own[1], this->Seams.ToInsert[i]);
  }
  std::vector<char> fates;
  for (const PointPair& keys : this->Seams.Missing)
  {
    const std::int64_t from = this->Mesh.FindPoint(keys[0]);
    const std::int64_t to = this->Mesh.FindPoint(keys[1]);
    fates.push_back(from >= 0 && to >= 0 ? Done : NotTried); // or refused, see Count
    if (fates.back() == Done)
    {
      add(from, to, 1);
    }
  }
  TriangleMesh mesh = this->Piece.Mesh;
  mesh.ConstraintEdges = ends.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(toInsert.size());
  mesh.ConstraintsToInsert = toInsert.data();
  mesh.Whole = this->Job.Survey.Whole;
  const bool isGuarded = this->Job.Survey.NeedsGuard() && this->Job.Group.GetSize() > 1;
  mesh.Whole.SharedPoints = isGuarded ? this->Mesh.GetShared().data() : nullptr;
  ConstraintInsertion insertion;
  DoTogether(this->Job.Group, [&]() { insertion = this->Insert(mesh); });

  const auto found = insertion.GetNumberInserted() +
    static_cast<std::int64_t>(insertion.GetRefused().size() + this->Seams.Missing.size());
  this->IsAborted =
    SumOverRanks(this->Job.Group, static_cast<std::int64_t>(this->IsAborted ? 1 : 0)) > 0;
  if (SumOverRanks(this->Job.Group, found) == 0 || this->IsAborted)
  {
    // All are edges; or what other ranks have inserted is dropped.
    std::fill(this->Seams.ToInsert.begin(), this->Seams.ToInsert.end(), 0);
    return;
  }
  this->Count(insertion, std::move(fates));
  this->Keep(insertion, mesh, static_cast<std::int64_t>(this->Seams.EdgesToFix.size()));
  this->Share = InsertionShare;
  this->Seams = SurveySeams(this->Job, this->Piece, this->Mesh);
}

/// @returns nothing if an observer stops it.
ConstraintInsertion PartConstraints::Insert(const TriangleMesh& mesh)
{
  FlipOptions options = this->Job.Options;
  options.Geometry = this->Job.Survey.Geometry;
  try
  {
    return ConstraintInsertion(mesh, options,
      [this](double share)
      { return !this->Job.Progress || this->Job.Progress(InsertionShare * share); });
  }
  catch (const RunAborted&)
  {
    this->IsAborted = true;
    return ConstraintInsertion();
  }
}

/// Counts what this rank has inserted and refused. A constraint between shared points is counted by
/// the first rank that came furthest with it.
/// @param fates of the missing constraints between shared points: Done for those that were tried.
void PartConstraints::Count(const ConstraintInsertion& insertion, std::vector<char> fates)
{
  const auto refuse = [this](const std::int64_t(&ends)[2], Refusal why)
  {
    const bool leaves = why == Refusal::LeavesMesh && this->Job.Group.GetSize() > 1;
    this->Refused.push_back({ { ends[0], ends[1] }, leaves ? Refusal::LeavesPart : why });
  };
  this->Flips = insertion.GetNumberOfFlips();
  this->Inserted = insertion.GetNumberInserted() - std::count(fates.begin(), fates.end(), Done);
  const std::vector<PointPair>& missing = this->Seams.Missing;
  for (const RefusedConstraint& one : insertion.GetRefused())
  {
    if (this->Mesh.IsShared(one.Ends[0]) && this->Mesh.IsShared(one.Ends[1]))
    {
      const PointPair keys = this->Mesh.GetKeys({ one.Ends[0], one.Ends[1] });
      const auto place = std::lower_bound(missing.begin(), missing.end(), keys);
      fates[place - missing.begin()] = static_cast<char>(1 + static_cast<int>(one.Why));
      ++this->Inserted; // it is among the tried ones
    }
    else
    {
      refuse(one.Ends, one.Why);
    }
  }
  const RecordLists<char> all = GatherRecords(this->Job.Group, fates);
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    const auto furthest = std::max_element(all.begin(), all.end(),
      [i](const std::vector<char>& a, const std::vector<char>& b) { return a[i] < b[i]; });
    if (furthest - all.begin() != this->Job.Group.GetRank())
    {
      continue;
    }
    if (fates[i] == Done)
    {
      ++this->Inserted;
    }
    else
    {
      const int why = fates[i] == NotTried ? 0 : fates[i] - 1;
      refuse({ missing[i][0], missing[i][1] }, static_cast<Refusal>(why));
    }
  }
}

/// Takes the triangles after the insertion, and all constraints that are edges now or are not to be
/// inserted.
/// @param mesh what the insertion started from. @param known how many of its constraints are not
/// the caller's.
void PartConstraints::Keep(
  const ConstraintInsertion& insertion, const TriangleMesh& mesh, std::int64_t known)
{
  const TriangleMesh& caller = this->Job.Piece.Mesh;
  for (std::int64_t i = 0; i < caller.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = caller.ConstraintEdges + 2 * i;
    if (this->Mesh.IsShared(ends[0]) && this->Mesh.IsShared(ends[1]) &&
      !std::binary_search(this->Seams.Missing.begin(), this->Seams.Missing.end(),
        this->Mesh.GetKeys({ ends[0], ends[1] })))
    {
      this->Constraints.insert(this->Constraints.end(), ends, ends + 2);
    }
  }
  const TriangleMesh made = insertion.GetMesh(mesh);
  this->Constraints.insert(this->Constraints.end(), made.ConstraintEdges + 2 * known,
    made.ConstraintEdges + 2 * made.NumberOfConstraintEdges);
  std::vector<std::int32_t> flips(made.Triangles.Count);
  insertion.AddFlipCounts(flips.data());
  this->Mesh.ListAll();
  for (std::int64_t t = 0; t < made.Triangles.Count; ++t)
  {
    this->Mesh.Triangles[t].Flips = flips[t];
    for (int slot = 0; slot < 3; ++slot)
    {
      const auto point = static_cast<std::int32_t>(made.Triangles.Get(t, slot));
      this->Mesh.Triangles[t].Points[slot] = point;
      this->Ids.push_back(point);
    }
  }
  this->Piece.Mesh.Triangles = TriangleArray(this->Ids.data(), made.Triangles.Count);
  this->Piece.Mesh.ConstraintEdges = this->Constraints.data();
  this->Piece.Mesh.NumberOfConstraintEdges =
    static_cast<std::int64_t>(this->Constraints.size()) / 2;
  this->Piece.Mesh.ConstraintsToInsert = nullptr;
}

}
