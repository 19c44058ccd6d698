// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFERENCESYSTEM_H
#define DELAUNAYFLIP_REFERENCESYSTEM_H

#include <ogr_spatialref.h>

#include <string>

/// @file
/// Coordinate reference systems.

namespace delaunayflip
{

/// @param crs what GDAL itself knows: a text may also name a file or an address.
/// @throws std::runtime_error for another text.
OGRSpatialReference FindCrs(const std::string& crs);

/// A system in one of the formats that GDAL calls so; empty if the format has no way to name it.
std::string WriteCrs(const OGRSpatialReference& crs, const std::string& format);

/// Whether a GeoTIFF can name a system.
bool FitsGeoTiff(const OGRSpatialReference& crs);

/// The names of two systems if their x and y differ; else "".
std::string DescribeDifference(OGRSpatialReference one, OGRSpatialReference other);

}

#endif
