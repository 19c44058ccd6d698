// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PROGRESSBAR_H
#define DELAUNAYFLIP_PROGRESSBAR_H

#include <chrono>
#include <string>

namespace delaunayflip
{

/// One line on stderr that shows progress. Drawn only on a terminal, never into a log.
class ProgressBar
{
public:
  /// If `wanted` is false, nothing is ever drawn.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows `fraction`, 0 to 1, and `text`. Draws at most ten times per second.
  void Show(double fraction, const std::string& text);

  /// Shows a fraction of 0 at once.
  void Start(const std::string& text);

  /// Erases the line.
  void Clear();

private:
  bool Draws;
  std::chrono::steady_clock::time_point LastDrawn;
};

}

#endif
