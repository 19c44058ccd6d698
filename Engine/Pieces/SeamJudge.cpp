// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamJudge.h"

#include "QuadJudge.h"
#include "QuadSoup.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
/// One edge: its triangles, by rank.
struct SeamEdge
{
  const RankedTriangle* Begin;
  const RankedTriangle* End;
  bool IsConstraint;

  std::int64_t GetSize() const { return this->End - this->Begin; }
  bool IsOnOneRank() const { return this->Begin->Rank == (this->End - 1)->Rank; }
  /// Whether it has two triangles, on two ranks, with different opposite points.
  bool IsQuad() const
  {
    return this->GetSize() == 2 && !this->IsOnOneRank() &&
      this->Begin[0].Seam->Opposite != this->Begin[1].Seam->Opposite;
  }
  std::int64_t CountOn(int rank) const
  {
    return std::count_if(
      this->Begin, this->End, [=](const RankedTriangle& seam) { return seam.Rank == rank; });
  }
};

void AddCounts(EdgeCounts& sum, const EdgeCounts& part, std::int64_t factor)
{
  sum.Edges += factor * part.Edges;
  sum.Boundary += factor * part.Boundary;
  sum.NonManifold += factor * part.NonManifold;
  sum.WronglyWound += factor * part.WronglyWound;
  sum.Feature += factor * part.Feature;
  sum.Constraint += factor * part.Constraint;
  sum.Region += factor * part.Region;
  sum.Fixed += factor * part.Fixed;
}

/// Decides about the edges that all ranks have sent to this one.
class SeamJudge
{
public:
  SeamJudge(const PieceSurvey& survey, const FlipOptions& options, std::size_t ranks)
    : Survey(survey),
      Options(options),
      Answers(ranks)
  {
  }

  void Judge(
    const RecordLists<SeamTriangle>& seams, const RecordLists<SharedConstraint>& constraints)
  {
    this->Seams = SortByEdge(seams);
    this->CollectConstraints(constraints);
    this->FindEdges();
    QuadSoup soup(this->Survey, this->Options);
    std::vector<const SeamEdge*> quads;
    for (const SeamEdge& edge : this->Edges)
    {
      if (edge.IsQuad())
      {
        soup.Add(edge.Begin[0].Seam->Side, edge.Begin[1].Seam->Side);
        quads.push_back(&edge);
      }
    }
    const std::vector<unsigned char> fixed = soup.FindFixed(this->Counts.Edges);
    for (std::size_t i = 0; i < quads.size(); ++i)
    {
      this->AnswerQuad(*quads[i], fixed[i] != 0);
    }
    for (const SeamEdge& edge : this->Edges)
    {
      this->AnswerOther(edge);
    }
    this->CountBad();
  }

  SeamVerdict Take()
  {
    SeamVerdict verdict{ std::move(this->Answers), {}, this->Counts };
    for (const SharedConstraint& one : this->Constraints)
    {
      if (one.IsToInsert != 0)
      {
        verdict.Missing.push_back(one.Ends);
      }
    }
    return verdict;
  }

private:
  void CollectConstraints(const RecordLists<SharedConstraint>& lists)
  {
    for (const std::vector<SharedConstraint>& list : lists)
    {
      this->Constraints.insert(this->Constraints.end(), list.begin(), list.end());
    }
    const auto place = [](const SharedConstraint& one)
    { return std::make_pair(one.Ends, -one.IsToInsert); };
    std::sort(this->Constraints.begin(), this->Constraints.end(),
      [&](const SharedConstraint& a, const SharedConstraint& b) { return place(a) < place(b); });
    this->Constraints.erase(
      std::unique(this->Constraints.begin(), this->Constraints.end(),
        [](const SharedConstraint& a, const SharedConstraint& b) { return a.Ends == b.Ends; }),
      this->Constraints.end());
  }

  /// Whether an edge is a constraint, which then is not missing.
  bool MatchConstraint(const PointPair& ends)
  {
    const auto found = std::lower_bound(this->Constraints.begin(), this->Constraints.end(), ends,
      [](const SharedConstraint& one, const PointPair& pair) { return one.Ends < pair; });
    const bool isConstraint = found != this->Constraints.end() && found->Ends == ends;
    this->Counts.MissingConstraints -= isConstraint ? 1 : 0;
    if (isConstraint)
    {
      this->Counts.MissingToInsert -= std::exchange(found->IsToInsert, 0);
    }
    return isConstraint;
  }

  void FindEdges()
  {
    for (const SharedConstraint& one : this->Constraints)
    {
      ++this->Counts.MissingConstraints;
      this->Counts.MissingToInsert += one.IsToInsert;
    }
    for (std::size_t begin = 0; begin < this->Seams.size();)
    {
      const PointPair& ends = this->Seams[begin].Ends;
      std::size_t end = begin + 1;
      while (end < this->Seams.size() && this->Seams[end].Ends == ends)
      {
        ++end;
      }
      const bool isConstraint = this->MatchConstraint(ends);
      this->Edges.push_back({ this->Seams.data() + begin, this->Seams.data() + end, isConstraint });
      begin = end;
    }
  }

