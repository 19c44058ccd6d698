// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHROOM_H
#define DELAUNAYFLIP_MESHROOM_H

#include "Array.h"
#include "EdgeMesh.h"

#include <cstdint>
#include <utility>

/// @file
/// Room for what is added to a mesh.

namespace delaunayflip
{

/// Makes room in an array for `size` values, and for more if it has to move: on a device for a half
/// more. A host gives an array pages when they are written, so there room for twice as many costs
/// nothing, and the array moves less often.
template <typename T, typename Backend>
void Reserve(Array<T>& array, std::int64_t used, std::int64_t size, const Backend& backend)
{
  if (static_cast<std::int64_t>(array.Size()) >= size)
  {
    return;
  }
  const std::int64_t spare = Backend::IsOnHost ? size : size / 2;
  Array<T> larger = backend.template MakeArray<T>(size + spare);
  const T* from = array.Data();
  T* to = larger.Data();
  backend.ForEach(used, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { to[i] = from[i]; });
  array = std::move(larger);
}

/// The states behind the last edge. Fewer edges may be added than there is room for, and loops read
/// states there.
struct StatesBehind
{
  EdgeState* First;
  std::int64_t Count;

  DELAUNAYFLIP_HOST_DEVICE void Fix(std::int64_t i) const { this->First[i] = EdgeState::Fixed; }
};

/// Makes room in a mesh for so many triangles and edges.
/// @returns states that the caller must fix.
template <typename Backend>
StatesBehind MakeMeshRoom(
  EdgeMesh& mesh, std::int64_t triangles, std::int64_t edges, const Backend& backend)
{
  constexpr std::int64_t Padding = EdgeMesh::StatePadding;
  const std::int64_t states = (edges + Padding - 1) / Padding * Padding;
  Reserve(mesh.Triangles, mesh.NumberOfTriangles, triangles, backend);
  Reserve(mesh.CornerOfHalfEdge, 2 * mesh.NumberOfEdges, 2 * edges, backend);
  Reserve(mesh.States, mesh.NumberOfEdges, states, backend);
  return { mesh.States.Data() + mesh.NumberOfEdges, states - mesh.NumberOfEdges };
}

/// Likewise, and fixes these states.
template <typename Backend>
void ReserveMesh(EdgeMesh& mesh, std::int64_t triangles, std::int64_t edges, const Backend& backend)
{
  const StatesBehind behind = MakeMeshRoom(mesh, triangles, edges, backend);
  backend.ForEach(behind.Count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { behind.Fix(i); });
}

}

#endif
