// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Hull.h"

#include <algorithm>
#include <tuple>

namespace delaunayflip
{

namespace
{
/// The first slot of a gap, counted through all gaps.
std::int64_t FindFirstSlot(const std::vector<std::uint32_t>& starts, std::size_t gap)
{
  return std::int64_t(starts[gap]) + starts[gap + 1] - starts[1];
}

/// The section at the left end of a gap.
BoundarySection MakeLeftSection(
  const std::vector<std::uint32_t>& starts, std::size_t gap, const Gap& measured)
{
  const std::uint32_t lower = starts[gap];
  const std::uint32_t upper = starts[gap + 1];
  const std::uint32_t run = measured.LeftRun;
  const CornerId diagonal = LabelDiagonal(starts.back(), FindFirstSlot(starts, gap) + run);
  if (measured.LeftIsLower)
  {
    return { lower, lower + run - 1, false, true, upper, diagonal };
  }
  return { upper, upper + run - 1, true, false, lower, diagonal };
}

/// The section at the right end of a gap.
BoundarySection MakeRightSection(
  const std::vector<std::uint32_t>& starts, std::size_t gap, const Gap& measured)
{
  const std::uint32_t lower = starts[gap + 1] - 1;
  const std::uint32_t upper = starts[gap + 2] - 1;
  const std::uint32_t run = measured.RightRun;
  const CornerId diagonal = LabelDiagonal(starts.back(), FindFirstSlot(starts, gap + 1) - run);
  if (measured.RightIsLower)
  {
    return { lower - run + 1, lower, false, false, upper, diagonal };
  }
  return { upper - run + 1, upper, true, true, lower, diagonal };
}
}

std::vector<BoundarySection> ListBoundary(
  const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps)
{
  std::vector<BoundarySection> sections;
  sections.push_back({ 0, starts[1] - 1, true, false });
  for (std::size_t gap = 0; gap < gaps.size(); ++gap)
  {
    sections.push_back(MakeRightSection(starts, gap, gaps[gap]));
  }
  sections.push_back({ starts[starts.size() - 2], starts.back() - 1, false, false });
  for (std::size_t gap = gaps.size(); gap-- > 0;)
  {
    sections.push_back(MakeLeftSection(starts, gap, gaps[gap]));
  }
  return sections;
}

std::vector<BoundaryStretch> CutIntoStretches(const std::vector<BoundarySection>& sections)
{
  constexpr std::uint32_t LongestStretch = 256; // one thread of a GPU takes about a millisecond
  std::vector<BoundaryStretch> stretches;
  std::uint32_t begin = 0;
  for (const BoundarySection& section : sections)
  {
    for (std::uint32_t first = section.First; first < section.Last; first += LongestStretch)
    {
      const std::uint32_t size = std::min(section.Last - first, LongestStretch) + 1;
      stretches.push_back({ first, size, section.Rises, begin, 0, NoCorner });
      begin += size - 2;
    }
  }
  return stretches;
}

Boundary JoinStretches(
  const std::vector<BoundarySection>& sections, const std::vector<LabelledVertex>& left)
{
  Boundary boundary;
  auto next = left.begin();
  std::vector<LabelledVertex> chain;
  for (const BoundarySection& section : sections)
  {
    chain = { { section.First, NoCorner } };
    while (chain.back().Vertex != section.Last)
    {
      chain.push_back(*next++);
    }
    if (!section.Rises)
    {
      std::reverse(chain.begin(), chain.end());
      for (std::size_t i = chain.size() - 1; i > 0; --i)
      {
        chain[i].Label = chain[i - 1].Label; // now it comes before the other end of its edge
      }
    }
    chain.front().Label = section.Diagonal; // only used if the other place comes before it
    if (section.Other != NoVertex)
    {
      const auto where = section.OtherIsFirst ? chain.begin() : chain.end();
      chain.insert(where, { section.Other, section.Diagonal });
    }
    for (const LabelledVertex& vertex : chain)
    {
      boundary.Places.push_back(vertex.Vertex);
      boundary.Labels.push_back(vertex.Label);
    }
    boundary.SectionEnds.push_back(boundary.Places.size());
  }
  return boundary;
}

HullTriangles FillHull(const Boundary& boundary, const std::vector<CoordinatePair<double>>& places,
  TriangleId firstTriangle)
{
  // Vertices are numbers of the boundary's places at first.
  HullTriangles result{ std::vector<TriangleRecord>(places.size()) };
  std::int32_t failed = 0; // stays so on the host
  const ChainView<double> chains{ places.data(), nullptr, 0, 0, nullptr, result.Triangles.data(),
    firstTriangle, nullptr, &failed };
  TriangleId next = firstTriangle;
  // Cuts a path that leads from `left` through all other vertices, and keeps what is left of it.
  const auto cut = [&](VertexId left, std::vector<LabelledVertex>& path)
  {
    EarCutter<double> cutter{ chains, PathList(path.data()),
      static_cast<std::uint32_t>(path.size() - 1), left, path.back().Vertex, path.back().Label,
      true, NoCorner, next };
    cutter.Cut();
    next = cutter.Next;
    path.resize(cutter.Size);
    path.push_back({ cutter.Right, cutter.LastLabel });
  };
  std::vector<LabelledVertex> whole, section;
  std::size_t begin = 0;
  for (const std::size_t end : boundary.SectionEnds)
  {
    section.clear();
    for (std::size_t i = begin + 1; i < end; ++i)
    {
      section.push_back({ static_cast<VertexId>(i), boundary.Labels[i] });
    }
    if (!section.empty())
    {
      cut(static_cast<VertexId>(begin), section);
      whole.insert(whole.end(), section.begin(), section.end());
    }
    begin = end;
  }
  const auto isLower = [&](const LabelledVertex& first, const LabelledVertex& second)
  {
    const CoordinatePair<double>&a = places[first.Vertex], &b = places[second.Vertex];
    return std::tie(a.V, a.U) < std::tie(b.V, b.U);
  };
  std::rotate(
    whole.begin(), std::min_element(whole.begin(), whole.end(), isLower) + 1, whole.end());
  cut(whole.back().Vertex, whole);
  result.HullEdges = static_cast<std::int64_t>(whole.size());
  result.Triangles.resize(next - firstTriangle);
  for (TriangleRecord& triangle : result.Triangles)
  {
    for (VertexId& vertex : triangle.Vertices)
    {
      vertex = boundary.Places[vertex];
    }
  }
  return result;
}

}
