// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "MeshInParts.h"
#include "PartMesh.h"
#include "PieceFlip.h"
#include "Records.h"
#include "SeamSurvey.h"
#include "SmallestAngle.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

/// @file
/// FlipInTurn: one mesh of this process, whose parts are flipped one after the other.

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// About the share of the time that passes before the first region.
constexpr double PartsShare = 0.9;

/// On surfaces, where nothing proves that flips end, so many regions are flipped at most.
constexpr std::int64_t MostRegions = 1000;

/// Counts of the edges of a mesh.
///
/// The sum over all parts counts seam edges wrongly: each is a boundary edge of several parts. To
/// correct the sum, add the counts of the triangles at seams, taken as one mesh, and subtract the
/// counts of the same triangles, taken part by part. Then edges inside a part cancel out, and a
/// seam edge is counted once.
struct EdgeTotals
{
  EdgeCounts Edges;
  std::int64_t NonDelaunay = 0, BlockedByShape = 0, BlockedByDeviation = 0, BlockedByEdge = 0;

  /// @param report of a run without iterations.
  /// @param factor 1 to add, -1 to subtract.
  void Add(const FlipReport& report, std::int64_t factor)
  {
    AddCounts(this->Edges, report.Edges, factor);
    this->NonDelaunay += factor * report.NonDelaunayAfter;
    this->BlockedByShape += factor * report.BlockedByShape;
    this->BlockedByDeviation += factor * report.BlockedByDeviation;
    this->BlockedByEdge += factor * report.BlockedByEdge;
  }
};

/// First each part is flipped by itself. The edges between parts, the seam edges, are treated as
/// boundary edges and do not flip. Then the triangles around the points of seam edges, a region,
/// are flipped as one mesh. If flips reach points at the border of the region, the triangles around
/// these points are the next region. The run ends when no flip has reached a border. So every edge
/// is judged after the last flip of a triangle next to it.
class DividedRun
{
public:
  DividedRun(MeshInParts& mesh, std::int32_t* flipCounts, const ProgressObserver& progress)
    : Mesh(mesh),
      Options(mesh.GetOptions()),
      FlipCounts(flipCounts),
      Progress(progress),
      Constraints(mesh.View().ConstraintEdges,
        mesh.View().ConstraintEdges + 2 * mesh.View().NumberOfConstraintEdges),
      Seam(mesh.FindSeamPoints()),
      Shares(mesh.GetNumberOfParts()),
      Reports(mesh.GetNumberOfParts())
  {
  }

  PiecesReport Run()
  {
    if (this->FlipCounts)
    {
      this->Mesh.GetThreads().ForEach(
        this->Mesh.View().Triangles.Count, [this](std::int64_t t) { this->FlipCounts[t] = 0; });
    }
    this->ExamineSeams();
    this->FlipParts();
    this->JoinParts();
    if (this->Report.StopReason == StopReasonKind::Converged)
    {
      this->FlipRegions();
    }
    this->CountRest();
    this->AddDefects();
    return this->Report;
  }

private:
  //------------------------------------------------------------------------------
  /// The options for parts of the mesh in which no edge is flipped.
  FlipOptions GetCountingOptions() const
  {
    FlipOptions options = GetPartOptions(this->Mesh.GetSurvey(), this->Options);
    options.MaximumIterations = 0;
    if (!this->Options.Devices.empty())
    {
      options.Device = this->Options.Devices.front();
      options.Devices.clear();
    }
    return options;
  }

