// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReportTables.h"

#include "UpdateReport.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <string>

namespace delaunayflip
{
namespace
{

/// Adds the arrays of a report to a table or to the field data of a mesh.
class ArrayWriter
{
public:
  ArrayWriter(const FlipReport& report, const char* prefix, vtkFieldData* data)
    : Report(report),
      Prefix(prefix),
      Data(data)
  {
    // If memory runs out while VTK 9.3 makes room for one more array, deleting the data crashes.
    constexpr int MostArrays = 40;
    data->AllocateArrays(data->GetNumberOfArrays() + MostArrays);
  }

  /// One value per iteration.
  template <typename ArrayT, typename Member>
  void AddColumn(const char* name, Member member) const
  {
    const auto column = this->AddArray<ArrayT>(name);
    column->SetNumberOfTuples(static_cast<vtkIdType>(this->Report.Iterations.size()));
    vtkIdType row = 0;
    for (const IterationRecord& record : this->Report.Iterations)
    {
      column->SetValue(row++, record.*member);
    }
  }

  template <typename ArrayT, typename Value>
  void AddValue(const char* name, const Value& value) const
  {
    const auto array = this->AddArray<ArrayT>(name);
    array->SetNumberOfTuples(1);
    array->SetValue(0, value);
  }

private:
  template <typename ArrayT>
  vtkSmartPointer<ArrayT> AddArray(const char* name) const
  {
    auto array = vtkSmartPointer<ArrayT>::New();
    array->SetName((this->Prefix + name).c_str());
    this->Data->AddArray(array);
    return array;
  }

  const FlipReport& Report;
  std::string Prefix;
  vtkFieldData* Data;
};

}

void AddIterationColumns(const FlipReport& report, const char* prefix, vtkFieldData* data)
{
  const ArrayWriter writer(report, prefix, data);
  writer.AddColumn<vtkIdTypeArray>("Iteration", &IterationRecord::Iteration);
  writer.AddColumn<vtkIdTypeArray>("Tested", &IterationRecord::Tested);
  writer.AddColumn<vtkIdTypeArray>("NonDelaunay", &IterationRecord::NonDelaunay);
  writer.AddColumn<vtkIdTypeArray>("Flipped", &IterationRecord::Flipped);
  writer.AddColumn<vtkIdTypeArray>("Excluded", &IterationRecord::Excluded);
  writer.AddColumn<vtkIdTypeArray>("Blocked", &IterationRecord::Blocked);
  writer.AddColumn<vtkDoubleArray>("MinimumAngle", &IterationRecord::MinimumAngle);
  writer.AddColumn<vtkDoubleArray>("Seconds", &IterationRecord::Seconds);
}

void AddFieldData(const UpdateReport& report, vtkFieldData* data)
{
  // The totals first: ParaView lists no field data when the first array is empty.
  const ArrayWriter writer(report, FieldPrefix, data);
  writer.AddValue<vtkIntArray>("Converged", report.Converged() ? 1 : 0);
  writer.AddValue<vtkStringArray>("StopReason", ToString(report.StopReason));
  writer.AddValue<vtkIdTypeArray>("TotalFlips", report.TotalFlips);
  writer.AddValue<vtkIdTypeArray>("NonDelaunayEdges", report.NonDelaunayAfter);
  writer.AddValue<vtkIdTypeArray>("BlockedByShape", report.BlockedByShape);
  writer.AddValue<vtkIdTypeArray>("BlockedByEdge", report.BlockedByEdge);
  writer.AddValue<vtkIdTypeArray>("FixedEdges", report.Edges.Fixed);
  writer.AddValue<vtkIdTypeArray>("NonManifoldEdges", report.Edges.NonManifold);
  writer.AddValue<vtkIdTypeArray>("ConstraintEdges", report.Edges.Constraint);
  writer.AddValue<vtkIdTypeArray>("UnmatchedConstraintEdges", report.UnmatchedConstraints);
  writer.AddValue<vtkIdTypeArray>("InsertedConstraintEdges", report.InsertedConstraints);
  writer.AddValue<vtkIdTypeArray>("ConstraintFlips", report.ConstraintFlips);
  writer.AddValue<vtkStringArray>("GeometryUsed", report.GetGeometryName());
  writer.AddValue<vtkStringArray>("GeometryReason", report.GeometryReason);
  writer.AddValue<vtkStringArray>("Tolerance", report.Tolerance);
  writer.AddValue<vtkStringArray>("Backend", report.Backend);
  if (report.Rounds > 0)
  {
    writer.AddValue<vtkIdTypeArray>("Rounds", report.Rounds);
    writer.AddValue<vtkIdTypeArray>("MovedTriangles", report.MovedTriangles);
  }
  AddIterationColumns(report, FieldPrefix, data);
}

void RenewFieldData(const UpdateReport& report, vtkFieldData* data)
{
  if (data->HasArray((std::string(FieldPrefix) + "Converged").c_str()))
  {
    AddFieldData(report, data);
  }
}

}
