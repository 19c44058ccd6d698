// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "QuadSoup.h"

#include "DelaunayFlip.h"

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

FlipOptions GetPartOptions(const PieceSurvey& survey, const FlipOptions& options)
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

QuadSoup::QuadSoup(const PieceSurvey& survey, const FlipOptions& options)
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

}
