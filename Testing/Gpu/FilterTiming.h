// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILTERTIMING_H
#define DELAUNAYFLIP_FILTERTIMING_H

#include "BenchmarkRow.h"

namespace delaunayflip
{

/// Times vtkDelaunayFlip::Update() with the CUDA backend, from a vtkPolyData in the host's memory
/// to another one, whose memory is new each time.
BenchmarkRow TimeFilter(const BenchmarkMesh& mesh, const RepetitionPlan& plan);

}

#endif
