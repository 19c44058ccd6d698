// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JoinedPartitions.h"

#include "DataArrays.h"
#include "FlipError.h"
#include "PolyDataBridge.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace delaunayflip
{
namespace
{

constexpr vtkIdType None = -1;

/// Verts, lines, polygons and strips: the order of cell ids.
std::array<vtkCellArray*, 4> ListCells(vtkPolyData* mesh)
{
  return { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() };
}

/// The cells with the ids `chosen`, ascending, of `from`.
/// @param areWide whether ids are stored in 64 bits. @param localize turns a point id into that of
/// the new mesh.
template <typename Localize>
void TakeCells(vtkPolyData* from, const std::vector<vtkIdType>& chosen, bool areWide,
  const Localize& localize, vtkPolyData* to)
{
  std::array<vtkNew<vtkCellArray>, 4> taken;
  vtkIdType first = 0;
  auto cell = chosen.begin();
  vtkNew<vtkIdList> ids;
  for (std::size_t kind = 0; kind < taken.size(); ++kind)
  {
    vtkCellArray* cells = ListCells(from)[kind];
    areWide ? taken[kind]->Use64BitStorage() : taken[kind]->Use32BitStorage();
    for (; cell != chosen.end() && *cell < first + cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(*cell - first, ids);
      std::transform(ids->begin(), ids->end(), ids->begin(), localize);
      taken[kind]->InsertNextCell(ids);
    }
    first += cells->GetNumberOfCells();
  }
  to->SetVerts(taken[0]);
  to->SetLines(taken[1]);
  to->SetPolys(taken[2]);
  to->SetStrips(taken[3]);
}

vtkSmartPointer<vtkIdList> MakeList(const std::vector<vtkIdType>& ids)
{
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->begin());
  return list;
}

/// The mesh without cells that are copies of others.
vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh)
{
  auto kept = ShareMesh(mesh);
  if (HasDuplicateCells(mesh))
  {
    const auto ghosts = FindGhosts(mesh);
    std::vector<vtkIdType> chosen;
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
    {
      if (cell >= ghosts->GetNumberOfValues() ||
        (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) == 0)
      {
        chosen.push_back(cell);
      }
    }
    TakeCells(
      mesh, chosen, UsesWideIds(mesh), [](vtkIdType id) { return id; }, kept);
    const auto whole = TakeWholeArrays(mesh->GetCellData(), mesh->GetNumberOfCells());
    kept->GetCellData()->Initialize();
    JoinTuples(whole, nullptr, MakeList(chosen), kept->GetCellData());
  }
  return kept;
}

/// How cells use a point.
enum Use : unsigned char
{
  Unused,
  OfLines,
  AtBorder, ///< Of polygons that do not close around it.
  Inside
};

std::vector<Use> FindUses(vtkPolyData* mesh)
{
  std::vector<Use> uses(mesh->GetNumberOfPoints(), Unused);
  // Around a closed fan every neighbour is the next one once, and once the previous one.
  std::vector<std::uint64_t> fans(uses.size(), 0);
  const auto scatter = [](vtkIdType id)
  {
    std::uint64_t bits = static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    return bits ^ (bits >> 27);
  };
  const auto addCorner = [&](vtkIdType point, vtkIdType next, vtkIdType previous)
  {
    uses[point] = Inside;
    fans[point] += scatter(next) - scatter(previous);
  };
  const PointIdCheck check{ "cell", 0, mesh->GetNumberOfPoints() };
  VisitCells(mesh->GetLines(), check,
    [&](vtkIdType, vtkIdList* ids)
    {
      for (const vtkIdType id : *ids)
      {
        uses[id] = OfLines;
      }
    });
  VisitCells(mesh->GetPolys(), check,
    [&](vtkIdType, vtkIdList* ids)
    {
      const vtkIdType count = ids->GetNumberOfIds();
      for (vtkIdType i = 0; i < count; ++i)
      {
        addCorner(ids->GetId(i), ids->GetId((i + 1) % count), ids->GetId((i + count - 1) % count));
      }
    });
  VisitCells(mesh->GetStrips(), check,
    [&](vtkIdType, vtkIdList* ids)
    {
      for (vtkIdType i = 0; i + 2 < ids->GetNumberOfIds(); ++i)
      {
        const vtkIdType a = ids->GetId(i), b = ids->GetId(i + 1 + i % 2),
                        c = ids->GetId(i + 2 - i % 2);
        addCorner(a, b, c);
        addCorner(b, c, a);
        addCorner(c, a, b);
      }
    });
  for (std::size_t i = 0; i < uses.size(); ++i)
  {
    uses[i] = uses[i] == Inside && fans[i] != 0 ? AtBorder : uses[i];
  }
  return uses;
}

