// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BufferFiller_h
#define BufferFiller_h

#include "vtkDelaunayFlipRenderingModule.h" // For export macro

#include "DeviceColors.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <string>

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
  const FlipSession& Session; ///< Of Count triangles.
  PointArray Points; ///< In the host's memory.
  std::uint64_t PointsTime = 0; ///< Another one than in the last call if points have moved.
  DrawnColors Colors;
};

/// Writes the mesh of a session into the buffers that OpenGL draws. All calls but the destructor
/// are made with OpenGL's context current.
class VTKDELAUNAYFLIPRENDERING_EXPORT BufferFiller
{
public:
  virtual ~BufferFiller() = default;

  /// Why this cannot fill buffers of the current context with the mesh of the filter's last
  /// update; empty if it can.
  virtual std::string FindObstacle(vtkDelaunayFlip* filter) = 0;

  /// Gets ready to fill these buffers. Their memory stays as it is until Release().
  /// @throws std::exception.
  virtual void Register(const DrawnBuffers& buffers) = 0;
  virtual void Release() noexcept = 0;

  /// Takes the registered buffers from OpenGL, which must not use them until Fill() or Unmap(). If
  /// they are taken already, nothing happens. Fill() does this by itself. It takes less time if
  /// this is called before the session makes its step: then the GPU finishes drawing, and
  /// switches from OpenGL to CUDA, while the step is being made.
  /// @throws std::exception; then what the buffers hold is undefined.
  virtual void Map() = 0;

  /// Gives the buffers back as they are, if they are taken.
  /// @throws std::exception; then what the buffers hold is undefined.
  virtual void Unmap() = 0;

  /// Writes the mesh and gives the buffers back to OpenGL. May return before they are written, as
  /// long as OpenGL waits for that.
  /// @throws std::exception; then what the buffers hold is undefined.
  virtual void Fill(const FilledMesh& mesh) = 0;

  /// The smallest angle of the mesh in the buffers in degrees; NaN if there is none, or if it
  /// cannot be found out.
  virtual double GetSmallestAngle() noexcept = 0;
};

/// The one that fills buffers by CUDA; null in a build without. Calls nothing of CUDA before it
/// must.
VTKDELAUNAYFLIPRENDERING_EXPORT std::unique_ptr<BufferFiller> MakeCudaFiller();

/// The one that live views use: that of CUDA, or what a test has put in its place.
std::unique_ptr<BufferFiller> MakeBufferFiller();
VTKDELAUNAYFLIPRENDERING_EXPORT void ReplaceBufferFiller(std::unique_ptr<BufferFiller> (*make)());

}

#endif
