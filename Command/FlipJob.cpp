// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipJob.h"

#include "CommandError.h"
#include "Console.h"
#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "Formats.h"
#include "OutputFiles.h"
#include "Report.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipPoints.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStaticCleanPolyData.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <limits>
#include <regex>
#include <stdexcept>
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

void ConfigureRun(vtkDelaunayFlipAlgorithm* filter, const FlipOptions& flip)
{
  filter->SetBackend(static_cast<int>(flip.Backend));
  filter->SetMaximumIterations(flip.MaximumIterations);
  filter->SetNumberOfThreads(flip.NumberOfThreads);
  filter->SetDeviceId(flip.Device);
}

void Configure(vtkDelaunayFlip* filter, const Arguments& arguments, double diagonal)
{
  const FlipOptions& flip = arguments.Flip;
  ConfigureRun(filter, flip);
  filter->SetGeometry(static_cast<int>(flip.Geometry));
  filter->SetCriterion(static_cast<int>(flip.Criterion));
  filter->SetTieRule(static_cast<int>(flip.TieRule));
  filter->SetTolerance(flip.Tolerance);
  filter->SetFeatureAngle(flip.FeatureAngle);
  filter->SetMaximumDeviation(
    flip.MaximumDeviation * (arguments.DeviationIsPercent ? diagonal / 100.0 : 1.0));
  filter->SetDevices(arguments.Devices.c_str());
  filter->SetNumberOfPieces(flip.NumberOfPieces);
  filter->SetLinesAsConstraints(!arguments.IgnoreLines);
  filter->SetInsertLines(arguments.InsertLines);
  filter->SetInsertConstraints(arguments.InsertConstraints);
  filter->SetRegionArray(arguments.RegionArray.c_str());
  filter->SetGenerateQuality(arguments.Quality);
}

void Configure(vtkDelaunayFlipPoints* filter, const Arguments& arguments)
{
  const PointOptions& points = arguments.Flip;
  ConfigureRun(filter, points);
  filter->SetProjection(arguments.InBestPlane);
  filter->SetLinesAsSegments(arguments.InsertLines);
  filter->SetSplitCrossings(points.SplitCrossings);
  filter->SetAlpha(points.Alpha);
  filter->SetLongestEdge(points.LongestEdge);
  filter->SetPointTolerance(points.PointTolerance);
  filter->SetOutlineToAny();
}

/// The filter's message with options of the command for properties of the filter.
std::string WithOptions(const std::string& message, bool mergesPoints)
{
  std::string text = message;
  for (const auto& [property, option] :
    { std::pair("\\bRegionArray\\b", "--region-array"), std::pair("\\bTolerance\\b", "--tolerance"),
      std::pair("merge points that lie at the same place",
        mergesPoints ? "no two edges lie at the same place, even after --merge-points"
                     : "--merge-points joins those that lie at the same place") })
  {
    text = std::regex_replace(text, std::regex(property), option);
  }
  return text;
}

/// The lines and polygons of `mesh`, with all its points, as vtkDelaunayFlipPoints takes them:
/// breaklines as lines, and rings as polygons.
vtkSmartPointer<vtkPolyData> MakeSegments(
  vtkPolyData* mesh, const std::string& path, bool areBreaklines)
{
  const vtkNew<vtkCellArray> segments;
  for (vtkCellArray* const cells : { mesh->GetLines(), mesh->GetPolys() })
  {
    const bool areLines = cells == mesh->GetLines();
    vtkIdType cell = 0;
    const auto add = [&](vtkIdType size, const vtkIdType* points)
    {
      const auto require = [&](bool isTrue, const char* problem)
      {
        if (!isTrue)
        {
          throw CommandError(ExitCode::BadFile,
            path + (areLines ? ": line " : ": polygon ") + std::to_string(cell) + problem);
        }
      };
      std::vector<vtkIdType> ids(points, points + size);
      if (!areBreaklines)
      {
        const char* const few = " has fewer than three points, so it is no ring";
        require(size > 2, few);
        std::array<double, 3> first, last;
        mesh->GetPoint(ids.front(), first.data());
        mesh->GetPoint(ids.back(), last.data());
        require(first == last || !areLines, " does not end where it begins, so it is no ring");
        ids.resize(ids.size() - (first == last ? 1 : 0));
        require(ids.size() > 2, few);
      }
      else if (!areLines && size > 0)
      {
        ids.push_back(ids.front());
      }
      segments->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
      ++cell;
    };
    ForEachCell(cells, add);
  }
  auto made = vtkSmartPointer<vtkPolyData>::New();
  made->SetPoints(mesh->GetPoints());
  made->GetPointData()->ShallowCopy(mesh->GetPointData());
  (areBreaklines ? made->SetLines(segments) : made->SetPolys(segments));
  return made;
}

