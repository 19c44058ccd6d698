// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HostProgram.h"

#if defined(DELAUNAYFLIP_PARAVIEW)
#include "vtkProcessModule.h"
#endif

namespace delaunayflip
{

bool IsBatchProgram()
{
#if defined(DELAUNAYFLIP_PARAVIEW)
  return vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_BATCH;
#else
  return false;
#endif
}

}
