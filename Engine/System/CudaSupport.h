// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDASUPPORT_H
#define DELAUNAYFLIP_CUDASUPPORT_H

/// @file
/// Whether published builds for this platform can have the CUDA backend.

namespace delaunayflip
{

/// @returns why they cannot, in parentheses and after a space; "" if they can. It also follows the
/// name of the backend in reports.
const char* ExplainNoCuda();

}

#endif
