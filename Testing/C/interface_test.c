/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** @file
 * The C interface as a C program sees it. Testing/Python/test_arrays.py tests more of what it does.
 */

/* A quad. Its short diagonal, from point 1 to point 3, is the Delaunay edge. */
static const double Points[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
static const int64_t LongDiagonal[] = { 0, 1, 2, 0, 2, 3 };

static delaunayflip_mesh MakeMesh(void)
{
  delaunayflip_mesh mesh;
  delaunayflip_mesh_init(&mesh);
  mesh.points = Points;
  mesh.number_of_points = 4;
  mesh.triangles = LongDiagonal;
  mesh.number_of_triangles = 2;
  return mesh;
}

static delaunayflip_report GetReport(delaunayflip_session* session)
{
  delaunayflip_report report;
  delaunayflip_report_init(&report);
  CHECK(delaunayflip_get_report(session, &report) == DELAUNAYFLIP_OK);
  return report;
}

static void TestFlipsSquare(void)
{
  const delaunayflip_mesh mesh = MakeMesh();
  int64_t triangles[6];
  delaunayflip_report report;
  delaunayflip_report_init(&report);
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, &report) == DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonal(triangles));
  CHECK(report.stop_reason == DELAUNAYFLIP_CONVERGED);
  CHECK(report.geometry_used == DELAUNAYFLIP_GEOMETRY_PLANAR);
  CHECK(report.total_flips == 1);
  CHECK(report.non_delaunay_before == 1 && report.non_delaunay_after == 0);
  CHECK(report.blocked_by_shape == 0 && report.blocked_by_edge == 0);
  CHECK(report.edges == 5 && report.boundary_edges == 4 && report.euler_characteristic == 1);
  CHECK(report.minimum_angle_after > report.minimum_angle_before);
  CHECK(strlen(report.geometry_reason) > 0 && strlen(report.backend) > 0);
  CHECK(strcmp(report.defects, "") == 0);
}

/* A sum over meshes adds up what it was given; without triangles there is nothing to say. */
static void TestSummary(void)
{
  const delaunayflip_mesh mesh = MakeMesh();
  int64_t triangles[6];
  const char* text = NULL;
  delaunayflip_report report;
  delaunayflip_report_init(&report);
  CHECK(delaunayflip_summarize(&report, &text) == DELAUNAYFLIP_OK && strcmp(text, "") == 0);
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, &report) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_summarize(&report, &text) == DELAUNAYFLIP_OK);
  CHECK(strncmp(text, "bad edges: 1 -> 0\nsmallest angle: ", 34) == 0);
  CHECK(strstr(text, "\nmesh: 4 points, 2 triangles") != NULL);
  CHECK(strstr(text, "\nflips: 1 in 1 iteration, converged\n") != NULL);
  report.total_flips = 2345;
  CHECK(delaunayflip_summarize(&report, &text) == DELAUNAYFLIP_OK);
  CHECK(strstr(text, "\nflips: 2,345 in 1 iteration") != NULL);
  CHECK(delaunayflip_summarize(&report, NULL) == DELAUNAYFLIP_INVALID_CALL);
  report.number_of_iterations = -1;
  CHECK(delaunayflip_summarize(&report, &text) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(strstr(delaunayflip_error_message(), "number_of_iterations is negative") != NULL);
  report.number_of_iterations = INT64_MAX;
  CHECK(delaunayflip_summarize(&report, &text) == DELAUNAYFLIP_OK);
  CHECK(strstr(text, " in 9,223,372,036,854,775,807 iterations, converged\n") != NULL);
  CHECK(delaunayflip_summarize(NULL, &text) != DELAUNAYFLIP_OK);
}

