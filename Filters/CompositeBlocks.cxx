// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CompositeBlocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkSmartPointer.h"
#include "vtkUniformGridAMR.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

/// Null if not all leaves may be meshes: those of AMR, which is a tree from VTK 9.6 on, are grids.
vtkDataObjectTree* GetTree(vtkCompositeDataSet* blocks)
{
  return vtkUniformGridAMR::SafeDownCast(blocks) ? nullptr
                                                 : vtkDataObjectTree::SafeDownCast(blocks);
}

vtkSmartPointer<vtkCompositeDataIterator> Traverse(vtkCompositeDataSet* blocks)
{
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  leaf->InitTraversal();
  return leaf;
}

std::string GetName(vtkCompositeDataIterator* leaf)
{
  const std::string number = "block " + std::to_string(leaf->GetCurrentFlatIndex());
  vtkInformation* about = leaf->HasCurrentMetaData() ? leaf->GetCurrentMetaData() : nullptr;
  const char* name = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name && *name ? number + " (" + name + ")" : number;
}

double CountCells(vtkDataObject* data)
{
  return data ? static_cast<double>(data->GetNumberOfElements(vtkDataObject::CELL)) : 0.0;
}

double CountCells(vtkCompositeDataSet* blocks)
{
  double cells = 0.0;
  for (auto leaf = Traverse(blocks); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    cells += CountCells(leaf->GetCurrentDataObject());
  }
  return cells;
}

}

std::vector<Block> ListBlocks(vtkCompositeDataSet* blocks)
{
  const bool holdsMeshes = GetTree(blocks) != nullptr;
  const double all = std::max(1.0, CountCells(blocks));
  double before = 0.0;
  std::vector<Block> list;
  for (auto leaf = Traverse(blocks); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* data = leaf->GetCurrentDataObject();
    const double own = CountCells(data);
    list.push_back({ data, leaf->GetCurrentFlatIndex(), GetName(leaf), own > 0.0, holdsMeshes,
      before / all, own / all });
    before += own;
  }
  return list;
}

vtkSmartPointer<vtkDataObject> CopyBlock(vtkDataObject* data)
{
  auto passed = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  passed->ShallowCopy(data);
  return passed;
}

void TransformBlocks(vtkCompositeDataSet* input, vtkCompositeDataSet* output,
  const std::function<vtkSmartPointer<vtkDataObject>(const Block& block)>& transform)
{
  output->CopyStructure(input);
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  const auto blocks = vtkSmartPointer<vtkCompositeDataSet>::Take(input->NewInstance());
  blocks->ShallowCopy(input);
  const auto leaf = Traverse(blocks);
  for (const Block& block : ListBlocks(blocks))
  {
    output->SetDataSet(leaf, transform(block));
    leaf->GoToNextItem();
  }
}

}
