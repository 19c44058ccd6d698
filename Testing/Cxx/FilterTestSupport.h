// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterTestSupport_h
#define FilterTestSupport_h

#include "GeneratedMeshes.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDelaunayFlip.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

/// Meshes and helpers for the tests of vtkDelaunayFlip.

using Points = std::vector<std::array<double, 3>>;
using Cell = std::vector<vtkIdType>;
using Cells = std::vector<Cell>;

/// A mesh with double points and polygons.
vtkSmartPointer<vtkPolyData> MakeMesh(const Points& points, const Cells& polygons);

/// A rhombus of points 0 (left), 1 (below), 2 (right), 3 (above), divided along its long diagonal
/// 0-2 into triangles (0, 1, 2) and (0, 2, 3). One flip, to 1-3, makes it Delaunay.
vtkSmartPointer<vtkPolyData> MakeRhombus();

/// The rhombus and another part, which must not keep it from being processed. The other points are
/// numbered from 4.
vtkSmartPointer<vtkPolyData> MakeRhombusAnd(const Points& points, const Cells& polygons);

/// Whether `part` occurs in `text`.
bool Holds(const std::string& text, const std::string& part);

/// The point ids of a cell.
Cell GetCell(vtkPolyData* mesh, vtkIdType cell);

/// The cells of a cell array.
Cells GetCells(vtkCellArray* cells);
vtkSmartPointer<vtkCellArray> MakeCells(const Cells& cells);

/// Whether two points are joined by an edge of some polygon.
bool HasEdge(vtkPolyData* mesh, vtkIdType a, vtkIdType b);

/// Adds an int array that numbers cells or points from `first`.
void AddNumbers(vtkDataSetAttributes* data, const char* name, vtkIdType count, int first);
std::vector<int> GetNumbers(vtkDataSetAttributes* data, const char* name);

template <typename Real>
vtkSmartPointer<vtkPolyData> ToPolyData(const delaunayflip::OwnedMesh<Real>& mesh)
{
  Points points;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    points.push_back({ mesh.Points[i], mesh.Points[i + 1], mesh.Points[i + 2] });
  }
  Cells triangles;
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    triangles.push_back({ mesh.Triangles[i], mesh.Triangles[i + 1], mesh.Triangles[i + 2] });
  }
  return MakeMesh(points, triangles);
}

/// Points and triangles for the audit functions; the mesh must have triangles only.
delaunayflip::OwnedMesh<double> ToOwnedMesh(vtkPolyData* mesh);

/// The number of edges that violate the in-circle criterion (the opposite-angle sum on surfaces).
long long CountViolations(vtkPolyData* mesh);

/// Chooses the GPU, for meshes of any size, if DELAUNAYFLIP_TEST_BACKEND says so.
void SetTestBackend(vtkDelaunayFlip* filter);

/// A filter that records its errors and warnings, and those of its executive. It runs on the
/// backend of SetTestBackend until a test chooses one.
class WatchedFilter
{
public:
  WatchedFilter();
  explicit WatchedFilter(vtkPolyData* input);

  vtkDelaunayFlip* operator->() { return this->Filter; }
  vtkDelaunayFlip* Get() { return this->Filter; }

  /// Updates, and returns output port 0.
  vtkPolyData* Run();

  const std::vector<std::string>& GetErrors() const { return this->Errors; }
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }
  const std::vector<std::string>& GetExecutiveErrors() const { return this->ExecutiveErrors; }

private:
  void Watch(vtkObject* object, unsigned long event, std::vector<std::string>* messages);

  vtkNew<vtkDelaunayFlip> Filter;
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  std::vector<std::string> ExecutiveErrors;
};

/// Calls a function at every progress event.
template <typename Action>
void OnProgress(vtkDelaunayFlip* filter, Action& action)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&action);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* target, void*) { (*static_cast<Action*>(target))(); });
  filter->AddObserver(vtkCommand::ProgressEvent, command);
}

/// Runs a filter that must have neither an error nor a warning.
vtkSmartPointer<vtkPolyData> RunCleanly(WatchedFilter& filter);

#endif
