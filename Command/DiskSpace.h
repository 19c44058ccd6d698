// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DISKSPACE_H
#define DELAUNAYFLIP_DISKSPACE_H

#include <string>

namespace delaunayflip
{

/// The end of a message, which explains why a file may be incomplete: a full disk or a limit on the
/// size of files. Empty if neither is the cause.
std::string ExplainFailedWrite(const std::string& path);

}

#endif
