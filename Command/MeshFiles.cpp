// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFiles.h"

#include "DataArrays.h"
#include "Formats.h"
#include "GdalModule.h"
#include "OutputFiles.h"

#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtksys/SystemTools.hxx>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>

namespace delaunayflip
{

std::string ExtensionOf(const std::string& path)
{
  return vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
}

std::vector<bool> FindUsed(vtkPolyData* mesh, const std::vector<vtkCellArray*>& kinds)
{
  std::vector<bool> isUsed(mesh->GetNumberOfPoints());
  for (vtkCellArray* cells : kinds)
  {
    ForEachCell(cells,
      [&isUsed](vtkIdType size, const vtkIdType* points)
      { std::for_each(points, points + size, [&](vtkIdType point) { isUsed[point] = true; }); });
  }
  return isUsed;
}

bool HasMarkup(const std::string& name)
{
  return std::any_of(name.begin(), name.end(),
    [](unsigned char letter) { return std::strchr("<>&\"", letter) || std::iscntrl(letter); });
}

std::string LostArrays(
  const std::string& what, vtkFieldData* data, const std::vector<vtkAbstractArray*>& kept)
{
  std::vector<std::string> names;
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(index);
    const std::string name = array->GetName() ? array->GetName() : "?";
    const bool isOwn = name.rfind("DelaunayFlip:", 0) == 0; // of an earlier run
    if (!isOwn && std::find(kept.begin(), kept.end(), array) == kept.end())
    {
      names.push_back(name);
    }
  }
  return names.empty() ? "" : what + " (" + JoinWords(names) + ")";
}

namespace
{

/// The data segments and private mappings of this process in bytes, as the system counts them.
double UsedMemory()
{
  std::ifstream file("/proc/self/statm");
  double pages[6] = {};
  for (double& count : pages)
  {
    file >> count;
  }
  return pages[5] * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Lowers a limit of this process for as long as the result lives.
std::shared_ptr<void> LowerLimit(int resource, double value)
{
  rlimit before = {};
  getrlimit(resource, &before);
  rlimit lowered = before;
  lowered.rlim_cur = std::min(before.rlim_cur, static_cast<rlim_t>(value));
  setrlimit(resource, &lowered);
  return { nullptr, [=](void*) { setrlimit(resource, &before); } };
}

void RequireSizes(vtkCellArray* cells, vtkIdType fewest, const std::string& what)
{
  vtkIdType cell = 0;
  ForEachCell(cells,
    [&](vtkIdType size, const vtkIdType*)
    {
      if (size < fewest)
      {
        throw std::runtime_error(what + " " + std::to_string(cell) + " has " +
          Counted(size, "point") + ", too few for this file format; a .vtk can hold it");
      }
      ++cell;
    });
}

void RequireValidIds(vtkPolyData* mesh, const InputFile& file)
{
  vtkIdType cell = 0;
  const vtkIdType points = mesh->GetNumberOfPoints();
  for (vtkCellArray* cells :
    { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() })
  {
    if (!cells->IsValid())
    {
      file.Fail("has cells without end (corrupt)");
    }
    ForEachCell(cells,
      [&](vtkIdType size, const vtkIdType* ids)
      {
        const vtkIdType* const bad =
          std::find_if(ids, ids + size, [points](vtkIdType id) { return id < 0 || id >= points; });
        if (bad != ids + size)
        {
          file.Fail("cell " + std::to_string(cell) + " names point " + std::to_string(*bad) +
            ", but there are " + Counted(points, "point") + ", numbered from 0");
        }
        ++cell;
      });
  }
}

/// Whether the last line of a .vtk or an .obj is complete: if it is cut off, the file may be
/// readable, but wrong. The other formats have an end, or a length that the reader checks.
bool IsEnded(const std::string& path, MeshFormat format)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(-1, std::ios::end);
  return (format != MeshFormat::VTK && format != MeshFormat::OBJ) || file.get() == '\n';
}

/// What a .stl loses of the points.
struct PointLosses
{
  explicit PointLosses(vtkPolyData* mesh)
  {
    const std::vector<bool> isUsed = FindUsed(mesh, { mesh->GetPolys(), mesh->GetStrips() });
    this->Unused = std::count(isUsed.begin(), isUsed.end(), false);
    std::vector<std::array<double, 3>> places;
    for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
    {
      if (isUsed[point])
      {
        mesh->GetPoint(point, places.emplace_back().data());
        std::replace_if( // NaN has no order
          places.back().begin(), places.back().end(), [](double x) { return std::isnan(x); }, 0.0);
      }
    }
    const auto countDistinct = [&places]
    {
      std::sort(places.begin(), places.end());
      return std::unique(places.begin(), places.end()) - places.begin();
    };
    this->Fallen = countDistinct();
    for (std::array<double, 3>& place : places)
    {
      for (double& x : place)
      {
        const double rounded = static_cast<float>(x);
        this->LargestMove = std::fmax(this->LargestMove, std::abs(rounded - x)); // not of infinity
        x = rounded;
      }
    }
    this->Fallen -= countDistinct();
  }

