// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipReport.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iterator>
#include <locale>
#include <sstream>
#include <type_traits>
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

/// Adds an item to a list in words.
void Append(std::string& list, const std::string& item, const char* separator)
{
  if (!list.empty())
  {
    list += separator;
  }
  list += item;
}
}

std::string FormatNumber(double value, int digits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(digits) << value;
  return text.str();
}

const char* ToString(StopReasonKind reason)
{
  constexpr const char* Names[] = { "not started", "converged", "iteration limit", "aborted",
    "running" };
  return GetName(Names, reason);
}

const char* ToString(GeometryKind geometry)
{
  constexpr const char* Names[] = { "auto", "planar", "planar-xy", "surface", "sphere", "mixed" };
  return GetName(Names, geometry);
}

std::string ToCamelCase(const std::string& name)
{
  std::string text;
  std::istringstream words(name);
  for (std::string word; std::getline(words, word, '_');)
  {
    word[0] = static_cast<char>(std::toupper(word[0]));
    text += word;
  }
  return text;
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
  return FormatNumber(options.Tolerance, std::numeric_limits<double>::digits10);
}

//------------------------------------------------------------------------------
void AddDefect(const Defect& defect, std::vector<Defect>& defects)
{
  const auto known = std::find_if(
    defects.begin(), defects.end(), [&](const Defect& other) { return other.IsLike(defect); });
  if (known != defects.end())
  {
    known->Count += defect.Count;
  }
  else if (defect.Count > 0)
  {
    defects.push_back(defect);
  }
}

void AddCounts(EdgeCounts& sum, const EdgeCounts& part, std::int64_t factor)
{
  for (const auto kind : EdgeKinds)
  {
    sum.*kind += factor * part.*kind;
  }
}

void AddTotals(FlipReport& sum, const FlipReport& part)
{
  const auto add = [](const char*, NumberKind kind, auto& total, const auto& more)
  {
    if (IsSummed(kind) && std::is_integral<std::decay_t<decltype(more)>>::value)
    {
      total += more;
    }
  };
  ForEachNumber(add, sum, part);
  if (part.Triangles > 0)
  {
    sum.MinimumAngleBefore = std::fmin(sum.MinimumAngleBefore, part.MinimumAngleBefore);
    sum.MinimumAngleAfter = std::fmin(sum.MinimumAngleAfter, part.MinimumAngleAfter);
  }
  for (const auto text : ReportTexts)
  {
    const std::string listed = ", " + sum.*text + ", ";
    if (!(part.*text).empty() && listed.find(", " + part.*text + ", ") == std::string::npos)
    {
      Append(sum.*text, part.*text, ", ");
    }
  }
  for (const Defect& defect : part.Defects)
  {
    Defect counted(defect.Kind, defect.Count);
    counted.Detail = defect.Detail;
    AddDefect(counted, sum.Defects);
  }
}

namespace
{

/// Whether a mesh has a smallest angle: some triangle has no coordinate that is NaN.
bool HasAngles(const FlipReport& report)
{
  return report.Triangles > 0 && !std::isnan(report.MinimumAngleAfter);
}

void AddIterations(FlipReport& sum, const FlipReport& other)
{
  const std::size_t made = sum.Iterations.size();
  for (const IterationRecord& row : other.Iterations)
  {
    AddIteration(sum, row).Seconds += row.Seconds;
  }
  for (std::size_t i = 0; i < sum.Iterations.size(); ++i)
  {
    // A mesh that made fewer iterations keeps its last angle. NaN stands for unknown.
    const auto getAngle = [i](const FlipReport& report, std::size_t iterations)
    {
      if (!HasAngles(report))
      {
        return std::numeric_limits<double>::infinity();
      }
      if (i < iterations)
      {
        return report.Iterations[i].MinimumAngle;
      }
      return report.MinimumAngleAfter;
    };
    const double a = getAngle(sum, made), b = getAngle(other, other.Iterations.size());
    const bool isKnown = !std::isnan(a + b) && (HasAngles(sum) || HasAngles(other));
    sum.Iterations[i].MinimumAngle =
      isKnown ? std::min(a, b) : std::numeric_limits<double>::quiet_NaN();
  }
}

void DropIds(std::vector<Defect>& defects)
{
  for (Defect& defect : defects)
  {
    defect.FirstIds.clear();
    defect.Crossed.clear();
  }
}

}

