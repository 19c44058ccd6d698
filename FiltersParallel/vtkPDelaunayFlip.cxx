// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPDelaunayFlip.h"

#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "FlipError.h"
#include "MeshBlocks.h"
#include "PieceFlip.h"
#include "RankMessages.h"
#include "TriangleAngles.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkFieldData.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>

using namespace delaunayflip;

vtkStandardNewMacro(vtkPDelaunayFlip);
vtkCxxSetObjectMacro(vtkPDelaunayFlip, Controller, vtkMultiProcessController);

vtkPDelaunayFlip::vtkPDelaunayFlip()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkPDelaunayFlip::~vtkPDelaunayFlip() { this->SetController(nullptr); }

//------------------------------------------------------------------------------
bool vtkPDelaunayFlip::HasSeveralProcesses() const
{
  return this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

std::unique_ptr<PieceGroup> vtkPDelaunayFlip::MakeGroup()
{
  if (!this->HasSeveralProcesses())
  {
    return nullptr;
  }
  return MakeControllerGroup(this->Controller);
}

/// Several processes gather the pieces of the second input.
int vtkPDelaunayFlip::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->HasSeveralProcesses())
  {
    return this->vtkPolyDataAlgorithm::RequestUpdateExtent(request, inputVector, outputVector);
  }
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
namespace
{

/// Gathers the constraints of all ranks as lines, each once; null if there are none. Every rank may
/// have all of them, or a part.
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
    Message key; // compared as bytes, since coordinates may be NaN
    Put(key, std::min(from, to));
    Put(key, std::max(from, to));
    if (from != to && known.insert(key).second)
    {
      ends.insert(ends.end(), { from, to });
    }
  }
  return MakeLines(ends, areFloats);
}

/// Counts the constraint edges with two ends that no rank has together. All ranks get the same
/// number.
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

/// Adds a defect that ranks have found in their pieces to the report, which is the same on all.
void AddSum(const Defect& own, PieceGroup& group, PiecesReport& report)
{
  Message message;
  Put(message, own.Count);
  Defect sum(own.Kind);
  sum.Detail = own.Detail;
  for (MessageReader reader = GatherAll(message, group); !reader.IsAtEnd();)
  {
    sum.Count += reader.Get<std::int64_t>();
  }
  if (sum.Count > 0)
  {
    report.Defects.push_back(sum);
  }
}