  std::int64_t Unused = 0; ///< Points of no polygon.
  double LargestMove = 0.0; ///< By how much a coordinate changes at most when it becomes float.
  std::int64_t Fallen = 0; ///< How many different places become the same as others.
};

/// On cells with fewer points than their kind needs, VTK's .vtp writer crashes, and files of other
/// formats cannot be read; as float, large coordinates would be infinite.
void RequireStorable(vtkPolyData* mesh, MeshFormat format)
{
  if (format == MeshFormat::VTP || format == MeshFormat::OBJ)
  {
    RequireSizes(mesh->GetStrips(), 3, "strip");
    RequireSizes(mesh->GetVerts(), 1, "vert");
    RequireSizes(mesh->GetLines(), 2, "line");
  }
  if (format != MeshFormat::VTK)
  {
    RequireSizes(mesh->GetPolys(), 3, "polygon");
  }
  if (format == MeshFormat::STL && std::isinf(PointLosses(mesh).LargestMove))
  {
    throw std::runtime_error(
      "a coordinate is larger than 3.4e38, too large for this file format; a .vtk, .vtp, .ply or "
      ".obj can hold it");
  }
}

/// A file format, by one of its extensions.
struct FormatRow
{
  const char* Extension;
  MeshFormat Format;
  FileMesh (*Read)(const InputFile&);
  void (*Write)(vtkPolyData*, const std::string&);
};

constexpr FormatRow Formats[] = {
  { ".vtk", MeshFormat::VTK, ReadLegacy, WriteLegacy },
  { ".vtp", MeshFormat::VTP, ReadXml, WriteXml },
  { ".ply", MeshFormat::PLY, ReadPly, WritePly },
  { ".stl", MeshFormat::STL, ReadStl, WriteStl },
  { ".obj", MeshFormat::OBJ, ReadObj, WriteObj },
  { ".xyz", MeshFormat::Text, nullptr, nullptr },
  { ".csv", MeshFormat::Text, nullptr, nullptr },
  { ".txt", MeshFormat::Text, nullptr, nullptr },
};

/// A file format that GDAL reads.
struct VectorRow
{
  const char* Extension;
  const char* Driver; ///< GDAL's name of it.
};

constexpr VectorRow VectorFormats[] = {
  { ".shp", "ESRI Shapefile" },
  { ".gpkg", "GPKG" },
  { ".geojson", "GeoJSON" },
  { ".dxf", "DXF" },
  { ".fgb", "FlatGeobuf" },
};

const VectorRow* FindVectorFormat(const std::string& file)
{
  const auto found = std::find_if(std::begin(VectorFormats), std::end(VectorFormats),
    [&](const VectorRow& row) { return ExtensionOf(file) == row.Extension; });
  return found == std::end(VectorFormats) ? nullptr : found;
}

const FormatRow& RowOf(MeshFormat format)
{
  return *std::find_if(std::begin(Formats), std::end(Formats),
    [format](const FormatRow& row) { return row.Format == format; });
}

}

namespace
{

/// How to go on with a file of meshes that the command cannot read; empty for other files.
std::string NameTheWay(const std::string& extension)
{
  const auto isOneOf = [&extension](const std::vector<std::string>& others)
  { return std::find(others.begin(), others.end(), extension) != others.end(); };
  if (extension == ".vtu")
  {
    return "; ParaView's Extract Surface makes a .vtp of a .vtu, and in Python "
           "delaunayflip.meshio.flip flips its triangles";
  }
  if (isOneOf({ ".off", ".msh", ".mesh", ".inp", ".xdmf", ".med" }))
  {
    return "; \"meshio convert\" converts between " + extension +
      " and .ply, and in Python delaunayflip.meshio.flip takes what meshio reads";
  }
  if (isOneOf({ ".tif", ".asc", ".vti" }))
  {
    return "; --raster writes a raster of heights";
  }
  if (isOneOf({ ".las", ".laz" }))
  {
    return "; in Python, delaunayflip.laspy.triangulate reads such files (pip install "
           "'delaunayflip[lidar]')";
  }
  if (isOneOf({ ".2dm", ".14", ".grd", ".gr3" }))
  {
    return "; in Python, delaunayflip.flip takes the points and triangles of such a file as arrays";
  }
  return "";
}

}

