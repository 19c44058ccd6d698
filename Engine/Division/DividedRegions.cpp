// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedRun.h"

#include "AngleSurvey.h"
#include "CotangentAngle.h"
#include "DelaunayFlip.h"
#include "JoinReports.h"
#include "PieceQuality.h"
#include "QuadSoup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

/// @file
/// A run in pieces after the pieces are flipped: the regions, and the report.

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// On surfaces, where nothing proves that flips end, so many regions are flipped at most.
constexpr std::int64_t MostRegions = 1000;

/// The smallest angle in degrees of the triangles for which counts(slot); NaN without any.
template <typename Counts>
double FindSmallestAngle(const MeshInPieces& mesh, const Counts& counts)
{
  const TriangleArray& triangles = mesh.View().Triangles;
  const LargestValue largest = mesh.GetThreads().Sum<LargestValue>(triangles.Count,
    [&](std::int64_t t, LargestValue& sum)
    {
      double x[3][3];
      for (int i = 0; i < 9; ++i)
      {
        x[i / 3][i % 3] = mesh.View().Points.Get(triangles.Get(t, i / 3), i % 3);
      }
      LargestValue one;
      one.Value = counts(t) ? MeasureCotangent(x, mesh.GetSurvey()) : -INFINITY;
      sum += one;
    });
  return ToDegrees(largest.Value);
}

