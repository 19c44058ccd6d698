// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Hull.h"

#include <algorithm>

namespace delaunayflip
{

std::vector<BoundaryPart> ListBoundary(
  const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps)
{
  std::vector<BoundaryPart> parts;
  const auto firstSlot = [&](std::size_t gap)
  { return std::int64_t(starts[gap]) + starts[gap + 1] - starts[1]; };
  const auto addEnd = [&](std::size_t gap, bool isRight)
  {
    const std::uint32_t run = isRight ? gaps[gap].RightRun : gaps[gap].LeftRun;
    const bool rises = isRight ? !gaps[gap].RightIsLower : !gaps[gap].LeftIsLower;
    // The outermost places of the two chains.
    const std::uint32_t lower = isRight ? starts[gap + 1] - 1 : starts[gap];
    const std::uint32_t upper = isRight ? starts[gap + 2] - 1 : starts[gap + 1];
    const std::uint32_t own = rises ? upper : lower;
    const std::int64_t slot = isRight ? firstSlot(gap + 1) - run : firstSlot(gap) + run;
    parts.push_back({ isRight ? own - run + 1 : own, isRight ? own : own + run - 1, rises,
      rises == isRight, rises ? lower : upper, LabelDiagonal(starts.back(), slot) });
  };
  parts.push_back({ 0, starts[1] - 1, true, false });
  for (std::size_t gap = 0; gap < gaps.size(); ++gap)
  {
    addEnd(gap, true);
  }
  parts.push_back({ starts[starts.size() - 2], starts.back() - 1, false, false });
  for (std::size_t gap = gaps.size(); gap-- > 0;)
  {
    addEnd(gap, false);
  }
  return parts;
}

std::vector<BoundaryPiece> CutIntoPieces(const std::vector<BoundaryPart>& parts)
{
  constexpr std::uint32_t LongestPiece = 256; // one thread of a GPU takes about a millisecond
  std::vector<BoundaryPiece> pieces;
  std::uint32_t begin = 0;
  for (const BoundaryPart& part : parts)
  {
    for (std::uint32_t first = part.First; first < part.Last; first += LongestPiece)
    {
      const std::uint32_t size = std::min(part.Last - first, LongestPiece) + 1;
      pieces.push_back({ first, size, part.Rises, begin, 0, NoCorner });
      begin += size - 2;
    }
  }
  return pieces;
}

Boundary JoinPieces(const std::vector<BoundaryPart>& parts, const std::vector<LabelledVertex>& left)
{
  Boundary boundary;
  auto next = left.begin();
  std::vector<LabelledVertex> chain;
  for (const BoundaryPart& part : parts)
  {
    chain = { { part.First, NoCorner } };
    while (chain.back().Vertex != part.Last)
    {
      chain.push_back(*next++);
    }
    if (!part.Rises)
    {
      std::reverse(chain.begin(), chain.end());
      for (std::size_t i = chain.size() - 1; i > 0; --i)
      {
        chain[i].Label = chain[i - 1].Label; // now it comes before the other end of its edge
      }
    }
    chain.front().Label = part.Diagonal; // only used if the other place comes before it
    if (part.Other != NoVertex)
    {
      chain.insert(part.OtherIsFirst ? chain.begin() : chain.end(), { part.Other, part.Diagonal });
    }
    for (const LabelledVertex& vertex : chain)
    {
      boundary.Places.push_back(vertex.Vertex);
      boundary.Labels.push_back(vertex.Label);
    }
    boundary.PartEnds.push_back(boundary.Places.size());
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
    EarCutter<double> cutter{ chains, { &path.front().Vertex, &path.front().Label, 2 },
      static_cast<std::uint32_t>(path.size() - 1), left, path.back().Vertex, path.back().Label,
      true, NoCorner, next };
    cutter.Cut();
    next = cutter.Next;
    path.resize(cutter.Size);
    path.push_back({ cutter.Right, cutter.LastLabel });
  };
  std::vector<LabelledVertex> whole, part;
  std::size_t begin = 0;
  for (const std::size_t end : boundary.PartEnds)
  {
    part.clear();
    for (std::size_t i = begin + 1; i < end; ++i)
    {
      part.push_back({ static_cast<VertexId>(i), boundary.Labels[i] });
    }
    if (!part.empty())
    {
      cut(static_cast<VertexId>(begin), part);
      whole.insert(whole.end(), part.begin(), part.end());
    }
    begin = end;
  }
  const auto isLower = [&](const LabelledVertex& first, const LabelledVertex& second)
  {
    const CoordinatePair<double>&a = places[first.Vertex], &b = places[second.Vertex];
    return a.V != b.V ? a.V < b.V : a.U < b.U;
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
