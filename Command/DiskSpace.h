// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DISKSPACE_H
#define DELAUNAYFLIP_DISKSPACE_H

#include <string>

namespace delaunayflip
{

/// What may have kept a file from being written whole, as the end of a message: a full disk or a
/// limit on the size of files; empty where there is neither.
std::string ExplainFailedWrite(const std::string& path);

}

#endif
