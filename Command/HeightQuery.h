// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HEIGHTQUERY_H
#define DELAUNAYFLIP_HEIGHTQUERY_H

#include <vtkDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

/// @file
/// Heights, or other values, where a user wants them: on a raster, or at the points of a file.

namespace delaunayflip
{

/// What the options ask for.
struct HeightOptions
{
  double Step = 0.0; ///< The width of a raster's cells; 0: no raster.
  std::string Extent; ///< xmin,ymin,xmax,ymax; empty: that of the points.
  std::string Places; ///< A file whose points are the places, instead of a raster.
  std::string Array; ///< A point array; empty: z.
  std::string Crs; ///< Of the raster; empty: that of the input, if its file names one.

  bool AreWanted() const { return this->Step > 0.0 || !this->Places.empty(); }
};

/// The four numbers of an extent.
/// @returns what is wrong with the text; empty: nothing.
std::string ParseExtent(const std::string& text, std::array<double, 4>& extent);

/// Where values are wanted, in blocks, and the file that they go to.
/// Methods throw std::runtime_error with the reason; it does not name the file.
class HeightQuery
{
public:
  virtual ~HeightQuery() = default;

  /// The places of the next block; null if there is none.
  virtual vtkSmartPointer<vtkDataSet> NextBlock() = 0;

  /// The share of the blocks that were taken, 0 .. 1.
  virtual double GetShare() const = 0;

  /// Begins the file.
  virtual void Begin(const std::string& path) = 0;

  /// Writes the values at the places of a block.
  void Write(vtkDataSet* block);

  /// Ends the file, and checks that it is complete.
  virtual void Finish() = 0;

  /// A line of the summary.
  std::string Describe() const;

  bool HasOnlyOutside() const { return this->Outside == this->Total; }

protected:
  HeightQuery(const std::string& array, const std::string& title, const std::string& noun);
  virtual void WriteValues(const double* values, vtkDataSet* block) = 0;

  std::string Array; ///< The name of the values.

private:
  std::string Title, Noun;
  std::int64_t Total = 0; ///< Places.
  std::int64_t Outside = 0; ///< Those in no triangle.
};

/// @param points give a raster its extent.
/// @param places those of the file, or null for a raster
/// @param extension of the output
/// @param array the name of the values
/// @throws CommandError (WrongUsage) for a raster of no cells, or of too many.
std::unique_ptr<HeightQuery> MakeHeightQuery(const HeightOptions& options, vtkPolyData* points,
  vtkPolyData* places, const std::string& extension, const std::string& array);

/// The points with the lines and the only array that is interpolated; none for z.
/// @throws CommandError (BadFile) with `path` if it has no such array of one component.
vtkSmartPointer<vtkPolyData> SelectArray(
  vtkPolyData* points, const std::string& array, const std::string& path);

}

#endif
