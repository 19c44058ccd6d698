// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The results of a session, as its caller asks for them.

#include "WholeSession.h"

#include <algorithm>

namespace delaunayflip
{

void WholeSession::StoreTriangles(const MutableTriangleArray& triangles)
{
  const bool isInput = this->Mesh.HasTriangles(triangles.Data());
  if (this->Engine && this->Try([&]() { this->Engine->StoreTriangles(triangles, isInput); }))
  {
    return;
  }
  const TriangleArray& input = this->Mesh.GetOnHost().Triangles;
  for (std::int64_t id = 0; id < 3 * triangles.Count; ++id)
  {
    const int slot = static_cast<int>(id % 3);
    triangles.Set(id / 3, slot, input.Get(id / 3, slot));
  }
}

bool WholeSession::TryToStoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream)
{
  bool isStored = false;
  const auto store = [&]() { isStored = this->Engine->StoreTrianglesOnDevice(triangles, stream); };
  return this->Engine && this->Try(store) && isStored;
}

void WholeSession::StoreFlipCounts(std::int32_t* counts)
{
  const auto store = [&]()
  {
    this->Engine->StoreFlipCounts(counts);
    this->Insertion.AddFlipCounts(counts);
  };
  if (!this->Engine || !this->Try(store))
  {
    std::fill_n(counts, this->Mesh.CountTriangles(), 0);
  }
}

bool WholeSession::TryToStoreFlipCounts(std::int32_t* counts, const DeviceStream& stream)
{
  bool isStored = false;
  const auto store = [&]() { isStored = this->Engine->StoreFlipCountsOnDevice(counts, stream); };
  return this->Engine && !this->Insertion.HasFlips() && this->Try(store) && isStored;
}

/// None if the engine's flips are not all.
EngineTriangles WholeSession::ViewTriangles() const
{
  return this->Engine && !this->Insertion.HasFlips() ? this->Engine->ViewTriangles()
                                                     : EngineTriangles();
}

HostTriangles WholeSession::ViewHostTriangles() const
{
  return this->Engine && !this->Insertion.HasFlips() ? this->Engine->ViewHostTriangles()
                                                     : HostTriangles();
}

}
