// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef VersionDifferences_h
#define VersionDifferences_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

/// @file
/// Everything that depends on the version of VTK.

namespace delaunayflip
{

/// Whether `filter` was asked to abort, directly or, from VTK 9.3 on, through a filter upstream.
/// After a direct request the filter keeps its output, which the executive would otherwise empty.
inline bool IsAbortRequested(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  const bool aborted = filter->CheckAbort();
  if (filter->GetAbortExecute())
  {
    filter->SetAbortOutput(false);
  }
  return aborted;
#else
  return filter->GetAbortExecute() != 0;
#endif
}

/// Ends a request to abort with the update that obeyed it. From VTK 9.3 on the executive does not,
/// and all later updates would be aborted too.
inline void ForgetAbortRequest(vtkAlgorithm* filter) { filter->SetAbortExecute(0); }

}

#endif
