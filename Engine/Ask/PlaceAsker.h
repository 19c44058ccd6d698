// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEASKER_H
#define DELAUNAYFLIP_PLACEASKER_H

#include "FlipOptions.h"
#include "Outline.h"
#include "PlaceQuery.h"
#include "RunQuery.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Answers queries about a triangulation of points in a backend's memory, block by block. Keeps
/// what later queries can use again.
template <typename Backend>
class PlaceAsker
{
public:
  /// @param mesh in the memory of the backend; edges have states.
  /// @param observer is told the share of the places that is done.
  AskResult Answer(const PointMeshView& mesh, const RunQuery& asked, const Backend& backend,
    const ProgressObserver& observer)
  {
    PlaneMesh plane{ mesh.Edges, mesh.Places };
    plane.IsTriangulation = true;
    const PlaceGridView grid = this->RequireGrid(plane, mesh.NumberOfTriangles, backend);
    plane.IsInFilterRange = grid.Frame.Box.IsInFilterRange();
    const std::int32_t none = 0;
    const LocalCopy<std::int32_t> failed(&none, 1, true, backend);
    plane.Failed = failed.GetWritable();
    const std::vector<std::int32_t>& numbers = asked.Numbers;
    const LocalCopy<std::int32_t> numbersHere(
      numbers.data(), SizeOf(numbers), !numbers.empty(), backend);
    const AskedMesh here{ plane, grid, numbersHere.Get(), asked.IsConvex };

    const PlaceQuery& query = asked.Query;
    const bool wantsValues = query.Values != nullptr;
    const LocalCopy<double> valuesHere(query.Values, asked.NumberOfPoints * query.Components,
      wantsValues && !query.OnDevice && !Backend::IsOnHost, backend);
    PlaceBoundary boundary;
    if (wantsValues && query.Outside == OutsideKind::Nearest)
    {
      boundary = BuildPlaceBoundary(plane, mesh.NumberOfEdges, here.Numbers, backend);
    }
    const bool areHere = query.OnDevice || Backend::IsOnHost;
    AskedValues values{ areHere ? query.Values : valuesHere.Get(), mesh.Ids, query.Components,
      query.Method == InterpolationKind::Natural, boundary.View(mesh.Places) };
    const std::int64_t count = query.CountPlaces();
    const Array<double> sorted = SortValues(values, mesh.NumberOfPlaces, count, backend);
    if (sorted.Size() > 0)
    {
      values.Values = sorted.Data();
      values.PointOfVertex = nullptr;
    }
    for (std::int64_t first = 0; first < count; first += MostAtATime)
    {
      const auto goesOn = [&](std::int64_t done) {
        return !observer ||
          observer(static_cast<double>(first + done) / static_cast<double>(count));
      };
      const std::int64_t size = std::min(MostAtATime, count - first);
      const AnswerPlaces answer{ here, values, CutBlock(query, first, size), nullptr };
      const bool isOnBackend = Backend::IsOnHost || query.OnDevice;
      const bool isDone = isOnBackend ? AnswerHere(answer, size, goesOn, backend)
                                      : AnswerCopy(answer, size, goesOn, backend);
      if (!isDone)
      {
        return AskResult::Stopped;
      }
    }
    std::int32_t hasFailed = 0;
    backend.Download(failed.Get(), 1, &hasFailed);
    return hasFailed == 0 ? AskResult::Complete : AskResult::Undecided;
  }

  /// The grid where walks begin. It is built at the first time, and stays usable while edges flip
  /// and triangles are split. What walks find does not depend on its state.
  PlaceGridView RequireGrid(const PlaneMesh& mesh, std::int64_t triangles, const Backend& backend)
  {
    if (this->Grid.Cells.Size() == 0)
    {
      this->Grid = BuildPlaceGrid(mesh, triangles, backend);
      this->Removed = 0;
    }
    return this->Grid.View();
  }

  /// Keeps the grid of a mesh from which some points were removed, unless many are gone by now.
  void Remove(
    std::int64_t points, const PlaneMesh& mesh, std::int64_t triangles, const Backend& backend)
  {
    constexpr std::int64_t Share = 16;
    this->Removed += points;
    if (this->Removed > mesh.Places.Count / Share)
    {
      *this = PlaceAsker();
    }
    else if (this->Grid.Cells.Size() > 0)
    {
      ForgetMovedTriangles(this->Grid, mesh, triangles, backend);
    }
  }

