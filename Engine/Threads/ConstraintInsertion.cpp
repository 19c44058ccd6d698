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
constexpr DefectKind Reasons[] = { DefectKind::ConstraintsLeaveMesh,
  DefectKind::ConstraintsLeavePart, DefectKind::ConstraintsCross,
  DefectKind::ConstraintsMeetOverlap, DefectKind::ConstraintsNeedGuard,
  DefectKind::ConstraintsOnSurface };

Refusal ToRefusal(PathResult result)
{
  switch (result)
  {
    case PathResult::LeavesMesh:
      return Refusal::LeavesMesh;
    case PathResult::CrossesFixedEdge:
      return Refusal::CrossesFixedEdge;
    default:
      return Refusal::MeetsOverlap;
  }
}

}

void AddDefects(const std::vector<RefusedConstraint>& refused, std::vector<Defect>& defects)
{
  for (std::size_t i = 0; i < std::size(Reasons); ++i)
  {
    Defect defect(Reasons[i]);
    for (const RefusedConstraint& one : refused)
    {
      if (one.Why == static_cast<Refusal>(i) && defect.Count++ < MostNamedIds)
      {
        defect.FirstIds.insert(defect.FirstIds.end(), std::begin(one.Ends), std::end(one.Ends));
        if (one.Why == Refusal::CrossesFixedEdge)
        {
          defect.Crossed.push_back(one.Crossed);
        }
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
  return std::any_of(
    flags, flags + edges.NumberOfConstraintEdges, [](unsigned char flag) { return flag != 0; });
}

MissingConstraints FindMissingConstraints(const TriangleMesh& mesh, const ThreadBackend& backend)
{
  const auto toKey = [](std::int64_t from, std::int64_t to)
  { return EdgeKey(static_cast<VertexId>(from), static_cast<VertexId>(to)); };
  CheckConstraints(mesh);
  std::vector<unsigned char> isEnd(mesh.Points.Count, 0);
  std::vector<std::uint64_t> keys; // of the edges that constraints are to become
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t from = mesh.ConstraintEdges[2 * i], to = mesh.ConstraintEdges[2 * i + 1];
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
      if (!mesh.Triangles.HasEdges(t))
      {
        return;
      }
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
    if (found < keys.size() && mesh.ConstraintsToInsert[i] != 0 && !isListed[found])
    {
      isListed[found] = true;
      missing.Wanted.push_back(i);
      if (missing.IsMissing.back())
      {
        missing.First.push_back(i);
      }
    }
  }
  return missing;
}

namespace
{
/// An edge that a constraint has become.
struct InsertedEdge
{
  VertexId From, To;
  std::int64_t Constraint; ///< Its number.
};

/// Inserts constraints into any planar mesh, one after the other.
class Inserter
{
public:
  /// @param table of the vertex pairs of all edges.
  Inserter(const PlaneMesh& mesh, std::int64_t vertices, std::int64_t triangles,
    const EdgeTableView& table)
    : Mesh(mesh),
      Table(table),
      First(vertices, NoCorner),
      Others(vertices, 0)
  {
    std::vector<bool> isKnown(4 * triangles, false);
    for (std::int64_t i = 0; i < 3 * triangles; ++i)
    {
      const CornerId corner = MakeCorner(static_cast<TriangleId>(i / 3), static_cast<int>(i % 3));
      if (!isKnown[corner] && HasEdges(mesh.Edges.Triangles[TriangleOf(corner)]))
      {
        this->AddFan(mesh.GetVertex(corner), corner);
        VertexFans::SearchFan(mesh, corner,
          [&](CornerId known)
          {
            isKnown[known] = true;
            return false;
          });
      }
    }
  }

  /// Whether there is such an edge now.
  bool HasEdge(VertexId from, VertexId to) const
  {
    return this->Table.Find(EdgeKey(from, to)) != EdgeTableView::NoSlot;
  }

  /// Makes the constraint between two vertices an edge or a chain of edges, and fixes these.
  PathResult Insert(VertexId from, VertexId to, std::int64_t constraint)
  {
    this->Crossed = NoHalfEdge;
    if (!this->Mesh.IsFinite(from) || !this->Mesh.IsFinite(to))
    {
      return PathResult::LeavesMesh;
    }
    const PlanePoint a = this->Mesh.GetPoint(from), b = this->Mesh.GetPoint(to);
    if (!IsLexicographicallyLess(a, b) && !IsLexicographicallyLess(b, a))
    {
      return PathResult::Overlaps;
    }
    ConstraintPath path{ this->Mesh, { this->First.data(), this->Others.data() }, &this->Table,
      from, to };
    const PathResult result = this->Insert(path, constraint);
    this->Flips += path.Flips;
    this->Crossed = path.Crossed;
    this->Crossings += this->HasCrossed() ? 1 : 0;
    return result;
  }

  /// The edges that constraints have become, in the order of insertion and from start to end.
  const std::vector<InsertedEdge>& GetEdges() const { return this->Edges; }
  /// Whether the last constraint crosses a fixed edge, and how many have done so.
  bool HasCrossed() const { return this->Crossed != NoHalfEdge; }
  std::int64_t GetNumberOfCrossings() const { return this->Crossings; }
  /// The ends of that edge.
  std::pair<VertexId, VertexId> GetCrossed() const
  {
    return { this->Mesh.GetStart(this->Crossed), this->Mesh.GetEnd(this->Crossed) };
  }
  std::int64_t GetNumberOfFlips() const { return this->Flips; }

private:
  void AddFan(VertexId vertex, CornerId corner)
  {
    if (this->First[vertex] == NoCorner)
    {
      this->First[vertex] = corner;
      return;
    }
    const auto added = static_cast<std::uint32_t>(this->First.size());
    this->First.push_back(corner);
    this->Others.push_back(std::exchange(this->Others[vertex], added));
  }

  PathResult Insert(ConstraintPath& path, std::int64_t constraint)
  {
    std::vector<ConstraintPath::Segment> segments;
    PathResult result = PathResult::IsBarred;
    while (result == PathResult::IsBarred)
    {
      segments.clear();
      result =
        path.Walk([&](const ConstraintPath::Segment& segment) { segments.push_back(segment); },
          [](HalfEdgeId) {});
      if (result == PathResult::IsBarred && !this->RemoveBar(path))
      {
        return PathResult::Overlaps;
      }
    }
    if (result != PathResult::Found)
    {
      return result;
    }
    if (!std::all_of(segments.begin(), segments.end(),
          [&](ConstraintPath::Segment& segment) { return path.Flip(segment); }))
    {
      return PathResult::Overlaps;
    }
    for (const ConstraintPath::Segment& segment : segments)
    {
      this->Mesh.Edges.States[EdgeOf(segment.Side)] = EdgeState::Fixed;
      this->Edges.push_back(
        { this->Mesh.GetStart(segment.Side), this->Mesh.GetEnd(segment.Side), constraint });
    }
    return result;
  }

  /// Flips a triangle without area away. If another one lies on its long side, that one goes first;
  /// its own long side is longer, so there is a last one.
  bool RemoveBar(ConstraintPath& path) const
  {
    std::vector<EdgeId> sides;
    for (TriangleId flat = path.Bar; this->Mesh.FindOrientationAt(MakeCorner(flat, 0)) == 0;)
    {
      const HalfEdgeId side = this->GetLongSide(flat);
      if (side == NoHalfEdge || this->Mesh.IsFixed(side) ||
        (!sides.empty() && sides.back() == EdgeOf(side)))
      {
        return false;
      }
      sides.push_back(EdgeOf(side));
      flat = TriangleOf(this->Mesh.FindAcross(side));
    }
    return std::all_of(
      sides.rbegin(), sides.rend(), [&](EdgeId side) { return path.TryFlip(side); });
  }

  /// Returns the side of a triangle without area that holds all three points, NoHalfEdge if two of
  /// them coincide.
  HalfEdgeId GetLongSide(TriangleId flat) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerId corner = MakeCorner(flat, slot);
      const PlanePoint at = this->Mesh.GetPoint(this->Mesh.GetVertex(corner));
      const PlanePoint next = this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Next(corner)));
      const PlanePoint previous =
        this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Previous(corner)));
      if ((IsLexicographicallyLess(next, at) && IsLexicographicallyLess(at, previous)) ||
        (IsLexicographicallyLess(previous, at) && IsLexicographicallyLess(at, next)))
      {
        return this->Mesh.GetHalfEdge(corner);
      }
    }
    return NoHalfEdge;
  }

  const PlaneMesh& Mesh;
  const EdgeTableView Table;
  std::vector<CornerId> First; ///< VertexFans::First. Others is VertexFans::Others.
  std::vector<std::uint32_t> Others;
  std::vector<InsertedEdge> Edges;
  HalfEdgeId Crossed = NoHalfEdge;
  std::int64_t Crossings = 0;
  std::int64_t Flips = 0;
};

