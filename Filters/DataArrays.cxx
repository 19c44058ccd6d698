// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DataArrays.h"

#include "FlipError.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <set>

namespace delaunayflip
{

namespace
{

/// Cells with arrays of their own, which share the memory of the others and know how much of it
/// they use.
vtkSmartPointer<vtkCellArray> ShareCells(vtkCellArray* cells)
{
  const auto share = [](vtkDataArray* array)
  {
    auto shared = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    shared->ShallowCopy(array);
    return shared;
  };
  auto shared = vtkSmartPointer<vtkCellArray>::New();
  shared->SetData(share(cells->GetOffsetsArray()), share(cells->GetConnectivityArray()));
  return shared;
}

}

vtkSmartPointer<vtkPolyData> ShareMesh(vtkPolyData* mesh)
{
  auto shared = vtkSmartPointer<vtkPolyData>::New();
  shared->ShallowCopy(mesh);
  shared->SetVerts(ShareCells(mesh->GetVerts()));
  shared->SetLines(ShareCells(mesh->GetLines()));
  shared->SetPolys(ShareCells(mesh->GetPolys()));
  shared->SetStrips(ShareCells(mesh->GetStrips()));
  return shared;
}

PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage)
{
  const vtkIdType count = mesh->GetNumberOfPoints();
  if (count == 0)
  {
    return {};
  }
  vtkDataArray* data = mesh->GetPoints()->GetData();
  if (data->GetNumberOfComponents() != 3)
  {
    throw InvalidMesh(
      "Points must have 3 coordinates, not " + std::to_string(data->GetNumberOfComponents()) + ".",
      -1, -1);
  }
  if (auto* floats = vtkArrayDownCast<vtkAOSDataArrayTemplate<float>>(data))
  {
    return { static_cast<const float*>(floats->GetPointer(0)), count };
  }
  if (auto* doubles = vtkArrayDownCast<vtkAOSDataArrayTemplate<double>>(data))
  {
    return { static_cast<const double*>(doubles->GetPointer(0)), count };
  }
  storage.resize(3 * count);
  for (vtkIdType point = 0; point < count; ++point)
  {
    data->GetTuple(point, &storage[3 * point]);
  }
  return { static_cast<const double*>(storage.data()), count };
}

vtkSmartPointer<vtkPoints> CopyPoints(vtkPoints* points)
{
  vtkDataArray* const from = points->GetData();
  auto copy = vtkSmartPointer<vtkPoints>::New();
  copy->SetDataType(from->GetDataType()); // to which DeepCopy rounds
  const bool isPlain = from->GetNumberOfComponents() == 3 && from->HasStandardMemoryLayout() &&
    from->GetDataTypeSize() > 0;
  if (!isPlain)
  {
    copy->DeepCopy(points);
    return copy;
  }
  const vtkIdType count = points->GetNumberOfPoints();
  copy->SetNumberOfPoints(count);
  copy->GetData()->SetName(from->GetName());
  copy->GetData()->CopyComponentNames(from);
  if (from->HasInformation())
  {
    copy->GetData()->CopyInformation(from->GetInformation());
  }
  const vtkIdType size = 3 * vtkIdType(from->GetDataTypeSize());
  const auto* const first = static_cast<const unsigned char*>(from->GetVoidPointer(0));
  auto* const to = static_cast<unsigned char*>(copy->GetVoidPointer(0));
  constexpr vtkIdType Grain = 1 << 14;
  vtkSMPTools::For(0, count, Grain,
    [=](vtkIdType begin, vtkIdType end)
    { std::memcpy(to + size * begin, first + size * begin, size * (end - begin)); });
  return copy;
}

vtkSmartPointer<vtkPoints> PlacePoints(vtkPoints* degrees)
{
  auto places = vtkSmartPointer<vtkPoints>::New();
  places->SetDataTypeToDouble();
  places->SetNumberOfPoints(degrees->GetNumberOfPoints());
  for (vtkIdType i = 0; i < degrees->GetNumberOfPoints(); ++i)
  {
    double given[3], place[3];
    degrees->GetPoint(i, given);
    PlaceOnSphere(given[0], given[1], place);
    places->SetPoint(i, place);
  }
  return places;
}

bool HaveSameBits(const PointArray& points, const PointArray& others)
{
  const auto areSame = [&](const auto* a, const auto* b)
  { return a && b && (a == b || std::memcmp(a, b, 3 * points.Count * sizeof(*a)) == 0); };
  return points.Count == others.Count &&
    (areSame(points.Floats, others.Floats) || areSame(points.Doubles, others.Doubles));
}

