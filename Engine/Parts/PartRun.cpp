// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "HostMemory.h"
#include "JoinReports.h"
#include "MeshAudit.h"
#include "PartConstraints.h"
#include "PartMesh.h"
#include "PartSurvey.h"
#include "PieceFlip.h"
#include "SeamRounds.h"
#include "SeamSurvey.h"
#include "StopWatch.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

/// @file
/// FlipPiece: one mesh whose parts are on many ranks.

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

/// The number of the first triangle of every rank, and at the end that of all.
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

/// What a rank says after its flips, or all ranks together.
struct RankState
{
  bool IsAborted = false, IsLimited = false;
  bool IsUncounted = false; ///< Stopped before the edges were counted.
  std::int64_t Iterations = 0; ///< Since the last time; the most that a rank has made.

  RankState& operator+=(const RankState& other)
  {
    this->IsAborted |= other.IsAborted;
    this->IsLimited |= other.IsLimited;
    this->IsUncounted |= other.IsUncounted;
    this->Iterations = std::max(this->Iterations, other.Iterations);
    return *this;
  }
};

/// Removes items of `size` values by their numbers, which ascend.
template <typename T>
void RemoveItems(const std::vector<std::int64_t>& gone, std::int64_t size, std::vector<T>& values)
{
  auto to = values.begin() + (gone.empty() ? values.size() : size * gone.front());
  for (std::size_t i = 0; i < gone.size(); ++i)
  {
    const auto end = i + 1 < gone.size() ? values.begin() + size * gone[i + 1] : values.end();
    to = std::move(values.begin() + size * (gone[i] + 1), end, to);
  }
  values.erase(to, values.end());
}

}

/// What a rank does in a run.
///
/// First each rank flips its part, in which the edges between ranks, the seam edges, are boundary
/// edges. Then rounds follow. In a round, all seam edges are tested; triangles at bad ones move to
/// the other rank, so that these edges become inner edges; and each rank flips from there on. Every
/// round flips at least one bad edge, so the proof that flips end on one rank holds here too.
class PartRun
{
public:
  PartRun(const PartJob& job, PointKeys keys)
    : Job(job),
      FirstOrigins(NumberTriangles(job.Piece, job.Group)),
      Mesh(job.Piece, std::move(keys), job.Group.GetRank(), FirstOrigins[job.Group.GetRank()]),
      Judge(job.Survey, job.Options),
      Constraints(Job, Mesh),
      Seams(std::move(Constraints.Seams))
  {
    this->Whole.SeamEdges = this->Seams.Counts.Seams;
    this->Whole.AmbiguousPoints = this->Mesh.GetWholeKeys().Ambiguous;
  }

  /// Makes the first flips and all rounds. All ranks must call this together.
  /// @returns the report of the whole mesh.
  PiecesReport Run()
  {
    DoTogether(this->Job.Group, [this]() { this->FlipFirst(); });
    while (this->MakeRound())
    {
    }
    DoTogether(this->Job.Group, [this]() { this->CountRest(); });
    return this->MakeReport();
  }

  void Store(FlippedPiece& flipped) const
  {
    const PartTriangles& triangles = this->Mesh.Triangles;
    const std::int64_t first = this->FirstOrigins[this->Job.Group.GetRank()];
    const std::int64_t count = this->FirstOrigins[this->Job.Group.GetRank() + 1] - first;
    this->StoreFirst(flipped, count);
    std::vector<std::int64_t> own, others;
    this->FindTriangles(flipped.GoneTriangles, own, others);

    // Overwrites the slots of listed triangles, closes those of gone ones, and adds those of
    // others.
    std::vector<std::int32_t> idOfReceived(
      this->Mesh.GetNumberOfPoints() - this->Mesh.GetFirstReceived(), -1);
    const auto storePoint = [&](std::int32_t point)
    {
      const auto firstReceived = static_cast<std::int32_t>(this->Mesh.GetFirstReceived());
      if (point < firstReceived)
      {
        return point;
      }
      std::int32_t& id = idOfReceived[point - firstReceived];
      if (id < 0)
      {
        id = firstReceived + static_cast<std::int32_t>(flipped.ReceivedPoints.size());
        double x[3];
        this->Mesh.GetPosition(point, x);
        flipped.ReceivedPoints.push_back(this->Mesh.FindOrigin(point));
        flipped.ReceivedCoordinates.insert(flipped.ReceivedCoordinates.end(), x, x + 3);
      }
      return id;
    };
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      constexpr std::size_t PrefetchDistance = 16;
      Prefetch(&triangles[own[std::min(i + PrefetchDistance, own.size() - 1)]]);
      const PartTriangle& triangle = triangles[own[i]];
      const std::int64_t slot = triangle.Origin - first;
      flipped.FlipCounts[slot] = triangle.Flips;
      std::transform(
        triangle.Points, triangle.Points + 3, flipped.Triangles.begin() + 3 * slot, storePoint);
    }
    RemoveItems(flipped.GoneTriangles, 3, flipped.Triangles);
    RemoveItems(flipped.GoneTriangles, 1, flipped.FlipCounts);
    for (const std::int64_t t : others)
    {
      const auto after =
        std::upper_bound(this->FirstOrigins.begin(), this->FirstOrigins.end(), triangles[t].Origin);
      const auto rank = static_cast<std::int32_t>(after - this->FirstOrigins.begin() - 1);
      flipped.ReceivedTriangles.push_back({ rank, triangles[t].Origin - this->FirstOrigins[rank] });
      flipped.FlipCounts.push_back(triangles[t].Flips);
      std::transform(triangles[t].Points, triangles[t].Points + 3,
        std::back_inserter(flipped.Triangles), storePoint);
    }
  }

