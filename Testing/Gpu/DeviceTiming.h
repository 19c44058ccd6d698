// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICETIMING_H
#define DELAUNAYFLIP_DEVICETIMING_H

#include "BenchmarkRow.h"

#include <cstdint>

namespace delaunayflip
{

/// Times the engine on a mesh in device memory, with a result in device memory.
/// @param components of the points: 2 or 3.
template <typename Id>
BenchmarkRow TimeOnDevice(const BenchmarkMesh& mesh, int components, const RepetitionPlan& plan);

extern template BenchmarkRow TimeOnDevice<std::int32_t>(
  const BenchmarkMesh&, int, const RepetitionPlan&);
extern template BenchmarkRow TimeOnDevice<std::int64_t>(
  const BenchmarkMesh&, int, const RepetitionPlan&);

}

#endif
