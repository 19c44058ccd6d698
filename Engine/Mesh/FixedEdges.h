// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FIXEDEDGES_H
#define DELAUNAYFLIP_FIXEDEDGES_H

#include "Atomics.h"
#include "Defects.h"
#include "EdgeMesh.h"
#include "EdgeMeshSteps.h"
#include "EdgeTable.h"
#include "FlipError.h"
#include "FlipReport.h"
#include "InputChecks.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "WideAngles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

/// @file
/// Decides which edges stay; done once, while the edge mesh is built.

namespace delaunayflip
{

struct EdgeMeshInput
{
  const MeshInput& Input;
  const MeshSurvey& Survey;
  const SpatialOrder& Order;
  double FeatureAngle; ///< Degrees; 180 fixes none. Surfaces only.
};

struct EdgeMeshResult
{
  EdgeMesh Edges;
  EdgeTable Table; ///< Vertex pairs of all edges, without words; or empty.
  EdgeCounts Counts;
  Defect DuplicateTriangles;
  std::int64_t MissingConstraints = 0;
};

/// Whether no edge of a triangle may flip: by request of the caller, because of a repeated id, or
/// because a coordinate is not finite. `uses` may be null if all coordinates are finite.
DELAUNAYFLIP_HOST_DEVICE inline bool IsUntouchable(
  const TriangleMesh& mesh, const PointUse* uses, TriangleId inputTriangle)
{
  const std::int64_t p = mesh.Triangles.Get(inputTriangle, 0);
  const std::int64_t q = mesh.Triangles.Get(inputTriangle, 1);
  const std::int64_t r = mesh.Triangles.Get(inputTriangle, 2);
  return (mesh.FrozenTriangles && mesh.FrozenTriangles[inputTriangle] != 0) || p == q || q == r ||
    r == p ||
    (uses &&
      (uses[p] == PointUse::NotFinite || uses[q] == PointUse::NotFinite ||
        uses[r] == PointUse::NotFinite));
}

/// Why edges were fixed. Edges are counted, a non-manifold one once.
struct FixedSums
{
  std::int64_t Boundary = 0, WronglyWound = 0, Feature = 0, Region = 0, Fixed = 0;
  std::int64_t Duplicate = 0; ///< Between two triangles on the same three points.
  std::int64_t OneOfMany = 0; ///< Edge records of non-manifold edges.

  DELAUNAYFLIP_HOST_DEVICE FixedSums& operator+=(const FixedSums& part)
  {
    this->Boundary += part.Boundary;
    this->WronglyWound += part.WronglyWound;
    this->Feature += part.Feature;
    this->Region += part.Region;
    this->Duplicate += part.Duplicate;
    this->Fixed += part.Fixed;
    this->OneOfMany += part.OneOfMany;
    return *this;
  }
};

/// Fixes one edge if topology, the caller or the shape of the input demand it, and counts it.
struct FixEdgeStep
{
  EdgeMeshView Mesh;
  const std::int32_t* Regions; ///< Or null.
  PointArray Points;
  SpatialOrderView Order;
  CoordinateRange Range;
  bool HasFeatures; ///< Sharp edges stay.
  double FeatureCosine;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t edge) const
  {
    PrefetchTriangles(this->Mesh, static_cast<EdgeId>(edge));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, FixedSums& sums) const
  {
    const auto edge = static_cast<EdgeId>(i);
    const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * edge];
    const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corner)];
    if (IsLoop(triangle, SlotOf(corner)))
    {
      // A loop of a triangle with a repeated id is not an edge, and not counted.
      this->Mesh.States[edge] = EdgeState::Fixed;
      return;
    }
    const CornerRole role = GetRole(triangle, SlotOf(corner));
    sums.Boundary += role == CornerRole::Alone ? 1 : 0;
    sums.OneOfMany += role == CornerRole::OneOfMany ? 1 : 0;
    if (role != CornerRole::Leader || this->MustStay(edge, sums))
    {
      this->Mesh.States[edge] = EdgeState::Fixed;
      ++sums.Fixed;
    }
  }

