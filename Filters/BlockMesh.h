// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BlockMesh_h
#define BlockMesh_h

#include "JoinedPartitions.h"
#include "Notes.h"
#include "SharedBlocks.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace delaunayflip
{

/// The second input of composite data.
struct BlockConstraints
{
  vtkPolyData* OfAll = nullptr; ///< The same for all blocks; or null.
  bool AreBlocks = false; ///< Whether each block has its own.
  std::map<BlockPlace, std::vector<BlockLeaf>> Blocks;
};

using BlockLeaves = std::map<unsigned int, vtkSmartPointer<vtkDataObject>>; ///< By flat index.

/// The mesh of a block: its leaf or, if a dataset is in several partitions, all of them as one.
class BlockMesh
{
public:
  /// What turns a leaf into a mesh; null if it is not a surface.
  using Reader = std::function<vtkSmartPointer<vtkPolyData>(vtkDataObject*)>;

  /// @param block must live as long as this object.
  explicit BlockMesh(const SharedBlock& block)
    : Block(block)
  {
  }

  /// Reads the leaves that this process has.
  /// @param regions as in JoinedPartitions. @throws what `read` and JoinedPartitions throw.
  void Read(const Reader& read, const std::string& regions, int rank);

  bool HasPartitions() const { return this->Joined != nullptr; } ///< Several.
  bool HasMesh() const { return !this->Meshes.empty(); }
  bool HasOtherCells() const; ///< Whether a leaf has cells and is not a surface.
  bool HasAmbiguousPoints() const;

  /// Warnings of the leaves with malformed arrays.
  std::vector<Note> ListMalformedArrays() const;

  /// Empty if the process has none.
  vtkSmartPointer<vtkPolyData> GetMesh() const;

  /// @returns null if there are none.
  vtkSmartPointer<vtkPolyData> FindConstraints(const BlockConstraints& constraints) const;

  /// Adds the leaves of the output.
  /// @param flipped the mesh after the run; or null: the leaves of the input pass unchanged.
  void Store(vtkPolyData* flipped, BlockLeaves& leaves) const;

  /// Adds empty leaves, after a failure.
  void StoreNothing(BlockLeaves& leaves) const;

private:
  const SharedBlock& Block;
  std::vector<vtkSmartPointer<vtkPolyData>> Meshes; ///< The surfaces.
  std::vector<unsigned int> Numbers; ///< Of their leaves.
  std::vector<std::string> Names; ///< Of their leaves, in messages.
  std::unique_ptr<JoinedPartitions> Joined; ///< If there are several.
};

}

#endif
