// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DISKSPACE_H
#define DELAUNAYFLIP_DISKSPACE_H

#include <string>

namespace delaunayflip
{

/// Why a file may not have been written completely, as the end of a message: a full disk or a file
/// size limit; empty if there is neither.
std::string ExplainFailedWrite(const std::string& path);

}

#endif
