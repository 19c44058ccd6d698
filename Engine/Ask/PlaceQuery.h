// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEQUERY_H
#define DELAUNAYFLIP_PLACEQUERY_H

#include "Interpolation.h"
#include "PlaceBoundary.h"
#include "PlaceGrid.h"
#include "PlaceWalk.h"
#include "PlaceWeights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// What both backends do for one place. The public query is in Interpolation.h.

namespace delaunayflip
{

/// A triangulation of points that can be asked.
struct AskedMesh
{
  PlaneMesh Mesh;
  PlaceGridView Grid;
  const std::int32_t* Numbers; ///< By triangle, that in the output, -1 if removed; null: its own.
  bool IsConvex; ///< See RunQuery.

  /// Finds a place. It is outside if it is not finite, or if its triangles are removed.
  /// @param last is where the last place was found, and becomes where this one is.
  /// @param sides become those of the triangle that is found, unless the place is on its boundary.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE FoundPlace Find(
    const PlanePoint& place, LastPlace& last, PlaceSides& sides) const
  {
    if (!this->Grid.Frame.Box.Has(place))
    {
      return FoundPlace();
    }
    const TriangleId start = this->Grid.FindStart(place, last);
    const FoundPlace found = WalkToPlace(this->Mesh, place, start, sides, this->IsConvex);
    last.Triangle = found.Triangle;
    if (found.IsOutside() || (found.OnEdges == 0 && !this->Numbers))
    {
      return found;
    }
    return ChooseTriangle(this->Mesh, found, this->Numbers);
  }

  /// The number of the triangle in the output, or -1.
  DELAUNAYFLIP_HOST_DEVICE std::int32_t GetNumber(const FoundPlace& found) const
  {
    if (found.IsOutside())
    {
      return -1;
    }
    return this->Numbers ? this->Numbers[found.Triangle]
                         : static_cast<std::int32_t>(found.Triangle);
  }
};

/// Values of the points, for functions of both backends.
struct AskedValues
{
  const double* Values;
  const VertexId* PointOfVertex; ///< Null: the values are those of vertices.
  int Components;
  bool IsNatural;
  PlaceBoundaryView Boundary; ///< Without edges: what is outside has no value.

  DELAUNAYFLIP_HOST_DEVICE const double* At(VertexId vertex) const
  {
    const VertexId point = this->PointOfVertex ? this->PointOfVertex[vertex] : vertex;
    return this->Values + std::int64_t(point) * this->Components;
  }

  /// Interpolates at a place. @param result receives one value for each component.
  DELAUNAYFLIP_HOST_DEVICE void Interpolate(const AskedMesh& asked, const PlanePoint& place,
    const FoundPlace& found, const PlaceSides& sides, double* result) const
  {
    if (found.IsOutside())
    {
      this->TakeNearest(place, result);
      return;
    }
    if (!this->IsNatural && found.OnEdges == 0 && sides.AreWeights())
    {
      this->TakeLinear(asked.Mesh.Edges.Triangles[found.Triangle], sides, result);
      return;
    }
    // At vertices, on the hull and on segments there are no natural weights. Each branch makes its
    // own frame: one that lives through both takes more registers of a GPU.
    double linearShare = 1.0;
    if (this->IsNatural && found.FindVertexSlot() < 0)
    {
      linearShare =
        this->TakeNatural(PlaceFrame(asked.Mesh, place, found.Triangle), found.Triangle, result);
    }
    if (linearShare > 0.0)
    {
      this->AddLinear(PlaceFrame(asked.Mesh, place, found.Triangle), found, linearShare, result);
    }
  }

  /// Interpolates linearly at a place that is in a triangle.
  /// @param share what this counts. If it is less than 1, it is added to the result.
  template <typename Frame>
  DELAUNAYFLIP_HOST_DEVICE void AddLinear(
    const Frame& frame, const FoundPlace& found, double share, double* result) const
  {
    if (share == 1.0)
    {
      this->Fill(result, 0.0);
    }
    VisitLinearWeights(frame, found,
      [&](VertexId vertex, double weight) { this->Add(vertex, share * weight, result); });
  }

