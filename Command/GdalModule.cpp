// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GdalModule.h"

#include <dlfcn.h>

#include <stdexcept>

namespace delaunayflip
{

const GdalModule& LoadGdal()
{
  void* const library = dlopen("libdelaunayflip-gdal.so", RTLD_NOW | RTLD_LOCAL);
  void* symbol = nullptr;
  if (library)
  {
    symbol = dlsym(library, "GetDelaunayFlipGdalModule");
  }
  if (!symbol)
  {
    throw std::runtime_error(std::string("needs GDAL, which is not here (") + dlerror() +
      "); on Debian, install libgdal-dev and build delaunay-flip again");
  }
  return *reinterpret_cast<const GdalModule* (*)()>(symbol)();
}

std::string SharedCrs::Compare(const std::string& crs, const std::string& path)
{
  if (this->Crs.empty())
  {
    this->Crs = crs;
    this->File = path;
    return "";
  }
  const std::string names = LoadGdal().DescribeDifference(crs, this->Crs);
  if (names.empty())
  {
    return "";
  }
  return path + ": its coordinate reference system is not that of " + this->File + " (" + names +
    "); the coordinates are taken as they are";
}

}
