// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINECASE_H
#define DELAUNAYFLIP_ENGINECASE_H

#include "DelaunayFlip.h"

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <vector>

namespace delaunayflip
{

/// A mesh, with constraints, regions and frozen triangles, and options; all drawn from bytes.
struct EngineCase
{
  std::vector<double> Points; ///< x, y, z.
  std::vector<std::int32_t> Triangles;
  std::vector<std::int64_t> Constraints; ///< Pairs of point ids.
  std::vector<std::int32_t> Regions; ///< One per triangle, or none.
  std::vector<unsigned char> Frozen; ///< One per triangle, or none.
  FlipOptions Options;
  bool HasFloats = false; ///< The engine gets points of type float.
  bool HasLongIds = false; ///< The engine gets 64-bit ids.

  /// A triangulation of distinct points: all triangles turn left in x and y, and nothing overlaps.
  bool IsClean = false;
};

/// The engine's view of a case, in the types that the case asks for.
class EngineInput
{
public:
  explicit EngineInput(const EngineCase& drawn);
  TriangleMesh View() const;

private:
  const EngineCase& Case;
  std::vector<float> Floats;
  std::vector<std::int64_t> LongIds;
};

/// Draws a case, which depends on the bytes alone and is the same on every machine.
EngineCase MakeEngineCase(const std::uint8_t* bytes, std::size_t size);

/// Writes a case as C++ code for a test.
void Print(const EngineCase& drawn, std::ostream& stream);

}

#endif
