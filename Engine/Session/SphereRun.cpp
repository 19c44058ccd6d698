// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereRun.h"

#include "Array.h"
#include "ExactPredicates.h"
#include "HullInserter.h"
#include "InputChecks.h"
#include "PointPreparation.h"
#include "PointRun.h"
#include "SmallestAngle.h"
#include "SpherePasses.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <type_traits>

namespace delaunayflip
{

namespace
{
constexpr int MostStarts = 50;

void RequirePlainPoints(const PointInput& input, const PointOptions& options)
{
  const auto require = [](bool isValid, const std::string& message)
  {
    if (!isValid)
    {
      throw InvalidOptions(message);
    }
  };
  require(input.Points.Count == 0 || input.Points.Stride >= 3,
    "points on a sphere need x, y and z; PlaceOnSphere makes them from longitudes and latitudes");
  require(input.NumberOfRegions == 0 && !input.Sizes,
    "a triangulation on a sphere cannot have regions or sizes yet");
  require(options.NumberOfPieces <= 1,
    "points cannot be triangulated in several pieces: gather them in one process first");
  require(options.MaximumIterations < 0,
    "a triangulation on a sphere cannot be stopped after a number of iterations");
  PointOptions plain = options;
  const PointOptions defaults;
  ForEachPointOption(
    [&](const char* name, const auto& given, const auto& standard)
    {
      using Option = std::decay_t<decltype(given)>;
      const bool isOfPlane =
        !std::is_same_v<Option, ProjectionKind> && !std::is_same_v<Option, RingRuleKind>;
      require(!isOfPlane || given == standard,
        ToCamelCase(name) + " has no meaning on a sphere yet: leave it out");
    },
    plain, defaults);
}
}

SphereRun::SphereRun(
  const PointInput& input, const PointOptions& options, const ProgressObserver& progress)
  : Input(input),
    Options(options)
{
  CheckOptions(options);
  CheckPointCount(input.Points.Count);
  RequirePlainPoints(input, options);
  CheckSegments(input, 3);
  this->CheckSeeds();
  this->Observer = progress;
  this->Reset();
  this->Stages = { { "triangulate on the sphere", OnStop::Forgets, 0.0,
    Whole([this] { this->Run(); }), {} } };
}

void SphereRun::Reset()
{
  this->Current = 0;
  this->Done = 0.0;
  this->Starts = 0;
  this->FirstSimplex.clear();
  this->DeviceAsker.reset();
  this->Asker.reset();
  this->OnDevice.reset();
  this->Triangles.clear();
  this->Neighbors.clear();
  this->FlipCounts.clear();
  this->States.clear();
  this->Planar = FlipReport();
  this->Opened = 0;
  this->HasHull = false;
  this->Segments.clear();
  this->Edges.clear();
  this->Refused.clear();
  this->Replaced = 0;
  this->Kept = KeptTriangles();
  this->WholeTriangles.clear();
  this->WholeNeighbors.clear();
  this->Numbers.clear();
  this->Report = FlipReport();
  this->Report.Points = this->Input.Points.Count;
  this->Report.GeometryUsed = GeometryKind::Sphere;
  this->Report.GeometryReason = "points are triangulated on a sphere";
  KeepAnglesBefore({}, this->Report);
  KeepAnglesAfter({}, this->Report);
}

bool SphereRun::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
try
{
  if (iterations == 0 || this->IsOver())
  {
    return !this->IsOver();
  }
  const TemporaryValue<ProgressObserver> told(this->Observer, progress);
  this->Reset();
  this->RunStages(this->Stages.size());
  this->TellEnd(observer, progress);
  return false;
}
catch (const RunAborted&)
{
  this->Abort();
  return false;
}
catch (...)
{
  this->Reset();
  throw;
}

void SphereRun::Run()
{
  if (this->RunOnDevice())
  {
    this->HasHull = true;
    this->Complete();
    return;
  }
  this->RunOnHost();
}

void SphereRun::RunOnHost()
{
  this->ReadPoints();
  this->CheckOpposite();
  this->MakeHull();
  if (this->Options.Projection == ProjectionKind::OpenSphere)
  {
    this->OpenMesh();
  }
  if (this->Input.NumberOfSegments + this->Input.NumberOfHoleSeeds > 0)
  {
    this->RequireFacesOutside();
    this->InsertSegments();
  }
  this->MarkInside();
  if (this->Input.Rings || this->Input.NumberOfHoleSeeds > 0)
  {
    this->RemoveTriangles();
  }
  this->Complete();
}

/// Makes the convex hull of the active points. Marks those that are inside. If all are in one
/// plane, there are no triangles.
void SphereRun::MakeHull()
{
  while (this->Start())
  {
    const bool isConvex = this->TakeStart();
    if (!isConvex)
    {
      this->Flip();
    }
    std::vector<std::int32_t> hidden;
    if (this->Report.NonDelaunayAfter > 0)
    {
      hidden = FindHidden(this->Points, this->Triangles, this->FindNeighborsOnce(), this->Center);
    }
    if (this->LeaveOut(hidden, PointState::Inside) || !this->InsertLeftOut())
    {
      continue;
    }
    const bool isSettled = isConvex && !this->HasLeftOut();
    if (isSettled ||
      !this->LeaveOut(
        FindFlat(this->Points, this->Triangles, this->FindNeighborsOnce()), PointState::Inside))
    {
      break;
    }
  }
}

void SphereRun::ReadPoints()
{
  const PlaneArray& given = this->Input.Points;
  const std::int64_t numbers = given.Count == 0 ? 0 : (given.Count - 1) * given.Stride + 3;
  PlaneArray points = given;
  std::vector<float> floats;
  std::vector<double> doubles;
  const auto copy = [&](const auto* values, auto& copied)
  {
    copied.resize(numbers);
    CopyMemory(values, numbers * static_cast<std::int64_t>(sizeof(*values)), copied.data(),
      this->Input.Stream);
    points = PlaneArray(copied.data(), given.Count, given.Stride);
  };
  if (this->Input.OnDevice && given.Floats)
  {
    copy(given.Floats, floats);
  }
  else if (this->Input.OnDevice)
  {
    copy(given.Doubles, doubles);
  }
  this->Points.resize(given.Count);
  this->States.assign(given.Count, PointState::Used);
  this->UsedPoint.resize(given.Count);
  std::iota(this->UsedPoint.begin(), this->UsedPoint.end(), 0);
  for (std::int64_t i = 0; i < given.Count; ++i)
  {
    this->Points[i] = { points.Get(i, 0), points.Get(i, 1), points.Get(i, 2) };
    if (!IsFinite(this->Points[i]))
    {
      this->States[i] = PointState::NotFinite;
    }
  }
}

std::vector<std::int32_t> SphereRun::ListActive() const
{
  std::vector<std::int32_t> active;
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    if (this->States[i] == PointState::Used)
    {
      active.push_back(static_cast<std::int32_t>(i));
    }
  }
  return active;
}