IterationRecord& AddIteration(FlipReport& sum, const IterationRecord& row)
{
  const auto number = static_cast<std::size_t>(row.Iteration);
  sum.Iterations.resize(std::max(sum.Iterations.size(), number));
  IterationRecord& joined = sum.Iterations[number - 1];
  joined.Iteration = row.Iteration;
  for (const auto count : IterationTotals)
  {
    joined.*count += row.*count;
  }
  return joined;
}

void AddReport(FlipReport& sum, const FlipReport& other)
{
  AddIterations(sum, other);
  if (sum.Triangles == 0)
  {
    sum.MinimumAngleBefore = sum.MinimumAngleAfter = std::numeric_limits<double>::quiet_NaN();
  }
  const bool isFirst = sum.Points == 0 && sum.Defects.empty();
  AddTotals(sum, other);
  if (isFirst)
  {
    sum.Defects = other.Defects;
  }
  else
  {
    DropIds(sum.Defects);
  }
  const double largestShift = std::max(sum.FromPoints.LargestShift, other.FromPoints.LargestShift);
  const auto add = [](const char*, NumberKind kind, auto& total, const auto& more)
  {
    if (!IsSummed(kind))
    {
      total += more;
    }
  };
  ForEachNumber(add, sum, other);
  sum.FromPoints.LargestShift = largestShift;
  if (sum.GeometryUsed == GeometryKind::Auto)
  {
    sum.GeometryUsed = other.GeometryUsed;
  }
  else if (other.GeometryUsed != GeometryKind::Auto && other.GeometryUsed != sum.GeometryUsed)
  {
    sum.GeometryUsed = GeometryKind::Mixed;
  }
  using Reason = StopReasonKind;
  for (const Reason worse :
    { Reason::Aborted, Reason::IterationLimit, Reason::Running, Reason::Converged })
  {
    if (sum.StopReason == worse || other.StopReason == worse)
    {
      sum.StopReason = worse;
      break;
    }
  }
}

//------------------------------------------------------------------------------
std::string Count(std::int64_t number, const std::string& singular)
{
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3)
  {
    text.insert(end - 3, ",");
  }
  if (singular.empty())
  {
    return text;
  }
  text += " " + singular;
  if (number != 1)
  {
    text += "s";
  }
  return text;
}

