/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#include "check.h"

#include <string.h>

/** @file
 * Usage: hash_test FILE [--write]
 *
 * Every system makes the same meshes: the hashes of 200 of them are those of the file, which is in
 * Testing/C. Everything begins with integers, so no function of the C library has a part in it.
 * --write makes the file, after a change of what meshes should be.
 */

enum
{
  Most = 2000, /* points */
  Kinds = 5, /* of places of points */
  PointVariants = 12,
  MeshVariants = 10
};

static uint64_t State;

/* An integer from 0 to size - 1. */
static int64_t Draw(int64_t size)
{
  State = State * 6364136223846793005u + 1442695040888963407u;
  return (int64_t)((State >> 33) % (uint64_t)size);
}

static uint64_t Hash; /* FNV-1a */

static void AddWord(uint64_t word)
{
  int byte;
  for (byte = 0; byte < 8; ++byte)
  {
    Hash = (Hash ^ (word >> (8 * byte) & 255)) * 1099511628211u;
  }
}

static void AddIntegers(const int64_t* numbers, int64_t count)
{
  int64_t i;
  AddWord((uint64_t)count);
  for (i = 0; i < count; ++i)
  {
    AddWord((uint64_t)numbers[i]);
  }
}

static void AddNarrow(const int32_t* numbers, int64_t count)
{
  int64_t i;
  for (i = 0; i < count; ++i)
  {
    AddWord((uint64_t)(int64_t)numbers[i]);
  }
}

static void AddDoubles(const double* numbers, int64_t count)
{
  int64_t i;
  for (i = 0; i < count; ++i)
  {
    uint64_t bits = 0; /* for NaN, which has a sign on some processors */
    if (numbers[i] == numbers[i])
    {
      memcpy(&bits, &numbers[i], sizeof(bits));
    }
    AddWord(bits);
  }
}

static void* Allocate(int64_t size)
{
  void* memory = calloc((size_t)size + 1, 1);
  CHECK(memory != NULL);
  return memory;
}

/* Points of one kind: anywhere, on a lattice, in clusters, along a line, with far ones. */
static void DrawPlaces(int kind, int64_t count, double* xy)
{
  int64_t i;
  for (i = 0; i < count; ++i)
  {
    double* place = xy + 2 * i;
    place[0] = (double)Draw(1 << 20) / 1024;
    place[1] = (double)Draw(1 << 20) / 1024;
    if (kind == 1)
    {
      place[0] = (double)Draw(24);
      place[1] = (double)Draw(24);
    }
    else if (kind == 2)
    {
      place[0] = place[0] / 4096 + (double)(300 * Draw(3));
      place[1] = place[1] / 4096 + (double)(300 * Draw(3));
    }
    else if (kind == 3)
    {
      place[1] = place[0] / 3 + (double)Draw(3) / 1048576;
    }
    else if (kind == 4 && i % 10 == 0)
    {
      place[0] *= 1048576.0;
    }
  }
}

static delaunayflip_report Finish(delaunayflip_session* session)
{
  delaunayflip_report report;
  delaunayflip_report_init(&report);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_get_report(session, &report) == DELAUNAYFLIP_OK);
  return report;
}

static void AddTriangles(delaunayflip_session* session)
{
  const int64_t size = 3 * delaunayflip_count_triangles(session);
  int64_t* ids = Allocate(8 * size);
  CHECK(delaunayflip_store_triangles(session, ids, DELAUNAYFLIP_INT64) == DELAUNAYFLIP_OK);
  AddIntegers(ids, size);
  free(ids);
}

