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
class vtkPolyData;

namespace delaunayflip
{

/// Where a leaf of a composite dataset is: the numbers of children, from the root on. Partitions
/// without cells are not counted, so that the first partition that a rank has is at the same place
/// as the first one of any other rank.
using BlockPlace = std::vector<std::int64_t>;

/// A leaf of a composite dataset that some ranks have a piece of.
struct SharedBlock
{
  BlockPlace Place;
  std::string Name; ///< Its name in messages, from the first rank that has it.
  double Cells = 0.0; ///< On all ranks.
  bool IsPartition = false; ///< Whether leaves with the same parent belong to the same mesh.
  double Before = 0.0; ///< The share of all cells in the leaves before it, 0 to 1.
  double Share = 0.0; ///< The share of all cells in it, 0 to 1.

  vtkSmartPointer<vtkDataObject> Data; ///< This rank's; null if it has none.
  unsigned int Number = 0; ///< VTK's flat index of Data; 0 if there is none.
  bool HasCells = false; ///< Whether Data has.
  bool MayBeMesh = false; ///< Whether this rank's dataset can hold a mesh in its place.
};

/// The leaves that any rank of the group has, in the same order on all ranks. All ranks must call
/// this together.
std::vector<SharedBlock> ListSharedBlocks(vtkCompositeDataSet* blocks, PieceGroup& group);

/// The polygonal leaves of this rank.
std::map<BlockPlace, vtkSmartPointer<vtkPolyData>> ListMeshesByPlace(vtkCompositeDataSet* blocks);

/// Whether several leaves with cells are partitions of one mesh.
bool HaveSharedPartitions(const std::vector<SharedBlock>& blocks);

}

#endif
