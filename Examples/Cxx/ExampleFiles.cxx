// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExampleFiles.h"

#include "BadMesh.h"

#include <vtkCleanPolyData.h>
#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipLiveView.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyDataReader.h>
#include <vtkRenderWindow.h>
#include <vtkSTLReader.h>
#include <vtkStringOutputWindow.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtksys/SystemTools.hxx>

#include <CLI/CLI.hpp>

#include <iostream>
#include <map>

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
    return "cannot be read: VTK's reader crashed; the file is probably truncated or corrupt";
  }
  reader->Update();
  const std::string problem = messages.GetFirst();
  const bool isEmpty = GetMesh(reader)->GetNumberOfCells() == 0;
  return !problem.empty() ? "cannot be read: " + problem
    : isEmpty             ? "cannot be read: no mesh in it"
                          : "";
}

const std::map<std::string, int> Geometries = { { "auto", vtkDelaunayFlip::GEOMETRY_AUTO },
  { "planar", vtkDelaunayFlip::GEOMETRY_PLANAR },
  { "planar-xy", vtkDelaunayFlip::GEOMETRY_PLANAR_XY },
  { "surface", vtkDelaunayFlip::GEOMETRY_SURFACE } };

int Fail(ExitStatus status, const std::string& message)
{
  std::cerr << "error: " << message << "\n";
  return status;
}

std::string CheckExtension(const std::string& file)
{
  return MakeReader(file) ? ""
                          : file + ": unknown file extension; known are .vtk .vtp .ply .stl .obj";
}

}

std::optional<int> ExampleFiles::ReadArguments(int argc, char* argv[])
{
  CLI::App app(
    "Shows in a window how flips make a mesh Delaunay. The window explains the keys.", "LiveFlip");
  app.footer("Exit status: 0 done; 2 wrong usage; 3 a file cannot be read, written or used.");
  app
    .add_option(
      "MESH", this->Mesh, "File to read: .vtk .vtp .ply .stl .obj (default: a generated bad mesh)")
    ->check(CheckExtension);
  app
    .add_option("--geometry", this->Geometry,
      "Where edges are judged; planar-xy: by x and y, for terrain (default: auto)")
    ->check(CLI::IsMember(Geometries));
  app.add_option("--frames", this->FramePrefix,
    "Open no window, but write every step as FRAMES0000.png, FRAMES0001.png and so on, "
    "and the last mesh as FRAMES.vtp");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? Done : WrongUsage;
  }
  return std::nullopt;
}

vtkSmartPointer<vtkPolyData> ExampleFiles::ReadMesh() const
{
  if (this->Mesh.empty())
  {
    return MakeBadMesh();
  }
  const bool isReadable = vtksys::SystemTools::TestFileAccess(this->Mesh, vtksys::TEST_FILE_READ) &&
    !vtksys::SystemTools::FileIsDirectory(this->Mesh);
  const auto reader = MakeReader(this->Mesh);
  const std::string problem =
    isReadable ? Update(reader) : "no such file, or no permission to read it";
  if (!problem.empty())
  {
    Fail(BadFile, this->Mesh + ": " + problem);
    return nullptr;
  }
  return GetMesh(reader);
}

int ExampleFiles::GetGeometry() const { return Geometries.at(this->Geometry); }

int ExampleFiles::WriteFrames(vtkDelaunayFlipLiveView* view, vtkRenderWindow* window) const
{
  window->OffScreenRenderingOn();
  window->SetMultiSamples(0);
  window->SetSize(360, 360);
  view->SetFramePrefix(this->FramePrefix.c_str());
  while (view->Step())
  {
  }
  vtkDelaunayFlipAlgorithm* flip = view->GetFilter();
  if (!view->GetConverged())
  {
    const bool isWrong = flip->GetFailure() == vtkDelaunayFlip::FAILURE_OPTIONS;
    return Fail(isWrong ? WrongUsage : BadFile, flip->GetErrorMessage());
  }
  std::cout << view->GetFrameNumber() << " steps, " << flip->GetTotalFlips() << " flips\n";
  return this->WriteMesh(flip->GetOutputPort());
}

int ExampleFiles::WriteMesh(vtkAlgorithmOutput* mesh) const
{
  const std::string file = this->FramePrefix + ".vtp";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary(); // ParaView 5.11 with a newer expat fails on appended data
  writer->SetInputConnection(mesh);
  writer->SetFileName(file.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0 ? Done : Fail(BadFile, file + ": cannot be written");
}
