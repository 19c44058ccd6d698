// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "HostMemory.h"
#include "PartMesh.h"
#include "PartSurvey.h"
#include "PieceFlip.h"
#include "Records.h"
#include "SeamRounds.h"
#include "SeamSurvey.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

/// @file
/// FlipPiece: one mesh whose parts are on many ranks.

namespace delaunayflip
{

namespace
{
/// The share of the time until the first test of edges between ranks, about.
constexpr double FirstShare = 0.8;

/// In the plane rounds end by themselves. On surfaces, where nothing proves that flips end, so many
/// are made at most.
constexpr std::int64_t MostRounds = 1000;

/// Nor that those of a round end, so it takes at most so many iterations more than the rank has
/// triangles.
constexpr std::int64_t SafetyMargin = 1000;
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
      Origins(job.Piece.Mesh.Triangles.Count, job.Group),
      Mesh(job.Piece, std::move(keys), job.Group.GetRank(), Origins.Firsts[job.Group.GetRank()]),
      Judge(job.Survey, job.Options),
      Constraints(Job, Mesh)
  {
    this->Whole.SeamEdges = this->Constraints.Seams.Seams;
    this->Whole.AmbiguousPoints = this->Mesh.GetPointKeys().Ambiguous;
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
    const std::int64_t first = this->Origins.Firsts[this->Job.Group.GetRank()];
    const std::int64_t count = this->Job.Piece.Mesh.Triangles.Count;
    flipped.Clear();
    flipped.AreFloats = this->Job.Survey.IsFloat;
    constexpr std::uint32_t Gone = 0xFFFFFFFFu;
    HostVector<std::uint32_t> own(count, Gone); // by slot; some have come back
    std::vector<std::int64_t> others;
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      const std::int64_t slot = triangles[t].Origin - first;
      if (slot >= 0 && slot < count && !triangles[t].HasLeft)
      {
        own[slot] = static_cast<std::uint32_t>(t);
      }
      else if (!triangles[t].HasLeft)
      {
        others.push_back(static_cast<std::int64_t>(t));
      }
    }
    std::sort(others.begin(), others.end(),
      [&](std::int64_t a, std::int64_t b) { return triangles[a].Origin < triangles[b].Origin; });

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
        flipped.ReceivedPoints.push_back(
          this->Mesh.GetPointKeys().Owners.Find(this->Mesh.GetKey(point)));
        flipped.ReceivedCoordinates.insert(flipped.ReceivedCoordinates.end(), x, x + 3);
      }
      return id;
    };
    const auto store = [&](const PartTriangle& triangle)
    {
      flipped.FlipCounts.push_back(triangle.Flips);
      std::transform(
        triangle.Points, triangle.Points + 3, std::back_inserter(flipped.Triangles), storePoint);
    };
    const std::size_t size = count + others.size(); // at most
    flipped.Triangles.reserve(3 * size);
    flipped.FlipCounts.reserve(size);
    for (std::int64_t slot = 0; slot < count; ++slot)
    {
      if (own[slot] == Gone)
      {
        flipped.GoneTriangles.push_back(slot);
      }
      else
      {
        store(triangles[own[slot]]);
      }
    }
    for (const std::int64_t t : others)
    {
      flipped.ReceivedTriangles.push_back(this->Origins.Find(triangles[t].Origin));
      store(triangles[t]);
    }
  }

