// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamHalves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace delaunayflip
{

SeamHalves::SeamHalves(const std::vector<BadSeam>& bad, const PieceMesh& mesh)
  : Mesh(mesh)
{
  std::unordered_map<int, std::vector<Place>> placesOf;
  for (const BadSeam& seam : bad)
  {
    placesOf[seam.OtherRank].push_back(this->GetPlace(seam));
  }
  for (auto& [rank, places] : placesOf)
  {
    this->Cuts.emplace(rank, FindCut(std::move(places)));
  }
}

SeamHalves::Place SeamHalves::GetPlace(const BadSeam& seam) const
{
  const std::int32_t* points = this->Mesh.Triangles[seam.Triangle].Points;
  const std::int32_t* end = std::find_if(points, points + 3,
    [&](std::int32_t point) { return this->Mesh.GetKey(point) == seam.Ends[0]; });
  double x[3];
  this->Mesh.GetPosition(*end, x);
  const auto clean = [](double value) { return std::isnan(value) ? 0.0 : value; };
  return { clean(x[0]), clean(x[1]), clean(x[2]) };
}

SeamHalves::Cut SeamHalves::FindCut(std::vector<Place> places)
{
  const auto compare = [](int axis)
  { return [axis](const Place& a, const Place& b) { return a[axis] < b[axis]; }; };
  int longest = 0;
  double most = -1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [least, greatest] = std::minmax_element(places.begin(), places.end(), compare(axis));
    const double extent = (*greatest)[axis] - (*least)[axis];
    if (extent > most)
    {
      most = extent;
      longest = axis;
    }
  }
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end(), compare(longest));
  return { longest, (*middle)[longest] };
}

}
