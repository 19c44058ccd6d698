// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Records.h"

#include <cmath>
#include <limits>
#include <string>

namespace delaunayflip
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

// What is joined, and how.
constexpr std::int64_t FlipReport::*Sums[] = { &FlipReport::Points, &FlipReport::Triangles,
  &FlipReport::UnmatchedConstraints, &FlipReport::InsertedConstraints, &FlipReport::ConstraintFlips,
  &FlipReport::EulerCharacteristic, &FlipReport::NonDelaunayBefore, &FlipReport::NonDelaunayAfter,
  &FlipReport::BlockedByShape, &FlipReport::BlockedByDeviation, &FlipReport::BlockedByEdge };
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

/// The reports of all ranks, as far as they are joined.
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
  const RecordLists<IterationRecord> iterations = GatherRecords(group, own.Iterations);
  const std::vector<Message> allTexts = group.Gather(Message(texts.begin(), texts.end()));
  std::vector<FlipReport> reports(allTexts.size());
  for (std::size_t rank = 0; rank < reports.size(); ++rank)
  {
    reports[rank].Iterations = iterations[rank];
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

FlipReport JoinReports(const std::vector<FlipReport>& reports)
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
    for (const IterationRecord& row : report.Iterations)
    {
      const auto number = static_cast<std::size_t>(row.Iteration);
      sum.Iterations.resize(std::max(sum.Iterations.size(), number));
      IterationRecord& joined = sum.Iterations[number - 1];
      joined.Iteration = row.Iteration;
      joined.Tested += row.Tested;
      joined.NonDelaunay += row.NonDelaunay;
      joined.Flipped += row.Flipped;
      joined.Excluded += row.Excluded;
      joined.Blocked += row.Blocked;
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
