// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GuardRound.h"

#include <algorithm>
#include <unordered_set>

namespace delaunayflip
{

namespace
{
/// An edge to flip, and the edge that this would make.
struct Question
{
  PointPair Ends; ///< Keys, as all here.
  PointPair Opposite;
  bool IsSeam; ///< Between ranks, so that it cannot flip now.
};

/// Triangles at shared points, more than once.
std::vector<std::int64_t> FindTrianglesAtShared(const PieceMesh& mesh)
{
  std::vector<std::int64_t> triangles;
  for (const std::int32_t point : mesh.GetSharedPoints())
  {
    mesh.ForEachAt(point, [&](const PieceCorner& corner) { triangles.push_back(corner.Triangle); });
  }
  return triangles;
}

/// The inner edges of some triangles whose two opposite points are both shared, in the order of the
/// later of their triangles.
std::vector<InnerQuad> ListWaiting(PieceMesh& mesh, std::vector<std::int64_t> triangles)
{
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<InnerQuad> quads;
  for (const std::int64_t t : triangles)
  {
    const PieceTriangle& triangle = mesh.Triangles[t];
    for (int slot = 0; slot < 3 && !triangle.HasLeft; ++slot)
    {
      const PieceCorner corner{ t, slot };
      const PieceCorner mate =
        mesh.IsShared(triangle.Points[slot]) ? mesh.FindOpenMate(corner) : PieceCorner{ -1, 0 };
      if (mate.Triangle >= 0 && mesh.IsShared(mesh.Triangles[mate.Triangle].Points[mate.Slot]))
      {
        const bool isFirst = t < mate.Triangle;
        quads.push_back({ isFirst ? corner : mate, isFirst ? mate : corner });
      }
    }
  }
  const auto place = [](const InnerQuad& quad)
  { return 3 * quad.Other.Triangle + quad.Other.Slot; };
  std::sort(quads.begin(), quads.end(),
    [&](const InnerQuad& a, const InnerQuad& b) { return place(a) < place(b); });
  quads.erase(std::unique(quads.begin(), quads.end(),
                [&](const InnerQuad& a, const InnerQuad& b) { return place(a) == place(b); }),
    quads.end());
  return quads;
}

/// Those of the waiting edges that are bad and whose flip would not fold the mesh over.
std::vector<InnerQuad> FindBadQuads(
  PieceMesh& mesh, const std::vector<std::int64_t>& triangles, const QuadJudge& judge)
{
  std::vector<InnerQuad> quads = ListWaiting(mesh, triangles);
  const auto isGood = [&](const InnerQuad& quad)
  { return judge.Judge(mesh, quad.One, quad.Other) != EdgeState::Bad; };
  quads.erase(std::remove_if(quads.begin(), quads.end(), isGood), quads.end());
  return quads;
}

Question MakeQuestion(const PieceMesh& mesh, const InnerQuad& quad)
{
  const PieceTriangle& one = mesh.Triangles[quad.One.Triangle];
  const PieceTriangle& other = mesh.Triangles[quad.Other.Triangle];
  return { mesh.GetKeys(one.GetEdge(quad.One.Slot)),
    mesh.GetKeys({ one.Points[quad.One.Slot], other.Points[quad.Other.Slot] }), false };
}

/// One flag per question: whether this rank has the edge that the flip would make.
std::vector<unsigned char> FindExisting(
  const PieceMesh& mesh, const std::vector<Question>& questions)
{
  std::vector<unsigned char> answers;
  for (const Question& question : questions)
  {
    const std::int64_t a = mesh.FindPoint(question.Opposite[0]);
    const std::int64_t b = mesh.FindPoint(question.Opposite[1]);
    answers.push_back(a >= 0 && b >= 0 && mesh.HasEdge({ a, b }) ? 1 : 0);
  }
  return answers;
}

/// The edges that may be made, and by the flip of which edge: of those that can flip now, or else
/// of the others, the first that asked. All ranks come to the same answers.
PairMap<PointPair> GrantFlips(
  const PieceMesh& mesh, const std::vector<Question>& own, PieceGroup& group)
{
  std::vector<Question> all;
  for (const std::vector<Question>& list : GatherRecords(group, own))
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  std::stable_partition(all.begin(), all.end(), [](const Question& one) { return !one.IsSeam; });
  std::vector<unsigned char> exists(all.size());
  for (const std::vector<unsigned char>& answers : GatherRecords(group, FindExisting(mesh, all)))
  {
    std::transform(answers.begin(), answers.end(), exists.begin(), exists.begin(),
      [](unsigned char a, unsigned char b) { return static_cast<unsigned char>(a | b); });
  }
  PairMap<PointPair> granted;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (exists[i] == 0)
    {
      granted.emplace(all[i].Opposite, all[i].Ends);
    }
  }
  return granted;
}

bool IsGranted(const PairMap<PointPair>& granted, const PointPair& ends, const PointPair& opposite)
{
  const auto found = granted.find(opposite);
  return found != granted.end() && found->second == ends;
}

/// Flips the granted ones of some edges, no two of the same triangle.
/// @returns the triangles that have changed.
std::unordered_set<std::int64_t> FlipGranted(PieceMesh& mesh, const std::vector<InnerQuad>& quads,
  const PairMap<PointPair>& granted, GuardRound& round)
{
  std::unordered_set<std::int64_t> busy;
  for (const InnerQuad& quad : quads)
  {
    const bool isFree = busy.count(quad.One.Triangle) == 0 && busy.count(quad.Other.Triangle) == 0;
    const Question question = MakeQuestion(mesh, quad);
    if (!isFree || !IsGranted(granted, question.Ends, question.Opposite))
    {
      continue;
    }
    round.Gone.push_back(mesh.Triangles[quad.One.Triangle].GetEdge(quad.One.Slot));
    mesh.Flip(quad.One, quad.Other);
    ++round.Flipped;
    for (const std::int64_t t : { quad.One.Triangle, quad.Other.Triangle })
    {
      busy.insert(t);
      round.Changed.push_back(t);
    }
  }
  return busy;
}
}

