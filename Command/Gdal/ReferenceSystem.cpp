// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceSystem.h"

#include "GdalMessages.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <stdexcept>

namespace delaunayflip
{

OGRSpatialReference FindCrs(const std::string& crs)
{
  const char* const options[] = { "ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr };
  OGRSpatialReference reference;
  if (reference.SetFromUserInput(crs.c_str(), const_cast<char**>(options)) != OGRERR_NONE)
  {
    throw std::runtime_error(
      crs + " is no coordinate reference system that GDAL knows; one is, for example, EPSG:25832");
  }
  return reference;
}

std::string WriteCrs(const OGRSpatialReference& crs, const std::string& format)
{
  const std::string option = "FORMAT=" + format;
  const char* const options[] = { option.c_str(), nullptr };
  char* text = nullptr;
  std::string written;
  if (crs.exportToWkt(&text, options) == OGRERR_NONE && text)
  {
    written = text;
  }
  CPLFree(text);
  return written;
}

bool FitsGeoTiff(const OGRSpatialReference& crs)
{
  const GdalMessages messages;
  const char* const path = "/vsimem/delaunay-flip.tif";
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDatasetUniquePtr data(driver->Create(path, 1, 1, 1, GDT_Byte, nullptr));
  bool fits = data && data->SetSpatialRef(&crs) == CE_None;
  data.reset(); // which writes it
  data.reset(GDALDataset::Open(path, GDAL_OF_RASTER));
  fits = fits && data && data->GetSpatialRef() && !messages.HasErrors();
  data.reset();
  VSIUnlink(path);
  return fits;
}

std::string DescribeDifference(OGRSpatialReference one, OGRSpatialReference other)
{
  one.DemoteTo2D(nullptr);
  other.DemoteTo2D(nullptr);
  const char* const options[] = { "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
    "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr };
  if (one.IsSame(&other, options) != 0)
  {
    return "";
  }
  return std::string(one.GetName()) + " and " + other.GetName();
}

}
