// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "FlipError.h"

#include <numeric>
#include <sstream>

namespace delaunayflip
{

namespace
{
/// @returns -1 if the word is not the number of a GPU.
int ParseDevice(const std::string& word)
{
  std::istringstream stream(word);
  int device = -1;
  const bool isNumber = (stream >> device) && (stream >> std::ws).eof();
  return isNumber && device >= 0 ? device : -1;
}
}

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
    devices.push_back(ParseDevice(word));
    if (devices.back() < 0)
    {
      throw InvalidOptions("'" + list +
        "' is not a list of GPUs; give CUDA's numbers separated by commas (0,1), or all");
    }
  }
  return devices;
}

}
