// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHFILES_H
#define DELAUNAYFLIP_MESHFILES_H

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataArray;

/// @file
/// Reading and writing of meshes in all formats. Call ReadMesh and WriteMesh in a child process: a
/// corrupt file may crash VTK's readers, or the limits on reading may end the process.

namespace delaunayflip
{

enum class MeshFormat
{
  VTK, ///< Legacy .vtk
  VTP, ///< VTK's XML .vtp
  PLY,
  STL,
  OBJ,
  Text, ///< .xyz, .csv or .txt: points, or lines of points; cannot be written.
  Vector ///< .shp, .gpkg and the like, which GDAL reads: points, lines, polygons; not written.
};

/// A file and the layer of it that is named, as in survey.gpkg:roads; only a file that GDAL reads
/// has layers.
struct FileLayer
{
  explicit FileLayer(const std::string& path);

  std::string File;
  std::string Layer; ///< Empty: none is named.
};

/// The extension of `path` in lower case, such as .ply.
std::string ExtensionOf(const std::string& path);

/// The format of `path`, from its extension in upper or lower case.
/// @throws CommandError (WrongUsage) that lists the known extensions.
MeshFormat FormatOf(const std::string& path);

/// A surface mesh that was read from a file.
struct FileMesh
{
  vtkSmartPointer<vtkPolyData> Mesh = vtkSmartPointer<vtkPolyData>::New();
  std::vector<std::string> Warnings; ///< What was left out, one line each, without the file.
  std::vector<std::string> Notes; ///< What may be good to know, like warnings.
  std::vector<std::string> Labels; ///< The integer arrays of cells with more than one value.

  bool HasAngles = false; ///< Whether the file calls x and y longitudes and latitudes.
  std::string Crs; ///< That of the coordinates, as GDAL describes it; empty: the file names none.

  /// Adds the name of an array of cells to the labels, if it has more than one value.
  void AddLabels(vtkDataArray* array);
};

/// What is read of a file.
enum class Content
{
  Mesh, ///< Also points that become one.
  Places, ///< Points of which only x and y matter. Nobody is told that they have no z.
  Rows, ///< Likewise, each for a row of a table. A row of text with empty cells only is kept.
  Segments ///< Lines and polygons, and in text lines of points with a number of their line.
};

/// Reads a surface mesh.
/// @param columns what --columns names; empty: nothing.
/// @throws CommandError (BadFile) that names the file and the reason.
FileMesh ReadMesh(const std::string& path, MeshFormat format, const std::string& columns = "",
  Content content = Content::Mesh);

/// Which points are corners of these cells.
std::vector<bool> FindUsed(vtkPolyData* mesh, const std::vector<vtkCellArray*>& kinds);

/// Whether a name has a character that VTK, which does not escape names, spoils in its XML files.
bool HasMarkup(const std::string& name);

/// `what` and, in parentheses, the names of the arrays of `data` that are not among `kept`; empty
/// if there are none.
std::string LostArrays(
  const std::string& what, vtkFieldData* data, const std::vector<vtkAbstractArray*>& kept);

/// Writes a mesh to `path`, in binary where the format allows it, and checks that the file is
/// complete, because the writers of some formats do not notice a full disk. Arrays that the format
/// would spoil are replaced in the mesh too.
/// @throws std::runtime_error with the reason; it does not name the file.
void WriteMesh(vtkPolyData* mesh, const std::string& path, MeshFormat format);

/// Lists in words which parts of `mesh` a file of this format cannot store; empty if it can store
/// all of them.
std::string DescribeLosses(vtkPolyData* mesh, MeshFormat format);

}

#endif
