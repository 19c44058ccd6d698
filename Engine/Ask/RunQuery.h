// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RUNQUERY_H
#define DELAUNAYFLIP_RUNQUERY_H

#include "Interpolation.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A query, and what a run knows that a mesh does not.
struct RunQuery
{
  const PlaceQuery& Query;
  /// By triangle, its number in the output, or -1 if it is removed. Empty: its own.
  const std::vector<std::int32_t>& Numbers;
  std::int64_t NumberOfPoints; ///< With added ones: the query has values for each.
  /// Whether the hull is surely convex. Refinement may split its edges at places that are rounded.
  bool IsConvex;
};

/// What has become of a query.
enum class AskResult
{
  Complete,
  Stopped, ///< By an observer.
  Undecided ///< A device cannot decide an orientation; the CPU can.
};

}

#endif
