// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef OpenGLFunctions_h
#define OpenGLFunctions_h

/// The functions of OpenGL as VTK loads them: by GLEW up to 9.3, by GLAD since 9.4.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
