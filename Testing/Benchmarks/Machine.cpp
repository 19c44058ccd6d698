// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Machine.h"

#include <fstream>
#include <thread>

namespace delaunayflip
{

namespace
{

std::string GetProcessor()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
    {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

std::string GetCompiler()
{
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown compiler";
#endif
}

}

std::string DescribeMachine()
{
  return GetProcessor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " +
    GetCompiler() + ", " DELAUNAYFLIP_BUILD_TYPE;
}

}
