// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MACHINE_H
#define DELAUNAYFLIP_MACHINE_H

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace delaunayflip
{

using Clock = std::chrono::steady_clock;

inline double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

inline double MillisecondsSince(Clock::time_point start) { return 1e3 * SecondsSince(start); }

/// The number behind a word of a file like /proc/meminfo, in kB, as bytes; `missing` if it is not
/// there.
inline double ReadBytes(const char* path, const std::string& name, double missing)
{
  std::ifstream file(path);
  for (std::string word; file >> word;)
  {
    double kilobytes = 0.0;
    if (word == name + ":" && file >> kilobytes)
    {
      return 1024.0 * kilobytes;
    }
  }
  return missing;
}

/// Describes CPU, cores, compiler and build type in one line.
inline std::string DescribeMachine()
{
  std::string text = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
    {
      text = line.substr(colon + 2);
    }
  }
#if defined(__clang__)
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  return text + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " + compiler +
    ", " DELAUNAYFLIP_BUILD_TYPE;
}

}

#endif