static void TestAllTypes(void)
{
  const float floats[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
  const int32_t ids[] = { 0, 1, 2, 0, 2, 3 };
  int32_t result32[6];
  int64_t result64[6];
  delaunayflip_mesh mesh = MakeMesh();
  delaunayflip_session* session;
  int i;
  mesh.points = floats;
  mesh.point_type = DELAUNAYFLIP_FLOAT32;
  mesh.triangles = ids;
  mesh.id_type = DELAUNAYFLIP_INT32;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, result32, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_open(&mesh, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_expect(session, NULL, 8) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_expect(session, result64, -1) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_expect(NULL, result64, sizeof(result64)) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_expect(session, result64, sizeof(result64)) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_triangles(session, result64, DELAUNAYFLIP_INT64) == DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonal(result64));
  for (i = 0; i < 6; ++i)
  {
    CHECK(result32[i] == result64[i]);
  }
  delaunayflip_close(session);
}

static void TestSteps(void)
{
  delaunayflip_mesh mesh = MakeMesh();
  delaunayflip_session* session;
  int64_t triangles[6];
  int32_t counts[2];
  int32_t is_running = 1;
  CHECK(delaunayflip_open(&mesh, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  while (is_running)
  {
    CHECK(delaunayflip_advance(session, 1, NULL, &is_running) == DELAUNAYFLIP_OK);
    CHECK(GetReport(session).stop_reason ==
      (is_running ? DELAUNAYFLIP_RUNNING : DELAUNAYFLIP_CONVERGED));
  }
  CHECK(delaunayflip_store_flip_counts(session, counts) == DELAUNAYFLIP_OK);
  CHECK(counts[0] == 1 && counts[1] == 1);
  delaunayflip_close(session);
  /* In place. */
  memcpy(triangles, LongDiagonal, sizeof(triangles));
  mesh.triangles = triangles;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, NULL) == DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonal(triangles));
}

typedef struct
{
  int64_t calls;
  int64_t last_call; /* The call that returns 0. */
  double share;
} Log;

static int32_t LogProgress(double share, void* user)
{
  Log* log = user;
  CHECK(share >= log->share && share <= 1.0);
  log->share = share;
  return ++log->calls != log->last_call;
}

static void TestInvalidOptions(void)
{
  const delaunayflip_mesh mesh = MakeMesh();
  int64_t triangles[6];
  delaunayflip_options options;
  delaunayflip_options_init(&options);
  options.feature_angle = 181.0;
  CHECK(delaunayflip_flip(&mesh, &options, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  CHECK(delaunayflip_error_cell() == -1);
  delaunayflip_options_init(&options);
  options.maximum_deviation = -1.0;
  CHECK(delaunayflip_flip(&mesh, &options, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  CHECK(strstr(delaunayflip_error_message(), "deviation") != NULL);
  delaunayflip_options_init(&options);
  options.geometry = DELAUNAYFLIP_GEOMETRY_MIXED;
  CHECK(delaunayflip_flip(&mesh, &options, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
  options.geometry = -1;
  CHECK(delaunayflip_flip(&mesh, &options, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
}

static void TestNullPointers(void)
{
  delaunayflip_mesh mesh = MakeMesh();
  delaunayflip_session* session = NULL;
  int64_t triangles[6];
  CHECK(delaunayflip_flip(NULL, NULL, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, NULL, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_open(&mesh, NULL, NULL, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_advance(NULL, -1, NULL, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_get_report(NULL, NULL) == DELAUNAYFLIP_INVALID_CALL);
  mesh.points = NULL;
  CHECK(delaunayflip_open(&mesh, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(session == NULL);
  CHECK(strstr(delaunayflip_error_message(), "points") != NULL);
  delaunayflip_close(NULL);
  delaunayflip_mesh_init_sized(NULL, 8);
  delaunayflip_report_init_sized(NULL, sizeof(delaunayflip_report));
  CHECK(delaunayflip_count_triangles(NULL) == 0 && delaunayflip_count_defects(NULL) == 0);
}

static void TestUnsetSizes(void)
{
  delaunayflip_mesh mesh = MakeMesh();
  delaunayflip_options options;
  int64_t triangles[6];
  memset(&options, 0, sizeof(options));
  CHECK(delaunayflip_flip(&mesh, &options, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(strstr(delaunayflip_error_message(), "_init") != NULL);
  mesh.size = 0;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
}

/* The header of an old program ended after `tie_rule`. The program gets the defaults of what
 * follows, and a report cut where its own ended. */
static void TestOldProgram(void)
{
  const delaunayflip_mesh mesh = MakeMesh();
  int64_t triangles[6];
  delaunayflip_options options;
  delaunayflip_report report;
  delaunayflip_options_init(&options);
  options.size = (int64_t)((char*)&options.backend - (char*)&options);
  options.feature_angle = 1000.0; /* Beyond the size: not looked at. */
  delaunayflip_report_init(&report);
  report.size = (int64_t)((char*)&report.total_flips - (char*)&report);
  report.total_flips = -5;
  CHECK(delaunayflip_flip(&mesh, &options, NULL, triangles, &report) == DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonal(triangles));
  CHECK(report.number_of_iterations > 0);
  CHECK(report.total_flips == -5);
}

/* A program with a longer struct than the library's: the end of its report stays as it was. */
static void TestNewerProgram(void)
{
  struct
  {
    delaunayflip_report report;
    int64_t unknown;
  } newer;
  const delaunayflip_mesh mesh = MakeMesh();
  int64_t triangles[6];
  delaunayflip_report_init(&newer.report);
  newer.report.size = sizeof(newer);
  newer.unknown = 42;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, &newer.report) == DELAUNAYFLIP_OK);
  CHECK(newer.report.total_flips == 1);
  CHECK(newer.report.size == sizeof(newer));
  CHECK(newer.unknown == 42);
}

/* device_test.c has what needs a GPU. */
static void TestDeviceMemory(void)
{
  delaunayflip_mesh mesh = MakeMesh();
  int64_t triangles[6] = { 7, 7, 7, 7, 7, 7 };
  delaunayflip_session* session;
  delaunayflip_status status;
  CHECK(mesh.memory == DELAUNAYFLIP_HOST && mesh.point_components == 3 && mesh.stream == NULL);
  mesh.point_components = 2;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
  mesh.memory = 2;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
  mesh.memory = DELAUNAYFLIP_CUDA;
  mesh.point_components = 4;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, NULL) == DELAUNAYFLIP_INVALID_CALL);
  /* These arrays are not in the memory of a GPU. */
  mesh.point_components = 3;
  status = delaunayflip_has_cuda_device() ? DELAUNAYFLIP_INVALID_OPTIONS
                                          : DELAUNAYFLIP_BACKEND_UNAVAILABLE;
  CHECK(delaunayflip_flip(&mesh, NULL, NULL, triangles, NULL) == status);
  CHECK(delaunayflip_open(&mesh, NULL, NULL, &session) == status);
  CHECK(delaunayflip_triangle_angles(&mesh, 0, NULL) == DELAUNAYFLIP_INVALID_CALL);
  mesh.memory = DELAUNAYFLIP_HOST;
  CHECK(delaunayflip_open(&mesh, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(
    delaunayflip_store_triangles_on_device(session, triangles, DELAUNAYFLIP_INT64, NULL) == status);
  CHECK(delaunayflip_store_flip_counts_on_device(session, (int32_t*)triangles, NULL) == status);
  CHECK(delaunayflip_store_flip_counts_on_device(session, NULL, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(triangles[0] == 7 && triangles[5] == 7);
  delaunayflip_close(session);
}

/* A quad, a line that is no polygon, and an L of six corners. A fan of the L would leave it. */
static void TestPolygons(void)
{
  static const double points[] = { 0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0 };
  static const int64_t corners[] = { 0, 1, 2, 3, 0, 1, 4, 5, 0, 1, 2, 3 };
  static const int64_t offsets[] = { 0, 4, 6, 12 };
  static const int64_t expected[] = { 0, 1, 2, 0, 2, 3 };
  static const int64_t decreasing[] = { 0, 3, 0, 0 };
  static const int64_t repeated[] = { 0, 1, 2, 2, 0, 1, 4, 4, 4, 5, 5, 4 };
  int64_t triangles[18], counts[3];
  delaunayflip_mesh mesh;
  delaunayflip_polygons polygons;
  delaunayflip_callbacks callbacks;
  Log log = { 0, 1, 0.0 };
  int i;
  delaunayflip_mesh_init(&mesh);
  mesh.points = points;
  mesh.number_of_points = 6;
  delaunayflip_polygons_init(&polygons);
  polygons.number_of_polygons = 3;
  polygons.offsets = offsets;
  polygons.corners = corners;
  CHECK(delaunayflip_split_polygons(&mesh, &polygons, NULL, triangles) == DELAUNAYFLIP_OK);
  CHECK(memcmp(triangles, expected, sizeof(expected)) == 0);
  for (i = 6; i < 18; i += 3)
  {
    const double* a = points + 3 * triangles[i];
    const double* b = points + 3 * triangles[i + 1];
    const double* c = points + 3 * triangles[i + 2];
    CHECK((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
  }
  polygons.corners = repeated;
  CHECK(
    delaunayflip_split_polygons(&mesh, &polygons, NULL, triangles) == DELAUNAYFLIP_INVALID_MESH);
  CHECK(delaunayflip_error_cell() == 0 && delaunayflip_error_point() == -1);
  polygons.triangle_counts = counts;
  CHECK(delaunayflip_split_polygons(&mesh, &polygons, NULL, triangles) == DELAUNAYFLIP_OK);
  CHECK(counts[0] == 1 && counts[1] == 0 && counts[2] == 0);
  CHECK(triangles[0] == 0 && triangles[1] == 1 && triangles[2] == 2);
  polygons.corners = corners;
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = LogProgress;
  callbacks.user = &log;
  CHECK(
    delaunayflip_split_polygons(&mesh, &polygons, &callbacks, triangles) == DELAUNAYFLIP_STOPPED);
  mesh.number_of_points = 5;
  CHECK(
    delaunayflip_split_polygons(&mesh, &polygons, NULL, triangles) == DELAUNAYFLIP_INVALID_MESH);
  CHECK(delaunayflip_error_cell() == 2 && delaunayflip_error_point() == 5);
  CHECK(counts[0] == 1); /* A call that fails writes nothing. */
  polygons.corners = NULL;
  polygons.offsets = decreasing;
  CHECK(
    delaunayflip_split_polygons(&mesh, &polygons, NULL, triangles) == DELAUNAYFLIP_INVALID_CALL);
}

/* The quad without its triangles, then with the long diagonal as a segment. */
static void TestPoints(void)
{
  const int64_t diagonal[] = { 2, 0 };
  int64_t triangles[6], edge[2], used[4];
  int32_t neighbors[6];
  delaunayflip_points points;
  delaunayflip_options options;
  delaunayflip_callbacks callbacks;
  Log log = { 0, 1, 0.0 };
  delaunayflip_session* session = NULL;
  int i;
  delaunayflip_points_init(&points);
  points.points = Points;
  points.number_of_points = 4;
  points.point_components = 3;
  for (i = 0; i < 2; ++i)
  {
    points.segments = diagonal;
    points.number_of_segments = i;
    CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
    CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
    CHECK(delaunayflip_store_triangles(session, triangles, DELAUNAYFLIP_INT64) == DELAUNAYFLIP_OK);
    CHECK(HasShortDiagonal(triangles) == (i == 0));
    CHECK(delaunayflip_store_ordered_triangles(session, triangles, DELAUNAYFLIP_INT64) ==
      DELAUNAYFLIP_OK);
    CHECK(triangles[0] == 0 && triangles[3] == 0 + (i == 0));
    CHECK(delaunayflip_store_neighbors(session, neighbors) == DELAUNAYFLIP_OK);
    CHECK(neighbors[0] + neighbors[1] + neighbors[2] == -1);
    CHECK(delaunayflip_store_segment_edges(session, edge) == DELAUNAYFLIP_OK);
    CHECK(i == 0 || (edge[0] == 2 && edge[1] == 0));
    delaunayflip_close(session);
  }
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = LogProgress;
  callbacks.user = &log;
  CHECK(delaunayflip_open_points(&points, NULL, &callbacks, &session) == DELAUNAYFLIP_OK);
  CHECK(GetReport(session).stop_reason == DELAUNAYFLIP_ABORTED);
  CHECK(delaunayflip_store_used_points(session, used) == DELAUNAYFLIP_OK);
  CHECK(used[0] == 0 && used[1] == 1 && used[2] == 2 && used[3] == 3);
  delaunayflip_close(session);
  delaunayflip_options_init(&options);
  options.number_of_pieces = 2;
  CHECK(
    delaunayflip_open_points(&points, &options, NULL, &session) == DELAUNAYFLIP_INVALID_OPTIONS);
  CHECK(strstr(delaunayflip_error_message(), "gather them in one process") != NULL);
  points.number_of_points = INT64_MAX;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_CALL);
  points.number_of_points = INT64_C(1) << 48;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_MESH_TOO_LARGE);
}

/** The segments of the second ring run in both directions. */
static void TestRings(void)
{
  const double places[] = { 0, 0, 9, 0, 9, 9, 0, 9, 1, 1, 8, 1, 8, 8, 1, 8, 2, 2, 4, 2, 4, 4, 2,
    4 };
  const int64_t segments[] = { 4, 5, 5, 6, 6, 7, 7, 4, 8, 9, 10, 9, 10, 11, 8, 11, 0, 1, 1, 0 };
  const int32_t rings[] = { 0, 0, 0, 0, 1, 1, 1, 1, 2, 2 };
  const int32_t rules[] = { DELAUNAYFLIP_EVEN_ODD, DELAUNAYFLIP_NONZERO, DELAUNAYFLIP_ORIENTATION };
  const double areas[] = { 45, 49, 49 };
  int32_t triangles[3 * 30];
  delaunayflip_points points;
  delaunayflip_session* session = NULL;
  int i, t;
  delaunayflip_points_init(&points);
  points.points = places;
  points.number_of_points = 12;
  points.segments = segments;
  points.number_of_segments = 10;
  points.rings = rings;
  for (i = 0; i < 3; ++i)
  {
    double area = 0.0;
    points.ring_rule = rules[i];
    CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
    CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
    CHECK(
      strstr(GetReport(session).defects, "1 ring without an area, left out (first: 2)") != NULL);
    CHECK(delaunayflip_store_triangles(session, triangles, DELAUNAYFLIP_INT32) == DELAUNAYFLIP_OK);
    for (t = 0; t < GetReport(session).triangles; ++t)
    {
      const double* a = places + 2 * triangles[3 * t];
      const double* b = places + 2 * triangles[3 * t + 1];
      const double* c = places + 2 * triangles[3 * t + 2];
      area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    CHECK(area == areas[i]);
    delaunayflip_close(session);
  }
  points.ring_rule = 3;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(strstr(delaunayflip_error_message(), "ring_rule") != NULL);
}

/** Places and rasters, with two linear functions, which are reproduced. */
static void TestQueries(void)
{
  const double xy[] = { 0, 0, 4, 0, 4, 4, 0, 4, 1, 2 };
  const double values[] = { 0, 0, 4, 8, 8, 8, 4, 0, 3, 2 }; /* x + y and 2 x */
  const float places[] = { 1, 1, 9, 3, 0.5, 9, 7, 2, 9 };
  double results[12] = { 0 };
  int32_t triangles[6], ids[12];
  int i;
  delaunayflip_points points;
  delaunayflip_query query;
  delaunayflip_callbacks callbacks;
  delaunayflip_session* session = NULL;
  Log log = { 0, 1, 0.0 };
  delaunayflip_points_init(&points);
  points.points = xy;
  points.number_of_points = 5;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_triangles(session, ids, DELAUNAYFLIP_INT32) == DELAUNAYFLIP_OK);
  delaunayflip_query_init(&query);
  query.places = places;
  query.number_of_places = 3;
  query.place_type = DELAUNAYFLIP_FLOAT32;
  query.place_components = 3;
  query.triangles = triangles;
  query.values = values;
  query.value_components = 2;
  query.results = results;
  for (query.method = 0; query.method < 2; ++query.method)
  {
    CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_OK);
    CHECK(fabs(results[0] - 2) < 1e-12 && fabs(results[1] - 2) < 1e-12);
    CHECK(fabs(results[2] - 3.5) < 1e-12 && fabs(results[3] - 6) < 1e-12);
    CHECK(isnan(results[4]) && isnan(results[5]));
    CHECK(triangles[0] >= 0 && triangles[1] >= 0 && triangles[2] == -1);
  }
  query.method = DELAUNAYFLIP_LINEAR;
  query.outside = DELAUNAYFLIP_OUTSIDE_NEAREST;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_OK);
  CHECK(fabs(results[4] - 6) < 1e-12 && fabs(results[5] - 8) < 1e-12); /* as at (4, 2) */
  query.places = NULL;
  query.columns = 3;
  query.rows = 2;
  query.origin_x = 0.5;
  query.origin_y = 3.5;
  query.step_y = -2;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_OK);
  for (i = 0; i < 6; ++i)
  {
    const double x = 0.5 + i % 3, y = i < 3 ? 3.5 : 1.5;
    CHECK(triangles[i] >= 0 && fabs(results[2 * i] - (x + y)) < 1e-12);
    CHECK(fabs(results[2 * i + 1] - 2 * x) < 1e-12);
  }
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = LogProgress;
  callbacks.user = &log;
  CHECK(delaunayflip_ask(session, &query, &callbacks) == DELAUNAYFLIP_STOPPED);
  query.rows = -1;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  query.rows = 0; /* so that the places count, which are null */
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(strcmp(delaunayflip_error_message(), "places is null") == 0);
  query.rows = 2;
  query.method = 2;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_INVALID_CALL);
  query.method = DELAUNAYFLIP_NATURAL;
  query.outside = -1;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_INVALID_CALL);
  query.outside = DELAUNAYFLIP_OUTSIDE_NAN;
  query.results = NULL;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_INVALID_CALL);
  query.size = 0;
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_ask(session, NULL, NULL) == DELAUNAYFLIP_INVALID_CALL);
  delaunayflip_close(session);
}

/** A square of two regions with an outline. Added points are where their weights say. */
static void TestRefinement(void)
{
  const double places[] = { 0, 0, 10, 0, 10, 10, 0, 10, 4, 0, 4, 10 };
  const double sizes[] = { 9, 9, 9, 9, 9, NAN };
  const int64_t segments[] = { 0, 1, 1, 2, 2, 3, 3, 0, 4, 5 };
  const int32_t rings[] = { 0, 0, 0, 0, -1 };
  const delaunayflip_region regions[] = { { 1, 1, 7, 0.5 }, { 9, 9, -2, 0 } };
  enum
  {
    Most = 2000
  };
  static double xy[2 * Most], weights[3 * Most];
  static int64_t ids[3 * Most], on[Most], edges[2 * Most], numbers[Most];
  static int32_t triangles[6 * Most], labels[2 * Most];
  delaunayflip_points points;
  delaunayflip_session* session = NULL;
  delaunayflip_report report;
  double length = 0.0;
  int64_t i, k;
  delaunayflip_points_init(&points);
  CHECK(points.minimum_angle == 0 && points.point_limit == 0 && points.regions == NULL);
  points.points = places;
  points.number_of_points = 6;
  points.segments = segments;
  points.number_of_segments = 5;
  points.rings = rings;
  points.minimum_angle = 25;
  points.sizes = sizes;
  points.regions = regions;
  points.number_of_regions = 2;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  report = GetReport(session);
  CHECK(report.minimum_angle_after >= 25 && report.unrefined_triangles == 0);
  CHECK(report.refinement_points > 50 && report.refinement_points < Most - 6);
  CHECK(report.refinement_rounds > 0 && report.reached_point_limit == 0);
  CHECK(delaunayflip_store_added_weights(session, xy, ids, weights, on) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_added_points(session, NULL, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_added_weights(session, xy, ids, NULL, on) == DELAUNAYFLIP_INVALID_CALL);
  for (i = 0; i < report.refinement_points; ++i)
  {
    for (k = 0; k < 2; ++k)
    {
      double sum = 0.0;
      int corner;
      for (corner = 0; corner < 3; ++corner)
      {
        const int64_t id = ids[3 * i + corner];
        CHECK(id < 6 + i && id >= (corner == 2 ? -1 : 0));
        if (id >= 0)
        {
          sum += weights[3 * i + corner] * (id < 6 ? places[2 * id + k] : xy[2 * (id - 6) + k]);
        }
      }
      CHECK(fabs(sum - xy[2 * i + k]) < 1e-9);
    }
    CHECK(on[i] >= -1 && on[i] < 5);
    CHECK(on[i] != 4 || xy[2 * i] == 4);
  }
  CHECK(report.triangles < 2 * Most && report.segment_edges < Most);
  CHECK(delaunayflip_store_triangles(session, triangles, DELAUNAYFLIP_INT32) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_regions(session, labels) == DELAUNAYFLIP_OK);
  for (i = 0; i < report.triangles; ++i)
  {
    double x = 0.0;
    for (k = 0; k < 3; ++k)
    {
      const int32_t id = triangles[3 * i + k];
      x += id < 6 ? places[2 * id] : xy[2 * (id - 6)];
    }
    CHECK(labels[i] == (x < 12 ? 7 : -2));
  }
  CHECK(delaunayflip_store_segment_edges(session, edges) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_segments_of_edges(session, numbers) == DELAUNAYFLIP_OK);
  for (i = 0; i < report.segment_edges; ++i)
  {
    const int64_t from = edges[2 * i], to = edges[2 * i + 1];
    if (numbers[i] == 4)
    {
      length += (to < 6 ? places[2 * to + 1] : xy[2 * (to - 6) + 1]) -
        (from < 6 ? places[2 * from + 1] : xy[2 * (from - 6) + 1]);
    }
  }
  CHECK(fabs(length - 10) < 1e-9);
  delaunayflip_close(session);
  points.minimum_angle = 34;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_OPTIONS);
  points.minimum_angle = 0;
  points.regions = NULL;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_CALL);
}

/** Labels the lower of two regions of a mesh, and refines it to an area. */
static void TestRegionSeeds(delaunayflip_mesh mesh)
{
  const delaunayflip_region seeds[] = { { 4, -1, 7, 0.5 }, { 100, 100, 8, 0 } };
  static int32_t labels[500], sources[500];
  delaunayflip_options options;
  delaunayflip_session* session = NULL;
  int64_t copy[6], i, count;
  delaunayflip_options_init(&options);
  options.geometry = DELAUNAYFLIP_GEOMETRY_PLANAR_XY;
  CHECK(mesh.region_seeds == NULL && mesh.number_of_region_seeds == 0);
  mesh.number_of_region_seeds = 2;
  CHECK(delaunayflip_open(&mesh, &options, NULL, &session) == DELAUNAYFLIP_INVALID_CALL);
  mesh.region_seeds = seeds;
  CHECK(delaunayflip_open(&mesh, &options, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  count = delaunayflip_count_triangles(session);
  CHECK(count > 20 && count < 500);
  CHECK(delaunayflip_store_regions(session, labels) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_sources(session, sources) == DELAUNAYFLIP_OK);
  for (i = 0; i < count; ++i)
  {
    CHECK(labels[i] == (sources[i] == 0 ? 7 : 0));
  }
  CHECK(GetReport(session).unrefined_triangles == 0);
  CHECK(delaunayflip_count_defects(session) == 1);
  delaunayflip_close(session);
  CHECK(delaunayflip_flip(&mesh, &options, NULL, copy, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
}

/** Refines two triangles of terrain with different labels. Weights give the places of new points.
 */
static void TestRefinementOfMesh(void)
{
  const double xyz[] = { 0, 0, 1, 4, -3, 2, 8, 0, 9, 4, 5, 5 };
  const int64_t ids[] = { 0, 1, 2, 0, 2, 3 };
  const int32_t regions[] = { 5, 6 };
  enum
  {
    Most = 500
  };
  static double added[3 * Most], weights[3 * Most];
  static int64_t of[3 * Most];
  static int32_t triangles[6 * Most], sources[2 * Most];
  delaunayflip_mesh mesh;
  delaunayflip_options options;
  delaunayflip_session* session = NULL;
  delaunayflip_report report;
  int64_t copy[6], i, k;
  delaunayflip_mesh_init(&mesh);
  delaunayflip_options_init(&options);
  CHECK(options.minimum_angle == 0 && options.keep_boundary == 0 && mesh.sizes == NULL);
  mesh.points = xyz;
  mesh.number_of_points = 4;
  mesh.triangles = ids;
  mesh.number_of_triangles = 2;
  mesh.regions = regions;
  options.geometry = DELAUNAYFLIP_GEOMETRY_PLANAR_XY;
  options.minimum_angle = 25;
  options.maximum_area = 0.3;
  CHECK(delaunayflip_open(&mesh, &options, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  report = GetReport(session);
  CHECK(report.refinement_points > 50 && report.refinement_points < Most);
  CHECK(report.triangles < 2 * Most && report.points == 4);
  CHECK(delaunayflip_store_refined_points(session, added, of, weights) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_refined_points(session, added, of, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_store_sources(session, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_store_regions(session, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_store_regions(session, sources) == DELAUNAYFLIP_OK && sources[0] == 0);
  CHECK(delaunayflip_store_sources(session, sources) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_triangles(session, triangles, DELAUNAYFLIP_INT32) == DELAUNAYFLIP_OK);
  for (i = 0; i < report.refinement_points; ++i)
  {
    for (k = 0; k < 3; ++k)
    {
      const double third = of[3 * i + 2] < 0 ? 0.0 : xyz[3 * of[3 * i + 2] + k];
      const double sum = weights[3 * i] * xyz[3 * of[3 * i] + k] +
        weights[3 * i + 1] * xyz[3 * of[3 * i + 1] + k] + weights[3 * i + 2] * third;
      CHECK(fabs(sum - added[3 * i + k]) < 1e-9);
    }
  }
  for (i = 0; i < report.triangles; ++i)
  {
    double y = 0.0;
    for (k = 0; k < 3; ++k)
    {
      const int32_t id = triangles[3 * i + k];
      y += id < 4 ? xyz[3 * id + 1] : added[3 * (id - 4) + 1];
    }
    CHECK(sources[i] == (y < 0 ? 0 : 1));
  }
  delaunayflip_close(session);
  TestRegionSeeds(mesh);
  CHECK(delaunayflip_flip(&mesh, &options, NULL, copy, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  options.geometry = DELAUNAYFLIP_GEOMETRY_SURFACE;
  CHECK(delaunayflip_open(&mesh, &options, NULL, &session) == DELAUNAYFLIP_INVALID_OPTIONS);
}

/** A point in the middle of two triangles, of other precision; then one outside, and no further. */
static void TestInsertion(void)
{
  const float middle[] = { 2, 0, 7 };
  const double outside[] = { 5, 5 };
  int64_t triangles[12];
  int32_t neighbors[6];
  delaunayflip_points points, more;
  delaunayflip_callbacks callbacks;
  delaunayflip_session* session = NULL;
  const delaunayflip_mesh mesh = MakeMesh();
  Log log = { 0, 1, 0.0 };
  int i, used = 0;
  delaunayflip_points_init(&points);
  points.points = Points;
  points.number_of_points = 4;
  points.point_components = 3;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  delaunayflip_points_init(&more);
  more.points = middle;
  more.number_of_points = 1;
  more.point_type = DELAUNAYFLIP_FLOAT32;
  more.point_components = 3;
  CHECK(delaunayflip_insert_points(session, &more, NULL) == DELAUNAYFLIP_OK);
  CHECK(GetReport(session).points == 5 && GetReport(session).triangles == 4);
  CHECK(delaunayflip_store_triangles(session, triangles, DELAUNAYFLIP_INT64) == DELAUNAYFLIP_OK);
  for (i = 0; i < 12; ++i)
  {
    used += triangles[i] == 4;
  }
  CHECK(used == 4);
  more.memory = DELAUNAYFLIP_CUDA;
  CHECK(delaunayflip_insert_points(session, &more, NULL) == DELAUNAYFLIP_INVALID_CALL);
  more.memory = DELAUNAYFLIP_HOST;
  more.number_of_points = INT64_C(1) << 48;
  CHECK(delaunayflip_insert_points(session, &more, NULL) == DELAUNAYFLIP_MESH_TOO_LARGE);
  more.number_of_points = 1;
  more.points = outside;
  more.point_type = DELAUNAYFLIP_FLOAT64;
  more.point_components = 2;
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = LogProgress;
  callbacks.user = &log;
  CHECK(delaunayflip_insert_points(session, &more, &callbacks) == DELAUNAYFLIP_STOPPED);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(GetReport(session).points == 6 && GetReport(session).triangles == 6);
  delaunayflip_close(session);
  CHECK(delaunayflip_open(&mesh, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_insert_points(session, &more, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  CHECK(delaunayflip_store_neighbors(session, neighbors) == DELAUNAYFLIP_INVALID_OPTIONS);
  CHECK(strstr(delaunayflip_error_message(), "not made from points") != NULL);
  delaunayflip_close(session);
}

/** Each member for refinement in the options of a session from points, where it has no effect. */
static void TestGoalsOfMeshes(void)
{
  delaunayflip_points points;
  delaunayflip_session* session = NULL;
  int i;
  delaunayflip_points_init(&points);
  points.points = Points;
  points.number_of_points = 4;
  points.point_components = 3;
  for (i = 0; i < 5; ++i)
  {
    delaunayflip_options options;
    delaunayflip_options_init(&options);
    options.minimum_angle = i == 0 ? 20 : 0;
    options.maximum_area = i == 1 ? 0.5 : 0;
    options.maximum_edge = i == 2 ? 0.5 : 0;
    options.keep_boundary = i == 3;
    options.point_limit = i == 4 ? 100 : 0;
    CHECK(
      delaunayflip_open_points(&points, &options, NULL, &session) == DELAUNAYFLIP_INVALID_OPTIONS);
    CHECK(strstr(delaunayflip_error_message(), "delaunayflip_points") != NULL);
  }
}

/** Points move, and one is removed. */
static void TestMove(void)
{
  const float places[] = { 0, 0, 2, -1, 4, 0, 2, 3 };
  const double place[] = { 2, 0.5 };
  const int64_t ids[] = { 3 }, beyond[] = { 4 };
  delaunayflip_points points;
  delaunayflip_callbacks callbacks;
  delaunayflip_session* session = NULL;
  Log log = { 0, 1, 0.0 };
  delaunayflip_points_init(&points);
  points.points = Points;
  points.number_of_points = 4;
  points.point_components = 3;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  points.points = places;
  points.point_type = DELAUNAYFLIP_FLOAT32;
  points.point_components = 2;
  CHECK(delaunayflip_move_points(session, &points, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_count_triangles(session) == 2 && GetReport(session).move_rounds > 0);
  points.number_of_points = 3;
  CHECK(delaunayflip_move_points(session, &points, NULL, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  points.points = place;
  points.point_type = DELAUNAYFLIP_FLOAT64;
  points.number_of_points = 1;
  CHECK(delaunayflip_move_points(session, &points, ids, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_count_triangles(session) == 2);
  CHECK(delaunayflip_move_points(session, &points, beyond, NULL) == DELAUNAYFLIP_INVALID_OPTIONS);
  points.memory = DELAUNAYFLIP_CUDA;
  CHECK(delaunayflip_move_points(session, &points, ids, NULL) == DELAUNAYFLIP_INVALID_CALL);
  points.memory = DELAUNAYFLIP_HOST;
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = LogProgress;
  callbacks.user = &log;
  CHECK(delaunayflip_remove_points(session, ids, 1, &callbacks) == DELAUNAYFLIP_STOPPED);
  CHECK(delaunayflip_remove_points(session, ids, 1, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_count_triangles(session) == 1);
  CHECK(GetReport(session).removed_points == 1 && GetReport(session).points == 4);
  CHECK(delaunayflip_compact_points(session, NULL) == DELAUNAYFLIP_OK);
  CHECK(GetReport(session).removed_points == 0 && GetReport(session).points == 3);
  delaunayflip_close(session);
}

/** Two diagonals that cross, and a ring of one edge. Then a ring that is not closed. */
/** Longitudes and latitudes of an octahedron. Each pole is given twice. */
static void TestSphere(void)
{
  const double degrees[] = { 0, 0, 90, 0, 180, 0, -90, 0, 0, 90, 77, 90, 5, -90, -5, -90, 270, 0 };
  double places[27];
  int32_t triangles[24], neighbors[24];
  int64_t used[9];
  int i;
  delaunayflip_points points;
  delaunayflip_session* session = NULL;
  CHECK(delaunayflip_place_on_sphere(degrees, 9, NULL) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_place_on_sphere(degrees, 9, places) == DELAUNAYFLIP_OK);
  CHECK(places[3] == 0 && places[4] == 1 && places[5] == 0 && places[14] == 1);
  delaunayflip_points_init(&points);
  points.points = places;
  points.number_of_points = 9;
  points.projection = DELAUNAYFLIP_SPHERE;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_OPTIONS);
  points.point_components = 3;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(GetReport(session).triangles == 8 && GetReport(session).repeated_points == 3);
  CHECK(GetReport(session).geometry_used == DELAUNAYFLIP_GEOMETRY_SPHERE);
  CHECK(delaunayflip_store_triangles(session, triangles, DELAUNAYFLIP_INT32) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_neighbors(session, neighbors) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_used_points(session, used) == DELAUNAYFLIP_OK);
  CHECK(used[5] == 4 && used[7] == 6 && used[8] == 3);
  for (i = 0; i < 24; ++i)
  {
    CHECK(used[triangles[i]] == triangles[i] && neighbors[i] >= 0);
  }
  delaunayflip_close(session);
  points.projection = 3;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_INVALID_CALL);
}

static void TestDefects(void)
{
  const double places[] = { 0, 0, 4, 0, 4, 4, 0, 4 };
  const int64_t segments[] = { 0, 2, 1, 3, 0, 1, 1, 0 };
  const int32_t rings[] = { -1, -1, 7, 7 };
  const int32_t open_rings[] = { -1, 5, 5, -1 };
  delaunayflip_points points;
  delaunayflip_defect defects[2];
  delaunayflip_session* session = NULL;
  const int64_t size = sizeof(defects[0]);
  delaunayflip_points_init(&points);
  points.points = places;
  points.number_of_points = 4;
  points.segments = segments;
  points.number_of_segments = 4;
  points.rings = rings;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  GetReport(session);
  CHECK(delaunayflip_count_defects(session) == 2);
  CHECK(delaunayflip_get_defects(session, 0, 2, defects, size) == DELAUNAYFLIP_OK);
  CHECK(defects[0].kind == DELAUNAYFLIP_DEFECT_SEGMENTS_CROSS && defects[0].count == 1);
  CHECK(defects[0].number_of_ids == 2);
  CHECK(defects[0].first_ids[0] == 1 && defects[0].first_ids[1] == 3);
  CHECK(defects[0].crossed[0] == 0);
  CHECK(defects[0].crossed[1] == 0 && defects[0].crossed[2] == 2);
  CHECK(strstr(defects[0].text, "1-3 crosses segment 0 (points 0 and 2)") != NULL);
  CHECK(defects[1].kind == DELAUNAYFLIP_DEFECT_RINGS_WITHOUT_AREA);
  CHECK(defects[1].number_of_ids == 1 && defects[1].first_ids[0] == 7);
  CHECK(defects[1].crossed == NULL);
  CHECK(delaunayflip_get_defects(session, 1, 2, defects, size) == DELAUNAYFLIP_INVALID_CALL);
  CHECK(delaunayflip_error_ring() == -1);
  delaunayflip_close(session);
  points.rings = open_rings;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_INVALID_MESH);
  CHECK(delaunayflip_error_ring() == 5);
  delaunayflip_close(session);
}

int main(void)
{
  TestFlipsSquare();
  TestSummary();
  TestAllTypes();
  TestSteps();
  TestInvalidOptions();
  TestNullPointers();
  TestUnsetSizes();
  TestOldProgram();
  TestNewerProgram();
  TestDeviceMemory();
  TestPolygons();
  TestPoints();
  TestRings();
  TestQueries();
  TestInsertion();
  TestGoalsOfMeshes();
  TestRefinement();
  TestRefinementOfMesh();
  TestMove();
  TestSphere();
  TestDefects();
  return 0;
}
