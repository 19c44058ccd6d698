// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionCalls.h"

#include "CudaDevice.h"
#include "PolygonSplit.h"
#include "TriangleAngles.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

using namespace delaunayflip;

namespace
{

/// The last error in a thread.
struct LastError
{
  char Message[1024] = ""; ///< Takes no memory that may be lacking; longer ones are cut off.
  std::int64_t Cell = -1;
  std::int64_t Point = -1;
  std::int64_t Ring = -1;
};

thread_local LastError TheLastError;

/// The triangles of all polygons, and how many each has.
struct SplitPolygons
{
  std::vector<std::int64_t> Triangles;
  std::vector<std::int64_t> Counts; ///< None if the caller has no room for them.
};

SplitPolygons Split(
  const PointArray& points, const delaunayflip_polygons& polygons, const ProgressObserver& progress)
{
  Require(polygons.number_of_polygons >= 0, "number_of_polygons is negative");
  Require(polygons.offsets || polygons.number_of_polygons == 0, "offsets is null");
  constexpr std::int64_t PolygonsBetweenCalls = 4096;
  SplitPolygons split;
  std::vector<std::int64_t>& triangles = split.Triangles;
  const auto all = static_cast<double>(polygons.number_of_polygons);
  for (std::int64_t i = 0; i < polygons.number_of_polygons; ++i)
  {
    const std::int64_t begin = polygons.offsets[i];
    const std::int64_t end = polygons.offsets[i + 1];
    Require(begin >= 0 && begin <= end, "offsets decrease, or are negative");
    Require(polygons.corners || begin == end, "corners is null");
    for (std::int64_t corner = begin; corner < end; ++corner)
    {
      const std::int64_t id = polygons.corners[corner];
      if (id < 0 || id >= points.Count)
      {
        throw InvalidMesh("polygon " + std::to_string(i) + " names point " + std::to_string(id) +
            ", but there are " + std::to_string(points.Count) + " points, numbered from 0",
          i, id);
      }
    }
    const auto part = [&](double share)
    { return !progress || progress((static_cast<double>(i) + share) / all); };
    const auto before = static_cast<std::int64_t>(triangles.size() / 3);
    if ((i % PolygonsBetweenCalls == 0 && !part(0.0)) ||
      (end - begin >= 3 &&
        !SplitPolygon(points, polygons.corners + begin, end - begin, triangles, part)))
    {
      throw RunAborted();
    }
    const std::int64_t made = static_cast<std::int64_t>(triangles.size() / 3) - before;
    if (polygons.triangle_counts)
    {
      split.Counts.push_back(made);
    }
    else if (end - begin > 3 && made < end - begin - 2)
    {
      throw InvalidMesh("polygon " + std::to_string(i) +
          " names a point twice in a row, or only two points, and so gives fewer triangles: "
          "triangle_counts is needed to tell how many",
        i, -1);
    }
  }
  return split;
}

}

namespace delaunayflip
{

delaunayflip_status Fail(delaunayflip_status status, const char* message, std::int64_t cell,
  std::int64_t point, std::int64_t ring)
{
  std::snprintf(TheLastError.Message, sizeof(TheLastError.Message), "%s", message);
  TheLastError.Cell = cell;
  TheLastError.Point = point;
  TheLastError.Ring = ring;
  return status;
}

delaunayflip_status StatusOf(const std::exception& error)
{
  if (dynamic_cast<const InvalidCall*>(&error))
  {
    return DELAUNAYFLIP_INVALID_CALL;
  }
  if (dynamic_cast<const InvalidOptions*>(&error))
  {
    return DELAUNAYFLIP_INVALID_OPTIONS;
  }
  if (dynamic_cast<const MeshTooLarge*>(&error))
  {
    return DELAUNAYFLIP_MESH_TOO_LARGE;
  }
  if (dynamic_cast<const BackendUnavailable*>(&error))
  {
    return DELAUNAYFLIP_BACKEND_UNAVAILABLE;
  }
  return DELAUNAYFLIP_FAILED;
}

}

