// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BufferFiller_h
#define BufferFiller_h

#include "vtkDelaunayFlipRenderingModule.h" // For export macro

#include <memory>

class vtkDelaunayFlipAlgorithm;

namespace delaunayflip
{

class FlipSession;

/// Writes the triangles of a session on a GPU, three point ids of 32 bits each, into the buffer
/// that OpenGL draws. All calls but the destructor are made with OpenGL's context current, and none
/// after one has thrown an exception. What the buffer holds is undefined then.
class BufferFiller
{
public:
  virtual ~BufferFiller() = default;

  /// Takes the buffer from OpenGL, which must not use it until Fill() or Unmap(). If it is taken
  /// already, nothing happens. Fill() does this by itself. It takes less time if this is called
  /// before the session makes its step: then the GPU finishes drawing, and switches from OpenGL to
  /// CUDA, while the step is being made.
  /// @throws std::exception.
  virtual void Map() = 0;

  /// Gives the buffer back as it is, if it is taken.
  /// @throws std::exception.
  virtual void Unmap() = 0;

  /// Writes the triangles and gives the buffer back to OpenGL.
  /// @param session of as many triangles as the buffer.
  /// @param isNew whether it may be another session than the last time. If not, only triangles that
  /// have changed need be written.
  /// @throws std::exception.
  virtual void Fill(const FlipSession& session, bool isNew) = 0;
};

/// Makes a filler of a buffer of the current context, by OpenGL's name of it, for sessions of a
/// filter. The buffer's memory must stay as it is as long as the filler exists.
/// @throws std::exception that says why it cannot fill it.
using FillerMaker = std::unique_ptr<BufferFiller> (*)(
  vtkDelaunayFlipAlgorithm* filter, unsigned int buffer);

/// Makes a filler that uses CUDA, for sessions on the GPU that draws.
VTKDELAUNAYFLIPRENDERING_EXPORT std::unique_ptr<BufferFiller> MakeCudaFiller(
  vtkDelaunayFlipAlgorithm* filter, unsigned int buffer);

/// Mappers use this where they need not fill from the host. It is MakeCudaFiller, or what a test
/// has put in its place.
VTKDELAUNAYFLIPRENDERING_EXPORT extern FillerMaker DeviceFillerMaker;

}

#endif
