// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PENDINGFILE_H
#define DELAUNAYFLIP_PENDINGFILE_H

#include <string>

/// @file
/// Files that get their names only when they are complete.

namespace delaunayflip
{

/// An empty temporary file beside `target`. Commit() replaces the target with it; if Commit() is
/// not called, the destructor removes it.
class PendingFile
{
public:
  /// @throws CommandError (BadFile) when no file can be created there, or `target` exists and is
  /// not a regular file.
  explicit PendingFile(const std::string& target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& GetTarget() const { return this->Target; }
  const std::string& GetTemporary() const { return this->Temporary; }

  /// Gives the temporary file the name, the owner and the permissions of the target.
  /// @throws CommandError (BadFile); the target is unchanged then.
  void Commit();

  /// Puts back what Commit replaced.
  void Undo();

private:
  std::string Target;
  std::string Resolved; ///< The target, with symbolic links resolved.
  std::string Temporary;
  std::string Backup; ///< Another name of the file that was replaced.
  bool HadNone = false; ///< Whether there was no such file.
};

}

#endif
