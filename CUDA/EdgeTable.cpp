// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeTable.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
/// Share of slots in use when every expected edge is in: searches stay short, memory small.
constexpr double FillFactor = 0.6;
}

EdgeTable::EdgeTable(
  std::int64_t edges, std::int64_t vertices, bool withWords, const ThreadBackend& backend)
  : NumberOfVertices(static_cast<std::uint32_t>(std::max<std::int64_t>(1, vertices)))
{
  const std::int64_t wanted = static_cast<std::int64_t>(edges / FillFactor) + 64;
  const std::int64_t capacity = std::min<std::int64_t>(wanted, EdgeTableView::NoSlot);
  this->Keys = Array<std::uint64_t>(capacity);
  if (withWords)
  {
    this->First = Array<std::uint32_t>(capacity);
    this->Second = Array<std::uint32_t>(capacity);
  }
  this->Clear(backend);
}

EdgeTableView EdgeTable::View()
{
  const std::uint64_t capacity = this->Keys.Size();
  return { this->Keys.Data(), this->First.Data(), this->Second.Data(),
    static_cast<std::uint32_t>(capacity),
    (capacity << EdgeTableView::StrideBits) / this->NumberOfVertices };
}

void EdgeTable::Clear(const ThreadBackend& backend)
{
  backend.ForRange(this->GetCapacity(),
    [this](std::int64_t begin, std::int64_t end)
    {
      std::fill(&this->Keys[begin], &this->Keys[0] + end, EdgeTableView::Empty);
      if (this->First.Size())
      {
        std::fill(&this->First[begin], &this->First[0] + end, NoCorner);
        std::fill(&this->Second[begin], &this->Second[0] + end, NoCorner);
      }
    });
}

void EdgeTable::DropWords()
{
  this->First = Array<std::uint32_t>();
  this->Second = Array<std::uint32_t>();
}

}
