// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamSurvey.h"

#include "DelaunayFlip.h"
#include "PartReports.h"

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
  const PartTriangle& triangle = mesh.Triangles[t];
  SeamTriangle seam{};
  seam.Ends = mesh.GetKeys({ triangle.GetStart(slot), triangle.GetEnd(slot) });
  seam.Opposite = mesh.GetKey(triangle.Points[slot]);
  seam.Corner = 3 * t + slot;
  seam.Rank = mesh.GetRank();
  seam.IsToTest = true;
  seam.RunsForward = mesh.GetKey(triangle.GetStart(slot)) == seam.Ends[0];
  mesh.GetPosition(triangle.GetStart(slot), seam.Places[seam.GetStart()]);
  mesh.GetPosition(triangle.GetEnd(slot), seam.Places[1 - seam.GetStart()]);
  mesh.GetPosition(triangle.Points[slot], seam.Places[2]);
  return seam;
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

EdgeState QuadJudge::Judge(const SeamTriangle& one, const SeamTriangle& other) const
{
  double apqb[4][3];
  std::copy_n(one.Places[2], 3, apqb[0]);
  std::copy_n(one.Places[one.GetStart()], 3, apqb[1]);
  std::copy_n(one.Places[1 - one.GetStart()], 3, apqb[2]);
  std::copy_n(other.Places[2], 3, apqb[3]);
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
/// What became of a constraint between shared points on a rank: one of these, or 1 + its Refusal.
/// The largest of all ranks decides.
constexpr char IsEdge = 100, Inserted = 101;

/// The answer of the home of an edge about a triangle that a rank has sent.
struct SeamAnswer
{
  std::int64_t Corner; ///< SeamTriangle::Corner of the triangle.
  EdgeMark Mark;
  bool IsToFix; ///< The rank must be told to fix the edge: it has two triangles of it.
};

/// Edges and their triangles, which may come from different ranks, as a mesh in which these edges
/// share no points. So the engine judges them by the same rules as all others.
class LooseEdges
{
public:
  explicit LooseEdges(const PartJob& job)
    : Job(job)
  {
  }

  /// Adds the edge of some triangles. @returns the id of its first point.
  std::int64_t Add(const SeamTriangle* begin, const SeamTriangle* end, bool isConstraint)
  {
    const std::int64_t first = this->CountPoints();
    this->AddPoint(begin->Places[0]);
    this->AddPoint(begin->Places[1]);
    for (const SeamTriangle* one = begin; one != end; ++one)
    {
      const int start = one->GetStart();
      this->Triangles.insert(
        this->Triangles.end(), { first + start, first + 1 - start, this->CountPoints() });
      this->AddPoint(one->Places[2]);
      this->Regions.push_back(one->Region);
      this->Frozen.push_back(one->IsFrozen);
      isConstraint = isConstraint || one->IsConstraint;
    }
    if (isConstraint)
    {
      this->Constraints.insert(this->Constraints.end(), { first, first + 1 });
    }
    return first;
  }

  /// One flag per point: whether an edge with two triangles that begins there is fixed.
  std::vector<bool> FindFixed() const
  {
    std::vector<bool> isFixed(this->CountPoints());
    this->Visit(
      [&](const TriangleMesh& mesh, const FlipOptions& options)
      {
        for (const std::int64_t point : FindFixedEdges(mesh, options))
        {
          isFixed[point] = true;
        }
      });
    return isFixed;
  }

  void AddTo(FlipReport& totals, std::int64_t factor) const
  {
    this->Visit([&](const TriangleMesh& mesh, const FlipOptions& options)
      { AddEdges(totals, FlipSession(mesh, options).GetReport(), factor); });
  }

private:
  /// Calls visit(mesh, options) unless there are none.
  template <typename Function>
  void Visit(const Function& visit) const
  {
    TriangleMesh mesh;
    mesh.Points = PointArray(this->Points.data(), this->CountPoints());
    std::vector<float> floats;
    if (this->Job.Survey.IsFloat)
    {
      floats.assign(this->Points.begin(), this->Points.end());
      mesh.Points = PointArray(floats.data(), this->CountPoints());
    }
    mesh.Triangles = TriangleArray(this->Triangles.data(), SizeOf(this->Triangles) / 3);
    mesh.Regions = this->Regions.data();
    mesh.FrozenTriangles = this->Frozen.data();
    mesh.ConstraintEdges = this->Constraints.data();
    mesh.NumberOfConstraintEdges = SizeOf(this->Constraints) / 2;
    mesh.Whole = this->Job.Survey.Whole;
    FlipOptions options = GetPartOptions(this->Job.Survey, this->Job.Options);
    options.FeatureAngle = this->Job.Options.FeatureAngle;
    options.MaximumIterations = 0;
    if (mesh.Triangles.Count > 0)
    {
      visit(mesh, options);
    }
  }

  void AddPoint(const double (&x)[3]) { this->Points.insert(this->Points.end(), x, x + 3); }
  std::int64_t CountPoints() const { return SizeOf(this->Points) / 3; }

  const PartJob& Job;
  std::vector<double> Points;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;
  std::vector<std::int64_t> Constraints;
};

/// Decides about the edges that all ranks have sent to this one, their home.
/// @param triangles of all ranks at these edges. @param seams receives the counts of the edges.
/// @returns the answers for every rank.
RecordLists<SeamAnswer> JudgeSeams(
  const PartJob& job, std::vector<SeamTriangle> triangles, SeamSurvey& seams)
{
  struct Edge
  {
    const SeamTriangle* Begin;
    const SeamTriangle* End;
    bool IsQuad; ///< It has two triangles with different opposite points.
    std::int64_t Point;
  };
  std::vector<Edge> edges; // that have triangles on several ranks
  LooseEdges together(job), alone(job);
  std::sort(triangles.begin(), triangles.end(),
    [](const SeamTriangle& a, const SeamTriangle& b)
    { return std::tie(a.Ends, a.Rank, a.Corner) < std::tie(b.Ends, b.Rank, b.Corner); });
  const auto add = [&](SeamTriangle* begin, SeamTriangle* end)
  {
    if (begin->Rank == end[-1].Rank)
    {
      return;
    }
    const bool isPair = end - begin == 2;
    const bool isQuad = isPair && begin[0].Opposite != begin[1].Opposite;
    begin->IsFrozen = begin->IsFrozen || (isPair && !isQuad);
    edges.push_back({ begin, end, isQuad, together.Add(begin, end, false) });
    for (SeamTriangle* one = begin; one != end;)
    {
      SeamTriangle* const next =
        std::find_if(one, end, [=](const SeamTriangle& other) { return other.Rank != one->Rank; });
      alone.Add(one, next, next - one == 2); // which the rank is told to fix
      one = next;
    }
  };
  ForEachRun(
    triangles, [](const SeamTriangle& a, const SeamTriangle& b) { return a.Ends == b.Ends; }, add);
  together.AddTo(seams.Totals, 1);
  alone.AddTo(seams.Totals, -1);
  const std::vector<bool> isFixed = together.FindFixed();
  RecordLists<SeamAnswer> answers(job.Group.GetSize());
  for (const Edge& edge : edges)
  {
    const bool isSeam = edge.IsQuad && !isFixed[edge.Point];
    seams.Seams += isSeam;
    for (const SeamTriangle* one = edge.Begin; one != edge.End; ++one)
    {
      const auto here = std::count_if(
        edge.Begin, edge.End, [=](const SeamTriangle& other) { return other.Rank == one->Rank; });
      answers[one->Rank].push_back({ one->Corner, isSeam ? SeamMark : FixedMark, here == 2 });
    }
  }
  return answers;
}

/// The triangles of this rank at edges between two shared points, for the homes of the edges.
/// @param fates of constraints, by keys; those that are edges are set to IsEdge, at least.
RecordLists<SeamTriangle> ListSeamTriangles(
  const TriangleMesh& mesh, const PartMesh& part, PairMap<char>& fates, const PieceGroup& group)
{
  RecordLists<SeamTriangle> toHome(group.GetSize());
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    if (!part.Triangles[t].HasEdges())
    {
      continue;
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      if (part.AreShared(part.Triangles[t].GetEdge(slot)))
      {
        SeamTriangle seam = MakeSeamTriangle(part, t, slot);
        seam.IsFrozen = mesh.FrozenTriangles && mesh.FrozenTriangles[t] != 0;
        seam.Region = mesh.Regions ? mesh.Regions[t] : 0;
        const auto constraint = fates.find(seam.Ends);
        if (constraint != fates.end())
        {
          constraint->second = std::max(constraint->second, IsEdge);
          seam.IsConstraint = true;
        }
        toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam);
      }
    }
  }
  return toHome;
}

