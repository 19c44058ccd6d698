// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartReports.h"

#include <algorithm>
#include <limits>

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

constexpr double FlipReport::*Largest[] = { &FlipReport::BuildSeconds, &FlipReport::FlipSeconds };

template <typename Report, typename Visit>
void ForEachMember(Report& report, const Visit& visit)
{
  const auto visitNumber = [&visit](const char*, NumberKind kind, auto& number)
  {
    if (IsSummed(kind) || kind == NumberKind::Seconds)
    {
      visit(number);
    }
  };
  ForEachNumber(visitNumber, report);
  for (const auto text : ReportTexts)
  {
    visit(report.*text);
  }
  visit(report.Iterations);
}

/// The reports of all ranks, as far as they are joined.
std::vector<FlipReport> GatherReports(const FlipReport& own, PieceGroup& group)
{
  Message message;
  ForEachMember(own, [&](const auto& member) { Put(message, member); });
  for (const Defect& defect : own.Defects)
  {
    Put(message, static_cast<std::int64_t>(defect.Kind));
    Put(message, defect.Detail);
    Put(message, defect.Count);
  }
  std::vector<FlipReport> reports;
  for (Message& one : group.Gather(message))
  {
    MessageReader reader(std::move(one));
    FlipReport& report = reports.emplace_back();
    ForEachMember(report, [&](auto& member) { reader.Get(member); });
    while (!reader.IsAtEnd())
    {
      const auto kind = static_cast<DefectKind>(reader.Get<std::int64_t>());
      Defect& defect = report.Defects.emplace_back(kind);
      reader.Get(defect.Detail);
      reader.Get(defect.Count);
    }
  }
  return reports;
}
}

//------------------------------------------------------------------------------
void AddEdges(FlipReport& sum, const FlipReport& part, std::int64_t factor)
{
  AddCounts(sum.Edges, part.Edges, factor);
  for (const auto number : { &FlipReport::NonDelaunayAfter, &FlipReport::BlockedByShape,
         &FlipReport::BlockedByDeviation, &FlipReport::BlockedByEdge })
  {
    sum.*number += factor * part.*number;
  }
}

void CompleteReport(FlipReport& report, std::int64_t usedPoints, bool isCounted)
{
  report.EulerCharacteristic = usedPoints - report.Edges.Edges + report.Triangles;
  for (const Defect& defect : report.Defects)
  {
    if (defect.Kind == DefectKind::RepeatedIds) // triangles without edges
    {
      report.EulerCharacteristic -= defect.Count;
    }
  }
  if (!isCounted)
  {
    report.Edges = EdgeCounts();
    report.EulerCharacteristic = 0;
  }
  if (!report.Iterations.empty())
  {
    report.Iterations.back().MinimumAngle = report.MinimumAngleAfter;
  }
  report.TotalFlips = report.TotalExcluded = report.TotalBlocked = 0;
  for (const IterationRecord& row : report.Iterations)
  {
    report.TotalFlips += row.Flipped;
    report.TotalExcluded += row.Excluded;
    report.TotalBlocked += row.Blocked;
  }
}

FlipReport JoinReports(const std::vector<FlipReport>& reports)
{
  FlipReport sum;
  sum.MinimumAngleBefore = sum.MinimumAngleAfter = NaN;
  for (const FlipReport& report : reports)
  {
    AddTotals(sum, report);
    for (const auto seconds : Largest)
    {
      sum.*seconds = std::max(sum.*seconds, report.*seconds);
    }
    for (const IterationRecord& row : report.Iterations)
    {
      IterationRecord& joined = AddIteration(sum, row);
      joined.MinimumAngle = NaN;
      joined.Seconds = std::max(joined.Seconds, row.Seconds);
    }
  }
  return sum;
}

FlipReport JoinReports(const FlipReport& report, PieceGroup& group)
{
  return JoinReports(GatherReports(report, group));
}

}
