// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MACHINE_H
#define DELAUNAYFLIP_MACHINE_H

#include <string>

namespace delaunayflip
{

/// Describes CPU, cores, compiler and build type in one line.
std::string DescribeMachine();

}

#endif
