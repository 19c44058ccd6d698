// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressBar.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace delaunayflip
{

ProgressBar::ProgressBar(bool wanted)
  : Draws(wanted && isatty(STDERR_FILENO))
{
}

ProgressBar::~ProgressBar() { this->Clear(); }

void ProgressBar::Show(double fraction, const std::string& text)
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->Draws || now - this->LastDrawn < std::chrono::milliseconds(100))
  {
    return;
  }
  this->LastDrawn = now;
  constexpr int width = 30;
  const int done = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
  std::cerr << "\r\033[K[" << std::string(done, '#') << std::string(width - done, '-') << "] "
            << text << std::flush;
}

void ProgressBar::Start(const std::string& text)
{
  this->LastDrawn = {};
  this->Show(0.0, text);
}

void ProgressBar::Clear()
{
  if (this->Draws)
  {
    std::cerr << "\r\033[K" << std::flush;
  }
}

}
