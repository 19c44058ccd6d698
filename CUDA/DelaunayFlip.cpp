// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

#include "EdgeMeshAudit.h"
#include "EdgeMeshBuilder.h"
#include "FlipLoop.h"
#include "FlipLoopFactory.h"
#include "MeshSurvey.h"
#include "PackedPoints.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"

#include <chrono>
#include <cmath>
#include <limits>

namespace delaunayflip
{

namespace
{
/// Iterations that a surface may take beyond its number of triangles before the loop gives up.
constexpr std::int64_t SafetyMargin = 1000;
constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

class StopWatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

void CheckOptions(const FlipOptions& options)
{
  if (!(options.Tolerance >= 0.0 && options.Tolerance < 1.0))
  {
    throw InvalidOptions("the tolerance must be at least 0 and below 1 radian");
  }
  if (!(options.FeatureAngle >= 0.0 && options.FeatureAngle <= 180.0))
  {
    throw InvalidOptions("the feature angle must be from 0 to 180 degrees");
  }
  if (options.MaximumIterations < -1)
  {
    throw InvalidOptions("the number of iterations must be -1 (until done), 0 or more");
  }
  if (options.NumberOfThreads < 0)
  {
    throw InvalidOptions("the number of threads must be 0 (all) or more");
  }
  if (options.Backend == BackendKind::CUDA)
  {
    throw BackendUnavailable("this build has no CUDA backend; use 'auto' or 'threads'");
  }
}

void CheckTieRule(const FlipOptions& options, GeometryKind geometry)
{
  if (options.TieRule == TieRuleKind::Canonical &&
    (geometry == GeometryKind::Surface || options.Criterion != CriterionKind::InCircle))
  {
    throw InvalidOptions(
      "the tie rule 'canonical' needs the in-circle criterion in planar geometry; "
      "use 'keep' for surfaces and opposite angles");
  }
}

double ToDegrees(double squaredCotangent)
{
  if (squaredCotangent == -INFINITY)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return squaredCotangent == INFINITY
    ? 0.0
    : std::atan2(1.0, std::sqrt(squaredCotangent)) / DegreesToRadians;
}
}

/// From the caller's arrays to a loop, and from its iterations to a report.
class FlipSession::Implementation
{
public:
  Implementation(const TriangleMesh& mesh, const FlipOptions& options)
    : Options(options),
      Backend(options.NumberOfThreads)
  {
    const StopWatch watch;
    CheckOptions(options);
    CheckMeshSize(mesh);
    const MeshSurvey survey = SurveyMesh(mesh, options.Geometry, this->Backend);
    CheckTieRule(options, survey.Geometry);
    this->Order = OrderMesh(mesh, survey, this->Backend);
    EdgeMeshResult built =
      BuildEdgeMesh({ mesh, survey, this->Order, options.FeatureAngle }, this->Backend);
    this->Order.RankOfVertex = Array<VertexId>();
    this->Mesh = std::move(built.Edges);
    this->StartReport(mesh, survey, built);
    this->MakeLoop(mesh, survey, std::move(built.Table));
    this->Report.MinimumAngleBefore = ToDegrees(this->Loop->FindLargestSquaredCotangent());
    this->Report.MinimumAngleAfter = this->Report.MinimumAngleBefore;
    this->Report.BuildSeconds = watch.GetSeconds();
    this->DetectFirst();
  }

  bool Advance(std::int64_t iterations, const FlipObserver& observer)
  {
    const StopWatch watch;
    const double secondsBefore = this->Report.FlipSeconds;
    this->Resume();
    const auto done = [this]()
    { return static_cast<std::int64_t>(this->Report.Iterations.size()); };
    const std::int64_t limit = iterations < 0 ? NoLimit : done() + iterations;
    while (this->IsRunning() && done() < limit)
    {
      this->Iterate(std::min(limit, this->GetIterationLimit()) - done(), observer);
    }
    this->MeasureEnd();
    this->Report.FlipSeconds = secondsBefore + watch.GetSeconds();
    return this->IsRunning();
  }

  const FlipReport& GetReport() const { return this->Report; }

  void StoreTriangles(const MutableTriangleArray& triangles) const
  {
    this->ForTriangles(
      [&](const TriangleRecord& record)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          triangles.Set(record.InputTriangle, slot, this->Order.GetVertex(record.Vertices[slot]));
        }
      });
  }

  void StoreFlipCounts(std::int32_t* counts) const
  {
    this->ForTriangles([counts](const TriangleRecord& record)
      { counts[record.InputTriangle] = static_cast<std::int32_t>(record.FlipCount); });
  }

