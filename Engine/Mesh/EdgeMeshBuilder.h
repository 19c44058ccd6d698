// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHBUILDER_H
#define DELAUNAYFLIP_EDGEMESHBUILDER_H

#include "Atomics.h"
#include "BuildProgress.h"
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

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Makes an edge mesh of triangles, in linear time whatever the vertex degrees, and decides which
/// edges stay.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// Which edges stay.

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

/// The vertices of a triangle, ascending, and the caller's slot of it.
struct SortedTriangle
{
  std::uint32_t Vertices[3];
  std::uint32_t Slot;

  DELAUNAYFLIP_HOST_DEVICE explicit SortedTriangle(const TriangleRecord& triangle)
    : Slot(triangle.InputTriangle)
  {
    const std::uint32_t* v = triangle.Vertices;
    const std::uint32_t low = std::min(v[0], v[1]);
    const std::uint32_t high = std::max(v[0], v[1]);
    this->Vertices[0] = std::min(low, v[2]);
    this->Vertices[1] = std::max(low, std::min(high, v[2]));
    this->Vertices[2] = std::max(high, v[2]);
  }
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetHash() const
  {
    return Scatter(this->Vertices[0] + Scatter(this->Vertices[1] + Scatter(this->Vertices[2])));
  }
  DELAUNAYFLIP_HOST_DEVICE bool HasVerticesOf(const SortedTriangle& other) const
  {
    return this->Vertices[0] == other.Vertices[0] && this->Vertices[1] == other.Vertices[1] &&
      this->Vertices[2] == other.Vertices[2];
  }
};

/// Finds the `suspects` that have the vertices of one in a smaller slot.
template <typename Backend>
IdSample FindRepeated(const SortedTriangle* suspects, std::int64_t count, const Backend& backend)
{
  constexpr int KeyBits = 32;
  const Array<std::uint32_t> bySlot = backend.template SortIndices<KeyBits>(
    count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return suspects[i].Slot; });
  const std::uint32_t* suspectOf = bySlot.Data();
  // Equal triangles become neighbours, and those in smaller slots come first.
  const Array<std::uint32_t> byHash = backend.template SortIndices<KeyBits>(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return suspects[suspectOf[i]].GetHash(); });
  const std::uint32_t* rankOf = byHash.Data();
  return backend.template Sum<IdSample>(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, IdSample & sum)
    {
      const SortedTriangle own = suspects[suspectOf[rankOf[i]]];
      for (std::int64_t j = i - 1; j >= 0; --j)
      {
        const SortedTriangle& before = suspects[suspectOf[rankOf[j]]];
        if (before.HasVerticesOf(own))
        {
          sum.Note(own.Slot);
          return;
        }
        if (before.GetHash() != own.GetHash())
        {
          return;
        }
      }
    });
}

/// The triangles with the same points as one in a smaller slot.
template <typename Backend>
Defect FindDuplicates(EdgeMesh& edges, const Backend& backend)
{
  const EdgeMeshView mesh = edges.View();
  const auto count = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
  { return int(MayBeRepeated(mesh, t)); };
  const typename Backend::Numbering numbering = backend.Count(edges.NumberOfTriangles, count);
  IdSample repeated; // none in a clean mesh
  if (numbering.Total > 0)
  {
    Array<SortedTriangle> found = backend.template MakeArray<SortedTriangle>(numbering.Total);
    SortedTriangle* suspects = found.Data();
    backend.ForEachNumbered(numbering, edges.NumberOfTriangles, count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      {
        if (MayBeRepeated(mesh, t))
        {
          suspects[number] = SortedTriangle(mesh.Triangles[t]);
        }
      });
    repeated = FindRepeated(suspects, numbering.Total, backend);
  }
  return MakeDefect(DefectKind::DuplicateTriangles, repeated);
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
  if (count == 0)
  {
    return;
  }
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

//------------------------------------------------------------------------------

/// Finds or makes the table entries of the edges opposite corners 3 * triangle + slot, if they are
/// of the table's slice, and adds the corners to them.
struct PairStep
{
  EdgeTableView Table;
  TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t i) const
  {
    this->Table.Prefetch(KeyOpposite(this->Triangles[i / 3], static_cast<int>(i % 3)));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, PairSums& sums) const
  {
    TriangleRecord& triangle = this->Triangles[i / 3];
    const int slot = static_cast<int>(i % 3);
    const std::uint64_t key = KeyOpposite(triangle, slot);
    // A table that has failed once is discarded.
    if (sums.Failures > 0 || !this->Table.Slice.Holds(key))
    {
      return;
    }
    bool inserted = false;
    const std::uint32_t entry = this->Table.FindOrInsert(key, inserted);
    if (entry == EdgeTableView::NoSlot)
    {
      ++sums.Failures;
      return;
    }
    const CornerId corner = MakeCorner(static_cast<TriangleId>(i / 3), slot);
    bool many = false; // this makes the edge non-manifold
    if (inserted)
    {
      this->Table.First[entry] = corner; // the first word belongs to the corner that inserted it
    }
    else
    {
      CornerId* second = &this->Table.Second[entry];
      many = AtomicCompareExchange(second, NoCorner, corner) != NoCorner &&
        AtomicExchange(second, ManyCorners) != ManyCorners;
    }
    sums.Edges += int(IsKeyOfEdge(key) && inserted);
    sums.NonManifold += int(IsKeyOfEdge(key) && many);
    triangle.HalfEdges[slot] = entry;
  }
};

