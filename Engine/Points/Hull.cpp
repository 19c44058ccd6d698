// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Hull.h"

#include <algorithm>
#include <iterator>

namespace delaunayflip
{

Boundary ListBoundary(const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps)
{
  Boundary boundary;
  const auto add = [&](std::uint32_t place, SideWord sideAfter)
  {
    boundary.Places.push_back(place);
    boundary.SideAfter.push_back(sideAfter);
  };
  const auto endPart = [&](std::uint32_t place)
  {
    add(place, 0);
    boundary.PartEnds.push_back(boundary.Places.size());
  };
  // The edges of the places first .. last of a chain, without its last place.
  const auto rise = [&](std::uint32_t first, std::uint32_t last, int side)
  {
    for (std::uint32_t place = first; place < last; ++place)
    {
      add(place, 2 * SideWord(place + 1) + side);
    }
  };
  const auto fall = [&](std::uint32_t first, std::uint32_t last, int side)
  {
    for (std::uint32_t place = last; place > first; --place)
    {
      add(place, 2 * SideWord(place) + side);
    }
  };
  const auto firstSlot = [&](std::size_t gap)
  { return SideWord(starts[gap]) + starts[gap + 1] - starts[1]; };

  rise(0, starts[1] - 1, 0);
  endPart(starts[1] - 1);
  for (std::size_t gap = 0; gap < gaps.size(); ++gap)
  {
    const std::uint32_t lower = starts[gap + 1] - 1, upper = starts[gap + 2] - 1; // rightmost
    const std::uint32_t run = gaps[gap].RightRun;
    const SideWord diagonal = ~(2 * (firstSlot(gap + 1) + starts[0] - run) + 1);
    if (gaps[gap].RightIsLower)
    {
      fall(lower - run + 1, lower, 1);
      add(lower - run + 1, diagonal);
    }
    else
    {
      add(lower, diagonal);
      rise(upper - run + 1, upper, 0);
    }
    endPart(upper);
  }
  const std::uint32_t highest = starts[starts.size() - 2], end = starts.back() - 1;
  fall(highest, end, 1);
  endPart(highest);
  for (std::size_t gap = gaps.size(); gap-- > 0;)
  {
    const std::uint32_t lower = starts[gap], upper = starts[gap + 1]; // leftmost
    const std::uint32_t run = gaps[gap].LeftRun;
    const SideWord diagonal = ~(2 * (firstSlot(gap) + run));
    if (gaps[gap].LeftIsLower)
    {
      add(upper, diagonal);
      fall(lower, lower + run - 1, 1);
    }
    else
    {
      rise(upper, upper + run - 1, 0);
      add(upper + run - 1, diagonal);
    }
    endPart(lower);
  }
  return boundary;
}

namespace
{
/// Open edges of the boundary have labels above those of all corners.
struct BoundaryEdges
{
  std::uint32_t FirstLabel;
  const Boundary& Path;
  HullTriangles& Result;

  bool IsOpen(std::uint32_t label) const { return label >= this->FirstLabel; }
  void operator()(std::uint32_t label, VertexId, VertexId, CornerId corner) const
  {
    this->Result.Sides.push_back(this->Path.SideAfter[label - this->FirstLabel]);
    this->Result.Corners.push_back(corner);
  }
};

/// A closed path: vertices, and the labels of the edges after them.
struct LabelledPath
{
  std::vector<std::uint32_t> Vertices, Labels;
};
}

HullTriangles FillHull(const Boundary& boundary, const std::vector<CoordinatePair<double>>& places,
  std::int64_t firstTriangle)
{
  HullTriangles result;
  const std::size_t size = places.size();
  result.Triangles.resize(size);
  std::vector<TriangleRecord> stored(size);
  const auto firstLabel = static_cast<std::uint32_t>(4 * size);
  std::int32_t failed = 0;
  ChainView<double> chains{};
  chains.Places = places.data();
  chains.Triangles = result.Triangles.data();
  chains.Failed = &failed;
  TriangleId next = 0;
  const BoundaryEdges open{ firstLabel, boundary, result };
  LabelledPath whole;

  // Cuts ears along a path that begins with `path`'s first vertex and ends at `right`.
  const auto fill = [&](const LabelledPath& path, std::uint32_t right)
  {
    const auto inner = static_cast<std::uint32_t>(path.Vertices.size() - 1);
    for (std::uint32_t i = 0; i < inner; ++i)
    {
      stored[i].InputTriangle = path.Vertices[i + 1];
      stored[i].Flips = path.Labels[i];
    }
    EarCutter<double, BoundaryEdges> cutter{ chains, stored.data(), inner, path.Vertices[0], right,
      path.Labels[inner], 1, next, open };
    cutter.Cut();
    next = cutter.Next;
    LabelledPath left;
    left.Vertices.push_back(path.Vertices[0]);
    for (std::uint32_t i = 0; i < cutter.Size; ++i)
    {
      left.Vertices.push_back(stored[i].InputTriangle);
      left.Labels.push_back(stored[i].Flips);
    }
    left.Labels.push_back(cutter.LastLabel);
    return left;
  };

  std::size_t begin = 0;
  for (const std::size_t end : boundary.PartEnds)
  {
    if (end - begin > 1)
    {
      LabelledPath part;
      for (std::size_t i = begin; i + 1 < end; ++i)
      {
        part.Vertices.push_back(static_cast<std::uint32_t>(i));
        part.Labels.push_back(firstLabel + static_cast<std::uint32_t>(i));
      }
      const LabelledPath filled = fill(part, static_cast<std::uint32_t>(end - 1));
      whole.Vertices.insert(whole.Vertices.end(), filled.Vertices.begin(), filled.Vertices.end());
      whole.Labels.insert(whole.Labels.end(), filled.Labels.begin(), filled.Labels.end());
    }
    begin = end;
  }
  const auto isLower = [&](std::uint32_t a, std::uint32_t b)
  { return places[a].V != places[b].V ? places[a].V < places[b].V : places[a].U < places[b].U; };
  const auto lowest = std::min_element(whole.Vertices.begin(), whole.Vertices.end(), isLower) -
    whole.Vertices.begin();
  std::rotate(whole.Vertices.begin(), whole.Vertices.begin() + lowest, whole.Vertices.end());
  std::rotate(whole.Labels.begin(), whole.Labels.begin() + lowest, whole.Labels.end());
  const LabelledPath hull = fill(whole, whole.Vertices[0]);

  result.HullEdges = static_cast<std::int64_t>(hull.Labels.size());
  for (const std::uint32_t label : hull.Labels)
  {
    if (label < firstLabel)
    {
      chains.Join(label, NoCorner);
    }
  }
  result.Triangles.resize(next);
  const auto firstCorner = static_cast<CornerId>(4 * firstTriangle);
  for (TriangleRecord& triangle : result.Triangles)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      triangle.Vertices[slot] = boundary.Places[triangle.Vertices[slot]];
      triangle.HalfEdges[slot] += triangle.HalfEdges[slot] == NoCorner ? 0 : firstCorner;
    }
  }
  for (CornerId& corner : result.Corners)
  {
    corner += firstCorner;
  }
  return result;
}

}
