// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipJob.h"

#include "Arguments.h"
#include "CommandError.h"
#include "Console.h"
#include "DelaunayFlip.h"
#include "GdalModule.h"
#include "HeightQuery.h"
#include "JobInput.h"
#include "JobMessages.h"
#include "MeshFiles.h"
#include "OutputFiles.h"
#include "RasterFile.h"
#include "RoundedDigits.h"
#include "RunReport.h"
#include "SegmentLines.h"

#include <vtkBoundingBox.h>
#include <vtkCommand.h>
#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipPoints.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Reports contradicting options and a missing backend before a large file is read.
void TryOptions(vtkDelaunayFlip* filter)
{
  FlipOptions options;
  options.Geometry = static_cast<GeometryKind>(filter->GetGeometry());
  options.Criterion = static_cast<CriterionKind>(filter->GetCriterion());
  options.TieRule = static_cast<TieRuleKind>(filter->GetTieRule());
  options.Backend = static_cast<BackendKind>(filter->GetBackend());
  options.Device = filter->GetDeviceId();
  try
  {
    CheckOptionsAndBackend(options);
  }
  catch (const BackendUnavailable& error)
  {
    throw CommandError(ExitCode::NoBackend, error.what());
  }
  catch (const InvalidOptions& error)
  {
    throw CommandError(ExitCode::WrongUsage, error.what());
  }
}

/// oneTBB 2022 waits for ever where memory fails while it starts. Under a memory limit VTK does
/// without it; the engine looks for itself.
void KeepVTKFromThreads()
{
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
  {
    vtkSMPTools::SetBackend("Sequential");
  }
}

/// The diagonal of the box around the points that have finite coordinates.
double DiagonalOf(vtkPolyData* mesh)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> point;
    mesh->GetPoint(i, point.data());
    if (std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); }))
    {
      box.AddPoint(point.data());
    }
  }
  return box.IsValid() ? std::hypot(box.GetLength(0), box.GetLength(1), box.GetLength(2)) : 0.0;
}

/// @param failure a vtkDelaunayFlip::FailureType.
ExitCode ExitCodeOf(int failure)
{
  switch (failure)
  {
    case vtkDelaunayFlip::FAILURE_OPTIONS:
      return ExitCode::WrongUsage;
    case vtkDelaunayFlip::FAILURE_BACKEND:
      return ExitCode::NoBackend;
    default:
      return ExitCode::BadFile;
  }
}

vtkDelaunayFlipAlgorithm* ChooseFilter(const Arguments& arguments)
{
  if (arguments.Heights.AreWanted())
  {
    return arguments.Interpolator;
  }
  if (arguments.FromPoints)
  {
    return arguments.Points;
  }
  return arguments.Flip;
}

/// The work from reading to the report, one function per step.
class FlipJob
{
public:
  FlipJob(const Arguments& arguments, OutputFiles& files)
    : Settings(arguments),
      Files(files),
      Bar(!arguments.Quiet),
      Messages(arguments.Quiet),
      Filter(ChooseFilter(arguments))
  {
    CollectVTKMessages();
  }

  void Read()
  {
    const auto start = Clock::now();
    this->Input = ReadInput(this->Settings, this->Bar, this->Messages);
    this->Run.ReadSeconds = SecondsSince(start);
  }