  /// An edge with a triangle on each of two ranks.
  void AnswerQuad(const SeamEdge& edge, bool isFixed)
  {
    // Each rank has counted an edge at its boundary.
    AddCounts(this->Counts.Edges, MakeBoundary(), -2);
    this->Counts.Edges.Constraint += edge.IsConstraint ? 1 : 0;
    this->Counts.Edges.Fixed += edge.IsConstraint && !isFixed ? 1 : 0;
    const bool stays = isFixed || edge.IsConstraint;
    for (const RankedTriangle* one = edge.Begin; one != edge.End; ++one)
    {
      this->Answer(*one, stays, false);
    }
    if (!stays)
    {
      ++this->Counts.Seams;
      this->Open.push_back(&edge);
    }
  }

  /// An edge with all of its triangles on one rank, or with more than two.
  void AnswerOther(const SeamEdge& edge)
  {
    if (edge.IsOnOneRank())
    {
      for (const RankedTriangle* one = edge.Begin; one != edge.End && edge.IsConstraint; ++one)
      {
        this->Answer(*one, true, true);
      }
      return;
    }
    if (edge.IsQuad())
    {
      return;
    }
    this->CountOther(edge);
    for (const RankedTriangle* one = edge.Begin; one != edge.End; ++one)
    {
      this->Answer(*one, true, edge.CountOn(one->Rank) == 2);
    }
  }

  /// Takes back what the ranks have counted alone.
  void CountOther(const SeamEdge& edge)
  {
    EdgeCounts all;
    all.Edges = 1;
    all.Fixed = 1;
    all.NonManifold = edge.GetSize() > 2 ? 1 : 0;
    all.Constraint = edge.IsConstraint ? 1 : 0;
    if (edge.GetSize() == 2) // two triangles on the same three points
    {
      all.WronglyWound =
        edge.Begin[0].Seam->Side.RunsForward == edge.Begin[1].Seam->Side.RunsForward ? 1 : 0;
      all.Region = edge.Begin[0].Seam->Side.Region != edge.Begin[1].Seam->Side.Region ? 1 : 0;
    }
    AddCounts(this->Counts.Edges, all, 1);
    for (const RankedTriangle* one = edge.Begin; one != edge.End; ++one)
    {
      if (one == edge.Begin || one->Rank != one[-1].Rank)
      {
        AddCounts(this->Counts.Edges, this->CountAlone(edge, one), -1);
      }
    }
  }

  /// What a rank counts of an edge of which others have triangles, too.
  EdgeCounts CountAlone(const SeamEdge& edge, const RankedTriangle* first) const
  {
    const std::int64_t size = edge.CountOn(first->Rank);
    EdgeCounts counts = MakeBoundary();
    if (size == 2)
    {
      counts = EdgeCounts();
      QuadSoup soup(this->Survey, this->Options);
      soup.Add(first[0].Seam->Side, first[1].Seam->Side);
      soup.FindFixed(counts);
      counts.Fixed = 1; // on this rank
      counts.Constraint = 1;
    }
    else if (size > 2)
    {
      counts.Boundary = 0;
      counts.NonManifold = 1;
    }
    return counts;
  }

  static EdgeCounts MakeBoundary()
  {
    EdgeCounts counts;
    counts.Edges = 1;
    counts.Boundary = 1;
    counts.Fixed = 1;
    return counts;
  }

  void Answer(const RankedTriangle& seam, bool isFixed, bool isToFix)
  {
    this->Answers[seam.Rank].push_back(
      { seam.Seam->GetTriangle(), seam.Seam->GetSlot(), isFixed, isToFix });
  }

  void CountBad()
  {
    const QuadJudge judge(this->Survey, this->Options);
    this->Counts.NonDelaunay = std::count_if(this->Open.begin(), this->Open.end(),
      [&](const SeamEdge* edge) {
        return judge.Judge(edge->Begin[0].Seam->Side, edge->Begin[1].Seam->Side) != EdgeState::Good;
      });
  }

  const PieceSurvey& Survey;
  const FlipOptions& Options;
  std::vector<RankedTriangle> Seams;
  std::vector<SharedConstraint> Constraints;
  std::vector<SeamEdge> Edges;
  std::vector<const SeamEdge*> Open;
  RecordLists<SeamAnswer> Answers;
  SeamCounts Counts;
};
}

SeamCounts& SeamCounts::operator+=(const SeamCounts& part)
{
  AddCounts(this->Edges, part.Edges, 1);
  this->Seams += part.Seams;
  this->NonDelaunay += part.NonDelaunay;
  this->MissingConstraints += part.MissingConstraints;
  this->MissingToInsert += part.MissingToInsert;
  this->ToInsert += part.ToInsert;
  return *this;
}

EdgeCounts SeamCounts::AddTo(EdgeCounts sum) const
{
  AddCounts(sum, this->Edges, 1);
  return sum;
}

SeamVerdict JudgeSeams(const RecordLists<SeamTriangle>& seams,
  const RecordLists<SharedConstraint>& constraints, const PieceSurvey& survey,
  const FlipOptions& options)
{
  SeamJudge judge(survey, options, seams.size());
  judge.Judge(seams, constraints);
  return judge.Take();
}

}
