// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdateReport.h"

#include "FlipError.h"

#include "vtkDelaunayFlip.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iomanip>
#include <iterator>
#include <limits>
#include <new>
#include <sstream>
#include <utility>

namespace delaunayflip
{
namespace
{

template <typename Record, typename Value>
void AddMembers(Record& sum, const Record& more, std::initializer_list<Value Record::*> members)
{
  for (const auto member : members)
  {
    sum.*member += more.*member;
  }
}

/// Whether a mesh has a smallest angle: some triangle has no coordinate that is NaN.
bool HasAngles(const FlipReport& report)
{
  return report.Triangles > 0 && !std::isnan(report.MinimumAngleBefore);
}

std::vector<IterationRecord> JoinIterations(const FlipReport& a, const FlipReport& b)
{
  using Row = IterationRecord;
  std::vector<Row> rows(std::max(a.Iterations.size(), b.Iterations.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    rows[i].Iteration = static_cast<std::int64_t>(i) + 1;
    rows[i].MinimumAngle = std::numeric_limits<double>::infinity();
    for (const FlipReport* report : { &a, &b })
    {
      const bool isMade = i < report->Iterations.size();
      if (isMade)
      {
        AddMembers(rows[i], report->Iterations[i],
          { &Row::Tested, &Row::NonDelaunay, &Row::Flipped, &Row::Excluded, &Row::Blocked });
        rows[i].Seconds += report->Iterations[i].Seconds;
      }
      if (HasAngles(*report))
      {
        // A mesh that made fewer iterations keeps its last angle. NaN stands for unknown.
        const double angle =
          isMade ? report->Iterations[i].MinimumAngle : report->MinimumAngleAfter;
        const double least = rows[i].MinimumAngle;
        rows[i].MinimumAngle =
          std::isnan(angle) || std::isnan(least) ? angle + least : std::min(angle, least);
      }
    }
  }
  return rows;
}

/// Appends a text to a comma-separated list, unless the list contains it already.
void AddText(std::string& list, const std::string& text)
{
  if (list.find(text) == std::string::npos)
  {
    list += (list.empty() ? "" : ", ") + text;
  }
}

}

void UpdateReport::Add(const UpdateReport& other)
{
  this->Iterations = JoinIterations(*this, other);
  if (!HasAngles(*this) && other.Triangles > 0)
  {
    this->MinimumAngleBefore = other.MinimumAngleBefore;
    this->MinimumAngleAfter = other.MinimumAngleAfter;
  }
  else if (HasAngles(other))
  {
    this->MinimumAngleBefore = std::min(this->MinimumAngleBefore, other.MinimumAngleBefore);
    this->MinimumAngleAfter = std::min(this->MinimumAngleAfter, other.MinimumAngleAfter);
  }
  if (this->GeometryUsed == GeometryKind::Auto)
  {
    this->GeometryUsed = other.GeometryUsed;
  }
  this->HasMixedGeometry = this->HasMixedGeometry || other.HasMixedGeometry ||
    (other.GeometryUsed != GeometryKind::Auto && other.GeometryUsed != this->GeometryUsed);
  this->KeepsSliver = this->KeepsSliver || other.KeepsSliver;
  AddText(this->GeometryReason, other.GeometryReason);
  AddText(this->Tolerance, other.Tolerance);
  AddText(this->Backend, other.Backend);
  AddText(this->Fallback, other.Fallback);
  for (const Defect& defect : other.Defects)
  {
    const auto same = std::find_if(this->Defects.begin(), this->Defects.end(),
      [&defect](const Defect& one) { return one.What == defect.What; });
    (same != this->Defects.end() ? *same : this->Defects.emplace_back(Defect{ defect.What, 0, {} }))
      .Count += defect.Count;
  }
  using Kind = EdgeCounts;
  AddMembers(this->Edges, other.Edges,
    { &Kind::Edges, &Kind::Boundary, &Kind::NonManifold, &Kind::WronglyWound, &Kind::Feature,
      &Kind::Constraint, &Kind::Region, &Kind::Fixed });
  using Sum = FlipReport;
  AddMembers<Sum, std::int64_t>(*this, other,
    { &Sum::Points, &Sum::Triangles, &Sum::UnmatchedConstraints, &Sum::InsertedConstraints,
      &Sum::ConstraintFlips, &Sum::EulerCharacteristic, &Sum::TotalFlips, &Sum::TotalExcluded,
      &Sum::TotalBlocked, &Sum::NonDelaunayBefore, &Sum::NonDelaunayAfter, &Sum::BlockedByShape,
      &Sum::BlockedByDeviation, &Sum::BlockedByEdge });
  AddMembers<Sum, double>(*this, other, { &Sum::BuildSeconds, &Sum::FlipSeconds });
  using Found = PointCounts;
  AddMembers(this->FromPoints, other.FromPoints,
    { &Found::NotFinite, &Found::Repeated, &Found::TooNear, &Found::SegmentEdges,
      &Found::RefusedSegments, &Found::Crossings, &Found::OutsideTriangles,
      &Found::LargeTriangles });
  this->FromPoints.LargestShift =
    std::max(this->FromPoints.LargestShift, other.FromPoints.LargestShift);
  using Reason = StopReasonKind;
  for (const Reason worse :
    { Reason::Aborted, Reason::IterationLimit, Reason::Running, Reason::Converged })
  {
    if (this->StopReason == worse || other.StopReason == worse)
    {
      this->StopReason = worse;
      break;
    }
  }
}

const char* UpdateReport::GetGeometryName() const
{
  return this->HasMixedGeometry ? "mixed" : ToString(this->GeometryUsed);
}

//------------------------------------------------------------------------------
namespace
{

std::string Join(const std::vector<std::string>& items, const char* separator)
{
  constexpr std::size_t Most = 3; // places named per text, and texts
  std::string text;
  for (std::size_t i = 0; i < std::min(items.size(), Most); ++i)
  {
    text += (i == 0 ? "" : separator) + items[i];
  }
  return items.size() > Most
    ? text + separator + "and " + std::to_string(items.size() - Most) + " more"
    : text;
}

}

std::string Describe(const std::vector<Note>& notes)
{
  std::vector<std::string> texts;
  std::vector<std::vector<std::string>> places;
  for (const Note& note : notes)
  {
    const std::size_t known = std::find(texts.begin(), texts.end(), note.Text) - texts.begin();
    if (known == texts.size())
    {
      texts.push_back(note.Text);
      places.emplace_back();
    }
    places[known].push_back(note.Where);
  }
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    const std::string where = Join(places[i], ", ");
    texts[i] = where.empty() ? texts[i] : where + ": " + texts[i];
  }
  return Join(texts, "; ");
}

void UpdateSummary::AddFailure(const std::string& where)
{
  int kind = vtkDelaunayFlip::FAILURE_OTHER;
  std::string text = "an exception of unknown type";
  try
  {
    throw;
  }
  catch (const std::exception& error)
  {
    kind = dynamic_cast<const InvalidOptions*>(&error)  ? vtkDelaunayFlip::FAILURE_OPTIONS
      : dynamic_cast<const BackendUnavailable*>(&error) ? vtkDelaunayFlip::FAILURE_BACKEND
      : dynamic_cast<const FlipError*>(&error)          ? vtkDelaunayFlip::FAILURE_MESH
                                                        : kind;
    text = dynamic_cast<const std::bad_alloc*>(&error) ? "not enough memory" : error.what();
  }
  catch (...)
  {
  }
  this->Failure = this->Failure == 0 ? kind : this->Failure;
  this->Errors.push_back({ where, text });
}

std::string DescribeTrouble(const FlipReport& report, bool hasAskedForLimit, bool hasTolerance)
{
  std::string text = DescribeDefects(report.Defects);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (report.StopReason == StopReasonKind::IterationLimit && !hasAskedForLimit)
  {
    add("stopped by the safety limit of " + std::to_string(report.Iterations.size()) +
      " iterations with " + std::to_string(report.NonDelaunayAfter) +
      " edges left that are not Delaunay");
  }
  if (hasTolerance && report.Tolerance == "none")
  {
    add("Tolerance has no effect on the in-circle criterion, which is exact; it is for opposite "
        "angles");
  }
  if (!report.Fallback.empty())
  {
    add("the GPU could not be used, the CPU did the work: " + report.Fallback);
  }
  return text;
}

//------------------------------------------------------------------------------
std::string Count(std::int64_t number, const std::string& singular)
{
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3)
  {
    text.insert(end - 3, ",");
  }
  return text + (singular.empty() ? "" : " ") + singular +
    (number == 1 || singular.empty() ? "" : "s");
}

