// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipReport.h"

#include <cstddef>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace delaunayflip
{

namespace
{
template <typename Kind, std::size_t Size>
const char* GetName(const char* const (&names)[Size], Kind kind)
{
  const auto i = static_cast<std::size_t>(kind);
  return i < Size ? names[i] : "unknown";
}
}

const char* ToString(StopReasonKind reason)
{
  constexpr const char* Names[] = { "not started", "converged", "iteration limit", "aborted",
    "running" };
  return GetName(Names, reason);
}

const char* ToString(GeometryKind geometry)
{
  constexpr const char* Names[] = { "auto", "planar", "planar-xy", "surface" };
  return GetName(Names, geometry);
}

std::string DescribeTolerance(const FlipOptions& options, GeometryKind used)
{
  if (used != GeometryKind::Surface && options.Criterion == CriterionKind::InCircle)
  {
    return "none";
  }
  if (options.Tolerance < 0.0)
  {
    return "automatic";
  }
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::digits10) << options.Tolerance;
  return text.str();
}

namespace
{

/// What a single one is called, as far as its beginning goes.
std::string InSingular(const std::string& what)
{
  static const std::pair<std::string, std::string> beginnings[] = {
    { "triangles that turn ", "triangle that turns " },
    { "triangles that repeat ", "triangle that repeats " },
    { "triangles ", "triangle " },
    { "points ", "point " },
    { "constraint edges that are not edges ", "constraint edge that is not an edge " },
    { "constraint edges that cannot be inserted because they leave ",
      "constraint edge that cannot be inserted because it leaves " },
    { "constraint edges that cannot be inserted because they cross ",
      "constraint edge that cannot be inserted because it crosses " },
    { "constraint edges ", "constraint edge " },
    { "segments that cross an earlier one or end ",
      "segment that crosses an earlier one or ends " },
    { "hole seeds ", "hole seed " },
  };
  for (const auto& [several, one] : beginnings)
  {
    if (what.compare(0, several.size(), several) == 0)
    {
      return one + what.substr(several.size());
    }
  }
  return what;
}

std::string CountDefect(const Defect& defect)
{
  return std::to_string(defect.Count) + " " +
    (defect.Count == 1 ? InSingular(defect.What) : defect.What);
}

}

std::string DescribeDefects(const std::vector<Defect>& defects)
{
  std::string text;
  for (const Defect& defect : defects)
  {
    text += (text.empty() ? "" : "; ") + CountDefect(defect);
    const bool isPaired = defect.Ids == DefectIds::PointPairs;
    for (std::size_t i = 0; i < defect.FirstIds.size(); ++i)
    {
      const char* next = isPaired && i % 2 == 1 ? "-" : ", ";
      text += (i == 0 ? " (first: " : next) + std::to_string(defect.FirstIds[i]);
    }
    text += defect.FirstIds.empty() ? "" : ")";
  }
  return text;
}

}
