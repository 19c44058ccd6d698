// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTGROUPS_H
#define DELAUNAYFLIP_CONSTRAINTGROUPS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace delaunayflip
{

/// Disjoint groups of constraints (union-find). A group is named by its first constraint.
class ConstraintGroups
{
public:
  explicit ConstraintGroups(std::size_t size)
    : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  std::int32_t GetFirst(std::int32_t constraint)
  {
    while (this->Parents[constraint] != constraint)
    {
      std::int32_t& parent = this->Parents[constraint];
      parent = this->Parents[parent]; // halves the chain
      constraint = parent;
    }
    return constraint;
  }

  void Join(std::int32_t a, std::int32_t b)
  {
    const auto [first, second] = std::minmax({ this->GetFirst(a), this->GetFirst(b) });
    this->Parents[second] = first;
  }

private:
  std::vector<std::int32_t> Parents;
};

}

#endif
