// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StlReader.h"

#include "Counted.h"
#include "FileValues.h"
#include "MergePoints.h"
#include "TextCursor.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace delaunayflip
{

namespace
{

constexpr std::size_t HeadSize = 80;
constexpr std::size_t BodyBegin = HeadSize + 4;
constexpr std::size_t TriangleSize = 50;

/// Every three points are a triangle.
void AttachTriangles(vtkPolyData* mesh, vtkDataArray* coordinates)
{
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  mesh->SetPoints(points);
  vtkNew<vtkIdTypeArray> corners;
  corners->SetNumberOfValues(coordinates->GetNumberOfTuples());
  std::iota(corners->GetPointer(0), corners->GetPointer(0) + corners->GetNumberOfValues(), 0);
  vtkNew<vtkIdTypeArray> offsets;
  offsets->SetNumberOfValues(coordinates->GetNumberOfTuples() / 3 + 1);
  for (vtkIdType i = 0; i < offsets->GetNumberOfValues(); ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, corners);
  mesh->SetPolys(triangles);
}

/// The number of triangles according to the header of a binary file.
std::uint32_t AnnouncedTriangles(const InputFile& file)
{
  return BinaryValues<false>(file, HeadSize).Next<std::uint32_t>();
}

bool IsBinary(const InputFile& file)
{
  const std::size_t size = file.GetBytes().size();
  return size >= BodyBegin && size == BodyBegin + TriangleSize * AnnouncedTriangles(file);
}

void ReadBinary(const InputFile& file, vtkPolyData* mesh)
{
  const vtkIdType triangles = AnnouncedTriangles(file);
  vtkNew<vtkFloatArray> points;
  points->SetNumberOfComponents(3);
  points->SetNumberOfTuples(3 * triangles);
  vtkNew<vtkUnsignedShortArray> attributes;
  attributes->SetName("Attributes");
  attributes->SetNumberOfValues(triangles);
  BinaryValues<false> values(file, BodyBegin);
  float* coordinate = points->GetPointer(0);
  bool hasAttributes = false;
  for (vtkIdType triangle = 0; triangle < triangles; ++triangle)
  {
    for (int number = 0; number < 12; ++number)
    {
      const auto value = values.Next<float>();
      *coordinate = value;
      coordinate += number < 3 ? 0 : 1; // the normal comes first
    }
    attributes->SetValue(triangle, values.Next<std::uint16_t>());
    hasAttributes = hasAttributes || attributes->GetValue(triangle) != 0;
  }
  AttachTriangles(mesh, points);
  if (hasAttributes)
  {
    mesh->GetCellData()->AddArray(attributes);
  }
}

class StlText
{
public:
  explicit StlText(const InputFile& file)
    : File(file),
      Cursor(file)
  {
  }

  void Read(vtkPolyData* mesh)
  {
    for (this->Cursor.SkipSpace(); !this->Cursor.IsAtEnd(); this->Cursor.SkipSpace())
    {
      this->ReadStatement(this->NextKeyword());
    }
    if (this->IsOpen || this->Names.empty())
    {
      this->File.Fail("has no 'endsolid' (truncated or corrupt)");
    }
    this->Assemble(mesh);
  }

private:
  std::string NextKeyword()
  {
    this->Cursor.SkipSpace();
    std::string word(this->Cursor.NextWord());
    std::transform(word.begin(), word.end(), word.begin(),
      [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return word;
  }

  void ReadStatement(const std::string& keyword)
  {
    if (keyword == "vertex")
    {
      this->ReadVertex();
    }
    else if (keyword == "facet")
    {
      this->ReadFacet();
    }
    else if (keyword == "endloop" || keyword == "endfacet")
    {
      this->Require(this->FacetPoints == 3, "a facet with fewer than three vertices");
    }
    else if (keyword == "solid" || keyword == "endsolid")
    {
      this->ReadSolid(keyword == "solid");
    }
    else
    {
      this->Require(
        keyword == "outer" && this->NextKeyword() == "loop", "not a line of an STL file");
    }
  }

  void ReadVertex()
  {
    this->Require(this->FacetPoints < 3, "a facet with more than three vertices");
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Coordinates.push_back(this->Cursor.NextNumber<double>());
    }
    ++this->FacetPoints;
  }

  /// The normal is not used, so it may be anything.
  void ReadFacet()
  {
    this->Require(this->IsOpen, "a facet outside a solid");
    this->Require(this->FacetPoints == 3, "a facet with fewer than three vertices");
    this->Require(this->NextKeyword() == "normal", "a facet without a normal");
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Require(!this->Cursor.NextWord().empty(), "a normal with fewer than three numbers");
    }
    this->FacetPoints = 0;
    this->Solids.push_back(static_cast<int>(this->Names.size()) - 1);
  }

  void ReadSolid(bool begins)
  {
    this->Require(
      this->IsOpen != begins, begins ? "a solid within a solid" : "'endsolid' without 'solid'");
    this->Require(this->FacetPoints == 3, "a facet with fewer than three vertices");
    const std::string name = this->Cursor.RestOfLine();
    this->IsOpen = begins;
    if (begins)
    {
      this->Names.push_back(name);
    }
  }

  void Require(bool holds, const char* problem) const
  {
    if (!holds)
    {
      this->Cursor.Fail(problem);
    }
  }

  void Assemble(vtkPolyData* mesh) const
  {
    vtkNew<vtkDoubleArray> points;
    points->SetNumberOfComponents(3);
    points->SetNumberOfTuples(static_cast<vtkIdType>(this->Coordinates.size() / 3));
    std::copy(this->Coordinates.begin(), this->Coordinates.end(), points->GetPointer(0));
    AttachTriangles(mesh, points);
    if (this->Names.size() > 1)
    {
      this->AttachSolids(mesh);
    }
  }

  void AttachSolids(vtkPolyData* mesh) const
  {
    vtkNew<vtkIntArray> ids;
    ids->SetName("SolidIds");
    ids->SetNumberOfValues(static_cast<vtkIdType>(this->Solids.size()));
    std::copy(this->Solids.begin(), this->Solids.end(), ids->GetPointer(0));
    mesh->GetCellData()->AddArray(ids);
    vtkNew<vtkStringArray> names;
    names->SetName("SolidNames");
    for (const std::string& name : this->Names)
    {
      names->InsertNextValue(name);
    }
    mesh->GetFieldData()->AddArray(names);
  }

  const InputFile& File;
  TextCursor Cursor;
  std::vector<double> Coordinates;
  std::vector<int> Solids; ///< Of each facet.
  std::vector<std::string> Names;
  int FacetPoints = 3; ///< Of the facet being read.
  bool IsOpen = false; ///< Within a solid.
};

/// Why a file is neither a binary nor a text .stl.
void RequireText(const InputFile& file)
{
  const std::string_view bytes = file.GetBytes();
  const bool isText = bytes.find('\0') == std::string_view::npos;
  if (!isText && bytes.size() >= BodyBegin)
  {
    const std::int64_t triangles = AnnouncedTriangles(file);
    file.Fail("its header says " + Counted(triangles, "triangle") + ", which take " +
      std::to_string(BodyBegin + TriangleSize * static_cast<std::size_t>(triangles)) +
      " bytes, but it has " + std::to_string(bytes.size()) + " (truncated or corrupt)");
  }
  if (!isText || bytes.empty())
  {
    file.Fail("too short for an STL file");
  }
}

}

FileMesh ReadStl(const InputFile& file)
{
  FileMesh result;
  if (IsBinary(file))
  {
    ReadBinary(file, result.Mesh);
  }
  else
  {
    RequireText(file);
    StlText(file).Read(result.Mesh);
  }
  MergeCoincidentPoints(result.Mesh);
  return result;
}

}
