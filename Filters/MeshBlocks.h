// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshBlocks_h
#define MeshBlocks_h

#include "EngineExport.h"
#include "UpdateReport.h"

#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

/// A leaf of the input.
struct BlockLeaf
{
  vtkSmartPointer<vtkDataObject> Data; ///< Never null.
  unsigned int Number; ///< VTK's flat index.
  std::string Name; ///< In messages: "block 3 (wing)".
  vtkSmartPointer<vtkDataObject> Result; ///< The leaf of the output.
};

/// A block of the input: a leaf, the partitions of a dataset, or the whole input. It is one mesh or
/// no mesh.
struct MeshBlock
{
  /// Where it is in composite data: the numbers of children, from the root on. The partitions of a
  /// dataset that are not empty are at one place. Empty if the block is the whole input.
  std::vector<std::int64_t> Place;
  std::string Name; ///< In messages.
  double Size = 0.0; ///< How many cells, or points, it has.
  bool IsLive = false; ///< Flipped a few iterations at a time.
  std::vector<BlockLeaf> Leaves;
};

/// The blocks of an input, in the order of their first leaves.
/// @param elements what measures their sizes: vtkDataObject::CELL or POINT. A partition without any
/// is a block of its own.
DELAUNAYFLIP_EXPORT std::vector<MeshBlock> ListMeshBlocks(vtkDataObject* input, int elements);

/// Does so for another input than the first one. There is at least one block.
std::vector<MeshBlock> ListOtherBlocks(vtkDataObject* input, int elements);

/// Lists what is ignored of another input than the first one.
/// @param name what messages call it.
DELAUNAYFLIP_EXPORT std::vector<Note> ListMisfits(const std::vector<MeshBlock>& blocks,
  const std::vector<MeshBlock>& others, const std::string& name = "second input");

/// Lists the leaves of another input that are for a block. A single dataset has one leaf, number 0,
/// which is for all blocks. Leaves of composite data are for the block at the same place.
/// @param what begins the message if they cannot be composite. @param type other leaves are
/// ignored.
/// @throws InvalidOptions.
std::vector<BlockLeaf> ListOthers(const MeshBlock& block, const std::vector<MeshBlock>& others,
  const std::string& what, const char* type = "vtkPolyData");

/// Makes a shallow copy; null for null. Observers cannot take its leaves and arrays away.
vtkSmartPointer<vtkDataObject> Hold(vtkDataObject* data);

/// Gives `output`, which is of the same type, the structure of `input` and the results of the
/// blocks' leaves.
void StoreResults(
  const std::vector<MeshBlock>& blocks, vtkDataObject* input, vtkDataObject* output);

//------------------------------------------------------------------------------
using MeshList = std::vector<vtkSmartPointer<vtkPolyData>>;

/// The partitions of a dataset as one mesh.
struct JoinedMesh
{
  vtkSmartPointer<vtkPolyData> Mesh;
  std::vector<vtkSmartPointer<vtkIdList>> Points; ///< For each partition, its points in the mesh.
  vtkSmartPointer<vtkIntArray> Owners; ///< Its partition for each cell, by which it is divided.

  /// The number of points that coincide with another point of their partition and with a point of
  /// another partition. It is not known which of the two is meant.
  vtkIdType Ambiguous = 0;
};

/// The values of vtkGlobalPointIds, one per point; empty if the mesh has none.
DELAUNAYFLIP_EXPORT std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh);

/// The mesh of a block: its leaf or, if a dataset is in several partitions, all of them as one.
class DELAUNAYFLIP_EXPORT BlockMesh
{
public:
  /// @param block must live as long as this object. @param regions the name of a cell array that
  /// all partitions must have, or empty. @param dropsDuplicates whether duplicate ghost cells are
  /// dropped also from a single leaf, and partitions stay joined.
  /// @throws InvalidMesh, InvalidOptions.
  BlockMesh(MeshBlock& block, const std::string& regions, bool dropsDuplicates = false);
  BlockMesh(const BlockMesh&) = delete;
  BlockMesh& operator=(const BlockMesh&) = delete;

  /// Lists the warnings about the block.
  /// @param ofArrays adds malformed arrays of a single leaf. Otherwise the report of its flips has
  /// them.
  std::vector<Note> ListNotes(bool ofArrays = false) const;

  /// Null if the block is no mesh.
  vtkPolyData* GetMesh() const { return this->Joined.Mesh; }

  /// All of the second input, or its leaves at the same place; null if there are none.
  /// @param constraints the blocks of the second input.
  /// @throws InvalidOptions, InvalidMesh.
  vtkSmartPointer<vtkPolyData> FindConstraints(const std::vector<MeshBlock>& constraints) const;

  /// Writes the results of the block's leaves. Partitions that were joined are divided again; if
  /// the owners of their cells have no name, the mesh takes the place of the first one, and the
  /// others are empty. Leaves that are no surfaces pass.
  /// @param flipped the mesh after the run; or null: all leaves of the input pass unchanged.
  void Store(vtkPolyData* flipped);

private:
  bool IsJoined() const { return this->Meshes.size() > 1; }

  MeshBlock& Block;
  MeshList Surfaces; ///< One per leaf; null for a leaf that is no surface.
  MeshList Meshes; ///< The surfaces without the nulls.
  JoinedMesh Joined; ///< The only mesh, or all of them joined.
};

}

#endif
