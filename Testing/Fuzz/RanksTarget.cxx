// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ByteSource.h"
#include "EngineCase.h"
#include "FuzzTarget.h"
#include "MeshDivision.h"
#include "OtherGroup.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPDelaunayFlip.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace delaunayflip;

/// @file
/// The filter on several ranks, which are threads, as a target for fuzzers. In half of the cases
/// one rank has another option than the others; then all ranks must fail and name it.

namespace
{

/// The filter of one rank.
class RankFilter : public vtkPDelaunayFlip
{
public:
  static RankFilter* New();
  vtkTypeMacro(RankFilter, vtkPDelaunayFlip);

  PieceGroup* Group = nullptr;

protected:
  std::unique_ptr<PieceGroup> MakeGroup() override
  {
    return std::unique_ptr<PieceGroup>(new OtherGroup(*this->Group));
  }
};
vtkStandardNewMacro(RankFilter);

struct Difference
{
  const char* Property;
  std::function<void(vtkDelaunayFlip*)> Apply;
};

/// The first of the filter's own options among the differences, of which Flags has a bit each.
constexpr std::size_t FirstOfFilter = 8;

const std::vector<Difference>& ListDifferences()
{
  static const std::vector<Difference> all = {
    { "Geometry", [](vtkDelaunayFlip* f) { f->SetGeometry((f->GetGeometry() + 1) % 4); } },
    { "Criterion", [](vtkDelaunayFlip* f) { f->SetCriterion(1 - f->GetCriterion()); } },
    { "TieRule", [](vtkDelaunayFlip* f) { f->SetTieRule(1 - f->GetTieRule()); } },
    { "Tolerance", [](vtkDelaunayFlip* f) { f->SetTolerance(0.25 + 0.5 * f->GetTolerance()); } },
    { "FeatureAngle",
      [](vtkDelaunayFlip* f) { f->SetFeatureAngle(1 + f->GetFeatureAngle() / 2); } },
    { "MaximumDeviation",
      [](vtkDelaunayFlip* f)
      { f->SetMaximumDeviation(f->GetMaximumDeviation() == 0.0 ? 1.0 : 0.0); } },
    { "MaximumIterations",
      [](vtkDelaunayFlip* f) { f->SetMaximumIterations(f->GetMaximumIterations() + 1); } },
    { "TrackQuality", [](vtkDelaunayFlip* f) { f->SetTrackQuality(!f->GetTrackQuality()); } },
    { "RegionArray",
      [](vtkDelaunayFlip* f) { f->SetRegionArray(*f->GetRegionArray() ? "" : "Region"); } },
    { "Triangulate", [](vtkDelaunayFlip* f) { f->SetTriangulate(!f->GetTriangulate()); } },
    { "LinesAsConstraints",
      [](vtkDelaunayFlip* f) { f->SetLinesAsConstraints(!f->GetLinesAsConstraints()); } },
    { "InsertLines", [](vtkDelaunayFlip* f) { f->SetInsertLines(!f->GetInsertLines()); } },
    { "InsertConstraints",
      [](vtkDelaunayFlip* f) { f->SetInsertConstraints(!f->GetInsertConstraints()); } },
    { "GenerateFlipCount",
      [](vtkDelaunayFlip* f) { f->SetGenerateFlipCount(!f->GetGenerateFlipCount()); } },
    { "GenerateQuality",
      [](vtkDelaunayFlip* f) { f->SetGenerateQuality(!f->GetGenerateQuality()); } },
  };
  return all;
}

struct RanksCase
{
  EngineCase Whole;
  std::vector<int> Owners; ///< The rank of every triangle.
  int Ranks;
  int Different; ///< The rank with another option, or 0: none.
  std::size_t Difference;
  bool HasNumbers; ///< Global ids of points.
  bool IsComposite;
  std::uint32_t Flags; ///< The filter's own options.
};

RanksCase MakeRanksCase(const std::uint8_t* bytes, std::size_t size)
{
  RanksCase drawn;
  drawn.Whole = MakeEngineCase(bytes, size);
  const std::vector<std::uint8_t> backwards(
    std::reverse_iterator(bytes + size), std::reverse_iterator(bytes));
  ByteSource source(backwards.data(), size); // another one: all choices of the mesh are its own
  drawn.Ranks = 2 + static_cast<int>(source.Draw(3));
  drawn.Different = source.Once(2)
    ? 0
    : 1 + static_cast<int>(source.Draw(static_cast<std::uint32_t>(drawn.Ranks - 1)));
  drawn.Difference = source.Draw(static_cast<std::uint32_t>(ListDifferences().size()));
  drawn.HasNumbers = source.Once(2);
  drawn.IsComposite = source.Once(4);
  drawn.Flags = source.Draw(256);
  const bool isScattered = source.Once(3);
  const std::size_t triangles = drawn.Whole.Triangles.size() / 3;
  for (std::size_t t = 0; t < triangles; ++t)
  {
    drawn.Owners.push_back(
      static_cast<int>(isScattered ? source.Draw(static_cast<std::uint32_t>(drawn.Ranks))
                                   : t * static_cast<std::size_t>(drawn.Ranks) / triangles));
  }
  return drawn;
}

/// The triangles of one rank with their points.
vtkSmartPointer<vtkDataObject> MakePiece(const RanksCase& drawn, const OwnPiece& own)
{
  const TriangleMesh mesh = own.View().Mesh;
  vtkNew<vtkPoints> points;
  points->SetDataType(drawn.Whole.HasFloats ? VTK_FLOAT : VTK_DOUBLE);
  for (std::int64_t i = 0; i < mesh.Points.Count; ++i)
  {
    points->InsertNextPoint(mesh.Points.Get(i, 0), mesh.Points.Get(i, 1), mesh.Points.Get(i, 2));
  }
  vtkNew<vtkIntArray> regions;
  regions->SetName("Region");
  vtkNew<vtkCellArray> polygons;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    polygons->InsertNextCell(
      { mesh.Triangles.Get(t, 0), mesh.Triangles.Get(t, 1), mesh.Triangles.Get(t, 2) });
    regions->InsertNextValue(mesh.Regions ? mesh.Regions[t] : 0);
  }
  const auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->SetPoints(points);
  piece->SetPolys(polygons);
  piece->GetCellData()->AddArray(regions);
  if (drawn.HasNumbers)
  {
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName("Number");
    std::for_each(own.PointOf.begin(), own.PointOf.end(),
      [&numbers](std::int64_t id) { numbers->InsertNextValue(id); });
    piece->GetPointData()->SetGlobalIds(numbers);
  }
  if (!drawn.IsComposite)
  {
    return piece;
  }
  const auto partitions = vtkSmartPointer<vtkPartitionedDataSet>::New();
  partitions->SetPartition(0, piece);
  return partitions;
}