  /// Interpolates by natural neighbours at a place that is at no vertex.
  /// @returns the share of linear interpolation that has to be added.
  template <typename Frame>
  DELAUNAYFLIP_HOST_DEVICE double TakeNatural(
    const Frame& frame, TriangleId triangle, double* result) const
  {
    NaturalSums sums;
    if (this->AddNatural<false>(frame, triangle, sums, result))
    {
      return this->LeaveToLinear(sums, result);
    }
    return TakePrecise(*this, frame, triangle, result);
  }

  DELAUNAYFLIP_HOST_DEVICE void Fill(double* result, double value) const
  {
    for (int i = 0; i < this->Components; ++i)
    {
      result[i] = value;
    }
  }

  /// Interpolates along an edge. @param share that of its end.
  DELAUNAYFLIP_HOST_DEVICE void TakeAlong(
    const BoundaryEdge& edge, double share, double* result) const
  {
    const double* from = this->At(edge.From);
    const double* to = this->At(edge.To);
    for (int i = 0; i < this->Components; ++i)
    {
      result[i] = (1.0 - share) * from[i] + share * to[i];
    }
  }

private:
  /// Sums over the weights of one place: of themselves, and of their magnitudes.
  struct NaturalSums
  {
    double Sum = 0.0, Size = 0.0;
  };

  /// Does what TakeNatural does, with twice the digits. It is apart, and has copies, so that the
  /// usual way keeps its registers.
  template <typename Frame>
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE static double TakePrecise(
    AskedValues values, Frame frame, TriangleId triangle, double* result)
  {
    NaturalSums sums;
    const bool isGood = values.AddNatural<true>(frame, triangle, sums, result);
    return isGood ? values.LeaveToLinear(sums, result) : 1.0;
  }

  /// @returns whether there are weights that rounding has left good.
  template <bool IsPrecise, typename Frame>
  DELAUNAYFLIP_HOST_DEVICE bool AddNatural(
    const Frame& frame, TriangleId triangle, NaturalSums& sums, double* result) const
  {
    double scale = 1.0;
    bool isGood = true, isFinite = false;
    for (int trial = 0; trial < 2 && isGood && !isFinite; ++trial)
    {
      sums = NaturalSums();
      this->Fill(result, 0.0);
      const auto add = [&](VertexId vertex, double weight)
      {
        sums.Sum += weight * scale;
        sums.Size += std::fabs(weight * scale);
        this->Add(vertex, weight * scale, result);
      };
      if constexpr (IsPrecise)
      {
        isGood = VisitPreciseWeights(frame, triangle, add);
      }
      else
      {
        isGood = VisitNaturalWeights(frame, triangle, add);
      }
      isFinite = true;
      for (int i = 0; i < this->Components; ++i)
      {
        result[i] /= sums.Sum;
        isFinite = isFinite && delaunayflip::IsFinite(result[i]);
      }
      // Sums of large values may overflow. With weights of less than 1 in all they do not.
      scale = 0.25 * InvertPowerOfTwo(std::fabs(sums.Sum));
    }
    return isGood && std::fabs(sums.Sum) > 0.0; // else weights have cancelled, as in slivers
  }

  /// Where triangles are not Delaunay, weights may have different signs, and values leave the range
  /// of the neighbours' values. This happens beside segments, and where points of a globe are not
  /// on a sphere. The more the weights cancel, the less natural ones count. So values leave that
  /// range by at most 1/64 of it, and stay continuous.
  /// @returns the share of linear interpolation.
  DELAUNAYFLIP_HOST_DEVICE double LeaveToLinear(const NaturalSums& sums, double* result) const
  {
    constexpr double Steepness = 8.0, Rounding = 1e-6;
    // Twice the sum of the weights with the other sign than the sum of all, divided by that sum.
    const double cancelled = sums.Size / std::fabs(sums.Sum) - 1.0;
    const double share = Steepness * cancelled - Rounding;
    if (share <= 0.0)
    {
      return 0.0;
    }
    if (share >= 1.0)
    {
      return 1.0;
    }
    for (int i = 0; i < this->Components; ++i)
    {
      result[i] *= 1.0 - share;
    }
    return share;
  }

  DELAUNAYFLIP_HOST_DEVICE void Add(VertexId vertex, double weight, double* result) const
  {
    const double* value = this->At(vertex);
    for (int i = 0; i < this->Components; ++i)
    {
      result[i] += weight * value[i];
    }
  }

