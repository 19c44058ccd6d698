// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MAPPERCOLORS_H
#define DELAUNAYFLIP_MAPPERCOLORS_H

#include "vtkColorTransferFunction.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

constexpr int Bands = 12; ///< How many colours there are.

/// Fills the table with twelve bands between a few colours: for flip counts up to the largest or,
/// if that is negative, for angles.
inline void FillTable(vtkLookupTable* table, double largestCount)
{
  // From nearly white to dark violet, or from red for slivers to blue for equilateral triangles.
  double countColors[] = { 0.96, 0.95, 0.98, 0.80, 0.81, 0.91, 0.62, 0.60, 0.80, 0.46, 0.32, 0.66,
    0.25, 0.0, 0.49 };
  double angleColors[] = { 0.70, 0.09, 0.17, 0.94, 0.54, 0.38, 0.99, 0.86, 0.78, 0.82, 0.90, 0.94,
    0.40, 0.66, 0.81, 0.13, 0.40, 0.67 };
  vtkNew<vtkColorTransferFunction> colors; // by the number of a band
  double largest = 60.0; // degrees
  if (largestCount < 0.0)
  {
    colors->BuildFunctionFromTable(0, Bands - 1, 6, angleColors);
  }
  else
  {
    colors->BuildFunctionFromTable(0, Bands - 1, 5, countColors);
    // It is rounded up to a multiple of four for whole labels at its quarters.
    largest = 4.0 * std::ceil(std::max(largestCount, 12.0) / 4.0);
  }
  table->SetNumberOfTableValues(Bands);
  for (int i = 0; i < Bands; ++i)
  {
    const double* rgb = colors->GetColor(i);
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetRange(0.0, largest);
}

}

#endif
