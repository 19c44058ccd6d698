// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshWriter.h"

#include "CommandError.h"
#include "Console.h"
#include "Counted.h"
#include "DiskSpace.h"
#include "FloatPoints.h"
#include "MeshReader.h"
#include "ObjWriter.h"
#include "PlyWriter.h"
#include "XmlWriter.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <fstream>

namespace delaunayflip
{

namespace
{

template <typename Writer>
void Run(Writer* writer, const std::string& path, VTKMessages& messages)
{
  writer->SetFileName(path.c_str());
  const bool written = writer->Write() != 0;
  const std::string problems = messages.TakeProblems();
  if (writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError)
  {
    throw CommandError(ExitCode::BadFile, "no space for the whole file");
  }
  if (!written || !problems.empty() || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw CommandError(ExitCode::BadFile, problems.empty() ? "the writer failed" : problems);
  }
}

void WriteLegacy(vtkPolyData* mesh, const std::string& path, VTKMessages& messages)
{
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileTypeToBinary();
  Run(writer.Get(), path, messages);
}

void TellProgress(vtkObject* writer, unsigned long, void* tell, void*)
{
  (*static_cast<const WriteObserver*>(tell))(vtkAlgorithm::SafeDownCast(writer)->GetProgress());
}

/// Reports progress, because this is the one format that takes long to write.
void WriteXml(
  vtkPolyData* mesh, const std::string& path, VTKMessages& messages, const WriteObserver& tell)
{
  const vtkSmartPointer<vtkXMLPolyDataWriter> writer = MakeXmlWriter();
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(TellProgress);
  progress->SetClientData(const_cast<WriteObserver*>(&tell));
  writer->AddObserver(vtkCommand::ProgressEvent, progress);
  writer->SetDataModeToBinary(); // inline: Debian's ParaView 5.11 fails on appended data
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToLZ4(); // a fifth of zlib's time, for files half as large again
  SetXmlInput(writer, mesh);
  Run(writer.Get(), path, messages);
}

void WriteStl(vtkPolyData* mesh, const std::string& path, VTKMessages& messages)
{
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileTypeToBinary();
  Run(writer.Get(), path, messages);
}

void RequireSizes(vtkCellArray* cells, vtkIdType fewest, const std::string& what)
{
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    const vtkIdType size = cells->GetCellSize(cell);
    if (size < fewest)
    {
      throw CommandError(ExitCode::BadFile,
        what + " " + std::to_string(cell) + " has " + Counted(size, "point") +
          ", too few for this file format; a .vtk can hold it");
    }
  }
}

/// A .vtp ends its strings with zeros, so a string that has one is read back as two.
void RequireStrings(vtkFieldData* data)
{
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    auto* const strings = vtkStringArray::SafeDownCast(data->GetAbstractArray(index));
    for (vtkIdType i = 0; strings && i < strings->GetNumberOfValues(); ++i)
    {
      if (strings->GetValue(i).find('\0') != std::string::npos)
      {
        throw CommandError(ExitCode::BadFile,
          "a string of the array '" + std::string(strings->GetName() ? strings->GetName() : "") +
            "' contains a zero byte, which this file format cannot hold; a .vtk can hold it");
      }
    }
  }
}

/// On cells with fewer points than their kind needs, VTK's writers crash (.vtp) or write files that
/// no program can read; its .stl writer makes large coordinates infinite.
void RequireStorable(vtkPolyData* mesh, MeshFormat format)
{
  const bool isXml = format == MeshFormat::VTP;
  if (isXml)
  {
    RequireStrings(mesh->GetFieldData());
    RequireStrings(mesh->GetPointData());
    RequireStrings(mesh->GetCellData());
    RequireSizes(mesh->GetStrips(), 3, "strip");
  }
  if (isXml || format == MeshFormat::OBJ)
  {
    RequireSizes(mesh->GetVerts(), 1, "vert");
    RequireSizes(mesh->GetLines(), 2, "line");
  }
  if (isXml || format == MeshFormat::OBJ || format == MeshFormat::STL)
  {
    RequireSizes(mesh->GetPolys(), 3, "polygon");
  }
  if (format == MeshFormat::STL)
  {
    RequireFloatRange(mesh);
  }
}

void WriteUnchecked(vtkPolyData* mesh, const std::string& path, MeshFormat format,
  VTKMessages& messages, const WriteObserver& tell)
{
  switch (format)
  {
    case MeshFormat::VTK:
      return WriteLegacy(mesh, path, messages);
    case MeshFormat::VTP:
      return WriteXml(mesh, path, messages, tell);
    case MeshFormat::PLY:
      return WritePly(mesh, path);
    case MeshFormat::STL:
      return WriteStl(mesh, path, messages);
    case MeshFormat::OBJ:
      return WriteObj(mesh, path);
  }
}

/// Whether the last line is complete: text cut off within it may be readable, but wrong.
bool IsEnded(const std::string& path, MeshFormat format)
{
  if (format == MeshFormat::PLY || format == MeshFormat::STL)
  {
    return true; // the reader checks the length of their binary form
  }
  const std::string ending = format == MeshFormat::VTP ? "</VTKFile>\n" : "\n";
  std::ifstream file(path, std::ios::binary);
  std::string last(ending.size(), ' ');
  file.seekg(-static_cast<std::streamoff>(ending.size()), std::ios::end);
  file.read(last.data(), static_cast<std::streamsize>(last.size()));
  return file && last == ending;
}

bool HasSameCounts(vtkPolyData* mesh, vtkPolyData* written, MeshFormat format)
{
  const bool keepsPoints = format != MeshFormat::STL;
  const bool keepsAll = format == MeshFormat::VTK || format == MeshFormat::VTP;
  return mesh->GetNumberOfPolys() == written->GetNumberOfPolys() &&
    (!keepsPoints || mesh->GetNumberOfPoints() == written->GetNumberOfPoints()) &&
    (!keepsAll || mesh->GetNumberOfCells() == written->GetNumberOfCells());
}

}

void WriteMesh(vtkPolyData* mesh, const std::string& path, MeshFormat format, VTKMessages& messages,
  const WriteObserver& tell)
{
  RequireStorable(mesh, format);
  std::string difference;
  try
  {
    WriteUnchecked(mesh, path, format, messages, tell);
    const FileMesh written = ReadMesh(path, format, messages);
    if (IsEnded(path, format) && HasSameCounts(mesh, written.Mesh, format))
    {
      return;
    }
    difference = "the file is incomplete when read back";
  }
  catch (const CommandError& error)
  {
    // The user does not know the temporary file, so the message does not name it.
    difference = error.what();
    const std::size_t name = difference.find(path + ": ");
    difference.erase(0, name == 0 ? path.size() + 2 : 0);
  }
  throw CommandError(ExitCode::BadFile, difference + ExplainFailedWrite(path));
}

}