private:
  /// Calls the observer of this rank. @returns whether to go on.
  bool Tell(double share) const
  {
    return !this->Constraints.IsAborted && (!this->Job.Progress || this->Job.Progress(share));
  }

  //------------------------------------------------------------------------------
  /// Flips the part by itself, with the constraints that other ranks know of.
  void FlipFirst()
  {
    TriangleMesh mesh = this->Constraints.Mesh;
    mesh.Whole.SharedPoints =
      this->Job.Survey.NeedsGuard() ? this->Mesh.GetPointKeys().Shared.data() : nullptr;
    const double begin = this->Constraints.Share;
    const ProgressObserver progress = [=](double share)
    { return this->Tell(begin + (FirstShare - begin) * share); };
    FlipSession session(mesh, this->Job.Options, progress);
    if (session.GetReport().StopReason != StopReasonKind::Aborted)
    {
      session.Advance(-1, {}, progress);
    }
    this->Own = session.GetReport();
    this->Constraints.AddTo(this->Own);
    this->HasBlocked = this->Own.NonDelaunayAfter > 0;
    this->StopReason = this->Constraints.IsAborted ? StopReasonKind::Aborted : this->Own.StopReason;
    const std::int64_t count = mesh.Triangles.Count;
    HostVector<std::int32_t> ids(3 * count), flips(count);
    session.StoreTriangles(MutableTriangleArray(ids.data(), count));
    session.StoreFlipCounts(flips.data());
    this->Constraints.AddFlipCounts(flips.data());
    this->Mesh.Take(TriangleArray(ids.data(), count));
    for (std::int64_t t = 0; t < count; ++t)
    {
      this->Mesh.Triangles[t].Flips = flips[t];
    }
    if (this->Job.Group.GetSize() > 1)
    {
      this->BeginRounds();
    }
  }

  /// Finds the edges that need marks. Of a fixed edge with one triangle only those are marked that
  /// have others on other ranks.
  void BeginRounds()
  {
    MarkedEdges edges = std::move(this->Constraints.Seams.Marks);
    const std::vector<std::int64_t> fixed =
      ListFixedEdges(this->Constraints.Mesh, this->Job.Options, this->Own.Edges);
    for (std::size_t i = 0; i < fixed.size(); i += 2)
    {
      edges[MakePair(fixed[i], fixed[i + 1])] |= FixedMark;
    }
    this->Mesh.BeginRounds(edges);
  }

  //------------------------------------------------------------------------------
  /// Whether no rank has stopped.
  bool MayGoOn()
  {
    const bool isUncounted = this->Own.Triangles > 0 && this->Own.Edges.Edges == 0;
    const std::vector<std::int64_t> own{ this->StopReason == StopReasonKind::Aborted ? 1 : 0,
      this->StopReason == StopReasonKind::IterationLimit ? 1 : 0, isUncounted ? 1 : 0,
      this->CountRows() - this->EarlierRows };
    this->EarlierRows = this->CountRows();
    const std::vector<std::int64_t> most = FindMaxima(this->Job.Group, own);
    this->IsCounted = most[2] == 0;
    this->Iterations += most[3];
    if (most[0] != 0)
    {
      this->WholeStopReason = StopReasonKind::Aborted;
    }
    else if (most[1] != 0 || (this->Job.Survey.NeedsGuard() && this->Whole.Rounds > MostRounds))
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
    const std::vector<std::int64_t> changed = this->Mesh.TakeChanged();
    SeamTest test = this->Tester.Run(this->Mesh, changed, this->Judge, group);
    this->Seams = test.OfAll;
    GuardRound waiting;
    waiting.FreeOfAll = test.OfAll.Bad;
    if (needsGuard && mayGoOn)
    {
      this->Waiting.insert(this->Waiting.end(), changed.begin(), changed.end());
      waiting = AskForFlips(this->Mesh, this->Judge, this->Waiting, test, group);
      if (!this->IsAtLimit())
      {
        waiting.Flip(this->Mesh, test);
      }
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
    const std::int64_t limit = this->Job.Options.MaximumIterations >= 0
      ? this->EarlierRows + this->Job.Options.MaximumIterations - this->Iterations
      : this->CountRows() + static_cast<std::int64_t>(this->Mesh.Triangles.size()) + SafetyMargin;
    while (!flips.AreDone() && this->StopReason == StopReasonKind::Converged)
    {
      if (!this->Tell(1.0 - (1.0 - FirstShare) / (1.0 + rounds)))
      {
        this->StopReason = StopReasonKind::Aborted;
      }
      else if (this->CountRows() >= limit)
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

  std::int64_t CountRows() const { return static_cast<std::int64_t>(this->Own.Iterations.size()); }

  /// Keeps an iteration of this rank. Those of all ranks with the same place in the same round are
  /// one iteration of the whole mesh.
  void KeepRow(IterationRecord row)
  {
    row.Iteration = this->Iterations + this->CountRows() - this->EarlierRows + 1;
    this->Own.Iterations.push_back(row);
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
    this->Own.NonDelaunayAfter = this->Own.BlockedByShape = this->Own.BlockedByDeviation =
      this->Own.BlockedByEdge = 0;
    if (this->HasBlocked || this->StopReason != StopReasonKind::Converged)
    {
      this->CountBad();
    }
  }

  /// The bad edges that are left on this rank.
  void CountBad()
  {
    if (!this->Mesh.HasBegunRounds())
    {
      this->BeginRounds(); // which finds the mates of corners
    }
    const RoundFlips flips(this->Mesh, this->Judge, this->Job.Survey.NeedsGuard());
    const auto count = static_cast<std::int64_t>(this->Mesh.Triangles.size());
    for (std::int64_t t = 0; t < count; ++t)
    {
      for (int slot = 0; slot < 3 && !this->Mesh.Triangles[t].HasLeft; ++slot)
      {
        const PartCorner mate = this->Mesh.FindOpenMate({ t, slot });
        const EdgeState state =
          mate.Triangle > t ? flips.Judge({ t, slot }, mate) : EdgeState::Good;
        this->Own.NonDelaunayAfter += state != EdgeState::Good ? 1 : 0;
        this->Own.BlockedByShape += state == EdgeState::BlockedByShape ? 1 : 0;
        this->Own.BlockedByDeviation += state == EdgeState::BlockedByDeviation ? 1 : 0;
        this->Own.BlockedByEdge += state == EdgeState::BlockedByEdge ? 1 : 0;
      }
    }
  }

  PiecesReport MakeReport()
  {
    const PointKeys& keys = this->Mesh.GetPointKeys();
    const FlipReport& seams = this->Constraints.Seams.Totals;
    AddCounts(this->Own.Edges, seams.Edges, 1);
    this->Own.NonDelaunayBefore += seams.NonDelaunayAfter;
    PiecesReport report = this->Whole;
    static_cast<FlipReport&>(report) = JoinReports(this->Own, this->Job.Group);
    CountIterations(report);
    report.Points = keys.Owners.Firsts.back() - keys.Repeated;
    report.EulerCharacteristic = keys.UsedPoints - report.Edges.Edges + report.Triangles;
    if (!this->IsCounted)
    {
      report.Edges = EdgeCounts();
      report.EulerCharacteristic = 0;
    }
    report.NonDelaunayAfter += this->Seams.Bad + this->Seams.Blocked;
    report.BlockedByShape += this->Seams.Blocked - this->Seams.Deviating;
    report.BlockedByDeviation += this->Seams.Deviating;
    const bool areBlocked = this->WholeStopReason == StopReasonKind::Converged;
    report.BlockedByEdge += areBlocked ? this->Seams.Bad : 0;
    report.GeometryUsed = this->Job.Survey.Geometry;
    report.GeometryReason = this->Job.Survey.GeometryReason;
    report.StopReason = this->WholeStopReason;
    if (!report.Iterations.empty())
    {
      report.Iterations.back().MinimumAngle = report.MinimumAngleAfter;
    }
    AddDefect(this->Job.Survey.NearlyHeightField, report.Defects);
    return report;
  }

  PartJob Job;
  RankNumbers Origins; ///< Of the triangles in their input slots.
  PartMesh Mesh;
  QuadJudge Judge;
  SeamTester Tester;
  std::vector<std::int64_t> Waiting; ///< Triangles of edges that may wait (AskForFlips).
  PartConstraints Constraints;

  // Of this rank:
  FlipReport Own; ///< Starts as the report of the first flips. Has the iterations of all rounds.
  StopReasonKind StopReason = StopReasonKind::Converged;
  std::int64_t EarlierRows = 0; ///< Iterations of this rank in earlier rounds.
  bool HasBlocked = false; ///< Whether a bad edge was seen that may not flip.

  // Of all ranks:
  PiecesReport Whole; ///< The members that it inherits from FlipReport are set at the end.
  StopReasonKind WholeStopReason = StopReasonKind::Converged;
  std::int64_t Iterations = 0; ///< Of earlier rounds.
  bool IsCounted = true; ///< Whether no rank was stopped before its edges were counted.
  SeamCounts Seams; ///< At the last test.
};

//------------------------------------------------------------------------------
void FlippedPiece::Clear()
{
  this->Triangles.clear();
  this->FlipCounts.clear();
  this->GoneTriangles.clear();
  this->ReceivedTriangles.clear();
  this->ReceivedPoints.clear();
  this->ReceivedCoordinates.clear();
}

std::vector<PieceOrigin> ListOrigins(const FlippedPiece& flipped, int rank)
{
  const std::size_t kept = flipped.FlipCounts.size() - flipped.ReceivedTriangles.size();
  std::vector<PieceOrigin> origins;
  origins.reserve(flipped.FlipCounts.size());
  auto gone = flipped.GoneTriangles.begin();
  for (std::int64_t slot = 0; origins.size() < kept; ++slot)
  {
    if (gone != flipped.GoneTriangles.end() && *gone == slot)
    {
      ++gone;
      continue;
    }
    origins.push_back({ rank, slot });
  }
  origins.insert(origins.end(), flipped.ReceivedTriangles.begin(), flipped.ReceivedTriangles.end());
  return origins;
}

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
    own.Geometry = survey.Geometry;
    PartRun run({ piece, own, survey, told, progress }, std::move(keys));
    report = run.Run();
    run.Store(flipped);
  };
  RunTogether(group, std::ref(flip)); // a copy of flip would need memory
  return report;
}

}
