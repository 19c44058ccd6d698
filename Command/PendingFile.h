// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PENDINGFILE_H
#define DELAUNAYFLIP_PENDINGFILE_H

#include <string>

/// @file
/// Files that appear under their name only when they are whole.

namespace delaunayflip
{

/// An empty temporary file beside `target`, which it replaces when told; else it goes away.
class PendingFile
{
public:
  /// @throws CommandError (BadFile) when no file can be made there, or `target` is something else
  /// than a plain file.
  explicit PendingFile(const std::string& target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& GetTarget() const { return this->Target; }
  const std::string& GetTemporary() const { return this->Temporary; }

  /// Gives the temporary the name, and the permissions, of the target.
  /// @throws CommandError (BadFile).
  void Commit();

private:
  std::string Target;
  std::string Resolved; ///< The target behind symbolic links.
  std::string Temporary;
};

}

#endif
