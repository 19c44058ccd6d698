// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

namespace delaunayflip
{
namespace
{

/// The point of the unit circle at `turn` (0 <= turn < 1) turns. The rational parametrization needs
/// no sine; the last bit of a sine differs between machines.
struct CirclePoint
{
  explicit CirclePoint(double turn)
  {
    const double quarters = 4.0 * turn;
    const double t = quarters - std::floor(quarters);
    const double c = (1.0 - t * t) / (1.0 + t * t);
    const double s = 2.0 * t / (1.0 + t * t);
    const double cosines[] = { c, -s, -c, s };
    const double sines[] = { s, c, -s, -c };
    this->Cosine = cosines[static_cast<int>(quarters) % 4];
    this->Sine = sines[static_cast<int>(quarters) % 4];
  }

  double Cosine = 1.0;
  double Sine = 0.0;
};

/// A random number in [0, 1), made from the generator's bits: the distributions of the standard
/// differ between libraries.
double DrawUnit(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

void AddPoint(OwnedMesh<double>& mesh, double x, double y, double z)
{
  mesh.Points.insert(mesh.Points.end(), { x, y, z });
}

void AddTriangle(OwnedMesh<double>& mesh, std::int32_t a, std::int32_t b, std::int32_t c)
{
  mesh.Triangles.insert(mesh.Triangles.end(), { a, b, c });
}

/// Divides a quad along its 0-2 diagonal or, with `otherDiagonal`, along 1-3.
void AddQuad(OwnedMesh<double>& mesh, const std::array<std::int32_t, 4>& quad, bool otherDiagonal)
{
  const auto [a, b, c, d] = quad;
  AddTriangle(mesh, a, b, otherDiagonal ? d : c);
  AddTriangle(mesh, otherDiagonal ? b : a, c, d);
}

bool DrawBit(std::mt19937& random) { return (random() >> 31) != 0; }

/// Moves vertices along their circles by shift() times the distance of neighbours, and divides
/// quads along one diagonal or, if cut() is true, the other.
template <typename Shift, typename Cut>
OwnedMesh<double> MakeSphere(
  std::int32_t columns, std::int32_t rows, const Shift& shift, const Cut& cut)
{
  OwnedMesh<double> mesh;
  for (std::int32_t r = 0; r < rows; ++r)
  {
    const CirclePoint meridian(0.5 * (r + 1) / (rows + 1));
    for (std::int32_t c = 0; c < columns; ++c)
    {
      const CirclePoint parallel((c + shift()) / columns);
      AddPoint(
        mesh, meridian.Sine * parallel.Cosine, meridian.Sine * parallel.Sine, meridian.Cosine);
    }
  }
  const std::int32_t north = rows * columns;
  const std::int32_t south = north + 1;
  AddPoint(mesh, 0.0, 0.0, 1.0);
  AddPoint(mesh, 0.0, 0.0, -1.0);
  const std::int32_t lastRing = (rows - 1) * columns;
  for (std::int32_t c = 0; c < columns; ++c)
  {
    const std::int32_t next = (c + 1) % columns;
    AddTriangle(mesh, north, c, next);
    for (std::int32_t ring = 0; ring < lastRing; ring += columns)
    {
      AddQuad(mesh, { ring + c, ring + columns + c, ring + columns + next, ring + next }, cut());
    }
    AddTriangle(mesh, south, lastRing + next, lastRing + c);
  }
  return mesh;
}

}

OwnedMesh<double> MakeWorstCaseMesh(std::int32_t size)
{
  OwnedMesh<double> mesh;
  for (std::int32_t i = 0; i < 2 * size; ++i)
  {
    AddPoint(mesh, i < size ? size + 1 + i : i - size, i < size ? 1.0 : -1.0, 0.0);
  }
  for (std::int32_t i = 0; i + 1 < size; ++i)
  {
    AddTriangle(mesh, size, i + 1, i);
  }
  for (std::int32_t i = size; i + 1 < 2 * size; ++i)
  {
    AddTriangle(mesh, size - 1, i, i + 1);
  }
  return mesh;
}

OwnedMesh<double> MakeGridMesh(std::int32_t columns, std::int32_t rows)
{
  OwnedMesh<double> mesh;
  for (std::int32_t r = 0; r <= rows; ++r)
  {
    for (std::int32_t c = 0; c <= columns; ++c)
    {
      AddPoint(mesh, c, r, 0.0);
    }
  }
  const std::int32_t stride = columns + 1;
  for (std::int32_t r = 0; r < rows; ++r)
  {
    for (std::int32_t c = 0; c < columns; ++c)
    {
      const std::int32_t corner = r * stride + c;
      AddQuad(mesh, { corner, corner + 1, corner + stride + 1, corner + stride }, false);
    }
  }
  return mesh;
}

OwnedMesh<float> MakeJitteredGrid(std::int64_t points, std::uint32_t seed)
{
  constexpr double Most = 0.24;
  const auto side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(points))) - 1;
  OwnedMesh<double> grid = MakeGridMesh(side, side);
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < grid.Points.size(); ++i)
  {
    grid.Points[i] += i % 3 == 2 ? 0.0 : Most * (2.0 * DrawUnit(random) - 1.0);
  }
  return { { grid.Points.begin(), grid.Points.end() }, std::move(grid.Triangles) };
}

