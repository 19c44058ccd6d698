// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCase.h"

#include "ByteSource.h"
#include "RandomInputs.h"
#include "References.h"

#include <cmath>
#include <limits>
#include <ostream>
#include <set>
#include <utility>

namespace delaunayflip
{
namespace
{

using Mesh = OwnedMesh<double>;

/// Points of one family, chosen because inexact predicates fail on it.
std::vector<Point3> DrawPoints(ByteSource& source, std::uint32_t most)
{
  static const std::vector<PointFamily> families = ListPointFamilies();
  const PointFamily& family = families[source.Draw(static_cast<std::uint32_t>(families.size()))];
  const std::uint32_t fours = 1 + source.Draw(most / 4);
  std::mt19937 random = source.MakeRandom();
  std::vector<Point3> points;
  for (std::uint32_t i = 0; i < fours; ++i)
  {
    const FourPoints drawn = family.Draw(random);
    points.insert(points.end(), drawn.begin(), drawn.end());
  }
  return points;
}

/// A triangulation of the distinct points, in x and y; z is 0.
Mesh Triangulate(const std::vector<Point3>& points)
{
  std::set<std::array<double, 2>> distinct;
  for (const Point3& point : points)
  {
    distinct.insert({ point[0] + 0.0, point[1] + 0.0 }); // no -0
  }
  return MakeSweptMesh({ distinct.begin(), distinct.end() });
}

Mesh MakePlane(ByteSource& source) { return Triangulate(DrawPoints(source, 48)); }

/// A lattice, which has ties everywhere, with holes.
Mesh MakeLattice(ByteSource& source)
{
  const std::uint32_t size = 2 + source.Draw(6);
  std::vector<Point3> points;
  for (std::uint32_t i = 3 + source.Draw(size * size); i > 0; --i)
  {
    const auto x = static_cast<double>(source.Draw(size));
    points.push_back({ x, static_cast<double>(source.Draw(size)), 0.0 });
  }
  return Triangulate(points);
}

/// A triangulation in x and y, with heights of the same family.
Mesh MakeTerrain(ByteSource& source)
{
  const Mesh mesh = MakePlane(source);
  const std::vector<Point3> heights = DrawPoints(source, 16);
  return Lift(mesh,
    [&](double, double)
    { return heights[source.Draw(static_cast<std::uint32_t>(heights.size()))][2]; });
}

/// A triangulation in a tilted plane. Coordinates are integers, so the points lie in it exactly.
Mesh MakeTiltedPlane(ByteSource& source)
{
  const Mesh mesh = MakeLattice(source);
  const auto draw = [&source] { return static_cast<double>(source.Draw(32)) - 16.0; };
  AffineMap map;
  for (AffineRow& row : map)
  {
    row = { draw(), draw(), 0.0, draw() };
  }
  return Transform(mesh, map);
}

Mesh MakeSurface(ByteSource& source)
{
  const auto columns = static_cast<std::int32_t>(3 + source.Draw(12));
  const auto rows = static_cast<std::int32_t>(1 + source.Draw(8));
  switch (source.Draw(3))
  {
    case 0:
      return MakeLatLongSphere(columns, rows);
    case 1:
      return MakeMoebiusStrip(columns, rows, source.Draw(1000));
    default:
      return MakeBadSphere(columns, rows, source.Draw(1000));
  }
}

/// Triangles of any three points.
Mesh MakeSoup(ByteSource& source)
{
  Mesh mesh;
  for (const Point3& point : DrawPoints(source, 40))
  {
    mesh.Points.insert(mesh.Points.end(), point.begin(), point.end());
  }
  const auto points = static_cast<std::uint32_t>(mesh.NumberOfPoints());
  for (std::uint32_t i = 3 * (1 + source.Draw(100)); i > 0; --i)
  {
    mesh.Triangles.push_back(static_cast<std::int32_t>(source.Draw(points)));
  }
  return mesh;
}

Mesh MakeMess(ByteSource& source) { return MakeRandomMess(source.Draw(0xFFFFFFFFu)).Mesh; }

/// A mesh large enough to give work to several threads.
Mesh MakeLarge(ByteSource& source)
{
  const Mesh mesh = MakeRandomBadMeshDouble(1000 + source.Draw(6000), source.Draw(10000));
  return source.Once(2) ? mesh : RepeatTriangles(mesh);
}

/// @param isClean receives whether the mesh is a triangulation without overlaps.
Mesh DrawMesh(ByteSource& source, bool& isClean)
{
  constexpr Mesh (*Kinds[])(ByteSource&) = { MakePlane, MakePlane, MakeLattice, MakeTerrain,
    MakeTiltedPlane, MakeSurface, MakeSoup, MakeMess };
  const std::uint32_t kind = source.Draw(256);
  isClean = kind % 8 < 3;
  return kind == 255 ? MakeLarge(source) : Kinds[kind % 8](source);
}

double DrawBadNumber(ByteSource& source)
{
  constexpr double Numbers[] = { 0.0, -0.0, 1.0, 5e-324, 1e-310, 1e300, 1.7e308,
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() };
  return Numbers[source.Draw(sizeof(Numbers) / sizeof(Numbers[0]))];
}

/// Adds one fault to the points or the triangles.
void Spoil(Mesh& mesh, ByteSource& source)
{
  const auto drawPoint = [&]
  { return source.Draw(static_cast<std::uint32_t>(mesh.NumberOfPoints())); };
  const auto drawTriangle = [&]
  { return 3 * source.Draw(static_cast<std::uint32_t>(mesh.NumberOfTriangles())); };
  std::int32_t* corners = &mesh.Triangles[drawTriangle()];
  double* point = &mesh.Points[3 * drawPoint()];
  switch (source.Draw(6))
  {
    case 0: // reverses it
      std::swap(corners[0], corners[1]);
      break;
    case 1:
      corners[source.Draw(3)] = static_cast<std::int32_t>(drawPoint());
      break;
    case 2: // repeats it, perhaps reversed
      mesh.Triangles.insert(mesh.Triangles.end(),
        { corners[0], corners[1 + source.Draw(2)], corners[2 - source.Draw(2)] });
      break;
    case 3:
      point[source.Draw(3)] = DrawBadNumber(source);
      break;
    case 4: // moves a point onto another one, or between two
    {
      const double* p = &mesh.Points[3 * drawPoint()];
      const double* q = source.Once(2) ? p : &mesh.Points[3 * drawPoint()];
      for (int axis = 0; axis < 3; ++axis)
      {
        point[axis] = 0.5 * p[axis] + 0.5 * q[axis];
      }
      break;
    }
    default: // a hole
      mesh.Triangles.erase(mesh.Triangles.end() - 3, mesh.Triangles.end());
      break;
  }
}

/// Multiplies by a power of two, which changes no decision unless numbers overflow or underflow.
void Scale(Mesh& mesh, ByteSource& source)
{
  constexpr int Exponents[] = { -1040, -300, -20, 20, 300 };
  const int exponent = Exponents[source.Draw(5)];
  for (double& coordinate : mesh.Points)
  {
    coordinate = std::ldexp(coordinate, exponent);
  }
}

void DrawConstraints(EngineCase& drawn, ByteSource& source)
{
  const auto corners = static_cast<std::uint32_t>(drawn.Triangles.size());
  const auto points = static_cast<std::uint32_t>(drawn.Points.size() / 3);
  for (std::uint32_t i = source.Draw(6); i > 0; --i)
  {
    if (source.Once(4))
    {
      drawn.Constraints.push_back(source.Draw(points));
      drawn.Constraints.push_back(source.Draw(points));
      continue;
    }
    const std::uint32_t corner = source.Draw(corners);
    drawn.Constraints.push_back(drawn.Triangles[corner]);
    drawn.Constraints.push_back(drawn.Triangles[corner % 3 == 2 ? corner - 2 : corner + 1]);
  }
}

void DrawLabels(EngineCase& drawn, ByteSource& source)
{
  const bool hasRegions = source.Once(4);
  const bool hasFrozen = source.Once(4);
  for (std::size_t t = 0; t < drawn.Triangles.size() / 3; ++t)
  {
    if (hasRegions)
    {
      drawn.Regions.push_back(source.Once(8) ? 1 : 0);
    }
    if (hasFrozen)
    {
      drawn.Frozen.push_back(source.Once(8) ? 1 : 0);
    }
  }
}

FlipOptions DrawOptions(ByteSource& source)
{
  constexpr double Tolerances[] = { -1.0, -1.0, 0.0, 1e-9, 0.1, 0.99 };
  constexpr double FeatureAngles[] = { 180.0, 180.0, 30.0, 0.0 };
  constexpr double Deviations[] = { INFINITY, INFINITY, 0.0, 1e-9, 0.01, 0.3 };
  constexpr std::int64_t Limits[] = { -1, -1, -1, -1, -1, 0, 1, 3 };
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  options.Geometry = static_cast<GeometryKind>(source.Draw(4));
  options.Criterion = source.Once(4) ? CriterionKind::OppositeAngles : CriterionKind::InCircle;
  options.TieRule = source.Once(3) ? TieRuleKind::Canonical : TieRuleKind::Keep;
  options.Tolerance = Tolerances[source.Draw(6)];
  options.FeatureAngle = FeatureAngles[source.Draw(4)];
  options.MaximumDeviation = Deviations[source.Draw(6)];
  options.MaximumIterations = Limits[source.Draw(8)];
  options.TrackQuality = source.Once(8);
  return options;
}

template <typename Number>
void PrintArray(const char* name, const std::vector<Number>& numbers, std::ostream& stream)
{
  stream << name << " = {";
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    stream << (i > 0 ? ", " : " ") << +numbers[i];
  }
  stream << " };\n";
}

}

