// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Formats.h"
#include "PlyProperties.h"
#include "PointColumns.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <set>

/// @file
/// The reader of .ply.

namespace delaunayflip
{

namespace
{

/// No property can have this name. What the array is for VTK has no effect, since no array of the
/// points stays.
const PlyGroup Coordinates = { "x y z", { "x", "y", "z" }, vtkDataSetAttributes::VECTORS };

struct PlyElement
{
  std::string Name;
  std::uint64_t Count;
  std::vector<PlyProperty> Properties;
};

/// Makes one array of those of a group, if all are there and no other has its name.
void Join(vtkDataSetAttributes* data, const PlyGroup& group)
{
  const auto find = [data](const std::string& name) { return data->GetArray(name.c_str()); };
  const Names& names = group.Properties;
  if (find(group.Array) || !std::all_of(names.begin(), names.end(), find))
  {
    return;
  }
  const int type = find(names[0])->GetDataType();
  const bool keepsType = (type == VTK_FLOAT || group.Array != Coordinates.Array) &&
    std::all_of(names.begin(), names.end(),
      [&](const std::string& name) { return find(name)->GetDataType() == type; });
  const auto joined =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(keepsType ? type : VTK_DOUBLE));
  joined->SetName(group.Array.c_str());
  joined->SetNumberOfComponents(static_cast<int>(names.size()));
  joined->SetNumberOfTuples(find(names[0])->GetNumberOfTuples());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    joined->CopyComponent(static_cast<int>(i), find(names[i]), 0);
    data->RemoveArray(names[i].c_str());
  }
  data->AddArray(joined);
  data->SetActiveAttribute(group.Array.c_str(), group.Attribute);
}

class PlyReader
{
public:
  explicit PlyReader(const InputFile& file)
    : File(file),
      Lines(file)
  {
    this->ReadHeader();
    for (PlyElement& element : this->Elements)
    {
      if (element.Count > 0 || element.Name == "vertex")
      {
        this->ReadElement(element);
      }
    }
    this->StoreCells();
    this->StoreFaceData();
    this->TellLosses();
    const std::size_t rest = this->Lines.Rest.size();
    if (rest > 0 && (!this->IsText || this->Lines.Next()))
    {
      this->Result.Warnings.push_back(
        "left out " + Counted(static_cast<std::int64_t>(rest), "byte") + " after its last element");
    }
    if (!this->Result.Mesh->GetPoints())
    {
      this->File.Fail("has no vertices x, y and z");
    }
  }

  FileMesh Result;

private:
  void ReadHeader()
  {
    if (!this->Lines.Next() || this->Word(0) != "ply")
    {
      this->File.Fail("not a PLY file (it does not start with 'ply')");
    }
    std::string format;
    std::set<std::string> elements, properties; // names; the properties are the last element's
    while (this->Lines.Next() && this->Word(0) != "end_header")
    {
      const std::string keyword = this->Word(0);
      const bool isList = this->Word(1) == "list";
      bool isRight = keyword == "comment" || keyword == "obj_info" ||
        keyword == "Created"; // by Open Asset Import Library
      if (keyword == "comment" && this->Word(1) == "TextureFile" && this->Lines.Words.size() > 2)
      {
        const char* const name = this->Lines.Words[2].data();
        const std::string_view last = this->Lines.Words.back();
        this->Textures.emplace_back(name, last.data() + last.size() - name);
      }
      if (keyword == "format")
      {
        format = this->Word(1);
        isRight = true;
      }
      else if (keyword == "element")
      {
        isRight = elements.insert(this->Word(1)).second;
        properties.clear();
        this->Elements.push_back({ this->Word(1), this->Lines.Number<std::uint64_t>(2), {} });
      }
      else if (keyword == "property" && !this->Elements.empty())
      {
        const std::size_t type = isList ? 3 : 1;
        PlyProperty property{ this->Word(type + 1), this->TypeAt(type) };
        if (isList)
        {
          property.CountType = this->TypeAt(2);
        }
        isRight = IsInteger(property.CountType) && properties.insert(property.Name).second;
        this->Elements.back().Properties.push_back(property);
      }
      if (!isRight)
      {
        this->Lines.Fail("not a line of a PLY header, or a name that an earlier line has");
      }
    }
    this->IsText = format == "ascii";
    this->IsSwapped = format == "binary_big_endian";
    const bool isKnown = this->IsText || this->IsSwapped || format == "binary_little_endian";
    if (this->Word(0).empty())
    {
      this->File.Fail("its header has no line 'end_header'");
    }
    if (!isKnown)
    {
      this->File.Fail(format.empty() ? "its header names no format"
                                     : "its header names an unknown format, '" + format + "'");
    }
  }

  std::string Word(std::size_t place) const
  {
    if (place >= this->Lines.Words.size())
    {
      return "";
    }
    return std::string(this->Lines.Words[place]);
  }

