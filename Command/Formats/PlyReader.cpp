// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyReader.h"

#include "Counted.h"
#include "FileValues.h"
#include "PlyArrays.h"
#include "PlyHeader.h"
#include "PlyTexture.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <memory>

namespace delaunayflip
{

namespace
{

bool IsIndexList(const PlyProperty& property)
{
  return property.CountType && property.Type < PlyType::Float32 &&
    (property.Name == "vertex_indices" || property.Name == "vertex_index");
}

bool IsTexture(const PlyProperty& property)
{
  return property.CountType && property.Type >= PlyType::Float32 && property.Name == "texcoord";
}

/// Reads the body, one element after the other. `Values` is the source of its numbers.
template <typename Values>
class PlyBody
{
public:
  PlyBody(const InputFile& file, const PlyHeader& header, Values values)
    : File(file),
      Header(header),
      Source(values),
      Vertices(header.CountOf("vertex"))
  {
  }

  FileMesh Read()
  {
    for (const PlyElement& element : this->Header.Elements)
    {
      this->ReadElement(element);
    }
    if (const std::size_t left = this->Source.Finish())
    {
      this->Note(
        "ignored " + Counted(static_cast<std::int64_t>(left), "byte") + " after its last element");
    }
    this->Assemble();
    return this->Result;
  }

private:
  void ReadElement(const PlyElement& element)
  {
    this->Arrays = std::make_unique<PlyArrays>(element);
    if (element.Name == "vertex")
    {
      this->ReadVertices(element);
    }
    else if (element.Name == "face")
    {
      this->ReadFaces(element);
    }
    else if (element.Name == "tristrips")
    {
      this->ReadStrips(element);
    }
    else if (element.Name == "edge")
    {
      this->ReadEdges(element);
    }
    else if (element.Count > 0)
    {
      this->SkipElements(element);
    }
  }

  /// Reads all elements of a kind; `onList(property, length)` reads the items of a list.
  template <typename Function>
  void ReadRows(const PlyElement& element, const Function& onList)
  {
    for (std::int64_t row = 0; row < element.Count; ++row)
    {
      this->Source.StartRow(element.Name, row);
      for (std::size_t i = 0; i < element.Properties.size(); ++i)
      {
        const PlyProperty& property = element.Properties[i];
        if (property.CountType)
        {
          onList(property, this->NextLength(property));
        }
        else
        {
          this->Arrays->Columns[i].Store(this->Source);
        }
      }
      this->Source.EndRow();
    }
  }

  std::int64_t NextInteger(PlyType type)
  {
    return VisitPlyType(type,
      [this](auto zero)
      { return static_cast<std::int64_t>(this->Source.template Next<decltype(zero)>()); });
  }

  std::int64_t NextLength(const PlyProperty& property)
  {
    const std::int64_t length = this->NextInteger(*property.CountType);
    if (length < 0 || static_cast<std::size_t>(length) > this->Source.GetBytesLeft())
    {
      this->Source.Fail("a list of length " + std::to_string(length));
    }
    return length;
  }

  vtkIdType NextVertex(PlyType type)
  {
    const std::int64_t vertex = this->NextInteger(type);
    if (vertex < 0 || vertex >= this->Vertices)
    {
      this->Source.Fail("vertex " + std::to_string(vertex) +
        " is out of range; the number of vertices is " + std::to_string(this->Vertices));
    }
    return vertex;
  }

  void SkipList(const PlyProperty& property, std::int64_t length)
  {
    for (std::int64_t i = 0; i < length; ++i)
    {
      VisitPlyType(
        property.Type, [this](auto zero) { this->Source.template Next<decltype(zero)>(); });
    }
  }

  void ReadVertices(const PlyElement& element)
  {
    this->NoteLists(element, [](const PlyProperty&) { return false; });
    this->ReadRows(element,
      [this](const PlyProperty& property, std::int64_t length)
      { this->SkipList(property, length); });
    const auto coordinates = this->Arrays->TakePoints();
    if (!coordinates)
    {
      this->File.Fail("its vertices have no x, y and z");
    }
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);
    this->Result.Mesh->SetPoints(points);
    this->Arrays->AddTo(this->Result.Mesh->GetPointData());
  }

  void ReadFaces(const PlyElement& element)
  {
    this->RequireIndices(element);
    this->NoteLists(
      element, [](const PlyProperty& list) { return IsIndexList(list) || IsTexture(list); });
    this->Polys->AllocateEstimate(element.Count, 3);
    this->ReadRows(element,
      [this](const PlyProperty& property, std::int64_t length)
      {
        if (IsIndexList(property))
        {
          this->ReadCell(this->Polys, property, length);
        }
        else if (IsTexture(property))
        {
          this->ReadTexture(property, length);
        }
        else
        {
          this->SkipList(property, length);
        }
      });
    this->FaceArrays = std::move(this->Arrays);
  }

  void ReadCell(vtkCellArray* cells, const PlyProperty& property, std::int64_t length)
  {
    cells->InsertNextCell(static_cast<int>(length));
    for (std::int64_t i = 0; i < length; ++i)
    {
      cells->InsertCellPoint(this->NextVertex(property.Type));
    }
  }

  void ReadTexture(const PlyProperty& property, std::int64_t length)
  {
    for (std::int64_t i = 0; i < length; ++i)
    {
      this->Texture.Add(VisitPlyType(property.Type,
        [this](auto zero)
        { return static_cast<double>(this->Source.template Next<decltype(zero)>()); }));
    }
    this->Texture.EndFace();
  }

