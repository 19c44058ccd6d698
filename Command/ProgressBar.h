// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PROGRESSBAR_H
#define DELAUNAYFLIP_PROGRESSBAR_H

#include <chrono>
#include <string>

namespace delaunayflip
{

/// One line on stderr that tells how far the work is. Only on a terminal: a log stays free of it.
class ProgressBar
{
public:
  /// `wanted` false: never draws.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` 0 .. 1. Draws a changed fraction at most ten times per second.
  void Show(double fraction, const std::string& text);

  /// Draws at once.
  void Start(const std::string& text);

  /// Wipes the line.
  void Clear();

private:
  bool Draws;
  std::chrono::steady_clock::time_point LastDrawn;
};

}

#endif
