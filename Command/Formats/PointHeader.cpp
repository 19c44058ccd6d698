// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointHeader.h"

#include "InputFile.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace delaunayflip
{

bool IsNumber(std::string_view word)
{
  double value = 0.0;
  return ReadNumber(word, value) != std::errc::invalid_argument;
}

std::string WithPoint(std::string_view word)
{
  std::string text(word);
  const std::size_t comma = text.find(',');
  if (comma == text.npos || text.find('.') != text.npos)
  {
    return "";
  }
  text[comma] = '.';
  return IsNumber(text) ? text : "";
}

bool IsValue(std::string_view word) { return IsNumber(word) || !WithPoint(word).empty(); }

bool IsComment(const TextLines& lines)
{
  const std::size_t start = std::min(lines.Text.find_first_not_of(" \t\v\f"), lines.Text.size());
  return lines.Text.substr(start, 1) == "#" || lines.Text.substr(start, 2) == "//";
}

bool IsBlank(const TextLines& lines)
{
  return std::all_of(
    lines.Words.begin(), lines.Words.end(), [](std::string_view word) { return word.empty(); });
}

namespace
{
/// Whether no word at these places, as far as they are there, is other than a number or empty.
bool MayBeValues(const Words& words, const Places& places)
{
  return std::all_of(places.begin(), places.end(),
    [&words](std::size_t place)
    { return place >= words.size() || words[place].empty() || IsValue(words[place]); });
}

/// Whether there are words at all of these places, and they are numbers.
bool AreValues(const Words& words, const Places& places)
{
  return std::all_of(places.begin(), places.end(),
    [&words](std::size_t place) { return place < words.size() && IsValue(words[place]); });
}

/// Separates the words of a line at the first separator that makes numbers of those at these
/// places.
/// @returns whether one does.
bool SeparateValues(TextLines& lines, const Places& places)
{
  for (const char* const one : { ";", "\t", ",", "" })
  {
    lines.SeparateBy(one);
    const bool occurs = *one == '\0' || lines.Separator == *one;
    if (occurs && AreValues(lines.Words, places))
    {
      return true;
    }
  }
  return false;
}

/// The separator that a spreadsheet names in a line such as sep=; else 0.
char NamedSeparator(const TextLines& lines)
{
  const std::string_view text = lines.Text;
  const bool isOne =
    text.size() > 4 && (text.substr(0, 4) == "sep=" || text.substr(0, 4) == "SEP=");
  return isOne ? text[4] : '\0';
}

/// Whether words are numbers that may have decimal commas, each between two digits.
bool MayHaveDecimalCommas(const Words& words)
{
  const auto isOne = [](std::string_view word)
  { return IsValue(word) && word.front() != ',' && word.back() != ','; };
  return words.size() > 1 && std::all_of(words.begin(), words.end(), isOne);
}

/// Where coordinates must be. Without names, they are the first ones of a line.
/// @param least how many coordinates a line without names must begin with.
Places FindCoordinates(const Words& names, const ChosenColumns& chosen, std::size_t least)
{
  Places places = chosen.IsEmpty() ? FindKnownColumns(names) : chosen.Find(names);
  for (std::size_t place = 0; place < least && chosen.IsEmpty() && names.empty(); ++place)
  {
    places.push_back(place);
  }
  return places;
}

/// Splits a line of numbers. Tabs separate numbers with decimal commas. So do blanks if what is
/// between the commas are no numbers.
void SplitValues(TextLines& lines, const std::string& separators)
{
  const bool mayHaveCommas =
    lines.Text.find(',') != lines.Text.npos && lines.Text.find(';') == lines.Text.npos;
  if (mayHaveCommas && lines.Text.find('\t') != lines.Text.npos)
  {
    lines.SeparateBy("\t");
    if (std::count_if(lines.Words.begin(), lines.Words.end(), IsValue) >= 2)
    {
      return;
    }
  }
  lines.SeparateBy(separators);
  if (mayHaveCommas && !std::all_of(lines.Words.begin(), lines.Words.end(), IsNumber))
  {
    lines.SeparateBy("");
    if (MayHaveDecimalCommas(lines.Words))
    {
      return;
    }
    lines.SeparateBy(separators);
  }
}

/// The words of a comment without its mark.
Words WordsOfComment(const TextLines& lines)
{
  Words found = lines.Words;
  const auto isEmpty = [](std::string_view word) { return word.empty(); };
  found.erase(found.begin(), std::find_if_not(found.begin(), found.end(), isEmpty));
  found[0].remove_prefix(found[0][0] == '#' ? 1 : 2);
  found[0].remove_prefix(std::min(found[0].find_first_not_of(' '), found[0].size()));
  if (found[0].empty())
  {
    found.erase(found.begin());
  }
  return found;
}

/// Whether a comment may be a line of names. In prose, such as "x and y are lengths", x and y are
/// not side by side.
bool NamesColumns(const Words& comment, const ChosenColumns& chosen)
{
  if (!chosen.IsEmpty())
  {
    return !chosen.AreNumbers() && !chosen.Find(comment).empty();
  }
  const Places places = FindKnownColumns(comment);
  const auto [first, last] = std::minmax_element(places.begin(), places.end());
  return !places.empty() && *last - *first + 1 == places.size();
}

/// Whether words are the names that pandas gives to columns without any, and to their index: an
/// empty one, 0, 1 and so on.
bool AreCounted(const Words& words)
{
  std::size_t next = 0;
  return words.size() > 2 && words[0].empty() &&
    std::all_of(words.begin() + 1, words.end(),
      [&next](std::string_view word) { return word == std::to_string(next++); });
}

/// Whether a line has numbers where coordinates must be, whatever separates its words.
bool IsPoint(TextLines lines, const ChosenColumns& chosen)
{
  const bool isFree = chosen.IsEmpty() || !chosen.AreNumbers();
  return SeparateValues(lines, isFree ? Places{ 0, 1 } : chosen.Find({}));
}

/// Whether the first line that is no comment names columns. Names may be numbers, too.
bool IsLineOfNames(const TextLines& lines, const ChosenColumns& chosen)
{
  const Words& words = lines.Words;
  if (AreCounted(words))
  {
    return true;
  }
  if (!chosen.IsEmpty() && !chosen.AreNumbers() && !chosen.Find(words).empty())
  {
    return true;
  }
  if (std::none_of(words.begin(), words.end(), IsValue))
  {
    return !FindKnownColumns(words).empty() || !IsPoint(lines, chosen);
  }
  if (!chosen.IsEmpty())
  {
    return chosen.AreNumbers() && !MayBeValues(words, chosen.Find({})) && !IsPoint(lines, chosen);
  }
  const Places places = FindKnownColumns(words);
  TextLines next = lines;
  return !places.empty() && next.Next() && MayBeValues(next.Words, places);
}

/// Splits a line of numbers, which text may follow that has other separators. Blanks separate then
/// only if a coordinate has a decimal comma: in "48 12 30 N;16 22 15 E" they do not.
/// @param names of the columns.
void SplitPoint(
  TextLines& lines, const std::string& separators, const Words& names, const ChosenColumns& chosen)
{
  SplitValues(lines, separators);
  const Places places = FindCoordinates(names, chosen, 3);
  const bool isSplit = AreValues(lines.Words, FindCoordinates(names, chosen, 2)) || IsBlank(lines);
  TextLines trial = lines;
  if (isSplit || separators.size() == 1 || places.empty() || !SeparateValues(trial, places))
  {
    return;
  }
  const bool hasComma = std::any_of(places.begin(), places.end(),
    [&trial](std::size_t place) { return trial.Words[place].find(',') != std::string_view::npos; });
  const bool isSure =
    trial.Separator != ' ' || (hasComma && trial.Text.find(';') == trial.Text.npos);
  if (isSure)
  {
    lines.SeparateBy({ &trial.Separator, 1 });
  }
}
}

PointHeader ReadHeader(TextLines& lines, const ChosenColumns& chosen)
{
  PointHeader header;
  bool hasNames = false; // that are no comment
  bool isFirst = true;
  while (lines.Next())
  {
    const char named = NamedSeparator(lines);
    if (std::exchange(isFirst, false) && named != '\0')
    {
      header.Separators = named;
      continue;
    }
    if (IsComment(lines))
    {
      TextLines comment = lines; // so that rows go on with their own separator
      comment.SeparateBy(";,\t");
      const Words found = WordsOfComment(comment);
      if (!hasNames && NamesColumns(found, chosen))
      {
        header.Names = found;
        header.IsComment = true;
        header.Separator = comment.Separator;
      }
      continue;
    }
    // Names may have blanks, so tabs separate them. Between numbers, blanks and tabs are the same.
    lines.SeparateBy(header.Separators.size() == 1 ? header.Separators : ";,\t");
    if (!hasNames && !IsBlank(lines) && IsLineOfNames(lines, chosen))
    {
      hasNames = true;
      header.EmptyRows = 0;
      header.Names = lines.Words;
      header.Line = lines.GetLine();
      header.IsComment = false;
      if (lines.Separator != ' ')
      {
        header.Separators.insert(0, 1, lines.Separator);
      }
      continue;
    }
    SplitPoint(lines, header.Separators, header.Names, chosen);
    if (!IsBlank(lines))
    {
      return header;
    }
    header.EmptyRows += lines.Words.empty() ? 0 : 1;
  }
  return header;
}

}
