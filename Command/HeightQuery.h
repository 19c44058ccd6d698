// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HEIGHTQUERY_H
#define DELAUNAYFLIP_HEIGHTQUERY_H

#include <vtkDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkDelaunayFlipInterpolator;

/// @file
/// Heights, or other values, where a user wants them: on a raster, or at the points of a file.

namespace delaunayflip
{

/// What the options ask for.
struct HeightOptions
{
  double Step = 0.0; ///< The width of a raster's cells; 0: no raster.
  std::string Extent; ///< xmin,ymin,xmax,ymax; empty: that of the points.
  std::string Places; ///< A file with points for places, instead of a raster.
  std::string Array; ///< A point array; empty: z.
  std::string Output; ///< The file that is written.
  std::string Crs; ///< That of the raster; empty: that of the input, if its file names one.
  bool AreAngles = false; ///< Points are longitudes and latitudes.
  bool AreDirections = false; ///< Points are x, y and z on a sphere.
  bool PlacesAreAngles = false; ///< Places are longitudes and latitudes, though points are not.

  bool AreWanted() const { return this->Step > 0.0 || !this->Places.empty(); }
};

/// The four numbers of an extent.
/// @returns what is wrong with the text; empty: nothing.
std::string ParseExtent(const std::string& text, std::array<double, 4>& extent);

/// Where values are wanted, in blocks, and the file that they go to.
class HeightQuery
{
public:
  virtual ~HeightQuery() = default;

  /// @param points give a raster its extent.
  /// @param places those of the file, or null for a raster
  /// @throws CommandError (WrongUsage) for a raster of no cells, or of too many.
  static std::unique_ptr<HeightQuery> Make(
    const HeightOptions& options, vtkPolyData* points, vtkPolyData* places);

  /// Gives a filter its inputs, the first block of places and the points with their values.
  void Begin(vtkDelaunayFlipInterpolator* filter, vtkPolyData* points);

  /// Writes all blocks, the first of which the filter has answered.
  /// @param show is told the share that is done, 0 .. 1.
  /// @throws std::runtime_error with the reason; it does not name the file.
  void Write(const std::string& path, const std::function<void(double)>& show);

  /// A line of the summary.
  std::string Describe() const;

  std::int64_t CountPlaces() const { return this->Total; }

  /// Those in no triangle.
  std::int64_t CountOutside() const { return this->Outside; }

  /// What users may not expect of the values that were written.
  /// @param isAscii whether to an .asc.
  std::vector<std::string> ListWarnings(bool isAscii) const;

protected:
  HeightQuery(const HeightOptions& options, const std::string& title, const std::string& noun);

  /// The places of the next block; null if there is none.
  virtual vtkSmartPointer<vtkDataSet> NextBlock() = 0;

  /// The share of the blocks that were taken, 0 .. 1.
  virtual double GetShare() const = 0;

  virtual void Open(const std::string& path) = 0;
  virtual void WriteValues(const double* values, vtkDataSet* block) = 0;

  /// Ends the file, and checks that it is complete.
  virtual void Finish() = 0;

  std::string Array; ///< The name of the values.

private:
  void WriteBlock(vtkDataSet* block);

  bool IsOfHeights; ///< The values are z.
  std::string Title, Noun;
  vtkDelaunayFlipInterpolator* Filter = nullptr;
  std::int64_t Total = 0; ///< Places.
  std::int64_t Outside = 0;
  std::int64_t WithoutValue = 0; ///< In triangles with points that have none.
  std::int64_t LikeNoData = 0; ///< NoDataOfAscii.
  std::int64_t Infinite = 0;
  bool HasOthers = false; ///< Whether some value is not 0.
};

/// The points with the lines and the only array that is interpolated; none for z.
/// @throws CommandError (BadFile) with `path` if it has no such array of one component.
vtkSmartPointer<vtkPolyData> SelectArray(
  vtkPolyData* points, const std::string& array, const std::string& path);

}

#endif
