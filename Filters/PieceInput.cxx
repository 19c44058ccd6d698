// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceInput.h"

#include "MalformedArrays.h"
#include "PointViews.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>

namespace delaunayflip
{
namespace
{

/// The bytes of a number, equal for equal numbers.
template <typename Number>
void AppendNumber(Number number, std::string& text)
{
  char bytes[sizeof(Number)];
  std::memcpy(bytes, &number, sizeof(Number));
  text.append(bytes, sizeof(Number));
}

/// What identifies the label of a cell on every rank.
std::string DescribeLabel(vtkAbstractArray* array, vtkIdType cell)
{
  std::string text;
  auto* numbers = vtkArrayDownCast<vtkDataArray>(array);
  const bool isReal =
    numbers && (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE);
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    if (isReal)
    {
      const double number = numbers->GetComponent(cell, i) + 0.0; // -0 becomes 0
      AppendNumber(number == number ? number : vtkMath::Nan(), text);
    }
    else
    {
      const vtkIdType value = cell * array->GetNumberOfComponents() + i;
      text += array->GetVariantValue(value).ToString() + '\0';
    }
  }
  return text;
}

/// Texts with their lengths, in one message.
Message PackTexts(const std::vector<std::string>& texts)
{
  std::string all;
  for (const std::string& text : texts)
  {
    AppendNumber(static_cast<std::int64_t>(text.size()), all);
    all += text;
  }
  return Message(all.begin(), all.end());
}

void UnpackTexts(const Message& message, std::vector<std::string>& texts)
{
  for (std::size_t at = 0; at < message.size();)
  {
    std::int64_t size = 0;
    std::memcpy(&size, message.data() + at, sizeof(size));
    at += sizeof(size);
    texts.emplace_back(message.data() + at, size);
    at += size;
  }
}

vtkSmartPointer<vtkCellArray> TakeCells(vtkCellArray* cells, vtkIdType first, vtkIdList* chosen)
{
  auto taken = vtkSmartPointer<vtkCellArray>::New();
  const bool isWide = cells->GetConnectivityArray()->GetDataTypeSize() == 8;
  isWide ? taken->Use64BitStorage() : taken->Use32BitStorage();
  vtkNew<vtkIdList> ids;
  for (auto cell = std::lower_bound(chosen->begin(), chosen->end(), first);
       cell != chosen->end() && *cell < first + cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(*cell - first, ids);
    taken->InsertNextCell(ids);
  }
  return taken;
}

/// The mesh with some of its cells, of any size. (vtkPolyData::DeleteCell fails for some sizes.)
vtkSmartPointer<vtkPolyData> TakeCells(vtkPolyData* mesh, vtkIdList* chosen)
{
  auto taken = vtkSmartPointer<vtkPolyData>::New();
  taken->SetPoints(mesh->GetPoints());
  taken->GetPointData()->ShallowCopy(mesh->GetPointData());
  taken->GetFieldData()->ShallowCopy(mesh->GetFieldData());
  vtkIdType first = 0;
  taken->SetVerts(TakeCells(mesh->GetVerts(), first, chosen));
  first += mesh->GetNumberOfVerts();
  taken->SetLines(TakeCells(mesh->GetLines(), first, chosen));
  first += mesh->GetNumberOfLines();
  taken->SetPolys(TakeCells(mesh->GetPolys(), first, chosen));
  first += mesh->GetNumberOfPolys();
  taken->SetStrips(TakeCells(mesh->GetStrips(), first, chosen));
  const vtkSmartPointer<vtkCellData> whole = TakeWholeArrays(mesh);
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(chosen->GetNumberOfIds());
  std::iota(places->begin(), places->end(), 0);
  taken->GetCellData()->CopyAllOn();
  taken->GetCellData()->CopyAllocate(whole, chosen->GetNumberOfIds());
  taken->GetCellData()->CopyData(whole, chosen, places);
  return taken;
}

/// The ends of edges along lines and polygons: six coordinates for each.
class SegmentList
{
public:
  /// @throws InvalidMesh when a cell names a point that does not exist.
  void Add(vtkPoints* points, vtkCellArray* cells, const PointIdCheck& check, bool areClosed)
  {
    check.RequireValid(cells);
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, ids);
      check.RequireInRange(cell, ids);
      const vtkIdType count = ids->GetNumberOfIds();
      for (vtkIdType i = 0; i + (areClosed ? 0 : 1) < count; ++i)
      {
        this->AddPoint(points, ids->GetId(i));
        this->AddPoint(points, ids->GetId((i + 1) % count));
      }
    }
  }

  std::vector<double> Coordinates;

private:
  void AddPoint(vtkPoints* points, vtkIdType id)
  {
    double x[3];
    points->GetPoint(id, x);
    this->Coordinates.insert(this->Coordinates.end(), x, x + 3);
  }
};

vtkSmartPointer<vtkPolyData> BuildSegments(const std::vector<double>& coordinates, bool areFloats)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(areFloats ? VTK_FLOAT : VTK_DOUBLE);
  vtkNew<vtkCellArray> lines;
  for (std::size_t i = 0; i < coordinates.size(); i += 6)
  {
    const vtkIdType ids[2] = { points->InsertNextPoint(coordinates.data() + i),
      points->InsertNextPoint(coordinates.data() + i + 3) };
    lines->InsertNextCell(2, ids);
  }
  auto segments = vtkSmartPointer<vtkPolyData>::New();
  segments->SetPoints(points);
  segments->SetLines(lines);
  return segments;
}

/// The points that the constraints name.
vtkPoints* GetPointsOf(vtkPolyData* constraints, vtkPolyData* mesh)
{
  return constraints->GetNumberOfPoints() > 0 ? constraints->GetPoints() : mesh->GetPoints();
}

