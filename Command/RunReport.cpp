// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RunReport.h"

#include "Arguments.h"
#include "PointTriangulation.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Replaces whole words, except within quotes, where they are a name.
void ReplaceWords(const std::string& from, const std::string& to, std::string& text)
{
  const auto isLetter = [&](std::size_t i)
  { return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0; };
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
  {
    const std::size_t end = at + from.size();
    const bool isQuoted = end < text.size() && text[end] == '"';
    const bool isPart = isLetter(end) || (at > 0 && isLetter(at - 1));
    if (isQuoted || isPart)
    {
      at = end;
      continue;
    }
    text.replace(at, from.size(), to);
    at += to.size();
  }
}
}

std::string WithOptions(const std::string& message, const Arguments& given)
{
  std::string text = message;
  std::string withoutDuplicates = "leave them out (--drop-duplicates)";
  if (given.DropDuplicates)
  {
    withoutDuplicates = "they are parts of larger polygons, so run --drop-duplicates on the output";
  }
  std::string withMerged = "--merge-points joins those that lie at the same place";
  if (given.MergePoints)
  {
    withMerged = "no two edges lie at the same place, even after --merge-points";
  }
  for (const auto& [property, option] :
    { std::pair("vtkPolyDataNormals with ConsistencyOn", "--orient"),
      std::pair("leave out such duplicates", withoutDuplicates.c_str()),
      std::pair("RegionArray", "--region-array"), std::pair("Tolerance", "--tolerance"),
      std::pair("the geometry 'planar-xy'", "--geometry planar-xy"),
      std::pair("use 'planar-xy'", "use --geometry planar-xy"),
      std::pair("SizeArray", "--size-array"), std::pair("SegmentHeights Own", "--heights own"),
      std::pair("merge points that lie at the same place", withMerged.c_str()) })
  {
    ReplaceWords(property, option, text);
  }
  const auto replace = [&text](const std::string& name, const auto&)
  {
    std::string option = "--" + name;
    std::replace(option.begin(), option.end(), '_', '-');
    ReplaceWords(ToCamelCase(name), option, text);
  };
  const PointOptions options;
  ForEachPointOption(replace, options);
  return text;
}

std::string MakeJson(const RunReport& run)
{
  const FlipReport& flip = run.Flip;
  nlohmann::ordered_json json;
  json["stop_reason"] = ToString(flip.StopReason);
  json["converged"] = flip.Converged();
  json["geometry_used"] = ToString(flip.GeometryUsed);
  json["geometry_reason"] = flip.GeometryReason;
  json["tolerance"] = flip.Tolerance;
  json["backend"] = flip.Backend;
  json["fallback"] = flip.Fallback;
  json["number_of_iterations"] = flip.Iterations.size();
  const auto add = [&](const char* name, NumberKind kind, const auto& number)
  {
    if (kind != NumberKind::Points || run.IsFromPoints)
    {
      json[name] = number;
    }
  };
  ForEachNumber(add, flip);
  if (run.Places >= 0)
  {
    json["places"] = run.Places;
    json["places_outside"] = run.PlacesOutside;
  }
  json["read_seconds"] = run.ReadSeconds;
  json["write_seconds"] = run.WriteSeconds;
  json["warnings"] = run.Warnings;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string MakeCsv(const FlipReport& flip)
{
  std::ostringstream text;
  text << "Iteration,Tested,NonDelaunay,Flipped,Excluded,Blocked,MinimumAngle,Seconds\n"
       << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const IterationRecord& record : flip.Iterations)
  {
    text << record.Iteration << ',' << record.Tested << ',' << record.NonDelaunay << ','
         << record.Flipped << ',' << record.Excluded << ',' << record.Blocked << ','
         << std::abs(record.MinimumAngle) // a NaN may have a sign
         << ',' << record.Seconds << '\n';
  }
  return text.str();
}

std::string MakeSummary(const RunReport& run)
{
  constexpr std::size_t Column = 16;
  std::ostringstream text;
  std::istringstream lines(run.Summary);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t colon = line.find(": ");
    const std::string title = line.substr(0, colon);
    text << std::left << std::setw(Column) << title << line.substr(colon + 2) << '\n';
  }
  const FlipReport& flip = run.Flip;
  text << std::fixed << std::setprecision(3) << "time            read " << run.ReadSeconds
       << " s, edges " << flip.BuildSeconds << " s, flips " << flip.FlipSeconds << " s, write "
       << run.WriteSeconds << " s";
  if (!flip.Backend.empty())
  {
    text << " (" << flip.Backend << ")";
  }
  text << '\n';
  return text.str();
}

}
