// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FlipFailure_h
#define FlipFailure_h

#include <functional>
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

/// Runs `work`, and turns an exception into a failure.
FlipFailure Attempt(const std::function<void()>& work);

}

#endif
