/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#include "check.h"

#include <cuda_runtime_api.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** @file
 * Arrays in the memory of a GPU, from C. The exit status is 77 if there is none.
 */

enum
{
  Skipped = 77
};

/* A quad. Its short diagonal, from point 1 to point 3, is the Delaunay edge. */
static const float Points[] = { 0, 0, 2, -1, 4, 0, 2, 1 };
static const int64_t LongDiagonal[] = { 0, 1, 2, 0, 2, 3 };

static void* Upload(const void* values, size_t bytes)
{
  void* memory = NULL;
  CHECK(cudaMalloc(&memory, bytes) == cudaSuccess);
  CHECK(cudaMemcpy(memory, values, bytes, cudaMemcpyHostToDevice) == cudaSuccess);
  return memory;
}

static int HasShortDiagonalThere(const int64_t* onDevice)
{
  int64_t triangles[6];
  CHECK(cudaMemcpy(triangles, onDevice, sizeof(triangles), cudaMemcpyDeviceToHost) == cudaSuccess);
  return HasShortDiagonal(triangles);
}

static delaunayflip_mesh MakeMesh(void)
{
  delaunayflip_mesh mesh;
  delaunayflip_mesh_init(&mesh);
  mesh.memory = DELAUNAYFLIP_CUDA;
  mesh.points = Upload(Points, sizeof(Points));
  mesh.number_of_points = 4;
  mesh.point_type = DELAUNAYFLIP_FLOAT32;
  mesh.point_components = 2;
  mesh.triangles = Upload(LongDiagonal, sizeof(LongDiagonal));
  mesh.number_of_triangles = 2;
  return mesh;
}

static void TestFlip(const delaunayflip_mesh* mesh)
{
  int64_t* result = Upload(LongDiagonal, sizeof(LongDiagonal));
  delaunayflip_report report;
  delaunayflip_report_init(&report);
  CHECK(delaunayflip_flip(mesh, NULL, NULL, result, &report) == DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonalThere(result));
  CHECK(strncmp(report.backend, "CUDA: ", 6) == 0);
  CHECK(!HasShortDiagonalThere(mesh->triangles));
  CHECK(cudaFree(result) == cudaSuccess);
}

static void TestSession(const delaunayflip_mesh* mesh)
{
  int64_t* result = Upload(LongDiagonal, sizeof(LongDiagonal));
  int32_t* counts = Upload(LongDiagonal, 2 * sizeof(int32_t));
  int32_t flips[2];
  delaunayflip_session* session;
  CHECK(delaunayflip_open(mesh, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_triangles_on_device(session, result, DELAUNAYFLIP_INT64, NULL) ==
    DELAUNAYFLIP_OK);
  CHECK(!HasShortDiagonalThere(result));
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_store_triangles_on_device(session, result, DELAUNAYFLIP_INT64, NULL) ==
    DELAUNAYFLIP_OK);
  CHECK(HasShortDiagonalThere(result));
  CHECK(delaunayflip_store_flip_counts_on_device(session, counts, NULL) == DELAUNAYFLIP_OK);
  CHECK(cudaMemcpy(flips, counts, sizeof(flips), cudaMemcpyDeviceToHost) == cudaSuccess);
  CHECK(flips[0] == 1 && flips[1] == 1);
  delaunayflip_close(session);
  CHECK(cudaFree(result) == cudaSuccess);
  CHECK(cudaFree(counts) == cudaSuccess);
}

/** Points, places, values and results are all on the GPU. */
static void TestQuery(const delaunayflip_mesh* mesh)
{
  const double values[] = { 0, 2, 4, 2 }; /* x */
  const float places[] = { 1, 0.25, 2, 0.5, 9, 9 };
  double results[3];
  delaunayflip_session* session;
  delaunayflip_points points;
  delaunayflip_query query;
  delaunayflip_points_init(&points);
  points.points = mesh->points;
  points.number_of_points = 4;
  points.point_type = DELAUNAYFLIP_FLOAT32;
  points.memory = DELAUNAYFLIP_CUDA;
  CHECK(delaunayflip_open_points(&points, NULL, NULL, &session) == DELAUNAYFLIP_OK);
  CHECK(delaunayflip_advance(session, -1, NULL, NULL) == DELAUNAYFLIP_OK);
  delaunayflip_query_init(&query);
  query.memory = DELAUNAYFLIP_CUDA;
  query.places = Upload(places, sizeof(places));
  query.number_of_places = 3;
  query.place_type = DELAUNAYFLIP_FLOAT32;
  query.values = Upload(values, sizeof(values));
  query.results = Upload(values, sizeof(results));
  CHECK(delaunayflip_ask(session, &query, NULL) == DELAUNAYFLIP_OK);
  CHECK(cudaMemcpy(results, query.results, sizeof(results), cudaMemcpyDeviceToHost) == cudaSuccess);
  CHECK(fabs(results[0] - 1) < 1e-12 && fabs(results[1] - 2) < 1e-12 && isnan(results[2]));
  delaunayflip_close(session);
  CHECK(cudaFree((void*)query.places) == cudaSuccess);
  CHECK(cudaFree((void*)query.values) == cudaSuccess);
  CHECK(cudaFree(query.results) == cudaSuccess);
}

int main(void)
{
  delaunayflip_mesh mesh;
  if (!delaunayflip_has_cuda_device())
  {
    printf("skipped: no GPU\n");
    return Skipped;
  }
  mesh = MakeMesh();
  TestFlip(&mesh);
  TestSession(&mesh);
  TestQuery(&mesh);
  CHECK(cudaFree((void*)mesh.points) == cudaSuccess);
  CHECK(cudaFree((void*)mesh.triangles) == cudaSuccess);
  printf("passed\n");
  return 0;
}
