// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTCOLUMNS_H
#define DELAUNAYFLIP_POINTCOLUMNS_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Which columns of a text are x, y and z.

namespace delaunayflip
{

using Words = std::vector<std::string_view>;

/// The places of x, y and, if there is one, z among the columns of a line, from 0.
using Places = std::vector<std::size_t>;

/// What the user says of the columns, x, y and perhaps z: each a name or a number, from 1.
class ChosenColumns
{
public:
  /// @param list separated by commas; empty: nothing is chosen.
  explicit ChosenColumns(const std::string& list);

  /// What is wrong with the list; empty: nothing.
  std::string FindFault() const;

  bool IsEmpty() const { return this->Columns.empty(); }

  /// Whether all are numbers, so that no line of names is needed.
  bool AreNumbers() const;

  /// The places of the columns. Numbers are names if all of them are.
  /// @returns an empty list if a name is not there.
  Places Find(const Words& names) const;

private:
  std::vector<std::string> Columns;
};

/// The places of the columns with names that are known as x, y and z, such as x y z, easting
/// northing elevation, lon lat height or Points:0 Points:1 Points:2, in upper or lower case.
/// @returns an empty list if x or y has none.
Places FindKnownColumns(const Words& names);

/// Whether these are names of longitudes and latitudes, such as lon and lat.
bool AreAngles(std::string_view x, std::string_view y);

/// The place of the column with the numbers of lines, which is known by its name, such as line or
/// ring_id; the number of names if there is none.
std::size_t FindLineColumn(const Words& names);

/// Names in quotes, such as "'time', 'intensity'", but no more than ten.
std::string Quoted(const Words& names);

}

#endif
