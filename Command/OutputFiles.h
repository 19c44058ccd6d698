// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OUTPUTFILES_H
#define DELAUNAYFLIP_OUTPUTFILES_H

#include "Arguments.h"
#include "PendingFile.h"

#include <optional>

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
      this->Statistics.emplace(arguments.Statistics);
    }
    if (!arguments.Report.empty())
    {
      this->Report.emplace(arguments.Report);
    }
  }

  /// @throws CommandError (BadFile).
  void Commit()
  {
    this->Mesh.Commit();
    for (std::optional<PendingFile>* file : { &this->Statistics, &this->Report })
    {
      if (*file)
      {
        (*file)->Commit();
      }
    }
  }

  PendingFile Mesh;
  std::optional<PendingFile> Statistics;
  std::optional<PendingFile> Report;
};

}

#endif
