// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GPUDESCRIPTION_H
#define DELAUNAYFLIP_GPUDESCRIPTION_H

#include <string>

namespace delaunayflip
{

/// The current GPU and the versions of CUDA as a JSON object; "null" without a GPU.
std::string DescribeGpuInJson();

}

#endif
