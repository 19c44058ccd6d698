// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DiskSpace.h"

#include "Counted.h"

#include <sys/resource.h>

#include <cstdint>
#include <filesystem>

namespace delaunayflip
{

std::string ExplainFailedWrite(const std::string& path)
{
  constexpr std::uintmax_t least = 1 << 20; // file systems keep some space back, or round sizes
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (!error && space.available < least)
  {
    return "; the disk is full";
  }
  rlimit limit = {};
  const std::uintmax_t size = std::filesystem::file_size(path, error); // VTK may have removed it
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
    (error || size >= limit.rlim_cur))
  {
    return "; the size of files is limited to " +
      Counted(static_cast<std::int64_t>(limit.rlim_cur), "byte") + " here";
  }
  return {};
}

}
