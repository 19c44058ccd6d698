// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFile.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace delaunayflip
{
namespace
{

struct Header
{
  char Magic[8];
  std::int64_t CoordinateBytes;
  std::int64_t Points;
  std::int64_t Triangles;
  std::int64_t ConstraintEdges;
  std::int64_t IsHeightField;
};

std::int64_t GetFileSize(const Header& header)
{
  return static_cast<std::int64_t>(sizeof(Header)) + 3 * header.CoordinateBytes * header.Points +
    12 * header.Triangles + 16 * header.ConstraintEdges;
}

bool IsSound(const Header& header)
{
  constexpr std::int64_t Most = std::numeric_limits<std::int32_t>::max();
  const auto isCount = [](std::int64_t count) { return count >= 0 && count <= Most; };
  return std::memcmp(header.Magic, "DFMESH01", 8) == 0 &&
    (header.CoordinateBytes == 4 || header.CoordinateBytes == 8) && isCount(header.Points) &&
    isCount(header.Triangles) && isCount(header.ConstraintEdges);
}

template <typename Number>
void Read(std::ifstream& file, std::int64_t count, std::vector<Number>& numbers)
{
  numbers.resize(static_cast<std::size_t>(count));
  file.read(reinterpret_cast<char*>(numbers.data()),
    static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
}

}

TriangleMesh FileMesh::View() const
{
  TriangleMesh view;
  view.Points = this->Doubles.empty()
    ? PointArray(this->Floats.data(), static_cast<std::int64_t>(this->Floats.size()) / 3)
    : PointArray(this->Doubles.data(), static_cast<std::int64_t>(this->Doubles.size()) / 3);
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
    if (entry.path().extension() == ".dfmesh")
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
  Header header = {};
  file.read(reinterpret_cast<char*>(&header), sizeof(header));
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (!file || error || !IsSound(header) || size != GetFileSize(header))
  {
    throw std::runtime_error(path + " is not a complete mesh file");
  }
  FileMesh mesh;
  mesh.Name = std::filesystem::path(path).stem().string();
  mesh.IsHeightField = header.IsHeightField != 0;
  if (header.CoordinateBytes == 4)
  {
    Read(file, 3 * header.Points, mesh.Floats);
  }
  else
  {
    Read(file, 3 * header.Points, mesh.Doubles);
  }
  Read(file, 3 * header.Triangles, mesh.Triangles);
  Read(file, 2 * header.ConstraintEdges, mesh.ConstraintEdges);
  if (!file)
  {
    throw std::runtime_error(path + " cannot be read");
  }
  return mesh;
}

}
