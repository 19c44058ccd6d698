// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionCalls.h"

#include <cstddef>

/// @file
/// The functions that programs compiled with the header of 0.2.0 call in place of those that take a
/// size. Each fills the struct of that release, which ends with this member, and never more.

/// The size of a struct up to a member.
#define DELAUNAYFLIP_SIZE_TO(Struct, member) (offsetof(Struct, member) + sizeof(Struct::member))

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

extern "C"
{

  void delaunayflip_mesh_init(delaunayflip_mesh* mesh)
  {
    delaunayflip_mesh_init_sized(
      mesh, DELAUNAYFLIP_SIZE_TO(delaunayflip_mesh, number_of_region_seeds));
  }

  void delaunayflip_options_init(delaunayflip_options* options)
  {
    delaunayflip_options_init_sized(
      options, DELAUNAYFLIP_SIZE_TO(delaunayflip_options, point_limit));
  }

  void delaunayflip_report_init(delaunayflip_report* report)
  {
    delaunayflip_report_init_sized(
      report, DELAUNAYFLIP_SIZE_TO(delaunayflip_report, points_inside));
  }

  void delaunayflip_callbacks_init(delaunayflip_callbacks* callbacks)
  {
    delaunayflip_callbacks_init_sized(
      callbacks, DELAUNAYFLIP_SIZE_TO(delaunayflip_callbacks, user));
  }

  void delaunayflip_points_init(delaunayflip_points* points)
  {
    delaunayflip_points_init_sized(points, DELAUNAYFLIP_SIZE_TO(delaunayflip_points, reserved));
  }

  void delaunayflip_query_init(delaunayflip_query* query)
  {
    delaunayflip_query_init_sized(query, DELAUNAYFLIP_SIZE_TO(delaunayflip_query, reserved));
  }

  void delaunayflip_polygons_init(delaunayflip_polygons* polygons)
  {
    delaunayflip_polygons_init_sized(
      polygons, DELAUNAYFLIP_SIZE_TO(delaunayflip_polygons, triangle_counts));
  }
}

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