/// Surveys the seams. All ranks must call this together.
SeamSurvey SurveySeams(
  const PartJob& job, const TriangleMesh& mesh, const PartMesh& part, PairMap<char>& fates)
{
  PieceGroup& group = job.Group;
  SeamSurvey seams;
  const std::vector<SeamTriangle> triangles =
    Join(ExchangeRecords(group, ListSeamTriangles(mesh, part, fates, group)));
  RecordLists<SeamAnswer> answers;
  DoTogether(group, [&]() { answers = JudgeSeams(job, triangles, seams); });
  for (const SeamAnswer& answer : Join(ExchangeRecords(group, answers)))
  {
    const PointPair edge =
      part.Triangles[answer.Corner / 3].GetEdge(static_cast<int>(answer.Corner % 3));
    seams.Marks[edge] |= answer.Mark;
    if (answer.IsToFix)
    {
      seams.ToFix.insert(seams.ToFix.end(), edge.begin(), edge.end());
    }
  }
  seams.Seams = SumOverRanks(group, seams.Seams);
  return seams;
}

/// How much of a run is done when all constraints are inserted.
constexpr double InsertionShare = 0.25;
}

//------------------------------------------------------------------------------
PartConstraints::PartConstraints(const PartJob& job, PartMesh& part)
  : Mesh(job.Piece.Mesh)
{
  const SharedConstraints shared = this->List(job, part);
  this->Mesh.ConstraintEdges = this->Ends.data();
  this->Mesh.NumberOfConstraintEdges = SizeOf(this->ToInsert);
  this->Mesh.ConstraintsToInsert = this->ToInsert.data();
  this->Mesh.Whole = job.Survey.Whole;
  if (job.Survey.NeedsGuard() && job.Group.GetSize() > 1)
  {
    this->Mesh.Whole.SharedPoints = part.GetPointKeys().Shared.data();
  }
  this->Insert(job);
  this->FindFates(part);
  this->Mesh = this->Insertion.GetMesh(this->Mesh);
  if (this->Insertion.HasFlips())
  {
    part.Take(this->Mesh.Triangles);
  }
  // Returns the fate of a constraint between shared points, which is entered if it is new. Others
  // have none.
  const auto getFate = [&](std::int64_t constraint) -> char*
  {
    const std::int64_t* ends = this->Mesh.ConstraintEdges + 2 * constraint;
    if (!part.AreShared({ ends[0], ends[1] }))
    {
      return nullptr;
    }
    return &this->Fates[part.GetKeys({ ends[0], ends[1] })];
  };
  for (std::int64_t i = 0; i < this->Mesh.NumberOfConstraintEdges; ++i)
  {
    getFate(i); // enters it for the survey
  }
  this->Seams = SurveySeams(job, this->Mesh, part, this->Fates);
  this->Edges = this->Seams.ToFix;
  for (std::int64_t i = 0; i < this->Mesh.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = this->Mesh.ConstraintEdges + 2 * i;
    const char* fate = getFate(i);
    if (!fate || *fate >= IsEdge)
    {
      this->Edges.insert(this->Edges.end(), ends, ends + 2);
    }
  }
  this->Mesh.ConstraintEdges = this->Edges.data();
  this->Mesh.NumberOfConstraintEdges = SizeOf(this->Edges) / 2;

  std::vector<char> ofShared;
  for (const auto& [ends, isToInsert] : shared)
  {
    ofShared.push_back(this->Fates[ends]);
  }
  ofShared = FindMaxima(job.Group, std::move(ofShared));
  if (job.Group.GetRank() == 0)
  {
    this->CountShared(shared, ofShared);
  }
  for (RefusedConstraint& one : this->Refused)
  {
    if (one.Why == Refusal::LeavesMesh && job.Group.GetSize() > 1)
    {
      one.Why = Refusal::LeavesPart;
    }
  }
}

