// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: mpirun -n RANKS FlipInParallel OUTPUT.pvtp [INPUT.vtp] [--planar-xy]
///
/// Divides a mesh (default: a generated bad one) among the ranks, flips it as one, and writes the
/// pieces: OUTPUT.pvtp and a .vtp for each rank. Triangles have the number of their rank as array
/// "piece". --planar-xy: judge edges by x and y alone, for terrain. Exit status: 0 done; 2 wrong
/// usage; 3 a file cannot be read or written.

#include "BadMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkPDelaunayFlip.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPPolyDataWriter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace
{

vtkSmartPointer<vtkPolyData> ReadMesh(const char* file)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file);
  reader->Update();
  return reader->GetOutput();
}

/// The cells of a mesh from left to right.
std::vector<vtkIdType> SortCells(vtkPolyData* mesh)
{
  std::vector<std::pair<double, vtkIdType>> order(mesh->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    const double* bounds = mesh->GetCell(cell)->GetBounds();
    order[cell] = { bounds[0] + bounds[1], cell };
  }
  std::sort(order.begin(), order.end());
  std::vector<vtkIdType> cells;
  for (const auto& entry : order)
  {
    cells.push_back(entry.second);
  }
  return cells;
}

/// The part of a mesh that a rank has. Its points are those of the other parts with the same global
/// ids.
vtkSmartPointer<vtkPolyData> CutPiece(vtkPolyData* mesh, int rank, int ranks)
{
  const std::vector<vtkIdType> cells = SortCells(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataType(mesh->GetPoints()->GetDataType());
  vtkNew<vtkIdTypeArray> globalIds;
  globalIds->SetName("GlobalPointIds");
  vtkNew<vtkCellArray> triangles;
  std::map<vtkIdType, vtkIdType> ids; // in the piece, by those in the mesh
  const auto addPoint = [&](vtkIdType id)
  {
    const auto added = ids.emplace(id, points->GetNumberOfPoints());
    if (added.second)
    {
      points->InsertNextPoint(mesh->GetPoint(id));
      globalIds->InsertNextValue(id);
    }
    return added.first->second;
  };
  for (std::size_t i = cells.size() * rank / ranks; i < cells.size() * (rank + 1) / ranks; ++i)
  {
    vtkIdList* corners = mesh->GetCell(cells[i])->GetPointIds();
    triangles->InsertNextCell(static_cast<int>(corners->GetNumberOfIds()));
    for (const vtkIdType id : *corners)
    {
      triangles->InsertCellPoint(addPoint(id));
    }
  }
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->SetPoints(points);
  piece->SetPolys(triangles);
  piece->GetPointData()->SetGlobalIds(globalIds);
  return piece;
}

void NameRank(vtkPolyData* piece, int rank)
{
  vtkNew<vtkIntArray> ranks;
  ranks->SetName("piece");
  ranks->SetNumberOfValues(piece->GetNumberOfCells());
  ranks->FillValue(rank);
  piece->GetCellData()->AddArray(ranks);
}

/// @returns whether all files were written.
bool Write(vtkPolyData* piece, const char* file, vtkMultiProcessController* controller)
{
  vtkNew<vtkXMLPPolyDataWriter> writer;
  writer->SetController(controller);
  writer->SetFileName(file);
  writer->SetDataModeToBinary();
  writer->SetNumberOfPieces(controller->GetNumberOfProcesses());
  writer->SetStartPiece(controller->GetLocalProcessId());
  writer->SetEndPiece(controller->GetLocalProcessId());
  writer->SetInputData(piece);
  return writer->Write() != 0;
}

int Run(int argc, char** argv, vtkMultiProcessController* controller)
{
  const int rank = controller->GetLocalProcessId(), ranks = controller->GetNumberOfProcesses();
  std::vector<std::string> files(argv + 1, argv + argc);
  const auto terrain = std::find(files.begin(), files.end(), "--planar-xy");
  const bool isTerrain = terrain != files.end();
  files.erase(terrain, isTerrain ? terrain + 1 : terrain);
  if (files.empty() || files.size() > 2 || files[0][0] == '-')
  {
    if (rank == 0)
    {
      std::cerr << "usage: mpirun -n RANKS " << argv[0]
                << " OUTPUT.pvtp [INPUT.vtp] [--planar-xy]\nDivides a mesh among the ranks, flips "
                   "it as one, and writes the pieces.\n";
    }
    return files.size() == 1 && files[0] == "--help" ? 0 : 2;
  }
  const vtkSmartPointer<vtkPolyData> mesh =
    files.size() == 2 ? ReadMesh(files[1].c_str()) : MakeBadMesh();
  if (mesh->GetNumberOfCells() == 0)
  {
    return 3; // the reader has said why
  }
  vtkNew<vtkPDelaunayFlip> flip;
  flip->SetGeometry(
    isTerrain ? vtkPDelaunayFlip::GEOMETRY_PLANAR_XY : vtkPDelaunayFlip::GEOMETRY_AUTO);
  flip->SetInputData(CutPiece(mesh, rank, ranks));
  flip->UpdatePiece(rank, ranks, 0);
  NameRank(flip->GetOutput(), rank);
  if (rank == 0)
  {
    std::cout << flip->GetTotalFlips() << " flips in " << flip->GetNumberOfRounds() << " rounds on "
              << ranks << " ranks, " << flip->GetNonDelaunayAfter() << " bad edges left\n";
  }
  return Write(flip->GetOutput(), files[0].c_str(), controller) ? 0 : 3;
}

}

int main(int argc, char** argv)
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller); // vtkPDelaunayFlip's ranks
  const int status = Run(argc, argv, controller);
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return status;
}
