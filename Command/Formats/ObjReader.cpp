// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ObjReader.h"

#include "CornerVectors.h"
#include "ObjParser.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace delaunayflip
{

namespace
{

vtkSmartPointer<vtkDoubleArray> MakeVectors(const std::vector<double>& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size() / 3));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkCellArray> MakeCells(const ObjCells& cells)
{
  vtkNew<vtkIdTypeArray> offsets;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(cells.Ends.size()) + 1);
  offsets->SetValue(0, 0);
  std::copy(cells.Ends.begin(), cells.Ends.end(), offsets->GetPointer(0) + 1);
  vtkNew<vtkIdTypeArray> points;
  points->SetNumberOfValues(static_cast<vtkIdType>(cells.Points.size()));
  std::copy(cells.Points.begin(), cells.Points.end(), points->GetPointer(0));
  auto array = vtkSmartPointer<vtkCellArray>::New();
  array->SetData(offsets, points);
  return array;
}

/// The labels of all cells in VTK's order.
vtkSmartPointer<vtkIntArray> MakeLabels(const ObjContent& content, std::size_t label)
{
  auto ids = vtkSmartPointer<vtkIntArray>::New();
  ids->SetName(ObjLabels[label].Ids);
  for (const ObjCells* cells : { &content.Verts, &content.Lines, &content.Faces })
  {
    std::vector<int> labels = cells->Labels[label];
    labels.resize(cells->Ends.size(), -1);
    std::for_each(labels.begin(), labels.end(), [&ids](int id) { ids->InsertNextValue(id); });
  }
  return ids;
}

vtkSmartPointer<vtkStringArray> MakeNames(const char* name, const std::vector<std::string>& names)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (const std::string& value : names)
  {
    array->InsertNextValue(value);
  }
  return array;
}

void AttachLabels(vtkPolyData* mesh, const ObjContent& content)
{
  for (std::size_t label = 0; label < ObjLabels.size(); ++label)
  {
    if (!content.Names[label].empty())
    {
      mesh->GetCellData()->AddArray(MakeLabels(content, label));
      mesh->GetFieldData()->AddArray(MakeNames(ObjLabels[label].Names, content.Names[label]));
    }
  }
  if (!content.Libraries.empty())
  {
    mesh->GetFieldData()->AddArray(MakeNames("MaterialLibraries", content.Libraries));
  }
}

void AttachColors(vtkPolyData* mesh, ObjContent& content)
{
  if (!content.Colors.empty())
  {
    content.Colors.resize(content.Positions.size(), std::numeric_limits<double>::quiet_NaN());
    const auto colors = MakeVectors(content.Colors);
    colors->SetName("Colors");
    mesh->GetPointData()->AddArray(colors);
  }
}

/// The vectors of corners. `numbers` may be shorter than the list of corners.
CornerVectors MakeCornerVectors(const ObjCells& cells, const std::vector<std::int64_t>& numbers)
{
  CornerVectors vectors;
  vectors.OfCorner = numbers;
  vectors.OfCorner.resize(cells.Points.size(), CornerVectors::None);
  return vectors;
}

/// Texture coordinates have two components, unless some third component is not zero.
CornerVectors MakeTexture(const ObjContent& content)
{
  CornerVectors texture = MakeCornerVectors(content.Faces, content.Faces.Textures);
  texture.Components = 2;
  for (std::size_t i = 2; i < content.Textures.size(); i += 3)
  {
    texture.Components = content.Textures[i] == 0.0 ? texture.Components : 3;
  }
  for (std::size_t i = 0; i < content.Textures.size(); i += 3)
  {
    const auto begin = content.Textures.begin() + static_cast<std::ptrdiff_t>(i);
    texture.Values.insert(texture.Values.end(), begin, begin + texture.Components);
  }
  return texture;
}

CornerVectors MakeNormals(const ObjContent& content)
{
  CornerVectors normals = MakeCornerVectors(content.Faces, content.Faces.Normals);
  normals.Components = 3;
  normals.Values = content.Normals;
  return normals;
}

void NoteUnknown(FileMesh& file, const std::string& name, const ObjContent& content)
{
  std::string list;
  for (const auto& [keyword, count] : content.Unknown)
  {
    list += (list.empty() ? "" : ", ") + keyword + " (" + std::to_string(count) + ")";
  }
  if (!list.empty())
  {
    file.Notes.push_back(name + ": ignored the lines with these keywords: " + list);
  }
}

}

FileMesh ReadObj(const InputFile& input)
{
  ObjContent content = ParseObj(input);
  FileMesh file;
  vtkNew<vtkPoints> points;
  points->SetData(MakeVectors(content.Positions));
  file.Mesh->SetPoints(points);
  file.Mesh->SetVerts(MakeCells(content.Verts));
  file.Mesh->SetLines(MakeCells(content.Lines));
  file.Mesh->SetPolys(MakeCells(content.Faces));
  AttachLabels(file.Mesh, content);
  AttachColors(file.Mesh, content);
  NoteUnknown(file, input.GetName(), content);
  if (!content.Faces.Textures.empty())
  {
    AttachTexture(file, input.GetName(), MakeTexture(content));
  }
  if (!content.Faces.Normals.empty())
  {
    AttachNormals(file, input.GetName(), MakeNormals(content));
  }
  return file;
}

}
