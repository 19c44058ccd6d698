// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InputChecks.h"
#include "SmallestAngle.h"
#include "SphereRun.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <numeric>
#include <utility>

/// @file
/// What a run on a sphere reports and stores.

namespace delaunayflip
{

/// Makes the triangle of three places, which is an open mesh. Nothing is made if there are more or
/// fewer, or if they are on a great circle.
void SphereRun::MakeOneTriangle()
{
  for (const std::int32_t id : this->ListActive())
  {
    this->States[id] = PointState::LeftOut;
  }
  this->MarkRepeatedLeftOut();
  std::vector<std::int32_t> places;
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    if (this->States[i] == PointState::LeftOut)
    {
      this->States[i] = PointState::Used;
      places.push_back(static_cast<std::int32_t>(i));
    }
  }
  if (places.size() != 3)
  {
    return;
  }
  const int side = FindOrientation3D(
    this->Points[places[0]], this->Points[places[1]], this->Points[places[2]], Origin);
  if (side < 0)
  {
    std::swap(places[1], places[2]);
  }
  if (side != 0)
  {
    this->Triangles = places;
    this->FlipCounts.assign(1, 0);
    StartSums sums;
    sums.Angles.Add(MeasureTriangle(this->Points.data(), places.data()));
    this->ReportStart(sums);
  }
}

/// Removes the triangles that do not face away from the origin.
void SphereRun::OpenMesh()
{
  if (this->Triangles.empty())
  {
    this->MakeOneTriangle();
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; 3 * t < this->Triangles.size(); ++t)
  {
    if (FacesOutside(this->Points, &this->Triangles[3 * t], Origin))
    {
      std::copy_n(&this->Triangles[3 * t], 3, &this->Triangles[3 * kept]);
      this->FlipCounts[kept++] = this->FlipCounts[t];
    }
  }
  this->Opened = SizeOf(this->Triangles) / 3 - std::int64_t(kept);
  this->Triangles.resize(3 * kept);
  this->FlipCounts.resize(kept);
  if (this->Opened > 0)
  {
    this->Neighbors.clear();
  }
}

void SphereRun::Complete()
{
  FlipReport& report = this->Report;
  report.Points = this->Input.Points.Count;
  report.GeometryUsed = GeometryKind::Sphere;
  report.GeometryReason = "points are triangulated on a sphere";
  report.FromPoints = PointCounts();
  report.Defects.clear();
  report.StopReason = StopReasonKind::Converged;
  if (report.Backend.empty()) // no other session was needed
  {
    report.Backend = ThreadBackend(this->Options.NumberOfThreads).GetName();
    report.Tolerance = "none";
  }
  report.BuildSeconds += this->Planar.BuildSeconds;
  report.FlipSeconds += this->Planar.FlipSeconds;
  report.FromPoints.LargeTriangles = this->Opened;
  std::int64_t boundary = 0;
  if (this->OnDevice)
  {
    report.Triangles = this->OnDevice->CountTriangles();
  }
  else
  {
    this->FindNeighborsOnce();
    report.Triangles = SizeOf(this->Triangles) / 3;
    boundary = std::count(this->Neighbors.begin(), this->Neighbors.end(), -1);
  }
  report.Edges = EdgeCounts();
  report.Edges.Edges = (3 * report.Triangles + boundary) / 2;
  report.Edges.Boundary = report.Edges.Fixed = boundary;
  KeepAnglesBefore({}, report); // nobody sees the triangles from which flips begin
  this->ListUnused();
  this->CountSegments();
  this->ListRemoved();
  report.EulerCharacteristic = report.FromPoints.Used - report.Edges.Edges + report.Triangles;
}

/// Marks the points that have no triangle in the complete mesh.
void SphereRun::MarkInside()
{
  std::vector<char> hasTriangle(this->Points.size());
  for (const std::int32_t id : this->Triangles)
  {
    hasTriangle[id] = 1;
  }
  this->HasHull = !this->Triangles.empty();
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    const bool isUsed =
      this->States[i] != PointState::NotFinite && this->States[i] != PointState::Repeated;
    if (this->HasHull && isUsed && hasTriangle[i] == 0)
    {
      this->States[i] = PointState::Inside;
    }
  }
}

/// Counts the points that have triangles, and counts and names those that are not used.
void SphereRun::ListUnused()
{
  if (this->OnDevice)
  {
    this->Report.FromPoints.Used = this->Report.Points;
    return;
  }
  std::vector<char> hasTriangle(this->Points.size());
  for (const std::int32_t id : this->Triangles)
  {
    hasTriangle[id] = 1;
  }
  FlipReport& report = this->Report;
  PointCounts& counts = report.FromPoints;
  counts.Used = std::count(hasTriangle.begin(), hasTriangle.end(), 1);
  Defect notFinite(DefectKind::PointsNotFinite), repeated(DefectKind::PointsRepeated),
    inside(DefectKind::PointsInside);
  const auto note = [](Defect& defect, std::int64_t id)
  {
    ++defect.Count;
    if (SizeOf(defect.FirstIds) < MostNamedIds)
    {
      defect.FirstIds.push_back(id);
    }
  };
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    const auto id = static_cast<std::int64_t>(i);
    if (this->States[i] == PointState::NotFinite)
    {
      note(notFinite, id);
    }
    else if (this->States[i] == PointState::Repeated)
    {
      note(repeated, id);
    }
    else if (this->HasHull && this->States[i] == PointState::Inside)
    {
      note(inside, id);
    }
  }
  counts.NotFinite = notFinite.Count;
  counts.Repeated = repeated.Count;
  counts.Inside = inside.Count;
  Defect inPlane(DefectKind::PointsInOnePlane);
  inPlane.Count = this->HasHull ? 0 : report.Points;
  for (const Defect& defect : { notFinite, repeated, inside, inPlane })
  {
    AddDefect(defect, report.Defects);
  }
}

//------------------------------------------------------------------------------
void SphereRun::StoreTriangles(const MutableTriangleArray& triangles)
{
  this->Fetch();
  for (std::int64_t t = 0; t < triangles.Count; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      triangles.Set(t, slot, this->Triangles[3 * t + slot]);
    }
  }
}

void SphereRun::StoreFlipCounts(std::int32_t* counts)
{
  std::fill_n(counts, this->Report.Triangles, 0); // those on a device have not flipped
  std::copy(this->FlipCounts.begin(), this->FlipCounts.end(), counts);
}

void SphereRun::StoreNeighbors(std::int32_t* neighbors)
{
  this->Fetch();
  std::copy(this->Neighbors.begin(), this->Neighbors.end(), neighbors);
}

void SphereRun::StoreUsedPoints(std::int64_t* ids)
{
  std::iota(ids, ids + this->Input.Points.Count, std::int64_t(0));
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    ids[i] = this->FindUsed(static_cast<std::int64_t>(i));
  }
}

/// The point that is used at the place of a point; -1: none.
std::int64_t SphereRun::FindUsed(std::int64_t point) const
{
  std::int64_t place = point;
  while (this->States[place] == PointState::Repeated)
  {
    place = this->UsedPoint[place];
  }
  const bool isUsed =
    this->States[place] == PointState::Used || this->States[place] == PointState::LeftOut;
  return isUsed ? place : -1;
}

void SphereRun::StoreRegions(std::int32_t* labels)
{
  std::fill_n(labels, this->Report.Triangles, 0);
}

}
