// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HeightQuery.h"

#include "CommandError.h"
#include "Console.h"
#include "InputFile.h"
#include "MeshFiles.h"
#include "OutputFiles.h"
#include "PointTriangulation.h"
#include "RasterFile.h"

#include <vtkBoundingBox.h>
#include <vtkDataArray.h>
#include <vtkDelaunayFlipInterpolator.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

/// The array of the interpolator's output that says which places are inside.
constexpr const char* MaskArray = "vtkValidPointMask";

/// A number with commas, as in 12,345.
std::string Grouped(std::int64_t number)
{
  std::string text = std::to_string(number);
  for (std::size_t place = text.size(); place > 3; place -= 3)
  {
    text.insert(place - 3, ",");
  }
  return text;
}

/// If longitudes are on both sides of 180 degrees and none is near 0, 360 degrees are added to
/// those in the west. Points around the whole globe keep theirs: any gap between them could be the
/// border.
/// @param west the least longitude. @param east the greatest one.
void JoinAcross180(std::vector<double> longitudes, double& west, double& east)
{
  constexpr double Turn = 360.0, Far = 90.0;
  if (east - west > Turn)
  {
    return;
  }
  std::sort(longitudes.begin(), longitudes.end());
  double widest = std::max(Far, Turn - (east - west)); // the gap behind the last one
  for (std::size_t i = 1; i < longitudes.size(); ++i)
  {
    const double gap = longitudes[i] - longitudes[i - 1];
    if (gap > widest)
    {
      widest = gap;
      west = longitudes[i];
      east = longitudes[i - 1] + Turn;
    }
  }
}

/// The box of the points that are finite in x and y, widened to whole multiples of the step.
/// @param areAngles whether x is a longitude.
std::array<double, 4> FindExtent(vtkPolyData* points, bool areAngles, double step)
{
  vtkBoundingBox box;
  std::vector<double> longitudes;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> point;
    points->GetPoint(i, point.data());
    if (std::isfinite(point[0]) && std::isfinite(point[1]))
    {
      box.AddPoint(point[0], point[1], 0.0);
      longitudes.push_back(point[0]);
    }
  }
  if (!box.IsValid())
  {
    throw CommandError(ExitCode::BadFile, "--raster: no point is finite, so the extent is unknown");
  }
  double west = box.GetBound(0), east = box.GetBound(1);
  if (areAngles)
  {
    JoinAcross180(std::move(longitudes), west, east);
  }
  const auto below = [step](double value) { return std::floor(value / step) * step; };
  const auto above = [step](double value) { return std::ceil(value / step) * step; };
  return { below(west), below(box.GetBound(2)), above(east), above(box.GetBound(3)) };
}

/// How many cells cover a length. One more than whole steps by rounding alone does not count.
std::int64_t CountCells(double length, double step)
{
  constexpr double most = 2147483647.0;
  constexpr double rounding = 1e-6;
  const double cells = std::max(std::ceil(length / step - rounding), 1.0);
  if (!(cells <= most))
  {
    throw CommandError(ExitCode::WrongUsage,
      "--raster: with cells of " + TextOf(step) + " the raster has more than 2^31 rows or columns");
  }
  return static_cast<std::int64_t>(cells);
}

RasterGrid MakeGrid(const HeightOptions& options, vtkPolyData* points)
{
  std::array<double, 4> extent = { -180.0, -90.0, 180.0, 90.0 };
  if (!options.Extent.empty())
  {
    ParseExtent(options.Extent, extent);
  }
  else if (!options.AreDirections)
  {
    extent = FindExtent(points, options.AreAngles, options.Step);
  }
  RasterGrid grid;
  grid.Step = options.Step;
  grid.Columns = CountCells(extent[2] - extent[0], options.Step);
  grid.Rows = CountCells(extent[3] - extent[1], options.Step);
  grid.X = extent[0] + options.Step / 2;
  grid.Y = extent[1] + options.Step / 2;
  return grid;
}