EngineInput::EngineInput(const EngineCase& drawn)
  : Case(drawn)
{
  if (drawn.HasFloats)
  {
    this->Floats.assign(drawn.Points.begin(), drawn.Points.end());
  }
  if (drawn.HasLongIds)
  {
    this->LongIds.assign(drawn.Triangles.begin(), drawn.Triangles.end());
  }
}

TriangleMesh EngineInput::View() const
{
  const auto points = static_cast<std::int64_t>(this->Case.Points.size()) / 3;
  const auto triangles = static_cast<std::int64_t>(this->Case.Triangles.size()) / 3;
  TriangleMesh mesh;
  mesh.Points = this->Case.HasFloats ? PointArray(this->Floats.data(), points)
                                     : PointArray(this->Case.Points.data(), points);
  mesh.Triangles = this->Case.HasLongIds ? TriangleArray(this->LongIds.data(), triangles)
                                         : TriangleArray(this->Case.Triangles.data(), triangles);
  mesh.ConstraintEdges = this->Case.Constraints.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Case.Constraints.size()) / 2;
  mesh.Regions = this->Case.Regions.empty() ? nullptr : this->Case.Regions.data();
  mesh.FrozenTriangles = this->Case.Frozen.empty() ? nullptr : this->Case.Frozen.data();
  return mesh;
}

