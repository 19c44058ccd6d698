// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"

#include "MeshSurveyBuilder.h"
#include "Predicates.h"
#include "Records.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"
#include "TriangleAngles.h"
#include "WideAngles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace delaunayflip
{

namespace
{

using VertexPair = std::pair<std::int64_t, std::int64_t>;

// The opposite-angle test of MeshAudit and its tolerance. It shares only vectors with the engine's
// test and works differently, with divisions, hypot and inverse trigonometry: if both shared more
// code, a mistake in it would confirm itself.

double Hypot(const Vector3& a) { return std::hypot(a.X, a.Y, a.Z); }

/// Cosine and sine, times any positive number, of the angle at `apex` towards `p` and `q`.
struct Angle
{
  Angle(const Vector3& apex, const Vector3& p, const Vector3& q)
    : Cosine(Dot(p - apex, q - apex)),
      Sine(Hypot(Cross(p - apex, q - apex)))
  {
  }

  double Cosine;
  double Sine;
};

/// Whether the angles sum to more than pi + tolerance. The sum lies in [0, 2 pi].
bool IsSumAbovePi(const Angle& a, const Angle& b, double tolerance)
{
  if (a.Cosine >= 0.0 && b.Cosine >= 0.0)
  {
    return false;
  }
  const double sine = a.Sine * b.Cosine + a.Cosine * b.Sine;
  const double cosine = a.Cosine * b.Cosine - a.Sine * b.Sine;
  const bool isAboveThreeHalvesPi = a.Cosine < 0.0 && b.Cosine < 0.0 && cosine > 0.0;
  return isAboveThreeHalvesPi || sine * std::cos(tolerance) - cosine * std::sin(tolerance) < 0.0;
}

/// One side of a triangle.
struct Side
{
  VertexPair Ends; ///< Ascending.
  std::int64_t Triangle;
  int Slot; ///< The slot of the vertex opposite the side.
  bool Reversed; ///< The triangle runs from the larger end to the smaller.
};

bool operator<(const Side& a, const Side& b)
{
  return std::tie(a.Ends, a.Triangle, a.Slot) < std::tie(b.Ends, b.Triangle, b.Slot);
}

/// All sides, those of one edge in a row. Triangles that name a vertex twice have none.
std::vector<Side> SortSides(const TriangleArray& triangles)
{
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(3 * triangles.Count));
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    if (!triangles.HasEdges(t))
    {
      continue;
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t from = triangles.Get(t, (slot + 1) % 3);
      const std::int64_t to = triangles.Get(t, (slot + 2) % 3);
      sides.push_back({ std::minmax({ from, to }), t, slot, from > to });
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Calls visit(first side, number of incident sides) for every edge, by ascending vertex pair.
template <typename Visitor>
void ForEachEdge(const TriangleArray& triangles, const Visitor& visit)
{
  std::vector<Side> sides = SortSides(triangles);
  ForEachRun(
    sides, [](const Side& a, const Side& b) { return a.Ends == b.Ends; },
    [&](const Side* begin, const Side* end) { visit(begin, end - begin); });
}

/// The vertices of a triangle or quad relative to the first; with PlanarXY, z is 0.
template <std::size_t Count>
std::array<Vector3, Count> GetScaledPoints(
  const PointArray& points, const std::array<std::int64_t, Count>& ids, GeometryKind geometry)
{
  double offsets[Count][3] = {};
  LoadScaledOffsets(points, ids.data(), Count, geometry == GeometryKind::PlanarXY ? 2 : 3, offsets);
  std::array<Vector3, Count> scaled;
  for (std::size_t i = 0; i < Count; ++i)
  {
    scaled[i] = { offsets[i][0], offsets[i][1], offsets[i][2] };
  }
  return scaled;
}

/// Decides whether single edges violate the criterion.
class EdgeJudge
{
public:
  EdgeJudge(const TriangleMesh& mesh, const FlipOptions& options)
    : Mesh(mesh),
      Options(options)
  {
    const ThreadBackend backend(1);
    const MeshSurvey survey = BuildMeshSurvey(MeshInput{ mesh, mesh }, options.Geometry, backend);
    this->Geometry = survey.Geometry;
    this->Projection = survey.Projection;
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      this->Constraints.emplace_back(
        std::minmax({ mesh.ConstraintEdges[2 * i], mesh.ConstraintEdges[2 * i + 1] }));
    }
    std::sort(this->Constraints.begin(), this->Constraints.end());
  }

  /// @param sides the two sides of an edge.
  bool IsViolated(const Side* sides) const
  {
    if (!this->MayFlip(sides))
    {
      return false;
    }
    const std::array<std::int64_t, 4> quad = this->GetQuad(sides);
    const bool isDegenerate = quad[0] == quad[3] || quad[0] == quad[1] || quad[0] == quad[2] ||
      quad[3] == quad[1] || quad[3] == quad[2];
    const auto isFinite = [this](std::int64_t point)
    { return IsFinitePoint(this->Mesh.Points, point, this->Geometry); };
    if (isDegenerate || !std::all_of(quad.begin(), quad.end(), isFinite))
    {
      return false;
    }
    if (this->Geometry == GeometryKind::Surface)
    {
      return !this->IsFeature(quad) && this->HasLargeAngles(quad);
    }
    if (this->Geometry == GeometryKind::Sphere)
    {
      return this->IsReflex(quad);
    }
    const int upper = this->Orient(quad[0], quad[1], quad[2]);
    const int lower = this->Orient(quad[3], quad[2], quad[1]);
    const bool byAngles = this->Options.Criterion == CriterionKind::OppositeAngles;
    if (upper == 0 && lower == 0)
    {
      return this->SpansOpposite(quad) && (!byAngles || this->HasLargeAngles(quad));
    }
    if (byAngles)
    {
      return upper + lower != 0 && this->HasLargeAngles(quad);
    }
    return (upper + lower) * this->JudgeInCircle(quad) > 0;
  }

private:
  /// Whether neither the caller's options nor the winding fix the edge.
  bool MayFlip(const Side* sides) const
  {
    const std::int64_t t = sides[0].Triangle;
    const std::int64_t s = sides[1].Triangle;
    const unsigned char* frozen = this->Mesh.FrozenTriangles;
    const bool isFrozen = frozen && (frozen[t] != 0 || frozen[s] != 0);
    const bool isRegionBorder =
      this->Mesh.Regions && this->Mesh.Regions[t] != this->Mesh.Regions[s];
    return sides[0].Reversed != sides[1].Reversed && !isFrozen && !isRegionBorder &&
      !std::binary_search(this->Constraints.begin(), this->Constraints.end(), sides[0].Ends);
  }

  /// a, p, q, b: triangles (a, p, q) and (b, q, p).
  std::array<std::int64_t, 4> GetQuad(const Side* sides) const
  {
    const TriangleArray& triangles = this->Mesh.Triangles;
    const Side& side = sides[0];
    return { triangles.Get(side.Triangle, side.Slot),
      triangles.Get(side.Triangle, (side.Slot + 1) % 3),
      triangles.Get(side.Triangle, (side.Slot + 2) % 3),
      triangles.Get(sides[1].Triangle, sides[1].Slot) };
  }

  /// A point's u, v and w; w is 0 unless it belongs to the lift.
  std::array<double, 3> Project(std::int64_t point) const
  {
    const PlanePoint projected = this->Projection.Project(this->Mesh.Points, point);
    return { projected.U, projected.V, projected.W };
  }

  int Orient(std::int64_t a, std::int64_t b, std::int64_t c) const
  {
    return Orientation(this->Project(a).data(), this->Project(b).data(), this->Project(c).data());
  }

  /// Whether, on a sphere, the far corner of the quad lies beyond the plane of the first triangle.
  bool IsReflex(const std::array<std::int64_t, 4>& quad) const
  {
    const auto position = [this](std::int64_t point)
    {
      const PointArray& points = this->Mesh.Points;
      return std::array<double, 3>{ points.Get(point, 0), points.Get(point, 1),
        points.Get(point, 2) };
    };
    const auto a = position(quad[0]), p = position(quad[1]);
    const auto q = position(quad[2]), b = position(quad[3]);
    const double* const center = this->Mesh.Center;
    const int upper = Orientation3D(a.data(), p.data(), q.data(), center);
    const int lower = Orientation3D(b.data(), q.data(), p.data(), center);
    return (upper + lower) * Orientation3D(a.data(), p.data(), q.data(), b.data()) < 0;
  }

  int JudgeInCircle(const std::array<std::int64_t, 4>& quad) const
  {
    const auto a = this->Project(quad[0]), p = this->Project(quad[1]);
    const auto q = this->Project(quad[2]), b = this->Project(quad[3]);
    if (this->Projection.Tilted)
    {
      return InCircleTilted(a.data(), p.data(), q.data(), b.data());
    }
    return InCircle(a.data(), p.data(), q.data(), b.data());
  }

  /// Whether the edge of a quad without area runs from end to end of it, and further than the edge
  /// that a flip would make.
  bool SpansOpposite(const std::array<std::int64_t, 4>& quad) const
  {
    const auto place = [&](int i)
    {
      const auto projected = this->Project(quad[i]);
      return std::make_pair(projected[0], projected[1]);
    };
    const auto edge = std::minmax({ place(1), place(2) });
    const auto made = std::minmax({ place(0), place(3) });
    return edge.first <= made.first && made.second <= edge.second && edge != made;
  }

  bool HasLargeAngles(const std::array<std::int64_t, 4>& quad) const
  {
    const double tolerance = this->GetTolerance(quad);
    return tolerance < Pi &&
      IsSumAbovePi(this->FindAngle(quad[0], quad[1], quad[2]),
        this->FindAngle(quad[3], quad[1], quad[2]), tolerance);
  }

  /// Each angle relative to its own apex: a short leg would drown in the distance of another one.
  Angle FindAngle(std::int64_t apex, std::int64_t p, std::int64_t q) const
  {
    const auto x =
      GetScaledPoints(this->Mesh.Points, std::array<std::int64_t, 3>{ apex, p, q }, this->Geometry);
    return Angle(x[0], x[1], x[2]);
  }

  /// In radians. The automatic one: how much the angle sum may change when every coordinate moves
  /// by a unit in the last place. Infinite if the change has no bound.
  double GetTolerance(const std::array<std::int64_t, 4>& quad) const
  {
    if (this->Options.Tolerance >= 0.0)
    {
      return this->Options.Tolerance;
    }
    // Differences and lengths of a quarter of the coordinates are finite.
    std::array<Vector3, 4> quarters;
    double farthest = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      quarters[i] = 0.25 * LoadPoint(this->Mesh.Points, quad[i]);
      if (this->Geometry == GeometryKind::PlanarXY)
      {
        quarters[i].Z = 0.0;
      }
      farthest = std::max(farthest, Hypot(quarters[i]));
    }
    const double epsilon = this->Mesh.Points.Floats ? std::numeric_limits<float>::epsilon()
                                                    : std::numeric_limits<double>::epsilon();
    double sine = 0.0;
    for (int apex : { 0, 3 })
    {
      for (int end : { 1, 2 })
      {
        const double moved = 2.0 * epsilon * farthest; // of one end relative to the other
        sine += moved / Hypot(quarters[end] - quarters[apex]);
      }
    }
    // The rounding of the engine's test is less than this.
    sine += 32.0 * std::numeric_limits<double>::epsilon();
    return sine < 1.0 ? std::asin(sine) : std::numeric_limits<double>::infinity();
  }

  /// Whether the normals differ by more than the feature angle; never next to an empty triangle.
  bool IsFeature(const std::array<std::int64_t, 4>& quad) const
  {
    if (this->Options.FeatureAngle >= 180.0)
    {
      return false;
    }
    const auto x = GetScaledPoints(this->Mesh.Points, quad, this->Geometry);
    const Vector3 n = AreaVector(x[0], x[1], x[2]);
    const Vector3 m = AreaVector(x[3], x[2], x[1]);
    return Dot(n, m) < std::cos(this->Options.FeatureAngle * Pi / 180.0) * Hypot(n) * Hypot(m);
  }

  const TriangleMesh& Mesh;
  const FlipOptions& Options;
  GeometryKind Geometry;
  PlaneProjection Projection;
  std::vector<VertexPair> Constraints;
};

}

