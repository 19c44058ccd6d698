// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CompositeBlocks_h
#define CompositeBlocks_h

#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <string>

class vtkCompositeDataSet;
class vtkDataObject;
class vtkPolyData;

namespace delaunayflip
{

/// A leaf of a composite dataset.
struct Block
{
  vtkDataObject* Data; ///< Never null.
  unsigned int Number; ///< VTK's flat index.
  std::string Name; ///< How notes call it: "block 3 (wing)".
  bool HasCells;
  double Before; ///< The share of the whole dataset's cells that lies before it, 0 to 1,
  double Share; ///< and its own.
};

/// Makes `output` a composite dataset with the structure of `input`, and with what `transform`
/// makes of each leaf. Empty leaves stay empty.
void TransformBlocks(vtkCompositeDataSet* input, vtkCompositeDataSet* output,
  const std::function<vtkSmartPointer<vtkDataObject>(const Block& block)>& transform);

/// The polygonal leaves by their numbers.
std::map<unsigned int, vtkPolyData*> ListMeshes(vtkCompositeDataSet* blocks);

/// Whether some dataset of `blocks` is divided into partitions, as different from blocks that are
/// meshes of their own.
bool HasPartitions(vtkCompositeDataSet* blocks);

}

#endif
