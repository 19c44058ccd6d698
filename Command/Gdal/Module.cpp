// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CommandError.h"
#include "GdalMessages.h"
#include "GdalModule.h"
#include "RasterFile.h"
#include "ReferenceSystem.h"
#include "VectorReader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

/// @file
/// GeoTIFF by GDAL, and the one function of this library.

namespace delaunayflip
{

namespace
{

class GeoTiff : public RasterFile
{
public:
  GeoTiff(const std::string& path, const RasterGrid& grid, const std::string& crs)
    : Columns(grid.Columns),
      Path(path)
  {
    if (std::max(grid.Columns, grid.Rows) > std::numeric_limits<int>::max())
    {
      throw std::runtime_error("a .tif has fewer than 2^31 columns and rows");
    }
    // Deflate after the differences of floating-point numbers loses nothing.
    const char* const options[] = { "TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3",
      "BIGTIFF=IF_SAFER", nullptr };
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    this->Data.reset(driver->Create(path.c_str(), static_cast<int>(grid.Columns),
      static_cast<int>(grid.Rows), 1, GDT_Float64, const_cast<char**>(options)));
    this->Messages.Check();
    std::array<double, 6> corner = { grid.X - grid.Step / 2, grid.Step, 0.0,
      grid.Y + (static_cast<double>(grid.Rows) - 0.5) * grid.Step, 0.0, -grid.Step };
    GDALSetGeoTransform(GDALDataset::ToHandle(this->Data.get()), corner.data());
    this->Data->GetRasterBand(1)->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
    if (!crs.empty())
    {
      const OGRSpatialReference reference = FindCrs(crs);
      this->Data->SetSpatialRef(&reference);
    }
    this->Messages.Check();
  }

  void WriteRows(const double* values, std::int64_t rows) override
  {
    const int columns = static_cast<int>(this->Columns);
    const int count = static_cast<int>(rows);
    const CPLErr result = this->Data->GetRasterBand(1)->RasterIO(GF_Write, 0, this->Done, columns,
      count, const_cast<double*>(values), columns, count, GDT_Float64, 0, 0, nullptr);
    this->Done += count;
    if (result != CE_None)
    {
      this->Messages.Fail();
    }
  }

  void Finish() override
  {
    this->Data.reset();
    const GDALDatasetUniquePtr written(GDALDataset::Open(this->Path.c_str(), GDAL_OF_RASTER));
    this->Messages.Check();
  }

private:
  GdalMessages Messages; // outlives the data, which GDAL writes to the end
  std::int64_t Columns;
  std::string Path;
  int Done = 0; ///< Rows.
  GDALDatasetUniquePtr Data;
};

class Module : public GdalModule
{
public:
  FileMesh ReadVectors(const VectorRequest& request) const override
  {
    return delaunayflip::ReadVectors(request);
  }

  std::string DescribeCrs(const std::string& crs, bool isForGeoTiff) const override
  {
    const GdalMessages messages;
    const OGRSpatialReference reference = FindCrs(crs);
    const std::string text = WriteCrs(reference, "WKT1_ESRI");
    const bool fits = isForGeoTiff ? FitsGeoTiff(reference) : !text.empty();
    if (!fits)
    {
      throw std::runtime_error("its format has no way to name " + crs +
        "; choose another coordinate reference system, or write the raster without --crs");
    }
    return text;
  }

  std::string DescribeDifference(const std::string& one, const std::string& other) const override
  {
    const GdalMessages messages;
    return delaunayflip::DescribeDifference(FindCrs(one), FindCrs(other));
  }

  std::unique_ptr<RasterFile> MakeGeoTiff(
    const std::string& path, const RasterGrid& grid, const std::string& crs) const override
  {
    return std::make_unique<GeoTiff>(path, grid, crs);
  }
};

}

}

extern "C" __attribute__((visibility("default"))) const delaunayflip::GdalModule*
GetDelaunayFlipGdalModule()
{
  static const delaunayflip::Module module;
  return &module;
}
