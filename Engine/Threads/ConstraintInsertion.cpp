// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintInsertion.h"

#include "BackendEngine.h"
#include "ConstraintFlips.h"
#include "EdgeMeshBuilder.h"
#include "MeshSurveyBuilder.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <iterator>

namespace delaunayflip
{

namespace
{

/// The vertex pairs that constraints are to make edges of, and which of them are edges already.
class WantedEdges
{
public:
  explicit WantedEdges(const TriangleMesh& mesh)
    : IsEnd(mesh.Points.Count, 0)
  {
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t from = CheckConstraint(mesh, i, 0);
      const std::int64_t to = CheckConstraint(mesh, i, 1);
      if (mesh.ConstraintsToInsert[i] != 0 && from != to)
      {
        this->Keys.push_back(ToKey(from, to));
        this->IsEnd[from] = 1;
        this->IsEnd[to] = 1;
      }
    }
    std::sort(this->Keys.begin(), this->Keys.end());
    this->Keys.erase(std::unique(this->Keys.begin(), this->Keys.end()), this->Keys.end());
    this->IsEdge.resize(this->Keys.size(), 0);
  }

  bool IsEmpty() const { return this->Keys.empty(); }

  /// By threads at the same time.
  void NoteSide(std::int64_t from, std::int64_t to)
  {
    if (this->MayEndAt(from) && this->MayEndAt(to))
    {
      const std::size_t i = this->Find(from, to);
      if (i < this->Keys.size())
      {
        AtomicStore<unsigned char>(&this->IsEdge[i], 1);
      }
    }
  }

  MissingConstraints ListMissing(const TriangleMesh& mesh) const
  {
    MissingConstraints missing;
    std::vector<bool> isListed(this->Keys.size(), false);
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
      const std::size_t found = this->Find(ends[0], ends[1]);
      missing.IsMissing.push_back(found < this->Keys.size() && this->IsEdge[found] == 0);
      if (missing.IsMissing.back() && !isListed[found])
      {
        isListed[found] = true;
        missing.First.push_back(i);
      }
    }
    return missing;
  }

private:
  static std::uint64_t ToKey(std::int64_t from, std::int64_t to)
  {
    return EdgeKey(static_cast<VertexId>(from), static_cast<VertexId>(to));
  }

  bool MayEndAt(std::int64_t point) const
  {
    const auto count = static_cast<std::int64_t>(this->IsEnd.size());
    return point >= 0 && point < count && this->IsEnd[point] != 0;
  }

  /// The place of a pair among the keys, or one beyond the last.
  std::size_t Find(std::int64_t from, std::int64_t to) const
  {
    const std::uint64_t key = ToKey(from, to);
    const auto place = std::lower_bound(this->Keys.begin(), this->Keys.end(), key);
    return place != this->Keys.end() && *place == key ? place - this->Keys.begin()
                                                      : this->Keys.size();
  }

  std::vector<unsigned char> IsEnd; ///< One per point.
  std::vector<std::uint64_t> Keys; ///< Ascending.
  std::vector<unsigned char> IsEdge; ///< One per key.
};

}

MissingConstraints FindMissingConstraints(const TriangleMesh& mesh, const ThreadBackend& backend)
{
  WantedEdges wanted(mesh);
  if (wanted.IsEmpty())
  {
    return {};
  }
  const TriangleArray triangles = mesh.Triangles;
  backend.ForEach(triangles.Count,
    [&](std::int64_t t)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        wanted.NoteSide(triangles.Get(t, slot), triangles.Get(t, NextSlot(slot)));
      }
    });
  return wanted.ListMissing(mesh);
}

namespace
{
/// Shares of the time that an insertion takes: the edge mesh, and all constraints.
constexpr double BuildShare = 0.6;
constexpr double FlipShare = 0.95;

/// Constraints between two calls of the observer, a few milliseconds.
constexpr std::size_t ConstraintsPerCall = 64;

void Tell(const ProgressObserver& progress, double share)
{
  if (progress && !progress(share))
  {
    throw RunAborted();
  }
}

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

/// Fills a ConstraintInsertion.
class ConstraintInserter
{
public:
  ConstraintInserter(ConstraintInsertion& target, const TriangleMesh& mesh,
    const FlipOptions& options, const ProgressObserver& progress)
    : Target(target),
      Mesh(mesh),
      Options(options),
      Progress(progress),
      Backend(options.NumberOfThreads)
  {
  }

