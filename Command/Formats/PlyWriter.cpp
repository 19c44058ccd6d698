// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyWriter.h"

#include "CommandError.h"
#include "OutputBuffer.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <limits>

namespace delaunayflip
{

namespace
{

const char* NameOf(PlyType type)
{
  constexpr const char* names[] = { "char", "uchar", "short", "ushort", "int", "uint", "float",
    "double" };
  return names[static_cast<int>(type)];
}

PlyType FloatTypeOf(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT ? PlyType::Float32 : PlyType::Float64;
}

/// Calls `visit(size, points)` for every cell.
template <typename Function>
void ForEachCell(vtkCellArray* cells, const Function& visit)
{
  const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cell->GetCurrentCell(size, points);
    visit(size, points);
  }
}

class PlyFileWriter
{
public:
  PlyFileWriter(vtkPolyData* mesh, const std::string& path)
    : Mesh(mesh),
      Vertices(PlanPlyVertices(mesh)),
      Faces(PlanPlyFaces(mesh)),
      Out(path)
  {
    const vtkIdType longest = this->Mesh->GetPolys()->GetMaxCellSize();
    this->CountType = longest < 256 ? PlyType::UInt8 : PlyType::Int32;
  }

  void Write()
  {
    if (this->Mesh->GetNumberOfPoints() > std::numeric_limits<std::int32_t>::max())
    {
      throw CommandError(ExitCode::BadFile, "more points than this file format can number");
    }
    this->WriteHeader();
    this->WriteVertices();
    this->WriteFaces();
    this->WriteEdges();
    this->Out.Close();
  }

private:
  vtkIdType CountEdges() const
  {
    vtkIdType edges = 0;
    ForEachCell(this->Mesh->GetLines(),
      [&edges](vtkIdType size, const vtkIdType*) { edges += std::max<vtkIdType>(size - 1, 0); });
    return edges;
  }

  void AddElement(const std::string& name, vtkIdType count)
  {
    this->Out.Add("element " + name + " " + std::to_string(count) + "\n");
  }

  void AddProperty(PlyType type, const std::string& name)
  {
    this->Out.Add(std::string("property ") + NameOf(type) + " " + name + "\n");
  }

  void AddList(PlyType type, const std::string& name)
  {
    this->Out.Add(std::string("property list ") + NameOf(this->CountType) + " " + NameOf(type) +
      " " + name + "\n");
  }

  void AddProperties(const PlyPlan& plan)
  {
    for (const PlyOutput& output : plan.Properties)
    {
      this->AddProperty(output.Type, output.Name);
    }
  }

  void WriteHeader()
  {
    this->Out.Add("ply\nformat binary_little_endian 1.0\ncomment written by delaunay-flip\n");
    this->AddElement("vertex", this->Mesh->GetNumberOfPoints());
    for (const char* axis : { "x", "y", "z" })
    {
      this->AddProperty(FloatTypeOf(this->Mesh->GetPoints()->GetData()), axis);
    }
    this->AddProperties(this->Vertices);
    this->AddElement("face", this->Mesh->GetNumberOfPolys());
    this->AddList(PlyType::Int32, "vertex_indices");
    this->AddProperties(this->Faces);
    if (const vtkIdType edges = this->CountEdges())
    {
      this->AddElement("edge", edges);
      this->AddProperty(PlyType::Int32, "vertex1");
      this->AddProperty(PlyType::Int32, "vertex2");
    }
    this->Out.Add("end_header\n");
  }

  void AddValue(PlyType type, double value)
  {
    VisitPlyType(
      type, [this, value](auto zero) { this->Out.AddBytes(static_cast<decltype(zero)>(value)); });
  }

  void AddValues(const PlyPlan& plan, vtkIdType tuple)
  {
    for (const PlyOutput& output : plan.Properties)
    {
      this->AddValue(output.Type, output.Array->GetComponent(tuple, output.Component));
    }
  }

  void AddVertex(vtkIdType point) { this->Out.AddBytes(static_cast<std::int32_t>(point)); }

  void WriteVertices()
  {
    vtkDataArray* const coordinates = this->Mesh->GetPoints()->GetData();
    const PlyType type = FloatTypeOf(coordinates);
    for (vtkIdType point = 0; point < this->Mesh->GetNumberOfPoints(); ++point)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        this->AddValue(type, coordinates->GetComponent(point, axis));
      }
      this->AddValues(this->Vertices, point);
    }
  }

  void WriteFaces()
  {
    vtkIdType cell = this->Mesh->GetNumberOfVerts() + this->Mesh->GetNumberOfLines();
    ForEachCell(this->Mesh->GetPolys(),
      [this, &cell](vtkIdType size, const vtkIdType* points)
      {
        this->AddValue(this->CountType, static_cast<double>(size));
        std::for_each(points, points + size, [this](vtkIdType point) { this->AddVertex(point); });
        this->AddValues(this->Faces, cell++);
      });
  }

  void WriteEdges()
  {
    ForEachCell(this->Mesh->GetLines(),
      [this](vtkIdType size, const vtkIdType* points)
      {
        for (vtkIdType end = 1; end < size; ++end)
        {
          this->AddVertex(points[end - 1]);
          this->AddVertex(points[end]);
        }
      });
  }

  vtkPolyData* Mesh;
  PlyPlan Vertices;
  PlyPlan Faces;
  PlyType CountType = PlyType::UInt8; ///< Of lists.
  OutputBuffer Out;
};

}

PlyPlan PlanPlyVertices(vtkPolyData* mesh)
{
  return PlanPly(mesh->GetPointData(), mesh->GetNumberOfPoints(), { "x", "y", "z" });
}

PlyPlan PlanPlyFaces(vtkPolyData* mesh)
{
  return PlanPly(mesh->GetCellData(), mesh->GetNumberOfCells(),
    { "vertex_indices", "vertex_index", "texcoord" });
}

void WritePly(vtkPolyData* mesh, const std::string& path) { PlyFileWriter(mesh, path).Write(); }

}
