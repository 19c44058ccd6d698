// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TEXTCURSOR_H
#define DELAUNAYFLIP_TEXTCURSOR_H

#include "InputFile.h"

#include <charconv>
#include <string>
#include <string_view>

namespace delaunayflip
{

/// Reads the text of a file by words and lines. Lines end with \n, \r\n or \r; words are separated
/// by blanks. Numbers are read as by std::from_chars, in any locale, and rounded correctly; NaN and
/// infinity are numbers.
class TextCursor
{
public:
  /// Reads from byte `begin` to byte `end`. If `begin` is 0, skips a byte order mark.
  explicit TextCursor(
    const InputFile& file, std::size_t begin = 0, std::size_t end = std::string_view::npos);

  /// After this call, a backslash at the end of a line continues the line.
  void ContinueLines() { this->Continues = true; }

  /// After this call, `mark` begins a comment: words and numbers of a line end before it.
  void EndLinesAt(char mark) { this->CommentMark = mark; }

  bool IsAtEnd() const { return this->Here == this->End; }

  /// Whether nothing but blanks and a comment is left of the line.
  bool IsAtLineEnd();

  /// Moves to the next line.
  void SkipLine();

  /// Moves to the next word, in this line or a later one.
  void SkipSpace();

  /// The next word of this line; empty where there is none.
  std::string_view NextWord();

  /// What is left of this line, without blanks around it.
  std::string RestOfLine();

  /// The next word of this line as a number.
  /// @throws CommandError (BadFile) where it is none, or too large for the type.
  template <typename T>
  T NextNumber();

  /// Moves past `size` bytes, whatever they contain, and returns them.
  const char* NextBytes(std::size_t size);

  std::size_t GetOffset() const { return this->Here - this->File->GetBytes().data(); }
  std::size_t GetBytesLeft() const { return this->End - this->Here; }

  /// @throws CommandError (BadFile): the file, the line and the reason.
  [[noreturn]] void Fail(const std::string& reason) const;

private:
  static bool IsLineEnd(char letter) { return letter == '\n' || letter == '\r'; }
  static bool IsBlank(char letter)
  {
    return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
  }
  bool IsWordEnd(const char* place) const
  {
    return place == this->End || IsBlank(*place) || IsLineEnd(*place) ||
      *place == this->CommentMark || this->IsContinued(place);
  }
  bool IsContinued(const char* place) const
  {
    return this->Continues && *place == '\\' && this->FindLineEnd(place + 1) != nullptr;
  }
  const char* FindLineEnd(const char* place) const;
  void SkipBlanks();
  void SkipLineEnd();
  const char* FindWordEnd() const;
  template <typename T>
  T NextUnusualNumber();

  const InputFile* File;
  const char* Here;
  const char* End;
  bool Continues = false;
  char CommentMark = '\n';
};

template <typename T>
T TextCursor::NextNumber()
{
  this->SkipBlanks();
  T value = 0;
  const auto [end, error] = std::from_chars(this->Here, this->End, value);
  if (error == std::errc() && this->IsWordEnd(end))
  {
    this->Here = end;
    return value;
  }
  return this->NextUnusualNumber<T>();
}

}

#endif