/// Gives regions the same labels on all ranks.
void ShareRegionLabels(PolyDataBridge& bridge, PieceGroup& group)
{
  Message own;
  for (const std::string& key : bridge.RegionKeys)
  {
    Put(own, key);
  }
  std::map<std::string, std::int32_t> all;
  for (MessageReader reader = GatherAll(own, group); !reader.IsAtEnd();)
  {
    all.emplace(reader.Get<std::string>(), static_cast<std::int32_t>(all.size()));
  }
  std::vector<std::int32_t> labels;
  for (const std::string& key : bridge.RegionKeys)
  {
    labels.push_back(all.at(key));
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
    // The polygons that stayed come first, in their order, then those received.
    const std::vector<std::int64_t>& gone = flipped.GoneTriangles;
    for (vtkIdType i = 0; i < this->Slots.GetNumberOfPolygons(); ++i)
    {
      const OutputPolygon polygon = this->Slots.GetPolygon(i);
      const auto next = std::lower_bound(gone.begin(), gone.end(), polygon.Triangle);
      if (next == gone.end() || *next != polygon.Triangle)
      {
        this->Polygons.push_back({ polygon.Cell, polygon.Triangle - (next - gone.begin()) });
        this->Origins.push_back(polygon.Triangle);
      }
    }
    const vtkIdType first = this->Slots.Triangles.Count - static_cast<vtkIdType>(gone.size());
    for (std::size_t i = 0; i < flipped.ReceivedTriangles.size(); ++i)
    {
      this->Polygons.push_back({ TriangleSlots::None, first + static_cast<vtkIdType>(i) });
      this->Origins.push_back(TriangleSlots::None);
    }
  }

  void Store(vtkPolyData* output) const
  {
    this->StorePoints(output);
    output->SetPolys(BuildPolygons(this->Polygons, this->GetTriangles(), this->Mesh));
    const auto data = TakeWholeArrays(this->Mesh->GetCellData(), this->Mesh->GetNumberOfCells());
    vtkNew<vtkCellData> received;
    BringTuples(
      this->Flipped.ReceivedTriangles, data,
      [this](std::int64_t slot) { return this->Slots.GetCell(slot); }, this->Group, received);
    StoreCells(this->Mesh, this->Slots, this->Polygons, received, output);
    // The ids are not unique if any rank has divided cells.
    if (IsOnAnyRank(this->Slots.AreDivided, this->Group))
    {
      DemoteGlobalIds(output->GetCellData());
    }
    if (output->GetCellData()->GetNormals())
    {
      RenewNormals(output,
        [this](vtkIdType polygon, const std::int64_t*, std::int64_t before[3])
        {
          const vtkIdType triangle = this->Polygons[polygon].Triangle;
          const vtkIdType slot = this->Origins[polygon];
          for (int i = 0; i < 3 && slot != TriangleSlots::None; ++i)
          {
            before[i] = this->Slots.Triangles.Get(slot, i);
          }
          return triangle >= 0 && this->Flipped.FlipCounts[triangle] > 0;
        });
    }
  }

  template <typename Value>
  void AddArray(
    const char* name, const std::vector<Value>& values, Value elsewhere, vtkPolyData* output) const
  {
    AddTriangleArray(
      name, values, elsewhere,
      [this](vtkIdType polygon) { return this->Polygons[polygon].Triangle; }, output);
  }

  void AddAngles(GeometryKind geometry, int threads, vtkPolyData* output) const
  {
    TriangleMesh mesh = this->Bridge.GetMesh();
    vtkNew<vtkDoubleArray> first; // one per slot that this rank had
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
    mesh.Triangles = this->GetTriangles();
    FindSmallestAngles(mesh, geometry, threads, angles.data(), {});
    this->AddArray("Smallest angle after (degrees)", angles, NaN, output);
  }

private:
  /// Writes the points of the mesh, then those received, with their data.
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
    points->SetDataType(FindPointType(this->Flipped.AreFloats));
    for (vtkIdType i = 0; i < count; ++i)
    {
      points->InsertNextPoint(this->Flipped.ReceivedCoordinates.data() + 3 * i);
    }
    AppendPoints(this->Mesh, points, MakeRange(0, count), received, output);
  }

  TriangleArray GetTriangles() const
  {
    return { this->Flipped.Triangles.data(),
      static_cast<std::int64_t>(this->Flipped.FlipCounts.size()) };
  }

  vtkPolyData* Mesh;
  const PolyDataBridge& Bridge;
  const TriangleSlots& Slots;
  const FlippedPiece& Flipped;
  PieceGroup& Group;
  // One for each polygon of the output:
  std::vector<OutputPolygon> Polygons; ///< Its triangle is one of the flipped piece.
  std::vector<vtkIdType> Origins; ///< The triangle of the mesh, or None.
};

/// Flips a mesh of which every rank of the group has a piece, and writes this rank's piece. All
/// ranks must call this together, within RunTogether.
/// @param request may have an empty input.
/// @returns the report of the whole mesh.
/// @throws InvalidMesh, InvalidOptions and so on.
PiecesReport FlipPieces(const FlipRequest& request, PieceGroup& group, vtkPolyData* output)
{
  const auto mesh = ShareMesh(request.Input);
  const bool isEmpty = mesh->GetNumberOfPolys() == 0 && mesh->GetNumberOfStrips() == 0;
  const auto constraints = GatherConstraints(request.Others, mesh, group);
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
  const MeshPiece piece{ bridge.GetMesh(), ViewValues(numbers) };
  const std::int64_t elsewhere = CountElsewhere(bridge.GetConstraints().AreHere, group);
  FlippedPiece flipped;
  PiecesReport report = FlipPiece(piece, request.Options, group, flipped, request.Progress);
  if (elsewhere > 0)
  {
    report.UnmatchedConstraints += elsewhere;
    Defect missing(DefectKind::ConstraintsNotInMesh, elsewhere);
    if (request.Settings.InsertConstraints && group.GetSize() > 1)
    {
      missing = Defect("constraint edges of the second input with ends that no rank has together: "
                       "insert constraints before the mesh is divided",
        elsewhere);
    }
    report.Defects.push_back(missing);
  }
  AddSum(bridge.GetSlots().NoTriangles, group, report);
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

/// Lists the blocks that any rank has, in one order on all ranks, each with the leaves of this
/// rank.
std::vector<MeshBlock> ShareBlocks(const std::vector<MeshBlock>& own, PieceGroup& group)
{
  Message message;
  for (const MeshBlock& block : own)
  {
    Put(message, block.Place);
    Put(message, block.Name);
    Put(message, block.Size);
  }
  std::map<std::vector<std::int64_t>, MeshBlock> shared;
  for (MessageReader reader = GatherAll(message, group); !reader.IsAtEnd();)
  {
    const auto place = reader.Get<std::vector<std::int64_t>>();
    const auto name = reader.Get<std::string>();
    MeshBlock& block =
      shared.emplace(place, MeshBlock{ place, name, 0.0, false, {} }).first->second;
    block.Size += reader.Get<double>();
  }
  for (const MeshBlock& block : own)
  {
    if (block.Place.empty() && shared.size() > 1)
    {
      throw InvalidOptions("this rank has a single mesh, but others have composite datasets");
    }
    shared[block.Place].Leaves = block.Leaves;
  }
  std::vector<MeshBlock> blocks;
  for (auto& entry : shared)
  {
    blocks.push_back(std::move(entry.second));
  }
  return blocks;
}

/// Gathers the notes of all ranks, in their order, with the rank's number.
std::vector<Note> ShareNotes(const std::vector<Note>& own, PieceGroup& group)
{
  Message message;
  for (const Note& note : own)
  {
    std::string where = "rank " + std::to_string(group.GetRank());
    if (!note.Where.empty())
    {
      where += ", " + note.Where;
    }
    Put(message, where);
    Put(message, note.Text);
  }
  std::vector<Note> notes;
  for (MessageReader reader = GatherAll(message, group); !reader.IsAtEnd();)
  {
    Note& note = notes.emplace_back();
    reader.Get(note.Where);
    reader.Get(note.Text);
  }
  return notes;
}

}

