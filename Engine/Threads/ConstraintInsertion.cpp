// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"

#include "ConstraintFlips.h"
#include "EdgeMeshBuilder.h"
#include "MeshOnBackend.h"
#include "MeshSurveyBuilder.h"

#include <algorithm>
#include <iterator>

namespace delaunayflip
{
namespace
{

/// By Refusal.
constexpr const char* Reasons[] = {
  "constraint edges that cannot be inserted because they leave the mesh",
  "constraint edges that cannot be inserted because they leave the part of the mesh that a rank "
  "has: insert constraints across ranks before the mesh is divided",
  "constraint edges that cannot be inserted because they cross edges that stay",
  "constraint edges that cannot be inserted where triangles overlap or points coincide",
  "constraint edges that ranks cannot insert because triangles overlap or have no area: insert "
  "constraints before the mesh is divided",
  "constraint edges that are not edges of the mesh and cannot be inserted on a surface"
};

Refusal ToRefusal(PathResult result)
{
  return result == PathResult::LeavesMesh
    ? Refusal::LeavesMesh
    : (result == PathResult::CrossesFixedEdge ? Refusal::CrossesFixedEdge : Refusal::MeetsOverlap);
}

}

const char* Describe(Refusal refusal) { return Reasons[static_cast<std::size_t>(refusal)]; }

void AddDefects(const std::vector<RefusedConstraint>& refused, std::vector<Defect>& defects)
{
  for (std::size_t i = 0; i < std::size(Reasons); ++i)
  {
    Defect defect{ Reasons[i], 0, {}, DefectIds::PointPairs };
    for (const RefusedConstraint& one : refused)
    {
      constexpr std::int64_t Named = 3;
      if (one.Why == static_cast<Refusal>(i) && defect.Count++ < Named)
      {
        defect.FirstIds.insert(defect.FirstIds.end(), std::begin(one.Ends), std::end(one.Ends));
      }
    }
    if (defect.Count > 0)
    {
      defects.push_back(defect);
    }
  }
}

bool ConstraintInsertion::IsRequested(const FixedEdges& edges)
{
  const unsigned char* flags = edges.ConstraintsToInsert;
  return flags &&
    std::any_of(
      flags, flags + edges.NumberOfConstraintEdges, [](unsigned char flag) { return flag != 0; });
}

MissingConstraints FindMissingConstraints(const TriangleMesh& mesh, const ThreadBackend& backend)
{
  const auto toKey = [](std::int64_t from, std::int64_t to)
  { return EdgeKey(static_cast<VertexId>(from), static_cast<VertexId>(to)); };
  std::vector<unsigned char> isEnd(mesh.Points.Count, 0);
  std::vector<std::uint64_t> keys; // of the edges that constraints are to become
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t from = CheckConstraint(mesh, i, 0);
    const std::int64_t to = CheckConstraint(mesh, i, 1);
    if (mesh.ConstraintsToInsert[i] != 0 && from != to)
    {
      keys.push_back(toKey(from, to));
      isEnd[from] = isEnd[to] = 1;
    }
  }
  MissingConstraints missing;
  if (keys.empty())
  {
    return missing;
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  const auto find = [&](std::int64_t from, std::int64_t to) // keys.size() if it is not wanted
  {
    const auto place = std::lower_bound(keys.begin(), keys.end(), toKey(from, to));
    const bool isThere = place != keys.end() && *place == toKey(from, to);
    return isThere ? static_cast<std::size_t>(place - keys.begin()) : keys.size();
  };
  const auto mayEndAt = [&](std::int64_t point)
  { return point >= 0 && point < mesh.Points.Count && isEnd[point] != 0; };
  std::vector<unsigned char> isEdge(keys.size(), 0);
  backend.ForEach(mesh.Triangles.Count,
    [&](std::int64_t t)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        const std::int64_t from = mesh.Triangles.Get(t, slot);
        const std::int64_t to = mesh.Triangles.Get(t, NextSlot(slot));
        const std::size_t i = mayEndAt(from) && mayEndAt(to) ? find(from, to) : keys.size();
        if (i < keys.size())
        {
          AtomicStore<unsigned char>(&isEdge[i], 1);
        }
      }
    });
  std::vector<bool> isListed(keys.size(), false);
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::size_t found = find(mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1]);
    missing.IsMissing.push_back(found < keys.size() && isEdge[found] == 0);
    if (missing.IsMissing.back() && !isListed[found])
    {
      isListed[found] = true;
      missing.First.push_back(i);
    }
  }
  return missing;
}

/// The places of the points in the plane, by rank.
static std::vector<CoordinatePair<double>> ListPlaces(
  const TriangleMesh& mesh, const SpatialOrderView& ranks, const PlaneProjection& projection)
{
  std::vector<CoordinatePair<double>> places(mesh.Points.Count);
  for (std::int64_t i = 0; i < mesh.Points.Count; ++i)
  {
    const PlanePoint point = projection.Project(mesh.Points, i);
    places[ranks.GetRank(i)] = { point.U, point.V };
  }
  return places;
}

