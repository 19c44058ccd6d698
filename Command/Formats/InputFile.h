// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INPUTFILE_H
#define DELAUNAYFLIP_INPUTFILE_H

#include <string>
#include <string_view>

namespace delaunayflip
{

/// The bytes of a file, in memory as long as this object lives. A pipe is read to its end first.
class InputFile
{
public:
  /// @throws CommandError (BadFile) with the file and the reason.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::string_view GetBytes() const { return this->Bytes; }

  /// The name that the user gave.
  const std::string& GetName() const { return this->Name; }

  /// A path that VTK's readers can open: for a pipe, a copy of its contents.
  const std::string& GetPath() const { return this->Path; }

  /// @throws CommandError (BadFile): the name and the reason.
  [[noreturn]] void Fail(const std::string& reason) const;

  /// The same, with the number of the line that contains `place`, a pointer into the bytes.
  [[noreturn]] void FailAt(const char* place, const std::string& reason) const;

private:
  int OpenFile() const;
  int Spool(int pipe) const;
  void Map();
  [[noreturn]] void FailToRead() const;

  std::string Name;
  std::string Path;
  int Descriptor = -1;
  std::string_view Bytes;
};

}

#endif
