// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The results of a session, as its caller asks for them.

#include "SessionWork.h"

#include "DeviceCopies.h"

#include <algorithm>

namespace delaunayflip
{

void FlipSession::Implementation::StoreTriangles(const MutableTriangleArray& triangles)
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

void FlipSession::Implementation::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream)
{
  RequireOnDevice(triangles);
  bool isStored = false;
  const auto store = [&]() { isStored = this->Engine->StoreTrianglesOnDevice(triangles, stream); };
  if (this->Engine && this->Try(store) && isStored)
  {
    return;
  }
  const auto pass = [&](auto* ids)
  {
    StoreThroughHost(ids, 3 * triangles.Count, stream,
      [&](auto* host) { this->StoreTriangles(MutableTriangleArray(host, triangles.Count)); });
  };
  triangles.Ids32 ? pass(triangles.Ids32) : pass(triangles.Ids64);
}

void FlipSession::Implementation::StoreFlipCounts(std::int32_t* counts)
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

void FlipSession::Implementation::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream)
{
  const std::int64_t size = this->Mesh.CountTriangles();
  RequireOnDevice(counts, size);
  bool isStored = false;
  const auto store = [&]() { isStored = this->Engine->StoreFlipCountsOnDevice(counts, stream); };
  if (this->Engine && !this->Insertion.HasFlips() && this->Try(store) && isStored)
  {
    return;
  }
  StoreThroughHost(
    counts, size, stream, [this](std::int32_t* host) { this->StoreFlipCounts(host); });
}

/// None if the engine's flips are not all.
EngineTriangles FlipSession::Implementation::ViewTriangles() const
{
  return this->Engine && !this->Insertion.HasFlips() ? this->Engine->ViewTriangles()
                                                     : EngineTriangles();
}

}
