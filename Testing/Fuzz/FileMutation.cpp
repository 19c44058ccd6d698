// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileMutation.h"

#include <algorithm>
#include <cctype>

namespace delaunayflip
{
namespace
{

using Size = std::uint32_t;

/// A position in a text, or 0 in an empty one.
Size DrawPlace(const std::string& text, ByteSource& source)
{
  return text.empty() ? 0 : source.Draw(static_cast<Size>(text.size()));
}

void ChangeByte(std::string& text, ByteSource& source)
{
  constexpr unsigned char Values[] = { 0, 1, 9, 10, 13, 32, 127, 128, 255 };
  if (text.empty())
  {
    return;
  }
  char& byte = text[DrawPlace(text, source)];
  byte = source.Once(2) ? static_cast<char>(byte ^ (1 << source.Draw(8)))
                        : static_cast<char>(Values[source.Draw(sizeof(Values))]);
}

/// Changes four or eight bytes, as of a binary number.
void ChangeWord(std::string& text, ByteSource& source)
{
  static const std::string words[] = { std::string(4, '\0'), std::string(4, '\xFF'),
    std::string("\x00\x00\x00\x80", 4), std::string("\x7F\xFF\xFF\xFF", 4),
    std::string("\xFF\xFF\xFF\x7F", 4), std::string("\x00\x00\x80\x7F", 4),
    std::string("\x00\x00\xC0\x7F", 4), std::string(8, '\xFF'),
    std::string("\x00\x00\x00\x00\x00\x00\xF0\x7F", 8), std::string("\x00\x00\x00\x40", 4) };
  const std::string& word = words[source.Draw(sizeof(words) / sizeof(words[0]))];
  const Size place = DrawPlace(text, source);
  text.replace(place, std::min(word.size(), text.size() - place), word);
}

bool IsOfNumber(char letter)
{
  return std::isdigit(static_cast<unsigned char>(letter)) || letter == '.' || letter == '-' ||
    letter == 'e' || letter == '+';
}

/// Replaces a decimal number with another.
void ChangeNumber(std::string& text, ByteSource& source)
{
  constexpr const char* Numbers[] = { "0", "-1", "1", "2", "3", "4294967296", "2147483648",
    "9223372036854775807", "99999999999999999999", "1e400", "-1e-400", "nan", "inf", "1,5", "abc",
    "", "0x10", "1000000000", "1e154", "-0" };
  const Size start = DrawPlace(text, source);
  const auto digit = std::find_if(text.begin() + start, text.end(),
    [](char letter) { return std::isdigit(static_cast<unsigned char>(letter)); });
  const auto end = std::find_if_not(digit, text.end(), IsOfNumber);
  text.replace(digit, end, Numbers[source.Draw(sizeof(Numbers) / sizeof(Numbers[0]))]);
}

/// Removes, repeats or moves a piece.
void ChangePiece(std::string& text, ByteSource& source)
{
  const Size place = DrawPlace(text, source);
  const std::string piece = text.substr(place, 1 + source.Draw(64));
  switch (source.Draw(3))
  {
    case 0:
      text.erase(place, piece.size());
      break;
    case 1:
      text.insert(place, piece);
      break;
    default:
      text.erase(place, piece.size());
      text.insert(DrawPlace(text, source), piece);
      break;
  }
}

/// Removes, repeats or moves a line.
void ChangeLine(std::string& text, ByteSource& source)
{
  const Size place = DrawPlace(text, source);
  const std::size_t before = text.rfind('\n', place);
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(text.find('\n', start), text.size() - 1);
  const std::string line = text.substr(start, end + 1 - start);
  if (source.Once(2))
  {
    text.erase(start, line.size());
  }
  else
  {
    text.insert(start, line);
  }
}

void Splice(std::string& text, const std::string& other, ByteSource& source)
{
  const Size from = DrawPlace(other, source);
  text.insert(DrawPlace(text, source), other.substr(from, 1 + source.Draw(256)));
}

void MutateOnce(std::string& text, const std::string& other, ByteSource& source)
{
  switch (source.Draw(8))
  {
    case 0:
      ChangeByte(text, source);
      break;
    case 1:
      ChangeWord(text, source);
      break;
    case 2:
    case 3:
    case 4:
      ChangeNumber(text, source);
      break;
    case 5:
      ChangePiece(text, source);
      break;
    case 6:
      ChangeLine(text, source);
      break;
    default:
      if (source.Once(2))
      {
        Splice(text, other, source);
      }
      else
      {
        text.resize(DrawPlace(text, source));
      }
      break;
  }
}

}

std::string MutateFile(std::string bytes, const std::string& other, ByteSource& source)
{
  // Most files stay regular enough to pass the first checks.
  for (Size faults = 1 + source.Draw(source.Once(4) ? 12 : 3); faults > 0; --faults)
  {
    MutateOnce(bytes, other, source);
  }
  return bytes;
}

}
