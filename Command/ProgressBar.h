// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PROGRESSBAR_H
#define DELAUNAYFLIP_PROGRESSBAR_H

#include <chrono>
#include <string>

namespace delaunayflip
{

/// One line on stderr that shows how much of a job of several parts is done. It never goes
/// backwards. It is drawn on a terminal only, so logs do not contain it.
class ProgressBar
{
public:
  /// `wanted` false: never draws.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Begins the next part, which ends at this share of the job, 0 .. 1. Draws at once.
  void Begin(double end, const std::string& text);

  /// Shows that `fraction` of the part, 0 .. 1, is done. Draws at most ten times per second.
  void Show(double fraction, const std::string& text);

  /// Wipes the line.
  void Clear();

private:
  void Draw(const std::string& text);

  bool Draws;
  std::chrono::steady_clock::time_point LastDrawn;
  double PartBegin = 0.0;
  double PartEnd = 0.0;
  double Done = 0.0;
};

}

#endif