extern "C"
{

  std::int32_t delaunayflip_interface_version(void) { return DELAUNAYFLIP_INTERFACE_VERSION; }

  const char* delaunayflip_version(void) { return DELAUNAYFLIP_RELEASE; }

  const char* delaunayflip_error_message(void) { return TheLastError.Message; }

  std::int64_t delaunayflip_error_cell(void) { return TheLastError.Cell; }

  std::int64_t delaunayflip_error_point(void) { return TheLastError.Point; }

  std::int64_t delaunayflip_error_ring(void) { return TheLastError.Ring; }

  void delaunayflip_mesh_init_sized(delaunayflip_mesh* mesh, std::int64_t size)
  {
    auto values = MakeEmpty<delaunayflip_mesh>();
    values.point_type = DELAUNAYFLIP_FLOAT64;
    values.id_type = DELAUNAYFLIP_INT64;
    values.point_components = 3;
    Initialize(mesh, size, values);
  }

  void delaunayflip_points_init_sized(delaunayflip_points* points, std::int64_t size)
  {
    auto values = MakeEmpty<delaunayflip_points>();
    values.point_type = DELAUNAYFLIP_FLOAT64;
    values.point_components = 2;
    values.first_hole = PointInput().FirstHole;
    values.first_added = PointInput().FirstAdded;
    const PointOptions defaults;
    PairPointOptions(
      values, defaults, [](auto& wanted, const auto& option) { CopyOption(option, wanted); });
    Initialize(points, size, values);
  }

  void delaunayflip_query_init_sized(delaunayflip_query* query, std::int64_t size)
  {
    auto values = MakeEmpty<delaunayflip_query>();
    values.place_type = DELAUNAYFLIP_FLOAT64;
    values.place_components = 2;
    values.step_x = values.step_y = 1.0;
    values.value_components = 1;
    Initialize(query, size, values);
  }

  void delaunayflip_options_init_sized(delaunayflip_options* options, std::int64_t size)
  {
    const FlipOptions defaults;
    auto values = MakeEmpty<delaunayflip_options>();
    PairOptions(
      values, defaults, [](auto& wanted, const auto& option) { CopyOption(option, wanted); });
    Initialize(options, size, values);
  }

  void delaunayflip_report_init_sized(delaunayflip_report* report, std::int64_t size)
  {
    auto values = MakeEmpty<delaunayflip_report>();
    values.geometry_reason = values.backend = values.fallback = "";
    values.tolerance = values.defects = "";
    Initialize(report, size, values);
  }

  void delaunayflip_callbacks_init_sized(delaunayflip_callbacks* callbacks, std::int64_t size)
  {
    Initialize(callbacks, size, MakeEmpty<delaunayflip_callbacks>());
  }

  void delaunayflip_polygons_init_sized(delaunayflip_polygons* polygons, std::int64_t size)
  {
    Initialize(polygons, size, MakeEmpty<delaunayflip_polygons>());
  }

  delaunayflip_status delaunayflip_open(const delaunayflip_mesh* mesh,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks,
    delaunayflip_session** session)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        const delaunayflip_mesh c = Complete(mesh, delaunayflip_mesh_init_sized);
        const FlipOptions wanted = ToOptions(options);
        std::vector<RegionSeed> seeds =
          ToRegions(c.region_seeds, c.number_of_region_seeds, "region_seeds");
        const bool isRefined = wanted.MinimumAngle > 0.0 || wanted.MaximumArea > 0.0 ||
          wanted.MaximumEdge > 0.0 || c.sizes ||
          std::any_of(seeds.begin(), seeds.end(),
            [](const RegionSeed& seed) { return seed.MaximumArea > 0.0; });
        const ProgressOfCall progress(callbacks);
        const auto open = [&](const auto& view)
        { return FlipSession(view, wanted, progress.Get()); };
        FlipSession opened =
          IsOnDevice(c.memory) ? open(ToDeviceMesh(c, seeds)) : open(ToMesh(&c, seeds));
        *session = new delaunayflip_session{ std::move(opened), false, isRefined,
          c.number_of_triangles, c.triangle_numbers, {}, std::move(seeds) };
      });
  }

  delaunayflip_status delaunayflip_open_points(const delaunayflip_points* points,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks,
    delaunayflip_session** session)
  {
    return Try(
      [=]()
      {
        Require(session, "session is null");
        const delaunayflip_points c = Complete(points, delaunayflip_points_init_sized);
        std::vector<RegionSeed> regions = ToRegions(c.regions, c.number_of_regions, "regions");
        const ProgressOfCall progress(callbacks);
        FlipSession opened(
          ToPointInput(c, regions), ToPointOptions(c, ToOptions(options)), progress.Get());
        *session = new delaunayflip_session{ std::move(opened), true, true, 0, nullptr, {},
          std::move(regions) };
      });
  }

  delaunayflip_status delaunayflip_place_on_sphere(
    const double* degrees, std::int64_t number_of_places, double* xyz)
  {
    return Try(
      [=]()
      {
        Require(number_of_places >= 0, "number_of_places is negative");
        Require((degrees && xyz) || number_of_places == 0, "degrees or xyz is null");
        for (std::int64_t i = 0; i < number_of_places; ++i)
        {
          PlaceOnSphere(degrees[2 * i], degrees[2 * i + 1], xyz + 3 * i);
        }
      });
  }

  delaunayflip_status delaunayflip_insert_points(delaunayflip_session* session,
    const delaunayflip_points* points, const delaunayflip_callbacks* callbacks)
  {
    return TryWith(session,
      [=]()
      {
        const delaunayflip_points c = Complete(points, delaunayflip_points_init_sized);
        Require(!IsOnDevice(c.memory), "points to insert must be in the host's memory");
        RequireNotStopped(session->Session.Insert(ToPlane(c), ToProgress(callbacks)));
      });
  }

  delaunayflip_status delaunayflip_move_points(delaunayflip_session* session,
    const delaunayflip_points* places, const std::int64_t* ids,
    const delaunayflip_callbacks* callbacks)
  {
    return TryWith(session,
      [=]()
      {
        const delaunayflip_points c = Complete(places, delaunayflip_points_init_sized);
        Require(!ids || !IsOnDevice(c.memory), "with ids, the places must be in the host's memory");
        const PointMove move{ ToPlane(c), ids, IsOnDevice(c.memory), { c.stream } };
        RequireNotStopped(session->Session.Move(move, ToProgress(callbacks)));
      });
  }

  delaunayflip_status delaunayflip_remove_points(delaunayflip_session* session,
    const std::int64_t* ids, std::int64_t number_of_ids, const delaunayflip_callbacks* callbacks)
  {
    return TryWith(session,
      [=]()
      {
        RequireArray(ids, number_of_ids, "ids");
        RequireNotStopped(session->Session.Remove(ids, number_of_ids, ToProgress(callbacks)));
      });
  }

  delaunayflip_status delaunayflip_compact_points(
    delaunayflip_session* session, const delaunayflip_callbacks* callbacks)
  {
    return TryWith(
      session, [=]() { RequireNotStopped(session->Session.Compact(ToProgress(callbacks))); });
  }

  std::int64_t delaunayflip_count_triangles(const delaunayflip_session* session)
  {
    return session ? session->Session.CountTriangles() : 0;
  }

  delaunayflip_status delaunayflip_ask(delaunayflip_session* session,
    const delaunayflip_query* query, const delaunayflip_callbacks* callbacks)
  {
    return TryWith(session,
      [=]() { RequireNotStopped(session->Session.Ask(ToQuery(query), ToProgress(callbacks))); });
  }

  delaunayflip_status delaunayflip_expect(
    delaunayflip_session* session, void* memory, std::int64_t bytes)
  {
    return TryWith(session,
      [=]()
      {
        Require(bytes >= 0 && (memory || bytes == 0), "memory is null, or bytes is negative");
        session->Session.Expect(memory, bytes);
      });
  }

  delaunayflip_status delaunayflip_advance(delaunayflip_session* session, std::int64_t iterations,
    const delaunayflip_callbacks* callbacks, std::int32_t* is_running)
  {
    return TryWith(session,
      [=]()
      {
        Require(iterations >= -1, "iterations is less than -1");
        const bool isRunning =
          session->Session.Advance(iterations, ToObserver(callbacks), ToProgress(callbacks));
        if (is_running)
        {
          *is_running = isRunning ? 1 : 0;
        }
      });
  }

  delaunayflip_status delaunayflip_get_report(
    delaunayflip_session* session, delaunayflip_report* report)
  {
    return TryWith(session,
      [=]()
      {
        RequireSize(report);
        session->Report.Fill(session->Session.GetReport(), session->TriangleNumbers, *report);
      });
  }

  delaunayflip_status delaunayflip_summarize(const delaunayflip_report* report, const char** text)
  {
    return Try(
      [=]()
      {
        Require(text, "text is null");
        thread_local std::string kept;
        SummaryNotes notes;
        const FlipReport all = ToReport(report, notes.Iterations);
        kept = Summarize(all, notes);
        *text = kept.c_str();
      });
  }

  delaunayflip_status delaunayflip_get_iterations(delaunayflip_session* session, std::int64_t first,
    std::int64_t count, delaunayflip_iteration* records, std::int64_t record_size)
  {
    return TryWith(session,
      [=]()
      {
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

  std::int64_t delaunayflip_count_defects(const delaunayflip_session* session)
  {
    return session ? session->Report.CountDefects() : 0;
  }

  delaunayflip_status delaunayflip_get_defects(delaunayflip_session* session, std::int64_t first,
    std::int64_t count, delaunayflip_defect* defects, std::int64_t defect_size)
  {
    return TryWith(session,
      [=]()
      {
        Require(defect_size > 0, "defect_size is not positive");
        const std::int64_t known = session->Report.CountDefects();
        Require(first >= 0 && count >= 0 && first <= known && count <= known - first,
          "first and count name defects that the report does not have");
        Require(defects || count == 0, "defects is null");
        auto* bytes = reinterpret_cast<unsigned char*>(defects);
        for (std::int64_t i = 0; i < count; ++i)
        {
          const delaunayflip_defect defect = session->Report.GetDefect(first + i);
          std::memcpy(bytes + i * defect_size, &defect,
            std::min(sizeof(defect), static_cast<std::size_t>(defect_size)));
        }
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
        const delaunayflip_mesh c = Complete(mesh, delaunayflip_mesh_init_sized);
        if (report)
        {
          RequireSize(report);
        }
        const auto flip = [&](const auto& view)
        {
          return FlipToDelaunay(view, ToOptions(options),
            ToOutput(triangles, c.number_of_triangles, c.id_type), ToObserver(callbacks),
            ToProgress(callbacks));
        };
        const std::vector<RegionSeed> seeds =
          ToRegions(c.region_seeds, c.number_of_region_seeds, "region_seeds");
        const FlipReport result =
          IsOnDevice(c.memory) ? flip(ToDeviceMesh(c, seeds)) : flip(ToMesh(&c, seeds));
        if (report)
        {
          thread_local KeptReport kept;
          kept.Fill(result, c.triangle_numbers, *report);
        }
      });
  }

  delaunayflip_status delaunayflip_triangle_angles(
    const delaunayflip_mesh* mesh, std::int32_t geometry, double* angles)
  {
    return Try(
      [=]()
      {
        const TriangleMesh view = ToMesh(mesh);
        Require(angles || view.Triangles.Count == 0, "angles is null");
        FindSmallestAngles(
          view, ToEnumeration(geometry, GeometryKind::Sphere, "geometry"), 0, angles);
      });
  }

  delaunayflip_status delaunayflip_triangle_normals(const delaunayflip_mesh* mesh, double* normals)
  {
    return Try(
      [=]()
      {
        const TriangleMesh view = ToMesh(mesh);
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

  delaunayflip_status delaunayflip_split_polygons(const delaunayflip_mesh* mesh,
    const delaunayflip_polygons* polygons, const delaunayflip_callbacks* callbacks,
    std::int64_t* triangles)
  {
    return Try(
      [=]()
      {
        const TriangleMesh view = ToMesh(mesh);
        const auto c = Complete(polygons, delaunayflip_polygons_init_sized);
        const SplitPolygons split = Split(view.Points, c, ToProgress(callbacks));
        Require(triangles || split.Triangles.empty(), "triangles is null");
        std::copy(split.Triangles.begin(), split.Triangles.end(), triangles);
        std::copy(split.Counts.begin(), split.Counts.end(), c.triangle_counts);
      });
  }

  std::int32_t delaunayflip_has_cuda_device(void) { return HasCudaDevice() ? 1 : 0; }

  void delaunayflip_release_cuda_memory(void) { ReleaseCudaMemory(); }
}