vtkSmartPointer<RankFilter> MakeFilter(const RanksCase& drawn, const OwnPiece& piece, int rank)
{
  const auto filter = vtkSmartPointer<RankFilter>::New();
  const FlipOptions& options = drawn.Whole.Options;
  filter->SetInputDataObject(MakePiece(drawn, piece));
  filter->SetGeometry(static_cast<int>(options.Geometry));
  filter->SetCriterion(static_cast<int>(options.Criterion));
  filter->SetTieRule(static_cast<int>(options.TieRule));
  filter->SetTolerance(options.Tolerance);
  filter->SetFeatureAngle(options.FeatureAngle);
  filter->SetMaximumDeviation(options.MaximumDeviation);
  filter->SetMaximumIterations(static_cast<int>(options.MaximumIterations));
  filter->SetTrackQuality(options.TrackQuality);
  filter->SetBackendToThreads();
  for (std::size_t i = 0; i < 7; ++i)
  {
    if ((drawn.Flags >> i & 1) != 0)
    {
      ListDifferences()[FirstOfFilter + i].Apply(filter);
    }
  }
  // What may differ:
  filter->SetNumberOfThreads(1 + rank % 2);
  filter->SetNumberOfPieces((drawn.Flags & 128) != 0 ? rank : 0);
  if (drawn.Different > 0 && rank == drawn.Different)
  {
    ListDifferences()[drawn.Difference].Apply(filter);
  }
  return filter;
}

