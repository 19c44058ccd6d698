// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamSurvey.h"

#include "DelaunayFlip.h"
#include "Records.h"

#include <algorithm>
#include <array>
#include <utility>

namespace delaunayflip
{

FlipOptions GetPartOptions(const PartSurvey& survey, const FlipOptions& options)
{
  FlipOptions part = options;
  part.Geometry = survey.Geometry;
  part.FeatureAngle = 180.0;
  part.TrackQuality = false;
  part.NumberOfPieces = 1;
  if (part.Backend == BackendKind::CUDA)
  {
    part.Backend = BackendKind::Auto; // parts are often too small for a GPU
  }
  return part;
}

//------------------------------------------------------------------------------
SeamTriangle MakeSeamTriangle(const PartMesh& mesh, std::int64_t t, int slot)
{
  std::int32_t points[3];
  mesh.GetPoints(t, points);
  std::int32_t first = points[(slot + 1) % 3];
  std::int32_t second = points[(slot + 2) % 3];
  SeamTriangle seam{};
  seam.Ends = mesh.GetKeys({ first, second });
  seam.Opposite = mesh.GetKey(points[slot]);
  seam.Corner = 3 * t + slot;
  seam.Side.RunsForward = mesh.GetKey(first) == seam.Ends[0];
  if (!seam.Side.RunsForward)
  {
    std::swap(first, second);
  }
  mesh.GetPosition(first, seam.Side.Ends[0]);
  mesh.GetPosition(second, seam.Side.Ends[1]);
  mesh.GetPosition(points[slot], seam.Side.Opposite);
  return seam;
}

std::vector<SeamTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists)
{
  std::vector<SeamTriangle> all;
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const SeamTriangle& seam : lists[rank])
    {
      all.push_back(seam);
      all.back().Rank = static_cast<std::int32_t>(rank);
      all.back().IsToTest = true;
    }
  }
  std::sort(all.begin(), all.end(),
    [](const SeamTriangle& a, const SeamTriangle& b)
    { return std::tie(a.Ends, a.Rank, a.Corner) < std::tie(b.Ends, b.Rank, b.Corner); });
  return all;
}

//------------------------------------------------------------------------------
QuadJudge::QuadJudge(const PartSurvey& survey, const FlipOptions& options)
  : Plan(PlanPacking(survey, options.Criterion, false)),
    Rule(survey, options)
{
}

EdgeState QuadJudge::Judge(const double (&apqb)[4][3]) const
{
  double packed[12];
  const int components = this->Plan.Components;
  for (int i = 0; i < 4 * components; ++i)
  {
    const int k = i % components;
    packed[i] = this->Plan.Flat && k == 2 ? 0.0 : apqb[i / components][this->Plan.Axes[k]];
  }
  return this->Rule.Visit(nullptr, packed, 0,
    [](const auto& rule)
    {
      const Quad quad{ 0, 0, 0, 1, 2, 3 };
      const EdgeState state = rule.Judge(quad);
      return state == EdgeState::Uncertain ? rule.JudgeExactly(quad) : state;
    });
}

EdgeState QuadJudge::Judge(const SeamSide& one, const SeamSide& other) const
{
  double apqb[4][3];
  std::copy_n(one.Opposite, 3, apqb[0]);
  std::copy_n(one.Ends[one.RunsForward ? 0 : 1], 3, apqb[1]);
  std::copy_n(one.Ends[one.RunsForward ? 1 : 0], 3, apqb[2]);
  std::copy_n(other.Opposite, 3, apqb[3]);
  return this->Judge(apqb);
}

EdgeState QuadJudge::Judge(
  const PartMesh& mesh, const PartCorner& one, const PartCorner& other) const
{
  const PartTriangle& triangle = mesh.Triangles[one.Triangle];
  double apqb[4][3];
  mesh.GetPosition(triangle.Points[one.Slot], apqb[0]);
  mesh.GetPosition(triangle.GetStart(one.Slot), apqb[1]);
  mesh.GetPosition(triangle.GetEnd(one.Slot), apqb[2]);
  mesh.GetPosition(mesh.Triangles[other.Triangle].Points[other.Slot], apqb[3]);
  return this->Judge(apqb);
}

