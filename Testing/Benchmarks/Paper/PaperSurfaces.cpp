// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PaperSurfaces.h"

#include "CornerMesh.h"
#include "PaperTests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>
#include <unordered_set>

namespace delaunayflip
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

/// A random number in [0, 1), the same with every standard library.
double DrawUnit(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

std::int32_t DrawIndex(std::mt19937& random, std::int64_t count)
{
  return static_cast<std::int32_t>(DrawUnit(random) * static_cast<double>(count));
}

using Quad = std::array<std::int32_t, 4>;

/// Adds two triangles, divided by the diagonal 0-2 or, with `otherDiagonal`, 1-3.
void AddQuad(OwnedMesh<double>& mesh, const Quad& q, bool otherDiagonal)
{
  const Quad turned = otherDiagonal ? Quad{ q[1], q[2], q[3], q[0] } : q;
  mesh.Triangles.insert(
    mesh.Triangles.end(), { turned[0], turned[1], turned[2], turned[0], turned[2], turned[3] });
}

PaperPoint3<double> GetPoint(const OwnedMesh<double>& mesh, std::int64_t i)
{
  return { mesh.Points[3 * i], mesh.Points[3 * i + 1], mesh.Points[3 * i + 2], 0.0 };
}

double CosineBetween(const PaperPoint3<double>& m, const PaperPoint3<double>& n)
{
  return Dot(m, n) / (std::sqrt(Dot(m, m)) * std::sqrt(Dot(n, n)));
}

std::uint64_t MakeKey(std::int32_t p, std::int32_t q)
{
  const auto [low, high] = std::minmax(p, q);
  return std::uint64_t(low) << 32 | std::uint64_t(high);
}

/// Random legal flips, one at a time.
class FlipRuin
{
public:
  FlipRuin(const OwnedMesh<double>& mesh, std::uint32_t seed)
    : Points(mesh),
      Mesh(mesh.Triangles),
      Random(seed)
  {
    for (std::int32_t c = 0; c < this->Mesh.CountCorners(); ++c)
    {
      this->Edges.insert(this->KeyOf(CornerMesh::Next(c), CornerMesh::Previous(c)));
    }
  }

  const std::vector<std::int32_t>& Run(std::int64_t attempts)
  {
    for (std::int64_t i = 0; i < attempts; ++i)
    {
      const std::int32_t corner = DrawIndex(this->Random, this->Mesh.CountCorners());
      if (this->Mesh.Twins[corner] >= 0 && this->IsLegal(corner, this->Mesh.Twins[corner]))
      {
        this->Edges.erase(this->KeyOf(CornerMesh::Next(corner), CornerMesh::Previous(corner)));
        this->Edges.insert(this->KeyOf(corner, this->Mesh.Twins[corner]));
        this->Mesh.Flip(corner);
      }
    }
    return this->Mesh.Vertices;
  }

private:
  std::uint64_t KeyOf(std::int32_t c, std::int32_t d) const
  {
    return MakeKey(this->Mesh.Vertices[c], this->Mesh.Vertices[d]);
  }

  PaperPoint3<double> At(std::int32_t corner) const
  {
    return GetPoint(this->Points, this->Mesh.Vertices[corner]);
  }

  bool IsLegal(std::int32_t corner, std::int32_t twin) const
  {
    const double limit = std::cos(20.0 * Pi / 180.0);
    const auto a = this->At(corner), b = this->At(twin);
    const auto p = this->At(CornerMesh::Next(corner)), q = this->At(CornerMesh::Previous(corner));
    const auto quad = Cross(q - p, a - b); // twice the quad's vector area
    for (const auto& normal :
      { Cross(p - a, q - a), Cross(q - b, p - b), Cross(p - a, b - a), Cross(q - b, a - b) })
    {
      if (!(CosineBetween(normal, quad) > limit))
      {
        return false;
      }
    }
    return this->Edges.count(this->KeyOf(corner, twin)) == 0;
  }

  const OwnedMesh<double>& Points;
  CornerMesh Mesh;
  std::mt19937 Random;
  std::unordered_set<std::uint64_t> Edges;
};

}

OwnedMesh<double> MakeBumpyTorus(
  std::int32_t columns, std::int32_t rows, double shift, std::uint32_t seed)
{
  std::mt19937 random(seed);
  OwnedMesh<double> mesh;
  for (std::int32_t r = 0; r < rows; ++r)
  {
    const double v = 2.0 * Pi * r / rows;
    for (std::int32_t c = 0; c < columns; ++c)
    {
      const double u = 2.0 * Pi * (c + shift * (2.0 * DrawUnit(random) - 1.0)) / columns;
      const double tube = 1.0 + 0.1 * std::sin(9.0 * u) * std::sin(5.0 * v);
      const double around = 2.5 + tube * std::cos(v);
      mesh.Points.insert(
        mesh.Points.end(), { around * std::cos(u), around * std::sin(u), tube * std::sin(v) });
    }
  }
  const auto id = [=](std::int32_t c, std::int32_t r)
  { return (r % rows) * columns + c % columns; };
  for (std::int32_t r = 0; r < rows; ++r)
  {
    for (std::int32_t c = 0; c < columns; ++c)
    {
      const bool otherDiagonal = shift > 0.0 && DrawUnit(random) < 0.5;
      AddQuad(mesh, { id(c, r), id(c + 1, r), id(c + 1, r + 1), id(c, r + 1) }, otherDiagonal);
    }
  }
  return mesh;
}