FileLayer::FileLayer(const std::string& path)
  : File(path)
{
  const auto isThere = [](const std::string& file)
  { return vtksys::SystemTools::FileExists(file); };
  if (isThere(path))
  {
    return;
  }
  // Names of layers may have colons, and so may those of files.
  for (std::size_t colon = path.find(':'); colon != path.npos; colon = path.find(':', colon + 1))
  {
    const std::string file = path.substr(0, colon);
    const bool isFirst = this->Layer.empty();
    if (FindVectorFormat(file) && (isFirst || isThere(file)))
    {
      this->File = file;
      this->Layer = path.substr(colon + 1);
    }
    if (isThere(this->File))
    {
      return;
    }
  }
}

MeshFormat FormatOf(const std::string& path)
{
  const std::string file = FileLayer(path).File;
  if (FindVectorFormat(file))
  {
    return MeshFormat::Vector;
  }
  const std::string extension = ExtensionOf(file);
  for (const FormatRow& row : Formats)
  {
    if (extension == row.Extension)
    {
      return row.Format;
    }
  }
  throw CommandError(ExitCode::WrongUsage,
    path +
      ": unknown file extension; known are .vtk, .vtp, .ply, .stl and .obj, and for points and "
      "lines .xyz, .csv, .txt, .shp, .gpkg, .geojson, .dxf and .fgb" +
      NameTheWay(extension));
}

void FileMesh::AddLabels(vtkDataArray* array)
{
  const double* const range = array->GetRange(0);
  if (range[0] < range[1] && array->GetNumberOfComponents() == 1)
  {
    this->Labels.emplace_back(array->GetName());
  }
}

namespace
{

/// A text with another one in all places of a part, which is not empty.
std::string Replaced(std::string text, const std::string& part, const std::string& other)
{
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + other.size()))
  {
    text.replace(at, part.size(), other);
  }
  return text;
}

FileMesh ReadVectorFile(
  const InputFile& file, const std::string& path, const std::string& height, Content content)
{
  const FileLayer layer(path);
  VectorRequest request;
  request.Path = file.GetPath();
  request.Driver = FindVectorFormat(layer.File)->Driver;
  request.Layer = layer.Layer;
  request.HasData = content != Content::Segments && content != Content::Rows;
  request.AreFlat = content == Content::Places || content == Content::Rows;
  if (content != Content::Segments)
  {
    request.Height = height;
  }
  const std::string extension = ExtensionOf(layer.File);
  const bool isPipe = file.GetPath() != layer.File;
  if (isPipe && (extension == ".gpkg" || extension == ".shp"))
  {
    file.Fail("a " + extension + " cannot be read from a pipe, because GDAL needs the file itself");
  }
  try
  {
    return LoadGdal().ReadVectors(request);
  }
  catch (const std::runtime_error& error)
  {
    file.Fail(Replaced(error.what(), file.GetPath(), layer.File));
  }
}

}

FileMesh ReadMesh(
  const std::string& path, MeshFormat format, const std::string& columns, Content content)
{
  const InputFile file(FileLayer(path).File);
  const auto bytes = static_cast<double>(file.GetBytes().size());
  const double seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  // A file that asks for more ends the process, or an allocation fails. Text of one-digit numbers
  // grows 16 times when every number becomes a few doubles. Compressed data can grow a thousand
  // times, but only if they are nearly constant. The slowest readers take 0.2 microseconds per
  // byte.
  const auto memory = LowerLimit(RLIMIT_DATA, UsedMemory() + (1 << 30) + 200.0 * bytes);
  const auto time = LowerLimit(RLIMIT_CPU, std::ceil(seconds + 30.0 + 5e-6 * bytes));
  try
  {
    FileMesh read;
    if (format == MeshFormat::Vector)
    {
      read = ReadVectorFile(file, path, columns, content);
    }
    else if (format == MeshFormat::Text && content == Content::Segments)
    {
      read = ReadTextLines(file);
    }
    else if (format == MeshFormat::Text)
    {
      read = ReadPoints(file, columns, content);
    }
    else
    {
      read = RowOf(format).Read(file);
    }
    RequireValidIds(read.Mesh, file);
    return read;
  }
  catch (const std::bad_alloc&)
  {
  }
  catch (const std::length_error&)
  {
  }
  file.Fail(
    "cannot be read: not enough memory, or the file is corrupt: it asks for more than its " +
    std::to_string(file.GetBytes().size()) + " bytes can hold");
}