  int TypeAt(std::size_t place) const
  {
    const auto* const found = std::find_if(std::begin(PlyTypes), std::end(PlyTypes),
      [name = this->Word(place)](const auto& type) { return name == type.first; });
    if (found == std::end(PlyTypes))
    {
      this->Lines.FailOn(this->Word(place), " is not a type of a property");
    }
    return found->second;
  }

  /// Whether a property has the points of a face, or one of an edge.
  static bool IsOfCell(const PlyElement& element, const PlyProperty& property)
  {
    const std::string& name = property.Name;
    const bool isList = property.CountType != VTK_VOID;
    const bool areCorners =
      element.Name == "face" && isList && (name == "vertex_indices" || name == "vertex_index");
    const bool isEnd =
      element.Name == "edge" && !isList && (name == "vertex1" || name == "vertex2");
    return IsInteger(property.Type) && (areCorners || isEnd);
  }

  /// @param found how many properties of the element are of cells.
  void RequireCells(const PlyElement& element, int found) const
  {
    if (element.Name == "face" && found != 1)
    {
      this->File.Fail("its element face needs one list of vertex_indices");
    }
    if (element.Name == "edge" && found != 2)
    {
      this->File.Fail("its element edge needs vertex1 and vertex2");
    }
  }

  void ReadElement(PlyElement& element)
  {
    const bool isVertex = element.Name == "vertex";
    const bool isFace = element.Name == "face";
    const bool isEdge = element.Name == "edge";
    vtkPolyData* const mesh = this->Result.Mesh;
    vtkPointData* const data = mesh->GetPointData();
    int found = 0; // properties that are of a cell
    std::vector<std::string> others;
    for (PlyProperty& property : element.Properties)
    {
      const std::string& name = property.Name;
      const bool isList = property.CountType != VTK_VOID;
      property.IsOfCell = IsOfCell(element, property);
      if (property.IsOfCell)
      {
        ++found;
      }
      const bool isLabel = isFace && IsInteger(property.Type);
      if ((isVertex || isLabel) && !isList)
      {
        property.Array = vtkDataArray::CreateDataArray(property.Type);
        property.Array->SetName(name.c_str());
        vtkDataSetAttributes* owner = data;
        if (isFace)
        {
          owner = this->FaceData;
        }
        owner->AddArray(vtk::TakeSmartPointer(property.Array));
      }
      else if (isList && !isVertex && !isFace && !isEdge)
      {
        this->File.Fail("holds '" + element.Name +
          "', which may hold polygons; known elements are vertex, face and edge");
      }
      else if (!property.IsOfCell)
      {
        others.push_back(name);
      }
    }
    this->RequireCells(element, found);
    for (std::uint64_t row = 0; row < element.Count && !element.Properties.empty(); ++row)
    {
      this->ReadRow(element, static_cast<vtkIdType>(row));
      if (isFace)
      {
        this->AddFace(static_cast<vtkIdType>(row));
      }
      else if (isEdge)
      {
        this->Edges->InsertNextCell(2, this->Cell.data());
      }
    }
    if (isVertex)
    {
      Join(data, Coordinates);
      std::for_each(std::begin(PlyGroups), std::end(PlyGroups),
        [data](const PlyGroup& group) { Join(data, group); });
      if (vtkDataArray* const points = data->GetArray(Coordinates.Array.c_str()))
      {
        mesh->SetPoints(vtkNew<vtkPoints>());
        mesh->GetPoints()->SetData(points);
        data->RemoveArray(Coordinates.Array.c_str());
      }
    }
    if (!others.empty())
    {
      this->Result.Warnings.push_back(
        "left out " + JoinWords(others) + " of the element " + element.Name);
    }
  }

  void AddFace(vtkIdType row)
  {
    if (this->Cell.empty())
    {
      ++this->EmptyFaces;
      return;
    }
    const std::size_t kind = std::min<std::size_t>(this->Cell.size(), 3) - 1;
    this->Faces[kind]->InsertNextCell(static_cast<vtkIdType>(this->Cell.size()), this->Cell.data());
    this->FaceRows[kind].push_back(row);
  }

  /// Faces of one point become verts, and those of two become lines, behind the edges.
  void StoreCells()
  {
    vtkPolyData* const mesh = this->Result.Mesh;
    mesh->SetPolys(this->Faces[2]);
    if (this->Faces[1]->GetNumberOfCells() > 0)
    {
      this->Edges->Append(this->Faces[1]);
    }
    if (this->Edges->GetNumberOfCells() > 0)
    {
      mesh->SetLines(this->Edges);
    }
    if (this->Faces[0]->GetNumberOfCells() > 0)
    {
      mesh->SetVerts(this->Faces[0]);
    }
  }

