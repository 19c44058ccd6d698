// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BufferFiller_h
#define BufferFiller_h

#include "vtkDelaunayFlipRenderingModule.h" // For export macro

#include "DeviceColors.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>

class vtkDelaunayFlip;

namespace delaunayflip
{

class FlipSession;

/// Buffers of OpenGL that hold a drawn mesh, by OpenGL's names.
struct DrawnBuffers
{
  unsigned int Triangles = 0; ///< Three point ids of 32 bits per triangle.
  unsigned int Colors = 0; ///< Red, green, blue and alpha per triangle, a byte each.
  std::int64_t Count = 0; ///< The number of triangles.
};

/// What is to be written into them.
struct FilledMesh
{
  const FlipSession* Session; ///< Of Count triangles. If null, those that follow are drawn.
  TriangleArray Triangles; ///< In the host's memory, as are the points.
  const std::int32_t* FlipCounts; ///< One per triangle, or null: none has been flipped.
  PointArray Points;
  std::uint64_t PointsTime = 0; ///< Another one than in the last call if points have moved.
  DrawnColors Colors;
};

/// Writes triangles and their colours into the buffers that OpenGL draws. All calls but the
/// destructor are made with OpenGL's context current, and none after one has thrown an exception.
/// What the buffers hold is undefined then.
class BufferFiller
{
public:
  virtual ~BufferFiller() = default;

  /// Takes the buffers from OpenGL, which must not use them until Fill() or Unmap(). If they are
  /// taken already, nothing happens. Fill() does this by itself. It takes less time if this is
  /// called before the session makes its step: then the GPU finishes drawing, and switches from
  /// OpenGL to CUDA, while the step is being made.
  /// @throws std::exception.
  virtual void Map() {}

  /// Gives the buffers back as they are, if they are taken.
  /// @throws std::exception.
  virtual void Unmap() {}

  /// Writes the mesh and gives the buffers back to OpenGL. May return before they are written, as
  /// long as OpenGL waits for that.
  /// @throws std::exception.
  virtual void Fill(const FilledMesh& mesh) = 0;

  /// The smallest angle of the mesh in the buffers in degrees; NaN if there is none, or if it
  /// cannot be found out.
  virtual double GetSmallestAngle() noexcept = 0;
};

/// Makes a filler of buffers of the current context, for sessions of a filter. Their memory must
/// stay as it is as long as the filler exists.
/// @throws std::exception that says why it cannot fill them.
using FillerMaker = std::unique_ptr<BufferFiller> (*)(
  vtkDelaunayFlip* filter, const DrawnBuffers& buffers);

/// By CUDA, for sessions on the GPU that draws.
VTKDELAUNAYFLIPRENDERING_EXPORT std::unique_ptr<BufferFiller> MakeCudaFiller(
  vtkDelaunayFlip* filter, const DrawnBuffers& buffers);

/// From the host, for any mesh. The filter may be null.
VTKDELAUNAYFLIPRENDERING_EXPORT std::unique_ptr<BufferFiller> MakeHostFiller(
  vtkDelaunayFlip* filter, const DrawnBuffers& buffers);

/// What mappers use where they need not fill from the host: MakeCudaFiller, or what a test has put
/// in its place.
VTKDELAUNAYFLIPRENDERING_EXPORT extern FillerMaker DeviceFillerMaker;

}

#endif
