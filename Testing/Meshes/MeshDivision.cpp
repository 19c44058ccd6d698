// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshDivision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace delaunayflip
{

namespace
{
/// Some triangles of a mesh, which may be put into another order.
struct TriangleRange
{
  std::int64_t* Begin;
  std::int64_t* End;
};

class Divider
{
public:
  explicit Divider(const TriangleMesh& mesh)
    : Mesh(mesh),
      Order(mesh.Triangles.Count),
      Local(mesh.Points.Count)
  {
    std::iota(this->Order.begin(), this->Order.end(), 0);
  }

  std::vector<OwnPiece> Divide(int pieces)
  {
    this->Cut({ this->Order.data(), this->Order.data() + this->Order.size() }, pieces);
    return std::move(this->Pieces);
  }

private:
  /// Three times the centre of a triangle; NaN counts as 0.
  double GetCenter(std::int64_t triangle, int axis) const
  {
    double sum = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      sum += this->Mesh.Points.Get(this->Mesh.Triangles.Get(triangle, slot), axis);
    }
    return std::isnan(sum) ? 0.0 : sum;
  }

  int FindLongestAxis(const TriangleRange& range) const
  {
    double extents[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      double lower = std::numeric_limits<double>::infinity();
      double upper = -lower;
      for (const std::int64_t* t = range.Begin; t != range.End; ++t)
      {
        lower = std::min(lower, this->GetCenter(*t, axis));
        upper = std::max(upper, this->GetCenter(*t, axis));
      }
      extents[axis] = upper - lower;
    }
    return static_cast<int>(std::max_element(extents, extents + 3) - extents);
  }

  /// Cuts a range until each part is one piece.
  void Cut(const TriangleRange& range, int pieces)
  {
    if (pieces == 1)
    {
      std::sort(range.Begin, range.End);
      this->AddPiece(range);
      return;
    }
    const int axis = range.Begin == range.End ? 0 : this->FindLongestAxis(range);
    std::int64_t* middle = range.Begin + (range.End - range.Begin) / pieces * (pieces / 2);
    std::nth_element(range.Begin, middle, range.End,
      [&](std::int64_t a, std::int64_t b)
      {
        const double left = this->GetCenter(a, axis);
        const double right = this->GetCenter(b, axis);
        return left < right || (left == right && a < b);
      });
    this->Cut({ range.Begin, middle }, pieces / 2);
    this->Cut({ middle, range.End }, pieces - pieces / 2);
  }

  void AddPiece(const TriangleRange& range)
  {
    std::fill(this->Local.begin(), this->Local.end(), -1);
    this->Pieces.emplace_back();
    OwnPiece& piece = this->Pieces.back();
    piece.SlotOf.assign(range.Begin, range.End);
    for (const std::int64_t t : piece.SlotOf)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        piece.Triangles.push_back(this->AddPoint(this->Mesh.Triangles.Get(t, slot), piece));
      }
      if (this->Mesh.Regions)
      {
        piece.Regions.push_back(this->Mesh.Regions[t]);
      }
      if (this->Mesh.FrozenTriangles)
      {
        piece.Frozen.push_back(this->Mesh.FrozenTriangles[t]);
      }
    }
  }

  std::int32_t AddPoint(std::int64_t point, OwnPiece& piece)
  {
    std::int32_t& local = this->Local[point];
    if (local < 0)
    {
      local = static_cast<std::int32_t>(piece.PointOf.size());
      piece.PointOf.push_back(point);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double x = this->Mesh.Points.Get(point, axis);
        this->Mesh.Points.Floats ? piece.Floats.push_back(static_cast<float>(x))
                                 : piece.Doubles.push_back(x);
      }
    }
    return local;
  }

  const TriangleMesh& Mesh;
  std::vector<std::int64_t> Order;
  std::vector<std::int32_t> Local; ///< The id of every point in the current piece, or -1.
  std::vector<OwnPiece> Pieces;
};
}

MeshPiece OwnPiece::View() const
{
  MeshPiece piece;
  const auto points = static_cast<std::int64_t>(this->PointOf.size());
  TriangleMesh& mesh = piece.Mesh;
  mesh.Points = this->Doubles.empty() ? PointArray(this->Floats.data(), points)
                                      : PointArray(this->Doubles.data(), points);
  mesh.Triangles =
    TriangleArray(this->Triangles.data(), static_cast<std::int64_t>(this->SlotOf.size()));
  mesh.Regions = this->Regions.empty() ? nullptr : this->Regions.data();
  mesh.FrozenTriangles = this->Frozen.empty() ? nullptr : this->Frozen.data();
  piece.PointNumbers = this->PointOf.data();
  return piece;
}

std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, int pieces)
{
  return Divider(mesh).Divide(pieces);
}

}