/// A point that other partitions may have, too.
struct Candidate
{
  std::array<double, 3> Place; ///< Coordinates, or a global id.
  bool IsOfLines;
  vtkIdType Number; ///< Among the points of all partitions.
  std::size_t Partition;
  bool IsInside;
};

std::vector<Candidate> ListCandidates(const std::vector<vtkSmartPointer<vtkPolyData>>& partitions)
{
  std::vector<std::vector<std::int64_t>> ids;
  bool haveIds = true;
  for (const auto& mesh : partitions)
  {
    ids.push_back(ReadPointNumbers(mesh));
    haveIds = haveIds && (!ids.back().empty() || mesh->GetNumberOfPoints() == 0);
  }
  std::vector<Candidate> all;
  vtkIdType number = 0;
  for (std::size_t k = 0; k < partitions.size(); ++k)
  {
    const std::vector<Use> uses = FindUses(partitions[k]);
    for (std::size_t i = 0; i < uses.size(); ++i, ++number)
    {
      std::array<double, 3> place{};
      if (haveIds) // all bits of the id, which a double may not have
      {
        place = { static_cast<double>(ids[k][i] >> 32), static_cast<double>(ids[k][i] & 0xffffffff),
          0.0 };
      }
      else
      {
        partitions[k]->GetPoint(static_cast<vtkIdType>(i), place.data());
      }
      if (uses[i] != Unused && place == place) // no NaN
      {
        all.push_back({ place, uses[i] == OfLines, number, k, !haveIds && uses[i] == Inside });
      }
    }
  }
  return all;
}

/// The name in the joined data of an array of a partition.
std::string FindName(vtkDataSetAttributes* own, int index, vtkDataSetAttributes* joined)
{
  vtkAbstractArray* array = own->GetAbstractArray(index);
  std::string name = array->GetName() ? array->GetName() : "\n" + std::to_string(index);
  if (IsWrongGhostArray(array)) // the joined mesh has the ghost types of the other partitions
  {
    name += '\n';
  }
  vtkAbstractArray* known = joined->GetAbstractArray(name.c_str());
  while (known && !IsSameKind(known, array))
  {
    name += '\n'; // no name that anybody gives
    known = joined->GetAbstractArray(name.c_str());
  }
  return name;
}

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

bool HasDuplicateCells(vtkPolyData* mesh)
{
  const auto ghosts = FindGhosts(mesh);
  return ghosts &&
    std::any_of(ghosts->Begin(), ghosts->End(),
      [](unsigned char ghost) { return (ghost & vtkDataSetAttributes::DUPLICATECELL) != 0; });
}

//------------------------------------------------------------------------------
JoinedPartitions::JoinedPartitions(
  std::vector<vtkSmartPointer<vtkPolyData>> partitions, const std::string& regions)
  : Partitions(std::move(partitions))
{
  for (vtkSmartPointer<vtkPolyData>& mesh : this->Partitions)
  {
    PointIdCheck check{ "cell", 0, mesh->GetNumberOfPoints() };
    for (vtkCellArray* cells : ListCells(mesh))
    {
      VisitCells(cells, check, [](vtkIdType, vtkIdList*) {});
      check.FirstCell += cells->GetNumberOfCells();
    }
    mesh = DropDuplicateCells(mesh);
  }
  this->JoinPoints();
  this->JoinCells();
  if (!regions.empty())
  {
    this->RequireRegions(regions);
  }
}

