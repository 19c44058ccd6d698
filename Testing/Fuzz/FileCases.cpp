// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileCases.h"

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

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
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

template <typename Writer, typename Prepare>
void Write(const std::string& path, vtkPolyData* mesh, const Prepare& prepare)
{
  vtkNew<Writer> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(path.c_str());
  prepare(writer.Get());
  writer->Write();
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
property int material
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255
4 0 0 0
4 3 1e-3 7
0.5 3 0 9
3 0 1 2 7
3 0 2 3 -8
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
usemtl
f -4//1 -2//1 -1//1
l 1 2
p 3
)";

constexpr const char* StlText = R"(solid one two
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 4 0 0
vertex 2 1 0
end loop
endfacet
end solid
solid
facet normal 0 0 1
outer loop
vertex 4 0 0
vertex 0 0 0
vertex 2 -1 1e-3
endloop
end facet
endsolid
)";

constexpr const char* CsvText = "id;X;Y;Z\n1;0;0;5\n2;4.5;0;1e-3\n#3\n3;4;3;\"2\"\n\n4;0;3;-1\n";
constexpr const char* SurveyText = "sep=;\n// x and y\nFID;Northing;Easting (m);Elev\n1;0,5;0;5\n"
                                   "2;4,5;0;1e-3\n;;\n3;4;3;2;oak\n4;0;3;-1\n";
constexpr const char* XyzText = "0 0 0\n4\t0.25 1\n4 3 2\n0 3 nan\n2 1 1\n";

int WriteAll(const std::string& folder)
{
  const auto mesh = MakeRichMesh(), triangles = MakeTriangles();
  const auto binary = [](auto* vtk) { vtk->SetFileTypeToBinary(); };
  const auto ascii = [](auto* vtk) { vtk->SetFileTypeToASCII(); };
  Write<vtkPolyDataWriter>(folder + "/binary.vtk", mesh, binary);
  Write<vtkPolyDataWriter>(folder + "/ascii.vtk", mesh, ascii);
  Write<vtkPolyDataWriter>(folder + "/version4.vtk", mesh,
    [](auto* vtk) { vtk->SetFileVersion(vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_4_2); });
  Write<vtkXMLPolyDataWriter>(folder + "/raw.vtp", mesh,
    [](auto* vtk)
    {
      vtk->SetDataModeToAppended();
      vtk->EncodeAppendedDataOff();
    });
  Write<vtkXMLPolyDataWriter>(
    folder + "/ascii.vtp", mesh, [](auto* vtk) { vtk->SetDataModeToAscii(); });
  Write<vtkXMLPolyDataWriter>(folder + "/inline.vtp", mesh,
    [](auto* vtk)
    {
      vtk->SetDataModeToBinary();
      vtk->SetCompressorTypeToNone();
    });
  Write<vtkPLYWriter>(folder + "/binary.ply", triangles, binary);
  Write<vtkPLYWriter>(folder + "/big.ply", triangles,
    [](auto* vtk)
    {
      vtk->SetFileTypeToBinary();
      vtk->SetDataByteOrderToBigEndian();
    });
  Write<vtkSTLWriter>(folder + "/binary.stl", triangles, binary);
  Write<vtkSTLWriter>(folder + "/ascii.stl", triangles, ascii);
  Write<vtkOBJWriter>(folder + "/plain.obj", triangles, [](auto*) {});
  const std::pair<const char*, const char*> texts[] = { { "text.ply", PlyText },
    { "text.obj", ObjText }, { "solids.stl", StlText }, { "names.csv", CsvText },
    { "survey.csv", SurveyText }, { "plain.csv", XyzText } };
  for (const auto& [name, text] : texts)
  {
    std::ofstream(folder + "/" + name, std::ios::binary) << text;
  }
  return 0;
}

using Size = std::uint32_t;

/// A position in a text, or 0 in an empty one.
Size DrawPlace(const std::string& text, ByteSource& source)
{
  return text.empty() ? 0 : source.Draw(static_cast<Size>(text.size()));
}

