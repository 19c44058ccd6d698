// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSOLE_H
#define DELAUNAYFLIP_CONSOLE_H

#include <string>
#include <vector>

/// @file
/// One-line messages on stderr, including VTK's.

namespace delaunayflip
{

/// The text with control characters, which names of files and arrays may have, as \x1b and the
/// like: a terminal would act on them. The functions below do this.
std::string WithoutControls(const std::string& text);

void PrintError(const std::string& message);
void PrintWarning(const std::string& message);
void PrintNote(const std::string& message);

/// From its construction on, collects VTK's messages in this process instead of printing them.
class VTKMessages
{
public:
  VTKMessages();

  /// The warnings since the last call.
  std::vector<std::string> TakeWarnings();

  /// The errors since the last call, joined, or an empty string.
  std::string TakeErrors();

  /// The errors and warnings since the last call, joined, or an empty string. Leaves out warnings
  /// that the file has a newer version than VTK knows; TakeWarnings returns these.
  std::string TakeProblems();
};

/// Discards what is written to stderr while it lives: the output of a crashing reader helps nobody.
class MutedStandardError
{
public:
  MutedStandardError();
  ~MutedStandardError();
  MutedStandardError(const MutedStandardError&) = delete;
  MutedStandardError& operator=(const MutedStandardError&) = delete;

private:
  int Saved;
};

}

#endif
