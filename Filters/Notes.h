// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef Notes_h
#define Notes_h

#include <string>
#include <vector>

namespace delaunayflip
{

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
