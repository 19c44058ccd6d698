// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ExampleFiles_h
#define ExampleFiles_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>

class vtkAlgorithmOutput;
class vtkDelaunayFlipLiveView;
class vtkRenderWindow;

/// The exit statuses of delaunay-flip that LiveFlip has too.
enum ExitStatus
{
  Done = 0,
  WrongUsage = 2,
  BadFile = 3
};

/// The command line of LiveFlip, and the files that it reads and writes.
class ExampleFiles
{
public:
  /// Prints the help or what was wrong, where it has to.
  /// @returns the exit status when there is nothing left to do.
  std::optional<int> ReadArguments(int argc, char* argv[]);

  /// The mesh of the file, null after an error message; without a file MakeBadMesh().
  vtkSmartPointer<vtkPolyData> ReadMesh() const;

  /// One of vtkDelaunayFlip::GeometryType.
  int GetGeometry() const;

  /// Empty where a window is wanted.
  const std::string& GetFramePrefix() const { return this->FramePrefix; }

  /// Runs the view to its end, off screen; writes every step and the last mesh.
  /// @returns the exit status.
  int WriteFrames(vtkDelaunayFlipLiveView* view, vtkRenderWindow* window) const;

private:
  int WriteMesh(vtkAlgorithmOutput* mesh) const;

  std::string Mesh; ///< Empty: one that is made here.
  std::string Geometry = "auto";
  std::string FramePrefix;
};

#endif
