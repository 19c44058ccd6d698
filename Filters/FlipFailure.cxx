// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipFailure.h"

#include "FlipError.h"
#include "vtkDelaunayFlip.h"

#include <exception>
#include <new>
#include <stdexcept>

namespace delaunayflip
{

FlipFailure ExplainException()
{
  try
  {
    throw;
  }
  catch (const InvalidOptions& error)
  {
    return { vtkDelaunayFlip::FAILURE_OPTIONS, error.what() };
  }
  catch (const BackendUnavailable& error)
  {
    return { vtkDelaunayFlip::FAILURE_BACKEND, error.what() };
  }
  catch (const FlipError& error)
  {
    return { vtkDelaunayFlip::FAILURE_MESH, error.what() };
  }
  catch (const std::invalid_argument& error) // of a subclass of the filter
  {
    return { vtkDelaunayFlip::FAILURE_MESH, error.what() };
  }
  catch (const std::bad_alloc&)
  {
    return { vtkDelaunayFlip::FAILURE_OTHER, "not enough memory" };
  }
  catch (const std::exception& error)
  {
    return { vtkDelaunayFlip::FAILURE_OTHER, error.what() };
  }
  catch (...)
  {
    return { vtkDelaunayFlip::FAILURE_OTHER, "an exception of unknown type" };
  }
}

}