/// The work from reading to the report, one function per step.
class FlipJob
{
public:
  FlipJob(const Arguments& arguments, OutputFiles& files)
    : Settings(arguments),
      Files(files),
      Bar(!arguments.Quiet)
  {
    CollectVTKMessages();
  }

  void Read()
  {
    const auto start = Clock::now();
    this->Input = this->ReadFile(this->Settings.Input);
    if (this->Settings.FromPoints)
    {
      this->ReadSegments();
    }
    else if (!this->Settings.Constraints.empty())
    {
      this->Segments = this->ReadFile(this->Settings.Constraints);
    }
    if (this->Settings.MergePoints)
    {
      this->MergePoints();
    }
    this->Run.ReadSeconds = SecondsSince(start);
    const bool hasTriangles =
      this->Input->GetNumberOfPolys() + this->Input->GetNumberOfStrips() > 0;
    if (hasTriangles == this->Settings.FromPoints)
    {
      this->Note(this->Settings.Input +
        (hasTriangles ? ": its triangles are not used, only its points"
                      : ": contains no triangles; --from-points makes them"));
    }
  }

  void Flip()
  {
    if (this->Settings.FromPoints)
    {
      const auto filter = vtkSmartPointer<vtkDelaunayFlipPoints>::New();
      filter->SetSegmentsData(this->Segments);
      if (this->Segments)
      {
        filter->SetFirstHole(this->Segments->GetNumberOfLines() + this->OutlineRings);
      }
      Configure(filter, this->Settings);
      this->Filter = filter;
    }
    else
    {
      const auto filter = vtkSmartPointer<vtkDelaunayFlip>::New();
      filter->SetConstraintsData(this->Segments);
      Configure(filter, this->Settings, this->Input->GetLength());
      this->Filter = filter;
    }
    this->Bar.Begin(Phase::Flipping, "finding edges");
    this->Filter->AddObserver(vtkCommand::ProgressEvent, this, &FlipJob::ShowProgress);
    this->Filter->SetInputData(this->Input);
    this->Filter->Update();
    this->Bar.Clear();
    for (const std::string& warning : TakeVTKWarnings())
    {
      this->Warn(WithOptions(warning, this->Settings.MergePoints));
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
    WriteMesh(mesh, this->Files.Mesh.GetTemporary(), this->Settings.OutputFormat);
    this->Bar.Clear();
    this->Run.WriteSeconds = SecondsSince(start);
    mesh->SetFieldData(this->Input->GetFieldData()); // what flips add is in reports
    const std::string losses = DescribeLosses(mesh, this->Settings.OutputFormat);
    if (!losses.empty())
    {
      this->Note(this->Settings.Output + ": this file format cannot store: " + losses);
    }
  }

  void Tell()
  {
    this->Files.Statistics.Write(MakeCsv(this->Run.Flip));
    this->Files.Report.Write(MakeJson(this->Run));
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
  void ShowProgress()
  {
    const vtkIdType iterations = this->Filter->GetNumberOfIterations();
    this->Bar.Show(this->Filter->GetProgress(),
      iterations == 0 ? "finding edges"
                      : "iteration " + std::to_string(iterations) + ", " +
          Counted(this->Filter->GetTotalFlips(), "flip"));
  }

  vtkSmartPointer<vtkPolyData> ReadFile(const std::string& path)
  {
    this->Bar.Begin(Phase::Reading, "reading " + path);
    const FileMesh file = ReadMesh(path, FormatOf(path));
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

  /// Of points: breaklines and rings, as one mesh.
  void ReadSegments()
  {
    const vtkNew<vtkAppendPolyData> all;
    int mostArrays = 0;
    const Arguments& files = this->Settings;
    for (const std::string* file : { &files.Constraints, &files.Outline, &files.Holes })
    {
      const std::string& path = *file;
      if (path.empty())
      {
        continue;
      }
      const vtkSmartPointer<vtkPolyData> mesh = this->ReadFile(path);
      if (mesh->GetNumberOfLines() + mesh->GetNumberOfPolys() == 0)
      {
        throw CommandError(ExitCode::BadFile, path + ": has no lines or polygons");
      }
      this->TakeExactPlaces(mesh);
      const auto segments = MakeSegments(mesh, path, file == &files.Constraints);
      this->OutlineRings += file == &files.Outline ? segments->GetNumberOfPolys() : 0;
      all->AddInputData(segments);
      mostArrays = std::max(mostArrays, mesh->GetPointData()->GetNumberOfArrays());
    }
    if (all->GetNumberOfInputConnections(0) > 0)
    {
      all->Update();
      this->Segments = all->GetOutput();
      if (this->Segments->GetPointData()->GetNumberOfArrays() < mostArrays)
      {
        this->Warn("of the point data of breaklines, outline and holes, only arrays that all of "
                   "these files have are kept");
      }
    }
  }

  /// Makes floats doubles, as they become where another file has doubles. Those at a point of the
  /// input, rounded, become that point.
  void TakeExactPlaces(vtkPolyData* mesh) const
  {
    std::vector<double> storage, inputStorage;
    const PointArray points = ViewPoints(mesh, storage);
    const PointArray inputPoints = ViewPoints(this->Input, inputStorage);
    if (!points.Floats || inputPoints.Floats)
    {
      return;
    }
    PointPlaces places(true);
    std::vector<std::int64_t> placeOf(points.Count);
    for (std::int64_t i = 0; i < points.Count; ++i)
    {
      placeOf[i] = places.Add(points, i);
    }
    std::vector<std::int64_t> inputAt(places.GetNumberOfPlaces(), PointPlaces::None);
    for (std::int64_t i = inputPoints.Count - 1; i >= 0; --i)
    {
      const std::int64_t place = places.Find(inputPoints, i);
      if (place != PointPlaces::None)
      {
        inputAt[place] = i;
      }
    }
    const vtkNew<vtkPoints> exact;
    exact->SetDataTypeToDouble();
    exact->DeepCopy(mesh->GetPoints());
    for (std::int64_t i = 0; i < points.Count; ++i)
    {
      const std::int64_t same = inputAt[placeOf[i]];
      if (same != PointPlaces::None)
      {
        exact->SetPoint(i, this->Input->GetPoint(same));
      }
    }
    mesh->SetPoints(exact);
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

  /// Names the file of the ring that cannot be used, and the number that it has there.
  [[noreturn]] void FailOnRing(const std::smatch& message) const
  {
    const vtkIdType ring = std::stoll(message[1].str()) - this->Segments->GetNumberOfLines();
    const bool isHole = ring >= this->OutlineRings;
    throw CommandError(ExitCode::BadFile,
      (isHole ? this->Settings.Holes : this->Settings.Outline) + ": ring " +
        std::to_string(ring - (isHole ? this->OutlineRings : 0)) +
        (message[2].matched ? " cannot be used" + message[3].str() +
              "; --split-crossings adds points where it crosses others"
                            : message[3].str()));
  }

  void ThrowErrors()
  {
    const std::string errors = TakeVTKErrors();
    static const std::regex ring("\\bring (\\d+)( from .* cannot be inserted)?(.*)");
    std::smatch found;
    if (std::regex_search(errors, found, ring))
    {
      this->FailOnRing(found);
    }
    if (!errors.empty())
    {
      const std::string text = WithOptions(errors, this->Settings.MergePoints);
      const int failure = this->Filter->GetFailure();
      if (failure == vtkDelaunayFlip::FAILURE_OTHER)
      {
        throw std::runtime_error(text); // main says of which file, and what was being done
      }
      throw CommandError(failure == vtkDelaunayFlip::FAILURE_OPTIONS ? ExitCode::WrongUsage
          : failure == vtkDelaunayFlip::FAILURE_BACKEND              ? ExitCode::NoBackend
                                                                     : ExitCode::BadFile,
        this->Settings.Input + ": " + text);
    }
  }

  void TakeReport()
  {
    this->Run.IsFromPoints = this->Settings.FromPoints;
    FlipReport& report = this->Run.Flip;
    report = this->Filter->GetReport();
    this->Run.Summary = this->Filter->GetSummary();
    if (report.Triangles == 0)
    {
      report.Points = this->Filter->GetOutput()->GetNumberOfPoints();
      this->Run.Summary = "mesh: " + Counted(report.Points, "point") + ", no triangles\n";
      report.MinimumAngleBefore = std::numeric_limits<double>::quiet_NaN();
      report.MinimumAngleAfter = report.MinimumAngleBefore;
    }
  }

  const Arguments& Settings;
  OutputFiles& Files;
  ProgressBar Bar;
  vtkSmartPointer<vtkPolyData> Input;
  vtkSmartPointer<vtkPolyData> Segments; ///< Those of constraints and rings; or null.
  vtkIdType OutlineRings = 0; ///< How many of the rings come first.
  vtkSmartPointer<vtkDelaunayFlipAlgorithm> Filter;
  RunReport Run;
};

}

int RunFlipJob(const Arguments& arguments, OutputFiles& files, ChildProcess& child)
{
  KeepVTKFromThreads();
  TryOptions(arguments.Flip);
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
