// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"

#include "ArgumentChecks.h"
#include "CommandError.h"
#include "Console.h"
#include "CudaDevice.h"
#include "FlipError.h"
#include "HelpPage.h"
#include "InputFile.h"
#include "PointColumns.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>

namespace delaunayflip
{

namespace
{

/// Calls a method of the filters that have it.
template <typename Filter, typename... T>
std::function<void(T...)> Set(Arguments& arguments, void (Filter::*method)(T...))
{
  return [&arguments, method](T... value)
  {
    const std::array<vtkObject*, 3> filters = { arguments.Flip, arguments.Points,
      arguments.Interpolator };
    for (vtkObject* const each : filters)
    {
      if (auto* const filter = dynamic_cast<Filter*>(each))
      {
        (filter->*method)(value...);
      }
    }
  };
}

/// @param words the choices, in the order of the enumeration.
void AddChoice(CLI::App& app, const std::string& name, const std::function<void(int)>& set,
  const std::vector<std::string>& words, const std::string& help)
{
  const auto take = [set, words](const std::string& word)
  { set(static_cast<int>(std::find(words.begin(), words.end(), word) - words.begin())); };
  CLI::Validator check = CLI::IsMember(words);
  CLI::Option* const option = app.add_option_function<std::string>(name, take, help);
  option->type_name(check.get_description())->check(check.description(""));
}

/// A number in a range; unlike with CLI::Range, NaN is in none. An integer may have leading zeros,
/// which CLI would take for octal.
template <typename T>
CLI::Validator Within(T low, T high, const std::string& range)
{
  const auto check = [low, high, range](std::string& text)
  {
    T value = 0;
    if (ReadNumber(text, value) != std::errc() || !(value >= low && value <= high))
    {
      return text + " is not " + range;
    }
    if (std::is_integral_v<T>)
    {
      text = std::to_string(value);
    }
    return std::string();
  };
  return CLI::Validator(check, "");
}

/// An option with a value that is checked. `type` is what help calls the value.
template <typename T>
void AddValue(CLI::App& app, const std::string& name, const std::function<void(T)>& set,
  const std::string& type, const CLI::Validator& check, const std::string& help)
{
  app.add_option_function<T>(name, set, help)->type_name(type)->transform(check);
}

/// An empty name would count as an option that is not given.
std::string FindFaultOfName(const std::string& text)
{
  return text.empty() ? "the name is empty" : "";
}

CLI::Option* AddFile(
  CLI::App& app, const std::string& name, std::string& value, const std::string& help)
{
  return app.add_option(name, value, help)->type_name("FILE")->check(FindFaultOfName);
}

void AddReadOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(ToRead);
  AddFile(app, "INPUT", arguments.Input, "The mesh or the points to read")->required();
  app.add_flag("--merge-points", arguments.MergePoints,
    "First join points of the input at the same place, as in a file that lists the corners of "
    "each triangle. The merged point keeps the data of the first one. Triangles that collapse are "
    "left out and counted, with the first cell ids. Points that no cell uses are left out");
  app.add_flag("--drop-duplicates", arguments.DropDuplicates,
    "Keep only the first of several triangles with the same three corners. Otherwise their edges "
    "could not flip");
  app.add_flag("--orient", arguments.Orient,
    "Turn over as few triangles as possible so that neighbours are wound the same way. Edges "
    "between triangles that are wound differently never flip");
}

void AddJudgeOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(ToJudge);
  AddChoice(app, "--geometry", Set(arguments, &vtkDelaunayFlip::SetGeometry),
    { "auto", "planar", "planar-xy", "surface", "sphere" },
    "Where edges are judged: in the plane of the points (planar), by x and y alone "
    "(planar-xy, for terrain), in space (surface) or on a globe around the origin (sphere). auto: "
    "planar if all points lie in one plane, planar-xy if the mesh is a height field of gentle "
    "slopes or mixed units, else surface [auto]");
  AddChoice(app, "--criterion", Set(arguments, &vtkDelaunayFlip::SetCriterion),
    { "in-circle", "opposite-angles" },
    "Exact in-circle test, or opposite-angle sum above pi; surfaces always use the latter "
    "[in-circle]");
  AddValue(app, "--tolerance", Set(arguments, &vtkDelaunayFlip::SetTolerance), "RADIANS",
    Within(-1.0, -1.0, "automatic (-1)") |
      Within(0.0, std::nextafter(1.0, 0.0), "an angle from 0 to less than 1 radian"),
    "How far an opposite-angle sum may exceed pi, in radians; -1 (automatic): for each edge as "
    "much as the rounding of its points can explain [-1]");
  AddChoice(app, "--tie-rule", Set(arguments, &vtkDelaunayFlip::SetTieRule),
    { "keep", "canonical" },
    "Edges with all four points on one circle: keep them, or make the result independent of the "
    "input's triangles (not on surfaces in space) [keep]");
}

void AddStayOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(ToStay);
  AddValue(app, "--feature-angle", Set(arguments, &vtkDelaunayFlip::SetFeatureAngle), "DEGREES",
    Within(0.0, 180.0, "an angle from 0 to 180 degrees"),
    "On surfaces, edges sharper than this many degrees stay; 180 turns this off [30]");
  AddValue(app, "--max-deviation", Set(arguments, &vtkDelaunayFlip::SetMaximumDeviation), "LENGTH",
    CLI::Validator(
      [&arguments](std::string& text)
      {
        arguments.DeviationIsPercent = !text.empty() && text.back() == '%';
        std::string number = text;
        if (arguments.DeviationIsPercent)
        {
          number.pop_back();
        }
        if (!Within(0.0, std::numeric_limits<double>::infinity(), "")(number).empty())
        {
          return text + " is not a length of 0 or more, or a percentage such as 1%";
        }
        text = number;
        return std::string();
      },
      ""),
    "On surfaces, an edge stays if its flip would move the surface by more than this: a length, or "
    "with a percent sign a share of the bounding box's diagonal (1%). Many flips can add up [inf]");
  AddFile(app, "--constraints", arguments.Constraints,
    "A file with lines and polygons. Their edges stay. Its point ids are the input's if "
    "it has the same points; otherwise points are matched by their coordinates. In the plane, "
    "edges that the input does not have are inserted by flips");
  app.add_flag_callback("--no-insert-constraints",
    Set(arguments, &vtkDelaunayFlip::InsertConstraintsOff), "Do not insert edges of --constraints");
  const auto insertLines = [&arguments]
  {
    arguments.Flip->InsertLinesOn();
    arguments.Points->LinesAsSegmentsOn();
    arguments.Interpolator->LinesAsSegmentsOn();
  };
  app.add_flag_callback(
    "--insert-lines", insertLines, "Insert edges along lines of the input as well");
  app.add_flag_callback("--ignore-lines", Set(arguments, &vtkDelaunayFlip::LinesAsConstraintsOff),
    "Do not keep edges along lines of the input");
  app
    .add_option_function<std::string>(
      "--region-array",
      [&arguments](const std::string& name) { arguments.Flip->SetRegionArray(name.c_str()); },
      "A cell array of the input: edges between cells of different values stay")
    ->type_name("NAME")
    ->check(FindFaultOfName);
}

/// Reads x,y,label or x,y,label,area. @returns what is wrong, or "".
std::string ParseRegion(const std::string& text, std::array<double, 4>& region)
{
  region = {};
  std::istringstream words(text + ',');
  std::size_t count = 0;
  bool areNumbers = true;
  for (std::string word; std::getline(words, word, ',') && count <= region.size(); ++count)
  {
    std::int32_t label = 0;
    double value = 0.0;
    const bool isLabel = count == 2;
    std::errc error = isLabel ? ReadNumber(word, label) : ReadNumber(word, value);
    areNumbers = areNumbers && error == std::errc() && std::isfinite(value);
    region[std::min<std::size_t>(count, 3)] = isLabel ? label : value;
  }
  if (!areNumbers || count < 3 || count > region.size() || region[3] < 0.0)
  {
    return "'" + text +
      "' is not x,y,label or x,y,label,area, with an integer as label and an area of 0 or more";
  }
  return "";
}