/// Throws if a raster needs more memory than this process may have.
void RequireMemory(const RasterGrid& grid, double needed)
{
  constexpr double mega = 1048576.0;
  double most =
    static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
  {
    most = std::min(most, static_cast<double>(limit.rlim_cur));
  }
  if (needed > most)
  {
    throw CommandError(ExitCode::WrongUsage,
      "--raster: " + Grouped(grid.Columns) + " x " + Grouped(grid.Rows) + " cells of " +
        TextOf(grid.Step) + " need " + Grouped(static_cast<std::int64_t>(needed / mega)) +
        " MB of memory, but there are " + Grouped(static_cast<std::int64_t>(most / mega)) +
        " MB; choose a larger step, or a part of the area by --extent");
  }
}

/// The directions of longitudes and latitudes.
vtkSmartPointer<vtkPolyData> MakeDirections(vtkDataSet* degrees)
{
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(degrees->GetNumberOfPoints());
  for (vtkIdType i = 0; i < degrees->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> angles, place;
    degrees->GetPoint(i, angles.data());
    PlaceOnSphere(angles[0], angles[1], place.data());
    points->SetPoint(i, place.data());
  }
  auto directions = vtkSmartPointer<vtkPolyData>::New();
  directions->SetPoints(points);
  return directions;
}

/// A raster in blocks of rows from the north.
class RasterQuery : public HeightQuery
{
public:
  RasterQuery(const HeightOptions& options, const RasterGrid& grid)
    : HeightQuery(options, "raster", Grouped(grid.Columns) + " x " + Grouped(grid.Rows) + " cells"),
      Grid(grid),
      HasDirections(options.AreDirections),
      Name({ "", ExtensionOf(options.Output), options.Crs, this->Array })
  {
    constexpr std::int64_t cells = 1 << 22; // of a block
    constexpr std::int64_t tile = 256; // rows of a GeoTIFF's tiles, which are best written once
    this->RowsOfBlock = std::max<std::int64_t>(cells / grid.Columns / tile, 1) * tile;
    constexpr double bytesOfCell = 40.0; // its place, triangle and values, and what is made of them
    const auto columns = static_cast<double>(grid.Columns), rows = static_cast<double>(grid.Rows);
    const double ofBlock =
      bytesOfCell * columns * std::min(static_cast<double>(this->RowsOfBlock), rows);
    const bool isWhole = this->Name.Extension == ".vti"; // else it is written in blocks
    if (isWhole && HasMarkup(this->Array))
    {
      throw CommandError(ExitCode::BadFile,
        options.Output + ": the array '" + this->Array +
          "' has one of < > & \" or a control character in the name, which this file format cannot "
          "hold; a .tif or .asc can hold it");
    }
    RequireMemory(grid, ofBlock + (isWhole ? sizeof(double) * columns * rows : 0.0));
  }

  vtkSmartPointer<vtkDataSet> NextBlock() override
  {
    const std::int64_t rows = std::min(this->RowsOfBlock, this->Grid.Rows - this->Taken);
    if (rows == 0)
    {
      return nullptr;
    }
    auto block = vtkSmartPointer<vtkImageData>::New();
    const double north =
      this->Grid.Y + static_cast<double>(this->Grid.Rows - 1 - this->Taken) * this->Grid.Step;
    block->SetDimensions(static_cast<int>(this->Grid.Columns), static_cast<int>(rows), 1);
    block->SetOrigin(this->Grid.X, north, 0.0);
    block->SetSpacing(this->Grid.Step, -this->Grid.Step, 1.0);
    this->Taken += rows;
    if (this->HasDirections)
    {
      return MakeDirections(block);
    }
    return block;
  }

  double GetShare() const override
  {
    return static_cast<double>(this->Taken) / static_cast<double>(this->Grid.Rows);
  }

  void Open(const std::string& path) override
  {
    this->Name.Path = path;
    this->File = MakeRasterFile(this->Name, this->Grid);
  }