void PointIdCheck::RequireValid(vtkCellArray* cells) const
{
  if (!cells->IsValid())
  {
    throw InvalidMesh(std::string("The offsets and the connectivity of the cell array of ") +
        this->What + " " + std::to_string(this->FirstCell) +
        " and the following ones contradict each other.",
      this->FirstCell, -1);
  }
}

void PointIdCheck::ThrowOutOfRange(vtkIdType cell, vtkIdType id) const
{
  const vtkIdType cellId = this->FirstCell + cell;
  throw InvalidMesh(std::string("Invalid mesh: ") + this->What + " " + std::to_string(cellId) +
      " names point " + std::to_string(id) + ", but there are " +
      std::to_string(this->NumberOfPoints) + " points, numbered from 0.",
    cellId, id);
}

//------------------------------------------------------------------------------
std::string GetName(vtkAbstractArray* array)
{
  const char* name = array->GetName();
  return name ? name : "";
}

std::string ListNames(vtkDataSetAttributes* data)
{
  if (data->GetNumberOfArrays() == 0)
  {
    return "it has none";
  }
  std::string names = "it has \"" + GetName(data->GetAbstractArray(0)) + '"';
  for (int i = 1; i < data->GetNumberOfArrays(); ++i)
  {
    names += ", \"" + GetName(data->GetAbstractArray(i)) + '"';
  }
  return names;
}

void SetName(const std::string& name, vtkAbstractArray* array)
{
  array->SetName(name.empty() ? nullptr : name.c_str());
}

vtkSmartPointer<vtkDataSetAttributes> TakeWholeArrays(vtkDataSetAttributes* data, vtkIdType tuples)
{
  auto whole = vtkSmartPointer<vtkDataSetAttributes>::New();
  whole->ShallowCopy(data);
  for (int i = whole->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (whole->GetAbstractArray(i)->GetNumberOfTuples() < tuples)
    {
      whole->RemoveArray(i);
    }
  }
  return whole;
}

bool IsWrongGhostArray(vtkAbstractArray* array)
{
  return GetName(array) == vtkDataSetAttributes::GhostArrayName() &&
    (array->GetDataType() != VTK_UNSIGNED_CHAR || array->GetNumberOfComponents() != 1);
}

vtkSmartPointer<vtkUnsignedCharArray> FindGhosts(vtkPolyData* mesh)
{
  vtkDataArray* array = mesh->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  if (!array || IsWrongGhostArray(array))
  {
    return nullptr;
  }
  if (auto* ghosts = vtkArrayDownCast<vtkUnsignedCharArray>(array))
  {
    return ghosts;
  }
  auto ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New(); // another layout of memory
  ghosts->DeepCopy(array);
  return ghosts;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkIdList> MakeRange(vtkIdType first, vtkIdType count)
{
  auto range = vtkSmartPointer<vtkIdList>::New();
  range->SetNumberOfIds(count);
  std::iota(range->begin(), range->end(), first);
  return range;
}

int FindAttributes(vtkDataSetAttributes* data, vtkAbstractArray* array)
{
  int attributes = 0;
  for (int i = 0; i < vtkDataSetAttributes::NUM_ATTRIBUTES; ++i)
  {
    if (data->GetAbstractAttribute(i) == array)
    {
      attributes |= 1 << i;
    }
  }
  return attributes;
}

void AddAttributes(vtkDataSetAttributes* data, int index, int attributes)
{
  for (int i = 0; i < vtkDataSetAttributes::NUM_ATTRIBUTES; ++i)
  {
    if ((attributes >> i & 1) != 0 && !data->GetAbstractAttribute(i))
    {
      data->SetActiveAttribute(index, i);
    }
  }
}

namespace
{

bool AreAlike(vtkAbstractArray* a, vtkAbstractArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

/// An array of the same kind, of zeros or empty texts.
vtkSmartPointer<vtkAbstractArray> MakeZeros(vtkAbstractArray* like, vtkIdType tuples)
{
  auto array =
    vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(like->GetDataType()));
  array->SetName(like->GetName());
  array->SetNumberOfComponents(like->GetNumberOfComponents());
  array->SetNumberOfTuples(tuples);
  array->CopyComponentNames(like);
  array->CopyInformation(like->GetInformation());
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    numbers->Fill(0.0);
    numbers->SetLookupTable(vtkArrayDownCast<vtkDataArray>(like)->GetLookupTable());
  }
  return array;
}

}

