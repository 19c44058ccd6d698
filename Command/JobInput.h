// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_JOBINPUT_H
#define DELAUNAYFLIP_JOBINPUT_H

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <string>

class vtkPolyData;

namespace delaunayflip
{

struct Arguments;
class JobMessages;
class ProgressBar;

/// What the files of a run contain.
struct JobInput
{
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkSmartPointer<vtkPolyData> Segments; ///< Those of constraints and rings; or null.
  vtkSmartPointer<vtkPolyData> Places; ///< Where heights are wanted; or null.
  bool PlacesAreAngles = false; ///< They are longitudes and latitudes, but the points are not.
  std::string Crs; ///< The coordinate reference system that the mesh's file names.
  vtkIdType OutlineRings = 0; ///< How many of the rings come first.
};

/// Reads all files that the arguments name, repairs the mesh as they say, and tells what is odd.
/// @throws CommandError if a file cannot be read.
JobInput ReadInput(const Arguments& arguments, ProgressBar& bar, JobMessages& messages);

}

#endif
