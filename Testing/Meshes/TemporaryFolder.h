// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TEMPORARYFOLDER_H
#define DELAUNAYFLIP_TEMPORARYFOLDER_H

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>

namespace delaunayflip
{

/// An empty folder of its own, so that tests may run at the same time. It is removed with all
/// files.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    if (!mkdtemp(this->Path.data()))
    {
      throw std::runtime_error("no folder for temporary files in " + testing::TempDir());
    }
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const char* name) const { return this->Path + "/" + name; }
  long CountFiles() const
  {
    return std::distance(std::filesystem::directory_iterator(this->Path), {});
  }

private:
  std::string Path = testing::TempDir() + "delaunayflip-XXXXXX";
};

}

#endif
