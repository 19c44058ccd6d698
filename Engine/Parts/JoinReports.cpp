// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JoinReports.h"

#include "Records.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

// What is joined, and how.
constexpr std::int64_t FlipReport::*Sums[] = { &FlipReport::Points, &FlipReport::Triangles,
  &FlipReport::UnmatchedConstraints, &FlipReport::InsertedConstraints, &FlipReport::ConstraintFlips,
  &FlipReport::EulerCharacteristic, &FlipReport::NonDelaunayBefore, &FlipReport::NonDelaunayAfter,
  &FlipReport::BlockedByShape, &FlipReport::BlockedByEdge };
constexpr double FlipReport::*Smallest[] = { &FlipReport::MinimumAngleBefore,
  &FlipReport::MinimumAngleAfter };
constexpr double FlipReport::*Largest[] = { &FlipReport::BuildSeconds, &FlipReport::FlipSeconds };
constexpr std::string FlipReport::*Texts[] = { &FlipReport::Tolerance, &FlipReport::Backend,
  &FlipReport::Fallback };

constexpr std::int64_t EdgeCounts::*Kinds[] = { &EdgeCounts::Edges, &EdgeCounts::Boundary,
  &EdgeCounts::NonManifold, &EdgeCounts::WronglyWound, &EdgeCounts::Feature,
  &EdgeCounts::Constraint, &EdgeCounts::Region, &EdgeCounts::Fixed };

template <typename Report, typename Visit>
void ForEachNumber(Report& report, const Visit& visit)
{
  std::for_each(std::begin(Sums), std::end(Sums), [&](auto number) { visit(report.*number); });
  std::for_each(std::begin(Kinds), std::end(Kinds), [&](auto kind) { visit(report.Edges.*kind); });
  for (int i = 0; i < 2; ++i)
  {
    visit(report.*Smallest[i]);
    visit(report.*Largest[i]);
  }
}

/// The reports of all ranks, as far as they are joined, but for the iterations.
std::vector<FlipReport> GatherReports(const FlipReport& own, PieceGroup& group)
{
  std::vector<double> numbers; // exact for counts
  std::string texts;
  ForEachNumber(own, [&](auto number) { numbers.push_back(static_cast<double>(number)); });
  for (const auto text : Texts)
  {
    texts += own.*text + '\0';
  }
  for (const Defect& defect : own.Defects)
  {
    numbers.push_back(static_cast<double>(defect.Count));
    texts += defect.What + '\0';
  }
  const RecordLists<double> allNumbers = GatherRecords(group, numbers);
  const std::vector<Message> allTexts = group.Gather(Message(texts.begin(), texts.end()));
  std::vector<FlipReport> reports(allTexts.size());
  for (std::size_t rank = 0; rank < reports.size(); ++rank)
  {
    auto number = allNumbers[rank].begin();
    ForEachNumber(
      reports[rank], [&](auto& to) { to = static_cast<std::decay_t<decltype(to)>>(*number++); });
    const char* next = allTexts[rank].data();
    const auto takeText = [&next]()
    {
      std::string text = next;
      next += text.size() + 1;
      return text;
    };
    for (const auto text : Texts)
    {
      reports[rank].*text = takeText();
    }
    for (; number != allNumbers[rank].end(); ++number)
    {
      reports[rank].Defects.push_back({ takeText(), static_cast<std::int64_t>(*number), {} });
    }
  }
  return reports;
}

/// Joins all but the iterations.
FlipReport SumReports(const std::vector<FlipReport>& reports)
{
  FlipReport sum;
  sum.MinimumAngleBefore = sum.MinimumAngleAfter = NaN;
  for (const FlipReport& report : reports)
  {
    for (const auto number : Sums)
    {
      sum.*number += report.*number;
    }
    AddCounts(sum.Edges, report.Edges, 1);
    for (int i = 0; i < 2; ++i)
    {
      sum.*Smallest[i] = std::fmin(sum.*Smallest[i], report.*Smallest[i]);
      sum.*Largest[i] = std::max(sum.*Largest[i], report.*Largest[i]);
    }
    for (const auto text : Texts)
    {
      const std::string listed = ", " + sum.*text + ", ";
      if (!(report.*text).empty() && listed.find(", " + report.*text + ", ") == std::string::npos)
      {
        sum.*text += ((sum.*text).empty() ? "" : ", ") + report.*text;
      }
    }
    for (const Defect& defect : report.Defects)
    {
      AddDefect({ defect.What, defect.Count, {} }, sum.Defects);
    }
  }
  return sum;
}

