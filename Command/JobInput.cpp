// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JobInput.h"

#include "Arguments.h"
#include "CommandError.h"
#include "Console.h"
#include "GdalModule.h"
#include "InputRepair.h"
#include "JobMessages.h"
#include "MeshFiles.h"
#include "SegmentLines.h"

#include <vtkAppendPolyData.h>
#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipPoints.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <utility>

namespace delaunayflip
{

namespace
{

/// Reads the files of a run, one function per step.
class InputReader
{
public:
  InputReader(const Arguments& arguments, ProgressBar& bar, JobMessages& messages)
    : Settings(arguments),
      Bar(bar),
      Messages(messages)
  {
  }

  JobInput Read()
  {
    const HeightOptions& heights = this->Settings.Heights;
    this->Input.Mesh =
      this->ReadFile(this->Settings.Input, heights.Array.empty() ? Content::Mesh : Content::Places);
    if (this->HasAngles && !this->Settings.Points->GetDegrees())
    {
      this->Messages.Hint(this->Settings.Input +
        ": its points have longitudes and latitudes; --projection sphere --degrees joins them on a "
        "globe");
    }
    if (!heights.Places.empty())
    {
      this->Input.Places = this->ReadFile(heights.Places, Content::Rows);
      this->FindKindOfPlaces();
    }
    if (this->Settings.FromPoints)
    {
      this->ReadSegments();
      if (!heights.Crs.empty())
      {
        this->CompareCrs(heights.Crs, "--crs");
      }
    }
    else if (!this->Settings.Constraints.empty())
    {
      const std::string& path = this->Settings.Constraints;
      this->Input.Segments = MakeSegments(this->ReadFile(path, Content::Segments), path, true);
    }
    if (this->Settings.MergePoints)
    {
      this->Repair(MergeEqualPoints);
    }
    if (this->Settings.DropDuplicates)
    {
      this->Repair(DropDuplicates);
    }
    if (this->Settings.Orient)
    {
      this->Repair(Orient);
    }
    const bool hasTriangles =
      this->Input.Mesh->GetNumberOfPolys() + this->Input.Mesh->GetNumberOfStrips() > 0;
    if (this->Input.Mesh->GetNumberOfPoints() == 0)
    {
      this->Messages.Note(this->Settings.Input + ": is empty: it contains no points");
    }
    else if (hasTriangles && this->Settings.FromPoints)
    {
      this->Messages.Note(this->Settings.Input + ": its triangles are not used, only its points");
    }
    else if (!hasTriangles && !this->Settings.FromPoints)
    {
      this->Messages.Note(
        this->Settings.Input + ": contains no triangles; --from-points makes them");
    }
    return std::move(this->Input);
  }

private:
  /// Places for a mesh of x, y and z on a sphere may be longitudes and latitudes, as the cells of a
  /// raster are: then their columns are called so, or there is no third one.
  void FindKindOfPlaces()
  {
    if (!this->Settings.Heights.AreDirections)
    {
      return;
    }
    double bounds[6];
    this->Input.Places->GetBounds(bounds);
    const bool areFlat = bounds[4] == 0.0 && bounds[5] == 0.0;
    this->Input.PlacesAreAngles = this->PlacesHaveAngles || areFlat;
    if (this->Input.PlacesAreAngles)
    {
      this->Messages.Note(
        this->Settings.Heights.Places + ": its x and y are longitudes and latitudes in degrees");
    }
  }