vtkPolyData* GetResult(vtkDelaunayFlip* filter)
{
  vtkDataObject* output = filter->GetOutputDataObject(0);
  auto* partitions = vtkPartitionedDataSet::SafeDownCast(output);
  return vtkPolyData::SafeDownCast(
    partitions && partitions->GetNumberOfPartitions() > 0 ? partitions->GetPartition(0) : output);
}

void Require(bool condition, const std::string& text)
{
  if (!condition)
  {
    throw std::runtime_error(text);
  }
}

void JudgeFailure(const RanksCase& drawn, vtkDelaunayFlip* filter)
{
  const std::string error = filter->GetErrorMessage();
  const std::string property = ListDifferences()[drawn.Difference].Property;
  Require(filter->GetFailure() == vtkDelaunayFlip::FAILURE_OPTIONS, "no failure: " + property);
  for (const std::string& part : { property + " is '", std::string("' on rank 0, but '"),
         "' on rank " + std::to_string(drawn.Different) })
  {
    Require(error.find(part) != std::string::npos, "'" + part + "' is missing in: " + error);
  }
}

void Judge(const RanksCase& drawn, const std::vector<vtkSmartPointer<RankFilter>>& filters)
{
  RankFilter* first = filters.front();
  vtkIdType triangles = 0;
  for (RankFilter* filter : filters)
  {
    const std::string error = filter->GetErrorMessage();
    Require(error == first->GetErrorMessage(),
      "ranks say '" + error + "' and '" + first->GetErrorMessage() + "'");
    Require(filter->GetFailure() == first->GetFailure() &&
        filter->GetTotalFlips() == first->GetTotalFlips() &&
        filter->GetNumberOfIterations() == first->GetNumberOfIterations() &&
        filter->GetNonDelaunayAfter() == first->GetNonDelaunayAfter() &&
        filter->GetStopReason() == first->GetStopReason(),
      "ranks report different results");
    triangles += GetResult(filter) ? GetResult(filter)->GetNumberOfPolys() : 0;
  }
  if (drawn.Different > 0)
  {
    JudgeFailure(drawn, first);
    return;
  }
  const bool isDone = first->GetFailure() == vtkDelaunayFlip::FAILURE_NONE;
  const auto given = static_cast<vtkIdType>(drawn.Owners.size());
  Require(triangles == (isDone ? given : 0),
    "there are " + std::to_string(triangles) + " triangles of " + std::to_string(given) + ": " +
      first->GetErrorMessage());
  const std::int64_t most = drawn.Whole.Options.MaximumIterations;
  Require(!isDone || most < 0 || first->GetNumberOfIterations() <= most, "too many iterations");
}

}

void SetUpTarget(int*, char**) { vtkObject::GlobalWarningDisplayOff(); }

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  const RanksCase drawn = MakeRanksCase(bytes, size);
  const std::vector<OwnPiece> pieces =
    DivideMesh(EngineInput(drawn.Whole).View(), drawn.Owners, drawn.Ranks);
  std::vector<vtkSmartPointer<RankFilter>> filters;
  for (int rank = 0; rank < drawn.Ranks; ++rank)
  {
    filters.push_back(MakeFilter(drawn, pieces[rank], rank));
  }
  RunInThreads(drawn.Ranks,
    [&](PieceGroup& group)
    {
      RankFilter* filter = filters[group.GetRank()];
      filter->Group = &group;
      filter->UpdatePiece(group.GetRank(), group.GetSize(), 0);
    });
  Judge(drawn, filters);
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const RanksCase drawn = MakeRanksCase(bytes, size);
  Print(drawn.Whole, std::cout);
  std::cout << "Ranks = " << drawn.Ranks << "; Different = " << drawn.Different
            << "; Property = " << ListDifferences()[drawn.Difference].Property
            << "; HasNumbers = " << drawn.HasNumbers << "; IsComposite = " << drawn.IsComposite
            << "; Flags = " << drawn.Flags << ";\n";
}
