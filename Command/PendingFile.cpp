// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PendingFile.h"

#include "CommandError.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace delaunayflip
{

namespace
{

namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& target, const std::string& reason)
{
  throw CommandError(ExitCode::BadFile, target + ": cannot be written: " + reason);
}

/// The extension in lower case: vtkPLYWriter appends ".ply" to any name that lacks it.
std::string ExtensionOf(const fs::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

/// Creates an empty file with an unused name in the folder of `path`.
std::string MakeTemporary(const fs::path& path, const std::string& target)
{
  const std::string stem = ".delaunay-flip-" + std::to_string(getpid()) + "-";
  for (int number = 0;; ++number)
  {
    const fs::path name = path.parent_path() / (stem + std::to_string(number) + ExtensionOf(path));
    const int file = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0)
    {
      close(file);
      return name.string();
    }
    if (errno != EEXIST)
    {
      Fail(target, std::strerror(errno));
    }
  }
}

}

PendingFile::PendingFile(const std::string& target)
  : Target(target)
{
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(target), error);
  if (error)
  {
    Fail(target, error.message());
  }
  if (fs::exists(resolved) && !fs::is_regular_file(resolved))
  {
    Fail(target, "it exists and is not a regular file");
  }
  if (fs::exists(resolved) && access(resolved.c_str(), W_OK) != 0)
  {
    Fail(target, std::strerror(errno));
  }
  this->Resolved = resolved.string();
  this->Temporary = MakeTemporary(resolved, target);
}

PendingFile::~PendingFile()
{
  if (!this->Temporary.empty())
  {
    unlink(this->Temporary.c_str());
  }
}

void PendingFile::Commit()
{
  std::error_code error;
  const fs::file_status existing = fs::status(this->Resolved, error);
  if (fs::exists(existing))
  {
    fs::permissions(this->Temporary, existing.permissions(), error);
  }
  fs::rename(this->Temporary, this->Resolved, error);
  if (error)
  {
    Fail(this->Target, error.message());
  }
  this->Temporary.clear();
}

}
