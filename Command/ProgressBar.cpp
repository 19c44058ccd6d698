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

void ProgressBar::Begin(double end, const std::string& text)
{
  this->PartBegin = this->PartEnd;
  this->PartEnd = end;
  this->Done = std::max(this->Done, this->PartBegin);
  this->Draw(text);
}

void ProgressBar::Show(double fraction, const std::string& text)
{
  const double done = this->PartBegin + (this->PartEnd - this->PartBegin) * fraction;
  this->Done = std::max(this->Done, std::min(done, this->PartEnd));
  if (std::chrono::steady_clock::now() - this->LastDrawn >= std::chrono::milliseconds(100))
  {
    this->Draw(text);
  }
}

void ProgressBar::Draw(const std::string& text)
{
  if (!this->Draws)
  {
    return;
  }
  this->LastDrawn = std::chrono::steady_clock::now();
  constexpr int width = 30;
  const int done = static_cast<int>(this->Done * width);
  const std::string percent = std::to_string(static_cast<int>(100.0 * this->Done));
  std::cerr << "\r\033[K[" << std::string(done, '#') << std::string(width - done, '-') << "] "
            << percent << " %, " << text << std::flush;
}

void ProgressBar::Clear()
{
  if (this->Draws)
  {
    std::cerr << "\r\033[K" << std::flush;
  }
}

}