/// Makes a closed mesh in which all triangles face outside, from the points that are not left out,
/// or from four points.
/// @returns false if there is no such mesh because all points lie in one plane.
bool SphereRun::Start()
{
  const ThreadBackend threads(this->Options.NumberOfThreads);
  for (;;)
  {
    const std::vector<std::int32_t> active = this->ListActive();
    const SpherePoints points{ this->Points.data(), active.data(), SizeOf(active) };
    const Simplex simplex = FindSimplex(points, threads);
    if (this->FirstSimplex.empty())
    {
      this->FirstSimplex = simplex;
    }
    this->Triangles.clear();
    this->Neighbors.clear();
    if (simplex.empty() || ++this->Starts > MostStarts)
    {
      return this->StartFromSimplex();
    }
    this->StartInPlane(points, simplex.front());
    if (this->Triangles.empty())
    {
      return this->StartFromSimplex();
    }
    if (this->ChooseCenter(simplex))
    {
      return true;
    }
    this->LeaveOut(FindStrays(this->Points, this->Triangles, this->Center), PointState::LeftOut);
  }
}

/// Triangulates the active points, projected from one of them, the pole. Marks points at the places
/// of others.
void SphereRun::StartInPlane(const SpherePoints& points, const NumberedPoint& pole)
{
  const ThreadBackend threads(this->Options.NumberOfThreads);
  const std::int64_t count = SizeOf(this->Points) - 1;
  const PlaneNumbers numbers{ pole.Id };
  Array<double> places = threads.MakeArray<double>(2 * count);
  if (points.Count <= count)
  {
    std::fill_n(places.Data(), 2 * count, NAN);
  }
  const ProjectionStep project{ points, StereographicProjection(pole.Place), numbers,
    places.Data() };
  const auto unplaced = threads.Sum<std::int64_t>(points.Count, project);
  for (std::int64_t i = 0; unplaced > 0 && i < points.Count; ++i)
  {
    this->MarkUnplaced(points.GetId(i), pole, places.Data());
  }
  PointInput plane;
  plane.Points = PlaneArray(places.Data(), count, 2);
  PointOptions options;
  static_cast<FlipOptions&>(options) = this->Options;
  const ProgressObserver progress = this->TellHalf();
  PointRun run(plane, options, progress);
  run.LeaveAnglesOut();
  AdvanceToEnd(run, progress);
  const FlipReport& report = run.GetReport();
  AddReport(this->Planar, report);
  if (report.FromPoints.Repeated > 0)
  {
    std::vector<std::int64_t> used(count);
    run.StoreUsedPoints(used.data());
    this->MarkRepeated(used, numbers);
  }
  for (std::vector<std::int32_t>* list : { &this->Triangles, &this->Neighbors })
  {
    list->reserve(6 * count); // with those that the pole adds
    list->resize(3 * report.Triangles);
  }
  run.StoreTriangles(MutableTriangleArray(this->Triangles.data(), report.Triangles));
  run.StoreNeighbors(this->Neighbors.data());
  std::int32_t* const ids = this->Triangles.data();
  threads.ForEach(3 * report.Triangles, [=](std::int64_t i) { ids[i] = numbers.GetId(ids[i]); });
  this->JoinPole(pole.Id);
}

