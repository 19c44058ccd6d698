// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdateReport.h"

#include "DataArrays.h"
#include "FlipError.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <new>
#include <type_traits>
#include <utility>

namespace delaunayflip
{
namespace
{

/// Joins the first items, and says how many more there are. There must be at least one.
std::string Join(const std::vector<std::string>& items, const char* separator)
{
  constexpr std::size_t Most = 3; // places named per text, and texts
  std::string text = items.front();
  for (std::size_t i = 1; i < std::min(items.size(), Most); ++i)
  {
    text += separator + items[i];
  }
  if (items.size() > Most)
  {
    text += separator + ("and " + std::to_string(items.size() - Most)) + " more";
  }
  return text;
}

/// The ring that the exception that is being handled names; -1: none.
std::int64_t FindFailedRing()
{
  try
  {
    throw;
  }
  catch (const InvalidMesh& error)
  {
    return error.Ring;
  }
  catch (...)
  {
    return -1;
  }
}

/// The kind and the text of the exception that is being handled.
std::pair<FailureKind, std::string> DescribeException()
{
  try
  {
    throw;
  }
  catch (const InvalidOptions& error)
  {
    return { FailureKind::Options, error.what() };
  }
  catch (const BackendUnavailable& error)
  {
    return { FailureKind::Backend, error.what() };
  }
  catch (const FlipError& error)
  {
    return { FailureKind::Mesh, error.what() };
  }
  catch (const std::bad_alloc&)
  {
    return { FailureKind::Other, "not enough memory" };
  }
  catch (const std::exception& error)
  {
    return { FailureKind::Other, error.what() };
  }
  catch (...)
  {
    return { FailureKind::Other, "an exception of unknown type" };
  }
}

}

std::string Describe(const std::vector<Note>& notes)
{
  if (notes.empty())
  {
    return "";
  }
  std::vector<std::string> texts;
  std::vector<std::vector<std::string>> places;
  for (const Note& note : notes)
  {
    const std::size_t known = std::find(texts.begin(), texts.end(), note.Text) - texts.begin();
    if (known == texts.size())
    {
      texts.push_back(note.Text);
      places.emplace_back();
    }
    places[known].push_back(note.Where);
  }
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    const std::string where = Join(places[i], ", ");
    if (!where.empty())
    {
      texts[i] = where + ": " + texts[i];
    }
  }
  return Join(texts, "; ");
}

void UpdateSummary::AddFailure(const std::string& where)
{
  const auto [kind, text] = DescribeException();
  if (this->Failure == FailureKind::None)
  {
    this->Failure = kind;
    this->FailedRing = FindFailedRing();
  }
  this->Errors.push_back({ where, text });
}

std::string DescribeTrouble(const FlipReport& report, bool hasAskedForLimit, bool hasTolerance)
{
  std::string text = DescribeDefects(report.Defects);
  const auto add = [&text](const std::string& more)
  {
    if (!text.empty())
    {
      text += "; ";
    }
    text += more;
  };
  if (report.StopReason == StopReasonKind::IterationLimit && !hasAskedForLimit)
  {
    add("stopped by the safety limit of " + std::to_string(report.Iterations.size()) +
      " iterations with " + std::to_string(report.NonDelaunayAfter) +
      " edges left that are not Delaunay");
  }
  if (hasTolerance && report.Tolerance == "none")
  {
    add("Tolerance has no effect on the in-circle criterion, which is exact; it is for opposite "
        "angles");
  }
  if (!report.Fallback.empty())
  {
    add("the GPU could not be used, the CPU did the work: " + report.Fallback);
  }
  return text;
}

Defect FindShortArrays(
  vtkDataSetAttributes* data, vtkIdType tuples, const std::string& kind, const std::string& fate)
{
  std::vector<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < tuples)
    {
      names.push_back('"' + GetName(array) + '"');
    }
  }
  if (names.empty())
  {
    return {};
  }
  const std::string arrays = names.size() == 1 ? " array" : " arrays";
  return { kind + arrays + fate + ": " + Join(names, ", "),
    static_cast<std::int64_t>(names.size()) };
}

std::vector<Defect> ListMalformedArrays(vtkPolyData* mesh, bool pointsPass, bool cellsPass)
{
  std::vector<Defect> defects;
  const auto addShort = [&](
                          const char* kind, vtkDataSetAttributes* data, vtkIdType tuples, bool pass)
  {
    const std::string fate = pass ? "passed unchanged" : "left out";
    AddDefect(FindShortArrays(data, tuples, kind, " with too few tuples " + fate), defects);
  };
  addShort("point", mesh->GetPointData(), mesh->GetNumberOfPoints(), pointsPass);
  addShort("cell", mesh->GetCellData(), mesh->GetNumberOfCells(), cellsPass);
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkAbstractArray* ghosts = mesh->GetCellData()->GetAbstractArray(name);
  if (ghosts && IsWrongGhostArray(ghosts))
  {
    const std::string fault = ghosts->GetDataType() != VTK_UNSIGNED_CHAR
      ? "ghost array that is not of type unsigned char ignored"
      : "ghost array with several components ignored";
    defects.emplace_back(fault + ": \"" + name + '"', 1);
  }
  return defects;
}