/// An iteration of all ranks that make one.
struct JoinedRow
{
  IterationRecord Sum;
  std::vector<std::pair<std::size_t, double>> Angles; ///< The smallest of those ranks.
};

/// The smallest angle after an iteration is that of all ranks; a rank that has made no further
/// iteration still has its last one.
std::vector<IterationRecord> JoinRows(const RecordLists<RoundRow>& lists)
{
  std::map<std::pair<std::int64_t, std::int64_t>, JoinedRow> rows; // by round and place
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const RoundRow& row : lists[rank])
    {
      JoinedRow& joined = rows[{ row.Round, row.Place }];
      joined.Sum.Tested += row.Record.Tested;
      joined.Sum.NonDelaunay += row.Record.NonDelaunay;
      joined.Sum.Flipped += row.Record.Flipped;
      joined.Sum.Excluded += row.Record.Excluded;
      joined.Sum.Blocked += row.Record.Blocked;
      joined.Sum.Seconds = std::max(joined.Sum.Seconds, row.Record.Seconds);
      joined.Angles.emplace_back(rank, row.Record.MinimumAngle);
    }
  }
  std::vector<double> angles(lists.size(), NaN);
  std::vector<IterationRecord> joined;
  for (const auto& [place, row] : rows)
  {
    for (const auto& [rank, angle] : row.Angles)
    {
      angles[rank] = angle;
    }
    if (place.second >= 0)
    {
      joined.push_back(row.Sum);
      joined.back().Iteration = static_cast<std::int64_t>(joined.size());
      joined.back().MinimumAngle = std::accumulate(
        angles.begin(), angles.end(), NaN, [](double a, double b) { return std::fmin(a, b); });
    }
  }
  return joined;
}
}

void AddCounts(EdgeCounts& sum, const EdgeCounts& part, std::int64_t factor)
{
  for (const auto kind : Kinds)
  {
    sum.*kind += factor * part.*kind;
  }
}

void AddDefect(const Defect& defect, std::vector<Defect>& defects)
{
  const auto known = std::find_if(
    defects.begin(), defects.end(), [&](const Defect& other) { return other.What == defect.What; });
  if (known != defects.end())
  {
    known->Count += defect.Count;
  }
  else if (defect.Count > 0)
  {
    defects.push_back(defect);
  }
}

void CountIterations(FlipReport& report)
{
  report.TotalFlips = report.TotalExcluded = report.TotalBlocked = 0;
  for (const IterationRecord& row : report.Iterations)
  {
    report.TotalFlips += row.Flipped;
    report.TotalExcluded += row.Excluded;
    report.TotalBlocked += row.Blocked;
  }
}

FlipReport JoinReports(
  const FlipReport& report, const std::vector<RoundRow>& rows, PieceGroup& group)
{
  FlipReport joined = SumReports(GatherReports(report, group));
  joined.Iterations = JoinRows(GatherRecords(group, rows));
  CountIterations(joined);
  return joined;
}

FlipReport JoinReports(const std::vector<FlipReport>& reports)
{
  RecordLists<RoundRow> rows(reports.size());
  for (std::size_t i = 0; i < reports.size(); ++i)
  {
    IterationRecord before;
    before.MinimumAngle = reports[i].MinimumAngleBefore;
    rows[i].push_back({ 1, -1, before });
    for (const IterationRecord& row : reports[i].Iterations)
    {
      rows[i].push_back({ 1, row.Iteration, row });
    }
  }
  FlipReport joined = SumReports(reports);
  joined.Iterations = JoinRows(rows);
  return joined;
}

}
