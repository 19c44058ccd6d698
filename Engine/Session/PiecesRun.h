// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECESRUN_H
#define DELAUNAYFLIP_PIECESRUN_H

#include "MeshInParts.h"
#include "SessionRun.h"

#include <memory>
#include <string>

namespace delaunayflip
{

/// The run of a mesh in several pieces. Its stages are listed in ListStages. One call of
/// Advance does them all, whatever the number of iterations. If it is stopped, the next one begins
/// anew.
class PiecesRun final : public SessionRun
{
public:
  /// @param triangles as CutIntoParts takes them.
  /// @throws as FlipInPieces.
  PiecesRun(const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress,
    const MutableTriangleArray& triangles = {});

  bool Advance(std::int64_t iterations, const FlipObserver& observer,
    const ProgressObserver& progress) override;
  const FlipReport& GetReport() override { return this->Report; }
  PiecesReport GetPiecesReport() const;
  void StoreTriangles(const MutableTriangleArray& triangles) override;
  void StoreFlipCounts(std::int32_t* counts) override;
  void StoreSources(std::int32_t* sources) override;

private:
  void ListStages();
  void Cut();
  void Begin();
  void Reset() override;
  std::string ExplainRefusal() const override
  {
    return "a mesh in several pieces cannot move and has no regions, and this session was not made "
           "from points";
  }

  TriangleMesh Mesh;
  FlipOptions Options;
  MutableTriangleArray Given; ///< For the triangles, or empty.
  std::unique_ptr<MeshInParts> Parts; ///< None before the first stage.
};

}

#endif
