// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PENDINGFILE_H
#define DELAUNAYFLIP_PENDINGFILE_H

#include <string>

/// @file
/// Files that get their names only when they are complete, and streams, which are written at once.

namespace delaunayflip
{

/// An empty temporary file beside `target`. Commit() replaces the target with it; if Commit() is
/// not called, the destructor removes it.
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

  const std::string& GetTarget() const { return this->Target; }
  const std::string& GetTemporary() const { return this->Temporary; }

  /// Writes all of the file, or adds to the stream.
  /// @throws CommandError (BadFile).
  void Write(const std::string& text) const;

  /// Gives the temporary file the name, the owner and the permissions of the target.
  /// @throws CommandError (BadFile); the target is unchanged then.
  void Commit();

  /// Puts back what Commit replaced.
  void Undo();

private:
  std::string Target;
  std::string Resolved; ///< The target, with symbolic links resolved.
  std::string Temporary; ///< Empty for a stream.
  std::string Backup; ///< Another name of the file that was replaced.
  int OpenFile = -1; ///< The number of this process's open file that the target is, or -1.
  bool HadNone = false; ///< Whether there was no such file.
};

}

#endif
