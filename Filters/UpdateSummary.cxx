// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdateSummary.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

void AddNotes(std::vector<Note>& notes, const std::vector<Note>& more, const std::string& place)
{
  for (const Note& note : more)
  {
    notes.push_back({ note.Where.empty() ? place : place + ", " + note.Where, note.Text });
  }
}

}

void UpdateSummary::AddMesh(const MeshOutcome& mesh, std::int64_t block, const std::string& where)
{
  this->Report.Add(mesh.Report, UpdateReport::Timing::InTurn);
  if (mesh.Failure)
  {
    this->Failure = this->Failure == 0 ? mesh.Failure.Kind : this->Failure;
    this->Errors.push_back({ where, mesh.Failure.Message });
  }
  if (!mesh.Trouble.empty())
  {
    this->Warnings.push_back({ where, mesh.Trouble });
  }
  if (mesh.Report.Triangles > 0)
  {
    this->Blocks.push_back(block);
  }
}

void UpdateSummary::AddRank(const UpdateSummary& other, int rank)
{
  const std::string place = "rank " + std::to_string(rank);
  this->Report.Add(other.Report, UpdateReport::Timing::AtOnce);
  this->Failure = this->Failure == 0 ? other.Failure : this->Failure;
  AddNotes(this->Errors, other.Errors, place);
  AddNotes(this->Warnings, other.Warnings, place);
  const std::size_t known = this->Blocks.size();
  this->Blocks.insert(this->Blocks.end(), other.Blocks.begin(), other.Blocks.end());
  std::sort(this->Blocks.begin() + known, this->Blocks.end());
  std::inplace_merge(this->Blocks.begin(), this->Blocks.begin() + known, this->Blocks.end());
  const auto end = std::unique(this->Blocks.begin(), this->Blocks.end());
  this->HasSeams = this->HasSeams || other.HasSeams || end != this->Blocks.end();
  this->Blocks.erase(end, this->Blocks.end());
}

}
