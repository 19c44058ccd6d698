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

}
