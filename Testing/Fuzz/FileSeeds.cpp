// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileSeeds.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr int Columns = 4;
constexpr int Rows = 3;

/// A bent lattice of triangles.
vtkSmartPointer<vtkPolyData> MakeTriangles()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polys;
  for (int i = 0; i < Columns * Rows; ++i)
  {
    const int x = i % Columns;
    const int y = i / Columns;
    points->InsertNextPoint(x + 0.25 * (y % 2), y, 0.1 * x * y);
    if (x + 1 < Columns && y + 1 < Rows)
    {
      const vtkIdType lower[] = { i, i + 1, i + Columns + 1 };
      const vtkIdType upper[] = { i, i + Columns + 1, i + Columns };
      polys->InsertNextCell(3, lower);
      polys->InsertNextCell(3, upper);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polys);
  return mesh;
}

template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(1);
  return array;
}

/// A mesh with vertices, lines, a quad and a strip too, and attributes of several types.
vtkSmartPointer<vtkPolyData> MakeRichMesh()
{
  vtkSmartPointer<vtkPolyData> mesh = MakeTriangles();
  const vtkIdType quad[] = { 0, 1, 5, 4 };
  mesh->GetPolys()->InsertNextCell(4, quad);
  const auto add = [](const vtkIdType* ids, int count)
  {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->InsertNextCell(count, ids);
    return cells;
  };
  mesh->SetVerts(add(quad, 1));
  mesh->SetLines(add(quad, 3));
  mesh->SetStrips(add(quad, 4));
  const vtkIdType cells = mesh->GetNumberOfCells();
  mesh->GetPointData()->SetScalars(
    MakeArray<vtkDoubleArray>("height", 1, mesh->GetNumberOfPoints()));
  mesh->GetPointData()->SetNormals(
    MakeArray<vtkDoubleArray>("normals", 3, mesh->GetNumberOfPoints()));
  mesh->GetPointData()->SetTCoords(
    MakeArray<vtkDoubleArray>("texture", 2, mesh->GetNumberOfPoints()));
  mesh->GetCellData()->AddArray(MakeArray<vtkIntArray>("region", 1, cells));
  mesh->GetCellData()->AddArray(MakeArray<vtkUnsignedCharArray>("colours", 3, cells));
  vtkNew<vtkStringArray> note;
  note->SetName("note");
  note->InsertNextValue("made by a test");
  mesh->GetFieldData()->AddArray(note);
  return mesh;
}

class SeedWriter
{
public:
  explicit SeedWriter(std::string folder)
    : Folder(std::move(folder))
  {
  }

  template <typename Writer>
  void Write(const char* name, vtkPolyData* mesh, const std::function<void(Writer*)>& prepare)
  {
    vtkNew<Writer> writer;
    writer->SetInputData(mesh);
    writer->SetFileName((this->Folder + "/" + name).c_str());
    prepare(writer);
    writer->Write();
  }

  void Write(const char* name, const char* text) const
  {
    std::ofstream(this->Folder + "/" + name, std::ios::binary) << text;
  }

private:
  std::string Folder;
};

void WriteLegacy(SeedWriter& writer, vtkPolyData* mesh)
{
  writer.Write<vtkPolyDataWriter>(
    "binary.vtk", mesh, [](auto* vtk) { vtk->SetFileTypeToBinary(); });
  writer.Write<vtkPolyDataWriter>("ascii.vtk", mesh, [](auto* vtk) { vtk->SetFileTypeToASCII(); });
  writer.Write<vtkPolyDataWriter>("version4.vtk", mesh,
    [](auto* vtk) { vtk->SetFileVersion(vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_4_2); });
}

void WriteXml(SeedWriter& writer, vtkPolyData* mesh)
{
  const auto raw = [](auto* vtk)
  {
    vtk->SetDataModeToAppended();
    vtk->EncodeAppendedDataOff();
  };
  writer.Write<vtkXMLPolyDataWriter>("raw.vtp", mesh, raw);
  writer.Write<vtkXMLPolyDataWriter>(
    "ascii.vtp", mesh, [](auto* vtk) { vtk->SetDataModeToAscii(); });
  writer.Write<vtkXMLPolyDataWriter>("inline.vtp", mesh,
    [](auto* vtk)
    {
      vtk->SetDataModeToBinary();
      vtk->SetCompressorTypeToNone();
    });
}

constexpr const char* PlyText = R"(ply
format ascii 1.0
comment made by a test
element vertex 4
property double x
property double y
property double z
property uchar red
element face 2
property list uchar int vertex_indices
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255
4 0 0 0
4 3 1e-3 7
0.5 3 0 9
3 0 1 2
3 0 2 3
0 2
)";

constexpr const char* ObjText = R"(# made by a test
mtllib none.mtl
o thing
v 0 0 0
v 4 0 0 1.0
v 4 3 1e-3
v 0.5 3 0
vt 0 0
vt 1 0.5
vn 0 0 1
g left
usemtl grey
s 1
f 1/1/1 2/2/1 3/1/1
f -4//1 -2//1 -1//1
l 1 2
p 3
)";

void WriteOthers(SeedWriter& writer, vtkPolyData* triangles)
{
  writer.Write<vtkPLYWriter>(
    "binary.ply", triangles, [](auto* vtk) { vtk->SetFileTypeToBinary(); });
  writer.Write<vtkPLYWriter>("big.ply", triangles,
    [](auto* vtk)
    {
      vtk->SetFileTypeToBinary();
      vtk->SetDataByteOrderToBigEndian();
    });
  writer.Write("text.ply", PlyText);
  writer.Write<vtkSTLWriter>(
    "binary.stl", triangles, [](auto* vtk) { vtk->SetFileTypeToBinary(); });
  writer.Write<vtkSTLWriter>("ascii.stl", triangles, [](auto* vtk) { vtk->SetFileTypeToASCII(); });
  writer.Write<vtkOBJWriter>("plain.obj", triangles, [](auto*) {});
  writer.Write("text.obj", ObjText);
}

int WriteAll(const std::string& folder)
{
  SeedWriter writer(folder);
  const auto mesh = MakeRichMesh();
  WriteLegacy(writer, mesh);
  WriteXml(writer, mesh);
  WriteOthers(writer, MakeTriangles());
  return 0;
}

}

std::vector<SeedFile> MakeSeedFiles(const std::string& folder)
{
  const int child = fork();
  if (child == 0)
  {
    _exit(WriteAll(folder));
  }
  int status = -1;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
  {
    throw std::runtime_error("the seed files could not be made");
  }
  std::set<std::filesystem::path> paths; // in an order that does not depend on the machine
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    paths.insert(entry.path());
  }
  std::vector<SeedFile> seeds;
  for (const auto& path : paths)
  {
    std::ifstream file(path, std::ios::binary);
    seeds.push_back({ path.extension().string().substr(1),
      std::string(std::istreambuf_iterator<char>(file), {}) });
    std::filesystem::remove(path);
  }
  return seeds;
}

}