  void Flip()
  {
    if (this->Settings.DeviationIsPercent)
    {
      this->Settings.Flip->SetMaximumDeviation(
        this->Settings.Flip->GetMaximumDeviation() * DiagonalOf(this->Input.Mesh) / 100.0);
    }
    auto* const points = dynamic_cast<vtkDelaunayFlipPoints*>(this->Filter);
    if (points && this->Input.Segments)
    {
      points->SetFirstHole(this->Input.Segments->GetNumberOfLines() + this->Input.OutlineRings);
      points->ClosedLinesAsRingsOff(); // those that are rings have become polygons
      points->SetDefectHandler(
        [this](const Defect& defect)
        {
          const bool isOfRings = defect.Ids == DefectIds::Rings;
          if (isOfRings)
          {
            this->RingDefects.push_back(defect);
          }
          return isOfRings;
        });
    }
    this->Bar.Begin(Phase::Flipping, "finding edges");
    this->Filter->AddObserver(vtkCommand::ProgressEvent, this, &FlipJob::ShowProgress);
    if (this->Settings.Heights.AreWanted())
    {
      this->AskHeights();
    }
    else
    {
      this->Filter->SetInputData(0, this->Input.Mesh);
      this->Filter->SetInputData(1, this->Input.Segments);
    }
    this->Filter->Update();
    this->Bar.Clear();
    for (const std::string& warning : TakeVTKWarnings())
    {
      this->Messages.Warn(WithOptions(warning, this->Settings));
    }
    if (!this->RingDefects.empty())
    {
      this->WarnOfRings();
    }
    this->ThrowErrors();
    this->TakeReport();
  }

  void Write()
  {
    const auto start = Clock::now();
    this->Bar.Begin(Phase::Writing, "writing " + this->Settings.Output);
    if (this->Heights)
    {
      this->WriteHeights();
    }
    else
    {
      this->WriteTriangles();
    }
    this->Bar.Clear();
    this->Run.WriteSeconds = SecondsSince(start);
  }

  void Tell()
  {
    this->Run.Warnings = this->Messages.GetWarnings();
    if (!this->Settings.Statistics.empty())
    {
      this->Files.Statistics.Write(MakeCsv(this->Run.Flip));
    }
    if (!this->Settings.Report.empty())
    {
      this->Files.Report.Write(MakeJson(this->Run));
    }
    if (!this->Settings.Quiet)
    {
      std::cout << MakeSummary(this->Run);
    }
  }

  ExitCode GetExitCode() const
  {
    const bool isLimited = this->Run.Flip.StopReason == StopReasonKind::IterationLimit;
    return isLimited ? ExitCode::IterationLimit : ExitCode::Done;
  }

private:
  /// Begins with the first block of places.
  void AskHeights()
  {
    HeightOptions options = this->Settings.Heights;
    if (options.Crs.empty())
    {
      options.Crs = this->FindCrs();
    }
    options.Output = this->Settings.Output;
    options.PlacesAreAngles = this->Input.PlacesAreAngles;
    this->Heights = HeightQuery::Make(options, this->Input.Mesh, this->Input.Places);
    this->Heights->Begin(this->Settings.Interpolator,
      SelectArray(this->Input.Mesh, options.Array, this->Settings.Input));
    this->Filter->SetInputData(2, this->Input.Segments);
  }

  /// The coordinate reference system of INPUT. Warns if a GeoTIFF has no way to name it.
  std::string FindCrs()
  {
    const std::string& crs = this->Input.Crs;
    if (crs.empty() || ExtensionOf(this->Settings.Output) != ".tif")
    {
      return crs;
    }
    try
    {
      LoadGdal().DescribeCrs(crs, true);
      return crs;
    }
    catch (const std::runtime_error&)
    {
      this->Messages.Warn(this->Settings.Output +
        ": its format has no way to name the coordinate reference system of " +
        this->Settings.Input + ", so it names none");
      return "";
    }
  }

  void WriteHeights()
  {
    this->Filter->RemoveAllObservers(); // what is shown now is how much is written
    this->Heights->Write(this->Files.Mesh.GetTemporary(),
      [this](double share) { this->Bar.Show(share, "writing " + this->Settings.Output); });
    this->Run.Summary += this->Heights->Describe();
    this->Run.Places = this->Heights->CountPlaces();
    this->Run.PlacesOutside = this->Heights->CountOutside();
    const bool isAscii = ExtensionOf(this->Settings.Output) == ".asc";
    for (const std::string& warning : this->Heights->ListWarnings(isAscii))
    {
      this->Messages.Warn(this->Settings.Output + ": " + warning);
    }
    if (isAscii)
    {
      this->WarnOfProjectionFile();
    }
  }

