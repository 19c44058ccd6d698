// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ArgumentChecks.h"

#include "CommandError.h"
#include "HeightQuery.h"
#include "InputFile.h"
#include "OutputFiles.h"
#include "PointColumns.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>

namespace delaunayflip
{

namespace
{

[[noreturn]] void FailOnUsage(const std::string& message)
{
  throw CommandError(ExitCode::WrongUsage, message);
}

/// Checks that longitudes and latitudes are given for a sphere, and that places fit the projection.
void CheckProjection(Arguments& arguments)
{
  const int projection = arguments.Points->GetProjection();
  const bool isSphere = projection == vtkDelaunayFlipPoints::PROJECTION_SPHERE ||
    projection == vtkDelaunayFlipPoints::PROJECTION_OPEN_SPHERE;
  if (arguments.Points->GetDegrees() && !isSphere)
  {
    FailOnUsage("--degrees needs --projection sphere or open-sphere");
  }
  HeightOptions& heights = arguments.Heights;
  const bool isPlane = projection == vtkDelaunayFlipPoints::PROJECTION_BEST_FITTING_PLANE;
  if (heights.AreWanted() && isPlane)
  {
    FailOnUsage("--raster and --heights-at take places in x and y, so they do not go with "
                "--projection plane");
  }
  heights.AreAngles = isSphere && arguments.Points->GetDegrees();
  heights.AreDirections = isSphere && !heights.AreAngles;
  if (heights.AreWanted() && heights.AreDirections && heights.Array.empty())
  {
    FailOnUsage("--raster and --heights-at on a sphere need --degrees, or --raster-array: without "
                "--degrees z is one of three coordinates, and no height");
  }
  std::array<double, 4> extent{};
  if (isSphere && !heights.Extent.empty())
  {
    ParseExtent(heights.Extent, extent);
  }
  const double furthest = std::max(-extent[1], extent[3]) - 0.5 * heights.Step;
  constexpr double Pole = 90.0, Rounding = 1e-4;
  if (furthest > Pole + Rounding)
  {
    FailOnUsage("--extent " + heights.Extent +
      ": cells have latitudes beyond 90 degrees; the second and the fourth number are latitudes");
  }
}

/// Checks that the format of the output fits what is written: a mesh, a raster or heights.
void CheckOutput(Arguments& arguments)
{
  const HeightOptions& heights = arguments.Heights;
  const std::string extension = ExtensionOf(arguments.Output);
  const bool isRaster = extension == ".tif" || extension == ".asc" || extension == ".vti";
  if (!heights.Places.empty() && extension != ".csv")
  {
    FailOnUsage(arguments.Output + ": --heights-at writes a .csv");
  }
  if (heights.Step > 0.0 && !isRaster)
  {
    FailOnUsage(arguments.Output + ": --raster writes a .tif, .asc or .vti");
  }
  if (!heights.Crs.empty() && extension == ".vti")
  {
    FailOnUsage(arguments.Output + ": --crs is for a .tif or .asc; a .vti does not store it");
  }
  if (!heights.Crs.empty() && extension == ".asc")
  {
    arguments.ProjectionFile =
      std::filesystem::path(arguments.Output).replace_extension(".prj").string();
  }
  if (heights.AreWanted())
  {
    return;
  }
  arguments.OutputFormat = FormatOf(arguments.Output);
  const bool isOther =
    arguments.OutputFormat == MeshFormat::Text || arguments.OutputFormat == MeshFormat::Vector;
  if (isOther)
  {
    FailOnUsage(
      arguments.Output + ": such a file holds no triangles; give a .vtk, .vtp, .ply, .stl or .obj");
  }
}

/// Checks that the formats of files fit their purposes.
void CheckFormats(Arguments& arguments)
{
  CheckOutput(arguments);
  const MeshFormat input = FormatOf(arguments.Input);
  const bool isOfPoints = input == MeshFormat::Text || input == MeshFormat::Vector;
  if (!arguments.Columns.empty() && !isOfPoints)
  {
    FailOnUsage(arguments.Input + ": --columns is for a file of points, such as .csv or .shp");
  }
  const bool isHeight = arguments.Columns.find(',') == std::string::npos;
  if (input == MeshFormat::Text && isHeight && !arguments.Columns.empty())
  {
    FailOnUsage("--columns: " + ChosenColumns("").FindFault());
  }
  if (input == MeshFormat::Vector && !isHeight)
  {
    FailOnUsage(
      arguments.Input + ": --columns takes one attribute of such a file as z; x and y are known");
  }
  if (isOfPoints && !arguments.FromPoints)
  {
    FailOnUsage(arguments.Input + ": has points, but no triangles; --from-points makes them");
  }
  for (const std::string& file : arguments.ListOthers())
  {
    if (!file.empty())
    {
      FormatOf(file); // fails for an unknown format before anything is read
    }
  }
}

}

void CheckArguments(Arguments& arguments)
{
  CheckFormats(arguments);
  if (arguments.FromPoints)
  {
    CheckProjection(arguments);
  }
  const bool holdsCellData =
    arguments.OutputFormat == MeshFormat::VTK || arguments.OutputFormat == MeshFormat::VTP;
  if (arguments.Flip->GetGenerateQuality() && !holdsCellData)
  {
    FailOnUsage(arguments.Output + ": --quality needs a .vtk or .vtp file");
  }
  // One file may be read for several purposes, and the output may replace the input.
  std::set<std::filesystem::path> used;
  for (const std::string& file : arguments.ListOthers())
  {
    used.insert(FollowLinks(FileLayer(file).File));
  }
  for (const std::string& file :
    { arguments.Output, arguments.Statistics, arguments.Report, arguments.ProjectionFile })
  {
    if (!file.empty() && !used.insert(FollowLinks(file)).second)
    {
      FailOnUsage(file + ": the same file is given for two purposes");
    }
    used.insert(FollowLinks(FileLayer(arguments.Input).File));
  }
}

}
