// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Hull.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delaunayflip
{

std::vector<BoundaryPart> ListBoundary(
  const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps)
{
  std::vector<BoundaryPart> parts;
  const auto firstSlot = [&](std::size_t gap)
  { return std::int64_t(starts[gap]) + starts[gap + 1] - starts[1]; };
  const auto label = [&](std::int64_t slot) { return LabelDiagonal(starts.back(), slot); };
  parts.push_back({ 0, starts[1] - 1, true, false });
  for (std::size_t gap = 0; gap < gaps.size(); ++gap)
  {
    const std::uint32_t lower = starts[gap + 1] - 1, upper = starts[gap + 2] - 1; // rightmost
    const std::uint32_t run = gaps[gap].RightRun;
    const bool rises = !gaps[gap].RightIsLower;
    const std::uint32_t last = rises ? upper : lower;
    parts.push_back({ last - run + 1, last, rises, rises, rises ? lower : upper,
      label(firstSlot(gap + 1) - run) });
  }
  parts.push_back({ starts[starts.size() - 2], starts.back() - 1, false, false });
  for (std::size_t gap = gaps.size(); gap-- > 0;)
  {
    const std::uint32_t lower = starts[gap], upper = starts[gap + 1]; // leftmost
    const std::uint32_t run = gaps[gap].LeftRun;
    const bool rises = !gaps[gap].LeftIsLower;
    const std::uint32_t first = rises ? upper : lower;
    parts.push_back({ first, first + run - 1, rises, !rises, rises ? lower : upper,
      label(firstSlot(gap) + run) });
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
  const auto add = [&](std::uint32_t place, CornerId label)
  {
    boundary.Places.push_back(place);
    boundary.Labels.push_back(label);
  };
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
    if (part.Other != NoVertex && part.OtherIsFirst)
    {
      add(part.Other, NoCorner);
    }
    chain.front().Label = part.Diagonal;
    for (const LabelledVertex& vertex : chain)
    {
      add(vertex.Vertex, vertex.Label);
    }
    if (part.Other != NoVertex && !part.OtherIsFirst)
    {
      add(part.Other, part.Diagonal);
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
  const auto cut = [&](
                     VertexId left, std::vector<VertexId>& vertices, std::vector<CornerId>& labels)
  {
    EarCutter<double> cutter{ chains, { vertices.data(), labels.data(), 1 },
      static_cast<std::uint32_t>(vertices.size() - 1), left, vertices.back(), labels.back(), true,
      NoCorner, next };
    cutter.Cut();
    next = cutter.Next;
    vertices.resize(cutter.Size);
    vertices.push_back(cutter.Right);
    labels.resize(cutter.Size);
    labels.push_back(cutter.LastLabel);
  };
  std::vector<VertexId> vertices, ofPart;
  std::vector<CornerId> labels, labelsOfPart;
  std::size_t begin = 0;
  for (const std::size_t end : boundary.PartEnds)
  {
    if (begin + 1 < end)
    {
      ofPart.resize(end - begin - 1);
      std::iota(ofPart.begin(), ofPart.end(), static_cast<VertexId>(begin + 1));
      labelsOfPart.assign(&boundary.Labels[begin + 1], boundary.Labels.data() + end);
      cut(static_cast<VertexId>(begin), ofPart, labelsOfPart);
      vertices.insert(vertices.end(), ofPart.begin(), ofPart.end());
      labels.insert(labels.end(), labelsOfPart.begin(), labelsOfPart.end());
    }
    begin = end;
  }
  const auto isLower = [&](std::uint32_t a, std::uint32_t b)
  { return places[a].V != places[b].V ? places[a].V < places[b].V : places[a].U < places[b].U; };
  const auto lowest =
    std::min_element(vertices.begin(), vertices.end(), isLower) - vertices.begin() + 1;
  std::rotate(vertices.begin(), vertices.begin() + lowest, vertices.end());
  std::rotate(labels.begin(), labels.begin() + lowest, labels.end());
  cut(vertices.back(), vertices, labels);
  result.HullEdges = static_cast<std::int64_t>(labels.size());
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
