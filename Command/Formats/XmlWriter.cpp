// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "XmlWriter.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

namespace
{

class SafeXmlWriter : public vtkXMLPolyDataWriter
{
public:
  static SafeXmlWriter* New();
  vtkTypeMacro(SafeXmlWriter, vtkXMLPolyDataWriter);

protected:
  SafeXmlWriter()
  {
    this->NumberOfPointsPositions = nullptr;
    this->NumberOfVertsPositions = nullptr;
    this->NumberOfLinesPositions = nullptr;
    this->NumberOfStripsPositions = nullptr;
    this->NumberOfPolysPositions = nullptr;
  }
};

vtkStandardNewMacro(SafeXmlWriter);

double Finite(double value)
{
  constexpr double most = 1e308; // the largest double, rounded as VTK writes it, would be infinite
  return std::isnan(value) ? 0.0 : std::clamp(value, -most, most);
}

/// VTK writes the range of the vectors' lengths with an array, and cannot read an infinite one. The
/// squares of coordinates above 1e154 are infinite.
void LimitRange(vtkDataArray* array)
{
  double range[2];
  array->GetRange(range, -1);
  if (array->GetNumberOfComponents() > 1 && !(std::isfinite(range[0]) && std::isfinite(range[1])))
  {
    range[0] = Finite(range[0]);
    range[1] = Finite(range[1]);
    array->GetInformation()->Set(vtkDataArray::L2_NORM_RANGE(), range, 2);
  }
}

void LimitRanges(vtkFieldData* data)
{
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    if (vtkDataArray* const array = data->GetArray(index))
    {
      LimitRange(array);
    }
  }
}

void RemoveOddIds(vtkDataSetAttributes* data)
{
  for (const int kind : { vtkDataSetAttributes::PEDIGREEIDS, vtkDataSetAttributes::GLOBALIDS })
  {
    vtkAbstractArray* const ids = data->GetAbstractAttribute(kind);
    if (ids && !CanBeXmlIds(ids))
    {
      data->SetActiveAttribute(-1, kind);
    }
  }
}

}

bool CanBeXmlIds(vtkAbstractArray* array)
{
  switch (array->GetDataType())
  {
    case VTK_INT:
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
      return true;
    default:
      return false;
  }
}

vtkSmartPointer<vtkXMLPolyDataWriter> MakeXmlWriter()
{
  return vtkSmartPointer<SafeXmlWriter>::New();
}

void SetXmlInput(vtkXMLPolyDataWriter* writer, vtkPolyData* mesh)
{
  const vtkNew<vtkPolyData> storable;
  storable->ShallowCopy(mesh);
  RemoveOddIds(storable->GetPointData());
  RemoveOddIds(storable->GetCellData());
  LimitRange(storable->GetPoints()->GetData());
  LimitRanges(storable->GetPointData());
  LimitRanges(storable->GetCellData());
  LimitRanges(storable->GetFieldData());
  writer->SetInputData(storable);
}

}
