// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_JOBMESSAGES_H
#define DELAUNAYFLIP_JOBMESSAGES_H

#include "Console.h"

#include <string>
#include <vector>

namespace delaunayflip
{

/// What a run tells before its summary. Warnings are printed in any case, and kept for the report.
class JobMessages
{
public:
  /// @param isQuiet whether notes and hints are left out.
  explicit JobMessages(bool isQuiet)
    : IsQuiet(isQuiet)
  {
  }

  void Warn(const std::string& warning)
  {
    PrintWarning(warning);
    this->Warnings.push_back(warning);
  }

  void Note(const std::string& note) const
  {
    if (!this->IsQuiet)
    {
      PrintNote(note);
    }
  }

  void Hint(const std::string& hint) const
  {
    if (!this->IsQuiet)
    {
      PrintHint(hint);
    }
  }

  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }

private:
  const bool IsQuiet;
  std::vector<std::string> Warnings;
};

}

#endif
