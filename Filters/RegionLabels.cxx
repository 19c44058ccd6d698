// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RegionLabels.h"

#include "FlipError.h"
#include "WorkProgress.h"

#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <map>

namespace delaunayflip
{
namespace
{

/// The lexicographic order of tuples. All NaN are equal and come first.
struct TupleLess
{
  template <typename Value>
  bool operator()(const std::vector<Value>& left, const std::vector<Value>& right) const
  {
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      if (IsLess(left[i], right[i]))
      {
        return true;
      }
      if (IsLess(right[i], left[i]))
      {
        return false;
      }
    }
    return false;
  }

  template <typename Value>
  static bool IsLess(const Value& left, const Value& right)
  {
    return left < right || (left != left && right == right);
  }
};

/// Numbers distinct tuples, in the order of appearance.
template <typename Value>
class Labeler
{
public:
  std::int32_t operator()(const std::vector<Value>& tuple)
  {
    return this->Labels.emplace(tuple, static_cast<std::int32_t>(this->Labels.size()))
      .first->second;
  }

private:
  std::map<std::vector<Value>, std::int32_t, TupleLess> Labels;
};

struct LabelNumbers
{
  template <typename ArrayT>
  void operator()(ArrayT* array, WorkProgress& progress, std::vector<std::int32_t>& labels) const
  {
    using Value = vtk::GetAPIType<ArrayT>;
    Labeler<Value> label;
    std::vector<Value> tuple(array->GetNumberOfComponents());
    std::size_t cell = 0;
    for (const auto values : vtk::DataArrayTupleRange(array))
    {
      std::copy(values.cbegin(), values.cend(), tuple.begin());
      labels[cell++] = label(tuple);
      progress.Add();
    }
  }
};

void LabelStrings(
  vtkAbstractArray* array, WorkProgress& progress, std::vector<std::int32_t>& labels)
{
  Labeler<std::string> label;
  std::vector<std::string> tuple(array->GetNumberOfComponents());
  vtkIdType value = 0;
  for (std::int32_t& cellLabel : labels)
  {
    for (std::string& component : tuple)
    {
      component = array->GetVariantValue(value++).ToString();
    }
    cellLabel = label(tuple);
    progress.Add();
  }
}

}

std::vector<std::int32_t> LabelRegions(
  vtkPolyData* mesh, const std::string& name, const ProgressObserver& observer)
{
  vtkAbstractArray* array = mesh->GetCellData()->GetAbstractArray(name.c_str());
  if (!array)
  {
    throw InvalidOptions("RegionArray: the input has no cell array named \"" + name + "\".");
  }
  if (array->GetNumberOfTuples() != mesh->GetNumberOfCells())
  {
    throw InvalidOptions(
      "RegionArray: \"" + name + "\" must have as many tuples as the mesh has cells.");
  }
  std::vector<std::int32_t> labels(mesh->GetNumberOfCells());
  WorkProgress progress(observer, mesh->GetNumberOfCells());
  vtkDataArray* numbers = vtkArrayDownCast<vtkDataArray>(array);
  if (!numbers)
  {
    LabelStrings(array, progress, labels);
  }
  else if (!vtkArrayDispatch::Dispatch::Execute(numbers, LabelNumbers{}, progress, labels))
  {
    LabelNumbers{}(numbers, progress, labels);
  }
  return labels;
}

}
