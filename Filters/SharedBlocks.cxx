// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedBlocks.h"

#include "CompositeBlocks.h"

#include "vtkCompositeDataSet.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace delaunayflip
{
namespace
{

bool HasCells(vtkDataObject* data)
{
  return data && data->GetNumberOfElements(vtkDataObject::CELL) > 0;
}

/// The places of leaves, by their flat indices, which VTK counts from the root in the same order.
class PlaceFinder
{
public:
  explicit PlaceFinder(vtkCompositeDataSet* blocks) { this->Visit(blocks, {}, false); }

  SharedBlock Find(unsigned int number) const
  {
    const auto found = this->Leaves.find(number);
    SharedBlock leaf = found == this->Leaves.end() ? SharedBlock() : found->second;
    if (leaf.Place.empty())
    {
      leaf.Place = { number }; // no tree
    }
    leaf.Number = number;
    return leaf;
  }

private:
  void Visit(vtkDataObject* node, const BlockPlace& place, bool isPartition)
  {
    SharedBlock& leaf = this->Leaves[this->Next++];
    leaf.Place = place;
    leaf.IsPartition = isPartition;
    if (auto* partitions = vtkPartitionedDataSet::SafeDownCast(node))
    {
      this->VisitPartitions(partitions, place);
    }
    else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(node))
    {
      this->VisitChildren(place, collection->GetNumberOfPartitionedDataSets(),
        [&](unsigned int i) { return collection->GetPartitionedDataSet(i); });
    }
    else if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(node))
    {
      this->VisitChildren(
        place, blocks->GetNumberOfBlocks(), [&](unsigned int i) { return blocks->GetBlock(i); });
    }
  }

  template <typename GetChild>
  void VisitChildren(const BlockPlace& parent, unsigned int count, const GetChild& getChild)
  {
    BlockPlace place = parent;
    place.push_back(0);
    for (unsigned int i = 0; i < count; ++i)
    {
      place.back() = i;
      this->Visit(getChild(i), place, false);
    }
  }

  void VisitPartitions(vtkPartitionedDataSet* partitions, const BlockPlace& parent)
  {
    BlockPlace place = parent;
    place.push_back(0);
    std::int64_t meshes = 0;
    for (unsigned int i = 0; i < partitions->GetNumberOfPartitions(); ++i)
    {
      vtkDataObject* data = partitions->GetPartitionAsDataObject(i);
      place.back() = HasCells(data) ? meshes++ : -1 - static_cast<std::int64_t>(i);
      this->Visit(data, place, true);
    }
  }

  unsigned int Next = 0;
  std::map<unsigned int, SharedBlock> Leaves;
};

std::vector<SharedBlock> ListOwnBlocks(vtkCompositeDataSet* blocks)
{
  const PlaceFinder places(blocks);
  std::vector<SharedBlock> list;
  for (const Block& block : ListBlocks(blocks))
  {
    SharedBlock own = places.Find(block.Number);
    own.Name = block.Name;
    own.Data = block.Data;
    own.HasCells = block.HasCells;
    own.MayBeMesh = block.MayBeMesh;
    own.Cells = static_cast<double>(block.Data->GetNumberOfElements(vtkDataObject::CELL));
    list.push_back(own);
  }
  return list;
}

Message Pack(const std::vector<SharedBlock>& blocks)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  for (const SharedBlock& block : blocks)
  {
    text << block.Cells << ' ' << block.IsPartition << ' ' << block.Place.size() << ' ';
    for (const std::int64_t number : block.Place)
    {
      text << number << ' ';
    }
    text << block.Name.size() << ' ' << block.Name;
  }
  const std::string all = text.str();
  return Message(all.begin(), all.end());
}

std::vector<SharedBlock> Unpack(const Message& message)
{
  std::istringstream text(std::string(message.begin(), message.end()));
  text.imbue(std::locale::classic());
  std::vector<SharedBlock> blocks;
  SharedBlock block;
  std::size_t size = 0;
  while (text >> block.Cells >> block.IsPartition >> size)
  {
    block.Place.resize(size);
    for (std::int64_t& number : block.Place)
    {
      text >> number;
    }
    text >> size;
    text.get();
    block.Name.resize(size);
    text.read(&block.Name[0], static_cast<std::streamsize>(size));
    blocks.push_back(block);
  }
  return blocks;
}

/// Joins leaves of several ranks at the same place.
std::vector<SharedBlock> Join(const std::vector<Message>& lists)
{
  std::map<BlockPlace, SharedBlock> joined;
  for (const Message& list : lists)
  {
    for (const SharedBlock& block : Unpack(list))
    {
      const auto known = joined.emplace(block.Place, block);
      known.first->second.Cells += known.second ? 0.0 : block.Cells;
    }
  }
  std::vector<SharedBlock> blocks;
  std::transform(joined.begin(), joined.end(), std::back_inserter(blocks),
    [](const auto& entry) { return entry.second; });
  return blocks;
}

/// Puts this rank's leaf at the same place into each of the shared ones.
void AddOwn(const std::vector<SharedBlock>& own, std::vector<SharedBlock>& blocks)
{
  for (SharedBlock& block : blocks)
  {
    const auto found = std::find_if(own.begin(), own.end(),
      [&block](const SharedBlock& one) { return one.Place == block.Place; });
    if (found != own.end())
    {
      block.Data = found->Data;
      block.Number = found->Number;
      block.HasCells = found->HasCells;
      block.MayBeMesh = found->MayBeMesh;
    }
  }
}

void AddShares(std::vector<SharedBlock>& blocks)
{
  double all = 0.0, before = 0.0;
  for (const SharedBlock& block : blocks)
  {
    all += block.Cells;
  }
  for (SharedBlock& block : blocks)
  {
    block.Before = before / std::max(1.0, all);
    block.Share = block.Cells / std::max(1.0, all);
    before += block.Cells;
  }
}

}

std::vector<SharedBlock> ListSharedBlocks(vtkCompositeDataSet* blocks, PieceGroup& group)
{
  std::vector<SharedBlock> own;
  DoTogether(group, [&]() { own = ListOwnBlocks(blocks); });
  std::vector<SharedBlock> shared = Join(group.Gather(Pack(own)));
  AddOwn(own, shared);
  AddShares(shared);
  return shared;
}

std::map<BlockPlace, vtkSmartPointer<vtkPolyData>> ListMeshesByPlace(vtkCompositeDataSet* blocks)
{
  std::map<BlockPlace, vtkSmartPointer<vtkPolyData>> meshes;
  for (const SharedBlock& block : ListOwnBlocks(blocks))
  {
    if (auto* mesh = vtkPolyData::SafeDownCast(block.Data))
    {
      meshes[block.Place] = mesh;
    }
  }
  return meshes;
}

bool HaveSharedPartitions(const std::vector<SharedBlock>& blocks)
{
  std::map<BlockPlace, int> counts;
  for (const SharedBlock& block : blocks)
  {
    if (block.IsPartition && block.Cells > 0.0)
    {
      ++counts[BlockPlace(block.Place.begin(), block.Place.end() - 1)];
    }
  }
  return std::any_of(
    counts.begin(), counts.end(), [](const auto& count) { return count.second > 1; });
}

}
