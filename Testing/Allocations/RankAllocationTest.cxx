// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Under mpirun: allocations of one rank fail one by one, also those for messages. All ranks fail
/// with the same message, and none waits for another.

#include "FailingAllocations.h"
#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkMPIController.h"
#include "vtkOutputWindow.h"
#include "vtkPDelaunayFlip.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkStringOutputWindow.h"

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace
{

constexpr int Failing = 1;

enum Outcome : int
{
  Done,
  Told, ///< That the rank lacks memory.
  Other
};

/// A part of a mesh, with all of its points.
vtkSmartPointer<vtkPolyData> MakePart(int part, int parts)
{
  const auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(12, 1));
  const Cells all = GetCells(mesh->GetPolys());
  Cells own;
  for (std::size_t t = 0; t < all.size(); ++t)
  {
    if (static_cast<int>(t * parts / all.size()) == part)
    {
      own.push_back(all[t]);
    }
  }
  mesh->SetPolys(MakeCells(own));
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  AddNumbers(mesh->GetPointData(), "Number", mesh->GetNumberOfPoints(), 0);
  return mesh;
}

vtkSmartPointer<vtkDataObject> MakeInput(vtkMultiProcessController* controller, bool isComposite)
{
  const int rank = controller->GetLocalProcessId();
  const int ranks = controller->GetNumberOfProcesses();
  if (!isComposite)
  {
    return MakePart(rank, ranks);
  }
  auto partitions = vtkSmartPointer<vtkPartitionedDataSet>::New();
  partitions->SetPartition(0, MakePart(2 * rank, 2 * ranks));
  partitions->SetPartition(1, MakePart(2 * rank + 1, 2 * ranks));
  return partitions;
}

Outcome Describe(vtkDelaunayFlip* filter)
{
  const std::string message = filter->GetErrorMessage();
  if (filter->GetFailure() == vtkDelaunayFlip::FAILURE_NONE)
  {
    return Done;
  }
  return message.find("rank 1: not enough memory") != std::string::npos ? Told : Other;
}

/// The outcomes of all ranks.
std::vector<int> GatherOutcomes(vtkDelaunayFlip* filter, vtkMultiProcessController* controller)
{
  const int own = Describe(filter);
  std::vector<int> all(controller->GetNumberOfProcesses());
  controller->AllGather(&own, all.data(), 1);
  return all;
}

/// Updates with the first allocation of the rank failing, another one `step` later, and so on until
/// an update gets through. @returns whether all ranks always said the same.
bool FailEach(vtkPDelaunayFlip* filter, vtkMultiProcessController* controller, int step)
{
  const int rank = controller->GetLocalProcessId();
  int told = 0;
  for (int number = 1;; number += step)
  {
    filter->Modified();
    int hasFailed = 0;
    if (rank == Failing)
    {
      FailingAllocations failing(number);
      filter->UpdatePiece(rank, controller->GetNumberOfProcesses(), 0);
      hasFailed = FailingAllocations::Stop() ? 1 : 0;
    }
    else
    {
      filter->UpdatePiece(rank, controller->GetNumberOfProcesses(), 0);
    }
    controller->Broadcast(&hasFailed, 1, Failing);
    const std::vector<int> outcomes = GatherOutcomes(filter, controller);
    const bool areSame = std::count(outcomes.begin(), outcomes.end(), outcomes.front()) ==
      controller->GetNumberOfProcesses();
    told += outcomes.front() == Told ? 1 : 0;
    if (!areSame || outcomes.front() == Other)
    {
      std::cerr << "allocation " << number << " of rank 1: rank " << rank << " says '"
                << filter->GetErrorMessage() << "'\n";
      return false;
    }
    if (!hasFailed)
    {
      return told * step > 1000 && outcomes.front() == Done;
    }
  }
}

bool RunCase(vtkMultiProcessController* controller, bool isComposite, int step)
{
  const vtkSmartPointer<vtkDataObject> input = MakeInput(controller, isComposite);
  vtkNew<vtkPDelaunayFlip> filter;
  filter->SetInputDataObject(input);
  filter->SetBackendToThreads();
  filter->SetNumberOfThreads(1);
  filter->UpdatePiece( // also what a process allocates only once
    controller->GetLocalProcessId(), controller->GetNumberOfProcesses(), 0);
  return Describe(filter) == Done && FailEach(filter, controller, step);
}

}

/// Arguments: `mesh` or `partitions`, and a step: 1 if each allocation is to fail.
int main(int argc, char* argv[])
{
  vtkOutputWindow::SetInstance(vtkNew<vtkStringOutputWindow>());
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  const bool isComposite = argc > 1 && std::string(argv[1]) == "partitions";
  const bool isRight = RunCase(controller, isComposite, argc > 2 ? std::stoi(argv[2]) : 1);
  vtkMultiProcessController::SetGlobalController(nullptr);
  vtkOutputWindow::SetInstance(nullptr);
  controller->Finalize();
  return isRight ? 0 : 1;
}