/// Replaces table slots by the roles of a triangle's corners and the edges' other corners, for the
/// edges of the table's slice.
/// @returns the number of edges that the triangle leads, as far as roles are known.
struct RoleStep
{
  EdgeTableView Table;
  TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const std::uint32_t entry : this->Triangles[t].HalfEdges)
    {
      delaunayflip::Prefetch(&this->Table.First[entry]);
      delaunayflip::Prefetch(&this->Table.Second[entry]);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t t) const
  {
    TriangleRecord& triangle = this->Triangles[t];
    const bool hasEdges = HasEdges(triangle);
    // All three are read before anything is written, so that the loads overlap.
    bool known[3];
    CornerId others[3] = {};
    for (int slot = 0; slot < 3; ++slot)
    {
      known[slot] = this->Table.Slice.Holds(KeyOpposite(triangle, slot));
      if (known[slot])
      {
        const CornerId corner = MakeCorner(static_cast<TriangleId>(t), slot);
        const CornerId first = this->Table.First[triangle.HalfEdges[slot]];
        const CornerId second = this->Table.Second[triangle.HalfEdges[slot]];
        const bool isPair = second != NoCorner && second != ManyCorners;
        others[slot] = isPair && first != corner ? first : second;
      }
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      if (known[slot])
      {
        SetRole(triangle, t, slot, hasEdges ? others[slot] : ManyCorners);
      }
    }
    return CountLeaders(triangle);
  }
};

/// Numbers the edges that a triangle leads, from `next` on.
struct NumberStep
{
  EdgeMeshView Mesh;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    const TriangleRecord& triangle = this->Mesh.Triangles[t];
    for (int slot = 0; slot < 3; ++slot)
    {
      if (GetRole(triangle, slot) == CornerRole::Leader)
      {
        delaunayflip::Prefetch(&this->Mesh.Triangles[TriangleOf(triangle.HalfEdges[slot])]);
      }
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, std::int64_t first) const
  {
    ConstTriangleAccess triangle = this->Mesh.Triangles[t];
    auto next = static_cast<EdgeId>(first);
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerRole role = GetRole(triangle, slot);
      if (role != CornerRole::Follower)
      {
        if (this->Mesh.States)
        {
          this->Mesh.States[next] =
            role == CornerRole::Leader ? EdgeState::Candidate : EdgeState::Fixed;
        }
        const CornerId other = triangle.HalfEdges[slot];
        this->Mesh.SetCorners(next, { MakeCorner(static_cast<TriangleId>(t), slot), other });
        this->Mesh.Triangles[t].HalfEdges[slot] = 2 * next;
        if (other != NoCorner)
        {
          this->Mesh.Triangles[TriangleOf(other)].HalfEdges[SlotOf(other)] = 2 * next + 1;
        }
        ++next;
      }
    }
  }
};