void WaitingEdges::Find(PieceMesh& mesh, const QuadJudge& judge)
{
  const std::vector<std::int64_t> changed = mesh.TakeChanged();
  this->Triangles.insert(this->Triangles.end(), changed.begin(), changed.end());
  this->Bad =
    FindBadQuads(mesh, this->IsFirst ? FindTrianglesAtShared(mesh) : this->Triangles, judge);
  this->IsFirst = false;
  this->Triangles.clear();
  for (const InnerQuad& quad : this->Bad)
  {
    this->Triangles.insert(this->Triangles.end(), { quad.One.Triangle, quad.Other.Triangle });
  }
}

GuardRound WaitingEdges::Flip(
  PieceMesh& mesh, const QuadJudge& judge, SeamTest& test, PieceGroup& group, bool mayFlip)
{
  DoTogether(group, [&]() { this->Find(mesh, judge); });
  std::vector<Question> questions;
  for (const InnerQuad& quad : this->Bad)
  {
    questions.push_back(MakeQuestion(mesh, quad));
  }
  for (const BadSeam& seam : test.Bad)
  {
    questions.push_back({ seam.Ends, seam.Opposite, true });
  }
  const PairMap<PointPair> granted = GrantFlips(mesh, questions, group);
  GuardRound round;
  round.FreeOfAll = static_cast<std::int64_t>(granted.size());
  if (!mayFlip)
  {
    return round;
  }
  const std::unordered_set<std::int64_t> changed = FlipGranted(mesh, this->Bad, granted, round);
  // A changed triangle may have lost its bad edge to its neighbour; the next round will tell.
  const auto mustStay = [&](const BadSeam& seam)
  { return changed.count(seam.Triangle) > 0 || !IsGranted(granted, seam.Ends, seam.Opposite); };
  test.Bad.erase(std::remove_if(test.Bad.begin(), test.Bad.end(), mustStay), test.Bad.end());
  return round;
}

}
