// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PackedPoints.h"

namespace delaunayflip
{

PackedPoints PackPoints(const PointArray& points, const SpatialOrder& order,
  const PackingPlan& plan, const ThreadBackend& backend)
{
  PackedPoints packed;
  packed.Components = plan.Components;
  packed.Count = points.Count;
  const std::size_t size = std::size_t(plan.Components) * points.Count;
  packed.Floats = Array<float>(plan.AsFloat ? size : 0);
  packed.Doubles = Array<double>(plan.AsFloat ? 0 : size);
  backend.ForRange(points.Count,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t rank = begin; rank < end; ++rank)
      {
        const VertexId point = order.GetVertex(rank);
        for (int k = 0; k < plan.Components; ++k)
        {
          const double x = plan.Scale * points.Get(point, plan.Axes[k]);
          const std::size_t i = std::size_t(plan.Components) * rank + k;
          if (plan.AsFloat)
          {
            packed.Floats[i] = static_cast<float>(x);
          }
          else
          {
            packed.Doubles[i] = x;
          }
        }
      }
    });
  return packed;
}

}
