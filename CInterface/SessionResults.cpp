// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionCalls.h"

#include <algorithm>
#include <functional>

/// @file
/// The functions that write what a session has made to arrays of the program.

using namespace delaunayflip;

namespace
{

/// Does work with a session from points, which writes `count(report)` values.
template <typename Count, typename Work>
delaunayflip_status TryWithPoints(
  const delaunayflip_session* session, const void* target, const Count& count, const Work& work)
{
  return TryWith(session,
    [&]()
    {
      if (!session->IsFromPoints) // the error of all functions that such a session does not have
      {
        throw InvalidOptions("this session was not made from points");
      }
      Require(target || std::invoke(count, session->Session.GetReport()) == 0, "an array is null");
      work();
    });
}

/// Does work with a session, which writes a value for each triangle to target.
template <typename Work>
delaunayflip_status TryPerTriangle(
  delaunayflip_session* session, const void* target, const char* isNull, const Work& work)
{
  return TryWith(session,
    [&]()
    {
      Require(target || session->CountTriangles() == 0, isNull);
      work();
    });
}

/// Writes to the host's memory, or with a stream to that of a GPU.
template <typename... Stream>
delaunayflip_status StoreTriangles(
  delaunayflip_session* session, void* triangles, std::int32_t type, Stream... stream)
{
  return TryWith(session,
    [=]()
    {
      session->Session.StoreTriangles(
        ToOutput(triangles, session->CountTriangles(), type), DeviceStream{ stream }...);
    });
}

/// Writes to the host's memory, or with a stream to that of a GPU.
template <typename... Stream>
delaunayflip_status StoreFlipCounts(
  delaunayflip_session* session, std::int32_t* counts, Stream... stream)
{
  return TryPerTriangle(session, counts, "counts is null",
    [=]() { session->Session.StoreFlipCounts(counts, DeviceStream{ stream }...); });
}

}

extern "C"
{

  delaunayflip_status delaunayflip_store_neighbors(
    delaunayflip_session* session, std::int32_t* neighbors)
  {
    return TryWithPoints(session, neighbors, &FlipReport::Triangles,
      [=]() { session->Session.StoreNeighbors(neighbors); });
  }

  delaunayflip_status delaunayflip_store_neighbors_on_device(
    delaunayflip_session* session, std::int32_t* neighbors, void* stream)
  {
    return TryWithPoints(session, neighbors, &FlipReport::Triangles,
      [=]() { session->Session.StoreNeighbors(neighbors, DeviceStream{ stream }); });
  }

  delaunayflip_status delaunayflip_store_used_points(
    delaunayflip_session* session, std::int64_t* ids)
  {
    return TryWithPoints(
      session, ids, &FlipReport::Points, [=]() { session->Session.StoreUsedPoints(ids); });
  }

  delaunayflip_status delaunayflip_store_added_points(
    delaunayflip_session* session, double* xy, std::int64_t* ends, double* shares)
  {
    return TryWithPoints(
      session, xy && ends ? shares : nullptr,
      [](const FlipReport& report) { return report.FromPoints.Crossings; },
      [=]()
      {
        const std::int64_t crossings = session->Session.GetReport().FromPoints.Crossings;
        for (std::int64_t i = 0; i < crossings; ++i)
        {
          const AddedPoint& point = session->Session.GetAddedPoints()[i];
          xy[2 * i] = point.X;
          xy[2 * i + 1] = point.Y;
          ends[2 * i] = point.From;
          ends[2 * i + 1] = point.To;
          shares[i] = point.Share;
        }
      });
  }

  delaunayflip_status delaunayflip_store_added_weights(delaunayflip_session* session, double* xy,
    std::int64_t* ids, double* weights, std::int64_t* segments)
  {
    return TryWithPoints(
      session, xy && ids ? weights : nullptr,
      [](const FlipReport& report)
      { return report.FromPoints.Crossings + report.FromPoints.RefinementPoints; },
      [=]()
      {
        AddedPointArrays arrays;
        arrays.Places = xy;
        arrays.Ids = ids;
        arrays.Weights = weights;
        arrays.Segments = segments;
        session->Session.StoreAddedPoints(arrays);
      });
  }

  delaunayflip_status delaunayflip_store_refined_points(
    delaunayflip_session* session, double* xyz, std::int64_t* ids, double* weights)
  {
    return TryWith(session,
      [=]()
      {
        if (session->IsFromPoints)
        {
          throw InvalidOptions("this session was made from points");
        }
        const std::int64_t added = session->Session.GetReport().FromPoints.RefinementPoints;
        Require((xyz && ids && weights) || added == 0, "an array is null");
        AddedPointArrays arrays;
        arrays.Places = xyz;
        arrays.Components = 3;
        arrays.Ids = ids;
        arrays.Weights = weights;
        session->Session.StoreAddedPoints(arrays);
      });
  }

  delaunayflip_status delaunayflip_store_sources(
    delaunayflip_session* session, std::int32_t* sources)
  {
    return TryPerTriangle(
      session, sources, "sources is null", [=]() { session->Session.StoreSources(sources); });
  }

  delaunayflip_status delaunayflip_store_regions(
    delaunayflip_session* session, std::int32_t* labels)
  {
    return TryPerTriangle(
      session, labels, "labels is null", [=]() { session->Session.StoreRegions(labels); });
  }

  delaunayflip_status delaunayflip_store_segments_of_edges(
    delaunayflip_session* session, std::int64_t* numbers)
  {
    return TryWithPoints(
      session, numbers, [](const FlipReport& report) { return report.FromPoints.SegmentEdges; },
      [=]()
      {
        const std::vector<std::int64_t> all = session->Session.ListSegmentsOfEdges();
        std::copy(all.begin(), all.end(), numbers);
      });
  }

  delaunayflip_status delaunayflip_store_segment_edges(
    delaunayflip_session* session, std::int64_t* pairs)
  {
    return TryWithPoints(
      session, pairs, [](const FlipReport& report) { return report.FromPoints.SegmentEdges; },
      [=]()
      {
        const std::vector<std::int64_t> all = session->Session.ListSegmentEdges();
        std::copy(all.begin(), all.end(), pairs);
      });
  }

  delaunayflip_status delaunayflip_store_triangles(
    delaunayflip_session* session, void* triangles, std::int32_t id_type)
  {
    return StoreTriangles(session, triangles, id_type);
  }

  delaunayflip_status delaunayflip_store_ordered_triangles(
    delaunayflip_session* session, void* triangles, std::int32_t id_type)
  {
    return TryWith(session,
      [=]()
      {
        session->Session.StoreOrderedTriangles(
          ToOutput(triangles, session->CountTriangles(), id_type));
      });
  }

  delaunayflip_status delaunayflip_store_flip_counts(
    delaunayflip_session* session, std::int32_t* counts)
  {
    return StoreFlipCounts(session, counts);
  }

  delaunayflip_status delaunayflip_store_triangles_on_device(
    delaunayflip_session* session, void* triangles, std::int32_t id_type, void* stream)
  {
    return StoreTriangles(session, triangles, id_type, stream);
  }

  delaunayflip_status delaunayflip_store_flip_counts_on_device(
    delaunayflip_session* session, std::int32_t* counts, void* stream)
  {
    return StoreFlipCounts(session, counts, stream);
  }
}
