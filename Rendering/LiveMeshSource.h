// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveMeshSource_h
#define LiveMeshSource_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

#include <functional>

namespace delaunayflip
{

/// Puts out a mesh that is asked for only when something needs it on the host: a picker, an
/// exporter, a mapper that makes its buffers. Call Modified() when there is another.
class LiveMeshSource : public vtkPolyDataAlgorithm
{
public:
  static LiveMeshSource* New();
  vtkTypeMacro(LiveMeshSource, vtkPolyDataAlgorithm);

  /// The cell array of colours, red, green, blue and alpha in bytes: all are opaque and the same.
  static constexpr const char* ColorName = "DelaunayFlipColors";

  /// Returns the mesh, or null if there is none; then the last one stays.
  std::function<vtkSmartPointer<vtkPolyData>()> GetMesh;

protected:
  LiveMeshSource();
  ~LiveMeshSource() override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkSmartPointer<vtkPolyData> Last;
};

}

#endif