namespace
{

std::string Degrees(double angle)
{
  std::ostringstream text;
  text << std::setprecision(4) << angle;
  return angle == angle ? text.str() : "none";
}

/// " (1,000 boundary, 6 constraints)"; kinds of which there are none are left out.
std::string List(std::initializer_list<std::pair<const char*, std::int64_t>> kinds)
{
  std::string text;
  for (const auto& [kind, count] : kinds)
  {
    text += count > 0 ? (text.empty() ? " (" : ", ") + Count(count, "") + " " + kind : "";
  }
  return text + (text.empty() ? "" : ")");
}

/// What to change if more than a tenth of the inner edges, or one of the worst slivers, stay
/// because the user wants it so.
std::string Advise(const FlipReport& report)
{
  const EdgeCounts& edges = report.Edges;
  const std::int64_t inner = edges.Edges - edges.Boundary;
  const std::int64_t kept = edges.Fixed - edges.Boundary - edges.NonManifold - edges.WronglyWound;
  const bool isFromPoints = report.GeometryReason.rfind("points are triangulated", 0) == 0;
  if ((10 * kept <= inner && !report.KeepsSliver) || isFromPoints)
  {
    return "";
  }
  const std::pair<std::int64_t, const char*> remedies[] = { { edges.Region, "fewer regions" },
    { edges.Feature, "a larger feature angle" }, { edges.Constraint, "fewer constraints" } };
  const auto most = std::max_element(std::begin(remedies), std::end(remedies),
    [](const auto& one, const auto& other) { return one.first < other.first; });
  const std::string what = 10 * kept > inner
    ? std::to_string(100 * kept / inner) + " % of the inner edges are kept; with "
    : "an edge is kept at one of the ten triangles with the smallest angles; with ";
  return "hint: " + what + most->second + " more can flip\n";
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

}

std::string Summarize(const UpdateReport& report)
{
  if (report.Triangles == 0)
  {
    return "";
  }
  const EdgeCounts& edges = report.Edges;
  const std::string& reason = report.GeometryReason;
  return "mesh: " + Count(report.Points, "point") + ", " + Count(report.Triangles, "triangle") +
    ", " + Count(edges.Edges, "edge") + "\nkept edges: " + Count(edges.Fixed, "") +
    List({ { "boundary", edges.Boundary }, { "non-manifold", edges.NonManifold },
      { "wrongly wound", edges.WronglyWound }, { "feature angle", edges.Feature },
      { "constraints", edges.Constraint }, { "regions", edges.Region } }) +
    "\n" + Advise(report) + "geometry: " + report.GetGeometryName() + (reason.empty() ? "" : ": ") +
    reason + "\n" + DescribeConstraints(report) +
    "bad edges: " + Count(report.NonDelaunayBefore, "") + " -> " +
    Count(report.NonDelaunayAfter, "") +
    List({ { "blocked: would duplicate an edge", report.BlockedByEdge },
      { "blocked: would fold", report.BlockedByShape },
      { "blocked: would deviate", report.BlockedByDeviation } }) +
    "\nsmallest angle: " + Degrees(report.MinimumAngleBefore) + " -> " +
    Degrees(report.MinimumAngleAfter) + " degrees\nflips: " + Count(report.TotalFlips, "") +
    " in " + Count(static_cast<std::int64_t>(report.Iterations.size()), "iteration") + ", " +
    ToString(report.StopReason) + "\n";
}

//------------------------------------------------------------------------------
void AddIterationColumns(const FlipReport& report, const std::string& prefix, vtkFieldData* data)
{
  const auto add = [&](auto* array, const char* name, auto member)
  {
    array->SetName((prefix + name).c_str());
    for (const IterationRecord& record : report.Iterations)
    {
      array->InsertNextValue(record.*member);
    }
    data->AddArray(array);
  };
  const auto addCount = [&](const char* name, std::int64_t IterationRecord::*member)
  { add(vtkNew<vtkIdTypeArray>().Get(), name, member); };
  addCount("Iteration", &IterationRecord::Iteration);
  addCount("Tested", &IterationRecord::Tested);
  addCount("NonDelaunay", &IterationRecord::NonDelaunay);
  addCount("Flipped", &IterationRecord::Flipped);
  addCount("Excluded", &IterationRecord::Excluded);
  addCount("Blocked", &IterationRecord::Blocked);
  add(vtkNew<vtkDoubleArray>().Get(), "MinimumAngle", &IterationRecord::MinimumAngle);
  add(vtkNew<vtkDoubleArray>().Get(), "Seconds", &IterationRecord::Seconds);
}

namespace
{

const std::string Prefix = "DelaunayFlip:";

template <typename ArrayT, typename Value>
void AddValue(const char* name, const Value& value, vtkFieldData* data)
{
  vtkNew<ArrayT> array;
  array->SetName((Prefix + name).c_str());
  array->InsertNextValue(value);
  data->AddArray(array);
}

}

void AddFieldData(const UpdateReport& report, vtkFieldData* data)
{
  const auto addText = [&](const char* name, const std::string& text)
  { AddValue<vtkStringArray>(name, text, data); };
  const auto addCount = [&](const char* name, std::int64_t count)
  { AddValue<vtkIdTypeArray>(name, count, data); };
  // The totals first: ParaView lists no field data when the first array is empty.
  AddValue<vtkIntArray>("Converged", report.Converged() ? 1 : 0, data);
  addText("StopReason", ToString(report.StopReason));
  addText("Summary", Summarize(report));
  addCount("TotalFlips", report.TotalFlips);
  addCount("NonDelaunayEdges", report.NonDelaunayAfter);
  addCount("BlockedByShape", report.BlockedByShape);
  addCount("BlockedByDeviation", report.BlockedByDeviation);
  addCount("BlockedByEdge", report.BlockedByEdge);
  addCount("FixedEdges", report.Edges.Fixed);
  addCount("NonManifoldEdges", report.Edges.NonManifold);
  addCount("ConstraintEdges", report.Edges.Constraint);
  addCount("UnmatchedConstraintEdges", report.UnmatchedConstraints);
  addCount("InsertedConstraintEdges", report.InsertedConstraints);
  addCount("ConstraintFlips", report.ConstraintFlips);
  addText("GeometryUsed", report.GetGeometryName());
  addText("GeometryReason", report.GeometryReason);
  addText("Tolerance", report.Tolerance);
  addText("Backend", report.Backend);
  AddIterationColumns(report, Prefix, data);
#if defined(DELAUNAYFLIP_PARAVIEW)
  // Its lists of arrays, such as Color By, leave out what has this key.
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetName() && std::string(array->GetName()).rfind(Prefix, 0) == 0)
    {
      array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
    }
  }
#endif
}

void AddPointFieldData(const PointCounts& counts, vtkFieldData* data)
{
  const auto add = [&](const char* name, std::int64_t count)
  { AddValue<vtkIdTypeArray>(name, count, data); };
  add("PointsNotFinite", counts.NotFinite);
  add("RepeatedPoints", counts.Repeated);
  add("PointsTooNear", counts.TooNear);
  add("SegmentEdges", counts.SegmentEdges);
  add("RefusedSegments", counts.RefusedSegments);
  add("CrossingPoints", counts.Crossings);
  add("OutsideTriangles", counts.OutsideTriangles);
  add("LargeTriangles", counts.LargeTriangles);
  AddValue<vtkDoubleArray>("LargestShift", counts.LargestShift, data);
}

}
