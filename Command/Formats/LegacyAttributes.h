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
/// of a kind becomes the active one, the others are arrays among others.
class LegacyAttributes
{
public:
  explicit LegacyAttributes(LegacyArrays& arrays)
    : Arrays(arrays)
  {
  }

  /// What is read from here on belongs to `data`.
  void Begin(vtkDataSetAttributes* data, vtkIdType tuples)
  {
    this->Data = data;
    this->Tuples = tuples;
  }

  /// What the attributes belong to; null before the first Begin.
  vtkDataSetAttributes* Get() const { return this->Data; }

  /// Reads what follows a keyword; false if it is none of an attribute, or none can be here.
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
  std::string TableName; ///< What the active scalars call their colors.
};

}

#endif
