// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// A live run ends with the same bits as a single update.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <sstream>
#include <vector>

namespace
{

std::string Print(vtkAbstractArray* array)
{
  std::ostringstream text;
  text << std::hexfloat;
  auto* numbers = vtkDataArray::SafeDownCast(array);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    const int components = array->GetNumberOfComponents();
    const int component = static_cast<int>(i % components);
    numbers ? text << numbers->GetComponent(i / components, component)
            : text << array->GetVariantValue(i).ToString();
    text << ' ';
  }
  return text.str();
}

/// Every array, except the seconds.
std::map<std::string, std::string> GetContents(vtkFieldData* data)
{
  std::map<std::string, std::string> contents;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string name = array->GetName();
    if (name.find("Seconds") == std::string::npos)
    {
      contents[name] = Print(array);
    }
  }
  return contents;
}

void ExpectSame(vtkDelaunayFlip* live, vtkDelaunayFlip* once)
{
  EXPECT_EQ(GetCells(live->GetOutput()->GetPolys()), GetCells(once->GetOutput()->GetPolys()));
  EXPECT_EQ(live->GetOutput()->GetPoints(), once->GetOutput()->GetPoints());
  EXPECT_EQ(GetContents(live->GetIterations()->GetRowData()),
    GetContents(once->GetIterations()->GetRowData()));
  EXPECT_EQ(
    GetContents(live->GetOutput()->GetFieldData()), GetContents(once->GetOutput()->GetFieldData()));
  EXPECT_EQ(
    GetContents(live->GetOutput()->GetCellData()), GetContents(once->GetOutput()->GetCellData()));
  EXPECT_EQ(live->GetTotalFlips(), once->GetTotalFlips());
  EXPECT_EQ(live->GetStopReason(), once->GetStopReason());
}

using Setting = std::function<void(vtkDelaunayFlip*)>;

/// Runs a mesh in a single update, and live with steps of several lengths.
void ExpectLiveIsAtOnce(vtkPolyData* mesh, const Setting& set)
{
  WatchedFilter once(mesh);
  once->GenerateFlipCountOn();
  once->GenerateQualityOn();
  set(once.Get());
  once.Run();
  EXPECT_TRUE(once.GetErrors().empty());
  EXPECT_GT(once->GetTotalFlips(), 0);
  EXPECT_TRUE(once->GetConverged());
  for (const vtkIdType step : { 0, 1, 7, 1000 }) // 0: as many as fit into a frame
  {
    LiveFilter live(mesh);
    live->GenerateFlipCountOn();
    live->GenerateQualityOn();
    live->SetIterationsPerUpdate(step);
    set(live.Get());
    const int updates = live.RunToTheEnd();
    const vtkIdType iterations = once->GetNumberOfIterations();
    EXPECT_TRUE(step == 0 ? updates <= iterations : updates == (iterations + step - 1) / step);
    ExpectSame(live.Get(), once.Get());
    EXPECT_EQ(live.GetWarnings().size(), once.GetWarnings().size());
  }
}

Mesh MakeTerrain()
{
  auto mesh = MakeBadPlane();
  MovePoints(mesh, [](double* x) { x[2] = 0.2 * x[0] * x[1]; });
  return mesh;
}

/// A mesh with lines and regions that keep bad edges from flipping.
Mesh MakeDividedTerrain()
{
  auto mesh = MakeTerrain();
  Cells lines;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); cell += 20)
  {
    const Cell triangle = GetCell(mesh, cell);
    lines.push_back({ triangle[0], triangle[1] });
  }
  vtkNew<vtkIntArray> regions;
  regions->SetName("Region");
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells() + static_cast<vtkIdType>(lines.size());
       ++cell)
  {
    regions->InsertNextValue(static_cast<int>(cell / 100));
  }
  mesh->SetLines(MakeCells(lines));
  mesh->GetCellData()->AddArray(regions);
  return mesh;
}

void Divide(vtkDelaunayFlip* filter)
{
  filter->SetGeometryToPlanarXY();
  filter->SetRegionArray("Region");
  filter->SetConstraintsData(MakeLines({ GetCell(filter->GetPolyDataInput(0), 250) }));
}

}

TEST(LiveBits, AreThoseOfAnUpdateAtOnce)
{
  const Setting setNothing = [](vtkDelaunayFlip*) {};
  auto floats = MakeTerrain();
  ReplacePoints<vtkFloatArray>(floats);
  ExpectLiveIsAtOnce(MakeBadPlane(), setNothing);
  ExpectLiveIsAtOnce(MakeBadSphere(), setNothing);
  ExpectLiveIsAtOnce(floats, [](vtkDelaunayFlip* filter) { filter->SetGeometryToPlanarXY(); });
  ExpectLiveIsAtOnce(MakeDividedTerrain(), Divide);
  // Constraints that are inserted first.
  const Mesh lines = MakeLines({ { 0, 300 }, { 1, 250 }, { 17, 200 }, { 5, 399 } });
  ExpectLiveIsAtOnce(
    MakeBadPlane(), [&lines](vtkDelaunayFlip* filter) { filter->SetConstraintsData(lines); });
}