std::set<std::string> AddTuples(vtkDataSetAttributes* own, vtkIdList* sources, vtkIdList* places,
  vtkIdType size, vtkDataSetAttributes* data)
{
  std::set<vtkAbstractArray*> taken; // never iterated over
  std::set<std::string> names;
  for (int i = 0; i < own->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = own->GetAbstractArray(i);
    std::string name = GetName(array);
    const auto fits = [&](vtkAbstractArray* other)
    { return AreAlike(other, array) && taken.count(other) == 0; };
    const auto find = [&]()
    {
      for (int k = 0; k < data->GetNumberOfArrays(); ++k)
      {
        vtkAbstractArray* other = data->GetAbstractArray(k);
        if (GetName(other) == name && (!name.empty() || fits(other)))
        {
          return vtkSmartPointer<vtkAbstractArray>(other);
        }
      }
      return vtkSmartPointer<vtkAbstractArray>();
    };
    vtkSmartPointer<vtkAbstractArray> target = find();
    while (target && !fits(target))
    {
      name += " (2)";
      target = find();
    }
    if (!target)
    {
      target = MakeZeros(array, size);
      SetName(name, target);
      AddAttributes(data, data->AddArray(target), FindAttributes(own, array));
    }
    taken.insert(target);
    names.insert(name);
    target->InsertTuples(places, sources, array);
  }
  return names;
}

void DemoteGlobalIds(vtkDataSetAttributes* data)
{
  int indices[vtkDataSetAttributes::NUM_ATTRIBUTES];
  data->GetAttributeIndices(indices);
  const int ids = indices[vtkDataSetAttributes::GLOBALIDS];
  data->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  if (!data->GetPedigreeIds())
  {
    data->SetActiveAttribute(ids, vtkDataSetAttributes::PEDIGREEIDS);
  }
}

vtkDataArray* FindSizes(vtkPolyData* mesh, const std::string& name, vtkIdType count)
{
  vtkPointData* data = mesh->GetPointData();
  vtkDataArray* array = data->GetArray(name.c_str());
  if (!array)
  {
    throw InvalidOptions("SizeArray: the input has no point array of numbers named \"" + name +
      "\"; " + ListNames(data) + ".");
  }
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() < count)
  {
    throw InvalidOptions("SizeArray: \"" + name +
      "\" must have one component, and as many tuples as there are points.");
  }
  return array;
}

std::vector<RegionSeed> ReadRegionSeeds(const std::vector<std::array<double, 4>>& regions)
{
  std::vector<RegionSeed> seeds;
  for (const std::array<double, 4>& region : regions)
  {
    const double label = region[2];
    const bool isInteger = label >= INT32_MIN && label <= INT32_MAX && label == std::floor(label);
    if (!isInteger)
    {
      throw InvalidOptions("the label of region " + std::to_string(seeds.size()) +
        " must be an integer from -2147483648 to 2147483647, not " + FormatNumber(label, 10));
    }
    seeds.push_back({ region[0], region[1], static_cast<std::int32_t>(label), region[3] });
  }
  return seeds;
}

namespace
{
bool IsReal(vtkAbstractArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

/// Turns arrays of numbers, except labels, into others.
/// @param find the type that an array becomes, from the array.
template <typename FindType>
void TurnNumbers(vtkDataSetAttributes* data, const FindType& find)
{
  const vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i); // null if it has no numbers
    const bool isLabel = std::count(std::begin(labels), std::end(labels), array) > 0;
    if (!array || !array->GetName() || isLabel)
    {
      continue;
    }
    const int type = find(array);
    if (type != array->GetDataType())
    {
      const auto turned = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
      turned->DeepCopy(array);
      const int attributes = FindAttributes(data, array);
      AddAttributes(data, data->AddArray(turned), attributes); // replaces the array
    }
  }
}
}

void TurnToDoubles(vtkDataSetAttributes* data)
{
  TurnNumbers(
    data, [](vtkDataArray* array) { return IsReal(array) ? array->GetDataType() : VTK_DOUBLE; });
}

void TurnToRealsOf(vtkDataSetAttributes* own, vtkDataSetAttributes* data)
{
  TurnNumbers(data,
    [own](vtkDataArray* array)
    {
      vtkAbstractArray* like = own->GetAbstractArray(array->GetName());
      return like && IsReal(like) ? like->GetDataType() : array->GetDataType();
    });
}

