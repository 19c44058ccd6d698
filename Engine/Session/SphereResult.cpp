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

/// Removes the triangles that do not face away from the origin.
void SphereRun::OpenMesh()
{
  if (this->Triangles.empty())
  {
    this->TriangulateOnePlane();
  }
  std::vector<unsigned char> isRemoved(this->Triangles.size() / 3);
  for (std::size_t t = 0; t < isRemoved.size(); ++t)
  {
    isRemoved[t] = int(!FacesOutside(this->Points, &this->Triangles[3 * t], Origin));
  }
  this->Opened = std::count(isRemoved.begin(), isRemoved.end(), 1);
  if (this->Opened > 0)
  {
    this->DropTriangles(isRemoved);
  }
}

/// Triangulates points that all lie in one plane. They have a convex hull together with one more
/// point, just beyond the origin and opposite to their middle. The triangles of that point are
/// dropped. Nothing is made if the plane passes through the origin, or if all points are in one
/// line. The added point is so near to the origin that it hides no triangle that faces away from
/// the origin, even if rounding has moved points out of the plane.
void SphereRun::TriangulateOnePlane()
{
  this->LeaveOut(this->ListActive(), PointState::LeftOut);
  this->MarkRepeatedLeftOut();
  std::replace(this->States.begin(), this->States.end(), PointState::LeftOut, PointState::Used);
  std::vector<PlanePoint> places;
  for (const std::int32_t id : this->ListActive())
  {
    places.push_back(this->Points[id]);
  }
  std::sort(places.begin(), places.end(), IsFartherNorth); // for sums that depend on places alone
  PlanePoint opposite{ 0.0, 0.0, 0.0 };
  constexpr double Near = 0x1p-60;
  const double share = Near / static_cast<double>(places.size());
  for (const PlanePoint& place : places)
  {
    opposite.U -= share * place.U;
    opposite.V -= share * place.V;
    opposite.W -= share * place.W;
  }
  const auto added = static_cast<std::int32_t>(this->Points.size());
  this->Points.push_back(opposite);
  this->States.push_back(PointState::Used);
  this->UsedPoint.push_back(added);
  this->Starts = 0;
  this->FirstSimplex.clear();
  this->MakeHull();
  std::vector<unsigned char> isRemoved(this->Triangles.size() / 3);
  for (std::size_t corner = 0; corner < this->Triangles.size(); ++corner)
  {
    if (this->Triangles[corner] == added)
    {
      isRemoved[corner / 3] = 1;
    }
  }
  this->DropTriangles(isRemoved);
  this->Points.pop_back();
  this->States.pop_back();
  this->UsedPoint.pop_back();
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
  inPlane.Detail = this->Options.Projection == ProjectionKind::OpenSphere
    ? "there are fewer than three places, or all are on one great circle, except for rounding"
    : "there are fewer than four places, or all are in one plane, except for rounding";
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
  const bool isWithoutHull = this->IsOver() && !this->HasHull;
  if (isWithoutHull)
  {
    std::fill_n(ids, this->Input.Points.Count, std::int64_t(-1));
    return;
  }
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

std::string SphereRun::ExplainRefusal() const
{
  return "on a sphere, points cannot be inserted, moved, removed or compacted, and triangles "
         "cannot "
         "be stored in order";
}

}
