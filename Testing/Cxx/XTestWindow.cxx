// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TestWindow.h"

vtkSmartPointer<vtkRenderWindow> MakeTestWindow()
{
  return vtkSmartPointer<vtkRenderWindow>::New();
}

vtkSmartPointer<vtkRenderWindowInteractor> MakeTestInteractor()
{
  return vtkSmartPointer<vtkRenderWindowInteractor>::New();
}
