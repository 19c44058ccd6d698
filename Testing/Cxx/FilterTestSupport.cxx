// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterTestSupport.h"

#include "MeshAudit.h"
#include "TestBackend.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

namespace
{

/// A command that owns the function that it calls.
class FunctionCommand : public vtkCommand
{
public:
  static FunctionCommand* New() { return new FunctionCommand; }
  void Execute(vtkObject*, unsigned long, void* data) override { this->Action(data); }

  std::function<void(void*)> Action;
};

}

vtkSmartPointer<vtkCellArray> MakeCells(const Cells& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const Cell& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

Mesh MakeMesh(const Points& points, const Cells& polygons)
{
  vtkNew<vtkPoints> array;
  array->SetDataTypeToDouble();
  for (const std::array<double, 3>& point : points)
  {
    array->InsertNextPoint(point.data());
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(array);
  mesh->SetPolys(MakeCells(polygons));
  return mesh;
}

Mesh MakeLines(const Points& points, const Cells& lines)
{
  auto mesh = MakeMesh(points, {});
  mesh->SetLines(MakeCells(lines));
  return mesh;
}

Mesh MakeLines(const Cells& lines)
{
  auto mesh = Mesh::New();
  mesh->SetLines(MakeCells(lines));
  return mesh;
}

vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks(const std::vector<vtkDataObject*>& leaves)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i), leaves[i]);
  }
  return blocks;
}

Mesh MakeRhombus()
{
  return MakeMesh(
    { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
}

Mesh MakeRhombusAnd(const Points& points, const Cells& polygons)
{
  auto mesh = MakeRhombus();
  for (const auto& point : points)
  {
    mesh->GetPoints()->InsertNextPoint(point.data());
  }
  for (const Cell& cell : polygons)
  {
    mesh->GetPolys()->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return mesh;
}

Mesh MakeQuadAndTriangle()
{
  return MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 10, 0, 0 },
                    { 11, 0, 0 }, { 10, 1, 0 } },
    { { 0, 1, 2, 3 }, { 4, 5, 6 } });
}

Mesh MakeBadPlane() { return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(400, 3)); }

Mesh MakeBadSphere() { return ToPolyData(delaunayflip::MakeBadSphere(40, 20, 4)); }

void ExpectHolds(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << '"' << text << "\" lacks \"" << part << '"';
}

Cell GetCell(vtkPolyData* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  return Cell(ids->begin(), ids->end());
}

Cells GetCells(vtkCellArray* cells)
{
  Cells result;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    result.emplace_back(ids->begin(), ids->end());
  }
  return result;
}

std::set<std::set<vtkIdType>> GetTriangles(vtkPolyData* mesh)
{
  std::set<std::set<vtkIdType>> triangles;
  for (const Cell& cell : GetCells(mesh->GetPolys()))
  {
    EXPECT_EQ(cell.size(), 3u);
    triangles.emplace(cell.begin(), cell.end());
  }
  return triangles;
}

bool HasEdge(vtkPolyData* mesh, vtkIdType a, vtkIdType b)
{
  for (const Cell& cell : GetCells(mesh->GetPolys()))
  {
    for (std::size_t i = 0; i < cell.size(); ++i)
    {
      const vtkIdType from = cell[i];
      const vtkIdType to = cell[(i + 1) % cell.size()];
      if ((from == a && to == b) || (from == b && to == a))
      {
        return true;
      }
    }
  }
  return false;
}

void AddNumbers(vtkDataSetAttributes* data, const char* name, vtkIdType count, int first)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->InsertNextValue(first + static_cast<int>(i));
  }
  data->AddArray(array);
}

std::vector<int> GetNumbers(vtkDataSetAttributes* data, const char* name)
{
  auto* array = vtkIntArray::SafeDownCast(data->GetArray(name));
  if (!array)
  {
    ADD_FAILURE() << "no int array " << name;
    return {};
  }
  return std::vector<int>(array->GetPointer(0), array->GetPointer(array->GetNumberOfValues()));
}

void MovePoints(vtkPolyData* mesh, const std::function<void(double*)>& change)
{
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double x[3];
    mesh->GetPoint(point, x);
    change(x);
    mesh->GetPoints()->SetPoint(point, x);
  }
  mesh->GetPoints()->Modified();
}

void Shear(vtkPolyData* mesh, double factor)
{
  MovePoints(mesh, [factor](double* x) { x[0] += factor * x[1]; });
}

double GetTotal(vtkPolyData* mesh, const std::string& name, vtkIdType row)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(("DelaunayFlip:" + name).c_str());
  EXPECT_NE(array, nullptr) << name;
  return array && row < array->GetNumberOfTuples() ? array->GetComponent(row, 0) : 0.0;
}

