// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CellLabels.h"
#include "Formats.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

/// @file
/// .stl, binary or text. VTK's reader would round text to single precision, drop triangles that
/// collapse, and take a truncated file for a whole one.

namespace delaunayflip
{

namespace
{

constexpr std::size_t BodyBegin = 84; // behind 80 bytes of any content and the number of triangles
constexpr std::size_t TriangleSize = 50; // a normal, three points and two bytes of attributes

/// A mesh that is given corner by corner. Corners in the same place are one point.
class CornerMesh
{
public:
  explicit CornerMesh(int type) { this->Points->SetDataType(type); }

  void Add(std::array<double, 3> place)
  {
    const vtkIdType point = this->Places.Number(place);
    if (point == this->Points->GetNumberOfPoints())
    {
      this->Points->InsertNextPoint(place.data());
    }
    if (this->Corners++ % 3 == 0)
    {
      this->Triangles->InsertNextCell(3);
    }
    this->Triangles->InsertCellPoint(point);
  }

  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Triangles;

private:
  PlaceNumbers Places;
  std::int64_t Corners = 0;
};

void ReadBinary(std::string_view bytes, CornerMesh& mesh, FileMesh& result)
{
  bool hasAttributes = false;
  for (std::size_t begin = BodyBegin; begin < bytes.size(); begin += TriangleSize)
  {
    std::array<float, 12> numbers; // the normal comes first
    std::memcpy(numbers.data(), bytes.data() + begin, sizeof(numbers));
    for (std::size_t corner = 3; corner < numbers.size(); corner += 3)
    {
      mesh.Add({ numbers[corner], numbers[corner + 1], numbers[corner + 2] });
    }
    hasAttributes =
      hasAttributes || bytes.substr(begin + sizeof(numbers), 2) != std::string_view("\0\0", 2);
  }
  if (hasAttributes)
  {
    result.Warnings.emplace_back("left out the attribute bytes of triangles");
  }
}

/// The keyword of a line, in lower case: "endloop" of "end loop", too.
std::string KeywordOf(const std::vector<std::string_view>& words)
{
  std::string keyword(words[0]);
  std::transform(keyword.begin(), keyword.end(), keyword.begin(), ::tolower);
  if (keyword == "end" && words.size() > 1)
  {
    std::string what(words[1]);
    std::transform(what.begin(), what.end(), what.begin(), ::tolower);
    keyword += what;
  }
  return keyword;
}

/// Where there are several solids, they become labels.
void ReadText(const InputFile& file, CornerMesh& mesh, FileMesh& result)
{
  constexpr const char* Facet[] = { "facet", "outer", "vertex", "vertex", "vertex", "endloop",
    "endfacet" };
  TextLines lines(file);
  CellLabels labels("Solid");
  int solids = 0;
  bool isOpen = false;
  std::size_t place = 0; // in a facet
  while (lines.Next())
  {
    const std::string keyword = KeywordOf(lines.Words);
    if (place == 0 && keyword == (isOpen ? "endsolid" : "solid"))
    {
      isOpen = !isOpen;
      if (isOpen)
      {
        ++solids;
        const auto& words = lines.Words;
        labels.SetNew(
          JoinWords(std::vector<std::string_view>(words.begin() + 1, words.end()), " "));
      }
      continue;
    }
    if (!isOpen || keyword != Facet[place])
    {
      lines.Fail("not a line of an STL file, or out of place, or a facet without three vertices");
    }
    if (keyword == "vertex")
    {
      mesh.Add({ lines.Number<double>(1), lines.Number<double>(2), lines.Number<double>(3) });
    }
    place = (place + 1) % std::size(Facet);
    if (place == 0)
    {
      labels.AddCell(2);
    }
  }
  if (isOpen || solids == 0)
  {
    file.Fail("has no 'endsolid' (truncated or corrupt)");
  }
  if (solids > 1)
  {
    labels.Store(result);
  }
}

}

FileMesh ReadStl(const InputFile& file)
{
  const std::string_view bytes = file.GetBytes();
  std::uint32_t triangles = 0;
  if (bytes.size() >= BodyBegin)
  {
    std::memcpy(&triangles, bytes.data() + BodyBegin - sizeof(triangles), sizeof(triangles));
  }
  const std::size_t expected = BodyBegin + TriangleSize * triangles;
  const bool isBinary = bytes.size() == expected;
  if (!isBinary && bytes.size() >= BodyBegin && bytes.find('\0') != std::string_view::npos)
  {
    file.Fail("its header says " + Counted(triangles, "triangle") + ", which take " +
      std::to_string(expected) + " bytes, but it has " + std::to_string(bytes.size()) +
      " (truncated or corrupt)");
  }
  CornerMesh mesh(isBinary ? VTK_FLOAT : VTK_DOUBLE);
  FileMesh result;
  if (isBinary)
  {
    ReadBinary(bytes, mesh, result);
  }
  else
  {
    ReadText(file, mesh, result);
  }
  result.Mesh->SetPoints(mesh.Points);
  result.Mesh->SetPolys(mesh.Triangles);
  return result;
}

}
