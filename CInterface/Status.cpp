// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Status.h"

#include "FlipError.h"
#include "FlipReport.h"

#include <new>

namespace delaunayflip
{

namespace
{

delaunayflip_status Fail(
  delaunayflip_status status, const char* message, std::int64_t cell = -1, std::int64_t point = -1)
{
  LastError& error = GetLastError();
  error.Cell = cell;
  error.Point = point;
  try
  {
    error.Message = message;
  }
  catch (const std::bad_alloc&)
  {
    error.Message.clear();
    return DELAUNAYFLIP_OUT_OF_MEMORY;
  }
  return status;
}

}

void Require(bool isKept, const char* rule)
{
  if (!isKept)
  {
    throw InvalidCall(rule);
  }
}

LastError& GetLastError()
{
  thread_local LastError error;
  return error;
}

delaunayflip_status FailByException()
{
  try
  {
    throw;
  }
  catch (const InvalidCall& error)
  {
    return Fail(DELAUNAYFLIP_INVALID_CALL, error.what());
  }
  catch (const InvalidMesh& error)
  {
    return Fail(DELAUNAYFLIP_INVALID_MESH, error.what(), error.Cell, error.Point);
  }
  catch (const InvalidOptions& error)
  {
    return Fail(DELAUNAYFLIP_INVALID_OPTIONS, error.what());
  }
  catch (const MeshTooLarge& error)
  {
    return Fail(DELAUNAYFLIP_MESH_TOO_LARGE, error.what());
  }
  catch (const BackendUnavailable& error)
  {
    return Fail(DELAUNAYFLIP_BACKEND_UNAVAILABLE, error.what());
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
    return Fail(DELAUNAYFLIP_FAILED, error.what());
  }
  catch (...)
  {
    return Fail(DELAUNAYFLIP_FAILED, "an exception of an unknown type");
  }
}

}