//------------------------------------------------------------------------------
namespace
{
/// A constraint between shared points.
struct SharedConstraint
{
  PointPair Ends; ///< Keys.
  std::int64_t IsToInsert; ///< 0 or 1.
};

/// The answer of the home of an edge about a triangle that a rank has sent.
struct SeamAnswer
{
  std::int64_t Triangle;
  std::int32_t Slot;
  bool IsFixed;
  bool IsToFix; ///< The rank must be told to fix the edge: it has two triangles of it.
};

/// One edge: its triangles, by rank.
struct SeamEdge
{
  const SeamTriangle* Begin;
  const SeamTriangle* End;
  bool IsConstraint;

  bool IsOnOneRank() const { return this->Begin->Rank == (this->End - 1)->Rank; }
  /// Whether it has two triangles, on two ranks, with different opposite points.
  bool IsQuad() const
  {
    return this->End - this->Begin == 2 && !this->IsOnOneRank() &&
      this->Begin[0].Opposite != this->Begin[1].Opposite;
  }
  std::int64_t CountOn(int rank) const
  {
    return std::count_if(
      this->Begin, this->End, [=](const SeamTriangle& one) { return one.Rank == rank; });
  }
};

/// The two triangles of an edge.
using SeamQuad = std::array<const SeamSide*, 2>;

/// One flag per quad: whether its edge is fixed. Adds these edges, and why they are fixed, to
/// `counts`. The quads, whose triangles may come from different ranks, are a mesh in which they
/// share no points. So the engine judges such edges by the same rules as all others.
std::vector<unsigned char> FindFixed(
  const std::vector<SeamQuad>& quads, const PartJob& job, EdgeCounts& counts)
{
  std::vector<unsigned char> fixed(quads.size());
  if (fixed.empty())
  {
    return fixed;
  }
  std::vector<double> doubles;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> regions;
  std::vector<unsigned char> frozen;
  for (const SeamQuad& quad : quads)
  {
    const auto first = static_cast<std::int64_t>(2 * frozen.size());
    for (const auto& end : quad[0]->Ends)
    {
      doubles.insert(doubles.end(), end, end + 3);
    }
    for (int i = 0; i < 2; ++i)
    {
      doubles.insert(doubles.end(), quad[i]->Opposite, quad[i]->Opposite + 3);
      const int start = quad[i]->RunsForward ? 0 : 1;
      ids.insert(ids.end(), { first + start, first + 1 - start, first + 2 + i });
      regions.push_back(quad[i]->Region);
      frozen.push_back(quad[i]->IsFrozen ? 1 : 0);
    }
  }
  TriangleMesh mesh;
  const std::vector<float> floats(doubles.begin(), doubles.end());
  const auto points = static_cast<std::int64_t>(doubles.size()) / 3;
  mesh.Points =
    job.Survey.IsFloat ? PointArray(floats.data(), points) : PointArray(doubles.data(), points);
  mesh.Triangles = TriangleArray(ids.data(), static_cast<std::int64_t>(ids.size()) / 3);
  mesh.Regions = regions.data();
  mesh.FrozenTriangles = frozen.data();
  mesh.Whole = job.Survey.Whole;
  FlipOptions options = GetPartOptions(job.Survey, job.Options);
  options.FeatureAngle = job.Options.FeatureAngle;
  const std::vector<std::int64_t> pairs = FindFixedEdges(mesh, options);
  for (std::size_t i = 0; i < pairs.size(); i += 2)
  {
    fixed[pairs[i] / 4] = 1;
  }
  options.MaximumIterations = 0;
  const FlipSession session(mesh, options);
  const EdgeCounts& found = session.GetReport().Edges;
  counts.Edges += static_cast<std::int64_t>(quads.size());
  counts.WronglyWound += found.WronglyWound;
  counts.Feature += found.Feature;
  counts.Region += found.Region;
  counts.Fixed += static_cast<std::int64_t>(pairs.size()) / 2;
  return fixed;
}

/// Decides about the edges that all ranks have sent to this one, their home.
class SeamJudge
{
public:
  SeamJudge(const PartJob& job)
    : Answers(job.Group.GetSize()),
      Job(job)
  {
  }

