// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FOLLOWLINKS_H
#define DELAUNAYFLIP_FOLLOWLINKS_H

#include <filesystem>
#include <string>

namespace delaunayflip
{

/// The absolute path of the file that `path` means, symbolic links followed, also those to files
/// that do not exist yet. A link where links form a loop.
std::filesystem::path FollowLinks(const std::string& path);

}

#endif
