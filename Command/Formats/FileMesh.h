// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILEMESH_H
#define DELAUNAYFLIP_FILEMESH_H

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace delaunayflip
{

/// A surface mesh that was read from a file, or is to be written to one.
struct FileMesh
{
  vtkSmartPointer<vtkPolyData> Mesh = vtkSmartPointer<vtkPolyData>::New();
  std::vector<std::string> Notes; ///< What reading changed or left out, one line each.
  std::vector<std::string> Warnings; ///< What may be wrong with the file.
  /// The originals of the last points, which were repeated along seams of the texture.
  std::vector<vtkIdType> CopiesOf;

  vtkIdType GetNumberOfOriginals() const
  {
    return this->Mesh->GetNumberOfPoints() - static_cast<vtkIdType>(this->CopiesOf.size());
  }

  vtkIdType OriginalOf(vtkIdType point) const
  {
    const vtkIdType originals = this->GetNumberOfOriginals();
    return point < originals ? point : this->CopiesOf[point - originals];
  }
};

/// What a reader does with points that a format repeats.
enum class RepeatedPoints
{
  Keep,
  Merge
};

}

#endif
