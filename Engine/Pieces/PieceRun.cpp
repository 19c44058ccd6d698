// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRun.h"

#include "GuardRound.h"
#include "MeshAudit.h"
#include "PieceStore.h"
#include "RoundFlips.h"
#include "StopWatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delaunayflip
{

namespace
{
/// The share of the time until the first test of edges between ranks, about.
constexpr double FirstShare = 0.8;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// In the plane rounds end by themselves. On surfaces, where nothing proves that flips end, so many
/// are made at most.
constexpr std::int64_t MostRounds = 1000;

/// Nor that those of a round end, so it takes at most so many iterations more than the rank has
/// triangles.
constexpr std::int64_t SafetyMargin = 1000;

std::vector<std::int64_t> NumberTriangles(const MeshPiece& piece, PieceGroup& group)
{
  std::vector<std::int64_t> firsts{ 0 };
  for (const std::vector<std::int64_t>& count :
    GatherRecords(group, std::vector<std::int64_t>{ piece.Mesh.Triangles.Count }))
  {
    firsts.push_back(firsts.back() + count.front());
  }
  return firsts;
}

/// How many ranks have stopped, and why.
struct StopCounts
{
  std::int64_t Iterations = 0; ///< Since the last count; the most that a rank has made.
  std::int64_t Aborted = 0, Limited = 0;
  std::int64_t Uncounted = 0; ///< Stopped before the edges were counted.

  StopCounts& operator+=(const StopCounts& part)
  {
    this->Iterations = std::max(this->Iterations, part.Iterations);
    this->Aborted += part.Aborted;
    this->Limited += part.Limited;
    this->Uncounted += part.Uncounted;
    return *this;
  }
};
}

PieceRun::PieceRun(const PieceJob& job, PointKeys keys)
  : Job(job),
    FirstOrigins(NumberTriangles(job.Piece, job.Group)),
    Mesh(job.Piece, std::move(keys), job.Group.GetRank(), FirstOrigins[job.Group.GetRank()]),
    Judge(job.Survey, job.Options),
    Constraints(Job, Mesh),
    Seams(std::move(Constraints.GetSeams())),
    NumberOfPoints(Mesh.GetWholeKeys().FirstKeys.back() - Mesh.GetWholeKeys().Repeated),
    UsedPoints(Mesh.GetWholeKeys().UsedPoints)
{
  this->Whole.SeamEdges = this->Seams.Counts.Seams;
  this->Whole.AmbiguousPoints = this->Mesh.GetWholeKeys().Ambiguous;
}

//------------------------------------------------------------------------------
PiecesReport PieceRun::Run()
{
  DoTogether(this->Job.Group, [this]() { this->FlipFirst(); });
  while (this->MakeRound())
  {
  }
  DoTogether(this->Job.Group, [this]() { this->CountRest(); });
  return this->MakeReport();
}

/// Calls the observer of this rank. @returns whether to go on.
bool PieceRun::Tell(double share) const
{
  return !this->Constraints.HasAborted() && (!this->Job.Progress || this->Job.Progress(share));
}

//------------------------------------------------------------------------------
/// The mesh that flips start from, with the constraints that other ranks know of.
TriangleMesh PieceRun::GetFirstMesh() const
{
  TriangleMesh mesh = this->Constraints.GetPiece().Mesh;
  mesh.ConstraintEdges = this->Seams.Constraints.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Seams.ToInsert.size());
  mesh.ConstraintsToInsert = this->Seams.ToInsert.data();
  mesh.Whole = this->Job.Survey.Whole;
  mesh.Whole.SharedPoints = this->Job.Survey.NeedsGuard() ? this->Mesh.GetShared().data() : nullptr;
  return mesh;
}

void PieceRun::FlipFirst()
{
  for (const PointPair& edge : this->Seams.EdgesToFix)
  {
    this->Seams.Constraints.insert(this->Seams.Constraints.end(), { edge[0], edge[1] });
    this->Seams.ToInsert.push_back(0);
  }
  const TriangleMesh mesh = this->GetFirstMesh();
  FlipOptions options = this->Job.Options;
  options.Geometry = this->Job.Survey.Geometry;
  const double begin = this->Constraints.GetShare();
  const ProgressObserver progress = [=](double share)
  { return this->Tell(begin + (FirstShare - begin) * share); };
  this->First = std::make_unique<FlipSession>(mesh, options, progress);
  if (this->First->GetReport().StopReason != StopReasonKind::Aborted)
  {
    this->First->Advance(-1, {}, progress);
  }
  this->KeepFirst(mesh);
}