void AddEnds(const std::vector<InsertedEdge>& edges, const SpatialOrderView& ranks,
  std::vector<std::int64_t>& ends)
{
  for (const InsertedEdge& edge : edges)
  {
    ends.insert(ends.end(), { ranks.GetVertex(edge.From), ranks.GetVertex(edge.To) });
  }
}

/// The edge that the last constraint crosses, and the first constraint that keeps it, if one does.
CrossedEdge FindCrossed(
  const TriangleMesh& mesh, const SpatialOrderView& ranks, const Inserter& flips)
{
  const auto [start, end] = flips.GetCrossed();
  CrossedEdge crossed{ -1, { ranks.GetVertex(start), ranks.GetVertex(end) } };
  const std::uint64_t key = EdgeKey(start, end);
  std::int64_t first = mesh.NumberOfConstraintEdges;
  for (const InsertedEdge& edge : flips.GetEdges())
  {
    first = EdgeKey(edge.From, edge.To) == key ? std::min(first, edge.Constraint) : first;
  }
  for (std::int64_t i = 0; i < first; ++i)
  {
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
    const bool isThis = mesh.ConstraintsToInsert[i] == 0 &&
      EdgeKey(ranks.GetRank(ends[0]), ranks.GetRank(ends[1])) == key;
    first = isThis ? i : first;
  }
  if (first < mesh.NumberOfConstraintEdges)
  {
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * first;
    crossed = { first, { ends[0], ends[1] } };
  }
  return crossed;
}

