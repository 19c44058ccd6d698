// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdatePipeline.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <set>
#include <string>

namespace delaunayflip
{

namespace
{

constexpr const char* NotMade = " was not made: see the errors of what makes it";

/// Describes what is wrong with the data of an input port; "" if nothing.
std::string DescribeFault(vtkAlgorithm* filter, int port, vtkInformationVector* inputs)
{
  const std::string names[] = { "input", "second input", "third input" };
  const std::string& name = names[port];
  vtkInformation* info = filter->GetInputPortInformation(port);
  const int connections = inputs->GetNumberOfInformationObjects();
  if (connections == 0)
  {
    return info->Has(vtkAlgorithm::INPUT_IS_OPTIONAL()) ? "" : "there is no " + name;
  }
  if (connections > 1)
  {
    return "the " + name + " has " + std::to_string(connections) + " connections; it takes one";
  }
  vtkDataObject* data = vtkDataObject::GetData(inputs);
  if (!data)
  {
    return "the " + name + NotMade;
  }
  std::string wanted;
  for (int i = 0; i < info->Length(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE()); ++i)
  {
    const std::string type = info->Get(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), i);
    if (data->IsA(type.c_str()))
    {
      return "";
    }
    if (!wanted.empty())
    {
      wanted += " or ";
    }
    wanted += type;
  }
  return "the " + name + " is a " + data->GetClassName() + "; it must be a " + wanted;
}

/// Adds an algorithm, if there is one, and all those upstream of it.
void AddUpstream(vtkAlgorithm* algorithm, std::set<vtkAlgorithm*>& all)
{
  const bool isNew = algorithm && all.insert(algorithm).second;
  for (int port = 0; isNew && port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
    {
      AddUpstream(algorithm->GetInputAlgorithm(port, i), all);
    }
  }
}

}

vtkStandardNewMacro(UpdatePipeline);

vtkTypeBool UpdatePipeline::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const vtkTypeBool works = this->Superclass::ProcessRequest(request, inputs, outputs);
  if (!works && this->Algorithm && this->OnRefusal)
  {
    std::string fault;
    for (int port = 0; port < this->Algorithm->GetNumberOfInputPorts() && fault.empty(); ++port)
    {
      fault = DescribeFault(this->Algorithm, port, inputs[port]);
    }
    if (fault.empty())
    {
      fault = std::string("an input") + NotMade;
    }
    this->OnRefusal(fault);
  }
  return works;
}

void UpdatePipeline::ExecuteDataEnd(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Superclass::ExecuteDataEnd(request, inputs, outputs);
  this->Algorithm->SetAbortExecute(0);
}

bool ShareUpstream(vtkAlgorithm* one, vtkAlgorithm* other)
{
  std::set<vtkAlgorithm*> first, second;
  AddUpstream(one, first);
  AddUpstream(other, second);
  return std::any_of(first.begin(), first.end(),
    [&second](vtkAlgorithm* algorithm) { return second.count(algorithm) > 0; });
}

}
