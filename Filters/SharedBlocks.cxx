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
  explicit PlaceFinder(vtkCompositeDataSet* blocks) { this->Visit(blocks, {}); }

  BlockPlace Find(unsigned int number) const
  {
    const bool isInTree = number < this->Places.size() && !this->Places[number].empty();
    return isInTree ? this->Places[number] : BlockPlace{ number };
  }

private:
  void Visit(vtkDataObject* node, const BlockPlace& place)
  {
    this->Places.push_back(place);
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
      this->Visit(getChild(i), place);
    }
  }

  void VisitPartitions(vtkPartitionedDataSet* partitions, const BlockPlace& parent)
  {
    BlockPlace place = parent;
    place.push_back(0);
    for (unsigned int i = 0; i < partitions->GetNumberOfPartitions(); ++i)
    {
      vtkDataObject* data = partitions->GetPartitionAsDataObject(i);
      place.back() = HasCells(data) ? 0 : -1 - static_cast<std::int64_t>(i);
      this->Visit(data, place);
    }
  }

  std::vector<BlockPlace> Places;
};

/// This rank's blocks, by their first leaves.
std::vector<SharedBlock> ListOwnBlocks(vtkCompositeDataSet* blocks)
{
  const PlaceFinder places(blocks);
  std::vector<SharedBlock> list;
  std::map<BlockPlace, std::size_t> known;
  for (const Block& leaf : ListBlocks(blocks))
  {
    const BlockPlace place = places.Find(leaf.Number);
    const auto [found, isNew] = known.emplace(place, list.size());
    if (isNew)
    {
      list.emplace_back();
      list.back().Place = place;
      list.back().Name = leaf.Name;
    }
    SharedBlock& block = list[found->second];
    block.Leaves.push_back({ leaf.Data, leaf.Number, leaf.HasCells, leaf.MayBeMesh, leaf.Name });
    block.Cells += static_cast<double>(leaf.Data->GetNumberOfElements(vtkDataObject::CELL));
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
    text << block.Cells << ' ' << block.Place.size() << ' ';
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
  while (text >> block.Cells >> size)
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

/// Joins blocks of several ranks at the same place.
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

/// Puts this rank's leaves at the same place into each of the shared blocks.
void AddOwn(const std::vector<SharedBlock>& own, std::vector<SharedBlock>& blocks)
{
  for (SharedBlock& block : blocks)
  {
    const auto found = std::find_if(own.begin(), own.end(),
      [&block](const SharedBlock& one) { return one.Place == block.Place; });
    if (found != own.end())
    {
      block.Leaves = found->Leaves;
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

std::map<BlockPlace, std::vector<BlockLeaf>> ListMeshesByPlace(vtkCompositeDataSet* blocks)
{
  std::map<BlockPlace, std::vector<BlockLeaf>> meshes;
  for (const SharedBlock& block : ListOwnBlocks(blocks))
  {
    for (const BlockLeaf& leaf : block.Leaves)
    {
      if (vtkPolyData::SafeDownCast(leaf.Data))
      {
        meshes[block.Place].push_back(leaf);
      }
    }
  }
  return meshes;
}

}
