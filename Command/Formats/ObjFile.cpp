// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CellLabels.h"
#include "Formats.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

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

// The lines with numbers: how many of them are kept, and what the others are.
constexpr const char* Keywords[] = { "v", "vt", "vn" };
constexpr int Components[] = { 3, 2, 3 };
constexpr const char* Others[] = { "weights", "third coordinates of vt",
  "further coordinates of vn" };

/// What the elements are called in messages.
constexpr const char* Elements[] = { "vertex (v)", "texture coordinate (vt)", "normal (vn)" };

/// The lines that label the cells after them, and the arrays of their labels.
constexpr const char* LabelKeywords[] = { "usemtl", "g", "o" };
constexpr const char* LabelArrays[] = { "Material", "Group", "Object" };

/// The lines of cells, in the order of the fewest points: one, two and three.
constexpr std::string_view CellKeywords = "plf";

/// The place of a word among the keywords; 3 for others.
std::size_t FindKind(std::string_view word)
{
  return std::find(std::begin(Keywords), std::end(Keywords), word) - std::begin(Keywords);
}

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
    : Lines(file, true)
  {
    for (TextLines all(file, true); all.Next();) // indices may refer to later lines
    {
      ++this->Sizes[FindKind(all.Words[0])];
    }
    while (this->Lines.Next())
    {
      this->ReadLine(std::string(this->Lines.Words[0]));
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
    for (const CellLabels& labels : this->Labels)
    {
      labels.Store(result);
    }
    for (const std::string& missing : this->Missing)
    {
      if (!missing.empty())
      {
        result.Warnings.push_back(missing);
      }
    }
    std::vector<std::string> losses;
    for (const auto& [what, count] : this->LeftOut)
    {
      losses.push_back(what + " (" + std::to_string(count) + ")");
    }
    if (!losses.empty())
    {
      result.Warnings.push_back("left out " + JoinWords(losses));
    }
    return result;
  }

private:
  void ReadLine(const std::string& keyword)
  {
    const std::size_t kind = FindKind(keyword);
    if (kind < this->Values.size())
    {
      this->ReadVector(kind);
    }
    else if (const std::size_t cell = CellKeywords.find(keyword);
             keyword.size() == 1 && cell != CellKeywords.npos)
    {
      this->ReadCell(cell + 1);
    }
    else if (const auto* const label =
               std::find(std::begin(LabelKeywords), std::end(LabelKeywords), keyword);
             label != std::end(LabelKeywords))
    {
      const auto& words = this->Lines.Words;
      this->Labels[label - LabelKeywords].Set(
        JoinWords(std::vector<std::string_view>(words.begin() + 1, words.end()), " "));
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

  /// A vertex may have a weight after its coordinates, and then a color. The second texture
  /// coordinate may be missing.
  void ReadVector(std::size_t kind)
  {
    const std::size_t count = this->Lines.Words.size() - 1;
    const std::size_t components = Components[kind];
    const bool isVertex = kind == 0;
    if (isVertex && (count == 5 || count > 7))
    {
      this->Lines.Fail("a vertex has three coordinates, perhaps a weight, and perhaps a color");
    }
    for (std::size_t i = 0; i < std::max(count, components); ++i)
    {
      const bool isMissing = kind == 1 && i > 0 && i >= count;
      double value = 0.0;
      if (!isMissing)
      {
        value = this->Lines.Number<double>(i + 1);
      }
      if (i < components)
      {
        this->Values[kind].push_back(value);
      }
      else if (isVertex && count >= 6 && i + 3 >= count)
      {
        this->Colors.push_back(value);
      }
      else if (isVertex || value != 0.0)
      {
        ++this->LeftOut[Others[kind]];
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
    for (CellLabels& labels : this->Labels)
    {
      labels.AddCell(fewest - 1);
    }
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
    std::string_view rest = word;
    for (std::size_t kind = 0; kind < corner.size(); ++kind)
    {
      const std::string_view text = rest.substr(0, rest.find('/'));
      const auto seen = static_cast<std::int64_t>(this->Values[kind].size()) / Components[kind];
      std::int64_t index = 0;
      if (kind == 0 || !text.empty())
      {
        if (ReadNumber(text, index) != std::errc())
        {
          break;
        }
        // In the file, index 1 is the first element, and -1 the last one before this line.
        const bool exists = index != 0 && index >= -seen && index <= this->Sizes[kind];
        if (exists)
        {
          corner[kind] = index < 0 ? seen + index : index - 1;
        }
        else
        {
          this->MissElement(kind, index);
        }
      }
      if (text.size() == rest.size())
      {
        return corner;
      }
      rest.remove_prefix(text.size() + 1); // and the slash
    }
    this->Lines.FailOn(word, " is not an index");
  }

  /// For an index of nothing. The mesh can do without texture coordinates and normals.
  void MissElement(std::size_t kind, std::int64_t index)
  {
    const std::string text = "index " + std::to_string(index) + " of a " + Elements[kind] +
      " is out of range: there are " + std::to_string(this->Sizes[kind]);
    if (kind == 0)
    {
      this->Lines.Fail(text);
    }
    if (this->Missing[kind].empty())
    {
      this->Missing[kind] = "line " + std::to_string(this->Lines.GetLine()) + ": " + text +
        "; read without " + Keywords[kind];
    }
  }

  /// Adds the texture coordinates (kind 1) or normals (kind 2) to the points, zeros where no
  /// polygon has the point. If there are no polygons, a corner has none, or two at a point differ,
  /// all are left out.
  vtkSmartPointer<vtkDoubleArray> OfPoints(std::size_t kind, const char* name)
  {
    const std::vector<double>& values = this->Values[kind];
    const int size = Components[kind];
    const auto points = static_cast<std::size_t>(this->Sizes[0]);
    std::vector<double> ofPoints(points * size);
    std::vector<bool> isKnown(points);
    bool agree = !this->Corners.empty();
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
    if (values.empty())
    {
      return nullptr;
    }
    if (!agree)
    {
      this->LeftOut[Keywords[kind]] = this->Sizes[kind];
      return nullptr;
    }
    return MakeVectors(name, ofPoints, size);
  }

  TextLines Lines;
  std::array<std::int64_t, 4> Sizes = {}; ///< How many v, vt, vn and other lines there are.
  std::array<std::vector<double>, 3> Values; ///< The numbers of v, vt and vn.
  std::vector<double> Colors; ///< 3 each.
  std::array<vtkNew<vtkCellArray>, 3> Cells; ///< Those with one, two, and more points.
  std::vector<Corner> Corners; ///< The corners of polygons.
  std::map<std::string, std::int64_t> LeftOut;
  std::array<std::string, 3> Missing; ///< Warnings of indices of nothing.
  std::array<CellLabels, 3> Labels = { CellLabels(LabelArrays[0]), CellLabels(LabelArrays[1]),
    CellLabels(LabelArrays[2]) };
};

/// The colors, texture coordinates and normals of points, as far as a .obj can hold them. Colors
/// are an array Colors, or three bytes.
std::array<vtkDataArray*, 3> FindArrays(vtkPolyData* mesh)
{
  vtkPointData* const data = mesh->GetPointData();
  const auto fit = [mesh](vtkDataArray* array, int fewest)
  {
    const bool fits = array && array->GetNumberOfComponents() >= fewest &&
      array->GetNumberOfComponents() <= 3 &&
      array->GetNumberOfTuples() >= mesh->GetNumberOfPoints();
    return fits ? array : nullptr;
  };
  vtkDataArray* colors = fit(data->GetArray("Colors"), 3);
  for (vtkDataArray* array : { data->GetArray("RGB"), data->GetScalars() })
  {
    if (fit(array, 3) && array->GetDataType() == VTK_UNSIGNED_CHAR)
    {
      colors = array;
    }
  }
  return { colors, fit(data->GetTCoords(), 1), fit(data->GetNormals(), 3) };
}

/// Writes the lines that label cells, each where a label differs from that of the cell before.
class LabelWriter
{
public:
  LabelWriter(vtkPolyData* mesh, std::ostream& out)
    : Out(out)
  {
    for (const char* const array : LabelArrays)
    {
      this->Labels.emplace_back(mesh, array);
    }
  }

  void Begin(vtkIdType cell)
  {
    for (std::size_t kind = 0; kind < this->Labels.size(); ++kind)
    {
      const StoredLabels& labels = this->Labels[kind];
      if (labels.Numbers)
      {
        this->Put(kind,
          labels.Texts->GetValue(static_cast<vtkIdType>(labels.Numbers->GetComponent(cell, 0))));
      }
    }
  }

private:
  void Put(std::size_t kind, std::string text)
  {
    if (text == this->Last[kind])
    {
      return;
    }
    this->Last[kind] = text;
    const auto isSpecial = [](unsigned char letter)
    { return std::iscntrl(letter) || letter == '\\'; };
    std::replace_if(text.begin(), text.end(), isSpecial, '_');
    this->Out << LabelKeywords[kind];
    if (!text.empty())
    {
      this->Out << ' ' << text;
    }
    this->Out << '\n';
  }

  std::ostream& Out;
  std::vector<StoredLabels> Labels;
  std::array<std::string, 3> Last; ///< Nothing is labelled at first.
};

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
  const auto arrays = FindArrays(mesh);
  vtkDataArray *const colors = arrays[0], *const texture = arrays[1], *const normals = arrays[2];
  const auto put = [&out](vtkDataArray* array, vtkIdType tuple, double scale = 1.0)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      PutNumber(out, array->GetComponent(tuple, component) / scale, ' ');
    }
  };
  const double most = colors && colors->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    out << 'v';
    put(mesh->GetPoints()->GetData(), point);
    if (colors)
    {
      put(colors, point, most);
    }
    out << '\n';
  }
  for (vtkDataArray* array : { texture, normals })
  {
    for (vtkIdType tuple = 0; array && tuple < mesh->GetNumberOfPoints(); ++tuple)
    {
      out << (array == texture ? "vt" : "vn");
      put(array, tuple);
      out << '\n';
    }
  }
  LabelWriter labels(mesh, out);
  vtkIdType cell = 0;
  for (const auto& [letter, cells] : { std::pair('p', mesh->GetVerts()),
         std::pair('l', mesh->GetLines()), std::pair('f', mesh->GetPolys()) })
  {
    const char keyword = letter;
    const bool isPolygons = letter == 'f';
    ForEachCell(cells,
      [&](vtkIdType size, const vtkIdType* points)
      {
        labels.Begin(cell++);
        out << keyword;
        for (vtkIdType i = 0; i < size; ++i)
        {
          PutNumber(out, points[i] + 1, ' ');
          if (isPolygons && texture)
          {
            PutNumber(out, points[i] + 1, '/');
          }
          if (isPolygons && normals)
          {
            if (!texture)
            {
              out << '/';
            }
            PutNumber(out, points[i] + 1, '/');
          }
        }
        out << '\n';
      });
  }
}

HeldArrays ArraysOfObj(vtkPolyData* mesh)
{
  const auto arrays = FindArrays(mesh);
  HeldArrays held = { { arrays.begin(), arrays.end() }, {}, {} };
  for (const char* const array : LabelArrays)
  {
    const StoredLabels labels(mesh, array);
    held.OfCells.push_back(labels.Numbers);
    held.OfField.push_back(labels.Texts);
  }
  return held;
}

}
