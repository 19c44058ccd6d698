// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ExampleFiles_h
#define ExampleFiles_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkDelaunayFlipLiveView;
class vtkRenderWindow;

/// The files that LiveFlip reads and writes: [MESH.vtp] [--frames PREFIX].
class ExampleFiles
{
public:
  ExampleFiles(int argc, char* argv[]);

  /// The mesh of the file; without one a square of 612 triangles, most of them slivers.
  vtkSmartPointer<vtkPolyData> ReadMesh() const;

  /// Empty where a window is wanted.
  const std::string& GetFramePrefix() const { return this->FramePrefix; }

  /// Runs the view to its end, off screen; writes every step and the last mesh.
  /// @returns the exit status.
  int WriteFrames(vtkDelaunayFlipLiveView* view, vtkRenderWindow* window) const;

private:
  std::string Mesh; ///< Empty: one that is made here.
  std::string FramePrefix;
};

#endif
