// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FORMATS_H
#define DELAUNAYFLIP_FORMATS_H

#include "CommandError.h"
#include "InputFile.h"
#include "MeshFiles.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <unordered_map>

class vtkAbstractArray;

/// @file
/// The reader and the writer of each format. They throw CommandError (BadFile); readers name the
/// file, writers do not. The readers and writers of VtkFiles.cpp are VTK's, with checks. This
/// header has what all of them need.

namespace delaunayflip
{

FileMesh ReadLegacy(const InputFile& file);
FileMesh ReadXml(const InputFile& file);
FileMesh ReadPly(const InputFile& file);
FileMesh ReadObj(const InputFile& file);

/// @param columns those of x, y and z, as the user names them; empty: those with known names, or
/// the first ones.
FileMesh ReadPoints(const InputFile& file, const std::string& columns, Content content);

/// Lines of points: x y [z] and the number of the line that a point is on.
FileMesh ReadTextLines(const InputFile& file);

/// Points in the same place become one, because a .stl repeats them for every triangle. A triangle
/// that collapses stays a triangle.
FileMesh ReadStl(const InputFile& file);

void WriteLegacy(vtkPolyData* mesh, const std::string& path);
void WriteXml(vtkPolyData* mesh, const std::string& path);
void WriteStl(vtkPolyData* mesh, const std::string& path);
void WritePly(vtkPolyData* mesh, const std::string& path);
void WriteObj(vtkPolyData* mesh, const std::string& path);

/// The arrays of a mesh that a file holds.
struct HeldArrays
{
  std::vector<vtkAbstractArray*> OfPoints, OfCells, OfField;
};

HeldArrays ArraysOfPly(vtkPolyData* mesh);
HeldArrays ArraysOfObj(vtkPolyData* mesh);

/// Numbers places in the order in which they come.
class PlaceNumbers
{
public:
  /// @param place where each -0 becomes 0
  /// @returns the number of an equal place that came before, or that of a new one.
  vtkIdType Number(std::array<double, 3>& place)
  {
    std::array<std::uint64_t, 3> bits; // of which a NaN equals itself
    for (double& value : place)
    {
      value += 0.0;
    }
    std::memcpy(bits.data(), place.data(), sizeof(bits));
    return this->Known.try_emplace(bits, this->Known.size()).first->second;
  }

private:
  struct Hash
  {
    std::size_t operator()(const std::array<std::uint64_t, 3>& bits) const
    {
      const auto* const bytes = reinterpret_cast<const char*>(bits.data());
      return std::hash<std::string_view>()({ bytes, sizeof(bits) });
    }
  };

  std::unordered_map<std::array<std::uint64_t, 3>, vtkIdType, Hash> Known;
};

/// Calls `visit(size, points)` for every cell.
template <typename Function>
void ForEachCell(vtkCellArray* cells, const Function& visit)
{
  const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cell->GetCurrentCell(size, points);
    visit(size, points);
  }
}

}

#endif
