// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "delaunayflip_c.h"

#include "CallerInput.h"
#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "KeptReport.h"
#include "PolygonSplit.h"
#include "Status.h"
#include "TriangleAngles.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

using namespace delaunayflip;

namespace
{

void RequireReport(const delaunayflip_report* report)
{
  Require(report && report->size >= static_cast<std::int64_t>(sizeof(report->size)),
    "report is null, or its size is not set: call delaunayflip_report_init first");
}

FlipReport Flip(const delaunayflip_mesh& c, const FlipOptions& options,
  const MutableTriangleArray& triangles, const Observers& observers)
{
  return IsOnDevice(c)
    ? FlipToDelaunay(ToDeviceMesh(c), options, triangles, observers.Iteration, observers.Progress)
    : FlipToDelaunay(ToMesh(c), options, triangles, observers.Iteration, observers.Progress);
}

}

struct delaunayflip_session
{
  delaunayflip_session(
    const delaunayflip_mesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
    : Session(IsOnDevice(mesh) ? FlipSession(ToDeviceMesh(mesh), options, progress)
                               : FlipSession(ToMesh(mesh), options, progress)),
      NumberOfTriangles(mesh.number_of_triangles),
      TriangleNumbers(mesh.triangle_numbers)
  {
  }

  FlipSession Session;
  std::int64_t NumberOfTriangles;
  const std::int64_t* TriangleNumbers; ///< Of the caller, or null.
  std::unique_ptr<KeptReport> Report;
};

extern "C"
{

  std::int32_t delaunayflip_interface_version(void) { return DELAUNAYFLIP_INTERFACE_VERSION; }

  const char* delaunayflip_version(void) { return DELAUNAYFLIP_RELEASE; }

  const char* delaunayflip_error_message(void) { return GetLastError().Message.c_str(); }

  std::int64_t delaunayflip_error_cell(void) { return GetLastError().Cell; }

  std::int64_t delaunayflip_error_point(void) { return GetLastError().Point; }

  void delaunayflip_mesh_init(delaunayflip_mesh* mesh)
  {
    *mesh = MakeEmpty<delaunayflip_mesh>();
    mesh->point_type = DELAUNAYFLIP_FLOAT64;
    mesh->id_type = DELAUNAYFLIP_INT64;
    mesh->point_components = 3;
  }

  void delaunayflip_options_init(delaunayflip_options* options)
  {
    const FlipOptions defaults;
    *options = MakeEmpty<delaunayflip_options>();
    options->tolerance = defaults.Tolerance;
    options->feature_angle = defaults.FeatureAngle;
    options->maximum_iterations = defaults.MaximumIterations;
    options->number_of_threads = defaults.NumberOfThreads;
    options->device = defaults.Device;
    options->devices = nullptr;
  }

  void delaunayflip_report_init(delaunayflip_report* report)
  {
    *report = MakeEmpty<delaunayflip_report>();
    for (const char** text : { &report->geometry_reason, &report->backend, &report->fallback,
           &report->tolerance, &report->defects })
    {
      *text = "";
    }
  }

  void delaunayflip_callbacks_init(delaunayflip_callbacks* callbacks)
  {
    *callbacks = MakeEmpty<delaunayflip_callbacks>();
  }

  delaunayflip_status delaunayflip_open(const delaunayflip_mesh* mesh,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks,
    delaunayflip_session** session)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        *session = new delaunayflip_session(
          CompleteMesh(mesh), ToOptions(options), Observers(callbacks).Progress);
      });
  }

  delaunayflip_status delaunayflip_advance(delaunayflip_session* session, std::int64_t iterations,
    const delaunayflip_callbacks* callbacks, std::int32_t* is_running)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        Require(iterations >= -1, "iterations is less than -1");
        const Observers observers(callbacks);
        const bool isRunning =
          session->Session.Advance(iterations, observers.Iteration, observers.Progress);
        if (is_running)
        {
          *is_running = isRunning ? 1 : 0;
        }
      });
  }

  delaunayflip_status delaunayflip_get_report(
    delaunayflip_session* session, delaunayflip_report* report)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        RequireReport(report);
        session->Report =
          std::make_unique<KeptReport>(session->Session.GetReport(), session->TriangleNumbers);
        session->Report->Fill(*report);
      });
  }

  delaunayflip_status delaunayflip_get_iterations(delaunayflip_session* session, std::int64_t first,
    std::int64_t count, delaunayflip_iteration* records, std::int64_t record_size)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        Require(record_size > 0, "record_size is not positive");
        const std::vector<IterationRecord>& iterations = session->Session.GetReport().Iterations;
        const auto known = static_cast<std::int64_t>(iterations.size());
        Require(first >= 0 && count >= 0 && first <= known && count <= known - first,
          "first and count name iterations that were not made");
        Require(records || count == 0, "records is null");
        auto* bytes = reinterpret_cast<unsigned char*>(records);
        for (std::int64_t i = 0; i < count; ++i)
        {
          const delaunayflip_iteration record = ToC(iterations[first + i]);
          std::memcpy(bytes + i * record_size, &record,
            std::min(sizeof(record), static_cast<std::size_t>(record_size)));
        }
      });
  }

  delaunayflip_status delaunayflip_store_triangles(
    delaunayflip_session* session, void* triangles, std::int32_t id_type)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        session->Session.StoreTriangles(ToOutput(triangles, session->NumberOfTriangles, id_type));
      });
  }

  delaunayflip_status delaunayflip_store_flip_counts(
    delaunayflip_session* session, std::int32_t* counts)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        Require(counts || session->NumberOfTriangles == 0, "counts is null");
        session->Session.StoreFlipCounts(counts);
      });
  }

  delaunayflip_status delaunayflip_store_triangles_on_device(
    delaunayflip_session* session, void* triangles, std::int32_t id_type, void* stream)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        session->Session.StoreTriangles(
          ToOutput(triangles, session->NumberOfTriangles, id_type), DeviceStream{ stream });
      });
  }

  delaunayflip_status delaunayflip_store_flip_counts_on_device(
    delaunayflip_session* session, std::int32_t* counts, void* stream)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        Require(counts || session->NumberOfTriangles == 0, "counts is null");
        session->Session.StoreFlipCounts(counts, DeviceStream{ stream });
      });
  }

  void delaunayflip_close(delaunayflip_session* session) { delete session; }

  delaunayflip_status delaunayflip_flip(const delaunayflip_mesh* mesh,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks, void* triangles,
    delaunayflip_report* report)
  {
    return Try(
      [=]()
      {
        const delaunayflip_mesh c = CompleteMesh(mesh);
        if (report)
        {
          RequireReport(report);
        }
        const FlipReport result = Flip(c, ToOptions(options),
          ToOutput(triangles, c.number_of_triangles, c.id_type), Observers(callbacks));
        if (report)
        {
          thread_local std::unique_ptr<KeptReport> kept;
          kept = std::make_unique<KeptReport>(result, c.triangle_numbers);
          kept->Fill(*report);
        }
      });
  }

  delaunayflip_status delaunayflip_triangle_angles(
    const delaunayflip_mesh* mesh, std::int32_t geometry, double* angles)
  {
    return Try(
      [=]()
      {
        const TriangleMesh view = ToMesh(CompleteMesh(mesh));
        Require(angles || view.Triangles.Count == 0, "angles is null");
        FindSmallestAngles(view, ToGeometry(geometry), 0, angles);
      });
  }

  delaunayflip_status delaunayflip_triangle_normals(const delaunayflip_mesh* mesh, double* normals)
  {
    return Try(
      [=]()
      {
        const TriangleMesh view = ToMesh(CompleteMesh(mesh));
        Require(normals || view.Triangles.Count == 0, "normals is null");
        RequireValidIds(view);
        for (std::int64_t t = 0; t < view.Triangles.Count; ++t)
        {
          const std::int64_t ids[3] = { view.Triangles.Get(t, 0), view.Triangles.Get(t, 1),
            view.Triangles.Get(t, 2) };
          TriangleNormal(view.Points, ids, normals + 3 * t);
        }
      });
  }

  std::int32_t delaunayflip_has_cuda_device(void) { return HasCudaDevice() ? 1 : 0; }

  void delaunayflip_release_cuda_memory(void) { ReleaseCudaMemory(); }
}
