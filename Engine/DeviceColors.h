// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICECOLORS_H
#define DELAUNAYFLIP_DEVICECOLORS_H

#include "DeviceMesh.h"
#include "EngineExport.h"
#include "FlipOptions.h"

#include <cstdint>
#include <vector>

/// @file
/// Colours of triangles in the memory of a GPU, for programs that draw a mesh from there. Nothing
/// here is copied through the host. All functions wait for what is in the caller's stream; when
/// they return, their results are there for any stream.

namespace delaunayflip
{

/// The extreme ones of some numbers, NaN left out; both are NaN if there is no number.
struct ValueRange
{
  double Smallest;
  double Largest;
};

/// Bands of equal width between two numbers, with a colour each.
struct ColorBands
{
  std::vector<std::uint32_t> Colors; ///< One or more: red, green, blue and alpha in memory's order.
  double First = 0.0; ///< Where the first band begins. What is less gets its colour.
  double Last = 1.0; ///< Where the last band ends. What is more gets its colour.
  std::uint32_t OfNaN = 0;
};

/// Writes the smallest angle of every triangle in degrees: mesh.Triangles.Count numbers in device
/// memory. They are those of FindSmallestAngles for the host (TriangleAngles.h), up to the rounding
/// to float, but NaN also for a triangle with a point that does not exist.
/// @param mesh its points, triangles and stream; nothing else of it matters.
/// @throws InvalidOptions if `degrees` is not in the memory of a GPU; BackendUnavailable.
DELAUNAYFLIP_EXPORT ValueRange FindSmallestAngles(
  const DeviceMesh& mesh, GeometryKind geometry, float* degrees);

/// The extreme ones of `count` numbers in device memory.
/// @throws the same.
DELAUNAYFLIP_EXPORT ValueRange FindRange(
  const std::int32_t* values, std::int64_t count, const DeviceStream& stream);

/// Writes the colours of `count` numbers in device memory. `colors` may be the array of the numbers
/// itself.
/// @throws InvalidOptions also if there is no band; BackendUnavailable.
DELAUNAYFLIP_EXPORT void ColorValues(const float* values, std::int64_t count,
  const ColorBands& bands, std::uint32_t* colors, const DeviceStream& stream);
DELAUNAYFLIP_EXPORT void ColorValues(const std::int32_t* values, std::int64_t count,
  const ColorBands& bands, std::uint32_t* colors, const DeviceStream& stream);

}

#endif
