// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BufferFiller.h"

#include <limits>

/// @file
/// Takes the place of CudaFiller.cxx in a build without CUDA.

namespace delaunayflip
{

namespace
{

class NoFiller : public BufferFiller
{
public:
  std::string FindObstacle(vtkDelaunayFlip*) override { return "this build has no CUDA backend"; }
  void Register(const DrawnBuffers&) override {}
  void Release() noexcept override {}
  void Map() override {}
  void Unmap() override {}
  void Fill(const FilledMesh&) override {}
  double GetSmallestAngle() noexcept override { return std::numeric_limits<double>::quiet_NaN(); }
};

}

std::unique_ptr<BufferFiller> MakeCudaFiller() { return std::make_unique<NoFiller>(); }

}
