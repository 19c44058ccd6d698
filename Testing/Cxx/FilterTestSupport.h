// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterTestSupport_h
#define FilterTestSupport_h

#include "GeneratedMeshes.h"

#include "vtkCommand.h"
#include "vtkDelaunayFlip.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

/// Meshes and helpers for the tests of vtkDelaunayFlip.

using Mesh = vtkSmartPointer<vtkPolyData>;
using Points = std::vector<std::array<double, 3>>;
using Cell = std::vector<vtkIdType>;
using Cells = std::vector<Cell>;

/// A mesh with double points and polygons, one with lines, and lines without points.
Mesh MakeMesh(const Points& points, const Cells& polygons);
Mesh MakeLines(const Points& points, const Cells& lines);
Mesh MakeLines(const Cells& lines);

vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks(const std::vector<vtkDataObject*>& leaves);

/// A rhombus of points 0 (left), 1 (below), 2 (right), 3 (above), divided along its long diagonal
/// 0-2 into triangles (0, 1, 2) and (0, 2, 3). One flip, to 1-3, makes it Delaunay.
Mesh MakeRhombus();

/// The rhombus and another part, which must not keep it from being processed. The other points are
/// numbered from 4.
Mesh MakeRhombusAnd(const Points& points, const Cells& polygons);

/// The rhombus as one quad, and a triangle of points 4, 5, 6 beside it.
Mesh MakeQuadAndTriangle();

/// A random bad mesh of 400 points, and a closed surface with bad triangles.
Mesh MakeBadPlane();
Mesh MakeBadSphere();

/// That `part` occurs in `text`.
void ExpectHolds(const std::string& text, const std::string& part);

/// The point ids of a cell.
Cell GetCell(vtkPolyData* mesh, vtkIdType cell);

/// The cells of a cell array.
Cells GetCells(vtkCellArray* cells);
vtkSmartPointer<vtkCellArray> MakeCells(const Cells& cells);

/// The triangles of a mesh without other polygons, whatever their order and first corner.
std::set<std::set<vtkIdType>> GetTriangles(vtkPolyData* mesh);

/// Whether two points are joined by an edge of some polygon.
bool HasEdge(vtkPolyData* mesh, vtkIdType a, vtkIdType b);

/// Adds an int array that numbers cells or points from `first`.
void AddNumbers(vtkDataSetAttributes* data, const char* name, vtkIdType count, int first);
std::vector<int> GetNumbers(vtkDataSetAttributes* data, const char* name);

/// An array without values so far.
template <typename ArrayT>
vtkSmartPointer<ArrayT> MakeArray(const char* name, vtkIdType tuples, int components = 1)
{
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Gives a mesh points of this array type. `change` may change a point's coordinates before.
template <typename ArrayT>
void ReplacePoints(
  vtkPolyData* mesh, const std::function<void(double*)>& change = [](double*) {})
{
  const auto array = MakeArray<ArrayT>("Points", mesh->GetNumberOfPoints(), 3);
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double x[3];
    mesh->GetPoint(point, x);
    change(x);
    array->SetTuple(point, x);
  }
  vtkNew<vtkPoints> points;
  points->SetData(array);
  mesh->SetPoints(points);
}

/// Changes the points in place.
void MovePoints(vtkPolyData* mesh, const std::function<void(double*)>& change);

/// Moves the points in place by a shear, which makes other edges bad.
void Shear(vtkPolyData* mesh, double factor);

/// Results in the field data, by their names without "DelaunayFlip:". 0 in rows that are missing.
double GetTotal(vtkPolyData* mesh, const std::string& name, vtkIdType row = 0);
std::string GetText(vtkPolyData* mesh, const std::string& name);

template <typename Real>
Mesh ToPolyData(const delaunayflip::OwnedMesh<Real>& mesh)
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
void SetTestBackend(vtkDelaunayFlipAlgorithm* filter);

/// A filter that records its errors and warnings, and those of its executive. It runs on the
/// backend of SetTestBackend until a test chooses one.
class WatchedAlgorithm
{
public:
  explicit WatchedAlgorithm(vtkDelaunayFlipAlgorithm* filter);

  vtkDelaunayFlipAlgorithm* GetAlgorithm() { return this->Filter; }

  /// Updates, and returns output port 0; null if that is composite.
  vtkPolyData* Run();

  /// A block of the output that is a mesh; null if there is none.
  vtkPolyData* GetBlock(unsigned int number);

  /// The polygons of the output.
  Cells GetPolygons() { return GetCells(this->Filter->GetOutput()->GetPolys()); }

  /// The value in a row of the table of iterations.
  double GetRow(const char* column, vtkIdType row);

  const std::vector<std::string>& GetErrors() const { return this->Errors; }
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }
  const std::vector<std::string>& GetExecutiveErrors() const { return this->ExecutiveErrors; }

private:
  vtkSmartPointer<vtkDelaunayFlipAlgorithm> Filter;
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  std::vector<std::string> ExecutiveErrors;
};

template <typename FilterT>
class Watched : public WatchedAlgorithm
{
public:
  Watched()
    : WatchedAlgorithm(vtkNew<FilterT>())
  {
  }
  explicit Watched(vtkDataObject* input)
    : Watched()
  {
    this->Get()->SetInputDataObject(input);
  }

  FilterT* operator->() { return this->Get(); }
  FilterT* Get() { return static_cast<FilterT*>(this->GetAlgorithm()); }
};

using WatchedFilter = Watched<vtkDelaunayFlip>;

/// Calls a function with the data of every event of an object, or without. @returns the observer.
unsigned long Observe(
  vtkObject* object, unsigned long event, const std::function<void(void*)>& action);
void OnEvent(vtkObject* object, unsigned long event, const std::function<void()>& action);

/// Calls a function at every progress event.
void OnProgress(vtkAlgorithm* filter, const std::function<void()>& action);

/// Runs a filter that must have neither an error nor a warning.
Mesh RunCleanly(WatchedAlgorithm& filter);

/// Runs a filter that must give one warning and no error. @returns the warning.
std::string RunToWarning(WatchedAlgorithm& filter);

/// Runs a filter that must fail with one more error, leave its output empty, and tell of this kind
/// of failure. @returns the error.
std::string RunToError(WatchedAlgorithm& filter, int failure = vtkDelaunayFlip::FAILURE_MESH);

/// The polygons after a single update with some options.
Cells FlipAtOnce(
  vtkPolyData* mesh, const std::function<void(vtkDelaunayFlip*)>& set = [](vtkDelaunayFlip*) {});

/// Updates a live run until nothing is left to do. @returns the number of updates.
int RunToTheEnd(WatchedAlgorithm& filter);

/// A filter with LiveUpdate on.
class LiveFilter : public WatchedFilter
{
public:
  explicit LiveFilter(vtkPolyData* input);

  /// Updates until nothing is left to do. @returns the number of updates.
  int RunToTheEnd() { return ::RunToTheEnd(*this); }
};

#endif
