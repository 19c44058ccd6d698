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

/// The exit statuses that LiveFlip has in common with delaunay-flip.
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
  /// Prints the help or an error message if necessary.
  /// @returns the exit status if there is nothing left to do.
  std::optional<int> ReadArguments(int argc, char* argv[]);

  /// The mesh in the file, or null after an error message; MakeBadMesh() if no file was given.
  vtkSmartPointer<vtkPolyData> ReadMesh() const;

  /// One of vtkDelaunayFlip::GeometryType.
  int GetGeometry() const;

  /// The prefix of the frames; empty to show a window.
  const std::string& GetFramePrefix() const { return this->FramePrefix; }

  /// Runs the view to the end, off screen; writes every step and the last mesh.
  /// @returns the exit status.
  int WriteFrames(vtkDelaunayFlipLiveView* view, vtkRenderWindow* window) const;

private:
  int WriteMesh(vtkAlgorithmOutput* mesh) const;

  std::string Mesh; ///< The file; empty: a generated mesh.
  std::string Geometry = "auto";
  std::string FramePrefix;
};

#endif
