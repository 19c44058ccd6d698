// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipJob.h"

#include "CommandError.h"
#include "Console.h"
#include "DelaunayFlip.h"
#include "OutputFiles.h"
#include "Report.h"

#include <vtkCallbackCommand.h>
#include <vtkDelaunayFlip.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStaticCleanPolyData.h>

#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <limits>
#include <regex>
#include <sstream>

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
void TryOptions(FlipOptions options)
{
  options.NumberOfPieces = 1; // a session of several looks for a GPU when it flips
  const double points[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  const std::int32_t triangle[] = { 0, 1, 2 };
  TriangleMesh mesh;
  mesh.Points = PointArray(points, 3);
  mesh.Triangles = TriangleArray(triangle, 1);
  try
  {
    FlipSession(mesh, options);
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

void Configure(vtkDelaunayFlip* filter, const Arguments& arguments)
{
  const FlipOptions& flip = arguments.Flip;
  filter->SetGeometry(static_cast<int>(flip.Geometry));
  filter->SetCriterion(static_cast<int>(flip.Criterion));
  filter->SetTieRule(static_cast<int>(flip.TieRule));
  filter->SetBackend(static_cast<int>(flip.Backend));
  filter->SetTolerance(flip.Tolerance);
  filter->SetFeatureAngle(flip.FeatureAngle);
  filter->SetMaximumIterations(flip.MaximumIterations);
  filter->SetNumberOfThreads(flip.NumberOfThreads);
  filter->SetDeviceId(flip.Device);
  filter->SetDevices(arguments.Devices.c_str());
  filter->SetNumberOfPieces(flip.NumberOfPieces);
  filter->SetLinesAsConstraints(!arguments.IgnoreLines);
  filter->SetInsertLines(arguments.InsertLines);
  filter->SetInsertConstraints(arguments.InsertConstraints);
  filter->SetRegionArray(arguments.RegionArray.c_str());
  filter->SetGenerateQuality(arguments.Quality);
}

/// The exit code for a vtkDelaunayFlip::FailureType.
ExitCode ToExitCode(int failure)
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

/// The filter's message with options of the command for properties of the filter.
std::string WithOptions(const std::string& message)
{
  static const std::regex region("\\bRegionArray\\b");
  static const std::regex tolerance("\\bTolerance\\b");
  static const std::regex merge("merge points that lie at the same place");
  std::string text = std::regex_replace(message, region, "--region-array");
  text = std::regex_replace(text, tolerance, "--tolerance");
  return std::regex_replace(text, merge, "--merge-points joins those that lie at the same place");
}

void ShowProgress(vtkObject* caller, unsigned long, void* bar, void*)
{
  auto* filter = vtkDelaunayFlip::SafeDownCast(caller);
  const vtkIdType iterations = filter->GetNumberOfIterations();
  static_cast<ProgressBar*>(bar)->Show(filter->GetProgress(),
    iterations == 0 ? "finding edges"
                    : "iteration " + std::to_string(iterations) + ", " +
        Counted(filter->GetTotalFlips(), "flip"));
}

/// The work from reading to the report, one function per step.
class FlipJob
{
public:
  FlipJob(const Arguments& arguments, OutputFiles& files)
    : Settings(arguments),
      Files(files),
      Bar(!arguments.Quiet, arguments.InputFormat, arguments.OutputFormat)
  {
  }

  void Read()
  {
    const auto start = Clock::now();
    this->Input = this->ReadFile(this->Settings.Input, this->Settings.InputFormat);
    if (!this->Settings.Constraints.empty())
    {
      this->Constraints =
        this->ReadFile(this->Settings.Constraints, this->Settings.ConstraintsFormat);
    }
    if (this->Settings.MergePoints)
    {
      this->MergePoints();
    }
    this->Run.ReadSeconds = SecondsSince(start);
    if (this->Input->GetNumberOfPolys() + this->Input->GetNumberOfStrips() == 0)
    {
      this->Note(this->Settings.Input + ": contains no triangles");
    }
  }

  void Flip()
  {
    vtkNew<vtkCallbackCommand> progress;
    progress->SetCallback(ShowProgress);
    progress->SetClientData(&this->Bar);
    Configure(this->Filter, this->Settings);
    this->Bar.Begin(Phase::Flipping, "finding edges");
    this->Filter->AddObserver(vtkCommand::ProgressEvent, progress);
    this->Filter->SetInputData(this->Input);
    if (this->Constraints)
    {
      this->Filter->SetConstraintsData(this->Constraints);
    }
    this->Filter->Update();
    this->Bar.Clear();
    for (const std::string& warning : this->Messages.TakeWarnings())
    {
      this->Warn(WithOptions(warning));
    }
    this->ThrowErrors();
    this->TakeReport();
  }

  void Write()
  {
    const auto start = Clock::now();
    this->Bar.Begin(Phase::Writing, "writing " + this->Settings.Output);
    vtkNew<vtkPolyData> mesh;
    mesh->ShallowCopy(this->Filter->GetOutput());
    // These two may differ between runs; without them, equal meshes give equal files.
    mesh->GetFieldData()->RemoveArray("DelaunayFlip:Seconds");
    mesh->GetFieldData()->RemoveArray("DelaunayFlip:Backend");
    WriteMesh(mesh, this->Files.Mesh.GetTemporary(), this->Settings.OutputFormat, this->Messages,
      [this](double fraction) { this->Bar.Show(fraction, "writing " + this->Settings.Output); });
    this->Bar.Clear();
    this->Run.WriteSeconds = SecondsSince(start);
    const std::string losses = DescribeLosses(this->Input, this->Settings.OutputFormat);
    if (!losses.empty())
    {
      this->Note(this->Settings.Output + ": this file format cannot store: " + losses);
    }
  }

  void Tell()
  {
    if (this->Files.Statistics)
    {
      std::ostringstream text;
      WriteCsv(this->Run.Flip, text);
      this->Files.Statistics->Write(text.str());
    }
    if (this->Files.Report)
    {
      std::ostringstream text;
      WriteJson(this->Run, text);
      this->Files.Report->Write(text.str());
    }
    if (!this->Settings.Quiet)
    {
      WriteSummary(this->Run, std::cout);
    }
  }

  ExitCode GetExitCode() const
  {
    const bool isLimited = this->Run.Flip.StopReason == StopReasonKind::IterationLimit;
    return isLimited ? ExitCode::IterationLimit : ExitCode::Done;
  }

private:
  vtkSmartPointer<vtkPolyData> ReadFile(const std::string& path, MeshFormat format)
  {
    this->Bar.Begin(Phase::Reading, "reading " + path);
    const FileMesh file = ReadMesh(path, format, this->Messages);
    this->Bar.Clear();
    for (const std::string& warning : file.Warnings)
    {
      this->Warn(warning);
    }
    return file.Mesh;
  }

  /// Joins points of the input at the same place.
  void MergePoints()
  {
    vtkNew<vtkStaticCleanPolyData> clean;
    clean->SetInputData(this->Input);
    clean->ConvertLinesToPointsOff();
    clean->ConvertPolysToLinesOff();
    clean->ConvertStripsToPolysOff();
    clean->Update();
    this->Note(this->Settings.Input + ": of " + Counted(this->Input->GetNumberOfPoints(), "point") +
      " " + std::to_string(clean->GetOutput()->GetNumberOfPoints()) + " are left after merging");
    this->Input = clean->GetOutput();
  }

  void Warn(const std::string& warning)
  {
    PrintWarning(warning);
    this->Run.Warnings.push_back(warning);
  }

  void Note(const std::string& note) const
  {
    if (!this->Settings.Quiet)
    {
      PrintNote(note);
    }
  }

  void ThrowErrors()
  {
    const std::string errors = this->Messages.TakeErrors();
    if (!errors.empty())
    {
      const int failure = this->Filter->GetFailure();
      const bool isNamed = failure != vtkDelaunayFlip::FAILURE_OTHER;
      throw CommandError(ToExitCode(failure),
        this->Settings.Input + (isNamed ? ": " : ": cannot be flipped: ") + WithOptions(errors));
    }
  }

  void TakeReport()
  {
    FlipReport& report = this->Run.Flip;
    report = this->Filter->GetReport();
    this->Run.Summary = this->Filter->GetSummary();
    if (report.Triangles == 0)
    {
      // The filter had nothing to do.
      report.Points = this->Input->GetNumberOfPoints();
      this->Run.Summary = "mesh: " + Counted(report.Points, "point") + ", no triangles\n";
      report.MinimumAngleBefore = std::numeric_limits<double>::quiet_NaN();
      report.MinimumAngleAfter = report.MinimumAngleBefore;
    }
  }

  const Arguments& Settings;
  OutputFiles& Files;
  VTKMessages Messages;
  ProgressBar Bar;
  vtkSmartPointer<vtkPolyData> Input;
  vtkSmartPointer<vtkPolyData> Constraints; ///< Or null.
  vtkNew<vtkDelaunayFlip> Filter;
  RunReport Run;
};

}

int RunFlipJob(
  const Arguments& arguments, OutputFiles& files, const std::function<void(Phase)>& enter)
{
  KeepVTKFromThreads();
  TryOptions(arguments.Flip);
  FlipJob job(arguments, files);
  enter(Phase::Reading);
  job.Read();
  enter(Phase::Flipping);
  job.Flip();
  enter(Phase::Writing);
  job.Write();
  job.Tell();
  enter(Phase::Over);
  return static_cast<int>(job.GetExitCode());
}

}
