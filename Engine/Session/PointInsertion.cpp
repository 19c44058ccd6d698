// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "Array.h"
#include "FlipError.h"
#include "InputChecks.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// @file
/// How the run of points takes in more of them.

namespace delaunayflip
{
namespace
{

/// Coordinates in the precision of other points.
std::vector<double> RoundLike(const PlaneArray& points, const PlaneArray& others)
{
  std::vector<double> places;
  places.reserve(2 * points.Count);
  for (std::int64_t i = 0; i < 2 * points.Count; ++i)
  {
    const double coordinate = points.Get(i / 2, static_cast<int>(i % 2));
    places.push_back(others.Floats ? static_cast<float>(coordinate) : coordinate);
  }
  return places;
}

}

bool PointRun::Insert(const PlaneArray& points, const ProgressObserver& progress)
{
  const std::int64_t before = this->Points.GetCaller().Points.Count;
  CheckPointCount(before + points.Count);
  if (points.Count == 0)
  {
    return true;
  }
  if (this->Points.GetCaller().Sizes != nullptr)
  {
    throw InvalidOptions("points have no sizes here, so they cannot be inserted where others have: "
                         "triangulate all points with their sizes");
  }
  const bool mayStay = this->CanInsertInPlace(points);
  try
  {
    this->Points.Append(points);
    const bool isThere = mayStay && this->InsertInPlace(points.Count);
    if (!isThere)
    {
      this->Reset();
      this->Advance(-1, {}, progress);
    }
  }
  catch (...)
  {
    this->Reset(); // some points may be in the mesh, and others not
    throw;
  }
  return this->Report.StopReason != StopReasonKind::Aborted;
}

/// Whether this has become a constrained Delaunay triangulation of the caller's points alone.
bool PointRun::IsDelaunay() const
{
  const PointOptions& options = this->Points.GetOptions();
  const bool isSplit = options.SplitCrossings && this->Points.GetCaller().NumberOfSegments > 0;
  const bool isOfCaller = !this->WantsRefinement && options.PointTolerance == 0.0 && !isSplit;
  return isOfCaller && this->Loaded && this->IsOver() && this->Found.Bad == 0;
}

/// Whether so many points are inserted or removed in less time than all are triangulated anew. That
/// is so up to about a tenth of all on one thread, and a thirtieth on a GPU.
bool PointRun::AreFew(std::int64_t points) const
{
  constexpr std::int64_t Share = 32, Always = 64;
  return points <= this->Points.GetCaller().Points.Count / Share + Always;
}

/// Whether no limit may end the flips, the points are few, and none of them is in a triangle that
/// was removed. Whether all are in the hull is found out while they are inserted.
bool PointRun::CanInsertInPlace(const PlaneArray& points)
{
  const bool hasNoLimit = this->Points.GetOptions().MaximumIterations < 0;
  const bool mayStay = hasNoLimit && this->Report.Triangles > 0 && this->AreFew(points.Count) &&
    this->IsDelaunay() && this->MaySegmentsStay();
  if (!mayStay)
  {
    return false;
  }
  if (!this->Result.HasRemoved())
  {
    return true;
  }
  const std::vector<double> places = RoundLike(points, this->Points.GetCaller().Points);
  std::vector<std::int32_t> triangles(points.Count);
  PlaceQuery query;
  query.Places = PlaneArray(places.data(), points.Count, 2);
  query.Triangles = triangles.data();
  this->Ask(query, {});
  return std::all_of(
    triangles.begin(), triangles.end(), [](std::int32_t triangle) { return triangle >= 0; });
}

/// Inserts the last points.
/// @returns false if all points have to be triangulated anew.
bool PointRun::InsertInPlace(std::int64_t count)
{
  const std::int64_t all = this->Points.GetCaller().Points.Count;
  if (this->BatchEnds.empty())
  {
    this->BatchEnds.push_back(all - count);
  }
  const std::size_t batch = this->BatchEnds.size() - 1;
  this->BatchEnds.push_back(all);
  const StopWatch watch;
  this->Points.Prepare(this->Observer);
  MotionResult inserted;
  const bool isLoaded =
    this->TryOnBackend([&](LoadedMesh& mesh) { inserted = this->InsertBatch(mesh, batch); });
  if (!isLoaded)
  {
    return true; // an observer has stopped it
  }
  this->Journal.push_back({ this->Stages.size() - 1, static_cast<std::int64_t>(batch) });
  if (!inserted.IsThere || !this->JudgeAgain(inserted))
  {
    return false;
  }
  this->RecordMotion(inserted);
  this->Report.FlipSeconds = watch.GetSeconds();
  return true;
}

/// @returns what LoadedMesh::InsertPoints does.
MotionResult PointRun::InsertBatch(LoadedMesh& mesh, std::size_t batch) const
{
  const PlaneArray& all = this->Points.GetInput().Points;
  const std::int64_t begin = this->BatchEnds[batch];
  const std::int64_t count = this->BatchEnds[batch + 1] - begin;
  const auto skip = [&](const auto* values)
  { return PlaneArray(values + all.Stride * begin, count, all.Stride); };
  std::vector<double> places(2 * count);
  CopyCoordinates(all.Floats ? skip(all.Floats) : skip(all.Doubles), places.data());
  return mesh.InsertPoints(places, this->Points.GetCaller().NumberOfSegments > 0);
}

}