/// Lists the constraints that have both points on this rank: its own, and those between shared
/// points that any rank has given.
/// @returns the latter of all ranks.
PartConstraints::SharedConstraints PartConstraints::List(const PartJob& job, const PartMesh& part)
{
  const TriangleMesh& caller = job.Piece.Mesh;
  std::vector<std::array<std::int64_t, 3>> own; // two keys, and 1 if it is to be inserted
  for (std::int64_t i = 0; i < caller.NumberOfConstraintEdges; ++i)
  {
    const std::int64_t* ends = caller.ConstraintEdges + 2 * i;
    const bool isToInsert = caller.ConstraintsToInsert && caller.ConstraintsToInsert[i] != 0;
    if (part.AreShared({ ends[0], ends[1] }))
    {
      const PointPair keys = part.GetKeys({ ends[0], ends[1] });
      own.push_back({ keys[0], keys[1], isToInsert });
    }
    else
    {
      this->Ends.insert(this->Ends.end(), ends, ends + 2);
      this->ToInsert.push_back(isToInsert);
    }
  }
  SharedConstraints shared;
  for (const auto& [a, b, isToInsert] : Join(GatherRecords(job.Group, own)))
  {
    shared[{ a, b }] |= isToInsert != 0;
  }
  for (const auto& [ends, isToInsert] : shared)
  {
    const std::int64_t from = part.FindPoint(ends[0]);
    const std::int64_t to = part.FindPoint(ends[1]);
    if (from >= 0 && to >= 0)
    {
      this->Ends.insert(this->Ends.end(), { from, to });
      this->ToInsert.push_back(isToInsert);
    }
  }
  return shared;
}

