// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ARGUMENTS_H
#define DELAUNAYFLIP_ARGUMENTS_H

#include "MeshFiles.h"
#include "PointTriangulation.h"

#include <optional>
#include <string>

/// @file
/// The command line.

namespace delaunayflip
{

struct Arguments
{
  std::string Input;
  std::string Output;
  MeshFormat OutputFormat = MeshFormat::VTK;
  PointOptions Flip;
  bool DeviationIsPercent = false; ///< Flip.MaximumDeviation is one of the bounding box's diagonal.
  bool MergePoints = false; ///< Of the input, at equal places.
  bool FromPoints = false;
  bool InBestPlane = false; ///< Of points: else in x and y.
  std::string Outline; ///< Of points: a file; empty: none.
  std::string Holes;
  bool IgnoreLines = false;
  bool InsertLines = false;
  std::string Constraints; ///< File; empty: none.
  bool InsertConstraints = true;
  std::string RegionArray; ///< Empty: none.
  std::string Devices; ///< GPUs that share the mesh; empty: Flip.Device.
  bool Quality = false; ///< Cell arrays of angles.
  std::string Statistics; ///< CSV file; empty: none.
  std::string Report; ///< JSON file; empty: none.
  bool Quiet = false;
};

/// Reads the command line into `arguments`. Prints help or the version if asked for, else errors.
/// @returns the exit code if there is nothing left to do, else nothing.
std::optional<int> ParseArguments(int argc, char** argv, Arguments& arguments);

}

#endif
