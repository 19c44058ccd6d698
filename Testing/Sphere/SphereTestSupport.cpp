// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereTestSupport.h"

#include "PointTriangulation.h"
#include "Predicates.h"
#include "RandomNumbers.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace delaunayflip
{

namespace
{
constexpr double Pi = 3.14159265358979323846;

Point3 Normalize(const Point3& p)
{
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  return { p[0] / length, p[1] / length, p[2] / length };
}

/// The place of a longitude and a latitude, in radians.
Point3 Place(double longitude, double latitude)
{
  return { std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
    std::sin(latitude) };
}

std::vector<Point3> MakeFibonacci()
{
  constexpr int Count = 400;
  std::vector<Point3> points;
  for (int i = 0; i < Count; ++i)
  {
    points.push_back(
      Place(Pi * (1.0 + std::sqrt(5.0)) * (i + 0.5), std::asin(1.0 - 2.0 * (i + 0.5) / Count)));
  }
  return points;
}

/// A longitude-latitude grid with a pole at every longitude.
std::vector<Point3> MakeLatLon()
{
  std::vector<Point3> points;
  for (int row = 0; row <= 12; ++row)
  {
    for (int column = 0; column < 24; ++column)
    {
      points.push_back(Place(Pi * column / 12, Pi * (row - 6) / 12));
    }
  }
  return points;
}

/// The lattice of a cube's faces, projected.
std::vector<Point3> MakeCubedSphere()
{
  constexpr int Size = 8;
  std::vector<Point3> points;
  for (int i = -Size; i <= Size; ++i)
  {
    for (int j = -Size; j <= Size; ++j)
    {
      const double x = i, y = j, z = Size;
      for (const Point3& p : { Point3{ x, y, z }, Point3{ x, y, -z }, Point3{ x, z, y },
             Point3{ x, -z, y }, Point3{ z, x, y }, Point3{ -z, x, y } })
      {
        points.push_back(Normalize(p));
      }
    }
  }
  return points;
}

/// The corners of an icosahedron, and points on its faces, projected.
std::vector<Point3> MakeIcosahedral()
{
  constexpr int Size = 6;
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<Point3> corners;
  for (const double a : { -1.0, 1.0 })
  {
    for (const double b : { -golden, golden })
    {
      corners.insert(corners.end(), { { 0.0, a, b }, { a, b, 0.0 }, { b, 0.0, a } });
    }
  }
  const OwnedMesh<double> hull = MakeHull(corners);
  std::vector<Point3> points;
  for (std::int64_t t = 0; t < hull.NumberOfTriangles(); ++t)
  {
    for (int i = 0; i <= Size; ++i)
    {
      for (int j = 0; i + j <= Size; ++j)
      {
        const double weights[3] = { double(i), double(j), double(Size - i - j) };
        Point3 p{};
        for (int axis = 0; axis < 3; ++axis)
        {
          for (int slot = 0; slot < 3; ++slot)
          {
            p[axis] += weights[slot] * corners[hull.Triangles[3 * t + slot]][axis];
          }
        }
        points.push_back(Normalize(p));
      }
    }
  }
  return points;
}

/// Many points around one place, and a few everywhere.
std::vector<Point3> MakeCluster()
{
  std::mt19937 random(7);
  std::vector<Point3> points = MakeRandomPoints<double>(40, 3);
  for (int i = 0; i < 300; ++i)
  {
    points.push_back(Normalize(
      { 1.0 + 1e-3 * DrawNormal(random), 1e-3 * DrawNormal(random), 1e-3 * DrawNormal(random) }));
  }
  return points;
}

/// All points in a small part of the sphere, around its equator.
std::vector<Point3> MakeCap()
{
  std::mt19937 random(8);
  std::vector<Point3> points;
  for (int i = 0; i < 300; ++i)
  {
    points.push_back(Normalize({ 1.0, 0.1 * DrawNormal(random), 0.1 * DrawNormal(random) }));
  }
  return points;
}

/// Half a sphere, with its rim in a plane through the center.
std::vector<Point3> MakeHemisphere()
{
  std::vector<Point3> points = MakeRandomPoints<double>(200, 9);
  for (Point3& p : points)
  {
    p[2] = std::fabs(p[2]);
  }
  for (int i = 0; i < 32; ++i)
  {
    points.push_back(Place(Pi * i / 16, 0.0));
  }
  return points;
}

std::vector<Point3> MakeRandomDoubles() { return MakeRandomPoints<double>(400, 1); }
std::vector<Point3> MakeRandomFloats() { return MakeRandomPoints<float>(400, 2); }
std::vector<Point3> MakeLattice() { return MakeLatticePoints(1001); }

/// So dense that the rounding to float puts many of them inside of the hull.
std::vector<Point3> MakeDenseFloats()
{
  std::vector<Point3> points = MakeRandomPoints<double>(20, 12);
  for (const Point3& p : MakeRandomPoints<double>(500, 11))
  {
    const Point3 near = Normalize({ 0.6 + 1e-3 * p[0], -0.64 + 1e-3 * p[1], 0.48 + 1e-3 * p[2] });
    points.push_back({ float(near[0]), float(near[1]), float(near[2]) });
  }
  return points;
}
}

std::vector<SphereFamily> ListSphereFamilies()
{
  return { { "RandomDoubles", MakeRandomDoubles, false },
    { "RandomFloats", MakeRandomFloats, false }, { "DenseFloats", MakeDenseFloats, true },
    { "Fibonacci", MakeFibonacci, false }, { "LatLon", MakeLatLon, true },
    { "CubedSphere", MakeCubedSphere, true }, { "Icosahedral", MakeIcosahedral, true },
    { "Lattice", MakeLattice, true }, { "Cluster", MakeCluster, false },
    { "Cap", MakeCap, false, true }, { "Hemisphere", MakeHemisphere, true, true } };
}

std::vector<Point3> MakeLatticePoints(int square)
{
  const int most = static_cast<int>(std::sqrt(square));
  std::vector<Point3> points;
  for (int x = -most; x <= most; ++x)
  {
    for (int y = -most; y <= most; ++y)
    {
      for (int z = -most; z <= most; ++z)
      {
        if (x * x + y * y + z * z == square)
        {
          points.push_back({ double(x), double(y), double(z) });
        }
      }
    }
  }
  return points;
}

template <typename Real>
std::vector<Point3> MakeRandomPoints(std::int64_t count, std::uint32_t seed)
{
  std::mt19937 random(seed);
  std::vector<Point3> points(count);
  for (Point3& p : points)
  {
    p = Normalize({ DrawNormal(random), DrawNormal(random), DrawNormal(random) });
    p = { Real(p[0]), Real(p[1]), Real(p[2]) };
  }
  return points;
}
template std::vector<Point3> MakeRandomPoints<float>(std::int64_t, std::uint32_t);
template std::vector<Point3> MakeRandomPoints<double>(std::int64_t, std::uint32_t);

OwnedMesh<double> MakeHull(const std::vector<Point3>& points)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> given;
  std::map<Point3, std::int32_t> ids;
  OwnedMesh<double> mesh;
  for (const Point3& p : points)
  {
    ids.emplace(p, static_cast<std::int32_t>(given.size())); // keeps the first point at a place
    given.emplace_back(p[0], p[1], p[2]);
    mesh.Points.insert(mesh.Points.end(), p.begin(), p.end());
  }
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(given.begin(), given.end(), hull);
  for (const auto face : hull.faces())
  {
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face)))
    {
      const Kernel::Point_3& p = hull.point(vertex);
      mesh.Triangles.push_back(ids.at({ p.x(), p.y(), p.z() }));
    }
  }
  return mesh;
}