void PieceRun::KeepFirst(const TriangleMesh& mesh)
{
  this->Own = this->First->GetReport();
  this->Constraints.AddTo(this->Own);
  this->KeepRows(this->Own);
  this->StopReason = this->Constraints.HasAborted() ? StopReasonKind::Aborted : this->StopReason;
  const bool haveChanged = this->Mesh.AreAllListed(); // by constraints
  this->TakeFirst(this->MarkEdges(mesh));
  if (haveChanged || this->Job.Survey.NeedsGuard())
  {
    this->Mesh.ListAll();
  }
  if (this->Mesh.AreAllListed())
  {
    this->First.reset();
  }
  if (this->Job.Group.GetSize() > 1)
  {
    this->Mesh.BeginRounds(this->Job.Survey.NeedsGuard());
  }
}

void PieceRun::TakeFirst(MarkedEdges marks)
{
  const HostTriangles made = this->First->ViewHostTriangles();
  if (made.Records)
  {
    this->Mesh.TakeTriangles(made, std::move(marks));
    return;
  }
  const std::size_t count = this->Mesh.Triangles.size();
  RawVector<std::int32_t> ids(3 * count);
  RawVector<std::int32_t> flips(count);
  this->First->StoreTriangles(MutableTriangleArray(ids.data(), static_cast<std::int64_t>(count)));
  this->First->StoreFlipCounts(flips.data());
  this->Mesh.TakeTriangles(ids.data(), flips.data(), marks);
}

/// Finds the edges that need marks. Of a fixed edge with one triangle only those are marked that
/// have others on other ranks.
MarkedEdges PieceRun::MarkEdges(const TriangleMesh& mesh)
{
  MarkedEdges edges;
  for (const MarkedCorner& mark : this->Seams.Marks)
  {
    edges.Add(this->Mesh.GetEdge(mark.Triangle, mark.Slot), mark.Mark);
  }
  const EdgeCounts& counts = this->Own.Edges;
  const bool hasFixed = counts.Fixed > counts.Boundary + counts.NonManifold;
  if (hasFixed)
  {
    FlipOptions options = this->Job.Options;
    options.Geometry = this->Job.Survey.Geometry;
    const std::vector<std::int64_t> fixed = FindFixedEdges(mesh, options);
    for (std::size_t i = 0; i < fixed.size(); i += 2)
    {
      edges.Add(MakePair(fixed[i], fixed[i + 1]), FixedMark);
    }
  }
  if (counts.NonManifold > 0)
  {
    for (const PointPair& edge : FindCrowdedEdges(mesh.Triangles))
    {
      edges.Add(edge, FixedMark);
    }
  }
  return edges;
}

//------------------------------------------------------------------------------
/// Whether no rank has stopped.
bool PieceRun::MayGoOn()
{
  StopCounts own;
  own.Iterations = static_cast<std::int64_t>(this->Rows.size() - this->EarlierRows);
  this->EarlierRows = this->Rows.size();
  own.Aborted = this->StopReason == StopReasonKind::Aborted ? 1 : 0;
  own.Limited = this->StopReason == StopReasonKind::IterationLimit ? 1 : 0;
  own.Uncounted = this->Own.Triangles > 0 && this->Own.Edges.Edges == 0 ? 1 : 0;
  const StopCounts all = SumOverRanks(this->Job.Group, own);
  this->Iterations += all.Iterations;
  this->IsCounted = all.Uncounted == 0;
  if (all.Aborted > 0)
  {
    this->WholeStopReason = StopReasonKind::Aborted;
  }
  else if (all.Limited > 0 || (this->Job.Survey.NeedsGuard() && this->Whole.Rounds > MostRounds))
  {
    this->WholeStopReason = StopReasonKind::IterationLimit;
  }
  return this->WholeStopReason == StopReasonKind::Converged;
}

/// Tests the edges between ranks and flips around those that are bad. @returns whether there were
/// any.
bool PieceRun::MakeRound()
{
  ++this->Whole.Rounds;
  const bool mayGoOn = this->MayGoOn();
  SeamTest test = this->Tester.Run(this->Mesh, this->Judge, this->Job.Group);
  this->BadSeams = test.BadOfAll + test.BlockedOfAll;
  this->FoldedSeams = test.BlockedOfAll;
  GuardRound waiting;
  waiting.FreeOfAll = test.BadOfAll;
  if (this->Job.Survey.NeedsGuard() && mayGoOn)
  {
    waiting =
      this->Waiting.Flip(this->Mesh, this->Judge, test, this->Job.Group, !this->IsAtLimit());
    this->KeepFlips(waiting.Flipped);
  }
  if (!mayGoOn || waiting.FreeOfAll == 0)
  {
    return false;
  }
  if (this->IsAtLimit())
  {
    this->WholeStopReason = StopReasonKind::IterationLimit;
    return false;
  }
  std::int64_t moved = 0;
  // With a guard the two ranks of a seam may try different edges, and so find different halves.
  const MoveRule rule{ this->Whole.Rounds % 2 != 0, !this->Job.Survey.NeedsGuard() };
  const std::vector<std::int64_t> toJudge =
    MoveTriangles(this->Mesh, test.Bad, rule, this->Job.Group, moved);
  this->Whole.MovedTriangles += moved;
  DoTogether(this->Job.Group, [&]() { this->FlipAround(toJudge, waiting); });
  return true;
}