ConstraintInsertion::ConstraintInsertion(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& observer)
{
  if (!mesh.ConstraintsToInsert || mesh.NumberOfConstraintEdges == 0)
  {
    return;
  }
  const ThreadBackend backend(options.NumberOfThreads);
  const MissingConstraints missing = FindMissingConstraints(mesh, backend);
  if (missing.First.empty())
  {
    return;
  }
  this->Tried = missing.First;
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, backend);
  this->HasEdges = true; // all but the missing ones as they are
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
    this->Edges.insert(this->Edges.end(), ends, missing.IsMissing[i] ? ends : ends + 2);
  }
  const auto refuse = [&](std::int64_t constraint, Refusal why)
  {
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * constraint;
    this->Refused.push_back({ { ends[0], ends[1] }, why });
  };
  const bool isOnSurface = survey.Geometry == GeometryKind::Surface;
  if (isOnSurface || mesh.Whole.SharedPoints)
  {
    for (const std::int64_t constraint : missing.First)
    {
      refuse(constraint, isOnSurface ? Refusal::OnSurface : Refusal::NeedsGuard);
    }
    return;
  }

  // Shares of the time that an insertion takes: the edge mesh, and all constraints.
  constexpr double BuildShare = 0.6, FlipShare = 0.95;
  const SpatialOrder order = OrderMesh(input, survey, backend);
  const SpatialOrderView ranks = order.View();
  const EdgeMeshInput edges{ input, survey, order, options.FeatureAngle };
  const BuildProgress progress(
    [&](double share) { return !observer || observer(std::min(1.0, share)); });
  const BuildProgress building(
    [&](double share) { return !observer || observer(std::min(1.0, share) * BuildShare); });
  EdgeMeshResult built = BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend, building);
  const std::vector<CoordinatePair<double>> places = ListPlaces(mesh, ranks, survey.Projection);
  const PlaneMesh plane{ built.Edges.View(), PlaneArray(&places.data()->U, mesh.Points.Count, 2) };
  EdgeTableView table = built.Table.View();
  ConstraintFlips flips(plane, mesh.Points.Count, mesh.Triangles.Count, &table);
  for (std::size_t i = 0; i < missing.First.size(); ++i)
  {
    constexpr std::size_t ConstraintsPerCall = 64; // a few milliseconds
    if (i % ConstraintsPerCall == 0)
    {
      const double share = static_cast<double>(i) / static_cast<double>(missing.First.size());
      progress.Tell(BuildShare + (FlipShare - BuildShare) * share);
    }
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * missing.First[i];
    const PathResult result = flips.Insert(ranks.GetRank(ends[0]), ranks.GetRank(ends[1]));
    if (result != PathResult::Found)
    {
      refuse(missing.First[i], ToRefusal(result));
    }
  }
  this->Inserted = static_cast<std::int64_t>(missing.First.size() - this->Refused.size());
  for (const HalfEdgeId segment : flips.GetSegments())
  {
    this->Edges.insert(this->Edges.end(),
      { ranks.GetVertex(plane.GetStart(segment)), ranks.GetVertex(plane.GetEnd(segment)) });
  }
  this->Flips = flips.GetNumberOfFlips();
  if (this->Flips > 0)
  {
    this->Geometry = survey.Geometry;
    this->GeometryReason = survey.GeometryReason;
    this->Store(mesh, built.Edges, ranks, backend);
  }
}

/// Keeps the triangles, with ids as wide as the caller's.
void ConstraintInsertion::Store(const TriangleMesh& mesh, const EdgeMesh& edges,
  const SpatialOrderView& order, const ThreadBackend& backend)
{
  const std::int64_t count = edges.NumberOfTriangles;
  const bool isNarrow = mesh.Triangles.Ids32 != nullptr;
  this->Ids32.resize(isNarrow ? 3 * count : 0);
  this->Ids64.resize(isNarrow ? 0 : 3 * count);
  backend.StoreTriangles(isNarrow ? MutableTriangleArray(this->Ids32.data(), count)
                                  : MutableTriangleArray(this->Ids64.data(), count),
    StoreStep{ edges.Triangles.Data(), order });
  for (std::int64_t t = 0; t < count; ++t)
  {
    const TriangleRecord& triangle = edges.Triangles[t];
    const auto flips = static_cast<std::int32_t>(triangle.Flips / OneFlip);
    if (flips > 0)
    {
      this->FlipCounts.emplace_back(triangle.InputTriangle, flips);
    }
  }
}

TriangleMesh ConstraintInsertion::GetMesh(const TriangleMesh& caller) const
{
  TriangleMesh mesh = caller;
  mesh.ConstraintsToInsert = nullptr;
  if (this->HasEdges)
  {
    mesh.ConstraintEdges = this->Edges.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Edges.size()) / 2;
  }
  if (!this->Ids32.empty())
  {
    mesh.Triangles = TriangleArray(this->Ids32.data(), caller.Triangles.Count);
  }
  if (!this->Ids64.empty())
  {
    mesh.Triangles = TriangleArray(this->Ids64.data(), caller.Triangles.Count);
  }
  return mesh;
}

FlipOptions ConstraintInsertion::GetOptions(const FlipOptions& caller) const
{
  FlipOptions options = caller;
  options.Geometry = this->HasFlips() ? this->Geometry : caller.Geometry;
  return options;
}

void ConstraintInsertion::AddTo(FlipReport& report) const
{
  report.GeometryReason = this->HasFlips() ? this->GeometryReason : report.GeometryReason;
  report.InsertedConstraints = this->Inserted;
  report.ConstraintFlips = this->Flips;
  report.UnmatchedConstraints += static_cast<std::int64_t>(this->Refused.size());
  AddDefects(this->Refused, report.Defects);
}

void ConstraintInsertion::AddFlipCounts(std::int32_t* counts) const
{
  for (const auto& [triangle, flips] : this->FlipCounts)
  {
    counts[triangle] += flips;
  }
}

}