void Scramble(OwnedMesh<double>& mesh, int flips, std::uint32_t seed)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> sides; // the triangle of each side
  const auto enter = [&](std::int64_t t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      sides[{ mesh.Triangles[3 * t + slot], mesh.Triangles[3 * t + (slot + 1) % 3] }] = t;
    }
  };
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    enter(t);
  }
  const auto faces = [&](std::int32_t a, std::int32_t b, std::int32_t c)
  {
    const double origin[3] = { 0.0, 0.0, 0.0 };
    return Orientation3D(&mesh.Points[3 * a], &mesh.Points[3 * b], &mesh.Points[3 * c], origin) > 0;
  };
  std::mt19937 random(seed);
  for (int i = 0; i < flips; ++i)
  {
    const std::int64_t t = random() % mesh.NumberOfTriangles();
    std::int32_t* ids = &mesh.Triangles[3 * t];
    std::rotate(ids, ids + random() % 3, ids + 3);
    const std::int32_t a = ids[0], p = ids[1], q = ids[2];
    const auto across = sides.find({ q, p });
    if (across == sides.end())
    {
      continue;
    }
    const std::int64_t s = across->second;
    std::int32_t* others = &mesh.Triangles[3 * s];
    const std::int32_t b = others[0] + others[1] + others[2] - p - q;
    if (sides.count({ a, b }) > 0 || !faces(a, p, b) || !faces(b, q, a))
    {
      continue;
    }
    sides.erase({ p, q });
    sides.erase({ q, p });
    std::copy_n(std::array<std::int32_t, 3>{ a, p, b }.begin(), 3, ids);
    std::copy_n(std::array<std::int32_t, 3>{ b, q, a }.begin(), 3, others);
    enter(t);
    enter(s);
  }
}

std::vector<Point3> PlaceAll(const std::vector<std::array<double, 2>>& degrees)
{
  std::vector<Point3> points(degrees.size());
  for (std::size_t i = 0; i < degrees.size(); ++i)
  {
    PlaceOnSphere(degrees[i][0], degrees[i][1], points[i].data());
  }
  return points;
}

FlipOptions OnSphere(TieRuleKind ties)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Sphere;
  options.TieRule = ties;
  return options;
}

}