/// A triangle with its vertices in the engine's order and its fixed bit.
struct LoadStep
{
  TriangleMesh Mesh;
  SpatialOrderView Order;
  const PointUse* Uses; ///< Null: all points are finite.
  TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    constexpr std::int64_t Further = 32; // when this prefetches what the ids of a triangle name
    const std::int64_t far = std::min(t + Further, this->Mesh.Triangles.Count - 1);
    this->Mesh.Triangles.Prefetch(this->Order.GetTriangle(far));
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t vertex = this->Mesh.Triangles.Get(this->Order.GetTriangle(t), slot);
      if (this->Order.RankOfVertex)
      {
        delaunayflip::Prefetch(&this->Order.RankOfVertex[vertex]);
      }
      if (this->Uses)
      {
        delaunayflip::Prefetch(&this->Uses[vertex]);
      }
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t) const
  {
    TriangleRecord& record = this->Triangles[t];
    const TriangleId own = this->Order.GetTriangle(t);
    const std::int64_t p = this->Mesh.Triangles.Get(own, 0);
    const std::int64_t q = this->Mesh.Triangles.Get(own, 1);
    const std::int64_t r = this->Mesh.Triangles.Get(own, 2);
    // Its edges must not flip: the caller says so, it has a repeated id, or a coordinate is not
    // finite.
    const bool isUntouchable =
      (this->Mesh.FrozenTriangles && this->Mesh.FrozenTriangles[own] != 0) || p == q || q == r ||
      r == p ||
      (this->Uses &&
        (this->Uses[p] == PointUse::NotFinite || this->Uses[q] == PointUse::NotFinite ||
          this->Uses[r] == PointUse::NotFinite));
    record.InputTriangle = own;
    record.Flips = int(isUntouchable) * UntouchableBit;
    record.Vertices[0] = this->Order.GetRank(p);
    record.Vertices[1] = this->Order.GetRank(q);
    record.Vertices[2] = this->Order.GetRank(r);
  }
};

/// Loads the triangles in the engine's order, with which an edge mesh begins. After this the ids of
/// the input and the order of its triangles are not needed any more.
template <typename Backend>
EdgeMesh LoadTriangles(const EdgeMeshInput& input, const Backend& backend)
{
  EdgeMesh edges;
  const TriangleMesh mesh = input.Input.Local;
  const SpatialOrderView order = input.Order.View();
  const PointUse* uses = input.Survey.GetUsesIfNeeded();
  edges.NumberOfTriangles = mesh.Triangles.Count;
  edges.Triangles = backend.template MakeArray<TriangleRecord>(mesh.Triangles.Count);
  TriangleRecord* triangles = edges.Triangles.Data();
  backend.ForEach(mesh.Triangles.Count, LoadStep{ mesh, order, uses, triangles });
  return edges;
}

/// Pairs the corners slice by slice, and numbers the edges. @returns whether all tables, for
/// `expected` edges together, were large enough.
template <typename Backend>
bool TryPairSlices(EdgeMeshResult& result, std::int64_t vertices, std::int64_t slices,
  std::int64_t expected, typename Backend::Numbering& numbering, const Backend& backend)
{
  TriangleRecord* records = result.Edges.Triangles.Data();
  const std::int64_t triangles = result.Edges.NumberOfTriangles;
  result.Counts.Edges = 0;
  result.Counts.NonManifold = 0;
  for (std::int64_t i = 0; i < slices; ++i)
  {
    const VertexSlice slice{ static_cast<VertexId>(vertices * i / slices),
      static_cast<VertexId>(vertices * (i + 1) / slices) };
    result.Table = EdgeTable(); // frees the memory first
    result.Table = EdgeTable(expected / slices, slice, backend);
    const PairSums sums =
      backend.template Sum<PairSums>(3 * triangles, PairStep{ result.Table.View(), records });
    result.Counts.Edges += sums.Edges;
    result.Counts.NonManifold += sums.NonManifold;
    // With a larger share of slots in use, later searches would be long.
    constexpr double LargestFill = 0.8;
    const auto capacity = static_cast<double>(result.Table.GetCapacity());
    if (sums.Failures > 0 || static_cast<double>(sums.Edges) > LargestFill * capacity)
    {
      return false;
    }
    const RoleStep setRoles{ result.Table.View(), records };
    if (i + 1 < slices)
    {
      backend.ForEach(triangles, setRoles);
    }
    else
    {
      numbering = backend.Count(triangles, setRoles);
    }
  }
  return true;
}

/// Finds the other corner of every corner's edge, and the roles, by the edge table.
/// @param slices into how many slices the vertices are divided. Their tables are used one after the
/// other, which saves memory. If some slice has more edges than its share, one table is used for
/// all.
/// @returns the numbering of the edges.
template <typename Backend>
typename Backend::Numbering PairByTable(
  const EdgeMeshInput& input, EdgeMeshResult& result, std::int64_t slices, const Backend& backend)
{
  const std::int64_t vertices = input.Input.Local.Points.Count;
  const std::int64_t corners = 3 * result.Edges.NumberOfTriangles;
  typename Backend::Numbering numbering;
  std::int64_t expected = corners / 2 + corners / 100;
  while (expected <= 4 * corners + 4)
  {
    if (TryPairSlices(result, vertices, slices, std::min(expected, corners), numbering, backend))
    {
      return numbering;
    }
    if (slices == 1)
    {
      expected = 2 * expected + 1;
    }
    slices = 1;
  }
  throw std::logic_error("the edge table runs full; please report this with the mesh");
}

