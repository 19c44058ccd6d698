// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OUTPUTFILES_H
#define DELAUNAYFLIP_OUTPUTFILES_H

#include "Arguments.h"
#include "PendingFile.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace delaunayflip
{

/// The files that a run writes. They are created before the work begins, so that a missing write
/// permission is noticed early, and get their final names after it.
struct OutputFiles
{
  /// @throws CommandError (BadFile).
  explicit OutputFiles(const Arguments& arguments)
    : Mesh(arguments.Output)
  {
    if (!arguments.Statistics.empty())
    {
      this->Statistics.emplace(arguments.Statistics, true);
    }
    if (!arguments.Report.empty())
    {
      this->Report.emplace(arguments.Report, true);
    }
  }

  /// All of them, or none.
  /// @throws CommandError (BadFile).
  void Commit()
  {
    std::vector<PendingFile*> done;
    try
    {
      for (PendingFile* file : this->GetAll())
      {
        file->Commit();
        done.push_back(file);
      }
    }
    catch (...)
    {
      std::for_each(done.begin(), done.end(), [](PendingFile* file) { file->Undo(); });
      throw;
    }
  }

  /// The mesh comes last, because it matters most.
  std::vector<PendingFile*> GetAll()
  {
    std::vector<PendingFile*> all;
    for (std::optional<PendingFile>* file : { &this->Statistics, &this->Report })
    {
      if (*file)
      {
        all.push_back(&**file);
      }
    }
    all.push_back(&this->Mesh);
    return all;
  }

  PendingFile Mesh;
  std::optional<PendingFile> Statistics;
  std::optional<PendingFile> Report;
};

}

#endif
