// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEEDGEBITS_CUH
#define DELAUNAYFLIP_DEVICEEDGEBITS_CUH

#include "CudaBackend.cuh"
#include "DeviceWorklist.cuh"
#include "EdgeBits.h"
#include "EdgeMesh.h"
#include "Team.cuh"

#include <cstdint>

namespace delaunayflip
{

/// Owns the EdgeBits, and has the functions for all edges at once.
class DeviceEdgeBits
{
public:
  DeviceEdgeBits(EdgeMesh& mesh, const CudaBackend& backend)
    : Backend(backend)
  {
    const std::int64_t units =
      (mesh.NumberOfEdges + EdgeUnits::UnitSize - 1) >> EdgeUnits::UnitBits;
    this->NumberOfWords = units * EdgeUnits::UnitSize / 32;
    std::uint32_t** const kinds[EdgeBits::Kinds] = { &this->Bits.Fixed, &this->Bits.FixedOrDeferred,
      &this->Bits.Candidates, &this->Bits.Bad, &this->Bits.Winners, &this->Bits.BlockedByShape,
      &this->Bits.BlockedByEdge };
    for (int kind = 0; kind < EdgeBits::Kinds; ++kind)
    {
      this->Words[kind] = backend.MakeArray<std::uint32_t>(this->NumberOfWords);
      *kinds[kind] = this->Words[kind].Data();
    }
    this->LoadStates(mesh);
  }

  const EdgeBits& View() const { return this->Bits; }
  std::int64_t CountUnits() const { return this->NumberOfWords / (EdgeUnits::UnitSize / 32); }

  // Public because device lambdas require it.

  /// Converts the initial states into bits. Bits after the last edge are fixed.
  void LoadStates(const EdgeMesh& mesh)
  {
    const EdgeBits bits = this->Bits;
    const EdgeState* states = mesh.States.Data();
    const std::int64_t edges = mesh.NumberOfEdges;
    this->Backend.ForEach(this->NumberOfWords,
      [=] __device__(std::int64_t word)
      {
        std::uint32_t fixed = 0;
        for (int i = 0; i < 32; ++i)
        {
          const std::int64_t edge = 32 * word + i;
          fixed |= edge >= edges || states[edge] == EdgeState::Fixed ? 1u << i : 0;
        }
        bits.Fixed[word] = fixed;
        bits.FixedOrDeferred[word] = fixed;
        bits.Candidates[word] = ~fixed;
        bits.Bad[word] = bits.Winners[word] = bits.BlockedByShape[word] = bits.BlockedByEdge[word] =
          0;
      });
  }

  /// @param chunkBits chunks of 2^chunkBits triangles.
  void DeferEdgesBetweenChunks(EdgeMesh& edgeMesh, int chunkBits)
  {
    const EdgeBits bits = this->Bits;
    const EdgeMeshView mesh = edgeMesh.View();
    const std::int64_t edges = edgeMesh.NumberOfEdges;
    // Threads of a warp work on one word.
    this->Backend.ForEach(32 * this->NumberOfWords,
      [=] __device__(std::int64_t e)
      {
        bool between = false;
        if (e < edges && !EdgeBits::Has(bits.Fixed, static_cast<EdgeId>(e)))
        {
          const CornerPair corners = mesh.GetCorners(static_cast<EdgeId>(e));
          between = (TriangleOf(corners.A) ^ TriangleOf(corners.B)) >> chunkBits != 0;
        }
        const std::uint32_t deferred = __ballot_sync(WholeWarp, between);
        if (e % 32 == 0)
        {
          bits.FixedOrDeferred[e / 32] |= deferred;
          bits.Bad[e / 32] &= ~deferred;
          bits.BlockedByShape[e / 32] &= ~deferred;
        }
      });
  }

  void RecallEdges()
  {
    const EdgeBits bits = this->Bits;
    this->Backend.ForEach(this->NumberOfWords,
      [=] __device__(std::int64_t word)
      {
        bits.Candidates[word] = bits.FixedOrDeferred[word] & ~bits.Fixed[word];
        bits.FixedOrDeferred[word] = bits.Fixed[word];
      });
  }

private:
  const CudaBackend& Backend;
  std::int64_t NumberOfWords = 0; ///< Of each kind of bits.
  Array<std::uint32_t> Words[EdgeBits::Kinds];
  EdgeBits Bits{};
};

}

#endif