EngineCase MakeEngineCase(const std::uint8_t* bytes, std::size_t size)
{
  ByteSource source(bytes, size);
  EngineCase drawn;
  Mesh mesh = DrawMesh(source, drawn.IsClean);
  for (std::uint32_t faults = source.Once(2) ? source.Draw(5) : 0; faults > 0; --faults)
  {
    if (mesh.NumberOfTriangles() > 0)
    {
      drawn.IsClean = false;
      Spoil(mesh, source);
    }
  }
  if (source.Once(16))
  {
    drawn.IsClean = false;
    Scale(mesh, source);
  }
  drawn.Points = std::move(mesh.Points);
  drawn.Triangles = std::move(mesh.Triangles);
  if (!drawn.Triangles.empty() && source.Once(2))
  {
    DrawConstraints(drawn, source);
    DrawLabels(drawn, source);
  }
  drawn.Options = DrawOptions(source);
  drawn.HasLongIds = source.Once(4);
  drawn.HasFloats = source.Once(8);
  drawn.IsClean = drawn.IsClean && !drawn.HasFloats; // rounding may turn triangles over
  return drawn;
}

void Print(const EngineCase& drawn, std::ostream& stream)
{
  stream.precision(17);
  PrintArray("Points", drawn.Points, stream);
  PrintArray("Triangles", drawn.Triangles, stream);
  PrintArray("Constraints", drawn.Constraints, stream);
  PrintArray("Regions", drawn.Regions, stream);
  PrintArray("Frozen", drawn.Frozen, stream);
  const FlipOptions& options = drawn.Options;
  stream << "HasFloats = " << drawn.HasFloats << "; HasLongIds = " << drawn.HasLongIds
         << "; IsClean = " << drawn.IsClean << ";\n"
         << "Geometry = " << ToString(options.Geometry)
         << "; OppositeAngles = " << (options.Criterion == CriterionKind::OppositeAngles)
         << "; Canonical = " << (options.TieRule == TieRuleKind::Canonical)
         << "; Tolerance = " << options.Tolerance << "; FeatureAngle = " << options.FeatureAngle
         << "; MaximumDeviation = " << options.MaximumDeviation
         << "; MaximumIterations = " << options.MaximumIterations << ";\n";
}

}
