// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMesh.h"

#include "CompositeBlocks.h"
#include "MalformedArrays.h"
#include "PieceInput.h"

#include "vtkPolyData.h"

#include <algorithm>

namespace delaunayflip
{

void BlockMesh::Read(const Reader& read, const std::string& regions, int rank)
{
  for (const BlockLeaf& leaf : this->Block.Leaves)
  {
    const vtkSmartPointer<vtkPolyData> mesh = leaf.MayBeMesh ? read(leaf.Data) : nullptr;
    if (mesh)
    {
      this->Meshes.push_back(mesh);
      this->Numbers.push_back(leaf.Number);
      this->Names.push_back(leaf.Name);
    }
  }
  if (this->Meshes.size() > 1)
  {
    this->Joined.reset(new JoinedPartitions(this->Meshes, regions, rank));
  }
}

bool BlockMesh::HasOtherCells() const
{
  return std::any_of(this->Block.Leaves.begin(), this->Block.Leaves.end(),
    [this](const BlockLeaf& leaf)
    {
      return leaf.HasCells &&
        std::find(this->Numbers.begin(), this->Numbers.end(), leaf.Number) == this->Numbers.end();
    });
}

bool BlockMesh::HasAmbiguousPoints() const
{
  return this->Joined && this->Joined->CountAmbiguousPoints() > 0;
}

std::vector<Note> BlockMesh::ListMalformedArrays() const
{
  std::vector<Note> notes;
  for (std::size_t i = 0; i < this->Meshes.size(); ++i)
  {
    AddMalformedArrays(this->Meshes[i], this->Names[i], notes);
  }
  return notes;
}

vtkSmartPointer<vtkPolyData> BlockMesh::GetMesh() const
{
  if (this->Joined)
  {
    return this->Joined->GetMesh();
  }
  return this->HasMesh() ? this->Meshes.front() : vtkSmartPointer<vtkPolyData>::New();
}

vtkSmartPointer<vtkPolyData> BlockMesh::FindConstraints(const BlockConstraints& constraints) const
{
  const auto found = constraints.Blocks.find(this->Block.Place);
  std::vector<BlockLeaf> leaves;
  if (found != constraints.Blocks.end())
  {
    leaves = found->second;
  }
  for (const unsigned int number : this->Numbers)
  {
    if (constraints.OfAll)
    {
      leaves.push_back({ constraints.OfAll, number });
    }
  }
  const bool areOfAll = constraints.OfAll && constraints.OfAll->GetNumberOfPoints() > 0;
  if (areOfAll || leaves.empty() || (!this->Joined && leaves.size() == 1))
  {
    return leaves.empty() ? constraints.OfAll : vtkPolyData::SafeDownCast(leaves.front().Data);
  }
  std::vector<ConstraintsOfMesh> sources;
  for (const BlockLeaf& leaf : leaves)
  {
    const auto number = std::find(this->Numbers.begin(), this->Numbers.end(), leaf.Number);
    vtkPolyData* mesh =
      number == this->Numbers.end() ? nullptr : this->Meshes[number - this->Numbers.begin()].Get();
    sources.push_back({ vtkPolyData::SafeDownCast(leaf.Data), mesh });
  }
  return JoinConstraints(sources);
}

void BlockMesh::Store(vtkPolyData* flipped, BlockLeaves& leaves) const
{
  for (const BlockLeaf& leaf : this->Block.Leaves)
  {
    leaves[leaf.Number] = CopyBlock(leaf.Data);
  }
  if (!flipped || this->Meshes.empty())
  {
    return;
  }
  if (!this->Joined)
  {
    JoinedPartitions::RemoveMarks(flipped);
    leaves[this->Numbers.front()] = flipped;
    return;
  }
  const auto partitions = this->Joined->Divide(flipped);
  for (std::size_t i = 0; i < partitions.size(); ++i)
  {
    leaves[this->Numbers[i]] = partitions[i];
  }
}

void BlockMesh::StoreNothing(BlockLeaves& leaves) const
{
  for (const BlockLeaf& leaf : this->Block.Leaves)
  {
    leaves[leaf.Number] = vtkSmartPointer<vtkPolyData>::New();
  }
}

}
