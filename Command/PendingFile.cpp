// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PendingFile.h"

#include "CommandError.h"
#include "FollowLinks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
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

/// Calls `make` with different names in the folder of `path`, as long as the name is in use.
/// Returns the name, or an empty string if `make` fails for another reason, which errno holds.
template <typename Function>
std::string MakeUnused(const fs::path& path, const Function& make)
{
  const std::string stem = ".delaunay-flip-" + std::to_string(getpid()) + "-";
  for (int number = 0;; ++number)
  {
    const fs::path name = path.parent_path() / (stem + std::to_string(number) + ExtensionOf(path));
    if (make(name.c_str()))
    {
      return name.string();
    }
    if (errno != EEXIST)
    {
      return {};
    }
  }
}

bool MakeEmpty(const char* name)
{
  const int file = open(name, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  return file >= 0 && close(file) == 0;
}

/// Copies the owner, group and mode of a file to another, as far as the system permits.
void CopyOwner(const std::string& from, const std::string& to)
{
  struct stat status = {};
  if (stat(from.c_str(), &status) != 0)
  {
    return;
  }
  const bool isOwned = chown(to.c_str(), status.st_uid, status.st_gid) == 0;
  if (!isOwned && chown(to.c_str(), static_cast<uid_t>(-1), status.st_gid) != 0)
  {
    errno = 0; // both stay the caller's
  }
  // Set-user-ID and similar bits were meant for the original owner.
  chmod(to.c_str(), status.st_mode & (isOwned ? 07777 : 0777));
}

}

PendingFile::PendingFile(const std::string& target)
  : Target(target)
{
  const fs::path resolved = FollowLinks(target);
  std::error_code error;
  const fs::file_status status = fs::status(resolved, error);
  if (error && status.type() != fs::file_type::not_found)
  {
    Fail(target, error.message());
  }
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    Fail(target, "it exists and is not a regular file");
  }
  if (fs::exists(status) && access(resolved.c_str(), W_OK) != 0)
  {
    Fail(target, std::strerror(errno));
  }
  this->Resolved = resolved.string();
  this->Temporary = MakeUnused(resolved, MakeEmpty);
  if (this->Temporary.empty())
  {
    Fail(target, std::strerror(errno));
  }
}

PendingFile::~PendingFile()
{
  for (const std::string& name : { this->Temporary, this->Backup })
  {
    if (!name.empty())
    {
      unlink(name.c_str());
    }
  }
}

void PendingFile::Commit()
{
  CopyOwner(this->Resolved, this->Temporary);
  // Some file systems allow no second name for the old file; then Undo cannot bring it back.
  this->Backup = MakeUnused(
    this->Resolved, [this](const char* name) { return link(this->Resolved.c_str(), name) == 0; });
  this->HadNone = this->Backup.empty() && errno == ENOENT;
  if (std::rename(this->Temporary.c_str(), this->Resolved.c_str()) != 0)
  {
    Fail(this->Target, std::strerror(errno));
  }
  this->Temporary.clear();
}

void PendingFile::Undo()
{
  if (this->HadNone)
  {
    unlink(this->Resolved.c_str());
  }
  else if (!this->Backup.empty())
  {
    std::rename(this->Backup.c_str(), this->Resolved.c_str());
    this->Backup.clear();
  }
}

}
