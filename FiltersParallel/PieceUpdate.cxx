// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceUpdate.h"

#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "JoinedPartitions.h"
#include "RankMessages.h"
#include "TriangleAngles.h"

#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <set>

namespace delaunayflip
{
namespace
{

/// The constraints of all ranks as lines, each once: every rank may have all of them, or a part.
/// Null if there are none.
vtkSmartPointer<vtkPolyData> GatherConstraints(
  vtkPolyData* constraints, vtkPolyData* mesh, PieceGroup& group)
{
  const auto own =
    constraints ? JoinConstraints({ { constraints, mesh } }) : vtkSmartPointer<vtkPolyData>();
  const bool areFloats = !IsOnAnyRank(own && own->GetPoints()->GetDataType() != VTK_FLOAT, group);
  Message message;
  for (vtkIdType i = 0; own && i < own->GetNumberOfPoints(); ++i)
  {
    const double* x = own->GetPoint(i);
    Put(message, std::array<double, 3>{ x[0] + 0.0, x[1] + 0.0, x[2] + 0.0 }); // -0 becomes 0
  }
  std::vector<std::array<double, 3>> ends;
  std::set<Message> known;
  for (MessageReader reader = GatherAll(message, group); !reader.IsAtEnd();)
  {
    const auto from = reader.Get<std::array<double, 3>>(), to = reader.Get<std::array<double, 3>>();
    Message key; // of bytes, since coordinates may be NaN
    Put(key, std::min(from, to));
    Put(key, std::max(from, to));
    if (from != to && known.insert(key).second)
    {
      ends.insert(ends.end(), { from, to });
    }
  }
  if (ends.empty())
  {
    return nullptr;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(areFloats ? VTK_FLOAT : VTK_DOUBLE);
  vtkNew<vtkCellArray> lines;
  for (std::size_t i = 0; i < ends.size(); i += 2)
  {
    lines->InsertNextCell(
      { points->InsertNextPoint(ends[i].data()), points->InsertNextPoint(ends[i + 1].data()) });
  }
  auto gathered = vtkSmartPointer<vtkPolyData>::New();
  gathered->SetPoints(points);
  gathered->SetLines(lines);
  return gathered;
}

/// How many constraint edges have two ends that no rank has together; all ranks get the same.
/// @param areHere by constraint, whether this rank has both ends.
std::int64_t CountElsewhere(const std::vector<char>& areHere, PieceGroup& group)
{
  const std::vector<Message> flags = group.Gather(areHere);
  std::int64_t elsewhere = 0;
  for (std::size_t i = 0; i < areHere.size(); ++i)
  {
    elsewhere +=
      std::none_of(flags.begin(), flags.end(), [i](const Message& one) { return one[i] != 0; });
  }
  return elsewhere;
}

/// Gives regions the same labels on all ranks.
void ShareRegionLabels(PolyDataBridge& bridge, PieceGroup& group)
{
  Message own;
  for (const std::string& key : bridge.RegionKeys)
  {
    Put(own, key);
  }
  std::set<std::string> all;
  for (MessageReader reader = GatherAll(own, group); !reader.IsAtEnd();)
  {
    all.insert(reader.Get<std::string>());
  }
  std::vector<std::int32_t> labels;
  for (const std::string& key : bridge.RegionKeys)
  {
    labels.push_back(static_cast<std::int32_t>(std::distance(all.begin(), all.find(key))));
  }
  for (std::int32_t& label : bridge.Regions)
  {
    label = labels[label];
  }
}

/// Writes the piece of a rank, with the data of what it has received.
class PieceOutput
{
public:
  /// All must live as long as this object.
  PieceOutput(
    vtkPolyData* mesh, const PolyDataBridge& bridge, const FlippedPiece& flipped, PieceGroup& group)
    : Mesh(mesh),
      Bridge(bridge),
      Slots(bridge.GetSlots()),
      Flipped(flipped),
      Group(group)
  {
    // The polygons that stayed, in their order, then those received.
    std::vector<vtkIdType> places(this->Slots.Triangles.Count, 0);
    for (const std::int64_t slot : flipped.GoneTriangles)
    {
      places[slot] = -1;
    }
    vtkIdType kept = 0;
    for (vtkIdType& place : places)
    {
      place = place < 0 ? -1 : kept++;
    }
    for (vtkIdType polygon = 0; polygon < this->Slots.GetNumberOfPolygons(); ++polygon)
    {
      const vtkIdType slot = this->Slots.GetTriangle(polygon);
      const vtkIdType place = slot == TriangleSlots::None ? -1 : places[slot];
      if (slot == TriangleSlots::None || place >= 0)
      {
        this->Sources.push_back(this->Slots.GetCellOfPolygon(polygon));
        this->Triangles.push_back(place);
        this->Origins.push_back(slot);
      }
    }
    for (std::size_t i = 0; i < flipped.ReceivedTriangles.size(); ++i)
    {
      this->Sources.push_back(-1 - static_cast<vtkIdType>(i));
      this->Triangles.push_back(kept++);
      this->Origins.push_back(TriangleSlots::None);
    }
  }

  void Store(vtkPolyData* output) const
  {
    this->StorePoints(output);
    output->SetVerts(this->Mesh->GetVerts());
    output->SetLines(this->Mesh->GetLines());
    output->SetPolys(this->BuildPolygons());
    output->SetStrips(BuildStrips(this->Slots, this->Mesh));
    output->GetFieldData()->ShallowCopy(this->Mesh->GetFieldData());
    const auto data = TakeWholeArrays(this->Mesh->GetCellData(), this->Mesh->GetNumberOfCells());
    vtkNew<vtkCellData> received;
    BringTuples(
      this->Flipped.ReceivedTriangles, data,
      [this](std::int64_t slot) { return this->Slots.GetCell(slot); }, this->Group, received);
    const auto sources = MakeRange(0, this->Slots.FirstPolygon);
    const auto count = static_cast<vtkIdType>(this->Flipped.ReceivedTriangles.size());
    std::for_each(this->Sources.begin(), this->Sources.end() - count,
      [&](vtkIdType source) { sources->InsertNextId(source); });
    const vtkIdType first = sources->GetNumberOfIds(); // the cells received are before the strips
    const auto places = MakeRange(0, first);
    for (const vtkIdType strip : this->Slots.Strips)
    {
      places->InsertNextId(sources->InsertNextId(strip) + count);
    }
    const vtkIdType size = sources->GetNumberOfIds() + count;
    AddTuples(data, sources, places, size, output->GetCellData());
    AddTuples(received, MakeRange(0, count), MakeRange(first, count), size, output->GetCellData());
    // The ids are not unique if any rank has divided cells.
    if (IsOnAnyRank(this->Slots.AreDivided, this->Group))
    {
      DemoteGlobalIds(output->GetCellData());
    }
    RenewNormals(output,
      [this](vtkIdType polygon, const std::int64_t*, std::int64_t before[3])
      {
        const vtkIdType triangle = this->Triangles[polygon];
        const vtkIdType slot = this->Origins[polygon];
        for (int i = 0; i < 3 && slot != TriangleSlots::None; ++i)
        {
          before[i] = this->Slots.Triangles.Get(slot, i);
        }
        return triangle >= 0 && this->Flipped.FlipCounts[triangle] > 0;
      });
  }

  template <typename Value>
  void AddArray(
    const char* name, const std::vector<Value>& values, Value elsewhere, vtkPolyData* output) const
  {
    AddTriangleArray(
      name, values, elsewhere, [this](vtkIdType polygon) { return this->Triangles[polygon]; },
      output);
  }

  void AddAngles(GeometryKind geometry, int threads, vtkPolyData* output) const
  {
    TriangleMesh mesh = this->Bridge.GetMesh();
    vtkNew<vtkDoubleArray> first; // of the slots that this rank had
    first->SetName("Smallest angle before (degrees)");
    first->SetNumberOfTuples(mesh.Triangles.Count);
    FindSmallestAngles(mesh, geometry, threads, first->GetPointer(0), {});
    vtkNew<vtkCellData> given, brought;
    given->AddArray(first);
    BringTuples(
      ListOrigins(this->Flipped, this->Group.GetRank()), given,
      [](std::int64_t slot) { return static_cast<vtkIdType>(slot); }, this->Group, brought);
    const double* before =
      vtkDoubleArray::SafeDownCast(brought->GetArray(first->GetName()))->GetPointer(0);
    std::vector<double> angles(before, before + this->Flipped.FlipCounts.size());
    this->AddArray(first->GetName(), angles, NaN, output);
    std::vector<double> storage;
    mesh = TriangleMesh();
    mesh.Points = ViewPoints(output, storage);
    mesh.Triangles =
      TriangleArray(this->Flipped.Triangles.data(), static_cast<std::int64_t>(angles.size()));
    FindSmallestAngles(mesh, geometry, threads, angles.data(), {});
    this->AddArray("Smallest angle after (degrees)", angles, NaN, output);
  }

private:
  /// The points of the mesh, then those received, with their data.
  void StorePoints(vtkPolyData* output) const
  {
    const vtkIdType given = this->Mesh->GetNumberOfPoints();
    const auto count = static_cast<vtkIdType>(this->Flipped.ReceivedPoints.size());
    const auto data = TakeWholeArrays(this->Mesh->GetPointData(), given);
    vtkNew<vtkPointData> received;
    BringTuples(
      this->Flipped.ReceivedPoints, data,
      [](std::int64_t point) { return static_cast<vtkIdType>(point); }, this->Group, received);
    if (count == 0)
    {
      output->SetPoints(this->Mesh->GetPoints());
      output->GetPointData()->ShallowCopy(data);
      return;
    }
    vtkNew<vtkPoints> points;
    points->SetDataType(this->Flipped.AreFloats ? VTK_FLOAT : VTK_DOUBLE);
    if (given > 0)
    {
      points->SetDataType(this->Mesh->GetPoints()->GetDataType());
      points->InsertPoints(0, given, 0, this->Mesh->GetPoints());
    }
    for (vtkIdType i = 0; i < count; ++i)
    {
      points->InsertNextPoint(this->Flipped.ReceivedCoordinates.data() + 3 * i);
    }
    output->SetPoints(points);
    const auto own = MakeRange(0, given);
    AddTuples(data, own, own, given + count, output->GetPointData());
    AddTuples(received, MakeRange(0, count), MakeRange(given, count), given + count,
      output->GetPointData());
  }

  vtkSmartPointer<vtkCellArray> BuildPolygons() const
  {
    auto polygons = vtkSmartPointer<vtkCellArray>::New();
    UsesWideIds(this->Mesh) ? polygons->Use64BitStorage() : polygons->Use32BitStorage();
    vtkNew<vtkIdList> ids;
    for (std::size_t polygon = 0; polygon < this->Triangles.size(); ++polygon)
    {
      if (this->Triangles[polygon] < 0)
      {
        this->Mesh->GetPolys()->GetCellAtId(this->Sources[polygon] - this->Slots.FirstPolygon, ids);
        polygons->InsertNextCell(ids);
      }
      else
      {
        const std::int32_t* points = this->Flipped.Triangles.data() + 3 * this->Triangles[polygon];
        polygons->InsertNextCell({ points[0], points[1], points[2] });
      }
    }
    return polygons;
  }

  vtkPolyData* Mesh;
  const PolyDataBridge& Bridge;
  const TriangleSlots& Slots;
  const FlippedPiece& Flipped;
  PieceGroup& Group;
  // Of each polygon of the output:
  std::vector<vtkIdType> Sources; ///< The cell of the mesh; -1 - i: that of received triangle i.
  std::vector<vtkIdType> Triangles; ///< The triangle of the flipped piece, or -1.
  std::vector<vtkIdType> Origins; ///< The triangle of the mesh, or None.
};

}

PiecesReport FlipPieces(const FlipRequest& request, PieceGroup& group, vtkPolyData* output)
{
  const auto mesh = ShareMesh(request.Input);
  const bool isEmpty = mesh->GetNumberOfPolys() == 0 && mesh->GetNumberOfStrips() == 0;
  const auto constraints = GatherConstraints(request.Constraints, mesh, group);
  BridgeSettings settings = request.Settings;
  if (isEmpty)
  {
    settings.RegionArray.clear(); // an empty piece has no arrays
  }
  PolyDataBridge bridge(mesh, constraints, settings, UpdatePlan({}, {}));
  bridge.RequireValidIds();
  if (!request.Settings.RegionArray.empty())
  {
    ShareRegionLabels(bridge, group);
  }
  if (!IsOnAnyRank(!isEmpty, group))
  {
    output->ShallowCopy(mesh);
    PiecesReport nothing;
    nothing.StopReason = StopReasonKind::Converged;
    return nothing;
  }
  const std::vector<std::int64_t> numbers = ReadPointNumbers(mesh);
  const MeshPiece piece{ bridge.GetMesh(), numbers.empty() ? nullptr : numbers.data() };
  const std::int64_t elsewhere = CountElsewhere(bridge.GetConstraints().AreHere, group);
  FlippedPiece flipped;
  PiecesReport report = FlipPiece(piece, request.Options, group, flipped, request.Progress);
  if (elsewhere > 0)
  {
    report.UnmatchedConstraints += elsewhere;
    report.Defects.push_back({ request.Settings.InsertConstraints && group.GetSize() > 1
        ? "constraint edges of the second input whose two ends no rank has together: insert "
          "constraints before the mesh is divided"
        : "constraint edges of the second input that the mesh does not have",
      elsewhere, {}, DefectIds::Points });
  }
  const PieceOutput writer(mesh, bridge, flipped, group);
  writer.Store(output);
  if (request.WantsFlipCounts)
  {
    writer.AddArray("vtkDelaunayFlipCount", flipped.FlipCounts, 0, output);
  }
  if (request.WantsAngles)
  {
    writer.AddAngles(report.GeometryUsed, request.Options.NumberOfThreads, output);
  }
  return report;
}

}
