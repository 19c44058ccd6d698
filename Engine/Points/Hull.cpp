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

/// A path: vertices, and the labels of the edges after them.
struct LabelledPath
{
  std::vector<std::uint32_t> Vertices, Labels;
};

/// Cuts ears off paths. Vertices are numbers of the boundary's places.
class HullFiller
{
public:
  HullFiller(const Boundary& boundary, const std::vector<CoordinatePair<double>>& places)
    : FirstLabel(static_cast<std::uint32_t>(4 * places.size())),
      Open{ FirstLabel, boundary, this->Result },
      Stored(places.size())
  {
    this->Result.Triangles.resize(places.size());
    this->Chains.Places = places.data();
    this->Chains.Triangles = this->Result.Triangles.data();
    this->Chains.Failed = &this->Failed;
  }

  /// The boundary after each of its parts has been filled alone.
  LabelledPath CutParts(const Boundary& boundary)
  {
    LabelledPath whole;
    std::uint32_t begin = 0;
    for (const std::size_t partEnd : boundary.PartEnds)
    {
      const auto end = static_cast<std::uint32_t>(partEnd);
      for (std::uint32_t i = begin; i + 2 < end; ++i)
      {
        this->Stored[i - begin].InputTriangle = i + 1;
        this->Stored[i - begin].Flips = this->FirstLabel + i;
      }
      if (begin + 1 < end)
      {
        this->Cut(begin, end - begin - 2, end - 1, this->FirstLabel + end - 2, whole);
      }
      begin = end;
    }
    return whole;
  }

  /// Cuts all of a closed path but its hull.
  LabelledPath CutClosed(const LabelledPath& path)
  {
    const auto inner = static_cast<std::uint32_t>(path.Vertices.size() - 1);
    for (std::uint32_t i = 0; i < inner; ++i)
    {
      this->Stored[i].InputTriangle = path.Vertices[i + 1];
      this->Stored[i].Flips = path.Labels[i];
    }
    LabelledPath hull;
    this->Cut(path.Vertices[0], inner, path.Vertices[0], path.Labels[inner], hull);
    return hull;
  }

  /// The triangles, when all is cut but the hull.
  HullTriangles Finish(
    const LabelledPath& hull, const Boundary& boundary, std::int64_t firstTriangle)
  {
    this->Result.HullEdges = static_cast<std::int64_t>(hull.Labels.size());
    for (const std::uint32_t label : hull.Labels)
    {
      if (!this->Open.IsOpen(label))
      {
        this->Chains.Join(label, NoCorner);
      }
    }
    this->Result.Triangles.resize(this->Next);
    const auto firstCorner = static_cast<CornerId>(4 * firstTriangle);
    for (TriangleRecord& triangle : this->Result.Triangles)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        triangle.Vertices[slot] = boundary.Places[triangle.Vertices[slot]];
        triangle.HalfEdges[slot] += triangle.HalfEdges[slot] == NoCorner ? 0 : firstCorner;
      }
    }
    for (CornerId& corner : this->Result.Corners)
    {
      corner += firstCorner;
    }
    return std::move(this->Result);
  }

private:
  /// Cuts the path from `left` through the `inner` first vertices of Stored to `right`, and adds
  /// what is left of it, without `right`, to a path.
  /// @param lastLabel that of the edge to `right`; those before are in Stored.
  void Cut(std::uint32_t left, std::uint32_t inner, std::uint32_t right, std::uint32_t lastLabel,
    LabelledPath& to)
  {
    EarCutter<double, BoundaryEdges> cutter{ this->Chains, this->Stored.data(), inner, left, right,
      lastLabel, 1, this->Next, this->Open };
    cutter.Cut();
    this->Next = cutter.Next;
    to.Vertices.push_back(left);
    for (std::uint32_t i = 0; i < cutter.Size; ++i)
    {
      to.Vertices.push_back(this->Stored[i].InputTriangle);
      to.Labels.push_back(this->Stored[i].Flips);
    }
    to.Labels.push_back(cutter.LastLabel);
  }

  HullTriangles Result;
  const std::uint32_t FirstLabel; ///< Of the boundary's edges, above those of all corners.
  const BoundaryEdges Open;
  std::vector<TriangleRecord> Stored; ///< The path that is cut.
  ChainView<double> Chains{};
  std::int32_t Failed = 0; ///< Never on the host.
  TriangleId Next = 0;
};
}

HullTriangles FillHull(const Boundary& boundary, const std::vector<CoordinatePair<double>>& places,
  std::int64_t firstTriangle)
{
  HullFiller filler(boundary, places);
  LabelledPath whole = filler.CutParts(boundary);
  const auto isLower = [&](std::uint32_t a, std::uint32_t b)
  { return places[a].V != places[b].V ? places[a].V < places[b].V : places[a].U < places[b].U; };
  const auto lowest = std::min_element(whole.Vertices.begin(), whole.Vertices.end(), isLower) -
    whole.Vertices.begin();
  std::rotate(whole.Vertices.begin(), whole.Vertices.begin() + lowest, whole.Vertices.end());
  std::rotate(whole.Labels.begin(), whole.Labels.begin() + lowest, whole.Labels.end());
  return filler.Finish(filler.CutClosed(whole), boundary, firstTriangle);
}

}
