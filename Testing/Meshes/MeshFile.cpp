// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFile.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace delaunayflip
{
TriangleMesh FileMesh::View() const
{
  TriangleMesh view;
  const auto points = static_cast<std::int64_t>(this->Floats.size() + this->Doubles.size()) / 3;
  view.Points = this->Doubles.empty() ? PointArray(this->Floats.data(), points)
                                      : PointArray(this->Doubles.data(), points);
  view.Triangles =
    TriangleArray(this->Triangles.data(), static_cast<std::int64_t>(this->Triangles.size()) / 3);
  view.ConstraintEdges = this->ConstraintEdges.data();
  view.NumberOfConstraintEdges = static_cast<std::int64_t>(this->ConstraintEdges.size()) / 2;
  return view;
}

std::vector<std::string> ListMeshFiles(const std::string& folder)
{
  std::vector<std::string> paths;
  std::error_code isMissing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, isMissing))
  {
    if (entry.path().extension().string() == ".dfmesh")
    {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

FileMesh ReadMeshFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  char magic[8] = {};
  std::int64_t numbers[5] = {};
  file.read(magic, sizeof(magic));
  file.read(reinterpret_cast<char*>(numbers), sizeof(numbers));
  const auto [coordinateBytes, points, triangles, edges, isHeightField] = numbers;
  const std::int64_t expected = 48 + 3 * coordinateBytes * points + 12 * triangles + 16 * edges;
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (!file || error || size != expected || std::memcmp(magic, "DFMESH01", sizeof(magic)) != 0)
  {
    throw std::runtime_error(path + " is not a complete mesh file");
  }
  const auto read = [&file](std::int64_t count, auto& values)
  {
    values.resize(static_cast<std::size_t>(count));
    file.read(reinterpret_cast<char*>(values.data()),
      static_cast<std::streamsize>(values.size() * sizeof(values[0])));
  };
  FileMesh mesh;
  mesh.Name = std::filesystem::path(path).stem().string();
  mesh.IsHeightField = isHeightField != 0;
  coordinateBytes == 4 ? read(3 * points, mesh.Floats) : read(3 * points, mesh.Doubles);
  read(3 * triangles, mesh.Triangles);
  read(2 * edges, mesh.ConstraintEdges);
  if (!file)
  {
    throw std::runtime_error(path + " cannot be read");
  }
  return mesh;
}

}