  /// @param seams, lists from every rank.
  void Judge(const RecordLists<SeamTriangle>& seams, const RecordLists<SharedConstraint>& lists)
  {
    const std::vector<SeamTriangle> triangles = SortByEdge(seams);
    const std::vector<SeamEdge> edges = this->FindEdges(triangles, lists);
    std::vector<SeamQuad> quads;
    for (const SeamEdge& edge : edges)
    {
      if (edge.IsQuad())
      {
        quads.push_back({ &edge.Begin[0].Side, &edge.Begin[1].Side });
      }
    }
    const std::vector<unsigned char> fixed = FindFixed(quads, this->Job, this->Counts.Edges);
    auto isFixed = fixed.begin();
    const QuadJudge judge(this->Job.Survey, this->Job.Options);
    for (const SeamEdge& edge : edges)
    {
      if (edge.IsQuad())
      {
        this->AnswerQuad(edge, *isFixed++ != 0, judge);
        continue;
      }
      const bool isSpread = !edge.IsOnOneRank();
      if (isSpread)
      {
        this->CountOther(edge);
      }
      for (const SeamTriangle* one = edge.Begin; one != edge.End && (isSpread || edge.IsConstraint);
           ++one)
      {
        this->Answer(*one, true, !isSpread || edge.CountOn(one->Rank) == 2);
      }
    }
  }

  RecordLists<SeamAnswer> Answers; ///< For every rank.
  std::vector<PointPair> Missing; ///< The constraints to be inserted that are not edges yet.
  SeamCounts Counts;

private:
  /// Finds the edges, and which of the constraints they are. The other constraints are missing.
  std::vector<SeamEdge> FindEdges(
    const std::vector<SeamTriangle>& triangles, const RecordLists<SharedConstraint>& lists)
  {
    std::vector<SharedConstraint> constraints = Join(lists);
    // Of equal ones, one to be inserted comes first.
    std::sort(constraints.begin(), constraints.end(),
      [](const SharedConstraint& a, const SharedConstraint& b)
      { return a.Ends != b.Ends ? a.Ends < b.Ends : a.IsToInsert > b.IsToInsert; });
    std::vector<SeamEdge> edges;
    for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end)
    {
      while (end < triangles.size() && triangles[end].Ends == triangles[begin].Ends)
      {
        ++end;
      }
      edges.push_back({ triangles.data() + begin, triangles.data() + end, false });
    }
    auto edge = edges.begin();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const SharedConstraint& one = constraints[i];
      if (i > 0 && one.Ends == constraints[i - 1].Ends)
      {
        continue;
      }
      edge = std::lower_bound(edge, edges.end(), one.Ends,
        [](const SeamEdge& a, const PointPair& ends) { return a.Begin->Ends < ends; });
      if (edge != edges.end() && edge->Begin->Ends == one.Ends)
      {
        edge->IsConstraint = true;
        continue;
      }
      ++this->Counts.MissingConstraints;
      this->Counts.MissingToInsert += one.IsToInsert;
      if (one.IsToInsert != 0)
      {
        this->Missing.push_back(one.Ends);
      }
    }
    return edges;
  }

  /// An edge with a triangle on each of two ranks.
  void AnswerQuad(const SeamEdge& edge, bool isFixed, const QuadJudge& judge)
  {
    // Each rank has counted an edge at its boundary.
    AddCounts(this->Counts.Edges, MakeBoundary(), -2);
    this->Counts.Edges.Constraint += edge.IsConstraint ? 1 : 0;
    this->Counts.Edges.Fixed += edge.IsConstraint && !isFixed ? 1 : 0;
    const bool stays = isFixed || edge.IsConstraint;
    this->Answer(edge.Begin[0], stays, false);
    this->Answer(edge.Begin[1], stays, false);
    if (!stays)
    {
      ++this->Counts.Seams;
      const EdgeState state = judge.Judge(edge.Begin[0].Side, edge.Begin[1].Side);
      this->Counts.NonDelaunay += state != EdgeState::Good ? 1 : 0;
    }
  }

  /// Counts an edge with more than two triangles, or two on the same three points, and takes back
  /// what the ranks have counted alone.
  void CountOther(const SeamEdge& edge)
  {
    EdgeCounts all;
    all.Edges = 1;
    all.Fixed = 1;
    all.NonManifold = edge.End - edge.Begin > 2 ? 1 : 0;
    all.Constraint = edge.IsConstraint ? 1 : 0;
    if (all.NonManifold == 0)
    {
      const SeamSide& one = edge.Begin[0].Side;
      const SeamSide& other = edge.Begin[1].Side;
      all.WronglyWound = one.RunsForward == other.RunsForward ? 1 : 0;
      all.Region = one.Region != other.Region ? 1 : 0;
    }
    AddCounts(this->Counts.Edges, all, 1);
    for (const SeamTriangle* one = edge.Begin; one != edge.End; ++one)
    {
      if (one == edge.Begin || one->Rank != one[-1].Rank)
      {
        AddCounts(this->Counts.Edges, this->CountAlone(one, edge.CountOn(one->Rank)), -1);
      }
    }
  }

  /// What a rank counts of an edge of which others have triangles, too.
  /// @param first of its triangles.
  EdgeCounts CountAlone(const SeamTriangle* first, std::int64_t size) const
  {
    EdgeCounts counts = MakeBoundary();
    if (size == 2)
    {
      counts = EdgeCounts();
      FindFixed({ { &first[0].Side, &first[1].Side } }, this->Job, counts);
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
    counts.Edges = counts.Boundary = counts.Fixed = 1;
    return counts;
  }

  void Answer(const SeamTriangle& one, bool isFixed, bool isToFix)
  {
    this->Answers[one.Rank].push_back({ one.GetTriangle(), one.GetSlot(), isFixed, isToFix });
  }

  const PartJob& Job;
};

