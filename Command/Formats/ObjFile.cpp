// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CommandError.h"
#include "Formats.h"
#include "InputFile.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>

/// @file
/// .obj: a line of text for each vertex (v), texture coordinate (vt), normal (vn), polygon (f),
/// line (l) and point (p).

namespace delaunayflip
{

namespace
{

/// The numbers of a vertex, its texture coordinates and its normal, from 0; -1 for none.
using Corner = std::array<std::int64_t, 3>;

constexpr std::array<int, 3> Components = { 3, 2, 3 };

vtkSmartPointer<vtkDoubleArray> MakeVectors(
  const char* name, const std::vector<double>& values, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

class ObjReader
{
public:
  explicit ObjReader(const InputFile& file)
    : File(file),
      Lines(file, '#')
  {
    TextLines all(file, '#'); // indices may refer to later lines
    all.ContinueLines();
    while (all.Next())
    {
      const std::string_view keyword = all.Words[0];
      ++this->Sizes[keyword == "v" ? 0 : keyword == "vt" ? 1 : keyword == "vn" ? 2 : 3];
    }
    this->Lines.ContinueLines();
    while (this->Lines.Next())
    {
      this->ReadLine();
    }
  }

  FileMesh Assemble()
  {
    FileMesh result;
    const vtkNew<vtkPoints> points;
    points->SetData(MakeVectors("Points", this->Values[0], 3));
    result.Mesh->SetPoints(points);
    result.Mesh->SetVerts(this->Cells[0]);
    result.Mesh->SetLines(this->Cells[1]);
    result.Mesh->SetPolys(this->Cells[2]);
    vtkPointData* const data = result.Mesh->GetPointData();
    if (!this->Colors.empty() && this->Colors.size() == this->Values[0].size())
    {
      data->AddArray(MakeVectors("Colors", this->Colors, 3));
    }
    else if (!this->Colors.empty())
    {
      this->LeftOut["colors"] = static_cast<std::int64_t>(this->Colors.size() / 3);
    }
    data->SetTCoords(this->OfPoints(1, "TCoords"));
    data->SetNormals(this->OfPoints(2, "Normals"));
    std::string list;
    for (const auto& [what, count] : this->LeftOut)
    {
      list += (list.empty() ? "" : ", ") + what + " (" + std::to_string(count) + ")";
    }
    if (!list.empty())
    {
      result.Warnings.push_back(this->File.GetName() + ": left out " + list);
    }
    return result;
  }

private:
  void ReadLine()
  {
    const std::string keyword(this->Lines.Words[0]);
    if (keyword == "v")
    {
      this->ReadVertex();
    }
    else if (keyword == "vt" || keyword == "vn")
    {
      const bool isTexture = keyword == "vt";
      for (std::size_t i = 1; i <= 3; ++i)
      {
        const bool isGiven = !isTexture || i == 1 || i < this->Lines.Words.size();
        const double value = isGiven ? this->Lines.Number<double>(i) : 0.0;
        if (!isTexture || i < 3)
        {
          this->Values[isTexture ? 1 : 2].push_back(value);
        }
        else if (value != 0.0)
        {
          ++this->LeftOut["third coordinates of vt"];
        }
      }
    }
    else if (keyword == "p" || keyword == "l" || keyword == "f")
    {
      this->ReadCell(keyword == "p" ? 1 : keyword == "l" ? 2 : 3);
    }
    else
    {
      const bool isWord = std::all_of(keyword.begin(), keyword.end(),
        [](unsigned char letter) { return std::isalnum(letter) || letter == '_'; });
      if (!isWord)
      {
        this->Lines.Fail("not a line of an OBJ file");
      }
      ++this->LeftOut[keyword];
    }
  }

  /// x y z, then perhaps a weight, then perhaps a color.
  void ReadVertex()
  {
    const std::size_t count = this->Lines.Words.size() - 1;
    if (count < 3 || count == 5 || count > 7)
    {
      this->Lines.Fail("a vertex has three coordinates, perhaps a weight, and perhaps a color");
    }
    for (std::size_t i = 1; i <= count; ++i)
    {
      const auto value = this->Lines.Number<double>(i);
      if (i <= 3)
      {
        this->Values[0].push_back(value);
      }
      else if (count >= 6 && i > count - 3)
      {
        this->Colors.push_back(value);
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
    vtkCellArray* const cells = this->Cells[fewest - 1];
    cells->InsertNextCell(static_cast<int>(corners));
    for (std::size_t i = 1; i <= corners; ++i)
    {
      const Corner corner = this->ReadCorner(this->Lines.Words[i]);
      cells->InsertCellPoint(corner[0]);
      if (fewest == 3)
      {
        this->Corners.push_back(corner);
      }
    }
  }

  /// vertex, vertex/texture, vertex/texture/normal or vertex//normal.
  Corner ReadCorner(std::string_view word)
  {
    Corner corner = { -1, -1, -1 };
    const char* here = word.data();
    const char* const end = here + word.size();
    for (std::size_t kind = 0; kind < corner.size(); ++kind)
    {
      const auto seen = static_cast<std::int64_t>(this->Values[kind].size()) / Components[kind];
      std::int64_t index = 0;
      const auto [next, error] = std::from_chars(here, end, index);
      const bool isLeftOut = kind > 0 && (here == end || *here == '/');
      if (!isLeftOut && (error != std::errc() || (next != end && *next != '/')))
      {
        break;
      }
      // In the file, index 1 is the first element, and -1 the last one before this line.
      if (!isLeftOut && (index == 0 || index < -seen || index > this->Sizes[kind]))
      {
        this->Lines.Fail("index " + std::to_string(index) + " is out of range");
      }
      corner[kind] = isLeftOut ? -1 : index < 0 ? seen + index : index - 1;
      here = isLeftOut ? here : next;
      if (here == end)
      {
        return corner;
      }
      ++here; // the slash
    }
    this->Lines.FailOn(word, " is not an index");
  }

  /// Adds the texture coordinates (kind 1) or normals (kind 2) to the points, zeros where no
  /// polygon has the point. If a corner has none, or two at a point differ, all are left out.
  vtkSmartPointer<vtkDoubleArray> OfPoints(std::size_t kind, const char* name)
  {
    const std::vector<double>& values = this->Values[kind];
    const int size = Components[kind];
    const auto points = static_cast<std::size_t>(this->Sizes[0]);
    std::vector<double> ofPoints(points * size);
    std::vector<bool> isKnown(points);
    bool agree = true;
    for (std::size_t i = 0; i < this->Corners.size() && agree; ++i)
    {
      const Corner& corner = this->Corners[i];
      const auto value = values.begin() + size * std::max<std::int64_t>(corner[kind], 0);
      const auto place = ofPoints.begin() + size * corner[0];
      agree = corner[kind] >= 0 && (!isKnown[corner[0]] || std::equal(value, value + size, place));
      if (agree)
      {
        std::copy(value, value + size, place);
        isKnown[corner[0]] = true;
      }
    }
    if (!values.empty() && !agree)
    {
      this->LeftOut[kind == 1 ? "vt" : "vn"] = this->Sizes[kind];
    }
    return values.empty() || !agree ? nullptr : MakeVectors(name, ofPoints, size);
  }

  const InputFile& File;
  TextLines Lines;
  std::array<std::int64_t, 4> Sizes = {}; ///< How many v, vt, vn and other lines there are.
  std::array<std::vector<double>, 3> Values; ///< Of v, vt and vn.
  std::vector<double> Colors; ///< 3 each.
  std::array<vtkNew<vtkCellArray>, 3> Cells; ///< Of one, two, and more points.
  std::vector<Corner> Corners; ///< Of polygons.
  std::map<std::string, std::int64_t> LeftOut;
};

vtkDataArray* WithComponents(vtkDataArray* array, int fewest, int most)
{
  const int components = array ? array->GetNumberOfComponents() : 0;
  return components >= fewest && components <= most ? array : nullptr;
}

/// The colors of points: an array Colors, or three bytes.
vtkDataArray* FindColors(vtkPointData* data)
{
  for (vtkDataArray* array : { data->GetScalars(), data->GetArray("RGB") })
  {
    if (WithComponents(array, 3, 3) && array->GetDataType() == VTK_UNSIGNED_CHAR)
    {
      return array;
    }
  }
  return WithComponents(data->GetArray("Colors"), 3, 3);
}

template <typename T>
void PutNumber(std::ostream& out, T number, char before)
{
  char text[32] = { before };
  const char* const end = std::to_chars(text + 1, text + sizeof(text), number).ptr;
  out.write(text, end - text);
}

}

FileMesh ReadObj(const InputFile& file) { return ObjReader(file).Assemble(); }

void WriteObj(vtkPolyData* mesh, const std::string& path)
{
  std::ofstream out(path, std::ios::binary);
  out << "# written by delaunay-flip\n";
  vtkPointData* const data = mesh->GetPointData();
  vtkDataArray* const colors = FindColors(data);
  const auto put = [&out](vtkDataArray* array, vtkIdType tuple)
  {
    const double scale = array->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      PutNumber(out, array->GetComponent(tuple, component) / scale, ' ');
    }
  };
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    out << 'v';
    put(mesh->GetPoints()->GetData(), point);
    if (colors)
    {
      put(colors, point);
    }
    out << '\n';
  }
  vtkDataArray* const texture = WithComponents(data->GetTCoords(), 1, 3);
  vtkDataArray* const normals = WithComponents(data->GetNormals(), 3, 3);
  for (vtkDataArray* array : { texture, normals })
  {
    for (vtkIdType tuple = 0; array && tuple < mesh->GetNumberOfPoints(); ++tuple)
    {
      out << (array == texture ? "vt" : "vn");
      put(array, tuple);
      out << '\n';
    }
  }
  for (vtkCellArray* cells : { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys() })
  {
    const bool isPolygons = cells == mesh->GetPolys();
    ForEachCell(cells,
      [&](vtkIdType size, const vtkIdType* points)
      {
        out << (isPolygons ? 'f' : cells == mesh->GetLines() ? 'l' : 'p');
        for (vtkIdType i = 0; i < size; ++i)
        {
          PutNumber(out, points[i] + 1, ' ');
          if (isPolygons && texture)
          {
            PutNumber(out, points[i] + 1, '/');
          }
          if (isPolygons && normals)
          {
            out << (texture ? "" : "/");
            PutNumber(out, points[i] + 1, '/');
          }
        }
        out << '\n';
      });
  }
  out.close();
  if (!out)
  {
    throw CommandError(ExitCode::BadFile, "the file is incomplete");
  }
}

std::vector<vtkAbstractArray*> ArraysOfObj(vtkPolyData* mesh)
{
  vtkPointData* const data = mesh->GetPointData();
  return { FindColors(data), WithComponents(data->GetTCoords(), 1, 3),
    WithComponents(data->GetNormals(), 3, 3) };
}

}