/// Finds what the last of the refused constraints crosses, if a message will name it.
void NameCrossed(const TriangleMesh& mesh, const SpatialOrderView& ranks, const Inserter& flips,
  std::vector<RefusedConstraint>& refused)
{
  const std::int64_t crossings = flips.GetNumberOfCrossings();
  if (flips.HasCrossed() && crossings <= MostNamedIds)
  {
    refused.back().Crossed = FindCrossed(mesh, ranks, flips);
  }
}
}

namespace
{
/// Lists the ends of the constraints of a mesh that are chosen by their numbers.
template <typename Choice>
std::vector<std::int64_t> ListEnds(const TriangleMesh& mesh, const Choice& isChosen)
{
  std::vector<std::int64_t> listed;
  for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
  {
    if (isChosen(i))
    {
      const std::int64_t* ends = mesh.ConstraintEdges + 2 * i;
      listed.insert(listed.end(), ends, ends + 2);
    }
  }
  return listed;
}

TriangleMesh WithConstraints(const TriangleMesh& mesh, const std::vector<std::int64_t>& ends)
{
  TriangleMesh made = mesh;
  made.ConstraintEdges = ends.data();
  made.NumberOfConstraintEdges = SizeOf(ends) / 2;
  made.ConstraintsToInsert = nullptr;
  return made;
}
}

void ConstraintInsertion::Refuse(const TriangleMesh& mesh, std::int64_t constraint, Refusal why)
{
  const std::int64_t* ends = mesh.ConstraintEdges + 2 * constraint;
  this->Refused.push_back({ { ends[0], ends[1] }, why });
  this->Tried.push_back(constraint);
}

/// Refuses all constraints that are no edges.
void ConstraintInsertion::RefuseAll(
  const TriangleMesh& mesh, const MissingConstraints& missing, Refusal why)
{
  this->Edges = ListEnds(mesh, [&](std::int64_t i) { return !missing.IsMissing[i]; });
  for (const std::int64_t constraint : missing.First)
  {
    this->Refuse(mesh, constraint, why);
  }
}

