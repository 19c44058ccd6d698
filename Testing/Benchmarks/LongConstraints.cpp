// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LongConstraints.h"

namespace delaunayflip
{

namespace
{
constexpr double Margin = 0.02; ///< Between the ends of lines and the border.

class LineMaker
{
public:
  LineMaker(const OwnedMesh<float>& mesh, int lines)
    : Mesh(mesh),
      Lines(lines)
  {
  }

  /// The middle of a strip.
  double GetMiddle(int line) const { return (line + 0.5) / this->Lines; }

  /// @returns the point of the mesh that is nearest to a place.
  std::int64_t FindNearest(double x, double y) const
  {
    std::int64_t nearest = 0;
    double least = 8.0; // more than the square is wide
    for (std::int64_t i = 0; i < this->Mesh.NumberOfPoints(); ++i)
    {
      const double dx = this->Mesh.Points[3 * i] - x;
      const double dy = this->Mesh.Points[3 * i + 1] - y;
      if (dx * dx + dy * dy < least)
      {
        least = dx * dx + dy * dy;
        nearest = i;
      }
    }
    return nearest;
  }

  void Add(std::int64_t from, std::int64_t to)
  {
    this->Made.Ends.insert(this->Made.Ends.end(), { from, to });
    this->Made.ToInsert.push_back(1);
  }

  LongConstraints Made;

private:
  const OwnedMesh<float>& Mesh;
  int Lines;
};
}

TriangleMesh LongConstraints::AddTo(TriangleMesh mesh) const
{
  mesh.ConstraintEdges = this->Ends.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->ToInsert.size());
  mesh.ConstraintsToInsert = this->ToInsert.data();
  return mesh;
}

LongConstraints MakeLines(const OwnedMesh<float>& mesh, int lines)
{
  LineMaker maker(mesh, lines);
  for (int line = 0; line < lines; ++line)
  {
    const double y = maker.GetMiddle(line);
    maker.Add(maker.FindNearest(Margin, y), maker.FindNearest(1.0 - Margin, y));
  }
  return maker.Made;
}

LongConstraints MakeNet(const OwnedMesh<float>& mesh, int lines)
{
  LineMaker maker(mesh, lines);
  std::vector<std::int64_t> nodes; // row by row
  for (int place = 0; place < lines * lines; ++place)
  {
    nodes.push_back(
      maker.FindNearest(maker.GetMiddle(place % lines), maker.GetMiddle(place / lines)));
  }
  for (int one = 0; one < lines; ++one)
  {
    for (int next = 1; next < lines; ++next)
    {
      maker.Add(nodes[one * lines + next - 1], nodes[one * lines + next]);
      maker.Add(nodes[(next - 1) * lines + one], nodes[next * lines + one]);
    }
  }
  return maker.Made;
}

}