/// Inserts what lies in this part, unless an observer of any rank stops it.
void PartConstraints::Insert(const PartJob& job)
{
  const auto insert = [&]()
  {
    try
    {
      this->Insertion = ConstraintInsertion(this->Mesh, job.Options,
        [&](double share) { return !job.Progress || job.Progress(InsertionShare * share); });
    }
    catch (const RunAborted&)
    {
      this->IsAborted = true;
    }
  };
  DoTogether(job.Group, insert);
  this->IsAborted = IsOnAnyRank(job.Group, this->IsAborted);
  if (this->IsAborted)
  {
    this->Insertion = ConstraintInsertion(); // or what other ranks have inserted is dropped
  }
  if (IsOnAnyRank(job.Group, !this->Insertion.GetTried().empty()))
  {
    this->Share = InsertionShare;
  }
}

/// Counts what this rank has inserted and refused, except between shared points.
void PartConstraints::FindFates(const PartMesh& part)
{
  for (const std::int64_t i : this->Insertion.GetTried())
  {
    const PointPair ends{ this->Ends[2 * i], this->Ends[2 * i + 1] };
    if (part.AreShared(ends))
    {
      this->Fates[part.GetKeys(ends)] = Inserted;
    }
    else
    {
      ++this->NumberInserted;
    }
  }
  for (const RefusedConstraint& one : this->Insertion.GetRefused())
  {
    const PointPair ends{ one.Ends[0], one.Ends[1] };
    if (part.AreShared(ends))
    {
      this->Fates[part.GetKeys(ends)] = static_cast<char>(1 + static_cast<int>(one.Why));
    }
    else
    {
      --this->NumberInserted;
      this->Refused.push_back(one);
    }
  }
}

/// @param fates over all ranks.
void PartConstraints::CountShared(const SharedConstraints& shared, const std::vector<char>& fates)
{
  auto next = fates.begin();
  for (const auto& [ends, isToInsert] : shared)
  {
    const char fate = *next++;
    if (fate >= IsEdge)
    {
      this->NumberInserted += fate == Inserted;
    }
    else if (isToInsert && !this->IsAborted)
    {
      this->Refused.push_back(
        { { ends[0], ends[1] }, static_cast<Refusal>(std::max(0, fate - 1)) });
    }
    else
    {
      ++this->Unmatched;
    }
  }
}

void PartConstraints::AddTo(FlipReport& report) const
{
  report.InsertedConstraints += this->NumberInserted;
  report.ConstraintFlips += this->Insertion.GetNumberOfFlips();
  report.UnmatchedConstraints += SizeOf(this->Refused) + this->Unmatched;
  AddDefects(this->Refused, report.Defects);
  AddDefect(Defect(DefectKind::ConstraintsNotEdges, this->Unmatched), report.Defects);
}

}
