// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

#include "SessionWork.h"

namespace delaunayflip
{

FlipSession::FlipSession(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Work(SessionWork::Make(CallerMesh(mesh), options, progress))
{
}

FlipSession::FlipSession(
  const DeviceMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Work(SessionWork::Make(CallerMesh(mesh), options, progress))
{
}

FlipSession::~FlipSession() = default;
FlipSession::FlipSession(FlipSession&&) noexcept = default;
FlipSession& FlipSession::operator=(FlipSession&&) noexcept = default;

bool FlipSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  return this->Work->Advance(iterations, observer, progress);
}

const FlipReport& FlipSession::GetReport() const { return this->Work->GetReport(); }

void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  this->Work->StoreTriangles(triangles);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts) const
{
  this->Work->StoreFlipCounts(counts);
}

void FlipSession::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream) const
{
  this->Work->StoreTriangles(triangles, stream);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const
{
  this->Work->StoreFlipCounts(counts, stream);
}

EngineTriangles FlipSession::ViewTriangles() const { return this->Work->ViewTriangles(); }
HostTriangles FlipSession::ViewHostTriangles() const { return this->Work->ViewHostTriangles(); }

}
