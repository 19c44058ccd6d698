// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FlipFailure_h
#define FlipFailure_h

#include <string>

namespace delaunayflip
{

/// Why a mesh could not be flipped.
struct FlipFailure
{
  int Kind = 0; ///< One of vtkDelaunayFlip::FailureType; 0 is none.
  std::string Message;

  explicit operator bool() const { return this->Kind != 0; }
};

/// What the exception that is being handled means.
FlipFailure ExplainException();

/// Runs `work`, and turns what it throws into a failure. A template, since a std::function takes
/// memory before anything is tried.
template <typename Work>
FlipFailure Attempt(const Work& work)
{
  try
  {
    work();
    return {};
  }
  catch (...)
  {
    return ExplainException();
  }
}

}

#endif