/// The triangles of this rank at edges between two shared points, for the homes of the edges.
RecordLists<SeamTriangle> ListSeamTriangles(
  const TriangleMesh& caller, const PartMesh& mesh, const PieceGroup& group)
{
  RecordLists<SeamTriangle> toHome(group.GetSize());
  for (std::int64_t t = 0; t < static_cast<std::int64_t>(mesh.Triangles.size()); ++t)
  {
    std::int32_t p[3];
    mesh.GetPoints(t, p);
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t start = p[(slot + 1) % 3];
      const std::int32_t end = p[(slot + 2) % 3];
      if (start != end && mesh.IsShared(start) && mesh.IsShared(end))
      {
        SeamTriangle seam = MakeSeamTriangle(mesh, t, slot);
        seam.Side.IsFrozen = (caller.FrozenTriangles && caller.FrozenTriangles[t] != 0) ||
          p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
        seam.Side.Region = caller.Regions ? caller.Regions[t] : 0;
        toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam);
      }
    }
  }
  return toHome;
}

/// Sends constraints between shared points to the ranks that know their edges, and keeps the others
/// for this rank alone.
RecordLists<SharedConstraint> DivideConstraints(
  const TriangleMesh& caller, const PartMesh& mesh, SeamSurvey& survey, const PieceGroup& group)
{
  RecordLists<SharedConstraint> toHome(group.GetSize());
  for (std::int64_t i = 0; i < caller.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t a = caller.ConstraintEdges[2 * i];
    const std::int64_t b = caller.ConstraintEdges[2 * i + 1];
    const unsigned char isToInsert = caller.ConstraintsToInsert ? caller.ConstraintsToInsert[i] : 0;
    if (a != b && mesh.IsShared(a) && mesh.IsShared(b))
    {
      const PointPair keys = mesh.GetKeys({ a, b });
      toHome[GetHome(PairHash()(keys), group)].push_back({ keys, isToInsert != 0 ? 1 : 0 });
    }
    else
    {
      survey.Constraints.insert(survey.Constraints.end(), { a, b });
      survey.ToInsert.push_back(isToInsert);
    }
  }
  return toHome;
}
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

