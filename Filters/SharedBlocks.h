// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SharedBlocks_h
#define SharedBlocks_h

#include "PieceGroup.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkCompositeDataSet;
class vtkDataObject;

namespace delaunayflip
{

/// Where a block of a composite dataset is: the numbers of children, from the root on. The
/// partitions of a dataset that have cells are one block, whatever their numbers.
using BlockPlace = std::vector<std::int64_t>;

/// A leaf of this process's composite dataset.
struct BlockLeaf
{
  vtkSmartPointer<vtkDataObject> Data; ///< Never null.
  unsigned int Number; ///< VTK's flat index.
  bool HasCells = false;
  bool MayBeMesh = false; ///< Whether the dataset can hold a mesh in its place.
  std::string Name = {}; ///< Its name in messages: "block 3 (wing)".
};

/// A block that is one mesh, or none: a leaf, or the partitions of a dataset. Other ranks may have
/// a piece of it, too.
struct SharedBlock
{
  BlockPlace Place;
  std::string Name; ///< Its name in messages, from the first rank that has it.
  double Cells = 0.0; ///< On all ranks.
  double Before = 0.0; ///< The share of all cells in the blocks before it, 0 to 1.
  double Share = 0.0; ///< The share of all cells in it, 0 to 1.
  std::vector<BlockLeaf> Leaves; ///< Of this rank.
};

/// The blocks that any rank of the group has, in the same order on all ranks. All ranks must call
/// this together.
std::vector<SharedBlock> ListSharedBlocks(vtkCompositeDataSet* blocks, PieceGroup& group);

/// The polygonal leaves of this process.
std::map<BlockPlace, std::vector<BlockLeaf>> ListMeshesByPlace(vtkCompositeDataSet* blocks);

}

#endif
