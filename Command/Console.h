// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSOLE_H
#define DELAUNAYFLIP_CONSOLE_H

#include "ChildProcess.h"

#include <chrono>
#include <string>
#include <vector>

/// @file
/// What appears on stderr: messages of one line, including VTK's, and the progress bar.

namespace delaunayflip
{

/// The text with control characters, which names of files and arrays may have, as \x1b and the
/// like: a terminal would act on them. The functions below do this.
std::string WithoutControls(const std::string& text);

void PrintError(const std::string& message);
void PrintWarning(const std::string& message);
void PrintNote(const std::string& message);
void PrintHint(const std::string& message);

/// From now on, collects VTK's messages in this process instead of printing them.
void CollectVTKMessages();

/// The warnings since the last call.
std::vector<std::string> TakeVTKWarnings();

/// The errors since the last call, joined, or an empty string.
std::string TakeVTKErrors();

/// The errors and warnings since the last call, joined, or an empty string. Leaves out warnings
/// that the file has a newer version than VTK knows; TakeVTKWarnings returns these.
std::string TakeVTKProblems();

/// One line that shows how much of a job is done. It never goes backwards. It is drawn on a
/// terminal only, so logs do not contain it.
class ProgressBar
{
public:
  /// `wanted` false: never draws.
  explicit ProgressBar(bool wanted);
  ~ProgressBar() { this->Clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Begins a phase, or another part of it. Draws at once.
  void Begin(Phase phase, const std::string& text);

  /// Shows that `fraction` of the phase, 0 .. 1, is done. Draws at most ten times per second.
  void Show(double fraction, const std::string& text);

  /// Wipes the line.
  void Clear();

private:
  void Draw(const std::string& text);

  bool Draws;
  std::chrono::steady_clock::time_point LastDrawn;
  double PhaseBegin = 0.0;
  double PhaseEnd = 0.0;
  double Done = 0.0;
};

}

#endif
