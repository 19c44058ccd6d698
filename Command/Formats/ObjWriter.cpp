// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ObjWriter.h"

#include "ObjPlan.h"
#include "OutputBuffer.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace delaunayflip
{

namespace
{

class ObjFileWriter
{
public:
  ObjFileWriter(vtkPolyData* mesh, const std::string& path)
    : Mesh(mesh),
      Plan(mesh),
      Out(path)
  {
    this->Current.fill(-1);
  }

  void Write()
  {
    this->Out.Add("# written by delaunay-flip\n");
    for (vtkIdType i = 0; this->Plan.Libraries && i < this->Plan.Libraries->GetNumberOfValues();
         ++i)
    {
      this->Out.Add("mtllib " + this->Plan.Libraries->GetValue(i) + "\n");
    }
    this->WriteVertices();
    this->TextureNumbers = this->WriteVectors("vt", this->Plan.Texture);
    this->NormalNumbers = this->WriteVectors(
      "vn", this->Plan.PointNormals ? this->Plan.PointNormals : this->Plan.CellNormals);
    for (const Kind& kind : this->SortKinds())
    {
      this->WriteCells(kind);
    }
    this->Out.Close();
  }

private:
  /// The verts, lines or polygons.
  struct Kind
  {
    const char* Keyword;
    vtkCellArray* Cells;
    vtkIdType Begin; ///< The first of them among all cells.
  };

  /// Kinds that begin without a material come first, because many readers fail on a usemtl without
  /// a name.
  std::array<Kind, 3> SortKinds() const
  {
    const vtkIdType verts = this->Mesh->GetNumberOfVerts();
    const vtkIdType lines = this->Mesh->GetNumberOfLines();
    std::array<Kind, 3> kinds = { { { "p", this->Mesh->GetVerts(), 0 },
      { "l", this->Mesh->GetLines(), verts }, { "f", this->Mesh->GetPolys(), verts + lines } } };
    std::stable_partition(kinds.begin(), kinds.end(),
      [this](const Kind& kind)
      { return kind.Cells->GetNumberOfCells() > 0 && this->GetLabel(0, kind.Begin) < 0; });
    return kinds;
  }

  void AddVector(vtkDataArray* array, vtkIdType tuple, int components, double scale = 1.0)
  {
    for (int component = 0; component < components; ++component)
    {
      this->Out.Add(" ");
      this->Out.AddNumber(array->GetComponent(tuple, component) / scale);
    }
  }

  static bool HasNan(vtkDataArray* array, vtkIdType tuple)
  {
    bool hasNan = false;
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      const double value = array->GetComponent(tuple, component);
      hasNan = hasNan || value != value;
    }
    return hasNan;
  }

  void WriteVertices()
  {
    vtkDataArray* const colors = this->Plan.Colors;
    const double most = colors && colors->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
    for (vtkIdType point = 0; point < this->Mesh->GetNumberOfPoints(); ++point)
    {
      this->Out.Add("v");
      this->AddVector(this->Mesh->GetPoints()->GetData(), point, 3);
      if (colors && !HasNan(colors, point))
      {
        this->AddVector(colors, point, 3, most);
      }
      this->Out.Add("\n");
    }
  }

  /// Returns the number of each tuple's vector in the file, 0 where it has none (NaN).
  std::vector<std::int64_t> WriteVectors(const char* keyword, vtkDataArray* array)
  {
    std::vector<std::int64_t> numbers;
    std::int64_t count = 0;
    for (vtkIdType tuple = 0; array && tuple < array->GetNumberOfTuples(); ++tuple)
    {
      const bool isLeftOut = HasNan(array, tuple);
      numbers.push_back(isLeftOut ? 0 : ++count);
      if (!isLeftOut)
      {
        this->Out.Add(keyword);
        this->AddVector(array, tuple, array->GetNumberOfComponents());
        this->Out.Add("\n");
      }
    }
    return numbers;
  }

  void WriteCells(const Kind& kind)
  {
    const bool isFace = kind.Cells == this->Mesh->GetPolys();
    for (vtkIdType i = 0; i < kind.Cells->GetNumberOfCells(); ++i)
    {
      vtkIdType size = 0;
      const vtkIdType* points = nullptr;
      kind.Cells->GetCellAtId(i, size, points);
      this->AddLabels(kind.Begin + i);
      this->Out.Add(kind.Keyword);
      for (vtkIdType corner = 0; corner < size; ++corner)
      {
        this->Out.Add(" ");
        this->Out.AddNumber(std::int64_t(points[corner] + 1));
        if (isFace)
        {
          this->AddCorner(points[corner], kind.Begin + i);
        }
      }
      this->Out.Add("\n");
    }
  }

  /// The number of a cell's material, group ..., or -1.
  vtkIdType GetLabel(std::size_t label, vtkIdType cell) const
  {
    vtkDataArray* const ids = this->Plan.Labels[label].Ids;
    return ids ? static_cast<vtkIdType>(ids->GetTuple1(cell)) : -1;
  }

  /// A keyword without a name ends the group, material or the like that an earlier one began.
  void AddLabels(vtkIdType cell)
  {
    for (std::size_t label = 0; label < ObjLabels.size(); ++label)
    {
      const vtkIdType id = this->GetLabel(label, cell);
      if (id != this->Current[label])
      {
        const std::string name = id < 0 ? "" : " " + this->Plan.Labels[label].Names->GetValue(id);
        this->Out.Add(ObjLabels[label].Keyword + name + "\n");
        this->Current[label] = id;
      }
    }
  }

  /// What follows the vertex: nothing, /texture, //normal or /texture/normal.
  void AddCorner(vtkIdType point, vtkIdType cell)
  {
    const vtkIdType normalOf = this->Plan.PointNormals ? point : cell;
    const std::int64_t texture = this->TextureNumbers.empty() ? 0 : this->TextureNumbers[point];
    const std::int64_t normal = this->NormalNumbers.empty() ? 0 : this->NormalNumbers[normalOf];
    if (texture + normal > 0)
    {
      this->Out.Add("/");
    }
    if (texture > 0)
    {
      this->Out.AddNumber(texture);
    }
    if (normal > 0)
    {
      this->Out.Add("/");
      this->Out.AddNumber(normal);
    }
  }

  vtkPolyData* Mesh;
  ObjPlan Plan;
  std::vector<std::int64_t> TextureNumbers;
  std::vector<std::int64_t> NormalNumbers;
  std::array<vtkIdType, ObjLabels.size()> Current; ///< The labels in force.
  OutputBuffer Out;
};

}

void WriteObj(vtkPolyData* mesh, const std::string& path) { ObjFileWriter(mesh, path).Write(); }

}
