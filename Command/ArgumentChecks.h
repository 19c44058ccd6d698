// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ARGUMENT_CHECKS_H
#define DELAUNAYFLIP_ARGUMENT_CHECKS_H

#include "Arguments.h"

namespace delaunayflip
{

/// Checks what involves files or several options, and finds the format of the output.
/// @throws CommandError
void CheckArguments(Arguments& arguments);

}

#endif
