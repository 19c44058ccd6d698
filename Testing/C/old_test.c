/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#define DELAUNAYFLIP_BUILDS_C_LIBRARY /* without the inline functions of the header */
#include "check.h"

#include <stddef.h>
#include <string.h>

/** @file
 * Programs that were compiled with another header than the library's: their structs are shorter or
 * longer. The library must not write beyond them.
 */

/* The functions of 0.2.0. */
void delaunayflip_mesh_init(void* mesh);
void delaunayflip_options_init(void* options);
void delaunayflip_report_init(void* report);
void delaunayflip_callbacks_init(void* callbacks);
void delaunayflip_points_init(void* points);
void delaunayflip_query_init(void* query);
void delaunayflip_polygons_init(void* polygons);

enum
{
  BYTES = 1024,
  CANARY = 0x5a
};

/* The header of 0.1.0. */
typedef struct
{
  int64_t size;
  const void* points;
  int64_t number_of_points;
  const void* triangles;
  int64_t number_of_triangles;
  int32_t point_type;
  int32_t id_type;
  const int64_t* constraint_edges;
  int64_t number_of_constraint_edges;
  const unsigned char* constraints_to_insert;
  const int32_t* regions;
  const unsigned char* frozen_triangles;
} OldMesh;

typedef union
{
  int64_t size;
  unsigned char bytes[BYTES];
  OldMesh old_mesh;
  delaunayflip_mesh mesh;
  delaunayflip_report report;
  delaunayflip_query query;
} Room;

/* How many bytes of the room were written. */
static int64_t CountWritten(const Room* room)
{
  int64_t count = BYTES;
  while (count > 0 && room->bytes[count - 1] == CANARY)
  {
    --count;
  }
  return count;
}

static Room MakeRoom(void)
{
  Room room;
  memset(&room, CANARY, sizeof(room));
  return room;
}

/* A program with a short mesh, and a report that ends before the numbers. */
static void TestShorterStructs(void)
{
  const double points[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
  const int64_t ids[] = { 0, 1, 2, 0, 2, 3 };
  const int64_t report_size = offsetof(delaunayflip_report, total_flips);
  int64_t triangles[6];
  Room room = MakeRoom(), report = MakeRoom();
  delaunayflip_mesh_init_sized(&room.mesh, sizeof(OldMesh));
  CHECK(CountWritten(&room) == sizeof(OldMesh) && room.size == sizeof(OldMesh));
  CHECK(room.mesh.id_type == DELAUNAYFLIP_INT64 && room.mesh.frozen_triangles == NULL);
  room.old_mesh.points = points;
  room.old_mesh.number_of_points = 4;
  room.old_mesh.triangles = ids;
  room.old_mesh.number_of_triangles = 2;
  delaunayflip_report_init_sized(&report.report, report_size);
  CHECK(delaunayflip_flip(&room.mesh, NULL, NULL, triangles, &report.report) == DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonal(triangles));
  CHECK(CountWritten(&report) == report_size && report.size == report_size);
  CHECK(report.report.number_of_iterations > 0);
}

/* A program with a longer struct than the library's gets 0 for the rest. Too few bytes for a size
 * are left alone. */
static void TestOtherSizes(void)
{
  const int64_t longer = sizeof(delaunayflip_query) + 8;
  Room room = MakeRoom();
  delaunayflip_query_init_sized(&room.query, longer);
  CHECK(CountWritten(&room) == longer && room.size == longer);
  CHECK(room.query.step_y == 1.0);
  CHECK(room.bytes[longer - 8] == 0 && room.bytes[longer - 1] == 0);
  room = MakeRoom();
  delaunayflip_query_init_sized(&room.query, 7);
  CHECK(CountWritten(&room) == 0);
}

/* The sizes of 0.2.0, which programs that were compiled then have. They never change. */
static void TestOldFunctions(void)
{
  const struct
  {
    void (*initialize)(void*);
    int64_t size;
  } old[] = {
    { delaunayflip_mesh_init, 136 },
    { delaunayflip_options_init, 120 },
    { delaunayflip_report_init, 496 },
    { delaunayflip_callbacks_init, 32 },
    { delaunayflip_points_init, 208 },
    { delaunayflip_query_init, 136 },
    { delaunayflip_polygons_init, 40 },
  };
  size_t i;
  for (i = 0; i < sizeof(old) / sizeof(old[0]) && sizeof(void*) == 8; ++i)
  {
    Room room = MakeRoom();
    old[i].initialize(&room);
    CHECK(CountWritten(&room) == old[i].size && room.size == old[i].size);
  }
}

int main(void)
{
  TestShorterStructs();
  TestOtherSizes();
  TestOldFunctions();
  return 0;
}
