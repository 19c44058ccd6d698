// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanarSurvey.h"

#include "ExactPredicates.h"
#include "SurfaceAngles.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
int FindOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const int sign = FilteredOrientation(a, b, c);
  const bool certain = sign != UncertainSign &&
    std::max({ std::fabs(a.U), std::fabs(a.V), std::fabs(b.U), std::fabs(b.V), std::fabs(c.U),
      std::fabs(c.V) }) <= LargestFilteredDifference / 2;
  return certain ? sign : ExactOrientation(a, b, c);
}

bool IsFinite(const PlanePoint& point) { return std::isfinite(point.U) && std::isfinite(point.V); }

/// Sorts defects' ids of caller's triangles: pieces come in the engine's order.
void SortFirstIds(Defect& defect) { std::sort(defect.FirstIds.begin(), defect.FirstIds.end()); }

struct OrientationSums
{
  Defect Left, Right, None;

  OrientationSums& operator+=(const OrientationSums& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->None += part.None;
    return *this;
  }
};

OrientationSums SumOrientations(
  const EdgeMesh& mesh, const PackedPoints& points, const ThreadBackend& backend)
{
  return backend.Sum<OrientationSums>(mesh.NumberOfTriangles,
    [&](std::int64_t begin, std::int64_t end)
    {
      OrientationSums sums;
      for (std::int64_t t = begin; t < end; ++t)
      {
        const TriangleRecord& triangle = mesh.Triangles[t];
        const PlanePoint p = points.GetPlanePoint(triangle.Vertices[0]);
        const PlanePoint q = points.GetPlanePoint(triangle.Vertices[1]);
        const PlanePoint r = points.GetPlanePoint(triangle.Vertices[2]);
        if (IsFinite(p) && IsFinite(q) && IsFinite(r))
        {
          const int sign = FindOrientation(p, q, r);
          Note(sign > 0 ? sums.Left : (sign < 0 ? sums.Right : sums.None), triangle.InputTriangle);
        }
      }
      return sums;
    });
}

/// Whether the stars of a mesh of uniform side cover no direction twice.
///
/// Around an inner vertex the triangles turn a whole number of times: as often as the direction +u
/// is crossed, which comparisons of coordinates tell. At the boundary the direction of the fan's
/// first edge must be covered once only.
class StarSurvey
{
public:
  StarSurvey(const EdgeMesh& mesh, const PackedPoints& points, int side)
    : Mesh(mesh),
      Points(points),
      Side(side),
      Turns(points.Count, 0),
      FanStarts(points.Count, NoVertex)
  {
  }

  bool AreSimple(const ThreadBackend& backend)
  {
    if (!this->FindFanStarts())
    {
      return false; // several fans meet at a vertex
    }
    backend.ForRange(this->Mesh.NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t t = begin; t < end; ++t)
        {
          this->CountTriangle(this->Mesh.Triangles[t]);
        }
      });
    return std::all_of(
      this->Turns.begin(), this->Turns.end(), [](std::uint8_t turns) { return turns <= 1; });
  }

