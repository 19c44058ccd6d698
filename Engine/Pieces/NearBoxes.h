// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_NEARBOXES_H
#define DELAUNAYFLIP_NEARBOXES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

struct Box
{
  double Lower[3], Upper[3];

  bool Holds(const double (&x)[3]) const
  {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      holds = holds && this->Lower[axis] <= x[axis] && x[axis] <= this->Upper[axis];
    }
    return holds;
  }
};

/// Finds the boxes of other ranks that hold a point, without a test of each box: the box of this
/// rank is cut into slabs along each axis, and every slab knows which boxes reach it.
class NearBoxes
{
public:
  /// @param boxes one per rank.
  NearBoxes(std::vector<Box> boxes, int rank)
    : Boxes(std::move(boxes)),
      Rank(rank)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double size = this->GetOwn().Upper[axis] - this->GetOwn().Lower[axis];
      this->Scale[axis] = size > 0.0 ? Slabs / size : 0.0;
      for (std::size_t other = 0; other < this->Boxes.size(); ++other)
      {
        this->AddBox(other, axis);
      }
    }
  }

  template <typename Visit>
  void ForEachOther(const Visit& visit) const
  {
    for (std::size_t other = 0; other < this->Boxes.size(); ++other)
    {
      if (static_cast<int>(other) != this->Rank)
      {
        visit(static_cast<int>(other));
      }
    }
  }

  /// Calls visit(rank) for every other rank whose box holds a point.
  /// @param x must not contain NaN.
  template <typename Visit>
  void ForEachHolding(const double (&x)[3], const Visit& visit) const
  {
    std::uint64_t bits = ~std::uint64_t(0);
    for (int axis = 0; axis < 3; ++axis)
    {
      bits &= this->BoxesAt[axis][this->FindSlab(axis, x[axis])];
    }
    for (; bits != 0; bits &= bits - 1) // which removes the lowest one
    {
      for (std::size_t other = __builtin_ctzll(bits); other < this->Boxes.size(); other += Bits)
      {
        if (static_cast<int>(other) != this->Rank && this->Boxes[other].Holds(x))
        {
          visit(static_cast<int>(other));
        }
      }
    }
  }

private:
  const Box& GetOwn() const { return this->Boxes[this->Rank]; }

  static constexpr int Slabs = 256;
  static constexpr std::size_t Bits = 64;

  /// Never decreases as x grows. So a box reaches the slabs from that of its lower end to that of
  /// its upper end.
  int FindSlab(int axis, double x) const
  {
    const double slab = (x - this->GetOwn().Lower[axis]) * this->Scale[axis];
    return slab > 0.0 ? static_cast<int>(std::min(slab, Slabs - 1.0)) : 0;
  }

  void AddBox(std::size_t rank, int axis)
  {
    const Box& box = this->Boxes[rank];
    if (static_cast<int>(rank) == this->Rank || !(box.Lower[axis] <= box.Upper[axis]))
    {
      return; // its own box, or one without points
    }
    const int last = this->FindSlab(axis, box.Upper[axis]);
    for (int slab = this->FindSlab(axis, box.Lower[axis]); slab <= last; ++slab)
    {
      this->BoxesAt[axis][slab] |= std::uint64_t(1) << rank % Bits;
    }
  }

  std::vector<Box> Boxes;
  int Rank;
  double Scale[3];
  /// For each slab, one bit per rank whose box reaches it. Beyond 64 ranks, ranks share bits.
  std::array<std::array<std::uint64_t, Slabs>, 3> BoxesAt{};
};

}

#endif
