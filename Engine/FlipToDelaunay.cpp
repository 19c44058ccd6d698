// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

/// @file
/// The whole run in one call.

namespace delaunayflip
{

namespace
{
/// Runs a new session and calls store(session).
template <typename Store>
FlipReport RunToEnd(FlipSession session, const FlipObserver& observer,
  const ProgressObserver& progress, const Store& store)
{
  if (session.GetReport().StopReason != StopReasonKind::Aborted)
  {
    session.Advance(-1, observer, progress);
  }
  FlipReport report = session.GetReport(); // before anything is written: it takes memory
  store(session);
  if (session.GetReport().Fallback != report.Fallback) // a GPU may fail while its result is fetched
  {
    report = session.GetReport();
  }
  return report;
}
}

FlipReport FlipToDelaunay(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  return RunToEnd(FlipSession(mesh, options, progress), observer, progress,
    [&](const FlipSession& session) { session.StoreTriangles(triangles); });
}

FlipReport FlipToDelaunay(const DeviceMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  return RunToEnd(FlipSession(mesh, options, progress), observer, progress,
    [&](const FlipSession& session) { session.StoreTriangles(triangles, mesh.Stream); });
}

}
