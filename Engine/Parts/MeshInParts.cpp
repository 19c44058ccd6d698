// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInParts.h"

#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "EdgeMeshBuilder.h"
#include "InputChecks.h"
#include "MeshSurveyBuilder.h"
#include "PartMesh.h"
#include "PartReports.h"
#include "SeamSurvey.h"
#include "SmallestAngle.h"
#include "SubMesh.h"
#include "SurfaceAngles.h"

#include <atomic>
#include <mutex>
#include <numeric>

/// @file
/// One mesh of this process. Its parts are flipped one after the other.

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// On surfaces, where nothing proves that flips end, at most this many neighbourhoods are flipped.
constexpr std::int64_t MostNeighbourhoods = 1000;

ConstraintInsertion InsertConstraints(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
{
  CheckOptions(options);
  RefuseRefinement(options, mesh, "a mesh in several pieces");
  if (!mesh.ConstraintsToInsert || !ConstraintInsertion::IsRequested(mesh))
  {
    return {};
  }
  CheckMeshSize(mesh.Triangles.Count, mesh.Points.Count,
    "where constraints are to be inserted; give constraints that are edges of the mesh");
  return ConstraintInsertion(mesh, options,
    [&](double share) { return !progress || progress(ConstraintInsertion::ShareOfRun * share); });
}

/// First each part is flipped by itself. The edges between parts, the seam edges, are treated as
/// boundary edges and do not flip. Then the triangles around the points of seam edges are flipped
/// as one mesh, which is the neighbourhood of these points. If flips reach points at its border,
/// the triangles around these points are the next neighbourhood. The run ends when no flip has
/// reached a border. So every edge is judged after the last flip of a triangle next to it.
class PartsInTurn : public MeshInParts
{
public:
  PartsInTurn(const TriangleMesh& mesh, const FlipOptions& options,
    const ProgressObserver& progress, const MutableTriangleArray& triangles)
    : Threads(options.NumberOfThreads),
      Insertion(InsertConstraints(mesh, options, progress)),
      Options(this->Insertion.GetOptions(options)),
      Mesh(this->Insertion.GetMesh(mesh)),
      Parts(CountPieces(options, mesh.Triangles.Count)),
      Seam(0, Threads),
      Shares(Parts),
      Reports(Parts)
  {
    this->Constraints.assign(this->Mesh.ConstraintEdges,
      this->Mesh.ConstraintEdges + 2 * this->Mesh.NumberOfConstraintEdges);
    CheckConstraints(this->Mesh);
    this->Survey = PartSurvey(
      BuildMeshSurvey(MeshInput{ this->Mesh, this->Mesh }, this->Options.Geometry, this->Threads),
      this->Mesh.Points.Floats != nullptr);
    CheckTieRule(options, this->Survey.Geometry);
    RefuseParts(this->Survey.Geometry);
    std::vector<int> axes; // to cut across: in planar geometry not the one across the plane
    for (int axis = 0; axis < 3; ++axis)
    {
      if (this->Survey.Geometry == GeometryKind::Surface || axis != this->Survey.Projection.AxisW)
      {
        axes.push_back(axis);
      }
    }
    if (this->Survey.Geometry != GeometryKind::Surface)
    {
      const auto group = MakeSingleGroup();
      SurveyStars(this->Mesh, MatchPoints({ this->Mesh, nullptr }, *group, this->Threads),
        this->Threads, *group, this->Survey);
    }
    this->Mesh.Whole = this->Survey.Whole;
    this->PartOf = FindParts(this->Mesh, axes, this->Parts, this->Threads);
    this->TakeArrays(mesh, triangles);
    this->Report.Points = this->Mesh.Points.Count;
    this->Report.Triangles = this->Mesh.Triangles.Count;
    this->Report.GeometryUsed = this->Survey.Geometry;
    this->Report.GeometryReason = this->Survey.GeometryReason;
    this->Report.Tolerance = DescribeTolerance(this->Options, this->Survey.Geometry);
    this->Report.Defects = this->Survey.ListDefects();
    this->Insertion.AddTo(this->Report);
  }

  void ExamineSeams() override
  {
    this->Seam = this->FindSeamPoints();
    this->CountSeams();
  }

  void FlipParts(const ProgressObserver& progress) override
  {
    const double begin = this->Insertion.GetShare();
    this->Progress = [&progress, begin](double share)
    { return !progress || progress(begin + (1.0 - begin) * share); };
    this->FlipEachPart();
    this->JoinParts();
  }

  void FlipSeams() override
  {
    if (this->Report.StopReason == StopReasonKind::Converged)
    {
      this->FlipNeighbourhoods();
    }
  }

  void Complete() override
  {
    this->CountRest();
    this->AddDefects();
    this->Insertion.AddTo(this->Report);
    if (!this->FlipCounts.empty())
    {
      this->Insertion.AddFlipCounts(this->FlipCounts.data());
    }
    // Frees what is not needed any more.
    this->Insertion = ConstraintInsertion();
    this->PartOf = Array<unsigned char>();
    this->Fixed = std::vector<std::int64_t>();
  }

private:
  /// Copies the triangles to where flips change them.
  /// @param given or empty.
  void TakeArrays(const TriangleMesh& mesh, const MutableTriangleArray& given)
  {
    const std::int64_t count = mesh.Triangles.Count;
    this->Triangles = given;
    if (!given.Data())
    {
      this->FlipCounts.resize(count);
      this->MakeIds(mesh.Triangles.Ids32 != nullptr, count);
    }
    CopyTriangles(this->Mesh.Triangles, this->Triangles, this->Threads);
    this->Mesh.Triangles = AsConst(this->Triangles);
  }

  /// Makes an array for triangles.
  void MakeIds(bool have32Bits, std::int64_t count)
  {
    if (have32Bits)
    {
      this->Ids32 = this->Threads.MakeArray<std::int32_t>(3 * count);
      this->Triangles = MutableTriangleArray(this->Ids32.Data(), count);
      return;
    }
    this->Ids64 = this->Threads.MakeArray<std::int64_t>(3 * count);
    this->Triangles = MutableTriangleArray(this->Ids64.Data(), count);
  }

  SubMesh GetPart(int number) const
  {
    const auto isIn = [&](std::int64_t t) { return this->PartOf[t] == number; };
    return SubMesh(
      this->Mesh, ListNumbers(this->Mesh.Triangles.Count, isIn, this->Threads), this->Threads);
  }

  /// The triangles of a sub-mesh that belong to one part.
  SubMesh GetPartOf(const SubMesh& mesh, int number) const
  {
    const auto isIn = [&](std::int64_t t) { return this->PartOf[mesh.GetSlot(t)] == number; };
    std::vector<std::int64_t> slots = ListNumbers(mesh.GetNumberOfTriangles(), isIn, this->Threads);
    this->Threads.ForEach(
      SizeOf(slots), [&](std::int64_t i) { slots[i] = mesh.GetSlot(slots[i]); });
    return SubMesh(this->Mesh, std::move(slots), this->Threads);
  }

  /// The points that triangles of several parts share at the moment.
  PointSet FindSeamPoints() const
  {
    const TriangleArray& triangles = this->Mesh.Triangles;
    PointSet seam(this->Mesh.Points.Count, this->Threads);
    Array<unsigned char> partOfPoint =
      this->Threads.MakeArray<unsigned char>(this->Mesh.Points.Count);
    // Whichever of its parts a point keeps, it differs from another one of them.
    ForEachCorner(triangles.Count, this->Threads,
      [&](std::int64_t t, int slot)
      { AtomicStore(partOfPoint.Data() + triangles.Get(t, slot), this->PartOf[t]); });
    ForEachCorner(triangles.Count, this->Threads,
      [&](std::int64_t t, int slot)
      {
        const std::int64_t point = triangles.Get(t, slot);
        if (partOfPoint[point] != this->PartOf[t])
        {
          seam.Add(point);
        }
      });
    return seam;
  }

  /// The triangles that have one of these points.
  SubMesh GetTrianglesAt(const PointSet& points) const
  {
    const TriangleArray& triangles = this->Mesh.Triangles;
    const auto isIn = [&](std::int64_t t) { return points.Touches(triangles, t); };
    return SubMesh(this->Mesh, ListNumbers(triangles.Count, isIn, this->Threads), this->Threads);
  }

  //------------------------------------------------------------------------------
  /// The options for parts of the mesh in which no edge is flipped.
  FlipOptions GetCountingOptions() const
  {
    FlipOptions options = GetPartOptions(this->Survey, this->Options);
    options.MaximumIterations = 0;
    if (!this->Options.Devices.empty())
    {
      options.Device = this->Options.Devices.front();
      options.Devices.clear();
    }
    return options;
  }

  /// Before the first flip: counts seam edges, finds the fixed ones, and missing constraints.
  void CountSeams()
  {
    FlipOptions options = this->GetCountingOptions();
    options.FeatureAngle = this->Options.FeatureAngle;
    const auto count = [&](const SubMesh& part, std::int64_t factor)
    {
      const FlipSession session(part.View(), options);
      AddEdges(this->Seams, session.GetReport(), factor);
      return session.GetReport().Edges;
    };
    SubMesh strip = this->GetTrianglesAt(this->Seam);
    strip.FixEdges(this->Constraints);
    this->KeepFixedEdges(strip, options, count(strip, 1));
    this->FixedAtSeams = this->Fixed;
    for (int number = 0; number < this->Parts; ++number)
    {
      SubMesh part = this->GetPartOf(strip, number);
      part.FixEdges(this->Constraints);
      part.FixEdges(this->FixedAtSeams);
      count(part, -1);
    }
    TriangleMesh mesh = this->Mesh;
    const std::vector<unsigned char> all(mesh.NumberOfConstraintEdges, 1);
    mesh.ConstraintsToInsert = all.data();
    const MissingConstraints missing = FindMissingConstraints(mesh, this->Threads);
    this->Unmatched = std::count(missing.IsMissing.begin(), missing.IsMissing.end(), true);
  }

  /// Keeps the edges of a part that stay.
  /// @param edges of that part.
  void KeepFixedEdges(const SubMesh& part, const FlipOptions& options, const EdgeCounts& edges)
  {
    const std::vector<std::int64_t> ends = ListInnerFixedEdges(part.View(), options, edges);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const std::int64_t end : ends)
    {
      this->Fixed.push_back(part.GetPointId(end));
    }
  }

  //------------------------------------------------------------------------------
  void FlipEachPart()
  {
    // One worker prepares a part while another's is on the GPU.
    const int devices = static_cast<int>(this->Options.Devices.size());
    const int workers = std::max(1, std::min(this->Parts, 2 * devices));
    std::vector<int> turns;
    for (int worker = 0; worker < workers && devices > 0; ++worker)
    {
      turns.push_back(worker % devices);
    }
    const auto work = [&](PieceGroup& group)
    {
      try
      {
        for (int part = group.GetRank(); part < this->Parts; part += workers)
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

  /// Runs in one of several threads. Rank 0 is the calling thread; it asks the observer.
  void FlipPart(int number, PieceGroup& group)
  {
    SubMesh part = this->GetPart(number);
    part.FixEdges(this->Constraints);
    part.FixEdges(this->FixedAtSeams);
    if (this->Survey.NeedsGuard())
    {
      part.GuardPoints([this](std::int64_t point) { return this->Seam.Has(point); });
    }
    FlipOptions options = GetPartOptions(this->Survey, this->Options);
    options.FeatureAngle = this->Options.FeatureAngle;
    options.Backend = this->Options.Backend;
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
        this->GoesOn = this->Progress(PartsShare * sum / this->Parts) && this->GoesOn;
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
      this->TakeTriangles(session, part);
    };
    group.Work(flip);
    part.Store(this->Triangles);
  }

  /// Takes the triangles of a part from its session. Parts that are flipped at the same time have
  /// none in common.
  /// @returns how many flips each has made.
  Array<std::int32_t> TakeTriangles(const FlipSession& session, SubMesh& part)
  {
    session.StoreTriangles(part.GetTriangles());
    const std::int64_t count = part.GetNumberOfTriangles();
    Array<std::int32_t> flips = this->Threads.MakeArray<std::int32_t>(count);
    session.StoreFlipCounts(flips.Data());
    if (!this->FlipCounts.empty())
    {
      this->Threads.ForEach(
        count, [&](std::int64_t t) { this->FlipCounts[part.GetSlot(t)] += flips[t]; });
    }
    return flips;
  }

  /// Begins the report of the whole mesh.
  void JoinParts()
  {
    static_cast<FlipReport&>(this->Report) = JoinReports(this->Reports);
    this->Report.UnmatchedConstraints = this->Unmatched;
    this->Report.SeamEdges = -this->Seams.Edges.Edges;
    this->Report.Points = this->Mesh.Points.Count;
    this->Report.GeometryUsed = this->Survey.Geometry;
    this->Report.GeometryReason = this->Survey.GeometryReason;
    this->Report.Rounds = 1;
    this->Report.StopReason = StopReasonKind::Converged;
    // The largest sum of the seconds of the parts on one GPU.
    const std::size_t devices = std::max<std::size_t>(1, this->Options.Devices.size());
    std::vector<double> build(devices), flip(devices);
    for (std::size_t number = 0; number < this->Reports.size(); ++number)
    {
      const FlipReport& part = this->Reports[number];
      build[number % devices] += part.BuildSeconds;
      flip[number % devices] += part.FlipSeconds;
      this->Report.StopReason = std::max(this->Report.StopReason, part.StopReason); // the worst
      this->HasBadEdges = this->HasBadEdges || part.NonDelaunayAfter > 0;
    }
    this->Report.BuildSeconds = *std::max_element(build.begin(), build.end());
    this->Report.FlipSeconds = *std::max_element(flip.begin(), flip.end());
  }

  //------------------------------------------------------------------------------
  void FlipNeighbourhoods()
  {
    PointSet active = std::move(this->Seam);
    active.Number(this->Threads);
    for (std::int64_t number = 1;
         active.GetSize() > 0 && this->Report.StopReason == StopReasonKind::Converged; ++number)
    {
      if (number > MostNeighbourhoods && this->Survey.Geometry == GeometryKind::Surface)
      {
        this->Report.StopReason = StopReasonKind::IterationLimit;
        return;
      }
      const double share = PartsShare + (1.0 - PartsShare) * (1.0 - 1.0 / double(number));
      active = this->FlipNeighbourhood(active,
        [&](double part)
        { return !this->Progress || this->Progress(share + part * (1.0 - share) / 2.0); });
    }
  }

  /// Flips the triangles around some points, as one mesh.
  /// @returns the points around which edges must be judged next: those at the border of the
  /// neighbourhood that flips have reached. A flip that would join two points at the border waits,
  /// because they may have an edge elsewhere. A triangle beside it has changed, or the edge would
  /// not be bad. So one of the two points is reached.
  PointSet FlipNeighbourhood(const PointSet& active, const ProgressObserver& progress)
  {
    const TriangleArray& triangles = this->Mesh.Triangles;
    PointSet inner(this->Mesh.Points.Count, this->Threads); // points inside of the neighbourhood
    ForEachCorner(triangles.Count, this->Threads,
      [&](std::int64_t t, int slot)
      {
        if (active.Touches(triangles, t))
        {
          inner.Add(triangles.Get(t, slot));
        }
      });
    SubMesh around = this->GetTrianglesAt(inner);
    around.FixEdges(this->Fixed);
    if (this->Survey.NeedsGuard())
    {
      around.GuardPoints([&](std::int64_t point) { return !inner.Has(point); });
    }
    FlipOptions options = this->GetCountingOptions();
    options.MaximumIterations = this->Options.MaximumIterations;
    if (options.MaximumIterations >= 0)
    {
      const std::int64_t left = options.MaximumIterations - SizeOf(this->Report.Iterations);
      options.MaximumIterations = std::max<std::int64_t>(0, left);
    }
    FlipSession session(around.View(false), options, progress);
    if (session.GetReport().StopReason != StopReasonKind::Aborted)
    {
      session.Advance(-1, {}, progress);
    }

    const FlipReport& report = session.GetReport();
    for (IterationRecord row : report.Iterations)
    {
      row.Iteration = SizeOf(this->Report.Iterations) + 1;
      row.MinimumAngle = NaN;
      this->Report.Iterations.push_back(row);
    }
    if (report.TotalFlips > 0)
    {
      ++this->Report.Rounds;
    }
    this->Report.StopReason = report.StopReason;
    this->Report.BuildSeconds += report.BuildSeconds;
    this->Report.FlipSeconds += report.FlipSeconds;
    this->HasBadEdges = this->HasBadEdges || report.NonDelaunayAfter > 0;

    const Array<std::int32_t> flips = this->TakeTriangles(session, around);
    around.Store(this->Triangles);
    PointSet next(this->Mesh.Points.Count, this->Threads);
    for (std::int64_t t = 0; t < around.GetNumberOfTriangles(); ++t)
    {
      for (int slot = 0; slot < 3 && flips[t] > 0; ++slot)
      {
        const std::int64_t point = around.GetPoint(t, slot);
        if (!inner.Has(point))
        {
          next.Add(point);
        }
      }
    }
    next.Number(this->Threads);
    return next;
  }

  //------------------------------------------------------------------------------
  void CountRest()
  {
    PiecesReport& report = this->Report;
    AddCounts(report.Edges, this->Seams.Edges, 1);
    if (this->AreCounted)
    {
      report.NonDelaunayBefore += this->Seams.NonDelaunayAfter;
    }
    if (report.Rounds > 1)
    {
      const TriangleMesh& mesh = this->Mesh;
      const AngleSums angles = MeasureAngles(mesh.Triangles.Count, this->Survey, this->Threads,
        [&](std::int64_t t, double(&x)[3][3])
        {
          for (int i = 0; i < 9; ++i)
          {
            x[i / 3][i % 3] = mesh.Points.Get(mesh.Triangles.Get(t, i / 3), i % 3);
          }
          return true;
        });
      KeepAnglesAfter(angles, report);
    }
    if (this->HasBadEdges && report.StopReason != StopReasonKind::Aborted)
    {
      this->CountBadEdges();
    }
    CompleteReport(report, this->Survey.UsedPoints, this->AreCounted);
  }

  /// Counts those that are left, whatever the reason.
  void CountBadEdges()
  {
    const FlipOptions options = this->GetCountingOptions();
    FlipReport totals;
    const auto count = [&](SubMesh& part, std::int64_t factor)
    {
      part.FixEdges(this->Fixed);
      const FlipSession session(part.View(false), options);
      AddEdges(totals, session.GetReport(), factor);
    };
    SubMesh strip = this->GetTrianglesAt(this->FindSeamPoints());
    count(strip, 1);
    for (int number = 0; number < this->Parts; ++number)
    {
      SubMesh whole = this->GetPart(number);
      SubMesh atSeams = this->GetPartOf(strip, number);
      count(whole, 1);
      count(atSeams, -1);
    }
    this->Report.NonDelaunayAfter = totals.NonDelaunayAfter;
    this->Report.BlockedByShape = totals.BlockedByShape;
    this->Report.BlockedByDeviation = totals.BlockedByDeviation;
    this->Report.BlockedByEdge = totals.BlockedByEdge;
    if (this->Report.Converged())
    {
      // A part does not know all edges that exist. After the last flip nothing else blocks any.
      this->Report.BlockedByEdge =
        totals.NonDelaunayAfter - totals.BlockedByShape - totals.BlockedByDeviation;
    }
  }

  /// What is known of the whole mesh takes the place of what parts have found.
  void AddDefects()
  {
    std::vector<Defect> defects = this->Survey.ListDefects();
    const Defect unmatched(DefectKind::ConstraintsNotEdges, this->Report.UnmatchedConstraints);
    AddDefect(unmatched, defects);
    for (const Defect& defect : this->Report.Defects)
    {
      const bool isKnown = defect.IsLike(unmatched) ||
        std::any_of(defects.begin(), defects.end(),
          [&](const Defect& known) { return known.IsLike(defect); });
      if (!isKnown)
      {
        defects.push_back(defect);
      }
    }
    this->Report.Defects = defects;
  }

  ThreadBackend Threads;
  ConstraintInsertion Insertion;
  FlipOptions Options; ///< With the geometry that was chosen before the insertion.
  TriangleMesh Mesh; ///< With the triangles as they are at the moment.
  int Parts;
  PartSurvey Survey;
  Array<unsigned char> PartOf; ///< By triangle slot.
  Array<std::int32_t> Ids32; ///< Three per triangle, if the caller's ids have 32 bits.
  Array<std::int64_t> Ids64; ///< If they have 64 bits.
  ProgressObserver Progress;

  std::vector<std::int64_t> Constraints; ///< Edges that the caller fixes: two ids for each.
  PointSet Seam; ///< The points of seam edges before the first flip.
  std::int64_t Unmatched = 0; ///< Constraints that are not edges of the mesh.
  FlipReport Seams; ///< To be added to the sums of the parts' reports (AddEdges).
  std::vector<std::int64_t> FixedAtSeams; ///< The ends of all edges there that stay.

  std::vector<std::atomic<double>> Shares; ///< How much of the work for each part is done.
  std::atomic<bool> GoesOn{ true };
  std::atomic<bool> AreCounted{ true }; ///< Whether no part was stopped before its edges were.
  std::mutex Mutex; ///< Guards what follows while parts are flipped.
  std::vector<std::int64_t> Fixed; ///< All edges that stay, but boundary edges: two ids for each.
  std::vector<FlipReport> Reports; ///< One per part.
  bool HasBadEdges = false; ///< Whether a session has left some.
};
}

std::unique_ptr<MeshInParts> CutIntoParts(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const MutableTriangleArray& triangles)
{
  return std::make_unique<PartsInTurn>(mesh, options, progress, triangles);
}

}
