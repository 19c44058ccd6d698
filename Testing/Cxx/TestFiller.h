// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestFiller_h
#define TestFiller_h

#include <string>

/// Fills OpenGL's buffers in the tests of drawing without copies: from memory of the host, so
/// that all but CUDA itself is tested where there is no GPU, or, where the environment says
/// DELAUNAYFLIP_TEST_BACKEND=cuda, by CUDA. Either can be made to fail.
struct TestFiller
{
  /// What live views meet from now on. A number counts calls; the last of them fails, as do all
  /// later ones; 0: none fails.
  std::string Obstacle;
  int FailingRegister = 0;
  int FailingMap = 0;
  int FailingUnmap = 0;
  int FailingFill = 0;

  int Registers = 0;
  int Releases = 0;
  int Maps = 0; ///< Also by fills of buffers that are not mapped.
  int Unmaps = 0;
  int Fills = 0;
  bool IsRegistered = false;
  bool AreMapped = false; ///< OpenGL must not use the buffers.

  /// Puts the filler in the place of the live views' own, with nothing that fails.
  static TestFiller& Install();

  /// Gives live views their own one back.
  static void Remove();
};

#endif
