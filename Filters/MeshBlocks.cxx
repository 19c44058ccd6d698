// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshBlocks.h"

#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "FlipError.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPolyData.h"
#include "vtkUniformGridAMR.h"

#include <algorithm>
#include <map>
#include <utility>

namespace delaunayflip
{
namespace
{

/// The cell array by which a joined mesh is divided again.
constexpr const char* OwnerName = "vtkDelaunayFlipPartition";

/// The leaves of AMR, which is a tree from VTK 9.6 on, are grids.
vtkDataObjectTree* GetTree(vtkDataObject* data)
{
  return vtkUniformGridAMR::SafeDownCast(data) ? nullptr : vtkDataObjectTree::SafeDownCast(data);
}

/// @param number the flat index of the tree, and then of its last node.
void AddLeaves(vtkDataObjectTree* tree, int elements, std::vector<std::int64_t> place,
  unsigned int& number, std::vector<MeshBlock>& blocks)
{
  const bool arePartitions = vtkPartitionedDataSet::SafeDownCast(tree) != nullptr;
  place.push_back(0);
  const auto child = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
  child->TraverseSubTreeOff();
  child->VisitOnlyLeavesOff();
  child->SkipEmptyNodesOff();
  std::int64_t i = 0;
  constexpr std::size_t None = SIZE_MAX;
  std::size_t joined = None; // the block of the partitions that are not empty
  for (child->InitTraversal(); !child->IsDoneWithTraversal(); child->GoToNextItem(), ++i)
  {
    ++number;
    vtkDataObject* data = child->GetCurrentDataObject();
    const double size = data ? static_cast<double>(data->GetNumberOfElements(elements)) : 0.0;
    const bool isJoined = arePartitions && size > 0.0;
    place.back() = isJoined ? 0 : arePartitions ? -1 - i : i;
    if (vtkDataObjectTree* inner = GetTree(data))
    {
      AddLeaves(inner, elements, place, number, blocks);
    }
    else if (data)
    {
      vtkInformation* about = child->HasCurrentMetaData() ? child->GetCurrentMetaData() : nullptr;
      const char* text = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
      const std::string name =
        "block " + std::to_string(number) + (text && *text ? std::string(" (") + text + ")" : "");
      if (!isJoined || joined == None)
      {
        joined = isJoined ? blocks.size() : joined;
        blocks.push_back({ place, name, 0.0, false, {} });
      }
      MeshBlock& block = isJoined ? blocks[joined] : blocks.back();
      block.Size += size;
      block.Leaves.push_back({ data, number, name, nullptr });
    }
  }
}

}

std::vector<MeshBlock> ListMeshBlocks(vtkDataObject* input, int elements)
{
  std::vector<MeshBlock> blocks;
  unsigned int number = 0;
  if (vtkDataObjectTree* tree = GetTree(input))
  {
    AddLeaves(tree, elements, {}, number, blocks);
  }
  else
  {
    std::vector<std::int64_t> place(vtkCompositeDataSet::SafeDownCast(input) ? 1 : 0);
    const auto size = static_cast<double>(input->GetNumberOfElements(elements));
    blocks.push_back({ place, "", size, false, { { input, number, "", nullptr } } });
  }
  return blocks;
}

void StoreResults(const std::vector<MeshBlock>& blocks, vtkDataObject* input, vtkDataObject* output)
{
  vtkDataObjectTree* given = GetTree(input);
  auto* tree = vtkDataObjectTree::SafeDownCast(output);
  if (!given || !tree)
  {
    output->ShallowCopy(blocks.front().Leaves.front().Result);
    return;
  }
  std::map<unsigned int, vtkDataObject*> results; // by flat index
  for (const MeshBlock& block : blocks)
  {
    for (const BlockLeaf& leaf : block.Leaves)
    {
      results[leaf.Number] = leaf.Result;
    }
  }
  tree->CopyStructure(given);
  tree->GetFieldData()->ShallowCopy(given->GetFieldData());
  const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(given->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    tree->SetDataSet(leaf, results[leaf->GetCurrentFlatIndex()]);
  }
}

//------------------------------------------------------------------------------
BlockMesh::BlockMesh(MeshBlock& block, const std::string& regions, bool dropsDuplicates)
  : Block(block)
{
  MeshList meshes;
  for (const BlockLeaf& leaf : block.Leaves)
  {
    this->Surfaces.emplace_back(vtkPolyData::SafeDownCast(leaf.Data));
    if (this->Surfaces.back())
    {
      meshes.push_back(this->Surfaces.back());
    }
  }
  this->IsJoined = meshes.size() > 1;
  if (this->IsJoined)
  {
    this->Joined = JoinPartitions(meshes, regions);
    this->Mesh = this->Joined.Mesh;
    if (!dropsDuplicates)
    {
      this->Joined.Owners->SetName(OwnerName);
      this->Mesh->GetCellData()->AddArray(this->Joined.Owners);
    }
  }
  else if (!meshes.empty())
  {
    this->Mesh = dropsDuplicates ? DropDuplicateCells(meshes.front()) : meshes.front();
  }
}

std::vector<Note> BlockMesh::ListNotes(bool ofArrays) const
{
  std::vector<Note> notes;
  bool areAllSurfaces = true;
  for (std::size_t i = 0; i < this->Surfaces.size(); ++i)
  {
    const bool isAsked = this->Surfaces[i] && (this->IsJoined || ofArrays);
    const std::string text =
      isAsked ? DescribeDefects(ListMalformedArrays(this->Surfaces[i], false, false)) : "";
    if (!text.empty())
    {
      notes.push_back({ this->Block.Leaves[i].Name, text });
    }
    areAllSurfaces = areAllSurfaces && this->Surfaces[i];
  }
  if (!areAllSurfaces && this->Block.Size > 0.0)
  {
    notes.push_back({ this->Block.Name, "not a surface, passed unchanged" });
  }
  if (this->Joined.Ambiguous > 0)
  {
    notes.push_back({ this->Block.Name,
      "points of some partitions coincide with others of the same partition, and edges there "
      "stayed; number the points of the mesh before it is cut, as vtkGlobalPointIds" });
  }
  return notes;
}

vtkSmartPointer<vtkPolyData> BlockMesh::FindConstraints(
  const std::vector<MeshBlock>& constraints) const
{
  const bool areOfAll = constraints.size() == 1 && constraints.front().Place.empty();
  if (!constraints.empty() && !areOfAll && this->Block.Place.empty())
  {
    throw InvalidOptions("the constraints of a single mesh cannot be a composite dataset");
  }
  std::vector<std::pair<vtkPolyData*, vtkPolyData*>> sources; // each with the mesh that it is for
  for (const MeshBlock& block : constraints)
  {
    for (const BlockLeaf& leaf : block.Leaves)
    {
      auto* edges = vtkPolyData::SafeDownCast(leaf.Data);
      if (edges && areOfAll && (!this->IsJoined || edges->GetNumberOfPoints() > 0))
      {
        return edges;
      }
      vtkPolyData* own = nullptr; // at the same place
      for (std::size_t i = 0; edges && i < this->Surfaces.size(); ++i)
      {
        if (areOfAll && this->Surfaces[i])
        {
          sources.emplace_back(edges, this->Surfaces[i]);
        }
        own = this->Block.Leaves[i].Number == leaf.Number ? this->Surfaces[i].Get() : own;
      }
      if (edges && !areOfAll && block.Place == this->Block.Place)
      {
        sources.emplace_back(edges, own);
      }
    }
  }
  if (!this->IsJoined && sources.size() == 1)
  {
    return sources.front().first;
  }
  return JoinConstraints(sources);
}

void BlockMesh::Store(vtkPolyData* flipped)
{
  MeshList results{ flipped };
  vtkCellData* data = flipped ? flipped->GetCellData() : nullptr;
  const vtkSmartPointer<vtkIntArray> owners =
    data ? vtkIntArray::SafeDownCast(data->GetAbstractArray(OwnerName)) : nullptr;
  if (this->IsJoined && owners)
  {
    data->RemoveArray(OwnerName);
    MeshList given = this->Surfaces;
    given.erase(std::remove(given.begin(), given.end(), nullptr), given.end());
    results = DividePartitions(flipped, owners, given, this->Joined.Points);
  }
  auto next = results.begin();
  for (std::size_t i = 0; i < this->Surfaces.size(); ++i)
  {
    BlockLeaf& leaf = this->Block.Leaves[i];
    if (flipped && this->Surfaces[i])
    {
      leaf.Result = next != results.end() ? *next++ : vtkSmartPointer<vtkPolyData>::New();
    }
    else
    {
      leaf.Result = vtkSmartPointer<vtkDataObject>::Take(leaf.Data->NewInstance());
      leaf.Result->ShallowCopy(leaf.Data);
    }
  }
}

}