  /// The result of VisitLinearWeights, to the last bit: powers of two do not change quotients.
  DELAUNAYFLIP_HOST_DEVICE void TakeLinear(
    ConstTriangleAccess triangle, const PlaceSides& sides, double* result) const
  {
    const double* from[3];
    double weights[3];
    const double sum = sides.Areas[0] + sides.Areas[1] + sides.Areas[2];
    for (int slot = 0; slot < 3; ++slot)
    {
      from[slot] = this->At(triangle.Vertices[slot]);
      weights[slot] = sides.Areas[slot] / sum;
    }
    for (int i = 0; i < this->Components; ++i)
    {
      const double first = 0.0 + weights[0] * from[0][i];
      const double two = first + weights[1] * from[1][i];
      result[i] = two + weights[2] * from[2][i];
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void TakeNearest(const PlanePoint& place, double* result) const
  {
    if (this->Boundary.NumberOfEdges == 0 || !delaunayflip::IsFinite(place))
    {
      this->Fill(result, NAN);
      return;
    }
    const NearestOnBoundary nearest = this->Boundary.FindNearest(place);
    this->TakeAlong(nearest.Edge, nearest.ShareOfTo, result);
  }
};

/// Copies the values of a vertex.
struct CopyValues
{
  AskedValues From;
  double* To; ///< By vertex.

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t vertex) const
  {
    const double* const from = this->From.At(static_cast<VertexId>(vertex));
    for (int i = 0; i < this->From.Components; ++i)
    {
      this->To[vertex * this->From.Components + i] = from[i];
    }
  }
  void Prefetch(std::int64_t vertex) const
  {
    delaunayflip::Prefetch(this->From.At(static_cast<VertexId>(vertex)));
  }
};

/// Consecutive places of a query, with their results in the memory of a backend.
struct PlaceBlock
{
  PlaneArray Places;
  PlaceRaster Raster; ///< Instead of Places, if it has cells.
  std::int64_t FirstCell = 0; ///< The first one of the raster in this block.
  std::int32_t* Triangles = nullptr;
  double* Results = nullptr;

  DELAUNAYFLIP_HOST_DEVICE PlanePoint GetPlace(std::int64_t i) const
  {
    if (this->Raster.Columns > 0)
    {
      const std::int64_t cell = this->FirstCell + i;
      return { this->Raster.Get(cell, 0), this->Raster.Get(cell, 1), 0.0 };
    }
    return { this->Places.Get(i, 0), this->Places.Get(i, 1), 0.0 };
  }
};

/// Answers some places of a block.
struct AnswerPlaces
{
  AskedMesh Asked;
  AskedValues Values;
  PlaceBlock Block;
  const std::uint32_t* Order; ///< That of the places, or null.

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t k) const { (*this)(k, k + 1); }

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t begin, std::int64_t end) const
  {
    LastPlace last;
    for (std::int64_t k = begin; k < end; ++k)
    {
      const std::int64_t i = this->Order ? this->Order[k] : k;
      const PlanePoint place = this->Block.GetPlace(i);
      PlaceSides sides;
      const FoundPlace found = this->Asked.Find(place, last, sides);
      if (this->Block.Triangles)
      {
        this->Block.Triangles[i] = this->Asked.GetNumber(found);
      }
      if (this->Block.Results)
      {
        double* const result = this->Block.Results + i * this->Values.Components;
        this->Values.Interpolate(this->Asked, place, found, sides, result);
      }
    }
  }
};

/// Returns the places of a query from `first` on, `count` of them.
inline PlaceBlock CutBlock(const PlaceQuery& query, std::int64_t first, std::int64_t count)
{
  PlaceBlock block;
  block.FirstCell = first;
  const std::int64_t numbers = query.Places.Stride * first;
  if (query.Raster.CountCells() > 0)
  {
    block.Raster = query.Raster;
  }
  else if (query.Places.Floats)
  {
    block.Places = PlaneArray(query.Places.Floats + numbers, count, query.Places.Stride);
  }
  else if (query.Places.Doubles)
  {
    block.Places = PlaneArray(query.Places.Doubles + numbers, count, query.Places.Stride);
  }
  if (query.Triangles)
  {
    block.Triangles = query.Triangles + first;
  }
  if (query.Values)
  {
    block.Results = query.Results + first * query.Components;
  }
  return block;
}

}

#endif
