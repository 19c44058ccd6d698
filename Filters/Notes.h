// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef Notes_h
#define Notes_h

#include <string>
#include <vector>

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

struct FlipReport;

/// A message about a mesh.
struct Note
{
  std::string Where; ///< E.g. "block 3 (wing)"; empty if there is only one mesh.
  std::string Text;
};

/// Joins notes to one text. Each text appears once, with the first places to which it applies.
std::string Describe(const std::vector<Note>& notes);

/// What to warn the user of, or empty. Reaching a requested iteration limit is not worth a warning.
/// @param hasTolerance whether the user has set one.
std::string DescribeTrouble(const FlipReport& report, bool hasAskedForLimit, bool hasTolerance);

}

#endif
