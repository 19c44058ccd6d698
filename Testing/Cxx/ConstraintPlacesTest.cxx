// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Constraints of the second input with their own points: matched by place.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFeatureEdges.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;

Mesh MakeLines(const Points& points, const Cells& lines)
{
  auto mesh = MakeMesh(points, {});
  mesh->SetLines(MakeCells(lines));
  return mesh;
}

/// All edges with two triangles, with points in a different order.
Mesh ExtractInnerEdges(vtkPolyData* mesh, int precision)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->BoundaryEdgesOff();
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ManifoldEdgesOn();
  edges->SetOutputPointsPrecision(precision);
  edges->Update();
  return edges->GetOutput();
}

/// The same mesh with points of this type (VTK_FLOAT, ...).
void Convert(vtkPolyData* mesh, int type)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->DeepCopy(mesh->GetPoints());
  mesh->SetPoints(points);
}

/// The results for constraints: edges kept, edges unmatched.
using Counts = std::pair<vtkIdType, vtkIdType>;

vtkIdType GetField(vtkPolyData* mesh, const char* name)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(name);
  return array ? static_cast<vtkIdType>(array->GetTuple1(0)) : -1;
}

Counts Constrain(WatchedFilter& filter, vtkPolyData* constraints)
{
  filter->SetConstraintsData(constraints);
  vtkPolyData* output = filter.Run();
  EXPECT_TRUE(filter.GetErrors().empty());
  const Counts counts(
    filter->GetNumberOfConstraintEdges(), filter->GetNumberOfUnmatchedConstraintEdges());
  EXPECT_EQ(counts.first, GetField(output, "DelaunayFlip:ConstraintEdges"));
  EXPECT_EQ(counts.second, GetField(output, "DelaunayFlip:UnmatchedConstraintEdges"));
  EXPECT_EQ(filter.GetWarnings().size(), counts.second > 0 ? 1u : 0u);
  return counts;
}

Counts Constrain(vtkPolyData* mesh, vtkPolyData* constraints)
{
  WatchedFilter filter(mesh);
  return Constrain(filter, constraints);
}

/// MakeRhombus(), with point 4 at the place of point 0, and point 5 at that of point 2. Point 5 is
/// a corner of the triangle (5, 6, 7).
Mesh MakeCrowdedRhombus()
{
  return MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { -3, 0, 0 }, { 3, 0, 0 },
                    { 9, 0, 0 }, { 6, 2, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 5, 6, 7 } });
}

}

TEST(ConstraintPlaces, OutputOfFeatureEdgesHoldsEveryEdge)
{
  for (const Mesh& mesh : { MakeBadPlane(), MakeBadSphere() })
  {
    for (const int type : { VTK_DOUBLE, VTK_FLOAT })
    {
      Convert(mesh, type);
      for (const int precision : { vtkAlgorithm::SINGLE_PRECISION, vtkAlgorithm::DOUBLE_PRECISION })
      {
        Mesh edges = ExtractInnerEdges(mesh, precision);
        WatchedFilter filter(mesh);
        EXPECT_EQ(Constrain(filter, edges), Counts(edges->GetNumberOfLines(), 0));
        EXPECT_EQ(filter->GetTotalFlips(), 0);
      }
    }
  }
}

TEST(ConstraintPlaces, PointsThatAreNumberedOtherwise)
{
  // By ids this would be 1-3.
  WatchedFilter filter(MakeRhombus());
  Mesh line =
    MakeLines({ { 7, 7, 7 }, { 3, 0, 0 }, { 8, 8, 8 }, { -3, 0, 0 }, { 9, 9, 9 } }, { { 1, 3 } });
  EXPECT_EQ(Constrain(filter, line), Counts(1, 0));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
}

TEST(ConstraintPlaces, PolygonsToo)
{
  WatchedFilter filter(MakeRhombus());
  EXPECT_EQ(
    Constrain(filter, MakeMesh({ { 3, 0, 0 }, { 0, 1, 0 }, { -3, 0, 0 } }, { { 0, 1, 2 } })),
    Counts(3, 0));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
}

TEST(ConstraintPlaces, FloatsOfADoubleMesh)
{
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(0, -3.1, 0.0, 0.0);
  Mesh line = MakeLines({ { -3.1, 0, 0 }, { 3, 0, 0 } }, { { 0, 1 } });
  Convert(line, VTK_FLOAT);
  EXPECT_EQ(Constrain(mesh, line), Counts(1, 0));
  Convert(line, VTK_DOUBLE); // the values of the floats, which differ from those of the mesh
  EXPECT_EQ(Constrain(mesh, line), Counts(0, 1));
}

TEST(ConstraintPlaces, DoublesOfAFloatMesh)
{
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(0, -3.1, 0.0, 0.0);
  Convert(mesh, VTK_FLOAT);
  EXPECT_EQ(
    Constrain(mesh, MakeLines({ { -3.1, 0, 0 }, { 3, 0, 0 } }, { { 0, 1 } })), Counts(1, 0));
  EXPECT_EQ(
    Constrain(mesh, MakeLines({ { -3.2, 0, 0 }, { 3, 0, 0 } }, { { 0, 1 } })), Counts(0, 1));
}

TEST(ConstraintPlaces, MinusZeroIsZero)
{
  EXPECT_EQ(Constrain(MakeRhombus(), MakeLines({ { -3, -0.0, 0 }, { 3, 0, -0.0 } }, { { 0, 1 } })),
    Counts(1, 0));
}

TEST(ConstraintPlaces, NearIsNotEqual)
{
  const double near = std::nextafter(3.0, 4.0);
  EXPECT_EQ(Constrain(MakeRhombus(), MakeLines({ { -3, 0, 0 }, { near, 0, 0 } }, { { 0, 1 } })),
    Counts(0, 1));
}