  vtkSmartPointer<vtkPolyData> ReadFile(const std::string& path, Content content = Content::Mesh)
  {
    this->Bar.Begin(Phase::Reading, "reading " + path);
    const MeshFormat format = FormatOf(path);
    const bool isInput = path == this->Settings.Input && content != Content::Segments;
    const FileMesh file = ReadMesh(path, format, isInput ? this->Settings.Columns : "", content);
    if (isInput)
    {
      this->Input.Crs = file.Crs;
      this->HasAngles = file.HasAngles;
    }
    if (content == Content::Rows)
    {
      this->PlacesHaveAngles = file.HasAngles;
    }
    this->Bar.Clear();
    if (!file.Crs.empty())
    {
      this->CompareCrs(file.Crs, path);
    }
    // The others say that they have nothing.
    const bool mayBeEmpty =
      format == MeshFormat::VTK || format == MeshFormat::VTP || format == MeshFormat::PLY;
    if (file.Mesh->GetNumberOfPoints() == 0 && !mayBeEmpty)
    {
      throw CommandError(ExitCode::BadFile, path + ": is empty: it contains no points");
    }
    return this->Take(file, path);
  }

  /// Warns of a coordinate reference system that is not that of the files before.
  /// @param where a file, or the option that names it.
  void CompareCrs(const std::string& crs, const std::string& where)
  {
    const std::string difference = this->FilesCrs.Compare(crs, where);
    if (!difference.empty())
    {
      this->Messages.Warn(difference);
    }
  }

  /// The mesh, after its warnings have been told.
  vtkSmartPointer<vtkPolyData> Take(const FileMesh& file, const std::string& path)
  {
    for (const std::string& warning : file.Warnings)
    {
      this->Messages.Warn(path + ": " + warning);
    }
    for (const std::string& note : file.Notes)
    {
      this->Messages.Note(path + ": " + note);
    }
    const char* const regions = this->Settings.Flip->GetRegionArray();
    const bool hasRegions = regions != nullptr && *regions != '\0';
    if (!file.Labels.empty() && !hasRegions && path == this->Settings.Input &&
      !this->Settings.FromPoints)
    {
      this->Messages.Note(path + ": its faces have labels (" + JoinWords(file.Labels) +
        "); --region-array " + file.Labels.front() + " keeps the edges between them");
    }
    return file.Mesh;
  }

  void Repair(RepairedMesh (*repair)(vtkPolyData*))
  {
    const RepairedMesh repaired = repair(this->Input.Mesh);
    this->Input.Mesh = this->Take(repaired.Result, this->Settings.Input);
    this->Messages.Note(this->Settings.Input + ": " + repaired.Note);
  }

  /// Reads breaklines and rings, which become one mesh.
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
      const vtkSmartPointer<vtkPolyData> mesh = this->ReadFile(path, Content::Segments);
      TakeExactPlaces(mesh, this->Input.Mesh);
      if (mesh->GetPoints()->GetDataType() == VTK_DOUBLE &&
        this->Input.Mesh->GetPoints()->GetDataType() == VTK_FLOAT)
      {
        this->Messages.Note(
          path + ": its coordinates are rounded to floats, as those of the points are");
      }
      const auto segments = MakeSegments(mesh, path, file == &files.Constraints);
      if (file == &files.Outline)
      {
        this->Input.OutlineRings = segments->GetNumberOfPolys();
      }
      all->AddInputData(segments);
      mostArrays = std::max(mostArrays, mesh->GetPointData()->GetNumberOfArrays());
    }
    if (all->GetNumberOfInputConnections(0) > 0)
    {
      all->Update();
      this->Input.Segments = all->GetOutput();
      if (this->Input.Segments->GetPointData()->GetNumberOfArrays() < mostArrays)
      {
        this->Messages.Warn(
          "of the point data of breaklines, outline and holes, only arrays that all of "
          "these files have are kept");
      }
    }
  }

  const Arguments& Settings;
  ProgressBar& Bar;
  JobMessages& Messages;
  JobInput Input;
  bool HasAngles = false; ///< The input's file calls x and y longitudes and latitudes.
  bool PlacesHaveAngles = false; ///< That of the places does so.
  SharedCrs FilesCrs;
};

}

JobInput ReadInput(const Arguments& arguments, ProgressBar& bar, JobMessages& messages)
{
  return InputReader(arguments, bar, messages).Read();
}

}
