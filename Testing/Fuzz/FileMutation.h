// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILEMUTATION_H
#define DELAUNAYFLIP_FILEMUTATION_H

#include "ByteSource.h"

#include <string>

namespace delaunayflip
{

/// A file with a few faults: bits, bytes, numbers, lines, a cut, or a piece of `other`.
std::string MutateFile(std::string bytes, const std::string& other, ByteSource& source);

}

#endif