/// Marks a point if it is not the pole and the projection cannot place it.
void SphereRun::MarkUnplaced(std::int32_t id, const NumberedPoint& pole, const double* places)
{
  const std::int64_t number = PlaneNumbers{ pole.Id }.GetNumber(id);
  if (id == pole.Id || IsFinite(places[2 * number]))
  {
    return;
  }
  const bool isSame = IsSamePlace(this->Points[id], pole.Place);
  this->UsedPoint[id] = isSame ? pole.Id : id;
  this->States[id] = isSame ? PointState::Repeated : PointState::LeftOut;
}

/// Marks points that another one represents in the plane.
/// @param used by number in the plane, the number that is used at its place, or -1.
void SphereRun::MarkRepeated(const std::vector<std::int64_t>& used, const PlaneNumbers& numbers)
{
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    if (used[i] < 0 || used[i] == static_cast<std::int64_t>(i))
    {
      continue;
    }
    const std::int32_t id = numbers.GetId(static_cast<std::int32_t>(i));
    const std::int32_t other = numbers.GetId(static_cast<std::int32_t>(used[i]));
    const bool isSame = IsSamePlace(this->Points[id], this->Points[other]);
    this->UsedPoint[id] = isSame ? other : id;
    this->States[id] = isSame ? PointState::Repeated : PointState::LeftOut;
  }
}

/// Adds the triangles between a pole and the boundary.
void SphereRun::JoinPole(std::int32_t pole)
{
  const ThreadBackend threads(this->Options.NumberOfThreads);
  const std::int64_t count = SizeOf(this->Triangles) / 3;
  const SphereTriangles inPlane{ this->Triangles.data(), this->Neighbors.data(), count };
  const std::vector<BoundarySide> sides = ListBoundary(inPlane, threads);
  const PoleStar star = MakePoleStar(sides, count, pole);
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    this->Neighbors[sides[i].Corner] = static_cast<std::int32_t>(count + std::int64_t(i));
  }
  this->Triangles.insert(this->Triangles.end(), star.Triangles.begin(), star.Triangles.end());
  this->Neighbors.insert(this->Neighbors.end(), star.Neighbors.begin(), star.Neighbors.end());
}

