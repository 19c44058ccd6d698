// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshRun.h"

#include "InputChecks.h"
#include "PointPreparation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

/// @file
/// How the run of a mesh refines it.

namespace delaunayflip
{
namespace
{

/// Computes a weighted mean. If all values are equal, it is exactly this value, so that planes stay
/// planar.
double Mean(const double (&values)[3], const double (&weights)[3])
{
  double sum = 0.0;
  bool areEqual = true;
  for (int k = 0; k < 3; ++k)
  {
    areEqual = areEqual && (values[k] == values[0] || weights[k] == 0.0);
    sum += weights[k] == 0.0 ? 0.0 : weights[k] * values[k];
  }
  return areEqual ? values[0] : sum;
}

/// Finds the coordinates of an added point, in the precision of the caller's points.
void FindPosition(
  const PointArray& points, const RefinedVertex& vertex, const int (&axes)[2], double (&xyz)[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double values[3];
    for (int k = 0; k < 3; ++k)
    {
      values[k] = points.Get(vertex.Points[k], axis);
    }
    xyz[axis] = Mean(values, vertex.Weights);
  }
  if (axes[0] >= 0)
  {
    xyz[axes[0]] = vertex.U;
    xyz[axes[1]] = vertex.V;
  }
  for (double& coordinate : xyz)
  {
    coordinate = points.Floats ? static_cast<float>(coordinate) : coordinate;
  }
}

}

RefinementPlan MeshRun::PlanRefinement(LoadedMesh& mesh)
{
  const std::int64_t points = this->Mesh.CountPoints();
  RefinementPlan plan = this->PlanGoals(mesh, points, points);
  plan.IsOfCaller = true;
  plan.HasNonManifold = mesh.GetInputReport().Edges.NonManifold > 0;
  this->NumberRegions(plan);
  const double* sizes = this->Mesh.GetFixedEdges().Sizes;
  if (sizes)
  {
    plan.Sizes.assign(sizes, sizes + points);
  }
  return plan;
}

void MeshRun::LabelRegions()
{
  FlipOptions options = this->Insertion.GetOptions(this->Options);
  options.Geometry = this->Report.GeometryUsed;
  UnusedSeeds unused;
  this->Regions = FindSeededRegions(this->Start.CopyToHost(), options, unused);
  AddDefect(unused.Outside, this->Report.Defects);
  AddDefect(unused.Repeated, this->Report.Defects);
}

/// Numbers the regions from 0. Triangles are in one region if they have the same label and the same
/// seed. Frozen triangles count as removed. Without labels, seeds and frozen triangles there are no
/// numbers.
void MeshRun::NumberRegions(RefinementPlan& plan) const
{
  using Key = std::pair<std::int32_t, std::int32_t>; // the label, and the number of the seed
  const FixedEdges& given = this->Mesh.GetFixedEdges();
  const auto getKey = [&](std::size_t t) {
    return Key(given.Regions ? given.Regions[t] : 0, this->Regions.empty() ? 0 : this->Regions[t]);
  };
  const bool hasRegions = given.Regions || !this->Regions.empty();
  plan.Regions.resize(hasRegions || given.FrozenTriangles ? this->Mesh.CountTriangles() : 0, 0);
  std::vector<Key> keys;
  if (hasRegions)
  {
    for (std::size_t t = 0; t < plan.Regions.size(); ++t)
    {
      keys.push_back(getKey(t));
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const auto& [label, seed] : keys)
  {
    plan.LabelOfRegion.push_back(label);
    if (given.NumberOfRegionSeeds > 0) // else there are no limits, and refinement need not look
    {
      const double area = seed > 0 ? given.RegionSeeds[seed - 1].MaximumArea : 0.0;
      plan.AreaOfRegion.push_back(area > 0.0 ? area : INFINITY);
    }
  }
  for (std::size_t t = 0; t < plan.Regions.size(); ++t)
  {
    if (hasRegions)
    {
      const auto place = std::lower_bound(keys.begin(), keys.end(), getKey(t));
      plan.Regions[t] = static_cast<std::int32_t>(place - keys.begin());
    }
    if (given.FrozenTriangles && given.FrozenTriangles[t] != 0)
    {
      plan.Regions[t] = RemovedRegion(plan.Regions[t]);
    }
  }
}

void MeshRun::TakeRefinement(LoadedMesh& mesh)
{
  const RefinementResult& made = mesh.FetchRefinement(this->IsRefinementOver());
  this->AddRefinedPoints(made);
  this->Refined.Sources = made.Sources;
  const std::int64_t unrefined = this->HasEndedRefinement() ? made.Unrefined : 0;
  this->Refined.Unrefined = Defect(DefectKind::TrianglesNotRefined, unrefined);
  std::vector<std::int64_t>& first = this->Refined.Unrefined.FirstIds;
  for (const TriangleId triangle : made.FirstUnrefined)
  {
    first.push_back(made.Sources[triangle]); // a triangle of the caller
  }
  std::sort(first.begin(), first.end());
  first.erase(std::unique(first.begin(), first.end()), first.end());
  this->Refined.HasReachedLimit = made.HasReachedLimit;
  FlipReport& report = this->Report;
  const std::int64_t segments = SizeOf(made.Segments) - SizeOf(made.Ends) / 2;
  const EdgeCounts& before = mesh.GetInputReport().Edges;
  report.Triangles = mesh.GetInputReport().Triangles;
  report.Edges.Edges = before.Edges + made.Edges;
  report.Edges.Boundary = before.Boundary + made.BoundaryEdges;
  report.Edges.Region = before.Region + made.RegionEdges;
  report.Edges.Constraint = before.Constraint + this->CountConstraints(made);
  report.Edges.Fixed = before.Fixed + segments;
  PointCounts& counts = report.FromPoints;
  counts.RefinementPoints = SizeOf(this->Refined.Points);
  counts.RefinementRounds = this->Rounds;
  counts.UnrefinedTriangles = unrefined;
  counts.ReachedPointLimit = made.HasReachedLimit ? 1 : 0;
  this->AreKeptEdgesKnown = false;
}

/// Counts the edges that splits of constraint edges have added.
std::int64_t MeshRun::CountConstraints(const RefinementResult& made) const
{
  const FixedEdges& edges = this->Start.GetFixedEdges();
  std::vector<std::pair<std::int64_t, std::int64_t>> constraints;
  for (std::int64_t i = 0; i < edges.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = edges.ConstraintEdges + 2 * i;
    constraints.emplace_back(std::minmax(ends[0], ends[1]));
  }
  std::sort(constraints.begin(), constraints.end());
  std::int64_t count = 0;
  for (std::size_t i = made.Ends.size() / 2; i < made.Segments.size(); ++i)
  {
    const std::int64_t a = made.Ends[2 * std::size_t(made.Segments[i].Origin)];
    const std::int64_t b = made.Ends[2 * std::size_t(made.Segments[i].Origin) + 1];
    const std::pair<std::int64_t, std::int64_t> ends = std::minmax(a, b);
    count += std::binary_search(constraints.begin(), constraints.end(), ends) ? 1 : 0;
  }
  return count;
}

void MeshRun::AddRefinedPoints(const RefinementResult& made)
{
  const PointArray& points = this->Mesh.CopyToHost().Points;
  std::vector<AddedPoint>& added = this->Refined.Points;
  added.clear();
  added.reserve(made.Vertices.size());
  for (const RefinedVertex& vertex : made.Vertices)
  {
    double xyz[3];
    FindPosition(points, vertex, made.Axes, xyz);
    AddedPoint point = ToAddedPoint(vertex);
    point.X = xyz[0];
    point.Y = xyz[1];
    point.Z = xyz[2];
    added.push_back(point);
  }
}

void MeshRun::StoreSources(std::int32_t* sources)
{
  if (this->Refined.Sources.empty())
  {
    std::iota(sources, sources + this->CountTriangles(), 0);
    return;
  }
  std::copy(this->Refined.Sources.begin(), this->Refined.Sources.end(), sources);
}

void MeshRun::StoreRegions(std::int32_t* labels)
{
  this->StoreSources(labels); // each is replaced by its label
  const RegionSeed* seeds = this->Mesh.GetFixedEdges().RegionSeeds;
  for (std::int64_t t = 0; t < this->CountTriangles(); ++t)
  {
    const std::int32_t seed = this->Regions.empty() ? 0 : this->Regions[labels[t]];
    labels[t] = seed > 0 ? seeds[seed - 1].Label : 0;
  }
}

}
