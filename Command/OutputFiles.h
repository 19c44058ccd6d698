// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OUTPUTFILES_H
#define DELAUNAYFLIP_OUTPUTFILES_H

#include <filesystem>
#include <string>

/// @file
/// Files that get their names only when they are complete, and streams, which are written at once.

namespace delaunayflip
{

/// The absolute path of the file that `path` refers to, with symbolic links resolved, including
/// links to files that do not exist yet. If links form a loop, the path of one of these links.
/// @param openFile receives the number of the open file of this process that the path leads to, as
///   /dev/stdout and /dev/fd/3 do; -1 if it leads elsewhere
std::filesystem::path FollowLinks(const std::string& path, int* openFile = nullptr);

/// The end of a message, which explains why a file may be incomplete: a full disk or a limit on the
/// size of files. Empty if neither is the cause.
std::string ExplainFailedWrite(const std::string& path);

/// An empty temporary file beside `target`, or no file for an empty name. Commit() replaces the
/// target with it, and Keep() makes that final; without Keep(), the destructor puts all back.
///
/// A target that is a pipe, a device or one of this process's open files (/dev/stdout) is a stream:
/// it has no temporary file, and Write writes to it.
class PendingFile
{
public:
  /// @throws CommandError (BadFile) when no file can be created there, or `target` is a stream and
  /// may not be one, or a folder.
  explicit PendingFile(const std::string& target, bool mayBeStream = false);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& GetTemporary() const { return this->Temporary; }

  /// Writes all of the file, or adds to the stream.
  /// @throws CommandError (BadFile).
  void Write(const std::string& text) const;

  /// Gives the temporary file the name, the owner and the permissions of the target.
  /// @throws CommandError (BadFile); the target is unchanged then.
  void Commit();

  /// From now on, what Commit replaced is not put back.
  void Keep();

private:
  [[noreturn]] void Fail(const std::string& reason) const;

  std::string Target;
  int OpenFile = -1; ///< The number of this process's open file that the target is, or -1.
  std::filesystem::path Resolved; ///< The target, with symbolic links resolved.
  std::string Temporary; ///< Empty for a stream.
  std::string Backup; ///< Another name of the file that was replaced.
  bool IsNew = false; ///< Whether Commit made a file where there was none.
};

/// The files that a run writes. They are created before the work begins, so that a missing write
/// permission is noticed early, and get their final names after it.
struct OutputFiles
{
  /// All of them, or none. The mesh comes last, because it matters most.
  /// @throws CommandError (BadFile).
  void Commit();

  PendingFile Mesh;
  PendingFile Statistics;
  PendingFile Report;
  PendingFile Projection; ///< The .prj beside an .asc.
};

}

#endif
