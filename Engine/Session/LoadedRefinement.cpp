// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LoadedRun.h"

#include "InputChecks.h"

#include <algorithm>
#include <cstdint>

/// @file
/// The rounds of refinement, of points and of meshes.

namespace delaunayflip
{
namespace
{

/// FlipOptions::PointLimit, or its default.
std::int64_t GetPointLimit(std::int64_t limit, std::int64_t points)
{
  constexpr std::int64_t Times = 10, Fewest = 1000000;
  return limit > 0 ? limit : std::max(Times * points, Fewest);
}

}

RefinementPlan LoadedRun::PlanGoals(const LoadedMesh& mesh, std::int64_t given, std::int64_t used)
{
  const FlipOptions& options = this->Options;
  RefinementPlan plan;
  SetSmallestAngle(options.MinimumAngle, plan.Goals);
  if (options.MaximumArea > 0.0)
  {
    plan.Goals.Area = options.MaximumArea;
  }
  if (options.MaximumEdge > 0.0)
  {
    plan.Goals.SquaredEdge = options.MaximumEdge * options.MaximumEdge;
  }
  const FlipReport& report = mesh.GetInputReport(); // also of triangles that are removed
  this->MostPoints = std::min(GetPointLimit(options.PointLimit, given),
    used + CountPointsThatFit(report.Triangles, report.Points));
  plan.MostAdded = std::max<std::int64_t>(0, this->MostPoints - used);
  plan.KeepsBoundary = options.KeepBoundary;
  return plan;
}

Defect LoadedRun::DescribeLimit(std::int64_t points) const
{
  Defect defect(DefectKind::PointLimitReached, points);
  defect.Detail =
    " than " + std::to_string(this->MostPoints) + "; set it higher, or ask for larger triangles";
  return defect;
}

bool LoadedRun::Refine()
{
  // The number of rounds is not known before; most meshes need 10 to 30.
  constexpr double Usual = 10.0;
  if (this->Report.Triangles == 0)
  {
    return true;
  }
  const auto mayRefine = [this]
  { return this->CountIterations() + this->Rounds - this->RoundsBefore < this->Limit; };
  while (!this->IsRefined && !this->WasStopped && !this->IsAtIterationLimit() && mayRefine())
  {
    this->OnBackend([this](LoadedMesh& mesh) { this->IsRefined = this->RefineOnce(mesh) == 0; });
    this->RecordChange(this->IsRefined ? 0 : 1); // also the beginning, if no point is added
    if (!this->IsRefined)
    {
      const auto rounds = static_cast<double>(this->Rounds);
      this->WasStopped = !this->TellStage(rounds / (rounds + Usual));
    }
  }
  if (this->Rounds > 0 || this->IsRefined)
  {
    this->OnBackend([this](LoadedMesh& mesh) { this->TakeRefinement(mesh); });
    this->RecordFound(this->Loaded->GetLoop().GetFound());
    this->AreAnglesKnown = false;
  }
  return this->IsRefinementOver();
}

bool LoadedRun::IsAtIterationLimit() const
{
  const std::int64_t most = this->Options.MaximumIterations;
  return most >= 0 && this->CountIterations() + this->Rounds >= most;
}

std::int64_t LoadedRun::RefineOnce(LoadedMesh& mesh)
{
  if (this->Rounds == 0)
  {
    mesh.StartRefinement(this->PlanRefinement(mesh));
  }
  const std::int64_t added = mesh.Refine();
  this->Rounds += added > 0 ? 1 : 0;
  return added;
}

void LoadedRun::RepeatRounds(LoadedMesh& mesh, std::int64_t rounds)
{
  this->Rounds = 0;
  while (this->Rounds < rounds)
  {
    this->RefineOnce(mesh);
  }
  if (this->IsRefined)
  {
    this->RefineOnce(mesh); // adds no point, and ends refinement
  }
  this->TakeRefinement(mesh);
}

}
