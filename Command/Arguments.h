// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ARGUMENTS_H
#define DELAUNAYFLIP_ARGUMENTS_H

#include "HeightQuery.h"
#include "MeshFiles.h"

#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipInterpolator.h>
#include <vtkDelaunayFlipPoints.h>
#include <vtkNew.h>

#include <optional>
#include <string>
#include <vector>

/// @file
/// The command line.

namespace delaunayflip
{

struct Arguments
{
  std::string Input;
  std::string Output;
  MeshFormat OutputFormat = MeshFormat::VTK;
  vtkNew<vtkDelaunayFlip> Flip; ///< Its properties are options.
  vtkNew<vtkDelaunayFlipPoints> Points; ///< Has the options for FromPoints.
  vtkNew<vtkDelaunayFlipInterpolator> Interpolator; ///< Has them, too, for Heights.
  HeightOptions Heights;
  bool DeviationIsPercent = false; ///< The largest deviation is one of the bounding box's diagonal.
  bool MergePoints = false; ///< Joins points of the input at equal places.
  bool DropDuplicates = false; ///< Polygons of the input with the corners of earlier ones.
  bool Orient = false; ///< Winds polygons of the input as those beside them.
  bool FromPoints = false;
  std::string Columns; ///< Those of x, y and z in a file of points; empty: not named.
  std::string Outline; ///< File, for FromPoints; empty: none.
  std::string Holes;
  std::string Constraints; ///< File; empty: none.

  /// The files to read beside the input; some are empty.
  std::vector<std::string> ListOthers() const
  {
    return { this->Constraints, this->Outline, this->Holes, this->Heights.Places };
  }

  std::string Statistics; ///< CSV file; empty: none.
  std::string Report; ///< JSON file; empty: none.
  std::string ProjectionFile; ///< Beside an .asc with a coordinate reference system; empty: none.
  bool Quiet = false;
};

/// Reads the command line into `arguments`. Prints help or the version if asked for, else errors.
/// @returns the exit code if there is nothing left to do, else nothing.
std::optional<int> ParseArguments(int argc, char** argv, Arguments& arguments);

}

#endif
