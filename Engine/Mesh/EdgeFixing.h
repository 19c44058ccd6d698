// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEFIXING_H
#define DELAUNAYFLIP_EDGEFIXING_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipError.h"
#include "FlipReport.h"
#include "InputChecks.h"
#include "MeshSurvey.h"
#include "PortableMath.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "WideAngles.h"

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Decides which edges of a new edge mesh stay: by topology, regions, feature angle and
/// constraints.

namespace delaunayflip
{

struct EdgeMeshInput
{
  const MeshInput& Input;
  const MeshSurvey& Survey;
  const SpatialOrder& Order;
  double FeatureAngle; ///< Degrees; 180 fixes none. Surfaces only.
  PointArray Packed = {}; ///< The points of a surface by rank, or none if they are not packed yet.
};

struct EdgeMeshResult
{
  EdgeMesh Edges;
  EdgeTable Table; ///< Vertex pairs of all edges; or empty.
  EdgeCounts Counts;
  Defect DuplicateTriangles;
  std::int64_t MissingConstraints = 0;
};

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
  const std::int32_t* Regions; ///< One per triangle, or null.
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
    const CornerRole role = GetRole(triangle, SlotOf(corner));
    if (role == CornerRole::OneOfMany && !HasEdges(triangle))
    {
      this->Mesh.States[edge] = EdgeState::Fixed; // and not counted
      return;
    }
    sums.Boundary += int(role == CornerRole::Alone);
    sums.OneOfMany += int(role == CornerRole::OneOfMany);
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
    const bool feature = this->HasFeatures && !wronglyWound && this->IsFeature(quad);
    sums.WronglyWound += int(wronglyWound);
    sums.Region += int(region);
    sums.Duplicate += int(duplicate);
    sums.Feature += int(feature);
    return wronglyWound || duplicate || region || feature ||
      ((a.Flips | b.Flips) & UntouchableBit) != 0;
  }

  /// Whether the edge of a quad is sharper than the feature angle.
  DELAUNAYFLIP_HOST_DEVICE bool IsFeature(const Quad& quad) const
  {
    const auto load = [this](VertexId rank)
    { return LoadPoint(this->Points, this->Order.GetVertex(rank)); };
    const QuadPoints points{ load(quad.A), load(quad.P), load(quad.Q), load(quad.B) };
    if (IsWide(this->Range, points))
    {
      return IsSharpWide(points, this->FeatureCosine);
    }
    return IsSharp(points, this->FeatureCosine);
  }
};

/// @returns whether a triangle may have the same points as another one.
template <typename Backend>
bool FixByInput(const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  const bool hasFeatures =
    input.Survey.Geometry == GeometryKind::Surface && input.FeatureAngle < 180.0;
  double featureCosine = 0.0;
  if (hasFeatures)
  {
    featureCosine = Cosine(input.FeatureAngle * DegreesToRadians);
  }
  FixEdgeStep step{ result.Edges.View(), input.Input.Local.Regions, input.Input.Local.Points,
    input.Order.View(), input.Survey.Range, hasFeatures, featureCosine };
  if (input.Packed.Count > 0)
  {
    step.Points = input.Packed;
    step.Order = SpatialOrderView{};
  }
  const FixedSums sums = backend.template Sum<FixedSums>(result.Edges.NumberOfEdges, step);
  EdgeCounts& counts = result.Counts;
  counts.Boundary = sums.Boundary;
  counts.WronglyWound = sums.WronglyWound;
  counts.Feature = sums.Feature;
  counts.Region = sums.Region;
  counts.Fixed = sums.Fixed - sums.OneOfMany + counts.NonManifold;
  return counts.NonManifold > 0 || sums.Duplicate > 0 || input.Survey.RepeatedIds.Count > 0;
}

/// @throws InvalidMesh.
inline void CheckConstraints(const TriangleMesh& mesh)
{
  for (std::int64_t i = 0; i < 2 * mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t point = mesh.ConstraintEdges[i];
    if (point < 0 || point >= mesh.Points.Count)
    {
      throw InvalidMesh("constraint edge " + std::to_string(i / 2) + " names point " +
          std::to_string(point) + ", but the mesh has " + DescribePoints(mesh.Points.Count),
        i / 2, point);
    }
  }
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

/// Fixes the edges that are constraints. A repeated constraint counts once.
template <typename Backend>
void FixConstraints(const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  const TriangleMesh& caller = input.Input.Caller;
  const std::int64_t count = caller.NumberOfConstraintEdges;
  CheckConstraints(caller);
  const std::vector<std::uint32_t> ends(caller.ConstraintEdges, caller.ConstraintEdges + 2 * count);
  Array<std::uint32_t> local = backend.template MakeArray<std::uint32_t>(2 * count);
  std::uint32_t* points = local.Data();
  backend.Upload(ends.data(), 2 * count, points);
  const EdgeTableView table = result.Table.View();
  const SpatialOrderView order = input.Order.View();
  const EdgeMeshView mesh = result.Edges.View();
  const ConstraintSums sums = backend.template Sum<ConstraintSums>(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, ConstraintSums & part)
    {
      const VertexId a = order.GetRank(points[2 * i]), b = order.GetRank(points[2 * i + 1]);
      if (a == b)
      {
        return;
      }
      const std::uint32_t slot = table.Find(EdgeKey(a, b));
      if (slot == EdgeTableView::NoSlot)
      {
        ++part.Missing;
        return;
      }
      constexpr CornerId Seen = 0xFFFFFFFDu;
      const CornerId second = AtomicExchange(&table.Second[slot], Seen);
      part.Found += int(second != Seen);
      if (second != Seen && second != ManyCorners)
      {
        const CornerId corner = table.First[slot];
        const EdgeId edge = EdgeOf(mesh.Triangles[TriangleOf(corner)].HalfEdges[SlotOf(corner)]);
        part.NewlyFixed += int(mesh.States[edge] != EdgeState::Fixed);
        mesh.States[edge] = EdgeState::Fixed;
      }
    });
  result.Counts.Constraint = sums.Found;
  result.Counts.Fixed += sums.NewlyFixed;
  result.MissingConstraints = sums.Missing;
}

}

#endif
