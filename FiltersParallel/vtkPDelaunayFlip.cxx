// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPDelaunayFlip.h"

#include "FlipError.h"
#include "MeshBlocks.h"
#include "PieceUpdate.h"
#include "RankMessages.h"
#include "UpdateReport.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

#include <functional>
#include <map>
#include <string>

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
  return isShared ? MakeControllerGroup(this->Controller) : nullptr;
}

//------------------------------------------------------------------------------
namespace
{

/// The blocks that any rank has, in the same order on all ranks, each with the leaves of this rank.
std::vector<MeshBlock> ShareBlocks(const std::vector<MeshBlock>& own, PieceGroup& group)
{
  Message message;
  for (const MeshBlock& block : own)
  {
    Put(message, block.Place);
    Put(message, block.Name);
    Put(message, block.Size);
  }
  std::map<std::vector<std::int64_t>, MeshBlock> shared;
  for (MessageReader reader = GatherAll(message, group); !reader.IsAtEnd();)
  {
    const auto place = reader.Get<std::vector<std::int64_t>>();
    const auto name = reader.Get<std::string>();
    MeshBlock& block =
      shared.emplace(place, MeshBlock{ place, name, 0.0, false, {} }).first->second;
    block.Size += reader.Get<double>();
  }
  for (const MeshBlock& block : own)
  {
    if (block.Place.empty() && shared.size() > 1)
    {
      throw InvalidOptions("this rank has a single mesh, but others have composite datasets");
    }
    shared[block.Place].Leaves = block.Leaves;
  }
  std::vector<MeshBlock> blocks;
  for (auto& entry : shared)
  {
    blocks.push_back(std::move(entry.second));
  }
  return blocks;
}

/// The notes of all ranks, in their order, with the rank's number.
std::vector<Note> ShareNotes(const std::vector<Note>& own, PieceGroup& group)
{
  Message message;
  for (const Note& note : own)
  {
    Put(message,
      "rank " + std::to_string(group.GetRank()) + (note.Where.empty() ? "" : ", " + note.Where));
    Put(message, note.Text);
  }
  std::vector<Note> notes;
  for (MessageReader reader = GatherAll(message, group); !reader.IsAtEnd();)
  {
    Note& note = notes.emplace_back();
    reader.Get(note.Where);
    reader.Get(note.Text);
  }
  return notes;
}

}

std::vector<MeshBlock> vtkPDelaunayFlip::ListBlocks(vtkDataObject* input)
{
  this->NumberOfRounds = 0;
  this->NumberOfMovedTriangles = 0;
  this->IsSilent = false;
  this->Group = this->MakeGroup();
  if (!this->Group)
  {
    return this->Superclass::ListBlocks(input);
  }
  this->IsSilent = this->Group->GetRank() > 0;
  std::vector<MeshBlock> blocks;
  const auto share = [&](PieceGroup& told)
  {
    const FlipRequest request = this->MakeRequest(nullptr, nullptr);
    const auto write = [](bool value) { return value ? "on" : "off"; };
    RequireSameOptions(request.Options, told,
      { { "RegionArray", request.Settings.RegionArray },
        { "Triangulate", write(request.Settings.Triangulate) },
        { "LinesAsConstraints", write(request.Settings.LinesAsConstraints) },
        { "InsertLines", write(request.Settings.InsertLines) },
        { "InsertConstraints", write(request.Settings.InsertConstraints) },
        { "GenerateFlipCount", write(request.WantsFlipCounts) },
        { "GenerateQuality", write(request.WantsAngles) } });
    blocks = ShareBlocks(ListMeshBlocks(input, vtkDataObject::CELL), told);
  };
  RunTogether(*this->Group, std::ref(share));
  return blocks;
}

/// Whatever fails on a rank, all ranks fail.
void vtkPDelaunayFlip::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& constraints, UpdateSummary& summary)
{
  if (!this->Group)
  {
    this->Superclass::FlipLeaves(block, constraints, summary);
    return;
  }
  const auto flip = [&](PieceGroup& told)
  {
    BlockMesh mesh(block, this->RegionArray, true);
    const auto edges = mesh.FindConstraints(constraints);
    const std::vector<Note> notes = ShareNotes(mesh.ListNotes(true), told);
    summary.Warnings.insert(summary.Warnings.end(), notes.begin(), notes.end());
    if (summary.Report.StopReason == StopReasonKind::Aborted ||
      !IsOnAnyRank(mesh.GetMesh() != nullptr, told))
    {
      mesh.Store(nullptr);
      return;
    }
    vtkNew<vtkPolyData> empty, flipped;
    const PiecesReport report = FlipPieces(
      this->MakeRequest(mesh.GetMesh() ? mesh.GetMesh() : empty.Get(), edges), told, flipped);
    const auto addCount = [&](const char* name, std::int64_t count)
    {
      vtkNew<vtkIdTypeArray> array;
      array->SetName(name);
      array->InsertNextValue(count);
      flipped->GetFieldData()->AddArray(array);
    };
    addCount("DelaunayFlip:Rounds", report.Rounds);
    addCount("DelaunayFlip:MovedTriangles", report.MovedTriangles);
    AddFieldData(report, flipped->GetFieldData());
    mesh.Store(flipped);
    this->NumberOfRounds = std::max<vtkIdType>(this->NumberOfRounds, report.Rounds);
    this->NumberOfMovedTriangles += report.MovedTriangles;
    *this->Report = report;
    if (report.AmbiguousPoints > 0)
    {
      summary.Warnings.push_back({ block.Name,
        std::to_string(report.AmbiguousPoints) +
          " points at the borders of pieces coincide with others of the same piece, and edges "
          "there stayed; number the points of the mesh before it is cut, as vtkGlobalPointIds" });
    }
  };
  RunTogether(*this->Group, std::ref(flip));
}

//------------------------------------------------------------------------------
void vtkPDelaunayFlip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "NumberOfRounds: " << this->NumberOfRounds << "\n";
}
