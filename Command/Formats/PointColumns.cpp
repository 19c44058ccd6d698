// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointColumns.h"

#include "CommandError.h"
#include "InputFile.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace delaunayflip
{

namespace
{

using Names = std::vector<std::string_view>;

/// Names of x and y that belong together, and the z that goes with them before all other heights.
struct ColumnFamily
{
  Names X, Y, Z;
};

const ColumnFamily Angles = { { "lon", "long", "longitude", "lng" }, { "lat", "latitude" }, {} };

/// Those that come first are taken first.
const ColumnFamily Families[] = {
  { { "x" }, { "y" }, { "z" } },
  { { "points0", "pointsx" }, { "points1", "pointsy" }, { "points2", "pointsz" } }, // of ParaView
  { { "xcoord", "xcoordinate", "coordx", "pointx", "posx", "xpos" },
    { "ycoord", "ycoordinate", "coordy", "pointy", "posy", "ypos" },
    { "zcoord", "zcoordinate", "coordz", "pointz", "posz", "zpos" } },
  { { "easting", "eastings", "east", "utmeasting", "utme", "utmx", "rechtswert" },
    { "northing", "northings", "north", "utmnorthing", "utmn", "utmy", "hochwert" }, {} },
  Angles,
  { { "e" }, { "n" }, { "z", "u" } },
};

/// Without letters that are not ASCII: "hhe" is the German word with its umlaut.
const Names Heights = { "z", "zcoord", "zcoordinate", "coordz", "pointz", "elevation", "elev",
  "ele", "height", "hgt", "h", "altitude", "alt", "hoehe", "hhe", "hauteur", "quota", "cota" };

std::string Lower(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return lower;
}

/// A name without its unit, as letters of lower case and digits: "points0" of "Points:0", "easting"
/// of "Easting (m)", "z" of "Z_m".
std::string Simplified(std::string_view name)
{
  std::string lower = Lower(name.substr(0, name.find_first_of("([")));
  const std::size_t last = lower.find_last_of("_ ");
  if (last != lower.npos)
  {
    const std::string unit = lower.substr(last + 1);
    const bool isUnit = unit == "m" || unit == "ft" || unit == "km" || unit == "deg";
    if (isUnit)
    {
      lower.resize(last);
    }
  }
  const auto isOther = [](unsigned char letter) { return !std::isalnum(letter); };
  lower.erase(std::remove_if(lower.begin(), lower.end(), isOther), lower.end());
  return lower;
}

/// The place of the first of these names that is there, else the number of names.
std::size_t FindOneOf(const Names& wanted, const std::vector<std::string>& names)
{
  for (const std::string_view name : wanted)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
    {
      return static_cast<std::size_t>(found - names.begin());
    }
  }
  return names.size();
}

/// The number that a word is, from 1; 0 if it is none.
std::size_t ColumnNumber(std::string_view word)
{
  std::size_t number = 0;
  return ReadNumber(word, number) == std::errc() ? number : 0;
}

}

ChosenColumns::ChosenColumns(const std::string& list)
{
  std::istringstream words(list + ","); // else nothing would follow a comma at the end
  for (std::string word; !list.empty() && std::getline(words, word, ',');)
  {
    const std::size_t begin = std::min(word.find_first_not_of(' '), word.size());
    this->Columns.push_back(word.substr(begin, word.find_last_not_of(' ') + 1 - begin));
  }
}

std::string ChosenColumns::FindFault() const
{
  const std::size_t count = this->Columns.size();
  const std::set<std::string> different(this->Columns.begin(), this->Columns.end());
  if (count < 2 || count > 3 || different.size() < count || different.count("") > 0)
  {
    return "two or three different columns, x, y and perhaps z, are separated by commas: x,y,z "
           "or 2,3,4";
  }
  return "";
}

bool ChosenColumns::AreNumbers() const
{
  const auto isNumber = [](const std::string& column) { return ColumnNumber(column) > 0; };
  return !this->IsEmpty() && std::all_of(this->Columns.begin(), this->Columns.end(), isNumber);
}

Places ChosenColumns::Find(const Words& names) const
{
  Places places;
  bool areAllNames = true;
  for (const std::string& column : this->Columns)
  {
    auto found = std::find(names.begin(), names.end(), column);
    if (found == names.end())
    {
      found = std::find_if(names.begin(), names.end(),
        [&column](std::string_view name) { return Lower(name) == Lower(column); });
    }
    const std::size_t number = ColumnNumber(column);
    const bool isName = found != names.end();
    if (!isName && number == 0)
    {
      return {};
    }
    areAllNames = areAllNames && isName;
    if (isName)
    {
      places.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    else
    {
      places.push_back(number - 1);
    }
  }
  if (this->AreNumbers() && !areAllNames)
  {
    std::transform(this->Columns.begin(), this->Columns.end(), places.begin(),
      [](const std::string& column) { return ColumnNumber(column) - 1; });
  }
  return places;
}

std::size_t FindLineColumn(const Words& names)
{
  std::vector<std::string> simple(names.size());
  std::transform(names.begin(), names.end(), simple.begin(), Simplified);
  return FindOneOf({ "line", "lineid", "lineno", "linenumber", "polyline", "ring", "ringid",
                     "ringno", "ringnumber" },
    simple);
}

Places FindKnownColumns(const Words& names)
{
  std::vector<std::string> simple(names.size());
  std::transform(names.begin(), names.end(), simple.begin(), Simplified);
  const std::size_t none = names.size();
  for (const ColumnFamily& family : Families)
  {
    const std::size_t x = FindOneOf(family.X, simple);
    const std::size_t y = FindOneOf(family.Y, simple);
    if (x < none && y < none)
    {
      std::size_t z = FindOneOf(family.Z, simple);
      if (z == none)
      {
        z = FindOneOf(Heights, simple);
      }
      return z < none ? Places{ x, y, z } : Places{ x, y };
    }
  }
  return {};
}

bool AreAngles(std::string_view x, std::string_view y)
{
  return FindOneOf(Angles.X, { Simplified(x) }) == 0 && FindOneOf(Angles.Y, { Simplified(y) }) == 0;
}

std::string Quoted(const Words& names)
{
  constexpr std::size_t most = 10;
  std::vector<std::string> quoted;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
  {
    quoted.push_back("'" + std::string(names[i]) + "'");
  }
  const std::string text = JoinWords(quoted);
  return names.size() > most ? text + " and others" : text;
}

}
