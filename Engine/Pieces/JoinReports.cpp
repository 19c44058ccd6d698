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

/// The numbers of a report.
struct ReportNumbers
{
  std::int64_t Points = 0, Triangles = 0, Unmatched = 0, Inserted = 0, ConstraintFlips = 0;
  std::int64_t Euler = 0, NonDelaunayBefore = 0, NonDelaunayAfter = 0;
  std::int64_t BlockedByShape = 0, BlockedByEdge = 0;
  EdgeCounts Edges;
  double AngleBefore = NaN, AngleAfter = NaN; ///< The smallest; NaN without triangles.
  double BuildSeconds = 0.0, FlipSeconds = 0.0; ///< The largest.

  ReportNumbers() = default;
  explicit ReportNumbers(const FlipReport& report)
    : Points(report.Points),
      Triangles(report.Triangles),
      Unmatched(report.UnmatchedConstraints),
      Inserted(report.InsertedConstraints),
      ConstraintFlips(report.ConstraintFlips),
      Euler(report.EulerCharacteristic),
      NonDelaunayBefore(report.NonDelaunayBefore),
      NonDelaunayAfter(report.NonDelaunayAfter),
      BlockedByShape(report.BlockedByShape),
      BlockedByEdge(report.BlockedByEdge),
      Edges(report.Edges),
      AngleBefore(report.MinimumAngleBefore),
      AngleAfter(report.MinimumAngleAfter),
      BuildSeconds(report.BuildSeconds),
      FlipSeconds(report.FlipSeconds)
  {
  }

  ReportNumbers& operator+=(const ReportNumbers& part)
  {
    this->Points += part.Points;
    this->Triangles += part.Triangles;
    this->Unmatched += part.Unmatched;
    this->Inserted += part.Inserted;
    this->ConstraintFlips += part.ConstraintFlips;
    this->Euler += part.Euler;
    this->NonDelaunayBefore += part.NonDelaunayBefore;
    this->NonDelaunayAfter += part.NonDelaunayAfter;
    this->BlockedByShape += part.BlockedByShape;
    this->BlockedByEdge += part.BlockedByEdge;
    this->AddEdges(part.Edges);
    this->AngleBefore = std::fmin(this->AngleBefore, part.AngleBefore);
    this->AngleAfter = std::fmin(this->AngleAfter, part.AngleAfter);
    this->BuildSeconds = std::max(this->BuildSeconds, part.BuildSeconds);
    this->FlipSeconds = std::max(this->FlipSeconds, part.FlipSeconds);
    return *this;
  }

  void Store(FlipReport& report) const
  {
    report.Points = this->Points;
    report.Triangles = this->Triangles;
    report.UnmatchedConstraints = this->Unmatched;
    report.InsertedConstraints = this->Inserted;
    report.ConstraintFlips = this->ConstraintFlips;
    report.EulerCharacteristic = this->Euler;
    report.NonDelaunayBefore = this->NonDelaunayBefore;
    report.NonDelaunayAfter = this->NonDelaunayAfter;
    report.BlockedByShape = this->BlockedByShape;
    report.BlockedByEdge = this->BlockedByEdge;
    report.Edges = this->Edges;
    report.MinimumAngleBefore = this->AngleBefore;
    report.MinimumAngleAfter = this->AngleAfter;
    report.BuildSeconds = this->BuildSeconds;
    report.FlipSeconds = this->FlipSeconds;
  }

private:
  void AddEdges(const EdgeCounts& part)
  {
    this->Edges.Edges += part.Edges;
    this->Edges.Boundary += part.Boundary;
    this->Edges.NonManifold += part.NonManifold;
    this->Edges.WronglyWound += part.WronglyWound;
    this->Edges.Feature += part.Feature;
    this->Edges.Constraint += part.Constraint;
    this->Edges.Region += part.Region;
    this->Edges.Fixed += part.Fixed;
  }
};

Message PackText(const std::string& text) { return Message(text.begin(), text.end()); }

std::vector<std::string> GatherTexts(const std::string& text, PieceGroup& group)
{
  std::vector<std::string> texts;
  for (const Message& message : group.Gather(PackText(text)))
  {
    texts.emplace_back(message.begin(), message.end());
  }
  return texts;
}

/// The texts without repetitions, separated by commas.
std::string JoinTexts(const std::vector<std::string>& texts)
{
  std::string list;
  std::vector<std::string> known;
  for (const std::string& one : texts)
  {
    if (!one.empty() && std::find(known.begin(), known.end(), one) == known.end())
    {
      known.push_back(one);
      list += (list.empty() ? "" : ", ") + one;
    }
  }
  return list;
}

