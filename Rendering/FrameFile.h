// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FrameFile_h
#define FrameFile_h

#include <string>

class vtkRenderWindow;

namespace delaunayflip
{

/// The name of a frame's file, e.g. "prefix0012.png" for frame 12.
std::string MakeFrameName(const std::string& prefix, int frame);

/// Writes the picture in a window to a PNG file.
/// @returns whether the whole file could be written.
bool WriteFrame(vtkRenderWindow* window, const std::string& fileName);

}

#endif
