// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceUpdate.h"

#include "ConstraintsElsewhere.h"
#include "DelaunayFlip.h"
#include "MalformedArrays.h"
#include "PieceFlip.h"
#include "PieceInput.h"
#include "PieceOutput.h"
#include "PointViews.h"
#include "ReportTables.h"
#include "TriangleAngles.h"
#include "TupleTransfer.h"
#include "UpdateProgress.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr const char* AngleBefore = "vtkDelaunayFlipAngleBefore";
constexpr const char* AngleAfter = "vtkDelaunayFlipAngleAfter";

/// The update of one rank.
class PieceUpdater
{
public:
  PieceUpdater(const PieceRequest& request, PieceGroup& group)
    : Request(request),
      Group(group)
  {
  }

  PieceUpdate Run(vtkPolyData* output)
  {
    this->ReadInput();
    if (!IsOnAnyRank(!this->IsEmpty(), this->Group))
    {
      output->ShallowCopy(this->Mesh);
      PieceUpdate nothing;
      nothing.Report.StopReason = StopReasonKind::Converged;
      return nothing;
    }
    this->FindElsewhere();
    const MeshPiece piece{ this->Bridge->GetMesh(),
      this->Numbers.empty() ? nullptr : this->Numbers.data(), this->Elsewhere.Ends.data(),
      static_cast<std::int64_t>(this->Elsewhere.Ends.size()) / 2 };
    const PiecesReport report =
      FlipPiece(piece, this->Request.Options, this->Group, this->Flipped, this->Request.Progress);
    PieceUpdate update;
    update.Report = UpdateReport(report);
    update.Report.Rounds = report.Rounds;
    update.Report.MovedTriangles = report.MovedTriangles;
    update.AmbiguousPoints = report.AmbiguousPoints;
    this->AddElsewhere(update.Report);
    this->Store(report.GeometryUsed, output);
    AddFieldData(update.Report, output->GetFieldData());
    return update;
  }

private:
  bool IsEmpty() const
  {
    return this->Mesh->GetNumberOfPolys() == 0 && this->Mesh->GetNumberOfStrips() == 0;
  }

  void ReadInput()
  {
    vtkSmartPointer<vtkPolyData> input;
    DoTogether(this->Group,
      [&]()
      {
        input = this->Request.GetInput();
        this->Mesh = DropDuplicateCells(ShareMesh(input));
        this->Numbers = ReadPointNumbers(this->Mesh);
      });
    if (IsOnAnyRank(this->Request.Constraints != nullptr, this->Group))
    {
      this->Constraints = GatherConstraints(this->Request.Constraints, this->Mesh, this->Group);
    }
    DoTogether(this->Group, [this]() { this->MakeBridge(); });
    if (!this->Request.Settings.RegionArray.empty())
    {
      ShareRegionLabels(
        this->Mesh, this->Request.Settings.RegionArray, this->Bridge->GetRegions(), this->Group);
    }
  }

  void MakeBridge()
  {
    PolyDataBridge::Settings settings = this->Request.Settings;
    if (this->IsEmpty())
    {
      settings.RegionArray.clear(); // an empty piece has no arrays
    }
    const UpdatePlan plan({ this->Mesh, this->Constraints, settings.LinesAsConstraints,
                            !settings.RegionArray.empty(), false, this->Request.Wanted.Angles },
      {});
    this->Bridge.reset(new PolyDataBridge(this->Mesh, this->Constraints, settings, plan));
    this->Bridge->RequireValidIds();
  }

  /// The constraints that cross from rank to rank go to the engine if they are to be inserted.
  void FindElsewhere()
  {
    if (this->Constraints)
    {
      this->Elsewhere =
        FindConstraintsElsewhere(this->Constraints, this->Bridge->GetMesh(), this->Group);
    }
    if (!this->Request.Settings.InsertConstraints)
    {
      this->Elsewhere.Unmatched += this->Elsewhere.Count;
      this->Elsewhere.Ends.clear();
    }
  }