namespace
{

std::string Degrees(double angle) { return angle == angle ? FormatNumber(angle, 4) : "none"; }

/// " (1,000 boundary, 6 constraints)"; kinds of which there are none are left out.
std::string List(std::initializer_list<std::pair<const char*, std::int64_t>> kinds)
{
  std::string list;
  for (const auto& [kind, count] : kinds)
  {
    if (count > 0)
    {
      Append(list, Count(count, "") + " " + kind, ", ");
    }
  }
  if (list.empty())
  {
    return list;
  }
  return " (" + list + ")";
}

bool IsFromPoints(const FlipReport& report)
{
  return report.GeometryReason.rfind("points are triangulated", 0) == 0;
}

/// What to change if more than a tenth of the inner edges, or one of the worst slivers, stay
/// because the user wants it so.
std::string Advise(const FlipReport& report)
{
  const EdgeCounts& edges = report.Edges;
  const std::int64_t inner = edges.Edges - edges.Boundary;
  const std::int64_t kept = // an edge may be kept for several reasons
    std::min(edges.Fixed - edges.Boundary - edges.NonManifold - edges.WronglyWound,
      edges.Feature + edges.Constraint + edges.Region);
  if (kept <= 0 || (10 * kept <= inner && !report.KeepsSliver) || IsFromPoints(report))
  {
    return "";
  }
  struct Keeper
  {
    std::int64_t Count;
    const char* Keeps;
    const char* Remedy;
  };
  const Keeper keepers[] = { { edges.Region, "regions keep", "fewer regions" },
    { edges.Feature, "the feature angle keeps", "a larger feature angle" },
    { edges.Constraint, "constraints keep", "fewer constraints" } };
  const Keeper& most = *std::max_element(std::begin(keepers), std::end(keepers),
    [](const Keeper& one, const Keeper& other) { return one.Count < other.Count; });
  const std::string share = std::to_string(100 * kept / inner);
  const std::string what = 10 * kept > inner
    ? share + " % of the inner edges are kept"
    : std::string(most.Keeps) + " an edge of one of the ten triangles with the smallest angles";
  return "hint: " + what + "; with " + most.Remedy + " more can flip\n";
}

/// What to repair if bad edges stay because of defects of the mesh.
std::string AdviseRepair(const FlipReport& report)
{
  const EdgeCounts& edges = report.Edges;
  const std::int64_t inner = edges.Edges - edges.Boundary;
  std::string text;
  if (report.HiddenByWinding > 0)
  {
    text += "hint: " + Count(report.HiddenByWinding, "bad edge") +
      " kept between triangles that are wound differently; wind all the same way "
      "(vtkPolyDataNormals with ConsistencyOn), and more can flip\n";
  }
  if (report.DuplicateTriangles > 0 && report.ObtuseAtNonManifold > 0)
  {
    text += "hint: " + Count(report.DuplicateTriangles, "triangle") +
      " with the corners of another one: their edges are kept; leave out such duplicates, and more "
      "can flip\n";
  }
  else if (report.ObtuseAtNonManifold > 0 && 10 * edges.NonManifold > inner)
  {
    text += "hint: " + std::to_string(100 * edges.NonManifold / inner) +
      " % of the inner edges have more than two triangles and are kept; flip the parts that meet "
      "there one by one, and more can flip\n";
  }
  return text;
}

/// A line, or nothing if there are no constraints.
std::string DescribeConstraints(const FlipReport& flip)
{
  if (flip.Edges.Constraint + flip.UnmatchedConstraints == 0)
  {
    return {};
  }
  std::string text = "constraints: " + Count(flip.Edges.Constraint, "edge") + " kept";
  if (flip.InsertedConstraints > 0)
  {
    text += ", " + Count(flip.InsertedConstraints, "") + " inserted by " +
      Count(flip.ConstraintFlips, "flip");
  }
  return text + ", " + Count(flip.UnmatchedConstraints, "") + " not in the mesh\n";
}

/// Appends a count, unless it is 0.
void AddCount(std::string& text, std::int64_t count, const char* what)
{
  if (count > 0)
  {
    text += ", " + Count(count) + " " + what;
  }
}

/// One line, or nothing if there was no refinement.
std::string DescribeRefinement(const PointCounts& counts)
{
  if (counts.RefinementPoints + counts.UnrefinedTriangles == 0)
  {
    return {};
  }
  std::string refinement = Count(counts.RefinementPoints, "point") + " added in " +
    Count(counts.RefinementRounds, "round");
  AddCount(refinement, counts.UnrefinedTriangles, "triangles left that do not reach the goals");
  if (counts.ReachedPointLimit > 0)
  {
    refinement += ", ended by the point limit";
  }
  return "refinement: " + refinement + '\n';
}

/// A line, or nothing: what the reason for the geometry says beside that there are points.
std::string AdviseGeometry(const FlipReport& flip)
{
  const std::size_t end = flip.GeometryReason.find("; ");
  return end == std::string::npos ? "" : "hint: " + flip.GeometryReason.substr(end + 2) + '\n';
}

/// The lines that only a mesh from points has.
std::string DescribePoints(const FlipReport& flip)
{
  const PointCounts& counts = flip.FromPoints;
  const std::int64_t unused = counts.NotFinite + counts.Repeated + counts.TooNear + counts.Inside;
  std::string points = Count(counts.Used) + " used";
  AddCount(points, counts.Repeated, "repeated");
  AddCount(points, counts.TooNear, "too near to another");
  AddCount(points, counts.NotFinite, "not finite");
  AddCount(points, counts.Inside, "inside of the hull");
  AddCount(points, flip.Points - unused - counts.Used, "without a triangle");
  std::string text = "points: " + points + '\n';
  if (counts.SegmentEdges + counts.RefusedSegments > 0)
  {
    std::string segments = Count(counts.SegmentEdges, "edge");
    AddCount(segments, counts.RefusedSegments, "refused");
    if (counts.Crossings > 0)
    {
      segments += ", " + Count(counts.Crossings, "crossing") + " added";
    }
    text += "segments: " + segments + '\n';
  }
  text += DescribeRefinement(counts);
  if (counts.OutsideTriangles + counts.LargeTriangles > 0)
  {
    std::string large = "too large";
    if (flip.GeometryUsed == GeometryKind::Sphere)
    {
      large = "with a circumcircle that encloses half of the sphere or more";
    }
    text += "removed: " + Count(counts.OutsideTriangles, "triangle") + " outside, " +
      Count(counts.LargeTriangles) + " " + large + "\n";
  }
  return text;
}

/// What the mesh is, and which edges stay.
std::string DescribeMesh(const FlipReport& report, const std::string& hint)
{
  const EdgeCounts& edges = report.Edges;
  const std::string& reason = report.GeometryReason;
  const std::string mesh = "mesh: " + Count(report.Points, "point") + ", " +
    Count(report.Triangles, "triangle") + ", " + Count(edges.Edges, "edge") + "\n";
  const std::string kept = "kept edges: " + Count(edges.Fixed, "") +
    List({ { "boundary", edges.Boundary }, { "non-manifold", edges.NonManifold },
      { "wrongly wound", edges.WronglyWound }, { "feature angle", edges.Feature },
      { "constraints", edges.Constraint }, { "regions", edges.Region } }) +
    "\n";
  if (IsFromPoints(report))
  {
    return mesh + DescribePoints(report) + kept + AdviseGeometry(report);
  }
  return mesh + DescribeRefinement(report.FromPoints) + kept + Advise(report) +
    AdviseRepair(report) + hint + "geometry: " + ToString(report.GeometryUsed) +
    (reason.empty() ? "" : ": ") + reason + "\n" + DescribeConstraints(report);
}

/// What has become of it. Nobody has seen the triangles that a run from points begins with, so
/// their numbers are left out.
std::string DescribeResult(const FlipReport& report, const SummaryNotes& notes)
{
  const bool hasBefore = !IsFromPoints(report);
  const auto compare = [hasBefore](const std::string& before, const std::string& after)
  { return hasBefore ? before + " -> " + after : after; };
  const auto countBelow = [&](std::int64_t before, std::int64_t after, const char* below)
  { return compare(Count(before), Count(after)) + below; };
  std::string text;
  if (hasBefore || report.NonDelaunayAfter > 0)
  {
    text = countBelow(report.NonDelaunayBefore, report.NonDelaunayAfter, "") +
      List({ { "blocked: would duplicate an edge", report.BlockedByEdge },
        { "blocked: would fold", report.BlockedByShape },
        { "blocked: would deviate", report.BlockedByDeviation } });
    text = "bad edges: " + text + "\n";
  }
  constexpr int Digits = 6;
  std::string wanted;
  if (notes.WantedAngle > 0.0)
  {
    wanted = " (asked for: " + FormatNumber(notes.WantedAngle, Digits) + ")";
  }
  const auto records = static_cast<std::int64_t>(report.Iterations.size());
  const std::int64_t iterations = notes.Iterations >= 0 ? notes.Iterations : records;
  return text + "smallest angle: " +
    compare(Degrees(report.MinimumAngleBefore), Degrees(report.MinimumAngleAfter)) + " degrees" +
    wanted + "\nsmall angles: " +
    countBelow(report.TrianglesBelow10Before, report.TrianglesBelow10After,
      " triangles below 10 degrees, ") +
    countBelow(report.TrianglesBelow20Before, report.TrianglesBelow20After, " below 20, ") +
    countBelow(report.TrianglesBelow30Before, report.TrianglesBelow30After, " below 30") +
    "\nflips: " + Count(report.TotalFlips, "") + " in " + Count(iterations, "iteration") + ", " +
    ToString(report.StopReason) + "\n";
}

}

std::string Summarize(const FlipReport& report, const SummaryNotes& notes)
{
  if (report.Triangles == 0)
  {
    return "";
  }
  // What has become better comes first. From points nothing has.
  if (IsFromPoints(report))
  {
    return DescribeMesh(report, notes.Hint) + DescribeResult(report, notes);
  }
  return DescribeResult(report, notes) + DescribeMesh(report, notes.Hint);
}

}
