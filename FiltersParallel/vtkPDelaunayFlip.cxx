// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPDelaunayFlip.h"

#include "ControllerGroup.h"

#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

using namespace delaunayflip;

vtkStandardNewMacro(vtkPDelaunayFlip);
vtkCxxSetObjectMacro(vtkPDelaunayFlip, Controller, vtkMultiProcessController);

vtkPDelaunayFlip::vtkPDelaunayFlip()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkPDelaunayFlip::~vtkPDelaunayFlip() { this->SetController(nullptr); }

//------------------------------------------------------------------------------
std::unique_ptr<PieceGroup> vtkPDelaunayFlip::MakeGroup()
{
  const bool isShared = this->Controller && this->Controller->GetNumberOfProcesses() > 1;
  return isShared ? ControllerGroup::Make(this->Controller) : nullptr;
}

//------------------------------------------------------------------------------
void vtkPDelaunayFlip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "NumberOfRounds: " << this->GetNumberOfRounds() << "\n";
}
