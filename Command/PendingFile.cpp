// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PendingFile.h"

#include "CommandError.h"
#include "DiskSpace.h"
#include "FollowLinks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
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

/// The number of the open file of this process that a path such as /dev/stdout or /dev/fd/3 leads
/// to; -1 if it leads elsewhere.
int FindOpenFile(const std::string& target)
{
  std::error_code error;
  fs::path file = fs::absolute(target, error);
  constexpr int most = 40; // the limit of Linux for links
  for (int links = 0; links < most; ++links)
  {
    const std::string folder = fs::weakly_canonical(file.parent_path(), error).string();
    const std::string name = file.filename().string();
    const bool isNumber = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
    if (isNumber && (folder == "/dev/fd" || folder == "/proc/" + std::to_string(getpid()) + "/fd"))
    {
      return std::atoi(name.c_str());
    }
    if (!fs::is_symlink(fs::symlink_status(file, error)))
    {
      break;
    }
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  return -1;
}

}

PendingFile::PendingFile(const std::string& target, bool mayBeStream)
  : Target(target),
    OpenFile(FindOpenFile(target))
{
  const fs::path resolved = FollowLinks(target);
  std::error_code error;
  const fs::file_status status = fs::status(resolved, error);
  if (error && status.type() != fs::file_type::not_found)
  {
    Fail(target, error.message());
  }
  const bool isStream = this->OpenFile >= 0 || (fs::exists(status) && !fs::is_regular_file(status));
  if (isStream && (!mayBeStream || fs::is_directory(status)))
  {
    Fail(target, "it exists and is not a regular file");
  }
  if (fs::exists(status) && access(resolved.c_str(), W_OK) != 0)
  {
    Fail(target, std::strerror(errno));
  }
  if (isStream)
  {
    return;
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

void PendingFile::Write(const std::string& text) const
{
  const std::string& path = this->Temporary.empty() ? this->Target : this->Temporary;
  const int file = this->OpenFile >= 0 ? dup(this->OpenFile) : open(path.c_str(), O_WRONLY);
  std::size_t done = 0;
  ssize_t size = file < 0 ? -1 : 1;
  while (size > 0 && done < text.size())
  {
    size = write(file, text.data() + done, text.size() - done);
    done += size > 0 ? static_cast<std::size_t>(size) : 0;
  }
  const int problem = errno;
  if (file < 0 || close(file) != 0 || done < text.size())
  {
    Fail(this->Target,
      std::strerror(problem) +
        (this->Temporary.empty() ? std::string() : ExplainFailedWrite(path)));
  }
}

void PendingFile::Commit()
{
  if (this->Temporary.empty())
  {
    return;
  }
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
  if (this->Resolved.empty())
  {
    return;
  }
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
