// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "delaunayflip_c.h"

#include "CallerInput.h"
#include "Status.h"

#include <algorithm>
#include <vector>

using namespace delaunayflip;

extern "C"
{

  delaunayflip_status delaunayflip_find_geometry(
    const delaunayflip_mesh* mesh, const delaunayflip_options* options, std::int32_t* geometry)
  {
    return Try(
      [=]()
      {
        Require(geometry, "geometry is null");
        *geometry =
          static_cast<std::int32_t>(FindGeometry(ToMesh(CompleteMesh(mesh)), ToOptions(options)));
      });
  }

  delaunayflip_status delaunayflip_find_fixed_edges(const delaunayflip_mesh* mesh,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks,
    std::int64_t* pairs, std::int64_t* count)
  {
    return Try(
      [=]()
      {
        Require(count, "count is null");
        const std::vector<std::int64_t> ids = FindFixedEdges(
          ToMesh(CompleteMesh(mesh)), ToOptions(options), Observers(callbacks).Progress);
        Require(pairs || ids.empty(), "pairs is null");
        std::copy(ids.begin(), ids.end(), pairs);
        *count = static_cast<std::int64_t>(ids.size()) / 2;
      });
  }
}