private:
  static constexpr VertexId NoVertex = 0xFFFFFFFFu;

  bool FindFanStarts()
  {
    for (std::int64_t e = 0; e < this->Mesh.NumberOfEdges; ++e)
    {
      if (this->Mesh.CornerOfHalfEdge[2 * e + 1] != NoCorner)
      {
        continue;
      }
      const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * e];
      const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corner)];
      const VertexId from = triangle.Vertices[NextSlot(SlotOf(corner))];
      const VertexId to = triangle.Vertices[PreviousSlot(SlotOf(corner))];
      if (this->FanStarts[from] != NoVertex)
      {
        return false;
      }
      this->FanStarts[from] = to;
    }
    return true;
  }

  void CountTriangle(const TriangleRecord& triangle)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const VertexId v = triangle.Vertices[slot];
      const VertexId first = triangle.Vertices[NextSlot(slot)];
      const VertexId last = triangle.Vertices[PreviousSlot(slot)];
      const bool covers = this->FanStarts[v] == NoVertex
        ? this->CoversPositiveU(v, first, last)
        : this->Covers(v, first, last, this->FanStarts[v]);
      std::uint8_t* turns = &this->Turns[v];
      if (covers && AtomicExchange(turns, std::uint8_t(1)) != 0)
      {
        AtomicStore(turns, std::uint8_t(2));
      }
    }
  }

  /// Whether direction v-p lies in the half plane v > 0, or on its border with u > 0.
  bool IsUpper(const PlanePoint& v, const PlanePoint& p) const
  {
    // Without branches, which would be coin tosses.
    return ((p.V > v.V) | ((p.V == v.V) & (p.U > v.U))) != 0;
  }

  bool CoversPositiveU(VertexId vertex, VertexId first, VertexId last) const
  {
    const PlanePoint v = this->Points.GetPlanePoint(vertex);
    const bool firstUpper = this->IsUpper(v, this->Points.GetPlanePoint(first));
    const bool lastUpper = this->IsUpper(v, this->Points.GetPlanePoint(last));
    return this->Side > 0 ? !firstUpper && lastUpper : firstUpper && !lastUpper;
  }

  /// Whether the corner from `first` (included) to `last` (not) covers the direction of `target`.
  bool Covers(VertexId vertex, VertexId first, VertexId last, VertexId target) const
  {
    if (target == first)
    {
      return true;
    }
    const PlanePoint v = this->Points.GetPlanePoint(vertex);
    const PlanePoint f = this->Points.GetPlanePoint(first);
    const PlanePoint t = this->Points.GetPlanePoint(target);
    const int afterFirst = this->Side * FindOrientation(v, f, t);
    if (afterFirst == 0)
    {
      return this->IsUpper(v, f) == this->IsUpper(v, t);
    }
    return afterFirst > 0 &&
      this->Side * FindOrientation(v, t, this->Points.GetPlanePoint(last)) > 0;
  }

  const EdgeMesh& Mesh;
  const PackedPoints& Points;
  int Side;
  std::vector<std::uint8_t> Turns; ///< 0, 1, or 2 for more.
  std::vector<VertexId> FanStarts; ///< At the boundary, the end of the fan's first edge.
};
}

PlanarSurvey SurveyPlane(const EdgeMesh& mesh, const PackedPoints& points, bool hasBrokenFans,
  const ThreadBackend& backend)
{
  OrientationSums sums = SumOrientations(mesh, points, backend);
  PlanarSurvey survey;
  const bool mostlyLeft = sums.Left.Count >= sums.Right.Count;
  survey.InvertedTriangles = mostlyLeft ? sums.Right : sums.Left;
  survey.InvertedTriangles.What = "triangles that turn the other way than most";
  survey.ZeroAreaTriangles = sums.None;
  survey.ZeroAreaTriangles.What = "triangles without area";
  SortFirstIds(survey.InvertedTriangles);
  SortFirstIds(survey.ZeroAreaTriangles);
  if (survey.InvertedTriangles.Count == 0 && survey.ZeroAreaTriangles.Count == 0)
  {
    survey.UniformSide = mostlyLeft ? 1 : -1;
    survey.StarsAreSimple =
      !hasBrokenFans && StarSurvey(mesh, points, survey.UniformSide).AreSimple(backend);
  }
  return survey;
}

Defect FindZeroAreaTriangles(
  const EdgeMesh& mesh, const PackedPoints& points, const ThreadBackend& backend)
{
  const auto position = [&points](VertexId vertex)
  {
    const std::size_t i = std::size_t(3) * vertex;
    return points.IsFloat()
      ? Vector3{ points.Floats[i], points.Floats[i + 1], points.Floats[i + 2] }
      : Vector3{ points.Doubles[i], points.Doubles[i + 1], points.Doubles[i + 2] };
  };
  Defect defect = backend.Sum<Defect>(mesh.NumberOfTriangles,
    [&](std::int64_t begin, std::int64_t end)
    {
      Defect part;
      for (std::int64_t t = begin; t < end; ++t)
      {
        const VertexId* v = mesh.Triangles[t].Vertices;
        if (Length(AreaVector(position(v[0]), position(v[1]), position(v[2]))) == 0.0)
        {
          Note(part, mesh.Triangles[t].InputTriangle);
        }
      }
      return part;
    });
  defect.What = "triangles without area";
  SortFirstIds(defect);
  return defect;
}

}
