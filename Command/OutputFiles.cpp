// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OutputFiles.h"

#include "CommandError.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace delaunayflip
{

namespace
{

namespace fs = std::filesystem;

/// Calls `make` with different names in the folder of `path`, as long as the name is in use.
/// Returns the name, or an empty string if `make` fails for another reason, which errno holds.
template <typename Function>
std::string MakeUnused(const fs::path& path, const Function& make)
{
  const std::string stem = ".delaunay-flip-" + std::to_string(getpid()) + "-";
  for (int number = 0;; ++number)
  {
    const fs::path name = path.parent_path() / (stem + std::to_string(number));
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
  const mode_t bits = isOwned ? 07777 : 0777;
  chmod(to.c_str(), status.st_mode & bits);
}

}

fs::path FollowLinks(const std::string& path, int* openFile)
{
  constexpr int most = 40; // the limit of Linux
  std::error_code error;
  fs::path file = fs::absolute(path, error);
  for (int links = 0; links < most; ++links)
  {
    const std::string folder = fs::weakly_canonical(file.parent_path(), error).string();
    const std::string name = file.filename().string();
    const bool isNumber = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
    if (openFile && isNumber &&
      (folder == "/dev/fd" || folder == "/proc/" + std::to_string(getpid()) + "/fd"))
    {
      *openFile = std::atoi(name.c_str());
    }
    if (!fs::is_symlink(fs::symlink_status(file, error)))
    {
      break;
    }
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  const fs::path resolved = fs::weakly_canonical(file, error);
  return error ? file : resolved;
}

std::string ExplainFailedWrite(const std::string& path)
{
  constexpr std::uintmax_t least = 1 << 20; // file systems keep some space back, or round sizes
  std::error_code error;
  const fs::space_info space = fs::space(fs::absolute(path).parent_path(), error);
  if (!error && space.available < least)
  {
    return "; the disk is full";
  }
  rlimit limit = {};
  const std::uintmax_t size = fs::file_size(path, error); // VTK may have removed it
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
    (error || size >= limit.rlim_cur))
  {
    return "; the size of files is limited to " +
      Counted(static_cast<std::int64_t>(limit.rlim_cur), "byte") + " here";
  }
  return {};
}

PendingFile::PendingFile(const std::string& target, bool mayBeStream)
  : Target(target)
{
  if (target.empty())
  {
    return;
  }
  this->Resolved = FollowLinks(target, &this->OpenFile);
  std::error_code error;
  const fs::file_status status = fs::status(this->Resolved, error);
  const bool exists = fs::exists(status);
  if (error && status.type() != fs::file_type::not_found)
  {
    this->Fail(error.message());
  }
  const bool isStream = this->OpenFile >= 0 || (exists && !fs::is_regular_file(status));
  if (isStream && (!mayBeStream || fs::is_directory(status)))
  {
    this->Fail("it exists and is not a regular file");
  }
  if (exists && access(this->Resolved.c_str(), W_OK) != 0)
  {
    this->Fail(std::strerror(errno));
  }
  if (isStream)
  {
    return;
  }
  this->Temporary = MakeUnused(this->Resolved,
    [](const char* name)
    {
      const int file = open(name, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      return file >= 0 && close(file) == 0;
    });
  if (this->Temporary.empty())
  {
    this->Fail(std::strerror(errno));
  }
}

PendingFile::~PendingFile()
{
  if (!this->Backup.empty())
  {
    std::rename(this->Backup.c_str(), this->Resolved.c_str());
  }
  unlink(this->Temporary.c_str());
  unlink(this->Backup.c_str());
  if (this->IsNew)
  {
    unlink(this->Resolved.c_str());
  }
}

void PendingFile::Write(const std::string& text) const
{
  if (this->Target.empty())
  {
    return;
  }
  const std::string& path = this->Temporary.empty() ? this->Target : this->Temporary;
  const int file = this->OpenFile >= 0 ? dup(this->OpenFile) : open(path.c_str(), O_WRONLY);
  std::size_t done = 0;
  while (file >= 0 && done < text.size())
  {
    const ssize_t size = write(file, text.data() + done, text.size() - done);
    if (size <= 0)
    {
      break;
    }
    done += static_cast<std::size_t>(size);
  }
  const int problem = errno;
  if (file < 0 || close(file) != 0 || done < text.size())
  {
    std::string reason = std::strerror(problem);
    if (!this->Temporary.empty())
    {
      reason += ExplainFailedWrite(path);
    }
    this->Fail(reason);
  }
}

void PendingFile::Commit()
{
  if (this->Temporary.empty())
  {
    return;
  }
  CopyOwner(this->Resolved, this->Temporary);
  // Some file systems allow no second name for the old file; then it cannot be put back.
  this->Backup = MakeUnused(
    this->Resolved, [this](const char* name) { return link(this->Resolved.c_str(), name) == 0; });
  const bool isNew = this->Backup.empty() && errno == ENOENT;
  if (std::rename(this->Temporary.c_str(), this->Resolved.c_str()) != 0)
  {
    this->Fail(std::strerror(errno));
  }
  this->IsNew = isNew;
  this->Temporary.clear();
}

void PendingFile::Keep()
{
  this->IsNew = false;
  unlink(this->Backup.c_str());
  this->Backup.clear();
}

void PendingFile::Fail(const std::string& reason) const
{
  throw CommandError(ExitCode::BadFile, this->Target + ": cannot be written: " + reason);
}

void OutputFiles::Commit()
{
  for (PendingFile* const file :
    { &this->Statistics, &this->Report, &this->Projection, &this->Mesh })
  {
    file->Commit();
  }
  for (PendingFile* const file :
    { &this->Statistics, &this->Report, &this->Projection, &this->Mesh })
  {
    file->Keep();
  }
}

}
