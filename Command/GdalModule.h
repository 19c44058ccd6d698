// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GDALMODULE_H
#define DELAUNAYFLIP_GDALMODULE_H

#include "MeshFiles.h"

#include <memory>
#include <string>

/// @file
/// What GDAL does for the command. It is in a library of its own, libdelaunayflip-gdal.so, which is
/// loaded when a file needs it: GDAL brings sixty libraries, which take longer to load than a small
/// mesh takes to flip, and the command also runs where GDAL is not installed.

namespace delaunayflip
{

struct RasterGrid;
class RasterFile;

/// What to read from a file of points, lines and polygons.
struct VectorRequest
{
  std::string Path;
  std::string Driver; ///< GDAL's name of the format.
  std::string Layer; ///< Empty: the only one; *: all.
  std::string Height; ///< The attribute that is z; empty: z of the geometries.
  bool HasData = true; ///< Whether numeric attributes of points are wanted.
  bool AreFlat = false; ///< Whether z does not matter.
};

/// Methods throw std::runtime_error with GDAL's messages; the text does not name the file.
class GdalModule
{
public:
  virtual ~GdalModule() = default;

  /// Points, lines, and each ring of polygons as a polygon. If there are points alone, their
  /// numeric attributes become point data, joined by their names if there are several layers.
  virtual FileMesh ReadVectors(const VectorRequest& request) const = 0;

  /// A coordinate reference system as the .prj beside an ESRI ASCII grid has it.
  /// @param crs such as EPSG:25832, or any other text that GDAL knows
  /// @param isForGeoTiff whether a GeoTIFF must have a way to name it; else a .prj
  virtual std::string DescribeCrs(const std::string& crs, bool isForGeoTiff) const = 0;

  /// The names of two coordinate reference systems if their x and y differ; else "".
  virtual std::string DescribeDifference(
    const std::string& one, const std::string& other) const = 0;

  /// A GeoTIFF of doubles.
  /// @param crs may be empty
  virtual std::unique_ptr<RasterFile> MakeGeoTiff(
    const std::string& path, const RasterGrid& grid, const std::string& crs) const = 0;
};

/// @throws std::runtime_error that says what to install.
const GdalModule& LoadGdal();

/// The coordinate reference system that all files should have: that of the first one that names it.
class SharedCrs
{
public:
  /// @param crs FileMesh::Crs of a file, or a name that GDAL knows.
  /// @param path the file, or the option that has the name.
  /// @returns the text of a warning about another system, or "".
  std::string Compare(const std::string& crs, const std::string& path);

private:
  std::string Crs, File;
};

}

#endif
