// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestFiller_h
#define TestFiller_h

#include <cstdint>
#include <string>
#include <vector>

/// Takes CUDA's place in the tests of drawing: fills OpenGL's buffers from the host, so that all
/// but CUDA itself is tested where there is no GPU, or, where the environment says
/// DELAUNAYFLIP_TEST_BACKEND=cuda, by CUDA. Either can be made to fail.
struct TestFiller
{
  /// What mappers meet from now on. A number counts calls; the last of them fails, as do all later
  /// ones; 0: none fails.
  std::string Obstacle;
  int FailingMap = 0;
  int FailingUnmap = 0;
  int FailingFill = 0;

  int Fillers = 0; ///< How many were made.
  int Maps = 0; ///< Also by fills of buffers that are not mapped.
  int Unmaps = 0;
  int Fills = 0;
  int Living = 0; ///< How many fillers there are now.
  bool AreMapped = false; ///< OpenGL must not use the buffer.

  /// What the buffer of the last filler holds. Needs its context.
  std::vector<std::int32_t> GetTriangles() const;

  /// Puts the filler in the place of the mappers' own, with nothing that fails.
  static TestFiller& Install();

  /// Gives mappers their own one back.
  static void Remove();
};

#endif
