// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CELLLABELS_H
#define DELAUNAYFLIP_CELLLABELS_H

#include "MeshFiles.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

class vtkDataArray;
class vtkStringArray;

/// @file
/// Texts that label cells, such as the materials of an .obj. In a mesh they are an integer array of
/// the cells, such as Material, and a string array in the field data, MaterialNames, where each
/// integer is the place of its text.

namespace delaunayflip
{

/// Collects the labels of one kind while a file is read.
class CellLabels
{
public:
  /// @param array the name of the array of integers.
  explicit CellLabels(const char* array);

  /// Labels the cells that follow. Equal texts are one label.
  void Set(const std::string& text);

  /// Labels the cells that follow with a text of their own, which others may have too.
  void SetNew(const std::string& text);

  /// Adds a cell, which is labelled with an empty text if none was set.
  /// @param kind 0, 1 or 2 for verts, lines and polygons.
  void AddCell(std::size_t kind);

  /// Gives the labels to the mesh that has the cells, if any label was set.
  void Store(FileMesh& file) const;

private:
  std::string Array;
  std::vector<std::string> Texts;
  std::map<std::string, int> Numbers; ///< The places of the texts.
  int Current = -1; ///< None was set yet.
  std::array<std::vector<int>, 3> OfCells;
};

/// The labels of one kind that a mesh has; null if it has none, or some have no text.
struct StoredLabels
{
  StoredLabels(vtkPolyData* mesh, const std::string& array);

  vtkDataArray* Numbers = nullptr;
  vtkStringArray* Texts = nullptr;
};

}

#endif
