// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdateReport.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{
namespace
{

double JoinSeconds(double a, double b, UpdateReport::Timing timing)
{
  return timing == UpdateReport::Timing::InTurn ? a + b : std::max(a, b);
}

/// From best to worst.
int GetSeverity(StopReasonKind reason)
{
  switch (reason)
  {
    case StopReasonKind::NotStarted:
      return 0;
    case StopReasonKind::Converged:
      return 1;
    case StopReasonKind::Running:
      return 2;
    case StopReasonKind::IterationLimit:
      return 3;
    case StopReasonKind::Aborted:
      return 4;
  }
  return 0;
}

/// Whether a mesh has a smallest angle: some triangle has no coordinate that is NaN.
bool HasAngles(const FlipReport& report)
{
  return report.Triangles > 0 && !std::isnan(report.MinimumAngleBefore);
}

/// The smallest angle of a mesh after iteration `row`. A mesh that made fewer iterations keeps its
/// last angle.
double GetMinimumAngle(const FlipReport& report, std::size_t row)
{
  if (!HasAngles(report))
  {
    return std::numeric_limits<double>::infinity();
  }
  return row < report.Iterations.size() ? report.Iterations[row].MinimumAngle
                                        : report.MinimumAngleAfter;
}

/// The smaller of two numbers; NaN, which stands for unknown, if either is.
double GetSmaller(double a, double b)
{
  return std::isnan(a) || std::isnan(b) ? a + b : std::min(a, b);
}

std::vector<IterationRecord> JoinIterations(
  const FlipReport& a, const FlipReport& b, UpdateReport::Timing timing)
{
  std::vector<IterationRecord> rows(std::max(a.Iterations.size(), b.Iterations.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (const FlipReport* report : { &a, &b })
    {
      const IterationRecord from =
        i < report->Iterations.size() ? report->Iterations[i] : IterationRecord();
      rows[i].Tested += from.Tested;
      rows[i].NonDelaunay += from.NonDelaunay;
      rows[i].Flipped += from.Flipped;
      rows[i].Excluded += from.Excluded;
      rows[i].Blocked += from.Blocked;
      rows[i].Seconds = JoinSeconds(rows[i].Seconds, from.Seconds, timing);
    }
    rows[i].Iteration = static_cast<std::int64_t>(i) + 1;
    rows[i].MinimumAngle = GetSmaller(GetMinimumAngle(a, i), GetMinimumAngle(b, i));
  }
  return rows;
}

void AddEdges(EdgeCounts& sum, const EdgeCounts& more)
{
  sum.Edges += more.Edges;
  sum.Boundary += more.Boundary;
  sum.NonManifold += more.NonManifold;
  sum.WronglyWound += more.WronglyWound;
  sum.Feature += more.Feature;
  sum.Constraint += more.Constraint;
  sum.Region += more.Region;
  sum.Fixed += more.Fixed;
}

void AddAngles(FlipReport& sum, const FlipReport& more)
{
  if (!HasAngles(sum) && more.Triangles > 0)
  {
    sum.MinimumAngleBefore = more.MinimumAngleBefore;
    sum.MinimumAngleAfter = more.MinimumAngleAfter;
  }
  else if (HasAngles(more))
  {
    sum.MinimumAngleBefore = std::min(sum.MinimumAngleBefore, more.MinimumAngleBefore);
    sum.MinimumAngleAfter = std::min(sum.MinimumAngleAfter, more.MinimumAngleAfter);
  }
}

void AddGeometry(UpdateReport& sum, const UpdateReport& more)
{
  if (sum.GeometryUsed == GeometryKind::Auto)
  {
    sum.GeometryUsed = more.GeometryUsed;
  }
  sum.HasMixedGeometry = sum.HasMixedGeometry || more.HasMixedGeometry ||
    (more.GeometryUsed != GeometryKind::Auto && more.GeometryUsed != sum.GeometryUsed);
}

/// Appends a text to a comma-separated list, unless the list contains it already.
void AddText(std::string& list, const std::string& text)
{
  if (list.find(text) == std::string::npos)
  {
    list += (list.empty() ? "" : ", ") + text;
  }
}

void AddDefects(std::vector<Defect>& sum, const std::vector<Defect>& more)
{
  for (const Defect& defect : more)
  {
    const auto same = std::find_if(
      sum.begin(), sum.end(), [&defect](const Defect& one) { return one.What == defect.What; });
    Defect& target = same != sum.end() ? *same : sum.emplace_back(Defect{ defect.What, 0, {} });
    target.Count += defect.Count;
  }
}

}

void UpdateReport::Add(const UpdateReport& other, Timing timing)
{
  this->Iterations = JoinIterations(*this, other, timing);
  AddAngles(*this, other);
  AddGeometry(*this, other);
  AddEdges(this->Edges, other.Edges);
  AddText(this->GeometryReason, other.GeometryReason);
  AddText(this->Tolerance, other.Tolerance);
  AddText(this->Backend, other.Backend);
  AddText(this->Fallback, other.Fallback);
  AddDefects(this->Defects, other.Defects);
  this->Points += other.Points;
  this->Triangles += other.Triangles;
  this->Rounds = std::max(this->Rounds, other.Rounds);
  this->MovedTriangles += other.MovedTriangles;
  this->UnmatchedConstraints += other.UnmatchedConstraints;
  this->InsertedConstraints += other.InsertedConstraints;
  this->ConstraintFlips += other.ConstraintFlips;
  this->EulerCharacteristic += other.EulerCharacteristic;
  this->TotalFlips += other.TotalFlips;
  this->TotalExcluded += other.TotalExcluded;
  this->TotalBlocked += other.TotalBlocked;
  this->NonDelaunayBefore += other.NonDelaunayBefore;
  this->NonDelaunayAfter += other.NonDelaunayAfter;
  this->BlockedByShape += other.BlockedByShape;
  this->BlockedByEdge += other.BlockedByEdge;
  this->BuildSeconds = JoinSeconds(this->BuildSeconds, other.BuildSeconds, timing);
  this->FlipSeconds = JoinSeconds(this->FlipSeconds, other.FlipSeconds, timing);
  if (GetSeverity(other.StopReason) > GetSeverity(this->StopReason))
  {
    this->StopReason = other.StopReason;
  }
}

const char* UpdateReport::GetGeometryName() const
{
  return this->HasMixedGeometry ? "mixed" : ToString(this->GeometryUsed);
}

namespace
{

void AddNotes(std::vector<Note>& notes, const std::vector<Note>& more, const std::string& place)
{
  for (const Note& note : more)
  {
    notes.push_back({ note.Where.empty() ? place : place + ", " + note.Where, note.Text });
  }
}

}

void UpdateSummary::AddMesh(const MeshOutcome& mesh, std::int64_t block, const std::string& where)
{
  this->Report.Add(mesh.Report, UpdateReport::Timing::InTurn);
  if (mesh.Failure)
  {
    this->Failure = this->Failure == 0 ? mesh.Failure.Kind : this->Failure;
    this->Errors.push_back({ where, mesh.Failure.Message });
  }
  if (!mesh.Trouble.empty())
  {
    this->Warnings.push_back({ where, mesh.Trouble });
  }
  if (mesh.Report.Triangles > 0)
  {
    this->Blocks.push_back(block);
  }
}

void UpdateSummary::AddRank(const UpdateSummary& other, int rank)
{
  const std::string place = "rank " + std::to_string(rank);
  this->Report.Add(other.Report, UpdateReport::Timing::AtOnce);
  this->Failure = this->Failure == 0 ? other.Failure : this->Failure;
  AddNotes(this->Errors, other.Errors, place);
  AddNotes(this->Warnings, other.Warnings, place);
  const std::size_t known = this->Blocks.size();
  this->Blocks.insert(this->Blocks.end(), other.Blocks.begin(), other.Blocks.end());
  std::sort(this->Blocks.begin() + known, this->Blocks.end());
  std::inplace_merge(this->Blocks.begin(), this->Blocks.begin() + known, this->Blocks.end());
  const auto end = std::unique(this->Blocks.begin(), this->Blocks.end());
  this->HasSeams = this->HasSeams || other.HasSeams || end != this->Blocks.end();
  this->Blocks.erase(end, this->Blocks.end());
}

}
