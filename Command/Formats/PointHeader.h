// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTHEADER_H
#define DELAUNAYFLIP_POINTHEADER_H

#include "PointColumns.h"

#include <string>
#include <string_view>

/// @file
/// What the lines of a file of points are: names, comments, blank rows or numbers.

namespace delaunayflip
{

class TextLines;

/// The first lines of a file of points.
struct PointHeader
{
  Words Names; ///< Names of the columns; empty if the file names none.
  std::size_t Line = 0; ///< The number of their line, if it is no comment.
  bool IsComment = false; ///< Whether a comment names them.
  char Separator = ' '; ///< What separates the names.
  std::string Separators = ";,"; ///< A line of points is split at the first that it has.
  int EmptyRows = 0; ///< Before the first point, rows of a table with empty cells only.
};

/// Reads the lines before the first point, which is then the line of `lines`, if there is one.
PointHeader ReadHeader(TextLines& lines, const ChosenColumns& chosen);

/// Whether a word is a number with a decimal point.
bool IsNumber(std::string_view word);

/// A word with its only comma replaced by a point, if that is a number; else an empty string.
std::string WithPoint(std::string_view word);

/// Whether a word is a number, with a decimal point or a decimal comma.
bool IsValue(std::string_view word);

bool IsComment(const TextLines& lines);

/// Whether no cell of a line has anything, as in the empty rows of a spreadsheet.
bool IsBlank(const TextLines& lines);

}

#endif