void AddRegionOption(CLI::App& app, Arguments& arguments)
{
  const auto addRegions = [&arguments](const std::vector<std::string>& regions)
  {
    for (const std::string& text : regions)
    {
      std::array<double, 4> region{};
      ParseRegion(text, region);
      arguments.Points->AddRegion(region[0], region[1], region[2], region[3]);
      arguments.Flip->AddRegion(region[0], region[1], region[2], region[3]);
    }
  };
  const auto findFault = [](const std::string& text)
  {
    std::array<double, 4> region{};
    return ParseRegion(text, region);
  };
  app
    .add_option_function<std::vector<std::string>>("--region", addRegions,
      "A place in a part that segments, or kept edges of a mesh, enclose: x,y,label or "
      "x,y,label,area. Its triangles get the label, an integer, in the cell array Region, and are "
      "not larger than the area. May be given several times")
    ->type_name("LIST")
    ->allow_extra_args(false)
    ->check(findFault);
}

void AddPointOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(OfPoints);
  app.add_flag("--from-points", arguments.FromPoints,
    "Make a mesh from the points of INPUT alone: their Delaunay triangulation. The "
    "lines and polygons of --constraints become edges of it, and with --insert-lines the lines of "
    "INPUT too. Points of these files that INPUT does not have are added");
  app
    .add_option("--columns", arguments.Columns,
      "Which columns of a .xyz, .csv or .txt are x, y and perhaps z, by name or by number from 1: "
      "x,y,z or 2,3,4 [those with known names, else the first ones]. For a .shp and the like: the "
      "attribute that is z")
    ->type_name("LIST")
    ->check(
      [](const std::string& list) {
        return list.empty() || list.find(',') != list.npos ? ChosenColumns(list).FindFault() : "";
      });
  AddFile(app, "--outline", arguments.Outline,
    "A file with rings: polygons, and lines that close. What is not inside them is removed");
  AddFile(app, "--holes", arguments.Holes,
    "A file with rings: polygons, and lines that close. What is inside them is removed");
  AddChoice(app, "--ring-rule", Set(arguments, &vtkDelaunayFlipPoints::SetRingRule),
    { "evenodd", "nonzero", "orientation" },
    "When a place is inside the rings of a file: if a path to infinity crosses them an odd number "
    "of times, or if their turns around the place do not add up to 0. orientation: as nonzero, but "
    "counter-clockwise rings of --outline enclose what is kept, and clockwise ones cut holes "
    "[evenodd]");
  AddChoice(app, "--heights", Set(arguments, &vtkDelaunayFlipPoints::SetSegmentHeights),
    { "auto", "survey", "own" },
    "Which heights points have that INPUT does not have: those of INPUT there, interpolated in its "
    "triangulation, or those of their file. auto: survey for lines or rings with z = 0 throughout, "
    "if INPUT has other heights, and where z is not finite; else own [auto]");
  app.add_flag_callback("--split-crossings",
    Set(arguments, &vtkDelaunayFlipPoints::SplitCrossingsOn),
    "Add a point where segments cross. Otherwise a segment that crosses an earlier one is left "
    "out");
  app.add_flag_callback("--pass-segments", Set(arguments, &vtkDelaunayFlipPoints::PassSegmentsOn),
    "Also write the edges that segments have become, as lines. The cell array SegmentIds has the "
    "number of the segment's line or ring in its files: first lines, then rings of --outline and "
    "of --holes. The point array SegmentIds has it for points that refinement puts there. -1: "
    "none");
  const auto length = Within(0.0, std::numeric_limits<double>::max(), "a length of 0 or more");
  AddValue(app, "--alpha", Set(arguments, &vtkDelaunayFlipPoints::SetAlpha), "RADIUS", length,
    "Remove a triangle if its circumcircle has a larger radius; 0: none [0]");
  AddValue(app, "--longest-edge", Set(arguments, &vtkDelaunayFlipPoints::SetLongestEdge), "LENGTH",
    length, "Remove triangles that have a longer edge; 0: none [0]");
  AddValue(app, "--point-tolerance", Set(arguments, &vtkDelaunayFlipPoints::SetPointTolerance),
    "LENGTH", length,
    "Leave out points that are nearer than this to an earlier one; 0: only those at the same "
    "place [0]");
  AddChoice(app, "--projection", Set(arguments, &vtkDelaunayFlipPoints::SetProjection),
    { "xy", "plane", "sphere", "open-sphere" },
    "Where points are joined: by x and y, in the plane that fits them best, or on a sphere around "
    "the origin, by their convex hull. open-sphere: a triangle is left out if its circumcircle "
    "encloses half of the sphere or more. On a sphere segments run along great circles, and the "
    "inside of a ring is its smaller side [xy]");
  app.add_flag_callback("--degrees", Set(arguments, &vtkDelaunayFlipPoints::DegreesOn),
    "On a sphere, x and y are longitudes and latitudes in degrees, in all files. The points of a "
    "mesh are written as places on the unit sphere, and their z, if it is not 0 throughout, as the "
    "point array Height");
}

