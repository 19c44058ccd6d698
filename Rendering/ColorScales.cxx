// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ColorScales.h"

#include "vtkColorTransferFunction.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace delaunayflip
{

namespace
{

using Color = std::array<double, 3>;

/// Fills the table, for 0 to `largest`, with bands of colours interpolated between `stops`.
void FillColors(vtkLookupTable* table, const std::vector<Color>& stops, int bands, double largest)
{
  vtkNew<vtkColorTransferFunction> function;
  for (std::size_t i = 0; i < stops.size(); ++i)
  {
    const double x = static_cast<double>(i) / static_cast<double>(stops.size() - 1);
    function->AddRGBPoint(x, stops[i][0], stops[i][1], stops[i][2]);
  }
  table->SetNumberOfTableValues(bands);
  for (int i = 0; i < bands; ++i)
  {
    const double* rgb = function->GetColor(static_cast<double>(i) / (bands - 1));
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetRange(0.0, largest);
}

}

void FillAngleColors(vtkLookupTable* table)
{
  FillColors(table,
    { { 0.70, 0.09, 0.17 }, { 0.94, 0.54, 0.38 }, { 0.99, 0.86, 0.78 }, { 0.82, 0.90, 0.94 },
      { 0.40, 0.66, 0.81 }, { 0.13, 0.40, 0.67 } },
    12, 60.0);
}

void FillCountColors(vtkLookupTable* table, double largest)
{
  FillColors(table,
    { { 0.96, 0.95, 0.98 }, { 0.80, 0.81, 0.91 }, { 0.62, 0.60, 0.80 }, { 0.46, 0.32, 0.66 },
      { 0.25, 0.0, 0.49 } },
    12, 4.0 * std::ceil(std::max(largest, 12.0) / 4.0));
}

ColorBands GetBands(vtkLookupTable* table)
{
  ColorBands bands;
  const vtkIdType count = table->GetNumberOfTableValues();
  bands.Colors.resize(static_cast<std::size_t>(count));
  std::memcpy(bands.Colors.data(), table->GetPointer(0), 4 * bands.Colors.size());
  bands.First = table->GetRange()[0];
  bands.Last = table->GetRange()[1];
  const unsigned char* ofNaN = table->GetNanColorAsUnsignedChars();
  std::memcpy(&bands.OfNaN, ofNaN, sizeof(bands.OfNaN));
  return bands;
}

ColorBands MakePlainBands()
{
  ColorBands bands;
  bands.Colors.resize(1);
  std::memcpy(bands.Colors.data(), PlainBytes.data(), PlainBytes.size());
  bands.OfNaN = bands.Colors[0];
  return bands;
}

}
