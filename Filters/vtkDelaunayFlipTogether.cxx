// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The part of vtkDelaunayFlip that runs in an update of many ranks, each of which has a piece of
/// every mesh.

#include "vtkDelaunayFlip.h"

#include "CompositeBlocks.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "PieceInput.h"
#include "PieceUpdate.h"
#include "SharedBlocks.h"
#include "UpdateSummary.h"

#include "vtkCompositeDataSet.h"
#include "vtkPolyData.h"

#include <functional>
#include <map>
#include <stdexcept>
#include <string>

using namespace delaunayflip;

/// A mesh of which every rank has a piece.
struct vtkDelaunayFlip::SharedMesh
{
  std::function<vtkSmartPointer<vtkPolyData>()> GetPiece; ///< May throw; never returns null.
  vtkPolyData* Constraints; ///< Or null.
  vtkPolyData* Output;
  std::string Name; ///< In messages; empty if it is the only mesh.
};

//------------------------------------------------------------------------------
std::unique_ptr<PieceGroup> vtkDelaunayFlip::MakeGroup() { return nullptr; }

//------------------------------------------------------------------------------
/// GetMesh, for DoTogether.
/// @throws InvalidMesh if the input contradicts itself.
vtkSmartPointer<vtkPolyData> vtkDelaunayFlip::ReadMesh(vtkDataObject* input)
{
  try
  {
    return this->GetMesh(input);
  }
  catch (const std::invalid_argument& error)
  {
    throw InvalidMesh(error.what(), -1, -1);
  }
}

//------------------------------------------------------------------------------
UpdateSummary vtkDelaunayFlip::FlipTogether(
  vtkDataObject* input, vtkDataObject* constraints, vtkDataObject* output, PieceGroup& group)
{
  this->Run.reset();
  *this->Report = UpdateReport();
  this->CanContinue = false;
  auto* blocks = vtkCompositeDataSet::SafeDownCast(input);
  if (IsOnAnyRank(blocks != nullptr, group))
  {
    return this->FlipSharedBlocks(
      blocks, constraints, vtkCompositeDataSet::SafeDownCast(output), group);
  }
  UpdateSummary summary;
  const auto getPiece = [&]()
  {
    if (constraints && !vtkPolyData::SafeDownCast(constraints))
    {
      throw InvalidOptions("the constraints of a single mesh cannot be a composite dataset");
    }
    vtkSmartPointer<vtkPolyData> mesh = this->ReadMesh(input);
    if (!mesh)
    {
      throw InvalidMesh("the input is not a surface; apply Extract Surface first", -1, -1);
    }
    return mesh;
  };
  this->FlipShared(
    { getPiece, vtkPolyData::SafeDownCast(constraints), vtkPolyData::SafeDownCast(output), "" },
    group, summary);
  return summary;
}

//------------------------------------------------------------------------------
/// Flips a mesh. After a failure its output is empty on all ranks.
void vtkDelaunayFlip::FlipShared(const SharedMesh& mesh, PieceGroup& group, UpdateSummary& summary)
{
  PieceUpdate update;
  MeshOutcome outcome;
  const auto flip = [&](PieceGroup& told)
  {
    const PieceRequest request{ mesh.GetPiece, mesh.Constraints,
      { this->Triangulate, this->LinesAsConstraints, this->InsertLines, this->InsertConstraints,
        this->RegionArray },
      this->GetOptions(), { this->GenerateFlipCount, this->GenerateQuality },
      [this](double fraction) { return this->ObserveProgress(fraction); } };
    update = FlipPieces(request, told, mesh.Output);
  };
  outcome.Failure = Attempt([&]() { RunTogether(group, std::ref(flip)); });
  if (outcome.Failure)
  {
    mesh.Output->Initialize();
    update = PieceUpdate();
  }
  outcome.Report = update.Report;
  outcome.Trouble = DescribeTrouble(update.Report, this->MaximumIterations >= 0);
  summary.AddMesh(outcome, 0, mesh.Name);
  if (update.AmbiguousPoints > 0)
  {
    summary.Warnings.push_back({ mesh.Name,
      std::to_string(update.AmbiguousPoints) +
        " points at the borders of pieces coincide with others of the same piece, and edges there "
        "stayed; give the points global ids" });
  }
}