/// Finds the other corner of every corner's edge, in the way that suits the backend.
/// @returns the numbering of the edges.
template <typename Backend>
typename Backend::Numbering PairCorners(
  const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  // Constraints are searched for in this table. A guard makes its own, which needs no words.
  if (input.Input.Caller.NumberOfConstraintEdges > 0)
  {
    return PairByTable(input, result, 1, backend);
  }
  typename Backend::Numbering numbering;
  PairSums sums;
  if (backend.PairCorners(result.Edges, input.Input.Local.Points.Count, sums, numbering))
  {
    result.Counts.Edges = sums.Edges;
    result.Counts.NonManifold = sums.NonManifold;
    return numbering;
  }
  // Slices take time, which matters in small meshes; but surfaces take most memory.
  constexpr std::int64_t SmallestSliced = std::int64_t(1) << 20; // triangles
  constexpr std::int64_t SmallestHalved = std::int64_t(1) << 17; // triangles of a surface
  const std::int64_t triangles = result.Edges.NumberOfTriangles;
  int slices = 1;
  if (triangles >= SmallestSliced)
  {
    slices = backend.CountTableSlices();
  }
  else if (triangles >= SmallestHalved && input.Survey.Geometry == GeometryKind::Surface)
  {
    slices = std::min(backend.CountTableSlices(), 2);
  }
  numbering = PairByTable(input, result, slices, backend);
  if (Backend::MemoryIsScarce)
  {
    result.Table = EdgeTable(); // frees its memory for the rest of the mesh
  }
  return numbering;
}

/// Makes the array of states, and sets those after the last edge.
template <typename Backend>
void MakeStates(EdgeMesh& edges, const Backend& backend)
{
  const std::int64_t numberOfEdges = edges.NumberOfEdges;
  const std::int64_t padded =
    (numberOfEdges + EdgeMesh::StatePadding - 1) / EdgeMesh::StatePadding * EdgeMesh::StatePadding;
  edges.States = backend.template MakeArray<EdgeState>(padded);
  EdgeState* states = edges.States.Data();
  backend.ForEach(padded - numberOfEdges,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { states[numberOfEdges + i] = EdgeState::Fixed; });
}

/// @param hasStates whether edges have states; else those with one triangle are fixed.
template <typename Backend>
void NumberEdges(EdgeMeshResult& result, const typename Backend::Numbering& numbering,
  const Backend& backend, bool hasStates = true)
{
  EdgeMesh& edges = result.Edges;
  const std::int64_t size = edges.NumberOfTriangles;
  edges.NumberOfEdges = numbering.Total;
  edges.CornerOfHalfEdge = backend.template MakeArray<CornerId>(2 * edges.NumberOfEdges);
  if (hasStates)
  {
    MakeStates(edges, backend);
  }
  const EdgeMeshView mesh = edges.View();
  backend.ForEachNumbered(
    numbering, size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { return CountLeaders(mesh.Triangles[t]); },
    NumberStep{ mesh });
}

/// Pairs the corners of triangles and fixes the edges that must stay: boundary, non-manifold and
/// wrongly wound edges, edges of triangles that are frozen, duplicate or not finite, region
/// borders, feature edges and constraints. All others are candidates. Triangles that name a point
/// twice stay, and have no edges.
///
/// EdgeId = rank of the edge's smallest incident corner in the engine's order, on every backend.
/// @param loaded made by LoadTriangles.
/// @throws InvalidMesh if a constraint names a point that does not exist; RunAborted.
template <typename Backend>
EdgeMeshResult BuildEdgeMesh(const EdgeMeshInput& input, EdgeMesh loaded, const Backend& backend,
  const BuildProgress& progress = BuildProgress())
{
  EdgeMeshResult result;
  result.Edges = std::move(loaded);
  {
    const typename Backend::Numbering numbering = PairCorners(input, result, backend);
    progress.Reach(input.Survey.Geometry, BuildStep::Paired);
    NumberEdges(result, numbering, backend);
  }
  progress.Reach(input.Survey.Geometry, BuildStep::Numbered);
  if (FixByInput(input, result, backend))
  {
    result.DuplicateTriangles = FindDuplicates(result.Edges, backend);
  }
  FixConstraints(input, result, backend);
  return result;
}

}

#endif