TEST(ConstraintPlaces, OfCoincidentPointsThePairThatIsAnEdge)
{
  auto mesh = MakeCrowdedRhombus();
  WatchedFilter filter(mesh);
  EXPECT_EQ(
    Constrain(filter, MakeLines({ { 3, 0, 0 }, { -3, 0, 0 } }, { { 0, 1 } })), Counts(1, 0));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
  // Several points at each place, and no edge between the places.
  EXPECT_EQ(Constrain(mesh, MakeLines({ { -3, 0, 0 }, { 9, 0, 0 } }, { { 0, 1 } })), Counts(0, 1));
}

TEST(ConstraintPlaces, OfTwoSheetsBothEdges)
{
  auto mesh = MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { -3, 0, 0 },
                         { 0, -1, 1 }, { 3, 0, 0 }, { 0, 1, 1 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 6, 7 } });
  EXPECT_EQ(Constrain(mesh, MakeLines({ { 3, 0, 0 }, { -3, 0, 0 } }, { { 0, 1 } })), Counts(2, 0));
}

TEST(ConstraintPlaces, TheSamePointsGoByIds)
{
  // Point 4 is at the place of 0, but 4-2 is not an edge.
  auto mesh = MakeCrowdedRhombus();
  vtkNew<vtkPolyData> constraints;
  constraints->SetPoints(mesh->GetPoints());
  constraints->SetLines(MakeCells({ { 4, 2 } }));
  EXPECT_EQ(Constrain(mesh, constraints), Counts(0, 1));
  Convert(constraints, VTK_DOUBLE); // other points with the same bits
  EXPECT_NE(constraints->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(Constrain(mesh, constraints), Counts(0, 1));
  Convert(constraints, VTK_FLOAT); // other bits
  EXPECT_EQ(Constrain(mesh, constraints), Counts(1, 0));
}

TEST(ConstraintPlaces, WithoutPointsTheyGoByIds)
{
  vtkNew<vtkPolyData> constraints;
  constraints->SetLines(MakeCells({ { 0, 2 }, { 1, 3 } }));
  EXPECT_EQ(Constrain(MakeRhombus(), constraints), Counts(1, 1));
}

TEST(ConstraintPlaces, PointsThatCoincideAmongTheConstraints)
{
  // Separate segments, one of them twice, and one of length zero.
  Mesh lines = MakeLines({ { -3, 0, 0 }, { 3, 0, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 3, 0, 0 },
                           { -3, 0, 0 }, { 0, 1, 0 }, { 0, 1, 0 }, { 5, 5, 5 }, { 5, 5, 5 } },
    { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 }, { 1, 8 }, { 9, 2 } });
  EXPECT_EQ(Constrain(MakeRhombus(), lines), Counts(2, 1));
}

TEST(ConstraintPlaces, NaNIsNowhere)
{
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(3, NAN, 0.0, 0.0);
  WatchedFilter filter(mesh);
  filter->SetConstraintsData(
    MakeLines({ { NAN, 0, 0 }, { 3, 0, 0 }, { INFINITY, 0, 0 } }, { { 0, 1 }, { 1, 2 } }));
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfConstraintEdges(), 0);
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 2);
}

TEST(ConstraintPlaces, LinesOfTheMeshAndOthersTogether)
{
  auto mesh = MakeRhombus();
  mesh->SetLines(MakeCells({ { 0, 1 }, { 1, 3 } }));
  Mesh lines = MakeLines(
    { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 4, 0, 0 } }, { { 0, 1 }, { 0, 2 }, { 2, 3 } });
  WatchedFilter filter(mesh);
  EXPECT_EQ(Constrain(filter, lines), Counts(2, 2));
  for (const char* text : { "1 constraint edge that is not an edge of the mesh",
         "1 constraint edge of the second input that the mesh does not have" })
  {
    EXPECT_NE(filter.GetWarnings()[0].find(text), std::string::npos) << filter.GetWarnings()[0];
  }
}

TEST(ConstraintPlaces, IdsOutOfRangeAreAnError)
{
  WatchedFilter filter(MakeRhombus());
  filter->SetConstraintsData(MakeLines({ { -3, 0, 0 }, { 3, 0, 0 } }, { { 0, 3 } }));
  EXPECT_EQ(filter.Run()->GetNumberOfCells(), 0);
  ASSERT_EQ(filter.GetErrors().size(), 1u);
  EXPECT_NE(filter.GetErrors()[0].find("names point 3"), std::string::npos);
}

TEST(ConstraintPlaces, MovedConstraintsRestartALiveRun)
{
  auto mesh = MakeRhombus();
  Mesh line = MakeLines({ { -3, 0, 0 }, { 4, 0, 0 } }, { { 0, 1 } });
  LiveFilter filter(mesh);
  filter->SetConstraintsData(line);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  line->GetPoints()->SetPoint(1, 3, 0, 0);
  line->GetPoints()->Modified();
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
}

TEST(ConstraintPlaces, WarmStartsKeepThemAndTheirCounts)
{
  auto mesh = MakeRhombus();
  Mesh lines = MakeLines({ { -3, 0, 0 }, { 3, 0, 0 }, { 5, 5, 5 } }, { { 0, 1 }, { 1, 2 } });
  LiveFilter filter(mesh);
  filter->SetConstraintsData(lines);
  filter.RunToTheEnd();
  for (int move = 0; move < 2; ++move)
  {
    Shear(mesh, 0.01); // no point is at a place of the constraints any more
    filter.RunToTheEnd();
    EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
    EXPECT_EQ(filter->GetNumberOfConstraintEdges(), 1);
    EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 1);
  }
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
}