//------------------------------------------------------------------------------
/// Flips every leaf that is a mesh on some rank, as a mesh of its own.
UpdateSummary vtkDelaunayFlip::FlipSharedBlocks(vtkCompositeDataSet* input,
  vtkDataObject* constraints, vtkCompositeDataSet* output, PieceGroup& group)
{
  std::map<BlockPlace, vtkSmartPointer<vtkPolyData>> edgesOfBlocks;
  vtkSmartPointer<vtkCompositeDataSet> blocks; // observers may change the input
  auto* edges = vtkCompositeDataSet::SafeDownCast(constraints);
  DoTogether(group,
    [&]()
    {
      if (!input)
      {
        throw InvalidOptions("this rank has a single mesh, but others have composite datasets");
      }
      blocks = vtkSmartPointer<vtkCompositeDataSet>::Take(input->NewInstance());
      blocks->ShallowCopy(input);
      edgesOfBlocks = edges ? ListMeshesByPlace(edges) : edgesOfBlocks;
    });
  UpdateSummary summary;
  summary.Report.StopReason = StopReasonKind::Converged; // what an input without blocks is
  std::map<unsigned int, vtkSmartPointer<vtkDataObject>> results;
  std::vector<SharedBlock> shared;
  const auto list = [&](PieceGroup& told) { shared = ListSharedBlocks(blocks, told); };
  RunTogether(group, std::ref(list)); // a copy would need memory
  for (const SharedBlock& block : shared)
  {
    vtkPolyData* own =
      edges ? edgesOfBlocks[block.Place].Get() : vtkPolyData::SafeDownCast(constraints);
    results[block.Number] = this->FlipSharedBlock(block, own, group, summary);
  }
  TransformBlocks(blocks, output, [&](const Block& block) { return results[block.Number]; });
  this->SetProgressShiftScale(0.0, 1.0);
  summary.HasSeams = HaveSharedPartitions(shared);
  return summary;
}

/// @returns the leaf of this rank's output. A rank that has no triangle of a mesh receives none.
vtkSmartPointer<vtkDataObject> vtkDelaunayFlip::FlipSharedBlock(
  const SharedBlock& block, vtkPolyData* constraints, PieceGroup& group, UpdateSummary& summary)
{
  vtkSmartPointer<vtkPolyData> mesh;
  const auto read = [&]()
  { mesh = block.Data && block.MayBeMesh ? this->ReadMesh(block.Data) : nullptr; };
  MeshOutcome outcome;
  outcome.Failure = Attempt([&]() { DoTogether(group, read); });
  auto flipped = vtkSmartPointer<vtkPolyData>::New();
  if (outcome.Failure)
  {
    summary.AddMesh(outcome, 0, block.Name);
    return flipped;
  }
  if (IsOnAnyRank(block.HasCells && !mesh, group))
  {
    summary.Warnings.push_back({ block.Name, NotASurface });
  }
  const bool isAborted = summary.Report.StopReason == StopReasonKind::Aborted;
  if (!isAborted && IsOnAnyRank(mesh != nullptr, group))
  {
    this->SetProgressShiftScale(block.Before, block.Share);
    const auto getPiece = [&mesh]() { return mesh ? mesh : vtkSmartPointer<vtkPolyData>::New(); };
    this->FlipShared({ getPiece, constraints, flipped, block.Name }, group, summary);
  }
  const bool isPassed = block.Data && (!mesh || isAborted);
  return isPassed ? CopyBlock(isAborted && mesh ? mesh.Get() : block.Data.Get())
                  : vtkSmartPointer<vtkDataObject>(flipped);
}