void WriteMesh(vtkPolyData* mesh, const std::string& path, MeshFormat format)
{
  RequireStorable(mesh, format);
  std::string problem;
  try
  {
    RowOf(format).Write(mesh, path);
    if (format == MeshFormat::VTP)
    {
      return; // WriteXml has checked it
    }
    const vtkSmartPointer<vtkPolyData> written = ReadMesh(path, format).Mesh;
    if (IsEnded(path, format) && mesh->GetNumberOfPolys() == written->GetNumberOfPolys() &&
      (format == MeshFormat::STL || mesh->GetNumberOfPoints() == written->GetNumberOfPoints()) &&
      ((format != MeshFormat::VTK && format != MeshFormat::OBJ) ||
        mesh->GetNumberOfCells() == written->GetNumberOfCells()))
    {
      return;
    }
    problem = "the file is incomplete when read back";
  }
  catch (const CommandError& error)
  {
    // The user does not know the temporary file, so the message does not name it.
    problem = error.what();
    const std::string beginning = path + ": ";
    if (problem.rfind(beginning, 0) == 0)
    {
      problem.erase(0, beginning.size());
    }
  }
  throw std::runtime_error(problem + ExplainFailedWrite(path));
}

namespace
{

/// Whether an array of cells has another value than 0 at a line.
bool HasValueOfLine(vtkPolyData* mesh, vtkDataArray* array)
{
  const vtkIdType first = mesh->GetNumberOfVerts();
  const vtkIdType end = first + mesh->GetNumberOfLines();
  for (vtkIdType cell = first; cell < end; ++cell)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      if (array->GetComponent(cell, component) != 0.0)
      {
        return true;
      }
    }
  }
  return false;
}

/// What lines lose in a .ply, which has cell data of faces alone.
std::string LostValuesOfLines(vtkPolyData* mesh, const HeldArrays& held)
{
  std::vector<std::string> names;
  for (vtkAbstractArray* const array : held.OfCells)
  {
    auto* const numbers = vtkArrayDownCast<vtkDataArray>(array);
    const bool isKnown = !names.empty() && names.back() == GetName(array); // of several components
    if (!isKnown && HasValueOfLine(mesh, numbers))
    {
      names.push_back(GetName(array));
    }
  }
  return names.empty() ? "" : "cell data of lines (" + JoinWords(names) + ")";
}

}

std::string DescribeLosses(vtkPolyData* mesh, MeshFormat format)
{
  if (format == MeshFormat::VTK || format == MeshFormat::VTP)
  {
    return {};
  }
  std::vector<std::string> losses;
  const auto add = [&losses](const std::string& loss)
  {
    if (!loss.empty())
    {
      losses.push_back(loss);
    }
  };
  const auto addCount = [&add](const std::string& what, std::int64_t count)
  {
    if (count > 0)
    {
      add(what + " (" + std::to_string(count) + ")");
    }
  };
  if (format == MeshFormat::STL)
  {
    addCount("lines", mesh->GetNumberOfLines());
  }
  if (format != MeshFormat::OBJ)
  {
    addCount("verts", mesh->GetNumberOfVerts());
  }
  if (format == MeshFormat::STL)
  {
    const PointLosses points(mesh);
    addCount("unused points", points.Unused);
    if (points.LargestMove > 0.0)
    {
      std::array<char, 32> move{};
      std::snprintf(move.data(), move.size(), "%.2g", points.LargestMove);
      std::string change = "coordinates change by up to " + std::string(move.data());
      if (points.Fallen > 0)
      {
        change += ", " + Counted(points.Fallen, "point") + " fall on others";
      }
      add("double precision of the points (" + change + ")");
    }
  }
  HeldArrays held; // nothing, by a .stl
  if (format == MeshFormat::PLY)
  {
    held = ArraysOfPly(mesh);
  }
  else if (format == MeshFormat::OBJ)
  {
    held = ArraysOfObj(mesh);
  }
  add(LostArrays("point data", mesh->GetPointData(), held.OfPoints));
  add(LostArrays("cell data", mesh->GetCellData(), held.OfCells));
  if (format == MeshFormat::PLY)
  {
    add(LostValuesOfLines(mesh, held));
  }
  add(LostArrays("field data", mesh->GetFieldData(), held.OfField));
  return JoinWords(losses);
}

}