private:
  template <typename Work>
  void ForTriangles(const Work& work) const
  {
    this->Backend.ForRange(this->Mesh.NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t t = begin; t < end; ++t)
        {
          work(this->Mesh.Triangles[t]);
        }
      });
  }

  void StartReport(const TriangleMesh& mesh, const MeshSurvey& survey, const EdgeMeshResult& built)
  {
    FlipReport& report = this->Report;
    report.Points = mesh.Points.Count;
    report.Triangles = mesh.Triangles.Count;
    report.Edges = built.Counts;
    report.EulerCharacteristic = survey.UsedPoints - built.Counts.Edges + mesh.Triangles.Count;
    report.GeometryUsed = survey.Geometry;
    report.Backend = this->Backend.GetName();
    this->AddDefect(survey.NonFinitePoints);
    this->AddDefect(survey.RepeatedIds);
    this->AddDefect(built.DuplicateTriangles);
    this->AddDefect({ "constraint edges that are not edges of the mesh", built.MissingConstraints,
      {}, DefectIds::Points });
  }

  void AddDefect(const Defect& defect)
  {
    if (defect.Count > 0)
    {
      this->Report.Defects.push_back(defect);
    }
  }

  void MakeLoop(const TriangleMesh& mesh, const MeshSurvey& survey, EdgeTable table)
  {
    const FlipLoopInput input{ mesh.Points, survey, this->Order, this->Options, this->Report };
    FlipLoopResult made = MakeFlipLoop(input, this->Mesh, std::move(table), this->Backend);
    this->Points = std::move(made.Points);
    this->Loop = std::move(made.Loop);
    for (const Defect& defect : made.Defects)
    {
      this->AddDefect(defect);
    }
  }

  /// What the input holds, and with nothing to do or no iteration allowed, the end.
  void DetectFirst()
  {
    const StopWatch watch;
    this->Detected(this->Loop->Detect());
    this->Report.NonDelaunayBefore = this->Found.Bad + this->Found.Blocked;
    this->Report.FlipSeconds = watch.GetSeconds();
  }

  void Detected(const StepCounts& found)
  {
    this->Found = found;
    this->Report.NonDelaunayAfter = found.Bad + found.Blocked;
  }

  std::int64_t GetIterationLimit() const
  {
    if (this->Options.MaximumIterations >= 0)
    {
      return this->Options.MaximumIterations;
    }
    const bool mayCycle = this->Report.GeometryUsed == GeometryKind::Surface ||
      this->Options.Criterion == CriterionKind::OppositeAngles;
    return mayCycle ? this->Report.Triangles + SafetyMargin : NoLimit;
  }

  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::NotStarted; }

  /// Goes on, also after an abort, unless there is nothing to do or no iteration left.
  void Resume()
  {
    const auto done = static_cast<std::int64_t>(this->Report.Iterations.size());
    this->Report.StopReason = StopReasonKind::NotStarted;
    if (this->Found.Bad == 0)
    {
      this->Report.StopReason = StopReasonKind::Converged;
    }
    else if (done >= this->GetIterationLimit())
    {
      this->Report.StopReason = StopReasonKind::IterationLimit;
    }
  }

  /// At least one iteration, at most `most`.
  void Iterate(std::int64_t most, const FlipObserver& observer)
  {
    const StopWatch watch;
    const bool isFirst = this->Report.Iterations.empty();
    const std::vector<IterationCounts> iterations =
      this->Loop->Advance({ most, isFirst, this->Options.TrackQuality });
    this->Detected(this->Loop->GetFound());
#if !defined(NDEBUG)
    RequireConsistent(this->Mesh, this->Backend);
#endif
    const double seconds = watch.GetSeconds() / static_cast<double>(iterations.size());
    bool goOn = true;
    for (const IterationCounts& counts : iterations)
    {
      this->Keep(counts, seconds);
      goOn = (!observer || observer(this->Report.Iterations.back())) && goOn;
    }
    this->Resume();
    if (!goOn && this->IsRunning())
    {
      this->Report.StopReason = StopReasonKind::Aborted;
    }
  }

  void Keep(const IterationCounts& counts, double seconds)
  {
    IterationRecord record;
    record.Iteration = static_cast<std::int64_t>(this->Report.Iterations.size()) + 1;
    record.Tested = counts.Tested;
    record.NonDelaunay = counts.Bad + counts.Blocked;
    record.Blocked = counts.Blocked;
    record.Flipped = counts.Flipped;
    record.Excluded = counts.Bad - counts.Flipped;
    record.MinimumAngle = ToDegrees(counts.SquaredCotangent);
    record.Seconds = seconds;
    this->Report.Iterations.push_back(record);
    this->Report.TotalFlips += record.Flipped;
    this->Report.TotalExcluded += record.Excluded;
    this->Report.TotalBlocked += record.Blocked;
  }

  /// The smallest angle is known at the first and the last iteration, without a pass between.
  void MeasureEnd()
  {
    if (this->Report.Iterations.empty())
    {
      return;
    }
    this->Report.MinimumAngleAfter = ToDegrees(this->Loop->FindLargestSquaredCotangent());
    if (!this->IsRunning())
    {
      this->Report.Iterations.back().MinimumAngle = this->Report.MinimumAngleAfter;
    }
  }

  FlipOptions Options;
  ThreadBackend Backend;
  SpatialOrder Order;
  EdgeMesh Mesh;
  PackedPoints Points;
  std::unique_ptr<FlipLoop> Loop;
  StepCounts Found; ///< By the last Detect.
  FlipReport Report;
};

FlipSession::FlipSession(const TriangleMesh& mesh, const FlipOptions& options)
  : Impl(new Implementation(mesh, options))
{
}

FlipSession::~FlipSession() = default;
FlipSession::FlipSession(FlipSession&&) noexcept = default;
FlipSession& FlipSession::operator=(FlipSession&&) noexcept = default;

bool FlipSession::Advance(std::int64_t iterations, const FlipObserver& observer)
{
  return this->Impl->Advance(iterations, observer);
}

const FlipReport& FlipSession::GetReport() const { return this->Impl->GetReport(); }

void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  this->Impl->StoreTriangles(triangles);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts) const
{
  this->Impl->StoreFlipCounts(counts);
}

FlipReport FlipToDelaunay(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer)
{
  FlipSession session(mesh, options);
  session.Advance(-1, observer);
  session.StoreTriangles(triangles);
  return session.GetReport();
}

}