EdgeCounts CountEdges(const TriangleArray& triangles)
{
  EdgeCounts counts;
  ForEachEdge(triangles,
    [&](const Side* sides, std::int64_t incident)
    {
      ++counts.Edges;
      counts.Boundary += incident == 1;
      counts.NonManifold += incident >= 3;
      counts.WronglyWound += incident == 2 && sides[0].Reversed == sides[1].Reversed;
    });
  return counts;
}

std::int64_t EulerCharacteristic(const TriangleArray& triangles)
{
  std::vector<std::int64_t> ids;
  ids.reserve(static_cast<std::size_t>(3 * triangles.Count));
  std::int64_t whole = 0;
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    ids.insert(ids.end(), { triangles.Get(t, 0), triangles.Get(t, 1), triangles.Get(t, 2) });
    whole += triangles.HasEdges(t);
  }
  std::sort(ids.begin(), ids.end());
  const std::int64_t used = std::unique(ids.begin(), ids.end()) - ids.begin();
  return used - CountEdges(triangles).Edges + whole;
}

std::int64_t CountDuplicateEdgesGained(const TriangleArray& before, const TriangleArray& after)
{
  std::map<VertexPair, std::int64_t> valences;
  ForEachEdge(before,
    [&](const Side* sides, std::int64_t incident)
    { valences.emplace_hint(valences.end(), sides->Ends, incident); });
  std::int64_t gained = 0;
  ForEachEdge(after,
    [&](const Side* sides, std::int64_t incident)
    { gained += incident >= 3 && incident > valences[sides->Ends]; });
  return gained;
}

std::int64_t CountNonDelaunayEdges(const TriangleMesh& mesh, const FlipOptions& options)
{
  const EdgeJudge judge(mesh, options);
  std::int64_t violated = 0;
  ForEachEdge(mesh.Triangles,
    [&](const Side* sides, std::int64_t incident)
    { violated += incident == 2 && judge.IsViolated(sides); });
  return violated;
}

double MinimumAngle(const TriangleMesh& mesh, GeometryKind geometry)
{
  std::vector<double> angles(mesh.Triangles.Count);
  FindSmallestAngles(mesh, geometry, 1, angles.data());
  const double smallest = std::accumulate(angles.begin(), angles.end(),
    std::numeric_limits<double>::infinity(), [](double a, double b) { return std::fmin(a, b); });
  return std::isfinite(smallest) ? smallest : std::numeric_limits<double>::quiet_NaN();
}

}