namespace
{
/// Surveys the seams. All ranks must call this together.
/// @param piece the caller's part, or that part after constraints have been inserted.
SeamSurvey SurveySeams(const PartJob& job, const MeshPiece& piece, const PartMesh& mesh)
{
  PieceGroup& group = job.Group;
  SeamSurvey seams;
  const RecordLists<SeamTriangle> triangles =
    ExchangeRecords(group, ListSeamTriangles(piece.Mesh, mesh, group));
  const RecordLists<SharedConstraint> constraints =
    ExchangeRecords(group, DivideConstraints(piece.Mesh, mesh, seams, group));
  SeamJudge judge(job);
  DoTogether(group, [&]() { judge.Judge(triangles, constraints); });
  std::vector<std::int64_t> toFix;
  for (const SeamAnswer& answer : Join(ExchangeRecords(group, judge.Answers)))
  {
    seams.Marks.push_back({ answer.Triangle, answer.Slot, answer.IsFixed ? FixedMark : SeamMark });
    if (answer.IsToFix)
    {
      const PointPair edge = mesh.GetEdge(answer.Triangle, answer.Slot);
      toFix.insert(toFix.end(), edge.begin(), edge.end());
    }
  }
  seams.NumberToFix = toFix.size() / 2;
  seams.Constraints.insert(seams.Constraints.begin(), toFix.begin(), toFix.end());
  seams.ToInsert.insert(seams.ToInsert.begin(), seams.NumberToFix, 0);
  judge.Counts.ToInsert = std::count_if(
    seams.ToInsert.begin(), seams.ToInsert.end(), [](unsigned char flag) { return flag != 0; });
  seams.Counts = SumOverRanks(group, judge.Counts);
  if (seams.Counts.MissingToInsert > 0)
  {
    seams.Missing = Join(GatherRecords(group, judge.Missing));
    std::sort(seams.Missing.begin(), seams.Missing.end());
  }
  return seams;
}

//------------------------------------------------------------------------------
/// How much of a run is done when all constraints are inserted.
constexpr double InsertionShare = 0.25;

/// What became of a constraint on a rank: one of these, or 1 + its Refusal. The largest of all
/// ranks decides.
constexpr char NotTried = 0, Done = 100;
}

PartConstraints::PartConstraints(const PartJob& job, PartMesh& mesh)
  : Piece(job.Piece),
    Seams(SurveySeams(job, job.Piece, mesh)),
    Job(job),
    Mesh(mesh)
{
  const bool isPlanar = job.Survey.Geometry != GeometryKind::Surface;
  if (isPlanar && this->Seams.Counts.ToInsert + this->Seams.Counts.MissingToInsert > 0)
  {
    this->Run();
  }
}

void PartConstraints::AddTo(FlipReport& report) const
{
  report.InsertedConstraints += this->Inserted;
  report.ConstraintFlips += this->Flips;
  report.UnmatchedConstraints += static_cast<std::int64_t>(this->Refused.size());
  AddDefects(this->Refused, report.Defects);
}

void PartConstraints::Run()
{
  std::vector<std::int64_t> ends = this->Seams.Constraints;
  std::vector<unsigned char> toInsert = this->Seams.ToInsert;
  std::vector<char> fates;
  for (const PointPair& keys : this->Seams.Missing)
  {
    const std::int64_t from = this->Mesh.FindPoint(keys[0]);
    const std::int64_t to = this->Mesh.FindPoint(keys[1]);
    fates.push_back(from >= 0 && to >= 0 ? Done : NotTried); // or refused, see Count
    if (fates.back() == Done)
    {
      ends.insert(ends.end(), { from, to });
      toInsert.push_back(1);
    }
  }
  TriangleMesh mesh = this->Piece.Mesh;
  mesh.ConstraintEdges = ends.data();
  mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(toInsert.size());
  mesh.ConstraintsToInsert = toInsert.data();
  mesh.Whole = this->Job.Survey.Whole;
  const bool isGuarded = this->Job.Survey.NeedsGuard() && this->Job.Group.GetSize() > 1;
  mesh.Whole.SharedPoints = isGuarded ? this->Mesh.GetShared().data() : nullptr;
  ConstraintInsertion insertion;
  FlipOptions options = this->Job.Options;
  options.Geometry = this->Job.Survey.Geometry;
  const auto insert = [&]()
  {
    try
    {
      insertion = ConstraintInsertion(mesh, options,
        [this](double share)
        { return !this->Job.Progress || this->Job.Progress(InsertionShare * share); });
    }
    catch (const RunAborted&)
    {
      this->IsAborted = true;
    }
  };
  DoTogether(this->Job.Group, insert);
  const auto found = insertion.GetNumberInserted() +
    static_cast<std::int64_t>(insertion.GetRefused().size() + this->Seams.Missing.size());
  this->IsAborted =
    SumOverRanks(this->Job.Group, static_cast<std::int64_t>(this->IsAborted ? 1 : 0)) > 0;
  if (SumOverRanks(this->Job.Group, found) == 0 || this->IsAborted)
  {
    // All are edges; or what other ranks have inserted is dropped.
    std::fill(this->Seams.ToInsert.begin(), this->Seams.ToInsert.end(), 0);
    return;
  }
  this->Count(insertion, std::move(fates));
  this->Keep(insertion, mesh);
  this->Share = InsertionShare;
  this->Seams = SurveySeams(this->Job, this->Piece, this->Mesh);
}

