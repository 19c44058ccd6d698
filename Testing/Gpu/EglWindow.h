// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef EglWindow_h
#define EglWindow_h

#include <string>

/// Makes the context of EGL in which MakeTestWindow() (TestWindow.h) draws: on the GPU that CUDA
/// numbers 0 or, with allowsOthers, on whatever EGL has. There is one for the process.
/// @returns why there is none; empty if there is one.
std::string OpenEgl(bool allowsOthers);

/// What OpenGL says it draws on; after the first frame of a window.
std::string GetRendererName();

#endif
