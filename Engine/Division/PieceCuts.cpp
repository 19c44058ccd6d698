// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceCuts.h"

#include "Records.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{

PieceCuts::PieceCuts(const TriangleMesh& mesh, const std::vector<int>& axes, int pieces)
  : Axes(axes)
{
  constexpr std::int64_t LargestSample = 1 << 20;
  const std::int64_t triangles = mesh.Triangles.Count;
  const bool isSample = triangles > LargestSample;
  std::vector<Center> centers(isSample ? LargestSample : triangles);
  for (std::size_t i = 0; i < centers.size(); ++i)
  {
    // Scattered, because neighbours in the array may be neighbours in space.
    const auto t = isSample ? static_cast<std::int64_t>(ScatterBits(i) % triangles)
                            : static_cast<std::int64_t>(i);
    centers[i] = GetCenter(mesh, t);
  }
  this->First = this->Divide(centers.data(), centers.data() + centers.size(), 0, pieces);
}

/// Three times the centre of a triangle; NaN counts as 0.
PieceCuts::Center PieceCuts::GetCenter(const TriangleMesh& mesh, std::int64_t triangle)
{
  Center center{ 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      center[axis] += mesh.Points.Get(mesh.Triangles.Get(triangle, slot), axis);
    }
    center[axis] = std::isnan(center[axis]) ? 0.0 : center[axis];
  }
  return center;
}

int PieceCuts::FindPiece(const TriangleMesh& mesh, std::int64_t triangle) const
{
  const Center center = GetCenter(mesh, triangle);
  int part = this->First;
  while (part >= 0)
  {
    const Cut& cut = this->Cuts[part];
    part = cut.Parts[center[cut.Axis] < cut.Value ? 0 : 1];
  }
  return ~part;
}

int PieceCuts::FindLongestAxis(const Center* begin, const Center* end) const
{
  int longest = this->Axes.front();
  double length = -1.0;
  for (const int axis : this->Axes)
  {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -lower;
    for (const Center* one = begin; one != end; ++one)
    {
      lower = std::min(lower, (*one)[axis]);
      upper = std::max(upper, (*one)[axis]);
    }
    if (upper - lower > length)
    {
      length = upper - lower;
      longest = axis;
    }
  }
  return longest;
}

/// @returns the part that a range of the sample belongs to.
int PieceCuts::Divide(Center* begin, Center* end, int firstPiece, int pieces)
{
  if (pieces == 1 || begin == end)
  {
    return ~firstPiece;
  }
  const int axis = this->FindLongestAxis(begin, end);
  Center* middle = begin + (end - begin) / pieces * (pieces / 2);
  std::nth_element(
    begin, middle, end, [=](const Center& a, const Center& b) { return a[axis] < b[axis]; });
  const double value = (*middle)[axis];
  // Equal centres stay together.
  middle = std::partition(begin, end, [=](const Center& one) { return one[axis] < value; });
  const auto cut = static_cast<int>(this->Cuts.size());
  this->Cuts.push_back({ axis, value, {} });
  const int first = this->Divide(begin, middle, firstPiece, pieces / 2);
  const int second = this->Divide(middle, end, firstPiece + pieces / 2, pieces - pieces / 2);
  this->Cuts[cut].Parts[0] = first;
  this->Cuts[cut].Parts[1] = second;
  return cut;
}

}