  void Run()
  {
    this->Missing = FindMissingConstraints(this->Mesh, this->Backend);
    if (this->Missing.First.empty())
    {
      return;
    }
    const MeshInput input{ this->Mesh, this->Mesh };
    const MeshSurvey survey = BuildMeshSurvey(input, this->Options.Geometry, this->Backend);
    this->KeepOthers();
    const bool isOnSurface = survey.Geometry == GeometryKind::Surface;
    if (!isOnSurface && !this->Mesh.Whole.SharedPoints)
    {
      this->Flip(input, survey);
      return;
    }
    for (const std::int64_t constraint : this->Missing.First)
    {
      this->Refuse(constraint, isOnSurface ? Refusal::OnSurface : Refusal::NeedsGuard);
    }
  }

private:
  /// All constraints but the missing ones go to the engine as they are.
  void KeepOthers()
  {
    this->Target.HasEdges = true;
    for (std::int64_t i = 0; i < this->Mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t* ends = this->Mesh.ConstraintEdges + 2 * i;
      if (!this->Missing.IsMissing[i])
      {
        this->Target.Edges.insert(this->Target.Edges.end(), ends, ends + 2);
      }
    }
  }

  void Flip(const MeshInput& input, const MeshSurvey& survey)
  {
    const SpatialOrder order = OrderMesh(input, survey, this->Backend);
    const EdgeMeshInput edges{ input, survey, order, this->Options.FeatureAngle };
    const BuildProgress progress([this](double share)
      { return !this->Progress || this->Progress(std::min(1.0, share) * BuildShare); });
    EdgeMeshResult built =
      BuildEdgeMesh(edges, LoadTriangles(edges, this->Backend), this->Backend, progress);
    const PlaneMesh plane{ built.Edges.View(), this->Mesh.Points, order.View(), survey.Projection };
    ConstraintFlips flips(
      plane, this->Mesh.Points.Count, this->Mesh.Triangles.Count, built.Table.View());
    Tell(this->Progress, BuildShare);
    this->InsertAll(flips, order.View());
    this->Target.Flips = flips.GetNumberOfFlips();
    if (this->Target.Flips > 0)
    {
      this->Target.Geometry = survey.Geometry;
      this->Target.GeometryReason = survey.GeometryReason;
      this->Store(built.Edges, order.View());
    }
    this->StoreSegments(flips, order.View());
  }

  void InsertAll(ConstraintFlips& flips, const SpatialOrderView& order)
  {
    const std::vector<std::int64_t>& missing = this->Missing.First;
    for (std::size_t i = 0; i < missing.size(); ++i)
    {
      const std::int64_t* ends = this->Mesh.ConstraintEdges + 2 * missing[i];
      const PathResult result = flips.Insert(order.GetRank(ends[0]), order.GetRank(ends[1]));
      if (result == PathResult::Found)
      {
        ++this->Target.Inserted;
      }
      else
      {
        this->Refuse(missing[i], ToRefusal(result));
      }
      if (i % ConstraintsPerCall == 0)
      {
        const double share = static_cast<double>(i) / static_cast<double>(missing.size());
        Tell(this->Progress, BuildShare + (FlipShare - BuildShare) * share);
      }
    }
  }

  void StoreSegments(const ConstraintFlips& flips, const SpatialOrderView& order)
  {
    for (const auto& [from, to] : flips.GetSegments())
    {
      this->Target.Edges.push_back(order.GetVertex(from));
      this->Target.Edges.push_back(order.GetVertex(to));
    }
  }

  void Store(EdgeMesh& edges, const SpatialOrderView& order)
  {
    const std::int64_t count = edges.NumberOfTriangles;
    const bool isNarrow = this->Mesh.Triangles.Ids32 != nullptr;
    this->Target.Ids32.resize(isNarrow ? 3 * count : 0);
    this->Target.Ids64.resize(isNarrow ? 0 : 3 * count);
    this->Backend.StoreTriangles(isNarrow ? MutableTriangleArray(this->Target.Ids32.data(), count)
                                          : MutableTriangleArray(this->Target.Ids64.data(), count),
      StoreStep{ edges.Triangles.Data(), order });
    for (std::int64_t t = 0; t < count; ++t)
    {
      const TriangleRecord& triangle = edges.Triangles[t];
      const auto flips = static_cast<std::int32_t>(triangle.Flips / OneFlip);
      if (flips > 0)
      {
        this->Target.FlipCounts.emplace_back(triangle.InputTriangle, flips);
      }
    }
  }

  void Refuse(std::int64_t constraint, Refusal refusal)
  {
    const std::int64_t* ends = this->Mesh.ConstraintEdges + 2 * constraint;
    this->Target.Refused.push_back({ { ends[0], ends[1] }, refusal });
  }

  ConstraintInsertion& Target;
  const TriangleMesh& Mesh;
  const FlipOptions& Options;
  const ProgressObserver& Progress;
  const ThreadBackend Backend;
  MissingConstraints Missing;
};

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

ConstraintInsertion::ConstraintInsertion(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
{
  if (mesh.ConstraintsToInsert && mesh.NumberOfConstraintEdges > 0)
  {
    ConstraintInserter(*this, mesh, options, progress).Run();
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