/// Points are the same if they have the same global id or, if a partition has no global ids, equal
/// coordinates, if at least one of them is at the border of its partition. Points without cells are
/// not compared.
void JoinedPartitions::JoinPoints()
{
  std::vector<Candidate> all = ListCandidates(this->Partitions);
  const auto order = [](const Candidate& one)
  { return std::tie(one.Place, one.IsOfLines, one.Number); };
  std::sort(all.begin(), all.end(),
    [&](const Candidate& a, const Candidate& b) { return order(a) < order(b); });
  vtkIdType count = 0;
  bool areDoubles = false;
  for (const auto& mesh : this->Partitions)
  {
    count += mesh->GetNumberOfPoints();
    areDoubles =
      areDoubles || (mesh->GetPoints() && mesh->GetPoints()->GetDataType() == VTK_DOUBLE);
  }
  std::vector<vtkIdType> same(count); // of every point, the first one that is the same
  std::iota(same.begin(), same.end(), 0);
  for (auto begin = all.begin(), end = begin; begin != all.end(); begin = end)
  {
    std::vector<Candidate> here;
    bool isRepeated = false;
    for (; end != all.end() && end->Place == begin->Place; ++end)
    {
      const bool isKnown = std::any_of(here.begin(), here.end(),
        [&](const Candidate& one) { return one.Partition == end->Partition; });
      if (!isKnown || !end->IsOfLines) // the partition has a point of polygons there
      {
        here.push_back(*end);
        isRepeated = isRepeated || isKnown;
      }
    }
    const bool isShared = here.front().Partition != here.back().Partition;
    if (!isShared ||
      std::all_of(here.begin(), here.end(), [](const Candidate& one) { return one.IsInside; }))
    {
      continue;
    }
    if (isRepeated)
    {
      this->Ambiguous += static_cast<vtkIdType>(here.size());
      continue;
    }
    const auto first = std::min_element(here.begin(), here.end(),
      [](const Candidate& a, const Candidate& b) { return a.Number < b.Number; });
    for (const Candidate& one : here)
    {
      same[one.Number] = first->Number;
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(areDoubles ? VTK_DOUBLE : VTK_FLOAT);
  vtkIdType number = 0;
  for (const auto& mesh : this->Partitions)
  {
    this->PointIds.emplace_back();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i, ++number)
    {
      // From here on the point's id in the joined mesh.
      same[number] =
        same[number] < number ? same[same[number]] : points->InsertNextPoint(mesh->GetPoint(i));
      this->PointIds.back().push_back(same[number]);
    }
  }
  this->Mesh->SetPoints(points);
}

void JoinedPartitions::JoinCells()
{
  std::vector<std::vector<vtkIdType>> places(this->Partitions.size());
  std::array<vtkNew<vtkCellArray>, 4> joined;
  vtkNew<vtkIntArray> marks;
  marks->SetName(MarkName);
  vtkNew<vtkIdList> ids;
  for (std::size_t kind = 0; kind < joined.size(); ++kind)
  {
    for (std::size_t k = 0; k < this->Partitions.size(); ++k)
    {
      vtkCellArray* cells = ListCells(this->Partitions[k])[kind];
      for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
      {
        cells->GetCellAtId(cell, ids);
        std::transform(ids->begin(), ids->end(), ids->begin(),
          [&](vtkIdType id) { return this->PointIds[k][id]; });
        joined[kind]->InsertNextCell(ids);
        places[k].push_back(marks->InsertNextValue(static_cast<int>(k)));
      }
    }
  }
  this->Mesh->SetVerts(joined[0]);
  this->Mesh->SetLines(joined[1]);
  this->Mesh->SetPolys(joined[2]);
  this->Mesh->SetStrips(joined[3]);
  for (std::size_t k = this->Partitions.size(); k-- > 0;) // the first one's points count
  {
    vtkPolyData* mesh = this->Partitions[k];
    this->JoinData(mesh->GetPointData(), MakeList(this->PointIds[k]), this->Mesh->GetPointData(),
      this->Mesh->GetNumberOfPoints());
    this->JoinData(mesh->GetCellData(), MakeList(places[k]), this->Mesh->GetCellData(),
      this->Mesh->GetNumberOfCells());
  }
  this->Mesh->GetCellData()->AddArray(marks);
}

/// @param places of the partition's tuples among all. Arrays with too few tuples are left out.
void JoinedPartitions::JoinData(
  vtkDataSetAttributes* own, vtkIdList* places, vtkDataSetAttributes* joined, vtkIdType size) const
{
  const auto sources = MakeRange(0, places->GetNumberOfIds());
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    const std::string name = FindName(own, i, joined);
    vtkSmartPointer<vtkAbstractArray> target = joined->GetAbstractArray(name.c_str());
    const bool isKnown = target != nullptr;
    target = isKnown ? target : MakeZeros(array, size);
    if (!target || array->GetNumberOfTuples() < places->GetNumberOfIds())
    {
      continue;
    }
    if (!isKnown)
    {
      target->SetName(name.c_str());
      AddArrayAs(own->IsArrayAnAttribute(i), target, joined);
    }
    target->InsertTuples(places, sources, array);
  }
}

void JoinedPartitions::RequireRegions(const std::string& name) const
{
  vtkAbstractArray* joined = this->Mesh->GetCellData()->GetAbstractArray(name.c_str());
  for (const auto& mesh : this->Partitions)
  {
    vtkAbstractArray* own = mesh->GetCellData()->GetAbstractArray(name.c_str());
    if (!own || !joined || !IsSameKind(own, joined) ||
      own->GetNumberOfTuples() < mesh->GetNumberOfCells())
    {
      throw InvalidOptions("not all partitions have a cell array named \"" + name +
        "\" of the same type, with a tuple for every cell");
    }
  }
}

