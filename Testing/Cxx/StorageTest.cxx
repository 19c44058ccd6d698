// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Types and layouts of points and ids.

#include "FilterTestSupport.h"

#include "FlipReport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPoints.h"
#include "vtkSOADataArrayTemplate.h"

#include <gtest/gtest.h>

namespace
{

/// A random bad mesh whose points are copied into an array of this type.
template <typename ArrayT>
vtkSmartPointer<vtkPolyData> MakeBadMesh(double scale)
{
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMesh(300, 3));
  vtkNew<ArrayT> array;
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      array->SetComponent(point, axis, scale * mesh->GetPoint(point)[axis]);
    }
  }
  vtkNew<vtkPoints> points;
  points->SetData(array);
  mesh->SetPoints(points);
  return mesh;
}

void ExpectDelaunay(vtkPolyData* mesh)
{
  WatchedFilter filter(mesh);
  filter->SetGeometryToPlanar();
  vtkPolyData* output = filter.Run();
  EXPECT_GT(filter->GetTotalFlips(), 0);
  EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(CountViolations(output), 0);
}

/// How the output stores polygons, for the rhombus and a quad stored with 32 or 64 bits.
bool Is64BitAfterRun(bool wide, bool quads, bool triangulate)
{
  auto mesh = MakeRhombus();
  vtkNew<vtkCellArray> cells;
  wide ? cells->Use64BitStorage() : cells->Use32BitStorage();
  if (quads)
  {
    cells->InsertNextCell({ 0, 1, 2, 3 });
  }
  else
  {
    cells->InsertNextCell({ 0, 1, 2 });
    cells->InsertNextCell({ 0, 2, 3 });
  }
  mesh->SetPolys(cells);
  WatchedFilter filter(mesh);
  filter->SetTriangulate(triangulate);
  return RunCleanly(filter)->GetPolys()->IsStorage64Bit();
}

}

TEST(VtkDelaunayFlip, FloatPoints) { ExpectDelaunay(MakeBadMesh<vtkFloatArray>(1.0)); }

TEST(VtkDelaunayFlip, DoublePoints) { ExpectDelaunay(MakeBadMesh<vtkDoubleArray>(1.0)); }

TEST(VtkDelaunayFlip, StructureOfArraysPoints)
{
  ExpectDelaunay(MakeBadMesh<vtkSOADataArrayTemplate<double>>(1.0));
}

TEST(VtkDelaunayFlip, IntegerPoints) { ExpectDelaunay(MakeBadMesh<vtkIntArray>(1e6)); }

TEST(VtkDelaunayFlip, LayoutsAgree)
{
  WatchedFilter plain(MakeBadMesh<vtkFloatArray>(1.0));
  WatchedFilter separate(MakeBadMesh<vtkSOADataArrayTemplate<float>>(1.0));
  EXPECT_EQ(GetCells(RunCleanly(plain)->GetPolys()), GetCells(RunCleanly(separate)->GetPolys()));
}

TEST(VtkDelaunayFlip, IdWidthIsKept)
{
  for (const bool wide : { false, true })
  {
    EXPECT_EQ(Is64BitAfterRun(wide, false, true), wide);
    EXPECT_EQ(Is64BitAfterRun(wide, true, true), wide);
    EXPECT_EQ(Is64BitAfterRun(wide, true, false), wide);
  }
}

TEST(VtkDelaunayFlip, IdWidthsAgree)
{
  auto narrow = MakeBadMesh<vtkDoubleArray>(1.0);
  auto wide = MakeBadMesh<vtkDoubleArray>(1.0);
  ASSERT_TRUE(narrow->GetPolys()->ConvertTo32BitStorage());
  ASSERT_TRUE(wide->GetPolys()->ConvertTo64BitStorage());
  WatchedFilter first(narrow);
  WatchedFilter second(wide);
  const Cells cells = GetCells(RunCleanly(first)->GetPolys());
  EXPECT_EQ(cells, GetCells(RunCleanly(second)->GetPolys()));
  EXPECT_NE(cells, GetCells(narrow->GetPolys()));
}

TEST(VtkDelaunayFlip, ThreadCountsAgree)
{
  WatchedFilter filter(MakeBadMesh<vtkDoubleArray>(1.0));
  filter->SetBackendToThreads();
  filter->SetNumberOfThreads(1);
  const Cells cells = GetCells(RunCleanly(filter)->GetPolys());
  EXPECT_EQ(filter->GetReport().Backend, "Threads: 1");
  filter->SetNumberOfThreads(3);
  EXPECT_EQ(cells, GetCells(RunCleanly(filter)->GetPolys()));
  EXPECT_EQ(filter->GetReport().Backend, "Threads: 3");
}
