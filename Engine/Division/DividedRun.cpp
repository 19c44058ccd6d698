// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedRun.h"

#include "DelaunayFlip.h"
#include "FixedPairs.h"
#include "JoinReports.h"
#include "MissingConstraints.h"
#include "QuadSoup.h"

#include <algorithm>
#include <memory>
#include <numeric>

/// @file
/// A run in pieces until the pieces are flipped.

namespace delaunayflip
{

namespace
{
/// One worker prepares a piece while another's is on the GPU.
int CountWorkers(int pieces, const std::vector<int>& devices)
{
  return devices.empty() ? 1 : std::min(pieces, 2 * static_cast<int>(devices.size()));
}
}

DividedRun::DividedRun(MeshInPieces& mesh, const FlipOptions& options, std::int32_t* flipCounts,
  const ProgressObserver& progress)
  : Mesh(mesh),
    Options(options),
    FlipCounts(flipCounts),
    Progress(progress),
    Constraints(mesh.View().ConstraintEdges,
      mesh.View().ConstraintEdges + 2 * mesh.View().NumberOfConstraintEdges),
    Seam(mesh.FindSeamPoints()),
    Shares(mesh.GetNumberOfPieces()),
    Reports(mesh.GetNumberOfPieces())
{
}

PiecesReport DividedRun::Run()
{
  if (this->FlipCounts)
  {
    this->Mesh.GetThreads().ForEach(
      this->Mesh.View().Triangles.Count, [this](std::int64_t t) { this->FlipCounts[t] = 0; });
  }
  this->ExamineSeams();
  this->FlipPieces();
  this->JoinPieces();
  if (this->Report.StopReason == StopReasonKind::Converged)
  {
    this->FlipRegions();
  }
  this->CountRest();
  this->AddDefects();
  return this->Report;
}

//------------------------------------------------------------------------------
/// The options for parts of the mesh in which no edge is flipped.
FlipOptions DividedRun::GetCountingOptions() const
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

void DividedRun::ExamineSeams()
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
  for (int piece = 0; piece < this->Mesh.GetNumberOfPieces(); ++piece)
  {
    SubMesh part = this->Mesh.GetPieceOf(strip, piece);
    part.FixEdges(this->Constraints);
    part.FixEdges(this->FixedAtSeams);
    count(part, -1);
  }
  this->Unmatched = this->CountUnmatched();
}

