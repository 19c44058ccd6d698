// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PeakMemory.h"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace delaunayflip
{

namespace
{

constexpr std::int64_t Unknown = -1;

/// A "Name:   123 kB" line of /proc/self/status, in bytes.
std::int64_t ReadStatus(const std::string& name)
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    std::string word;
    std::int64_t kilobytes = 0;
    if (words >> word >> kilobytes && word == name + ":")
    {
      return 1024 * kilobytes;
    }
  }
  return Unknown;
}

std::int64_t RunAndMeasure(const OwnedMesh<float>& mesh, const FlipOptions& options)
{
  std::vector<std::int32_t> output = mesh.Triangles;
  // Memory that the parent has freed but not returned would hide what the run needs.
  malloc_trim(0);
  const std::int64_t before = ReadStatus("VmRSS");
  FlipToDelaunay(
    mesh.View(), options, MutableTriangleArray(output.data(), mesh.NumberOfTriangles()));
  const std::int64_t peak = ReadStatus("VmHWM");
  return before == Unknown || peak == Unknown ? Unknown : peak - before;
}

}

std::int64_t MeasurePeakMemory(const OwnedMesh<float>& mesh, const FlipOptions& options)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    return Unknown;
  }
  const pid_t child = fork();
  if (child == 0)
  {
    const std::int64_t bytes = RunAndMeasure(mesh, options);
    const bool isWritten = write(ends[1], &bytes, sizeof bytes) == sizeof bytes;
    _exit(isWritten ? 0 : 1);
  }
  close(ends[1]);
  std::int64_t bytes = Unknown;
  const bool isRead = child > 0 && read(ends[0], &bytes, sizeof bytes) == sizeof bytes;
  close(ends[0]);
  if (child > 0)
  {
    waitpid(child, nullptr, 0);
  }
  return isRead ? bytes : Unknown;
}

}