/// Options that add points, to a mesh or to what is made from points.
void AddRefinementOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(ToRefine);
  AddRegionOption(app, arguments);
  const auto length = Within(0.0, std::numeric_limits<double>::max(), "a length of 0 or more");
  AddValue(app, "--minimum-angle", Set(arguments, &vtkDelaunayFlipAlgorithm::SetMinimumAngle),
    "DEGREES", Within(0.0, 33.0, "an angle from 0 to 33 degrees"),
    "In the plane and on terrain, add points until no angle is smaller; 0: no limit. Triangles "
    "that cannot get better, because edges that stay meet at a small angle, are left [0]");
  AddValue(app, "--maximum-area", Set(arguments, &vtkDelaunayFlipAlgorithm::SetMaximumArea), "AREA",
    Within(0.0, std::numeric_limits<double>::max(), "an area of 0 or more"),
    "Add points until no triangle is larger; 0: no limit [0]");
  AddValue(app, "--maximum-edge", Set(arguments, &vtkDelaunayFlipAlgorithm::SetMaximumEdge),
    "LENGTH", length, "Add points until no edge is longer; 0: no limit [0]");
  const auto setArray = [&arguments](const std::string& name)
  {
    arguments.Flip->SetSizeArray(name.c_str());
    arguments.Points->SetSizeArray(name.c_str());
  };
  app
    .add_option_function<std::string>("--size-array", setArray,
      "A point array of INPUT: add points until no edge is longer than it says there, linear "
      "between the points")
    ->type_name("NAME")
    ->check(FindFaultOfName);
  app.add_flag_callback("--keep-boundary",
    Set(arguments, &vtkDelaunayFlipAlgorithm::KeepBoundaryOn),
    "Add no points on the boundary of the mesh. Angles there may stay small, or become smaller");
  AddValue(app, "--point-limit", Set(arguments, &vtkDelaunayFlipAlgorithm::SetPointLimit), "INT",
    Within<std::int64_t>(0, std::numeric_limits<std::int64_t>::max(), "a number of points"),
    "Add no more points when the mesh has this many; 0: ten times as many as are given, at least "
    "a million [0]");
}