void ChangeByte(std::string& text, ByteSource& source)
{
  constexpr unsigned char Values[] = { 0, 1, 9, 10, 13, 32, 127, 128, 255 };
  if (text.empty())
  {
    return;
  }
  char& byte = text[DrawPlace(text, source)];
  byte = source.Once(2) ? static_cast<char>(byte ^ (1 << source.Draw(8)))
                        : static_cast<char>(Values[source.Draw(sizeof(Values))]);
}

/// Changes four or eight bytes, as of a binary number.
void ChangeWord(std::string& text, ByteSource& source)
{
  static const std::string words[] = { std::string(4, '\0'), std::string(4, '\xFF'),
    std::string("\x00\x00\x00\x80", 4), std::string("\x7F\xFF\xFF\xFF", 4),
    std::string("\xFF\xFF\xFF\x7F", 4), std::string("\x00\x00\x80\x7F", 4),
    std::string("\x00\x00\xC0\x7F", 4), std::string(8, '\xFF'),
    std::string("\x00\x00\x00\x00\x00\x00\xF0\x7F", 8), std::string("\x00\x00\x00\x40", 4) };
  const std::string& word = words[source.Draw(sizeof(words) / sizeof(words[0]))];
  const Size place = DrawPlace(text, source);
  text.replace(place, std::min(word.size(), text.size() - place), word);
}

bool IsOfNumber(char letter)
{
  return std::isdigit(static_cast<unsigned char>(letter)) || letter == '.' || letter == '-' ||
    letter == 'e' || letter == '+';
}

/// Replaces a decimal number with another.
void ChangeNumber(std::string& text, ByteSource& source)
{
  constexpr const char* Numbers[] = { "0", "-1", "1", "2", "3", "4294967296", "2147483648",
    "9223372036854775807", "99999999999999999999", "1e400", "-1e-400", "nan", "inf", "1,5", "abc",
    "", "0x10", "1000000000", "1e154", "-0" };
  const Size start = DrawPlace(text, source);
  const auto digit = std::find_if(text.begin() + start, text.end(),
    [](char letter) { return std::isdigit(static_cast<unsigned char>(letter)); });
  const auto end = std::find_if_not(digit, text.end(), IsOfNumber);
  text.replace(digit, end, Numbers[source.Draw(sizeof(Numbers) / sizeof(Numbers[0]))]);
}

/// Removes, repeats or moves a piece.
void ChangePiece(std::string& text, ByteSource& source)
{
  const Size place = DrawPlace(text, source);
  const std::string piece = text.substr(place, 1 + source.Draw(64));
  switch (source.Draw(3))
  {
    case 0:
      text.erase(place, piece.size());
      break;
    case 1:
      text.insert(place, piece);
      break;
    default:
      text.erase(place, piece.size());
      text.insert(DrawPlace(text, source), piece);
      break;
  }
}

/// Removes, repeats or moves a line.
void ChangeLine(std::string& text, ByteSource& source)
{
  const Size place = DrawPlace(text, source);
  const std::size_t before = text.rfind('\n', place);
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(text.find('\n', start), text.size() - 1);
  const std::string line = text.substr(start, end + 1 - start);
  if (source.Once(2))
  {
    text.erase(start, line.size());
  }
  else
  {
    text.insert(start, line);
  }
}

void Splice(std::string& text, const std::string& other, ByteSource& source)
{
  const Size from = DrawPlace(other, source);
  text.insert(DrawPlace(text, source), other.substr(from, 1 + source.Draw(256)));
}

void MutateOnce(std::string& text, const std::string& other, ByteSource& source)
{
  constexpr void (*Changes[])(std::string&, ByteSource&) = { ChangeByte, ChangeWord, ChangeNumber,
    ChangeNumber, ChangeNumber, ChangePiece, ChangeLine };
  const Size choice = source.Draw(8);
  if (choice < 7)
  {
    Changes[choice](text, source);
  }
  else if (source.Once(2))
  {
    Splice(text, other, source);
  }
  else
  {
    text.resize(DrawPlace(text, source));
  }
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

std::string MutateFile(std::string bytes, const std::string& other, ByteSource& source)
{
  // Most files stay regular enough to pass the first checks.
  for (Size faults = 1 + source.Draw(source.Once(4) ? 12 : 3); faults > 0; --faults)
  {
    MutateOnce(bytes, other, source);
  }
  return bytes;
}

}