  /// Before the first flip: counts seam edges, finds the fixed ones, and missing constraints.
  void ExamineSeams()
  {
    FlipOptions options = this->GetCountingOptions();
    options.FeatureAngle = this->Options.FeatureAngle;
    const auto count = [&](const SubMesh& part, std::int64_t factor)
    {
      const FlipSession session(part.View(), options);
      this->Seams.Add(session.GetReport(), factor);
      return session.GetReport().Edges;
    };
    SubMesh strip = this->Mesh.GetTrianglesAt(this->Seam);
    strip.FixEdges(this->Constraints);
    this->KeepFixedEdges(strip, options, count(strip, 1));
    this->FixedAtSeams = this->Fixed;
    for (int number = 0; number < this->Mesh.GetNumberOfParts(); ++number)
    {
      SubMesh part = this->Mesh.GetPartOf(strip, number);
      part.FixEdges(this->Constraints);
      part.FixEdges(this->FixedAtSeams);
      count(part, -1);
    }
    TriangleMesh mesh = this->Mesh.View();
    const std::vector<unsigned char> all(mesh.NumberOfConstraintEdges, 1);
    mesh.ConstraintsToInsert = all.data();
    const MissingConstraints missing = FindMissingConstraints(mesh, this->Mesh.GetThreads());
    this->Unmatched = std::count(missing.IsMissing.begin(), missing.IsMissing.end(), true);
  }