void AddHeightOptions(CLI::App& app, Arguments& arguments)
{
  HeightOptions& heights = arguments.Heights;
  app.option_defaults()->group(ToAsk);
  const std::function<void(double)> setStep = [&heights](double step) { heights.Step = step; };
  AddValue(app, "--raster", setStep, "STEP",
    Within(std::numeric_limits<double>::min(), std::numeric_limits<double>::max(),
      "the width of a cell, more than 0"),
    "Write a raster of heights instead of a mesh. OUTPUT is a .tif (GeoTIFF), .asc (ESRI ASCII "
    "grid) or .vti with square cells of this width. A cell has the height at its centre");
  AddFile(app, "--heights-at", heights.Places,
    "Write a table instead of a mesh. OUTPUT is a .csv with x, y and z of each point of this file; "
    "z is empty outside of the mesh");
  AddChoice(app, "--raster-method", Set(arguments, &vtkDelaunayFlipInterpolator::SetMethod),
    { "linear", "natural" },
    "How heights between points are found: linear in each triangle, or from natural neighbours, "
    "which is smooth except at the points [linear]");
  app
    .add_option("--raster-array", heights.Array, "A point array of INPUT to take instead of z [z]")
    ->type_name("NAME")
    ->check(FindFaultOfName);
  const auto findFault = [](const std::string& text)
  {
    std::array<double, 4> extent{};
    return ParseExtent(text, extent);
  };
  app
    .add_option("--extent", heights.Extent,
      "The borders of the raster: xmin,ymin,xmax,ymax. Where the step does not fit, there is a "
      "cell more [around the points, at whole multiples of the step]")
    ->type_name("LIST")
    ->check(findFault);
  app
    .add_option("--crs", heights.Crs,
      "The coordinate reference system that a .tif gets, and an .asc in a .prj beside it, such as "
      "EPSG:25832 [in a .tif that of INPUT, if its file names one]")
    ->type_name("NAME")
    ->check(FindFaultOfName);
}

void AddRunOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(ToRun);
  AddValue(app, "--max-iterations", Set(arguments, &vtkDelaunayFlipAlgorithm::SetMaximumIterations),
    "INT",
    Within<std::int64_t>(
      -1, std::numeric_limits<std::int64_t>::max(), "a number of iterations (-1 or more)"),
    "Stop after this many iterations; -1: when nothing is left to flip [-1]");
  AddChoice(app, "--backend", Set(arguments, &vtkDelaunayFlipAlgorithm::SetBackend),
    { "auto", "cuda", "threads" },
    "Where the flips run; the result is the same. auto: on a GPU if there is one and the mesh has "
    "at least " +
      std::to_string(SmallestMeshForCuda) +
      " triangles, else, or if the GPU fails, on the CPU [auto]");
  AddValue(app, "--device", Set(arguments, &vtkDelaunayFlipAlgorithm::SetDeviceId), "INT",
    Within(-1, std::numeric_limits<int>::max(), "the number of a GPU (-1 or more)"),
    "Which GPU, by CUDA's number, 0 or more; -1: CUDA's default [-1]");
  const auto setDevices = [&arguments](const std::string& list)
  {
    ParseDevices(list);
    arguments.Flip->SetDevices(list.c_str());
  };
  app
    .add_option_function<std::string>("--devices", setDevices,
      "GPUs that share the mesh: CUDA's numbers separated by commas (0,1), or all. Meshes "
      "of 12 million triangles or more per GPU flip faster, with the same result. Needs NVLink")
    ->type_name("LIST");
  AddValue(app, "--pieces", Set(arguments, &vtkDelaunayFlip::SetNumberOfPieces), "INT",
    Within(0, 255, "a number of pieces (0 to 255)"),
    "Flip the mesh in this many pieces, one after the other, so that it may be larger than the "
    "memory of the GPU. With --devices they take turns and need no NVLink. With --tie-rule "
    "canonical the result does not depend on it; 0: as few as possible [0]");
  AddValue(app, "--threads", Set(arguments, &vtkDelaunayFlipAlgorithm::SetNumberOfThreads), "INT",
    Within(0, 65536, "a number of threads (0 to 65536)"),
    "Number of CPU threads; 0: all. At most twice as many as there are cores are used, or 16 if "
    "that is more. The result does not depend on it [0]");
}

