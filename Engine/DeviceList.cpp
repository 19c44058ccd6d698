// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipError.h"

#include <numeric>
#include <sstream>

namespace delaunayflip
{

std::vector<int> ParseDevices(const std::string& list)
{
  if (list == "all")
  {
    std::vector<int> devices(CountCudaDevices());
    std::iota(devices.begin(), devices.end(), 0);
    return devices;
  }
  std::vector<int> devices;
  std::istringstream words(list + (list.empty() ? "" : ","));
  for (std::string word; std::getline(words, word, ',');)
  {
    std::istringstream stream(word);
    int device = -1;
    const bool isNumber = (stream >> device) && (stream >> std::ws).eof();
    if (!isNumber || device < 0)
    {
      throw InvalidOptions("'" + list +
        "' is not a list of GPUs; give CUDA's numbers separated by commas (0,1), or all");
    }
    devices.push_back(device);
  }
  return devices;
}

}