void ListSegments(vtkPolyData* constraints, vtkPoints* points, SegmentList& segments)
{
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  PointIdCheck check{ "constraint cell", constraints->GetNumberOfVerts(), count };
  segments.Add(points, constraints->GetLines(), check, false);
  check.FirstCell += constraints->GetNumberOfLines();
  segments.Add(points, constraints->GetPolys(), check, true);
}

}

bool IsOnAnyRank(bool flag, PieceGroup& group)
{
  bool isOnAny = false;
  const auto ask = [&](PieceGroup& told)
  {
    const std::vector<Message> flags = told.Gather(Message(1, flag ? 1 : 0));
    isOnAny =
      std::any_of(flags.begin(), flags.end(), [](const Message& one) { return one.front() != 0; });
  };
  RunTogether(group, std::ref(ask)); // the message needs memory
  return isOnAny;
}

std::vector<Note> ShareNotes(const std::vector<Note>& own, PieceGroup& group)
{
  if (group.GetSize() == 1)
  {
    return own;
  }
  std::vector<std::string> texts;
  for (const Note& note : own)
  {
    texts.insert(texts.end(), { note.Where, note.Text });
  }
  std::vector<Note> notes;
  int rank = 0;
  for (const Message& message : group.Gather(PackTexts(texts)))
  {
    std::vector<std::string> told;
    UnpackTexts(message, told);
    const std::string place = "rank " + std::to_string(rank++);
    for (std::size_t i = 0; i + 1 < told.size(); i += 2)
    {
      notes.push_back({ told[i].empty() ? place : place + ", " + told[i], told[i + 1] });
    }
  }
  return notes;
}

vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh)
{
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts = FindGhosts(mesh);
  const vtkIdType flags = ghosts ? ghosts->GetNumberOfValues() : 0;
  vtkNew<vtkIdList> kept;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    if (cell >= flags || !(ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL))
    {
      kept->InsertNextId(cell);
    }
  }
  return kept->GetNumberOfIds() == mesh->GetNumberOfCells() ? vtkSmartPointer<vtkPolyData>(mesh)
                                                            : TakeCells(mesh, kept);
}

std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh)
{
  vtkDataArray* ids = mesh->GetPointData()->GetGlobalIds();
  std::vector<std::int64_t> numbers;
  if (ids && ids->GetNumberOfComponents() == 1 &&
    ids->GetNumberOfTuples() == mesh->GetNumberOfPoints())
  {
    auto* known = vtkArrayDownCast<vtkIdTypeArray>(ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i) // a double has not all bits of an id
    {
      numbers.push_back(known ? known->GetValue(i) : ids->GetVariantValue(i).ToTypeInt64());
    }
  }
  return numbers;
}

void ShareRegionLabels(
  vtkPolyData* mesh, const std::string& name, std::vector<std::int32_t>& labels, PieceGroup& group)
{
  vtkAbstractArray* array = mesh->GetCellData()->GetAbstractArray(name.c_str());
  std::vector<std::string> own; // by the rank's own label
  DoTogether(group,
    [&]()
    {
      std::map<std::string, std::int32_t> known;
      for (vtkIdType cell = 0; array && cell < mesh->GetNumberOfCells(); ++cell)
      {
        const std::string text = DescribeLabel(array, cell);
        if (known.emplace(text, static_cast<std::int32_t>(own.size())).second)
        {
          own.push_back(text);
        }
      }
    });
  std::vector<std::string> all;
  for (const Message& message : group.Gather(PackTexts(own)))
  {
    UnpackTexts(message, all);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (std::int32_t& label : labels)
  {
    label =
      static_cast<std::int32_t>(std::lower_bound(all.begin(), all.end(), own[label]) - all.begin());
  }
}

vtkSmartPointer<vtkPolyData> JoinConstraints(const std::vector<ConstraintsOfMesh>& sources)
{
  SegmentList all;
  bool areFloats = true;
  for (const ConstraintsOfMesh& one : sources)
  {
    const bool hasPoints = one.Constraints->GetNumberOfPoints() > 0 || one.Mesh;
    if (hasPoints)
    {
      vtkPoints* points = GetPointsOf(one.Constraints, one.Mesh);
      ListSegments(one.Constraints, points, all);
      areFloats = areFloats && points->GetDataType() == VTK_FLOAT;
    }
  }
  return all.Coordinates.empty() ? nullptr : BuildSegments(all.Coordinates, areFloats);
}

vtkSmartPointer<vtkPolyData> GatherConstraints(
  vtkPolyData* constraints, vtkPolyData* mesh, PieceGroup& group)
{
  SegmentList own;
  bool areFloats = true;
  DoTogether(group,
    [&]()
    {
      vtkPoints* points = constraints ? GetPointsOf(constraints, mesh) : nullptr;
      if (constraints)
      {
        ListSegments(constraints, points, own);
      }
      areFloats = own.Coordinates.empty() || points->GetDataType() == VTK_FLOAT;
    });
  Message message(own.Coordinates.size() * sizeof(double) + 1, areFloats ? 1 : 0);
  std::copy_n(
    reinterpret_cast<const char*>(own.Coordinates.data()), message.size() - 1, message.data());
  std::vector<double> all;
  for (const Message& part : group.Gather(message))
  {
    areFloats = areFloats && part.back() != 0;
    std::vector<double> coordinates((part.size() - 1) / sizeof(double));
    std::copy_n(part.data(), part.size() - 1, reinterpret_cast<char*>(coordinates.data()));
    all.insert(all.end(), coordinates.begin(), coordinates.end());
  }
  return all.empty() ? nullptr : BuildSegments(all, areFloats);
}

}
