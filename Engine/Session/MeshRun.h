// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHRUN_H
#define DELAUNAYFLIP_MESHRUN_H

#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "LoadedRun.h"

#include <optional>
#include <vector>

namespace delaunayflip
{

/// The run of a mesh in one piece. Its stages are listed in ListStages.
class MeshRun final : public LoadedRun
{
public:
  /// @throws as FlipSession's constructor.
  MeshRun(const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress,
    const std::vector<ResultMemory>& expected = {});

  void StoreTriangles(const MutableTriangleArray& triangles) override;
  void StoreFlipCounts(std::int32_t* counts) override;
  bool StoreTrianglesOnDevice(const MutableTriangleArray& triangles, const DeviceStream& stream,
    std::int32_t* written) override;
  bool StoreFlipCountsOnDevice(std::int32_t* counts, const DeviceStream& stream) override;

private:
  void ListStages();
  void InsertConstraints();
  void LoadMesh();
  std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend) override;
  void Reset() override;
  void ListDefects() override;
  void Measure() override;

  CallerMesh Mesh;
  ConstraintInsertion Insertion; ///< The loaded mesh starts from its arrays.
  std::optional<CallerMesh> Start; ///< The mesh that iterations start from.
};

}

#endif