//------------------------------------------------------------------------------
/// By partition, its cells after the run.
std::vector<std::vector<vtkIdType>> JoinedPartitions::ListCellsOfPartitions(
  vtkPolyData* flipped) const
{
  std::vector<std::vector<vtkIdType>> cells(this->Partitions.size());
  std::vector<std::size_t> owners(flipped->GetNumberOfPoints(), cells.size()); // first partitions
  for (std::size_t k = cells.size(); k-- > 0;)
  {
    for (const vtkIdType point : this->PointIds[k])
    {
      owners[point] = k;
    }
  }
  auto* marks = vtkIntArray::SafeDownCast(flipped->GetCellData()->GetAbstractArray(MarkName));
  vtkNew<vtkIdList> ids;
  vtkIdType next = 0;
  for (vtkCellArray* array : ListCells(flipped))
  {
    for (vtkIdType cell = 0; cell < array->GetNumberOfCells(); ++cell, ++next)
    {
      std::size_t partition = static_cast<std::size_t>(marks->GetValue(next));
      if (marks->GetValue(next) < 0)
      {
        array->GetCellAtId(cell, ids);
        partition = cells.size();
        for (const vtkIdType id : *ids)
        {
          partition = std::min(partition, owners[id]);
        }
        partition = partition < cells.size() ? partition : 0;
      }
      cells[partition].push_back(next);
    }
  }
  return cells;
}

std::vector<vtkSmartPointer<vtkPolyData>> JoinedPartitions::Divide(vtkPolyData* flipped) const
{
  const std::vector<std::vector<vtkIdType>> cells = this->ListCellsOfPartitions(flipped);
  flipped->GetCellData()->RemoveArray(MarkName);
  std::vector<vtkSmartPointer<vtkPolyData>> partitions;
  std::vector<vtkIdType> local(flipped->GetNumberOfPoints(), None); // ids in the partition at hand
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    vtkPolyData* own = this->Partitions[k];
    const vtkIdType given = own->GetNumberOfPoints();
    for (vtkIdType i = 0; i < given; ++i)
    {
      local[this->PointIds[k][i]] = i;
    }
    std::vector<vtkIdType> added; // points that the partition lacks
    auto made = vtkSmartPointer<vtkPolyData>::New();
    const auto localize = [&](vtkIdType point)
    {
      if (local[point] == None)
      {
        local[point] = given + static_cast<vtkIdType>(added.size());
        added.push_back(point);
      }
      return local[point];
    };
    TakeCells(flipped, cells[k], UsesWideIds(own), localize, made);
    if (added.empty())
    {
      made->SetPoints(own->GetPoints());
      made->GetPointData()->ShallowCopy(TakeWholeArrays(own->GetPointData(), given));
    }
    else
    {
      vtkNew<vtkPoints> points;
      points->SetDataType(own->GetPoints()->GetDataType());
      points->InsertPoints(0, given, 0, own->GetPoints());
      for (const vtkIdType point : added)
      {
        points->InsertNextPoint(flipped->GetPoint(point));
      }
      made->SetPoints(points);
      this->DivideData(
        own->GetPointData(), given, flipped->GetPointData(), MakeList(added), made->GetPointData());
    }
    this->DivideData(
      own->GetCellData(), 0, flipped->GetCellData(), MakeList(cells[k]), made->GetCellData());
    if (!flipped->GetCellData()->GetGlobalIds() && this->Mesh->GetCellData()->GetGlobalIds())
    {
      DemoteGlobalIds(made->GetCellData());
    }
    made->GetFieldData()->ShallowCopy(own->GetFieldData());
    for (int i = 0; i < flipped->GetFieldData()->GetNumberOfArrays(); ++i)
    {
      made->GetFieldData()->AddArray(flipped->GetFieldData()->GetAbstractArray(i));
    }
    added.insert(added.end(), this->PointIds[k].begin(), this->PointIds[k].end());
    for (const vtkIdType point : added)
    {
      local[point] = None;
    }
    partitions.push_back(made);
  }
  return partitions;
}

/// Writes the data of a partition after the run: first `count` tuples of its own, then those
/// `places` of the mesh's. Cells get also the arrays that the run has added.
void JoinedPartitions::DivideData(vtkDataSetAttributes* own, vtkIdType count,
  vtkDataSetAttributes* flipped, vtkIdList* places, vtkDataSetAttributes* result) const
{
  const bool areCells = count == 0;
  vtkDataSetAttributes* joined = areCells
    ? static_cast<vtkDataSetAttributes*>(this->Mesh->GetCellData())
    : this->Mesh->GetPointData();
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    vtkAbstractArray* source = flipped->GetAbstractArray(FindName(own, i, joined).c_str());
    const bool isWhole = source && array->GetNumberOfTuples() >= count;
    if (const auto made = isWhole ? ExtendArray(array, count, source, places) : nullptr)
    {
      AddArrayAs(own->IsArrayAnAttribute(i), made, result);
    }
  }
  for (int i = 0; areCells && i < flipped->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = flipped->GetAbstractArray(i);
    if (array->GetName() && !joined->HasArray(array->GetName()))
    {
      result->AddArray(ExtendArray(array, 0, array, places));
    }
  }
}

}
