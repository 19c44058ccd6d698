// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_QUERYTESTSUPPORT_H
#define DELAUNAYFLIP_QUERYTESTSUPPORT_H

#include "DelaunayFlip.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// What sessions answer to queries that have their places already.

namespace delaunayflip
{

/// The triangles of the places.
inline std::vector<std::int32_t> Locate(const FlipSession& session, PlaceQuery query)
{
  std::vector<std::int32_t> found(query.CountPlaces(), -2);
  query.Triangles = found.data();
  EXPECT_TRUE(session.Ask(query));
  return found;
}

/// The values at the places.
/// @param values at least one for each point. @param points how many there are.
inline std::vector<double> Interpolate(const FlipSession& session, PlaceQuery query,
  const std::vector<double>& values, std::size_t points)
{
  query.Values = values.data();
  query.Components = static_cast<int>(values.size() / points);
  std::vector<double> results(query.CountPlaces() * query.Components, -1e99);
  query.Results = results.data();
  EXPECT_TRUE(session.Ask(query));
  return results;
}

}

#endif
