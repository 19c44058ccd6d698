// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PslgFile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace delaunayflip
{

namespace
{

using Row = std::vector<double>;

/// The lines that hold numbers, as far as they do.
std::vector<Row> ReadRows(const std::string& path)
{
  std::ifstream file(path);
  std::vector<Row> rows;
  std::string line;
  while (std::getline(file, line))
  {
    std::istringstream text(line.substr(0, line.find('#')));
    Row row;
    double number = 0.0;
    while (text >> number)
    {
      row.push_back(number);
    }
    if (!row.empty())
    {
      rows.push_back(row);
    }
  }
  if (rows.empty())
  {
    throw std::runtime_error(path + ": nothing in it");
  }
  return rows;
}

/// Gives equal points one number.
class PslgMaker
{
public:
  void AddPoint(double x, double y)
  {
    const auto [place, isNew] =
      this->Numbers.emplace(std::make_pair(x, y), this->Made.Points.size());
    if (isNew)
    {
      this->Made.Points.push_back({ x, y });
    }
    this->NumberOf.push_back(static_cast<std::int64_t>(place->second));
  }

  void AddSegment(std::int64_t from, std::int64_t to)
  {
    const std::pair<std::int64_t, std::int64_t> segment(
      this->NumberOf.at(from), this->NumberOf.at(to));
    if (segment.first != segment.second)
    {
      this->Made.Segments.push_back(segment);
    }
  }

  std::int64_t GetSize() const { return static_cast<std::int64_t>(this->NumberOf.size()); }

  Pslg Made;

private:
  std::map<std::pair<double, double>, std::size_t> Numbers;
  std::vector<std::int64_t> NumberOf;
};

Pslg ReadPoly(const std::string& path)
{
  std::vector<Row> rows = ReadRows(path);
  std::vector<Row> nodes = rows;
  auto next = static_cast<std::size_t>(rows[0][0]) + 1; // where segments begin
  if (rows[0][0] == 0.0)
  {
    nodes = ReadRows(path.substr(0, path.size() - 4) + "node");
  }
  const auto count = static_cast<std::size_t>(nodes[0][0]);
  const auto first = static_cast<std::int64_t>(nodes[1][0]);
  PslgMaker maker;
  for (std::size_t i = 1; i <= count; ++i)
  {
    maker.AddPoint(nodes.at(i).at(1), nodes.at(i).at(2));
  }
  const auto segments = static_cast<std::size_t>(rows.at(next)[0]);
  for (std::size_t i = 1; i <= segments; ++i)
  {
    const Row& row = rows.at(next + i);
    maker.AddSegment(
      static_cast<std::int64_t>(row.at(1)) - first, static_cast<std::int64_t>(row.at(2)) - first);
  }
  return maker.Made;
}

Pslg ReadCdt(const std::string& path)
{
  const std::vector<Row> rows = ReadRows(path);
  const auto points = static_cast<std::size_t>(rows[0].at(0));
  const auto segments = static_cast<std::size_t>(rows[0].at(1));
  PslgMaker maker;
  for (std::size_t i = 1; i <= points; ++i)
  {
    maker.AddPoint(rows.at(i).at(0), rows.at(i).at(1));
  }
  for (std::size_t i = points + 1; i <= points + segments; ++i)
  {
    maker.AddSegment(
      static_cast<std::int64_t>(rows.at(i).at(0)), static_cast<std::int64_t>(rows.at(i).at(1)));
  }
  return maker.Made;
}

Pslg ReadPolygon(const std::string& path)
{
  PslgMaker maker;
  for (const Row& row : ReadRows(path))
  {
    maker.AddPoint(row.at(0), row.at(1));
  }
  for (std::int64_t i = 0; i < maker.GetSize(); ++i)
  {
    maker.AddSegment(i, (i + 1) % maker.GetSize());
  }
  return maker.Made;
}

}

Pslg ReadPslg(const std::string& path)
{
  const std::string extension = std::filesystem::path(path).extension();
  if (extension == ".poly")
  {
    return ReadPoly(path);
  }
  return extension == ".txt" ? ReadCdt(path) : ReadPolygon(path);
}

std::vector<std::string> ListPslgFiles(const std::string& folder)
{
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
  {
    const std::string extension = entry.path().extension();
    if (extension == ".poly" || extension == ".txt" || extension == ".dat")
    {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}