  /// One list of vertices may hold many strips, with -1 between them.
  void ReadStrips(const PlyElement& element)
  {
    this->RequireIndices(element);
    std::vector<vtkIdType> strip;
    const auto endStrip = [this, &strip]
    {
      if (strip.size() > 2)
      {
        this->Strips->InsertNextCell(static_cast<vtkIdType>(strip.size()), strip.data());
      }
      strip.clear();
    };
    this->ReadRows(element,
      [this, &strip, &endStrip](const PlyProperty& property, std::int64_t length)
      {
        for (std::int64_t i = 0; i < length && IsIndexList(property); ++i)
        {
          this->ExtendStrip(strip, this->NextInteger(property.Type), endStrip);
        }
        endStrip();
        this->SkipList(property, IsIndexList(property) ? 0 : length);
      });
  }

  template <typename Function>
  void ExtendStrip(std::vector<vtkIdType>& strip, std::int64_t vertex, const Function& endStrip)
  {
    if (vertex >= this->Vertices || vertex < -1)
    {
      this->Source.Fail("vertex " + std::to_string(vertex) +
        " is out of range; the number of vertices is " + std::to_string(this->Vertices));
    }
    if (vertex == -1)
    {
      endStrip();
      return;
    }
    strip.push_back(vertex);
  }

  /// An edge is two scalar properties.
  void ReadEdges(const PlyElement& element)
  {
    this->ReadRows(element,
      [this](const PlyProperty& property, std::int64_t length)
      { this->SkipList(property, length); });
    vtkNew<vtkCellData> data;
    this->Arrays->AddTo(data);
    vtkDataArray* first = data->GetArray("vertex1");
    vtkDataArray* second = data->GetArray("vertex2");
    if (!first || !second)
    {
      this->File.Fail("its edges have no vertex1 and vertex2");
    }
    for (vtkIdType edge = 0; edge < element.Count; ++edge)
    {
      const vtkIdType ends[] = { static_cast<vtkIdType>(first->GetTuple1(edge)),
        static_cast<vtkIdType>(second->GetTuple1(edge)) };
      if (std::min(ends[0], ends[1]) < 0 || std::max(ends[0], ends[1]) >= this->Vertices)
      {
        this->File.Fail("edge " + std::to_string(edge) + " has a vertex that is out of range");
      }
      this->Lines->InsertNextCell(2, ends);
    }
  }

  void SkipElements(const PlyElement& element)
  {
    if (element.HasLists() || this->Header.CountOf("face") + this->Header.CountOf("tristrips") == 0)
    {
      this->File.Fail("holds '" + element.Name +
        "', which may hold polygons; known elements are vertex, face, tristrips and edge");
    }
    this->ReadRows(element, [](const PlyProperty&, std::int64_t) {});
    this->Note("ignored " + Counted(element.Count, "element") + " of the unknown type '" +
      element.Name + "'");
  }

  /// Requires one list of vertices and at most one of texture coordinates.
  void RequireIndices(const PlyElement& element) const
  {
    const auto& lists = element.Properties;
    if (element.Count > 0 &&
      (std::count_if(lists.begin(), lists.end(), IsIndexList) != 1 ||
        std::count_if(lists.begin(), lists.end(), IsTexture) > 1))
    {
      this->File.Fail("its element " + element.Name + " needs one list of vertex_indices");
    }
  }

  template <typename Predicate>
  void NoteLists(const PlyElement& element, const Predicate& isKept)
  {
    for (const PlyProperty& property : element.Properties)
    {
      if (property.CountType && !isKept(property) && element.Count > 0)
      {
        this->Note("ignored the lists " + property.Name + " of the element " + element.Name);
      }
    }
  }

  void Note(const std::string& note)
  {
    this->Result.Notes.push_back(this->File.GetName() + ": " + note);
  }

  void Assemble()
  {
    if (!this->Result.Mesh->GetPoints())
    {
      this->File.Fail("has no vertices");
    }
    this->Result.Mesh->SetLines(this->Lines);
    this->Result.Mesh->SetPolys(this->Polys);
    this->Result.Mesh->SetStrips(this->Strips);
    if (this->FaceArrays)
    {
      this->FaceArrays->AddTo(this->Result.Mesh->GetCellData(), this->Lines->GetNumberOfCells(),
        this->Strips->GetNumberOfCells());
    }
    this->Texture.Attach(this->Result, this->File);
  }

  const InputFile& File;
  const PlyHeader& Header;
  Values Source;
  std::int64_t Vertices;
  FileMesh Result;
  std::unique_ptr<PlyArrays> Arrays; ///< Of the element being read.
  std::unique_ptr<PlyArrays> FaceArrays;
  PlyTexture Texture;
  vtkNew<vtkCellArray> Lines;
  vtkNew<vtkCellArray> Polys;
  vtkNew<vtkCellArray> Strips;
};

}

FileMesh ReadPly(const InputFile& file)
{
  const PlyHeader header = ReadPlyHeader(file);
  switch (header.Encoding)
  {
    case PlyEncoding::Text:
      return PlyBody(file, header, TextValues(TextCursor(file, header.Size))).Read();
    case PlyEncoding::LittleEndian:
      return PlyBody(file, header, BinaryValues<false>(file, header.Size)).Read();
    default:
      return PlyBody(file, header, BinaryValues<true>(file, header.Size)).Read();
  }
}

}
