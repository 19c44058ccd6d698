// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BENCHMARKARGUMENTS_H
#define DELAUNAYFLIP_BENCHMARKARGUMENTS_H

#include "BenchmarkRow.h"

#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

struct BenchmarkArguments
{
  std::vector<std::int64_t> Sizes = { 100000, 500000, 1000000, 2000000, 5000000, 20000000,
    100000000 };
  std::vector<std::int64_t> CpuSizes = { 100000, 1000000, 5000000 };
  std::vector<std::int64_t> Threads = { 1, 2, 4, 8, 16 };
  RepetitionPlan Plan;
  std::string MeshFolder;
  std::string JsonPath;
  bool DescribeOnly = false;
  bool SectorRatesOnly = false;
};

/// What a user may ask for, for --help and after a wrong argument.
extern const char* const BenchmarkUsage;

/// @throws std::invalid_argument that names what is wrong.
BenchmarkArguments ParseArguments(int argc, char** argv);

}

#endif
