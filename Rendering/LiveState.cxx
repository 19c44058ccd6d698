// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveState.h"

#include "vtkDataObject.h"
#include "vtkDelaunayFlip.h"
#include "vtkExecutive.h"

namespace delaunayflip
{

namespace
{

LiveState ToState(int stopReason)
{
  switch (stopReason)
  {
    case vtkDelaunayFlip::STOP_REASON_RUNNING:
      return LiveState::UnderWay;
    case vtkDelaunayFlip::STOP_REASON_ABORTED:
      return LiveState::Aborted;
    case vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT:
      return LiveState::Limited;
    default:
      return LiveState::Converged;
  }
}

}

/// An update caused only by a change of the input or of an option is a step too.
LiveState MakeStep(vtkDelaunayFlip* filter)
{
  const vtkMTimeType before = filter->GetOutputDataObject(0)->GetUpdateTime();
  filter->Advance();
  const bool works = filter->GetExecutive()->Update(0) != 0;
  if (!works || filter->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
  {
    return LiveState::Failed;
  }
  const bool isNew = filter->GetOutputDataObject(0)->GetUpdateTime() != before;
  return isNew ? ToState(filter->GetStopReason()) : LiveState::Unchanged;
}

bool IsEnd(LiveState state) { return state != LiveState::UnderWay && state != LiveState::Aborted; }

}