OwnedMesh<double> MakeBox(std::int32_t size)
{
  OwnedMesh<double> mesh;
  std::map<std::array<std::int32_t, 3>, std::int32_t> ids;
  const auto add = [&](const std::array<std::int32_t, 3>& place)
  {
    const auto [found, isNew] = ids.emplace(place, static_cast<std::int32_t>(ids.size()));
    if (isNew)
    {
      mesh.Points.insert(mesh.Points.end(), place.begin(), place.end());
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::int32_t i = 0; i < 2 * size * size; ++i)
    {
      const std::int32_t u = i / 2 % size, v = i / 2 / size, w = i % 2 * size;
      const auto corner = [&](std::int32_t du, std::int32_t dv)
      {
        std::array<std::int32_t, 3> place;
        place[axis] = w;
        place[(axis + 1) % 3] = u + du;
        place[(axis + 2) % 3] = v + dv;
        return add(place);
      };
      const Quad quad = { corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1) };
      AddQuad(mesh, w > 0 ? quad : Quad{ quad[0], quad[3], quad[2], quad[1] }, false);
    }
  }
  return mesh;
}

OwnedMesh<double> MakeCircles(std::int32_t columns, std::int32_t rows)
{
  OwnedMesh<double> mesh;
  for (std::int32_t r = 0; r < rows; ++r)
  {
    const double radius = rows + r;
    for (std::int32_t c = 0; c < columns; ++c)
    {
      const double angle = 2.0 * Pi * c / columns;
      mesh.Points.insert(
        mesh.Points.end(), { radius * std::cos(angle), radius * std::sin(angle), 0.0 });
    }
  }
  for (std::int32_t i = 0; i < (rows - 1) * columns; ++i)
  {
    const std::int32_t next = i / columns * columns + (i + 1) % columns;
    AddQuad(mesh, { i, i + columns, next + columns, next }, false);
  }
  return mesh;
}

void AddNoise(OwnedMesh<double>& mesh, double distance, std::uint32_t seed)
{
  std::mt19937 random(seed);
  for (double& coordinate : mesh.Points)
  {
    coordinate += distance * (2.0 * DrawUnit(random) - 1.0);
  }
}

void RuinByFlips(OwnedMesh<double>& mesh, double share, std::uint32_t seed)
{
  const double attempts = share * static_cast<double>(mesh.NumberOfTriangles());
  mesh.Triangles = FlipRuin(mesh, seed).Run(static_cast<std::int64_t>(attempts));
}

void RuinBySplits(OwnedMesh<double>& mesh, double share, std::uint32_t seed)
{
  constexpr double Place = 0.02;
  std::mt19937 random(seed);
  const CornerMesh corners(mesh.Triangles);
  std::vector<char> isSplit(mesh.NumberOfTriangles(), 0);
  for (std::int32_t a = 0; a < corners.CountCorners(); ++a)
  {
    const std::int32_t b = corners.Twins[a];
    if (!corners.IsInterior(a) || DrawUnit(random) >= share || isSplit[a / 3] || isSplit[b / 3])
    {
      continue;
    }
    isSplit[a / 3] = isSplit[b / 3] = 1;
    const std::int32_t p = corners.Vertices[CornerMesh::Next(a)];
    const std::int32_t q = corners.Vertices[CornerMesh::Previous(a)];
    const auto middle = static_cast<std::int32_t>(mesh.NumberOfPoints());
    for (int axis = 0; axis < 3; ++axis)
    {
      const double from = mesh.Points[3 * p + axis];
      mesh.Points.push_back(from + Place * (mesh.Points[3 * q + axis] - from));
    }
    // (a, p, q) and (b, q, p) keep the part at q.
    mesh.Triangles[CornerMesh::Next(a)] = middle;
    mesh.Triangles[CornerMesh::Previous(b)] = middle;
    mesh.Triangles.insert(
      mesh.Triangles.end(), { corners.Vertices[a], p, middle, corners.Vertices[b], middle, p });
  }
}

void WriteMeshFile(const OwnedMesh<float>& mesh, const std::string& path)
{
  std::ofstream file(path, std::ios::binary);
  const std::int64_t header[5] = { 4, mesh.NumberOfPoints(), mesh.NumberOfTriangles(), 0, 0 };
  file.write("DFMESH01", 8);
  file.write(reinterpret_cast<const char*>(header), sizeof(header));
  file.write(reinterpret_cast<const char*>(mesh.Points.data()),
    static_cast<std::streamsize>(mesh.Points.size() * sizeof(float)));
  file.write(reinterpret_cast<const char*>(mesh.Triangles.data()),
    static_cast<std::streamsize>(mesh.Triangles.size() * sizeof(std::int32_t)));
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + path);
  }
}

OwnedMesh<float> RoundToFloats(const OwnedMesh<double>& mesh)
{
  OwnedMesh<float> rounded;
  rounded.Points.assign(mesh.Points.begin(), mesh.Points.end());
  rounded.Triangles = mesh.Triangles;
  return rounded;
}

OwnedMesh<double> WidenToDoubles(const OwnedMesh<float>& mesh)
{
  OwnedMesh<double> wide;
  wide.Points.assign(mesh.Points.begin(), mesh.Points.end());
  wide.Triangles = mesh.Triangles;
  return wide;
}

}
