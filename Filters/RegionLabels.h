// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RegionLabels_h
#define RegionLabels_h

#include "FlipReport.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// One label per cell. Cells with equal tuples in the cell array `name` (numbers or strings, any
/// number of components) get the same label. Labels count from 0 in the order of appearance.
/// @throws InvalidOptions when there is no such array, or when it does not have one tuple per cell.
/// @throws RunAborted.
std::vector<std::int32_t> LabelRegions(
  vtkPolyData* mesh, const std::string& name, const ProgressObserver& observer);

}

#endif
