/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#include <delaunayflip_c.h>

#include <stdio.h>

/* Flips the long diagonal of a quad by the C interface. Build it with
 *   cc flip_arrays.c -I PREFIX/include/delaunayflip -L PREFIX/lib -ldelaunayflip
 * or, with PREFIX in CMAKE_PREFIX_PATH, by CMake in this folder.
 */

static int32_t PrintProgress(double share, void* user)
{
  (void)user;
  fprintf(stderr, "%3.0f %%\r", 100.0 * share);
  return 1; /* 0 aborts */
}

int main(void)
{
  const double points[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
  int32_t triangles[] = { 0, 1, 2, 0, 2, 3 };
  delaunayflip_mesh mesh;
  delaunayflip_options options;
  delaunayflip_callbacks callbacks;
  delaunayflip_report report;

  delaunayflip_mesh_init(&mesh);
  mesh.points = points;
  mesh.number_of_points = 4;
  mesh.triangles = triangles;
  mesh.number_of_triangles = 2;
  mesh.id_type = DELAUNAYFLIP_INT32;

  delaunayflip_options_init(&options);
  options.geometry = DELAUNAYFLIP_GEOMETRY_PLANAR;
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = PrintProgress;
  delaunayflip_report_init(&report);

  /* The result replaces the input. */
  if (delaunayflip_flip(&mesh, &options, &callbacks, triangles, &report) != DELAUNAYFLIP_OK)
  {
    fprintf(stderr, "%s\n", delaunayflip_error_message());
    return 1;
  }
  printf("%lld flip%s, smallest angle %.1f -> %.1f degrees\n", (long long)report.total_flips,
    report.total_flips == 1 ? "" : "s", report.minimum_angle_before, report.minimum_angle_after);
  printf("%d %d %d, %d %d %d\n", triangles[0], triangles[1], triangles[2], triangles[3],
    triangles[4], triangles[5]);
  return 0;
}