/// Counts of the same defect are summed. Ids mean nothing outside their rank.
void AddDefect(const std::string& what, std::int64_t count, std::vector<Defect>& sum)
{
  const auto same =
    std::find_if(sum.begin(), sum.end(), [&](const Defect& one) { return one.What == what; });
  Defect& target = same != sum.end() ? *same : sum.emplace_back(Defect{ what, 0, {} });
  target.Count += count;
}

std::vector<Defect> JoinDefects(const std::vector<Defect>& defects, PieceGroup& group)
{
  std::vector<std::int64_t> counts;
  std::string texts;
  for (const Defect& defect : defects)
  {
    counts.push_back(defect.Count);
    texts += defect.What + "\n";
  }
  const RecordLists<std::int64_t> allCounts = GatherRecords(group, counts);
  const std::vector<std::string> allTexts = GatherTexts(texts, group);
  std::vector<Defect> sum;
  for (std::size_t rank = 0; rank < allTexts.size(); ++rank)
  {
    auto begin = allTexts[rank].begin();
    for (const std::int64_t count : allCounts[rank])
    {
      const auto end = std::find(begin, allTexts[rank].end(), '\n');
      AddDefect(std::string(begin, end), count, sum);
      begin = end + 1;
    }
  }
  return sum;
}

void AddRow(const IterationRecord& row, IterationRecord& sum)
{
  sum.Tested += row.Tested;
  sum.NonDelaunay += row.NonDelaunay;
  sum.Flipped += row.Flipped;
  sum.Excluded += row.Excluded;
  sum.Blocked += row.Blocked;
  sum.Seconds = std::max(sum.Seconds, row.Seconds);
}

/// An iteration of all ranks that make one.
struct JoinedRow
{
  IterationRecord Sum;
  std::vector<std::pair<std::size_t, double>> Angles; ///< The smallest of those ranks.
};

using RowPlace = std::pair<std::int64_t, std::int64_t>; // round and place

std::map<RowPlace, JoinedRow> SumRows(const RecordLists<RoundRow>& lists)
{
  std::map<RowPlace, JoinedRow> sums;
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const RoundRow& row : lists[rank])
    {
      JoinedRow& joined = sums[{ row.Round, row.Place }];
      AddRow(row.Record, joined.Sum);
      joined.Angles.emplace_back(rank, row.Record.MinimumAngle);
    }
  }
  return sums;
}

/// The smallest angle after an iteration is that of all ranks; a rank that has made no further
/// iteration still has its last one.
std::vector<IterationRecord> JoinRows(const RecordLists<RoundRow>& lists)
{
  std::vector<double> angles(lists.size(), NaN);
  std::vector<IterationRecord> joined;
  for (const auto& [place, row] : SumRows(lists))
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
  FlipReport joined = report;
  SumOverRanks(group, ReportNumbers(report)).Store(joined);
  joined.Tolerance = JoinTexts(GatherTexts(report.Tolerance, group));
  joined.Backend = JoinTexts(GatherTexts(report.Backend, group));
  joined.Fallback = JoinTexts(GatherTexts(report.Fallback, group));
  joined.Defects = JoinDefects(report.Defects, group);
  joined.Iterations = JoinRows(GatherRecords(group, rows));
  CountIterations(joined);
  return joined;
}

FlipReport JoinReports(const std::vector<FlipReport>& reports)
{
  FlipReport joined;
  ReportNumbers sum;
  RecordLists<RoundRow> rows(reports.size());
  std::vector<std::string> tolerances, backends, fallbacks;
  for (std::size_t i = 0; i < reports.size(); ++i)
  {
    const FlipReport& report = reports[i];
    sum += ReportNumbers(report);
    tolerances.push_back(report.Tolerance);
    backends.push_back(report.Backend);
    fallbacks.push_back(report.Fallback);
    for (const Defect& defect : report.Defects)
    {
      AddDefect(defect.What, defect.Count, joined.Defects);
    }
    IterationRecord before;
    before.MinimumAngle = report.MinimumAngleBefore;
    rows[i].push_back({ 1, -1, before });
    for (const IterationRecord& row : report.Iterations)
    {
      rows[i].push_back({ 1, row.Iteration, row });
    }
  }
  sum.Store(joined);
  joined.Tolerance = JoinTexts(tolerances);
  joined.Backend = JoinTexts(backends);
  joined.Fallback = JoinTexts(fallbacks);
  joined.Iterations = JoinRows(rows);
  return joined;
}

}
