// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamHalves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace delaunayflip
{

namespace
{
/// A coordinate of the place of an edge; NaN counts as 0, because it has no order.
double GetPlace(const BadSeam& seam, int axis)
{
  return std::isnan(seam.Place[axis]) ? 0.0 : seam.Place[axis];
}
}

SeamHalves::SeamHalves(const std::vector<BadSeam>& bad)
{
  std::unordered_map<int, std::vector<const BadSeam*>> seamsTo;
  for (const BadSeam& seam : bad)
  {
    seamsTo[seam.OtherRank].push_back(&seam);
  }
  for (auto& [rank, seams] : seamsTo)
  {
    this->Cuts.emplace(rank, FindCut(std::move(seams)));
  }
}

bool SeamHalves::IsInSecond(const BadSeam& seam) const
{
  const Cut& cut = this->Cuts.at(seam.OtherRank);
  return GetPlace(seam, cut.Axis) >= cut.Median;
}

SeamHalves::Cut SeamHalves::FindCut(std::vector<const BadSeam*> seams)
{
  const auto compare = [](int axis)
  {
    return [axis](const BadSeam* a, const BadSeam* b)
    { return GetPlace(*a, axis) < GetPlace(*b, axis); };
  };
  int longest = 0;
  double most = -1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [least, greatest] = std::minmax_element(seams.begin(), seams.end(), compare(axis));
    const double extent = GetPlace(**greatest, axis) - GetPlace(**least, axis);
    if (extent > most)
    {
      most = extent;
      longest = axis;
    }
  }
  const auto middle = seams.begin() + static_cast<std::ptrdiff_t>(seams.size() / 2);
  std::nth_element(seams.begin(), middle, seams.end(), compare(longest));
  return { longest, GetPlace(**middle, longest) };
}

}
