// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LEGACYATTRIBUTES_H
#define DELAUNAYFLIP_LEGACYATTRIBUTES_H

#include "LegacyArrays.h"

#include <vtkDataSetAttributes.h>

#include <string>

namespace delaunayflip
{

/// Reads the attributes of points and cells in a legacy .vtk: SCALARS, VECTORS and so on. The first
/// of a kind becomes the active one, the others become ordinary arrays.
class LegacyAttributes
{
public:
  explicit LegacyAttributes(LegacyArrays& arrays)
    : Arrays(arrays)
  {
  }

  /// Attributes read after this call belong to `data`.
  void Begin(vtkDataSetAttributes* data, vtkIdType tuples)
  {
    this->Data = data;
    this->Tuples = tuples;
  }

  /// The data to which attributes belong; null before the first Begin.
  vtkDataSetAttributes* Get() const { return this->Data; }

  /// Reads what follows a keyword. Returns false if it is not the keyword of an attribute, or if
  /// there can be no attribute here.
  bool Read(const std::string& keyword);

private:
  void ReadScalars();
  void ReadColors();
  void ReadLookupTable();
  void ReadTexture();
  template <int Attribute, int Components>
  void ReadArray();
  bool Add(vtkAbstractArray* array, const std::string& name, int attribute);

  LegacyArrays& Arrays;
  vtkDataSetAttributes* Data = nullptr;
  vtkIdType Tuples = 0;
  std::string TableName; ///< The name of the active scalars' colour table.
};

}

#endif
