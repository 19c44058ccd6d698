// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PSLGFILE_H
#define DELAUNAYFLIP_PSLGFILE_H

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Points and segments of the plane from files of other programs.

namespace delaunayflip
{

struct Pslg
{
  std::vector<std::array<double, 2>> Points; ///< Distinct.
  std::vector<std::pair<std::int64_t, std::int64_t>> Segments; ///< Between two different points.
};

/// Reads Triangle's .poly (and the .node beside it), CDT's .txt, and poly2tri's .dat, the closed
/// polygon of its points. @throws std::runtime_error.
Pslg ReadPslg(const std::string& path);

/// The files in a folder that ReadPslg reads, sorted; none if there is no folder.
std::vector<std::string> ListPslgFiles(const std::string& folder);

}

#endif