  void Finish() override { this->File->Finish(); }

protected:
  void WriteValues(const double* values, vtkDataSet* block) override
  {
    this->File->WriteRows(values, block->GetNumberOfPoints() / this->Grid.Columns);
  }

private:
  RasterGrid Grid;
  bool HasDirections; ///< The filter gets these instead of longitudes and latitudes.
  RasterName Name;
  std::int64_t RowsOfBlock;
  std::int64_t Taken = 0; ///< Rows.
  std::unique_ptr<RasterFile> File;
};

/// A text as a cell of a table: in quotes, which are doubled inside, where it needs them.
std::string CellOf(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == text.npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text)
  {
    quoted.append(letter == '"' ? 2 : 1, letter);
  }
  return quoted + '"';
}

/// The points of a file, as rows of text: x, y, perhaps z, and the value, which is empty outside.
class PlaceTable : public HeightQuery
{
public:
  PlaceTable(const HeightOptions& options, vtkPolyData* places)
    : HeightQuery(options, "places", Grouped(places->GetNumberOfPoints())),
      Places(places),
      Asked(places),
      Axes(options.AreDirections && !options.PlacesAreAngles ? 3 : 2)
  {
    if (options.PlacesAreAngles)
    {
      this->Asked = MakeDirections(places);
    }
  }

  vtkSmartPointer<vtkDataSet> NextBlock() override
  {
    return std::exchange(this->IsTaken, true) ? nullptr : this->Asked;
  }

  double GetShare() const override { return 1.0; }

  void Open(const std::string& path) override
  {
    this->File.open(path, std::ios::binary);
    this->File << (this->Axes == 3 ? "x,y,z," : "x,y,") << CellOf(this->Array) << '\n';
  }

  void Finish() override
  {
    this->File.close();
    if (!this->File)
    {
      throw std::runtime_error("the system refuses to write");
    }
  }

protected:
  void WriteValues(const double* values, vtkDataSet* block) override
  {
    for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
    {
      const double* const place = this->Places->GetPoint(i);
      for (int axis = 0; axis < this->Axes; ++axis)
      {
        this->File << TextOf(place[axis]) << ',';
      }
      if (!std::isnan(values[i]))
      {
        this->File << TextOf(values[i]);
      }
      this->File << '\n';
    }
  }

private:
  vtkSmartPointer<vtkPolyData> Places; ///< Those of the file.
  vtkSmartPointer<vtkPolyData> Asked; ///< These, or their directions.
  int Axes; ///< How many coordinates of a place are written.
  bool IsTaken = false;
  std::ofstream File;
};

}

std::string ParseExtent(const std::string& text, std::array<double, 4>& extent)
{
  std::istringstream words(text + ',');
  std::size_t count = 0;
  bool areNumbers = true;
  for (std::string word; std::getline(words, word, ',');)
  {
    double value = 0.0;
    areNumbers = areNumbers && ReadNumber(word, value) == std::errc() && std::isfinite(value);
    extent[std::min<std::size_t>(count++, 3)] = value;
  }
  if (!areNumbers || count != 4 || !(extent[0] < extent[2]) || !(extent[1] < extent[3]))
  {
    return "'" + text +
      "' is not four numbers xmin,ymin,xmax,ymax with xmin < xmax and ymin < ymax";
  }
  return "";
}

HeightQuery::HeightQuery(
  const HeightOptions& options, const std::string& title, const std::string& noun)
  : Array(options.Array),
    IsOfHeights(options.Array.empty()),
    Title(title),
    Noun(noun)
{
  if (this->IsOfHeights)
  {
    this->Array = "z";
  }
}

std::unique_ptr<HeightQuery> HeightQuery::Make(
  const HeightOptions& options, vtkPolyData* points, vtkPolyData* places)
{
  if (places)
  {
    return std::make_unique<PlaceTable>(options, places);
  }
  return std::make_unique<RasterQuery>(options, MakeGrid(options, points));
}

void HeightQuery::Begin(vtkDelaunayFlipInterpolator* filter, vtkPolyData* points)
{
  this->Filter = filter;
  filter->SetElevationArray(this->IsOfHeights ? this->Array.c_str() : "");
  filter->SetInputData(0, this->NextBlock());
  filter->SetInputData(1, points);
}

