// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReportTables.h"

#include "FlipReport.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <string>

namespace delaunayflip
{
namespace
{

template <typename ArrayT, typename Member>
void AddColumn(const FlipReport& report, const char* name, Member member, vtkFieldData* data)
{
  vtkNew<ArrayT> column;
  column->SetName(name);
  column->SetNumberOfValues(static_cast<vtkIdType>(report.Iterations.size()));
  vtkIdType row = 0;
  for (const IterationRecord& record : report.Iterations)
  {
    column->SetValue(row++, record.*member);
  }
  data->AddArray(column);
}

template <typename ArrayT, typename Value>
void AddValue(const char* name, const Value& value, vtkFieldData* data)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->AddArray(array);
}

}

void AddIterationColumns(const FlipReport& report, vtkFieldData* data)
{
  AddColumn<vtkIdTypeArray>(report, "Iteration", &IterationRecord::Iteration, data);
  AddColumn<vtkIdTypeArray>(report, "Tested", &IterationRecord::Tested, data);
  AddColumn<vtkIdTypeArray>(report, "NonDelaunay", &IterationRecord::NonDelaunay, data);
  AddColumn<vtkIdTypeArray>(report, "Flipped", &IterationRecord::Flipped, data);
  AddColumn<vtkIdTypeArray>(report, "Excluded", &IterationRecord::Excluded, data);
  AddColumn<vtkIdTypeArray>(report, "Blocked", &IterationRecord::Blocked, data);
  AddColumn<vtkDoubleArray>(report, "MinimumAngle", &IterationRecord::MinimumAngle, data);
  AddColumn<vtkDoubleArray>(report, "Seconds", &IterationRecord::Seconds, data);
}

void AddTotals(const FlipReport& report, vtkFieldData* data)
{
  AddValue<vtkIntArray>("Converged", report.Converged() ? 1 : 0, data);
  AddValue<vtkStringArray>("StopReason", ToString(report.StopReason), data);
  AddValue<vtkIdTypeArray>("TotalFlips", report.TotalFlips, data);
  AddValue<vtkIdTypeArray>("NonDelaunayEdges", report.NonDelaunayAfter, data);
  AddValue<vtkIdTypeArray>("FixedEdges", report.Edges.Fixed, data);
  AddValue<vtkIdTypeArray>("NonManifoldEdges", report.Edges.NonManifold, data);
  AddValue<vtkStringArray>("GeometryUsed", ToString(report.GeometryUsed), data);
  AddValue<vtkStringArray>("Backend", report.Backend, data);
}

}
