// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RefusedSegments.h"

#include "ExactPredicates.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
PlanePoint GetPlace(const PlaneArray& points, std::int64_t id)
{
  return { points.Get(id, 0), points.Get(id, 1), 0.0 };
}

/// Whether the points c and d lie on different sides of the line through a and b.
bool AreApart(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  return FindOrientation(a, b, c) * FindOrientation(a, b, d) < 0;
}
}

const char* GetRemedy(bool wereSplit)
{
  return wereSplit ? ", even after splitting"
                   : ": with SplitCrossings both get a point where they cross";
}

std::uint32_t FindCrossed(const PointMeshView& mesh, const PlaneArray& points,
  const std::vector<SegmentEdge>& edges, const RefusedSegment& refused)
{
  const PlanePoint from = GetPlace(points, refused.Refused.From);
  const PlanePoint to = GetPlace(points, refused.Refused.To);
  const auto found = std::find_if(edges.begin(), edges.end(),
    [&](const SegmentEdge& edge)
    {
      const PlanePoint start = GetPlace(points, mesh.Ids[mesh.GetStart(edge.Side)]);
      const PlanePoint end = GetPlace(points, mesh.Ids[mesh.GetEnd(edge.Side)]);
      return AreApart(from, to, start, end) && AreApart(start, end, from, to);
    });
  return found == edges.end() ? refused.Index : found->Segment;
}

void AddDefects(const std::vector<RefusedSegment>& refused, const std::int64_t* ends,
  const char* remedy, std::vector<Defect>& defects)
{
  constexpr DefectKind reasons[] = { DefectKind::SegmentsCross, DefectKind::SegmentsNotFinite,
    DefectKind::SegmentsWithoutTriangles, DefectKind::SegmentsInside, DefectKind::SegmentsRemoved };
  for (const RefusalKind why : { RefusalKind::CrossesEarlier, RefusalKind::NotFinite,
         RefusalKind::Removed, RefusalKind::NoTriangulation, RefusalKind::EndInside })
  {
    Defect defect(reasons[static_cast<int>(why)]);
    for (const RefusedSegment& one : refused)
    {
      if (one.Why == why && defect.Count++ < MostNamedIds)
      {
        const std::int64_t* pair = ends + 2 * one.Refused.Number;
        defect.FirstIds.insert(defect.FirstIds.end(), pair, pair + 2);
        defect.Crossed.push_back(one.Crossed);
      }
    }
    if (why == RefusalKind::CrossesEarlier)
    {
      defect.Detail = remedy;
    }
    else
    {
      defect.Crossed.clear();
    }
    AddDefect(defect, defects);
  }
}

std::string DescribeRefusal(
  const RefusedSegment& ofRing, const std::int64_t* ends, const char* remedy)
{
  const std::int64_t* pair = ends + 2 * ofRing.Refused.Number;
  const std::string which = "the segment of ring " + std::to_string(ofRing.Refused.Ring) +
    " from point " + std::to_string(pair[0]) + " to point " + std::to_string(pair[1]);
  switch (ofRing.Why)
  {
    case RefusalKind::CrossesEarlier:
      return which + " " + DescribeCrossed(ofRing.Crossed, DefectKind::SegmentsCross) + remedy;
    case RefusalKind::NotFinite:
      return which + " cannot be inserted: a coordinate of an end is NaN or infinite";
    case RefusalKind::Removed:
      return which + " cannot be inserted: an end was removed";
    case RefusalKind::EndInside:
      return which +
        " cannot be inserted: an end has no triangle, because it is inside of the convex hull of "
        "the others (it is not on the sphere, or rounding has put it inside) or, on an open "
        "sphere, only triangles that are left out have it";
    case RefusalKind::NoTriangulation:
      break;
  }
  return which + " cannot be inserted: there are no triangles";
}

}
