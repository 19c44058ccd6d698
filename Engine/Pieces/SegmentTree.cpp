// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentTree.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{

namespace
{
/// Half of a segment's extent along the longer axis, so that it does not overflow.
double GetHalfLength(const SegmentTree::Segment& segment)
{
  return std::max(
    std::abs(segment[0].U / 2 - segment[1].U / 2), std::abs(segment[0].V / 2 - segment[1].V / 2));
}

bool IsFinite(const SegmentTree::Segment& segment)
{
  return std::isfinite(segment[0].U) && std::isfinite(segment[0].V) &&
    std::isfinite(segment[1].U) && std::isfinite(segment[1].V);
}

/// Approximately the point at a share of a segment's length.
PlanePoint GetPointAt(const SegmentTree::Segment& segment, double share)
{
  return { segment[0].U * (1 - share) + segment[1].U * share,
    segment[0].V * (1 - share) + segment[1].V * share, 0.0 };
}

/// More than the rounding errors of GetPointAt.
double GetMargin(const SegmentTree::Segment& segment)
{
  double largest = 0.0;
  for (const PlanePoint& end : segment)
  {
    largest = std::max({ largest, std::abs(end.U), std::abs(end.V) });
  }
  return 8 * std::numeric_limits<double>::epsilon() * largest +
    8 * std::numeric_limits<double>::denorm_min();
}

/// Whether the line through the segment, or through a side of the triangle, separates the two.
bool AreSeparate(const SegmentTree::Segment& segment, const SegmentTree::Triangle& triangle)
{
  int sides[3];
  for (int i = 0; i < 3; ++i)
  {
    sides[i] = FindOrientation(segment[0], segment[1], triangle[i]);
  }
  bool separate = sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
  const int turn = FindOrientation(triangle[0], triangle[1], triangle[2]);
  for (int i = 0; i < 3 && !separate; ++i)
  {
    const PlanePoint& from = triangle[i];
    const PlanePoint& to = triangle[(i + 1) % 3];
    separate = turn * FindOrientation(from, to, segment[0]) < 0 &&
      turn * FindOrientation(from, to, segment[1]) < 0;
  }
  return separate;
}
}

SegmentTree::Box SegmentTree::Box::Of(const PlanePoint* points, int count)
{
  Box box{ points[0].U, points[0].U, points[0].V, points[0].V };
  for (int i = 1; i < count; ++i)
  {
    box.Add({ points[i].U, points[i].U, points[i].V, points[i].V });
  }
  return box;
}

void SegmentTree::Box::Add(const Box& other)
{
  this->LowerU = std::min(this->LowerU, other.LowerU);
  this->UpperU = std::max(this->UpperU, other.UpperU);
  this->LowerV = std::min(this->LowerV, other.LowerV);
  this->UpperV = std::max(this->UpperV, other.UpperV);
}

bool SegmentTree::Box::Meets(const Box& other) const
{
  return this->LowerU <= other.UpperU && other.LowerU <= this->UpperU &&
    this->LowerV <= other.UpperV && other.LowerV <= this->UpperV;
}

//------------------------------------------------------------------------------
SegmentTree::SegmentTree(const std::vector<Segment>& segments)
  : Segments(segments)
{
  double length = 0.0;
  for (const Segment& segment : segments)
  {
    length += IsFinite(segment) ? GetHalfLength(segment) : 0.0;
  }
  constexpr double PartsPerSegment = 8.0; // on average
  constexpr double MostParts = 1024.0;
  const double density = PartsPerSegment * static_cast<double>(segments.size()) / length;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    if (IsFinite(segments[i]))
    {
      const double parts = GetHalfLength(segments[i]) * density; // may be NaN
      this->AddParts(static_cast<std::int32_t>(i),
        parts > 1.0 ? static_cast<int>(std::min(parts, MostParts)) : 1);
    }
  }
  if (!this->Parts.empty())
  {
    this->MakeNodes({ 1, 0, this->Parts.size() });
  }
}

void SegmentTree::AddParts(std::int32_t index, int count)
{
  const Segment& segment = this->Segments[index];
  const double margin = GetMargin(segment);
  for (int i = 0; i < count; ++i)
  {
    const PlanePoint ends[2] = { GetPointAt(segment, static_cast<double>(i) / count),
      GetPointAt(segment, static_cast<double>(i + 1) / count) };
    Box box = Box::Of(ends, 2);
    box = { box.LowerU - margin, box.UpperU + margin, box.LowerV - margin, box.UpperV + margin };
    this->Parts.push_back({ box, index });
  }
}

void SegmentTree::MakeNodes(const NodeRange& range)
{
  Box bounds = this->Parts[range.Begin].Bounds;
  for (std::size_t i = range.Begin; i < range.End; ++i)
  {
    bounds.Add(this->Parts[i].Bounds);
  }
  if (range.Index >= this->Nodes.size())
  {
    this->Nodes.resize(std::max(range.Index + 1, 2 * this->Nodes.size()));
  }
  this->Nodes[range.Index] = bounds;
  if (range.IsLeaf())
  {
    return;
  }
  const bool isWide = bounds.UpperU / 2 - bounds.LowerU / 2 > bounds.UpperV / 2 - bounds.LowerV / 2;
  const auto place = [=](const Part& part)
  { return isWide ? part.Bounds.LowerU : part.Bounds.LowerV; };
  const auto at = [this](std::size_t i)
  { return this->Parts.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.Begin), at(range.GetMiddle()), at(range.End),
    [&](const Part& a, const Part& b) { return place(a) < place(b); });
  this->MakeNodes(range.GetLeft());
  this->MakeNodes(range.GetRight());
}

void SegmentTree::Search(
  const NodeRange& range, const Box& bounds, std::vector<std::int32_t>& near) const
{
  if (!this->Nodes[range.Index].Meets(bounds))
  {
    return;
  }
  if (!range.IsLeaf())
  {
    this->Search(range.GetLeft(), bounds, near);
    this->Search(range.GetRight(), bounds, near);
    return;
  }
  for (std::size_t i = range.Begin; i < range.End; ++i)
  {
    if (this->Parts[i].Bounds.Meets(bounds))
    {
      near.push_back(this->Parts[i].Segment);
    }
  }
}

void SegmentTree::FindTouched(const Triangle& triangle, std::vector<std::int32_t>& touched) const
{
  touched.clear();
  if (this->Parts.empty())
  {
    return;
  }
  this->Search({ 1, 0, this->Parts.size() }, Box::Of(triangle.data(), 3), touched);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  const auto isApart = [&](std::int32_t segment)
  { return AreSeparate(this->Segments[segment], triangle); };
  touched.erase(std::remove_if(touched.begin(), touched.end(), isApart), touched.end());
}

}
