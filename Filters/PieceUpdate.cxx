// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceUpdate.h"

#include "ConstraintEdges.h"
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
#include <set>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr const char* AngleBefore = "vtkDelaunayFlipAngleBefore";
constexpr const char* AngleAfter = "vtkDelaunayFlipAngleAfter";

/// How many constraint edges have two ends that no rank has together; all ranks get the same.
/// @param constraints those of all ranks (GatherConstraints). @param mesh this rank's.
std::int64_t CountElsewhere(vtkPolyData* constraints, const TriangleMesh& mesh, PieceGroup& group)
{
  std::vector<double> storage;
  const PointArray ends = ViewPoints(constraints, storage);
  PointPlaces own(ends.Floats != nullptr || mesh.Points.Floats != nullptr);
  PointPlaces all(false); // the same on all ranks
  std::vector<std::int64_t> placeOf;
  std::vector<std::int64_t> placeOfAll;
  for (std::int64_t i = 0; i < ends.Count; ++i)
  {
    placeOf.push_back(own.Add(ends, i));
    placeOfAll.push_back(all.Add(ends, i));
  }
  std::vector<bool> isHere(own.GetNumberOfPlaces());
  for (std::int64_t point = 0; point < mesh.Points.Count; ++point)
  {
    const std::int64_t place = own.Find(mesh.Points, point);
    if (place != PointPlaces::None)
    {
      isHere[place] = true;
    }
  }
  Message areHere; // one flag per constraint
  for (std::int64_t i = 0; i < ends.Count; i += 2)
  {
    areHere.push_back(isHere[placeOf[i]] && isHere[placeOf[i + 1]] ? 1 : 0);
  }
  const std::vector<Message> flags = group.Gather(areHere);
  std::set<std::pair<std::int64_t, std::int64_t>> elsewhere;
  for (std::int64_t i = 0; i < ends.Count / 2; ++i)
  {
    const bool isAnywhere =
      std::any_of(flags.begin(), flags.end(), [i](const Message& one) { return one[i] != 0; });
    const auto places = std::minmax(placeOfAll[2 * i], placeOfAll[2 * i + 1]);
    if (!isAnywhere && places.first != places.second)
    {
      elsewhere.insert(places);
    }
  }
  return static_cast<std::int64_t>(elsewhere.size());
}

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
    const MeshPiece piece{ this->Bridge->GetMesh(),
      this->Numbers.empty() ? nullptr : this->Numbers.data() };
    const std::int64_t elsewhere =
      this->Constraints ? CountElsewhere(this->Constraints, piece.Mesh, this->Group) : 0;
    const PiecesReport report =
      FlipPiece(piece, this->Request.Options, this->Group, this->Flipped, this->Request.Progress);
    PieceUpdate update;
    update.Report = UpdateReport(report);
    update.Report.Rounds = report.Rounds;
    update.Report.MovedTriangles = report.MovedTriangles;
    update.AmbiguousPoints = report.AmbiguousPoints;
    this->AddElsewhere(elsewhere, update.Report);
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

  void AddElsewhere(std::int64_t count, UpdateReport& report) const
  {
    report.UnmatchedConstraints += count;
    if (count > 0)
    {
      const bool isBetween = this->Request.Settings.InsertConstraints && this->Group.GetSize() > 1;
      report.Defects.push_back({ isBetween
          ? "constraint edges of the second input whose two ends no rank has together: insert "
            "constraints before the mesh is divided"
          : "constraint edges of the second input that the mesh does not have",
        count, {}, DefectIds::Points });
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
  FlippedPiece Flipped;
};

}

PieceUpdate FlipPieces(const PieceRequest& request, PieceGroup& group, vtkPolyData* output)
{
  return PieceUpdater(request, group).Run(output);
}

}
