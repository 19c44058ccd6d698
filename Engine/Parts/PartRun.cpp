// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "HostMemory.h"
#include "PartMesh.h"
#include "PartReports.h"
#include "PartSurvey.h"
#include "PieceFlip.h"
#include "Records.h"
#include "SeamRounds.h"
#include "SeamSurvey.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <unordered_set>
#include <utility>

/// @file
/// FlipPiece: one mesh with its parts on many ranks.

namespace delaunayflip
{

namespace
{
/// The share of the time until the first test of edges between ranks, about.
constexpr double FirstShare = 0.8;

/// In the plane rounds end by themselves. On surfaces, where nothing proves that flips end, at most
/// this many are made.
constexpr std::int64_t MostRounds = 1000;

/// Nothing proves there that the iterations of a round end. So a round makes at most this many more
/// than the rank has triangles.
constexpr std::int64_t SafetyMargin = 1000;

// The guard keeps a flip from making an edge that another rank has. Such an edge could only join
// two shared points. So when ranks flip alone, they make no flip that would join two shared points:
// the edge waits. Afterwards all ranks are asked whether the new edge exists. If it does not, one
// rank may make it.

/// An edge to flip, and the edge that this would make.
struct FlipQuestion
{
  PointPair Ends; ///< Keys.
  PointPair Opposite; ///< Keys.
  bool IsSeam; ///< Between ranks, so that it cannot flip now.
};

/// An inner edge of a rank that waits, with the two corners opposite to it.
struct WaitingFlip : FlipQuestion
{
  PartCorner One, Other;
};

/// What has become of waiting edges in a round, on one rank.
struct WaitedFlips
{
  std::int64_t FreeOfAll = 0; ///< How many edges may flip, on all ranks and between them.
  std::vector<std::int64_t> Changed; ///< The triangles of the edges that this rank has flipped.
  std::vector<PointPair> Gone; ///< The ends of these edges before the flip.
};

/// Finds inner edges of some triangles that must wait. Both points opposite to such an edge are
/// shared, and it is bad, and its flip would not fold the mesh over. The edges are in the order of
/// the later of their triangles.
std::vector<WaitingFlip> FindWaiting(
  PartMesh& mesh, std::vector<std::int64_t> triangles, const QuadJudge& judge)
{
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<WaitingFlip> waiting;
  for (const std::int64_t t : triangles)
  {
    for (int slot = 0; slot < 3 && !mesh.Triangles[t].HasLeft; ++slot)
    {
      const PartCorner corner{ t, slot };
      if (!mesh.IsShared(mesh.Triangles[t].Points[slot]))
      {
        continue;
      }
      const PartCorner mate = mesh.FindOpenMate(corner);
      if (mate.Triangle < 0)
      {
        continue;
      }
      const bool isNew =
        mate.Triangle > t || !std::binary_search(triangles.begin(), triangles.end(), mate.Triangle);
      if (isNew && mesh.IsShared(mesh.Triangles[mate.Triangle].Points[mate.Slot]) &&
        judge.Judge(mesh, corner, mate) == EdgeState::Bad)
      {
        const auto& [one, other] = std::minmax(corner, mate);
        waiting.push_back({ { mesh.GetKeys(mesh.Triangles[t].GetEdge(slot)),
                              mesh.GetKeys({ mesh.Triangles[t].Points[slot],
                                mesh.Triangles[mate.Triangle].Points[mate.Slot] }),
                              false },
          one, other });
      }
    }
  }
  std::sort(waiting.begin(), waiting.end(),
    [](const WaitingFlip& a, const WaitingFlip& b) { return a.Other < b.Other; });
  return waiting;
}

/// The edges that may be made, each with the edge that may flip to make it. That is the first one
/// that asked, among those that can flip now if there are any. All ranks get the same answers.
PairMap<PointPair> GrantFlips(
  const PartMesh& mesh, const std::vector<FlipQuestion>& own, PieceGroup& group)
{
  std::vector<FlipQuestion> all = Join(GatherRecords(group, own));
  std::stable_partition(
    all.begin(), all.end(), [](const FlipQuestion& one) { return !one.IsSeam; });
  std::vector<unsigned char> exists; // the edge that the flip would make
  for (const FlipQuestion& question : all)
  {
    const std::int64_t a = mesh.FindPoint(question.Opposite[0]);
    const std::int64_t b = mesh.FindPoint(question.Opposite[1]);
    exists.push_back(a >= 0 && b >= 0 && mesh.HasEdge(a, b) ? 1 : 0);
  }
  exists = FindMaxima(group, std::move(exists));
  PairMap<PointPair> granted;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (exists[i] == 0)
    {
      granted.emplace(all[i].Opposite, all[i].Ends);
    }
  }
  return granted;
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
    HostVector<std::uint32_t> order(count, Gone); // those of this rank by slot; some have come back
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      const std::int64_t slot = triangles[t].Origin - first;
      const bool isOwn = slot >= 0 && slot < count;
      if (triangles[t].HasLeft)
      {
        continue;
      }
      if (isOwn)
      {
        order[slot] = static_cast<std::uint32_t>(t);
      }
      else
      {
        order.push_back(static_cast<std::uint32_t>(t));
      }
    }
    std::sort(order.begin() + count, order.end(),
      [&](std::uint32_t a, std::uint32_t b) { return triangles[a].Origin < triangles[b].Origin; });

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
    flipped.Triangles.reserve(3 * order.size());
    flipped.FlipCounts.reserve(order.size());
    for (std::int64_t i = 0; i < SizeOf(order); ++i)
    {
      if (order[i] == Gone)
      {
        flipped.GoneTriangles.push_back(i);
        continue;
      }
      const PartTriangle& triangle = triangles[order[i]];
      if (i >= count)
      {
        flipped.ReceivedTriangles.push_back(this->Origins.Find(triangle.Origin));
      }
      flipped.FlipCounts.push_back(triangle.Flips);
      std::transform(
        triangle.Points, triangle.Points + 3, std::back_inserter(flipped.Triangles), storePoint);
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

  /// Finds the edges that need marks. A fixed edge with one triangle is marked only if it has
  /// others on other ranks.
  void BeginRounds()
  {
    MarkedEdges edges = std::move(this->Constraints.Seams.Marks);
    const std::vector<std::int64_t> fixed =
      ListInnerFixedEdges(this->Constraints.Mesh, this->Job.Options, this->Own.Edges);
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
    const bool isAborted = this->StopReason == StopReasonKind::Aborted;
    const bool isAtLimit = this->StopReason == StopReasonKind::IterationLimit;
    const bool isUncounted = this->Own.Triangles > 0 && this->Own.Edges.Edges == 0;
    const std::vector<std::int64_t> own{ isAborted, isAtLimit, isUncounted,
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
    this->Seams = test.Counts;
    WaitedFlips waiting{ test.BadOfAll, {}, {} };
    if (needsGuard && mayGoOn)
    {
      this->Waiting.insert(this->Waiting.end(), changed.begin(), changed.end());
      waiting = this->FlipWaiting(test);
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

  /// Flips waiting edges as far as the guard allows. Other edges can have become bad only where
  /// triangles have changed. Seam edges are removed from `test` if their flip would make an edge
  /// that exists or that another flip makes, or if their triangle has just changed. All ranks must
  /// call this together.
  WaitedFlips FlipWaiting(SeamTest& test)
  {
    std::vector<WaitingFlip> flips;
    DoTogether(this->Job.Group,
      [&]() { flips = FindWaiting(this->Mesh, std::move(this->Waiting), this->Judge); });
    std::vector<FlipQuestion> questions(flips.begin(), flips.end());
    for (const BadSeam& seam : test.Bad)
    {
      questions.push_back({ seam.Ends, seam.Opposite, true });
    }
    const PairMap<PointPair> granted = GrantFlips(this->Mesh, questions, this->Job.Group);
    const auto isGranted = [&](const PointPair& ends, const PointPair& opposite)
    {
      const auto found = granted.find(opposite);
      return found != granted.end() && found->second == ends;
    };
    WaitedFlips waited{ SizeOf(granted), {}, {} };
    std::unordered_set<std::int64_t> changed; // each triangle only once
    this->Waiting.clear();
    for (const WaitingFlip& flip : flips)
    {
      const std::int64_t one = flip.One.Triangle, other = flip.Other.Triangle;
      this->Waiting.insert(this->Waiting.end(), { one, other });
      if (!this->IsAtLimit() && changed.count(one) == 0 && changed.count(other) == 0 &&
        isGranted(flip.Ends, flip.Opposite))
      {
        waited.Gone.push_back(this->Mesh.Triangles[one].GetEdge(flip.One.Slot));
        this->Mesh.Flip(flip.One, flip.Other);
        waited.Changed.insert(waited.Changed.end(), { one, other });
        changed.insert({ one, other });
      }
    }
    // A changed triangle may have lost its bad edge to its neighbour; the next round will tell.
    const auto mustStay = [&](const BadSeam& seam)
    { return changed.count(seam.Triangle) > 0 || !isGranted(seam.Ends, seam.Opposite); };
    test.Bad.erase(std::remove_if(test.Bad.begin(), test.Bad.end(), mustStay), test.Bad.end());
    if (!waited.Gone.empty()) // all at once
    {
      IterationRecord row;
      row.Tested = row.NonDelaunay = row.Flipped = SizeOf(waited.Gone);
      this->KeepRow(row);
    }
    return waited;
  }

  void Flip(RoundFlips& flips)
  {
    const StopWatch watch;
    const double rounds = static_cast<double>(this->Whole.Rounds);
    std::int64_t limit = this->CountRows() + SizeOf(this->Mesh.Triangles) + SafetyMargin;
    if (this->Job.Options.MaximumIterations >= 0)
    {
      limit = this->EarlierRows + this->Job.Options.MaximumIterations - this->Iterations;
    }
    while (!flips.AreDone() && this->StopReason == StopReasonKind::Converged)
    {
      if (!this->Tell(1.0 - (1.0 - FirstShare) / (1.0 + rounds)))
      {
        this->StopReason = StopReasonKind::Aborted;
      }
      else if (this->CountRows() >= limit)
      {
        if (flips.HasBad())
        {
          this->StopReason = StopReasonKind::IterationLimit;
        }
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

  std::int64_t CountRows() const { return SizeOf(this->Own.Iterations); }

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
    KeepAnglesAfter(
      this->Mesh.MeasureAngles(this->Job.Survey, this->Job.Options.NumberOfThreads), this->Own);
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
    if (this->Job.Group.GetSize() == 1)
    {
      this->BeginRounds(); // which finds the mates of corners
    }
    const RoundFlips flips(this->Mesh, this->Judge, this->Job.Survey.NeedsGuard());
    const auto count = SizeOf(this->Mesh.Triangles);
    for (std::int64_t t = 0; t < count; ++t)
    {
      for (int slot = 0; slot < 3 && !this->Mesh.Triangles[t].HasLeft; ++slot)
      {
        const PartCorner mate = this->Mesh.FindOpenMate({ t, slot });
        if (mate.Triangle > t)
        {
          CountState(flips.Judge({ t, slot }, mate), this->Own);
        }
      }
    }
  }

  PiecesReport MakeReport()
  {
    const PointKeys& keys = this->Mesh.GetPointKeys();
    const FlipReport& seams = this->Constraints.Seams.Totals;
    AddCounts(this->Own.Edges, seams.Edges, 1);
    this->Own.NonDelaunayBefore += seams.NonDelaunayAfter;
    if (this->WholeStopReason == StopReasonKind::Converged) // nothing else blocks those left
    {
      this->Seams.BlockedByEdge =
        this->Seams.NonDelaunayAfter - this->Seams.BlockedByShape - this->Seams.BlockedByDeviation;
    }
    AddEdges(this->Own, this->Seams, 1);
    PiecesReport report = this->Whole;
    static_cast<FlipReport&>(report) = JoinReports(this->Own, this->Job.Group);
    CompleteReport(report, keys.UsedPoints, this->IsCounted);
    report.Points = keys.Owners.Firsts.back() - keys.Repeated;
    report.GeometryUsed = this->Job.Survey.Geometry;
    report.GeometryReason = this->Job.Survey.GeometryReason;
    report.StopReason = this->WholeStopReason;
    AddDefect(this->Job.Survey.NearlyHeightField, report.Defects);
    return report;
  }

  PartJob Job;
  RankNumbers Origins; ///< The numbers of the triangles in their input slots.
  PartMesh Mesh;
  QuadJudge Judge;
  SeamTester Tester;
  std::vector<std::int64_t> Waiting; ///< Triangles of edges that are bad and may wait.
  PartConstraints Constraints;

  // These are this rank's:
  FlipReport Own; ///< Starts as the report of the first flips. Has the iterations of all rounds.
  StopReasonKind StopReason = StopReasonKind::Converged;
  std::int64_t EarlierRows = 0; ///< Iterations of this rank in earlier rounds.
  bool HasBlocked = false; ///< Whether a bad edge was seen that may not flip.
  FlipReport Seams; ///< SeamTest::Counts of the last test.

  // These are about all ranks:
  PiecesReport Whole; ///< The members that it inherits from FlipReport are set at the end.
  StopReasonKind WholeStopReason = StopReasonKind::Converged;
  std::int64_t Iterations = 0; ///< Iterations of earlier rounds.
  bool IsCounted = true; ///< Whether no rank was stopped before its edges were counted.
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