  /// Programs take the .prj beside an .asc for its coordinate reference system.
  void WarnOfProjectionFile()
  {
    const auto file = std::filesystem::path(this->Settings.Output).replace_extension(".prj");
    std::error_code ignored;
    if (this->Settings.Heights.Crs.empty() && std::filesystem::exists(file, ignored))
    {
      this->Messages.Warn(file.string() +
        " is that of an earlier file, and programs will take it for " + this->Settings.Output +
        ", too; remove it, or give --crs");
    }
  }

  void WriteTriangles()
  {
    vtkNew<vtkPolyData> mesh;
    mesh->ShallowCopy(this->Output);
    // These two may differ between runs; without them, equal meshes give equal files.
    mesh->GetFieldData()->RemoveArray("DelaunayFlip:Seconds");
    mesh->GetFieldData()->RemoveArray("DelaunayFlip:Backend");
    WriteMesh(mesh, this->Files.Mesh.GetTemporary(), this->Settings.OutputFormat);
    mesh->SetFieldData(this->Input.Mesh->GetFieldData()); // what flips add is in reports
    const std::string losses = DescribeLosses(mesh, this->Settings.OutputFormat);
    if (!losses.empty())
    {
      this->Messages.Note(this->Settings.Output + ": this file format cannot store: " + losses);
    }
  }

  void ShowProgress()
  {
    const vtkIdType iterations = this->Filter->GetNumberOfIterations();
    std::string text = "finding edges";
    if (iterations > 0)
    {
      text = "iteration " + std::to_string(iterations) + ", " +
        Counted(this->Filter->GetTotalFlips(), "flip");
    }
    this->Bar.Show(this->Filter->GetProgress(), text);
  }

  /// The file of a ring, and its name there.
  /// @param number its cell id.
  std::pair<std::string, std::string> FindRing(vtkIdType number) const
  {
    const vtkIdType ring = number - this->Input.Segments->GetNumberOfLines();
    if (ring < this->Input.OutlineRings)
    {
      return { this->Settings.Outline, "ring " + std::to_string(ring) };
    }
    return { this->Settings.Holes, "ring " + std::to_string(ring - this->Input.OutlineRings) };
  }

  /// Warns of rings, with their files.
  void WarnOfRings()
  {
    std::vector<std::string> texts;
    for (Defect defect : std::exchange(this->RingDefects, {}))
    {
      std::vector<std::string> names;
      for (const std::int64_t number : std::exchange(defect.FirstIds, {}))
      {
        const auto [path, ring] = this->FindRing(number);
        names.push_back(ring + " of " + path);
      }
      texts.push_back(WithOptions(DescribeDefects({ defect }), this->Settings) +
        " (first: " + JoinWords(names) + ")");
    }
    this->Messages.Warn(JoinWords(texts, "; "));
  }

  std::string NamePlacesOf(const std::string& message) const
  {
    return NamePlaces(
      message, this->Input.Mesh, this->Input.Segments, this->Settings.Points->GetDegrees());
  }

  void ThrowErrors()
  {
    const std::string errors = TakeVTKErrors();
    const vtkIdType failed = this->Filter->GetFailedRing();
    if (failed >= 0)
    {
      const std::string name = "ring " + std::to_string(failed);
      const std::size_t place = errors.find(name);
      const std::string fault = this->NamePlacesOf(
        place == std::string::npos ? ": " + errors : errors.substr(place + name.size()));
      const auto [path, ring] = this->FindRing(failed);
      throw CommandError(
        ExitCode::BadFile, path + ": " + ring + WithOptions(fault, this->Settings));
    }
    if (!errors.empty())
    {
      const std::string text = WithOptions(errors, this->Settings);
      const int failure = this->Filter->GetFailure();
      if (failure == vtkDelaunayFlip::FAILURE_OTHER)
      {
        throw std::runtime_error(text); // main says of which file, and what was being done
      }
      const bool isOfSegment = errors.rfind("segment ", 0) == 0 && this->Input.Segments &&
        !this->Settings.Constraints.empty();
      if (isOfSegment)
      {
        throw CommandError(
          ExitCodeOf(failure), this->Settings.Constraints + ": " + this->NamePlacesOf(text));
      }
      throw CommandError(ExitCodeOf(failure), this->Settings.Input + ": " + text);
    }
  }