  void AddElsewhere(UpdateReport& report) const
  {
    report.UnmatchedConstraints += this->Elsewhere.Unmatched;
    if (this->Elsewhere.Unmatched > 0)
    {
      report.Defects.push_back({ "constraint edges of the second input that the mesh does not have",
        this->Elsewhere.Unmatched, {}, DefectIds::Points });
    }
  }

  void Store(GeometryKind geometry, vtkPolyData* output)
  {
    vtkNew<vtkCellData> data;
    std::unique_ptr<PieceOutput> writer;
    DoTogether(this->Group,
      [&]()
      {
        data->ShallowCopy(TakeWholeArrays(this->Mesh));
        writer.reset(new PieceOutput(this->Mesh, this->Bridge->GetSlots(), this->Flipped));
      });
    const bool areDivided = IsOnAnyRank(this->Bridge->GetSlots().DivideCells(), this->Group);
    writer->Store(data, areDivided, this->Group, output);
    DoTogether(this->Group,
      [&]()
      {
        writer->RenewNormals(output);
        if (this->Request.Wanted.FlipCounts)
        {
          writer->AddTriangleArray<vtkIntArray>("vtkDelaunayFlipCount",
            std::vector<int>(this->Flipped.FlipCounts.begin(), this->Flipped.FlipCounts.end()), 0,
            output);
        }
      });
    if (this->Request.Wanted.Angles)
    {
      this->AddAngles(geometry, *writer, output);
    }
  }

  /// The angles that triangles had in their first slots, on whatever rank.
  std::vector<double> BringAnglesBefore(GeometryKind geometry)
  {
    const TriangleMesh mesh = this->Bridge->GetMesh();
    vtkNew<vtkCellData> given;
    DoTogether(this->Group,
      [&]()
      {
        vtkNew<vtkDoubleArray> angles;
        angles->SetName(AngleBefore);
        angles->SetNumberOfTuples(mesh.Triangles.Count);
        FindSmallestAngles(
          mesh, geometry, this->Request.Options.NumberOfThreads, angles->GetPointer(0), {});
        given->AddArray(angles);
      });
    vtkNew<vtkCellData> brought;
    BringTuples(
      ListOrigins(this->Flipped, this->Group.GetRank()), given,
      [](std::int64_t slot) { return static_cast<vtkIdType>(slot); }, this->Group, brought);
    const double* first =
      vtkDoubleArray::SafeDownCast(brought->GetArray(AngleBefore))->GetPointer(0);
    return std::vector<double>(first, first + this->Flipped.FlipCounts.size());
  }

  void AddAngles(GeometryKind geometry, const PieceOutput& writer, vtkPolyData* output)
  {
    const std::vector<double> before = this->BringAnglesBefore(geometry);
    writer.AddTriangleArray<vtkDoubleArray>(AngleBefore, before, NaN, output);
    std::vector<double> storage;
    TriangleMesh mesh;
    mesh.Points = ViewPoints(output, storage);
    mesh.Triangles = TriangleArray(this->Flipped.Triangles.data(),
      static_cast<std::int64_t>(this->Flipped.Triangles.size()) / 3);
    std::vector<double> angles(mesh.Triangles.Count);
    FindSmallestAngles(mesh, geometry, this->Request.Options.NumberOfThreads, angles.data(), {});
    writer.AddTriangleArray<vtkDoubleArray>(AngleAfter, angles, NaN, output);
  }

  const PieceRequest& Request;
  PieceGroup& Group;
  vtkSmartPointer<vtkPolyData> Mesh;
  std::vector<std::int64_t> Numbers;
  vtkSmartPointer<vtkPolyData> Constraints; ///< Of all ranks, or null.
  std::unique_ptr<PolyDataBridge> Bridge;
  ConstraintsElsewhere Elsewhere;
  FlippedPiece Flipped;
};

}

PieceUpdate FlipPieces(const PieceRequest& request, PieceGroup& group, vtkPolyData* output)
{
  return PieceUpdater(request, group).Run(output);
}

}