private:
  /// Whether an edge of two triangles must stay.
  DELAUNAYFLIP_HOST_DEVICE bool MustStay(EdgeId edge, FixedSums& sums) const
  {
    const Quad quad = this->Mesh.GetQuad(edge);
    const TriangleRecord& a = this->Mesh.Triangles[TriangleOf(quad.CornerA)];
    const TriangleRecord& b = this->Mesh.Triangles[TriangleOf(quad.CornerB)];
    const bool wronglyWound = quad.P != GetAt(b.Vertices, PreviousSlot(SlotOf(quad.CornerB)));
    const bool duplicate = quad.A == quad.B;
    const bool region =
      this->Regions && this->Regions[a.InputTriangle] != this->Regions[b.InputTriangle];
    const bool feature = this->HasFeatures && !wronglyWound &&
      this->IsFeature({ this->GetPoint(quad.A), this->GetPoint(quad.P), this->GetPoint(quad.Q),
        this->GetPoint(quad.B) });
    sums.WronglyWound += wronglyWound ? 1 : 0;
    sums.Region += region ? 1 : 0;
    sums.Duplicate += duplicate ? 1 : 0;
    sums.Feature += feature ? 1 : 0;
    return wronglyWound || duplicate || region || feature ||
      ((a.Flips | b.Flips) & UntouchableBit) != 0;
  }

  DELAUNAYFLIP_HOST_DEVICE Vector3 GetPoint(VertexId rank) const
  {
    return LoadPoint(this->Points, this->Order.GetVertex(rank));
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsFeature(const QuadPoints& quad) const
  {
    return IsWide(this->Range, quad) ? IsSharpWide(quad, this->FeatureCosine)
                                     : IsSharp(quad, this->FeatureCosine);
  }
};

/// @returns whether a triangle may have the same points as another one.
template <typename Backend>
bool FixByInput(const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  const bool hasFeatures =
    input.Survey.Geometry == GeometryKind::Surface && input.FeatureAngle < 180.0;
  const FixEdgeStep step{ result.Edges.View(), input.Input.Local.Regions, input.Input.Local.Points,
    input.Order.View(), input.Survey.Range, hasFeatures,
    std::cos(input.FeatureAngle * DegreesToRadians) };
  const FixedSums sums = backend.template Sum<FixedSums>(result.Edges.NumberOfEdges, step);
  EdgeCounts& counts = result.Counts;
  counts.Boundary = sums.Boundary;
  counts.WronglyWound = sums.WronglyWound;
  counts.Feature = sums.Feature;
  counts.Region = sums.Region;
  counts.Fixed = sums.Fixed - sums.OneOfMany + counts.NonManifold;
  return counts.NonManifold > 0 || sums.Duplicate > 0 || input.Survey.RepeatedIds.Count > 0;
}

/// Whether every edge of a triangle has more than two triangles, or two on the same three points.
/// This holds for every triangle with a duplicate.
DELAUNAYFLIP_HOST_DEVICE inline bool MayBeRepeated(const EdgeMeshView& mesh, std::int64_t t)
{
  const TriangleRecord& triangle = mesh.Triangles[t];
  bool may = true;
  for (int slot = 0; slot < 3 && may; ++slot)
  {
    const CornerRole role = GetRole(triangle, slot);
    may = role == CornerRole::OneOfMany;
    if (role == CornerRole::Leader || role == CornerRole::Follower)
    {
      const Quad quad = mesh.GetQuad(EdgeOf(triangle.HalfEdges[slot]));
      may = quad.A == quad.B;
    }
  }
  return may;
}

/// Lists the triangles that may have a duplicate, in any order: none in a clean mesh.
template <typename Backend>
std::vector<TriangleRecord> FindSuspects(EdgeMesh& edges, const Backend& backend)
{
  const EdgeMeshView mesh = edges.View();
  const std::int64_t count = backend.template Sum<std::int64_t>(edges.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t & sum)
    { sum += MayBeRepeated(mesh, t) ? 1 : 0; });
  std::vector<TriangleRecord> suspects(count);
  if (count == 0)
  {
    return suspects;
  }
  Array<TriangleRecord> found = backend.template MakeArray<TriangleRecord>(count);
  Array<std::uint32_t> cursor = backend.template MakeArray<std::uint32_t>(1);
  TriangleRecord* records = found.Data();
  std::uint32_t* next = cursor.Data();
  backend.ForEach(1, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t) { *next = 0; });
  backend.ForEach(edges.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    {
      if (MayBeRepeated(mesh, t))
      {
        records[AtomicAdd(next, 1u)] = mesh.Triangles[t];
      }
    });
  backend.Download(records, count, suspects.data());
  return suspects;
}

