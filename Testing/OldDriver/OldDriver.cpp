// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// A driver that is too old for any current CUDA runtime. It only reports its version.

extern "C" __attribute__((visibility("default"))) int cuDriverGetVersion(int* version)
{
  constexpr int Cuda8 = 8000;
  *version = Cuda8;
  return 0;
}
