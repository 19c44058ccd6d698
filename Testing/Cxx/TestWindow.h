// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestWindow_h
#define TestWindow_h

#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSmartPointer.h"

/// The windows that tests of drawing use: those of X (LiveViewTest.cxx) or, where there is no X, of
/// EGL (Testing/Gpu/EglWindow.cxx).
vtkSmartPointer<vtkRenderWindow> MakeTestWindow();
vtkSmartPointer<vtkRenderWindowInteractor> MakeTestInteractor();

#endif
