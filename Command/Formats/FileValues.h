// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILEVALUES_H
#define DELAUNAYFLIP_FILEVALUES_H

#include "InputFile.h"
#include "TextCursor.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

/// @file
/// One interface to the numbers of text and binary files: Next reads a number, StartRow and EndRow
/// enclose a row, and Fail throws an error that says where the file is wrong.

namespace delaunayflip
{

/// Numbers as text, one row per line.
class TextValues
{
public:
  explicit TextValues(const TextCursor& cursor)
    : Cursor(cursor)
  {
  }

  void StartRow(const std::string&, std::int64_t) { this->Cursor.SkipSpace(); }

  template <typename T>
  T Next()
  {
    return this->Cursor.NextNumber<T>();
  }

  void EndRow()
  {
    if (!this->Cursor.IsAtLineEnd())
    {
      this->Cursor.Fail("more values than the header says");
    }
  }

  std::size_t GetBytesLeft() const { return this->Cursor.GetBytesLeft(); }

  /// The number of bytes after the last row, without blanks.
  std::size_t Finish()
  {
    this->Cursor.SkipSpace();
    return this->Cursor.GetBytesLeft();
  }

  [[noreturn]] void Fail(const std::string& reason) const { this->Cursor.Fail(reason); }

private:
  TextCursor Cursor;
};

/// Binary numbers, in this machine's byte order or the opposite one.
template <bool Swapped>
class BinaryValues
{
public:
  BinaryValues(const InputFile& file, std::size_t begin)
    : File(file),
      Here(file.GetBytes().data() + begin),
      End(file.GetBytes().data() + file.GetBytes().size())
  {
  }

  void StartRow(const std::string& what, std::int64_t row)
  {
    this->What = &what;
    this->Row = row;
  }

  template <typename T>
  T Next()
  {
    if (this->GetBytesLeft() < sizeof(T))
    {
      this->Fail("the file ends here (truncated or corrupt)");
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, this->Here, sizeof(T));
    if (Swapped)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    this->Here += sizeof(T);
    return value;
  }

  void EndRow() {}

  std::size_t GetBytesLeft() const { return static_cast<std::size_t>(this->End - this->Here); }

  std::size_t Finish() const { return this->GetBytesLeft(); }

  [[noreturn]] void Fail(const std::string& reason) const
  {
    this->File.Fail(*this->What + " " + std::to_string(this->Row) + ": " + reason);
  }

private:
  const InputFile& File;
  const char* Here;
  const char* End;
  const std::string* What = nullptr;
  std::int64_t Row = 0;
};

}

#endif
