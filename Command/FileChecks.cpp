// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileChecks.h"

#include "CommandError.h"

#include <vtksys/SystemTools.hxx>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace delaunayflip
{

namespace
{

[[noreturn]] void Fail(const std::string& path, const std::string& reason)
{
  throw CommandError(ExitCode::BadFile, path + ": " + reason);
}

std::int64_t SizeOf(const std::string& path)
{
  return static_cast<std::int64_t>(std::filesystem::file_size(path));
}

}

void CheckStl(const std::string& path)
{
  // vtkSTLReader decides by the same test.
  if (vtksys::SystemTools::DetectFileType(path.c_str()) == vtksys::SystemTools::FileTypeText)
  {
    return;
  }
  std::array<unsigned char, 84> head = {};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(head.data()), head.size()))
  {
    Fail(path, "too short for a binary STL file");
  }
  std::int64_t triangles = 0;
  for (int byte = 3; byte >= 0; --byte)
  {
    triangles = 256 * triangles + head[80 + byte];
  }
  const std::int64_t wanted = 84 + 50 * triangles;
  if (SizeOf(path) != wanted)
  {
    Fail(path,
      "its header says " + std::to_string(triangles) + " triangles, which take " +
        std::to_string(wanted) + " bytes, but it has " + std::to_string(SizeOf(path)) +
        " (truncated or corrupt)");
  }
}

namespace
{

/// Evaluates one line of the header: an element and its count, or a property of that element.
void ReadPlyLine(std::istream& words, std::string& element, PlyHeader& header)
{
  std::string keyword;
  words >> keyword;
  if (keyword == "element")
  {
    std::int64_t count = -1;
    words >> element >> count;
    if (element == "vertex")
    {
      header.Vertices = count;
    }
    else if (element == "face")
    {
      header.Faces = count;
    }
  }
  else if (keyword == "property" && element == "vertex")
  {
    std::string type;
    std::string name;
    words >> type >> name;
    header.DoublePoints =
      header.DoublePoints || (name == "x" && (type == "double" || type == "float64"));
  }
}

}

PlyHeader CheckPly(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  if (line.substr(0, 3) != "ply")
  {
    Fail(path, "not a PLY file (it does not start with 'ply')");
  }
  PlyHeader header;
  std::string element;
  while (std::getline(file, line) && line.substr(0, 10) != "end_header")
  {
    std::istringstream words(line);
    ReadPlyLine(words, element, header);
  }
  if (!file)
  {
    Fail(path, "its header has no end (truncated or corrupt)");
  }
  // Every vertex and face takes at least a byte. VTK would trust any count and allocate for it.
  const std::int64_t body = SizeOf(path) - static_cast<std::int64_t>(file.tellg());
  if (header.Vertices < 0 || header.Faces < 0 || header.Vertices > body || header.Faces > body)
  {
    Fail(path,
      "its header says " + std::to_string(header.Vertices) + " vertices and " +
        std::to_string(header.Faces) + " faces, but only " + std::to_string(body) +
        " bytes follow (truncated or corrupt)");
  }
  return header;
}

namespace
{

/// Reads a .obj twice: counts what it defines, then checks its faces, lines and points.
class ObjScanner
{
public:
  explicit ObjScanner(const std::string& path)
    : Path(path)
  {
  }

  ObjSummary Scan()
  {
    this->ForEachLine([this](const std::string& keyword, std::istream&) { this->Count(keyword); });
    this->Total = this->Seen;
    this->Seen = ObjSummary();
    this->ForEachLine(
      [this](const std::string& keyword, std::istream& words)
      {
        this->Count(keyword);
        this->Judge(keyword, words);
      });
    return this->Total;
  }

private:
  template <typename Function>
  void ForEachLine(const Function& function)
  {
    std::ifstream file(this->Path);
    std::string line;
    for (this->Line = 1; std::getline(file, line); ++this->Line)
    {
      this->JoinContinued(file, line);
      std::istringstream words(line);
      std::string keyword;
      if (words >> keyword)
      {
        function(keyword, words);
      }
    }
  }

  /// A backslash at the end continues a line.
  void JoinContinued(std::istream& file, std::string& line)
  {
    std::string next;
    while (true)
    {
      const std::size_t last = line.find_last_not_of(" \t\r");
      if (last == std::string::npos || line[last] != '\\' || !std::getline(file, next))
      {
        return;
      }
      line = line.substr(0, last) + " " + next;
      ++this->Line;
    }
  }

  void Count(const std::string& keyword)
  {
    this->Seen.Vertices += keyword == "v";
    this->Seen.TextureCoordinates += keyword == "vt";
    this->Seen.Normals += keyword == "vn";
    this->Seen.Groups += keyword == "g";
  }

  void Judge(const std::string& keyword, std::istream& words)
  {
    if (keyword == "v")
    {
      this->JudgeVertex(words);
    }
    else if (keyword == "f" || keyword == "l" || keyword == "p")
    {
      this->JudgeCell(words, keyword == "f" ? 3 : keyword == "l" ? 2 : 1);
    }
  }

  void JudgeVertex(std::istream& words)
  {
    std::string coordinate;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(words >> coordinate))
      {
        this->FailHere("a vertex with fewer than three coordinates");
      }
    }
  }

  void JudgeCell(std::istream& words, int fewest)
  {
    int corners = 0;
    std::string corner;
    while (words >> corner && corner[0] != '#')
    {
      this->JudgeCorner(corner);
      ++corners;
    }
    if (corners < fewest)
    {
      this->FailHere("fewer than " + std::to_string(fewest) + " corners");
    }
  }

  /// A corner is vertex, vertex/texture, vertex/texture/normal or vertex//normal.
  void JudgeCorner(const std::string& corner)
  {
    const std::array<std::int64_t, 3> totals = { this->Total.Vertices,
      this->Total.TextureCoordinates, this->Total.Normals };
    const std::array<std::int64_t, 3> seen = { this->Seen.Vertices, this->Seen.TextureCoordinates,
      this->Seen.Normals };
    std::istringstream parts(corner);
    std::string part;
    for (int kind = 0; kind < 3 && std::getline(parts, part, '/'); ++kind)
    {
      if (kind == 0 || !part.empty())
      {
        this->JudgeIndex(part, totals[kind], seen[kind]);
      }
    }
  }

  /// Index 1 is the first element, -1 the last one before this line.
  void JudgeIndex(const std::string& text, std::int64_t total, std::int64_t seen)
  {
    std::istringstream number(text);
    std::int64_t index = 0;
    if (!(number >> index) || !number.eof())
    {
      this->FailHere("'" + text + "' is not an index");
    }
    if (index == 0 || index > total || index < -seen)
    {
      this->FailHere("index " + text + " is out of range");
    }
  }

  [[noreturn]] void FailHere(const std::string& reason) const
  {
    Fail(this->Path, "line " + std::to_string(this->Line) + ": " + reason);
  }

  std::string Path;
  std::int64_t Line = 0;
  ObjSummary Total;
  ObjSummary Seen;
};

}

ObjSummary CheckObj(const std::string& path) { return ObjScanner(path).Scan(); }

}