/// Makes the four triangles of a simplex of points that are not inside. The other points are
/// inserted at the end. If the points that are not inside span no simplex with a center, because
/// coordinates differ by too many powers of ten, the first simplex of all points is taken again.
/// Points at its corners may be inside; they lose their triangles when other points are inserted.
bool SphereRun::StartFromSimplex()
{
  for (PointState& state : this->States)
  {
    state = state == PointState::LeftOut ? PointState::Used : state;
  }
  const std::vector<std::int32_t> active = this->ListActive();
  const SpherePoints points{ this->Points.data(), active.data(), SizeOf(active) };
  Simplex simplex = FindSimplex(points, ThreadBackend(this->Options.NumberOfThreads));
  if (simplex.empty() && ++this->Starts <= MostStarts)
  {
    simplex = this->FirstSimplex;
  }
  if (simplex.empty())
  {
    return false;
  }
  this->LeaveOut(active, PointState::LeftOut);
  for (const NumberedPoint& corner : simplex)
  {
    this->States[corner.Id] = PointState::Used;
  }
  this->Neighbors.clear();
  const std::int32_t a = simplex[0].Id, b = simplex[1].Id, c = simplex[2].Id, d = simplex[3].Id;
  this->Triangles = { a, b, c, b, a, d, c, b, d, a, c, d };
  this->Center = FindCenter(simplex);
  this->TestStart();
  return true;
}

/// Marks points that are left out and are at the place of another such point, or of a corner of the
/// simplex. The projection has found all other repeated points.
void SphereRun::MarkRepeatedLeftOut()
{
  constexpr std::int64_t IdsOfSimplex = 4 * 3;
  const bool isSimplex = SizeOf(this->Triangles) == IdsOfSimplex;
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    const bool isCorner = isSimplex && this->States[i] == PointState::Used;
    if (isCorner || this->States[i] == PointState::LeftOut)
    {
      ids.push_back(static_cast<std::int32_t>(i));
    }
  }
  std::stable_sort(ids.begin(), ids.end(),
    [this](std::int32_t a, std::int32_t b)
    {
      const bool isFirst =
        this->States[a] == PointState::Used && this->States[b] != PointState::Used;
      return IsFartherNorth(this->Points[a], this->Points[b]) ||
        (IsSamePlace(this->Points[a], this->Points[b]) && isFirst);
    });
  for (std::size_t i = 1; i < ids.size(); ++i)
  {
    if (IsSamePlace(this->Points[ids[i]], this->Points[ids[i - 1]]))
    {
      this->States[ids[i]] = PointState::Repeated;
      this->UsedPoint[ids[i]] = ids[i - 1];
    }
  }
}

/// Takes the origin as the center if it is inside of the mesh, else a place inside of the simplex.
/// @returns whether all triangles face outside, seen from there.
bool SphereRun::ChooseCenter(const Simplex& simplex)
{
  const ThreadBackend threads(this->Options.NumberOfThreads);
  const auto faceOutside = [&](const PlanePoint& center)
  {
    this->Center = center;
    this->TestStart();
    const auto countTurned = [&](std::int64_t t, std::int64_t& sum)
    { sum += int(!FacesOutside(this->Points, &this->Triangles[3 * t], center)); };
    return this->Tested.Turned == 0 ||
      threads.Sum<std::int64_t>(SizeOf(this->Triangles) / 3, countTurned) == 0;
  };
  return faceOutside(Origin) || faceOutside(FindCenter(simplex));
}

/// Tests triangles and edges by filters. If these may not be used, nothing is certain.
void SphereRun::TestStart()
{
  const ThreadBackend threads(this->Options.NumberOfThreads);
  const std::int64_t count = SizeOf(this->Triangles) / 3;
  const std::vector<std::int32_t> active = this->ListActive();
  const SpherePoints points{ this->Points.data(), active.data(), SizeOf(active) };
  this->Tested = StartSums();
  this->Tested.Turned = this->Tested.Uncertain = count;
  if (threads.Sum<std::int64_t>(points.Count, UnusualStep{ points }) == 0)
  {
    const SphereTriangles triangles{ this->Triangles.data(), this->FindNeighborsOnce().data(),
      count };
    this->Tested =
      threads.Sum<StartSums>(count, StartStep{ points.Places, triangles, this->Center });
  }
}

