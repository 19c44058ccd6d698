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
LiveStep MakeStep(vtkDelaunayFlip* filter, bool withholdsMesh)
{
  const vtkMTimeType before = filter->GetOutputDataObject(0)->GetUpdateTime();
  bool works = true;
  if (withholdsMesh)
  {
    works = filter->AdvanceSession();
  }
  else
  {
    filter->Advance();
    works = filter->GetExecutive()->Update(0) != 0;
  }
  const bool isWithheld = filter->GetMeshIsWithheld();
  if (!works || filter->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
  {
    return { LiveState::Failed, isWithheld };
  }
  const bool isNew = filter->GetOutputDataObject(0)->GetUpdateTime() != before;
  const LiveState state = isNew ? ToState(filter->GetStopReason()) : LiveState::Unchanged;
  if (isWithheld && IsEnd(state))
  {
    filter->GetExecutive()->Update(0); // puts the mesh out
  }
  return { state, isWithheld };
}

bool IsEnd(LiveState state) { return state != LiveState::UnderWay && state != LiveState::Aborted; }

}
