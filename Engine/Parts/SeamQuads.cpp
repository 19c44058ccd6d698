// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamQuads.h"

#include "DelaunayFlip.h"
#include "FlipLoopChoice.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

void PointList::Reserve(std::int64_t size)
{
  this->IsFloat ? this->Floats.reserve(3 * size) : this->Doubles.reserve(3 * size);
}

void PointList::Add(const double (&x)[3])
{
  if (this->IsFloat)
  {
    const float point[3] = { static_cast<float>(x[0]), static_cast<float>(x[1]),
      static_cast<float>(x[2]) };
    this->Floats.insert(this->Floats.end(), point, point + 3);
  }
  else
  {
    this->Doubles.insert(this->Doubles.end(), x, x + 3);
  }
}

std::int64_t PointList::GetSize() const
{
  return static_cast<std::int64_t>(this->IsFloat ? this->Floats.size() : this->Doubles.size()) / 3;
}

PointArray PointList::View() const
{
  return this->IsFloat ? PointArray(this->Floats.data(), this->GetSize())
                       : PointArray(this->Doubles.data(), this->GetSize());
}

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

QuadSoup::QuadSoup(const PartSurvey& survey, const FlipOptions& options)
  : Options(GetPartOptions(survey, options)),
    Whole(survey.Whole),
    Points(survey.IsFloat)
{
  this->Options.FeatureAngle = options.FeatureAngle;
}

void QuadSoup::Add(const SeamSide& one, const SeamSide& other)
{
  const std::int64_t first = this->Points.GetSize();
  this->Points.Add(one.Ends[0]);
  this->Points.Add(one.Ends[1]);
  for (const SeamSide* side : { &one, &other })
  {
    const std::int64_t opposite = this->Points.GetSize();
    this->Points.Add(side->Opposite);
    this->Triangles.push_back(first + (side->RunsForward ? 0 : 1));
    this->Triangles.push_back(first + (side->RunsForward ? 1 : 0));
    this->Triangles.push_back(opposite);
    this->Regions.push_back(side->Region);
    this->Frozen.push_back(side->IsFrozen ? 1 : 0);
  }
}

TriangleMesh QuadSoup::View() const
{
  TriangleMesh mesh;
  mesh.Points = this->Points.View();
  mesh.Triangles =
    TriangleArray(this->Triangles.data(), static_cast<std::int64_t>(this->Triangles.size()) / 3);
  mesh.Regions = this->Regions.data();
  mesh.FrozenTriangles = this->Frozen.data();
  mesh.Whole = this->Whole;
  return mesh;
}

std::vector<unsigned char> QuadSoup::FindFixed(EdgeCounts& counts) const
{
  std::vector<unsigned char> fixed(this->GetSize());
  if (fixed.empty())
  {
    return fixed;
  }
  const std::vector<std::int64_t> pairs = FindFixedEdges(this->View(), this->Options);
  for (std::size_t i = 0; i < pairs.size(); i += 2)
  {
    fixed[pairs[i] / 4] = 1;
  }
  FlipOptions none = this->Options;
  none.MaximumIterations = 0;
  const FlipSession session(this->View(), none);
  const EdgeCounts& found = session.GetReport().Edges;
  counts.Edges += this->GetSize();
  counts.WronglyWound += found.WronglyWound;
  counts.Feature += found.Feature;
  counts.Region += found.Region;
  counts.Fixed += static_cast<std::int64_t>(pairs.size()) / 2;
  return fixed;
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

std::vector<RankedTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists)
{
  std::vector<RankedTriangle> all;
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const SeamTriangle& seam : lists[rank])
    {
      all.push_back({ seam.Ends, static_cast<int>(rank), &seam });
    }
  }
  std::sort(all.begin(), all.end(),
    [](const RankedTriangle& a, const RankedTriangle& b)
    { return IsBefore(a, b) || (!IsBefore(b, a) && a.Seam->Corner < b.Seam->Corner); });
  return all;
}

//------------------------------------------------------------------------------
namespace
{
/// What the engine knows of a mesh when it chooses a rule.
MeshSurvey DescribeMesh(const PartSurvey& survey)
{
  MeshSurvey mesh;
  mesh.Geometry = survey.Geometry;
  mesh.Projection = survey.Projection;
  mesh.Precision = survey.IsFloat ? FloatPrecision : DoublePrecision;
  return mesh;
}

/// @param rule for the points 0 to 3.
template <typename Rule>
EdgeState Decide(const Rule& rule)
{
  const Quad quad{ 0, 0, 0, 1, 2, 3 };
  const EdgeState state = rule.Judge(quad);
  return state == EdgeState::Uncertain ? rule.JudgeExactly(quad) : state;
}
}

QuadJudge::QuadJudge(const PartSurvey& survey, const FlipOptions& options)
  : Plan(PlanPacking(DescribeMesh(survey), options.Criterion, false)),
    Criterion(options.Criterion),
    IsSurface(survey.Geometry == GeometryKind::Surface),
    Canonical(options.TieRule == TieRuleKind::Canonical),
    FiltersApply(survey.FiltersApply),
    Tolerance(GetTolerance(options, DescribeMesh(survey))),
    Range(survey.Range)
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
  if (this->IsSurface)
  {
    return Decide(SurfaceRule<double>{ { packed, this->Tolerance, this->Range } });
  }
  if (this->Criterion == CriterionKind::OppositeAngles)
  {
    return Decide(PlanarAngleRule{ { packed, this->Tolerance, this->Range } });
  }
  return components == 3
    ? Decide(PlanarRule<double, 3>{ packed, 0, this->Canonical, this->FiltersApply })
    : Decide(PlanarRule<double, 2>{ packed, 0, this->Canonical, this->FiltersApply });
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

}