/// Notes what became of a constraint.
void ConstraintInsertion::Take(
  const TriangleMesh& mesh, std::int64_t constraint, PathResult result, bool wasMissing)
{
  if (result != PathResult::Found)
  {
    this->Refuse(mesh, constraint, ToRefusal(result));
  }
  else if (wasMissing)
  {
    this->Tried.push_back(constraint);
  }
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
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, backend);
  const bool isOnSurface =
    survey.Geometry == GeometryKind::Surface || survey.Geometry == GeometryKind::Sphere;
  if (isOnSurface || mesh.Whole.SharedPoints)
  {
    this->RefuseAll(mesh, missing, isOnSurface ? Refusal::OnSurface : Refusal::NeedsGuard);
    return;
  }

  // What the caller wants inserted is fixed when it comes to it, even if it is an edge already.
  // Otherwise it would depend on the triangles which of two constraints that cross is refused.
  this->Edges = ListEnds(mesh, [&](std::int64_t i) { return mesh.ConstraintsToInsert[i] == 0; });
  std::vector<std::int64_t> first = this->Edges;
  const std::int64_t* noEdge = mesh.ConstraintEdges + 2 * missing.First.front();
  first.insert(first.end(), noEdge, noEdge + 2); // a mesh with constraints gets a table of edges
  const TriangleMesh start = WithConstraints(mesh, first);
  const MeshInput startInput{ start, start };
  // Shares of the time that an insertion takes: the edge mesh, and all constraints.
  constexpr double BuildShare = 0.6, FlipShare = 0.95;
  const SpatialOrder order = OrderMesh(input, survey, backend);
  const SpatialOrderView ranks = order.View();
  const EdgeMeshInput edges{ startInput, survey, order, options.FeatureAngle };
  const BuildProgress progress(
    [&](double share) { return !observer || observer(std::min(1.0, share)); });
  const BuildProgress building(
    [&](double share) { return !observer || observer(std::min(1.0, share) * BuildShare); });
  EdgeMeshResult built = BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend, building);
  const PackingPlan plan{ { survey.Projection.AxisU, survey.Projection.AxisV }, 2, false, false,
    false };
  const PackedPoints places = PackPoints(mesh.Points, ranks, plan, backend);
  const PlaneMesh plane{ built.Edges.View(),
    PlaneArray(places.Doubles.Data(), mesh.Points.Count, 2) };
  Inserter flips(plane, mesh.Points.Count, mesh.Triangles.Count, built.Table.View());
  for (std::size_t i = 0; i < missing.Wanted.size(); ++i)
  {
    constexpr std::size_t ConstraintsPerCall = 64; // a few milliseconds
    if (i % ConstraintsPerCall == 0)
    {
      const double share = static_cast<double>(i) / static_cast<double>(missing.Wanted.size());
      progress.Tell(BuildShare + (FlipShare - BuildShare) * share);
    }
    const std::int64_t wanted = missing.Wanted[i];
    const std::int64_t* ends = mesh.ConstraintEdges + 2 * wanted;
    const VertexId from = ranks.GetRank(ends[0]), to = ranks.GetRank(ends[1]);
    const bool isEdge = !missing.IsMissing[wanted] && flips.HasEdge(from, to);
    const PathResult result = flips.Insert(from, to, wanted);
    if (result != PathResult::Found && isEdge) // at points that are not finite, or coincide
    {
      this->Edges.insert(this->Edges.end(), ends, ends + 2);
    }
    else
    {
      this->Take(mesh, wanted, result, missing.IsMissing[wanted]);
      NameCrossed(mesh, ranks, flips, this->Refused);
    }
  }
  AddEnds(flips.GetEdges(), ranks, this->Edges);
  this->Flips = flips.GetNumberOfFlips();
  if (this->Flips > 0)
  {
    this->Geometry = survey.Geometry;
    this->GeometryReason = survey.GeometryReason;
    this->Store(built.Edges, ranks, backend);
  }
}

/// Keeps the triangles.
void ConstraintInsertion::Store(
  const EdgeMesh& edges, const SpatialOrderView& order, const ThreadBackend& backend)
{
  const std::int64_t count = edges.NumberOfTriangles;
  this->Triangles.resize(3 * count);
  backend.StoreTriangles(MutableTriangleArray(this->Triangles.data(), count),
    StoreStep{ { edges.Triangles.Data() }, order });
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
  TriangleMesh mesh = this->Tried.empty() ? caller : WithConstraints(caller, this->Edges);
  mesh.ConstraintsToInsert = nullptr;
  if (!this->Triangles.empty())
  {
    mesh.Triangles = TriangleArray(this->Triangles.data(), caller.Triangles.Count);
  }
  return mesh;
}

FlipOptions ConstraintInsertion::GetOptions(const FlipOptions& caller) const
{
  FlipOptions options = caller;
  if (this->HasFlips())
  {
    options.Geometry = this->Geometry;
  }
  return options;
}

void ConstraintInsertion::AddTo(FlipReport& report) const
{
  if (this->HasFlips())
  {
    report.GeometryReason = this->GeometryReason;
  }
  report.InsertedConstraints = SizeOf(this->Tried) - SizeOf(this->Refused);
  report.ConstraintFlips = this->Flips;
  report.UnmatchedConstraints += SizeOf(this->Refused);
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