private:
  /// Stores the triangles of the first flips in their slots, or makes room for all.
  void StoreFirst(FlippedPiece& flipped, std::int64_t count) const
  {
    flipped.Clear();
    flipped.AreFloats = this->Job.Survey.IsFloat;
    // With room for the triangles that have come: to append them would else copy the whole arrays.
    flipped.Triangles.reserve(3 * this->Mesh.Triangles.size());
    flipped.FlipCounts.reserve(this->Mesh.Triangles.size());
    flipped.Triangles.resize(3 * count);
    flipped.FlipCounts.resize(count);
    if (this->First)
    {
      this->First->StoreTriangles(MutableTriangleArray(flipped.Triangles.data(), count));
      this->First->StoreFlipCounts(flipped.FlipCounts.data());
    }
  }

  /// Finds the listed triangles that are here: the rank's own, and others by their origins.
  /// @param gone receives the slots of own ones that have left.
  void FindTriangles(std::vector<std::int64_t>& gone, std::vector<std::int64_t>& own,
    std::vector<std::int64_t>& others) const
  {
    const PartTriangles& triangles = this->Mesh.Triangles;
    const std::int64_t first = this->FirstOrigins[this->Job.Group.GetRank()];
    const std::int64_t count = this->FirstOrigins[this->Job.Group.GetRank() + 1] - first;
    constexpr std::uint32_t Unlisted = 0xFFFFFFFFu, Gone = Unlisted - 1;
    HostVector<std::uint32_t> places(count, this->First ? Unlisted : Gone);
    for (const std::int64_t t : this->Mesh.FindListed())
    {
      const std::int64_t slot = triangles[t].Origin - first;
      const bool isOwn = slot >= 0 && slot < count;
      if (isOwn && triangles[t].HasLeft)
      {
        places[slot] = places[slot] == Unlisted ? Gone : places[slot]; // or it has come back
      }
      else if (isOwn)
      {
        places[slot] = static_cast<std::uint32_t>(t);
        own.push_back(t);
      }
      else if (!triangles[t].HasLeft)
      {
        others.push_back(t);
      }
    }
    if (!this->First)
    {
      own.clear(); // the order of slots is faster
    }
    for (std::int64_t slot = 0; slot < count; ++slot)
    {
      if (places[slot] == Gone)
      {
        gone.push_back(slot);
      }
      else if (!this->First)
      {
        own.push_back(places[slot]);
      }
    }
    std::sort(others.begin(), others.end(),
      [&](std::int64_t a, std::int64_t b) { return triangles[a].Origin < triangles[b].Origin; });
  }

  /// Calls the observer of this rank. @returns whether to go on.
  bool Tell(double share) const
  {
    return !this->Constraints.IsAborted && (!this->Job.Progress || this->Job.Progress(share));
  }

  //------------------------------------------------------------------------------
  /// Flips the part by itself, with the constraints that other ranks know of.
  void FlipFirst()
  {
    for (const PointPair& edge : this->Seams.EdgesToFix)
    {
      this->Seams.Constraints.insert(this->Seams.Constraints.end(), { edge[0], edge[1] });
      this->Seams.ToInsert.push_back(0);
    }
    TriangleMesh mesh = this->Constraints.Piece.Mesh;
    mesh.ConstraintEdges = this->Seams.Constraints.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Seams.ToInsert.size());
    mesh.ConstraintsToInsert = this->Seams.ToInsert.data();
    mesh.Whole = this->Job.Survey.Whole;
    mesh.Whole.SharedPoints =
      this->Job.Survey.NeedsGuard() ? this->Mesh.GetShared().data() : nullptr;
    FlipOptions options = this->Job.Options;
    options.Geometry = this->Job.Survey.Geometry;
    const double begin = this->Constraints.Share;
    const ProgressObserver progress = [=](double share)
    { return this->Tell(begin + (FirstShare - begin) * share); };
    this->First = std::make_unique<FlipSession>(mesh, options, progress);
    if (this->First->GetReport().StopReason != StopReasonKind::Aborted)
    {
      this->First->Advance(-1, {}, progress);
    }
    this->Own = this->First->GetReport();
    this->Constraints.AddTo(this->Own);
    std::for_each(this->Own.Iterations.begin(), this->Own.Iterations.end(),
      [this](const IterationRecord& row) { this->KeepRow(row); });
    this->HasBlocked = this->Own.NonDelaunayAfter > 0;
    this->StopReason = this->Constraints.IsAborted ? StopReasonKind::Aborted : this->Own.StopReason;
    this->TakeFirst(mesh);
  }

  /// Takes the triangles of the first flips.
  /// @param mesh what they started from.
  void TakeFirst(const TriangleMesh& mesh)
  {
    const bool haveChanged = this->Mesh.AreAllListed(); // by constraints
    MarkedEdges marks = this->MarkEdges(mesh);
    const HostTriangles made = this->First->ViewHostTriangles();
    if (made.Records)
    {
      this->Mesh.TakeTriangles(made, std::move(marks));
    }
    else
    {
      const std::size_t count = this->Mesh.Triangles.size();
      RawVector<std::int32_t> ids(3 * count);
      RawVector<std::int32_t> flips(count);
      this->First->StoreTriangles(
        MutableTriangleArray(ids.data(), static_cast<std::int64_t>(count)));
      this->First->StoreFlipCounts(flips.data());
      this->Mesh.TakeTriangles(ids.data(), flips.data(), marks);
    }
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
      this->Mesh.BeginRounds();
    }
  }

  /// Finds the edges that need marks. Of a fixed edge with one triangle only those are marked that
  /// have others on other ranks.
  MarkedEdges MarkEdges(const TriangleMesh& mesh)
  {
    MarkedEdges edges;
    for (const MarkedCorner& mark : this->Seams.Marks)
    {
      edges.Add(this->Mesh.GetEdge(mark.Triangle, mark.Slot), mark.Mark);
    }
    FlipOptions options = this->Job.Options;
    options.Geometry = this->Job.Survey.Geometry;
    const std::vector<std::int64_t> fixed = ListFixedEdges(mesh, options, this->Own.Edges);
    for (std::size_t i = 0; i < fixed.size(); i += 2)
    {
      edges.Add(MakePair(fixed[i], fixed[i + 1]), FixedMark);
    }
    return edges;
  }

  //------------------------------------------------------------------------------
  /// Whether no rank has stopped.
  bool MayGoOn()
  {
    RankState state;
    state.IsAborted = this->StopReason == StopReasonKind::Aborted;
    state.IsLimited = this->StopReason == StopReasonKind::IterationLimit;
    state.IsUncounted = this->Own.Triangles > 0 && this->Own.Edges.Edges == 0;
    state.Iterations = static_cast<std::int64_t>(this->Rows.size() - this->EarlierRows);
    this->EarlierRows = this->Rows.size();
    state = SumOverRanks(this->Job.Group, state);
    this->Iterations += state.Iterations;
    this->IsCounted = !state.IsUncounted;
    if (state.IsAborted)
    {
      this->WholeStopReason = StopReasonKind::Aborted;
    }
    else if (state.IsLimited || (this->Job.Survey.NeedsGuard() && this->Whole.Rounds > MostRounds))
    {
      this->WholeStopReason = StopReasonKind::IterationLimit;
    }
    return this->WholeStopReason == StopReasonKind::Converged;
  }

  /// Whether all ranks together have made as many iterations as they may. What they do in a round
  /// at the same time is one iteration.
  bool IsAtLimit() const
  {
    const std::int64_t most = this->Job.Options.MaximumIterations;
    return most >= 0 && this->Iterations >= most;
  }

  /// Tests the edges between ranks and flips around those that are bad. @returns whether there were
  /// any.
  bool MakeRound()
  {
    ++this->Whole.Rounds;
    PieceGroup& group = this->Job.Group;
    const bool needsGuard = this->Job.Survey.NeedsGuard();
    const bool mayGoOn = this->MayGoOn();
    SeamTest test = this->Tester.Run(this->Mesh, this->Judge, group);
    this->BadSeams = test.BadOfAll + test.BlockedOfAll;
    this->FoldedSeams = test.BlockedOfAll;
    const std::vector<std::int64_t> changed = this->Mesh.TakeChanged();
    GuardRound waiting;
    waiting.FreeOfAll = test.BadOfAll;
    if (needsGuard && mayGoOn)
    {
      this->Waiting.insert(this->Waiting.end(), changed.begin(), changed.end());
      waiting =
        FlipWaiting(this->Mesh, this->Judge, this->Waiting, test, group, !this->IsAtLimit());
      if (!waiting.Gone.empty()) // all at once
      {
        IterationRecord row;
        row.Tested = row.NonDelaunay = row.Flipped = static_cast<std::int64_t>(waiting.Gone.size());
        this->KeepRow(row);
      }
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
    const MoveRule rule{ this->Whole.Rounds % 2 != 0, !needsGuard };
    const std::vector<std::int64_t> toJudge =
      MoveTriangles(this->Mesh, test.Bad, rule, group, moved);
    this->Whole.MovedTriangles += moved;
    DoTogether(group,
      [&]()
      {
        // The edges of triangles that have come or lie at bad seam edges, or that have waited;
        // then, as far as flips reach, those further away.
        RoundFlips flips(this->Mesh, this->Judge, needsGuard);
        const auto add = [&](std::int64_t t) { flips.Add(t); };
        std::for_each(toJudge.begin(), toJudge.end(), add);
        std::for_each(waiting.Changed.begin(), waiting.Changed.end(), add);
        std::for_each(waiting.Gone.begin(), waiting.Gone.end(),
          [&](const PointPair& edge) { flips.AddFreed(edge); });
        this->Flip(flips);
      });
    return true;
  }

  void Flip(RoundFlips& flips)
  {
    const StopWatch watch;
    const double rounds = static_cast<double>(this->Whole.Rounds);
    const auto made = static_cast<std::int64_t>(this->Rows.size());
    const std::int64_t limit = this->Job.Options.MaximumIterations >= 0
      ? static_cast<std::int64_t>(this->EarlierRows) + this->Job.Options.MaximumIterations -
        this->Iterations
      : made + static_cast<std::int64_t>(this->Mesh.Triangles.size()) + SafetyMargin;
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

  /// The smallest angle of a row is not that of the whole mesh.
  void KeepRow(const IterationRecord& row)
  {
    const bool isNext = !this->Rows.empty() && this->Rows.back().Round == this->Whole.Rounds;
    this->Rows.push_back({ this->Whole.Rounds, isNext ? this->Rows.back().Place + 1 : 0, row });
    this->Rows.back().Record.MinimumAngle = NaN;
  }

  //------------------------------------------------------------------------------
  /// The edges that are left, and the smallest angle, on this rank.
  void CountRest()
  {
    if (this->Whole.Rounds == 1 && this->Own.Edges.Edges > 0)
    {
      return; // the first flips were the last
    }
    this->Own.MinimumAngleAfter =
      this->Mesh.FindSmallestAngle(this->Job.Survey, this->Job.Options.NumberOfThreads);
    this->Own.NonDelaunayAfter = this->Own.BlockedByShape = this->Own.BlockedByEdge = 0;
    if (this->HasBlocked || this->StopReason != StopReasonKind::Converged)
    {
      this->CountBad();
    }
  }

  /// The bad edges that are left on this rank.
  void CountBad()
  {
    this->Mesh.ListAll();
    PointList points{ this->Job.Survey.IsFloat, {}, {} };
    for (std::int64_t i = 0; i < this->Mesh.GetNumberOfPoints(); ++i)
    {
      double x[3];
      this->Mesh.GetPosition(i, x);
      points.Add(x);
    }
    std::vector<std::int32_t> ids;
    std::vector<std::int64_t> fixed;
    for (const PartTriangle& triangle : this->Mesh.Triangles)
    {
      for (int slot = 0; slot < 3 && !triangle.HasLeft; ++slot)
      {
        ids.push_back(triangle.Points[slot]);
        if (triangle.Has(FixedMark, slot))
        {
          fixed.insert(fixed.end(), { triangle.GetStart(slot), triangle.GetEnd(slot) });
        }
      }
    }
    TriangleMesh mesh;
    mesh.Points = points.View();
    mesh.Triangles = TriangleArray(ids.data(), static_cast<std::int64_t>(ids.size()) / 3);
    mesh.ConstraintEdges = fixed.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(fixed.size()) / 2;
    mesh.Whole = this->Job.Survey.Whole;
    mesh.Whole.SharedPoints =
      this->Job.Survey.NeedsGuard() ? this->Mesh.GetShared().data() : nullptr;
    FlipOptions none = GetPartOptions(this->Job.Survey, this->Job.Options);
    none.MaximumIterations = 0;
    const FlipSession session(mesh, none);
    const FlipReport& report = session.GetReport();
    this->Own.NonDelaunayAfter = report.NonDelaunayAfter;
    this->Own.BlockedByShape = report.BlockedByShape;
    this->Own.BlockedByEdge = report.BlockedByEdge;
  }

  PiecesReport MakeReport()
  {
    const SeamCounts& seams = this->Seams.Counts;
    const PointKeys& keys = this->Mesh.GetWholeKeys();
    PiecesReport report = this->Whole;
    static_cast<FlipReport&>(report) = JoinReports(this->Own, this->Rows, this->Job.Group);
    report.Points = keys.FirstKeys.back() - keys.Repeated;
    AddCounts(report.Edges, seams.Edges, 1);
    report.EulerCharacteristic = keys.UsedPoints - report.Edges.Edges + report.Triangles;
    if (!this->IsCounted)
    {
      report.Edges = EdgeCounts();
      report.EulerCharacteristic = 0;
    }
    report.UnmatchedConstraints += seams.MissingConstraints;
    report.NonDelaunayBefore += seams.NonDelaunay;
    report.NonDelaunayAfter += this->BadSeams;
    report.BlockedByShape += this->FoldedSeams;
    const bool areBlocked = this->WholeStopReason == StopReasonKind::Converged;
    report.BlockedByEdge += areBlocked ? this->BadSeams - this->FoldedSeams : 0;
    report.GeometryUsed = this->Job.Survey.Geometry;
    report.GeometryReason = this->Job.Survey.GeometryReason;
    report.StopReason = this->WholeStopReason;
    if (!report.Iterations.empty())
    {
      report.Iterations.back().MinimumAngle = report.MinimumAngleAfter;
    }
    const Defect onSurface{ Describe(Refusal::OnSurface), seams.MissingToInsert, {},
      DefectIds::PointPairs };
    const Defect missing{ "constraint edges that are not edges of the mesh",
      seams.MissingConstraints - seams.MissingToInsert, {}, DefectIds::Points };
    for (const Defect& defect : { this->Job.Survey.NearlyHeightField, onSurface, missing })
    {
      AddDefect(defect, report.Defects);
    }
    return report;
  }

  PartJob Job;
  std::vector<std::int64_t> FirstOrigins;
  PartMesh Mesh;
  QuadJudge Judge;
  SeamTester Tester;
  std::vector<std::int64_t> Waiting; ///< Triangles of edges that may wait (FlipWaiting).
  PartConstraints Constraints;
  SeamSurvey Seams; ///< Of the mesh with the constraints inserted.

  // Of this rank:
  FlipReport Own; ///< Starts as the report of the first flips.
  std::vector<RoundRow> Rows;
  /// The session of the first flips. Keeps the triangles that are not listed (PartMesh), if any.
  std::unique_ptr<FlipSession> First;
  StopReasonKind StopReason = StopReasonKind::Converged;
  std::size_t EarlierRows = 0; ///< Rows of earlier rounds.
  bool HasBlocked = false; ///< Whether a bad edge was seen that may not flip.

  // Of all ranks:
  PiecesReport Whole; ///< The members that it inherits from FlipReport are set at the end.
  StopReasonKind WholeStopReason = StopReasonKind::Converged;
  std::int64_t Iterations = 0; ///< Of earlier rounds.
  bool IsCounted = true; ///< Whether no rank was stopped before its edges were counted.
  std::int64_t BadSeams = 0; ///< Bad seam edges that are left at the end, for any reason.
  std::int64_t FoldedSeams = 0; ///< Of these, the ones whose flip would fold the mesh over.
};

//------------------------------------------------------------------------------
PiecesReport FlipPiece(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group,
  FlippedPiece& flipped, const ProgressObserver& progress)
{
  PiecesReport report;
  const auto flip = [&](PieceGroup& told)
  {
    RequireSameOptions(options, told);
    CheckParts(piece, options, told);
    FlipOptions own = options;
    own.NumberOfPieces = 1; // a session of several does not know what other ranks have
    own.TrackQuality = false;
    PointKeys keys = MatchPoints(piece, told);
    const PartSurvey survey = SurveyParts(piece, keys, own, told);
    PartRun run({ piece, own, survey, told, progress }, std::move(keys));
    report = run.Run();
    run.Store(flipped);
  };
  RunTogether(group, std::ref(flip)); // a copy of flip would need memory
  return report;
}

}
