// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HelpPage.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <vector>

namespace delaunayflip
{

namespace
{

/// Whether an unknown option asks for a smallest angle, in the words of other programs.
bool AsksForAngle(const std::string& word)
{
  std::string letters;
  for (const char letter : word.substr(0, word.find('=')))
  {
    if (letter != '-' && letter != '_')
    {
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
  }
  return word[0] == '-' && (letters == "minangle" || letters == "minimumangle");
}

}

std::string PlainFormatter::make_help(
  const CLI::App* app, std::string name, CLI::AppFormatMode) const
{
  std::string text =
    "Usage: " + name + " [OPTIONS] INPUT OUTPUT\n\n" + app->get_description() + "\n";
  for (const char* group :
    { ToRead, ToJudge, ToStay, OfPoints, ToRefine, ToAsk, ToRun, ToWrite, ToHelp })
  {
    text += std::string("\n") + group + ":\n";
    const auto isInGroup = [group](const CLI::Option* option)
    { return option->get_group() == group; };
    for (const CLI::Option* option : app->get_options(isInGroup))
    {
      text += Describe(*option);
    }
  }
  return text + "\n" + app->get_footer() + "\n";
}

std::string PlainFormatter::Describe(const CLI::Option& option)
{
  constexpr std::size_t Column = 28;
  constexpr std::size_t Width = 80;
  std::string line = "  " + option.get_name(option.get_positional(), true);
  if (!option.get_positional() && !option.get_type_name().empty())
  {
    line += " " + option.get_type_name();
  }
  std::string text;
  if (line.size() + 2 > Column)
  {
    text = line + '\n';
    line.clear();
  }
  line.resize(Column, ' ');
  std::istringstream words(option.get_description());
  for (std::string word; words >> word;)
  {
    if (line.size() > Column && line.size() + 1 + word.size() > Width)
    {
      text += line + '\n';
      line = std::string(Column, ' ');
    }
    if (line.size() > Column)
    {
      line += ' ';
    }
    line += word;
  }
  return text + line + '\n';
}

std::string DescribeCommand()
{
  return "Turns a triangle mesh into a Delaunay mesh by edge flips, or makes one from\n"
         "points. Points never move. Files: .vtk .vtp .ply .stl .obj, by extension; points\n"
         "and lines also .xyz .csv .txt .shp .gpkg .geojson .dxf .fgb. Defaults are in\n"
         "square brackets.\n\n"
         "Examples:\n"
         "  delaunay-flip scan.ply better.ply\n"
         "      flips a surface; edges sharper than 30 degrees stay\n"
         "  delaunay-flip terrain.vtp better.vtp --constraints roads.vtk\n"
         "      makes the lines in roads.vtk edges that stay\n"
         "  delaunay-flip basin.vtp fine.vtp --minimum-angle 28 --region-array zone\n"
         "      adds points for good angles, and keeps the borders of zones\n"
         "  delaunay-flip survey.csv terrain.vtp --from-points\n"
         "      makes a mesh from points alone\n"
         "  delaunay-flip shore.gpkg mesh.vtp --from-points --outline shore.gpkg \\\n"
         "      --minimum-angle 28 --maximum-area 500\n"
         "      fills an outline with good triangles\n"
         "  delaunay-flip survey.csv dem.tif --from-points --raster 1 --crs EPSG:25832\n"
         "      writes heights on a raster of 1 x 1 cells";
}

std::string DescribeExitCodes()
{
  return "Exit codes: 0 done; 2 wrong usage; 3 input unreadable or invalid, or output not\n"
         "writable; 4 iteration limit reached (output written); 5 the requested backend is\n"
         "not available; 129, 130, 131 or 143 ended by the signal HUP, INT (Ctrl-C), QUIT\n"
         "or TERM. With any code but 0 and 4 no file has been changed.\n";
}

std::string ExplainAngle(const CLI::App& app)
{
  const std::vector<std::string> words = app.remaining();
  const auto found = std::find_if(words.begin(), words.end(), AsksForAngle);
  if (found == words.end())
  {
    return "";
  }
  return found->substr(0, found->find('=')) +
    ": flips alone guarantee no smallest angle. They choose the best triangles for the points that "
    "are there. --minimum-angle adds points until no angle is smaller";
}

std::string SuggestOption(const CLI::App& app)
{
  constexpr std::ptrdiff_t Alike = 5; // letters, with the two dashes
  for (const std::string& word : app.remaining())
  {
    for (const CLI::Option* option : app.get_options())
    {
      const std::string name = option->get_name();
      const auto end = std::mismatch(word.begin(), word.end(), name.begin(), name.end()).first;
      if (name.rfind("--", 0) == 0 && end - word.begin() >= Alike)
      {
        return "; did you mean " + name + "?";
      }
    }
  }
  return "";
}

}
