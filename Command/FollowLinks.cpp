// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FollowLinks.h"

namespace delaunayflip
{

std::filesystem::path FollowLinks(const std::string& path)
{
  namespace fs = std::filesystem;
  constexpr int most = 40; // the limit of Linux
  std::error_code error;
  fs::path file = fs::absolute(path, error);
  for (int links = 0; links < most && fs::is_symlink(fs::symlink_status(file, error)); ++links)
  {
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  const fs::path resolved = fs::weakly_canonical(file, error);
  return error ? file : resolved;
}

}