/// Counts what this rank has inserted and refused. The first rank counts constraints between shared
/// points, by what the rank that came furthest with them has found.
/// @param fates of the missing constraints between shared points: Done for those that were tried.
void PartConstraints::Count(const ConstraintInsertion& insertion, std::vector<char> fates)
{
  const auto refuse = [this](const std::int64_t(&ends)[2], Refusal why)
  {
    const bool leaves = why == Refusal::LeavesMesh && this->Job.Group.GetSize() > 1;
    this->Refused.push_back({ { ends[0], ends[1] }, leaves ? Refusal::LeavesPart : why });
  };
  this->Flips = insertion.GetNumberOfFlips();
  this->Inserted = insertion.GetNumberInserted() - std::count(fates.begin(), fates.end(), Done);
  const std::vector<PointPair>& missing = this->Seams.Missing;
  for (const RefusedConstraint& one : insertion.GetRefused())
  {
    if (this->Mesh.IsShared(one.Ends[0]) && this->Mesh.IsShared(one.Ends[1]))
    {
      const PointPair keys = this->Mesh.GetKeys({ one.Ends[0], one.Ends[1] });
      const auto place = std::lower_bound(missing.begin(), missing.end(), keys);
      fates[place - missing.begin()] = static_cast<char>(1 + static_cast<int>(one.Why));
      ++this->Inserted; // it is among the tried ones
    }
    else
    {
      refuse(one.Ends, one.Why);
    }
  }
  for (const std::vector<char>& others : GatherRecords(this->Job.Group, fates))
  {
    std::transform(others.begin(), others.end(), fates.begin(), fates.begin(),
      [](char a, char b) { return std::max(a, b); });
  }
  for (std::size_t i = 0; i < missing.size() && this->Job.Group.GetRank() == 0; ++i)
  {
    if (fates[i] == Done)
    {
      ++this->Inserted;
    }
    else
    {
      const int why = fates[i] == NotTried ? 0 : fates[i] - 1;
      refuse({ missing[i][0], missing[i][1] }, static_cast<Refusal>(why));
    }
  }
}

/// Takes the triangles after the insertion, and all constraints that are edges now or are not to be
/// inserted.
/// @param mesh what the insertion started from.
void PartConstraints::Keep(const ConstraintInsertion& insertion, const TriangleMesh& mesh)
{
  const TriangleMesh& caller = this->Job.Piece.Mesh;
  for (std::int64_t i = 0; i < caller.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = caller.ConstraintEdges + 2 * i;
    if (this->Mesh.IsShared(ends[0]) && this->Mesh.IsShared(ends[1]) &&
      !std::binary_search(this->Seams.Missing.begin(), this->Seams.Missing.end(),
        this->Mesh.GetKeys({ ends[0], ends[1] })))
    {
      this->Constraints.insert(this->Constraints.end(), ends, ends + 2);
    }
  }
  const TriangleMesh made = insertion.GetMesh(mesh);
  this->Constraints.insert(this->Constraints.end(),
    made.ConstraintEdges + 2 * this->Seams.NumberToFix,
    made.ConstraintEdges + 2 * made.NumberOfConstraintEdges);
  std::vector<std::int32_t> flips(made.Triangles.Count);
  insertion.AddFlipCounts(flips.data());
  this->Mesh.ListAll();
  for (std::int64_t t = 0; t < made.Triangles.Count; ++t)
  {
    this->Mesh.Triangles[t].Flips = flips[t];
    for (int slot = 0; slot < 3; ++slot)
    {
      const auto point = static_cast<std::int32_t>(made.Triangles.Get(t, slot));
      this->Mesh.Triangles[t].Points[slot] = point;
      this->Ids.push_back(point);
    }
  }
  this->Piece.Mesh.Triangles = TriangleArray(this->Ids.data(), made.Triangles.Count);
  this->Piece.Mesh.ConstraintEdges = this->Constraints.data();
  this->Piece.Mesh.NumberOfConstraintEdges =
    static_cast<std::int64_t>(this->Constraints.size()) / 2;
  this->Piece.Mesh.ConstraintsToInsert = nullptr;
}

}
