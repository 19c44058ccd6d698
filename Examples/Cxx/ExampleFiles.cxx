// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExampleFiles.h"

#include "BadMesh.h"
#include "ReadMeshFile.h"

#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipLiveView.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkXMLPolyDataWriter.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <map>
#include <stdexcept>

namespace
{

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
  return HasKnownExtension(file)
    ? ""
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
  try
  {
    return this->Mesh.empty() ? MakeBadMesh() : ReadMeshFile(this->Mesh);
  }
  catch (const std::runtime_error& error)
  {
    Fail(BadFile, error.what());
    return nullptr;
  }
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
  vtkDelaunayFlip* flip = view->GetFilter();
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
