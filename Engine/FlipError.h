// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPERROR_H
#define DELAUNAYFLIP_FLIPERROR_H

#include "EngineExport.h"

#include <cstdint>
#include <stdexcept>
#include <string>

/// @file
/// The exceptions of the engine. Each message says what is wrong, where, and what to do. If memory
/// runs out, std::bad_alloc is thrown.
///
///     const double xyz[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
///     std::int32_t ids[] = { 0, 1, 7 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 3);
///     mesh.Triangles = TriangleArray(ids, 1);
///     try
///     {
///       FlipToDelaunay(mesh, {}, MutableTriangleArray(ids, 1));
///     }
///     catch (const InvalidMesh& error)
///     {
///       error.Point; // 7
///     }

namespace delaunayflip
{

/// Base class of the engine's own exceptions.
class DELAUNAYFLIP_EXPORT FlipError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Options that contradict each other or the mesh, or are out of range.
class DELAUNAYFLIP_EXPORT InvalidOptions : public FlipError
{
public:
  using FlipError::FlipError;
};

/// A triangle or constraint edge names a point that does not exist.
class DELAUNAYFLIP_EXPORT InvalidMesh : public FlipError
{
public:
  InvalidMesh(
    const std::string& message, std::int64_t cell, std::int64_t point, std::int64_t ring = -1)
    : FlipError(message),
      Cell(cell),
      Point(point),
      Ring(ring)
  {
  }

  std::int64_t Cell; ///< The id of the triangle or constraint edge.
  std::int64_t Point; ///< The point id that it names.
  std::int64_t Ring = -1; ///< The ring of points that is at fault; -1: none.
};

/// More triangles than 32-bit half-edges can number; thrown before anything is allocated.
class DELAUNAYFLIP_EXPORT MeshTooLarge : public FlipError
{
public:
  using FlipError::FlipError;
};

/// The requested backend cannot run here.
class DELAUNAYFLIP_EXPORT BackendUnavailable : public FlipError
{
public:
  using FlipError::FlipError;
};

/// The coordinates need exact arithmetic that only the CPU has.
class DELAUNAYFLIP_EXPORT BeyondDevice : public BackendUnavailable
{
public:
  BeyondDevice()
    : BackendUnavailable("coordinates of one triangle span more than 125 bits, for which exact "
                         "arithmetic needs the CPU")
  {
  }
};

}

#endif
