// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_COLORTABLE_CUH
#define DELAUNAYFLIP_COLORTABLE_CUH

#include "CudaBackend.cuh"
#include "DeviceColors.h"
#include "FlipError.h"

#include <cstdint>

namespace delaunayflip
{

/// ColorBands where kernels can read them.
struct ColorTableView
{
  const std::uint32_t* Colors = nullptr;
  std::int64_t Size = 0;
  double First = 0.0; ///< Where the first band begins.
  double Scale = 0.0; ///< Bands per unit.
  std::uint32_t OfNaN = 0;

  __device__ std::uint32_t Find(double value) const
  {
    const double band = (value - this->First) * this->Scale;
    const double last = static_cast<double>(this->Size - 1);
    const double kept = band < 0.0 ? 0.0 : band > last ? last : band;
    return band == band ? this->Colors[static_cast<int>(kept)] : this->OfNaN;
  }
};

/// Has the memory of such a view.
class ColorTable
{
public:
  ColorTable() = default;

  /// @throws InvalidOptions if there is no band.
  ColorTable(const ColorBands& bands, const CudaBackend& backend)
  {
    const auto size = static_cast<std::int64_t>(bands.Colors.size());
    if (size == 0)
    {
      throw InvalidOptions("there must be at least one band of colours");
    }
    this->Colors = backend.MakeArray<std::uint32_t>(size);
    backend.Upload(bands.Colors.data(), size, this->Colors.Data());
    this->Values = { this->Colors.Data(), size, bands.First,
      static_cast<double>(size) / (bands.Last - bands.First), bands.OfNaN };
  }

  const ColorTableView& View() const { return this->Values; }

private:
  Array<std::uint32_t> Colors;
  ColorTableView Values;
};

}

#endif