std::string GetText(vtkPolyData* mesh, const std::string& name)
{
  auto* array = vtkStringArray::SafeDownCast(
    mesh->GetFieldData()->GetAbstractArray(("DelaunayFlip:" + name).c_str()));
  EXPECT_NE(array, nullptr) << name;
  return array ? array->GetValue(0) : "";
}

delaunayflip::OwnedMesh<double> ToOwnedMesh(vtkPolyData* mesh)
{
  delaunayflip::OwnedMesh<double> owned;
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    const double* xyz = mesh->GetPoint(point);
    owned.Points.insert(owned.Points.end(), xyz, xyz + 3);
  }
  for (const Cell& cell : GetCells(mesh->GetPolys()))
  {
    EXPECT_EQ(cell.size(), 3u);
    owned.Triangles.insert(owned.Triangles.end(), cell.begin(), cell.end());
  }
  return owned;
}

long long CountViolations(vtkPolyData* mesh)
{
  return delaunayflip::CountNonDelaunayEdges(ToOwnedMesh(mesh).View(), {});
}

void SetTestBackend(vtkDelaunayFlipAlgorithm* filter)
{
  if (delaunayflip::IsTestBackendCuda())
  {
    filter->SetBackendToCUDA();
  }
}

unsigned long Observe(
  vtkObject* object, unsigned long event, const std::function<void(void*)>& action)
{
  vtkNew<FunctionCommand> command;
  command->Action = action;
  return object->AddObserver(event, command);
}

void OnEvent(vtkObject* object, unsigned long event, const std::function<void()>& action)
{
  Observe(object, event, [action](void*) { action(); });
}

void OnProgress(vtkAlgorithm* filter, const std::function<void()>& action)
{
  OnEvent(filter, vtkCommand::ProgressEvent, action);
}

WatchedAlgorithm::WatchedAlgorithm(vtkDelaunayFlipAlgorithm* filter)
  : Filter(filter)
{
  SetTestBackend(this->Filter);
  const auto addTo = [](std::vector<std::string>& messages)
  { return [&messages](void* text) { messages.emplace_back(static_cast<const char*>(text)); }; };
  Observe(this->Filter, vtkCommand::ErrorEvent, addTo(this->Errors));
  Observe(this->Filter, vtkCommand::WarningEvent, addTo(this->Warnings));
  Observe(this->Filter->GetExecutive(), vtkCommand::ErrorEvent, addTo(this->ExecutiveErrors));
}

vtkPolyData* WatchedAlgorithm::Run()
{
  this->Filter->Update();
  return this->Filter->GetOutput();
}

vtkPolyData* WatchedAlgorithm::GetBlock(unsigned int number)
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(this->Filter->GetOutputDataObject(0));
  return blocks ? vtkPolyData::SafeDownCast(blocks->GetBlock(number)) : nullptr;
}

double WatchedAlgorithm::GetRow(const char* column, vtkIdType row)
{
  return this->Filter->GetIterations()->GetValueByName(row, column).ToDouble();
}

Mesh RunCleanly(WatchedAlgorithm& filter)
{
  Mesh output = filter.Run();
  EXPECT_EQ(filter.GetErrors(), std::vector<std::string>{});
  EXPECT_EQ(filter.GetWarnings(), std::vector<std::string>{});
  return output;
}

std::string RunToWarning(WatchedAlgorithm& filter)
{
  filter.Run();
  EXPECT_EQ(filter.GetErrors(), std::vector<std::string>{});
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
  return filter.GetWarnings().empty() ? "" : filter.GetWarnings()[0];
}

std::string RunToError(WatchedAlgorithm& filter, int failure)
{
  const std::size_t before = filter.GetErrors().size();
  filter.Run();
  EXPECT_EQ(filter.GetAlgorithm()->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter.GetAlgorithm()->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter.GetAlgorithm()->GetStopReason(), vtkDelaunayFlip::STOP_REASON_FAILED);
  EXPECT_EQ(filter.GetAlgorithm()->GetFailure(), failure);
  EXPECT_EQ(filter.GetErrors().size(), before + 1);
  return filter.GetErrors().empty() ? "" : filter.GetErrors().back();
}

Cells FlipAtOnce(vtkPolyData* mesh, const std::function<void(vtkDelaunayFlip*)>& set)
{
  WatchedFilter filter(mesh);
  set(filter.Get());
  return GetCells(RunCleanly(filter)->GetPolys());
}

LiveFilter::LiveFilter(vtkPolyData* input)
  : WatchedFilter(input)
{
  (*this)->LiveUpdateOn();
}

int RunToTheEnd(WatchedAlgorithm& filter)
{
  constexpr int Most = 1000; // updates, after which the test fails
  int updates = 0;
  do
  {
    filter.Run();
    ++updates;
  } while (filter.GetAlgorithm()->Advance() && updates < Most);
  EXPECT_LT(updates, Most);
  return updates;
}