//------------------------------------------------------------------------------
/// Judges the edges of triangles that have come or lie at bad edges between ranks, or that have
/// waited; then, as far as flips reach, those further away.
void PieceRun::FlipAround(const std::vector<std::int64_t>& toJudge, const GuardRound& waiting)
{
  RoundFlips flips(this->Mesh, this->Judge, this->Job.Survey.NeedsGuard());
  for (const std::vector<std::int64_t>* list : { &toJudge, &waiting.Changed })
  {
    std::for_each(list->begin(), list->end(), [&](std::int64_t t) { flips.Add(t); });
  }
  for (const PointPair& edge : waiting.Gone)
  {
    flips.AddFreed(static_cast<std::int32_t>(edge[0]), static_cast<std::int32_t>(edge[1]));
  }
  this->Flip(flips);
}

void PieceRun::Flip(RoundFlips& flips)
{
  const StopWatch watch;
  const double rounds = static_cast<double>(this->Whole.Rounds);
  const std::int64_t limit = this->GetIterationLimit();
  while (!flips.AreDone() && this->StopReason == StopReasonKind::Converged)
  {
    if (!this->Tell(1.0 - (1.0 - FirstShare) / (1.0 + rounds)))
    {
      this->StopReason = StopReasonKind::Aborted;
    }
    else if (static_cast<std::int64_t>(this->Rows.size()) >= limit)
    {
      this->StopReason = flips.HasBad() ? StopReasonKind::IterationLimit : this->StopReason;
      break;
    }
    else
    {
      const IterationRecord row = flips.Iterate();
      this->HasBlocked = this->HasBlocked || row.Blocked > 0;
      if (row.Flipped > 0) // else it has found that nothing is left to do
      {
        this->KeepRow(row);
      }
    }
  }
  this->Own.FlipSeconds += watch.GetSeconds();
}

/// Whether all ranks together have made as many iterations as they may. What they do in a round at
/// the same time is one iteration.
bool PieceRun::IsAtLimit() const
{
  const std::int64_t most = this->Job.Options.MaximumIterations;
  return most >= 0 && this->Iterations >= most;
}

/// How many rows of this rank there may be at the end of the round.
std::int64_t PieceRun::GetIterationLimit() const
{
  if (this->Job.Options.MaximumIterations >= 0)
  {
    return static_cast<std::int64_t>(this->EarlierRows) + this->Job.Options.MaximumIterations -
      this->Iterations;
  }
  const auto triangles = static_cast<std::int64_t>(this->Mesh.Triangles.size());
  return static_cast<std::int64_t>(this->Rows.size()) + triangles + SafetyMargin;
}

//------------------------------------------------------------------------------
void PieceRun::KeepRows(const FlipReport& report)
{
  for (const IterationRecord& row : report.Iterations)
  {
    this->KeepRow(row);
  }
  this->HasBlocked = this->HasBlocked || report.NonDelaunayAfter > 0;
  this->StopReason = report.StopReason;
}

/// The smallest angle of a row is not that of the whole mesh.
void PieceRun::KeepRow(const IterationRecord& row)
{
  const bool isNext = !this->Rows.empty() && this->Rows.back().Round == this->Whole.Rounds;
  this->Rows.push_back({ this->Whole.Rounds, isNext ? this->Rows.back().Place + 1 : 0, row });
  this->Rows.back().Record.MinimumAngle = NaN;
}

/// Edges that were flipped outside of a session, all at once.
void PieceRun::KeepFlips(std::int64_t flipped)
{
  if (flipped > 0)
  {
    IterationRecord row;
    row.Tested = row.NonDelaunay = row.Flipped = flipped;
    this->KeepRow(row);
  }
}

//------------------------------------------------------------------------------
void PieceRun::Store(FlippedPiece& flipped) const
{
  const int rank = this->Job.Group.GetRank();
  flipped.Clear();
  if (this->First)
  {
    const std::int64_t count = this->FirstOrigins[rank + 1] - this->FirstOrigins[rank];
    // With room for the triangles that have come: to append them would else copy the whole arrays.
    const std::size_t most = this->Mesh.Triangles.size();
    flipped.Triangles.reserve(3 * most);
    flipped.FlipCounts.reserve(most);
    flipped.Triangles.resize(3 * count);
    flipped.FlipCounts.resize(count);
    this->First->StoreTriangles(MutableTriangleArray(flipped.Triangles.data(), count));
    this->First->StoreFlipCounts(flipped.FlipCounts.data());
    StoreListed(this->Mesh, this->FirstOrigins, rank, flipped);
  }
  else
  {
    StorePiece(this->Mesh, this->FirstOrigins, rank, flipped);
  }
  flipped.AreFloats = this->Job.Survey.IsFloat;
}

}
