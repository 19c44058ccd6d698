// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankSum.h"

#include "UpdateReport.h"

#if VTK_MODULE_ENABLE_VTK_ParallelCore
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#endif

namespace delaunayflip
{

#if VTK_MODULE_ENABLE_VTK_ParallelCore
namespace
{

/// The archive that writes every value it is given.
class Packer
{
public:
  template <typename... Values>
  void operator()(const Values&... values)
  {
    (this->Put(values), ...);
  }

  vtkMultiProcessStream Stream;

private:
  void Put(std::int64_t value) { this->Stream << static_cast<vtkTypeInt64>(value); }
  void Put(int value) { this->Stream << value; }
  void Put(bool value) { this->Stream << static_cast<int>(value); }
  void Put(double value) { this->Stream << value; }
  void Put(const std::string& value) { this->Stream << value; }
  void Put(GeometryKind value) { this->Put(static_cast<int>(value)); }
  void Put(StopReasonKind value) { this->Put(static_cast<int>(value)); }
  template <typename Item>
  void Put(const std::vector<Item>& items)
  {
    this->Put(static_cast<std::int64_t>(items.size()));
    for (Item item : items)
    {
      Visit(*this, item);
    }
  }
};

/// The archive that reads them again, in the same order.
class Unpacker
{
public:
  template <typename... Values>
  void operator()(Values&... values)
  {
    (this->Get(values), ...);
  }

  vtkMultiProcessStream Stream;

private:
  void Get(std::int64_t& value)
  {
    vtkTypeInt64 number = 0;
    this->Stream >> number;
    value = number;
  }
  void Get(int& value) { this->Stream >> value; }
  void Get(double& value) { this->Stream >> value; }
  void Get(std::string& value) { this->Stream >> value; }
  void Get(bool& value) { value = this->GetNumber() != 0; }
  void Get(GeometryKind& value) { value = static_cast<GeometryKind>(this->GetNumber()); }
  void Get(StopReasonKind& value) { value = static_cast<StopReasonKind>(this->GetNumber()); }
  template <typename Item>
  void Get(std::vector<Item>& items)
  {
    std::int64_t count = 0;
    this->Get(count);
    items.resize(count);
    for (Item& item : items)
    {
      Visit(*this, item);
    }
  }
  int GetNumber()
  {
    int number = 0;
    this->Stream >> number;
    return number;
  }
};

template <typename Archive>
void Visit(Archive& archive, std::int64_t& value)
{
  archive(value);
}

template <typename Archive>
void Visit(Archive& archive, Note& note)
{
  archive(note.Where, note.Text);
}

template <typename Archive>
void Visit(Archive& archive, Defect& defect)
{
  archive(defect.What, defect.Count);
}

template <typename Archive>
void Visit(Archive& archive, IterationRecord& row)
{
  archive(row.Iteration, row.Tested, row.NonDelaunay, row.Flipped, row.Excluded, row.Blocked);
  archive(row.MinimumAngle, row.Seconds);
}

template <typename Archive>
void Visit(Archive& archive, EdgeCounts& edges)
{
  archive(edges.Edges, edges.Boundary, edges.NonManifold, edges.WronglyWound, edges.Feature);
  archive(edges.Constraint, edges.Region, edges.Fixed);
}

template <typename Archive>
void Visit(Archive& archive, UpdateReport& report)
{
  archive(report.Points, report.Triangles, report.EulerCharacteristic);
  archive(report.UnmatchedConstraints, report.InsertedConstraints, report.ConstraintFlips);
  Visit(archive, report.Edges);
  archive(report.GeometryUsed, report.HasMixedGeometry, report.GeometryReason, report.Tolerance);
  archive(report.Backend, report.Fallback);
  archive(report.Iterations, report.TotalFlips, report.TotalExcluded, report.TotalBlocked);
  archive(report.NonDelaunayBefore, report.NonDelaunayAfter);
  archive(report.BlockedByShape, report.BlockedByEdge);
  archive(report.MinimumAngleBefore, report.MinimumAngleAfter);
  archive(report.Rounds, report.MovedTriangles);
  archive(report.StopReason, report.BuildSeconds, report.FlipSeconds, report.Defects);
}

template <typename Archive>
void Visit(Archive& archive, UpdateSummary& summary)
{
  Visit(archive, summary.Report);
  archive(summary.Failure, summary.Errors, summary.Warnings, summary.Blocks, summary.HasSeams);
}

vtkMultiProcessStream Pack(UpdateSummary& summary)
{
  Packer packer;
  Visit(packer, summary);
  return packer.Stream;
}

UpdateSummary Unpack(const vtkMultiProcessStream& stream)
{
  Unpacker unpacker{ stream };
  UpdateSummary summary;
  Visit(unpacker, summary);
  return summary;
}

/// The global controller, if each of its processes updates one piece; else null.
vtkMultiProcessController* FindController(const Piece& piece)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isShared = controller && controller->GetNumberOfProcesses() > 1 &&
    piece.Count == controller->GetNumberOfProcesses() &&
    piece.Number == controller->GetLocalProcessId();
  return isShared ? controller : nullptr;
}

/// Replaces each rank's summary by the sum over all ranks.
void SumOverRanks(UpdateSummary& summary, vtkMultiProcessController* controller)
{
  std::vector<vtkMultiProcessStream> streams;
  controller->Gather(Pack(summary), streams, 0);
  UpdateSummary sum;
  for (int rank = 0; rank < static_cast<int>(streams.size()); ++rank)
  {
    sum.AddRank(Unpack(streams[rank]), rank);
  }
  vtkMultiProcessStream stream = Pack(sum);
  controller->Broadcast(stream, 0);
  summary = Unpack(stream);
}

}
#endif

bool JoinRanks(UpdateSummary& summary, const Piece& piece)
{
#if VTK_MODULE_ENABLE_VTK_ParallelCore
  if (vtkMultiProcessController* controller = FindController(piece))
  {
    SumOverRanks(summary, controller);
    return controller->GetLocalProcessId() == 0;
  }
#endif
  summary.HasSeams = summary.HasSeams || (piece.Count > 1 && summary.Report.Triangles > 0);
  return true;
}

}