  /// Sorts the places of a block by their cells, if most are far from the ones before. Then
  /// triangles that are near each other are read at about the same time. This and the next function
  /// are public because device lambdas require it.
  /// @returns the order, or nothing.
  static Array<std::uint32_t> SortPlaces(const PlaceGridFrame& frame, const PlaceBlock& block,
    std::int64_t count, const Backend& backend)
  {
    constexpr std::int64_t Fewest = 1 << 14;
    if (block.Raster.Columns > 0 || count < Fewest)
    {
      return {};
    }
    const auto far = backend.template Sum<std::int64_t>(count - 1,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
      { sum += frame.AreNear(block.GetPlace(i), block.GetPlace(i + 1)) ? 0 : 1; });
    if (2 * far < count)
    {
      return {};
    }
    return backend.template SortIndices<PlaceGridFrame::KeyBits>(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return frame.FindKey(block.GetPlace(i)); });
  }

  /// Copies values into the order of vertices, which is that of their places, if there are enough
  /// places to ask for. Then a thread waits for memory less often.
  /// @returns the copy, or nothing.
  static Array<double> SortValues(
    const AskedValues& values, std::int64_t vertices, std::int64_t places, const Backend& backend)
  {
    Array<double> sorted;
    if constexpr (Backend::IsOnHost)
    {
      constexpr std::int64_t VerticesPerPlace = 4;
      if (values.Values && VerticesPerPlace * places >= vertices)
      {
        sorted = backend.template MakeArray<double>(vertices * values.Components);
        backend.ForEach(vertices, CopyValues{ values, sorted.Data() });
      }
    }
    return sorted;
  }

  /// On the host a thread answers many places one after the other, which saves steps of walks.
  /// @param answer without an order.
  /// @param goesOn is asked whether to go on, with the number of places that are done.
  /// @returns whether all are answered.
  template <typename GoesOn>
  static bool AnswerHere(
    AnswerPlaces answer, std::int64_t count, const GoesOn& goesOn, const Backend& backend)
  {
    if (!goesOn(0))
    {
      return false;
    }
    const Array<std::uint32_t> sorted =
      SortPlaces(answer.Asked.Grid.Frame, answer.Block, count, backend);
    answer.Order = sorted.Data();
    if constexpr (Backend::IsOnHost)
    {
      for (std::int64_t first = 0; first < count; first += MostUnobserved)
      {
        if (first > 0 && !goesOn(first))
        {
          return false;
        }
        backend.ForRange(std::min(MostUnobserved, count - first),
          [&](std::int64_t begin, std::int64_t end) { answer(first + begin, first + end); });
      }
    }
    else
    {
      backend.ForEach(count, answer);
    }
    return true;
  }

private:
  /// How many places at a time keep a GPU busy and need little memory.
  static constexpr std::int64_t MostAtATime = 1 << 20;
  /// How many places a thread of a CPU answers in about a tenth of a second.
  static constexpr std::int64_t MostUnobserved = 1 << 16;

  /// A copy of the host's values in the backend's memory.
  template <typename T>
  class LocalCopy
  {
  public:
    /// @param isWanted otherwise there is no copy.
    LocalCopy(const T* host, std::int64_t size, bool isWanted, const Backend& backend)
    {
      if (isWanted)
      {
        this->Copy = backend.template MakeArray<T>(size);
        backend.Upload(host, size, this->Copy.Data());
      }
    }

    /// Null without a copy.
    const T* Get() const { return this->Copy.Data(); }
    T* GetWritable() const { return const_cast<T*>(this->Copy.Data()); }

  private:
    Array<T> Copy;
  };

  /// Like AnswerHere, for places and results that are in the host's memory.
  template <typename GoesOn>
  static bool AnswerCopy(
    const AnswerPlaces& answer, std::int64_t count, const GoesOn& goesOn, const Backend& backend)
  {
    const PlaceBlock& block = answer.Block;
    AnswerPlaces copy = answer;
    PlaceBlock& here = copy.Block;
    const std::int64_t numbers = (count - 1) * block.Places.Stride + 2;
    const LocalCopy<float> floats(
      block.Places.Floats, numbers, block.Places.Floats != nullptr, backend);
    const LocalCopy<double> doubles(
      block.Places.Doubles, numbers, block.Places.Doubles != nullptr, backend);
    here.Places.Floats = floats.Get();
    here.Places.Doubles = doubles.Get();
    Array<std::int32_t> triangles;
    if (block.Triangles)
    {
      triangles = backend.template MakeArray<std::int32_t>(count);
    }
    Array<double> results;
    const std::int64_t size = count * answer.Values.Components;
    if (block.Results)
    {
      results = backend.template MakeArray<double>(size);
    }
    here.Triangles = triangles.Data();
    here.Results = results.Data();
    if (!AnswerHere(copy, count, goesOn, backend))
    {
      return false;
    }
    backend.Download(here.Triangles, block.Triangles ? count : 0, block.Triangles);
    backend.Download(here.Results, block.Results ? size : 0, block.Results);
    return true;
  }

  PlaceGrid Grid;
  std::int64_t Removed = 0; ///< How many points were removed since the grid was built.
};

}

#endif