/// Gives points a state in which they are not active. @returns whether there are any.
bool SphereRun::LeaveOut(const std::vector<std::int32_t>& points, PointState state)
{
  for (const std::int32_t i : points)
  {
    this->States[i] = state;
  }
  return !points.empty();
}

/// Lists the neighbours of the triangles, unless they are known.
const std::vector<std::int32_t>& SphereRun::FindNeighborsOnce()
{
  if (this->Neighbors.empty())
  {
    this->Neighbors = FindNeighbors(this->Triangles, SizeOf(this->Points));
  }
  return this->Neighbors;
}

/// Takes the start as it is if filters see that all edges are convex. Then no four points tie, and
/// flips would change nothing. @returns whether the start is taken.
/// @throws RunAborted if the observer stops it.
bool SphereRun::TakeStart()
{
  if (this->Tested.Uncertain > 0)
  {
    return false;
  }
  this->FlipCounts.assign(SizeOf(this->Triangles) / 3, 0);
  this->ReportStart(this->Tested);
  return true;
}

/// Reports that there is nothing to flip on the sphere.
void SphereRun::ReportStart(const StartSums& sums)
{
  this->Report = FlipReport();
  this->Report.Backend = this->Planar.Backend;
  this->Report.Fallback = this->Planar.Fallback;
  this->Report.Tolerance = this->Planar.Tolerance;
  KeepAnglesAfter(sums.Angles, this->Report);
  const ProgressObserver progress = this->TellHalf();
  const bool isStopped = progress && !progress(1.0);
  if (isStopped)
  {
    throw RunAborted();
  }
}

/// Flips until every edge that is not of a segment is convex, or its flip would turn a triangle
/// over.
void SphereRun::Flip()
{
  TriangleMesh mesh;
  mesh.Points = PointArray(&this->Points.data()->U, SizeOf(this->Points));
  mesh.Triangles = TriangleArray(this->Triangles.data(), SizeOf(this->Triangles) / 3);
  mesh.Center[0] = this->Center.U;
  mesh.Center[1] = this->Center.V;
  mesh.Center[2] = this->Center.W;
  // Every triangle faces outside, so that around a vertex no direction is covered twice.
  mesh.Whole.StarsAreSimple = true;
  const std::vector<std::int64_t> kept = this->ListSegmentEdges();
  mesh.ConstraintEdges = kept.data();
  mesh.NumberOfConstraintEdges = SizeOf(kept) / 2;
  FlipOptions options = this->Options;
  options.Geometry = GeometryKind::Sphere;
  options.Criterion = CriterionKind::InCircle;
  options.TieRule = TieRuleKind::Canonical;
  const ProgressObserver progress = this->TellHalf();
  FlipSession session(mesh, options, progress);
  AdvanceToEnd(session, progress);
  this->Report = session.GetReport();
  this->FlipCounts.resize(mesh.Triangles.Count);
  session.StoreFlipCounts(this->FlipCounts.data());
  session.StoreTriangles(MutableTriangleArray(this->Triangles.data(), mesh.Triangles.Count));
  this->Neighbors.clear();
}

bool SphereRun::HasLeftOut() const
{
  return std::find(this->States.begin(), this->States.end(), PointState::LeftOut) !=
    this->States.end();
}

/// Inserts the points that are left out.
/// @returns false if this has made triangles without area, so that the run must begin again without
/// their middle points.
bool SphereRun::InsertLeftOut()
{
  this->MarkRepeatedLeftOut();
  if (!this->HasLeftOut())
  {
    return true;
  }
  HullInserter hull(this->Points, this->Center, this->Triangles);
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    if (this->States[i] == PointState::LeftOut)
    {
      hull.Insert(static_cast<std::int32_t>(i));
    }
  }
  this->Triangles = hull.ListTriangles();
  if (this->LeaveOut(FindBetween(this->Points, this->Triangles), PointState::Inside))
  {
    return false;
  }
  this->Flip(); // decides ties
  return true;
}

/// Reports progress through half of the remaining share, because nobody knows how much follows.
ProgressObserver SphereRun::TellHalf()
{
  const double begin = this->Done;
  const double half = 0.5 * (1.0 - begin);
  this->Done += half;
  if (!this->Observer)
  {
    return {};
  }
  return [this, begin, half](double share) { return this->Observer(begin + half * share); };
}

}