/// Adds the points at the border of a region that flips have reached. A flip that would join two
/// points at the border, which may have an edge elsewhere, waits; a triangle beside it has changed,
/// or the edge would not be bad, so one of the two is reached.
/// @param inner the points all of whose triangles belong to it.
/// @param flips of its triangles.
void AddReached(const SubMesh& region, const PointSet& inner,
  const std::vector<std::int32_t>& flips, PointSet& reached)
{
  for (std::int64_t t = 0; t < region.GetNumberOfTriangles(); ++t)
  {
    for (int slot = 0; slot < 3 && flips[t] > 0; ++slot)
    {
      const std::int64_t point = region.GetPoint(t, slot);
      if (!inner.Has(point))
      {
        reached.Add(point);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
void DividedRun::FlipRegions()
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
    const double share = PiecesShare + (1.0 - PiecesShare) * (1.0 - 1.0 / double(regions));
    active = this->FlipRegion(active,
      [&](double part)
      { return !this->Progress || this->Progress(share + part * (1.0 - share) / 2.0); });
  }
}

std::int64_t DividedRun::CountIterationsLeft() const
{
  const std::int64_t most = this->Options.MaximumIterations;
  const auto made = static_cast<std::int64_t>(this->Report.Iterations.size());
  return most < 0 ? most : std::max<std::int64_t>(0, most - made);
}

/// Flips the triangles around some points, as one mesh.
/// @returns the points around which edges must be judged next.
PointSet DividedRun::FlipRegion(const PointSet& active, const ProgressObserver& progress)
{
  const ThreadBackend& threads = this->Mesh.GetThreads();
  const PointSet inner = this->Mesh.FindPointsAround(active);
  SubMesh region = this->Mesh.GetTrianglesAt(inner);
  region.FixEdges(this->Fixed);
  if (this->Mesh.GetSurvey().NeedsGuard())
  {
    region.GuardPoints([&](std::int64_t point) { return !inner.Has(point); });
  }
  FlipOptions options = this->GetCountingOptions();
  options.MaximumIterations = this->CountIterationsLeft();
  options.TrackQuality = this->Options.TrackQuality;
  FlipSession session(region.ViewWithoutLabels(), options, progress);
  if (session.GetReport().StopReason != StopReasonKind::Aborted)
  {
    session.Advance(-1, {}, progress);
  }
  this->KeepRegion(session.GetReport(), inner);
  std::vector<std::int32_t> flips(region.GetNumberOfTriangles());
  session.StoreFlipCounts(flips.data());
  this->KeepFlips(region, flips.data());
  session.StoreTriangles(region.GetTriangles());
  region.Store(this->Mesh.GetTriangles());
  PointSet next(this->Mesh.View().Points.Count, threads);
  AddReached(region, inner, flips, next);
  next.Number(threads);
  return next;
}

/// @param inner the points all of whose triangles belong to the region.
void DividedRun::KeepRegion(const FlipReport& report, const PointSet& inner)
{
  const bool tracks = this->Options.TrackQuality && !report.Iterations.empty();
  const TriangleArray& triangles = this->Mesh.View().Triangles;
  const double rest = !tracks
    ? NaN
    : FindSmallestAngle(this->Mesh, [&](std::int64_t t) { return !inner.Touches(triangles, t); });
  for (IterationRecord row : report.Iterations)
  {
    row.Iteration = static_cast<std::int64_t>(this->Report.Iterations.size()) + 1;
    row.MinimumAngle = std::fmin(row.MinimumAngle, rest);
    this->Report.Iterations.push_back(row);
  }
  this->Report.Rounds += report.TotalFlips > 0 ? 1 : 0;
  this->Report.StopReason = report.StopReason;
  this->Report.BuildSeconds += report.BuildSeconds;
  this->Report.FlipSeconds += report.FlipSeconds;
  this->HasBadEdges = this->HasBadEdges || report.NonDelaunayAfter > 0;
}

//------------------------------------------------------------------------------
void DividedRun::CountRest()
{
  PiecesReport& report = this->Report;
  this->Seams.Add(report.Edges, 1);
  report.Edges = this->AreCounted ? this->Seams.Edges : EdgeCounts();
  report.EulerCharacteristic =
    this->AreCounted ? this->Mesh.GetUsedPoints() - report.Edges.Edges + report.Triangles : 0;
  report.NonDelaunayBefore += this->AreCounted ? this->Seams.NonDelaunay : 0;
  if (report.Rounds > 1)
  {
    report.MinimumAngleAfter = FindSmallestAngle(this->Mesh, [](std::int64_t) { return true; });
  }
  if (this->HasBadEdges && report.StopReason != StopReasonKind::Aborted)
  {
    this->CountBadEdges();
  }
  if (!this->Options.TrackQuality)
  {
    for (IterationRecord& row : report.Iterations)
    {
      row.MinimumAngle = NaN;
    }
    if (!report.Iterations.empty())
    {
      report.Iterations.back().MinimumAngle = report.MinimumAngleAfter;
    }
  }
  CountIterations(report);
}

/// Counts those that are left, whatever the reason.
void DividedRun::CountBadEdges()
{
  const FlipOptions options = this->GetCountingOptions();
  EdgeTotals totals;
  const auto count = [&](SubMesh& part, std::int64_t factor)
  {
    part.FixEdges(this->Fixed);
    const FlipSession session(part.ViewWithoutLabels(), options);
    totals.Add(session.GetReport(), factor);
  };
  SubMesh strip = this->Mesh.GetTrianglesAt(this->Mesh.FindSeamPoints());
  count(strip, 1);
  for (int piece = 0; piece < this->Mesh.GetNumberOfPieces(); ++piece)
  {
    SubMesh whole = this->Mesh.GetPiece(piece);
    SubMesh atSeams = this->Mesh.GetPieceOf(strip, piece);
    count(whole, 1);
    count(atSeams, -1);
  }
  this->Report.NonDelaunayAfter = totals.NonDelaunay;
  this->Report.BlockedByShape = totals.BlockedByShape;
  // A piece does not know all edges that exist. After the last flip nothing else blocks any.
  this->Report.BlockedByEdge =
    this->Report.Converged() ? totals.NonDelaunay - totals.BlockedByShape : totals.BlockedByEdge;
}

/// What is known of the whole mesh takes the place of what pieces have found.
void DividedRun::AddDefects()
{
  std::vector<Defect> defects = this->Mesh.GetDefects();
  if (this->Report.UnmatchedConstraints > 0)
  {
    defects.push_back({ "constraint edges that are not edges of the mesh",
      this->Report.UnmatchedConstraints, {}, DefectIds::Points });
  }
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

}