  void TakeReport()
  {
    this->Run.IsFromPoints = this->Settings.FromPoints;
    FlipReport& report = this->Run.Flip;
    report = this->Filter->GetReport();
    this->Output->ShallowCopy(this->Input.Mesh);
    if (!this->Heights)
    {
      this->Output->ShallowCopy(this->Filter->GetOutput());
    }
    this->Run.Summary = WithOptions(Summarize(report, this->MakeNotes()), this->Settings);
    if (report.Triangles == 0)
    {
      report.Points = this->Output->GetNumberOfPoints();
      this->Run.Summary = "mesh: " + Counted(report.Points, "point") + ", no triangles\n";
      report.MinimumAngleBefore = std::numeric_limits<double>::quiet_NaN();
      report.MinimumAngleAfter = report.MinimumAngleBefore;
    }
  }

  /// What the command knows and the filter does not.
  SummaryNotes MakeNotes()
  {
    SummaryNotes notes;
    notes.WantedAngle = this->Settings.Points->GetMinimumAngle();
    const FlipReport& report = this->Run.Flip;
    const bool mayRound = report.GeometryUsed == GeometryKind::Surface &&
      report.Tolerance == "automatic" && report.NonDelaunayBefore > 0;
    if (mayRound)
    {
      notes.Hint = this->AdviseTolerance();
    }
    return notes;
  }

  /// Advises one if the coordinates are rounded, and it leaves alone many of the bad edges.
  std::string AdviseTolerance()
  {
    const RoundedCoordinates rounded = FindRounding(this->Input.Mesh);
    if (rounded.Tolerance <= 0.0)
    {
      return "";
    }
    vtkDelaunayFlip* const filter = this->Settings.Flip;
    filter->RemoveAllObservers();
    filter->SetTolerance(rounded.Tolerance);
    filter->SetMaximumIterations(0);
    filter->Update();
    TakeVTKWarnings();
    constexpr std::int64_t Many = 10; // a tenth
    const std::int64_t bad = this->Run.Flip.NonDelaunayBefore;
    const std::int64_t left = filter->GetReport().NonDelaunayBefore;
    const bool leavesMany = TakeVTKErrors().empty() && Many * (bad - left) >= bad;
    return leavesMany ? DescribeRounding(rounded) : "";
  }

  const Arguments& Settings;
  OutputFiles& Files;
  ProgressBar Bar;
  JobMessages Messages;
  JobInput Input;
  std::unique_ptr<HeightQuery> Heights; ///< Null: a mesh is wanted.
  vtkDelaunayFlipAlgorithm* const Filter;
  const vtkNew<vtkPolyData> Output;
  std::vector<Defect> RingDefects; ///< Those that the filter leaves to WarnOfRings.
  RunReport Run;
};

}

int RunFlipJob(const Arguments& arguments, OutputFiles& files, ChildProcess& child)
{
  KeepVTKFromThreads();
  TryOptions(arguments.Flip);
  if (arguments.Heights.Step > 0.0)
  {
    files.Projection.Write(TryRaster(arguments.Output, arguments.Heights.Crs));
  }
  FlipJob job(arguments, files);
  child.Enter(Phase::Reading);
  job.Read();
  child.Enter(Phase::Flipping);
  job.Flip();
  child.Enter(Phase::Writing);
  job.Write();
  job.Tell();
  child.Enter(Phase::Over);
  return static_cast<int>(job.GetExitCode());
}

}
