// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkArguments.h"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace delaunayflip
{
namespace
{

double ParseNumber(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(number >= 0 && number < 1e12))
  {
    throw std::invalid_argument("'" + text + "' is not a number");
  }
  return number;
}

std::vector<std::int64_t> ParseCounts(const std::string& text)
{
  std::vector<std::int64_t> counts;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');)
  {
    counts.push_back(static_cast<std::int64_t>(ParseNumber(item)));
    if (counts.back() < 1)
    {
      throw std::invalid_argument("'" + item + "' is not a count");
    }
  }
  return counts;
}

void MakeQuick(BenchmarkArguments& arguments)
{
  arguments.Sizes = { 100000, 1000000 };
  arguments.CpuSizes = { 100000 };
  arguments.Plan = { 3, 2.0 };
}

/// Takes an option with its value; false for one that is unknown.
bool TakeOption(const std::string& name, const std::string& value, BenchmarkArguments& arguments)
{
  if (name == "--sizes")
  {
    arguments.Sizes = ParseCounts(value);
  }
  else if (name == "--cpu-sizes")
  {
    arguments.CpuSizes = ParseCounts(value);
  }
  else if (name == "--threads")
  {
    arguments.Threads = ParseCounts(value);
  }
  else if (name == "--repetitions")
  {
    arguments.Plan.Repetitions = static_cast<int>(ParseNumber(value));
  }
  else if (name == "--seconds")
  {
    arguments.Plan.Seconds = ParseNumber(value);
  }
  else if (name == "--meshes" || name == "--json")
  {
    (name == "--json" ? arguments.JsonPath : arguments.MeshFolder) = value;
  }
  else
  {
    return false;
  }
  return true;
}

}

const char* const BenchmarkUsage =
  "Usage: delaunay-flip-gpu-benchmark [OPTION...]\n"
  "  --sizes N,N,...      points of the random bad meshes that the GPU flips\n"
  "  --cpu-sizes N,N,...  those of them that the threads of the CPU and CGAL get too (none: '')\n"
  "  --threads N,N,...    numbers of threads, as far as there are cores\n"
  "  --repetitions N      runs after one that warms up; their median counts\n"
  "  --seconds S          fewer runs of what takes longer in all, but one\n"
  "  --meshes DIR         also the real meshes of export_meshes.py\n"
  "  --json FILE          writes the rows, the machine and the GPU\n"
  "  --quick              few sizes and runs; options behind it change them\n"
  "  --describe           only prints the machine and the GPU as JSON\n"
  "  --sector-rates       only measures how many random sectors a second the GPU serves\n";

BenchmarkArguments ParseArguments(int argc, char** argv)
{
  BenchmarkArguments arguments;
  for (int i = 1; i < argc; ++i)
  {
    const std::string name = argv[i];
    if (name == "--quick")
    {
      MakeQuick(arguments);
    }
    else if (name == "--describe")
    {
      arguments.DescribeOnly = true;
    }
    else if (name == "--sector-rates")
    {
      arguments.SectorRatesOnly = true;
    }
    else if (i + 1 == argc || !TakeOption(name, argv[++i], arguments))
    {
      throw std::invalid_argument("unknown option or missing value: " + name);
    }
  }
  return arguments;
}

}
