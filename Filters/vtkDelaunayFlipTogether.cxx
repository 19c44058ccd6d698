// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The part of vtkDelaunayFlip that runs in an update of composite data, or of many ranks, each of
/// which has a piece of every mesh.

#include "vtkDelaunayFlip.h"

#include "BlockMesh.h"
#include "CompositeBlocks.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "MalformedArrays.h"
#include "PieceFlip.h"
#include "PieceInput.h"
#include "PieceUpdate.h"
#include "SharedBlocks.h"
#include "UpdateReport.h"

#include "vtkCompositeDataSet.h"
#include "vtkPolyData.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace delaunayflip;

namespace
{

constexpr const char* AmbiguousPartitions =
  "points of some partitions coincide with others of the same partition, and edges there stayed; "
  "number the points of the mesh before it is cut, as vtkGlobalPointIds";

/// The group of an update, as blocks see it. RunTogether keeps failures of one block apart from
/// those of the update, which end all blocks.
class UpdateGroup : public PieceGroup
{
public:
  explicit UpdateGroup(PieceGroup& told)
    : Told(told)
  {
  }
  int GetRank() const override { return this->Told.GetRank(); }
  int GetSize() const override { return this->Told.GetSize(); }
  std::vector<Message> Exchange(std::vector<Message> messages) override
  {
    return this->Told.Exchange(std::move(messages));
  }
  std::vector<Message> Gather(const Message& message) override
  {
    return this->Told.Gather(message);
  }

private:
  PieceGroup& Told;
};

/// Adds the warnings of all ranks.
void AddWarnings(const std::vector<Note>& own, PieceGroup& group, UpdateSummary& summary)
{
  const std::vector<Note> all = ShareNotes(own, group);
  summary.Warnings.insert(summary.Warnings.end(), all.begin(), all.end());
}

}

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
/// Whatever fails on a rank, all ranks fail.
UpdateSummary vtkDelaunayFlip::FlipTogether(
  vtkDataObject* input, vtkDataObject* constraints, vtkDataObject* output, PieceGroup& group)
{
  UpdateSummary summary;
  const auto flip = [&](PieceGroup& told)
  {
    this->Run.reset();
    *this->Report = UpdateReport();
    this->CanContinue = false;
    const auto write = [](bool value) { return value ? "on" : "off"; };
    RequireSameOptions(this->GetOptions(), told,
      { { "RegionArray", this->RegionArray }, { "Triangulate", write(this->Triangulate) },
        { "LinesAsConstraints", write(this->LinesAsConstraints) },
        { "InsertLines", write(this->InsertLines) },
        { "InsertConstraints", write(this->InsertConstraints) },
        { "GenerateFlipCount", write(this->GenerateFlipCount) },
        { "GenerateQuality", write(this->GenerateQuality) } });
    UpdateGroup blocks(told);
    summary = this->FlipPieces(input, constraints, output, blocks);
  };
  RunTogether(group, std::ref(flip));
  return summary;
}

UpdateSummary vtkDelaunayFlip::FlipPieces(
  vtkDataObject* input, vtkDataObject* constraints, vtkDataObject* output, PieceGroup& group)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(input);
  if (IsOnAnyRank(blocks != nullptr, group))
  {
    return this->FlipBlocks(blocks, constraints, output, group);
  }
  UpdateSummary summary;
  std::vector<Note> notes;
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
    AddMalformedArrays(mesh, "", notes);
    return mesh;
  };
  this->FlipShared(
    { getPiece, vtkPolyData::SafeDownCast(constraints), vtkPolyData::SafeDownCast(output), "" },
    group, summary);
  AddWarnings(notes, group, summary);
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
    update = delaunayflip::FlipPieces(request, told, mesh.Output);
  };
  outcome.Failure = Attempt([&]() { RunTogether(group, std::ref(flip)); });
  if (outcome.Failure)
  {
    mesh.Output->Initialize();
    update = PieceUpdate();
  }
  outcome.Report = update.Report;
  outcome.Trouble =
    DescribeTrouble(update.Report, this->MaximumIterations >= 0, this->Tolerance >= 0.0);
  summary.AddMesh(outcome, 0, mesh.Name);
  if (update.AmbiguousPoints > 0)
  {
    summary.Warnings.push_back({ mesh.Name,
      std::to_string(update.AmbiguousPoints) +
        " points at the borders of pieces coincide with others of the same piece, and edges there "
        "stayed; number the points of the mesh before it is cut, as vtkGlobalPointIds" });
  }
}