/// The triangles with the same points as one in a smaller slot.
inline Defect FindDuplicates(std::vector<TriangleRecord> suspects)
{
  const auto pointsOf = [](const TriangleRecord& t)
  { return std::tie(t.Vertices[0], t.Vertices[1], t.Vertices[2]); };
  for (TriangleRecord& triangle : suspects)
  {
    std::sort(triangle.Vertices, triangle.Vertices + 3);
  }
  std::sort(suspects.begin(), suspects.end(),
    [&](const TriangleRecord& s, const TriangleRecord& t)
    {
      return std::make_tuple(pointsOf(s), s.InputTriangle) <
        std::make_tuple(pointsOf(t), t.InputTriangle);
    });
  IdSample repeated;
  for (std::size_t i = 1; i < suspects.size(); ++i)
  {
    if (pointsOf(suspects[i]) == pointsOf(suspects[i - 1]))
    {
      repeated.Note(suspects[i].InputTriangle);
    }
  }
  return MakeDefect("triangles that repeat another one's points", repeated);
}

inline std::int64_t CheckConstraint(const TriangleMesh& mesh, std::int64_t constraint, int end)
{
  const std::int64_t point = mesh.ConstraintEdges[2 * constraint + end];
  if (point < 0 || point >= mesh.Points.Count)
  {
    throw InvalidMesh("constraint edge " + std::to_string(constraint) + " names point " +
        std::to_string(point) + ", but the mesh has " + DescribePoints(mesh.Points.Count),
      constraint, point);
  }
  return point;
}

struct ConstraintSums
{
  std::int64_t Found = 0, Missing = 0, NewlyFixed = 0;

  DELAUNAYFLIP_HOST_DEVICE ConstraintSums& operator+=(const ConstraintSums& part)
  {
    this->Found += part.Found;
    this->Missing += part.Missing;
    this->NewlyFixed += part.NewlyFixed;
    return *this;
  }
};

/// Fixes the edge between two points, if there is one. A repeated constraint counts once.
DELAUNAYFLIP_HOST_DEVICE inline void FixConstraint(const EdgeTableView& table,
  const EdgeMeshView& mesh, VertexId a, VertexId b, ConstraintSums& sums)
{
  const std::uint32_t slot = a == b ? EdgeTableView::NoSlot : table.Find(EdgeKey(a, b));
  if (slot == EdgeTableView::NoSlot)
  {
    sums.Missing += a == b ? 0 : 1;
    return;
  }
  constexpr CornerId Seen = 0xFFFFFFFDu;
  const CornerId second = AtomicExchange(&table.Second[slot], Seen);
  sums.Found += second == Seen ? 0 : 1;
  if (second != Seen && second != ManyCorners)
  {
    const CornerId corner = table.First[slot];
    const EdgeId edge = EdgeOf(mesh.Triangles[TriangleOf(corner)].HalfEdges[SlotOf(corner)]);
    sums.NewlyFixed += mesh.States[edge] == EdgeState::Fixed ? 0 : 1;
    mesh.States[edge] = EdgeState::Fixed;
  }
}

template <typename Backend>
void FixConstraints(const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  const TriangleMesh& caller = input.Input.Caller;
  const std::int64_t count = caller.NumberOfConstraintEdges;
  if (count == 0)
  {
    return;
  }
  std::vector<std::uint32_t> ends(2 * count);
  for (std::int64_t i = 0; i < 2 * count; ++i)
  {
    ends[i] = static_cast<std::uint32_t>(CheckConstraint(caller, i / 2, static_cast<int>(i % 2)));
  }
  Array<std::uint32_t> local = backend.template MakeArray<std::uint32_t>(2 * count);
  std::uint32_t* points = local.Data();
  backend.Upload(ends.data(), 2 * count, points);
  const EdgeTableView table = result.Table.View();
  const SpatialOrderView order = input.Order.View();
  const EdgeMeshView mesh = result.Edges.View();
  const ConstraintSums sums = backend.template Sum<ConstraintSums>(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, ConstraintSums & part)
    {
      FixConstraint(
        table, mesh, order.GetRank(points[2 * i]), order.GetRank(points[2 * i + 1]), part);
    });
  result.Counts.Constraint = sums.Found;
  result.Counts.Fixed += sums.NewlyFixed;
  result.MissingConstraints = sums.Missing;
}

/// Fixes edges and counts why, by the roles that the builder left in Flips.
template <typename Backend>
void FixEdges(const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  if (FixByInput(input, result, backend))
  {
    result.DuplicateTriangles = FindDuplicates(FindSuspects(result.Edges, backend));
  }
  FixConstraints(input, result, backend);
}

}

#endif