std::vector<MeshBlock> vtkPDelaunayFlip::ListBlocks(
  vtkDataObject* input, const std::vector<MeshBlock>& constraints, UpdateSummary& summary)
{
  this->NumberOfRounds = 0;
  this->NumberOfMovedTriangles = 0;
  this->IsSilent = false;
  this->Group = this->MakeGroup();
  if (!this->Group)
  {
    return this->Superclass::ListBlocks(input, constraints, summary);
  }
  this->IsSilent = this->Group->GetRank() > 0;
  std::vector<MeshBlock> blocks;
  const auto share = [&](PieceGroup& told)
  {
    const FlipRequest request = this->MakeRequest(nullptr, nullptr);
    const auto write = [](bool value) { return value ? "on" : "off"; };
    RequireSameOptions(request.Options, told,
      { { "RegionArray", request.Settings.RegionArray },
        { "Triangulate", write(request.Settings.Triangulate) },
        { "LinesAsConstraints", write(request.Settings.LinesAsConstraints) },
        { "InsertLines", write(request.Settings.InsertLines) },
        { "InsertConstraints", write(request.Settings.InsertConstraints) },
        { "GenerateFlipCount", write(request.WantsFlipCounts) },
        { "GenerateQuality", write(request.WantsAngles) } });
    blocks = ShareBlocks(ListMeshBlocks(input, vtkDataObject::CELL), told);
    summary.Warnings = ShareNotes(ListMisfits(blocks, constraints), told);
  };
  RunTogether(*this->Group, std::ref(share));
  return blocks;
}

/// Whatever fails on a rank, all ranks fail.
void vtkPDelaunayFlip::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& constraints, UpdateSummary& summary)
{
  if (!this->Group)
  {
    this->Superclass::FlipLeaves(block, constraints, summary);
    return;
  }
  const auto flip = [&](PieceGroup& told)
  {
    BlockMesh mesh(block, this->RegionArray, true);
    const auto edges = mesh.FindConstraints(constraints);
    const std::vector<Note> notes = ShareNotes(mesh.ListNotes(true), told);
    summary.Warnings.insert(summary.Warnings.end(), notes.begin(), notes.end());
    if (summary.Report.StopReason == StopReasonKind::Aborted ||
      !IsOnAnyRank(mesh.GetMesh() != nullptr, told))
    {
      mesh.Store(nullptr);
      return;
    }
    vtkNew<vtkPolyData> empty, flipped;
    vtkPolyData* own = mesh.GetMesh() ? mesh.GetMesh() : empty.Get();
    const PiecesReport report = FlipPieces(this->MakeRequest(own, edges), told, flipped);
    AddCount("Rounds", report.Rounds, flipped->GetFieldData());
    AddCount("MovedTriangles", report.MovedTriangles, flipped->GetFieldData());
    AddFieldData(report, flipped->GetFieldData());
    mesh.Store(flipped);
    this->NumberOfRounds = std::max<vtkIdType>(this->NumberOfRounds, report.Rounds);
    this->NumberOfMovedTriangles += report.MovedTriangles;
    *this->Report = report;
    if (report.AmbiguousPoints > 0)
    {
      summary.Warnings.push_back({ block.Name,
        std::to_string(report.AmbiguousPoints) +
          " points at the borders of pieces coincide with others of the same piece, and edges "
          "there stayed; number the points of the mesh before it is cut, as vtkGlobalPointIds" });
    }
  };
  RunTogether(*this->Group, std::ref(flip));
}

//------------------------------------------------------------------------------
void vtkPDelaunayFlip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "NumberOfRounds: " << this->NumberOfRounds << "\n";
}