void AddWriteOptions(CLI::App& app, Arguments& arguments)
{
  app.option_defaults()->group(ToWrite);
  AddFile(app, "OUTPUT", arguments.Output, "The mesh to write; may be INPUT")->required();
  app.add_flag_callback("--quality", Set(arguments, &vtkDelaunayFlip::GenerateQualityOn),
    "Add cell arrays of the smallest angle of each triangle, in degrees, before and after "
    "(.vtk and .vtp)");
  AddFile(app, "--statistics", arguments.Statistics, "Write a table of the iterations (CSV)");
  AddFile(app, "--report", arguments.Report, "Write a summary of the run (JSON)");
  app.add_flag("--quiet", arguments.Quiet,
    "No summary, notes or progress bar; warnings and errors still appear");
  app.option_defaults()->group(ToHelp);
  app.get_help_ptr()->group(ToHelp);
  app.set_version_flag("--version", "delaunay-flip " DELAUNAYFLIP_VERSION);
}

/// Which options need others, or exclude them.
void RelateOptions(CLI::App& app)
{
  app.get_option("--insert-lines")->excludes("--ignore-lines");
  CLI::Option* const fromPoints = app.get_option("--from-points");
  const auto isForPoints = [fromPoints](const CLI::Option* option)
  { return option->get_group() == OfPoints && option != fromPoints; };
  for (CLI::Option* const option : app.get_options(isForPoints))
  {
    option->needs(fromPoints);
  }
  CLI::Option* const raster = app.get_option("--raster");
  CLI::Option* const heightsAt = app.get_option("--heights-at");
  raster->needs(fromPoints)->excludes(heightsAt);
  heightsAt->needs(fromPoints);
  app.get_option("--pass-segments")->excludes(raster, heightsAt);
  app.get_option("--extent")->needs(raster);
  app.get_option("--crs")->needs(raster);
  fromPoints->excludes("--geometry", "--criterion", "--feature-angle", "--max-deviation",
    "--tolerance", "--tie-rule", "--merge-points", "--drop-duplicates", "--orient",
    "--no-insert-constraints", "--ignore-lines", "--region-array", "--devices", "--pieces",
    "--quality");
}

}

std::optional<int> ParseArguments(int argc, char** argv, Arguments& arguments)
{
  CLI::App app(DescribeCommand(), "delaunay-flip");
  app.formatter(std::make_shared<PlainFormatter>());
  app.footer(DescribeExitCodes());
  AddReadOptions(app, arguments);
  AddJudgeOptions(app, arguments);
  AddStayOptions(app, arguments);
  AddPointOptions(app, arguments);
  AddRefinementOptions(app, arguments);
  AddHeightOptions(app, arguments);
  AddRunOptions(app, arguments);
  AddWriteOptions(app, arguments);
  RelateOptions(app);
  try
  {
    app.parse(argc, argv);
    for (const char* const option : { "--raster-method", "--raster-array" })
    {
      if (app.count(option) > 0 && !arguments.Heights.AreWanted())
      {
        throw CLI::RequiresError(option, "--raster or --heights-at");
      }
    }
    CheckArguments(arguments);
  }
  catch (const CLI::Success& success)
  {
    return app.exit(success);
  }
  catch (const InvalidOptions& error)
  {
    throw CommandError(ExitCode::WrongUsage, std::string("--devices: ") + error.what());
  }
  catch (const CLI::ParseError& error)
  {
    std::string problem = ExplainAngle(app);
    if (problem.empty())
    {
      problem = error.what() + SuggestOption(app);
    }
    PrintError(problem + " (delaunay-flip --help shows the usage)");
    return static_cast<int>(ExitCode::WrongUsage);
  }
  return std::nullopt;
}

}
