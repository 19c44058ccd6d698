// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_COUNTED_H
#define DELAUNAYFLIP_COUNTED_H

#include <cstdint>
#include <string>

namespace delaunayflip
{

/// A number and its unit, e.g. "1 point" or "2 points".
inline std::string Counted(std::int64_t count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}

#endif