vtkSmartPointer<vtkPoints> ExtendPoints(vtkPolyData* mesh, vtkPoints* more, vtkIdList* ids)
{
  const vtkIdType given = mesh->GetNumberOfPoints();
  const vtkIdType size = given + ids->GetNumberOfIds();
  vtkPoints* typical = given > 0 ? mesh->GetPoints() : more;
  auto points = vtkSmartPointer<vtkPoints>::New();
  // Integers would cut what is added.
  points->SetDataType(FindPointType(typical->GetDataType() == VTK_FLOAT));
  points->SetNumberOfPoints(size);
  if (given > 0)
  {
    points->InsertPoints(0, given, 0, mesh->GetPoints());
  }
  points->InsertPoints(MakeRange(given, size - given), ids, more);
  return points;
}

namespace
{
/// Writes the tuple of an added point, interpolated between those of two or three other points.
void InterpolateTuple(vtkIdType target, const AddedPoint& point, vtkAbstractArray* array)
{
  if (point.Third < 0)
  {
    array->InterpolateTuple(target, point.From, array, point.To, array, point.Share);
    return;
  }
  vtkNew<vtkIdList> corners;
  for (const std::int64_t corner : { point.From, point.To, point.Third })
  {
    corners->InsertNextId(corner);
  }
  double weights[] = { 1.0 - point.Share - point.ThirdShare, point.Share, point.ThirdShare };
  array->InterpolateTuple(target, corners, array, weights);
}
}

void InterpolateTuples(
  const std::vector<AddedPoint>& added, vtkIdType first, vtkDataSetAttributes* data)
{
  vtkAbstractArray* labels[] = { data->GetGlobalIds(), data->GetPedigreeIds(),
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (std::count(std::begin(labels), std::end(labels), array) > 0)
    {
      continue;
    }
    vtkIdType next = first;
    for (const AddedPoint& point : added)
    {
      InterpolateTuple(next++, point, array);
    }
  }
}

std::set<std::string> AppendPoints(vtkPolyData* mesh, vtkPoints* more, vtkIdList* ids,
  vtkDataSetAttributes* data, vtkPolyData* output)
{
  const vtkIdType given = mesh->GetNumberOfPoints();
  const vtkIdType size = given + ids->GetNumberOfIds();
  const auto own = MakeRange(0, given), places = MakeRange(given, size - given);
  output->SetPoints(ExtendPoints(mesh, more, ids));
  output->GetPointData()->Initialize();
  AddTuples(TakeWholeArrays(mesh->GetPointData(), given), own, own, size, output->GetPointData());
  if (!data)
  {
    return {};
  }
  return AddTuples(data, ids, places, size, output->GetPointData());
}

void AppendAdded(
  const std::vector<AddedPoint>& added, bool hasPlaces, vtkPolyData* mesh, vtkPolyData* output)
{
  const vtkIdType first = mesh->GetNumberOfPoints();
  const auto size = static_cast<vtkIdType>(added.size());
  vtkNew<vtkPoints> zeros;
  zeros->SetNumberOfPoints(size);
  zeros->GetData()->Fill(0.0);
  AppendPoints(mesh, zeros, MakeRange(0, size), nullptr, output);
  InterpolateTuples(added, first, output->GetPointData());
  vtkDataArray* xyz = output->GetPoints()->GetData();
  for (vtkIdType i = 0; i < size; ++i)
  {
    const AddedPoint& point = added[i];
    double place[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      // InterpolateTuple would make infinite floats finite.
      place[axis] = (1.0 - point.Share - point.ThirdShare) * xyz->GetComponent(point.From, axis) +
        point.Share * xyz->GetComponent(point.To, axis);
      if (point.Third >= 0)
      {
        place[axis] += point.ThirdShare * xyz->GetComponent(point.Third, axis);
      }
    }
    if (hasPlaces)
    {
      place[0] = point.X;
      place[1] = point.Y;
    }
    xyz->SetTuple(first + i, place);
  }
}

PlaneArray CopyPlaces(
  const PlaneArray& places, std::vector<float>& floats, std::vector<double>& doubles)
{
  const auto copy = [&places](auto* from, auto& storage)
  {
    std::decay_t<decltype(storage)> copied(2 * places.Count);
    for (std::int64_t i = 0; i < places.Count; ++i)
    {
      copied[2 * i] = from[i * places.Stride];
      copied[2 * i + 1] = from[i * places.Stride + 1];
    }
    storage = std::move(copied);
    return PlaneArray(std::as_const(storage).data(), places.Count, 2);
  };
  return places.Floats ? copy(places.Floats, floats) : copy(places.Doubles, doubles);
}

}
