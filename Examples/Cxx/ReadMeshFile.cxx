// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReadMeshFile.h"

#include <vtkCleanPolyData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkStringOutputWindow.h>
#include <vtkXMLPolyDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

std::string GetExtension(const std::string& file)
{
  return vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(file));
}

template <typename Reader>
vtkSmartPointer<vtkAlgorithm> Make(const std::string& file)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

/// Merges coincident points: vtkOBJReader repeats them for every normal and texture coordinate.
vtkSmartPointer<vtkAlgorithm> MakeObjReader(const std::string& file)
{
  auto clean = vtkSmartPointer<vtkCleanPolyData>::New();
  clean->SetInputConnection(Make<vtkOBJReader>(file)->GetOutputPort());
  clean->SetTolerance(0.0);
  return clean;
}

vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& file)
{
  const std::string extension = GetExtension(file);
  return extension == ".vtk" ? Make<vtkPolyDataReader>(file)
    : extension == ".vtp"    ? Make<vtkXMLPolyDataReader>(file)
    : extension == ".ply"    ? Make<vtkPLYReader>(file)
    : extension == ".stl"    ? Make<vtkSTLReader>(file)
    : extension == ".obj"    ? MakeObjReader(file)
                             : nullptr;
}

vtkPolyData* GetMesh(vtkAlgorithm* reader)
{
  return vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
}

/// Whether the reader can read the file. It runs in a child process, because some truncated files
/// crash it.
bool Survives(vtkAlgorithm* reader)
{
  const pid_t child = fork();
  if (child == 0)
  {
    reader->Update();
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status == 0;
}

/// Collects the messages of VTK during its lifetime.
class Messages
{
public:
  Messages()
  {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(this->Window);
  }
  ~Messages()
  {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);
    vtkOutputWindow::SetInstance(nullptr);
  }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  /// The second line of the messages, since the first one names a source file of VTK; empty if
  /// there are none.
  std::string GetFirst()
  {
    const std::string all = this->Window->GetOutput();
    const std::size_t begin = all.find('\n') + 1;
    return all.substr(begin, all.find('\n', begin) - begin);
  }

private:
  vtkNew<vtkStringOutputWindow> Window;
};

/// What is wrong, or empty.
std::string Update(vtkAlgorithm* reader)
{
  Messages messages;
  if (!Survives(reader))
  {
    return "VTK's reader crashed; the file is probably truncated or corrupt";
  }
  reader->Update();
  const std::string problem = messages.GetFirst();
  const bool isEmpty = GetMesh(reader)->GetNumberOfCells() == 0;
  return problem.empty() && isEmpty ? "no mesh in it" : problem;
}

}

bool HasKnownExtension(const std::string& file) { return MakeReader(file) != nullptr; }

vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& file)
{
  if (!vtksys::SystemTools::TestFileAccess(file, vtksys::TEST_FILE_READ) ||
    vtksys::SystemTools::FileIsDirectory(file))
  {
    throw std::runtime_error(file + ": no such file, or no permission to read it");
  }
  const auto reader = MakeReader(file);
  const std::string problem = Update(reader);
  if (!problem.empty())
  {
    throw std::runtime_error(file + ": cannot be read: " + problem);
  }
  return GetMesh(reader);
}
