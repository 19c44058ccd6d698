// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointSet.h"

#include "FlipError.h"

#include <limits>

namespace delaunayflip
{

PointSet::PointSet(std::int64_t points, const ThreadBackend& backend)
  : Words(backend.MakeArray<std::uint32_t>((points + WordBits - 1) / WordBits))
{
  std::uint32_t* words = this->Words.Data();
  backend.ForEach(
    static_cast<std::int64_t>(this->Words.Size()), [=](std::int64_t i) { words[i] = 0; });
}

void PointSet::Number(const ThreadBackend& backend)
{
  const auto size = static_cast<std::int64_t>(this->Words.Size());
  this->Firsts = backend.MakeArray<std::uint32_t>(size);
  std::uint32_t* firsts = this->Firsts.Data();
  const std::uint32_t* words = this->Words.Data();
  const auto count = [=](std::int64_t i) { return __builtin_popcount(words[i]); };
  const ThreadNumbering numbering = backend.Count(size, count);
  if (numbering.Total > std::numeric_limits<std::int32_t>::max())
  {
    throw MeshTooLarge("a piece has more than 2^31 points: divide the mesh into more pieces");
  }
  backend.ForEachNumbered(numbering, size, count,
    [=](std::int64_t i, std::int64_t first) { firsts[i] = static_cast<std::uint32_t>(first); });
  this->Size = numbering.Total;
}

}
