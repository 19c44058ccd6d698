// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReader.h"

#include "CommandError.h"
#include "Console.h"
#include "FileChecks.h"
#include "MergePoints.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkXMLFileReadTester.h>
#include <vtkXMLPolyDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace delaunayflip
{

namespace
{

[[noreturn]] void Fail(const std::string& path, const std::string& reason)
{
  throw CommandError(ExitCode::BadFile, path + ": " + reason);
}

[[noreturn]] void FailOnType(const std::string& path, const std::string& type)
{
  Fail(path,
    "holds " + type +
      ", not a surface mesh (PolyData); ParaView's Extract Surface (vtkDataSetSurfaceFilter) "
      "extracts one");
}

void CheckReadable(const std::string& path)
{
  if (std::filesystem::is_directory(path))
  {
    Fail(path, "is a folder");
  }
  if (!std::ifstream(path, std::ios::binary))
  {
    Fail(path, std::string("cannot be read: ") + std::strerror(errno));
  }
}

/// Any complaint of the reader is an error: it means that part of the file was not read.
vtkSmartPointer<vtkPolyData> Update(
  vtkAlgorithm* reader, const std::string& path, VTKMessages& messages)
{
  {
    const MutedStandardError muted;
    reader->Update();
  }
  const std::string complaints = messages.TakeComplaints();
  auto* mesh = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
  if (!complaints.empty() || !mesh)
  {
    Fail(path, "cannot be read: " + (complaints.empty() ? "it contains no mesh" : complaints));
  }
  if (!mesh->GetPoints())
  {
    const vtkNew<vtkPoints> none;
    mesh->SetPoints(none);
  }
  return mesh;
}

/// The word after DATASET in the header of a .vtk if it names another type of data; else empty.
std::string OtherLegacyType(const std::string& path)
{
  static const std::set<std::string> others = { "unstructured_grid", "structured_grid",
    "structured_points", "rectilinear_grid", "table", "graph", "directed_graph", "undirected_graph",
    "tree", "molecule", "hypertreegrid", "multiblock", "hierarchical_box", "overlapping_amr" };
  constexpr int headLines = 10; // four in the format, and blank ones
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (int number = 0; number < headLines && std::getline(file, line); ++number)
  {
    std::istringstream words(vtksys::SystemTools::LowerCase(line));
    std::string keyword;
    std::string type;
    if (words >> keyword >> type && keyword == "dataset")
    {
      return others.count(type) ? type : std::string();
    }
  }
  return {};
}

MeshFile ReadLegacy(const std::string& path, VTKMessages& messages)
{
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  const std::string type = OtherLegacyType(path);
  if (!type.empty())
  {
    FailOnType(path, type);
  }
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  return { Update(reader, path, messages), {}, false };
}

MeshFile ReadXml(const std::string& path, VTKMessages& messages)
{
  vtkNew<vtkXMLFileReadTester> tester;
  tester->SetFileName(path.c_str());
  const char* type = tester->TestReadFile() ? tester->GetFileDataType() : nullptr;
  if (!type)
  {
    Fail(path, "not a VTK XML file");
  }
  if (std::strcmp(type, "PolyData") != 0)
  {
    FailOnType(path, type);
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  return { Update(reader, path, messages), {}, false };
}

MeshFile ReadPly(const std::string& path, VTKMessages& messages)
{
  const PlyHeader header = CheckPly(path);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  MeshFile file{ Update(reader, path, messages), {}, false };
  if (file.Mesh->GetNumberOfPoints() != header.Vertices ||
    file.Mesh->GetNumberOfPolys() != header.Faces)
  {
    Fail(path, "has fewer vertices or faces than its header says (truncated or corrupt)");
  }
  if (header.DoublePoints)
  {
    file.Notes.emplace_back(path +
      ": double coordinates of .ply files are read in single "
      "precision; .vtk and .vtp keep them");
  }
  return file;
}

MeshFile ReadStl(const std::string& path, VTKMessages& messages)
{
  CheckStl(path);
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  reader->MergingOff(); // its merging drops triangles that collapse
  return { Update(reader, path, messages), {}, true };
}

MeshFile ReadObj(const std::string& path, VTKMessages& messages)
{
  const ObjSummary summary = CheckObj(path);
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(path.c_str());
  const auto mesh = Update(reader, path, messages);
  if (summary.Groups == 0)
  {
    mesh->GetCellData()->RemoveArray("GroupIds"); // vtkOBJReader always adds it
  }
  return { mesh, {}, summary.TextureCoordinates + summary.Normals > 0 };
}

}

MeshFile ReadUnmerged(const std::string& path, MeshFormat format, VTKMessages& messages)
{
  CheckReadable(path);
  switch (format)
  {
    case MeshFormat::VTK:
      return ReadLegacy(path, messages);
    case MeshFormat::VTP:
      return ReadXml(path, messages);
    case MeshFormat::PLY:
      return ReadPly(path, messages);
    case MeshFormat::STL:
      return ReadStl(path, messages);
    case MeshFormat::OBJ:
      break;
  }
  return ReadObj(path, messages);
}

MeshFile ReadMesh(const std::string& path, MeshFormat format, VTKMessages& messages)
{
  MeshFile file = ReadUnmerged(path, format, messages);
  const vtkIdType merged = file.RepeatsPoints ? MergeCoincidentPoints(file.Mesh) : 0;
  if (merged > 0 && format == MeshFormat::OBJ)
  {
    file.Notes.push_back(path + ": merged " + std::to_string(merged) +
      " points that coincide (the file repeats them for texture coordinates and normals)");
  }
  return file;
}

}
