// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextCursor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <type_traits>

namespace delaunayflip
{

namespace
{

/// A word of a file in quotes, short and printable.
std::string Quoted(std::string_view word)
{
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  std::replace_if(
    text.begin(), text.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

/// Numbers below the smallest of the type are rounded to it or to zero; numbers above the largest
/// become infinite. std::from_chars does neither.
template <typename T>
T Rounded(std::string_view word)
{
  const std::string text(word);
  if constexpr (std::is_same_v<T, float>)
  {
    return std::strtof(text.c_str(), nullptr);
  }
  else
  {
    return static_cast<T>(std::strtod(text.c_str(), nullptr));
  }
}

}

TextCursor::TextCursor(const InputFile& file, std::size_t begin, std::size_t end)
  : File(&file),
    Here(file.GetBytes().data() + begin),
    End(file.GetBytes().data() + std::min(end, file.GetBytes().size()))
{
  const std::string_view mark = "\xEF\xBB\xBF";
  if (begin == 0 && file.GetBytes().substr(0, mark.size()) == mark)
  {
    this->Here += mark.size();
  }
}

bool TextCursor::IsAtLineEnd()
{
  this->SkipBlanks();
  return this->IsAtEnd() || IsLineEnd(*this->Here) || *this->Here == this->CommentMark;
}

void TextCursor::SkipLine()
{
  this->Here = std::find_if(this->Here, this->End, IsLineEnd);
  this->SkipLineEnd();
}

void TextCursor::SkipLineEnd()
{
  const bool isPair = this->End - this->Here > 1 && this->Here[0] == '\r' && this->Here[1] == '\n';
  this->Here += this->IsAtEnd() ? 0 : isPair ? 2 : 1;
}

void TextCursor::SkipBlanks()
{
  while (!this->IsAtEnd())
  {
    if (IsBlank(*this->Here))
    {
      ++this->Here;
    }
    else if (this->IsContinued(this->Here))
    {
      this->Here = this->FindLineEnd(this->Here + 1);
      this->SkipLineEnd();
    }
    else
    {
      return;
    }
  }
}

/// The end of the line if only blanks are left of it; else null.
const char* TextCursor::FindLineEnd(const char* place) const
{
  place = std::find_if_not(place, this->End, IsBlank);
  return place == this->End || IsLineEnd(*place) ? place : nullptr;
}

void TextCursor::SkipSpace()
{
  while (this->IsAtLineEnd() && !this->IsAtEnd())
  {
    this->SkipLine();
  }
}

const char* TextCursor::FindWordEnd() const
{
  const char* end = this->Here;
  while (!this->IsWordEnd(end))
  {
    ++end;
  }
  return end;
}

std::string_view TextCursor::NextWord()
{
  this->SkipBlanks();
  const char* const begin = this->Here;
  this->Here = this->FindWordEnd();
  return { begin, static_cast<std::size_t>(this->Here - begin) };
}

std::string TextCursor::RestOfLine()
{
  this->SkipBlanks();
  const char* end = std::find_if(this->Here, this->End, IsLineEnd);
  const char* const begin = this->Here;
  this->Here = end;
  while (end > begin && IsBlank(end[-1]))
  {
    --end;
  }
  return { begin, end };
}

const char* TextCursor::NextBytes(std::size_t size)
{
  const char* const bytes = this->Here;
  this->Here += size;
  return bytes;
}

void TextCursor::Fail(const std::string& reason) const { this->File->FailAt(this->Here, reason); }

template <typename T>
T TextCursor::NextUnusualNumber()
{
  const char* const end = this->FindWordEnd();
  const std::string_view word(this->Here, static_cast<std::size_t>(end - this->Here));
  if (word.empty())
  {
    this->Fail("a number is missing");
  }
  const bool hasPlus = word[0] == '+' && word.substr(0, 2) != "+-";
  T value = 0;
  const auto [last, error] = std::from_chars(word.data() + (hasPlus ? 1 : 0), end, value);
  if (last != end || error == std::errc::invalid_argument)
  {
    this->Fail(Quoted(word) +
      (std::is_floating_point_v<T> ? " is not a number" : " is not an integer of its range"));
  }
  if constexpr (std::is_floating_point_v<T>)
  {
    value = error == std::errc() ? value : Rounded<T>(word);
  }
  if (error != std::errc() && (!std::is_floating_point_v<T> || std::isinf(double(value))))
  {
    this->Fail(Quoted(word) + " is out of range");
  }
  this->Here = end;
  return value;
}

// The types of numbers that files have.
template float TextCursor::NextUnusualNumber();
template double TextCursor::NextUnusualNumber();
template char TextCursor::NextUnusualNumber();
template signed char TextCursor::NextUnusualNumber();
template unsigned char TextCursor::NextUnusualNumber();
template short TextCursor::NextUnusualNumber();
template unsigned short TextCursor::NextUnusualNumber();
template int TextCursor::NextUnusualNumber();
template unsigned int TextCursor::NextUnusualNumber();
template long TextCursor::NextUnusualNumber();
template unsigned long TextCursor::NextUnusualNumber();
template long long TextCursor::NextUnusualNumber();
template unsigned long long TextCursor::NextUnusualNumber();

}