  void TellLosses()
  {
    if (this->EmptyFaces > 0)
    {
      this->Result.Warnings.push_back(
        "left out " + Counted(this->EmptyFaces, "face") + " without points");
    }
    if (!this->Textures.empty())
    {
      this->Result.Warnings.push_back("left out TextureFile " + Quoted(this->Textures));
    }
  }

  /// Gives the integers of faces to the mesh, in the order of its cells. Edges have zeros.
  void StoreFaceData()
  {
    vtkPolyData* const mesh = this->Result.Mesh;
    for (const PlyGroup& group : PlyGroups)
    {
      if (group.Attribute == vtkDataSetAttributes::SCALARS)
      {
        Join(this->FaceData, group);
      }
    }
    for (int index = 0; index < this->FaceData->GetNumberOfArrays(); ++index)
    {
      vtkDataArray* const given = this->FaceData->GetArray(index);
      const auto ofCells = vtk::TakeSmartPointer(given->NewInstance());
      ofCells->SetName(given->GetName());
      ofCells->SetNumberOfComponents(given->GetNumberOfComponents());
      ofCells->SetNumberOfTuples(mesh->GetNumberOfCells());
      ofCells->Fill(0.0);
      const auto ofPolygons = vtk::TakeSmartPointer(ofCells->NewInstance());
      ofPolygons->SetName(given->GetName());
      ofPolygons->SetNumberOfComponents(given->GetNumberOfComponents());
      const vtkIdType polygons = mesh->GetNumberOfPolys();
      const vtkIdType faceLines = this->Faces[1]->GetNumberOfCells();
      const std::array<vtkIdType, 3> begins = { 0,
        mesh->GetNumberOfVerts() + mesh->GetNumberOfLines() - faceLines,
        mesh->GetNumberOfCells() - polygons };
      for (std::size_t kind = 0; kind < begins.size(); ++kind)
      {
        vtkIdType cell = begins[kind];
        for (const vtkIdType row : this->FaceRows[kind])
        {
          ofCells->SetTuple(cell++, row, given);
        }
      }
      mesh->GetCellData()->AddArray(ofCells);
      ofPolygons->InsertTuples(0, polygons, begins[2], ofCells);
      this->Result.AddLabels(ofPolygons);
    }
  }

  void ReadRow(const PlyElement& element, vtkIdType row)
  {
    this->Place = 0;
    this->Cell.clear();
    if (this->IsText)
    {
      this->Lines.Next(); // without words where the file ends
    }
    for (const PlyProperty& property : element.Properties)
    {
      double length = 1.0;
      if (property.CountType != VTK_VOID)
      {
        length = this->Next(property.CountType);
      }
      for (double i = 0.0; i != length; ++i) // the file ends before a wrong length is reached
      {
        const double value = this->Next(property.Type);
        if ((property.Array || property.IsOfCell) && property.Type >= VTK_LONG_LONG &&
          std::abs(value) >= std::ldexp(1.0, 53))
        {
          this->File.Fail(
            property.Name + " has integers beyond 2^53, which cannot be read exactly");
        }
        if (property.Array)
        {
          property.Array->InsertComponent(row, 0, value);
        }
        else if (property.IsOfCell)
        {
          this->Cell.push_back(static_cast<vtkIdType>(value));
        }
      }
    }
    if (this->IsText && this->Place < this->Lines.Words.size())
    {
      this->Lines.Fail("more values than the header says");
    }
  }

  /// A double holds all numbers of a .ply but large integers of 64 bits.
  double Next(int type)
  {
    switch (type)
    {
      vtkTemplateMacro(return static_cast<double>(this->NextOf<VTK_TT>()));
    }
    return 0.0;
  }

  template <typename T>
  T NextOf()
  {
    if (this->IsText)
    {
      return this->Lines.Number<T>(this->Place++);
    }
    T value;
    char* const bytes = reinterpret_cast<char*>(&value);
    if (this->Lines.Rest.copy(bytes, sizeof(T)) < sizeof(T))
    {
      this->File.Fail("ends before its last value (truncated or corrupt)");
    }
    this->Lines.Rest.remove_prefix(sizeof(T));
    if (this->IsSwapped)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    return value;
  }

  const InputFile& File;
  TextLines Lines; ///< The header, and the values behind it, which may be binary.
  bool IsText = false;
  bool IsSwapped = false;
  std::vector<PlyElement> Elements;
  vtkNew<vtkCellData> FaceData;
  std::size_t Place = 0; ///< Where the next word begins in a line of values.
  std::vector<vtkIdType> Cell; ///< The points of a face or an edge.
  vtkNew<vtkCellArray> Edges;
  std::array<vtkNew<vtkCellArray>, 3> Faces; ///< Those of one, two and more points.
  std::array<std::vector<vtkIdType>, 3> FaceRows; ///< Their places in the file.
  std::int64_t EmptyFaces = 0;
  Words Textures; ///< Their files, which comments name.
};

}

FileMesh ReadPly(const InputFile& file) { return PlyReader(file).Result; }

}
