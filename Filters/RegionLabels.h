// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RegionLabels_h
#define RegionLabels_h

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// One label per cell: cells with equal tuples in the cell array `name` (numbers or strings, any
/// number of components) have equal labels, numbered from 0 in the order of appearance.
/// @throws InvalidOptions when there is no such array, or the number of its tuples is not that of
/// the cells.
std::vector<std::int32_t> LabelRegions(vtkPolyData* mesh, const std::string& name);

}

#endif
