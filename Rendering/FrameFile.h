// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FrameFile_h
#define FrameFile_h

#include <string>

class vtkRenderWindow;

namespace delaunayflip
{

/// `prefix` 12 -> "prefix0012.png".
std::string MakeFrameName(const std::string& prefix, int frame);

/// Writes what a window shows as a PNG.
/// @returns whether all of it could be written.
bool WriteFrame(vtkRenderWindow* window, const std::string& fileName);

}

#endif
