// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef Notes_h
#define Notes_h

#include <string>
#include <vector>

namespace delaunayflip
{

struct FlipReport;

/// Something to tell of a mesh.
struct Note
{
  std::string Where; ///< E.g. "block 3 (wing)"; empty where there is one mesh only.
  std::string Text;
};

/// All notes in one text: each text once, with the first places it is true of.
std::string Describe(const std::vector<Note>& notes);

/// What a user should be warned of; empty if nothing. Not of a limit that was asked for.
std::string DescribeTrouble(const FlipReport& report, bool hasAskedForLimit);

}

#endif