  /// Keeps the edges of a part that stay.
  /// @param edges of that part.
  void KeepFixedEdges(const SubMesh& part, const FlipOptions& options, const EdgeCounts& edges)
  {
    const std::vector<std::int64_t> ends = ListFixedEdges(part.View(), options, edges);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const std::int64_t end : ends)
    {
      this->Fixed.push_back(part.GetPointId(end));
    }
  }

  //------------------------------------------------------------------------------
  void FlipParts()
  {
    // One worker prepares a part while another's is on the GPU.
    const int devices = static_cast<int>(this->Options.Devices.size());
    const int workers = devices == 0 ? 1 : std::min(this->Mesh.GetNumberOfParts(), 2 * devices);
    std::vector<int> turns;
    for (int worker = 0; worker < workers && devices > 0; ++worker)
    {
      turns.push_back(worker % devices);
    }
    const auto work = [&](PieceGroup& group)
    {
      try
      {
        for (int part = group.GetRank(); part < this->Mesh.GetNumberOfParts(); part += workers)
        {
          this->FlipPart(part, group);
        }
      }
      catch (...)
      {
        this->GoesOn = false;
        throw;
      }
    };
    RunInThreads(workers, work, turns);
  }

  /// In one of several threads. Rank 0 is the calling thread, whose observer is asked.
  void FlipPart(int number, PieceGroup& group)
  {
    SubMesh part = this->Mesh.GetPart(number);
    part.FixEdges(this->Constraints);
    part.FixEdges(this->FixedAtSeams);
    if (this->Mesh.GetSurvey().NeedsGuard())
    {
      part.GuardPoints([this](std::int64_t point) { return this->Seam.Has(point); });
    }
    FlipOptions options = this->Options;
    options.NumberOfPieces = 1;
    options.TrackQuality = false;
    options.Geometry = this->Mesh.GetSurvey().Geometry;
    if (!this->Options.Devices.empty())
    {
      options.Device = this->Options.Devices[number % this->Options.Devices.size()];
      options.Devices.clear();
    }
    const bool isCaller = group.GetRank() == 0;
    const ProgressObserver progress = [&](double share)
    {
      this->Shares[number] = share;
      if (isCaller && this->Progress)
      {
        const double sum = std::accumulate(this->Shares.begin(), this->Shares.end(), 0.0);
        this->GoesOn =
          this->Progress(PartsShare * sum / this->Mesh.GetNumberOfParts()) && this->GoesOn;
      }
      return this->GoesOn.load();
    };
    const auto flip = [&]()
    {
      FlipSession session(part.View(), options, progress);
      if (session.GetReport().StopReason != StopReasonKind::Aborted)
      {
        this->KeepFixedEdges(part, options, session.GetReport().Edges);
        session.Advance(-1, {}, progress);
      }
      else
      {
        this->AreCounted = false;
      }
      this->Reports[number] = session.GetReport();
      session.StoreTriangles(part.GetTriangles());
      if (this->FlipCounts)
      {
        Array<std::int32_t> counts =
          this->Mesh.GetThreads().MakeArray<std::int32_t>(part.GetNumberOfTriangles());
        session.StoreFlipCounts(counts.Data());
        this->KeepFlips(part, counts.Data());
      }
    };
    group.Work(flip);
    part.Store(this->Mesh.GetTriangles());
  }

  /// Adds the flips of a part's triangles. Parts that are flipped at the same time have no triangle
  /// in common.
  void KeepFlips(const SubMesh& part, const std::int32_t* counts)
  {
    if (this->FlipCounts)
    {
      this->Mesh.GetThreads().ForEach(part.GetNumberOfTriangles(),
        [&](std::int64_t t) { this->FlipCounts[part.GetSlot(t)] += counts[t]; });
    }
  }

  /// Begins the report of the whole mesh.
  void JoinParts()
  {
    static_cast<FlipReport&>(this->Report) = JoinReports(this->Reports);
    this->Report.UnmatchedConstraints = this->Unmatched;
    this->Report.SeamEdges = -this->Seams.Edges.Edges;
    this->Report.Points = this->Mesh.View().Points.Count;
    this->Report.GeometryUsed = this->Mesh.GetSurvey().Geometry;
    this->Report.GeometryReason = this->Mesh.GetSurvey().GeometryReason;
    this->Report.Rounds = 1;
    this->Report.StopReason = StopReasonKind::Converged;
    // The seconds of all parts that have the same GPU; of several GPUs the largest.
    const std::size_t devices = std::max<std::size_t>(1, this->Options.Devices.size());
    std::vector<double> build(devices), flip(devices);
    for (std::size_t number = 0; number < this->Reports.size(); ++number)
    {
      const FlipReport& part = this->Reports[number];
      build[number % devices] += part.BuildSeconds;
      flip[number % devices] += part.FlipSeconds;
      const bool isWorse = part.StopReason == StopReasonKind::Aborted ||
        (part.StopReason == StopReasonKind::IterationLimit && this->Report.Converged());
      this->Report.StopReason = isWorse ? part.StopReason : this->Report.StopReason;
      this->HasBadEdges = this->HasBadEdges || part.NonDelaunayAfter > 0;
    }
    this->Report.BuildSeconds = *std::max_element(build.begin(), build.end());
    this->Report.FlipSeconds = *std::max_element(flip.begin(), flip.end());
  }

  //------------------------------------------------------------------------------
  void FlipRegions()
  {
    PointSet active = std::move(this->Seam);
    active.Number(this->Mesh.GetThreads());
    for (std::int64_t regions = 1;
         active.GetSize() > 0 && this->Report.StopReason == StopReasonKind::Converged; ++regions)
    {
      if (regions > MostRegions && this->Mesh.GetSurvey().Geometry == GeometryKind::Surface)
      {
        this->Report.StopReason = StopReasonKind::IterationLimit;
        return;
      }
      const double share = PartsShare + (1.0 - PartsShare) * (1.0 - 1.0 / double(regions));
      active = this->FlipRegion(active,
        [&](double part)
        { return !this->Progress || this->Progress(share + part * (1.0 - share) / 2.0); });
    }
  }

  /// Flips the triangles around some points, as one mesh.
  /// @returns the points around which edges must be judged next: those at the border of the region
  /// that flips have reached. A flip that would join two points at the border, which may have an
  /// edge elsewhere, waits; a triangle beside it has changed, or the edge would not be bad, so one
  /// of the two is reached.
  PointSet FlipRegion(const PointSet& active, const ProgressObserver& progress)
  {
    const ThreadBackend& threads = this->Mesh.GetThreads();
    const PointSet inner =
      this->Mesh.FindPointsAround(active); // all of whose triangles belong to it
    SubMesh region = this->Mesh.GetTrianglesAt(inner);
    region.FixEdges(this->Fixed);
    if (this->Mesh.GetSurvey().NeedsGuard())
    {
      region.GuardPoints([&](std::int64_t point) { return !inner.Has(point); });
    }
    FlipOptions options = this->GetCountingOptions();
    const auto made = static_cast<std::int64_t>(this->Report.Iterations.size());
    options.MaximumIterations = this->Options.MaximumIterations < 0
      ? -1
      : std::max<std::int64_t>(0, this->Options.MaximumIterations - made);
    FlipSession session(region.View(false), options, progress);
    if (session.GetReport().StopReason != StopReasonKind::Aborted)
    {
      session.Advance(-1, {}, progress);
    }

    const FlipReport& report = session.GetReport();
    for (IterationRecord row : report.Iterations)
    {
      row.Iteration = static_cast<std::int64_t>(this->Report.Iterations.size()) + 1;
      row.MinimumAngle = NaN;
      this->Report.Iterations.push_back(row);
    }
    this->Report.Rounds += report.TotalFlips > 0 ? 1 : 0;
    this->Report.StopReason = report.StopReason;
    this->Report.BuildSeconds += report.BuildSeconds;
    this->Report.FlipSeconds += report.FlipSeconds;
    this->HasBadEdges = this->HasBadEdges || report.NonDelaunayAfter > 0;

    std::vector<std::int32_t> flips(region.GetNumberOfTriangles());
    session.StoreFlipCounts(flips.data());
    this->KeepFlips(region, flips.data());
    session.StoreTriangles(region.GetTriangles());
    region.Store(this->Mesh.GetTriangles());
    PointSet next(this->Mesh.View().Points.Count, threads);
    for (std::int64_t t = 0; t < region.GetNumberOfTriangles(); ++t)
    {
      for (int slot = 0; slot < 3 && flips[t] > 0; ++slot)
      {
        const std::int64_t point = region.GetPoint(t, slot);
        if (!inner.Has(point))
        {
          next.Add(point);
        }
      }
    }
    next.Number(threads);
    return next;
  }

  //------------------------------------------------------------------------------
  void CountRest()
  {
    PiecesReport& report = this->Report;
    AddCounts(report.Edges, this->Seams.Edges, 1);
    report.EulerCharacteristic =
      this->Mesh.GetSurvey().UsedPoints - report.Edges.Edges + report.Triangles;
    report.NonDelaunayBefore += this->Seams.NonDelaunay;
    if (!this->AreCounted)
    {
      report.Edges = EdgeCounts();
      report.EulerCharacteristic = 0;
      report.NonDelaunayBefore -= this->Seams.NonDelaunay;
    }
    if (report.Rounds > 1)
    {
      const TriangleMesh& mesh = this->Mesh.View();
      report.MinimumAngleAfter = ToDegrees(
        FindLargestCotangent(mesh.Triangles.Count, this->Mesh.GetSurvey(), this->Mesh.GetThreads(),
          [&](std::int64_t t, double(&x)[3][3])
          {
            for (int i = 0; i < 9; ++i)
            {
              x[i / 3][i % 3] = mesh.Points.Get(mesh.Triangles.Get(t, i / 3), i % 3);
            }
            return true;
          }));
    }
    if (this->HasBadEdges && report.StopReason != StopReasonKind::Aborted)
    {
      this->CountBadEdges();
    }
    if (!report.Iterations.empty())
    {
      report.Iterations.back().MinimumAngle = report.MinimumAngleAfter;
    }
    CountIterations(report);
  }

  /// Counts those that are left, whatever the reason.
  void CountBadEdges()
  {
    const FlipOptions options = this->GetCountingOptions();
    EdgeTotals totals;
    const auto count = [&](SubMesh& part, std::int64_t factor)
    {
      part.FixEdges(this->Fixed);
      const FlipSession session(part.View(false), options);
      totals.Add(session.GetReport(), factor);
    };
    SubMesh strip = this->Mesh.GetTrianglesAt(this->Mesh.FindSeamPoints());
    count(strip, 1);
    for (int number = 0; number < this->Mesh.GetNumberOfParts(); ++number)
    {
      SubMesh whole = this->Mesh.GetPart(number);
      SubMesh atSeams = this->Mesh.GetPartOf(strip, number);
      count(whole, 1);
      count(atSeams, -1);
    }
    this->Report.NonDelaunayAfter = totals.NonDelaunay;
    this->Report.BlockedByShape = totals.BlockedByShape;
    this->Report.BlockedByDeviation = totals.BlockedByDeviation;
    // A part does not know all edges that exist. After the last flip nothing else blocks any.
    this->Report.BlockedByEdge = this->Report.Converged()
      ? totals.NonDelaunay - totals.BlockedByShape - totals.BlockedByDeviation
      : totals.BlockedByEdge;
  }

  /// What is known of the whole mesh takes the place of what parts have found.
  void AddDefects()
  {
    std::vector<Defect> defects = this->Mesh.GetSurvey().ListDefects();
    AddDefect({ "constraint edges that are not edges of the mesh",
                this->Report.UnmatchedConstraints, {}, DefectIds::Points },
      defects);
    for (const Defect& defect : this->Report.Defects)
    {
      const bool isKnown = std::any_of(defects.begin(), defects.end(),
        [&](const Defect& known) { return known.What == defect.What; });
      if (!isKnown)
      {
        defects.push_back(defect);
      }
    }
    this->Report.Defects = defects;
  }

  MeshInParts& Mesh;
  const FlipOptions& Options;
  std::int32_t* const FlipCounts; ///< Of the mesh; or null.
  const ProgressObserver& Progress;

  std::vector<std::int64_t> Constraints; ///< Edges that the caller fixes: two ids for each.
  PointSet Seam; ///< The points of seam edges before the first flip.
  std::int64_t Unmatched = 0; ///< Constraints that are not edges of the mesh.
  EdgeTotals Seams; ///< To be added to the sums of the parts' reports (EdgeTotals).
  std::vector<std::int64_t> FixedAtSeams; ///< The same for all edges there that stay.

  std::vector<std::atomic<double>> Shares; ///< Of the work for each part that is done.
  std::atomic<bool> GoesOn{ true };
  std::atomic<bool> AreCounted{ true }; ///< Whether no part was stopped before its edges were.
  std::mutex Mutex; ///< Of what follows, while parts are flipped.
  std::vector<std::int64_t> Fixed; ///< All edges that stay, but boundary edges: two ids for each.
  std::vector<FlipReport> Reports; ///< Of the parts.

  PiecesReport Report; ///< Of the whole mesh.
  bool HasBadEdges = false; ///< Whether a session has left some.
};
}

PiecesReport FlipInTurn(
  MeshInParts& mesh, std::int32_t* flipCounts, const ProgressObserver& progress)
{
  const ConstraintInsertion& insertion = mesh.GetInsertion();
  const double begin = insertion.GetShare();
  const ProgressObserver rest = [&](double share)
  { return !progress || progress(begin + (1.0 - begin) * share); };
  PiecesReport report = DividedRun(mesh, flipCounts, rest).Run();
  insertion.AddTo(report);
  if (flipCounts)
  {
    insertion.AddFlipCounts(flipCounts);
  }
  return report;
}

PiecesReport FlipInPieces(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const ProgressObserver& progress)
{
  std::optional<MeshInParts> parts;
  try
  {
    parts.emplace(mesh, triangles, options, progress);
  }
  catch (const RunAborted&)
  {
    return StopBeforeFlips(mesh, triangles, ThreadBackend(options.NumberOfThreads));
  }
  return FlipInTurn(*parts, nullptr, progress);
}

}