//------------------------------------------------------------------------------
/// Flips every block that is a mesh on some rank, as a mesh of its own.
/// @param group the ranks that have pieces of the blocks; one rank flips its blocks alone.
UpdateSummary vtkDelaunayFlip::FlipBlocks(
  vtkCompositeDataSet* input, vtkDataObject* constraints, vtkDataObject* output, PieceGroup& group)
{
  if (!input)
  {
    throw InvalidOptions("this rank has a single mesh, but others have composite datasets");
  }
  // Observers may change the input.
  const auto blocks = vtkSmartPointer<vtkCompositeDataSet>::Take(input->NewInstance());
  blocks->ShallowCopy(input);
  BlockConstraints edges;
  edges.OfAll = vtkPolyData::SafeDownCast(constraints);
  if (auto* ofBlocks = vtkCompositeDataSet::SafeDownCast(constraints))
  {
    edges.Blocks = ListMeshesByPlace(ofBlocks);
  }
  UpdateSummary summary;
  summary.Report.StopReason = StopReasonKind::Converged; // what an input without blocks is
  BlockLeaves results;
  std::vector<SharedBlock> shared;
  const auto list = [&](PieceGroup& told) { shared = ListSharedBlocks(blocks, told); };
  RunTogether(group, std::ref(list)); // a copy would need memory
  for (const SharedBlock& block : shared)
  {
    this->FlipBlock(block, edges, group, summary, results);
  }
  TransformBlocks(blocks, vtkCompositeDataSet::SafeDownCast(output),
    [&](const Block& block) { return results[block.Number]; });
  this->SetProgressShiftScale(0.0, 1.0);
  return summary;
}

/// Reads a block, flips it and adds its leaves to the output's. A rank that has no triangle of a
/// mesh receives none.
void vtkDelaunayFlip::FlipBlock(const SharedBlock& block, const BlockConstraints& constraints,
  PieceGroup& group, UpdateSummary& summary, BlockLeaves& leaves)
{
  BlockMesh mesh(block);
  vtkSmartPointer<vtkPolyData> edges;
  std::vector<Note> notes;
  const auto read = [&]()
  {
    mesh.Read([this](vtkDataObject* leaf) { return this->ReadMesh(leaf); }, this->RegionArray,
      group.GetRank());
    edges = mesh.FindConstraints(constraints);
    if (mesh.HasPartitions() || group.GetSize() > 1) // a single mesh is told of when it is flipped
    {
      notes = mesh.ListMalformedArrays();
    }
  };
  MeshOutcome outcome;
  outcome.Failure = Attempt([&]() { DoTogether(group, std::ref(read)); }); // a copy needs memory
  if (outcome.Failure)
  {
    mesh.StoreNothing(leaves);
    summary.AddMesh(outcome, 0, block.Name);
    return;
  }
  AddWarnings(notes, group, summary);
  if (IsOnAnyRank(mesh.HasOtherCells(), group))
  {
    summary.Warnings.push_back({ block.Name, NotASurface });
  }
  if (IsOnAnyRank(mesh.HasAmbiguousPoints(), group))
  {
    summary.Warnings.push_back({ block.Name, AmbiguousPartitions });
  }
  if (summary.Report.StopReason == StopReasonKind::Aborted || !IsOnAnyRank(mesh.HasMesh(), group))
  {
    mesh.Store(nullptr, leaves);
    return;
  }
  this->SetProgressShiftScale(block.Before, block.Share);
  const auto flipped = vtkSmartPointer<vtkPolyData>::New();
  if (group.GetSize() > 1)
  {
    const auto getPiece = [&mesh]() { return mesh.GetMesh(); };
    this->FlipShared({ getPiece, edges, flipped, block.Name }, group, summary);
  }
  else
  {
    const vtkSmartPointer<vtkPolyData> whole = mesh.GetMesh();
    const MeshOutcome alone = this->TryToFlip({ whole, edges, flipped, false });
    summary.AddMesh(alone, block.Leaves.front().Number, block.Name);
  }
  DoTogether(group, [&]() { mesh.Store(flipped, leaves); });
}
