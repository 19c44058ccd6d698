// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FOLLOWLINKS_H
#define DELAUNAYFLIP_FOLLOWLINKS_H

#include <filesystem>
#include <string>

namespace delaunayflip
{

/// The absolute path of the file that `path` refers to, with symbolic links resolved, including
/// links to files that do not exist yet. If links form a loop, the path of one of these links.
std::filesystem::path FollowLinks(const std::string& path);

}

#endif
