// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pqDelaunayFlipHiddenArrays.h"

#if __has_include("vtkPVRepresentedArrayListSettings.h")
#include "vtkCommand.h"
#include "vtkPVRepresentedArrayListSettings.h"

#include <cstring>

namespace
{

constexpr const char* Expression = "^DelaunayFlip:";

bool HasExpression(vtkPVRepresentedArrayListSettings* settings)
{
  for (int i = 0; i < settings->GetNumberOfFilterExpressions(); ++i)
  {
    if (std::strcmp(settings->GetFilterExpression(i), Expression) == 0)
    {
      return true;
    }
  }
  return false;
}

}

void pqDelaunayFlipHiddenArrays::Start()
{
  // ParaView replaces all expressions when the user edits or loads settings.
  auto* settings = vtkPVRepresentedArrayListSettings::GetInstance();
  this->Observer = settings->AddObserver(
    vtkCommand::ModifiedEvent, this, &pqDelaunayFlipHiddenArrays::AddExpression);
  this->AddExpression();
}

void pqDelaunayFlipHiddenArrays::Stop()
{
  vtkPVRepresentedArrayListSettings::GetInstance()->RemoveObserver(this->Observer);
}

void pqDelaunayFlipHiddenArrays::AddExpression()
{
  auto* settings = vtkPVRepresentedArrayListSettings::GetInstance();
  if (this->IsAdding || HasExpression(settings))
  {
    return;
  }
  this->IsAdding = true; // the following calls modify the settings, twice
  const int last = settings->GetNumberOfFilterExpressions();
  settings->SetNumberOfFilterExpressions(last + 1);
  settings->SetFilterExpression(last, Expression);
  this->IsAdding = false;
}

#else

void pqDelaunayFlipHiddenArrays::Start() {}
void pqDelaunayFlipHiddenArrays::Stop() {}

#endif
