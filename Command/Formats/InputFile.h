// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INPUTFILE_H
#define DELAUNAYFLIP_INPUTFILE_H

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

/// @file
/// The bytes of a file, and its lines if it is text.

namespace delaunayflip
{

/// Reads a whole word as a number, as std::from_chars does; it may begin with a plus sign.
template <typename T>
std::errc ReadNumber(std::string_view word, T& value)
{
  if (word.substr(0, 1) == "+" && word.substr(0, 2) != "+-")
  {
    word.remove_prefix(1);
  }
  const char* const end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data(), end, value);
  return last == end ? error : std::errc::invalid_argument;
}

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

  /// A path that VTK's readers can open: for a pipe, a copy of its contents.
  const std::string& GetPath() const { return this->Path; }

  /// @throws CommandError (BadFile): the name and the reason.
  [[noreturn]] void Fail(const std::string& reason) const;

private:
  void CopyPipe();
  [[noreturn]] void FailToRead() const;

  std::string Name; ///< That the user gave.
  std::string Path;
  int Descriptor = -1;
  std::string_view Bytes;
};

/// The lines of a text as words. Lines end with \n, \r\n or \r; words are separated by blanks,
/// unless SeparateBy says otherwise.
class TextLines
{
public:
  /// Begins behind a byte order mark, if there is one. In an .obj, # begins a comment, but
  /// not in names, and a backslash at the end of a line continues the line.
  explicit TextLines(const InputFile& file, bool isObj = false);

  /// From this line on, words are separated by the first of these characters that this line has, if
  /// it has one. Then words may be empty, but for those at the end. Quotes around them are removed,
  /// and characters between these do not separate.
  void SeparateBy(std::string_view characters);

  /// Reads the next line that is not empty. Returns false if there is none.
  bool Next();

  /// The line.
  std::string_view Text;

  /// The words of the line.
  std::vector<std::string_view> Words;

  /// What is between them; a blank: any blanks.
  char Separator = ' ';

  /// The bytes after this line.
  std::string_view Rest;

  /// What messages call a line: in a file of breaklines, a row.
  std::string Noun = "line";

  /// A word of the line as a number, read as by std::from_chars and rounded correctly; NaN and
  /// infinity are numbers.
  /// @throws CommandError (BadFile) where it is missing, no number, or too large for the type.
  template <typename T>
  T Number(std::size_t place) const;

  /// The number of the line, from 1.
  std::size_t GetLine() const { return this->Line; }

  /// @throws CommandError (BadFile): the file and the reason.
  [[noreturn]] void FailFile(const std::string& reason) const { this->File.Fail(reason); }

  /// @throws CommandError (BadFile): the file, the number of this line and the reason.
  [[noreturn]] void Fail(const std::string& reason) const;

  /// Fails with a word, which is quoted before the problem.
  [[noreturn]] void FailOn(std::string_view word, const char* problem) const;

private:
  void Split(std::string_view line);

  const InputFile& File;
  std::size_t Line = 0;
  bool IsObj;
};

template <typename T>
T TextLines::Number(std::size_t place) const
{
  if (place >= this->Words.size() || this->Words[place].empty())
  {
    this->Fail("a number is missing");
  }
  const std::string_view word = this->Words[place];
  T value = 0;
  const std::errc error = ReadNumber(word, value);
  if (error == std::errc::invalid_argument)
  {
    const bool isWhole = std::is_integral_v<T>;
    this->FailOn(word,
      isWhole ? " is not a whole number, or is out of range"
              : " is not a number, or is out of range");
  }
  if (error == std::errc::result_out_of_range)
  {
    // Numbers below the smallest of the type are rounded, which std::from_chars does not do.
    const std::string text(word);
    const double rounded = std::is_same_v<T, float> ? std::strtof(text.c_str(), nullptr)
                                                    : std::strtod(text.c_str(), nullptr);
    if (!std::is_floating_point_v<T> || std::isinf(rounded))
    {
      this->FailOn(word, " is out of range");
    }
    value = static_cast<T>(rounded);
  }
  return value;
}

}

#endif