OwnedMesh<double> MakeBadSphere(std::int32_t columns, std::int32_t rows, std::uint32_t seed)
{
  std::mt19937 random(seed);
  return MakeSphere(
    columns, rows, [&]() { return 0.9 * DrawUnit(random); }, [&]() { return DrawBit(random); });
}

OwnedMesh<double> MakeLatLongSphere(std::int32_t columns, std::int32_t rows)
{
  return MakeSphere(
    columns, rows, []() { return 0.0; }, []() { return false; });
}

OwnedMesh<double> MakeMoebiusStrip(std::int32_t columns, std::int32_t rows, std::uint32_t seed)
{
  std::mt19937 random(seed);
  OwnedMesh<double> mesh;
  for (std::int32_t c = 0; c < columns; ++c)
  {
    for (std::int32_t r = 0; r <= rows; ++r)
    {
      const double turn = (c + 0.9 * DrawUnit(random)) / columns;
      const CirclePoint around(turn);
      const CirclePoint twist(0.5 * turn);
      const double across = static_cast<double>(r) / rows - 0.5;
      const double radius = 2.0 + across * twist.Cosine;
      AddPoint(mesh, radius * around.Cosine, radius * around.Sine, across * twist.Sine);
    }
  }
  const std::int32_t stride = rows + 1;
  for (std::int32_t c = 0; c < columns; ++c)
  {
    const bool seam = c + 1 == columns;
    for (std::int32_t r = 0; r < rows; ++r)
    {
      const std::int32_t near = c * stride + r;
      // After one turn the strip arrives upside down.
      const std::int32_t far = seam ? rows - r : near + stride;
      AddQuad(mesh, { near, far, seam ? far - 1 : far + 1, near + 1 }, DrawBit(random));
    }
  }
  return mesh;
}

OwnedMesh<double> MakeFan(int start, int count)
{
  constexpr int Ring[8][2] = { { 2, 0 }, { 2, 2 }, { 0, 2 }, { -2, 2 }, { -2, 0 }, { -2, -2 },
    { 0, -2 }, { 2, -2 } };
  OwnedMesh<double> mesh;
  AddPoint(mesh, 0.0, 0.0, 0.0);
  for (int i = 0; i <= count; ++i)
  {
    const int* place = Ring[(start + i) % 8];
    AddPoint(mesh, place[0], place[1], 0.0);
  }
  for (std::int32_t i = 1; i <= count; ++i)
  {
    AddTriangle(mesh, 0, i, i + 1);
  }
  return mesh;
}

OwnedMesh<double> RepeatTriangles(OwnedMesh<double> mesh)
{
  const std::vector<std::int32_t> clean = mesh.Triangles;
  for (std::size_t i = 0; i + 3 <= clean.size(); i += 30)
  {
    mesh.Triangles.insert(mesh.Triangles.end(), &clean[i], &clean[i] + 3);
  }
  return mesh;
}

}
