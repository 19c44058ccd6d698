// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UpdatePipeline_h
#define UpdatePipeline_h

#include "vtkCompositeDataPipeline.h"

#include <functional>
#include <string>

class vtkAlgorithm;

namespace delaunayflip
{

/// The executive of the filters. VTK asks a filter for no update if its input is missing or wrong,
/// so this class tells the filter why.
class UpdatePipeline : public vtkCompositeDataPipeline
{
public:
  vtkTypeMacro(UpdatePipeline, vtkCompositeDataPipeline);
  static UpdatePipeline* New();

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /// Called with the reason if there is no usable input.
  std::function<void(const std::string&)> OnRefusal;

protected:
  UpdatePipeline() = default;

  /// Ends a request to abort, also one that an observer of the end has made.
  void ExecuteDataEnd(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  UpdatePipeline(const UpdatePipeline&) = delete;
  void operator=(const UpdatePipeline&) = delete;
};

/// Whether two algorithms are the same or have one upstream in common. Either may be null.
bool ShareUpstream(vtkAlgorithm* one, vtkAlgorithm* other);

}

#endif