/* The values at places between the points, from values of the points and of the added ones. */
static void AddAnswers(delaunayflip_session* session, int64_t points)
{
  enum
  {
    Columns = 12
  };
  double results[Columns * Columns];
  double* values = Allocate(8 * points);
  int64_t i;
  delaunayflip_query query;
  delaunayflip_query_init(&query);
  for (i = 0; i < points; ++i)
  {
    values[i] = (double)Draw(1000);
  }
  query.columns = Columns;
  query.rows = Columns;
  query.step_x = query.step_y = 1.625;
  query.values = values;
  query.results = results;
  for (query.method = DELAUNAYFLIP_LINEAR; query.method <= DELAUNAYFLIP_NATURAL; ++query.method)
  {
    CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_OK);
    AddDoubles(results, (int64_t)Columns * Columns);
  }
  free(values);
}

static void HashPoints(const delaunayflip_points* points, int asks)
{
  delaunayflip_session* session;
  delaunayflip_report report;
  int64_t added, *ids;
  int32_t* neighbors;
  double *xy, *weights;
  CHECK(delaunayflip_open_points(points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  report = Finish(session);
  added = report.crossings + report.refinement_points;
  AddTriangles(session);
  neighbors = Allocate(12 * report.triangles);
  CHECK(delaunayflip_store_neighbors(session, neighbors) == DELAUNAYFLIP_OK);
  AddNarrow(neighbors, 3 * report.triangles);
  xy = Allocate(16 * added);
  ids = Allocate(24 * added);
  weights = Allocate(24 * added);
  if (points->projection == DELAUNAYFLIP_PLANE)
  {
    CHECK(delaunayflip_store_added_weights(session, xy, ids, weights, NULL) == DELAUNAYFLIP_OK);
  }
  AddDoubles(xy, 2 * added);
  AddIntegers(ids, 3 * added);
  AddDoubles(weights, 3 * added);
  if (asks)
  {
    AddAnswers(session, points->number_of_points + added);
  }
  free(neighbors);
  free(xy);
  free(ids);
  free(weights);
  delaunayflip_close(session);
}

/* A ring around a part of the points: its corners are the last points, on a circle of integers. */
static void MakeRing(double* xy, int64_t count, int64_t* segments, int32_t* rings)
{
  static const double Corners[] = { 25, 0, 24, 7, 20, 15, 7, 24, 0, 25, -15, 20, -24, -7, -7, -24 };
  const int corners = 8;
  const int64_t first = count - corners;
  int i;
  for (i = 0; i < corners; ++i)
  {
    xy[2 * (first + i)] = 12 + 3 * Corners[2 * i];
    xy[2 * (first + i) + 1] = 12 + 3 * Corners[2 * i + 1];
    segments[2 * i] = first + i;
    segments[2 * i + 1] = first + (i + 1) % corners;
    rings[i] = 0;
  }
}

static void DrawSegments(int64_t points, int64_t count, int64_t* segments, int32_t* rings)
{
  int64_t i;
  for (i = 0; i < count; ++i)
  {
    segments[2 * i] = Draw(points);
    segments[2 * i + 1] = Draw(points);
    rings[i] = -1;
  }
}

static void SetGoals(int variant, delaunayflip_points* points)
{
  points->minimum_angle = variant == 6 ? 20 : variant == 7 ? 28.6 : variant == 8 ? 33 : 0;
  points->maximum_area = variant == 7 ? 40 : 0;
  points->maximum_edge = variant == 9 ? 7.3 : 0;
  points->alpha = variant == 3 ? 60.7 : 0;
  points->longest_edge = variant == 4 ? 91.3 : 0;
  points->point_tolerance = variant == 5 ? 2.3 : 0;
  points->split_crossings = variant == 2 || variant == 10;
}

static void HashOfPoints(int kind, int variant, int64_t count)
{
  static double xy[2 * Most];
  int64_t segments[2 * 48], number = 8;
  int32_t rings[48];
  delaunayflip_points points;
  delaunayflip_points_init(&points);
  DrawPlaces(kind, count, xy);
  MakeRing(xy, count, segments, rings);
  if (variant == 1 || variant == 2 || variant == 10)
  {
    DrawSegments(count - 8, 40, segments + 16, rings + 8);
    number = 48;
  }
  points.points = xy;
  points.number_of_points = count;
  points.segments = segments;
  points.rings = rings;
  points.number_of_segments = variant == 0 || (variant >= 3 && variant <= 5) ? 0 : number;
  SetGoals(variant, &points);
  HashPoints(&points, variant == 0 || variant == 6 || variant == 11);
}

static void HashOfSphere(int kind, int32_t projection, int64_t count)
{
  static double degrees[2 * Most], xyz[3 * Most];
  int64_t i;
  delaunayflip_points points;
  delaunayflip_points_init(&points);
  for (i = 0; i < count; ++i)
  {
    const int64_t step = kind == 0 ? 1 : kind == 1 ? 100 : 10000; /* in 1/1000 degrees */
    degrees[2 * i] = (double)(step * Draw(360000 / step)) / 1000 - 180;
    degrees[2 * i + 1] = (double)(step * Draw(180000 / step + 1)) / 1000 - 90;
  }
  CHECK(delaunayflip_place_on_sphere(degrees, count, xyz) == DELAUNAYFLIP_OK);
  AddDoubles(xyz, 3 * count);
  points.points = xyz;
  points.number_of_points = count;
  points.point_components = 3;
  points.projection = projection;
  HashPoints(&points, 0);
}

/* Squares with moved corners and heights, each with a diagonal of its own. */
static void MakeTerrain(int64_t side, int roughness, double* xyz, int64_t* triangles)
{
  int64_t i, j;
  for (j = 0; j <= side; ++j)
  {
    for (i = 0; i <= side; ++i)
    {
      *xyz++ = (double)(8 * i + Draw(6));
      *xyz++ = (double)(8 * j + Draw(6));
      *xyz++ = (double)Draw(1 + roughness * 8) / 8;
    }
  }
  for (j = 0; j < side; ++j)
  {
    for (i = 0; i < side; ++i)
    {
      const int64_t a = j * (side + 1) + i, b = a + 1, c = b + side + 1, d = c - 1;
      const int64_t first[] = { a, b, c, a, c, d }, second[] = { a, b, d, b, c, d };
      memcpy(triangles, Draw(2) ? first : second, sizeof(first));
      triangles += 6;
    }
  }
}

static void SetMeshOptions(int variant, delaunayflip_options* options)
{
  options->geometry = variant < 3 ? DELAUNAYFLIP_GEOMETRY_PLANAR_XY : DELAUNAYFLIP_GEOMETRY_SURFACE;
  options->tie_rule = variant == 1;
  options->criterion = variant == 2 || variant == 6;
  options->tolerance = variant == 2 ? 0.1 : -1;
  options->feature_angle = variant == 4 ? 75.5 : variant == 5 ? 180 : 20;
  options->maximum_deviation = variant == 7 ? 0.25 : 1e300;
  if (variant >= 8)
  {
    options->geometry = DELAUNAYFLIP_GEOMETRY_PLANAR_XY;
    options->minimum_angle = variant == 8 ? 25 : 0;
    options->maximum_edge = variant == 9 ? 5.7 : 0;
  }
}

static void HashOfMesh(int variant, int roughness, int64_t side)
{
  static double xyz[3 * Most];
  static int64_t triangles[6 * Most];
  int32_t counts[2 * Most];
  const int64_t squares = side * side;
  delaunayflip_mesh mesh;
  delaunayflip_options options;
  delaunayflip_session* session;
  delaunayflip_report report;
  delaunayflip_mesh_init(&mesh);
  delaunayflip_options_init(&options);
  MakeTerrain(side, roughness, xyz, triangles);
  SetMeshOptions(variant, &options);
  mesh.points = xyz;
  mesh.number_of_points = (side + 1) * (side + 1);
  mesh.triangles = triangles;
  mesh.number_of_triangles = 2 * squares;
  CHECK(delaunayflip_open(&mesh, &options, NULL, &session) == DELAUNAYFLIP_OK);
  report = Finish(session);
  AddTriangles(session);
  if (report.refinement_points == 0)
  {
    CHECK(delaunayflip_store_flip_counts(session, counts) == DELAUNAYFLIP_OK);
    AddNarrow(counts, 2 * squares);
  }
  else
  {
    const int64_t added = report.refinement_points;
    double *places = Allocate(24 * added), *weights = Allocate(24 * added);
    int64_t* ids = Allocate(24 * added);
    CHECK(delaunayflip_store_refined_points(session, places, ids, weights) == DELAUNAYFLIP_OK);
    AddDoubles(places, 3 * added);
    AddIntegers(ids, 3 * added);
    AddDoubles(weights, 3 * added);
    free(places);
    free(weights);
    free(ids);
  }
  delaunayflip_close(session);
}

/* Points that are moved, and of which some are removed. */
static void HashOfMoves(int kind, int64_t count)
{
  static double xy[2 * Most], next[2 * Most];
  const int64_t removed[] = { 3, 7, 8, count / 2 };
  int64_t i;
  delaunayflip_points points, places;
  delaunayflip_session* session;
  delaunayflip_points_init(&points);
  delaunayflip_points_init(&places);
  DrawPlaces(kind, count, xy);
  for (i = 0; i < 2 * count; ++i)
  {
    next[i] = xy[i] + (double)(Draw(2001) - 1000) / 512;
  }
  points.points = xy;
  places.points = next;
  points.number_of_points = places.number_of_points = count;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  Finish(session);
  CHECK(delaunayflip_move_points(session, &places, NULL, NULL) == DELAUNAYFLIP_OK);
  AddTriangles(session);
  CHECK(delaunayflip_remove_points(session, removed, 4, NULL) == DELAUNAYFLIP_OK);
  AddTriangles(session);
  delaunayflip_close(session);
}

static FILE* File;
static int IsWriting, Number, Different;

static void End(const char* what, int kind, int variant, int64_t size)
{
  char line[80], expected[80];
  snprintf(line, sizeof(line), "%s %d %d %d %016llx\n", what, kind, variant, (int)size,
    (unsigned long long)Hash);
  ++Number;
  if (IsWriting)
  {
    fputs(line, File);
  }
  else if (!fgets(expected, sizeof(expected), File) || strcmp(line, expected) != 0)
  {
    ++Different;
    printf("different: %s", line);
  }
  Hash = 14695981039346656037u;
  State = (uint64_t)Number;
}

static void HashAll(void)
{
  static const int64_t Sizes[] = { 30, 700 };
  int kind, variant, size;
  for (size = 0; size < 2; ++size)
  {
    for (kind = 0; kind < Kinds; ++kind)
    {
      for (variant = 0; variant < PointVariants; ++variant)
      {
        HashOfPoints(kind, variant, Sizes[size]);
        End("points", kind, variant, Sizes[size]);
      }
      HashOfMoves(kind, 2 * Sizes[size]);
      End("moves", kind, 0, Sizes[size]);
    }
    for (kind = 0; kind < 3; ++kind)
    {
      for (variant = DELAUNAYFLIP_SPHERE; variant <= DELAUNAYFLIP_OPEN_SPHERE; ++variant)
      {
        HashOfSphere(kind, variant, 2 * Sizes[size]);
        End("sphere", kind, variant, Sizes[size]);
      }
    }
    for (variant = 0; variant < MeshVariants; ++variant)
    {
      for (kind = 0; kind < 4; ++kind)
      {
        HashOfMesh(variant, 4 * kind, 6 + 30 * size);
        End("mesh", kind, variant, Sizes[size]);
      }
    }
  }
}

int main(int count, char** arguments)
{
  CHECK(count > 1);
  IsWriting = count > 2 && strcmp(arguments[2], "--write") == 0;
  File = fopen(arguments[1], IsWriting ? "wb" : "rb");
  CHECK(File != NULL);
  Hash = 14695981039346656037u;
  HashAll();
  fclose(File);
  printf("%d hashes, %d different\n", Number, Different);
  return Different > 0;
}