//------------------------------------------------------------------------------
void AddIterationColumns(const FlipReport& report, const std::string& prefix, vtkFieldData* data)
{
  const auto add = [&](auto* array, const char* name, auto find)
  {
    array->SetName((prefix + name).c_str());
    for (const IterationRecord& record : report.Iterations)
    {
      array->InsertNextValue(std::invoke(find, record));
    }
    if (prefix.empty() || !report.Iterations.empty())
    {
      data->AddArray(array); // VTK 9.7 cannot read empty arrays of ids in field data of a .vtk
    }
  };
  const auto addCount = [&](const char* name, std::int64_t IterationRecord::*member)
  { add(vtkNew<vtkIdTypeArray>().Get(), name, member); };
  addCount("Iteration", &IterationRecord::Iteration);
  addCount("Tested", &IterationRecord::Tested);
  addCount("NonDelaunay", &IterationRecord::NonDelaunay);
  addCount("Flipped", &IterationRecord::Flipped);
  addCount("Excluded", &IterationRecord::Excluded);
  addCount("Blocked", &IterationRecord::Blocked);
  // VTK 9.1 cannot read NaN in a .vtk of text.
  const auto findAngle = [](const IterationRecord& record)
  { return std::isnan(record.MinimumAngle) ? -1.0 : record.MinimumAngle; };
  add(vtkNew<vtkDoubleArray>().Get(), "MinimumAngle", findAngle);
  add(vtkNew<vtkDoubleArray>().Get(), "Seconds", &IterationRecord::Seconds);
}

namespace
{

const std::string Prefix = "DelaunayFlip:";

template <typename ArrayT, typename Value>
void AddValue(const char* name, const Value& value, vtkFieldData* data)
{
  vtkNew<ArrayT> array;
  array->SetName((Prefix + name).c_str());
  array->InsertNextValue(value);
  data->AddArray(array);
}

}

void DropResults(vtkFieldData* data)
{
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const std::string name = GetName(data->GetAbstractArray(i));
    if (name.rfind(Prefix, 0) == 0 || name == "vtkDelaunayFlipCount" ||
      name == "Smallest angle before (degrees)" || name == "Smallest angle after (degrees)")
    {
      data->RemoveArray(i);
    }
  }
}

void AddCount(const char* name, std::int64_t count, vtkFieldData* data)
{
  AddValue<vtkIdTypeArray>(name, count, data);
}

namespace
{

/// Adds an array for each number of a kind.
void AddNumbers(const FlipReport& report, NumberKind wanted, vtkFieldData* data)
{
  const auto add = [&](const char* name, NumberKind kind, auto number)
  {
    using Array = std::conditional_t<std::is_floating_point<decltype(number)>::value,
      vtkDoubleArray, vtkIdTypeArray>;
    if (kind == wanted)
    {
      AddValue<Array>(ToCamelCase(name).c_str(), number, data);
    }
  };
  ForEachNumber(add, report);
}

}

void AddFieldData(const FlipReport& report, vtkFieldData* data)
{
  const auto addText = [&](const char* name, const std::string& text)
  { AddValue<vtkStringArray>(name, text, data); };
  // The totals first: ParaView lists no field data when the first array is empty.
  AddValue<vtkIntArray>("Converged", static_cast<int>(report.Converged()), data);
  addText("StopReason", ToString(report.StopReason));
  addText("Summary", Summarize(report));
  AddNumbers(report, NumberKind::Main, data);
  addText("GeometryUsed", ToString(report.GeometryUsed));
  addText("GeometryReason", report.GeometryReason);
  addText("Tolerance", report.Tolerance);
  addText("Backend", report.Backend);
  AddIterationColumns(report, Prefix, data);
#if defined(DELAUNAYFLIP_PARAVIEW)
  // ParaView's lists of arrays, such as Color By, leave out arrays with this key.
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (GetName(array).rfind(Prefix, 0) == 0)
    {
      array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
    }
  }
#endif
}

void AddPointFieldData(const FlipReport& report, vtkFieldData* data)
{
  AddNumbers(report, NumberKind::Points, data);
}

UpdatePlan::UpdatePlan(const std::array<bool, NumberOfParts>& has, ProgressObserver observer)
  : Observer(std::move(observer))
{
  // Each part's time in units of the engine's, measured once on one thread.
  constexpr double Durations[] = { 0.4, 0.2, 0.3, 0.3, 0.9, 1.0, 0.05, 0.4 };
  double sum = 0.0;
  for (int part = 0; part < NumberOfParts; ++part)
  {
    if (has[part])
    {
      sum += Durations[part];
    }
    this->Ends[part + 1] = sum;
  }
}

}
