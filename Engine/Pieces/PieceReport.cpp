// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRun.h"

#include "ConstraintInsertion.h"
#include "DelaunayFlip.h"
#include "PieceQuality.h"
#include "QuadSoup.h"

#include <algorithm>

/// @file
/// What a run in pieces reports.

namespace delaunayflip
{

namespace
{
/// Adds a defect that may be known already.
void AddDefect(const Defect& defect, std::vector<Defect>& defects)
{
  const auto known = std::find_if(
    defects.begin(), defects.end(), [&](const Defect& other) { return other.What == defect.What; });
  if (known != defects.end())
  {
    known->Count += defect.Count;
  }
  else if (defect.Count > 0)
  {
    defects.push_back(defect);
  }
}
}

/// The edges that are left, and the smallest angle, on this rank.
void PieceRun::CountRest()
{
  const bool isKnown = this->Whole.Rounds == 1 && this->Own.Edges.Edges > 0;
  if (isKnown)
  {
    return; // the first flips were the last
  }
  const int threads = this->Job.Options.NumberOfThreads;
  this->Own.MinimumAngleAfter = this->First
    ? FindSmallestAngleAfterRounds(this->Mesh, this->Job.Survey)
    : FindSmallestAngle(this->Mesh, this->Job.Survey, threads);
  this->Own.NonDelaunayAfter = this->Own.BlockedByShape = this->Own.BlockedByEdge = 0;
  if (this->HasBlocked)
  {
    this->CountBad();
  }
}

/// The bad edges that are left on this rank.
void PieceRun::CountBad()
{
  this->Mesh.ListAll();
  PointList points(this->Job.Survey.IsFloat);
  points.Reserve(this->Mesh.GetNumberOfPoints());
  for (std::int64_t i = 0; i < this->Mesh.GetNumberOfPoints(); ++i)
  {
    double x[3];
    this->Mesh.GetPosition(i, x);
    points.Add(x);
  }
  std::vector<std::int32_t> ids;
  std::vector<std::int64_t> fixed;
  for (const PieceTriangle& triangle : this->Mesh.Triangles)
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
  mesh.Whole.SharedPoints = this->Job.Survey.NeedsGuard() ? this->Mesh.GetShared().data() : nullptr;
  FlipOptions none = GetPartOptions(this->Job.Survey, this->Job.Options);
  none.MaximumIterations = 0;
  const FlipSession session(mesh, none);
  const FlipReport& report = session.GetReport();
  this->Own.NonDelaunayAfter = report.NonDelaunayAfter;
  this->Own.BlockedByShape = report.BlockedByShape;
  this->Own.BlockedByEdge = report.BlockedByEdge;
}

PiecesReport PieceRun::MakeReport()
{
  const SeamCounts& seams = this->Seams.Counts;
  PiecesReport report = this->Whole;
  static_cast<FlipReport&>(report) = JoinReports(this->Own, this->Rows, this->Job.Group);
  report.Points = this->NumberOfPoints;
  report.Edges = this->IsCounted ? seams.AddTo(report.Edges) : EdgeCounts();
  report.EulerCharacteristic =
    this->IsCounted ? this->UsedPoints - report.Edges.Edges + report.Triangles : 0;
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
  this->AddDefects(report);
  return report;
}

void PieceRun::AddDefects(FlipReport& report) const
{
  const SeamCounts& seams = this->Seams.Counts;
  const Defect onSurface{ Describe(Refusal::OnSurface), seams.MissingToInsert, {},
    DefectIds::PointPairs };
  const Defect missing{ "constraint edges that are not edges of the mesh",
    seams.MissingConstraints - seams.MissingToInsert, {}, DefectIds::Points };
  for (const Defect& defect : { this->Job.Survey.NearlyHeightField, onSurface, missing })
  {
    AddDefect(defect, report.Defects);
  }
}

}