void HeightQuery::Write(const std::string& path, const std::function<void(double)>& show)
{
  try
  {
    this->Open(path);
    this->WriteBlock(this->Filter->GetOutput());
    while (const vtkSmartPointer<vtkDataSet> block = this->NextBlock())
    {
      show(this->GetShare());
      this->Filter->SetInputData(0, block);
      this->Filter->Update();
      TakeVTKWarnings(); // those of the first block
      const std::string errors = TakeVTKErrors();
      if (!errors.empty())
      {
        throw std::runtime_error(errors);
      }
      this->WriteBlock(this->Filter->GetOutput());
    }
    this->Finish();
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(error.what() + ExplainFailedWrite(path));
  }
}

void HeightQuery::WriteBlock(vtkDataSet* block)
{
  const vtkIdType count = block->GetNumberOfPoints();
  vtkDataArray* const found = block->GetPointData()->GetArray(this->Array.c_str());
  vtkDataArray* const inside = block->GetPointData()->GetArray(MaskArray);
  std::vector<double> values(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    values[i] = found->GetComponent(i, 0);
    const bool isOutside = inside->GetComponent(i, 0) == 0.0;
    this->Outside += isOutside;
    this->HasOthers = this->HasOthers || (!isOutside && values[i] != 0.0);
    this->LikeNoData += values[i] == NoDataOfAscii;
    this->Infinite += std::isinf(values[i]);
    this->WithoutValue += !isOutside && std::isnan(values[i]);
  }
  this->Total += count;
  this->WriteValues(values.data(), block);
}

std::vector<std::string> HeightQuery::ListWarnings(bool isAscii) const
{
  std::vector<std::string> warnings;
  if (this->Outside == this->Total)
  {
    warnings.push_back("has no value, because all places are outside of the triangles");
  }
  else if (this->IsOfHeights && !this->HasOthers)
  {
    warnings.push_back(
      "all heights are 0, as those of the points are; --columns names the column of "
      "heights, and --raster-array takes other values");
  }
  if (this->WithoutValue > 0)
  {
    warnings.push_back(Grouped(this->WithoutValue) +
      " places have no value, because points around them have none (NaN)");
  }
  if (isAscii && this->LikeNoData > 0)
  {
    warnings.push_back(Grouped(this->LikeNoData) +
      " heights are -9999, which an .asc has for no value; a .tif or .vti can have both");
  }
  if (isAscii && this->Infinite > 0)
  {
    warnings.push_back(Grouped(this->Infinite) +
      " heights are infinite, which an .asc cannot have, so they have no value there; a .tif or "
      ".vti can have them");
  }
  return warnings;
}

std::string HeightQuery::Describe() const
{
  return this->Title + ": " + this->Noun + ", " + Grouped(this->Outside) + " outside\n";
}

vtkSmartPointer<vtkPolyData> SelectArray(
  vtkPolyData* points, const std::string& array, const std::string& path)
{
  auto selected = vtkSmartPointer<vtkPolyData>::New();
  selected->CopyStructure(points);
  if (array.empty())
  {
    return selected;
  }
  if (array == MaskArray)
  {
    throw CommandError(ExitCode::WrongUsage,
      "--raster-array: VTK calls the mask of places inside " + array +
        ", so an array of this name cannot be taken; give it another name");
  }
  vtkPointData* const data = points->GetPointData();
  vtkDataArray* const found = data->GetArray(array.c_str());
  if (!found || found->GetNumberOfComponents() != 1)
  {
    std::vector<std::string> names;
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      names.push_back("'" + std::string(data->GetArrayName(i)) + "'");
    }
    throw CommandError(ExitCode::BadFile,
      path + ": --raster-array: the points have no array '" + array +
        "' of one number each; they have " + (names.empty() ? "none" : JoinWords(names)) +
        ". Without --raster-array it is z that is taken");
  }
  selected->GetPointData()->AddArray(found);
  return selected;
}

}
