// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RASTERFILE_H
#define DELAUNAYFLIP_RASTERFILE_H

#include <cstdint>
#include <memory>
#include <string>

/// @file
/// Rasters in files: GeoTIFF (.tif), ESRI ASCII grids (.asc) and images of VTK (.vti).

namespace delaunayflip
{

/// What an ESRI ASCII grid has where there is no value.
constexpr double NoDataOfAscii = -9999.0;

/// Square cells in rows from west to east.
struct RasterGrid
{
  std::int64_t Columns = 0;
  std::int64_t Rows = 0;
  double X = 0.0; ///< The centre of the south-western cell.
  double Y = 0.0;
  double Step = 0.0; ///< The width of a cell.
};

/// A file that gets its rows one after the other, so that the raster may be larger than the memory.
/// Methods throw std::runtime_error with the reason; it does not name the file.
class RasterFile
{
public:
  virtual ~RasterFile() = default;

  /// Writes the next rows. The first row of a raster is the northern one.
  /// @param values a double per cell; NaN: there is none
  virtual void WriteRows(const double* values, std::int64_t rows) = 0;

  /// Ends the file and checks that it is complete.
  virtual void Finish() = 0;
};

/// Checks before large files are read that a raster can be written, and that GDAL knows the
/// coordinate reference system, which may be empty.
/// @returns the text of the .prj that belongs to an .asc
/// @throws CommandError (WrongUsage) with `output`.
std::string TryRaster(const std::string& output, const std::string& crs);

/// The shortest text that is read as the same double, without an exponent if it can be.
std::string TextOf(double value);

/// What a raster is called and where it is.
struct RasterName
{
  std::string Path;
  std::string Extension; ///< .tif, .asc or .vti: the format, because a temporary file has none.
  std::string Crs; ///< The coordinate reference system, which only a .tif stores; may be empty.
  std::string Array; ///< The name of the values, which only a .vti stores.
};

/// Begins a file. A .vti is kept in memory until it ends.
std::unique_ptr<RasterFile> MakeRasterFile(const RasterName& name, const RasterGrid& grid);

}

#endif
