// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Formats.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cctype>

/// @file
/// .xyz, .csv and .txt: a line of text for each point, x y [z] and perhaps more, perhaps after a
/// line of names. Lines that begin with # or // are comments; the names may be in one.

namespace delaunayflip
{

namespace
{

using Words = std::vector<std::string_view>;

bool IsNumber(std::string_view word)
{
  double value = 0.0;
  return ReadNumber(word, value) != std::errc::invalid_argument;
}

bool IsComment(const TextLines& lines)
{
  const std::size_t start = std::min(lines.Text.find_first_not_of(" \t\v\f"), lines.Text.size());
  return lines.Text.substr(start, 1) == "#" || lines.Text.substr(start, 2) == "//";
}

/// The places of the columns named x, y and, if there is one, z, in any case; else none.
std::vector<std::size_t> FindAxes(const Words& names)
{
  std::vector<std::size_t> places;
  for (const char axis : { 'x', 'y', 'z' })
  {
    const auto found = std::find_if(names.begin(), names.end(),
      [axis](std::string_view name)
      { return name.size() == 1 && std::tolower(static_cast<unsigned char>(name[0])) == axis; });
    if (found != names.end())
    {
      places.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    else if (axis != 'z')
    {
      return {};
    }
  }
  return places;
}

/// E.g. "'time', 'intensity'", but no more than ten.
std::string Quoted(const Words& names)
{
  constexpr std::size_t most = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
  {
    text += (i == 0 ? "'" : ", '") + std::string(names[i]) + "'";
  }
  return names.size() > most ? text + " and others" : text;
}

/// Reads the lines before the first point, which is then the line of `lines`.
/// @returns the names of its columns; empty if the file names none, or has no points.
Words ReadNames(TextLines& lines)
{
  Words names;
  bool hasNames = false; // that are no comment
  // Names may have blanks, so tabs separate them. Between numbers, blanks and tabs are the same.
  std::string separators = ";,";
  while (lines.Next())
  {
    const bool isComment = IsComment(lines);
    lines.SeparateBy(separators);
    if (!isComment && (hasNames || std::any_of(lines.Words.begin(), lines.Words.end(), IsNumber)))
    {
      if (lines.Separator != ' ') // cells at the end may be empty
      {
        lines.Words.resize(std::max(lines.Words.size(), names.size()));
      }
      const bool fits = names.size() == lines.Words.size();
      if (hasNames && !fits)
      {
        lines.Fail("has " + std::to_string(lines.Words.size()) +
          " columns, but the line of names has " + std::to_string(names.size()));
      }
      return fits ? names : Words(); // a comment may be anything
    }
    lines.SeparateBy(";,\t");
    Words found = lines.Words;
    if (isComment)
    {
      const auto isEmpty = [](std::string_view word) { return word.empty(); };
      found.erase(found.begin(), std::find_if_not(found.begin(), found.end(), isEmpty));
      found[0].remove_prefix(found[0][0] == '#' ? 1 : 2);
      found[0].remove_prefix(std::min(found[0].find_first_not_of(' '), found[0].size()));
      found.erase(found.begin(), found.begin() + (found[0].empty() ? 1 : 0));
    }
    if (!isComment || !FindAxes(found).empty())
    {
      hasNames = !isComment;
      names = std::move(found);
      separators = lines.Separator == ' ' ? ";," : lines.Separator + std::string(";,");
    }
  }
  return {};
}

/// The columns of x, y and, if there is one, z. Warns of all that is not certain or left out.
std::vector<std::size_t> ChooseColumns(
  const TextLines& lines, const Words& names, std::vector<std::string>& warnings)
{
  const std::size_t count = lines.Words.size();
  if (count < 2)
  {
    lines.Fail("a point has two or three coordinates: x y [z]");
  }
  std::vector<std::size_t> columns = FindAxes(names);
  if (columns.empty())
  {
    columns = { 0, 1 };
    columns.resize(std::min<std::size_t>(count, 3), 2);
    if (!names.empty())
    {
      warnings.push_back("no columns are named x and y; took " +
        Quoted({ names.begin(), names.begin() + static_cast<std::ptrdiff_t>(columns.size()) }) +
        " as x" + (columns.size() == 3 ? ", y, z" : ", y"));
    }
  }
  Words others;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (std::find(columns.begin(), columns.end(), i) == columns.end())
    {
      others.push_back(names[i]);
    }
  }
  if (!others.empty())
  {
    warnings.push_back("left out the columns " + Quoted(others));
  }
  else if (count > columns.size())
  {
    warnings.push_back(
      "left out the columns from number " + std::to_string(columns.size() + 1) + " on");
  }
  return columns;
}

}

FileMesh ReadPoints(const InputFile& file)
{
  FileMesh result;
  TextLines lines(file);
  const Words names = ReadNames(lines);
  const vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  if (!lines.Words.empty())
  {
    const std::vector<std::size_t> columns = ChooseColumns(lines, names, result.Warnings);
    const std::size_t count = lines.Words.size();
    // Between blanks no cell is empty, so a missing one would move the others.
    const auto text = std::find_if_not(lines.Words.begin(), lines.Words.end(), IsNumber);
    const auto numbers = static_cast<std::size_t>(text - lines.Words.begin());
    const std::size_t fewest = lines.Separator != ' ' ? 0 : names.empty() ? numbers : count;
    const std::string_view rest = lines.Rest;
    coordinates->Allocate(3 * (std::count(rest.begin(), rest.end(), '\n') + 2));
    do
    {
      const Words& words = lines.Words;
      if (IsComment(lines))
      {
        continue;
      }
      if (words.size() < fewest)
      {
        lines.Fail("has " + std::to_string(words.size()) + " columns, but lines before it have " +
          std::to_string(fewest) + "; a value is missing");
      }
      // Text at the end may have any number of words. Numbers may come from decimal commas.
      if (words.size() > count && std::all_of(words.begin(), words.begin() + count + 1, IsNumber))
      {
        lines.Fail("begins with more than " + std::to_string(count) +
          " numbers, but the first point has " + std::to_string(count) + " columns");
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        coordinates->InsertNextValue(i < columns.size() ? lines.Number<double>(columns[i]) : 0.0);
      }
    } while (lines.Next());
  }
  result.Mesh->SetPoints(vtkNew<vtkPoints>());
  result.Mesh->GetPoints()->SetData(coordinates);
  return result;
}

}