/// Keeps the edges of a part that stay.
/// @param edges of that part.
void DividedRun::KeepFixedEdges(
  const SubMesh& part, const FlipOptions& options, const EdgeCounts& edges)
{
  std::vector<std::int64_t> ends;
  const TriangleMesh view = part.View();
  if (edges.Fixed > edges.Boundary + edges.NonManifold)
  {
    ends = FindFixedEdges(view, options);
  }
  if (edges.NonManifold > 0)
  {
    for (const PointPair& edge : FindCrowdedEdges(view.Triangles))
    {
      ends.insert(ends.end(), edge.begin(), edge.end());
    }
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  for (const std::int64_t end : ends)
  {
    this->Fixed.push_back(part.GetPointId(end));
  }
}

/// Constraints that are no edges of the mesh.
std::int64_t DividedRun::CountUnmatched() const
{
  TriangleMesh mesh = this->Mesh.View();
  const std::vector<unsigned char> all(mesh.NumberOfConstraintEdges, 1);
  mesh.ConstraintsToInsert = all.data();
  const MissingConstraints missing = FindMissingConstraints(mesh, this->Mesh.GetThreads());
  return std::count(missing.IsMissing.begin(), missing.IsMissing.end(), true);
}

//------------------------------------------------------------------------------
void DividedRun::FlipPieces()
{
  const int workers = CountWorkers(this->Mesh.GetNumberOfPieces(), this->Options.Devices);
  std::vector<int> turns;
  for (int worker = 0; worker < workers && !this->Options.Devices.empty(); ++worker)
  {
    turns.push_back(worker % static_cast<int>(this->Options.Devices.size()));
  }
  const auto work = [&](PieceGroup& group)
  {
    try
    {
      for (int piece = group.GetRank(); piece < this->Mesh.GetNumberOfPieces(); piece += workers)
      {
        this->FlipPiece(piece, group);
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

FlipOptions DividedRun::GetPieceOptions(int piece) const
{
  FlipOptions options = this->Options;
  options.NumberOfPieces = 1;
  options.Geometry = this->Mesh.GetSurvey().Geometry;
  if (!this->Options.Devices.empty())
  {
    options.Device = this->Options.Devices[piece % this->Options.Devices.size()];
    options.Devices.clear();
  }
  return options;
}

void DividedRun::FlipPiece(int piece, PieceGroup& group)
{
  SubMesh part = this->Mesh.GetPiece(piece);
  part.FixEdges(this->Constraints);
  part.FixEdges(this->FixedAtSeams);
  if (this->Mesh.GetSurvey().NeedsGuard())
  {
    part.GuardPoints([this](std::int64_t point) { return this->Seam.Has(point); });
  }
  // Rank 0 is the calling thread, whose observer is asked.
  const bool isCaller = group.GetRank() == 0;
  group.Work(
    [&]()
    {
      this->FlipSubMesh(
        part, piece, [&](double share) { return this->Tell(piece, share, isCaller); });
    });
  part.Store(this->Mesh.GetTriangles());
}

void DividedRun::FlipSubMesh(SubMesh& part, int piece, const ProgressObserver& progress)
{
  const FlipOptions options = this->GetPieceOptions(piece);
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
  this->Reports[piece] = session.GetReport();
  session.StoreTriangles(part.GetTriangles());
  if (this->FlipCounts)
  {
    Array<std::int32_t> counts =
      this->Mesh.GetThreads().MakeArray<std::int32_t>(part.GetNumberOfTriangles());
    session.StoreFlipCounts(counts.Data());
    this->KeepFlips(part, counts.Data());
  }
}

/// Adds the flips of a part's triangles. Parts that are flipped at the same time have no triangle
/// in common.
void DividedRun::KeepFlips(const SubMesh& part, const std::int32_t* counts)
{
  if (this->FlipCounts)
  {
    this->Mesh.GetThreads().ForEach(part.GetNumberOfTriangles(),
      [&](std::int64_t t) { this->FlipCounts[part.GetSlot(t)] += counts[t]; });
  }
}

/// @returns whether to go on.
bool DividedRun::Tell(int piece, double share, bool isCaller)
{
  this->Shares[piece] = share;
  if (isCaller && this->Progress)
  {
    const double sum = std::accumulate(this->Shares.begin(), this->Shares.end(), 0.0);
    this->GoesOn =
      this->Progress(PiecesShare * sum / this->Mesh.GetNumberOfPieces()) && this->GoesOn;
  }
  return this->GoesOn;
}

/// Begins the report of the whole mesh.
void DividedRun::JoinPieces()
{
  FlipReport& report = this->Report;
  report = JoinReports(this->Reports);
  report.UnmatchedConstraints = this->Unmatched;
  this->Report.SeamEdges = -this->Seams.Edges.Edges;
  report.Points = this->Mesh.View().Points.Count;
  report.GeometryUsed = this->Mesh.GetSurvey().Geometry;
  report.GeometryReason = this->Mesh.GetSurvey().GeometryReason;
  this->Report.Rounds = 1;
  report.StopReason = StopReasonKind::Converged;
  this->SumSeconds();
  for (const FlipReport& piece : this->Reports)
  {
    const bool isWorse = piece.StopReason == StopReasonKind::Aborted ||
      (piece.StopReason == StopReasonKind::IterationLimit && report.Converged());
    report.StopReason = isWorse ? piece.StopReason : report.StopReason;
    this->HasBadEdges = this->HasBadEdges || piece.NonDelaunayAfter > 0;
  }
}

/// Those of all pieces that have the same GPU; of several GPUs the largest.
void DividedRun::SumSeconds()
{
  const std::size_t devices = std::max<std::size_t>(1, this->Options.Devices.size());
  std::vector<double> build(devices), flip(devices);
  for (std::size_t piece = 0; piece < this->Reports.size(); ++piece)
  {
    build[piece % devices] += this->Reports[piece].BuildSeconds;
    flip[piece % devices] += this->Reports[piece].FlipSeconds;
  }
  this->Report.BuildSeconds = *std::max_element(build.begin(), build.end());
  this->Report.FlipSeconds = *std::max_element(flip.begin(), flip.end());
}

}
