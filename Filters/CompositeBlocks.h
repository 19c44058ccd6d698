// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CompositeBlocks_h
#define CompositeBlocks_h

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkCompositeDataSet;
class vtkDataObject;

namespace delaunayflip
{

/// A leaf of a composite dataset.
struct Block
{
  vtkDataObject* Data; ///< Never null.
  unsigned int Number; ///< VTK's flat index.
  std::string Name; ///< Its name in messages: "block 3 (wing)".
  bool HasCells;
  bool MayBeMesh; ///< Whether the dataset can hold a mesh in its place. AMR cannot.
  double Before; ///< The share of the dataset's cells in the leaves before it, 0 to 1.
  double Share; ///< The share of the dataset's cells in it, 0 to 1.
};

/// The leaves that are not null, in VTK's order.
std::vector<Block> ListBlocks(vtkCompositeDataSet* blocks);

/// A shallow copy: of a leaf that passes unchanged, with the warning NotASurface if it has cells.
vtkSmartPointer<vtkDataObject> CopyBlock(vtkDataObject* data);
constexpr const char* NotASurface = "not a surface, passed unchanged";

/// Gives `output` the structure of `input`, and for each leaf the result of `transform`. Empty
/// leaves stay empty. `transform` may change `input`.
void TransformBlocks(vtkCompositeDataSet* input, vtkCompositeDataSet* output,
  const std::function<vtkSmartPointer<vtkDataObject>(const Block& block)>& transform);

}

#endif
