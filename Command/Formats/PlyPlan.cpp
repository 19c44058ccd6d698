// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyPlan.h"

#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>

#include <algorithm>
#include <cctype>
#include <limits>

namespace delaunayflip
{

namespace
{

using Names = std::vector<std::string>;

/// The smallest type that holds all values of an array of 64-bit integers exactly; none if double
/// does not either.
std::optional<PlyType> FitLargeIntegers(vtkDataArray* array)
{
  constexpr double exact = 9007199254740992.0; // 2^53
  double least = 0.0;
  double most = 0.0;
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    double range[2];
    array->GetRange(range, component);
    least = std::min(least, range[0]);
    most = std::max(most, range[1]);
  }
  if (least >= std::numeric_limits<std::int32_t>::min() &&
    most <= std::numeric_limits<std::int32_t>::max())
  {
    return PlyType::Int32;
  }
  if (least >= 0.0 && most <= std::numeric_limits<std::uint32_t>::max())
  {
    return PlyType::UInt32;
  }
  return least > -exact && most < exact ? std::optional(PlyType::Float64) : std::nullopt;
}

std::optional<PlyType> PlyTypeOf(vtkDataArray* array)
{
  switch (array->GetDataType())
  {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return PlyType::Int8;
    case VTK_UNSIGNED_CHAR:
    case VTK_BIT:
      return PlyType::UInt8;
    case VTK_SHORT:
      return PlyType::Int16;
    case VTK_UNSIGNED_SHORT:
      return PlyType::UInt16;
    case VTK_INT:
      return PlyType::Int32;
    case VTK_UNSIGNED_INT:
      return PlyType::UInt32;
    case VTK_FLOAT:
      return PlyType::Float32;
    case VTK_DOUBLE:
      return PlyType::Float64;
    default:
      return FitLargeIntegers(array);
  }
}

bool IsColor(vtkDataSetAttributes* data, vtkDataArray* array)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  const int components = array->GetNumberOfComponents();
  const bool isScalars = array == data->GetScalars() && array->GetDataType() == VTK_UNSIGNED_CHAR;
  return (components == 3 && (isScalars || name == "RGB")) ||
    (components == 4 && (isScalars || name == "RGBA"));
}

/// A name must be one word.
std::string MakeWord(const char* name, const std::string& fallback)
{
  std::string word = name && *name ? name : fallback;
  std::replace_if(
    word.begin(), word.end(), [](unsigned char c) { return std::isspace(c) || std::iscntrl(c); },
    '_');
  return word;
}

/// The names by which other programs know an array, else its own.
Names PropertyNames(vtkDataSetAttributes* data, vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  if (array == data->GetNormals() && components == 3)
  {
    return { "nx", "ny", "nz" };
  }
  if (array == data->GetTCoords() && components == 2)
  {
    return { "u", "v" };
  }
  if (IsColor(data, array))
  {
    const Names names = { "red", "green", "blue", "alpha" };
    return Names(names.begin(), names.begin() + components);
  }
  const std::string word = MakeWord(array->GetName(), "values");
  Names names;
  for (int component = 0; component < components; ++component)
  {
    names.push_back(components == 1 ? word : word + "_" + std::to_string(component));
  }
  return names;
}

bool Intersect(const Names& first, const Names& second)
{
  return std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) !=
    first.end();
}

}

bool PlyPlan::Holds(vtkAbstractArray* array) const
{
  return std::find(this->Left.begin(), this->Left.end(), array) == this->Left.end();
}

PlyPlan PlanPly(vtkDataSetAttributes* data, vtkIdType size, std::vector<std::string> taken)
{
  PlyPlan plan;
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
    const auto type = array ? PlyTypeOf(array) : std::nullopt;
    const Names names = type ? PropertyNames(data, array) : Names();
    if (!type || array->GetNumberOfTuples() < size || Intersect(names, taken))
    {
      plan.Left.push_back(data->GetAbstractArray(index));
      continue;
    }
    taken.insert(taken.end(), names.begin(), names.end());
    for (std::size_t component = 0; component < names.size(); ++component)
    {
      plan.Properties.push_back({ names[component], *type, array, static_cast<int>(component) });
    }
  }
  return plan;
}

}
