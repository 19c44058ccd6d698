// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RasterFile.h"

#include "CommandError.h"
#include "Console.h"
#include "GdalModule.h"

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace delaunayflip
{

namespace
{

class AsciiGrid : public RasterFile
{
public:
  AsciiGrid(const std::string& path, const RasterGrid& grid)
    : Columns(grid.Columns),
      File(path, std::ios::binary)
  {
    this->File << "ncols " << grid.Columns << "\nnrows " << grid.Rows << "\nxllcenter "
               << TextOf(grid.X) << "\nyllcenter " << TextOf(grid.Y) << "\ncellsize "
               << TextOf(grid.Step) << "\nNODATA_value " << NoData << '\n';
  }

  void WriteRows(const double* values, std::int64_t rows) override
  {
    for (std::int64_t row = 0; row < rows; ++row)
    {
      std::string line;
      for (std::int64_t column = 0; column < this->Columns; ++column)
      {
        const double value = values[row * this->Columns + column];
        line += std::isfinite(value) ? TextOf(value) : NoData;
        line += ' ';
      }
      line.back() = '\n';
      this->File << line;
    }
    this->Check();
  }

  void Finish() override
  {
    this->File.close();
    this->Check();
  }

private:
  const std::string NoData = TextOf(NoDataOfAscii);

  void Check() const
  {
    if (!this->File)
    {
      throw std::runtime_error("the system refuses to write");
    }
  }

  std::int64_t Columns;
  std::ofstream File;
};

class VtkImage : public RasterFile
{
public:
  VtkImage(const RasterName& name, const RasterGrid& grid)
    : Path(name.Path),
      Left(grid.Rows),
      Columns(grid.Columns)
  {
    if (std::max(grid.Columns, grid.Rows) > std::numeric_limits<int>::max())
    {
      throw std::runtime_error("a .vti has fewer than 2^31 columns and rows; a .tif can have more");
    }
    this->Image->SetDimensions(static_cast<int>(grid.Columns), static_cast<int>(grid.Rows), 1);
    this->Image->SetOrigin(grid.X, grid.Y, 0.0);
    this->Image->SetSpacing(grid.Step, grid.Step, 1.0);
    this->Values->SetName(name.Array.c_str());
    this->Values->SetNumberOfValues(grid.Columns * grid.Rows);
    this->Image->GetPointData()->SetScalars(this->Values);
  }

  /// In an image, the first row is the southern one.
  void WriteRows(const double* values, std::int64_t rows) override
  {
    for (std::int64_t row = 0; row < rows; ++row)
    {
      --this->Left;
      std::copy_n(values + row * this->Columns, this->Columns,
        this->Values->GetPointer(this->Left * this->Columns));
    }
  }

  void Finish() override
  {
    const vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(this->Path.c_str());
    writer->SetInputData(this->Image);
    writer->SetDataModeToBinary(); // VTK before 9.3 cannot read appended data with a newer expat
    writer->SetHeaderTypeToUInt64();
    writer->SetCompressorTypeToLZ4();
    const bool isWritten = writer->Write() == 1;
    const vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(this->Path.c_str());
    reader->UpdateInformation(); // to the last tag of the file
    const std::string problems = TakeVTKProblems();
    if (!isWritten || !problems.empty())
    {
      throw std::runtime_error("the file is incomplete when read back");
    }
  }

private:
  std::string Path;
  std::int64_t Left; ///< How many rows are still to come.
  std::int64_t Columns;
  vtkNew<vtkImageData> Image;
  vtkNew<vtkDoubleArray> Values;
};

}

std::string TryRaster(const std::string& output, const std::string& crs)
{
  const bool isGeoTiff = ExtensionOf(output) == ".tif";
  const bool needsGdal = !crs.empty() || isGeoTiff;
  if (!needsGdal)
  {
    return "";
  }
  try
  {
    const GdalModule& gdal = LoadGdal();
    return crs.empty() ? "" : gdal.DescribeCrs(crs, isGeoTiff);
  }
  catch (const std::runtime_error& error)
  {
    throw CommandError(ExitCode::WrongUsage, output + ": " + error.what());
  }
}

std::string TextOf(double value)
{
  std::array<char, 64> text{};
  const double size = std::abs(value);
  const bool isPlain = value == 0.0 || (size > 1e-5 && size < 1e16);
  const auto format = isPlain ? std::chars_format::fixed : std::chars_format::general;
  return { text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format).ptr };
}

std::unique_ptr<RasterFile> MakeRasterFile(const RasterName& name, const RasterGrid& grid)
{
  if (name.Extension == ".asc")
  {
    return std::make_unique<AsciiGrid>(name.Path, grid);
  }
  if (name.Extension == ".vti")
  {
    return std::make_unique<VtkImage>(name, grid);
  }
  return LoadGdal().MakeGeoTiff(name.Path, grid, name.Crs);
}

}
