// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Formats.h"
#include "InputFile.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>

/// @file
/// .obj: a line of text for each vertex (v), polygon (f), line (l) and point (p). Of the corners of
/// polygons only the vertex is taken, so points are never split along the seam of a texture.

namespace delaunayflip
{

namespace
{

class ObjReader
{
public:
  explicit ObjReader(const InputFile& file)
    : Lines(file, true)
  {
    this->Points->SetNumberOfComponents(3);
    this->Colors->SetNumberOfComponents(3);
    this->Colors->SetName("Colors");
    while (this->Lines.Next())
    {
      this->ReadLine(std::string(this->Lines.Words[0]));
    }
  }

  FileMesh Assemble(const std::string& name)
  {
    FileMesh result;
    result.Mesh->SetPoints(vtkNew<vtkPoints>());
    result.Mesh->GetPoints()->SetData(this->Points);
    result.Mesh->SetVerts(this->Cells[0]);
    result.Mesh->SetLines(this->Cells[1]);
    result.Mesh->SetPolys(this->Cells[2]);
    const vtkIdType colors = this->Colors->GetNumberOfTuples();
    if (colors > 0 && colors == this->Points->GetNumberOfTuples())
    {
      result.Mesh->GetPointData()->AddArray(this->Colors);
    }
    else if (colors > 0)
    {
      this->LeftOut["colors"] = colors;
    }
    std::string list;
    for (const auto& [what, count] : this->LeftOut)
    {
      list += (list.empty() ? ": left out " : ", ") + what + " (" + std::to_string(count) + ")";
    }
    result.Warnings.resize(list.empty() ? 0 : 1, name + list);
    return result;
  }

private:
  void ReadLine(const std::string& keyword)
  {
    if (keyword == "v")
    {
      this->ReadVertex();
    }
    else if (keyword == "p" || keyword == "l" || keyword == "f")
    {
      this->ReadCell(keyword == "p" ? 1 : keyword == "l" ? 2 : 3);
    }
    else if (std::all_of(keyword.begin(), keyword.end(),
               [](unsigned char letter) { return std::isalnum(letter) || letter == '_'; }))
    {
      ++this->LeftOut[keyword];
    }
    else
    {
      this->Lines.Fail("not a line of an OBJ file");
    }
  }

  /// A vertex may have a color after its coordinates.
  void ReadVertex()
  {
    const std::size_t count = std::max<std::size_t>(this->Lines.Words.size() - 1, 3);
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto value = this->Lines.Number<double>(i + 1);
      if (i < 3 || count == 6)
      {
        (i < 3 ? this->Points : this->Colors)->InsertNextValue(value);
      }
      else
      {
        ++this->LeftOut["weights"];
      }
    }
  }

  void ReadCell(std::size_t fewest)
  {
    const std::size_t corners = this->Lines.Words.size() - 1;
    if (corners < fewest)
    {
      this->Lines.Fail("fewer than " + std::to_string(fewest) + " corners");
    }
    this->Cells[fewest - 1]->InsertNextCell(static_cast<int>(corners));
    for (std::size_t i = 1; i <= corners; ++i)
    {
      this->Cells[fewest - 1]->InsertCellPoint(this->ReadCorner(this->Lines.Words[i]));
    }
  }

  /// vertex, vertex/texture, vertex/texture/normal or vertex//normal.
  std::int64_t ReadCorner(std::string_view word) const
  {
    std::int64_t index = 0;
    if (ReadNumber(word.substr(0, word.find('/')), index) != std::errc() ||
      word.find_first_not_of("+-0123456789/") != word.npos)
    {
      this->Lines.FailOn(word, " is not an index");
    }
    // In the file, index 1 is the first vertex, even of a later line, and -1 the last one so far.
    const std::int64_t seen = this->Points->GetNumberOfTuples();
    if (index == 0 || index < -seen)
    {
      this->Lines.Fail("index " + std::to_string(index) + " is out of range");
    }
    return index < 0 ? seen + index : index - 1;
  }

  TextLines Lines;
  vtkNew<vtkDoubleArray> Points;
  vtkNew<vtkDoubleArray> Colors;
  std::array<vtkNew<vtkCellArray>, 3> Cells; ///< Of one, two, and more points.
  std::map<std::string, std::int64_t> LeftOut;
};

/// The colors of points: an array Colors, or three bytes.
vtkDataArray* FindColors(vtkPointData* data)
{
  vtkDataArray* const named = data->GetArray("Colors");
  for (vtkDataArray* array : { data->GetScalars(), data->GetArray("RGB"), named })
  {
    const bool isColor = array && array->GetNumberOfComponents() == 3;
    if (isColor && (array == named || array->GetDataType() == VTK_UNSIGNED_CHAR))
    {
      return array;
    }
  }
  return nullptr;
}

template <typename T>
void PutNumber(std::ostream& out, T number)
{
  char text[32] = { ' ' };
  const char* const end = std::to_chars(text + 1, text + sizeof(text), number).ptr;
  out.write(text, end - text);
}

}

FileMesh ReadObj(const InputFile& file) { return ObjReader(file).Assemble(file.GetName()); }

void WriteObj(vtkPolyData* mesh, const std::string& path)
{
  std::ofstream out(path, std::ios::binary);
  out << "# written by delaunay-flip\n";
  vtkDataArray* const colors = FindColors(mesh->GetPointData());
  const double unit = colors && colors->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    out << 'v';
    for (int i = 0; i < (colors ? 6 : 3); ++i)
    {
      PutNumber(out, i < 3 ? mesh->GetPoint(point)[i] : colors->GetComponent(point, i - 3) / unit);
    }
    out << '\n';
  }
  const std::pair<char, vtkCellArray*> kinds[] = { { 'p', mesh->GetVerts() },
    { 'l', mesh->GetLines() }, { 'f', mesh->GetPolys() } };
  for (const auto& [keyword, cells] : kinds)
  {
    ForEachCell(cells,
      [&out, keyword = keyword](vtkIdType size, const vtkIdType* points)
      {
        out << keyword;
        std::for_each(
          points, points + size, [&out](vtkIdType point) { PutNumber(out, point + 1); });
        out << '\n';
      });
  }
}

std::vector<vtkAbstractArray*> ArraysOfObj(vtkPolyData* mesh)
{
  return { FindColors(mesh->GetPointData()) };
}

}
