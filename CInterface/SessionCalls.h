// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SESSIONCALLS_H
#define DELAUNAYFLIP_SESSIONCALLS_H

#if defined(__GNUC__) // what this header declares is exported, and nothing else
#pragma GCC visibility push(default)
#endif
#include "delaunayflip_c.h"
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#include "CallerStructs.h"
#include "DelaunayFlip.h"
#include "FlipError.h"

#include <cstdint>
#include <exception>
#include <new>
#include <vector>

/// @file
/// How a C function does its work: with a session of the program, and exceptions as statuses.

struct delaunayflip_session
{
  std::int64_t CountTriangles() const
  {
    return this->MakesTriangles ? this->Session.CountTriangles() : this->NumberOfTriangles;
  }

  delaunayflip::FlipSession Session;
  bool IsFromPoints = false;
  bool MakesTriangles = false; ///< Whether their number may change: from points, or by refinement.
  std::int64_t NumberOfTriangles = 0;
  const std::int64_t* TriangleNumbers = nullptr; ///< The caller's, or null.
  delaunayflip::KeptReport Report;
  std::vector<delaunayflip::RegionSeed> Regions; ///< The session reads them.
};

namespace delaunayflip
{

/// Makes this the last error of the thread. @returns the status.
delaunayflip_status Fail(delaunayflip_status status, const char* message, std::int64_t cell = -1,
  std::int64_t point = -1, std::int64_t ring = -1);

/// The status for an error of no kind that Try knows.
delaunayflip_status StatusOf(const std::exception& error);

/// Does the work. No exception may leave a C function: its message becomes the last error.
template <typename Work>
delaunayflip_status Try(const Work& work)
{
  try
  {
    work();
    return DELAUNAYFLIP_OK;
  }
  catch (const InvalidMesh& error)
  {
    return Fail(DELAUNAYFLIP_INVALID_MESH, error.what(), error.Cell, error.Point, error.Ring);
  }
  catch (const RunAborted&)
  {
    return Fail(DELAUNAYFLIP_STOPPED, "stopped by a callback");
  }
  catch (const std::bad_alloc&)
  {
    return Fail(DELAUNAYFLIP_OUT_OF_MEMORY, "not enough memory");
  }
  catch (const std::exception& error)
  {
    return Fail(StatusOf(error), error.what());
  }
  catch (...)
  {
    return Fail(DELAUNAYFLIP_FAILED, "an exception of an unknown type");
  }
}

/// Does work with a session, which must not be null.
template <typename Work>
delaunayflip_status TryWith(const delaunayflip_session* session, const Work& work)
{
  return Try(
    [&]()
    {
      Require(session, "session is null");
      work();
    });
}

}

#endif
